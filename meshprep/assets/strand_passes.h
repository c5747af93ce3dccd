#pragma once
// Annotations of passes that draw or note strands (docs/design/fur.md), read here and nowhere else: Reach with ReachScale;
// Share with ShareRadius, ShareThinnest, ShareFewest and ShareFirst; Segment with SegmentsOf, SegmentScale and SegmentFewest; Least with
// LeastRadius or LeastSpacings, LeastScale and LeastTaper; Rows with RowsStrands, RowsMore, RowsEach, RowsScale and RowsMacro.

#include "host/run/parts.h"
#include "host/run/pass_request.h"
#include "host/support/result.h"
#include "meshprep/assets/strand_lists.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tegument::assets {

/// Least cosine of horizonOf() in effects: see strand_passes.cpp.
[[nodiscard]] double horizonOf(double reach);

/// Draw lists of passes that draw strands. Passes that list the same get the same object while one of them holds it. Thread safe.
class StrandPasses {
public:
    /// Null: all of the pass's part is drawn. TG4060 the mesh has no strands.
    [[nodiscard]] Result<std::shared_ptr<const DrawList>> list(const PassRequest& request);

private:
    struct Key {
        const std::uint32_t* indices = nullptr; // of the mesh
        std::string part;
        double reach = 0; // -1: all is listed, seen or not
        StrandShare share;
        glm::dmat4 toClip{1};
        glm::dvec3 eye{0};
        bool operator==(const Key&) const = default;
    };
    struct Made {
        Key key;
        bool whole = false; // all of the part is drawn
        std::weak_ptr<const DrawList> list;
    };
    std::mutex mutex_;
    std::vector<Made> made_;
};

/// Rows of roots that the part takes in the texture of roots, 1,365 roots to a row; 0 where the mesh has no such part or it holds no
/// ribbons.
[[nodiscard]] std::uint32_t rootRowsOf(const Mesh& mesh, const std::string& part);

/// Of a compute pass with the annotation Rows, a target: that it has as many rows as rows of roots (of the part that Part names), times
/// strands of a root (the sum of the parameters RowsStrands and RowsMore; 1), times rows of a strand (RowsEach segments times RowsScale,
/// rounded up, and one), and that the target Threads has as many as there are of roots. TG4064: it has fewer; the hint says how many are
/// wanted, and by which macro (RowsMacro) they are given.
[[nodiscard]] Result<void> checkStrandRows(const PassRequest& request);

} // namespace tegument::assets
