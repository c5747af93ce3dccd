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
            forSides(v, [&](std::uint32_t leaving, std::uint32_t) { wait(leaving, piece_.corners[cornerAfter(leaving)], v); });
            forSides(v, [&](std::uint32_t, std::uint32_t arriving) { match(arriving, piece_.corners[arriving], v); });
            forSides(v, [&](std::uint32_t leaving, std::uint32_t) { waiting_[piece_.corners[cornerAfter(leaving)]] = kNoLink; });
        }
        for (std::uint32_t corner = 0; corner < links_.size(); corner += 3)
            dropDoubles(corner);
        return std::move(links_);
    }

private:
    /// `visit(corner at v, corner before it)`: the sides that leave v and that arrive there.
    template <class Visit>
    void forSides(std::uint32_t v, Visit visit) const {
        for (const std::uint32_t f : piece_.around.of(v)) {
            const auto face = piece_.face(f);
            if (degenerate(face)) continue;
            const std::uint32_t corner = 3 * f + (face[1] == v ? 1u : 0u) + (face[2] == v ? 2u : 0u);
            visit(corner, cornerBefore(corner));
        }
    }

    void wait(std::uint32_t side, std::uint32_t end, std::uint32_t v) {
        if (end < v) return;
        next_[side] = waiting_[end];
        waiting_[end] = side;
    }

    void match(std::uint32_t side, std::uint32_t start, std::uint32_t v) {
        const std::uint32_t other = start < v ? kNoLink : waiting_[start];
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
};

} // namespace

std::vector<std::uint32_t> linkFaces(const Piece& piece) {
    return Linker(piece).run();
}

} // namespace tegument::order
