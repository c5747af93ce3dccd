#include "tests/spirv/missing.h"
#include "tests/spirv/support.h"

namespace tegument::test {
namespace {

class Layout : public CompileTest {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    }

    [[nodiscard]] static Shader compile(std::string_view code, Stage stage, Compiler compiler) {
        auto shader = compileShader({.code = code, .file = "test.fx", .entry = "Main", .stage = stage, .defines = {}, .includeFolders = {}},
                                    compiler);
        if (shader) return std::move(*shader);
        ADD_FAILURE() << compilerName(compiler) << ": " << format(shader.error());
        return {};
    }

    /// Compiles `parameters` and a shader that returns `value` with both, expects no difference, and gives DXC's view.
    static Shader agreed(const std::string& parameters, const std::string& value) {
        const std::string code = parameters + "\nfloat4 Main(float3 uv : TEXCOORD0) : SV_Target0 { return " + value + "; }";
        Shader dxc = compile(code, Stage::Pixel, Compiler::Dxc);
        for (const std::string& difference : compareReflections(dxc.reflection, compile(code, Stage::Pixel, Compiler::Glslang).reflection))
            ADD_FAILURE() << difference;
        return dxc;
    }

    static void expectOffsets(const Shader& shader, const std::map<std::string, std::uint32_t>& expected) {
        for (const auto& [name, offset] : expected) {
            ASSERT_NE(member(shader, name), nullptr) << name;
            EXPECT_EQ(member(shader, name)->offset, offset) << name;
        }
    }
};

TEST_F(Layout, parameters_that_fill_sixteen_bytes_each_lie_at_the_same_offsets) {
    const Shader shader =
        agreed("float4 gA; float3 gB; float gC; float2 gD; float2 gE; float4x4 gM; float4 gArray[3]; float3 gLast; float gF;",
               "gA + float4(gB, gC) + float4(gD, gE) + mul(gA, gM) + gArray[2] + gF + gLast.xyzz");
    expectOffsets(shader,
                  {{"gA", 0}, {"gB", 16}, {"gC", 28}, {"gD", 32}, {"gE", 40}, {"gM", 48}, {"gArray", 112}, {"gLast", 160}, {"gF", 172}});
}

TEST_F(Layout, the_offset_of_a_float3_behind_a_float_is_where_the_compilers_part) {
    const std::string code = "float gF; float3 gLast; float4 Main() : SV_Target0 { return gF + gLast.xyzz; }";
    const auto differences = compareReflections(compile(code, Stage::Pixel, Compiler::Dxc).reflection,
                                                compile(code, Stage::Pixel, Compiler::Glslang).reflection);
    EXPECT_TRUE(std::ranges::any_of(differences, [](const std::string& text) { return text.starts_with("gLast: offset"); }));
}

TEST_F(Layout, int_and_bool_are_four_bytes_like_float) {
    const Shader shader = agreed("int gCount; bool gOn; float gX; float gY; float4 gEnd;", "gOn ? gX * gCount : gEnd * gY");
    expectOffsets(shader, {{"gCount", 0}, {"gOn", 4}, {"gX", 8}, {"gY", 12}, {"gEnd", 16}});
    EXPECT_EQ(member(shader, "gCount")->base, MemberBase::Int);
    EXPECT_EQ(member(shader, "gOn")->base, MemberBase::Uint) << "SPIR-V has no bool in memory";
}

TEST_F(Layout, arrays_know_their_elements_and_stride) {
    const Shader shader = agreed("float4 gKernel[6]; float4 gEnd;", "gKernel[5] + gEnd");
    ASSERT_NE(member(shader, "gKernel"), nullptr);
    EXPECT_EQ(member(shader, "gKernel")->elements, 6U);
    EXPECT_EQ(member(shader, "gKernel")->arrayStride, 16U);
    EXPECT_EQ(member(shader, "gKernel")->size, 96U);
    EXPECT_EQ(member(shader, "gEnd")->elements, 0U);
    EXPECT_EQ(shader.reflection.globals->size, 112U);
}

TEST_F(Layout, matrices_are_column_major_unless_told_otherwise) {
    const Shader shader = agreed("float4x4 gPlain; row_major float4x4 gRows; column_major float4x4 gColumns;",
                                 "mul(uv.xyzz, gPlain) + mul(uv.xyzz, gRows) + mul(uv.xyzz, gColumns)");
    EXPECT_TRUE(member(shader, "gPlain")->spirvRowMajor) << "HLSL's columns are SPIR-V's rows";
    EXPECT_TRUE(member(shader, "gColumns")->spirvRowMajor);
    EXPECT_FALSE(member(shader, "gRows")->spirvRowMajor);
    EXPECT_EQ(member(shader, "gPlain")->matrixStride, 16U);
}

TEST_F(Layout, rows_and_columns_are_those_of_hlsl) {
    const Shader shader = agreed("float4x3 gTall; float3 gPoint; float gFill;", "float4(mul(uv.xyzz, gTall) + gPoint, gFill)");
    EXPECT_EQ(member(shader, "gTall")->rows, 4U);
    EXPECT_EQ(member(shader, "gTall")->columns, 3U);
    EXPECT_EQ(member(shader, "gPoint")->rows, 1U);
    EXPECT_EQ(member(shader, "gPoint")->columns, 3U);
}

TEST_F(Layout, texture_and_cube_map_used_through_a_function_are_seen_alike) {
    const Shader shader = agreed("Texture2D gSkinMap; SamplerState gSkin; TextureCube gRoomMap; SamplerState gRoom; float4 gTint;"
                                 "float4 look(Texture2D tMap, SamplerState t, float2 uv) { return tMap.Sample(t, uv); }",
                                 "look(gSkinMap, gSkin, uv.xy) * gTint + gRoomMap.SampleLevel(gRoom, uv, 0)");
    EXPECT_EQ(shader.reflection.resources.size(), 4U);
}

TEST_F(Layout, an_element_of_an_array_counts_as_a_use_of_the_array) {
    const Shader shader = agreed("float4 gKernel[6]; float4 gOther[2]; float3 gFill; int gCount;", "gKernel[gCount]");
    EXPECT_TRUE(member(shader, "gKernel")->used);
    EXPECT_TRUE(member(shader, "gCount")->used);
    EXPECT_FALSE(member(shader, "gOther")->used);
}

TEST(CompareReflections, tells_members_sizes_resources_and_semantics_apart) {
    Reflection a;
    a.globals = UniformBlock{.name = "$Globals", .size = 16, .members = {BlockMember{.name = "gX", .size = 4}}};
    a.resources = {{.name = "gMap"}};
    a.inputs = {{.semantic = "TEXCOORD0", .components = 2}};
    EXPECT_EQ(compareReflections(a, a), std::vector<std::string>{});
    Reflection b = a;
    b.globals->members[0].offset = 4;
    b.globals->members.push_back({.name = "gY"});
    b.resources[0].kind = ResourceKind::TextureCube;
    b.inputs[0].semantic = "TEXCOORD1";
    EXPECT_EQ(compareReflections(a, b),
              (std::vector<std::string>{"gX: offset 0 and 4", "parameter gY: only in the second", "gMap: kind 1 and 3",
                                        "input TEXCOORD0: only in the first", "input TEXCOORD1: only in the second"}));
}

TEST(CompareReflections, what_nothing_uses_may_be_dropped_by_one_compiler) {
    Reflection a;
    a.globals = UniformBlock{.name = "$Globals", .size = 16, .members = {BlockMember{.name = "gX", .size = 4, .used = false}}};
    a.resources = {{.name = "gMap", .used = false}};
    EXPECT_EQ(compareReflections(a, Reflection{}), std::vector<std::string>{});
}

} // namespace
} // namespace tegument::test
