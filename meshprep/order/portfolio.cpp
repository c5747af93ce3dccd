#include "meshprep/order/portfolio.h"

#include "meshprep/order/links.h"

#include <algorithm>
#include <limits>

namespace tegument::order {

namespace {

/// The FIFO cache whose orders suit a model best. An LRU cache holds a strip of half its entries only, for the strip's vertices are used
/// again and move to the front; a batch can be filled to its end, but the next one starts with nothing.
unsigned fifoEntries(const CacheModel& cache) {
    const unsigned entries = cache.replacement == Replacement::Lru ? cache.entries / 2 : cache.entries;
    return std::max(cache.batched() ? entries / 2 : entries, kLeastEntries);
}

/// Keeps the candidate with the fewest misses.
class Choice {
public:
    Choice(const Piece& piece, const CacheModel& cache) : piece_(piece), cache_(cache) {}

    void add(Corners candidate) {
        const std::size_t misses = measure(cache_, candidate, piece_.vertexCount).misses;
        if (misses >= fewest_) return;
        fewest_ = misses;
        best_ = std::move(candidate);
    }
    Corners take() { return std::move(best_); }

private:
    const Piece& piece_;
    CacheModel cache_;
    std::size_t fewest_ = std::numeric_limits<std::size_t>::max();
    Corners best_;
};

/// The limits that are worth trying: a strip's width against the vertices that turn up beside it.
void addHoppe(Choice& choice, const Piece& piece, unsigned entries) {
    const std::vector<std::uint32_t> links = linkFaces(piece);
    const unsigned most = entries - std::min(entries, 5u);
    for (unsigned i = 0; i < 3; ++i)
        choice.add(hoppe(piece, links, entries, most - std::min(most, i * std::max(entries / 12, 1u))));
}

Corners best(const Piece& piece, const CacheModel& cache) {
    Choice choice(piece, cache);
    const unsigned entries = fifoEntries(cache);
    addHoppe(choice, piece, entries);
    choice.add(linYu(piece, entries));
    if (cache.batched() || cache.replacement == Replacement::Lru) choice.add(meshopt(piece, entries));
    return choice.take();
}

Corners bestHoppe(const Piece& piece, const CacheModel& cache) {
    Choice choice(piece, cache);
    addHoppe(choice, piece, fifoEntries(cache));
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
