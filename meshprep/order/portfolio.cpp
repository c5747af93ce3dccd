#include "meshprep/order/portfolio.h"

#include "host/support/parallel.h"
#include "meshprep/order/links.h"

#include <algorithm>
#include <array>
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

/// Keeps the candidate with the fewest misses.
class Choice {
public:
    Choice(const Piece& piece, const CacheModel& cache) : piece_(piece), cache_(cache) {}

    [[nodiscard]] const Piece& piece() const { return piece_; }
    [[nodiscard]] std::size_t fewest() const { return fewest_; }
    /// Gives the candidate's misses.
    std::size_t add(Corners candidate) {
        const std::size_t misses = measure(cache_, candidate, piece_.vertexCount).misses;
        if (misses < fewest_) {
            fewest_ = misses;
            best_ = std::move(candidate);
        }
        return misses;
    }
    Corners take() { return std::move(best_); }

private:
    const Piece& piece_;
    CacheModel cache_;
    std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
    Corners best_;
};

/// What is left of a cache beside a strip, at least: narrower strips do not pay on any mesh.
constexpr unsigned kLeastReserve = 5;

/// Strips of full width first, as on regular meshes; then narrower ones while that helps, as on irregular ones. Ends when the best so far
/// is out of reach: one step narrower gains a twentieth at most.
void addHoppe(Choice& choice, unsigned entries) {
    const std::vector<std::uint32_t> links = linkFaces(choice.piece());
    const unsigned step = std::max(entries / 8, 1u);
    std::size_t last = std::numeric_limits<std::size_t>::max();
    for (unsigned reserve = std::min(kLeastReserve, entries - 1); reserve < entries; reserve += step) {
        const std::size_t misses = choice.add(hoppe(choice.piece(), links, entries, entries - reserve));
        if (misses >= last || misses > choice.fewest() + choice.fewest() / 20) return;
        last = misses;
    }
}

constexpr std::uint32_t kCheapFaces = 50'000;

/// Where a greedy order begins changes its misses by chance, by a share that falls with the root of the number of faces: 0.25 % for 70,000.
/// Small pieces are therefore tried from several vertices, unless the first two tries agree: then nothing is left to chance.
void addLinYu(Choice& choice, unsigned entries) {
    constexpr std::uint32_t kMostTries = 6;
    const Piece& piece = choice.piece();
    const std::size_t first = choice.add(linYu(piece, entries));
    if (piece.faceCount() >= kCheapFaces) return;
    const std::size_t second = choice.add(linYu(piece, entries, piece.vertexCount / kMostTries));
    if (std::max(first, second) - std::min(first, second) < second / 16384) return;
    std::array<Corners, kMostTries - 2> more;
    forEachInParallel(more.size(), [&](std::size_t i) {
        more[i] = linYu(piece, entries, piece.vertexCount / kMostTries * static_cast<std::uint32_t>(i + 2));
    });
    for (Corners& corners : more)
        choice.add(std::move(corners));
}

/// The share of vertices with six faces. Hoppe's strips win where nearly all have them, Lin & Yu's order where few do; between them both
/// are tried, and of pieces that cost nothing, too.
double regularity(const Piece& piece) {
    std::size_t regular = 0;
    for (std::uint32_t v = 0; v < piece.vertexCount; ++v)
        regular += piece.around.count(v) == 6;
    return piece.vertexCount == 0 ? 0 : static_cast<double>(regular) / piece.vertexCount;
}

