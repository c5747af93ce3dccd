// tegument prep IN -o OUT, as a user runs it.

#include "tests/cli/picture.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

std::string shape(const std::string& name) {
    const std::string path = (scratch() / (name + ".ply")).string();
    EXPECT_EQ(tegument::test::tegument({"prep", "shape", name, "-o", path, "--detail", "20"}).code, 0);
    return path;
}

nlohmann::json jsonIn(const fs::path& path) {
    std::ifstream in(path);
    return nlohmann::json::parse(in, nullptr, false);
}

} // namespace

TEST(PrepMesh, takes_what_it_wrote_as_input_again) {
    const std::string out = (scratch() / "torus.glb").string();
    const Ran ran = tegument::test::tegument({"prep", shape("torus"), "-o", out});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("192 vertices, 384 triangles"), std::string::npos) << ran.out;
    EXPECT_TRUE(fs::exists(out));
    EXPECT_EQ(tegument::test::tegument({"prep", out, "--dry-run"}).code, 0);
}

TEST(PrepMesh, reports_what_every_step_changed_and_the_figures_before_and_after) {
    const fs::path report = scratch() / "sphere.json";
    const Ran ran =
        tegument::test::tegument({"prep", shape("sphere"), "-o", (scratch() / "sphere.glb").string(), "--report", report.string()});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = jsonIn(report);
    EXPECT_EQ(json["output"]["vertices"], 4002);
    EXPECT_EQ(json["output"]["faces"], 8000);
    EXPECT_EQ(json["input"]["faces"], 8000);
    for (const auto& step : json["steps"])
        EXPECT_TRUE(step["name"].is_string() && step["changed"].is_number_unsigned()) << step;
    for (const char* model : {"fifo12", "fifo16", "fifo24", "fifo32", "warp"})
        for (const char* figure : {"acmr", "atvr"}) {
            EXPECT_GT(json[figure][model]["before"], 0) << model;
            EXPECT_GT(json[figure][model]["after"], 0) << model;
        }
    EXPECT_EQ(json["bytes"]["before"], 8000 * 3 * 24);
    EXPECT_EQ(json["bytes"]["after"], 4002 * 24 + 8000 * 3 * 2);
    EXPECT_EQ(json["levels"].size(), 3u);
}

TEST(PrepMesh, prints_the_report_as_json_on_request) {
    const auto json = tegument::test::tegument({"prep", shape("cube"), "--dry-run", "--json"}).json();
    EXPECT_EQ(json["output"]["vertices"], 8);
    EXPECT_TRUE(json["output"]["file"].is_null());
}

TEST(PrepMesh, writes_nothing_in_a_dry_run) {
    const fs::path out = scratch() / "dry.glb";
    EXPECT_EQ(tegument::test::tegument({"prep", shape("cube"), "-o", out.string(), "--dry-run"}).code, 0);
    EXPECT_FALSE(fs::exists(out));
}

TEST(PrepMesh, leaves_nothing_behind_when_the_input_is_at_fault) {
    const fs::path folder = scratch() / "nothing";
    fs::create_directories(folder);
    const Ran ran = tegument::test::tegument(
        {"prep", write("bad.obj", "v 0 0 0\nf 1 2 3\n"), "-o", (folder / "out.glb").string(), "--report", (folder / "out.json").string()});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.err.find("bad.obj(2,1): error TG5304"), std::string::npos) << ran.err;
    EXPECT_TRUE(fs::is_empty(folder));
}

TEST(PrepMesh, says_what_is_missing_on_the_command_line) {
    const struct {
        std::vector<std::string> arguments;
        const char* code;
    } cases[] = {{{"prep"}, "TG8041"},
                 {{"prep", "x.ply"}, "TG8040"},
                 {{"prep", ballMesh(), "--dry-run", "--weld-epsilon", "-1"}, "TG7022"},
                 {{"prep", ballMesh(), "--dry-run", "--weld-decimals", "13"}, "TG7023"},
                 {{"prep", ballMesh(), "--dry-run", "--weld-decimals", "6", "--weld-epsilon", "1"}, "TG7024"},
                 {{"prep", "x.ply", "-o", "x.obj"}, "TG8042"}};
    for (const auto& test : cases) {
        const Ran ran = tegument::test::tegument(test.arguments);
        EXPECT_EQ(ran.code, 2) << ran.err;
        EXPECT_NE(ran.err.find(test.code), std::string::npos) << ran.err;
    }
}

TEST(PrepMesh, names_the_step_that_left_nothing) {
    const Ran ran = tegument::test::tegument({"prep", write("flat.obj", "v 0 0 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\n"), "--dry-run"});
    EXPECT_EQ(ran.code, 1);
    EXPECT_NE(ran.err.find("TG7020"), std::string::npos) << ran.err;
}

TEST(PrepMesh, takes_every_format_that_it_says_it_takes) {
    const std::vector<std::string> files = {
        write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), write("a.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        write("a.stl",
              "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid a\n"),
        write("a.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
                       "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")};
    for (const std::string& file : files) {
        const auto json = tegument::test::tegument({"prep", file, "--dry-run", "--json"}).json();
        EXPECT_EQ(json["output"]["faces"], 1) << file;
    }
}

