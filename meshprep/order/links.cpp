#include "meshprep/order/links.h"

namespace tegument::order {

namespace {

bool degenerate(std::span<const std::uint32_t, 3> face) {
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The sides of a vertex towards vertices of higher number: those that lead there wait, those that come from there take one of them. Each
/// side is met at its lower end only, so the time is linear whatever the valences.
class Linker {
public:
    explicit Linker(const Piece& piece)
        : piece_(piece), links_(piece.corners.size(), kNoLink), waiting_(piece.vertexCount, kNoLink), next_(links_) {}

    std::vector<std::uint32_t> run() {
        for (std::uint32_t v = 0; v < piece_.vertexCount; ++v) {
            gather(v);
            for (const std::uint32_t side : leaving_)
                wait(side, piece_.corners[cornerAfter(side)]);
            for (const std::uint32_t side : arriving_)
                match(side, piece_.corners[side]);
            for (const std::uint32_t side : leaving_)
                waiting_[piece_.corners[cornerAfter(side)]] = kNoLink;
        }
        for (std::uint32_t corner = 0; corner < links_.size(); corner += 3)
            dropDoubles(corner);
        return std::move(links_);
    }

private:
    /// The sides that leave v for a vertex of higher number, and those that arrive from one.
    void gather(std::uint32_t v) {
        leaving_.clear();
        arriving_.clear();
        for (const std::uint32_t f : piece_.around.of(v)) {
            const auto face = piece_.face(f);
            if (degenerate(face)) continue;
            const std::uint32_t corner = 3 * f + (face[1] == v ? 1u : 0u) + (face[2] == v ? 2u : 0u);
            const std::uint32_t before = cornerBefore(corner);
            if (piece_.corners[cornerAfter(corner)] > v) leaving_.push_back(corner);
            if (piece_.corners[before] > v) arriving_.push_back(before);
        }
    }

    void wait(std::uint32_t side, std::uint32_t end) {
        next_[side] = waiting_[end];
        waiting_[end] = side;
    }

    void match(std::uint32_t side, std::uint32_t start) {
        const std::uint32_t other = waiting_[start];
        if (other == kNoLink) return;
        waiting_[start] = next_[other];
        links_[side] = other;
        links_[other] = side;
    }

    void dropDoubles(std::uint32_t first) {
        for (std::uint32_t i = first; i < first + 3; ++i)
            for (std::uint32_t j = i + 1; j < first + 3; ++j)
                if (links_[i] != kNoLink && links_[j] != kNoLink && links_[i] / 3 == links_[j] / 3) {
                    links_[links_[j]] = kNoLink;
                    links_[j] = kNoLink;
                }
    }

    const Piece& piece_;
    std::vector<std::uint32_t> links_;
    std::vector<std::uint32_t> waiting_; // by the other end: the last side that leads there
    std::vector<std::uint32_t> next_;    // the one before it
    std::vector<std::uint32_t> leaving_; // of the vertex that is looked at
    std::vector<std::uint32_t> arriving_;
};

} // namespace

std::vector<std::uint32_t> linkFaces(const Piece& piece) {
    return Linker(piece).run();
}

} // namespace tegument::order
