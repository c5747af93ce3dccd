// What reflection makes of modules that no compiler here writes, and of types that a Reflection cannot express.

#include "host/spirv/reflect.h"
#include "tests/spirv/support.h"

namespace tegument::test {
namespace {

constexpr int kUnreadable = 3003;

TEST(Reflect, words_that_are_no_module_are_an_error) {
    for (std::vector<std::uint32_t> words : {std::vector<std::uint32_t>{}, {0x07230203}, std::vector<std::uint32_t>(64, 0x12345678)}) {
        const auto reflection = spirv::reflect(words, Stage::Pixel, 1, "test.fx");
        ASSERT_FALSE(reflection);
        EXPECT_EQ(reflection.error().diagnostics[0].code, kUnreadable);
        EXPECT_FALSE(spirv::writesPosition(words));
    }
}

TEST(Reflect, a_shader_whose_words_are_lost_cannot_be_linked_and_stays_as_it_is) {
    Shader vertex{.stage = Stage::Vertex, .file = "test.fx", .entry = "VS", .spirv = {}};
    vertex.reflection.outputs = {{.semantic = "TEXCOORD0", .location = 3}};
    Shader pixel{.stage = Stage::Pixel, .file = "test.fx", .entry = "PS", .spirv = {1, 2, 3}};
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
        const auto shader = tryCompile(type + " gFine; float4 PS() : SV_Target { return (float)(gFine * 2.0L).x; }", "PS", Stage::Pixel);
        ASSERT_FALSE(shader) << type;
        EXPECT_EQ(shader.error().diagnostics.front().code, 3006) << format(shader.error());
        EXPECT_NE(shader.error().diagnostics.front().text.find("gFine"), std::string::npos);
    }
}

TEST_P(Reflected, of_an_input_array_the_elements_that_are_read_are_listed) {
    const std::string head = "int gAt; float4 PS(float2 uv[3] : TEXCOORD4) : SV_Target { return uv[";
    const std::map<std::string, std::uint32_t> all{{"TEXCOORD4", 0}, {"TEXCOORD5", 1}, {"TEXCOORD6", 2}};
    EXPECT_EQ(locations(compile(head + "gAt].xyxy; }", "PS", Stage::Pixel).reflection.inputs), all) << "a computed index may reach each";
    const auto one = locations(compile(head + "1].xyxy; }", "PS", Stage::Pixel).reflection.inputs);
    if (GetParam() == Compiler::Dxc)
        EXPECT_EQ(one, (std::map<std::string, std::uint32_t>{{"TEXCOORD5", 1}}));
    else
        EXPECT_EQ(one, all) << "glslang copies the array before it indexes";
}

} // namespace
} // namespace tegument::test
