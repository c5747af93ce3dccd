#include "meshprep/prepare/simplify.h"

namespace tegument::prep {

std::span<const Simplifier> simplifiers() {
    static constexpr std::array kAll = {Simplifier{}};
    return kAll;
}

std::vector<std::uint32_t> simplifyNewer(const Simplification& what, float) {
    return {what.from.begin(), what.from.end()};
}

} // namespace tegument::prep
