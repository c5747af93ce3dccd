#include "host/check/check.h"
#include "host/check/resources.h"

#include "host/support/file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <sstream>
#include <unistd.h>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

const std::vector<Target> kDirect3D = {Target::Fx2, Target::Fx4, Target::Fx5};

std::string describe(const FileReport& file) {
    std::string text = file.file.string() + " " + file.variant + "\n";
    for (const TargetCheck& target : file.targets) {
        text += std::string(targetName(target.target)) + " " + target.reason + "\n";
        for (const Diagnostic& diagnostic : target.diagnostics)
            text += format(diagnostic) + "\n";
    }
    return text;
}

class CheckMicrosoft : public testing::Test {
protected:
    void SetUp() override {
        if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) GTEST_SKIP() << missing;
        folder_ = fs::temp_directory_path() / ("tegument-check-d3d-" + std::to_string(::getpid()));
    }
    void TearDown() override {
        if (!folder_.empty()) fs::remove_all(folder_);
    }

    /// The dialect's prelude and `text` in one file, checked for Direct3D.
    [[nodiscard]] FileReport check(const std::string& text) const {
        const auto prelude = readFile("hlsl/platform.fxh");
        return checkPlain((prelude ? *prelude : "") + "\n" + text);
    }
    [[nodiscard]] FileReport checkPlain(const std::string& text) const {
        EXPECT_TRUE(writeFile(folder_ / "effect.fx", text));
        return checkEffects({folder_ / "effect.fx"}, kDirect3D).files.at(0);
    }

private:
    fs::path folder_;
};

const std::string kQuad = R"(
struct V { float4 position : SV_Position; float2 uv : TEXCOORD0; };
V VS(float3 position : POSITION, float2 uv : TEXCOORD0) { V o; o.position = float4(position, 1); o.uv = uv; return o; }
)";
const std::string kTechnique = R"(
#ifdef FX_TECHNIQUES
technique T { pass P { VertexShader = compile VS_MODEL VS(); PixelShader = compile PS_MODEL PS(); STATE_BUFFER; } }
#endif
)";

/// Every effect in every setting, compiled once for the tests below.
const CheckReport& allEffects() {
    static const CheckReport kReport = [] {
        std::vector<fs::path> files;
        for (const auto& entry : fs::directory_iterator("effects"))
            if (entry.path().extension() == ".fx") files.push_back(entry.path());
        std::ranges::sort(files);
        return checkEffects(files, {Target::Fx2, Target::Fx4, Target::Fx5, Target::Sm5, Target::SpirvGlslang},
                            {.variants = settingVariants(), .includeFolders = {}});
    }();
    return kReport;
}

TEST_F(CheckMicrosoft, every_effect_passes_as_direct3d_9_10_and_11_in_every_setting) {
    ASSERT_FALSE(allEffects().files.empty());
    for (const FileReport& file : allEffects().files) {
        EXPECT_FALSE(file.sm3.empty()) << describe(file);
        for (const TargetCheck& target : file.targets)
            EXPECT_EQ(target.verdict, Verdict::Passed) << describe(file);
    }
}

TEST_F(CheckMicrosoft, every_pass_of_every_effect_is_measured_against_shader_model_3) {
    for (const FileReport& file : allEffects().files) {
        std::size_t stages = 0;
        for (const Technique& technique : file.effect.techniques)
            stages += 2 * technique.passes.size();
        EXPECT_EQ(file.sm3.size(), stages) << file.file << " " << file.variant;
        for (const PassUsage& pass : file.sm3)
            for (const Sm3Limit& limit : kSm3Limits)
                EXPECT_LE(pass.usage.*limit.used, pass.profile == "vs_3_0" ? limit.vertex : limit.pixel) << pass.entry << " " << limit.what;
    }
}

/// The lines of docs/resources.md by the effect whose heading they stand under.
std::map<std::string, std::vector<std::string>> documentedRows() {
    std::map<std::string, std::vector<std::string>> rows;
    const auto text = readFile("docs/resources.md");
    std::istringstream lines(text ? *text : "");
    std::string effect;
    for (std::string line; std::getline(lines, line);) {
        if (line.starts_with("### ")) effect = line.substr(4);
        if (line.starts_with("| ") && !effect.empty()) rows[effect].push_back(line);
    }
    return rows;
}

/// All numbers behind the first three cells.
std::vector<int> numbersOf(const std::string& line) {
    std::size_t at = 0;
    for (int cell = 0; cell < 4; ++cell)
        at = line.find('|', at + (cell == 0 ? 0 : 1));
    std::vector<int> numbers;
    std::string digits;
    for (const char c : line.substr(at)) {
        if (std::isdigit(static_cast<unsigned char>(c)) != 0) digits += c;
        if (std::isdigit(static_cast<unsigned char>(c)) == 0 && !digits.empty()) numbers.push_back(std::stoi(std::exchange(digits, {})));
    }
    return numbers;
}

