#include "meshprep/assets/strand_lists.h"

#include "host/mesh/pose.h"
#include "host/support/parallel.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace tegument::assets {

namespace {

constexpr double kShareTolerance = 1e-4; // relative: of distances in single precision

/// A ribbon that is seen.
struct Seen {
    std::uint32_t first = 0; // of its indices
    std::uint32_t count = 0;
    std::uint32_t segments = 0; // of rows that are joined anew; 0: all that there are
    std::uint32_t drawn = 0;    // of these, from the root on
    double strands = 0;         // how many of the root's are drawn, less the root's rank
};

constexpr std::uint32_t kQuad = 6; // indices of a segment, a b c b d c: two vertices of a row, c and d of the next (meshprep/fur/ribbons)

/// As the vertices of ribbons hold it (docs/design/fur.md, "The vertices"): 31 parts of 32.
double placeAlong(float stored) {
    return (static_cast<double>(stored) - std::floor(static_cast<double>(stored))) * (32.0 / 31.0);
}

/// Whether the triangles are segments, so that rows may be left out.
bool inRows(std::span<const std::uint32_t> ribbon) {
    if (ribbon.size() % kQuad != 0) return false;
    for (std::size_t at = 0; at < ribbon.size(); at += kQuad) {
        const bool joined = at == 0 || (ribbon[at] == ribbon[at - kQuad + 2] && ribbon[at + 1] == ribbon[at - kQuad + 4]);
        if (!joined || ribbon[at + 3] != ribbon[at + 1] || ribbon[at + 5] != ribbon[at + 2]) return false;
    }
    return true;
}

/// Where a segment begins, in rows, if a ribbon of `all` has fewer: the first row and the last are kept.
std::uint32_t rowOf(std::uint32_t segment, std::uint32_t segments, std::uint32_t all) {
    return (segment * all + segments / 2) / segments;
}

/// The first of a ribbon's segments, joined from some of its rows.
void appendRows(std::span<const std::uint32_t> ribbon, const Seen& seen, std::vector<std::uint32_t>& indices) {
    const auto all = static_cast<std::uint32_t>(ribbon.size()) / kQuad;
    for (std::uint32_t segment = 0; segment < seen.drawn; ++segment) {
        const auto from = ribbon.subspan(std::size_t{rowOf(segment, seen.segments, all)} * kQuad, kQuad);
        const auto to = ribbon.subspan(std::size_t{rowOf(segment + 1, seen.segments, all) - 1} * kQuad, kQuad);
        indices.insert(indices.end(), {from[0], from[1], to[2], from[1], to[4], to[2]});
    }
}

class Lister {
public:
    Lister(const Mesh& mesh, const MeshPart& part, const run::PartView* view, const glm::dvec3& eye, const StrandShare& share)
        : mesh_(mesh), pose_(poseOf(mesh)), part_(part), view_(view), eye_(eye), share_(share) {}

    std::optional<DrawList> list() {
        find();
        DrawList lists;
        std::size_t indices = 0;
        for (const Seen& ribbon : seen_)
            indices += ribbon.segments > 0 ? ribbon.drawn * kQuad : ribbon.count;
        const auto wholes = static_cast<std::uint32_t>(std::clamp(fewest_, 0.0, double(share_.count)));
        if (indices == part_.indexCount && wholes == share_.count) return std::nullopt;
        if (wholes > 0) append(lists, 0, wholes);
        for (std::uint32_t instance = wholes; instance < share_.count; ++instance)
            if (!append(lists, instance, 1)) break; // the next have fewer still
        return lists;
    }

private:
    /// Of the ribbons that one chunk of clusters has.
    struct Found {
        std::vector<Seen> ribbons;
        double fewest = 1e9; // strands of one of their roots that are drawn for certain
    };

    void find() {
        std::vector<MeshCluster> clusters = part_.clusters;
        if (clusters.empty()) clusters.push_back({.firstIndex = 0, .indexCount = part_.indexCount, .radius = mesh_.bounds.radius});
        const bool bounded = !part_.clusters.empty();
        std::vector<Found> found(chunkCount(clusters.size()));
        inChunks(clusters.size(), 0, [&](std::size_t first, std::size_t last, std::size_t chunk) {
            for (std::size_t i = first; i < last; ++i)
                if (!bounded || !view_ || run::canBeSeen(clusters[i], *view_)) findIn(clusters[i], found[chunk]);
        });
        for (const Found& one : found) {
            seen_.insert(seen_.end(), one.ribbons.begin(), one.ribbons.end());
            fewest_ = std::min(fewest_, one.fewest);
        }
    }

    void findIn(const MeshCluster& cluster, Found& found) const {
        const std::uint32_t end = part_.firstIndex + cluster.firstIndex + cluster.indexCount;
        for (std::uint32_t first = part_.firstIndex + cluster.firstIndex; first < end;) {
            const std::uint32_t root = mesh_.indices[first];
            const float address = mesh_.uvs[root].y;
            std::uint32_t last = first + 3;
            while (last < end && mesh_.uvs[mesh_.indices[last]].y == address)
                last += 3;
            judge({.first = first, .count = last - first}, root, address, found);
            first = last;
        }
    }

