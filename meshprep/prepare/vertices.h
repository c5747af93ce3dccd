#pragma once
// Vertices shared where all that is kept of them is equal, and put in the order in which the triangles ask for them.
// One part of a mesh as a mesh of its own, so that work on a part costs no more than the part, however many parts there are.

#include "meshprep/prepare/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace tegument::prep {

/// Joins vertices of one place with equal normals and texture coordinates (0.0 and -0.0 are equal), so that seams of texture coordinates
/// survive. Gives how many went. Call after the normals are made.
std::size_t weldVertices(Surface& surface);

/// Numbers vertices in the order of their first use. Gives how many moved. `others`: further lists of the same vertices, which follow.
std::size_t orderVertices(Mesh& mesh, std::span<std::vector<std::uint32_t>* const> others = {});

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
