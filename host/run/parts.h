#pragma once
// Which of a mesh's triangles a pass draws: all, or the part that its annotation `Part` names, without the clusters that cannot be seen.

#include "host/effect/model.h"
#include "host/mesh/mesh.h"
#include "host/run/semantics.h"

#include <vector>

namespace tegument::run {

struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
    bool operator==(const IndexRange&) const = default;
};

/// What parts may be called "skin" where none is: every part that no pass of the effect names.
inline constexpr const char* kSkinPart = "skin";

/// In order, those that touch made one. TG4060 the mesh has no part of that name.
[[nodiscard]] Result<std::vector<IndexRange>> partOf(const Effect& effect, const Pass& pass, const Mesh& mesh);

} // namespace tegument::run
