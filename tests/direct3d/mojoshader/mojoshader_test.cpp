// Effects compiled for fx_2_0, read by MojoShader: its techniques, passes, parameters and samplers are ours, and it translates each shader.

#include "host/effect/load.h"
#include "host/support/children.h"
#include "host/support/file.h"
#include "tests/check/effect_files.h"
#include "tools/emit/emit.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>
#include <shared_mutex>
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
    if (type.members) return fmt::format("structure of {}", type.elements);
    return fmt::format("{} x {} of {}", type.rows, type.columns, type.elements);
}
std::string shapeOf(const MOJOSHADER_effectValue& value) {
    if (value.type.parameter_type == MOJOSHADER_SYMTYPE_STRING) return "string";
    if (isTexture(value.type.parameter_type)) return "texture";
    const MOJOSHADER_symbolTypeInfo& type = value.type;
    if (type.parameter_class == MOJOSHADER_SYMCLASS_STRUCT) return fmt::format("structure of {}", type.elements);
    const bool vector =
        type.parameter_class != MOJOSHADER_SYMCLASS_MATRIX_COLUMNS && type.parameter_class != MOJOSHADER_SYMCLASS_MATRIX_ROWS;
    // The binary has the rows of a matrix first, which MojoShader takes for its columns.
    return fmt::format("{} x {} of {}", vector ? type.rows : type.columns, vector ? type.columns : type.rows, type.elements);
}

/// Preshaders of these have instructions at which this version of MojoShader ends the program.
const std::set<std::string> kUnread = {"FurSkin", "Ladder", "Pyramid", "SkinPost"};

using Read = std::unique_ptr<const MOJOSHADER_effect, Deleted>;

/// What --emit-kind fx_2_0 writes.
Result<std::string> emitted(const FileReport& file, const fs::path& folder) {
    const auto written = emitEffect(file, {.folder = folder, .kinds = {Target::Fx2}});
    if (!written) return written.error();
    return readFile(*written / (file.file.stem().string() + ".fx_2_0.fxo"));
}

Read readBinary(const std::string& binary) {
    gRefused.clear();
    const MOJOSHADER_effectShaderContext ours = context();
    return Read(MOJOSHADER_compileEffect(reinterpret_cast<const unsigned char*>(binary.data()), static_cast<unsigned>(binary.size()),
                                         nullptr, 0, nullptr, 0, &ours));
}

using Names = std::map<std::string, std::vector<std::string>>;

/// Where MojoShader's techniques, passes, parameters and samplers are not ours: a line each.
std::string differences(const Effect& ours, const MOJOSHADER_effect& theirs) {
    std::string lines;
    Names passes;
    for (int t = 0; t < theirs.technique_count; ++t) {
        const MOJOSHADER_effectTechnique& technique = theirs.techniques[t];
        for (unsigned p = 0; p < technique.pass_count; ++p)
            passes[technique.name == nullptr ? "" : technique.name].emplace_back(
                technique.passes[p].name == nullptr ? "" : technique.passes[p].name);
    }
    Names expected;
    for (const Technique& technique : ours.techniques)
        if (technique.kind == TechniqueKind::D3D9)
            for (const Pass& pass : technique.passes)
                expected[technique.name].push_back(pass.name);
    if (passes != expected) lines += fmt::format("passes {} are {}\n", expected, passes);

    std::map<std::string, std::string> parameters;
    std::set<std::string> samplers;
    for (int i = 0; i < theirs.param_count; ++i) {
        const MOJOSHADER_effectValue& value = theirs.params[i].value;
        if (isSampler(value.type.parameter_type))
            samplers.insert(value.name);
        else
            parameters[value.name] = shapeOf(value);
    }
    for (const Parameter& parameter : ours.parameters)
        if (parameters[parameter.name] != shapeOf(parameter))
            lines += fmt::format("parameter {} {} is {}\n", parameter.name, shapeOf(parameter), parameters[parameter.name]);
    std::set<std::string> named; // an array's are name[0] and so on here
    for (const Sampler& sampler : ours.samplers)
        named.insert(sampler.name.substr(0, sampler.name.find('[')));
    if (samplers != named) lines += fmt::format("samplers {} are {}\n", named, samplers);
    return lines;
}

