// How a mesh moves, by hand: what no other program is asked for is here; tests/motion compares with three.js.

#include "host/mesh/motion.h"
#include "tests/mesh/files.h"

#include <nlohmann/json.hpp>

#include <cmath>

using namespace tegument;
using namespace tegument::testing_scene;

namespace {

using Json = nlohmann::json;
using Moving = SceneFiles;

/// A triangle of a skin with two joints: the first stands, the second turns about z in a second. `json` may be changed before it is
/// written.
struct Rig {
    std::vector<float> numbers;
    Json json = Json::parse(R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0, 1]}],
        "nodes": [{"mesh": 0, "skin": 0}, {"name": "hip", "children": [2]}, {"name": "head"}],
        "skins": [{"joints": [1, 2]}], "bufferViews": [], "accessors": []})");
    std::vector<float> times = {0, 1};
    std::vector<float> joints = {0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    std::vector<float> weights = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};
    std::vector<float> turns = {0, 0, 0, 1, 0, 0, std::sqrt(0.5f), std::sqrt(0.5f)};

    std::size_t add(const std::vector<float>& values, const char* type, std::size_t width) {
        json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", numbers.size() * 4}, {"byteLength", values.size() * 4}});
        json["accessors"].push_back(
            {{"bufferView", json["bufferViews"].size() - 1}, {"componentType", 5126}, {"count", values.size() / width}, {"type", type}});
        numbers.insert(numbers.end(), values.begin(), values.end());
        return json["accessors"].size() - 1;
    }
    std::string glb() {
        const Json primitive = {{"attributes",
                                 {{"POSITION", add({0, 0, 0, 1, 0, 0, 0, 1, 0}, "VEC3", 3)},
                                  {"NORMAL", add({0, 0, 1, 0, 0, 1, 0, 0, 1}, "VEC3", 3)},
                                  {"JOINTS_0", add(joints, "VEC4", 4)},
                                  {"WEIGHTS_0", add(weights, "VEC4", 4)}}},
                                {"targets", Json::array({{{"POSITION", add({0, 0, 0, 0, 0, 1, 0, 0, 0}, "VEC3", 3)},
                                                          {"NORMAL", add({0, 0, 0, -1, 0, 0, 0, 0, 0}, "VEC3", 3)}}})}};
        json["meshes"] = Json::array({{{"primitives", Json::array({primitive})}, {"extras", {{"targetNames", {"lift"}}}}}});
        json["animations"] =
            Json::array({{{"name", "turn"},
                          {"samplers", Json::array({{{"input", add(times, "SCALAR", 1)}, {"output", add(turns, "VEC4", 4)}}})},
                          {"channels", Json::array({{{"sampler", 0}, {"target", {{"node", 2}, {"path", "rotation"}}}}})}}});
        json["buffers"] = Json::array({{{"byteLength", numbers.size() * 4}}});
        std::string binary;
        append(binary, numbers);
        return testing_scene::glb(json.dump(), binary);
    }
};

std::string hintOf(const Error& error) {
    return error.diagnostics.front().hint;
}

} // namespace

TEST_F(Moving, a_turning_joint_takes_its_vertices_and_their_normals_along_and_stands_still_beyond_the_ends) {
    Rig rig;
    const auto rest = load("rig.glb", rig.glb());
    ASSERT_TRUE(rest) << format(rest.error());
    for (const auto& [seconds, angle] : {std::pair(-1.0, 0.0), {0.5, 45.0}, {1.0, 90.0}, {7.0, 90.0}}) {
        Mesh mesh = *rest;
        ASSERT_TRUE(poseMesh(mesh, {.animation = "turn", .time = seconds, .morphs = {}}));
        const double a = angle * 3.14159265358979 / 180;
        EXPECT_NEAR(glm::distance(mesh.positions[1], glm::vec3(1000 * std::cos(a), 1000 * std::sin(a), 0)), 0, 1e-3) << seconds;
        EXPECT_EQ(mesh.positions[0], glm::vec3(0));
    }
}

