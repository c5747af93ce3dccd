// Each peer on a plane with an edge reproduces its own kernel's or profile's response: along both axes of the picture, at any shape of it,
// on planes that are seen at an angle.

#include "lab/reference/peers.h"
#include "tests/peers/fixture.h"

#include <algorithm>

namespace tegument::test {
namespace {

using reference::Kernel;

constexpr int kSize = 256;
/// Half side of the plane, mm, for which a texel of the colour map is as large as a pixel: the edge lies between two of either, unfiltered.
constexpr float kHalfPlane = kHalfWidth * Peers::kEdgeMap / kSize;

reference::Kernel kernelOf(int samples, bool printed) {
    return printed ? reference::separableKernelPrinted(samples)
                   : reference::separableKernel(reference::skinProfile(), samples, reference::separableReach(samples));
}

/// Light is known at the middles of pixels and interpolated between them.
glm::dvec3 kernelResponse(const Kernel& kernel, double unit, double x, double pixel) {
    glm::dvec3 sum(0);
    for (const reference::KernelSample& sample : kernel)
        sum += sample.weight * std::clamp((x + unit * sample.offset) / pixel + 0.5, 0.0, 1.0);
    return sum;
}

class PeerEdges : public Peers {
protected:
    struct View {
        int width = kSize;
        int height = kSize;
        float turn = 0; // of the plane about y, radians
        bool leftRight = true;
        bool printed = false;
    };

    /// Light across the edge, from black to white; one value for each pixel, over what white is.
    std::vector<glm::dvec3> response(const Technique3& peer, const View& view) {
        RunOptions options{.width = view.width, .height = view.height, .compiler = defaultCompiler()};
        options.textures = {{"gSkinMap", edgeMap(view.leftRight)}};
        const auto result = render(peer, plane(kHalfPlane, view.turn), facing(), options, view.printed);
        EXPECT_TRUE(succeeded(result));
        std::vector<glm::dvec3> values;
        if (!result) return values;
        const int count = view.leftRight ? view.width : view.height;
        for (int i = 0; i < count; ++i)
            values.push_back(meanOf(result->image, view.leftRight, view.leftRight ? i : count - 1 - i) / std::cos(double{view.turn}));
        return values;
    }

    void expectKernel(const Technique3& peer, int samples, const View& view, double unit, double tolerance) {
        const std::vector<glm::dvec3> values = response(peer, view);
        ASSERT_FALSE(values.empty());
        const double pixel = 2 * kHalfWidth / view.width / (view.leftRight ? std::cos(double{view.turn}) : 1);
        const Kernel kernel = kernelOf(samples, view.printed);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double x = (static_cast<double>(i) + 0.5 - static_cast<double>(values.size()) / 2) * pixel;
            const glm::dvec3 expected = kernelResponse(kernel, unit, x, pixel);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(values[i][c], expected[c], tolerance) << peer.name << " at " << x << " mm, colour " << c;
        }
    }
};

constexpr std::array<int, 4> kSamples = {7, 11, 17, 25};

// Half-float targets: two roundings of 5e-4 at white, and the place of a tap to a hundredth of a pixel times a step of at most 0.2.
constexpr double kHalf = 4e-3;

TEST_F(PeerEdges, separable_kernels_respond_as_themselves_along_both_axes) {
    for (std::size_t i = 0; i < kSamples.size(); ++i)
        for (const bool leftRight : {true, false})
            expectKernel(kPeers[i], kSamples[i], {.leftRight = leftRight}, 1, kHalf);
}

TEST_F(PeerEdges, separable_kernels_are_as_wide_across_as_up_in_pictures_of_any_shape) {
    for (const bool leftRight : {true, false})
        expectKernel(kPeers[3], 25, {.width = kSize, .height = kSize / 2, .leftRight = leftRight}, 1, kHalf);
}

TEST_F(PeerEdges, separable_kernels_keep_their_width_on_a_plane_seen_at_an_angle) {
    // At 60 degrees the two sides of the picture are 28 mm nearer and farther than the middle, of 700: kernels are up to 4 % off there, but
    // the edge is in the middle.
    expectKernel(kPeers[3], 25, {.turn = std::numbers::pi_v<float> / 3}, 1, 2 * kHalf);
    expectKernel(kPeers[3], 25, {.turn = std::numbers::pi_v<float> / 3, .leftRight = false}, 1, 2 * kHalf);
}

TEST_F(PeerEdges, printed_kernels_respond_as_themselves_in_square_pictures) {
    for (std::size_t i = 0; i < kSamples.size(); ++i)
        expectKernel(kPeers[i], kSamples[i], {.printed = true}, 2.8, kHalf);
}

TEST_F(PeerEdges, printed_kernels_are_wider_across_by_the_shape_of_the_picture) {
    expectKernel(kPeers[3], 25, {.width = kSize, .height = kSize / 2, .printed = true}, 2 * 2.8, kHalf);
    expectKernel(kPeers[3], 25, {.width = kSize, .height = kSize / 2, .leftRight = false, .printed = true}, 2.8, kHalf);
}

/// Mean over the colours of the largest and of the rms difference from Burley's own edge, over the picture.
struct Differences {
    glm::dvec3 largest{0};
    glm::dvec3 rms{0};
};
Differences fromBurley(const std::vector<glm::dvec3>& values, double pixel) {
    const glm::dvec3 d(0.451, 0.104, 0.070);
    Differences differences;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double x = (static_cast<double>(i) + 0.5 - static_cast<double>(values.size()) / 2) * pixel;
        for (int c = 0; c < 3; ++c) {
            double expected = 0; // light is interpolated between pixels: the mean over one
            for (int k = 0; k < 9; ++k)
                expected += reference::burleyEdge(x + (k - 4) / 9.0 * pixel, d[c]) / 9;
            const double difference = std::abs(values[i][c] - expected);
            differences.largest[c] = std::max(differences.largest[c], difference);
            differences.rms[c] += difference * difference;
        }
    }
    differences.rms = glm::sqrt(differences.rms / static_cast<double>(values.size()));
    return differences;
}

TEST_F(PeerEdges, burley_s_discs_respond_as_his_profile_does) {
    for (std::size_t i = 4; i < 7; ++i)
        for (const bool leftRight : {true, false}) {
            const Differences differences = fromBurley(response(kPeers[i], {.leftRight = leftRight}), 2 * kHalfWidth / kSize);
            for (int c = 0; c < 3; ++c) {
                EXPECT_LT(differences.largest[c], 0.02) << kPeers[i].name << " " << c;
                EXPECT_LT(differences.rms[c], 0.004) << kPeers[i].name << " " << c;
            }
        }
}

TEST_F(PeerEdges, burley_s_discs_lie_in_the_surface) {
    const float turn = std::numbers::pi_v<float> / 3;
    const Differences differences = fromBurley(response(kPeers[6], {.turn = turn}), 2 * kHalfWidth / kSize / std::cos(turn));
    for (int c = 0; c < 3; ++c)
        EXPECT_LT(differences.rms[c], 0.006) << c;
}

} // namespace
} // namespace tegument::test
