// What reflection makes of modules that no compiler here writes, and of types that a Reflection cannot express.

#include "host/spirv/reflect.h"
#include "host/spirv/validate.h"
#include "tests/spirv/missing.h"
#include "tests/spirv/support.h"

#include <spirv_cross/spirv_cross.hpp>

#include <algorithm>

namespace tegument::test {
namespace {

constexpr std::string_view kVertex = R"(
struct Varying { float4 position : SV_Position; float4 colour : COLOR0; float2 uv : TEXCOORD0; float3 normal : TEXCOORD1; int kind : TEXCOORD2; float2 taps[2] : TEXCOORD3; };
Varying VS(float3 position : POSITION)
{ Varying o; o.position = float4(position, 1); o.colour = 1; o.uv = position.xy; o.normal = position; o.kind = 3; o.taps[0] = 1; o.taps[1] = position.yz; return o; }
)";

/// How many input variables the SPIR-V has at each location.
std::map<std::uint32_t, int> inputLocations(const Shader& shader) {
    std::map<std::uint32_t, int> found;
    const spirv_cross::Compiler module(shader.spirv);
    for (const auto& input : module.get_shader_resources().stage_inputs)
        ++found[module.get_decoration(input.id, spv::DecorationLocation)];
    return found;
}

class Link : public EachCompiler {
protected:
    [[nodiscard]] Shader vertex() const { return compile(kVertex, "VS", ShaderStage::Vertex); }
    [[nodiscard]] Shader pixel(const std::string& arguments, const std::string& value) const {
        return compile("float4 PS(" + arguments + ") : SV_Target { return " + value + "; }", "PS", ShaderStage::Pixel);
    }
    [[nodiscard]] static std::uint32_t locationOf(const Shader& shader, const std::string& semantic) {
        return locations(shader.reflection.outputs).at(semantic);
    }
};
INSTANTIATE_TEST_SUITE_P(By, Link, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

TEST_P(Link, a_pixel_shader_with_fewer_members_reads_the_locations_that_the_vertex_shader_writes) {
    const Shader from = vertex();
    Shader to = pixel("float3 normal : TEXCOORD1, float2 uv : TEXCOORD0", "float4(normal, uv.x)");
    EXPECT_EQ(inputLocations(to), (std::map<std::uint32_t, int>{{0, 1}, {1, 1}}));
    const auto linked = linkStages(from, to);
    ASSERT_TRUE(linked) << format(linked.error());
    EXPECT_EQ(locations(to.reflection.inputs), (std::map<std::string, std::uint32_t>{{"TEXCOORD0", locationOf(from, "TEXCOORD0")},
                                                                                     {"TEXCOORD1", locationOf(from, "TEXCOORD1")}}));
    EXPECT_EQ(inputLocations(to), (std::map<std::uint32_t, int>{{locationOf(from, "TEXCOORD0"), 1}, {locationOf(from, "TEXCOORD1"), 1}}));
    EXPECT_EQ(spirv::validate(to.spirv), "");
}

TEST_P(Link, a_module_that_is_whole_but_not_valid_is_told) {
    Shader shader = vertex();
    shader.spirv[3] = 1; // the bound of ids, which all of them reach
    EXPECT_NE(spirv::validate(shader.spirv), "");
}

TEST_P(Link, swapped_members_are_matched_by_semantic) {
    const Shader from = vertex();
    Shader to = pixel("float2 uv : TEXCOORD0, float4 colour : COLOR0", "colour * uv.x");
    ASSERT_TRUE(linkStages(from, to));
    EXPECT_EQ(locations(to.reflection.inputs).at("COLOR0"), locationOf(from, "COLOR0"));
    EXPECT_EQ(locations(to.reflection.inputs).at("TEXCOORD0"), locationOf(from, "TEXCOORD0"));
}

TEST_P(Link, an_array_moves_as_a_whole) {
    const Shader from = vertex();
    Shader to = pixel("float2 taps[2] : TEXCOORD3", "taps[1].xyxy");
    ASSERT_TRUE(linkStages(from, to));
    EXPECT_EQ(locations(to.reflection.inputs).at("TEXCOORD4"), locationOf(from, "TEXCOORD4"));
}

TEST_P(Link, linking_twice_changes_nothing) {
    const Shader from = vertex();
    Shader to = pixel("float3 normal : TEXCOORD1", "normal.xyzz");
    ASSERT_TRUE(linkStages(from, to));
    const Shader once = to;
    ASSERT_TRUE(linkStages(from, to));
    EXPECT_EQ(to.spirv, once.spirv);
}

TEST_P(Link, an_input_that_nobody_writes_is_an_error_that_names_it) {
    Shader to = pixel("float4 colour : COLOR1", "colour");
    const auto linked = linkStages(vertex(), to);
    ASSERT_FALSE(linked);
    EXPECT_EQ(linked.error().diagnostics[0].code, 3004);
    EXPECT_EQ(linked.error().diagnostics[0].text, "pixel shader PS reads COLOR1, which vertex shader VS does not write");
}

TEST_P(Link, an_input_that_is_declared_but_not_read_needs_no_output) {
    Shader to = pixel("float4 colour : COLOR1, float2 uv : TEXCOORD0", "uv.xyxy");
    EXPECT_TRUE(linkStages(vertex(), to));
}

TEST_P(Link, more_components_than_written_are_an_error) {
    Shader to = pixel("float4 uv : TEXCOORD0", "uv");
    const auto linked = linkStages(vertex(), to);
    ASSERT_FALSE(linked);
    EXPECT_EQ(linked.error().diagnostics[0].code, 3005);
    EXPECT_EQ(linked.error().diagnostics[0].text, "pixel shader PS reads TEXCOORD0 as float4, vertex shader VS writes it as float2");
}

TEST_P(Link, another_base_type_is_an_error) {
    Shader to = pixel("float kind : TEXCOORD2", "kind");
    const auto linked = linkStages(vertex(), to);
    ASSERT_FALSE(linked);
    EXPECT_EQ(linked.error().diagnostics[0].code, 3005);
}

TEST_P(Link, semantics_match_whatever_their_case_and_a_missing_index_is_zero) {
    Shader to = pixel("float4 colour : Color", "colour");
    EXPECT_TRUE(linkStages(vertex(), to));
}

class Layout : public CompileTest {
protected:
    void SetUp() override {
        if (const std::string missing = test::compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    }

    [[nodiscard]] static Shader compile(std::string_view code, ShaderStage stage, Compiler compiler) {
        auto shader = compileShader({.code = code, .file = "test.fx", .entry = "Main", .stage = stage}, compiler);
        if (shader) return std::move(*shader);
        ADD_FAILURE() << compilerName(compiler) << ": " << format(shader.error());
        return {};
    }

    /// Compiles `parameters` and a shader that returns `value` with both, expects no difference, and gives DXC's view.
    static Shader agreed(const std::string& parameters, const std::string& value) {
        const std::string code = parameters + "\nfloat4 Main(float3 uv : TEXCOORD0) : SV_Target0 { return " + value + "; }";
        Shader dxc = compile(code, ShaderStage::Pixel, Compiler::Dxc);
        for (const std::string& difference :
             compareReflections(dxc.reflection, compile(code, ShaderStage::Pixel, Compiler::Glslang).reflection))
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
    const auto differences = compareReflections(compile(code, ShaderStage::Pixel, Compiler::Dxc).reflection,
                                                compile(code, ShaderStage::Pixel, Compiler::Glslang).reflection);
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

constexpr int kUnreadable = 3003;

TEST(Reflect, words_that_are_no_module_are_an_error) {
    for (std::vector<std::uint32_t> words : {std::vector<std::uint32_t>{}, {0x07230203}, std::vector<std::uint32_t>(64, 0x12345678)}) {
        const auto reflection = spirv::reflect(words, ShaderStage::Pixel, 1, "test.fx");
        ASSERT_FALSE(reflection);
        EXPECT_EQ(reflection.error().diagnostics[0].code, kUnreadable);
        EXPECT_FALSE(spirv::writesPosition(words));
    }
}

TEST(Reflect, a_shader_whose_words_are_lost_cannot_be_linked_and_stays_as_it_is) {
    Shader vertex{.stage = ShaderStage::Vertex, .file = "test.fx", .entry = "VS"};
    vertex.reflection.outputs = {{.semantic = "TEXCOORD0", .location = 3}};
    Shader pixel{.stage = ShaderStage::Pixel, .file = "test.fx", .entry = "PS", .spirv = {1, 2, 3}};
    pixel.reflection.inputs = {{.semantic = "TEXCOORD0", .location = 0}};
    const auto linked = linkStages(vertex, pixel);
    ASSERT_FALSE(linked);
    EXPECT_EQ(linked.error().diagnostics[0].code, kUnreadable);
    EXPECT_EQ(pixel.reflection.inputs[0].location, 0U);
}

using Reflected = EachCompiler;
INSTANTIATE_TEST_SUITE_P(By, Reflected, testing::Values(Compiler::Dxc, Compiler::Glslang), compilerTestName);

TEST_P(Reflected, numbers_of_64_bits_are_refused_with_their_name_also_in_vectors) {
    for (const std::string type : {"double", "double2"}) {
        const auto shader =
            tryCompile(type + " gFine; float4 PS() : SV_Target { return (float)(gFine * 2.0L).x; }", "PS", ShaderStage::Pixel);
        ASSERT_FALSE(shader) << type;
        EXPECT_EQ(shader.error().diagnostics.front().code, 3006) << format(shader.error());
        EXPECT_NE(shader.error().diagnostics.front().text.find("gFine"), std::string::npos);
    }
}

TEST_P(Reflected, of_an_input_array_the_elements_that_are_read_are_listed) {
    const std::string head = "int gAt; float4 PS(float2 uv[3] : TEXCOORD4) : SV_Target { return uv[";
    const std::map<std::string, std::uint32_t> all{{"TEXCOORD4", 0}, {"TEXCOORD5", 1}, {"TEXCOORD6", 2}};
    EXPECT_EQ(locations(compile(head + "gAt].xyxy; }", "PS", ShaderStage::Pixel).reflection.inputs), all)
        << "a computed index may reach each";
    const auto one = locations(compile(head + "1].xyxy; }", "PS", ShaderStage::Pixel).reflection.inputs);
    if (GetParam() == Compiler::Dxc)
        EXPECT_EQ(one, (std::map<std::string, std::uint32_t>{{"TEXCOORD5", 1}}));
    else
        EXPECT_EQ(one, all) << "glslang copies the array before it indexes";
}

} // namespace
} // namespace tegument::test
