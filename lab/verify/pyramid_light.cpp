// Where the light of a pyramid goes: Gaussian by Gaussian and as a picture, against the integral over the surface.

#include "host/image/dds.h"
#include "host/support/temporary.h"
#include "lab/reference/bssrdf.h"
#include "lab/reference/skin_tone.h"
#include "lab/verify/pyramid.h"
#include "meshprep/skin/skin_links.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tegument::verify {

namespace {

constexpr int kLadderRows = 8; // of one profile in gLadderMap
constexpr double kWidest = 4;  // standard deviations within which a Gaussian must not meet the border of a chart
constexpr std::size_t kSamples = 160;

using Weights = std::array<glm::dvec3, 6>; // of the profile's Gaussians

/// A file that is gone with its owner.
class LinkFile {
public:
    explicit LinkFile(const SkinLinks& links)
        : file_(std::filesystem::temp_directory_path() / fmt::format("tegument-verify-{}.dds", ::getpid())),
          written_(writeDds(file_.path(), DdsTexture{.format = DdsFormat::Rgba16F, .images = {links.sheet}})) {}
    [[nodiscard]] const Result<void>& written() const { return written_; }
    [[nodiscard]] std::string path() const { return file_.path().string(); }

private:
    Temporary file_;
    Result<void> written_;
};

std::vector<double> numbersOf(const Weights& weights) {
    std::vector<double> numbers;
    for (std::size_t i = 0; i < weights.size(); ++i) {
        for (int c = 0; c < 3; ++c)
            numbers.push_back(weights[i][c]);
        numbers.push_back(reference::skinProfile()[i].variance);
    }
    return numbers;
}

reference::Profile profileOf(const Weights& weights) {
    reference::Profile profile;
    for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] != glm::dvec3(0)) profile.push_back({reference::skinProfile()[i].variance, weights[i]});
    return profile;
}

/// Evenly spread ones of those that count.
std::vector<std::size_t> someOf(const std::vector<std::uint8_t>& counts) {
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < counts.size(); ++i)
        if (counts[i] != 0) all.push_back(i);
    std::vector<std::size_t> some;
    for (std::size_t i = 0; i < std::min(kSamples, all.size()); ++i)
        some.push_back(all[(2 * i + 1) * all.size() / (2 * std::min(kSamples, all.size()))]);
    return some;
}

/// Texels from which no border of a chart is nearer than `reach` mm along the map.
std::vector<std::uint8_t> farFromBorders(const PyramidScene& at, double reach) {
    const Seen& texels = at.texels;
    std::vector<std::uint8_t> far(texels.pixels.size(), 0);
    for (int y = 0; y < texels.height; ++y)
        for (int x = 0; x < texels.width; ++x) {
            const auto& here = texels.pixels[texels.index(x, y)];
            const auto steps = here ? reference::jacobian(at.scene.mesh, here->place.triangle) : std::nullopt;
            if (!steps) continue;
            const double texel = std::min(glm::length(steps->alongU), glm::length(steps->alongV)) / texels.width;
            const int r = static_cast<int>(std::ceil(reach / texel));
            bool all = x >= r && y >= r && x + r < texels.width && y + r < texels.height;
            for (int j = -r; all && j <= r; ++j)
                for (int i = -r; all && i <= r; ++i)
                    all = texels.pixels[texels.index(x + i, y + j)].has_value();
            far[texels.index(x, y)] = all ? 1 : 0;
        }
    return far;
}

/// One column of an image of the sampled texels.
Image rowOf(std::size_t count) {
    return plainImage(static_cast<int>(count), 1, 3);
}

/// Light of the chosen Gaussians at texels, by brute force.
Image integrated(const PyramidScene& at, const std::vector<std::size_t>& texels, const Weights& weights) {
    const auto profile = reference::radial(profileOf(weights));
    const auto& skin = at.truth.skin;
    Image row = rowOf(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto diffused =
            reference::diffuse(skin.rays(), [&](const reference::SurfacePoint& point) { return skin.entering(point, skin.lit(point)); },
                               profile, at.texels.pixels[texels[i]]->position, {});
        for (int c = 0; c < 3; ++c)
            row.at(static_cast<int>(i), 0, c) = static_cast<float>(diffused.light[c]);
    }
    return row;
}

struct LightJob {
    std::string technique;
    Weights weights{};
    std::string links; // a file
};

struct LightMaps {
    Image light;  // gLight0Map
    Image entry;  // gEntry0Map
    Image ladder; // gLadderMap of the same weights
};

