// The whole way through the house on a mesh that every machine has: what the program draws obeys the laws of the model.
// `--samples`: one is at pixels' centres, several smooth edges, others are refused.
// `render --turntable -o x.webp` and `x.mp4`, read again by libwebp's decoder and by ffmpeg.

#include "host/support/file.h"
#include "tests/cli/picture.h"
#include "tests/cli/program.h"
#include "tools/process/process.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <webp/demux.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

using namespace tegument::test;
using ::tegument::Image;
namespace fs = std::filesystem;

namespace {

Picture head(const std::string& name, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"effects/Main.fx", "-w", ballWorkspace(), "--size", "256x256", "--map-size", "512"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return render(name, arguments);
}

bool finite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); });
}

double mean(const Image& image) {
    return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0) / static_cast<double>(image.pixels.size());
}

/// Share of values that differ by more than `limit`.
double shareBeyond(const Image& a, const Image& b, double limit) {
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    std::size_t beyond = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        beyond += std::abs(a.pixels[i] - b.pixels[i]) > limit;
    return static_cast<double>(beyond) / static_cast<double>(a.pixels.size());
}

/// Largest distance from `expected` over what the charts cover (alpha 1).
double largestError(const Image& image, const std::array<double, 3>& expected) {
    double largest = 0;
    std::size_t covered = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (image.at(x, y, 3) < 0.5F) continue;
            ++covered;
            for (int c = 0; c < 3; ++c)
                largest = std::max(largest, std::abs(image.at(x, y, c) - expected[static_cast<std::size_t>(c)]));
        }
    }
    EXPECT_GT(covered, image.pixels.size() / 8) << "the charts cover less than half of the map";
    return largest;
}

/// d'Eon and Luebke's table, written out again: the shader's own copy is what is tested.
constexpr double kWeights[6][3] = {{.233, .455, .649}, {.100, .336, .344}, {.118, .198, 0},
                                   {.113, .007, .007}, {.358, .004, 0},    {.078, 0, 0}};

/// Sum of the weights, each pass multiplying by `gain`: Gaussian i has seen 2 (i - 1) passes.
std::array<double, 3> whiteSum(double gain) {
    std::array<double, 3> sum{};
    for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            sum[c] += kWeights[i][c] * std::pow(gain, 2.0 * static_cast<double>(i));
    return sum;
}

Picture white(const std::string& setting, int bits, const std::string& technique = "White", int repair = 1) {
    return render(fmt::format("{}-{}-{}-{}", technique, setting, bits, repair),
                  {"effects/Convolution.fx", "-w", ballWorkspace(), "--technique", technique, "--setting", setting, "--size", "256x256",
                   "--map-size", "256", "-D", fmt::format("TEGUMENT_MAP_BITS={}", bits), "-D",
                   fmt::format("TEGUMENT_SEAM_REPAIR={}", repair)});
}

std::vector<std::string> ball(const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments = {"effects/OriginalTexture.fx", "-w", ballWorkspace(), "--size", "64x64"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
}

Ran renderTo(const fs::path& path, const std::string& samples) {
    std::vector<std::string> arguments = {"render", "-o", path.string()};
    for (const std::string& argument : ball({"--samples", samples}))
        arguments.push_back(argument);
    return tegument::test::tegument(arguments);
}

struct Shown {
    int milliseconds = 0;
    std::vector<unsigned char> rgba;
};

struct Animated {
    WebPAnimInfo info{};
    std::vector<Shown> pictures;
};

Animated readWebp(const fs::path& path) {
    const auto bytes = tegument::readFile(path);
    EXPECT_TRUE(bytes) << path;
    Animated animated;
    const WebPData data{reinterpret_cast<const unsigned char*>(bytes->data()), bytes->size()};
    const std::unique_ptr<WebPAnimDecoder, void (*)(WebPAnimDecoder*)> decoder(WebPAnimDecoderNew(&data, nullptr), WebPAnimDecoderDelete);
    EXPECT_TRUE(decoder && WebPAnimDecoderGetInfo(decoder.get(), &animated.info)) << path;
    int before = 0;
    while (decoder && WebPAnimDecoderHasMoreFrames(decoder.get())) {
        unsigned char* rgba = nullptr;
        int end = 0;
        if (!WebPAnimDecoderGetNext(decoder.get(), &rgba, &end)) break;
        const std::size_t size = std::size_t{4} * animated.info.canvas_width * animated.info.canvas_height;
        animated.pictures.push_back({end - before, {rgba, rgba + size}});
        before = end;
    }
    return animated;
}

/// Mean of the absolute differences of the three channels, of 0..1.
double framesApart(const Shown& picture, const tegument::Image& image) {
    if (picture.rgba.size() != std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) return 1e9;
    double sum = 0;
    std::size_t at = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x, at += 4)
            for (int c = 0; c < 3; ++c)
                sum += std::abs(picture.rgba[at + static_cast<std::size_t>(c)] / 255.0 - static_cast<double>(image.at(x, y, c)));
    return sum / (3.0 * image.width * image.height);
}

