#pragma once
// Windows programs through Wine: one prefix in the cache, one virtual display, a time limit.

#include "tools/process/process.h"

namespace tegument {

/// What Wine needs and this machine lacks, in words; empty when nothing.
[[nodiscard]] std::string wineMissing();

/// How to start a Windows program: the prefix is prepared (once, about 15 s) and a display opened, which ends with the calling thread.
/// TG3104 when Wine or the display cannot be had.
[[nodiscard]] Result<ProcessCommand> wineProcess(const std::filesystem::path& program, const std::vector<std::string>& arguments);

/// Runs such a program to the end.
[[nodiscard]] Result<ProcessResult> runInWine(const std::filesystem::path& program, const std::vector<std::string>& arguments,
                                              double timeoutSeconds);

} // namespace tegument