Result<LightMaps> draw(const Context& context, const PyramidScene& at, const LightJob& job) {
    RenderJob run{.effect = "Pyramid.fx",
                  .technique = job.technique,
                  .size = context.options.pictureSize,
                  .dump = {"gLight0Map", "gEntry0Map"},
                  .parameters = {{"gGaussianWeight", numbersOf(job.weights)}}};
    if (!job.links.empty()) run.textures["gLinksMap"] = job.links;
    const auto drawn = render(context, at.scene, run);
    if (!drawn) return drawn.error();
    const auto table =
        render(context, {.effect = "Ladder.fx", .dump = {"gLadderMap"}, .parameters = {{"gGaussianWeight", numbersOf(job.weights)}}});
    if (!table) return table.error();
    return LightMaps{drawn->dumped.at("gLight0Map"), drawn->dumped.at("gEntry0Map"), table->dumped.at("gLadderMap")};
}

/// What the levels made, and what is left to the pixel: the table's first row times what enters there.
Image gathered(const LightMaps& maps, const std::vector<std::size_t>& texels) {
    Image row = rowOf(texels.size());
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const int x = static_cast<int>(texels[i]) % maps.light.width;
        const int y = static_cast<int>(texels[i]) / maps.light.width;
        const double density = maps.light.at(x, y, 3);
        const double column = (std::log2(std::abs(density)) + 6) * 8;
        const int nearest = std::clamp(static_cast<int>(column), 0, maps.ladder.width - 1);
        for (int c = 0; c < 3; ++c)
            row.at(static_cast<int>(i), 0, c) =
                maps.light.at(x, y, c) + maps.ladder.at(nearest, density < 0 ? kLadderRows : 0, c) * maps.entry.at(x, y, c);
    }
    return row;
}

Result<void> hold(ModuleReport& report, const Context& context, const PyramidScene& at, const LightJob& job, const std::string& subject,
                  const std::vector<std::size_t>& texels, const Limits& limits) {
    const auto maps = draw(context, at, job);
    if (!maps) return maps.error();
    return compare(report, context, {subject, gathered(*maps, texels), integrated(at, texels, job.weights), {}, {}}, limits);
}

Result<void> verifyLevels(ModuleReport& report, const Context& context, const PyramidScene& at) {
    Weights weights{};
    weights[1].r = weights[2].g = weights[3].b = 1;
    const double reach = kWidest * std::sqrt(reference::skinProfile()[3].variance);
    const auto texels = someOf(farFromBorders(at, reach));
    if (texels.empty()) {
        report.notes.emplace_back("Gaussians 2 to 4: no texel is far enough from the border of its chart");
        return {};
    }
    return hold(report, context, at, {.technique = "Pyramid", .weights = weights}, "Gaussians 2, 3, 4 by levels", texels,
                {.relativeL2 = 0.03,
                 .bias = 0.01,
                 .why = "texels as large as the second Gaussian; splines that are no Gaussians; shadow edges of the map's resolution"});
}

Result<void> verifyLinks(ModuleReport& report, const Context& context, const PyramidScene& at, const std::string& links) {
    Weights weights{};
    weights[4].r = weights[5].g = 1;
    weights[4].b = weights[5].b = 0.5;
    weights[3] = LinkOptions{}.fourthShare * weights[4];
    return hold(report, context, at, {.technique = "PyramidLinked", .weights = weights, .links = links},
                "Gaussians 4, 5, 6 by levels and links", someOf(covered(at.texels)),
                {.relativeL2 = 0.025,
                 .bias = 0.01,
                 .why = "sources as large as 1.3 mm, 64 at most; what is received is interpolated between texels of 256 x 256"});
}

/// A technique with a profile of its own.
struct PictureJob {
    const char* effect;
    const char* technique;
    double wider = 1;                        // than the published profile, in width
    double relativeL2 = 0;                   // at most
    glm::dvec3 flesh{0};                     // c of 1 + c h, per mm
    std::optional<reference::SkinTone> tone; // by photons, in the place of both
};

/// What the technique is to draw of it: profile and flesh of these photons, the skin that the colour map shows divided out.
void followTone(const reference::SkinTone& tone, reference::Profile& profile, glm::dvec3& flesh) {
    static const reference::WhitePhotons kPhotons(20'000, 7);
    const reference::ToneResponse response = kPhotons.response(tone);
    const glm::dvec3 beside = response.albedo / kPhotons.response(reference::toneOf(0.014, 0.006)).albedo;
    profile = reference::fittedProfile(response);
    for (reference::Gaussian& gaussian : profile)
        gaussian.weight *= beside;
    flesh = reference::fleshFactor(tone);
}

Weights publishedWeights() {
    Weights weights;
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] = reference::skinProfile()[i].weight;
    return weights;
}