    void judge(Seen ribbon, std::uint32_t root, float address, Found& found) const {
        const glm::dvec3 place = pose_ ? pose_->position(root) : glm::dvec3(mesh_.positions[root]);
        if (view_ && !run::canBeSeen(place, pose_ ? pose_->normal(root) : glm::dvec3(mesh_.normals[root]), *view_)) return;
        const double distance = glm::distance(eye_, place);
        const double thin = thinFrom(share_, distance, view_ ? view_->reach : distance);
        if (!(thin > 0)) return;
        const double strands = shareAt(share_, distance) * share_.count;
        const double rank = rankOf(address, share_.first);
        ribbon.strands = strands - rank;
        if (!(ribbon.strands > -kRankTolerance)) return;
        found.fewest = std::min(found.fewest, std::floor(strands * (1 + 1e-9)));
        chooseRows(ribbon, segmentsAt(share_, distance, rank, ribbon.count / kQuad), thin);
        found.ribbons.push_back(ribbon);
    }

    /// So many segments; of them those that begin before the place `end`.
    void chooseRows(Seen& ribbon, std::uint32_t segments, double end) const {
        const std::span<const std::uint32_t> indices = std::span(mesh_.indices).subspan(ribbon.first, ribbon.count);
        const std::uint32_t all = ribbon.count / kQuad;
        if ((segments == all && end >= 1) || !inRows(indices)) return;
        std::uint32_t drawn = segments;
        while (drawn > 1 && placeAlong(mesh_.uvs[indices[std::size_t{rowOf(drawn - 1, segments, all)} * kQuad]].x) >= end)
            --drawn;
        if (drawn == all) return;
        ribbon.segments = segments;
        ribbon.drawn = drawn;
    }

    /// Whether any is.
    bool append(DrawList& lists, std::uint32_t instance, std::uint32_t instances) const {
        const auto from = static_cast<std::uint32_t>(lists.indices.size());
        for (const Seen& ribbon : seen_)
            if (instance + instances <= fewest_ || ribbon.strands > instance - kRankTolerance) {
                const auto indices = std::span(mesh_.indices).subspan(ribbon.first, ribbon.count);
                if (ribbon.segments > 0)
                    appendRows(indices, ribbon, lists.indices);
                else
                    lists.indices.insert(lists.indices.end(), indices.begin(), indices.end());
            }
        const auto count = static_cast<std::uint32_t>(lists.indices.size()) - from;
        if (count > 0) lists.ranges.push_back({.first = from, .count = count, .firstInstance = instance, .instances = instances});
        return count > 0;
    }

    const Mesh& mesh_;
    const std::optional<PoseView> pose_;
    const MeshPart& part_;
    const run::PartView* view_;
    const glm::dvec3 eye_;
    const StrandShare share_;
    std::vector<Seen> seen_;
    double fewest_ = 1e9; // strands that every root has for certain
};

} // namespace

double shareAt(const StrandShare& share, double distance) {
    if (!(share.width > 0) || !(share.thinnest > 0)) return share.share;
    const double pixels = share.width / std::max(share.pixel * distance, 1e-30);
    return share.share * std::clamp(pixels / share.thinnest * (1 + kShareTolerance), std::min(share.fewest, 1.0), 1.0);
}

double thinFrom(const StrandShare& share, double distance, double reach) {
    if (!(share.least > 0) || !(share.widest > 0) || distance <= reach) return 1;
    const double drawn = share.widest / std::max(shareAt(share, distance) * (1 - kShareTolerance) * (1 - kShareTolerance), 1e-30);
    const double asked = share.least * share.pixel * (distance - reach) / drawn; // of the root's width
    if (asked > 1) return 0;
    return share.taper > 0 ? std::pow(1 - asked, 1 / share.taper) : 1;
}

std::uint32_t segmentsAt(const StrandShare& share, double distance, double rank, std::uint32_t most) {
    if (!(share.length > 0) || !(share.segment > 0)) return most;
    constexpr double kOther = 7.13; // of ranks: strands that are left out have the high ones
    const double segments = share.length / std::max(share.pixel * distance, 1e-30) / share.segment + std::fmod(kOther * rank, 1.0);
    return segments < most ? std::clamp(static_cast<std::uint32_t>(segments), std::min(share.fewestSegments, most), most) : most;
}

double rankOf(float address, double first) {
    constexpr double kColumns = 4096;
    const double row = std::floor(static_cast<double>(address) / kColumns);
    const double sum = (static_cast<double>(address) - kColumns * row) * 0.6180340 + row * 0.7548777 + first;
    const double rank = sum - std::floor(sum);
    return rank < 1 - kRankTolerance ? rank : 0; // of a number just below the next whole one a shader may find 0
}

std::optional<DrawList> listStrands(const Mesh& mesh, const MeshPart& part, const run::PartView* view, const glm::dvec3& eye,
                                    const StrandShare& share) {
    return Lister(mesh, part, view, eye, share).list();
}

} // namespace tegument::assets
