#pragma once
// Charts: faces that share texture coordinates.

#include "host/support/disjoint_sets.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace tegument {

/// For each face (with indices `uv`) the number of its chart. Numbers follow the order of first use.
template <class Face>
[[nodiscard]] std::vector<std::uint32_t> chartsOf(const std::vector<Face>& faces) {
    std::uint32_t last = 0;
    for (const Face& face : faces)
        last = std::max(last, std::ranges::max(face.uv));
    DisjointSets sets(last + std::size_t{1});
    for (const Face& face : faces)
        for (const std::uint32_t uv : face.uv)
            sets.join(face.uv[0], uv);
    std::map<std::uint32_t, std::uint32_t> numbers;
    std::vector<std::uint32_t> result;
    for (const Face& face : faces)
        result.push_back(numbers.try_emplace(sets.find(face.uv[0]), static_cast<std::uint32_t>(numbers.size())).first->second);
    return result;
}

} // namespace tegument
