#pragma once
// What other people's techniques define (docs/design/peers.md), from their formulas: kernels, profiles, rings of skin, and their responses
// to the edge of a shadow.

#include "lab/reference/profile.h"

#include <vector>

namespace tegument::reference {

/// A sample of a one-dimensional kernel: weight of each colour, and how far from the centre, in units of the kernel.
struct KernelSample {
    double offset = 0;
    glm::dvec3 weight{0};
};
using Kernel = std::vector<KernelSample>;

/// Jimenez et al. 2015 with the marginal of `profile`: `samples` offsets from -reach to reach (mm), spaced by squares, each with the light
/// of its cell, whose ends are half-way to the neighbours; the outermost cells have no outer end.
[[nodiscard]] Kernel separableKernel(const Profile& profile, int samples, double reach);
/// mm for 7, 11, 17 and 25 samples.
[[nodiscard]] double separableReach(int samples);
/// As the authors' program computes it, with its default strength and falloff.
[[nodiscard]] Kernel separableKernelPrinted(int samples);
/// Light on x > 0, seen at x, through the kernel along x; `unit` mm for each unit of its offsets. Steps, as a kernel of samples makes them.
[[nodiscard]] glm::dvec3 kernelEdge(const Kernel& kernel, double unit, double x);

/// Burley's normalised diffusion, (exp(-r/d) + exp(-r/3d)) / (8 pi d r).
[[nodiscard]] double burleyProfile(double r, double d);
/// Share of its light within r.
[[nodiscard]] double burleyShare(double r, double d);
/// Radius that holds this share, 0 <= share < 1: by bisection.
[[nodiscard]] double burleyRadius(double share, double d);
/// Light on x > 0 of a plane, seen at x: the share outside of the circle that reaches the edge, over all directions.
[[nodiscard]] double burleyEdge(double x, double d);

/// Light max(cos, 0) around a cylinder of this radius (mm), spread along its surface by the profile's marginal, which goes around it as
/// often as it reaches: at cos(theta) = cosine.
[[nodiscard]] glm::dvec3 ring(const Profile& profile, double radius, double cosine);
/// As the listing of GPU Pro 2 has it: over half a turn, by chords, weights those of the profile's Gaussians with variances times 1.414 on
/// a line, normalised by their integral.
[[nodiscard]] glm::dvec3 ringPrinted(const Profile& profile, double radius, double cosine);

} // namespace tegument::reference
