// An order for batches that share nothing (warps): each batch is grown into a round patch beside the ones before. A patch of F triangles of
// a regular lattice has at least sqrt(6 F) boundary edges and so (F + sqrt(6 F)) / 2 + 1 vertices: 24 for 32 triangles, 1.5 runs per
// vertex.

#include "meshprep/order/algorithms.h"
#include "meshprep/order/open_faces.h"

#include <algorithm>
#include <array>

namespace tegument::order {

namespace {

/// What counts against taking a face, by search on two scans (Bunny, Dragon_res2): the result is flat round these. A vertex that comes;
/// less for each face that this vertex completes but for one corner, which makes patches round; a little for the faces that the vertex
/// leaves outside, so that no islands remain; for the open faces beside; and for the age of the corners already there. The others are
/// for small meshes, where chance decides.
struct Weights {
    int gain;
    int outsideFace;
    int neighbour;
    int age;
};
constexpr std::array<Weights, kBatchVariations> kWeights = {
    {{225, 10, 100, 1}, {225, 10, 100, 0}, {225, 40, 100, 1}, {150, 10, 150, 1}, {300, 10, 50, 2}, {225, 10, 0, 4}}};

/// A vertex of more faces is not looked round: its neighbours bring the faces that matter.
constexpr std::uint32_t kMostLookedAt = 64;

class Batches {
public:
    Batches(const Piece& piece, std::span<const std::uint32_t> links, unsigned vertices, unsigned triangles, const Weights& weights)
        : weights_(weights), piece_(piece), links_(links), open_(links), mostVertices_(vertices), mostTriangles_(triangles),
          vertices_(piece.vertexCount), touchedIn_(piece.faceCount(), 0) {
        for (std::uint32_t v = 0; v < piece.vertexCount; ++v)
            vertices_[v].live = piece.around.count(v);
        out_.reserve(piece.corners.size());
    }

    Corners run() {
        startBatch();
        for (std::uint32_t f = open_.fewestNeighbours(); f != kNoLink; f = open_.fewestNeighbours()) {
            if (!fits(f)) startBatch();
            for (; f != kNoLink; f = next())
                draw(f);
        }
        return std::move(out_);
    }

private:
    struct Vertex {
        std::uint32_t batch = 0; // the last one that it came into
        std::uint32_t place = 0; // in that batch
        std::uint32_t live = 0;  // open faces
    };

    void startBatch() {
        ++batch_;
        batchVertices_ = 0;
        batchTriangles_ = 0;
        complete_.clear();
        touched_.clear();
    }

    [[nodiscard]] bool inside(std::uint32_t v) const { return vertices_[v].batch == batch_; }
    [[nodiscard]] unsigned missing(std::uint32_t f) const {
        const auto face = piece_.face(f);
        return (inside(face[0]) ? 0u : 1u) + (inside(face[1]) ? 0u : 1u) + (inside(face[2]) ? 0u : 1u);
    }
    [[nodiscard]] bool fits(std::uint32_t f) const {
        return (mostTriangles_ == 0 || batchTriangles_ < mostTriangles_) &&
               (mostVertices_ == 0 || batchVertices_ + missing(f) <= mostVertices_);
    }

    std::uint32_t next() {
        while (!complete_.empty()) {
            const std::uint32_t f = complete_.back();
            complete_.pop_back();
            if (open_.open(f)) return fits(f) ? f : kNoLink;
        }
        return cheapest();
    }

    /// Of the faces that touch the batch and need the fewest vertices.
    std::uint32_t cheapest() {
        std::pair<unsigned, int> least{3, 0};
        std::uint32_t best = kNoLink;
        std::erase_if(touched_, [&](std::uint32_t f) { return !open_.open(f); });
        for (const std::uint32_t f : touched_) {
            const unsigned m = missing(f);
            if (m > least.first || !fits(f)) continue;
            const std::pair<unsigned, int> cost{m, costOf(f)};
            if (cost >= least) continue;
            least = cost;
            best = f;
        }
        return best;
    }

    [[nodiscard]] int costOf(std::uint32_t f) const {
        int cost = weights_.neighbour * static_cast<int>(open_.neighbours(f));
        for (const std::uint32_t v : piece_.face(f)) {
            if (inside(v))
                cost += weights_.age * static_cast<int>(vertices_[v].place);
            else
                cost += weights_.outsideFace * static_cast<int>(vertices_[v].live) - weights_.gain * gain(v);
        }
        return cost;
    }

    /// The faces round a vertex; none where there are too many.
    [[nodiscard]] std::span<const std::uint32_t> lookedAt(std::uint32_t v) const {
        const auto all = piece_.around.of(v);
        return all.first(all.size() > kMostLookedAt ? 0 : all.size());
    }

    [[nodiscard]] int gain(std::uint32_t v) const {
        int faces = 0;
        for (const std::uint32_t g : lookedAt(v))
            faces += open_.open(g) && missing(g) == 1;
        return faces;
    }

    void draw(std::uint32_t f) {
        open_.closeWithNeighbours(f, links_);
        for (const std::uint32_t v : piece_.face(f)) {
            out_.push_back(v);
            if (inside(v)) continue;
            vertices_[v].batch = batch_;
            vertices_[v].place = batchVertices_++;
            touchFaces(v);
        }
        const auto [a, b, c] = std::array{piece_.face(f)[0], piece_.face(f)[1], piece_.face(f)[2]};
        --vertices_[a].live;
        if (b != a) --vertices_[b].live;
        if (c != a && c != b) --vertices_[c].live;
        ++batchTriangles_;
    }

    void touchFaces(std::uint32_t v) {
        for (const std::uint32_t g : lookedAt(v)) {
            if (!open_.open(g)) continue;
            if (missing(g) == 0) complete_.push_back(g);
            if (touchedIn_[g] == batch_) continue;
            touchedIn_[g] = batch_;
            touched_.push_back(g);
        }
    }

    Weights weights_;
    const Piece& piece_;
    std::span<const std::uint32_t> links_;
    OpenFaces open_;
    unsigned mostVertices_;
    unsigned mostTriangles_;
    std::uint32_t batch_ = 0;
    unsigned batchVertices_ = 0;
    unsigned batchTriangles_ = 0;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> touchedIn_; // by face: the last batch that touched it
    std::vector<std::uint32_t> touched_;   // faces at this batch's vertices
    std::vector<std::uint32_t> complete_;  // those that need no more vertex
    Corners out_;
};

} // namespace

Corners batches(const Piece& piece, std::span<const std::uint32_t> links, unsigned vertices, unsigned triangles, std::size_t variation) {
    return Batches(piece, links, vertices, triangles, kWeights[variation]).run();
}

} // namespace tegument::order
