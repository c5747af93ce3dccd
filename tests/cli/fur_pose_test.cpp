// Fur on a body that bends, and motion vectors of fur, as a user meets them.

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/scene/view.h"
#include "tests/cli/program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>

using namespace tegument;
using namespace tegument::test;
namespace fs = std::filesystem;

namespace {

constexpr int kSide = 160;
using Words = std::vector<std::string>;

/// The ball, its vertices moved.
std::string posedBall(const std::string& name, const std::function<glm::dvec3(const glm::dvec3&)>& place) {
    std::ifstream in(ballMesh());
    std::string text, line;
    while (std::getline(in, line)) {
        glm::dvec3 p(0);
        const bool vertex = std::sscanf(line.c_str(), "v %lf %lf %lf", &p.x, &p.y, &p.z) == 3;
        if (line.starts_with("vn ")) continue; // they are made anew
        const glm::dvec3 now = vertex ? place(p) : p;
        text += vertex ? fmt::format("v {:.9g} {:.9g} {:.9g}\n", now.x, now.y, now.z) : line + "\n";
    }
    return write(name, text);
}

glm::dvec3 same(const glm::dvec3& p) {
    return p;
}

/// Its upper half leans over.
glm::dvec3 leaning(const glm::dvec3& p) {
    const double angle = 0.005 * std::max(p.y, 0.0);
    return {p.x * std::cos(angle) + p.y * std::sin(angle), p.y * std::cos(angle) - p.x * std::sin(angle), p.z};
}

/// Roots of the ball at rest: few, for they are drawn often.
const std::string& fewRoots() {
    static const std::string kRoots = [] {
        const fs::path file = scratch() / "few_roots.dds";
        EXPECT_EQ(test::tegument({"fur", "roots", posedBall("rest.obj", same), "-o", file.string(), "--count", "1500"}).code, 0);
        return file.string();
    }();
    return kRoots;
}

Ran drawPose(const fs::path& picture, Words more) {
    Words arguments = {"render", "FurCoat", "--size", fmt::format("{0}x{0}", kSide), "-o", picture.string(), "-D", "TEGUMENT_MAP_SIZE=128"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::tegument(arguments, {{"TEGUMENT_CACHE", (scratch() / "pose_cache").string()}});
}

std::vector<float> picture(Words more) {
    const fs::path file = scratch() / "posed.exr";
    const Ran ran = drawPose(file, std::move(more));
    EXPECT_EQ(ran.code, 0) << ran.err;
    const auto image = loadImage(file);
    return image ? image->pixels : std::vector<float>{};
}

double valuesApart(const std::vector<float>& a, const std::vector<float>& b) {
    double off = 0, all = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        off += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2);
        all += std::pow(static_cast<double>(b[i]), 2);
    }
    return std::sqrt(off / all);
}

} // namespace

TEST(FurPose, at_rest_draws_the_same_bits) {
    const std::string rest = posedBall("rest.obj", same);
    for (const char* technique : {"CoatSoft", "Strands", "CoatCompute"}) {
        const auto plain = picture({"--mesh", rest, "-t", technique});
        ASSERT_FALSE(plain.empty());
        EXPECT_EQ(plain, picture({"--mesh", rest, "--pose", rest, "-t", technique})) << technique;
    }
}

TEST(FurPose, that_turns_the_body_is_the_body_turned) {
    // About the vertical, and the scene back: light, camera and gravity stand as they stood. What is left: positions of floats, and the
    // maps of light, whose texels lie elsewhere.
    const glm::dmat3 turn(glm::rotate(glm::dmat4(1), glm::radians(70.0), glm::dvec3(0, 1, 0)));
    const std::string rest = posedBall("rest.obj", same);
    const std::string turned = posedBall("turned.obj", [&](const glm::dvec3& p) { return turn * p; });
    for (const char* technique : {"CoatSoft", "StrandsSoft", "CoatCompute"}) {
        const Words scene = {"--mesh", rest, "-t", technique, "--set", "gCoatBelly=0", "--set", "gFurRootsMap=" + fewRoots()};
        const auto with = [&](Words more) {
            more.insert(more.begin(), scene.begin(), scene.end());
            return picture(more);
        };
        const auto plain = with({});
        const auto back = with({"--pose", turned, "--turn", "-70"});
        const auto astray = with({"--turn", "-70"});
        EXPECT_LT(valuesApart(back, plain), 0.1) << technique;
        EXPECT_GT(valuesApart(astray, plain), 0.2) << technique << ": the ball's bumps and its coat show which way it stands";
    }
}

