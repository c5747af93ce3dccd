#pragma once
// Loading in other ways: from texts that are in no file, for tests and the fuzzer; as another target reads it.

#include "host/effect/model.h"
#include "host/effect/preprocess.h"

namespace tegument {

/// The roots of the effect are everywhere.
[[nodiscard]] Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read);

/// With the techniques of fx_2_0, where a long pass may be several: the metadata view without FX_D3D11.
[[nodiscard]] Result<Effect> loadEffectOfDirect3D9(const std::filesystem::path& file, const LoadOptions& options);

} // namespace tegument
