#include "lab/bench/truth.h"

#include "generated/setting_names.h"
#include "host/support/file.h"
#include "host/support/parallel.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

namespace tegument::bench {

namespace {

constexpr double kSkin = 0.99; // alpha of the colour map

double parameterOf(const Workspace& workspace, const std::string& name, double fallback) {
    const auto found = workspace.parameters.find(name);
    return found == workspace.parameters.end() || found->second.empty() ? fallback : found->second.front();
}

/// Setting `corrected` with what the scene sets itself.
reference::SkinSettings settingsOf(const Workspace& workspace) {
    reference::SkinSettings settings = reference::skinSettings(kSettingCorrected);
    settings.mix = parameterOf(workspace, "gMix", settings.mix);
    settings.roughness = parameterOf(workspace, "gRoughness", settings.roughness);
    settings.intensity = parameterOf(workspace, "gSpecularIntensity", settings.intensity);
    settings.attenuation = settings.intensity;
    return settings;
}

struct Neighbours {
    bool covered = true;
    bool interior = true;
};

/// The picture's pixels with the points that they show, or -1.
class Seen {
public:
    Seen(const std::vector<reference::ShadedPoint>& points, const reference::Pinhole& camera)
        : points_(points), camera_(camera), index_(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height), -1) {
        for (std::size_t i = 0; i < points.size(); ++i)
            index_[place(points[i].x, points[i].y)] = static_cast<std::int32_t>(i);
    }

    /// Whether all eight neighbours show something, and something near.
    [[nodiscard]] Neighbours neighbours(const reference::ShadedPoint& point) const {
        Neighbours found;
        constexpr double kOneSurface = 8; // pixels of distance: a surface seen at 7 degrees
        const double near = kOneSurface * camera_.footprint(glm::length(point.point.position - camera_.eye));
        for (int j = -1; j <= 1; ++j)
            for (int i = -1; i <= 1; ++i) {
                const reference::ShadedPoint* other = at(point.x + i, point.y + j);
                found.covered = found.covered && other;
                found.interior = found.interior && other && glm::length(other->point.position - point.point.position) < near;
            }
        return found;
    }

private:
    [[nodiscard]] std::size_t place(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(camera_.width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] const reference::ShadedPoint* at(int x, int y) const {
        if (x < 0 || y < 0 || x >= camera_.width || y >= camera_.height) return nullptr;
        const std::int32_t index = index_[place(x, y)];
        return index < 0 ? nullptr : &points_[static_cast<std::size_t>(index)];
    }

    const std::vector<reference::ShadedPoint>& points_;
    const reference::Pinhole& camera_;
    std::vector<std::int32_t> index_;
};

std::string identify(const Scene& scene, const reference::Pinhole& camera, const Sample& sample) {
    std::string bytes = scene.name;
    const auto add = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    add(camera.eye);
    add(camera.forward);
    add(camera.tangentX);
    add(camera.width);
    add(camera.height);
    for (const reference::ShadedPoint& point : sample.points) {
        add(point.x);
        add(point.y);
        add(point.point.position);
    }
    if (sample.grid > 1) add(sample.grid);
    return contentHash(bytes).substr(0, 12);
}

/// Fills in what light is computed at.
void takeParts(Sample& sample, const TruthScene& truth) {
    const auto grid = static_cast<std::size_t>(sample.grid);
    reference::Pinhole fine = truth.camera;
    fine.width *= sample.grid;
    fine.height *= sample.grid;
    std::vector<std::vector<reference::ShadedPoint>> seen(sample.points.size());
    forEachInParallel(seen.size(), [&](std::size_t i) {
        for (std::size_t k = 0; k < grid * grid; ++k) {
            const int x = sample.points[i].x * sample.grid + static_cast<int>(k % grid);
            const int y = sample.points[i].y * sample.grid + static_cast<int>(k / grid);
            if (const auto hit = truth.skin.rays().nearest(fine.start(x, y), fine.ray(x, y)))
                seen[i].push_back({x, y, interpolate(truth.skin.mesh(), hit->place)});
        }
    });
    for (std::size_t i = 0; i < seen.size(); ++i) {
        sample.parts.insert(sample.parts.end(), seen[i].begin(), seen[i].end());
        sample.partOf.insert(sample.partOf.end(), seen[i].size(), static_cast<std::uint32_t>(i));
    }
}

/// Light of the pixels from that of their parts.
std::vector<glm::dvec3> gathered(const Sample& sample, const std::vector<glm::dvec3>& light) {
    const double share = 1.0 / (sample.grid * sample.grid);
    std::vector<glm::dvec3> pixels(sample.points.size(), sample.background);
    for (std::size_t i = 0; i < light.size(); ++i)
        pixels[sample.partOf[i]] += share * (light[i] - sample.background);
    return pixels;
}

std::vector<glm::dvec3> lightOf(const TruthScene& truth, const Sample& sample, reference::RadialProfile profile, Part part,
                                const Progress& progress) {
    reference::BssrdfOptions options{.profile = std::move(profile)};
    const std::span<const reference::ShadedPoint> points = sample.parts;
    std::vector<glm::dvec3> light(points.size(), glm::dvec3(0));
    for (std::size_t first = 0; first < points.size(); first += kKeptTogether) {
        if (first / kKeptTogether % part.count != part.index - 1) continue;
        if (progress) options.progress = [&](std::size_t done, std::size_t) { progress(first + done, points.size()); };
        const auto some = points.subspan(first, std::min(kKeptTogether, points.size() - first));
        std::ranges::transform(reference::radiance(truth.skin, some, truth.camera.eye, options),
                               light.begin() + static_cast<std::ptrdiff_t>(first), &reference::Radiance::total);
    }
    return sample.grid > 1 ? gathered(sample, light) : light;
}

bool readNumber(std::string_view text, std::size_t& number) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size();
}

/// Every point sends back what enters it.
std::vector<glm::dvec3> undiffusedLight(const TruthScene& truth, const Sample& sample) {
    std::vector<glm::dvec3> light;
    for (const reference::ShadedPoint& part : sample.parts) {
        const reference::SurfacePoint& point = part.point;
        const bool lit = truth.skin.lit(point);
        light.push_back((truth.skin.entering(point, lit) + truth.skin.enteringMore(point)) * truth.skin.leaving(point, truth.camera.eye) +
                        truth.skin.reflected(point, truth.skin.mappedNormal(point), truth.camera.eye, lit) +
                        truth.skin.reflectedMore(point, truth.skin.mappedNormal(point), truth.camera.eye));
    }
    return sample.grid > 1 ? gathered(sample, light) : light;
}

} // namespace

