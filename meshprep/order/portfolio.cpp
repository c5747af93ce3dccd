#include "meshprep/order/portfolio.h"

#include "host/support/parallel.h"
#include "meshprep/order/links.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>

namespace tegument::order {

namespace {

/// The FIFO cache whose orders suit a model best. An LRU cache holds a narrower strip, for the strip's vertices are used again and move to
/// the front: 5/8 of it is best for 16 and 32 entries. A batch can be filled to its end, but the next one starts with nothing.
unsigned fifoEntries(const CacheModel& cache) {
    if (cache.batched()) return std::max(cache.entries / 2, kLeastEntries);
    if (cache.replacement == Replacement::Lru) return std::max(cache.entries * 5 / 8, kLeastEntries);
    return cache.entries;
}

/// Below this every order that there is costs nothing, and chance has most to say.
constexpr std::size_t kFewFaces = 1024;

/// Keeps the candidate with the fewest misses.
class Choice {
public:
    Choice(const Piece& piece, const CacheModel& cache) : piece_(piece), cache_(cache) {}

    [[nodiscard]] const Piece& piece() const { return piece_; }
    [[nodiscard]] std::size_t fewest() {
        if (!best_.empty() && fewest_ == kNotCounted) fewest_ = missesOf(best_);
        return fewest_;
    }
    /// Who comes first is counted when another one comes: of most pieces none does.
    void addFirst(Corners candidate) { best_ = std::move(candidate); }
    /// Gives the candidate's misses.
    std::size_t add(Corners candidate) {
        const std::size_t misses = missesOf(candidate);
        if (misses < fewest()) {
            fewest_ = misses;
            best_ = std::move(candidate);
        }
        return misses;
    }
    /// Of one that gave up: the most there can be.
    std::size_t addUnlessEmpty(Corners candidate) { return candidate.empty() ? kNotCounted : add(std::move(candidate)); }
    /// So many misses are out of reach of the best so far: its own and a share more. Only the cache that an order is made for tells.
    std::size_t mostOf(unsigned entries, std::size_t share) {
        if (best_.empty() || cache_ != fifo(entries)) return kNotCounted;
        return fewest() + fewest() / share;
    }
    Corners take() { return std::move(best_); }

private:
    static constexpr std::size_t kNotCounted = std::numeric_limits<std::size_t>::max();

    [[nodiscard]] std::size_t missesOf(const Corners& candidate) const { return countMisses(cache_, candidate, piece_.vertexCount); }