class MojoShader : public testing::TestWithParam<fs::path> {
protected:
    MojoShader() : folder_(fs::temp_directory_path() / fmt::format("tegument-mojoshader-{}", ::getpid())) {}
    ~MojoShader() override { fs::remove_all(folder_); }

    /// Null: the effect has no technique for fx_2_0.
    [[nodiscard]] Read read(const fs::path& file) const {
        // MojoShader translates no centroid.
        const CheckReport report = checkEffects({file}, {Target::Fx2}, {.variants = {{.name = "", .defines = {{"centroid", ""}}}}});
        const auto binary = emitted(report.files.at(0), folder_);
        return binary ? readBinary(*binary) : nullptr;
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
    EXPECT_EQ(differences(*ours, *theirs), "");
}

INSTANTIATE_TEST_SUITE_P(Effects, MojoShader, testing::ValuesIn(effectFiles()), effectName);

/// At most so many, evenly from the folder and those below it.
std::vector<fs::path> foreignFiles(const fs::path& folder, std::size_t most) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".fx") files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<fs::path> some;
    for (std::size_t i = 0; i < std::min(most, files.size()); ++i)
        some.push_back(files[i * files.size() / std::min(most, files.size())]);
    return some;
}

/// Each in a process of its own: at some preshaders MojoShader ends the program.
TEST(MojoShaderOfOthers, has_what_their_effects_have) {
    const char* folder = std::getenv("TEGUMENT_FOREIGN_EFFECTS");
    if (folder == nullptr) GTEST_SKIP() << "TEGUMENT_FOREIGN_EFFECTS names a folder of other hosts' effects, 40 at least";
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    constexpr double kSeconds = 60;
    constexpr std::size_t kMost = 160;
    constexpr std::size_t kLeast = 40;
    const std::vector<fs::path> files = foreignFiles(folder, kMost);
    CheckOptions options{.variants = {{.name = "", .defines = {{"centroid", ""}}}}};
    options.roots.folders.emplace_back(folder);
    const CheckReport report = checkEffects(files, {Target::Fx2}, options);
    const fs::path to = fs::temp_directory_path() / fmt::format("tegument-mojoshader-{}", ::getpid());
    std::shared_mutex busy;
    Children workers(
        [&](std::string_view index) {
            const FileReport& file = report.files.at(std::stoul(std::string(index)));
            LoadOptions load{.lenient = true};
            load.roots = options.roots;
            const auto ours = loadEffectOfDirect3D9(file.file, load);
            const auto binary = emitted(file, to / std::string(index));
            if (!ours || !binary) return std::string("not compiled");
            const Read theirs = readBinary(*binary);
            if (!theirs || theirs->error_count > 0) return fmt::format("refused: {}", theirs ? theirs->errors[0].error : "no memory");
            return differences(*ours, *theirs);
        },
        busy);
    std::size_t compared = 0;
    std::map<std::string, int> left;
    for (std::size_t i = 0; i < report.files.size(); ++i) {
        const ChildAnswer answer = workers.ask(std::to_string(i), kSeconds);
        if (!answer.answered || answer.bytes == "not compiled" || answer.bytes.starts_with("refused")) {
            ++left[answer.answered ? answer.bytes : "MojoShader ends the program"];
            continue;
        }
        ++compared;
        EXPECT_EQ(answer.bytes, "") << files[i];
    }
    fs::remove_all(to);
    fmt::print("{} of {} compared\n", compared, files.size());
    for (const auto& [why, count] : left)
        fmt::print("{:>5} {}\n", count, why);
    EXPECT_GE(compared, kLeast);
}

#else

TEST(MojoShader, is_there) {
    GTEST_SKIP() << "libmojoshader-dev (Debian) is not installed";
}

#endif

} // namespace
} // namespace tegument::test