/// Against the integral of the profile that it was given.
Result<void> verifyPicture(ModuleReport& report, const Context& context, const PyramidScene& at, const std::string& links,
                           const PictureJob& picture) {
    RenderJob job{.effect = picture.effect, .technique = picture.technique, .size = context.options.pictureSize};
    if (std::string_view(picture.effect) == "Pyramid.fx") job.textures["gLinksMap"] = links;
    reference::Profile profile = reference::skinProfile();
    if (picture.wider != 1) {
        job.parameters["gGaussianWeight"] = numbersOf(publishedWeights());
        for (std::size_t i = 0; i < profile.size(); ++i) {
            profile[i].variance *= picture.wider * picture.wider;
            job.parameters["gGaussianWeight"][4 * i + 3] = profile[i].variance;
        }
    }
    glm::dvec3 flesh = picture.flesh;
    if (picture.tone) {
        job.parameters["gMelanin"] = {picture.tone->melanin};
        job.parameters["gBlood"] = {picture.tone->blood};
        followTone(*picture.tone, profile, flesh);
    } else if (flesh != glm::dvec3(0)) {
        job.parameters["gFlesh"] = {flesh.x, flesh.y, flesh.z, 0};
    }
    const auto run = render(context, at.scene, job);
    if (!run) return run.error();
    const Seen seen = look(at.truth.skin, at.truth.camera);
    const auto counts = interior(seen);
    std::vector<reference::ShadedPoint> points;
    for (const std::size_t pixel : someOf(counts))
        points.push_back({static_cast<int>(pixel) % seen.width, static_cast<int>(pixel) / seen.width, *seen.pixels[pixel]});
    const auto light =
        reference::radiance(at.truth.skin, points, at.truth.camera.eye, {.profile = reference::radial(profile, flesh), .cached = false});
    Image drawn = rowOf(points.size());
    Image exact = drawn;
    for (std::size_t i = 0; i < points.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            drawn.at(static_cast<int>(i), 0, c) = run->image.at(points[i].x, points[i].y, c);
            exact.at(static_cast<int>(i), 0, c) = static_cast<float>(light[i].total()[c]);
        }
    std::string subject = fmt::format("{}: pixels of the picture", picture.technique);
    if (picture.wider != 1) subject += fmt::format(", a profile {:g} times as wide", picture.wider);
    if (picture.flesh != glm::dvec3(0)) subject += ", light through flesh";
    if (picture.tone) subject += fmt::format(", melanin {:g}, blood {:g}", picture.tone->melanin, picture.tone->blood);
    return compare(report, context, {subject, drawn, exact, {}, {}},
                   {.relativeL2 = picture.relativeL2,
                    .bias = picture.relativeL2 / 3,
                    .why = "all of the above, and the shadow's edges at the pixel; light from chart to chart, which links bring"});
}

/// Links are made for two variances: 1.25 times as wide they are weighed anew.
const std::array<PictureJob, 6> kPictures = {{{"Pyramid.fx", "PyramidLinked", 1, 0.015},
                                              {"Pyramid.fx", "PyramidLinked", 1.25, 0.035},
                                              {"Main.fx", "DEonLuebke", 1, 0.035},
                                              {"Pyramid.fx", "PyramidLinked", 1, 0.035, {0.7, 1.8, 2.5}},
                                              {"Pyramid.fx", "Pyramid", 1, 0.035, {}, reference::toneOf(0.014, 0.006)},
                                              {"Pyramid.fx", "PyramidLinked", 1, 0.035, {}, reference::toneOf(0.1, 0.02)}}};

} // namespace

Result<void> verifyPyramidLight(ModuleReport& report, const Context& context, const PyramidScene& at) {
    const auto links = makeSkinLinks(at.scene.mesh);
    if (!links) return links.error();
    const LinkFile file(*links);
    if (!file.written()) return file.written().error();
    if (const auto done = verifyLevels(report, context, at); !done) return done;
    if (const auto done = verifyLinks(report, context, at, file.path()); !done) return done;
    for (const PictureJob& picture : kPictures)
        if (const auto done = verifyPicture(report, context, at, file.path(), picture); !done) return done;
    return {};
}

} // namespace tegument::verify
