#include "tests/spirv/support.h"

#include "host/spirv/validate.h"

#include <spirv_cross/spirv_cross.hpp>

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
    [[nodiscard]] Shader vertex() const { return compile(kVertex, "VS", Stage::Vertex); }
    [[nodiscard]] Shader pixel(const std::string& arguments, const std::string& value) const {
        return compile("float4 PS(" + arguments + ") : SV_Target { return " + value + "; }", "PS", Stage::Pixel);
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

} // namespace
} // namespace tegument::test
