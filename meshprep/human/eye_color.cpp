#include "meshprep/human/eye_color.h"

#include "meshprep/base/noise.h"

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

constexpr float kPupilRadius = 1.7f; // mm, indoors

/// 0 in the iris, 1 in the white: a soft border, as the clear cornea passes into the white over a millimetre.
float limbus(float radius) {
    return glm::smoothstep(kIrisRadius - 0.65f, kIrisRadius + 0.45f, radius);
}

glm::vec3 irisColor(float radius, float angle, std::uint32_t seed) {
    const glm::vec2 around(std::cos(angle), std::sin(angle));
    const float share = (radius - kPupilRadius) / (kIrisRadius - kPupilRadius);
    const float fibres = fractalNoise(glm::vec3(around * 9.0f, share * 0.9f), 4, seed);
    const float wave = fractalNoise(glm::vec3(around * 2.5f, 3), 2, seed + 5);
    const glm::vec3 inner(0.105f, 0.068f, 0.036f); // collarette: hazel
    const glm::vec3 outer(0.058f, 0.066f, 0.062f); // grey-green
    const glm::vec3 base = glm::mix(inner, outer, glm::smoothstep(0.1f, 0.55f, share + 0.25f * wave));
    const float ring = 1 - 0.65f * glm::smoothstep(0.62f, 1.0f, share);              // limbal ring
    const float rim = glm::mix(0.45f, 1.0f, glm::smoothstep(0.0f, 0.12f, share));    // pupil's frill
    const float gathered = 1 - 0.3f * around.y * glm::smoothstep(0.1f, 0.8f, share); // the cornea gathers light from above below
    return base * std::max(0.25f, 1 + 0.85f * fibres) * ring * rim * gathered;
}

glm::vec3 scleraColor(const glm::vec3& fromCentre, float radius, std::uint32_t seed) {
    const glm::vec3 white(0.5f, 0.445f, 0.41f); // a living one is no paper: .7 to .75 of it in sRGB
    const glm::vec3 flushed(0.43f, 0.23f, 0.2f);
    const glm::vec3 warped =
        fromCentre + 0.7f * glm::vec3(gradientNoise(fromCentre / 1.6f, seed + 7), gradientNoise(fromCentre / 1.6f, seed + 8), 0);
    const float lines = std::abs(gradientNoise(glm::vec3(warped.x / 6, warped.y / 1.7f, warped.z / 6), seed + 9));
    const float vessels = (1 - glm::smoothstep(0.0f, 0.05f, lines)) * (0.5f + 0.5f * gradientNoise(fromCentre / 3.0f, seed + 11));
    const float corner = glm::smoothstep(7.5f, 13.5f, radius);
    const float blotch = 0.12f * fractalNoise(fromCentre / 4.0f, 3, seed + 12);
    const glm::vec3 clear =
        white * glm::mix(glm::vec3(0.86f, 0.92f, 1.0f), glm::vec3(1), glm::smoothstep(5.5f, 8.0f, radius)); // bluish at the iris
    return glm::mix(clear, flushed, std::clamp(0.08f + blotch + 0.55f * corner + 0.4f * vessels * (0.35f + corner), 0.0f, 1.0f));
}

} // namespace

glm::vec3 eyeColor(const glm::vec3& position, const Eyeball& eye, std::uint32_t seed) {
    const glm::vec2 plane = eyeChart(eye, position);
    const float radius = glm::length(plane);
    const float pupil = 1 - glm::smoothstep(kPupilRadius - 0.15f, kPupilRadius + 0.15f, radius);
    const glm::vec3 iris = glm::mix(irisColor(radius, std::atan2(plane.y, plane.x), seed), glm::vec3(0.004f), pupil);
    return glm::mix(iris, scleraColor(position - eye.centre, radius, seed), limbus(radius));
}

} // namespace tegument
