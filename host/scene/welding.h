#pragma once
// Inside host/scene only: which vertices are the same point.

#include <glm/glm.hpp>

#include <bit>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace tegument {

/// FNV-1a over words; keys are arrays of float bits.
template <std::size_t N>
struct FloatKey {
    std::array<float, N> values{};

    /// 0.0 and -0.0 are one key.
    explicit FloatKey(const std::array<float, N>& from) : values(from) {
        for (float& value : values)
            if (value == 0) value = 0;
    }
    bool operator==(const FloatKey& other) const { return std::memcmp(values.data(), other.values.data(), sizeof(values)) == 0; }

    struct Hash {
        std::size_t operator()(const FloatKey& key) const {
            std::uint64_t hash = 0xcbf29ce484222325u;
            for (const float value : key.values) {
                hash = (hash ^ std::bit_cast<std::uint32_t>(value)) * 0x100000001b3u;
                hash ^= hash >> 29; // FNV mixes only upwards
            }
            return static_cast<std::size_t>(hash);
        }
    };
};

/// For each of `count` items the first one with an equal key.
template <std::size_t N, class KeyOf>
std::vector<std::uint32_t> weld(std::size_t count, KeyOf keyOf) {
    std::unordered_map<FloatKey<N>, std::uint32_t, typename FloatKey<N>::Hash> first;
    first.reserve(count);
    std::vector<std::uint32_t> result(count);
    for (std::uint32_t i = 0; i < count; ++i)
        result[i] = first.emplace(FloatKey<N>(keyOf(i)), i).first->second;
    return result;
}

inline std::vector<std::uint32_t> weldPositions(const std::vector<glm::vec3>& positions) {
    return weld<3>(positions.size(), [&](std::uint32_t i) {
        const glm::vec3& p = positions[i];
        return std::array<float, 3>{p.x, p.y, p.z};
    });
}

} // namespace tegument
