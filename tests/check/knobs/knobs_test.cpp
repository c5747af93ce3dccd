// Each parameter that `tegument info` lists is turned in each technique that reads it, and the picture changes.

#include "host/run/pixels.h"
#include "host/run/session.h"
#include "meshprep/assets/job.h"
#include "tests/gpu/with_device.h"
#include "tests/spirv/missing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

/// EFFECT/PARAMETER, or EFFECT/TECHNIQUE/PARAMETER, and why it may change nothing.
const std::map<std::string, std::string> kExceptions = {
    {"Convolution/WhitePoisson/gBlurCount", "constant light is what every blur of it is: that is what the technique shows"},
    {"Convolution/WhitePoisson/gBlurSize", "the same"},
    {"Convolution/WhitePoisson/gBlurTurn", "the same"},
    {"Culling/gBlackColor", "marks texels whose colour is black, of which the default head has none; tests/cli/modules_test.cpp has them"},
};

std::vector<fs::path> ownEffects() {
    std::vector<fs::path> files;
    for (const char* folder : {"effects", "effects/peers"})
        for (const auto& entry : fs::directory_iterator(folder))
            if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

bool isListed(const Parameter& parameter) {
    return parameter.type.isNumeric() && parameter.defaultValue && parameter.annotations.string("UIName") && !parameter.isTarget() &&
           parameter.annotations.string("UIWidget").value_or("") != "None";
}

/// Values far from the default one, the likeliest to show first.
std::vector<std::vector<double>> turned(const Parameter& parameter) {
    const auto* given = std::get_if<std::vector<double>>(&*parameter.defaultValue);
    const std::vector<double> usual = given ? *given : std::vector<double>(static_cast<std::size_t>(parameter.type.scalarCount()), 0.0);
    const auto bound = [&](const char* name, double otherwise) {
        const auto numbers = parameter.annotations.numbers(name);
        return numbers && !numbers->empty() ? numbers->front() : otherwise;
    };
    const double least = bound("UIMin", 0), most = bound("UIMax", 2 * usual.front() + 1);
    std::vector<std::vector<double>> all;
    for (const double share : {0.9, 0.1, 0.5, 1.0, 0.0}) {
        std::vector<double> values = usual;
        for (double& value : values)
            value = parameter.type.base == BaseType::Float ? least + share * (most - least) : std::round(least + share * (most - least));
        if (values != usual) all.push_back(values);
    }
    return all;
}

class Knobs : public WithDevice, public testing::WithParamInterface<fs::path> {
protected:
    void SetUp() override {
        if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
        WithDevice::SetUp();
    }

    std::vector<float> drawn(EffectSession& session, const assets::Job& job, std::vector<std::string>* read = nullptr) {
        const auto frame = session.draw(job.scene.workspace, job.run);
        EXPECT_TRUE(frame) << format(frame.error());
        if (!frame) return {};
        if (read) *read = frame->parameters;
        const auto image = run::readBack(*device_, *session.target({}));
        return image ? image->pixels : std::vector<float>();
    }

    /// Notes which techniques show a parameter, and which read it in vain. `values`: of the effect's parameters, where it has them.
    void turnEach(const std::vector<std::string>& switches, const std::map<std::string, std::vector<double>>& values) {
        const std::string name = GetParam().stem().string();
        const int texels = name == "Main" || name == "Convolution" ? 512 : 64; // Gosselin's blurs are narrower than a texel of 64
        auto job = assets::loadJob({.file = GetParam().string(),
                                    .effect = {.defines = switches, .mapSize = texels, .shadowSize = 64},
                                    .size = "64",
                                    .samples = 1,
                                    .compiler = "dxc"},
                                   assets::MeshFor::AnyTechnique);
        if (!job && job.error().diagnostics.front().code == 5405) GTEST_SKIP() << format(job.error());
        ASSERT_TRUE(job) << format(job.error());
        job->run.keepUnchanged = true;
        for (const auto& [parameter, value] : values)
            if (job->effect.findParameter(parameter)) job->run.parameters[parameter] = value;
        EffectSession session(*device_, job->effect, assets::sessionScene(job->scene));
        for (const Technique& technique : job->effect.techniques) {
            job->run.technique = technique.name;
            std::vector<std::string> read;
            const std::vector<float> before = drawn(session, *job, &read);
            for (const Parameter& parameter : job->effect.parameters)
                if (isListed(parameter) && std::ranges::find(read, parameter.name) != read.end() &&
                    !shown_.contains(technique.name + "/" + parameter.name))
                    (changes(session, *job, parameter, before) ? shown_ : still_).insert(technique.name + "/" + parameter.name);
        }
    }

    bool changes(EffectSession& session, assets::Job& job, const Parameter& parameter, const std::vector<float>& before) {
        const RunOptions usual = job.run;
        const auto shows = [&](const std::vector<double>& value) {
            job.run.parameters[parameter.name] = value;
            return drawn(session, job) != before;
        };
        const auto values = turned(parameter);
        const bool any = std::ranges::any_of(values, shows);
        job.run = usual;
        return any;
    }

    std::set<std::string> shown_, still_; // TECHNIQUE/PARAMETER
};

} // namespace

/// What no technique of the effect reads, since it comes with an include, is told by TG8029.
TEST_P(Knobs, each_listed_parameter_changes_the_picture_of_the_techniques_that_read_it) {
    turnEach({}, {{"gFurShare", {0.02}}});
    if (IsSkipped()) return;
    turnEach({"TEGUMENT_SURROUNDINGS=1", "TEGUMENT_LAMPS=2", "TEGUMENT_LAMP_SHADOWS=2", "TEGUMENT_SOFT_SHADOWS=1", "TEGUMENT_LOBES=1"},
             {{"gFurShare", {0.02}}, {"gMelanin", {0.02}}});
    const std::string effect = GetParam().stem().string() + "/";
    for (const std::string& one : still_)
        if (!shown_.contains(one) && !kExceptions.contains(effect + one) && !kExceptions.contains(effect + one.substr(one.find('/') + 1)))
            ADD_FAILURE() << effect << one << " is read and changes nothing";
    fmt::print("{} {} pairs of a technique and a parameter that it reads, {} of them shown\n", effect,
               shown_.size() + std::ranges::count_if(still_, [&](const auto& one) { return !shown_.contains(one); }), shown_.size());
}

INSTANTIATE_TEST_SUITE_P(Each, Knobs, testing::ValuesIn(ownEffects()),
                         [](const testing::TestParamInfo<fs::path>& info) { return info.param.stem().string(); });

} // namespace tegument::test
