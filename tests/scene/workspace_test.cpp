#include "host/scene/workspace.h"
#include "tests/mesh/files.h"

#include <cstdlib>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

class Workspaces : public SceneFiles {
protected:
    [[nodiscard]] Result<Workspace> parse(const std::string& text, const WorkspaceOptions& options = {}) const {
        return parseWorkspace(text, folder_ / "w.json", options);
    }
    /// code(line,column) of the only diagnostic.
    [[nodiscard]] std::string faultOf(const std::string& text) const {
        const auto workspace = parse(text);
        if (workspace) return "accepted";
        EXPECT_EQ(workspace.error().diagnostics.size(), 1u);
        const Diagnostic& d = workspace.error().diagnostics.front();
        return std::to_string(d.code) + "(" + std::to_string(d.at.line) + "," + std::to_string(d.at.column) + ")";
    }
    [[nodiscard]] std::string messageOf(const std::string& text) const {
        const auto workspace = parse(text);
        return workspace ? "accepted" : format(workspace.error());
    }
};

} // namespace

TEST_F(Workspaces, every_key_arrives_in_its_field) {
    write("head.glb", "x");
    write("color.png", "x");
    const auto w = parse(R"({
      "comment": ["all", "keys"],
      "mesh": "head.glb", "unit_mm": 49.5, "flip_v": true, "head": false, "attribution": "Someone",
      "camera": { "frame": "world", "position": [1, 2, 3], "target": [4, 5, 6], "up": [0, 0, 1], "horizontal_fov": 30, "near": 10, "far": 1000, "comment": "" },
      "light": { "frame": "world", "position": [7, 8, 9], "color": [1, 0.5, 0] },
      "background": [0.1, 0.2, 0.3],
      "textures": { "gColorMap": "color.png" },
      "parameters": { "gMix": 0.5, "gTint": [1, 2, 3], "gUsePrePass": true },
      "technique": "A", "setting": "draft", "size": [640, 480], "samples": 2, "bind": { "gMatrix": "WORLD", "comment": 1 },
      "pose": "bent.obj", "pose_before": "straight.obj"
    })");
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_EQ(w->file, folder_ / "w.json");
    EXPECT_EQ(w->meshPath, "head.glb");
    EXPECT_EQ(w->unitMm, 49.5);
    EXPECT_TRUE(w->flipV);
    EXPECT_FALSE(w->head);
    EXPECT_EQ(w->attribution, "Someone");
    EXPECT_FALSE(w->cameraRelative);
    EXPECT_EQ(w->camera.position, glm::vec3(1, 2, 3));
    EXPECT_EQ(w->camera.target, glm::vec3(4, 5, 6));
    EXPECT_EQ(w->camera.up, glm::vec3(0, 0, 1));
    EXPECT_EQ(w->camera.horizontalFov, 30);
    EXPECT_EQ(w->camera.nearPlane, 10);
    EXPECT_EQ(w->camera.farPlane, 1000);
    EXPECT_EQ(w->technique + w->setting + w->pose + w->poseBefore, "Adraftbent.objstraight.obj");
    EXPECT_EQ(w->size, std::pair(640, 480));
    EXPECT_EQ(w->samples, 2);
    EXPECT_EQ(w->binds, (std::map<std::string, std::string>{{"gMatrix", "WORLD"}}));
    EXPECT_FALSE(w->lightRelative);
    EXPECT_EQ(w->light.position, glm::vec3(7, 8, 9));
    EXPECT_EQ(w->light.color, glm::vec3(1, 0.5f, 0));
    EXPECT_EQ(w->background, glm::vec3(0.1f, 0.2f, 0.3f));
    EXPECT_EQ(w->textures.at("gColorMap"), "color.png");
    EXPECT_EQ(w->parameters.at("gMix"), std::vector<double>{0.5});
    EXPECT_EQ(w->parameters.at("gTint"), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(w->parameters.at("gUsePrePass"), std::vector<double>{1});
}

TEST_F(Workspaces, an_empty_object_gives_the_defaults) {
    const auto w = parse("{}");
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_TRUE(w->cameraRelative && w->lightRelative && w->head);
    EXPECT_FALSE(w->unitMm);
    EXPECT_FALSE(w->camera.nearPlane);
    EXPECT_EQ(w->camera.horizontalFov, Camera{}.horizontalFov);
}

TEST_F(Workspaces, an_unknown_key_is_an_error_with_its_place_and_the_nearest_name) {
    const std::string text = "{\n  \"head\": true,\n  \"camera\": { \"possition\": [0, 0, 1] }\n}";
    EXPECT_EQ(faultOf(text), "5401(3,15)");
    EXPECT_NE(messageOf(text).find("did you mean 'position'?"), std::string::npos) << messageOf(text);
    EXPECT_NE(messageOf("{\"qqqqqqq\": 1}").find("known keys: mesh, unit_mm"), std::string::npos);
}

