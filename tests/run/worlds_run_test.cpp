// Effects in worlds of other units, scaled, turned and mirrored: the same picture. And light that no map can hold: nothing of it reaches a
// neighbour.

#include "tests/run/fixture.h"
#include "tests/run/sheet.h"

#include <algorithm>
#include <limits>

namespace tegument::test {
namespace {

constexpr int kWorldPicture = 96;

struct Picture {
    const char* effect;
    const char* technique;
};

const std::vector<Picture> kPictures = {{"Main.fx", "DEonLuebke"},       {"Main.fx", "Gosselin"},
                                        {"Main.fx", "Lambert"},          {"Specular.fx", "Specular"},
                                        {"Irradiance.fx", "Irradiance"}, {"TSM.fx", "TSM"},
                                        {"ShadowMap.fx", "ShadowMap"},   {"ShadowMap.fx", "Shadow"},
                                        {"Stretch.fx", "Stretch"},       {"Convolution.fx", "Convolution"},
                                        {"Convolution.fx", "Poisson"},   {"peers/Separable.fx", "Separable11"},
                                        {"peers/Burley.fx", "Burley20"}, {"peers/Preintegrated.fx", "PreintegratedPenumbra"}};

Workspace lit() {
    Workspace workspace;
    workspace.camera.position = {0.7F, 0.5F, 3};
    workspace.light.position = {-3, 2, 3};
    return workspace;
}

class Worlds : public Run {
protected:
    Result<RunResult> draw(const Picture& picture, const Mesh& mesh, const Placement& placement, const Workspace& workspace = lit(),
                           const std::string& setting = "2") {
        const auto effect = loadEffect(std::filesystem::path("effects") / picture.effect,
                                       {.defines = {{"TEGUMENT_SETTING", setting}, {"TEGUMENT_MAP_SIZE", "128"}}});
        if (!effect) return effect.error();
        const RunObject object{.mesh = &mesh, .workspace = workspace, .placement = placement};
        return runScene(*device_, *effect, std::span(&object, 1), workspace,
                        {.technique = picture.technique, .width = kWorldPicture, .height = kWorldPicture, .compiler = defaultCompiler()});
    }

