#pragma once
// Real scans for tests; docs/meshprep.md says where they come from.

#include <filesystem>
#include <string>

namespace tegument::testing_prep {

/// The scan with this name from the folder `stanford` below $TEGUMENT_SHARED_DATA, or from the cache; unpacked into `folder`. Empty where
/// there is none.
[[nodiscard]] std::filesystem::path findScan(const std::string& name, const std::filesystem::path& folder);

} // namespace tegument::testing_prep