TEST_F(Workspaces, faults_are_found_at_the_key) {
    EXPECT_EQ(faultOf("{\n \"head\": 1\n}"), "5402(2,2)");
    EXPECT_EQ(faultOf("{\n \"camera\": {\n  \"horizontal_fov\": -25 } }"), "5403(3,3)");
    EXPECT_EQ(faultOf("{\"camera\": {\"horizontal_fov\": 180}}"), "5403(1,13)");
    EXPECT_EQ(faultOf("{\"camera\": {\"position\": [1, 2]}}"), "5402(1,13)");
    EXPECT_EQ(faultOf("{\"camera\": {\"near\": 0}}"), "5403(1,13)");
    EXPECT_EQ(faultOf("{\"camera\": {\"near\": 5, \"far\": 5}}"), "5407(1,2)");
    EXPECT_EQ(faultOf("{\"camera\": {\"position\": [0, 0, 0], \"target\": [0, 0, 0]}}"), "5407(1,2)");
    EXPECT_EQ(faultOf("{\"camera\": {\"up\": [0, 0, 0]}}"), "5407(1,2)");
    EXPECT_EQ(faultOf("{\"camera\": {\"frame\": \"screen\"}}"), "5403(1,13)");
    EXPECT_EQ(faultOf("{\"camera\": {\"frame\": \"world\"}}"), "5407(1,2)");
    EXPECT_EQ(faultOf("{\"light\": {\"frame\": \"world\"}}"), "5407(1,2)");
    EXPECT_EQ(faultOf("{\"light\": {\"color\": [1, -1, 1]}}"), "5403(1,25)");
    EXPECT_EQ(faultOf("{\"light\": {\"color\": [1, 1, true]}}"), "5402(1,28)");
    EXPECT_EQ(faultOf("{\"light\": {\"color\": [\"red\", 1, 1]}}"), "5402(1,22)");
    EXPECT_EQ(faultOf("{\"unit_mm\": 0}"), "5403(1,2)");
    EXPECT_EQ(faultOf("{\"size\": 640}"), "5402(1,2)");
    EXPECT_EQ(faultOf("{\"size\": [640]}"), "5402(1,2)");
    EXPECT_EQ(faultOf("{\"size\": [640, 0]}"), "5403(1,16)");
    EXPECT_EQ(faultOf("{\"samples\": 3}"), "5403(1,2)");
    EXPECT_EQ(faultOf("{\"samples\": 16}"), "5403(1,2)");
    EXPECT_EQ(faultOf("{\"bind\": {\"gMatrix\": 1}}"), "5402(1,11)");
    EXPECT_EQ(faultOf("{\"technique\": 1}"), "5402(1,2)");
    EXPECT_EQ(faultOf("{\"unit_mm\": \"49\"}"), "5402(1,2)");
    EXPECT_EQ(faultOf("{\"light\": [1, 2, 3]}"), "5402(1,2)");
    EXPECT_EQ(faultOf("{\"parameters\": {\"gMix\": \"half\"}}"), "5402(1,17)");
    EXPECT_EQ(faultOf("{\"parameters\": {\"gMix\": [1, [2]]}}"), "5402(1,17)");
    EXPECT_EQ(faultOf("{\"parameters\": {\"gMix\": []}}"), "5402(1,17)");
    EXPECT_EQ(faultOf("[]"), "5402(1,1)");
}

TEST_F(Workspaces, a_repeated_key_is_an_error_at_the_second) {
    EXPECT_EQ(faultOf("{\n \"head\": true,\n \"head\": false\n}"), "5404(3,2)");
    EXPECT_EQ(faultOf("{\"parameters\": {\"a\": 1, \"b\": 2, \"a\": 3}}"), "5404(1,33)");
}

TEST_F(Workspaces, what_is_not_json_is_an_error_with_its_line) {
    for (const char* text : {"{\n \"head\": tru\n}", "{\n \"camera\": {\"near\": NaN}}", "{\n \"unit_mm\": 1e999}",
                             "{\n \"head\": true,\n}", "{\n // no\n}"}) {
        const std::string fault = faultOf(text);
        EXPECT_TRUE(fault.starts_with("5400(2,") || fault.starts_with("5400(3,")) << fault << " for " << text;
    }
    EXPECT_EQ(faultOf("").substr(0, 4), "5400");
    EXPECT_EQ(faultOf("{").substr(0, 4), "5400");
    EXPECT_EQ(faultOf("{} {}").substr(0, 4), "5400");
    EXPECT_EQ(faultOf("{\"\xff\": 1}").substr(0, 4), "5400");
    EXPECT_EQ(faultOf(std::string(100000, '[')).substr(0, 4), "5400");
}

