// tegument fur strands, and strands that are grown for a mesh that has none, as a user meets them.

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "tests/cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

const std::map<std::string, std::string>& ownCache() {
    static const std::map<std::string, std::string> environment = {{"TEGUMENT_CACHE", (scratch() / "strands_cache").string()}};
    return environment;
}

Ran strands(const fs::path& file, std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"fur", "strands", ballMesh(), "-o", file.string(), "--count", "1500"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments);
}

Ran drawStrands(const fs::path& picture, std::vector<std::string> more, const fs::path& effect = "effects/FurCoat.fx") {
    std::vector<std::string> arguments = {"render", effect.string(),  "--size", "96x96",
                                          "-o",     picture.string(), "-D",     "TEGUMENT_MAP_SIZE=64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return tegument::test::tegument(arguments, ownCache());
}

std::vector<float> pixels(const fs::path& picture) {
    const auto image = tegument::loadImage(picture);
    EXPECT_TRUE(image) << picture;
    return image ? image->pixels : std::vector<float>{};
}

} // namespace

TEST(FurStrands, are_a_part_of_the_mesh_that_is_written_with_their_roots_beside_it) {
    const fs::path file = scratch() / "strands.glb";
    const Ran ran = strands(file, {"--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto mesh = tegument::loadMesh(file);
    ASSERT_TRUE(mesh) << tegument::format(mesh.error());
    EXPECT_TRUE(mesh->warnings.empty()) << "texture coordinates of ribbons are none that could overlap";
    const auto part = std::ranges::find(mesh->parts, tegument::kStrandsPart, &tegument::MeshPart::name);
    ASSERT_NE(part, mesh->parts.end());
    EXPECT_EQ(part->indexCount, 1500U * 12 * 3);
    const auto json = ran.json();
    EXPECT_EQ(json["strands"], 1500);
    EXPECT_EQ(json["clusters"], part->clusters.size());
    EXPECT_EQ(json["files"], nlohmann::json({file.string(), (scratch() / "strands.dds").string()}));
    EXPECT_TRUE(fs::exists(scratch() / "strands.dds"));
}

TEST(FurStrands, are_the_same_each_time_and_from_roots_that_are_there) {
    ASSERT_EQ(strands(scratch() / "one.glb").code, 0);
    const fs::path again = scratch() / "again.glb";
    ASSERT_EQ(tegument::test::tegument(
                  {"fur", "strands", ballMesh(), "-o", again.string(), "--roots", (scratch() / "one.dds").string(), "--threads", "1"})
                  .code,
              0);
    EXPECT_FALSE(fs::exists(scratch() / "again.dds")) << "these roots have a file already";
    const auto one = tegument::loadMesh(scratch() / "one.glb");
    const auto two = tegument::loadMesh(again);
    ASSERT_TRUE(one && two);
    EXPECT_EQ(one->uvs, two->uvs);
    EXPECT_EQ(one->tangents, two->tangents);
}

TEST(FurStrands, grow_on_any_mesh_in_one_command_and_as_from_a_file) {
    const fs::path own = scratch() / "own.png";
    const Ran first = drawStrands(own, {"--mesh", ballMesh()});
    ASSERT_EQ(first.code, 0) << first.err;
    EXPECT_NE(first.err.find("made fur roots"), std::string::npos) << first.err;
    const Ran second = drawStrands(scratch() / "own2.png", {"--mesh", ballMesh()});
    EXPECT_EQ(second.err.find("made"), std::string::npos) << second.err;
    EXPECT_EQ(pixels(own), pixels(scratch() / "own2.png"));

    fs::path roots;
    for (const auto& entry : fs::directory_iterator(scratch() / "strands_cache" / "fur" / "made"))
        if (entry.path().filename().string().starts_with("roots_")) roots = entry.path();
    ASSERT_FALSE(roots.empty());
    const fs::path file = scratch() / "grown.glb";
    ASSERT_EQ(tegument::test::tegument({"fur", "strands", ballMesh(), "-o", file.string(), "--roots", roots.string()}).code, 0);
    ASSERT_EQ(drawStrands(scratch() / "file.png", {"--mesh", file.string(), "--set", "gFurRootsMap=" + roots.string()}).code, 0);
    EXPECT_EQ(pixels(own), pixels(scratch() / "file.png"));

    const fs::path fine = scratch() / "fine.glb";
    ASSERT_EQ(
        tegument::test::tegument({"fur", "strands", ballMesh(), "-o", fine.string(), "--roots", roots.string(), "--segments", "12"}).code,
        0);
    ASSERT_EQ(drawStrands(scratch() / "fine.png", {"--mesh", fine.string(), "--set", "gFurRootsMap=" + roots.string()}).code, 0);
    ASSERT_EQ(drawStrands(scratch() / "asked.png", {"--mesh", ballMesh(), "--set", "gCoatSegments=12"}).code, 0);
    EXPECT_EQ(pixels(scratch() / "fine.png"), pixels(scratch() / "asked.png"));
    EXPECT_NE(pixels(scratch() / "fine.png"), pixels(own));
    const Ran none = drawStrands(scratch() / "none.png", {"--mesh", ballMesh(), "--set", "gCoatSegments=0"});
    EXPECT_NE(none.err.find("TG7103"), std::string::npos) << none.err;
}

TEST(FurStrands, that_a_pass_is_not_given_would_not_have_been_drawn) {
    // The same effect without the annotations by which a host leaves strands out.
    const fs::path plain = scratch() / "plain";
    fs::create_directories(plain);
    for (const char* folder : {"effects", "hlsl"})
        fs::copy(folder, plain / folder, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
    const auto named = [](const std::string& line) {
        return std::ranges::any_of(std::array{"#define RIBBON_", "#define LOCK_", "#define STRANDS_SHARE", "#define STRANDS_CORE"},
                                   [&](const char* start) { return line.starts_with(start); });
    };
    for (const char* file : {"fur_ribbons.fxh", "fur_locks.fxh", "fur_root_strands.fxh"}) {
        std::ifstream in(plain / "effects/passes" / file);
        std::string text, line;
        while (std::getline(in, line))
            text += line.substr(0, named(line) ? line.find(' ', 8) : line.size()) + "\n";
        in.close();
        std::ofstream(plain / "effects/passes" / file) << text;
    }
    // Of the last two pass Core draws a part: strands there are about as wide as gRibbonThin.
    struct Drawn {
        const char* technique;
        const char* compiler;
        const char* set;
    };
    for (const auto& [technique, compiler, set] :
         {Drawn{"CoatSoft", "dxc", "gFurShare=1"}, Drawn{"CoatSoft", "dxc", "gFurShare=0.37"},
          Drawn{"CoatSoft", "glslang", "gFurShare=0.37"}, Drawn{"Strands", "dxc", "gFurShare=0.37"},
          Drawn{"CoatSoft", "dxc", "gCoatRadius=0.0065"}, Drawn{"Strands", "dxc", "gFurRadius=0.8"}}) {
        const fs::path some = scratch() / "some.exr", all = scratch() / "all.exr";
        std::vector<std::string> more = {"--mesh", ballMesh(), "-t", technique, "--compiler", compiler, "--set", set};
        for (const char* rows : {"gCoatSegment=0", "gRibbonSegment=0"}) // rows that are left out are seen, if hardly
            more.insert(more.end(), {"--set", rows});
        ASSERT_EQ(drawStrands(some, more).code, 0);
        ASSERT_EQ(drawStrands(all, more, plain / "effects/FurCoat.fx").code, 0);
        EXPECT_EQ(pixels(some), pixels(all)) << technique << ", " << compiler << ", " << set;
    }
}

TEST(FurStrands, are_as_bright_in_several_samples_a_pixel_as_in_one) {
    // From afar a ribbon's triangles are narrower than a pixel, whose centre they do not hold.
    const auto mean = [](const char* technique, const char* samples) {
        const fs::path picture = scratch() / "samples.exr";
        EXPECT_EQ(drawStrands(picture, {"--mesh", ballMesh(), "-t", technique, "--samples", samples}).code, 0);
        double sum = 0;
        for (const float value : pixels(picture))
            sum += value;
        return sum;
    };
    for (const char* technique : {"StrandsSoft", "CoatSoft"}) {
        const double one = mean(technique, "1");
        EXPECT_NEAR(mean(technique, "4") / one, 1, 0.05) << technique << "; light taken at centres of pixels: a quarter less";
    }
}

TEST(FurStrands, by_compute_shaders_are_those_of_vertex_shaders) {
    // Ways aside and colours are halves there, and an axis near a pixel's edge may fall to its other side.
    struct Drawn {
        const char* soft;
        const char* computed;
        const char* compiler;
        const char* set;
    };
    for (const Drawn& one :
         {Drawn{"StrandsSoft", "StrandsCompute", "dxc", "gFurShare=1"}, Drawn{"StrandsSoft", "StrandsCompute", "glslang", "gFurShare=0.4"},
          Drawn{"CoatSoft", "CoatCompute", "dxc", "gCoatSegments=9"}, Drawn{"CoatSoft", "CoatCompute", "dxc", "gCoatUnderfur=0"},
          Drawn{"CoatSoft", "CoatCompute", "glslang", "gCoatChildren=11"}, Drawn{"CoatSoft", "CoatCompute", "dxc", "gFurShare=0.3"}}) {
        const auto drawn = [&](const char* technique) {
            const fs::path picture = scratch() / "computed.exr";
            // Maps that hold the largest of these coats: what does not fit is not drawn.
            EXPECT_EQ(drawStrands(picture, {"--mesh", ballMesh(), "-t", technique, "--compiler", one.compiler, "--set", one.set, "-D",
                                            "TEGUMENT_RIBBON_ROWS=4096"})
                          .code,
                      0);
            return pixels(picture);
        };
        const std::vector<float> asked = drawn(one.soft);
        const std::vector<float> found = drawn(one.computed);
        ASSERT_EQ(asked.size(), found.size());
        double apart = 0, all = 0;
        for (std::size_t i = 0; i < asked.size(); ++i) {
            apart += std::pow(static_cast<double>(found[i]) - static_cast<double>(asked[i]), 2);
            all += std::pow(static_cast<double>(asked[i]), 2);
        }
        EXPECT_LT(std::sqrt(apart / all), 5e-3) << one.computed << ", " << one.compiler << ", " << one.set;
        EXPECT_GT(all, 0) << "there is something to see";
    }
}

TEST(FurStrands, that_compute_shaders_cannot_note_are_an_error_with_the_number_that_is_needed) {
    // Five strands to a root, of four rows each.
    const auto drawn = [](const char* rows) {
        return drawStrands(scratch() / "rows.png",
                           {"--mesh", ballMesh(), "-t", "CoatCompute", "--set", "gCoatChildren=3", "--set", "gCoatUnderfur=2", "-D", rows});
    };
    const Ran fits = drawn("TEGUMENT_RIBBON_ROWS=4096");
    ASSERT_EQ(fits.code, 0) << fits.err;
    const Ran less = drawn("TEGUMENT_RIBBON_ROWS=16");
    ASSERT_EQ(less.code, 1);
    const std::string before = "--set TEGUMENT_RIBBON_ROWS=";
    const std::size_t at = less.err.find(before);
    ASSERT_TRUE(less.err.find("TG4064") != std::string::npos && at != std::string::npos) << less.err;
    const int needed = std::stoi(less.err.substr(at + before.size()));
    EXPECT_EQ(needed % (5 * 4), 0) << "whole rows of roots";
    EXPECT_EQ(drawn(("TEGUMENT_RIBBON_ROWS=" + std::to_string(needed)).c_str()).code, 0);
    EXPECT_EQ(drawn(("TEGUMENT_RIBBON_ROWS=" + std::to_string(needed - 1)).c_str()).code, 1);
    const Ran strands = drawStrands(scratch() / "rows.png", {"--mesh", ballMesh(), "-t", "StrandsCompute", "-D", "TEGUMENT_RIBBON_ROWS=6"});
    EXPECT_NE(strands.err.find("TG4064"), std::string::npos) << "seven rows to a strand: " << strands.err;
}

TEST(FurShells, lit_at_vertices_are_those_lit_at_pixels_where_triangles_are_small) {
    const auto lit = [](const char* vertices) {
        const fs::path picture = scratch() / "shells.exr";
        EXPECT_EQ(drawStrands(picture, {"--mesh", ballMesh(), "--samples", "1", "-D", vertices}, "effects/Fur.fx").code, 0);
        return pixels(picture);
    };
    const std::vector<float> atPixels = lit("TEGUMENT_FUR_VERTEX_LIGHT=0");
    const std::vector<float> atVertices = lit("TEGUMENT_FUR_VERTEX_LIGHT=1");
    ASSERT_EQ(atPixels.size(), atVertices.size());
    double apart = 0, all = 0;
    for (std::size_t i = 0; i < atPixels.size(); ++i) {
        apart += std::pow(static_cast<double>(atVertices[i]) - static_cast<double>(atPixels[i]), 2);
        all += std::pow(static_cast<double>(atPixels[i]), 2);
    }
    EXPECT_GT(apart, 0) << "the switch does something";
    EXPECT_LT(std::sqrt(apart / all), 0.05) << "the Bunny, with smaller triangles, has 0.025";
}

TEST(FurStrands, stand_still_without_wind_and_sway_in_it_with_its_period) {
    const auto at = [](const char* wind, const char* time) {
        const fs::path picture = scratch() / "wind.exr";
        EXPECT_EQ(drawStrands(picture, {"--mesh", ballMesh(), "--samples", "1", "--set", std::string("gCoatWind=") + wind, "--set",
                                        "gCoatGusts=0.5,0.5,0.8", "--set", std::string("gTime=") + time})
                      .code,
                  0);
        return pixels(picture);
    };
    const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0;
        for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
            sum += std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
        return sum;
    };
    const auto still = at("0,0,0", "0");
    EXPECT_EQ(still, at("0,0,0", "0.7"));
    const auto blown = at("0.4,0,0.1", "0.25");
    EXPECT_GT(apart(blown, still), 0);
    const double swayed = apart(blown, at("0.4,0,0.1", "1.25"));
    EXPECT_GT(swayed, 0);
    // Half a gust a second: after two seconds all is as before, but for the rounding of the phase, which turns single pixels.
    EXPECT_LT(apart(blown, at("0.4,0,0.1", "2.25")), 0.05 * swayed);
}

TEST(FurStrands, find_their_roots_beside_their_file_and_refuse_others) {
    const fs::path file = scratch() / "beside.glb";
    ASSERT_EQ(strands(file).code, 0);
    EXPECT_EQ(drawStrands(scratch() / "beside.png", {"--mesh", file.string()}).code, 0);

    ASSERT_EQ(
        tegument::test::tegument({"fur", "roots", ballMesh(), "-o", (scratch() / "other.dds").string(), "--count", "1500", "--seed", "7"})
            .code,
        0);
    const Ran other =
        drawStrands(scratch() / "x.png", {"--mesh", file.string(), "--set", "gFurRootsMap=" + (scratch() / "other.dds").string()});
    EXPECT_EQ(other.code, 1);
    for (const char* text : {"TG4061", "other roots", "gFurRootsMap", "--set"})
        EXPECT_NE(other.err.find(text), std::string::npos) << text << " in " << other.err;

    fs::remove(scratch() / "beside.dds");
    const Ran alone = drawStrands(scratch() / "y.png", {"--mesh", file.string()});
    EXPECT_EQ(alone.code, 1);
    EXPECT_NE(alone.err.find("TG4061"), std::string::npos) << alone.err;
}

TEST(FurStrands, of_no_roots_no_mesh_or_no_segments_are_refused_and_nothing_is_written) {
    const fs::path file = scratch() / "none.glb";
    const std::string picture = write("no_roots.dds", "DDS ");
    EXPECT_EQ(strands(file, {"--roots", picture}).code, 1);
    EXPECT_EQ(strands(file, {"--roots", "no such file.dds"}).code, 2);
    EXPECT_EQ(strands(file, {"--segments", "0"}).code, 2);
    EXPECT_EQ(strands(file, {"--color-map", "no such file.png"}).code, 2);
    EXPECT_EQ(tegument::test::tegument({"fur", "strands", "no such mesh.glb", "-o", file.string()}).code, 2);
    EXPECT_EQ(tegument::test::tegument({"fur", "strands", ballMesh(), "-o", (scratch() / "x.obj").string()}).code, 2);
    EXPECT_FALSE(fs::exists(file));
}

TEST(FurStrands, take_the_colours_of_a_scan) {
    const fs::path mesh = scratch() / "painted.ply";
    std::ofstream(mesh) << "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
                           "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
                           "property list uchar int vertex_indices\nend_header\n"
                           "0 0 0 255 0 188\n100 0 0 255 0 188\n100 100 0 255 0 188\n0 100 0 255 0 188\n4 0 1 2 3\n";
    const fs::path file = scratch() / "painted.glb";
    const Ran ran = tegument::test::tegument(
        {"fur", "strands", mesh.string(), "-o", file.string(), "--count", "50", "--color-attribute", "red,green,blue"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    const auto read = tegument::loadMesh(file);
    ASSERT_TRUE(read);
    // (1, 0, 0.5 linear) as steps of roots: 31, 0, round(31 sqrt(0.5)) = 22
    const float code = std::floor(read->uvs.back().x / 16);
    EXPECT_EQ(code, 31 + 32 * (0 + 32 * 22));
}
