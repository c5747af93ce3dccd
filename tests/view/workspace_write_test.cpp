// A workspace that is written and read again is the same scene.
#include "host/support/file.h"
#include "tests/mesh/files.h"
#include "tools/view/workspace_write.h"

#include <cstdlib>

using namespace tegument;
using namespace tegument::testing_scene;
namespace fs = std::filesystem;

namespace {

class WrittenWorkspaces : public SceneFiles {
protected:
    void SetUp() override {
        SceneFiles::SetUp();
        write("scan.glb", "x");
        write("skin.png", "x");
    }

    /// Written into a folder below, and read from there.
    [[nodiscard]] Workspace again(const Workspace& workspace) {
        const fs::path path = folder_ / "out" / "w.json";
        text_ = workspaceJson(workspace, path);
        EXPECT_TRUE(writeFile(path, text_));
        const auto read = loadWorkspace(path);
        EXPECT_TRUE(read) << text_ << (read ? "" : format(read.error()));
        return read ? *read : Workspace{};
    }

    [[nodiscard]] Workspace full() const {
        Workspace w;
        w.file = folder_ / "w.json";
        w.meshPath = "scan.glb";
        w.unitMm = 25.4;
        w.flipV = true;
        w.head = false;
        w.attribution = "Some \"one\" [1, 2] \\";
        w.cameraRelative = w.lightRelative = false;
        w.camera = {.position = {0.1F, -200.3F, 3e-5F},
                    .target = {1, 2, 3},
                    .up = {0, 0, 1},
                    .horizontalFov = 33.3F,
                    .nearPlane = 1.5F,
                    .farPlane = 9000};
        w.light.position = {7.7F, 8, 9};
        w.light.color = {1, 0.1F, 0};
        w.light.fov = 40;
        w.background = {0.1F, 0.2F, 0.3F};
        w.textures = {{"DIFFUSE", "skin.png"}};
        w.parameters = {{"gMix", {0.1}}, {"gTint", {1, 0.25, 1.0 / 3}}};
        w.technique = "A";
        w.setting = "draft";
        w.size = {900, 600};
        w.samples = 8;
        w.binds = {{"gMatrix", "WORLD"}};
        return w;
    }

    void expectSame(const Workspace& a, const Workspace& b) const {
        EXPECT_EQ(a.cameraRelative, b.cameraRelative) << text_;
        EXPECT_EQ(a.camera.position, b.camera.position) << text_;
        EXPECT_EQ(a.camera.target, b.camera.target) << text_;
        EXPECT_EQ(a.camera.up, b.camera.up) << text_;
        EXPECT_EQ(a.camera.horizontalFov, b.camera.horizontalFov) << text_;
        EXPECT_EQ(a.camera.nearPlane, b.camera.nearPlane) << text_;
        EXPECT_EQ(a.camera.farPlane, b.camera.farPlane) << text_;
        EXPECT_EQ(a.lightRelative, b.lightRelative) << text_;
        EXPECT_EQ(a.light.color, b.light.color) << text_;
        EXPECT_EQ(a.light.direction, b.light.direction) << text_;
        EXPECT_EQ(a.light.width, b.light.width) << text_;
        EXPECT_EQ(a.light.fov, b.light.fov) << text_;
        if (!a.light.direction) {
            EXPECT_EQ(a.light.position, b.light.position) << text_;
        }
        EXPECT_EQ(a.background, b.background) << text_;
        EXPECT_EQ(a.parameters, b.parameters) << text_;
        EXPECT_EQ(a.unitMm, b.unitMm) << text_;
        EXPECT_EQ(a.flipV, b.flipV) << text_;
        EXPECT_EQ(a.head, b.head) << text_;
        EXPECT_EQ(a.attribution, b.attribution) << text_;
        EXPECT_EQ(a.technique, b.technique) << text_;
        EXPECT_EQ(a.setting, b.setting) << text_;
        EXPECT_EQ(a.size, b.size) << text_;
        EXPECT_EQ(a.samples, b.samples) << text_;
        EXPECT_EQ(a.binds, b.binds) << text_;
    }

    std::string text_;
};

} // namespace

