#include "meshprep/portrait/portrait.h"

#include "host/mesh/extent.h"
#include "host/support/text.h"
#include "meshprep/portrait/surface_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

std::string axisName(const glm::dvec3& direction) {
    constexpr double kAlong = 0.9999;
    for (int axis = 0; axis < 3; ++axis)
        if (std::abs(direction[axis]) > kAlong) return fmt::format("{}{}", direction[axis] < 0 ? "-" : "", "xyz"[axis]);
    return fmt::format("({:.2f}, {:.2f}, {:.2f})", direction.x, direction.y, direction.z);
}

/// A region of the face, mm from the nasion; both sides.
struct Region {
    double inner, outer, low, high;

    [[nodiscard]] bool holds(double across, double above) const {
        return across >= inner && across <= outer && above >= low && above <= high;
    }
};

constexpr Region kLips{.inner = 0, .outer = 18, .low = -83, .high = -66};
constexpr Region kCheeks{.inner = 28, .outer = 48, .low = -62, .high = -34};
constexpr Region kBrowsAndEyes{.inner = 16, .outer = 44, .low = -8, .high = 18};
constexpr Region kForehead{.inner = 0, .outer = 36, .low = 30, .high = 52};

struct Mean {
    glm::dvec3 sum{0};
    double count = 0;

    [[nodiscard]] glm::dvec3 value() const { return glm::max(sum / std::max(count, 1.0), glm::dvec3(1e-3)); }
};

glm::dvec3 colorAt(const Image& picture, const glm::dvec2& uv) {
    const auto texel = [](double t, int size) { return std::clamp(static_cast<int>((t - std::floor(t)) * size), 0, size - 1); };
    const int x = texel(uv.x, picture.width), y = texel(uv.y, picture.height);
    glm::dvec3 color;
    for (int channel = 0; channel < 3; ++channel)
        color[channel] = static_cast<double>(picture.at(x, y, std::min(channel, picture.channels - 1)));
    return color;
}

/// How much redder the lips are than the cheeks, and how much darker eyes and brows than the forehead, in logarithms.
double features(const std::array<Mean, 4>& means) {
    for (const Mean& mean : means)
        if (mean.count < 8) return 0;
    const glm::dvec3 lips = means[0].value(), cheeks = means[1].value(), eyes = means[2].value(), forehead = means[3].value();
    const double red = std::log(lips.r / lips.g) - std::log(cheeks.r / cheeks.g);
    const double dark = std::log(forehead.g / eyes.g);
    return std::clamp(red, -0.5, 0.5) + std::clamp(dark, -0.5, 0.5);
}

void turn(Mesh& mesh, const HeadPose& pose, double scale) {
    const glm::dmat3 rows = glm::transpose(glm::dmat3(pose.left, pose.up, pose.front));
    for (glm::vec3& position : mesh.positions)
        position = glm::vec3(rows * glm::dvec3(position) * scale);
    for (glm::vec3& normal : mesh.normals)
        normal = glm::vec3(rows * glm::dvec3(normal));
    for (glm::vec4& tangent : mesh.tangents)
        tangent = glm::vec4(glm::vec3(rows * glm::dvec3(tangent)), tangent.w);
    mesh.origin = rows * mesh.origin * scale;
    mesh.unitMm *= scale;
    computeBounds(mesh);
    for (MeshPart& part : mesh.parts)
        computeClusters(mesh, part);
}

void turnTrianglesOver(Mesh& mesh) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
}

/// On the side from which the triangles are seen.
void turnNormalsOut(Mesh& mesh) {
    if (mesh.normals.empty()) return;
    double along = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t *corner = &mesh.indices[i], first = *corner;
        const glm::vec3 a = mesh.positions[corner[1]] - mesh.positions[first], b = mesh.positions[corner[2]] - mesh.positions[first];
        along += static_cast<double>(glm::dot(glm::cross(a, b), mesh.normals[first]));
    }
    for (glm::vec3& normal : mesh.normals)
        if (along < 0) normal = -normal;
    mesh.tangents.clear();
    if (!mesh.uvs.empty()) computeTangents(mesh);
}

void flip(Mesh& mesh) {
    for (glm::vec2& uv : mesh.uvs)
        uv.y = 1 - uv.y;
    mesh.tangents.clear();
    computeTangents(mesh);
}