TEST(FurPose, that_bends_the_body_takes_its_coat_along) {
    // Where the skin is drawn strands stand: the bent body in plain colour is covered as its fur is.
    const std::string rest = posedBall("rest.obj", same);
    const std::string bent = posedBall("bent.obj", leaning);
    const auto grown = picture({"--mesh", bent});
    const auto posed = picture({"--mesh", rest, "--pose", bent});
    const auto still = picture({"--mesh", rest});
    double differs = 0, stays = 0;
    for (std::size_t i = 3; i < grown.size(); i += 4) {
        differs += std::abs(static_cast<double>(grown[i]) - static_cast<double>(posed[i]));
        stays += std::abs(static_cast<double>(grown[i]) - static_cast<double>(still[i]));
    }
    EXPECT_LT(differs, 0.25 * stays) << "outlines: other strands of the same coat";
}

TEST(FurPose, of_other_triangles_or_for_other_effects_is_refused) {
    const std::string rest = posedBall("rest.obj", same);
    const std::string other = write("other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const Ran mismatch = drawPose(scratch() / "x.png", {"--mesh", rest, "--pose", other});
    EXPECT_EQ(mismatch.code, 1);
    EXPECT_NE(mismatch.err.find("TG8048"), std::string::npos) << mismatch.err;
    const Ran missing = drawPose(scratch() / "x.png", {"--mesh", rest, "--pose", "no such.obj"});
    EXPECT_EQ(missing.code, 2);
    const Ran bald = test::tegument({"render", "Fur", "--mesh", rest, "--pose", rest, "-o", (scratch() / "x.png").string()});
    EXPECT_EQ(bald.code, 2);
    EXPECT_NE(bald.err.find("TG8047"), std::string::npos) << bald.err;
}

TEST(FurPose, is_written_for_engines_by_one_command) {
    const std::string rest = posedBall("rest.obj", same);
    const std::string bent = posedBall("bent.obj", leaning);
    const fs::path roots = scratch() / "pose_roots.dds", pose = scratch() / "pose.dds", seats = scratch() / "seats.dds";
    ASSERT_EQ(test::tegument({"fur", "roots", rest, "-o", roots.string(), "--count", "1500"}).code, 0);
    const Ran ran =
        test::tegument({"fur", "pose", rest, bent, "--roots", roots.string(), "-o", pose.string(), "--seats", seats.string(), "--json"});
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_EQ(ran.json()["roots"], 1500);
    EXPECT_EQ(ran.json()["lost"], 0);
    for (const fs::path& file : {pose, seats}) {
        const auto image = loadImage(file);
        ASSERT_TRUE(image) << file;
        EXPECT_EQ(image->width, 4096);
    }
    const Ran given = drawPose(scratch() / "given.png", {"--mesh", rest, "-D", "TEGUMENT_FUR_POSE", "--set",
                                                         "gFurRootsMap=" + roots.string(), "--set", "gFurPoseMap=" + pose.string()});
    EXPECT_EQ(given.code, 0) << given.err;
}

namespace {

constexpr float kFov = 9; // so near that strands are longer than ten pixels

/// A frame of the coat: what a test sets of it.
struct Frame {
    glm::dmat4 world{1};
    glm::dvec3 eye{0, 30, 420};
    std::string pose;
    std::string wind = "0,0,0";
    double time = 0;
};

Matrices camera(const Frame& frame) {
    Camera camera;
    camera.position = glm::vec3(frame.eye);
    camera.target = {0, 0, 0};
    camera.horizontalFov = kFov;
    camera.nearPlane = 50;
    camera.farPlane = 2000;
    return cameraMatrices(camera, 1);
}

/// Rows of the row-vector matrix: GLM's memory (host/scene/view.h).
std::string numbers(const glm::dmat4& rows) {
    std::vector<double> all;
    for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j)
            all.push_back(rows[i][j]);
    return fmt::format("{:.9g}", fmt::join(all, ","));
}

Words sceneOf(const Frame& frame, const std::string& mesh, const std::string& roots) {
    const std::string file = write("frame.json", fmt::format(R"({{"mesh": "{}", "unit_mm": 1, "head": false,
 "camera": {{"position": [{:.9g}, {:.9g}, {:.9g}], "target": [0, 0, 0], "horizontal_fov": {}, "near": 50, "far": 2000, "frame": "world"}},
 "textures": {{"gFurRootsMap": "{}"}}}})",
                                                             mesh, frame.eye.x, frame.eye.y, frame.eye.z, kFov, roots));
    Words words = {"-w", file, "--samples", "1", "-D", "TEGUMENT_RIBBON_ROWS=256", "-D", "TEGUMENT_MOTION"};
    const auto set = [&](const std::string& value) { words.insert(words.end(), {"--set", value}); };
    set("gWorld=" + numbers(frame.world));
    set("gWorldInverseTranspose=" + numbers(glm::transpose(glm::inverse(frame.world))));
    // A host binds where the ball's bounds stand in the world.
    const auto read = loadMesh(mesh);
    EXPECT_TRUE(read);
    const glm::dvec3 centre(frame.world * glm::dvec4(read ? glm::dvec3(read->bounds.centre) : glm::dvec3(0), 1));
    set(fmt::format("gBoundingCenter={:.9g},{:.9g},{:.9g}", centre.x, centre.y, centre.z));
    set("gCoatWind=" + frame.wind);
    set(fmt::format("gTime={}", frame.time));
    if (!frame.pose.empty()) words.insert(words.end(), {"--pose", frame.pose});
    return words;
}

