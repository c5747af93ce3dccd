// P. V. Sander, D. Nehab, J. Barczak, Fast triangle reordering for vertex locality and reduced overdraw, SIGGRAPH 2007, section 3.

#include "meshprep/order/algorithms.h"

#include <algorithm>
#include <limits>

namespace tegument::order {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

class Tipsify {
public:
    Tipsify(const Piece& piece, unsigned entries)
        : piece_(piece), entries_(entries), now_(entries), live_(piece.vertexCount), stamps_(piece.vertexCount, 0),
          drawn_(piece.faceCount(), 0) {
        for (std::uint32_t v = 0; v < piece.vertexCount; ++v)
            live_[v] = piece.around.count(v);
        out_.reserve(piece.corners.size());
    }

    Corners run() {
        for (std::uint32_t fan = nextInInput(); fan != kNone; fan = nextFan())
            drawFan(fan);
        return std::move(out_);
    }

private:
    void drawFan(std::uint32_t fan) {
        ring_.clear();
        for (const std::uint32_t f : piece_.around.of(fan)) {
            if (drawn_[f]) continue;
            drawn_[f] = 1;
            const auto face = piece_.face(f);
            for (std::size_t c = 0; c < 3; ++c)
                use(face[c], face.first(c));
        }
    }

    void use(std::uint32_t v, std::span<const std::uint32_t> before) {
        out_.push_back(v);
        if (std::ranges::find(before, v) != before.end()) return;
        --live_[v];
        ring_.push_back(v);
        deadEnds_.push_back(v);
        if (now_ - stamps_[v] >= entries_) stamps_[v] = ++now_;
    }

    /// Of the fan's vertices the one longest in the cache that would still be there after its own fan, which adds two vertices a face at
    /// most.
    std::uint32_t nextFan() {
        std::uint32_t best = kNone;
        std::uint64_t oldest = 0;
        for (const std::uint32_t v : ring_) {
            if (live_[v] == 0) continue;
            const std::uint64_t age = now_ - stamps_[v];
            const std::uint64_t priority = age + 2 * std::uint64_t{live_[v]} <= entries_ ? age : 0;
            if (best == kNone || priority > oldest) {
                best = v;
                oldest = priority;
            }
        }
        return best != kNone ? best : afterDeadEnd();
    }

    std::uint32_t afterDeadEnd() {
        while (!deadEnds_.empty()) {
            const std::uint32_t v = deadEnds_.back();
            deadEnds_.pop_back();
            if (live_[v] > 0) return v;
        }
        return nextInInput();
    }

    std::uint32_t nextInInput() {
        while (input_ < piece_.vertexCount && live_[input_] == 0)
            ++input_;
        return input_ < piece_.vertexCount ? input_ : kNone;
    }

    const Piece& piece_;
    std::uint32_t entries_;
    std::uint32_t now_;
    std::uint32_t input_ = 0;
    std::vector<std::uint32_t> live_; // faces not drawn, by vertex
    std::vector<std::uint32_t> stamps_;
    std::vector<std::uint8_t> drawn_;
    std::vector<std::uint32_t> ring_; // of the fan just drawn
    std::vector<std::uint32_t> deadEnds_;
    Corners out_;
};

} // namespace

Corners tipsify(const Piece& piece, unsigned entries) {
    return Tipsify(piece, entries).run();
}

} // namespace tegument::order
