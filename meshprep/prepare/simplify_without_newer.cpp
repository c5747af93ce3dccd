#include "meshprep/prepare/simplify.h"

namespace tegument::prep {

std::optional<std::vector<std::uint32_t>> simplifyNewer(const Simplification&, float) {
    return std::nullopt;
}

} // namespace tegument::prep
