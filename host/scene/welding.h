#pragma once
// Inside host/scene only: which vertices are the same point.

#include <glm/glm.hpp>

#include <array>
#include <bit>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace tegument {

/// The bits of some floats, so that keys compare exactly; 0.0 and -0.0 are one key. Hashed by FNV-1a over words.
template <std::size_t N>
struct FloatKey {
    std::array<std::uint32_t, N> bits{};

    explicit FloatKey(const std::array<float, N>& values) {
        for (std::size_t i = 0; i < N; ++i)
            bits[i] = values[i] == 0 ? 0 : std::bit_cast<std::uint32_t>(values[i]);
    }
    bool operator==(const FloatKey&) const = default;

    struct Hash {
        std::size_t operator()(const FloatKey& key) const {
            std::uint64_t hash = 0xcbf29ce484222325u;
            for (const std::uint32_t word : key.bits) {
                hash = (hash ^ word) * 0x100000001b3u;
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
