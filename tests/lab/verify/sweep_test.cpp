// Every parameter at both ends of what its slider allows: no target holds anything that is not finite. And white in, at most white out.

#include "host/effect/model.h"
#include "host/image/dds.h"
#include "host/run/parts.h"
#include "host/run/run.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "tests/lab/verify/fixture.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

using namespace tegument;
using namespace tegument::test;

namespace {

struct Sweep {
    std::string effect;
    std::string technique;
    int setting = 2;
    bool oneByOne = true;
};

void PrintTo(const Sweep& sweep, std::ostream* out) {
    *out << sweep.effect << ", " << sweep.technique << ", setting " << sweep.setting;
}

LoadOptions load(int setting, int mapSize) {
    return {.defines = {{"TEGUMENT_SETTING", std::to_string(setting)}, {"TEGUMENT_MAP_SIZE", std::to_string(mapSize)}}};
}

/// Every technique of every effect that draws skin or its tables.
std::vector<Sweep> sweeps(int setting) {
    std::vector<Sweep> all;
    for (const std::string& module : verifiableModules()) {
        const auto effect = loadEffect("effects/" + module + ".fx", load(setting, 64));
        if (!effect) continue;
        for (const Technique& technique : effect->techniques)
            all.push_back({module, technique.name, setting});
    }
    return all;
}

std::vector<Sweep> sweepsOfEverySetting() {
    std::vector<Sweep> all;
    for (int setting : {0, 1, 2})
        for (Sweep& sweep : sweeps(setting))
            all.push_back(std::move(sweep));
    return all;
}

const Mesh& body() {
    static const Mesh kMesh = verificationMesh();
    return kMesh;
}

/// The same with strands, and the file of their roots.
struct FurryBody {
    Mesh mesh = verificationMesh();
    std::filesystem::path roots = std::filesystem::temp_directory_path() / ("sweep_roots_" + std::to_string(::getpid()) + ".dds");

    FurryBody() {
        const auto grown = growRibbons(mesh, {.count = 400});
        EXPECT_TRUE(grown) << format(grown.error());
        EXPECT_TRUE(grown && writeDds(roots, {.format = DdsFormat::Rgba32F, .images = {*grown}}));
    }
    FurryBody(const FurryBody&) = delete;
    FurryBody& operator=(const FurryBody&) = delete;
    ~FurryBody() {
        std::error_code ignored;
        std::filesystem::remove(roots, ignored);
    }
};

const FurryBody& furryBody() {
    static const FurryBody kBody;
    return kBody;
}

Workspace fromTheSide() {
    Workspace workspace;
    workspace.head = false;
    workspace.camera.position = {2, 1, 4};
    workspace.light.position = {-3, 3, 4};
    return workspace;
}

/// Value of every slider with a range: parameters that the script counts with are left alone.
using Ends = std::vector<std::pair<std::string, std::pair<std::vector<double>, std::vector<double>>>>;
Ends endsOf(const Effect& effect) {
    Ends ends;
    for (const Parameter& parameter : effect.parameters) {
        const auto low = parameter.annotations.numbers("UIMin");
        const auto high = parameter.annotations.numbers("UIMax");
        if (!parameter.type.isNumeric() || !low || !high) continue;
        const auto count = static_cast<std::size_t>(parameter.type.scalarCount());
        ends.push_back({parameter.name, {std::vector<double>(count, low->front()), std::vector<double>(count, high->front())}});
    }
    return ends;
}

/// All at the low, all at the high end; and, `oneByOne`, the defaults but one, for each end of each.
std::vector<std::map<std::string, std::vector<double>>> variations(const Ends& ends, bool oneByOne) {
    std::vector<std::map<std::string, std::vector<double>>> all(2);
    for (const auto& [name, values] : ends) {
        all[0][name] = values.first;
        all[1][name] = values.second;
        if (!oneByOne) continue;
        all.push_back({{name, values.first}});
        all.push_back({{name, values.second}});
    }
    return all;
}

std::string text(const std::map<std::string, std::vector<double>>& parameters) {
    std::string all;
    for (const auto& [name, values] : parameters)
        all += name + "=" + std::to_string(values.front()) + " ";
    return all;
}

void expectFinite(const Image& image, const std::string& target) {
    const auto bad = std::ranges::count_if(image.pixels, [](float value) { return !std::isfinite(value); });
    EXPECT_EQ(bad, 0) << target;
}

class Sliders : public Verify, public testing::WithParamInterface<Sweep> {};

const auto kSweepName = [](const auto& each) {
    return each.param.effect + "_" + each.param.technique + "_" + std::to_string(each.param.setting);
};

class Furnace : public Verify {
protected:
    /// The largest value of a picture of Main.fx: white skin without reflection, light of colour 1.
    double brightest(const std::string& setting, double transmission) {
        static const std::vector<std::string> kSettings = {"seed", "deon2007", "corrected"};
        const auto number = static_cast<int>(std::ranges::find(kSettings, setting) - kSettings.begin());
        const auto effect = loadEffect("effects/Main.fx", load(number, 128));
        Mesh white = body();
        white.textures = {{.role = "color", .image = {.width = 1, .height = 1, .channels = 4, .pixels = {1, 1, 1, 1}}}};
        const auto run = runEffect(*device_, *effect, &white, fromTheSide(),
                                   {.technique = "DEonLuebke",
                                    .width = 128,
                                    .height = 128,
                                    .compiler = defaultCompiler(),
                                    .parameters = {{"gSpecularIntensity", {0}}, {"gTransmission", {transmission}}}});
        EXPECT_TRUE(run) << format(run.error());
        float largest = 0;
        for (int y = 0; y < run->image.height; ++y)
            for (int x = 0; x < run->image.width; ++x)
                for (int c = 0; c < 3; ++c)
                    largest = std::max(largest, run->image.at(x, y, c));
        return largest;
    }
};

} // namespace