glm::dvec4 clipOf(const Matrices& camera, const glm::dvec3& p) {
    return glm::dmat4(camera.viewProjection) * glm::dvec4(p, 1);
}

glm::dvec2 pixelOf(const glm::dvec4& clip) {
    return (glm::dvec2(clip) / clip.w * glm::dvec2(0.5, -0.5) + 0.5) * static_cast<double>(kSide);
}

/// Targets of a frame that is drawn by compute shaders, which note every row of every strand.
std::map<std::string, Image> targetsOf(const Frame& frame, const std::string& technique, Words more) {
    const std::string rest = posedBall("rest.obj", same);
    const Words scene = sceneOf(frame, rest, fewRoots());
    more.insert(more.begin(), scene.begin(), scene.end());
    more.insert(more.end(), {"-t", technique, "--json", "--dump", "gMotionMap", "--dump", "gMotionDepthMap", "--dump", "gRibbonPlaceMap"});
    const Ran ran = drawPose(scratch() / "motion.exr", more);
    EXPECT_EQ(ran.code, 0) << ran.err;
    std::map<std::string, Image> targets;
    const auto report = ran.json();
    for (const char* name : {"gMotionMap", "gMotionDepthMap", "gRibbonPlaceMap"}) {
        const auto image = loadImage(report["dumped"][name].get<std::string>());
        EXPECT_TRUE(image) << name;
        if (image) targets[name] = *image;
    }
    return targets;
}

/// Distances of motion vectors from the differences of positions, pixels, rising; and how far things moved.
struct Compared {
    std::vector<double> off;
    double moved = 0; // median
};

double median(std::vector<double> values, double share = 0.5) {
    if (values.empty()) return std::nan("");
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

Compared compare(const Frame& now, const Frame& before, const std::string& technique) {
    Words step = {"--set", "gPreviousWorld=" + numbers(before.world),
                  "--set", "gPreviousViewProjection=" + numbers(glm::dmat4(camera(before).viewProjection)),
                  "--set", fmt::format("gTimeStep={}", now.time - before.time)};
    if (now.wind != before.wind) step.insert(step.end(), {"--set", "gCoatWindChange=" + now.wind}); // from none
    if (!before.pose.empty()) step.insert(step.end(), {"--pose-before", before.pose});
    auto shown = targetsOf(now, technique, step);
    auto then = targetsOf(before, technique, {});
    const Image& places = shown["gRibbonPlaceMap"];
    const Image& earlier = then["gRibbonPlaceMap"];
    const Matrices eye = camera(now);
    const std::size_t rows = technique == "CoatCompute" ? 4 : 7; // of a strand's six segments, every second one in a lock
    Compared compared;
    std::vector<double> lengths;
    for (std::size_t i = 0; i + 3 < std::min(places.pixels.size(), earlier.pixels.size()); i += 4) {
        const float* a = &places.pixels[i];
        const float* b = &earlier.pixels[i];
        const bool root = i / 4 / static_cast<std::size_t>(places.width) % rows == 0;
        if (root || !(a[3] > 0) || !(b[3] > 0)) continue; // at its root the skin is as near
        const glm::dvec4 clip = clipOf(eye, {a[0], a[1], a[2]});
        const glm::dvec2 pixel = pixelOf(clip);
        const glm::ivec2 at(glm::floor(pixel));
        if (at.x < 0 || at.y < 0 || at.x >= kSide || at.y >= kSide) continue;
        const double depth = static_cast<double>(shown["gMotionDepthMap"].at(at.x, at.y, 0));
        // z / w = f / (f - n) (1 - n / w)
        const double distance = 50 / (1 - depth * (2000.0 - 50) / 2000);
        // Else another strand is seen there. Those of a lock stand close, and move each by itself.
        const bool lock = technique == "CoatCompute";
        if (std::abs(distance - clip.w) > (lock ? 0.3 : 1.0) * static_cast<double>(a[3])) continue;
        if (glm::distance(pixel, glm::dvec2(at) + 0.5) > (lock ? 0.4 : 0.71)) continue;
        const glm::dvec2 moved = pixel - pixelOf(clipOf(camera(before), {b[0], b[1], b[2]}));
        const glm::dvec2 found(shown["gMotionMap"].at(at.x, at.y, 0), shown["gMotionMap"].at(at.x, at.y, 1));
        compared.off.push_back(glm::distance(moved, found));
        lengths.push_back(glm::length(moved));
    }
    compared.moved = median(lengths);
    return compared;
}

} // namespace

