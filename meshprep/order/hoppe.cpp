// H. Hoppe, Optimization of mesh locality for transparent vertex caching, SIGGRAPH 1999, in the form that D3DX ships: strips grow along the
// one before; instead of the paper's lookahead, a strip is broken off when going on would push its beginning out of the cache.

#include "meshprep/order/algorithms.h"
#include "meshprep/order/open_faces.h"

namespace tegument::order {

namespace {

class Hoppe {
public:
    Hoppe(const Piece& piece, std::span<const std::uint32_t> links, unsigned entries, unsigned limit)
        : piece_(piece), links_(links), open_(links), entries_(entries), limit_(limit), now_(entries), stamps_(piece.vertexCount, 0) {
        out_.reserve(piece.corners.size());
    }

    Corners run(std::size_t most) {
        for (std::uint32_t f = open_.fewestNeighbours(); f != kNoLink; f = open_.fewestNeighbours()) {
            if (now_ - entries_ > most) return {};
            drawStrips(startCorner(f));
        }
        return std::move(out_);
    }

private:
    /// The open face across the side that starts at this corner, as its corner at the same side.
    [[nodiscard]] std::uint32_t across(std::uint32_t corner) const {
        const std::uint32_t other = links_[corner];
        return other != kNoLink && open_.open(other / 3) ? other : kNoLink;
    }
    /// Faces are turned round a pivot, here the corner's vertex; the inner side is the one from the corner before to it.
    [[nodiscard]] std::uint32_t inner(std::uint32_t corner) const { return across(cornerBefore(corner)); }
    [[nodiscard]] std::uint32_t outer(std::uint32_t corner) const { return across(cornerAfter(corner)); }

    [[nodiscard]] bool usable(std::uint32_t corner) const { return corner != kNoLink && open_.open(corner / 3); }

    [[nodiscard]] std::uint32_t startCorner(std::uint32_t f) const {
        if (across(3 * f) != kNoLink) return 3 * f + 1;
        if (across(3 * f + 1) != kNoLink) return 3 * f + 2;
        return 3 * f;
    }

    void drawStrips(std::uint32_t corner) {
        std::uint32_t nextStrip = kNoLink;
        while (corner != kNoLink) {
            draw(corner);
            const std::uint32_t in = inner(corner);
            const std::uint32_t out = outer(corner);
            if (in != kNoLink) {
                if (!usable(nextStrip) && out != kNoLink) {
                    nextStrip = out;
                    missesSince_ = 0;
                }
                corner = in;
            } else if (out != kNoLink && !(usable(nextStrip) && missesSince_ + ring(out) > limit_)) {
                corner = out;
            } else {
                corner = usable(nextStrip) ? nextStrip : kNoLink;
                nextStrip = kNoLink;
            }
        }
    }

    /// How many faces turning round this pivot would draw; no more than matter.
    [[nodiscard]] unsigned ring(std::uint32_t corner) const {
        unsigned faces = 0;
        const std::uint32_t start = corner;
        while (faces <= limit_) {
            ++faces;
            corner = inner(corner);
            if (corner == kNoLink || corner == start) break;
        }
        return faces;
    }

    void draw(std::uint32_t corner) {
        const std::uint32_t f = corner / 3;
        open_.closeWithNeighbours(f, links_);
        for (const std::uint32_t vertex : piece_.face(f)) {
            out_.push_back(vertex);
            if (now_ - stamps_[vertex] < entries_) continue;
            stamps_[vertex] = ++now_;
            ++missesSince_;
        }
    }

    const Piece& piece_;
    std::span<const std::uint32_t> links_;
    OpenFaces open_;
    unsigned entries_;
    unsigned limit_;
    std::uint32_t now_;
    std::vector<std::uint32_t> stamps_;
    unsigned missesSince_ = 0; // since the next strip's start was passed
    Corners out_;
};

} // namespace

Corners hoppe(const Piece& piece, std::span<const std::uint32_t> links, unsigned entries, unsigned limit, std::size_t most) {
    return Hoppe(piece, links, entries, limit).run(most);
}

} // namespace tegument::order
