#pragma once
// Microsoft's d3dcompiler_47 in Wine: fx_2_0, fx_4_0, fx_5_0 and single entry points, a job list in one process.

#include "host/support/result.h"

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

/// What ps_3_0 or vs_3_0 used, read from the disassembly: the SM3 limits are asserted by us because the compiler does not.
struct Sm3Usage {
    int instructionSlots = 0;
    int constants = 0;
    int samplers = 0;
    int interpolators = 0;
};

struct MicrosoftResult {
    bool ok = false;
    std::vector<Diagnostic> diagnostics;
    int techniqueCount = -1; // inside the binary; -1: not an effect
    std::optional<Sm3Usage> sm3;
    double milliseconds = 0;
};

/// Empty when the tool can run; otherwise what is missing ("wine is not installed", ...): the caller reports `not checked: <reason>`.
[[nodiscard]] std::string microsoftCompilerMissing();

/// Runs all jobs in one Wine process, in order.
[[nodiscard]] Result<std::vector<MicrosoftResult>> compileWithMicrosoft(const std::vector<MicrosoftJob>& jobs);

} // namespace tegument
