#include "meshprep/order/cache.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <vector>

namespace tegument::order {

namespace {

Error badModel(std::string_view text) {
    return usageError(7040, fmt::format("'{}' is no cache model", text),
                      fmt::format("write fifo:K or lru:K with {} to {} entries, or warp", kLeastEntries, kMostEntries));
}

std::optional<unsigned> parseEntries(std::string_view digits) {
    unsigned entries = 0;
    const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), entries);
    if (failure != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
    if (entries < kLeastEntries || entries > kMostEntries) return std::nullopt;
    return entries;
}

/// Each miss is stamped with the next time; a vertex is in the cache while fewer than `entries` others were stamped after it.
class FifoCache {
public:
    FifoCache(unsigned entries, std::size_t vertexCount) : entries_(entries), now_(entries), stamps_(vertexCount, 0) {}

    [[nodiscard]] bool holds(std::uint32_t vertex) const { return now_ - stamps_[vertex] < entries_; }
    void empty() { now_ += entries_; }
    void use(std::uint32_t vertex) {
        if (!holds(vertex)) stamps_[vertex] = ++now_;
    }

private:
    std::uint64_t entries_;
    std::uint64_t now_;
    std::vector<std::uint64_t> stamps_;
};

/// The vertices in the order of their last use, the latest first.
class LruCache {
public:
    LruCache(unsigned entries, std::size_t vertexCount) : entries_(entries), inside_(vertexCount, 0) {}

    [[nodiscard]] bool holds(std::uint32_t vertex) const { return inside_[vertex] != 0; }
    void empty() {
        for (const std::uint32_t vertex : recent_)
            inside_[vertex] = 0;
        recent_.clear();
    }
    void use(std::uint32_t vertex) {
        if (!holds(vertex)) {
            add(vertex);
            return;
        }
        const auto at = std::ranges::find(recent_, vertex);
        std::rotate(recent_.begin(), at, at + 1);
    }

private:
    void add(std::uint32_t vertex) {
        if (recent_.size() == entries_) {
            inside_[recent_.back()] = 0;
            recent_.pop_back();
        }
        recent_.insert(recent_.begin(), vertex);
        inside_[vertex] = 1;
    }

    std::size_t entries_;
    std::vector<std::uint32_t> recent_;
    std::vector<std::uint8_t> inside_;
};

/// Plays triangles through a cache; knows where a batch ends.
template <class Cache>
class Player {
public:
    Player(const CacheModel& model, std::size_t vertexCount) : model_(model), cache_(model.entries, vertexCount) {}

    void draw(std::span<const std::uint32_t, 3> triangle) {
        if (model_.batched() && !fits(missing(triangle))) {
            cache_.empty();
            batchVertices_ = 0;
            batchTriangles_ = 0;
        }
        for (const std::uint32_t vertex : triangle) {
            const bool miss = !cache_.holds(vertex);
            cache_.use(vertex);
            misses_ += miss;
            batchVertices_ += miss;
        }
        ++batchTriangles_;
    }
    [[nodiscard]] std::size_t misses() const { return misses_; }

private:
    [[nodiscard]] unsigned missing(std::span<const std::uint32_t, 3> t) const {
        return (cache_.holds(t[0]) ? 0u : 1u) + (cache_.holds(t[1]) || t[1] == t[0] ? 0u : 1u) +
               (cache_.holds(t[2]) || t[2] == t[0] || t[2] == t[1] ? 0u : 1u);
    }
    [[nodiscard]] bool fits(unsigned more) const {
        return (model_.batchTriangles == 0 || batchTriangles_ < model_.batchTriangles) &&
               (model_.batchVertices == 0 || batchVertices_ + more <= model_.batchVertices);
    }

    CacheModel model_;
    Cache cache_;
    unsigned batchVertices_ = 0;
    unsigned batchTriangles_ = 0;
    std::size_t misses_ = 0;
};

template <class Cache>
std::size_t play(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    Player<Cache> player(model, vertexCount);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
        player.draw(indices.subspan(i).first<3>());
    return player.misses();
}

/// As playing a FIFO cache that keeps everything between triangles, without branches: whether a vertex is there nobody could foresee.
std::size_t fifoMisses(std::uint32_t entries, std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    std::vector<std::uint32_t> stamps(vertexCount, 0);
    std::uint32_t now = entries;
    for (const std::uint32_t vertex : indices) {
        const std::uint32_t stamp = stamps[vertex];
        const bool miss = now - stamp >= entries;
        now += static_cast<std::uint32_t>(miss);
        stamps[vertex] = miss ? now : stamp;
    }
    return now - entries;
}

std::size_t countNamed(std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    std::vector<std::uint8_t> named(vertexCount, 0);
    for (const std::uint32_t vertex : indices)
        named[vertex] = 1;
    return static_cast<std::size_t>(std::ranges::count(named, 1));
}

} // namespace

Result<CacheModel> parseCacheModel(std::string_view text) {
    if (text == "warp") return kWarp;
    const std::size_t colon = text.find(':');
    if (colon == std::string_view::npos) return badModel(text);
    const std::optional<unsigned> entries = parseEntries(text.substr(colon + 1));
    if (!entries) return badModel(text);
    if (text.substr(0, colon) == "fifo") return fifo(*entries);
    if (text.substr(0, colon) == "lru") return lru(*entries);
    return badModel(text);
}

std::string name(const CacheModel& model) {
    if (model == kWarp) return "warp";
    const char* kind = model.replacement == Replacement::Fifo ? "fifo" : "lru";
    if (!model.batched()) return fmt::format("{}:{}", kind, model.entries);
    return fmt::format("{}:{} batch:{}/{}", kind, model.entries, model.batchVertices, model.batchTriangles);
}

std::size_t countMisses(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    if (model.replacement == Replacement::Lru) return play<LruCache>(model, indices, vertexCount);
    const bool countedIn32Bits = indices.size() < std::numeric_limits<std::uint32_t>::max() - model.entries;
    if (model.batched() || !countedIn32Bits) return play<FifoCache>(model, indices, vertexCount);
    return fifoMisses(model.entries, indices.first(indices.size() - indices.size() % 3), vertexCount);
}

CacheCost measure(const CacheModel& model, std::span<const std::uint32_t> indices, std::size_t vertexCount) {
    return {.misses = countMisses(model, indices, vertexCount), .faces = indices.size() / 3, .vertices = countNamed(indices, vertexCount)};
}

} // namespace tegument::order
