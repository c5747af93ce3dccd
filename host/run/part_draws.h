#pragma once
// What a pass draws of a mesh: its part, without what cannot be seen, and of thin strands a share, of short ones fewer rows.

#include "host/gpu/gpu.h"
#include "host/run/prepare.h"
#include "host/run/strands.h"

#include <memory>
#include <string>
#include <vector>

namespace tegument::run {

/// Strands that are listed once and drawn by several passes of a frame.
struct PartList {
    struct Key {
        const Mesh* mesh = nullptr;
        std::string part;
        double reach = 0; // -1: all is listed, seen or not
        StrandShare share;
        bool operator==(const Key&) const = default;
    };
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
/// ReachScale; Share with ShareRadius, ShareThinnest, ShareFewest and ShareFirst; Segment with SegmentsOf and SegmentScale;
/// Least with LeastRadius or LeastSpacings and LeastScale (docs/running.md).
[[nodiscard]] Result<void> chooseTriangles(const PartRequest& request, PartLists& lists, gpu::Draw& draw);

} // namespace tegument::run
