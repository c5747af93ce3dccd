#include "meshprep/order/links.h"

#include <array>

namespace tegument::order {

namespace {

bool degenerate(std::span<const std::uint32_t, 3> face) {
    return face[0] == face[1] || face[1] == face[2] || face[2] == face[0];
}

/// The sides of a vertex towards vertices of higher number: those that lead there wait, those that come from there take one of them, the
/// one that came last. Each side is met at its lower end only, so the time is linear whatever the valences: at a vertex of few sides all
/// that wait are looked through, at others they wait in lists by their other end.
class Linker {
public:
    explicit Linker(const Piece& piece) : piece_(piece), links_(piece.corners.size(), kNoLink) {}

    std::vector<std::uint32_t> run() {
        for (std::uint32_t v = 0; v < piece_.vertexCount; ++v)
            if (piece_.around.count(v) <= kFew)
                linkFew(v);
            else
                linkMany(v);
        for (std::uint32_t corner = 0; corner < links_.size(); corner += 3)
            dropDoubles(corner);
        return std::move(links_);
    }

private:
    static constexpr std::size_t kFew = 12;

    struct Side {
        std::uint32_t corner = 0;
        std::uint32_t other = 0; // end
    };

    /// Visits the sides that leave v for a vertex of higher number, and those that arrive from one.
    template <class Leaving, class Arriving>
    void forSides(std::uint32_t v, Leaving leaving, Arriving arriving) const {
        for (const std::uint32_t f : piece_.around.of(v)) {
            const auto face = piece_.face(f);
            if (degenerate(face)) continue;
            const std::uint32_t c = face[0] == v ? 0 : face[1] == v ? 1 : 2;
            const std::uint32_t after = c == 2 ? 0 : c + 1;
            const std::uint32_t before = c == 0 ? 2 : c - 1;
            if (face[after] > v) leaving({.corner = 3 * f + c, .other = face[after]});
            if (face[before] > v) arriving({.corner = 3 * f + before, .other = face[before]});
        }
    }

    void linkFew(std::uint32_t v) {
        std::array<Side, kFew> leaving, arriving;
        std::size_t leave = 0, arrive = 0;
        forSides(
            v, [&](const Side& side) { leaving[leave++] = side; }, [&](const Side& side) { arriving[arrive++] = side; });
        for (std::size_t a = 0; a < arrive; ++a)
            for (std::size_t i = leave; i-- > 0;)
                if (leaving[i].other == arriving[a].other) {
                    link(arriving[a].corner, leaving[i].corner);
                    leaving[i].other = kNoLink;
                    break;
                }
    }

    void linkMany(std::uint32_t v) {
        waiting_.resize(piece_.vertexCount, kNoLink);
        next_.resize(links_.size());
        leaving_.clear();
        arriving_.clear();
        forSides(
            v, [&](const Side& side) { leaving_.push_back(side); }, [&](const Side& side) { arriving_.push_back(side); });
        for (const Side& side : leaving_) {
            next_[side.corner] = waiting_[side.other];
            waiting_[side.other] = side.corner;
        }
        for (const Side& side : arriving_)
            if (const std::uint32_t found = waiting_[side.other]; found != kNoLink) {
                waiting_[side.other] = next_[found];
                link(side.corner, found);
            }
        for (const Side& side : leaving_)
            waiting_[side.other] = kNoLink;
    }

    void link(std::uint32_t side, std::uint32_t other) {
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
    std::vector<Side> leaving_;          // of the vertex that is looked at
    std::vector<Side> arriving_;
};

} // namespace

std::vector<std::uint32_t> linkFaces(const Piece& piece) {
    return Linker(piece).run();
}

} // namespace tegument::order
