// tegument fur info, import and export as a user meets them, and imported strands drawn.

#include "host/image/image.h"
#include "meshprep/groom/groom_file.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

constexpr int kStrands = 600;

/// Straight strands of 60 mm round ballMesh(), each a line of an OBJ file, bent down at their tips; `aside` moves all of them, mm.
std::string groomOfBall(const std::string& name, double aside = 0) {
    std::string text;
    for (int i = 0; i < kStrands; ++i) {
        const double up = 1 - 2 * (i + 0.5) / kStrands, around = 2.39996 * i, flat = std::sqrt(1 - up * up);
        for (int k = 0; k < 8; ++k) {
            const double far = 110 + 60 * k / 7.0;
            text += "v " + std::to_string(aside + far * flat * std::cos(around)) + " " + std::to_string(far * up - 20 * k * k / 49.0) +
                    " " + std::to_string(far * flat * std::sin(around)) + "\n";
        }
        text += "l -8 -7 -6 -5 -4 -3 -2 -1\n";
    }
    return write(name, text);
}

Ran fur(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "fur");
    return tegument::test::tegument(arguments);
}

/// Pixels of a picture that show something, and their mean brightness.
std::pair<std::size_t, double> shown(const fs::path& picture) {
    const auto image = tegument::loadImage(picture);
    if (!image) return {};
    std::size_t count = 0;
    double sum = 0;
    const auto channels = static_cast<std::size_t>(image->channels);
    for (std::size_t i = 0; i < image->pixels.size(); i += channels) {
        const bool covered = channels < 4 || image->pixels[i + 3] > 0.02F;
        count += covered;
        if (covered) sum += static_cast<double>(image->pixels[i + 1]);
    }
    return {count, count > 0 ? sum / static_cast<double>(count) : 0};
}

Ran draw(const fs::path& mesh, const std::string& technique, const fs::path& picture) {
    return tegument::test::tegument({"render", "effects/FurCoat.fx", "-t", technique, "--mesh", mesh.string(), "--size", "128x128", "-D",
                                     "TEGUMENT_MAP_SIZE=64", "-o", picture.string()},
                                    {{"TEGUMENT_CACHE", (scratch() / "groom_cache").string()}});
}

} // namespace

