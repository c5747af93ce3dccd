#include "lab/verify/corner_grid.h"

#include "host/effect/load.h"
#include "host/support/file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace tegument::verify {

namespace {

constexpr double kSize = 64;  // pixels a side
constexpr int kTriangles = 8; // along a side
constexpr int kFinest = 12;   // bits below a pixel that are tried
constexpr int kCoarsest = 2;

constexpr const char* kPlaces = R"(#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
Texture2D gPlaceMap : RENDERCOLORTARGET < int Width = 64; int Height = 64; int MipLevels = 1; string Format = "A32B32G32R32F"; >;
float Script : STANDARDSGLOBAL < string UIWidget = "none"; string ScriptClass = "object"; string ScriptOrder = "standard"; string ScriptOutput = "color"; string Script = "Technique=Places;"; > = 0.8;
struct PlaceVarying
{
    float4 position : SV_Position;
    float2 place : TEXCOORD0;
};
PlaceVarying PlaceVS(TgMeshInput input)
{
    PlaceVarying output;
    output.position = TG_HALF_PIXEL(float4(input.position.xy, 0.5, 1.0), gViewportSize);
    output.place = input.position.xy;
    return output;
}
float4 PlacePS(PlaceVarying input) : SV_Target0
{
    return float4(input.place, 0.0, 1.0);
}
#ifdef FX_TECHNIQUES
technique Places < string Script = "RenderColorTarget0=gPlaceMap; ClearSetColor=gClearEmpty; Clear=Color; Pass=Places;"; >
{
    TG_MESH_PASS(Places, PlaceVS, PlacePS, TG_STATE_BUFFER)
}
#endif
)";

/// Triangles that do not touch, corners at random places between pixels, in clip space.
Mesh scatteredTriangles() {
    std::mt19937 random(1);
    const auto next = [&] { return static_cast<float>(random()) / static_cast<float>(std::mt19937::max()); };
    Mesh mesh;
    mesh.name = "triangles";
    constexpr auto kPixels = static_cast<float>(kSize);
    constexpr auto kSide = static_cast<float>(kSize / kTriangles);
    for (int j = 0; j < kTriangles; ++j)
        for (int i = 0; i < kTriangles; ++i)
            for (const glm::vec2 corner : {glm::vec2(0, 0), glm::vec2(0.8F, 0.1F), glm::vec2(0.1F, 0.8F)}) {
                const glm::vec2 pixel = kSide * (glm::vec2(i, j) + corner) + glm::vec2(next(), next());
                mesh.positions.emplace_back(2 * pixel.x / kPixels - 1, 1 - 2 * pixel.y / kPixels, 0);
                mesh.normals.emplace_back(0, 0, 1);
                mesh.tangents.emplace_back(1, 0, 0, 1);
                mesh.uvs.emplace_back(0, 0);
                mesh.indices.push_back(static_cast<std::uint32_t>(mesh.indices.size()));
            }
    mesh.parts = {{.name = mesh.name, .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh.indices.size())}};
    computeBounds(mesh);
    return mesh;
}

Result<Image> drawPlaces(const Context& context, const Mesh& mesh) {
    const std::filesystem::path file = context.options.effects / "corner_grid.fx"; // in no folder: includes are found from there
    const auto effect = loadEffect(file, {}, [&](const std::filesystem::path& path) {
        return path == file ? Result<std::string>(std::string(kPlaces)) : readFile(path);
    });
    if (!effect) return effect.error();
    Workspace workspace;
    workspace.head = false;
    auto run = runEffect(context.device, *effect, &mesh, workspace,
                         {.technique = "Places",
                          .width = static_cast<int>(kSize),
                          .height = static_cast<int>(kSize),
                          .compiler = context.options.compiler,
                          .dump = {"gPlaceMap"}});
    if (!run) return run.error();
    return std::move(run->dumped.at("gPlaceMap"));
}

glm::dvec2 pixelOf(double x, double y) {
    return kSize * glm::dvec2(0.5 + 0.5 * x, 0.5 - 0.5 * y);
}

/// RMS distance of what was drawn from the values between corners at multiples of `step`, pixels.
double distanceFrom(const Mesh& mesh, const Image& places, double step) {
    double sum = 0;
    int count = 0;
    for (std::size_t t = 0; t < mesh.positions.size(); t += 3) {
        std::array<glm::dvec2, 3> exact;
        std::array<glm::dvec2, 3> moved;
        for (std::size_t c = 0; c < 3; ++c) {
            exact[c] = pixelOf(static_cast<double>(mesh.positions[t + c].x), static_cast<double>(mesh.positions[t + c].y));
            moved[c] = step > 0 ? step * glm::floor(exact[c] / step + 0.5) : exact[c];
        }
        const glm::dmat2 edges(moved[1] - moved[0], moved[2] - moved[0]);
        for (int y = static_cast<int>(exact[0].y); y < static_cast<int>(exact[2].y); ++y)
            for (int x = static_cast<int>(exact[0].x); x < static_cast<int>(exact[1].x); ++x) {
                const glm::dvec2 at = glm::inverse(edges) * (glm::dvec2(x + 0.5, y + 0.5) - moved[0]);
                constexpr double kInside = 0.02; // of the triangle, so that the device has drawn it
                if (std::min({at.x, at.y, 1 - at.x - at.y}) < kInside) continue;
                const glm::dvec2 between = exact[0] + at.x * (exact[1] - exact[0]) + at.y * (exact[2] - exact[0]);
                const glm::dvec2 off = pixelOf(static_cast<double>(places.at(x, y, 0)), static_cast<double>(places.at(x, y, 1))) - between;
                sum += glm::dot(off, off);
                ++count;
            }
    }
    return std::sqrt(sum / count);
}

} // namespace

Result<CornerGrid> measureCornerGrid(const Context& context) {
    const Mesh mesh = scatteredTriangles();
    const auto places = drawPlaces(context, mesh);
    if (!places) return places.error();
    CornerGrid grid{.step = 0, .exact = distanceFrom(mesh, *places, 0), .remaining = 0};
    grid.remaining = grid.exact;
    for (int bits = kCoarsest; bits <= kFinest; ++bits) {
        // A grid that explains less than half of the distance is none.
        const double distance = distanceFrom(mesh, *places, std::ldexp(1.0, -bits));
        if (distance < std::min(grid.remaining, grid.exact / 2)) {
            grid.step = std::ldexp(1.0, -bits);
            grid.remaining = distance;
        }
    }
    return grid;
}

} // namespace tegument::verify
