#pragma once
// What a pass draws of a mesh: its part, without what cannot be seen, and of thin strands a share.

#include "host/gpu/gpu.h"
#include "host/run/prepare.h"
#include "host/run/strands.h"

#include <memory>
#include <string>
#include <tuple>
#include <vector>

namespace tegument::run {

/// Strands that are listed once and drawn by several passes of a frame.
struct PartList {
    using Key = std::tuple<const Mesh*, std::string, double, double, double, double, double, std::uint32_t>;
    Key key;
    std::optional<gpu::Buffer> indices; // none: there is nothing to draw
    std::vector<StrandRange> ranges;
    bool whole = false; // all of the part is drawn, from the mesh's own indices
};
using PartLists = std::vector<std::unique_ptr<PartList>>;

struct PartRequest {
    const RunInput& input;
    const Prepared& prepared;
    const Pass& pass;
    Extent viewport; // that it draws into
    gpu::Device& device;
};

/// Fills in the draw's indices, ranges and instances, which are those of the whole mesh. Annotations of the pass: Part; Reach with
/// ReachScale; Share with ShareRadius and ShareThinnest (docs/running.md).
[[nodiscard]] Result<void> chooseTriangles(const PartRequest& request, PartLists& lists, gpu::Draw& draw);

} // namespace tegument::run
