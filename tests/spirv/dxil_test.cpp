#include "host/spirv/dxil.h"

#include "tests/spirv/support.h"

#include <algorithm>
#include <cstring>

namespace tegument::test {
namespace {

constexpr std::string_view kPair = R"(
float4 gTint;
struct Varying { float4 position : SV_Position; float2 uv : TEXCOORD0; float3 normal : NORMAL; float unread : TEXCOORD7; };
Varying VS(float3 position : POSITION) { Varying o; o.position = float4(position, 1); o.uv = position.xy; o.normal = position; o.unread = 1; return o; }
float4 PS(Varying v) : SV_Target0 { return gTint * v.uv.xyxy * v.normal.z; }
)";

/// Sample takes derivatives, which compute shaders of model 6.0 do not have.
constexpr std::string_view kInvalid = R"(
RWTexture2D<float4> gOutStore;
Texture2D gInMap; SamplerState gIn;
[numthreads(8, 8, 1)] void CS(uint2 at : SV_DispatchThreadID) { gOutStore[at] = gInMap.Sample(gIn, float2(at)); }
)";

ShaderRequest request(std::string_view code, const char* entry, ShaderStage stage) {
    return {.code = code, .file = "dxil.fx", .entry = entry, .stage = stage};
}

SignatureElement element(const std::vector<SignatureElement>& signature, std::string_view semantic) {
    const auto found = std::ranges::find(signature, semantic, &SignatureElement::semantic);
    if (found != signature.end()) return *found;
    ADD_FAILURE() << semantic << " is not there";
    return {};
}

class DxilShaders : public CompileTest {
protected:
    void SetUp() override {
        if (const std::string missing = compilerMissing(Compiler::Dxc); !missing.empty()) GTEST_SKIP() << missing;
    }
};

TEST_F(DxilShaders, say_by_their_signatures_what_they_read_and_write) {
    const auto pixel = compileDxil(request(kPair, "PS", ShaderStage::Pixel));
    ASSERT_TRUE(pixel) << format(pixel.error());
    EXPECT_EQ(pixel->container.substr(0, 4), "DXBC");
    ASSERT_EQ(pixel->inputs.size(), 4U);
    EXPECT_TRUE(element(pixel->inputs, "SV_POSITION0").systemValue);
    EXPECT_EQ(element(pixel->inputs, "TEXCOORD0").used, 0b0011) << "x and y";
    EXPECT_EQ(element(pixel->inputs, "NORMAL0").used, 0b0100) << "z alone is read";
    EXPECT_EQ(element(pixel->inputs, "TEXCOORD7").used, 0) << "not read";
    const auto vertex = compileDxil(request(kPair, "VS", ShaderStage::Vertex));
    ASSERT_TRUE(vertex) << format(vertex.error());
    ASSERT_EQ(vertex->outputs.size(), 4U);
    for (const SignatureElement& output : vertex->outputs) {
        EXPECT_EQ(output.location, element(pixel->inputs, output.semantic).location) << output.semantic;
        EXPECT_EQ(output.used, output.mask) << output.semantic;
    }
}

TEST_F(DxilShaders, come_from_the_cache_as_they_were_made) {
    const auto first = compileDxil(request(kPair, "PS", ShaderStage::Pixel));
    const auto second = compileDxil(request(kPair, "PS", ShaderStage::Pixel));
    ASSERT_TRUE(first && second);
    EXPECT_EQ(first->container, second->container);
    const auto spirv = compileShader(request(kPair, "PS", ShaderStage::Pixel), Compiler::Dxc);
    ASSERT_TRUE(spirv) << format(spirv.error());
    EXPECT_EQ(spirv->spirv.front(), 0x07230203U) << "the same text for another target is not the same entry of the cache";
}

TEST_F(DxilShaders, that_the_validator_refuses_are_errors) {
    const auto made = compileDxil(request(kInvalid, "CS", ShaderStage::Compute));
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().diagnostics.at(0).code, 3001) << format(made.error());
}

TEST_F(DxilShaders, cut_short_or_changed_are_no_signature_and_no_crash) {
    const auto made = compileDxil(request(kPair, "VS", ShaderStage::Vertex));
    ASSERT_TRUE(made);
    for (std::size_t size = 0; size < made->container.size(); size += 3) {
        const auto outputs = readSignature(std::string_view(made->container).substr(0, size), "OSG1");
        EXPECT_TRUE(!outputs || outputs->size() == 4U) << size;
    }
    for (std::size_t at = 0; at < 600 && at + 4 <= made->container.size(); ++at) {
        std::string changed = made->container;
        std::memset(changed.data() + at, 0xff, 4);
        (void)readSignature(changed, "ISG1"); // any answer will do
        (void)readSignature(changed, "OSG1");
    }
    EXPECT_FALSE(readSignature("", "ISG1"));
    EXPECT_FALSE(readSignature(made->container, "NONE"));
}

} // namespace
} // namespace tegument::test
