#pragma once
// Windows programs through Wine: one prefix in the cache, one virtual display, a time limit.

#include "host/support/process.h"

namespace tegument {

/// What Wine needs and this machine lacks, in words; empty when nothing.
[[nodiscard]] std::string wineMissing();

/// Prepares the prefix (once, about 15 s) and the display, then runs the program. TG3104 when Wine or the display cannot be had.
[[nodiscard]] Result<ProcessResult> runInWine(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                              double timeoutSeconds);

} // namespace tegument