Ran renderTurning(const fs::path& file) {
    return tegument::test::tegument(
        {"render", "effects/Specular.fx", "-w", ballWorkspace(), "--size", "96", "--turntable", "5", "-o", file.string()});
}

} // namespace

TEST(Pictures, both_compilers_draw_the_same_head) {
    if (!tegument::test::tegument({"check", "effects/TSM.fx", "--target", "spirv-dxc", "--json"}).json()["complete"].get<bool>())
        GTEST_SKIP() << "DXC was left out of this build (./bootstrap test brings it): there is no second picture to compare with";
    const Picture dxc = head("dxc", {"--compiler", "dxc"});
    const Picture glslang = head("glslang", {"--compiler", "glslang"});
    // Both front ends order arithmetic as they like: a shadow comparison may flip beside an edge, nothing else may move.
    EXPECT_LT(shareBeyond(dxc.image, glslang.image, 1e-3 * mean(dxc.image)), 1e-3);
    EXPECT_GT(mean(dxc.image), 0.01);
}

TEST(Pictures, every_setting_is_finite_and_differs_from_the_others) {
    const Picture seed = head("seed", {"--setting", "seed"});
    const Picture deon = head("deon2007", {"--setting", "deon2007"});
    const Picture corrected = head("corrected", {"--setting", "corrected"});
    for (const Picture* picture : {&seed, &deon, &corrected})
        EXPECT_TRUE(finite(picture->image));
    EXPECT_GT(shareBeyond(seed.image, deon.image, 1e-3), 0.05);
    EXPECT_GT(shareBeyond(deon.image, corrected.image, 1e-3), 0.05);
}

TEST(Pictures, diffusion_softens_the_terminator_and_keeps_the_energy) {
    const Picture diffused = head("diffused");
    const Picture lambert = head("lambert", {"--technique", "Lambert"});
    EXPECT_GT(shareBeyond(diffused.image, lambert.image, 1e-3), 0.05);
    // Scattering moves light about; only transmission adds and the closed ball loses nothing.
    EXPECT_NEAR(mean(diffused.image) / mean(lambert.image), 1.0, 0.05);
}

TEST(Pictures, dump_all_writes_every_target_that_was_allocated) {
    const Picture dumped = head("dump", {"--dump", "all"});
    ASSERT_FALSE(dumped.report["targets"].empty());
    for (const auto& target : dumped.report["targets"]) {
        const std::string name = target["name"];
        if (name.starts_with('<')) continue; // the picture's own, given by the caller
        ASSERT_TRUE(dumped.report["dumped"].contains(name)) << name;
        const auto image = ::tegument::loadImage(dumped.report["dumped"][name].get<std::string>());
        ASSERT_TRUE(image) << name;
        EXPECT_EQ(image->width, target["width"].get<int>()) << name;
        EXPECT_TRUE(finite(*image)) << name;
    }
}

TEST(Pictures, report_names_fifteen_passes_with_the_prepasses_and_thirteen_without) {
    const auto with = head("with", {"--set", "gUsePrePass=1"}).report;
    const auto without = head("without").report;
    EXPECT_EQ(with["passes"].size(), 15u);
    EXPECT_EQ(without["passes"].size(), 13u);
    EXPECT_EQ(with["passes"][0]["name"], "TSM");
    EXPECT_EQ(with["passes"][14]["name"], "Final");
    EXPECT_EQ(with["map_size"], 512);
}

