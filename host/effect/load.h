#pragma once
// Loading from texts that are in no file: tests and the fuzzer.

#include "host/effect/model.h"
#include "host/effect/preprocess.h"

namespace tegument {

/// The roots of the effect are everywhere.
[[nodiscard]] Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read);

} // namespace tegument
