// K-Cache-Reorder: G. Lin, T. P.-Y. Yu, An improved vertex caching scheme for 3D mesh rendering, IEEE TVCG 12(4), 640-648, 2006, in time
// that is linear in the faces: the cache is a ring with time stamps, vertices wait for a new start in buckets, and what a vertex of many
// faces costs is looked at only so far as it can matter.

#include "meshprep/order/algorithms.h"

#include <array>
#include <limits>

namespace tegument::order {

namespace {

/// C(v) = k1 C1 - k2 C2 + k3 C3 of the paper: vertices pushed, faces drawn, place in the cache afterwards.
constexpr float kPerFace = 0.5f;
constexpr float kPerPlace = 1.3f;

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Faces of one vertex that are looked at: more than that do not fit round one vertex of any cache that is common.
constexpr std::uint32_t kMostLookedAt = 64;

struct Vertex {
    std::uint32_t stamp = 0;  // the time of its last push
    std::uint32_t first = 0;  // into the list of faces
    std::uint32_t listed = 0; // faces there, drawn ones among them
    std::uint32_t live = 0;   // faces not drawn
};

struct Face {
    std::array<std::uint32_t, 3> corners{};
    bool drawn = false;
};

/// Vertices outside the cache by their number of faces not drawn. That number cannot change outside, so an entry is either true or, when
/// its vertex was pushed again, stale.
class Waiting {
public:
    void add(std::uint32_t vertex, std::uint32_t live) { buckets_[bucket(live)].push_back(vertex); }

    template <class Valid>
    std::uint32_t take(Valid valid) {
        for (std::size_t b = 1; b < kBuckets; ++b)
            while (!buckets_[b].empty()) {
                const std::uint32_t vertex = buckets_[b].back();
                buckets_[b].pop_back();
                if (valid(vertex, b)) return vertex;
            }
        return kNone;
    }
    static std::size_t bucket(std::uint32_t live) { return live < kBuckets ? live : kBuckets - 1; }

private:
    static constexpr std::size_t kBuckets = 32; // the last holds all larger numbers
    std::array<std::vector<std::uint32_t>, kBuckets> buckets_;
};

class LinYu {
public:
    LinYu(const Piece& piece, unsigned entries) : entries_(entries), now_(entries), list_(piece.around.faces), ring_(entries, kNone) {
        faces_.resize(piece.faceCount());
        for (std::uint32_t f = 0; f < piece.faceCount(); ++f)
            faces_[f].corners = {piece.face(f)[0], piece.face(f)[1], piece.face(f)[2]};
        vertices_.resize(piece.vertexCount);
        for (std::uint32_t v = piece.vertexCount; v-- > 0;) {
            vertices_[v] = {.first = piece.around.first[v], .listed = piece.around.count(v), .live = piece.around.count(v)};
            waiting_.add(v, piece.around.count(v));
        }
        out_.reserve(piece.corners.size());
    }

    Corners run() {
        while (out_.size() < 3 * faces_.size()) {
            std::uint32_t focus = cheapest();
            if (focus == kNone) {
                focus = restart();
                push(focus);
            }
            drawAround(focus);
        }
        return std::move(out_);
    }

private:
    [[nodiscard]] bool cached(std::uint32_t v) const { return now_ - vertices_[v].stamp < entries_; }
    [[nodiscard]] bool complete(const Face& f) const { return cached(f.corners[0]) && cached(f.corners[1]) && cached(f.corners[2]); }

    std::uint32_t restart() {
        return waiting_.take([&](std::uint32_t v, std::size_t bucket) {
            return vertices_[v].live > 0 && !cached(v) && Waiting::bucket(vertices_[v].live) == bucket;
        });
    }

    std::uint32_t cheapest() {
        float least = std::numeric_limits<float>::max();
        std::uint32_t best = kNone;
        for (std::uint32_t age = entries_; age-- > 0;) {
            const std::uint32_t v = ring_[(now_ - age) % entries_];
            if (v == kNone || vertices_[v].live == 0) continue;
            const float cost = simulate(v);
            if (cost < least) {
                least = cost;
                best = v;
            }
        }
        return best;
    }

