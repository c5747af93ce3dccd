// The vertex hook of effects/passes/vertex.fxh: every pass that draws the mesh asks it, and what it answers is what is drawn.

#include "host/run/program.h"
#include "tests/check/hook_example.h"
#include "tests/run/fixture.h"
#include "tests/run/sheet.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>
#include <set>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr int kHookPicture = 96;
constexpr int kBones = 60;

struct Drawn {
    const char* effect;
    const char* technique;
    bool onMap = false; // shows a texture-space map that rigid motion leaves as it is
};

// Every vertex shader that draws the mesh into a picture or into a map that shows, but those of technique Roots, which wants a texture of
// roots.
const std::vector<Drawn> kDrawn = {{"OriginalTexture.fx", "OriginalTexture"},
                                   {"Main.fx", "DEonLuebke"},
                                   {"Main.fx", "Gosselin"},
                                   {"Specular.fx", "Specular"},
                                   {"ShadowMap.fx", "Shadow"},
                                   {"Stretch.fx", "Stretch", true},
                                   {"Convolution.fx", "White", true},
                                   {"Culling.fx", "PrePass"},
                                   {"peers/Separable.fx", "Separable11"},
                                   {"peers/Preintegrated.fx", "PreintegratedPenumbra"},
                                   {"Fur.fx", "SpherePosition"},
                                   {"FurRoots.fx", "Cellular"}};

/// The example without streams of its own, for a host whose meshes have no bones: four of them move every vertex alike.
std::string exampleWithFourBones() {
    std::string text = hookExample();
    const std::string streams = "input.bones, input.weights";
    for (std::size_t at = text.find(streams); at != std::string::npos; at = text.find(streams, at))
        text.replace(at, streams.size(), "uint4(0, 1, 2, 3), float4(0.25, 0.25, 0.25, 0.25)");
    return std::regex_replace(text, std::regex("#define TEGUMENT_VERTEX_STREAMS[^\n]*\n"), "");
}

/// Four rows of three numbers for each bone. The matrix is for row vectors: in GLM's memory its rows are columns.
std::vector<double> bones(const std::array<glm::dmat4, 4>& first) {
    std::vector<double> numbers;
    for (std::size_t bone = 0; bone < kBones; ++bone)
        for (int row = 0; row < 4; ++row)
            for (int column = 0; column < 3; ++column)
                numbers.push_back(bone < 4 ? first[bone][row][column] : 0.0);
    return numbers;
}

std::vector<double> rows(const glm::dmat4& matrix) {
    std::vector<double> numbers;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            numbers.push_back(matrix[row][column]);
    return numbers;
}

/// Tufts on a sphere map.
Image furMap() {
    Image image = blankImage(64);
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x)
            image.at(x, y, 3) = 0.5F + 0.5F * std::sin(0.9F * static_cast<float>(x)) * std::cos(0.7F * static_cast<float>(y));
    return image;
}

class VertexHook : public Run {
protected:
    void SetUp() override {
        Run::SetUp();
        if (IsSkipped()) return;
        mesh_ = reliefSheet();
        furMap_ = fs::temp_directory_path() / ("tegument-hook-fur-" + std::to_string(::getpid()) + ".exr");
        ASSERT_TRUE(succeeded(writeExr(furMap_, furMap())));
    }
    void TearDown() override {
        if (!furMap_.empty()) fs::remove(furMap_);
        Run::TearDown();
    }

    Result<RunResult> draw(const fs::path& file, const Drawn& drawn, const std::map<std::string, std::vector<double>>& parameters) {
        const auto effect = loadEffect(file, {.defines = {{"TEGUMENT_MAP_SIZE", "128"}}});
        if (!effect) return effect.error();
        RunOptions options{.technique = drawn.technique, .width = kHookPicture, .height = kHookPicture, .compiler = defaultCompiler()};
        for (const auto& [name, value] : parameters)
            if (effect->findParameter(name)) options.parameters.emplace(name, value);
        if (effect->findParameter("gFurSphereMap")) options.textures = {{"gFurSphereMap", furMap_.string()}};
        Workspace workspace;
        workspace.camera.position = {0.7F, 0.5F, 3};
        workspace.light.position = {-3, 2, 3};
        return runEffect(*device_, *effect, &mesh_, workspace, options);
    }

    Result<RunResult> drawHooked(const Drawn& drawn, const std::array<glm::dmat4, 4>& pose) {
        return draw(copy_.put(exampleWithFourBones(), drawn.effect), drawn, {{"gBones", bones(pose)}});
    }
    static fs::path plain(const Drawn& drawn) { return fs::path("effects") / drawn.effect; }

    EffectsCopy copy_;
    Mesh mesh_;
    fs::path furMap_;
};

