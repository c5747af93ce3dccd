#pragma once
// Scenes on which a peer's answer is known: a plane with an edge, a ball, a shadow.

#include "host/image/image.h"
#include "tests/run/fixture.h"

#include <glm/glm.hpp>

#include <array>
#include <numbers>
#include <unistd.h>

namespace tegument::test {

struct Technique3 {
    const char* effect;
    const char* name;
};
/// Every technique of every peer.
inline constexpr std::array<Technique3, 9> kPeers = {{{"Separable", "Separable7"},
                                                      {"Separable", "Separable11"},
                                                      {"Separable", "Separable17"},
                                                      {"Separable", "Separable25"},
                                                      {"Burley", "Burley20"},
                                                      {"Burley", "Burley40"},
                                                      {"Burley", "Burley80"},
                                                      {"Preintegrated", "Preintegrated"},
                                                      {"Preintegrated", "PreintegratedPenumbra"}}};

using Parameters = std::map<std::string, std::vector<double>>;

/// mm from the middle of every picture to its left and right border, and from there to the eye.
inline constexpr double kHalfWidth = 8;
inline constexpr float kEyeDistance = 700;

struct Scratch {
    std::filesystem::path folder = std::filesystem::temp_directory_path() / ("tegument-peers-" + std::to_string(::getpid()));

    Scratch() { std::filesystem::create_directories(folder); }
    ~Scratch() {
        std::error_code code;
        std::filesystem::remove_all(folder, code);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
};

class Peers : public Run {
public:
    static constexpr int kEdgeMap = 2048; // texels of the colour map

protected:
    /// Light and eye face the plane z = 0 from so far that both are parallel; black background, no reflection, and all colour taken up
    /// before the light diffuses, so that a colour map is a pattern of light.
    static Workspace facing() {
        Workspace scene;
        scene.cameraRelative = false;
        scene.lightRelative = false;
        scene.camera.position = {0, 0, kEyeDistance};
        scene.camera.target = {0, 0, 0};
        scene.camera.horizontalFov = static_cast<float>(2 * std::atan(kHalfWidth / kEyeDistance) * 180 / std::numbers::pi);
        scene.light.position = {0, 0, 3000};
        scene.light.color = {1, 1, 1};
        scene.parameters = {{"gMix", {1}}, {"gSpecularIntensity", {0}}};
        return scene;
    }

    /// Two triangles of this half side, turned about the y axis: u to the right, v down.
    static Mesh plane(float half, float turn = 0) {
        Mesh mesh = square();
        const glm::vec3 across(std::cos(turn), 0, -std::sin(turn));
        for (glm::vec3& p : mesh.positions)
            p = half / 10 * (p.x * across + glm::vec3(0, p.y, 0));
        mesh.normals.assign(4, {std::sin(turn), 0, std::cos(turn)});
        mesh.tangents.assign(4, glm::vec4(across, 1));
        computeBounds(mesh);
        return mesh;
    }

    /// A colour map that is black on the left, or on the lower half, and white on the other; four texels the other way.
    static std::string edgeMap(bool leftRight) {
        Image image{.width = leftRight ? kEdgeMap : 4, .height = leftRight ? 4 : kEdgeMap, .channels = 3};
        for (int y = 0; y < image.height; ++y)
            for (int x = 0; x < image.width; ++x)
                image.pixels.insert(image.pixels.end(), 3, (leftRight ? x >= kEdgeMap / 2 : y < kEdgeMap / 2) ? 1.0F : 0.0F);
        return mapFile(leftRight ? "edge-x" : "edge-y", image);
    }
    static std::string whiteMap() { return mapFile("white", {.width = 1, .height = 1, .channels = 3, .pixels = {1, 1, 1}}); }

    /// Written once by each process, gone with it.
    static std::string mapFile(const std::string& name, const Image& image) {
        static const Scratch kScratch;
        const std::filesystem::path file = kScratch.folder / (name + ".png");
        const bool there = std::filesystem::exists(file) || writePng(file, image, PngEncoding::Srgb);
        EXPECT_TRUE(there) << file;
        return file.string();
    }

    Result<RunResult> render(const Technique3& peer, const Mesh& mesh, const Workspace& scene, RunOptions options, bool printed = false,
                             int mapSize = 256, const std::string& setting = "2") {
        const auto effect = loadEffect(std::string("effects/") + (std::string(peer.effect) == "Main" ? "" : "peers/") + peer.effect + ".fx",
                                       {.defines = {{"TEGUMENT_SETTING", setting},
                                                    {"TEGUMENT_MAP_SIZE", std::to_string(mapSize)},
                                                    {"TEGUMENT_PEERS_AS_PRINTED", printed ? "1" : "0"}}});
        if (!effect) return effect.error();
        options.technique = peer.name;
        return runEffect(*device_, *effect, &mesh, scene, options);
    }

    /// Mean of a column's or a row's pixels.
    static glm::dvec3 meanOf(const Image& image, bool column, int at) {
        glm::dvec3 sum(0);
        const int count = column ? image.height : image.width;
        for (int i = 0; i < count; ++i)
            for (int c = 0; c < 3; ++c)
                sum[c] += image.at(column ? at : i, column ? i : at, c) / static_cast<double>(count);
        return sum;
    }
};

} // namespace tegument::test