TEST(PrepMesh, says_which_folders_it_made) {
    const fs::path fresh = scratch() / "unmade";
    const std::string out = (fresh / "below" / "cube.glb").string();
    const std::string said = "created the folder " + fresh.string() + "\n"; // the outermost one alone
    EXPECT_EQ(tegument::test::tegument({"prep", shape("cube"), "-o", out, "--dry-run"}).out.find("created"), std::string::npos);
    EXPECT_FALSE(fs::exists(fresh));
    const Ran first = tegument::test::tegument({"prep", shape("cube"), "-o", out});
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_NE(first.out.find(said), std::string::npos) << first.out;
    EXPECT_TRUE(fs::exists(out));
    EXPECT_EQ(tegument::test::tegument({"prep", shape("cube"), "-o", out}).out.find("created"), std::string::npos);
}

TEST(PrepMesh, warns_of_what_a_ply_file_cannot_keep) {
    ASSERT_FALSE(write("two.mtl", "newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n").empty());
    const std::string triangles = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\n";
    const std::string two = write("two.obj", "mtllib two.mtl\n" + triangles + "usemtl red\nf 1 2 3\nusemtl blue\nf 1 2 4\n");
    const auto warnings = [](const std::string& from, const char* to) {
        const Ran ran = tegument::test::tegument({"prep", from, "-o", (scratch() / to).string()});
        EXPECT_EQ(ran.code, 0) << ran.err;
        return ran.err;
    };
    const std::string lost = warnings(two, "two.ply");
    EXPECT_NE(lost.find("warning TG5331: a PLY file keeps none of 2 parts, 2 materials"), std::string::npos) << lost;
    EXPECT_EQ(warnings(two, "two.glb").find("TG5331"), std::string::npos);
    EXPECT_EQ(warnings(write("plain.obj", triangles + "f 1 2 3\n"), "plain.ply").find("TG5331"), std::string::npos);
}

#ifndef TEGUMENT_WITHOUT_XATLAS
TEST(PrepMesh, draws_the_pictures_of_all_materials_anew_where_it_makes_texture_coordinates) {
    for (const std::string name : {"a", "b"}) { // smooth, and unlike
        tegument::Image picture = tegument::plainImage(256, 256, 3);
        for (int y = 0; y < 256; ++y)
            for (int x = 0; x < 256; ++x)
                for (int c = 0; c < 3; ++c)
                    picture.at(x, y, c) = 0.5F + 0.4F * std::sin(0.06F * static_cast<float>((c + 1) * x + (name == "a" ? y : -y)));
        ASSERT_TRUE(tegument::writePng(scratch() / (name + "_side.png"), picture, tegument::PngEncoding::Raw));
    }
    static_cast<void>(write("sides.mtl", "newmtl a\nmap_Kd a_side.png\nnewmtl b\nmap_Kd b_side.png\n"));
    std::string text = "mtllib sides.mtl\n" + ballObj();
    text.insert(text.find("f ", text.size() / 10 * 9), "usemtl b\n");
    text.insert(text.find("\nf ") + 1, "usemtl a\n");
    const std::string mesh = write("sides.obj", text);
    const Ran ran = tegument::test::tegument({"prep", mesh, "--unwrap", "--unit-mm", "1", "-o", out("sides.glb")});
    ASSERT_EQ(ran.code, 0) << ran.err;
    ASSERT_EQ(tegument::test::tegument({"prep", mesh, "--unwrap", "--flip-v", "--unit-mm", "1", "-o", out("flipped.glb")}).code, 0);
    EXPECT_NE(ran.out.find("1 drawn anew for these charts"), std::string::npos) << ran.out;
    const auto drawn = [](const std::string& name, const std::string& file) {
        return render(name, {"effects/OriginalTexture.fx", "--mesh", file, "--unit-mm", file.ends_with("glb") ? "1000" : "1", "--size",
                             "128", "--samples", "4"})
            .image;
    };
    const tegument::Image before = drawn("sides_before", mesh), after = drawn("sides_after", out("sides.glb"));
    ASSERT_EQ(before.pixels.size(), after.pixels.size());
    EXPECT_NE(drawn("sides_flipped", out("flipped.glb")).pixels, after.pixels);
    // Not at the limb: a texture that is seen at a glance is filtered along its charts, and these are others.
    const double reach = 0.9 * 54; // of the ball, pixels
    double off = 0, all = 0;
    for (int y = 0; y < before.height; ++y)
        for (int x = 0; x < before.width; ++x)
            for (int c = 0; c < 3 && std::hypot(x - 63.5, y - 63.5) < reach; ++c) {
                off += std::pow(static_cast<double>(before.at(x, y, c)) - static_cast<double>(after.at(x, y, c)), 2);
                all += std::pow(static_cast<double>(before.at(x, y, c)), 2);
            }
    EXPECT_LE(std::sqrt(off / all), 0.01);
    EXPECT_GT(all, 0);
}
#endif
