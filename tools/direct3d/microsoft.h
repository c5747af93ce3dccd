#pragma once
// Microsoft's d3dcompiler_47 in Wine: fx_2_0, fx_4_0, fx_5_0 and single entry points, a job list in one process.

#include "host/spirv/compile.h"
#include "host/support/result.h"
#include "host/support/roots.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument {

/// The longest job seen takes 3 s; on a machine with much else to do many times that.
inline constexpr double kMicrosoftJobSeconds = 180;

struct MicrosoftJob {
    std::string profile; // fx_2_0, fx_4_0, fx_5_0, vs_3_0, ps_3_0, vs_5_0, ps_5_0 ...; "listing" for a compiled shader of model 3
    std::string entry;   // empty for fx_* and listing
    std::filesystem::path source;
    std::vector<std::pair<std::string, std::string>> defines;
    std::filesystem::path output;                      // empty: only in the result
    std::vector<std::filesystem::path> includeFolders; // empty: Microsoft's own include handler, as in most engines
    std::string shader;                                // of a listing
    bool compatible = false;                           // fxc's option /Gec; a byte order mark is left out
    /// Where files may lie that the source includes: else TG1014, and nothing of what the compiler says. None: anywhere.
    std::optional<Roots> roots = {};
};

/// What ps_3_0 or vs_3_0 used, read from the disassembly: the SM3 limits are asserted by us because the compiler does not hold all of them.
struct Sm3Usage {
    int instructionSlots = 0;
    int constants = 0; // highest register + 1
    int samplers = 0;
    int interpolators = 0;               // pixel shader inputs; vertex shader outputs without the position
    std::map<std::string, int> varyings; // their semantics, "TEXCOORD3", with the number of components
};

/// What D3DReflect says of a shader of model 4 or 5: registers in place of bindings and locations, every set 0.
struct Sm5Reflection {
    Reflection reflection;
    std::map<std::string, std::vector<double>> defaults; // of constants that have one, in row order
    std::vector<std::string> unwritten;                  // outputs of which no component is ever set
    bool writesPosition = false;                         // SV_Position
};

struct MicrosoftResult {
    bool ok = false;
    bool kept = false; // from an earlier run: nothing was compiled
    std::vector<Diagnostic> diagnostics;
    std::string binary;
    int techniqueCount = -1;          // inside the binary; -1: not an effect
    int passCount = -1;               // inside the binary, fx_2_0 only
    int shaderCount = -1;             // inside the binary, fx_4_0 and fx_5_0 only
    std::optional<Sm3Usage> sm3;      // of vs_3_0, ps_3_0, listing
    std::optional<Sm5Reflection> sm5; // of shaders of model 4 and 5
    double milliseconds = 0;
};

/// Empty when the tool can run; otherwise what is missing ("wine is not installed", ...): the caller reports `not checked: <reason>`.
[[nodiscard]] std::string microsoftCompilerMissing();

/// Microsoft's d3dcompiler_47.dll: programs that load effects from source need it beside them.
[[nodiscard]] std::filesystem::path microsoftCompilerLibrary();

/// Runs all jobs in one Wine process, in order; a job that brings the process down fails (TG3103) and the rest goes on in a new one.
/// Messages are TG3101 (errors, with Microsoft's X number in the text) and TG3102 (warnings). A path that cannot be
/// handed over fails its job (TG3105). What compiles is kept in <cache>/microsoft by the text that the compiler's preprocessor makes of it.
/// An Error means that nothing could be run: TG3104, Wine or its display.
[[nodiscard]] Result<std::vector<MicrosoftResult>> compileWithMicrosoft(const std::vector<MicrosoftJob>& jobs,
                                                                        double jobSeconds = kMicrosoftJobSeconds);

} // namespace tegument
