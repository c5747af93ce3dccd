#pragma once
// Simplification of a 2-manifold, which stays what it is: no edge gets a third triangle, no component, handle or hole goes or comes.

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace tegument::prep {

class ManifoldSimplifier {
public:
    /// Whether this build has it; where not, there is none for any mesh.
    [[nodiscard]] static bool available();
    /// With `keepBorder` the vertices of every edge of one triangle stay. Null where the triangles are no
    /// 2-manifold of one orientation, or where vertices share a position (seams of texture coordinates): each side would go its own way.
    [[nodiscard]] static std::unique_ptr<ManifoldSimplifier> make(std::span<const std::uint32_t> indices,
                                                                  const std::vector<glm::vec3>& positions, bool keepBorder);
    ~ManifoldSimplifier();
    ManifoldSimplifier(const ManifoldSimplifier&) = delete;
    ManifoldSimplifier& operator=(const ManifoldSimplifier&) = delete;

    /// At most about `target` triangles over the same positions; more where the rest cannot go. Goes on from the call before, and still
    /// knows the full surface.
    [[nodiscard]] std::vector<std::uint32_t> reduceTo(std::size_t target);

private:
    struct State;
    explicit ManifoldSimplifier(std::unique_ptr<State> state);
    std::unique_ptr<State> state_;
};

} // namespace tegument::prep
