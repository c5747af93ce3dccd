// Draws everything with everything, once, in parts; compare_test.cpp looks at the results. CTest runs what they share first, then each part
// before what compares it (fixtures).

#include "host/run/pixels.h"
#include "host/support/file.h"
#include "tests/d3d/engines.h"
#include "tests/d3d/fur_scene.h"
#include "tests/d3d/job_file.h"
#include "tools/direct3d9/reference.h"
#include "tools/emit/flatten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// One case on Vulkan, and its inputs written down for the others.
Result<void> drawWithVulkan(gpu::Device& device, const Mesh& mesh, const Case& drawn,
                            std::map<Engine, std::vector<std::string>>& jobFiles) {
    const auto effect = loadCase(drawn);
    if (!effect) return effect.error();
    const Workspace workspace = drawsFur(drawn) ? furWorkspace() : testWorkspace();
    const RunOptions options{.technique = drawn.technique, .width = kPictureWidth, .height = kPictureHeight, .compiler = Compiler::Dxc};
    run::Stage stage(device, *effect, {.mesh = &mesh});
    auto staged = stage.prepare(workspace, options);
    if (!staged) return staged.error();
    if (const auto done = stage.draw(*staged, staged->frame.items.size()); !done) return done.error();
    const run::ObjectRun& run = staged->runs.front();
    const auto textures = writeTextures(device, stage, run.prepared, drawings());
    if (!textures) return textures.error();
    for (const Engine engine : kDirect3D) {
        if (!drawnBy(drawn, engine)) continue;
        auto job = writeJob(drawn, engine, run, *textures);
        if (!job) return job.error();
        jobFiles[engine].push_back(std::move(*job));
    }
    for (const auto& described : run.prepared.targets) {
        const std::string& name = described.first;
        if (run::isCallers(name)) continue;
        const auto image = run::readBack(device, stage.resources().targets.at(name));
        if (!image) return image.error();
        if (const auto written = writeFloats(drawing(drawn, Engine::Vulkan, name), *image); !written) return written;
    }
    const auto picture = run::readBack(device, *stage.resources().picture());
    if (!picture) return picture.error();
    if (const auto written = writeFloats(drawing(drawn, Engine::Vulkan, "picture"), *picture); !written) return written;
    return writeFile(statusFile(drawn, Engine::Vulkan), "ok");
}

Result<void> writeLibrary() {
    const auto text = flattenLibrary("hlsl/tegument.fxh", {.read = readFile});
    if (!text) return text.error();
    return writeFile(drawings() / "tegument.hlsl", *text);
}

std::string statusOf(const Case& drawn, Engine engine) {
    const auto status = readFile(statusFile(drawn, engine));
    return status ? *status : "not drawn";
}

/// What this machine lacks, and a device where it lacks nothing.
std::string missing(std::optional<gpu::Device>& device) {
    if (std::string reason = direct3dClientMissing(); !reason.empty()) return reason;
    if (!compilerAvailable(Compiler::Dxc)) return "DXC is not installed";
    auto created = gpu::Device::create({});
    if (!created) return format(created.error());
    device = std::move(*created);
    return "";
}

TEST(Drawings, have_their_meshes_maps_and_library) {
    fs::remove_all(drawings());
    std::optional<gpu::Device> device;
    if (const std::string reason = missing(device); !reason.empty()) {
        ASSERT_TRUE(writeFile(missingFile(), reason));
        GTEST_SKIP() << reason;
    }
    const auto mesh = testMesh();
    ASSERT_TRUE(mesh) << format(mesh.error());
    Mesh torus = furMesh();
    const auto roots = writeFurRoots(torus);
    for (const auto& written : {writeLibrary(), writeMeshFile(drawings() / kMeshFile, *mesh), roots,
                                writeMeshFile(drawings() / kFurMeshFile, torus), writeFurMaps()})
        ASSERT_TRUE(written) << format(written.error());
}

class Part : public testing::TestWithParam<int> {};

TEST_P(Part, is_drawn_by_every_engine) {
    if (const auto reason = readFile(missingFile())) GTEST_SKIP() << *reason;
    std::optional<gpu::Device> device;
    ASSERT_EQ(missing(device), "");
    const auto mesh = testMesh();
    ASSERT_TRUE(mesh) << format(mesh.error());
    Mesh torus = furMesh();
    const auto roots = writeFurRoots(torus);
    ASSERT_TRUE(roots) << format(roots.error());

    std::vector<Case> part;
    std::ranges::copy_if(allCases(), std::back_inserter(part), [](const Case& drawn) { return partOf(drawn) == GetParam(); });
    ASSERT_FALSE(part.empty());
    std::map<Engine, std::vector<std::string>> jobFiles;
    for (const Case& drawn : part) {
        const auto done = drawWithVulkan(*device, drawsFur(drawn) ? torus : *mesh, drawn, jobFiles);
        ASSERT_TRUE(done) << drawn.name() << "\n" << format(done.error());
    }
    const auto refused = compileAll(part);
    ASSERT_TRUE(refused) << format(refused.error());
    for (const std::string& message : *refused)
        ADD_FAILURE() << message;
    const auto emitted = emitAll(part);
    ASSERT_TRUE(emitted) << format(emitted.error());
    for (const Engine engine : kDirect3D) {
        std::vector<Case> cases;
        std::ranges::copy_if(part, std::back_inserter(cases), [&](const Case& drawn) { return drawnBy(drawn, engine); });
        const auto done = drawAll(engine, cases, jobFiles[engine]);
        ASSERT_TRUE(done) << format(done.error());
        for (const Case& drawn : cases)
            EXPECT_EQ(statusOf(drawn, engine), "ok") << drawn.name() << " on " << engineName(engine);
    }
}

INSTANTIATE_TEST_SUITE_P(Drawings, Part, testing::Range(1, kParts + 1), [](const auto& tested) { return std::to_string(tested.param); });

} // namespace
} // namespace tegument::test
