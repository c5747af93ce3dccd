// Skin in a Direct3D 12 engine: a mesh, a camera, a light; effects as `tegument check --emit` writes them; one picture.
//   d3d12_sample EMITTED-FOLDER MESH.bin COLOUR.png NORMAL.png SHOT.png
// The folder holds Stretch, EnergyAttenuation and Main. MESH.bin: counts, bounding sphere, the vertex stream of docs/conventions.md,
// indices; docs/samples/vulkan writes it. docs/your-engine.md explains what is not plain Direct3D.
#include "effect.h"
#include "picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr UINT kSize = 512;
constexpr UINT kVertexBytes = 48;

using Vector = std::array<float, 3>;
using Matrix = std::array<float, 16>; // of row vectors, row after row

Vector operator+(const Vector& a, const Vector& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Vector operator*(float s, const Vector& a) {
    return {s * a[0], s * a[1], s * a[2]};
}
float dot(const Vector& a, const Vector& b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
float length(const Vector& a) {
    return std::sqrt(dot(a, a));
}
Vector unit(const Vector& a) {
    return 1 / length(a) * a;
}
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Right-handed, z from 0 to 1.
Matrix pyramid(const Vector& from, const Vector& at, float fov, float nearest, float farthest) {
    const Vector z = unit(from + -1.0F * at), x = unit(cross({0, 1, 0}, z)), y = cross(z, x);
    const float scale = 1 / std::tan(fov / 2), depth = farthest / (nearest - farthest);
    const float ex = -dot(x, from), ey = -dot(y, from), ez = -dot(z, from);
    return {scale * x[0], scale * y[0], depth * z[0], -z[0], scale * x[1], scale * y[1], depth * z[1],           -z[1],
            scale * x[2], scale * y[2], depth * z[2], -z[2], scale * ex,   scale * ey,   depth * (ez + nearest), -ez};
}

struct Mesh {
    std::vector<char> vertices;
    std::vector<std::uint32_t> indices; // counter-clockwise
    Vector centre{};                    // bounding sphere
    float radius = 0;
};

Mesh loadMesh(const char* file) {
    Mesh mesh;
    std::ifstream in(file, std::ios::binary);
    std::uint32_t counts[2] = {};
    in.read(reinterpret_cast<char*>(counts), sizeof counts);
    in.read(reinterpret_cast<char*>(mesh.centre.data()), sizeof mesh.centre);
    in.read(reinterpret_cast<char*>(&mesh.radius), sizeof mesh.radius);
    mesh.vertices.resize(std::size_t{counts[0]} * kVertexBytes);
    mesh.indices.resize(counts[1]);
    in.read(mesh.vertices.data(), static_cast<std::streamsize>(mesh.vertices.size()));
    in.read(reinterpret_cast<char*>(mesh.indices.data()), static_cast<std::streamsize>(counts[1] * sizeof(std::uint32_t)));
    if (!in || counts[0] == 0) throw std::runtime_error(std::string("cannot read ") + file);
    return mesh;
}

/// What the effects ask for by semantic.
std::map<std::string, std::vector<float>> sceneOf(const Mesh& mesh) {
    const auto place = [&](float x, float y, float z) { return mesh.centre + mesh.radius * Vector{x, y, z}; };
    const Vector eye = place(1.75F, 0.35F, 3.7F), light = place(-3.2F, 3.6F, 6);
    const float distance = length(light + -1.0F * mesh.centre), eyeDistance = length(eye + -1.0F * mesh.centre);
    const float nearest = distance - 1.01F * mesh.radius, farthest = distance + 1.01F * mesh.radius;
    const float fov = 2 * std::asin(1.01F * mesh.radius / distance); // the light sees the whole mesh, and little else
    const Matrix camera =
        pyramid(eye, place(0, 0.17F, 0.1F), 25 * 3.14159265F / 180, eyeDistance - 1.1F * mesh.radius, eyeDistance + 1.1F * mesh.radius);
    const Matrix lit = pyramid(light, mesh.centre, fov, nearest, farthest);
    const std::vector<float> world = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    return {{"WORLD", world},
            {"WORLDINVERSETRANSPOSE", world},
            {"VIEWPROJECTION", {camera.begin(), camera.end()}},
            {"CAMERAPOSITION", {eye.begin(), eye.end()}},
            {"PointLight0 VIEWPROJECTION", {lit.begin(), lit.end()}},
            {"PointLight0 POSITION", {light.begin(), light.end()}},
            {"PointLight0 DIFFUSE", {1.7F, 1.7F, 1.7F}}, // irradiance / pi
            {"PointLight0 NEARCLIP", {nearest}},
            {"PointLight0 FARCLIP", {farthest}},
            {"UNITMM", {1}}}; // mm in one unit of all the lengths above
}

struct Buffers {
    ComPtr<ID3D12Resource> vertices, indices;
    UINT vertexBytes = 0, indexCount = 0;

    Buffers(Device& device, const void* stream, std::size_t bytes, const std::vector<std::uint32_t>& order)
        : vertices(device.buffer(bytes, D3D12_HEAP_TYPE_UPLOAD, stream)),
          indices(device.buffer(order.size() * 4, D3D12_HEAP_TYPE_UPLOAD, order.data())), vertexBytes(static_cast<UINT>(bytes)),
          indexCount(static_cast<UINT>(order.size())) {}

    void draw(ID3D12GraphicsCommandList* list, UINT instances) const {
        const D3D12_VERTEX_BUFFER_VIEW stream{vertices->GetGPUVirtualAddress(), vertexBytes, kVertexBytes};
        const D3D12_INDEX_BUFFER_VIEW order{indices->GetGPUVirtualAddress(), indexCount * 4, DXGI_FORMAT_R32_UINT};
        list->IASetVertexBuffers(0, 1, &stream);
        list->IASetIndexBuffer(&order);
        list->IASetPrimitiveTopology(D3D_PRIMITIVE_TOPOLOGY_TRIANGLELIST);
        list->DrawIndexedInstanced(indexCount, instances, 0, 0, 0);
    }
};

constexpr float kQuad[4][12] = {{-1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0},
                                {-1, -1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 1},
                                {1, 1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 0},
                                {1, -1, 0, 0, 0, 1, 1, 0, 0, 1, 1, 1}};

/// The effects give linear radiance. Tone map and sRGB are the engine's; this is what `tegument` does (docs/images.md).
std::uint8_t displayed(float linear) {
    const float finite = std::min(std::max(0.0F, linear), 65504.0F); // what is no number is black
    const float rest = std::max(finite - 0.8F, 0.0F) / 0.2F;
    const float c = std::min(finite, 0.8F) + 0.2F * rest / (1 + rest);
    return static_cast<std::uint8_t>(std::lround(255 * (c <= 0.0031308F ? c * 12.92F : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F)));
}

void save(Device& device, Texture& picture, const char* file) {
    const Rows rows = device.read(picture);
    Pixels shown{kSize, kSize, std::vector<std::uint8_t>(std::size_t{4} * kSize * kSize, 255)};
    for (UINT y = 0; y < kSize; ++y)
        for (UINT x = 0; x < kSize; ++x)
            for (UINT channel = 0; channel < 3; ++channel) {
                float value = 0;
                std::memcpy(&value, &rows.bytes[std::size_t{y} * rows.pitch + 4 * (std::size_t{4} * x + channel)], 4);
                shown.rgba[4 * (std::size_t{y} * kSize + x) + channel] = displayed(value);
            }
    savePicture(shown, file);
}

void run(char** files) {
    Device device;
    const Mesh mesh = loadMesh(files[2]);
    const auto scene = sceneOf(mesh);
    const Buffers head(device, mesh.vertices.data(), mesh.vertices.size(), mesh.indices);
    const Buffers quad(device, kQuad, sizeof kQuad, {0, 1, 2, 2, 1, 3});
    Texture color = loadTexture(device, files[3], true), normal = loadTexture(device, files[4], false);
    Texture picture = device.texture({kSize, kSize, 1, 1, DXGI_FORMAT_R32G32B32A32_FLOAT, D3D12_RESOURCE_FLAG_ALLOW_RENDER_TARGET});
    Texture depth = device.texture({kSize, kSize, 1, 1, DXGI_FORMAT_D24_UNORM_S8_UINT, D3D12_RESOURCE_FLAG_ALLOW_DEPTH_STENCIL});
    const auto draw = [&](const script_player::Pass&, bool drawsMesh, UINT instances) {
        (drawsMesh ? head : quad).draw(device.list(), instances);
    };
    const std::string folder = std::string(files[1]) + "\\";
    Effect stretch(device, folder + "Stretch"), attenuation(device, folder + "EnergyAttenuation"), skin(device, folder + "Main");
    for (Effect* effect : {&stretch, &attenuation, &skin}) {
        effect->makeTargets(kSize, kSize);
        effect->setValues([&](const script_player::Json& parameter) {
            const std::string object = parameter.at("annotations").textOr("Object", "");
            const auto found = scene.find((object.empty() ? "" : object + " ") + parameter.at("semantic").text());
            return found == scene.end() ? std::vector<float>() : found->second;
        });
    }
    stretch.run("Stretch", picture, depth, draw); // once for each mesh
    attenuation.run("EnergyAttenuation", picture, depth, draw);
    skin.setTexture("gSkinMap", &color);
    skin.setTexture("gNormalMap", &normal);
    skin.setTexture("gStretchMap", &stretch.target("gStretchMap"));
    skin.setTexture("gEnergyAttenuationMap", &attenuation.target("gEnergyAttenuationMap"));
    const float background[] = {0.008F, 0.008F, 0.012F, 0};
    device.transition(picture, D3D12_RESOURCE_STATE_RENDER_TARGET);
    device.transition(depth, D3D12_RESOURCE_STATE_DEPTH_WRITE);
    device.list()->ClearRenderTargetView(picture.target, background, 0, nullptr);
    device.list()->ClearDepthStencilView(depth.target, D3D12_CLEAR_FLAG_DEPTH, 1, 0, 0, nullptr);
    skin.run("DEonLuebke", picture, depth, draw); // each frame
    save(device, picture, files[5]);
}

} // namespace

int main(int count, char** arguments) try {
    if (count != 6) throw std::runtime_error("d3d12_sample EMITTED-FOLDER MESH.bin COLOUR.png NORMAL.png SHOT.png");
    run(arguments);
} catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}