    float simulate(std::uint32_t focus) {
        const std::uint32_t then = now_;
        pushed_.clear();
        int drawn = 0;
        const Vertex& v = vertices_[focus];
        for (std::uint32_t i = 0; i < v.listed; ++i) {
            const Face& f = faces_[list_[v.first + i]];
            if (f.drawn) continue;
            for (int g = 0; g < 6; ++g) {
                const std::uint32_t x = f.corners[static_cast<std::size_t>(g % 3)];
                if (!cached(x)) drawn += simulatePush(x);
            }
            if (pushed_.size() >= entries_) break;
        }
        const float c1 = static_cast<float>(pushed_.size());
        const std::uint32_t age = now_ - v.stamp;
        const float c3 = age < entries_ ? static_cast<float>(entries_ - age) / static_cast<float>(entries_) : 0;
        for (std::size_t i = pushed_.size(); i-- > 0;)
            vertices_[pushed_[i].first].stamp = pushed_[i].second;
        now_ = then;
        return c1 - kPerFace * static_cast<float>(drawn) + kPerPlace * c3;
    }

    int simulatePush(std::uint32_t x) {
        Vertex& v = vertices_[x];
        pushed_.emplace_back(x, v.stamp);
        v.stamp = ++now_;
        int drawn = 0;
        const std::uint32_t most = std::min(v.listed, kMostLookedAt);
        for (std::uint32_t i = 0; i < most; ++i) {
            const Face& f = faces_[list_[v.first + i]];
            drawn += !f.drawn && complete(f);
        }
        return drawn;
    }

    void push(std::uint32_t x) {
        std::uint32_t& slot = ring_[(now_ + 1) % entries_];
        if (slot != kNone && vertices_[slot].live > 0) waiting_.add(slot, vertices_[slot].live);
        slot = x;
        vertices_[x].stamp = ++now_;
        if (vertices_[x].live > kMostLookedAt) {
            for (const std::uint32_t y : ring_)
                if (y != kNone && vertices_[y].live <= kMostLookedAt) drawComplete(y);
        } else {
            drawComplete(x);
        }
    }

    void drawComplete(std::uint32_t x) {
        Vertex& v = vertices_[x];
        std::uint32_t kept = 0;
        for (std::uint32_t i = 0; i < v.listed; ++i) {
            const std::uint32_t f = list_[v.first + i];
            if (faces_[f].drawn) continue;
            if (complete(faces_[f]))
                draw(faces_[f]);
            else
                list_[v.first + kept++] = f;
        }
        v.listed = kept;
    }

    void draw(Face& f) {
        f.drawn = true;
        out_.insert(out_.end(), f.corners.begin(), f.corners.end());
        const auto [a, b, c] = f.corners;
        --vertices_[a].live;
        if (b != a) --vertices_[b].live;
        if (c != a && c != b) --vertices_[c].live;
    }

    void drawAround(std::uint32_t focus) {
        Vertex& v = vertices_[focus];
        const std::uint32_t start = now_;
        while (v.live > 0) {
            Face* next = nullptr;
            for (std::uint32_t i = 0; i < v.listed && !next; ++i)
                if (!faces_[list_[v.first + i]].drawn) next = &faces_[list_[v.first + i]];
            for (std::size_t g = 0; g < 9 && !next->drawn; ++g)
                if (!cached(next->corners[g % 3])) push(next->corners[g % 3]);
            if (!next->drawn) draw(*next);
            if (now_ - start >= entries_ && v.live > kMostLookedAt) return;
        }
    }

    std::uint32_t entries_;
    std::uint32_t now_;
    std::vector<Face> faces_;
    std::vector<Vertex> vertices_;
    std::vector<std::uint32_t> list_; // of faces, by vertex
    std::vector<std::uint32_t> ring_; // the vertex pushed at time t is at t % entries
    Waiting waiting_;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pushed_; // in a simulation: vertex, its stamp before
    Corners out_;
};

} // namespace

Corners linYu(const Piece& piece, unsigned entries) {
    return LinYu(piece, entries).run();
}

} // namespace tegument::order
