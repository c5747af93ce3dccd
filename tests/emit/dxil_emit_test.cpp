// What is written for Direct3D 12. DXC's validator is the judge: it refuses a shader whose root signature does not bind all that the shader
// reads.

#include "tools/emit/emit.h"

#include "host/spirv/dxil.h"
#include "host/support/file.h"
#include "tests/spirv/missing.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class DxilEmit : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
        const CheckReport checked = checkEffects({"effects/Pyramid.fx"}, {Target::Dxil});
        report_ = checked.files.at(0);
        const auto written = emitEffect(report_, {.folder = folder_, .kinds = {EmitKind::Dxil}, .defines = {}});
        ASSERT_TRUE(written) << format(written.error());
        written_ = *written;
        manifest_ = json::parse(*readFile(written_ / "manifest.json"));
    }
    ~DxilEmit() override { fs::remove_all(folder_); }

    [[nodiscard]] const json& shader(const std::string& name) const {
        return *std::ranges::find_if(manifest_["shaders"], [&](const json& one) { return one["name"] == name; });
    }
    /// The entry point again, with this root signature in front of it.
    [[nodiscard]] bool serves(const std::string& name, Stage stage, const std::string& signature) const {
        const std::string entry = shader(name)["entry"];
        const std::regex definition(fmt::format("\\b((?:void|float4|[A-Z]\\w*)\\s+{}\\s*\\()", entry));
        const std::string code = std::regex_replace(report_.effect.code, definition, fmt::format("[RootSignature(\"{}\")] $1", signature));
        EXPECT_TRUE(code != report_.effect.code) << entry << " is not found";
        const auto made =
            compileDxil({.code = code, .file = "effects/Pyramid.fx", .entry = entry, .stage = stage, .defines = {}, .includeFolders = {}});
        if (!made) error_ = format(made.error());
        return static_cast<bool>(made);
    }

    FileReport report_;
    fs::path written_;
    json manifest_;
    mutable std::string error_;

private:
    fs::path folder_ = fs::temp_directory_path() / fmt::format("tegument-dxil-emit-{}", ::getpid());
};

constexpr std::pair<const char*, Stage> kStages[] = {
    {"vertex_shader", Stage::Vertex}, {"pixel_shader", Stage::Pixel}, {"compute_shader", Stage::Compute}};

TEST_F(DxilEmit, the_root_signature_of_every_pass_binds_what_its_shaders_read) {
    int held = 0;
    for (const json& technique : manifest_["techniques"])
        for (const json& pass : technique["passes"])
            for (const auto& [key, stage] : kStages) {
                if (!pass.contains(key)) continue;
                EXPECT_TRUE(serves(pass[key], stage, pass["root_signature"])) << technique["name"] << pass["name"] << key << error_;
                ++held;
            }
    EXPECT_GT(held, 20);
}

TEST_F(DxilEmit, a_root_signature_with_a_texture_less_is_refused) {
    const json& pass = manifest_["techniques"][0]["passes"].back();
    const std::string whole = pass["root_signature"];
    const std::regex textures("SRV\\(t0, numDescriptors=(\\d+)\\)");
    std::smatch count;
    ASSERT_TRUE(std::regex_search(whole, count, textures)) << whole;
    const std::string less = std::regex_replace(whole, textures, fmt::format("SRV(t0, numDescriptors={})", std::stoi(count[1].str()) - 1));
    EXPECT_FALSE(serves(pass["pixel_shader"], Stage::Pixel, less));
}

/// Shader model 5 for Direct3D 11 and 12, model 6 for 12: two compilers, one signature.
TEST_F(DxilEmit, the_same_root_signature_serves_shader_model_5) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
    const CheckReport checked = checkEffects({"effects/Pyramid.fx"}, {Target::Sm5});
    const auto written =
        emitEffect(checked.files.at(0), {.folder = written_.parent_path() / "sm5", .kinds = {EmitKind::Sm5}, .defines = {}});
    ASSERT_TRUE(written) << format(written.error());
    const json other = json::parse(*readFile(*written / "manifest.json"));
    for (std::size_t t = 0; t < manifest_["techniques"].size(); ++t)
        for (std::size_t p = 0; p < manifest_["techniques"][t]["passes"].size(); ++p)
            EXPECT_EQ(manifest_["techniques"][t]["passes"][p].at("root_signature").get<std::string>(),
                      other["techniques"][t]["passes"][p].at("root_signature").get<std::string>());
    const auto& shaders = other["shaders"];
    const auto entry = std::ranges::find_if(shaders, [](const json& one) { return one["name"] == "EntryCS"; });
    ASSERT_NE(entry, shaders.end());
    EXPECT_EQ((*entry)["threads"], json({8, 8, 1})); // numthreads in effects/passes/pyramid_compute.fxh
}

TEST_F(DxilEmit, the_manifest_says_where_every_constant_and_texture_lies) {
    const json& pass = manifest_["techniques"][0]["passes"].back();
    const json& dxil = shader(pass["pixel_shader"])["dxil"];
    const auto bytes = readFile(written_ / dxil["file"].get<std::string>());
    ASSERT_TRUE(bytes);
    EXPECT_TRUE(bytes->starts_with("DXBC"));
    ASSERT_EQ(dxil["constants"].size(), 1U);
    EXPECT_EQ(dxil["constants"][0]["register"], 0);
    EXPECT_FALSE(dxil["constants"][0]["members"].empty());
    std::set<std::pair<bool, int>> places; // samplers count for themselves
    for (const json& resource : dxil["resources"])
        EXPECT_TRUE(places.emplace(resource["kind"] == "Sampler", resource["register"]).second) << resource;
    EXPECT_GT(places.size(), 4U);
    EXPECT_TRUE(std::ranges::any_of(dxil["outputs"], [](const json& one) { return one["semantic"] == "SV_TARGET0"; }));
}

} // namespace
} // namespace tegument::test
