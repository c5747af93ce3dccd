// Pyramid: its ladder, its atlas, what enters, what is reduced; levels, links and the picture stand in pyramid_light.cpp.

#include "lab/verify/pyramid.h"

#include "lab/reference/profile.h"
#include "lab/reference/spline_pyramid.h"
#include "lab/verify/corner_grid.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace tegument::verify {

namespace {

constexpr std::size_t kLevels = 7;
constexpr int kColumns = 160;          // of gLadderMap, an eighth of an octave of texels^2 per mm^2 each, from 2^-6 on
constexpr double kLargestTexel = 0.54; // mm: to here docs/design/modules/Ladder.md promises the edge
constexpr double kSmallestTexel = 0.06;

double densityOf(int column) {
    return std::exp2((column + 0.5) / 8 - 6);
}

struct EdgeErrors {
    double weights = 0; // of the sum of a column's weights, of any profile
    double edge = 0;
};

/// What the weights of each profile of the table must sum to: all six Gaussians; the first four; the red that links bring of the fourth,
/// in the colours of the fifth; the fifth.
std::array<glm::dvec3, 4> sumsOfWeights() {
    std::array<glm::dvec3, 4> sums{};
    const auto& profile = reference::skinProfile();
    for (std::size_t i = 0; i < profile.size(); ++i) {
        sums[0] += profile[i].weight;
        if (i < 4) sums[1] += profile[i].weight;
    }
    sums[2] = profile[4].weight * (profile[3].weight.x / profile[4].weight.x);
    sums[3] = profile[4].weight;
    return sums;
}

double errorOfSums(const Image& ladder, int column) {
    const auto expected = sumsOfWeights();
    double worst = 0;
    for (std::size_t profile = 0; profile < expected.size(); ++profile)
        for (int c = 0; c < 3; ++c) {
            double sum = -expected[profile][c];
            for (std::size_t step = 0; step <= kLevels; ++step)
                sum += ladder.at(column, static_cast<int>(profile * (kLevels + 1) + step), c);
            worst = std::max(worst, std::abs(sum));
        }
    return worst;
}

/// Of one column: what the weights make of an edge, against the profile's own.
EdgeErrors errorsOf(const Image& ladder, int column, const std::array<reference::EdgeAnswer, kLevels>& levels) {
    const double texels = std::sqrt(densityOf(column)); // per mm
    const auto& profile = reference::skinProfile();
    EdgeErrors errors{.weights = errorOfSums(ladder, column)};
    for (int at = -500; at <= 500; ++at) {
        const double x = 0.02 * at;
        glm::dvec3 answer(0);
        for (int c = 0; c < 3; ++c) {
            answer[c] = ladder.at(column, 0, c) * 0.5 * std::erfc(-x / std::sqrt(2 * profile.front().variance));
            for (std::size_t level = 0; level < kLevels; ++level)
                answer[c] += ladder.at(column, static_cast<int>(level) + 1, c) * levels[level].at(x * texels);
        }
        const glm::dvec3 off = glm::abs(answer - reference::halfPlane(profile, x));
        errors.edge = std::max({errors.edge, off.x, off.y, off.z});
    }
    return errors;
}

Result<void> verifyLadder(ModuleReport& report, const Context& context) {
    const auto run = render(context, {.effect = "Ladder.fx", .dump = {"gLadderMap"}});
    if (!run) return run.error();
    const Image& ladder = run->dumped.at("gLadderMap");
    std::array<reference::EdgeAnswer, kLevels> levels;
    for (std::size_t level = 0; level < kLevels; ++level)
        levels[level] = reference::splineEdge(static_cast<int>(level));
    EdgeErrors worst;
    for (int column = 0; column < kColumns; ++column) {
        const double texel = 1 / std::sqrt(densityOf(column));
        if (texel < kSmallestTexel || texel > kLargestTexel) continue;
        const EdgeErrors errors = errorsOf(ladder, column, levels);
        worst.weights = std::max(worst.weights, errors.weights);
        worst.edge = std::max(worst.edge, errors.edge);
    }
    addMetric(report, context, "ladder: largest error of a sum of weights", worst.weights, 8 * kHalfStep, "eight halves, truncated");
    addMetric(report, context, "ladder: largest error at an edge", worst.edge, 0.01,
              "Gaussians between the rungs, and splines that are no Gaussians: texels of 0.06 to 0.54 mm (docs/design/modules/Ladder.md)");
    return {};
}

/// Smallest stretch that a texel's own direction says anything about.
constexpr double kRound = 0.02;

/// Half a turn, in an eighth of a degree.
const std::vector<glm::dvec2>& directions() {
    static const std::vector<glm::dvec2> kDirections = [] {
        constexpr int kCount = 1440;
        std::vector<glm::dvec2> all;
        for (int i = 0; i < kCount; ++i)
            all.emplace_back(std::cos(std::numbers::pi * i / kCount), std::sin(std::numbers::pi * i / kCount));
        return all;
    }();
    return kDirections;
}

/// xx, xy, yy of the direction (whose sign means nothing), and the density, of the texel's triangle: by the singular values of its steps.
glm::dvec4 metricOf(const Mesh& mesh, const reference::SurfacePoint& point, int size) {
    const auto steps = reference::jacobian(mesh, point.place.triangle);
    if (!steps) return glm::dvec4(0);
    const glm::dvec3 u = steps->alongU / static_cast<double>(size);
    const glm::dvec3 v = steps->alongV / static_cast<double>(size);
    // The step of one texel that is shortest on the surface, by going round: no eigenvalue is solved for.
    glm::dvec2 dense(1, 0);
    double shortest = std::numeric_limits<double>::max();
    double longest = 0;
    for (const glm::dvec2& way : directions()) {
        const double length = glm::length(way.x * u + way.y * v);
        longest = std::max(longest, length);
        if (length < shortest) dense = way;
        shortest = std::min(shortest, length);
    }
    const double stretch = std::min(longest / shortest, 3.0);
    const double along = stretch * stretch - 1;
    return {along * dense.x * dense.x, along * dense.x * dense.y, along * dense.y * dense.y, 1 / (longest * longest)};
}

/// Of channel 3, where texels count: the mean around each, evenly weighed down to 0 over a 64th of the map.
Image smoothed(const Image& whole, const std::vector<std::uint8_t>& covered) {
    Image mean = plainImage(whole.width, whole.height, 1);
    const int reach = std::max(whole.width / 64, 1);
    const auto share = [&](int offset) { return 1 - std::abs(offset) / static_cast<double>(reach); };
    for (int y = 0; y < whole.height; ++y)
        for (int x = 0; x < whole.width; ++x) {
            double sum = 0;
            double weight = 0;
            for (int v = std::max(0, y - reach); v <= std::min(whole.height - 1, y + reach); ++v)
                for (int u = std::max(0, x - reach); u <= std::min(whole.width - 1, x + reach); ++u) {
                    if (covered[static_cast<std::size_t>(v * whole.width + u)] == 0) continue;
                    const double w = share(u - x) * share(v - y);
                    sum += w * whole.at(u, v, 3);
                    weight += w;
                }
            mean.at(x, y, 0) = weight > 0 ? static_cast<float>(sum / weight) : 0;
        }
    return mean;
}

Image metricTerms(const Image& metric) {
    Image terms = plainImage(metric.width, metric.height, 3);
    for (int y = 0; y < metric.height; ++y)
        for (int x = 0; x < metric.width; ++x) {
            const glm::dvec2 dense(metric.at(x, y, 0), metric.at(x, y, 1));
            terms.at(x, y, 0) = static_cast<float>(dense.x * dense.x + kRound);
            terms.at(x, y, 1) = static_cast<float>(dense.x * dense.y);
            terms.at(x, y, 2) = static_cast<float>(dense.y * dense.y + kRound);
        }
    return terms;
}

/// The mesh's corners in the map as the device has them (corner_grid.h): small triangles are another shape there, by as much as a corner is
/// moved beside their sides.
Mesh withCornersOnGrid(Mesh mesh, double step, int size) {
    const auto onGrid = [&](float place) { return static_cast<float>(std::round(static_cast<double>(place) * size / step) * step / size); };
    if (step > 0)
        for (glm::vec2& uv : mesh.uvs)
            uv = {onGrid(uv.x), onGrid(uv.y)};
    return mesh;
}

Result<void> verifyAtlas(ModuleReport& report, const Context& context, const PyramidScene& at) {
    const int size = context.options.mapSize;
    const auto run = render(
        context, at.scene,
        {.effect = "Atlas.fx", .size = size, .dump = {"gAtlasPositionMap", "gAtlasNormalMap", "gAtlasMeshNormalMap", "gAtlasMetricMap"}});
    if (!run) return run.error();
    const auto counts = interior(at.texels);
    const auto held = [&](const char* map, const Image& drawn, const Image& exact, const Limits& limits) {
        return compare(report, context, {map, drawn, exact, counts, {}}, limits);
    };
    const Limits halves{.relativeL2 = 1e-3, .why = "halves, truncated; corners that a rasteriser snaps to 1/256 texel"};
    const Image place = paint(at.texels, 3, [](const auto& point, std::size_t) { return glm::dvec4(point.position, 1); });
    if (const auto done = held(
            "gAtlasPositionMap", rgb(run->dumped.at("gAtlasPositionMap")), place,
            {.relativeL2 = 2e-5 * 256 / size, .why = "corners that a rasteriser snaps to 1/256 texel, which is wider in a smaller map"});
        !done)
        return done;
    const Image mapped = paint(at.texels, 3, [&](const auto& p, std::size_t) { return glm::dvec4(at.truth.skin.mappedNormal(p), 1); });
    if (const auto done = held("gAtlasNormalMap", rgb(run->dumped.at("gAtlasNormalMap")), mapped,
                               {.relativeL2 = 1e-3, .why = "8 bits of place in the look-up of the normal map"});
        !done)
        return done;
    const Image plain = paint(at.texels, 3, [](const auto& point, std::size_t) { return glm::dvec4(glm::normalize(point.normal), 1); });
    if (const auto done = held("gAtlasMeshNormalMap", rgb(run->dumped.at("gAtlasMeshNormalMap")), plain, halves); !done) return done;
    const auto grid = measureCornerGrid(context);
    if (!grid) return grid.error();
    const Mesh drawn = withCornersOnGrid(at.scene.mesh, grid->step, size);
    const Image& metric = run->dumped.at("gAtlasMetricMap");
    const Image whole = paint(
        at.texels, 4, [&](const auto& point, std::size_t) { return metricOf(drawn, point, size) + glm::dvec4(kRound, 0, kRound, 0); });
    const Limits edges{
        .relativeL2 = 5e-3, .bias = 3e-3, .why = "halves, truncated; differences within two by two texels, which may lie on two triangles"};
    if (const auto done = held("gAtlasMetricMap: direction", metricTerms(metric), rgb(whole), edges); !done) return done;
    return held("gAtlasMetricMap: density", channel(metric, 2), smoothed(whole, covered(at.texels)), edges);
}

/// What enters, times coverage: nothing outside the charts.
Result<void> verifyEntry(ModuleReport& report, const Context& context, const PyramidScene& at, const Image& drawn) {
    const auto counts = awayFromShadowEdges(at.truth, at.texels);
    const Image exact = paint(at.texels, 3, [&](const reference::SurfacePoint& point, std::size_t) {
        return glm::dvec4(at.truth.skin.entering(point, at.truth.skin.lit(point)), 1);
    });
    const auto compared =
        compare(report, context, {"gEntry0Map", rgb(drawn), exact, counts, interior(at.texels)},
                {.relativeL2 = 6e-3,
                 .bias = 2e-3,
                 .apart = 0.2,
                 .why = "a half, truncated; normals of the atlas are halves; 8 bits of place in the look-up of colour; the albedo table; "
                        "single taps of the shadow where a curved surface leaves the plane it is taken for"});
    if (!compared) return compared;
    noteApart(report, "gEntry0Map", counts, covered(at.texels), kShadowApart);
    return {};
}

/// Each level against the base as it was drawn, all at once.
Result<void> verifyReductions(ModuleReport& report, const Context& context, const RunResult& run) {
    const Image& base = run.dumped.at("gEntry0Map");
    for (int level = 1; level < static_cast<int>(kLevels); ++level) {
        const std::string name = fmt::format("gEntry{}Map", level);
        const Image exact = reference::splineLevel(base, level);
        const Image& drawn = run.dumped.at(name);
        if (exact.width < 4) continue; // every texel reaches over the edge
        std::vector<std::uint8_t> counts;
        for (int y = 0; y < exact.height; ++y)
            for (int x = 0; x < exact.width; ++x)
                counts.push_back(std::isfinite(exact.at(x, y, 0)) ? 1 : 0);
        Image known = exact;
        for (float& value : known.pixels)
            value = std::isfinite(value) ? value : 0;
        const double step = (level + 1) * kHalfStep;
        const auto compared = compare(report, context, {name, drawn, known, counts, {}},
                                      {.relativeL2 = step,
                                       .largest = 0.02,
                                       .bias = step,
                                       .why = "a half, truncated, in each reduction; software filters with weights of 8 bits"});
        if (!compared) return compared;
    }
    return {};
}

Result<void> verifyBase(ModuleReport& report, const Context& context, const PyramidScene& at) {
    RenderJob job{.effect = "Pyramid.fx", .technique = "Pyramid", .size = context.options.pictureSize};
    for (std::size_t level = 0; level < kLevels; ++level)
        job.dump.push_back(fmt::format("gEntry{}Map", level));
    const auto run = render(context, at.scene, job);
    if (!run) return run.error();
    if (const auto entry = verifyEntry(report, context, at, run->dumped.at("gEntry0Map")); !entry) return entry;
    return verifyReductions(report, context, *run);
}

} // namespace

Result<ModuleReport> verifyPyramid(const Context& context) {
    ModuleReport report{
        .module = "Pyramid",
        .summary =
            "The ladder against the profile's edge through splines; the atlas against the mesh; what enters against rays; reductions "
            "against three boxes; levels, links and the picture against the integral over the surface, all in double precision"};
    const Scene scene = sceneOf(context.options);
    const Truth truth = truthOf(scene, context.options);
    const Seen texels = lookUnwrapped(scene.mesh, context.options.mapSize);
    const PyramidScene at{.scene = scene, .truth = truth, .texels = texels};
    if (const auto done = verifyLadder(report, context); !done) return done.error();
    if (const auto done = verifyAtlas(report, context, at); !done) return done.error();
    if (const auto done = verifyBase(report, context, at); !done) return done.error();
    if (const auto done = verifyPyramidLight(report, context, at); !done) return done.error();
    return report;
}

} // namespace tegument::verify