TEST_F(Workspaces, the_message_shows_the_line_and_a_caret) {
    EXPECT_NE(messageOf("{\n  \"haed\": true\n}").find("\"haed\": true\n"), std::string::npos) << messageOf("{\n  \"haed\": true\n}");
}

TEST_F(Workspaces, missing_files_are_errors_at_their_key) {
    EXPECT_EQ(faultOf("{\n \"mesh\": \"gone.glb\"\n}"), "5405(2,2)");
    EXPECT_EQ(faultOf("{\"textures\": {\n \"DIFFUSE\": \"gone.png\"}}"), "5405(2,2)");
    EXPECT_EQ(messageOf("{\"mesh\": \"x/human.glb\"}").find("tegument prep"), std::string::npos) << "a file of somebody's own";
}

TEST_F(Workspaces, files_need_not_exist_when_the_mesh_is_given_elsewhere) {
    EXPECT_TRUE(parse(R"({"mesh": "gone.glb", "textures": {"DIFFUSE": "gone.png"}})", {.requireMesh = false}));
}

TEST_F(Workspaces, variables_are_replaced_and_unset_ones_named) {
    write("a.glb", "x");
    setenv("TEGUMENT_TEST_FOLDER", folder_.c_str(), 1);
    const auto w = parse(R"({"mesh": "${TEGUMENT_TEST_FOLDER}/a.glb"})");
    unsetenv("TEGUMENT_TEST_FOLDER");
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_EQ(w->meshPath, (folder_ / "a.glb").string());
    const std::string message = messageOf("{\n \"mesh\": \"${TEGUMENT_TEST_FOLDER}/a.glb\"}");
    EXPECT_NE(message.find("TEGUMENT_TEST_FOLDER is not set"), std::string::npos) << message;
    EXPECT_EQ(faultOf("{\n \"mesh\": \"${TEGUMENT_TEST_FOLDER}/a.glb\"}"), "5406(2,2)");
    EXPECT_EQ(faultOf("{\"mesh\": \"${UNCLOSED\"}"), "5406(1,2)");
}

TEST_F(Workspaces, the_cache_folder_is_always_a_variable) {
    const auto w = parse(R"({"mesh": "${TEGUMENT_CACHE}/human/human.glb"})", {.requireMesh = false});
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_EQ(w->meshPath, (cacheFolder() / "human" / "human.glb").string());
}

TEST_F(Workspaces, a_key_with_escapes_is_found_where_it_stands) {
    EXPECT_EQ(faultOf("{\n   \"he\\\"ad\": 1}"), "5401(2,4)");
}

TEST_F(Workspaces, mesh_options_follow_the_workspace) {
    const auto w = parse(R"({"unit_mm": 49, "flip_v": true, "head": false})");
    ASSERT_TRUE(w);
    const MeshOptions options = meshOptions(*w);
    EXPECT_EQ(options.unitMm, 49);
    EXPECT_TRUE(options.flipV);
    EXPECT_FALSE(options.expectHead);
}

TEST_F(Workspaces, objects_arrive_with_their_places) {
    write("head.glb", "x");
    write("skin.png", "x");
    const auto w = parse(R"({
      "objects": [
        { "mesh": "head.glb", "unit_mm": 49, "flip_v": true, "head": false, "attribution": "Someone", "position": [1, 2, 3], "rotation": [10, 20, 30], "scale": 1.5,
          "textures": { "DIFFUSE": "skin.png" }, "parameters": { "gMix": 0.25 } },
        { "mesh": "head.glb" }
      ],
      "parameters": { "gMix": 0.5, "gRoughness": 0.3 }
    })");
    ASSERT_TRUE(w) << format(w.error());
    ASSERT_EQ(w->objects.size(), 2u);
    const SceneObject& first = w->objects.front();
    EXPECT_EQ(first.placement, (Placement{.position = {1, 2, 3}, .rotation = {10, 20, 30}, .scale = glm::vec3(1.5F)}));
    EXPECT_EQ(w->objects[1].placement, Placement{});
    const Workspace own = workspaceOf(*w, first);
    EXPECT_EQ(own.meshPath, "head.glb");
    EXPECT_EQ(own.unitMm, 49);
    EXPECT_TRUE(own.flipV && !own.head);
    EXPECT_EQ(own.attribution, "Someone");
    EXPECT_EQ(own.textures.at("DIFFUSE"), "skin.png");
    EXPECT_EQ(own.parameters.at("gMix"), std::vector<double>{0.25}) << "the object's wins";
    EXPECT_EQ(own.parameters.at("gRoughness"), std::vector<double>{0.3}) << "the workspace's is shared";
    EXPECT_TRUE(own.objects.empty());
}

