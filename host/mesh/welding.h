#pragma once
// Which items are the same: vertices by the exact bits of their attributes, faces by their corners. Linear time, 12 bytes per slot.

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace tegument {

/// Spreads words over 64 bits: each is folded in and the sum is mixed (the multipliers of SplitMix64, Steele, Lea and Flood, 2014).
template <std::size_t N>
[[nodiscard]] std::uint64_t hashWords(const std::array<std::uint32_t, N>& words) {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const std::uint32_t word : words) {
        hash = (hash ^ word) * 0xbf58476d1ce4e5b9u;
        hash ^= hash >> 31;
    }
    hash *= 0x94d049bb133111ebu;
    return hash ^ hash >> 29;
}

/// A set of item numbers with linear probing. Whoever uses it knows what makes two items equal.
class UniqueItems {
public:
    explicit UniqueItems(std::size_t expected = 0) : slots_(std::bit_ceil(std::max<std::size_t>(16, 2 * expected)), Slot{}) {}

    /// The equal item that came first, or `item` itself, which is then in the set.
    template <class Equal>
    std::uint32_t findOrAdd(std::uint64_t hash, std::uint32_t item, Equal equal) {
        if (2 * (count_ + 1) > slots_.size()) grow();
        const auto tag = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t at = hash & (slots_.size() - 1);; at = (at + 1) & (slots_.size() - 1)) {
            Slot& slot = slots_[at];
            if (slot.item == kFree) {
                slot = {.item = item, .tag = tag, .low = static_cast<std::uint32_t>(hash)};
                ++count_;
                return item;
            }
            if (slot.tag == tag && equal(slot.item)) return slot.item;
        }
    }

    /// The equal item, if there is one.
    template <class Equal>
    [[nodiscard]] std::optional<std::uint32_t> find(std::uint64_t hash, Equal equal) const {
        const auto tag = static_cast<std::uint32_t>(hash >> 32);
        for (std::size_t at = hash & (slots_.size() - 1); slots_[at].item != kFree; at = (at + 1) & (slots_.size() - 1))
            if (slots_[at].tag == tag && equal(slots_[at].item)) return slots_[at].item;
        return std::nullopt;
    }

private:
    static constexpr std::uint32_t kFree = UINT32_MAX;
    struct Slot {
        std::uint32_t item = kFree;
        std::uint32_t tag = 0; // the hash's upper half tells most unequal items apart
        std::uint32_t low = 0;
    };

    void grow() {
        std::vector<Slot> old(slots_.size() * 2);
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.item == kFree) continue;
            std::size_t at = (static_cast<std::uint64_t>(slot.tag) << 32 | slot.low) & (slots_.size() - 1);
            while (slots_[at].item != kFree)
                at = (at + 1) & (slots_.size() - 1);
            slots_[at] = slot;
        }
    }

    std::vector<Slot> slots_;
    std::size_t count_ = 0;
};

/// The bits of some floats, so that they compare exactly; 0.0 and -0.0 are one key.
template <std::size_t N>
[[nodiscard]] std::array<std::uint32_t, N> floatKey(const std::array<float, N>& values) {
    std::array<std::uint32_t, N> bits{};
    for (std::size_t i = 0; i < N; ++i)
        bits[i] = values[i] == 0 ? 0 : std::bit_cast<std::uint32_t>(values[i]);
    return bits;
}

/// For each of `count` items the first one with an equal key; `keyOf` gives an array of words.
template <class KeyOf>
[[nodiscard]] std::vector<std::uint32_t> firstEqual(std::size_t count, KeyOf keyOf) {
    UniqueItems unique(count);
    std::vector<std::uint32_t> result(count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto key = keyOf(i);
        result[i] = unique.findOrAdd(hashWords(key), i, [&](std::uint32_t other) { return keyOf(other) == key; });
    }
    return result;
}

/// As `firstEqual`, for keys of floats.
template <std::size_t N, class KeyOf>
[[nodiscard]] std::vector<std::uint32_t> weld(std::size_t count, KeyOf keyOf) {
    return firstEqual(count, [&](std::uint32_t i) { return floatKey<N>(keyOf(i)); });
}

[[nodiscard]] inline std::vector<std::uint32_t> weldPositions(const std::vector<glm::vec3>& positions) {
    return weld<3>(positions.size(), [&](std::uint32_t i) {
        const glm::vec3& p = positions[i];
        return std::array<float, 3>{p.x, p.y, p.z};
    });
}

} // namespace tegument
