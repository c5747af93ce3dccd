#include "meshprep/order/portfolio.h"

#include "meshprep/order/links.h"

#include <algorithm>
#include <limits>

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

/// Where a greedy order begins changes its misses by chance, by a share that falls with the root of the number of faces: 0.25 % for 70,000.
/// Small pieces are therefore tried from several vertices, unless the first two tries agree: then nothing is left to chance.
void addLinYu(Choice& choice, unsigned entries) {
    constexpr std::uint32_t kEnoughFaces = 400'000;
    constexpr std::uint32_t kMostTries = 6;
    const std::uint32_t tries = std::clamp(kEnoughFaces / std::max(choice.piece().faceCount(), 1u), 1u, kMostTries);
    std::size_t before = 0;
    for (std::uint32_t i = 0; i < tries; ++i) {
        const std::size_t misses = choice.add(linYu(choice.piece(), entries, choice.piece().vertexCount / tries * i));
        if (std::max(misses, before) - std::min(misses, before) < misses / 16384) return;
        before = misses;
    }
}

void addBatches(Choice& choice, const CacheModel& cache) {
    choice.add(batches(choice.piece(), linkFaces(choice.piece()), cache.batchVertices, cache.batchTriangles));
}

Corners best(const Piece& piece, const CacheModel& cache) {
    Choice choice(piece, cache);
    const unsigned entries = fifoEntries(cache);
    if (cache.batched())
        addBatches(choice, cache);
    else
        addLinYu(choice, entries);
    addHoppe(choice, entries);
    if (cache.batched() || cache.replacement == Replacement::Lru) choice.add(meshopt(piece, entries));
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
    case Method::Best: return best(piece, cache);
    }
    return {};
}

} // namespace tegument::order
