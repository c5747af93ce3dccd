// Effects compiled for fx_2_0, read by MojoShader: its techniques, passes, parameters and samplers are ours, and it translates each shader.

#include "host/effect/load.h"
#include "host/support/file.h"
#include "tests/check/effect_files.h"
#include "tools/emit/emit.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <map>
#include <memory>
#include <set>
#include <tuple>

#ifdef TEGUMENT_MOJOSHADER
#include <mojoshader.h>
#include <mojoshader_effects.h>
#endif

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

#ifdef TEGUMENT_MOJOSHADER

std::string gRefused; // why MojoShader does not translate a shader

void* compileShader(const char* entry, const unsigned char* tokens, unsigned int size, const MOJOSHADER_swizzle* swizzles,
                    unsigned int swizzleCount, const MOJOSHADER_samplerMap* samplers, unsigned int samplerCount) {
    const MOJOSHADER_parseData* parsed = MOJOSHADER_parse(MOJOSHADER_PROFILE_SPIRV, entry, tokens, size, swizzles, swizzleCount, samplers,
                                                          samplerCount, nullptr, nullptr, nullptr);
    for (int i = 0; i < parsed->error_count; ++i)
        gRefused += fmt::format("{}: {}\n", entry, parsed->errors[i].error);
    return const_cast<MOJOSHADER_parseData*>(parsed);
}

MOJOSHADER_effectShaderContext context() {
    MOJOSHADER_effectShaderContext made{};
    made.compileShader = compileShader;
    made.shaderAddRef = [](void*) {};
    made.deleteShader = [](void* shader) { MOJOSHADER_freeParseData(static_cast<const MOJOSHADER_parseData*>(shader)); };
    made.getParseData = [](void* shader) { return static_cast<MOJOSHADER_parseData*>(shader); };
    made.bindShaders = [](void*, void*) {};
    made.getBoundShaders = [](void**, void**) {};
    made.mapUniformBufferMemory = [](float**, int**, unsigned char**, float**, int**, unsigned char**) {};
    made.unmapUniformBufferMemory = [] {};
    made.getError = [] { return gRefused.c_str(); };
    return made;
}

struct Deleted {
    void operator()(const MOJOSHADER_effect* effect) const { MOJOSHADER_deleteEffect(effect); }
};

bool isSampler(MOJOSHADER_symbolType type) {
    return type >= MOJOSHADER_SYMTYPE_SAMPLER && type <= MOJOSHADER_SYMTYPE_SAMPLERCUBE;
}
bool isTexture(MOJOSHADER_symbolType type) {
    return type >= MOJOSHADER_SYMTYPE_TEXTURE && type <= MOJOSHADER_SYMTYPE_TEXTURECUBE;
}

/// "float 4 x 4", "float 3 of 6", "texture".
std::string shapeOf(const Parameter& parameter) {
    const Type& type = parameter.type;
    if (type.base == BaseType::String) return "string";
    if (type.isTexture()) return "texture";
    return fmt::format("{} x {} of {}", type.rows, type.columns, type.elements);
}
std::string shapeOf(const MOJOSHADER_effectValue& value) {
    if (value.type.parameter_type == MOJOSHADER_SYMTYPE_STRING) return "string";
    if (isTexture(value.type.parameter_type)) return "texture";
    return fmt::format("{} x {} of {}", value.type.rows, value.type.columns, value.type.elements);
}

/// Preshaders of these have instructions at which this version of MojoShader ends the program.
const std::set<std::string> kUnread = {"FurSkin", "Ladder", "Pyramid", "SkinPost"};

class MojoShader : public testing::TestWithParam<fs::path> {
protected:
    MojoShader() : folder_(fs::temp_directory_path() / fmt::format("tegument-mojoshader-{}", ::getpid())) {}
    ~MojoShader() override { fs::remove_all(folder_); }

    /// Null: the effect has no technique for fx_2_0.
    [[nodiscard]] std::unique_ptr<const MOJOSHADER_effect, Deleted> read(const fs::path& file) const {
        // MojoShader translates no centroid.
        const CheckReport report = checkEffects({file}, {Target::Fx2}, {.variants = {{.name = "", .defines = {{"centroid", ""}}}}});
        const auto written = emitEffect(report.files.at(0), {.folder = folder_, .kinds = {Target::Fx2}});
        const auto binary = written ? readFile(*written / (file.stem().string() + ".fx_2_0.fxo")) : Result<std::string>(written.error());
        if (!binary) return nullptr;
        gRefused.clear();
        const MOJOSHADER_effectShaderContext ours = context();
        return std::unique_ptr<const MOJOSHADER_effect, Deleted>(MOJOSHADER_compileEffect(
            reinterpret_cast<const unsigned char*>(binary->data()), static_cast<unsigned>(binary->size()), nullptr, 0, nullptr, 0, &ours));
    }

private:
    fs::path folder_;
};

TEST_P(MojoShader, has_the_techniques_parameters_and_samplers_of_the_effect) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const auto ours = loadEffectOfDirect3D9(GetParam(), {});
    ASSERT_TRUE(ours) << format(ours.error());
    const bool old = std::ranges::any_of(ours->techniques, [](const Technique& each) { return each.kind == TechniqueKind::D3D9; });
    if (!old) return; // of compute shaders alone
    if (kUnread.contains(GetParam().stem().string())) {
        GTEST_FLAG_SET(death_test_style, "threadsafe");
        EXPECT_DEATH(std::ignore = read(GetParam()), "") << "MojoShader reads it now: take it out of the list";
        return;
    }
    const auto theirs = read(GetParam());
    ASSERT_TRUE(theirs);
    for (int i = 0; i < theirs->error_count; ++i)
        ADD_FAILURE() << theirs->errors[i].error;
    EXPECT_EQ(gRefused, "");

    std::map<std::string, std::vector<std::string>> passes;
    for (int t = 0; t < theirs->technique_count; ++t) {
        const MOJOSHADER_effectTechnique& technique = theirs->techniques[t];
        for (unsigned p = 0; p < technique.pass_count; ++p)
            passes[technique.name].emplace_back(technique.passes[p].name == nullptr ? "" : technique.passes[p].name);
    }
    std::map<std::string, std::vector<std::string>> expected;
    for (const Technique& technique : ours->techniques)
        if (technique.kind == TechniqueKind::D3D9)
            for (const Pass& pass : technique.passes)
                expected[technique.name].push_back(pass.name);
    EXPECT_EQ(passes, expected);

    std::map<std::string, std::string> parameters;
    std::set<std::string> samplers;
    for (int i = 0; i < theirs->param_count; ++i) {
        const MOJOSHADER_effectValue& value = theirs->params[i].value;
        if (isSampler(value.type.parameter_type))
            samplers.insert(value.name);
        else
            parameters[value.name] = shapeOf(value);
    }
    for (const Parameter& parameter : ours->parameters)
        EXPECT_EQ(parameters[parameter.name], shapeOf(parameter)) << parameter.name;
    for (const Sampler& sampler : ours->samplers)
        EXPECT_TRUE(samplers.contains(sampler.name)) << sampler.name;
    EXPECT_EQ(samplers.size(), ours->samplers.size());
}

INSTANTIATE_TEST_SUITE_P(Effects, MojoShader, testing::ValuesIn(effectFiles()), effectName);

#else

TEST(MojoShader, is_there) {
    GTEST_SKIP() << "libmojoshader-dev (Debian) is not installed";
}

#endif

} // namespace
} // namespace tegument::test