TEST(FurMotion, is_the_difference_of_positions_of_two_frames) {
    const glm::dmat4 turned =
        glm::translate(glm::rotate(glm::dmat4(1), 0.03, glm::normalize(glm::dvec3(0.2, 1, 0.1))), glm::dvec3(2, 1, -3));
    const std::string rest = posedBall("rest.obj", same),
                      bent = posedBall("bent.obj", [](const glm::dvec3&p) { return leaning(p) * 1.01; });
    struct Case {
        const char* name;
        Frame now;
        Frame before;
    };
    for (const Case& one :
         {Case{"camera", {.eye = {8, 30, 418}}, {}}, Case{"world", {}, {.world = turned}},
          Case{"wind", {.wind = "0.35,0.1,0", .time = 0.4}, {.time = 0.3}},
          Case{"gusts", {.wind = "0.5,0.1,0.1", .time = 0.6}, {.wind = "0.5,0.1,0.1", .time = 0.2}},
          Case{"pose", {.pose = bent}, {.pose = rest}},
          Case{"all", {.eye = {3, 30, 418}, .pose = bent, .wind = "0.2,0,0", .time = 0.4}, {.world = turned, .pose = rest, .time = 0.3}}}) {
        for (const char* technique : {"CoatCompute", "StrandsCompute"}) {
            const bool blown = one.name == std::string("wind") || one.name == std::string("gusts");
            if (blown && technique == std::string("StrandsCompute")) continue; // wind moves locks
            const Compared compared = compare(one.now, one.before, technique);
            ASSERT_GT(compared.off.size(), 50U) << one.name << " " << technique;
            EXPECT_GT(compared.moved, 0.3) << one.name << " " << technique;
            // A pixel's centre is up to 0.7 pixels from the place, and of a strand of 15 pixels the tip moves twice as far as the mean. A
            // half holds 8 pixels to 0.004. Without one of the parts that move the median is as large as what that part moves.
            EXPECT_LT(median(compared.off), 0.02 + 0.06 * compared.moved) << one.name << " " << technique << " of " << compared.moved;
            EXPECT_LT(median(compared.off, 0.9), 0.1 + 0.4 * compared.moved) << one.name << " " << technique << " of " << compared.moved;
        }
    }
}

TEST(FurMotion, is_nothing_where_all_stands_still_and_is_not_there_unless_asked) {
    const Frame still{.wind = "0.3,0,0", .time = 0.5};
    auto shown = targetsOf(still, "CoatCompute", {});
    // Now and before are the same sums; a compiler that multiplies and adds with one rounding may do so in one of them alone. Floats of
    // some 300 mm are 3e-5 mm apart, which is 2e-5 pixels here; a half holds 6e-8 of them.
    for (const float value : shown["gMotionMap"].pixels)
        ASSERT_LT(std::abs(value), 1e-4);
    EXPECT_TRUE(std::ranges::any_of(shown["gMotionDepthMap"].pixels, [](float depth) { return depth < 1; }));
    const Ran plain = drawPose(scratch() / "plain.exr", {"--mesh", posedBall("rest.obj", same), "--json"});
    ASSERT_EQ(plain.code, 0) << plain.err;
    EXPECT_EQ(plain.out.find("otion"), std::string::npos) << "neither passes nor targets";
}