constexpr double kRegular = 0.8;
constexpr double kIrregular = 0.5;
Corners best(const Piece& piece, const CacheModel& cache) {
    Choice choice(piece, cache);
    const unsigned entries = fifoEntries(cache);
    const bool cheap = piece.faceCount() < kCheapFaces;
    const double share = regularity(piece);
    if (cheap || share <= kRegular) addLinYu(choice, entries);
    if (cheap || share >= kIrregular) addHoppe(choice, entries);
    if (cache.replacement == Replacement::Lru) choice.add(meshopt(piece, entries));
    return choice.take();
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

/// Meshes below this are tried in every order that there is, which takes some hundredths of a second.
constexpr std::size_t kFacesForAll = 50'000;
/// Below this one more is: what is left out has lost by several per cent on every mesh of such a size.
constexpr std::size_t kFacesForOneMore = 200'000;

using Candidate = std::function<Corners()>;

/// The pieces one by one, on all processors.
Corners byPieces(std::span<const std::uint32_t> indices, std::size_t vertexCount, const std::function<Corners(const Piece&)>& order) {
    Corners out(indices.size());
    const Pieces pieces(indices, vertexCount);
    forEachInParallel(pieces.size(), [&](std::size_t i) { pieces.restore(i, order(pieces.piece(i)), out); });
    return out;
}

/// Everything as one piece, so that a batch that one component leaves half full is filled by the next.
Candidate inOne(const Pieces& whole, std::function<Corners(const Piece&)> order) {
    return [&whole, order = std::move(order)] {
        const Corners corners = order(whole.piece(0));
        Corners out(corners.size());
        whole.restore(0, corners, out);
        return out;
    };
}

/// In parallel, and the one with the fewest misses; of equals the first.
Corners fewestMisses(const std::vector<Candidate>& candidates, const CacheModel& cache, std::size_t vertexCount, Corners start) {
    std::mutex mutex;
    std::pair<std::size_t, std::size_t> least{measure(cache, start, vertexCount).misses, candidates.size()};
    forEachInParallel(candidates.size(), [&](std::size_t i) {
        Corners corners = candidates[i]();
        const std::pair<std::size_t, std::size_t> misses{measure(cache, corners, vertexCount).misses, i};
        const std::lock_guard lock(mutex);
        if (misses >= least) return;
        least = misses;
        start = std::move(corners);
    });
    return start;
}

} // namespace

Corners bestOrder(std::span<const std::uint32_t> indices, std::size_t vertexCount, const CacheModel& cache, std::span<const float> places) {
    Corners came(indices.begin(), indices.end());
    if (indices.empty()) return came;
    const unsigned entries = fifoEntries(cache);
    const bool all = indices.size() / 3 <= kFacesForAll;
    const bool oneMore = indices.size() / 3 <= kFacesForOneMore;
    std::vector<Candidate> candidates;
    std::optional<Pieces> whole;
    if (cache.batched() || oneMore) whole.emplace(indices, vertexCount, Pieces::Cut::Nowhere);
    if (cache.batched()) {
        const Piece piece = whole->piece(0);
        candidates.push_back(
            inOne(*whole, [&cache](const Piece& p) { return batches(p, linkFaces(p), cache.batchVertices, cache.batchTriangles); }));
        candidates.push_back(inOne(*whole, [entries](const Piece& p) { return meshopt(p, entries); }));
        if (all || regularity(piece) >= kIrregular)
            candidates.push_back(inOne(*whole, [&cache](const Piece& p) { return bestHoppe(p, cache); }));
    } else {
        candidates.push_back([&] { return byPieces(indices, vertexCount, [&](const Piece& p) { return best(p, cache); }); });
    }
    if (oneMore) candidates.push_back(inOne(*whole, [entries](const Piece& p) { return meshoptFifo(p, entries); }));
    if (all) {
        for (const Method method : {Method::LinYu, Method::Hoppe})
            candidates.push_back(
                [&, method] { return byPieces(indices, vertexCount, [&](const Piece& p) { return orderPiece(p, method, cache); }); });
        candidates.push_back(inOne(*whole, [entries](const Piece& p) { return tipsify(p, entries); }));
        candidates.push_back([&] { return meshopt(asItCame(indices, vertexCount), entries); });
        candidates.push_back([&] { return meshoptFifo(asItCame(indices, vertexCount), entries); });
        candidates.push_back([&] { return meshoptStrip(asItCame(indices, vertexCount)); });
        if (!cache.batched()) candidates.push_back(inOne(*whole, [entries](const Piece& p) { return meshopt(p, entries); }));
    }
    if (places.size() == 3 * vertexCount && (all || (oneMore && cache.batched())))
        candidates.push_back([&] {
            const Corners sorted = sortedByPlace(indices, places);
            return meshopt(asItCame(sorted, vertexCount), entries);
        });
    return fewestMisses(candidates, cache, vertexCount, std::move(came));
}

} // namespace tegument::order
