#include "meshprep/prepare/manifold_levels.h"

// OpenMesh is left out.

namespace tegument::prep {

struct ManifoldSimplifier::State {};

ManifoldSimplifier::ManifoldSimplifier(std::unique_ptr<State> state) : state_(std::move(state)) {}

ManifoldSimplifier::~ManifoldSimplifier() = default;

bool ManifoldSimplifier::available() {
    return false;
}

std::unique_ptr<ManifoldSimplifier> ManifoldSimplifier::make(std::span<const std::uint32_t>, const std::vector<glm::vec3>&, bool) {
    return nullptr;
}

std::vector<std::uint32_t> ManifoldSimplifier::reduceTo(std::size_t) {
    return {};
}

} // namespace tegument::prep