TEST_P(Sliders, leave_every_target_finite_at_both_ends) {
    const Sweep& sweep = GetParam();
    const auto effect = loadEffect("effects/" + sweep.effect + ".fx", load(sweep.setting, 64));
    ASSERT_TRUE(effect) << format(effect.error());
    for (const auto& parameters : variations(endsOf(*effect), sweep.oneByOne)) {
        SCOPED_TRACE(text(parameters));
        const bool furry = run::drawsPart(*effect, kStrandsPart) || run::drawsPart(*effect, kUnderfurPart);
        std::map<std::string, std::string> textures;
        if (furry) textures["gFurRootsMap"] = furryBody().roots.string();
        const auto run = runEffect(*device_, *effect, furry ? &furryBody().mesh : &body(), fromTheSide(),
                                   {.technique = sweep.technique,
                                    .width = 48,
                                    .height = 48,
                                    .compiler = defaultCompiler(),
                                    .parameters = parameters,
                                    .textures = textures,
                                    .dump = {"all"}});
        ASSERT_TRUE(run) << format(run.error());
        expectFinite(run->image, "the picture");
        for (const auto& [target, image] : run->dumped)
            expectFinite(image, target);
    }
}

INSTANTIATE_TEST_SUITE_P(Quick, Sliders,
                         testing::Values(Sweep{"Main", "DEonLuebke", 2, false}, Sweep{"Main", "Gosselin", 2, false},
                                         Sweep{"Specular", "Specular", 2, false}, Sweep{"Irradiance", "Irradiance", 0, false}),
                         kSweepName);
INSTANTIATE_TEST_SUITE_P(Full, Sliders, testing::ValuesIn(sweepsOfEverySetting()), kSweepName);

TEST_F(Furnace, white_skin_is_never_brighter_than_the_light_that_falls_on_it) {
    EXPECT_LE(brightest("corrected", 0), 1 + 2e-3); // maps of halves
    EXPECT_LE(brightest("deon2007", 0), 1.01 + 2e-3) << "the printed kernel gains 1 %";
}

TEST_F(Furnace, light_through_thin_parts_adds_to_it_but_not_above_it) {
    // The profile is taken for a transmittance: energy is added (docs/design/skin.md). It appears where the light does not fall.
    EXPECT_LE(brightest("corrected", 1), 1 + 2e-3);
}
