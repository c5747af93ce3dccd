// Skin by its melanin and blood, and brute force with the factor 1 + c h against photons in the same shape: the tables of
// docs/design/skin-error.md, "Every tone" and "Bent skin", and what effects/*.presets.json have of six skins.
//   skin_tones tones|bodies|table [--photons N] [--seed N]
// table: the numbers of hlsl/scatter/tone.fxh, and how far skins off its nodes are from other photons.

#include "lab/bench/shapes.h"
#include "lab/reference/bssrdf.h"
#include "lab/reference/profile.h"
#include "lab/reference/skin_tone.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>

namespace tegument::reference {

namespace {

struct Settings {
    std::size_t photons = 100'000;
    std::uint64_t seed = 1;
};

struct NamedTone {
    const char* name;
    double melanin, blood;
    [[nodiscard]] SkinTone tone() const { return toneOf(melanin, blood); }
};
constexpr std::array<NamedTone, 6> kTones = {{{"very light", .006, .004},
                                              {"light", .014, .006},
                                              {"intermediate", .028, .008},
                                              {"tan", .042, .009},
                                              {"brown", .10, .010},
                                              {"dark", .18, .010}}};
/// The skin that the default head's colour map shows.
constexpr std::size_t kMapTone = 1;
void tones(const Settings& settings) {
    const WhitePhotons photons(settings.photons, settings.seed);
    std::vector<ToneResponse> responses;
    for (const NamedTone& named : kTones)
        responses.push_back(photons.response(named.tone()));
    fmt::print("{} photons at each of nine wavelengths, seed {}\n\n", settings.photons, settings.seed);
    fmt::print(
        "| skin | melanin, blood | L* a* b* | angle | albedo, R / G / B | 50 % within, mm | 95 % | largest error of an edge | c, per mm "
        "|\n|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < kTones.size(); ++i) {
        const ToneResponse& r = responses[i];
        Spectrum seen = r.spectrum;
        for (double& value : seen)
            value *= 0.95; // light enters through a surface that mirrors a part
        const SkinColor color = colorOf(seen);
        const Profile profile = fittedProfile(r);
        glm::dvec3 worst(0);
        glm::dvec3 half(0);
        glm::dvec3 most(0);
        for (int c = 0; c < 3; ++c) {
            const RingHistogram& rings = r.rings.at(static_cast<std::size_t>(c));
            for (double x = 0.02; x < 25; x *= 1.15)
                worst[c] = std::max(worst[c], std::abs(halfPlane(profile, x)[c] - halfPlane(rings, x)));
            half[c] = rings.radiusOf(.5);
            most[c] = rings.radiusOf(.95);
        }
        const glm::dvec3 flesh = fleshFactor(kTones.at(i).tone());
        fmt::print(
            "| {} | {} {} | {:.1f} {:.1f} {:.1f} | {:.0f} {} | {:.3f} / {:.3f} / {:.3f} | {:.2f} / {:.2f} / {:.2f} | {:.2f} / {:.2f} / "
            "{:.2f} | {:.3f} / {:.3f} / {:.3f} | {:.2f} / {:.2f} / {:.2f} |\n",
            kTones.at(i).name, kTones.at(i).melanin, kTones.at(i).blood, color.lightness, color.a, color.b, color.typologyAngle(),
            typologyOf(color.typologyAngle()), r.albedo.x, r.albedo.y, r.albedo.z, half.x, half.y, half.z, most.x, most.y, most.z, worst.x,
            worst.y, worst.z, flesh.x, flesh.y, flesh.z);
    }
    fmt::print("\nPresets, for a colour map of \"{}\" skin: weights times what the skin gives back beside that one.\n\n",
               kTones.at(kMapTone).name);
    for (std::size_t i = 0; i < kTones.size(); ++i) {
        const glm::dvec3 share = responses[i].albedo / responses[kMapTone].albedo;
        const glm::dvec3 flesh = fleshFactor(kTones.at(i).tone());
        fmt::print("\"{}\": \"gGaussianWeight\": [", kTones.at(i).name);
        const Profile profile = fittedProfile(responses[i]);
        for (std::size_t k = 0; k < profile.size(); ++k) {
            const glm::dvec3 w = profile[k].weight * share;
            fmt::print("{}{:.4f}, {:.4f}, {:.4f}, {:.6f}", k > 0 ? ", " : "", w.x, w.y, w.z, profile[k].variance);
        }
        fmt::print("], \"gFlesh\": [{:.2f}, {:.2f}, {:.2f}, 0]\n", flesh.x, flesh.y, flesh.z);
    }
}

void printColors(const char* name, std::span<const glm::dvec3> colors) {
    fmt::print("static const float3 {}[{}] = {{\n", name, colors.size());
    for (const glm::dvec3& color : colors)
        fmt::print("    float3({:.5f}, {:.5f}, {:.5f}){}\n", color.x, color.y, color.z, &color == &colors.back() ? "" : ",");
    fmt::print("}};\n");
}

void table(const Settings& settings) {
    const ToneTable table = fittedTable(WhitePhotons(settings.photons, settings.seed));
    std::vector<glm::dvec3> weights;
    std::vector<glm::dvec3> albedo(kToneTerms, glm::dvec3(0));
    for (const auto& gaussian : table)
        for (std::size_t t = 0; t < kToneTerms; ++t) {
            weights.push_back(gaussian.at(t));
            albedo[t] += gaussian.at(t);
        }
    std::array<glm::dvec3, 3> dermis{};
    for (int c = 0; c < 3; ++c) {
        const LayerOptics without = fleshOf({.blood = 0}, kToneColors.at(static_cast<std::size_t>(c))).dermis;
        dermis[0][c] = without.scattering;
        dermis[1][c] = without.absorption;
        dermis[2][c] = fleshOf({.blood = 1}, kToneColors.at(static_cast<std::size_t>(c))).dermis.absorption;
    }
    printColors("kTgToneWeight", weights);
    printColors("kTgToneAlbedo", albedo);
    printColors("kTgToneDermis", dermis);
    constexpr int kSkins = 24;
    constexpr double kFairlyDark = 0.1; // melanin, up to which edges are promised
    constexpr double kSeen = 0.05;      // albedo, from which on it is promised
    const WhitePhotons others(settings.photons, settings.seed + 1);
    std::mt19937_64 random(settings.seed);
    const auto between = [&](const std::array<double, 2>& range) {
        return range[0] * std::pow(range[1] / range[0], std::generate_canonical<double, 53>(random));
    };
    glm::dvec3 edge(0);
    glm::dvec3 relative(0);
    for (int i = 0; i < kSkins; ++i) {
        const double melanin = between(kToneMelanin);
        const double blood = between(kToneBlood);
        const ToneResponse truth = others.response(toneOf(melanin, blood));
        const Profile profile = profileOf(table, melanin, blood);
        for (int c = 0; c < 3; ++c) {
            double sum = 0;
            for (const Gaussian& gaussian : profile)
                sum += gaussian.weight[c];
            if (truth.albedo[c] >= kSeen) relative[c] = std::max(relative[c], std::abs(sum / truth.albedo[c] - 1));
            for (double x = 0.02; x < 25 && melanin <= kFairlyDark; x *= 1.15)
                edge[c] =
                    std::max(edge[c], std::abs(halfPlane(profile, x)[c] / sum - halfPlane(truth.rings.at(static_cast<std::size_t>(c)), x)));
        }
    }
    fmt::print(
        "// {} skins by other photons: edge {:.4f} / {:.4f} / {:.4f} up to melanin .1, albedo {:.1f} / {:.1f} / {:.1f} % from .05 on\n",
        kSkins, edge.x, edge.y, edge.z, 100 * relative.x, 100 * relative.y, 100 * relative.z);
}

/// Photons at one wavelength in each channel, absorbed on their way.
struct Half {
    ToneResponse response;
    std::array<Flesh, 3> flesh;
};
Half halfSpace(const SkinTone& tone, const Settings& settings) {
    Half half;
    for (std::size_t c = 0; c < 3; ++c) {
        half.flesh.at(c) = fleshOf(tone, kToneColors.at(c));
        std::mt19937_64 random(settings.seed + c);
        const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
        const PlateBody body(std::numeric_limits<double>::infinity());
        for (std::size_t i = 0; i < settings.photons;) {
            const double cosine = std::sqrt(1 - uniform());
            const Entering inside = entering({std::sqrt(1 - cosine * cosine), 0, cosine}, {0, 0, -1}, half.flesh.at(c).index);
            if (uniform() < inside.mirrored) continue;
            ++i;
            followInBody(body, half.flesh.at(c), {0, 0, 1e-6}, inside.direction, 1 / static_cast<double>(settings.photons), uniform,
                         [&](const LeavingPhoton& p) { half.response.rings.at(c).add(std::hypot(p.place.x, p.place.y), p.energy); });
        }
        half.response.albedo[static_cast<int>(c)] = half.response.rings.at(c).total();
    }
    return half;
}

/// Relative L2 over the surface, by rings of equal angle about the light, the photons' noise taken off; and the flux of photons over the
/// formula's.
struct BodyError {
    double error = 0;
    double flux = 0;
    double noise = 0;
};
BodyError ballError(double radius, std::size_t color, const Half& half, const glm::dvec3& flesh, const Settings& settings) {
    constexpr std::size_t kRings = 18;
    constexpr int kParts = 6;
    const Mesh mesh = bench::sphere(radius);
    const RayScene surface(mesh);
    const glm::dvec3 light(0, 0, 1);
    const BodyLight photons =
        photonsInBody(surface, half.flesh.at(color), light, {.photons = settings.photons, .seed = settings.seed, .cached = true});
    const double index = half.flesh.at(color).index;
    const RadialProfile profile = radial(fittedProfile(half.response), flesh);
    const Irradiance entered = [&](const SurfacePoint& point) {
        const glm::dvec3 normal = glm::normalize(point.position);
        return glm::dvec3(std::max(0.0, normal.z) * (1 - entering(-light, normal, index).mirrored));
    };
    std::array<std::array<double, 2>, kRings> left{};
    std::array<double, kRings> area{};
    for (std::uint32_t t = 0; t < mesh.indices.size() / 3; ++t) {
        const auto corner = [&](std::size_t c) { return glm::dvec3(mesh.positions[mesh.indices[3UL * t + c]]); };
        const glm::dvec3 centre = glm::normalize(corner(0) + corner(1) + corner(2));
        const auto ring = std::min(kRings - 1, static_cast<std::size_t>(std::acos(centre.z) / std::numbers::pi * kRings));
        area.at(ring) += 0.5 * glm::length(glm::cross(corner(1) - corner(0), corner(2) - corner(0)));
        for (std::size_t h = 0; h < 2; ++h)
            left.at(ring).at(h) += photons.left.at(h)[t];
    }
    double squares = 0;
    double noise = 0;
    double all = 0;
    double out = 0;
    double said = 0;
    for (std::size_t ring = 0; ring < kRings; ++ring) {
        const auto c = static_cast<int>(color);
        const double truth = 0.5 * (left.at(ring)[0] + left.at(ring)[1]) / area.at(ring);
        const double halves = 0.5 * (left.at(ring)[0] - left.at(ring)[1]) / area.at(ring);
        double formula = 0; // the mean over the ring
        double weights = 0;
        for (int part = 0; part < kParts; ++part) {
            const double angle = (static_cast<double>(ring) + (part + 0.5) / kParts) / kRings * std::numbers::pi;
            const glm::dvec3 at(std::sin(angle), 0, std::cos(angle));
            formula += at.x * half.response.albedo[c] * diffuse(surface, entered, profile, radius * at, Quadrature{}, at).light[c];
            weights += at.x;
        }
        formula /= weights;
        squares += area.at(ring) * ((truth - formula) * (truth - formula) - halves * halves);
        noise += area.at(ring) * halves * halves;
        all += area.at(ring) * truth * truth;
        out += area.at(ring) * truth;
        said += area.at(ring) * formula;
    }
    return {std::sqrt(std::max(0.0, squares) / all), out / said, std::sqrt(noise / all)};
}

void bodies(const Settings& settings) {
    const SkinTone tone = kTones.at(kMapTone).tone();
    const Half half = halfSpace(tone, settings);
    const glm::dvec3 flesh = fleshFactor(tone);
    fmt::print("{} photons, seed {}; \"light\" skin at 620, 540 nm; c = {:.2f}, {:.2f} per mm\n\n", settings.photons, settings.seed,
               flesh.x, flesh.y);
    fmt::print("| shape | nm | relative L2, flux with R alone | with 1 + c h | noise |\n|---|---|---|---|---|\n");
    for (const double radius : {10.0, 5.0, 2.5})
        for (const std::size_t color : {0UL, 1UL}) {
            const BodyError alone = ballError(radius, color, half, glm::dvec3(0), settings);
            const BodyError with = ballError(radius, color, half, flesh, settings);
            fmt::print("| ball of {} mm | {} | {:.3f}, {:.2f} | {:.3f}, {:.2f} | {:.3f} |\n", radius, kToneColors.at(color), alone.error,
                       alone.flux, with.error, with.flux, with.noise);
            std::fflush(stdout);
        }
    for (const double thickness : {1.5, 3.0})
        for (const std::size_t color : {0UL, 1UL}) {
            std::mt19937_64 random(settings.seed);
            const Uniform uniform = [&] { return std::generate_canonical<double, 53>(random); };
            const PlateBody body(thickness);
            double through = 0;
            for (std::size_t i = 0; i < settings.photons;) {
                const double cosine = std::sqrt(1 - uniform());
                const Entering inside = entering({std::sqrt(1 - cosine * cosine), 0, cosine}, {0, 0, -1}, half.flesh.at(color).index);
                if (uniform() < inside.mirrored) continue;
                ++i;
                followInBody(body, half.flesh.at(color), {0, 0, 1e-6}, inside.direction, 1 / static_cast<double>(settings.photons), uniform,
                             [&](const LeavingPhoton& p) { through += p.triangle == 1 ? p.energy : 0; });
            }
            const RingHistogram& rings = half.response.rings.at(color);
            const double alone = rings.total() - rings.within(thickness);
            const double with = alone * (1 + flesh[static_cast<int>(color)] * thickness);
            fmt::print("| slab of {} mm, through it | {} | {:.3f}, {:.2f} | {:.3f}, {:.2f} | - |\n", thickness, kToneColors.at(color),
                       std::abs(alone / through - 1), through / alone, std::abs(with / through - 1), through / with);
        }
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App program("Skin by its melanin and blood", "skin_tones");
    program.require_subcommand(1);
    program.fallthrough();
    program.add_subcommand("tones", "Six skins: colours, profiles, presets")->callback([&] { tones(settings); });
    program.add_subcommand("bodies", "Brute force against photons in balls and slabs")->callback([&] { bodies(settings); });
    program.add_subcommand("table", "The numbers of hlsl/scatter/tone.fxh")->callback([&] { table(settings); });
    program.add_option("--photons", settings.photons, "For each wavelength and shape")->capture_default_str();
    program.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    return 0;
}

} // namespace

} // namespace tegument::reference

int main(int argc, char** argv) {
    return tegument::reference::run(argc, argv);
}