TEST_F(CheckMicrosoft, the_page_of_resources_tells_what_the_passes_take) {
    const auto documented = documentedRows();
    for (const ResourceRow& row : resourceTable(allEffects()).rows) {
        const std::string start = "| " + row.technique + " | " + row.pass + " | " + row.profile.substr(0, 2) + " " + row.entry + " |";
        ASSERT_TRUE(documented.contains(row.effect)) << row.effect;
        const auto& lines = documented.at(row.effect);
        const auto line = std::ranges::find_if(lines, [&](const std::string& l) { return l.starts_with(start); });
        ASSERT_NE(line, lines.end()) << row.effect << ": no row " << start
                                     << "\ntegument check effects/*.fx --all-settings --target fx_2_0 --resources prints the page's tables";
        const std::vector<int> numbers = numbersOf(*line);
        ASSERT_FALSE(numbers.empty()) << *line;
        int most = 0;
        for (const Sm3Usage& usage : row.usage)
            most = std::max(most, usage.instructionSlots);
        // Another version of the compiler schedules a few instructions otherwise; a page that is off by more misleads.
        constexpr double kShare = 0.05;
        const int largest =
            *std::max_element(numbers.begin(), numbers.begin() + static_cast<std::ptrdiff_t>(std::min(numbers.size(), row.usage.size())));
        EXPECT_NEAR(largest, most, 2 + kShare * most) << *line;
    }
}

TEST_F(CheckMicrosoft, a_shader_of_more_than_512_instructions_breaks_shader_model_3_only) {
    const std::string body = "float4 c = v.uv.xyxy; [unroll] for (int i = 0; i < 550; i++) c = c * c + gX; return c;";
    const FileReport report = check("float4 gX;" + kQuad + "float4 PS(V v) : SV_Target0 { " + body + " }" + kTechnique);
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed) << describe(report);
    EXPECT_TRUE(std::ranges::any_of(report.targets[0].diagnostics, [](const Diagnostic& d) {
        return d.code == 3203 && d.text.find("instruction slots") != std::string::npos;
    })) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
}

TEST_F(CheckMicrosoft, bit_operations_break_shader_model_3_only) {
    const FileReport report = check("int gBits; float3 gFill;" + kQuad +
                                    "float4 PS(V v) : SV_Target0 { return (gBits & 3) * v.uv.xyxy + gFill.xyzz; }" + kTechnique);
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
}

TEST_F(CheckMicrosoft, a_technique_that_one_target_does_not_see_is_missed) {
    const FileReport report = check(kQuad + "float4 PS(V v) : SV_Target0 { return v.uv.xyxy; }" + kTechnique +
                                    "#ifdef FX_D3D11\ntechnique Only11 { pass P { VertexShader = compile VS_MODEL VS(); PixelShader = "
                                    "compile PS_MODEL PS(); STATE_BUFFER; } }\n#endif\n");
    EXPECT_EQ(report.targets[0].verdict, Verdict::Failed);
    EXPECT_EQ(report.targets[1].verdict, Verdict::Failed);
    EXPECT_EQ(report.targets[2].verdict, Verdict::Passed) << describe(report);
    ASSERT_FALSE(report.targets[1].diagnostics.empty());
    EXPECT_EQ(report.targets[1].diagnostics[0].code, 3202);
    EXPECT_EQ(report.targets[1].diagnostics[0].text, "fx_4_0 holds 1 techniques, the file has 2");
}

TEST_F(CheckMicrosoft, a_plain_direct3d_9_file_is_checked_as_such_only) {
    const FileReport report = checkPlain("texture gMap;\nsampler2D gSkin = sampler_state { Texture = <gMap>; };\n"
                                         "float4 PS(float2 uv : TEXCOORD0) : COLOR0 { return tex2D(gSkin, uv); }\n"
                                         "technique T { pass P { PixelShader = compile ps_3_0 PS(); } }\n");
    EXPECT_EQ(report.targets[0].verdict, Verdict::Passed) << describe(report);
    EXPECT_EQ(report.targets[1].verdict, Verdict::NotChecked);
    EXPECT_EQ(report.targets[1].reason, "the file has no technique for fx_4_0");
    EXPECT_EQ(report.targets[2].verdict, Verdict::NotChecked);
    ASSERT_EQ(report.sm3.size(), 1U);
    EXPECT_EQ(report.sm3[0].usage.samplers, 1);
}

} // namespace
} // namespace tegument::test