TEST(WhiteIrradiance, comes_out_of_the_corrected_cascade_as_the_sum_of_weights) {
    // Float targets: rounding of ten passes. Half targets: lavapipe truncates to half, 2^-11 a pass on six maps.
    EXPECT_LT(largestError(white("corrected", 32).image, whiteSum(1.0)), 1e-5);
    EXPECT_LT(largestError(white("corrected", 16).image, whiteSum(1.0)), 3e-3);
}

TEST(WhiteIrradiance, grows_by_the_printed_kernels_sum_in_the_printed_settings) {
    for (const char* setting : {"seed", "deon2007"}) {
        EXPECT_LT(largestError(white(setting, 32).image, whiteSum(1.001)), 1e-5) << setting;
        EXPECT_GT(largestError(white(setting, 32).image, whiteSum(1.0)), 1e-4) << setting << ": the printed gain is gone";
    }
}

TEST(WhiteIrradiance, stays_white_under_poisson_blurs_in_every_setting) {
    for (const char* setting : {"seed", "deon2007", "corrected"}) {
        // Three means of 13; half targets round each to 2^-11.
        EXPECT_LT(largestError(white(setting, 32, "WhitePoisson").image, {1, 1, 1}), 1e-6) << setting;
        EXPECT_LT(largestError(white(setting, 16, "WhitePoisson").image, {1, 1, 1}), 2e-3) << setting;
    }
}

TEST(WhiteIrradiance, darkens_along_the_charts_where_the_seams_are_not_repaired) {
    for (const char* technique : {"White", "WhitePoisson"})
        for (const char* setting : {"seed", "corrected"})
            EXPECT_GT(largestError(white(setting, 32, technique, 0).image, {1, 1, 1}), 0.1) << technique << ", " << setting;
}

TEST(Samples, one_is_drawn_without_a_resolve_and_covers_a_pixel_wholly_or_not_at_all) {
    const Picture one = render("one", ball({"--samples", "1"}));
    EXPECT_EQ(one.report["samples"], 1);
    for (const auto& pass : one.report["passes"])
        EXPECT_NE(pass["name"], "resolve");
    for (std::size_t alpha = 3; alpha < one.image.pixels.size(); alpha += 4)
        EXPECT_TRUE(one.image.pixels[alpha] == 0 || one.image.pixels[alpha] == 1) << one.image.pixels[alpha];
}

TEST(Samples, four_give_the_rim_of_a_ball_steps_of_a_quarter) {
    const Picture four = render("four", ball({"--samples", "4"}));
    EXPECT_EQ(four.report["samples"], 4);
    bool between = false;
    for (int y = 0; y < four.image.height; ++y)
        for (int x = 0; x < four.image.width; ++x) {
            const float alpha = 4 * four.image.at(x, y, 3);
            EXPECT_EQ(alpha, std::round(alpha)) << x << ", " << y;
            between = between || (alpha > 0 && alpha < 4);
        }
    EXPECT_TRUE(between);
}

TEST(Samples, every_technique_of_the_skin_draws_with_four) {
    for (const char* technique : {"DEonLuebke", "Gosselin"}) {
        const Picture four = render(technique, {"effects/Main.fx", "-t", technique, "-w", ballWorkspace(), "--size", "64x64", "--map-size",
                                                "64", "--samples", "4"});
        EXPECT_EQ(four.report["samples"], 4) << technique;
    }
}

TEST(Samples, a_number_other_than_1_2_4_8_is_refused_before_work) {
    for (const char* samples : {"0", "3", "16", "-4", "four"}) {
        const fs::path path = scratch() / "refused.png";
        const Ran ran = renderTo(path, samples);
        EXPECT_EQ(ran.code, 2) << ran.err;
        EXPECT_NE(ran.err.find("--samples"), std::string::npos) << ran.err;
        EXPECT_FALSE(fs::exists(path));
    }
}