TEST(FurGroom, is_told_of_in_millimetres) {
    const Ran ran = fur({"info", groomOfBall("info.obj"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = ran.json();
    EXPECT_EQ(json["strands"], kStrands);
    EXPECT_EQ(json["points"], 8 * kStrands);
    EXPECT_NEAR(json["length_mm"][1].get<double>(), 65, 8);
    EXPECT_EQ(json["spline"], "linear");
    const Ran inches = fur({"info", groomOfBall("info.obj"), "--unit-mm", "25.4", "--json"});
    EXPECT_NEAR(inches.json()["length_mm"][1].get<double>(), 25.4 * json["length_mm"][1].get<double>(), 1);
    EXPECT_NE(fur({"info", groomOfBall("info.obj")}).out.find("600 strands"), std::string::npos);
    EXPECT_TRUE(
        fur({"info", write("one.obj", "v 0 0 0\nv 0 9 0\nl 1 2\n")}).out.starts_with("1 strand, 0 of them guides; 2 control points"));
}

TEST(FurGroom, is_bound_to_a_skin_and_drawn_by_every_technique_that_takes_curves) {
    const fs::path mesh = scratch() / "bound.glb";
    const Ran ran =
        fur({"import", groomOfBall("ball_groom.obj"), "--mesh", ballMesh(), "--width", "1", "--snap", "20", "-o", mesh.string(), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto json = ran.json();
    EXPECT_EQ(json["strands"], kStrands);
    EXPECT_EQ(json["off_the_skin"], 0);
    EXPECT_LT(json["error_mm"].get<double>(), 0.1);
    EXPECT_EQ(json["files"][1], (scratch() / "bound.dds").string());
    for (const std::string technique : {"Strands", "StrandsSoft", "Coat", "CoatSoft", "CoatChance"}) {
        const fs::path picture = scratch() / ("bound_" + technique + ".png");
        const Ran drawn = draw(mesh, technique, picture);
        ASSERT_EQ(drawn.code, 0) << technique << drawn.err;
        const auto [count, brightness] = shown(picture);
        EXPECT_GT(count, 128U * 128 / 5) << technique << ": strands of half a radius beyond the ball";
        EXPECT_GT(brightness, 0.02) << technique;
    }
}

TEST(FurGroom, that_stands_off_the_skin_is_counted) {
    const Ran ran = fur({"import", groomOfBall("aside.obj", 40), "--mesh", ballMesh(), "-o", out("aside.glb"), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_GT(ran.json()["off_the_skin"], kStrands / 2);
    EXPECT_LT(ran.json()["off_the_skin"], kStrands);
    const Ran all = fur({"import", groomOfBall("aside.obj", 40), "--mesh", ballMesh(), "--snap", "100", "-o", out("aside.glb"), "--json"});
    EXPECT_EQ(all.json()["off_the_skin"], 0);
}

TEST(FurGroom, goes_out_as_it_came_in_and_a_coat_of_ours_too) {
    const std::string groom = groomOfBall("through.obj");
    for (const std::string ending : {"abc", "usda", "hair", "tfx", "glb", "ply"}) {
        const std::string file = out("through." + ending);
        const Ran ran = fur({"export", groom, "-o", file});
        ASSERT_EQ(ran.code, 0) << ran.err;
        const auto one = fur({"info", groom, "--json"}).json(), two = fur({"info", file, "--json"}).json();
        EXPECT_EQ(one["strands"], two["strands"]) << ending;
        EXPECT_NEAR(one["length_mm"][2].get<double>(), two["length_mm"][2].get<double>(), 1e-3) << ending;
        EXPECT_NEAR(one["high_mm"][1].get<double>(), two["high_mm"][1].get<double>(), 1e-3) << ending;
    }
    ASSERT_EQ(fur({"strands", ballMesh(), "-o", out("coat.glb"), "--count", "500"}).code, 0);
    ASSERT_EQ(fur({"export", out("coat.glb"), "--length", "0.1", "-o", out("coat.abc")}).code, 0);
    const auto coat = fur({"info", out("coat.abc"), "--json"}).json();
    EXPECT_EQ(coat["strands"], 500);
    EXPECT_NEAR(coat["length_mm"][2].get<double>(), 11, 1) << "a tenth of the ball's radius of 110 mm";
    ASSERT_EQ(fur({"import", out("coat.abc"), "--mesh", ballMesh(), "-o", out("coat_again.glb")}).code, 0);
    EXPECT_EQ(fur({"export", out("coat_again.glb"), "-o", out("coat_again.usda")}).code, 0);
}

TEST(FurGroom, of_what_is_none_is_refused_and_meshes_lead_to_it) {
    expectSaid(fur({"info", write("no.hair", "HARE")}), kInput, {"TG5302"});
    expectSaid(fur({"info", write("no.fbx", "Kaydara")}), kInput, {"TG5340", ".abc"});
    expectSaid(fur({"info", ballMesh()}), kInput, {"TG5341"});
    expectSaid(fur({"info", groomOfBall("share.obj"), "--share", "0"}), kUsage, {"TG8052"});
    expectSaid(fur({"export", groomOfBall("share.obj"), "-o", out("x.fbx")}), kUsage, {"TG8024"});
    expectSaid(fur({"export", groomOfBall("share.obj"), "-o", groomOfBall("share.obj")}), kUsage, {"TG5004"});
    EXPECT_EQ(fur({"info", groomOfBall("share.obj"), "--share", "0.25", "--json"}).json()["strands"], kStrands / 4);
    expectSaid(tegument::test::tegument({"render", "FurCoat", "--mesh", write("a.abc", "Ogawa"), "-o", out("x.png")}), kInput,
               {"TG5300", "tegument fur import"});
    expectSaid(tegument::test::tegument({"render", "FurCoat", "--mesh", groomOfBall("lines.obj"), "-o", out("x.png")}), kInput,
               {"TG5306", "tegument fur import"});
}