TEST_F(Workspaces, a_scale_is_one_number_or_one_for_each_axis_and_may_mirror) {
    write("head.glb", "x");
    const auto w = parse(R"({"objects": [{"mesh": "head.glb", "scale": [-1, 1, 2]}, {"mesh": "head.glb", "scale": -1000}]})");
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_EQ(w->objects[0].placement.scale, glm::vec3(-1, 1, 2));
    EXPECT_EQ(w->objects[1].placement.scale, glm::vec3(-1000));
    EXPECT_EQ(meshOptions(w->objects[0]).scale, glm::vec3(-1, 1, 2)) << "a head is judged by it";
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "head.glb", "scale": [1, 0, 1]}]})"), "5403(1,35)");
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "head.glb", "scale": [1, 1]}]})"), "5402(1,35)");
}

TEST_F(Workspaces, lengths_of_the_world_are_in_its_unit) {
    write("head.glb", "x");
    const auto w = parse(R"({
      "objects": [{ "mesh": "head.glb", "position": [0.1, 0.2, 0.3], "scale": 2 }],
      "camera": { "frame": "world", "position": [0, 0, 0.7], "target": [0, 0.1, 0], "near": 0.5, "far": 0.9 },
      "light": { "frame": "world", "direction": [0, -1, 0], "width": 0.3 },
      "world_unit_mm": 1000
    })");
    ASSERT_TRUE(w) << format(w.error());
    EXPECT_EQ(w->worldUnitMm, 1000);
    EXPECT_EQ(w->objects[0].placement.position, glm::vec3(100, 200, 300));
    EXPECT_EQ(w->objects[0].placement.scale, glm::vec3(2));
    EXPECT_EQ(w->camera.position, glm::vec3(0, 0, 700));
    EXPECT_EQ(w->camera.target, glm::vec3(0, 100, 0));
    EXPECT_EQ(w->camera.nearPlane, 500);
    EXPECT_EQ(w->camera.farPlane, 900);
    EXPECT_EQ(w->light.width, 300);
    EXPECT_EQ(w->light.direction, glm::vec3(0, -1, 0));
    const auto relative = parse(R"({"camera": {"position": [1, 2, 3]}, "light": {"position": [4, 5, 6]}, "world_unit_mm": 10})");
    ASSERT_TRUE(relative) << format(relative.error());
    EXPECT_EQ(relative->camera.position, glm::vec3(1, 2, 3)) << "radii have no unit";
    EXPECT_EQ(relative->light.position, glm::vec3(4, 5, 6));
}

TEST_F(Workspaces, a_light_is_a_point_or_parallel) {
    const auto narrow = parse(R"({"light": {"position": [4, 5, 6], "fov": 7.5}})");
    ASSERT_TRUE(narrow) << format(narrow.error());
    EXPECT_EQ(narrow->light.fov, 7.5F);
    EXPECT_EQ(faultOf(R"({"light": {"direction": [0, 0, 0]}})"), "5407(1,2)");
    EXPECT_EQ(faultOf(R"({"light": {"direction": [0, 1, 0], "position": [1, 1, 1]}})"), "5407(1,2)");
    EXPECT_EQ(faultOf(R"({"light": {"direction": [0, 1, 0], "fov": 9}})"), "5407(1,2)");
    EXPECT_EQ(faultOf(R"({"light": {"width": 9}})"), "5407(1,2)");
    EXPECT_EQ(faultOf(R"({"light": {"fov": 161}})"), "5403(1,12)");
    EXPECT_EQ(faultOf(R"({"world_unit_mm": 0})"), "5403(1,2)");
}

TEST_F(Workspaces, faults_of_objects_are_found_where_they_stand) {
    write("head.glb", "x");
    EXPECT_EQ(faultOf(R"({"objects": []})"), "5403(1,2)");
    EXPECT_EQ(faultOf(R"({"objects": {}})"), "5402(1,2)");
    EXPECT_EQ(faultOf(R"({"objects": [{"position": [0, 0, 0]}]})"), "5407(1,14)");
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "head.glb", "scale": 0}]})"), "5403(1,35)");
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "head.glb", "rotate": [0, 0, 0]}]})"), "5401(1,35)");
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "absent.glb"}]})"), "5405(1,15)");
    EXPECT_EQ(faultOf(R"({"objects": [{"mesh": "head.glb"}], "unit_mm": 1})"), "5407(1,37)");
    EXPECT_NE(messageOf(R"({"objects": [{"mesh": "head.glb", "rotate": 1}]})").find("did you mean 'rotation'"), std::string::npos);
}

TEST_F(Workspaces, too_many_objects_are_refused) {
    write("head.glb", "x");
    std::string list;
    for (int i = 0; i < 257; ++i)
        list += std::string(i ? ", " : "") + R"({"mesh": "head.glb"})";
    EXPECT_EQ(faultOf("{\"objects\": [" + list + "]}"), "5403(1,2)");
}