TEST(Samples, eight_are_drawn_or_refused_with_those_that_the_device_has) {
    const fs::path path = scratch() / "eight.png";
    const Ran ran = renderTo(path, "8");
    if (ran.code == 0) {
        EXPECT_TRUE(fs::exists(path));
        return;
    }
    EXPECT_EQ(ran.code, 3) << ran.err;
    EXPECT_NE(ran.err.find("TG6016"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("1, 4"), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(path));
}

TEST(Webp, looks_like_the_pngs_of_the_turntable) {
    const Ran ran = renderTurning(scratch() / "turn.WEBP");
    ASSERT_EQ(ran.code, 0) << ran.err;
    ASSERT_EQ(renderTurning(scratch() / "turn.png").code, 0);
    const Animated webp = readWebp(scratch() / "turn.WEBP");
    ASSERT_EQ(webp.pictures.size(), 5U);
    for (std::size_t i = 0; i < 5; ++i) {
        const auto png = tegument::loadImage(scratch() / fmt::format("turn-{:03}.png", i + 1));
        ASSERT_TRUE(png);
        EXPECT_LT(framesApart(webp.pictures[i], *png), 0.01) << "what quality 90 loses, on the mean";
    }
}

TEST(Film, looks_like_the_pngs_of_the_turntable) {
    if (!tegument::findProgram("ffmpeg")) GTEST_SKIP() << "ffmpeg is not installed (./bootstrap test brings it)";
    const fs::path film = scratch() / "film.mp4", raw = scratch() / "film.rgba";
    ASSERT_EQ(renderTurning(film).code, 0);
    ASSERT_EQ(renderTurning(scratch() / "film.png").code, 0);
    const auto ran = tegument::runProcess(
        {.arguments = {"ffmpeg", "-nostdin", "-v", "error", "-y", "-i", film.string(), "-f", "rawvideo", "-pix_fmt", "rgba", raw.string()}},
        60);
    ASSERT_TRUE(ran && ran->exitCode == 0) << (ran ? ran->output : tegument::format(ran.error()));
    const auto bytes = tegument::readFile(raw);
    ASSERT_TRUE(bytes);
    constexpr std::size_t kFrame = std::size_t{96} * 96 * 4;
    ASSERT_EQ(bytes->size(), 5 * kFrame) << "every picture once";
    for (std::size_t i = 0; i < 5; ++i) {
        const auto png = tegument::loadImage(scratch() / fmt::format("film-{:03}.png", i + 1));
        ASSERT_TRUE(png);
        const Shown picture{
            0, {bytes->begin() + static_cast<std::ptrdiff_t>(i * kFrame), bytes->begin() + static_cast<std::ptrdiff_t>((i + 1) * kFrame)}};
        EXPECT_LT(framesApart(picture, *png), 0.02) << "colours of half resolution, and what quality 16 loses, on the mean";
    }
}

TEST(Film, without_ffmpeg_says_what_to_install_before_work) {
    const Ran ran = tegument::test::tegument(
        {"render", "effects/Specular.fx", "-w", ballWorkspace(), "--size", "96", "--turntable", "5", "-o", (scratch() / "no.mp4").string()},
        {{"PATH", "/nowhere"}});
    EXPECT_EQ(ran.code, 3);
    EXPECT_NE(ran.err.find("TG5205: MP4 needs the program ffmpeg"), std::string::npos) << ran.err;
    EXPECT_NE(ran.err.find("apt-get install ffmpeg"), std::string::npos) << ran.err;
    EXPECT_FALSE(fs::exists(scratch() / "no.mp4"));
}

TEST(Webp, turns_once_in_four_seconds_and_for_ever) {
    ASSERT_EQ(renderTurning(scratch() / "turn.webp").code, 0);
    const Animated webp = readWebp(scratch() / "turn.webp");
    ASSERT_EQ(webp.pictures.size(), 5U);
    for (const Shown& picture : webp.pictures)
        EXPECT_EQ(picture.milliseconds, 800);
    EXPECT_EQ(webp.info.loop_count, 0U) << "without end";
}
