#include "meshprep/rays/box_tree.h"

#include "meshprep/rays/windows/bounds_tree.h"

namespace tegument {

struct BoxTree::State {
    BoundsTree tree;
};

BoxTree::BoxTree(std::span<const PieceBox> boxes) : state_(new State{BoundsTree({boxes.begin(), boxes.end()})}) {}

BoxTree::~BoxTree() = default;

void BoxTree::search(const glm::vec3& origin, const glm::vec3& direction, float last, Visitor visitor, void* own) const {
    state_->tree.walk(
        last, [&](const PieceBox& box) { return entry(box, origin, direction, 0); },
        [&](std::uint32_t piece) { return visitor(own, piece); });
}

} // namespace tegument