    void expectSame(const Picture& picture, const Result<RunResult>& a, const Result<RunResult>& b) {
        ASSERT_TRUE(succeeded(a) && succeeded(b));
        double difference = 0;
        double square = 0;
        for (std::size_t i = 0; i < a->image.pixels.size(); ++i) {
            if (i % 4 == 3) continue;
            const auto expected = static_cast<double>(a->image.pixels[i]);
            difference += std::pow(static_cast<double>(b->image.pixels[i]) - expected, 2);
            square += expected * expected;
        }
        ASSERT_GT(square, 0) << picture.effect << " " << picture.technique << " shows nothing";
        // Vertices fall on other floats: pixels of outlines and of the light's map change sides.
        EXPECT_LT(std::sqrt(difference / square), 1e-3) << picture.effect << " " << picture.technique;
    }
};

Mesh scaled(Mesh mesh, const glm::vec3& scale) {
    for (glm::vec3& p : mesh.positions)
        p *= scale;
    computeBounds(mesh);
    return mesh;
}

TEST_F(Worlds, a_mesh_in_metres_scaled_by_a_thousand_is_the_mesh_in_millimetres) {
    const Mesh mesh = reliefSheet();
    const Mesh metres = scaled(mesh, glm::vec3(1e-3F));
    for (const Picture& picture : kPictures)
        expectSame(picture, draw(picture, mesh, {}), draw(picture, metres, {.scale = glm::vec3(1000)}));
}

TEST_F(Worlds, a_world_of_metres_shows_what_one_of_millimetres_does) {
    const Mesh mesh = reliefSheet();
    for (const float unit : {1000.0F, 25.4F, 0.01F}) {
        Workspace other = lit();
        other.worldUnitMm = unit;
        for (const Picture& picture : kPictures)
            expectSame(picture, draw(picture, mesh, {}), draw(picture, mesh, {}, other));
    }
}

/// The sheet and a copy 4 mm behind it that looks the other way, each in its half of the map.
Mesh slab() {
    const Mesh front = sheet();
    Mesh mesh = front;
    const auto count = static_cast<std::uint32_t>(front.positions.size());
    for (std::uint32_t i = 0; i < count; ++i) {
        mesh.uvs[i].x *= 0.5F;
        mesh.uvs.emplace_back(1 - mesh.uvs[i].x, mesh.uvs[i].y);
        mesh.positions.push_back(front.positions[i] - glm::vec3(0, 0, 4));
        mesh.normals.push_back(-front.normals[i]);
        mesh.tangents.push_back(front.tangents[i]);
    }
    for (std::size_t i = 0; i < front.indices.size(); i += 3)
        for (const std::size_t corner : {0U, 2U, 1U})
            mesh.indices.push_back(front.indices[i + corner] + count);
    mesh.parts.front().indexCount = static_cast<std::uint32_t>(mesh.indices.size());
    computeBounds(mesh);
    return mesh;
}

TEST_F(Worlds, light_through_a_body_is_the_same_in_metres) {
    const Mesh mesh = slab();
    Workspace behind = lit();
    behind.light.position = {-1, 1, -4};
    behind.light.color = glm::vec3(10);
    Workspace metres = behind;
    metres.worldUnitMm = 1000;
    for (const char* setting : {"0", "1", "2"}) {
        const Picture picture{"Main.fx", "DEonLuebke"};
        const auto there = draw(picture, mesh, {}, behind, setting);
        expectSame(picture, there, draw(picture, mesh, {}, metres, setting));
        EXPECT_GT(there->image.at(kWorldPicture / 2, kWorldPicture / 2, 0), 0.02F) << "nothing comes through";
    }
}

TEST_F(Worlds, the_printed_settings_follow_too) {
    const Mesh mesh = reliefSheet();
    const Mesh metres = scaled(mesh, glm::vec3(1e-3F));
    Workspace other = lit();
    other.worldUnitMm = 25.4F;
    for (const char* setting : {"0", "1"})
        for (const Picture& picture : kPictures)
            expectSame(picture, draw(picture, mesh, {}, lit(), setting), draw(picture, metres, {.scale = glm::vec3(1000)}, other, setting));
}

/// The mirrored vertices with their triangles turned round, against the same made by the world matrix.
TEST_F(Worlds, a_mirrored_world_shows_the_mirrored_mesh) {
    const Mesh mesh = reliefSheet();
    Mesh mirrored = scaled(mesh, {1, -1, 1});
    for (std::size_t i = 0; i < mirrored.indices.size(); i += 3)
        std::swap(mirrored.indices[i + 1], mirrored.indices[i + 2]);
    for (glm::vec3& normal : mirrored.normals)
        normal.y *= -1;
    for (glm::vec4& tangent : mirrored.tangents)
        tangent *= glm::vec4(1, -1, 1, -1);
    for (const Picture& picture : kPictures)
        expectSame(picture, draw(picture, mirrored, {}), draw(picture, mesh, {.scale = {1, -1, 1}}));
}

/// Without a normal map, whose bumps keep their slopes: normals and all lengths follow.
TEST_F(Worlds, an_uneven_scale_is_the_mesh_made_so) {
    const Mesh mesh = sheet();
    const glm::vec3 scale(0.5F, 1.2F, 1.5F);
    Mesh made = scaled(mesh, scale);
    for (std::size_t i = 0; i < made.normals.size(); ++i) {
        made.normals[i] = glm::normalize(made.normals[i] / scale);
        made.tangents[i] = glm::vec4(glm::normalize(glm::vec3(made.tangents[i]) * scale), made.tangents[i].w);
    }
    for (const Picture& picture : kPictures)
        expectSame(picture, draw(picture, made, {}), draw(picture, mesh, {.scale = scale}));
    const auto warned = draw(kPictures.front(), mesh, {.scale = scale});
    ASSERT_TRUE(succeeded(warned));
    EXPECT_TRUE(std::ranges::any_of(warned->warnings, [](const Diagnostic& d) { return d.code == 4053; }));
}

TEST_F(Worlds, parallel_light_is_a_light_far_away) {
    const Mesh mesh = reliefSheet();
    Workspace far = lit();
    far.light.position *= 3000; // its rays cross the mesh within 1/12000 of parallel
    Workspace parallel = lit();
    parallel.light.direction = -parallel.light.position;
    for (const Picture& picture : kPictures) {
        if (picture.technique == std::string("TSM") || picture.technique == std::string("ShadowMap")) continue; // depths from elsewhere
        const auto a = draw(picture, mesh, {}, far);
        const auto b = draw(picture, mesh, {}, parallel);
        ASSERT_TRUE(succeeded(a) && succeeded(b));
        double largest = 0;
        double sum = 0;
        for (std::size_t i = 0; i < a->image.pixels.size(); ++i) {
            if (i % 4 == 3) continue;
            sum += static_cast<double>(std::abs(a->image.pixels[i] - b->image.pixels[i]));
            largest += static_cast<double>(std::abs(a->image.pixels[i]));
        }
        EXPECT_LT(sum / largest, 5e-3) << picture.effect << " " << picture.technique;
    }
}

/// A colour map of which one texel is no number and one infinite.
Mesh hostileSheet() {
    Mesh mesh = sheet();
    Image colour = blankImage(64);
    for (int c = 0; c < 3; ++c) {
        colour.at(20, 30, c) = std::numeric_limits<float>::quiet_NaN();
        colour.at(44, 30, c) = std::numeric_limits<float>::infinity();
    }
    mesh.textures = {{.role = "color", .image = std::move(colour)}};
    return mesh;
}

class HostileLight : public Run {
protected:
    Result<RunResult> draw(const Picture& picture, const Mesh& mesh, const std::string& bits, const std::string& setting, double light) {
        const auto effect =
            loadEffect(std::filesystem::path("effects") / picture.effect,
                       {.defines = {{"TEGUMENT_SETTING", setting}, {"TEGUMENT_MAP_SIZE", "128"}, {"TEGUMENT_MAP_BITS", bits}}});
        if (!effect) return effect.error();
        return runEffect(*device_, *effect, &mesh, lit(),
                         {.technique = picture.technique,
                          .width = kWorldPicture,
                          .height = kWorldPicture,
                          .compiler = defaultCompiler(),
                          .parameters = {{"gLightColor", {light, light, light}}},
                          .dump = {"all"}});
    }
};

bool isLight(const std::string& target) {
    return target.starts_with("gIrradiance") || target.starts_with("gBlur") || target.starts_with("gScatter") || target == "gLightMap";
}

TEST_F(HostileLight, never_reaches_a_map_of_light) {
    const Mesh mesh = hostileSheet();
    for (const char* bits : {"16", "32"})
        for (const char* setting : {"0", "1", "2"})
            for (const double light : {1.0, 1e30})
                for (const Picture& picture : {Picture{"Main.fx", "DEonLuebke"}, Picture{"Main.fx", "Gosselin"},
                                               Picture{"peers/Separable.fx", "Separable11"}, Picture{"peers/Burley.fx", "Burley20"}}) {
                    const auto result = draw(picture, mesh, bits, setting, light);
                    ASSERT_TRUE(succeeded(result));
                    int maps = 0;
                    for (const auto& [name, image] : result->dumped) {
                        if (!isLight(name)) continue;
                        ++maps;
                        EXPECT_TRUE(std::ranges::all_of(image.pixels, [](float v) { return std::isfinite(v); }))
                            << picture.effect << " " << picture.technique << ", " << name << ", " << bits << " bits, setting " << setting
                            << ", light " << light;
                    }
                    EXPECT_GE(maps, 2) << picture.effect;
                }
}

TEST_F(HostileLight, leaves_the_picture_but_for_the_texels_themselves) {
    const auto result = draw({"Main.fx", "DEonLuebke"}, hostileSheet(), "16", "2", 1);
    ASSERT_TRUE(succeeded(result));
    const auto notFinite = std::ranges::count_if(result->image.pixels, [](float v) { return !std::isfinite(v); });
    // A look-up between texels reads two of them a side, here 1.3 pixels each: at most 4 x 4 pixels of three channels, twice.
    EXPECT_GT(notFinite, 0) << "the map was not read";
    EXPECT_LE(notFinite, 2 * 16 * 3);
}

} // namespace
} // namespace tegument::test