    const Piece& piece_;
    CacheModel cache_;
    std::size_t fewest_ = kNotCounted;
    Corners best_;
};

/// What is left of a cache beside a strip, at least: narrower strips do not pay on any mesh.
constexpr unsigned kLeastReserve = 5;

/// Strips of full width first, as on regular meshes; then narrower ones while that helps, as on irregular ones. Ends when the best so far
/// is out of reach: one step narrower gains a twentieth at most, the third step a hundredth. `regular`: strips of full width alone.
void addHoppe(Choice& choice, unsigned entries, bool regular = false) {
    const Piece& piece = choice.piece();
    const std::vector<std::uint32_t> links = linkFaces(piece);
    const unsigned step = std::max(entries / 8, 1u);
    const unsigned full = std::min(kLeastReserve, entries - 1);
    std::size_t last = std::numeric_limits<std::size_t>::max();
    for (unsigned reserve = full; reserve < entries; reserve += step) {
        const std::size_t most = choice.mostOf(entries, reserve == full && !regular ? 10 : 100);
        const std::size_t misses = choice.addUnlessEmpty(hoppe(piece, links, entries, entries - reserve, most));
        if (regular || misses >= last || misses > choice.fewest() + choice.fewest() / (reserve == full ? 10 : 100)) return;
        last = misses;
    }
}

constexpr std::uint32_t kCheapFaces = 50'000;

/// Where a greedy order begins changes its misses by chance, by a share that falls with the root of the number of faces. Of a larger cache
/// chance has more to say: on the Bunny's 70,000 faces 0.3 % for 16 entries, 1.1 % for 24, 1.9 % for 32. These are tried from two vertices,
/// and small meshes where the first try leaves much: a nut of 1,046 faces has 5 % fewer misses by that.
constexpr std::uint32_t kTriedTwice = 100'000;
constexpr unsigned kLargeCache = 17;
constexpr std::uint32_t kSmallTriedTwice = 8'000;
constexpr double kLeavesMuch = 1.24; // runs per vertex

/// `faces`: of all pieces and parts.
void addLinYu(Choice& choice, unsigned entries, std::size_t faces) {
    const Piece& piece = choice.piece();
    choice.addFirst(linYu(piece, entries));
    if (faces >= (entries >= kLargeCache ? kTriedTwice : kSmallTriedTwice)) return;
    const double enough = entries >= kLargeCache ? 1 : kLeavesMuch;
    if (static_cast<double>(choice.fewest()) > enough * piece.vertexCount) choice.add(linYu(piece, entries, piece.vertexCount / 2));
}

/// Shares of the vertices, of those with more than three faces: the others lie on borders.
struct Regularity {
    double six = 0;     // have six faces
    double nearSix = 0; // five to seven
};

Regularity regularity(const Piece& piece) {
    std::size_t six = 0;
    std::size_t nearSix = 0;
    std::size_t inside = 0;
    for (std::uint32_t v = 0; v < piece.vertexCount; ++v) {
        const std::uint32_t faces = piece.around.count(v);
        six += faces == 6;
        nearSix += faces >= 5 && faces <= 7;
        inside += faces > 3;
    }
    const double all = static_cast<double>(std::max<std::size_t>(inside, 1));
    return {.six = static_cast<double>(six) / all, .nearSix = static_cast<double>(nearSix) / all};
}

/// Hoppe's strips win where nearly all vertices have six faces, by a twentieth, Lin & Yu's order where few do. Between them both are tried.
constexpr double kAllSix = 0.95;
constexpr std::uint32_t kPatchFaces = 5'000; // in so few, regular or not, Lin & Yu's order may win by 2 %
constexpr double kMostSix = 0.8;
constexpr double kAboutSix = 0.8;

/// Where fewer vertices have six faces than these, strips won nothing for a FIFO cache of 16 entries on any piece of a machine, a figure or
/// a scan of more faces than `kFewFaces`, in three orders of the file; for LRU caches they did. Grids with diagonals drawn by lot are the
/// exception, by 0.6 %: 3/8 of their vertices have six faces, 7/8 five to seven. Pieces that look so are tried, and all for larger caches,
/// but large ones.
constexpr std::uint32_t kSmallForStrips = 2'500;
constexpr double kSixForSmallStrips = 0.7;
constexpr double kSixForStrips = 0.88;
constexpr std::uint32_t kLargePiece = 10'000;
constexpr double kSixByLot = 0.5;
constexpr double kNearSixByLot = 0.85;

bool stripsMayWin(const Piece& piece, const Regularity& share, const CacheModel& cache) {
    if (share.nearSix < kAboutSix) return false;
    const bool keepsAll = cache.replacement == Replacement::Fifo && !cache.batched();
    if (!keepsAll || piece.faceCount() <= kFewFaces) return true;
    const bool byLot = share.six < kSixByLot && share.nearSix >= kNearSixByLot;
    if (piece.faceCount() <= kLargePiece && (byLot || cache.entries >= kLargeCache)) return true;
    return share.six >= (piece.faceCount() <= kSmallForStrips ? kSixForSmallStrips : kSixForStrips);
}

/// The order and its misses, where they are counted from an empty cache.
struct Counted {
    Corners corners;
    std::size_t misses = 0;
};

Counted best(const Piece& piece, const CacheModel& cache, std::size_t faces) {
    Choice choice(piece, cache);
    const unsigned entries = fifoEntries(cache);
    const bool cheap = piece.faceCount() < kCheapFaces;
    const Regularity share = regularity(piece);
    if (piece.faceCount() <= kPatchFaces || share.six <= (cheap ? kAllSix : kMostSix)) addLinYu(choice, entries, faces);
    if (stripsMayWin(piece, share, cache)) addHoppe(choice, entries, share.six > kAllSix);
    const std::size_t misses = choice.fewest();
    return {.corners = choice.take(), .misses = misses};
}

Corners bestHoppe(const Piece& piece, const CacheModel& cache) {
    Choice choice(piece, cache);
    addHoppe(choice, fifoEntries(cache));
    return choice.take();
}

} // namespace

Corners orderPiece(const Piece& piece, Method method, const CacheModel& cache) {
    switch (method) {
    case Method::LinYu: return linYu(piece, fifoEntries(cache));
    case Method::Hoppe: return bestHoppe(piece, cache);
    case Method::Tipsify: return tipsify(piece, fifoEntries(cache));
    case Method::Meshopt: return meshopt(piece, fifoEntries(cache));
    case Method::Best: break; // it is judged on the whole: bestOrder
    }
    return {};
}

namespace {

/// A piece of everything, in the order in which it came.
Piece asItCame(std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    return {.corners = indices, .vertexCount = static_cast<std::uint32_t>(vertexCount), .around = facesOfVertices(indices, vertexCount)};
}

/// Above this only what has won on such meshes is tried.
constexpr std::size_t kManyFaces = 200'000;

/// meshoptimizer's orders differ by so much among themselves.
constexpr double kAmongSmall = 1.04;
constexpr double kAmongLarge = 1.01;

using Candidate = std::function<Corners()>;

/// Finds the order with the fewest misses. First come those that win on nearly every mesh; the others, which take most of the time, where
/// the first leave something to be gained. All is judged on the whole, as it is drawn.
class BestSearch {
public:
    BestSearch(std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache, std::size_t triangles)
        : indices_(indices), vertexCount_(vertexCount), cache_(cache), entries_(fifoEntries(cache)),
          ofMesh_(std::max(triangles, indices.size() / 3)) {}

