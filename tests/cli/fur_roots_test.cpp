// tegument fur roots, as a user runs it.

#include "host/image/dds.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

Ran roots(std::vector<std::string> more) {
    std::vector<std::string> arguments = {"fur", "roots", ballMesh()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments);
}

} // namespace

TEST(FurRoots, write_a_float_texture_and_say_what_is_in_it) {
    const fs::path file = scratch() / "roots.dds";
    const Ran ran = roots({"-o", file.string(), "--count", "2000", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto texture = tegument::loadDds(file);
    ASSERT_TRUE(texture);
    EXPECT_EQ(texture->format, tegument::DdsFormat::Rgba32F);
    EXPECT_EQ(texture->mips, 1);
    EXPECT_EQ(texture->at(0, 0).width, 4096);
    EXPECT_EQ(texture->at(0, 0).at(2, 0, 0), static_cast<float>(texture->at(0, 0).height)) << "texel 2 names the rows";
    auto json = ran.json();
    EXPECT_EQ(json["roots"], 2000);
    EXPECT_EQ(json["files"].size(), 2U);
    json.erase("files"); // of this run, not of what is in the texture
    EXPECT_EQ(json["texture"]["height"], texture->at(0, 0).height);
    std::ifstream beside(scratch() / "roots.json");
    EXPECT_EQ(nlohmann::json::parse(beside, nullptr, false), json) << "the file beside the texture says the same";
}

TEST(FurRoots, are_the_same_each_time) {
    const fs::path a = scratch() / "a.dds";
    const fs::path b = scratch() / "b.dds";
    ASSERT_EQ(roots({"-o", a.string(), "--count", "1000"}).code, 0);
    ASSERT_EQ(roots({"-o", b.string(), "--count", "1000", "--threads", "1"}).code, 0);
    EXPECT_EQ(tegument::loadDds(a)->at(0, 0).pixels, tegument::loadDds(b)->at(0, 0).pixels);
}

TEST(FurRoots, of_a_billion_are_refused_and_nothing_is_written) {
    const fs::path file = scratch() / "billion.dds";
    const Ran ran = roots({"-o", file.string(), "--count", "1000000000"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("TG7104"), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(file));
}

TEST(FurRoots, of_a_cloud_of_points_or_a_missing_map_are_refused) {
    const std::string points = write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n");
    EXPECT_EQ(tegument::test::tegument({"fur", "roots", points, "-o", (scratch() / "x.dds").string()}).code, 1);
    const Ran ran = roots({"--length-map", "no such file.png"});
    EXPECT_EQ(ran.code, 2);
    EXPECT_NE(ran.err.find("no such file.png"), std::string::npos) << ran.err;
}

TEST(FurRoots, take_their_density_from_a_property_of_the_vertices) {
    const fs::path mesh = scratch() / "painted.ply";
    std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                           "property float quality\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0.25\n100 0 0 0.25\n100 100 0 0.25\n0 100 0 0.25\n4 0 1 2 3\n";
    const fs::path file = scratch() / "painted.dds";
    const Ran ran = tegument::test::tegument(
        {"fur", "roots", mesh.string(), "-o", file.string(), "--count", "2000", "--density-attribute", "quality", "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.json()["roots"], 500);

    const fs::path other = scratch() / "unknown.dds";
    const Ran unknown = tegument::test::tegument({"fur", "roots", mesh.string(), "-o", other.string(), "--length-attribute", "length"});
    EXPECT_EQ(unknown.code, 1);
    EXPECT_NE(unknown.err.find("TG5313"), std::string::npos) << unknown.err;
    EXPECT_NE(unknown.err.find("x, y, z, quality"), std::string::npos) << unknown.err;
    EXPECT_FALSE(fs::exists(other));
}
