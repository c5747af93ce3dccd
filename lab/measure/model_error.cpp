// The tables of docs/design/skin-error.md: diffusion profiles against simulated skin.
//   model_error [--photons N] [--seed N]

#include "lab/reference/profile.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace tegument::reference {

namespace {

struct Settings {
    std::size_t photons = 4'000'000;
    std::uint64_t seed = 1;
};

std::string three(const glm::dvec3& v, const char* form = "{:.3f} / {:.3f} / {:.3f}") {
    return fmt::format(fmt::runtime(form), v.x, v.y, v.z);
}

/// One figure of each channel's photons.
template <class Figure>
glm::dvec3 each(const SimulatedSkin& skin, Figure figure) {
    return {figure(skin[0]), figure(skin[1]), figure(skin[2])};
}

SimulatedSkin simulate(const std::function<Tissue(int channel)>& tissue, Launch launch, const Settings& settings) {
    SimulatedSkin all;
    for (int c = 0; c < 3; ++c)
        all[static_cast<std::size_t>(c)] = followPhotons(tissue(c), {.photons = settings.photons, .launch = launch, .seed = settings.seed});
    return all;
}

/// Marble-like "skin1" of Jensen et al. 2001, endless.
Tissue jensenSkin(int channel) {
    constexpr std::array<double, 3> kScattering = {.74, .88, 1.01};
    constexpr std::array<double, 3> kAbsorption = {.032, .17, .48};
    const auto c = static_cast<std::size_t>(channel);
    return {{kAbsorption.at(c), kScattering.at(c), std::numeric_limits<double>::infinity(), 1.4}};
}

void checkRow(const std::string& name, const SimulatedSkin& skin, const char* published) {
    const auto back = [](const Photons& p) { return p.mirrored + p.reflected + p.transmitted; };
    const auto error = [](const Photons& p) { return std::hypot(p.reflectedError, p.transmittedError); };
    fmt::print("| {} | {} | {} | {} |\n", name, three(each(skin, back), "{:.4f} / {:.4f} / {:.4f}"),
               three(each(skin, error), "{:.4f} / {:.4f} / {:.4f}"), published);
}

void checks(const Settings& settings, const SimulatedSkin& skin) {
    fmt::print("| tissue | light that leaves, R / G / B | standard error | published |\n|---|---|---|---|\n");
    checkRow("skin1 of Jensen et al., endless, beam", simulate(jensenSkin, Launch::Normal, settings), ".4168 / .2090 / .1240");
    checkRow("epidermis alone, 0.25 mm, beam, both sides",
             simulate([](int c) { return Tissue{layeredSkin(c).front()}; }, Launch::Normal, settings), ".8385 / .8339 / .6811");
    checkRow("three layers, beam", simulate(layeredSkin, Launch::Normal, settings), ".489 / .405 / .311");
    checkRow("three layers, diffuse", skin, ".502 / .431 / .331");
    fmt::print("\n| share | radius, mm, R / G / B | published |\n|---|---|---|\n");
    const std::array<std::pair<double, const char*>, 3> kRadii = {
        {{.5, ".45 / .255 / .18"}, {.8, "3.3 / .65 / .42"}, {.95, "12.8 / 1.93 / .79"}}};
    for (const auto& [share, published] : kRadii)
        fmt::print("| {:.0f} % | {} | {} |\n", 100 * share,
                   three(each(skin, [share = share](const Photons& p) { return p.rings.radiusOf(share); })), published);
}

void slabs(const Settings& settings) {
    constexpr double kSkins = 0.9; // mm: epidermis and upper dermis on both sides
    const std::array<std::pair<double, const char*>, 4> kSlabs = {
        {{1.5, ".195 / .130 / .0068"}, {2.5, ".173 / .084 / .0003"}, {4.5, ".139 / .037 / 0"}, {6.5, ".112 / .017 / 0"}}};
    fmt::print("\n| thickness, mm | transmitted, R / G / B | standard error | published | six Gaussians, sum of w exp(-t^2/(2v)) "
               "|\n|---|---|---|---|---|\n");
    for (const auto& [thickness, published] : kSlabs) {
        const SimulatedSkin slab = simulate([t = thickness](int c) { return skinSlab(c, t - kSkins); }, Launch::Diffuse, settings);
        fmt::print("| {} | {} | {} | {} | {} |\n", thickness,
                   three(each(slab, [](const Photons& p) { return p.transmitted; }), "{:.4f} / {:.4f} / {:.4f}"),
                   three(each(slab, [](const Photons& p) { return p.transmittedError; }), "{:.5f} / {:.5f} / {:.5f}"), published,
                   three(reference::slab(skinProfile(), thickness), "{:.4f} / {:.4f} / {:.4f}"));
        std::fflush(stdout);
    }
}

void errors(const SimulatedSkin& skin) {
    const glm::dvec3 nearest = fittedBurley(skin);
    std::vector<NamedProfile> profiles = {named("six Gaussians", "d'Eon and Luebke 2007", skinProfile())};
    for (int count = 5; count >= 2; --count)
        profiles.push_back(named(fmt::format("{} Gaussians", count), "refit of the six", refittedProfile(count)));
    profiles.push_back(named("six Gaussians", "d'Eon, GDC 2007", conferenceProfile()));
    profiles.push_back(namedBurley("Burley, d = .451 / .104 / .070", "fit to the six", {.451, .104, .070}));
    profiles.push_back(namedBurley("Burley, d = " + three(nearest), "fit to this simulation", nearest));
    profiles.push_back(named("six Gaussians, physical", "fit to such a simulation", physicalProfile()));
    fmt::print("\n| profile | source | energy in the wrong place, R / G / B | edge of light, R / G / B |\n|---|---|---|---|\n");
    for (const NamedProfile& profile : profiles) {
        const ModelError error = modelError(profile, skin);
        fmt::print("| {} | {} | {} | {} |\n", profile.name, profile.source, three(error.within), three(error.halfPlane));
    }
}

int run(int argc, char** argv) {
    Settings settings;
    CLI::App program("Tables of docs/design/skin-error.md", "model_error");
    program.add_option("--photons", settings.photons, "For each channel and tissue")->capture_default_str();
    program.add_option("--seed", settings.seed, "Of the random numbers")->capture_default_str();
    CLI11_PARSE(program, argc, argv);
    fmt::print("{} photons for each channel, seed {}\n\n", settings.photons, settings.seed);
    const SimulatedSkin skin = simulateSkin(settings.photons, settings.seed);
    checks(settings, skin);
    slabs(settings);
    errors(skin);
    return 0;
}

} // namespace

} // namespace tegument::reference

int main(int argc, char** argv) {
    return tegument::reference::run(argc, argv);
}
