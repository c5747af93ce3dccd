#pragma once
// Microsoft's d3dcompiler_47 in Wine: fx_2_0, fx_4_0, fx_5_0 and single entry points, a job list in one process.

#include "host/support/result.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument {

struct MicrosoftJob {
    std::string profile; // fx_2_0, fx_4_0, fx_5_0, vs_3_0, ps_3_0, vs_5_0, ps_5_0 ...
    std::string entry;   // empty for fx_*
    std::filesystem::path source;
    std::vector<std::pair<std::string, std::string>> defines;
    std::filesystem::path output; // empty: not kept
};

/// What ps_3_0 or vs_3_0 used, read from the disassembly: the SM3 limits are asserted by us because the compiler does not hold all of them.
struct Sm3Usage {
    int instructionSlots = 0;
    int constants = 0; // highest register + 1
    int samplers = 0;
    int interpolators = 0; // pixel shader inputs; vertex shader outputs without the position
};

struct MicrosoftResult {
    bool ok = false;
    std::vector<Diagnostic> diagnostics;
    int techniqueCount = -1; // inside the binary; -1: not an effect
    int passCount = -1;      // inside the binary, fx_2_0 only
    int shaderCount = -1;    // inside the binary, fx_4_0 and fx_5_0 only
    std::uintmax_t bytes = 0;
    std::optional<Sm3Usage> sm3;
    double milliseconds = 0;
};

/// Empty when the tool can run; otherwise what is missing ("wine is not installed", ...): the caller reports `not checked: <reason>`.
[[nodiscard]] std::string microsoftCompilerMissing();

/// Microsoft's d3dcompiler_47.dll: programs that load effects from source need it beside them.
[[nodiscard]] std::filesystem::path microsoftCompilerLibrary();

/// Runs all jobs in one Wine process, in order; a job that brings the process down fails (TG3103) and the rest goes on in a new one.
/// Messages are TG3101 (errors, with Microsoft's X number in the text) and TG3102 (warnings). A path that cannot be
/// handed over fails its job (TG3105). An Error means that nothing could be run: TG3104, Wine or its display.
[[nodiscard]] Result<std::vector<MicrosoftResult>> compileWithMicrosoft(const std::vector<MicrosoftJob>& jobs);

} // namespace tegument
