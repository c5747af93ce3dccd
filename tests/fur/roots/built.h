#pragma once
// A mesh with its roots and their texture.

#include "host/support/result.h"
#include "meshprep/fur/roots/root_texture.h"
#include "meshprep/fur/roots/scatter.h"

#include <gtest/gtest.h>

namespace tegument::testing_roots {

struct Built {
    Mesh mesh;
    RootSet set;
    RootTexture texture;

    [[nodiscard]] glm::vec4 coat(const glm::vec3& place) const { return coatAround(texture.image, place); }
};

inline Built build(Mesh mesh, const RootOptions& options) {
    Built built{.mesh = std::move(mesh), .set = {}, .texture = {}};
    auto set = makeRoots(built.mesh, options);
    EXPECT_TRUE(set) << format(set.error());
    if (!set) return built;
    built.set = *std::move(set);
    auto texture = buildRootTexture(built.set);
    EXPECT_TRUE(texture) << format(texture.error());
    if (texture) built.texture = *std::move(texture);
    return built;
}

} // namespace tegument::testing_roots
