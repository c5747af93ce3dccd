#pragma once
// Points in space, found by place. Cells are hashed; a bucket may hold points of several cells, which their distance tells apart.

#include <glm/glm.hpp>

#include <bit>
#include <cstdint>
#include <vector>

namespace tegument {

class PointGrid {
public:
    PointGrid(float cell, std::size_t points) : perLength_(1 / cell), mask_(std::bit_ceil(points + 16) - 1), heads_(mask_ + 1, kNone) {
        entries_.reserve(points);
    }

    struct Entry {
        glm::vec3 position{0};
        float reach = 0; // the user's: how far its neighbours have to stay away
        glm::vec3 normal{0};
        std::uint32_t next = 0;
    };

    void add(const glm::vec3& position, const glm::vec3& normal, float reach) {
        std::uint32_t& head = heads_[bucket(cellOf(position))];
        entries_.push_back({.position = position, .reach = reach, .normal = normal, .next = head});
        head = static_cast<std::uint32_t>(entries_.size() - 1);
    }

    [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }

    /// Calls visit(index, squared distance) for every point within `radius` until it says false; a point may be shown twice where two cells
    /// share a bucket. False if it was stopped.
    template <class Visit>
    bool visit(const glm::vec3& position, float radius, Visit&& visit) const {
        const glm::ivec3 low = cellOf(position - radius);
        const glm::ivec3 high = cellOf(position + radius);
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    for (std::uint32_t i = heads_[bucket({x, y, z})]; i != kNone; i = entries_[i].next) {
                        const glm::vec3 offset = entries_[i].position - position;
                        const float squared = glm::dot(offset, offset);
                        if (squared <= radius * radius && !visit(i, squared)) return false;
                    }
        return true;
    }

private:
    static constexpr std::uint32_t kNone = UINT32_MAX;

    [[nodiscard]] glm::ivec3 cellOf(const glm::vec3& position) const { return glm::ivec3(glm::floor(position * perLength_)); }
    [[nodiscard]] std::size_t bucket(const glm::ivec3& cell) const {
        // M. Teschner et al., Optimized Spatial Hashing for Collision Detection of Deformable Objects, 2003, with the high bits folded in
        const std::uint32_t word = static_cast<std::uint32_t>(cell.x) * 73856093U ^ static_cast<std::uint32_t>(cell.y) * 19349663U ^
                                   static_cast<std::uint32_t>(cell.z) * 83492791U;
        return (word ^ (word >> 15U)) & mask_;
    }

    float perLength_;
    std::size_t mask_;
    std::vector<std::uint32_t> heads_;
    std::vector<Entry> entries_;
};

} // namespace tegument