TruthScene truthScene(const Scene& scene, int width, int height) {
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    constexpr int kMapSize = 1024; // of no importance: rays decide
    const auto light = reference::lightView(placed.light, scene.mesh.bounds, kMapSize);
    return {.camera = reference::pinhole(glm::dvec3(placed.camera.position), glm::dvec3(placed.camera.target), glm::dvec3(placed.camera.up),
                                         glm::radians(static_cast<double>(placed.camera.horizontalFov)), width, height),
            .skin =
                reference::SkinScene(scene.mesh, light, glm::dvec3(placed.light.color), settingsOf(scene.workspace), scene.lights.more)};
}

Sample samplePixels(const Scene& scene, const TruthScene& truth, std::size_t count, int grid) {
    const auto all = reference::visiblePoints(truth.skin, truth.camera, 0);
    const Seen seen(all, truth.camera);
    std::size_t skin = 0;
    std::vector<reference::ShadedPoint> kept;
    for (const reference::ShadedPoint& point : all) {
        if (truth.skin.colour(point.point).w < kSkin) continue;
        ++skin;
        if (seen.neighbours(point).covered) kept.push_back(point);
    }
    Sample sample{.points = reference::spreadEvenly(kept, count), .interior = {}};
    for (const reference::ShadedPoint& point : sample.points)
        sample.interior.push_back(seen.neighbours(point).interior ? 1 : 0);
    sample.coverage = static_cast<double>(skin) / (static_cast<double>(truth.camera.width) * truth.camera.height);
    sample.whole = sample.points.size() == kept.size();
    sample.grid = grid;
    sample.background = glm::dvec3(scene.workspace.background);
    if (grid > 1) {
        takeParts(sample, truth);
    } else {
        sample.parts = sample.points;
    }
    sample.id = identify(scene, truth.camera, sample);
    return sample;
}

Result<Part> partOf(const std::string& text) {
    const std::size_t slash = text.find('/');
    Part part;
    if (slash != std::string::npos && readNumber(std::string_view(text).substr(0, slash), part.index) &&
        readNumber(std::string_view(text).substr(slash + 1), part.count) && part.index >= 1 && part.index <= part.count)
        return part;
    return usageError(8101, fmt::format("'{}' is no part", text), "parts count from 1: 1/8 is the first of eight");
}

std::vector<glm::dvec3> trueLight(const TruthScene& truth, const Sample& sample, Part part, const Progress& progress) {
    return lightOf(truth, sample, reference::radial(reference::skinProfile()), part, progress);
}

std::vector<glm::dvec3> claimedLight(const TruthScene& truth, const Sample& sample, const Contender& contender, Part part,
                                     const Progress& progress) {
    if (contender.claim == Claim::Delta) return undiffusedLight(truth, sample);
    return lightOf(truth, sample, reference::burley({contender.burley[0], contender.burley[1], contender.burley[2]}), part, progress);
}

} // namespace tegument::bench