Error uncertain(const Mesh& mesh, const HeadPose& pose) {
    return inputError(
        5336, {.file = mesh.name},
        fmt::format("the shape does not say where the face is: it is most like one with {} up and {} in front ({:.0f} %), and "
                    "nearly as like seen another way ({:.0f} %)",
                    axisName(pose.up), axisName(pose.front), 100 * std::max(0.0, pose.likeness), 100 * std::max(0.0, pose.runnerUp)),
        fmt::format("say which axes of the file point up and where it looks, if that is right: --up={} --front={}",
                    pose.onAxes ? axisName(pose.up) : "y", pose.onAxes ? axisName(pose.front) : "z"));
}

/// Size and place of a head that fills the mesh.
void takeWhole(const Mesh& mesh, HeadPose& pose) {
    constexpr double kHeight = 260; // mm
    constexpr double kBrow = 0.45;  // of the height, from the crown
    glm::dvec3 low(INFINITY), high(-INFINITY);
    for (const glm::vec3& position : mesh.positions) {
        const glm::dvec3 p(glm::dot(glm::dvec3(position), pose.left), glm::dot(glm::dvec3(position), pose.up),
                           glm::dot(glm::dvec3(position), pose.front));
        low = glm::min(low, p), high = glm::max(high, p);
    }
    pose.millimetre = (high.y - low.y) / kHeight;
    pose.nasion = (low.x + high.x) / 2 * pose.left + (high.y - kBrow * (high.y - low.y)) * pose.up + high.z * pose.front;
}

Result<std::optional<Image>> pictureOf(const Mesh& mesh, const PortraitHints& hints) {
    if (!hints.colorMap.empty()) {
        auto image = loadImage(hints.colorMap);
        if (!image) return image.error();
        return std::optional<Image>(std::move(*image));
    }
    for (const EmbeddedTexture& texture : mesh.textures)
        if (texture.role == "color") return std::optional<Image>(texture.image);
    return std::optional<Image>();
}

} // namespace

double unitOfFace(double millimetre, double declared) {
    constexpr double kLargest = 1.7; // a newborn's face is so much smaller than a grown person's
    constexpr double kLeast = 0.7;
    const double wanted = declared / millimetre;
    const auto fits = [&](double unit) { return wanted / unit >= kLeast && wanted / unit <= kLargest; };
    if (fits(declared)) return declared;
    double best = 0;
    for (const double unit : {1.0, 10.0, 25.4, 100.0, 1000.0})
        if (fits(unit) && (best == 0 || std::abs(std::log(wanted / unit)) < std::abs(std::log(wanted / best)))) best = unit;
    if (best > 0) return best;
    const double step = std::pow(10, std::floor(std::log10(wanted)) - 1);
    return std::round(wanted / step) * step;
}

bool isInsideOut(const Mesh& mesh, const HeadPose& pose) {
    constexpr double kClearly = 0.4; // cosine
    double back = 0, all = 0;
    for (const SurfaceSample& s : sampleSurface(mesh.positions, mesh.indices)) {
        const glm::dvec3 p = (s.point - pose.nasion) / pose.millimetre;
        const double across = glm::dot(p, pose.left), above = glm::dot(p, pose.up), ahead = glm::dot(p, pose.front);
        const double facing = glm::dot(s.normal, pose.front);
        if (std::abs(across) > 55 || above < -100 || above > 45 || ahead < -35 || ahead > 35 || std::abs(facing) < kClearly) continue;
        all += 1;
        back += facing < 0 ? 1 : 0;
    }
    return back > 0.7 * all;
}

std::optional<bool> isFlipped(const Mesh& mesh, const HeadPose& pose, const Image& picture) {
    constexpr std::array<Region, 4> kRegions = {kLips, kCheeks, kBrowsAndEyes, kForehead};
    std::array<std::array<Mean, 4>, 2> means{};
    for (const SurfaceSample& s : sampleSurface(mesh.positions, mesh.indices)) {
        const glm::dvec3 p = (s.point - pose.nasion) / pose.millimetre;
        const double ahead = glm::dot(p, pose.front);
        if (ahead < -45 || ahead > 35 || glm::dot(s.normal, pose.front) < 0.15) continue;
        for (std::size_t region = 0; region < kRegions.size(); ++region) {
            if (!kRegions[region].holds(std::abs(glm::dot(p, pose.left)), glm::dot(p, pose.up))) continue;
            glm::dvec2 uv(0);
            for (int corner = 0; corner < 3; ++corner)
                uv +=
                    s.corners[corner] * glm::dvec2(mesh.uvs[mesh.indices[3 * std::size_t{s.triangle} + static_cast<std::size_t>(corner)]]);
            for (const std::size_t flipped : {std::size_t{0}, std::size_t{1}}) {
                Mean& mean = means[flipped][region];
                mean.sum += colorAt(picture, {uv.x, flipped ? 1 - uv.y : uv.y});
                mean.count += 1;
            }
        }
    }
    const double asIs = features(means[0]), flipped = features(means[1]);
    constexpr double kLeast = 0.12;
    constexpr double kLead = 0.12;
    if (std::max(asIs, flipped) < kLeast || std::abs(asIs - flipped) < kLead) return std::nullopt;
    return flipped > asIs;
}

