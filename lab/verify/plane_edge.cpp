#include "lab/verify/plane_edge.h"

#include "host/image/image.h"
#include "lab/reference/profile.h"

#include <array>
#include <cmath>

namespace tegument::verify {

namespace {

constexpr std::array kMaps = {"gIrradianceMap",  "gIrradiance2Map", "gIrradiance3Map",
                              "gIrradiance4Map", "gIrradiance5Map", "gIrradiance6Map"};

/// A square in the plane z = 0 that fills the map, `texel` mm to a texel.
Mesh plane(double texel, int size) {
    const auto half = static_cast<float>(0.5 * texel * size);
    Mesh mesh;
    mesh.name = "plane";
    mesh.positions = {{-half, half, 0}, {-half, -half, 0}, {half, half, 0}, {half, -half, 0}};
    mesh.normals.assign(4, {0, 0, 1});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    mesh.indices = {0, 1, 2, 2, 1, 3};
    mesh.parts = {{.name = "plane", .firstIndex = 0, .indexCount = 6}};
    computeBounds(mesh);
    return mesh;
}

/// Colour that makes the light an edge: black, white, and between them the texel that the edge crosses, by its share. With gMix = 1 all of
/// the colour is taken before diffusion. Floats, which are taken as linear.
Image edgeColour(int size, double phase) {
    Image image = blank(size, 1, 4);
    const int middle = size / 2;
    for (int x = 0; x < size; ++x) {
        const double share = std::clamp(x - middle + phase + 0.5, 0.0, 1.0);
        for (int c = 0; c < 3; ++c)
            image.at(x, 0, c) = static_cast<float>(share);
        image.at(x, 0, 3) = 1;
    }
    return image;
}

} // namespace

reference::EdgeResponse DrawnEdge::response() const {
    return [self = *this](double x) {
        const auto size = static_cast<double>(self.maps[0].size());
        const double place = std::clamp(x / self.texel - self.phase + size / 2, 0.0, size - 1);
        const auto left = std::min(static_cast<std::size_t>(place), self.maps[0].size() - 2);
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < self.maps.size(); ++i)
            sum += reference::skinProfile()[i].weight *
                   std::lerp(self.maps[i][left], self.maps[i][left + 1], place - static_cast<double>(left));
        return sum;
    };
}

double DrawnEdge::variance(std::size_t map) const {
    const std::vector<double>& row = maps[map];
    double mean = 0;
    double square = 0;
    double whole = 0;
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
        const double x = static_cast<double>(i) + 0.5;
        const double w = row[i + 1] - row[i];
        whole += w;
        mean += w * x;
        square += w * x * x;
    }
    mean /= whole;
    return (square / whole - mean * mean + 1.0 / 12) * texel * texel;
}

Result<DrawnEdge> drawEdge(const Context& context, double texel, double phase) {
    const int size = context.options.mapSize;
    Mesh mesh = plane(texel, size);
    mesh.textures = {{.role = "color", .image = edgeColour(size, phase)}};
    Workspace workspace = worldWorkspace();
    workspace.camera.position = {0, 0, 500};
    workspace.light.direction = glm::vec3(0, 0, -1);
    workspace.light.width = 1e-3F; // the edge is one of colour: no shadow's filter has been over it
    const auto run = render(context, {.effect = "Convolution.fx",
                                      .technique = "Convolution",
                                      .mesh = &mesh,
                                      .workspace = workspace,
                                      .dump = {kMaps.begin(), kMaps.end()},
                                      .parameters = {{"gMix", {1}}, {"gSpecularIntensity", {0}}},
                                      .defines = {{"TEGUMENT_MAP_BITS", "32"}}});
    if (!run) return run.error();
    const double light = run->dumped.at("gIrradianceMap").at(size * 7 / 8, size / 2, 0);
    DrawnEdge edge{.texel = texel, .phase = phase, .maps = {}};
    for (const char* map : kMaps) {
        std::vector<double> row;
        for (int x = 0; x < size; ++x)
            row.push_back(run->dumped.at(map).at(x, size / 2, 0) / light);
        edge.maps.push_back(std::move(row));
    }
    return edge;
}

} // namespace tegument::verify
