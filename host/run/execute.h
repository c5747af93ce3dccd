#pragma once
// Runs what was prepared, frame after frame, and reads targets back.

#include "host/run/frame.h"

#include <span>

namespace tegument::run {

/// One mesh, or none. TG4029 a target to dump that the technique does not use.
[[nodiscard]] Result<RunResult> execute(const RunInput& input, const Prepared& prepared);
/// Several, whose resources are allocated.
[[nodiscard]] Result<RunResult> execute(std::span<const ObjectRun> objects, Resources& resources);

/// What a picture must say about its making (docs/running.md, "Metadata").
[[nodiscard]] std::map<std::string, std::string> metadata(std::span<const ObjectRun> objects);
/// Each once: objects of one effect have most of their warnings in common.
[[nodiscard]] std::vector<Diagnostic> warningsOf(std::span<const ObjectRun> objects);

} // namespace tegument::run
