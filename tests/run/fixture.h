#pragma once
// Runs the fixture effects on whatever device there is, under the validation layers.

#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "host/run/run.h"
#include "tests/gpu/with_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

namespace tegument::test {

inline const std::filesystem::path kFixtures = "tests/run/fixtures";

/// Every test of this kind ends with no message of the validation layers, and skips without a device.
class Run : public WithDevice {
protected:
    /// A picture of one row, so that pixel x is value number x.
    static RunOptions row(int width, const std::string& technique, Compiler compiler = defaultCompiler()) {
        return {.technique = technique, .width = width, .height = 1, .compiler = compiler};
    }

    Result<RunResult> run(const std::string& file, const RunOptions& options, const Mesh* mesh = nullptr, const Workspace& workspace = {},
                          const LoadOptions& load = {}) {
        const auto effect = loadEffect(kFixtures / file, load);
        if (!effect) return effect.error();
        return runEffect(*device_, *effect, mesh, workspace, options);
    }
};

template <class T>
testing::AssertionResult succeeded(const Result<T>& result) {
    if (result) return testing::AssertionSuccess();
    return testing::AssertionFailure() << format(result.error());
}

/// The first diagnostic's code, or 0.
template <class T>
int code(const Result<T>& result) {
    return result ? 0 : result.error().diagnostics.front().code;
}

inline testing::AssertionResult pixelIs(const Image& image, int x, int y, std::array<float, 4> expected, float tolerance = 0) {
    for (int channel = 0; channel < image.channels; ++channel) {
        const float actual = image.at(x, y, channel);
        if (std::abs(actual - expected[static_cast<std::size_t>(channel)]) <= tolerance) continue;
        return testing::AssertionFailure() << "pixel (" << x << ", " << y << ") channel " << channel << " is " << actual << ", expected "
                                           << expected[static_cast<std::size_t>(channel)] << " within " << tolerance;
    }
    return testing::AssertionSuccess();
}

/// Two triangles that fill UV space and face +z: (-10, -10) to (10, 10) mm, u to the right, v down.
inline Mesh square() {
    Mesh mesh;
    mesh.name = "square";
    mesh.positions = {{-10, 10, 0}, {-10, -10, 0}, {10, 10, 0}, {10, -10, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    mesh.indices = {0, 1, 2, 2, 1, 3};
    mesh.parts = {{.name = "square", .firstIndex = 0, .indexCount = 6}};
    computeBounds(mesh);
    return mesh;
}

/// The camera looks at the mesh from five radii in front.
inline Workspace closeUp() {
    Workspace workspace;
    workspace.camera.position = {0, 0, 5};
    workspace.camera.target = {0, 0, 0};
    workspace.light.position = {3, 4, 5};
    workspace.light.color = {0.5F, 0.25F, 2.0F};
    return workspace;
}

} // namespace tegument::test