    BestOrder run() && {
        begin();
        if (fewest_ != named_) {
            if (cache_.batched())
                runBatched();
            else
                runCached();
        }
        if (best_.empty()) best_.assign(indices_.begin(), indices_.end());
        return {.corners = std::move(best_), .sortedToo = sortedToo_};
    }

private:
    [[nodiscard]] std::size_t faces() const { return indices_.size() / 3; }

    /// For larger caches the cut of a small mesh costs more than 2 %, for LRU caches all that an order is ahead.
    [[nodiscard]] Pieces::Cut cut() const {
        const bool small = cache_.replacement == Replacement::Fifo && cache_.entries < kLargeCache;
        return small ? Pieces::Cut::Finely : Pieces::Cut::Components;
    }

    /// What came in is judged while it is cut up.
    void begin() {
        forEachInParallel(
            2,
            [this](std::size_t i) {
                if (i == 1) {
                    const CacheCost came = measure(cache_, indices_, vertexCount_);
                    fewest_ = came.misses;
                    named_ = came.vertices;
                } else if (cache_.batched()) {
                    (void)whole();
                } else {
                    components_.emplace(indices_, vertexCount_, cut());
                }
            },
            {}, faces() > kFewFaces ? 0 : 1);
    }

    void runCached() {
        tryBestPieces();
        if (fewest_ == named_) return;
        const bool lru = cache_.replacement == Replacement::Lru;
        if (lru) tryAll({meshoptAsItCame()});
        sortedToo_ = lru;
        if (faces() > kManyFaces || fewest_ == named_) return;
        if (lru) tryAll({inOne([this](const Piece& p) { return meshopt(p, entries_); }), byMethod(Method::LinYu), byMethod(Method::Hoppe)});
        if (faces() > kFewFaces ? !unusual() : farAhead()) return;
        if (!best_.empty()) fewest_ = countMisses(cache_, best_, vertexCount_);
        tryAll(others());
        sortedToo_ = true;
    }

