#pragma once
// Coarser levels over the same vertices.

#include "meshprep/prepare/distance.h"
#include "meshprep/write/glb.h"

namespace tegument::prep {

enum class LevelMethod {
    Meshoptimizer, // fast, any connectivity; may join and tear what lies close together
    OpenMesh       // slow; parts that are 2-manifolds without seams stay so. Other parts are left to meshoptimizer
};

struct Level {
    MeshLevel mesh;
    SurfaceDistance error; // between this level and the full surface, mm
};

struct Levels {
    std::vector<Level> levels;
    std::size_t leftOver = 0; // parts of the full mesh that LevelMethod::OpenMesh left to meshoptimizer
    std::string whyEarly{};   // there are fewer than were asked for
};

/// At most `count` - 1 levels, each made of the full mesh, with a quarter of the triangles of the one before; the series ends early where
/// that is not possible, or where fewer than kLeastTriangles would be left. meshoptimizer sees all parts at once, so that a part loses what
/// it can spare, whatever its size; where parts meet both sides move together, and no gap opens.
inline constexpr std::size_t kLeastTriangles = 32;
[[nodiscard]] Levels makeLevels(const Mesh& mesh, int count, LevelMethod method = LevelMethod::Meshoptimizer);

/// Of the full mesh in one step, as near to `triangles` as meshoptimizer comes: corners over the same vertices. A tenth of a second for
/// 100,000 triangles, and no figures of how far it is off: for what is seen for a moment.
[[nodiscard]] std::vector<std::uint32_t> quickLevel(const Mesh& mesh, std::size_t triangles);

} // namespace tegument::prep