TEST_F(WrittenWorkspaces, read_back_as_they_were_to_the_last_bit) {
    const Workspace w = full();
    const Workspace read = again(w);
    expectSame(w, read);
    EXPECT_EQ(fs::weakly_canonical(folder_ / "out" / read.meshPath), fs::weakly_canonical(folder_ / "scan.glb")) << text_;
    EXPECT_EQ(fs::weakly_canonical(folder_ / "out" / read.textures.at("DIFFUSE")), fs::weakly_canonical(folder_ / "skin.png")) << text_;
    EXPECT_NE(text_.find("[1, 2, 3]"), std::string::npos) << "lists of numbers stand on one line: " << text_;
}

TEST_F(WrittenWorkspaces, keep_poses) {
    Workspace w = full();
    w.pose = "bent.glb";
    w.poseBefore = "straight.glb";
    const Workspace read = again(w);
    EXPECT_EQ(fs::weakly_canonical(folder_ / "out" / read.pose), fs::weakly_canonical(folder_ / "bent.glb")) << text_;
    EXPECT_EQ(fs::weakly_canonical(folder_ / "out" / read.poseBefore), fs::weakly_canonical(folder_ / "straight.glb")) << text_;
}

TEST_F(WrittenWorkspaces, keep_frames_parallel_light_and_defaults) {
    Workspace w;
    w.file = folder_ / "w.json";
    w.meshPath = "scan.glb";
    w.light.direction = glm::vec3(0.3F, -1, 0.1F);
    w.light.width = 2.5F;
    expectSame(w, again(w));
}

TEST_F(WrittenWorkspaces, of_a_world_in_metres_stay_so) {
    Workspace w = full();
    w.worldUnitMm = 1024; // a power of two: nothing is rounded on the way
    const Workspace read = again(w);
    expectSame(w, read);
    EXPECT_EQ(read.worldUnitMm, 1024);
}

TEST_F(WrittenWorkspaces, keep_their_objects) {
    Workspace w;
    w.file = folder_ / "w.json";
    SceneObject object;
    object.meshPath = "scan.glb";
    object.head = false;
    object.placement = {.position = {1, 2.5F, -3}, .rotation = {10, 20, 30}, .scale = {1, -1, 0.5F}};
    object.parameters = {{"gMix", {0.25}}};
    w.objects = {object, object};
    w.objects.back().textures = {{"NORMAL", "skin.png"}};
    const Workspace read = again(w);
    ASSERT_EQ(read.objects.size(), 2U) << text_;
    EXPECT_EQ(read.objects.front().placement, object.placement) << text_;
    EXPECT_EQ(read.objects.front().parameters, object.parameters) << text_;
    EXPECT_EQ(read.objects.back().textures.size(), 1U) << text_;
}

TEST_F(WrittenWorkspaces, name_files_of_the_cache_by_its_variable) {
    const char* before = std::getenv("TEGUMENT_CACHE");
    const std::string cache = before ? before : "";
    setenv("TEGUMENT_CACHE", folder_.c_str(), 1);
    const Workspace read = again(full());
    EXPECT_NE(text_.find("\"${TEGUMENT_CACHE}/scan.glb\""), std::string::npos) << text_;
    EXPECT_EQ(fs::path(read.meshPath), folder_ / "scan.glb");
    cache.empty() ? unsetenv("TEGUMENT_CACHE") : setenv("TEGUMENT_CACHE", cache.c_str(), 1);
}

TEST_F(WrittenWorkspaces, that_are_settled_hold_what_the_command_line_gave) {
    Workspace w = full();
    SceneObject object;
    object.parameters = {{"gMix", {0.9}}};
    w.objects = {object};
    settle(w, {{"gMix", {0.5}}}, {{"NORMAL", (folder_ / "skin.png").string()}});
    EXPECT_EQ(w.parameters.at("gMix"), std::vector<double>{0.5});
    EXPECT_EQ(w.objects.front().parameters.at("gMix"), std::vector<double>{0.5}) << "--set wins over objects";
    EXPECT_EQ(w.textures.at("NORMAL"), (folder_ / "skin.png").string());
}