TEST_F(Moving, morph_targets_change_place_and_normal_before_the_skin_turns_them) {
    Rig rig;
    const auto rest = load("rig.glb", rig.glb());
    ASSERT_TRUE(rest) << format(rest.error());
    Mesh mesh = *rest;
    ASSERT_TRUE(poseMesh(mesh, {.animation = "0", .time = 1, .morphs = {{"lift", 0.5}}}));
    EXPECT_NEAR(glm::distance(mesh.positions[1], glm::vec3(0, 1000, 500)), 0, 1e-3);
    const glm::vec3 normal = glm::normalize(glm::vec3(0, -0.5f, 1)); // (-0.5, 0, 1) turned by 90 degrees
    EXPECT_NEAR(glm::distance(mesh.normals[1], normal), 0, 1e-6);
}

TEST_F(Moving, normals_stay_at_right_angles_where_a_joint_is_stretched_unevenly) {
    Rig rig;
    rig.json["nodes"][1]["scale"] = {1, 1, 4};
    rig.json["nodes"][1]["rotation"] = {0.6, 0, 0, 0.8};
    const auto mesh = load("rig.glb", rig.glb());
    ASSERT_TRUE(mesh) << format(mesh.error());
    const auto& p = mesh->positions;
    const glm::vec3 face = glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0]));
    for (const glm::vec3& normal : mesh->normals)
        EXPECT_NEAR(glm::distance(normal, face), 0, 1e-6);
}

TEST_F(Moving, a_name_that_is_not_there_is_one_error_with_those_that_are) {
    Rig rig;
    const auto rest = load("rig.glb", rig.glb());
    ASSERT_TRUE(rest) << format(rest.error());
    Mesh mesh = *rest;
    const auto animation = poseMesh(mesh, {.animation = "walk", .time = {}, .morphs = {}});
    ASSERT_EQ(codeOf(animation), 8053);
    EXPECT_NE(hintOf(animation.error()).find("turn"), std::string::npos);
    const auto morph = poseMesh(mesh, {.animation = "", .time = {}, .morphs = {{"smile", 1}}});
    ASSERT_EQ(codeOf(morph), 8053);
    EXPECT_NE(hintOf(morph.error()).find("lift"), std::string::npos);
    const auto still = load("still.obj", "v 0 0 0\nv 10 0 0\nv 0 10 0\nf 1 2 3\n");
    ASSERT_TRUE(still);
    mesh = *still;
    EXPECT_EQ(codeOf(poseMesh(mesh, {.animation = "", .time = 1, .morphs = {}})), 8053);
}

TEST_F(Moving, keys_that_are_no_times_leave_the_animation_out_with_a_warning) {
    for (const std::vector<float>& times : {std::vector<float>{0, 0}, {1, 0}, {0, NAN}, {0, INFINITY}, {0}}) {
        Rig rig;
        rig.times = times;
        const auto mesh = load("rig.glb", rig.glb());
        ASSERT_TRUE(mesh) << format(mesh.error());
        EXPECT_TRUE(mesh->motion->animations.empty());
        EXPECT_TRUE(hasWarning(*mesh, 5331));
    }
}

TEST_F(Moving, joints_that_are_not_there_are_an_error_and_weights_without_a_sum_are_not) {
    Rig rig;
    rig.joints[4] = 2;
    EXPECT_EQ(codeOf(load("far.glb", rig.glb())), 5304);
    Rig none;
    none.weights[4] = 0;
    const auto mesh = load("none.glb", none.glb());
    ASSERT_TRUE(mesh) << format(mesh.error());
    EXPECT_TRUE(hasWarning(*mesh, 5323));
    Rig wild;
    wild.weights[4] = NAN;
    EXPECT_EQ(codeOf(load("wild.glb", wild.glb())), 5302);
}

TEST_F(Moving, nodes_that_go_round_and_matrices_that_are_missing_are_errors) {
    Rig round;
    round.json["nodes"][2]["children"] = {1};
    EXPECT_EQ(codeOf(load("round.glb", round.glb())), 5302);
    Rig few;
    few.json["skins"][0]["inverseBindMatrices"] = few.add({1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}, "MAT4", 16);
    EXPECT_EQ(codeOf(load("few.glb", few.glb())), 5302) << "one for two joints";
}