Result<LaidHead> layHead(Mesh& mesh, const PortraitHints& hints) {
    const auto guessed = guessHeadPose(mesh.positions, mesh.indices, {.up = hints.up, .front = hints.front});
    if (!guessed)
        return inputError(5336, {.file = mesh.name}, "no face is found between this --up and this --front",
                          "they are two different axes of the file, such as --up=y --front=z");
    HeadPose pose = *guessed;
    const bool told = hints.up && hints.front;
    if (told) {
        pose.up = *hints.up;
        pose.front = *hints.front;
        pose.left = glm::cross(pose.up, pose.front);
    }
    if (!told && !isCertain(pose)) return uncertain(mesh, pose);
    LaidHead head;
    if (told && pose.likeness < kLeastLikeness) {
        takeWhole(mesh, pose);
        head.guesses.push_back("no face is found that way: the whole mesh is taken for a head 260 mm high; its unit: --unit-mm X");
    }
    if (!told)
        head.guesses.push_back(
            fmt::format("guessed: {} is up and the face looks along {}, by the shape; another way: --up=AXIS --front=AXIS",
                        axisName(pose.up), axisName(pose.front)));
    const double unit = hints.unitMm ? mesh.unitMm : unitOfFace(pose.millimetre, mesh.unitMm);
    if (unit != mesh.unitMm)
        head.guesses.push_back(
            fmt::format("guessed: one unit of the file is {:g} mm, by the size of the face; another: --unit-mm X", unit));
    const bool insideOut = pose.likeness >= kLeastLikeness && isInsideOut(mesh, pose);
    const bool mirrored = hints.mirror.value_or(insideOut);
    if (insideOut) {
        turnTrianglesOver(mesh);
        constexpr int kInsideOut = 5332; // which it is no longer
        std::erase_if(mesh.warnings, [](const Diagnostic& warning) { return warning.code == kInsideOut; });
    }
    if (insideOut && !hints.mirror)
        head.guesses.push_back("guessed: the file is mirrored, by its surface, which is inside out; not so: --mirror=false");
    const auto picture = mesh.uvs.empty() ? Result<std::optional<Image>>(std::optional<Image>()) : pictureOf(mesh, hints);
    if (!picture) return picture.error();
    const auto seen = !hints.flipV && *picture ? isFlipped(mesh, pose, **picture) : std::nullopt;
    if (*picture && !hints.flipV)
        head.guesses.push_back(!seen   ? "the picture does not tell whether v points down, and is laid as the format says; other: --flip-v"
                               : *seen ? "guessed: v points up in the file, by lips and eyes in the picture; not so: --flip-v=false"
                                       : "guessed: v points as the format says, by lips and eyes in the picture; other: --flip-v");
    const double scale = unit / mesh.unitMm;
    if (mirrored) {
        pose.left = -pose.left;
        turnTrianglesOver(mesh);
    }
    turn(mesh, pose, scale);
    if (mirrored || insideOut) turnNormalsOut(mesh);
    if (hints.flipV.value_or(seen.value_or(false)) && !mesh.uvs.empty()) flip(mesh);
    const glm::dmat3 rows = glm::transpose(glm::dmat3(pose.left, pose.up, pose.front));
    head.nasion = glm::vec3(rows * pose.nasion * scale);
    head.millimetre = static_cast<float>(pose.millimetre * scale);
    return head;
}

std::vector<glm::vec3> framedPoints(const Mesh& mesh, const LaidHead& head) {
    constexpr float kNeck = -165; // mm below the nasion; the chin ends at -120
    constexpr float kBeside = 115;
    std::vector<glm::vec3> points;
    for (const glm::vec3& position : mesh.positions) {
        const glm::vec3 p = (position - head.nasion) / head.millimetre;
        if (p.y >= kNeck && std::abs(p.x) <= kBeside) points.push_back(position);
    }
    return points.empty() ? mesh.positions : points;
}

} // namespace tegument
