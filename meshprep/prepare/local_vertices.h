#pragma once
// One part of a mesh as a mesh of its own, so that work on a part costs no more than the part, however many parts there are.

#include <cstdint>
#include <span>
#include <vector>

namespace tegument::prep {

class LocalVertices {
public:
    explicit LocalVertices(std::size_t vertices) : number_(vertices, kNone) {}

    /// Numbers the vertices of these triangles in the order of their first use, and gives the triangles in these numbers.
    const std::vector<std::uint32_t>& enter(std::span<const std::uint32_t> indices) {
        for (const std::uint32_t vertex : global_)
            number_[vertex] = kNone;
        global_.clear();
        local_.clear();
        for (const std::uint32_t vertex : indices) {
            if (number_[vertex] == kNone) {
                number_[vertex] = static_cast<std::uint32_t>(global_.size());
                global_.push_back(vertex);
            }
            local_.push_back(number_[vertex]);
        }
        return local_;
    }

    /// By local number, the vertex of the mesh.
    [[nodiscard]] const std::vector<std::uint32_t>& global() const { return global_; }

    template <class T>
    [[nodiscard]] std::vector<T> gathered(const std::vector<T>& values) const {
        std::vector<T> own;
        own.reserve(global_.size());
        for (const std::uint32_t vertex : global_)
            own.push_back(values[vertex]);
        return own;
    }

private:
    static constexpr std::uint32_t kNone = UINT32_MAX;
    std::vector<std::uint32_t> number_;
    std::vector<std::uint32_t> global_;
    std::vector<std::uint32_t> local_;
};

} // namespace tegument::prep