    /// What the pieces miss each by itself is what they miss together, but for the vertices that halves have in common: a hundredth less
    /// than what came in misses is less. So all need not be played once more, by one thread, except where it is close or other orders
    /// follow.
    void tryBestPieces() {
        constexpr double kLess = 0.99;
        std::atomic<std::size_t> misses = 0;
        Corners corners = byPieces([&](const Piece& piece, std::size_t times) {
            Counted counted = best(piece, cache_, ofMesh_);
            misses += times * counted.misses;
            return std::move(counted.corners);
        });
        const bool close = static_cast<double>(misses) >= kLess * static_cast<double>(fewest_);
        if (close || faces() <= kFewFaces || cache_.replacement == Replacement::Lru) misses = countMisses(cache_, corners, vertexCount_);
        if (misses > fewest_) return;
        fewest_ = misses;
        best_ = std::move(corners);
    }

    /// Of one of meshoptimizer's orders, by more than they differ among themselves; of a large mesh's small parts, which have little to
    /// say, not behind it.
    [[nodiscard]] bool farAhead() {
        constexpr std::size_t kLargeMesh = 8'000;
        const double among = ofMesh_ >= kLargeMesh ? 1 : kAmongSmall;
        const std::size_t first = fewest_;
        return static_cast<double>(first) * among <= static_cast<double>(tryAll({meshoptAsItCame()})[0]);
    }

    /// Where the first orders are further from one run per vertex than they were on any mesh on which another was better.
    [[nodiscard]] bool unusual() const {
        constexpr double kUsual = 6; // of all meshes with more than kFewFaces: 1.26 for 16 entries, 1.17 for 32
        return static_cast<double>(fewest_) > (1 + kUsual / cache_.entries) * static_cast<double>(named_);
    }

    void runBatched() {
        const bool many = faces() > kManyFaces;
        const auto misses = tryAll({inOne([this](const Piece& p) { return batched(p); }),
                                    many ? inOne([this](const Piece& p) { return meshopt(p, entries_); }) : meshoptAsItCame()});
        const double among = faces() <= 4 * kFewFaces ? kAmongSmall : kAmongLarge;
        if (faces() > kFewFaces && static_cast<double>(misses[0]) * among < static_cast<double>(misses[1])) return;
        if (many)
            tryAll({inOne([this](const Piece& p) {
                return regularity(p).nearSix >= kAboutSix ? bestHoppe(p, cache_) : Corners(p.corners.begin(), p.corners.end());
            })});
        else
            tryAll(others());
        sortedToo_ = !many;
    }

    [[nodiscard]] std::vector<Candidate> others() const {
        std::vector<Candidate> all = {inOne([this](const Piece& p) { return meshopt(p, entries_); }),
                                      inOne([this](const Piece& p) { return meshoptFifo(p, entries_); }),
                                      inOne([this](const Piece& p) { return tipsify(p, entries_); }),
                                      inOne([this](const Piece& p) { return bestHoppe(p, cache_); }),
                                      [this] { return meshoptFifo(asItCame(indices_, vertexCount_), cache_.entries); },
                                      [this] { return meshoptStrip(asItCame(indices_, vertexCount_)); },
                                      meshoptAsItCame(),
                                      byMethod(Method::LinYu),
                                      byMethod(Method::Hoppe)};
        if (!cache_.batched()) return all;
        all.push_back([this] { return meshoptFifo(asItCame(indices_, vertexCount_), entries_); });
        for (std::size_t variation = 0; variation < (faces() > kFewFaces ? 1 : kBatchVariations); ++variation) {
            all.push_back([this, variation] { return batched(asItCame(indices_, vertexCount_), variation); });
            if (variation > 0) all.push_back(inOne([this, variation](const Piece& p) { return batched(p, variation); }));
        }
        return all;
    }

