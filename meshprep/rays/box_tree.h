#pragma once
// What surface_tree.h is for triangles, for pieces of any shape: Embree names those whose boxes a ray meets, and the caller meets the
// pieces themselves, in a precision of his own.

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>

namespace tegument {

/// Of one piece. Coordinates are single precision: whoever rounds to them makes the box wide enough for it.
struct PieceBox {
    glm::vec3 low{0};
    glm::vec3 high{0};
};

class BoxTree {
public:
    /// Copies the boxes.
    explicit BoxTree(std::span<const PieceBox> boxes);
    ~BoxTree();
    BoxTree(const BoxTree&) = delete;
    BoxTree& operator=(const BoxTree&) = delete;

    /// `meet(piece)` for every piece whose box the ray meets nearer than `last`, in lengths of `direction`, and perhaps for a few that do
    /// not. It returns the distance up to which to go on, the same or a smaller one. Safe to call from several threads.
    template <class Meet>
    void meetAlong(const glm::vec3& origin, const glm::vec3& direction, float last, Meet meet) const {
        search(
            origin, direction, last, [](void* own, std::uint32_t piece) { return (*static_cast<Meet*>(own))(piece); }, &meet);
    }

private:
    using Visitor = float (*)(void* own, std::uint32_t piece);
    void search(const glm::vec3& origin, const glm::vec3& direction, float last, Visitor visitor, void* own) const;

    struct State;
    std::unique_ptr<State> state_;
};

} // namespace tegument