TEST_F(VertexHook, that_changes_nothing_changes_no_bit_of_any_picture) {
    for (const Drawn& drawn : kDrawn) {
        const auto usual = draw(plain(drawn), drawn, {});
        const auto hooked = drawHooked(drawn, {glm::dmat4(1), glm::dmat4(1), glm::dmat4(1), glm::dmat4(1)});
        ASSERT_TRUE(succeeded(usual)) << drawn.effect;
        ASSERT_TRUE(succeeded(hooked)) << drawn.effect;
        EXPECT_TRUE(std::ranges::any_of(usual->image.pixels, [](float v) { return v != 0; })) << drawn.effect << " shows nothing";
        EXPECT_EQ(usual->image.pixels, hooked->image.pixels) << drawn.effect << " " << drawn.technique;
    }
}

/// How far the pictures are apart: the L2 of their difference over that of the first.
double apart(const Image& a, const Image& b) {
    double difference = 0;
    double square = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        difference += std::pow(static_cast<double>(a.pixels[i]) - static_cast<double>(b.pixels[i]), 2);
        square += std::pow(static_cast<double>(a.pixels[i]), 2);
    }
    return std::sqrt(difference / square);
}

/// The matrix that turns and moves, by the world matrix and by the mean of four bones that stand apart; camera, light and bounds stay.
TEST_F(VertexHook, that_turns_and_moves_the_mesh_draws_the_mesh_turned_and_moved) {
    const glm::dmat4 turn = glm::rotate(glm::dmat4(1), 0.35, glm::normalize(glm::dvec3(0.3, 1, -0.2)));
    const auto moved = [&](const glm::dvec3& by) { return glm::translate(glm::dmat4(1), by) * turn; };
    const glm::dvec3 by(6, -4, 3);
    const glm::dvec3 step(8, 16, -4);
    const std::array pose = {moved(by + step), moved(by - step), moved(by + 2.0 * step), moved(by - 2.0 * step)};
    const glm::dvec3 centre = glm::dvec3(moved(by) * glm::dvec4(glm::dvec3(mesh_.bounds.centre), 1));
    for (const Drawn& drawn : kDrawn) {
        // Roots and fur maps are found from the centre of the mesh at rest: for a mesh that the world moves it moves along.
        const auto world = draw(
            plain(drawn), drawn,
            {{"gWorld", rows(moved(by))}, {"gWorldInverseTranspose", rows(turn)}, {"gBoundingCenter", {centre.x, centre.y, centre.z}}});
        const auto hooked = drawHooked(drawn, pose);
        const auto usual = draw(plain(drawn), drawn, {});
        ASSERT_TRUE(succeeded(world) && succeeded(hooked) && succeeded(usual)) << drawn.effect;
        // 3e-7 at most on lavapipe. On other floats pixels of outlines and of the light's map may change sides.
        EXPECT_LT(apart(world->image, hooked->image), 1e-3) << drawn.effect << " " << drawn.technique;
        if (drawn.onMap) continue;
        EXPECT_GT(apart(world->image, usual->image), 0.2) << drawn.effect << " " << drawn.technique << " does not show where the mesh is";
    }
}

/// A parameter that the hook alone reads.
constexpr const char* kProbe = R"(
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
float4 gProbe < string UIWidget = "None"; > = { 0.0, 0.0, 0.0, 0.0 };
TgMeshInput probed(TgMeshInput rest)
{
    rest.position += gProbe.xyz;
    rest.uv += gProbe.xy;
    return rest;
}
#define TEGUMENT_VERTEX_HOOK(rest, input) probed(rest)
#include "Main.fx"
)";

std::vector<std::string> allEffects() {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator("effects"))
        if (entry.path().extension() == ".fx") files.push_back(fs::relative(entry.path(), "effects").string());
    std::ranges::sort(files);
    return files;
}

bool drawsTheMesh(const Pass& pass) {
    return !pass.script.given || std::ranges::any_of(pass.script.commands, [](const Command& command) {
        return command.kind == CommandKind::Draw && command.options.front() == "Geometry";
    });
}

bool asksHook(const Effect& effect, const Pass& pass) {
    const auto program = run::compilePass(effect, pass, defaultCompiler());
    EXPECT_TRUE(succeeded(program)) << pass.name;
    return program && program->numbers.contains("gProbe");
}

/// Compute shaders that find the vertices of such passes ask in their place.
bool asksHookByComputing(const Effect& effect, const Technique& technique) {
    return std::ranges::any_of(technique.passes, [&](const Pass& pass) { return pass.computeShader && asksHook(effect, pass); });
}

TEST(VertexHookIsAsked, by_every_pass_that_draws_the_mesh) {
    const EffectsCopy copy;
    std::set<std::string> asked; // vertex shaders, by effect
    for (const std::string& file : allEffects()) {
        const auto effect = loadEffect(copy.put(kProbe, file), {.defines = {{"TEGUMENT_SHADOW_FROM_TSM", "0"}}});
        ASSERT_TRUE(succeeded(effect)) << file;
        for (const Technique& technique : effect->techniques)
            for (const Pass& pass : technique.passes) {
                if (!drawsTheMesh(pass) || !asked.insert(file + " " + pass.vertexShader->entry).second) continue;
                EXPECT_TRUE(asksHook(*effect, pass) || asksHookByComputing(*effect, technique))
                    << file << " " << technique.name << " " << pass.name;
            }
    }
    EXPECT_GE(asked.size(), 40U);
}

} // namespace
} // namespace tegument::test