    [[nodiscard]] Corners batched(const Piece& piece, std::size_t variation = 0) const {
        return batches(piece, linkFaces(piece), cache_.batchVertices, cache_.batchTriangles, variation);
    }

    [[nodiscard]] Candidate byMethod(Method method) const {
        return [this, method] { return byPieces([&](const Piece& piece, std::size_t) { return orderPiece(piece, method, cache_); }); };
    }

    [[nodiscard]] Candidate meshoptAsItCame() const {
        return [this] { return meshopt(asItCame(indices_, vertexCount_), entries_); };
    }

    /// The pieces one by one, on all processors; those that are equal once, which the order hears how many there are.
    [[nodiscard]] Corners byPieces(const std::function<Corners(const Piece&, std::size_t)>& order) const {
        std::call_once(cutUp_, [this] {
            if (!components_) components_.emplace(indices_, vertexCount_, cut());
        });
        const std::vector<std::vector<std::size_t>> equals = components_->equals();
        Corners out(indices_.size());
        forEachInParallel(equals.size(), [&](std::size_t group) {
            const Corners own = order(components_->piece(equals[group].front()), equals[group].size());
            for (const std::size_t i : equals[group])
                components_->restore(i, own, out);
        });
        return out;
    }

    [[nodiscard]] const Pieces& whole() const {
        std::call_once(cut_, [this] { whole_.emplace(indices_, vertexCount_, Pieces::Cut::Nowhere); });
        return *whole_;
    }

    /// Everything as one piece, so that a batch that one component leaves half full is filled by the next.
    [[nodiscard]] Candidate inOne(std::function<Corners(const Piece&)> order) const {
        return [this, order = std::move(order)] {
            const Corners corners = order(whole().piece(0));
            Corners out(corners.size());
            whole().restore(0, corners, out);
            return out;
        };
    }

    /// In parallel; keeps the one with the fewest misses, of equals the first. Gives the misses of each.
    std::vector<std::size_t> tryAll(const std::vector<Candidate>& candidates) {
        std::vector<std::size_t> misses(candidates.size());
        std::mutex mutex;
        std::size_t from = candidates.size();
        forEachInParallel(candidates.size(), [&](std::size_t i) {
            Corners corners = candidates[i]();
            misses[i] = countMisses(cache_, corners, vertexCount_);
            const std::lock_guard lock(mutex);
            if (misses[i] > fewest_ || (misses[i] == fewest_ && i >= from)) return;
            fewest_ = misses[i];
            from = i;
            best_ = std::move(corners);
        });
        return misses;
    }

    std::span<const std::uint32_t> indices_;
    std::size_t vertexCount_;
    CacheModel cache_;
    unsigned entries_;
    std::size_t ofMesh_; // faces, of other parts as well
    Corners best_;
    std::size_t fewest_ = 0;
    std::size_t named_ = 0; // vertices, each of which must run once
    bool sortedToo_ = false;
    mutable std::once_flag cut_, cutUp_;
    mutable std::optional<Pieces> whole_, components_; // when they are asked for
};

} // namespace

BestOrder bestOrder(std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache, std::size_t triangles) {
    return BestSearch(indices, vertexCount, cache, triangles).run();
}

Corners betterSorted(Corners best, std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache,
                     std::span<const float> places) {
    if (places.size() != 3 * vertexCount) return best;
    const Corners sorted = sortedByPlace(indices, places);
    Corners other = meshopt(asItCame(sorted, vertexCount), fifoEntries(cache));
    return countMisses(cache, other, vertexCount) < countMisses(cache, best, vertexCount) ? other : best;
}

} // namespace tegument::order
