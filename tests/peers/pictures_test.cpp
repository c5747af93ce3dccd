// The peers as wholes: the same light, shadow and reflection as Main.fx, both compilers, every form; balls and shadows whose shading is
// known.

#include "lab/reference/peers.h"
#include "tests/peers/fixture.h"
#include "tests/peers/forms.h"
#include "tests/run/sphere.h"
#include "tests/spirv/missing.h"

#include <algorithm>

namespace tegument::test {
namespace {

class PeerPictures : public Peers {
protected:
    static RunOptions size(int width, int height) { return {.width = width, .height = height, .compiler = defaultCompiler()}; }

    /// A ball of 80 mm lit from the upper right, with reflection and the default colour.
    Result<RunResult> portrait(const Technique3& peer, Compiler compiler, bool printed = false, const Parameters& parameters = {}) {
        RunOptions options = size(96, 96);
        options.compiler = compiler;
        options.parameters = parameters;
        return render(peer, sphere(80, 64, 128), closeUp(), options, printed);
    }
};

double largestDifference(const Image& a, const Image& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        largest = std::max<double>(largest, std::abs(a.pixels[i] - b.pixels[i]));
    return largest;
}

double meanOfAll(const Image& image) {
    double sum = 0;
    for (const float value : image.pixels)
        sum += value;
    return sum / static_cast<double>(image.pixels.size());
}

double shareApart(const Image& a, const Image& b, double limit) {
    int apart = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += 4)
        apart += std::abs(a.pixels[i] - b.pixels[i]) > limit || std::abs(a.pixels[i + 1] - b.pixels[i + 1]) > limit;
    return apart / (static_cast<double>(a.width) * a.height);
}

TEST(PeerForms, compile_to_spirv_by_both_compilers_which_see_the_same_parameters) {
    if (compilerAvailable(Compiler::Dxc))
        expectEveryPeerPasses({Target::SpirvDxc, Target::SpirvGlslang});
    else
        expectEveryPeerPasses({Target::SpirvGlslang});
}

TEST_F(PeerPictures, both_compilers_draw_the_same_picture_in_both_forms) {
    if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    for (const Technique3& peer : kPeers)
        for (const bool printed : {false, true}) {
            const auto dxc = portrait(peer, Compiler::Dxc, printed);
            const auto glslang = portrait(peer, Compiler::Glslang, printed);
            ASSERT_TRUE(succeeded(dxc)) << peer.name;
            ASSERT_TRUE(succeeded(glslang)) << peer.name;
            const double mean = meanOfAll(dxc->image);
            ASSERT_GT(mean, 0.01) << "the picture is not black";
            // A tap on the border of two pixels, or a comparison with the shadow map, may fall the other way.
            EXPECT_LT(shareApart(dxc->image, glslang->image, 0.02 * mean), 0.01) << peer.name << printed;
        }
}

bool finite(const Image& image) {
    return std::ranges::all_of(image.pixels, [](float value) { return std::isfinite(value); });
}

TEST_F(PeerPictures, every_target_is_finite_in_every_setting) {
    for (const Technique3& peer : kPeers)
        for (const std::string setting : {"0", "1", "2"}) {
            RunOptions options = size(64, 48);
            options.dump = {"all"};
            const auto result = render(peer, sphere(80, 16, 32), closeUp(), options, setting != "2", 64, setting);
            ASSERT_TRUE(succeeded(result));
            for (const auto& [name, image] : result->dumped)
                EXPECT_TRUE(finite(image)) << peer.name << " " << name << " " << setting;
            EXPECT_TRUE(finite(result->image)) << peer.name << setting;
            EXPECT_GE(std::ranges::min(result->image.pixels), 0) << peer.name << setting;
        }
}

/// What the peers' own sliders offer, all at the low end, all at the high end.
const std::array<Parameters, 2> kEnds = {{{{"gSeparableStrength", {0, 0, 0}},
                                           {"gSeparableUnit", {0}},
                                           {"gBurleyDistance", {0.001, 0.001, 0.001}},
                                           {"gBurleyTurn", {0}},
                                           {"gBumpShare", {0, 0, 0}},
                                           {"gPenumbraRadius", {0.1}}},
                                          {{"gSeparableStrength", {1, 1, 1}},
                                           {"gSeparableUnit", {10}},
                                           {"gBurleyDistance", {5, 5, 5}},
                                           {"gBurleyTurn", {1}},
                                           {"gBumpShare", {1, 1, 1}},
                                           {"gPenumbraRadius", {20}}}}};

TEST_F(PeerPictures, are_finite_at_both_ends_of_their_sliders) {
    for (const std::size_t i : {3U, 6U, 8U})
        for (const Parameters& ends : kEnds) {
            const auto effect = loadEffect(std::string("effects/peers/") + kPeers.at(i).effect + ".fx", {});
            ASSERT_TRUE(succeeded(effect));
            Parameters own;
            for (const auto& [name, values] : ends)
                if (effect->findParameter(name)) own[name] = values;
            EXPECT_EQ(own.size(), 2U) << kPeers.at(i).effect;
            for (const bool printed : {false, true}) {
                const auto result = portrait(kPeers.at(i), defaultCompiler(), printed, own);
                ASSERT_TRUE(succeeded(result));
                EXPECT_TRUE(finite(result->image)) << kPeers.at(i).name << printed;
                EXPECT_GT(meanOfAll(result->image), 0.01) << kPeers.at(i).name << printed;
            }
        }
}

TEST_F(PeerPictures, without_diffusion_are_the_picture_of_main_without_diffusion) {
    // On a ball, with shadow, reflection, colour before and after: nothing but the diffusion differs. Light and shade pass half-float
    // targets, 1e-3 of white; where a triangle begins a depth may fall on another pixel.
    const auto lambert = portrait({"Main", "Lambert"}, defaultCompiler());
    ASSERT_TRUE(succeeded(lambert));
    for (const auto& [peer, parameters] :
         {std::pair(kPeers[3], Parameters{{"gSeparableStrength", {0, 0, 0}}}), std::pair(kPeers[3], Parameters{{"gSeparableUnit", {0}}}),
          std::pair(kPeers[6], Parameters{{"gBurleyDistance", {1e-4, 1e-4, 1e-4}}})}) {
        const auto peerless = portrait(peer, defaultCompiler(), false, parameters);
        ASSERT_TRUE(succeeded(peerless));
        EXPECT_LT(shareApart(peerless->image, lambert->image, 2e-3), 2e-3)
            << peer.name << ", largest " << largestDifference(peerless->image, lambert->image);
    }
}

TEST_F(PeerPictures, of_a_white_plane_are_white) {
    Workspace scene = facing();
    scene.parameters["gMix"] = {0.5};
    for (const Technique3& peer : kPeers)
        for (const bool printed : {false, true}) {
            RunOptions options = size(64, 48);
            options.textures = {{"gSkinMap", whiteMap()}};
            const auto result = render(peer, plane(60), scene, options, printed);
            ASSERT_TRUE(succeeded(result));
            for (int y = 0; y < 48; ++y)
                for (int x = 0; x < 64; ++x)
                    for (int c = 0; c < 3; ++c)
                        ASSERT_NEAR(result->image.at(x, y, c), 1, 2e-3)
                            << peer.name << printed << " " << x << " " << y; // half-float targets
        }
}

TEST_F(PeerPictures, an_outline_takes_no_light_from_the_background) {
    // A white plane that ends in the picture is white to its edge.
    for (const Technique3& peer : kPeers) {
        RunOptions options = size(64, 64);
        options.textures = {{"gSkinMap", whiteMap()}};
        const auto result = render(peer, plane(5), facing(), options);
        ASSERT_TRUE(succeeded(result));
        int covered = 0;
        for (int y = 0; y < 64; ++y)
            for (int x = 0; x < 64; ++x)
                if (result->image.at(x, y, 1) > 0) {
                    ++covered;
                    // The shadow map's filter reaches half a texel over the plane's own rim.
                    ASSERT_NEAR(result->image.at(x, y, 0), 1, 0.02) << peer.name << " " << x << " " << y;
                }
        EXPECT_NEAR(covered, 40 * 40, 80) << peer.name;
    }
}

/// Shading of a ball of 10 mm lit from the right, row by row near its equator, against what the technique tabulates.
glm::dvec3 worstOnBall(const Image& image, bool printed) {
    glm::dvec3 worst(0);
    const double pixel = 2 * kHalfWidth / image.width;
    for (int y = image.height / 2 - 8; y < image.height / 2 + 8; ++y)
        for (int x = 0; x < image.width; ++x) {
            const double px = (x + 0.5 - image.width / 2.0) * pixel;
            const double front = std::sqrt(100 - px * px); // nearer to the eye
            const double cosine = px / 10 * (1 - front / double{kEyeDistance});
            const glm::dvec3 expected = printed ? reference::ringPrinted(reference::skinProfile(), 10, cosine)
                                                : reference::ring(reference::skinProfile(), 10, cosine);
            for (int c = 0; c < 3; ++c)
                worst[c] = std::max(worst[c], std::abs(image.at(x, y, c) - expected[c]));
        }
    return worst;
}

TEST_F(PeerPictures, preintegrated_balls_are_shaded_by_the_ring) {
    Workspace scene = facing();
    scene.light.position = {3000, 0, 0};
    for (const bool printed : {false, true}) {
        RunOptions options = size(128, 64);
        options.textures = {{"gSkinMap", whiteMap()}};
        const auto result = render(kPeers[7], sphere(10, 64, 128), scene, options, printed, 512);
        ASSERT_TRUE(succeeded(result));
        const glm::dvec3 worst = worstOnBall(result->image, printed);
        for (int c = 0; c < 3; ++c)
            EXPECT_LT(worst[c], 0.008) << printed << " " << c; // rows that are up to 0.5 mm off the equator, facets of 0.5 mm
    }
}

/// A plane under a screen whose shadow ends at x = 0; the eye sees it from 5 mm inside the shadow on.
Mesh shadowed() {
    Mesh mesh = square();
    for (glm::vec3& p : mesh.positions)
        p *= 2;
    const float height = 6;
    mesh.positions.insert(mesh.positions.end(), {{-26, 20, height}, {-26, -20, height}, {-height, 20, height}, {-height, -20, height}});
    mesh.normals.insert(mesh.normals.end(), 4, {0, 0, 1});
    mesh.tangents.insert(mesh.tangents.end(), 4, {1, 0, 0, 1});
    mesh.uvs = std::vector<glm::vec2>(8, {0.5F, 0.5F});
    mesh.indices.insert(mesh.indices.end(), {4, 5, 6, 6, 5, 7});
    mesh.parts.front().indexCount = 12;
    computeBounds(mesh);
    return mesh;
}

TEST_F(PeerPictures, penumbras_spread_light_into_the_shadow_as_the_profile_does) {
    Workspace scene = facing();
    scene.light.position = {-3000, 0, 3000};
    RunOptions options = size(128, 64);
    options.textures = {{"gSkinMap", whiteMap()}};
    const auto result = render(kPeers[8], shadowed(), scene, options, false, 1024);
    ASSERT_TRUE(succeeded(result));
    const double lit = std::sqrt(0.5);
    for (int x = 24; x < 128; ++x) { // from 5 mm inside the shadow
        const double at = (x + 0.5 - 64) * 2 * kHalfWidth / 128;
        const glm::dvec3 expected = reference::halfPlane(reference::skinProfile(), at);
        const glm::dvec3 seen = Peers::meanOf(result->image, true, x) / lit;
        // The three narrow Gaussians show the shadow map's filter instead, within 0.3 mm of the edge; 32 taps tell its distance to 0.2 mm.
        const double tolerance = std::abs(at) < 0.5 ? 0.25 : 0.06;
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(seen[c], expected[c], tolerance) << at << " mm, colour " << c;
    }
}

} // namespace
} // namespace tegument::test
