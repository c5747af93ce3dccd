// How much of the light the drawn specular layer mirrors, by quadrature over pictures of it.

#include "lab/reference/radial.h"
#include "lab/verify/scene.h"
#include "lab/verify/work.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace tegument::verify {

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kAlbedoSize = 256; // pixels a side
constexpr float kBallRadius = 40;

Mesh albedoBall() {
    constexpr int kRows = 96;
    constexpr int kAround = 2 * kRows;
    Mesh mesh;
    mesh.name = "ball";
    for (int j = 0; j <= kRows; ++j)
        for (int i = 0; i <= kAround; ++i) {
            const double down = kPi * j / kRows;
            const double turn = 2 * kPi * i / kAround;
            const glm::dvec3 normal(std::sin(down) * std::cos(turn), std::cos(down), -std::sin(down) * std::sin(turn));
            mesh.normals.emplace_back(normal);
            mesh.positions.emplace_back(kBallRadius * glm::vec3(normal));
            mesh.uvs.emplace_back(static_cast<float>(i) / kAround, static_cast<float>(j) / kRows);
        }
    for (std::uint32_t j = 0; j < kRows; ++j)
        for (std::uint32_t i = 0; i < kAround; ++i) {
            const std::uint32_t a = j * (kAround + 1) + i;
            const std::uint32_t b = a + kAround + 1;
            if (j > 0) mesh.indices.insert(mesh.indices.end(), {a, b + 1, a + 1});
            if (j + 1 < kRows) mesh.indices.insert(mesh.indices.end(), {a, b, b + 1});
        }
    mesh.parts = {{.name = "ball", .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeTangents(mesh);
    computeBounds(mesh);
    return mesh;
}

/// Parallel light from a direction, of colour 1: irradiance pi on what faces it.
Workspace litFrom(const glm::dvec3& direction) {
    Workspace workspace = worldWorkspace();
    workspace.light.direction = -glm::vec3(direction);
    workspace.light.color = glm::vec3(1);
    return workspace;
}

Result<Image> drawnSpecular(const Context& context, const Mesh& mesh, const Workspace& workspace) {
    auto run = render(context, {.effect = "Specular.fx", .technique = "SpecularUnshadowed", .size = kAlbedoSize}, &mesh, workspace);
    if (!run) return run.error();
    return std::move(run->image);
}

/// Of light along the normal: a plane seen from near by, every pixel another direction of what it mirrors. Radiance times cosine over the
/// hemisphere of directions, over the irradiance; 75 degrees each way hold all of the lobe.
Result<double> albedoAlongNormal(const Context& context) {
    constexpr float kHeight = 50;
    constexpr double kHalfAngle = 75 * kPi / 180;
    const double reach = std::tan(kHalfAngle);
    Workspace workspace = litFrom({0, 0, 1});
    workspace.camera.position = {0, 0, kHeight};
    workspace.camera.target = {0, 0, 0};
    workspace.camera.horizontalFov = static_cast<float>(360 * kHalfAngle / kPi);
    workspace.camera.nearPlane = kHeight / 2;
    workspace.camera.farPlane = 2 * kHeight;
    const auto image = drawnSpecular(context, squareMesh(static_cast<float>(1.1 * kHeight * reach)), workspace);
    if (!image) return image.error();
    const double step = 2 * reach / kAlbedoSize;
    double sum = 0;
    for (int y = 0; y < kAlbedoSize; ++y)
        for (int x = 0; x < kAlbedoSize; ++x) {
            const double s = (x + 0.5) * step - reach;
            const double t = (y + 0.5) * step - reach;
            const double cosine2 = 1 / (1 + s * s + t * t); // a pixel's solid angle is step^2 cosine^3
            sum += static_cast<double>(image->at(x, y, 0)) * step * step * cosine2 * cosine2;
        }
    return sum / kPi;
}

/// Of light from all sides: what a ball sends everywhere of the light that falls on it. A ball shows the eye each of its normals, and its
/// picture's integral is the intensity; nodes over the cosine between eye and light.
Result<double> hemisphericalAlbedo(const Context& context) {
    constexpr std::size_t kAngles = 12; // 16 and 24 change it by 0.1 %
    constexpr float kAway = 200;        // radii: its front is seen half a per cent larger than from infinity
    constexpr double kFrame = 1.05;     // of the ball's width
    const Mesh ball = albedoBall();
    const double pixel = 2 * kFrame / kAlbedoSize; // radii
    double sum = 0;
    for (const reference::Node& node : reference::gaussLegendre(kAngles)) {
        Workspace workspace = litFrom({std::sqrt(1 - node.x * node.x), 0, node.x});
        workspace.camera.position = {0, 0, kAway * kBallRadius};
        workspace.camera.target = {0, 0, 0};
        workspace.camera.horizontalFov = static_cast<float>(360 / kPi * std::atan(kFrame / kAway));
        const auto image = drawnSpecular(context, ball, workspace);
        if (!image) return image.error();
        double intensity = 0;
        for (int y = 0; y < kAlbedoSize; ++y)
            for (int x = 0; x < kAlbedoSize; ++x)
                intensity += static_cast<double>(image->at(x, y, 0)) * pixel * pixel;
        sum += node.weight * intensity;
    }
    return 2 * sum / kPi; // 2 pi radians around, over the light on the ball: pi times its pi radii^2
}

} // namespace

Result<void> measureAlbedos(ModuleReport& report, const Context& context) {
    const auto normal = albedoAlongNormal(context);
    if (!normal) return normal.error();
    const auto hemispherical = hemisphericalAlbedo(context);
    if (!hemispherical) return hemispherical.error();
    constexpr const char* kSkin = "skin in vivo mirrors .04 to .07 of light along the normal, and its cheeks have index 1.51 to 1.53 "
                                  "(docs/design/modules/Specular.md)";
    addMetric(report, context, "albedo along the normal, less .04", *normal - 0.04, 0.004, kSkin);
    addMetric(report, context, "hemispherical albedo, less .06", *hemispherical - 0.06, 0.01, kSkin);
    report.notes.push_back(fmt::format("the specular layer mirrors {:.4f} of light along the normal and {:.4f} of light from all sides, by "
                                       "quadrature over 13 pictures",
                                       *normal, *hemispherical));
    return {};
}

} // namespace tegument::verify
