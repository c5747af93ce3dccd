#include "tools/view/mesh_canvas.h"

#include "host/scene/placement.h"

#include <cassert>
#include <cstring>
#include <string_view>

namespace tegument::view {

namespace {

// The third edge's line is where the third number is 0, and so on; 1 at all corners of an edge without one.
constexpr std::string_view kMeshCode = R"(
float4x4 gViewProjection;
float4 gEye;

struct MeshVaryings {
    float4 position : SV_Position;
    float3 place : TEXCOORD0;
    float3 color : TEXCOORD1;
    float3 seam : TEXCOORD2;
    float3 border : TEXCOORD3;
};

MeshVaryings MeshVS(float3 position : POSITION0, float3 color : COLOR0, float3 seam : TEXCOORD0, float3 border : TEXCOORD1) {
    MeshVaryings result;
    result.position = mul(float4(position, 1), gViewProjection);
    result.place = position;
    result.color = color;
    result.seam = seam;
    result.border = border;
    return result;
}

float lineAt(float3 edges) {
    float3 pixels = edges / max(fwidth(edges), 1e-6);
    return saturate(2 - min(pixels.x, min(pixels.y, pixels.z)));
}

float4 MeshPS(MeshVaryings input) : SV_Target {
    float3 normal = normalize(cross(ddx(input.place), ddy(input.place)));
    float3 color = input.color * (0.35 + 0.65 * abs(dot(normal, normalize(gEye.xyz - input.place))));
    color = lerp(color, float3(0.1, 0.8, 1), any(input.border < 1) ? lineAt(input.border) : 0);
    color = lerp(color, float3(1, 0.45, 0.05), any(input.seam < 1) ? lineAt(input.seam) : 0);
    return float4(color, 1);
}
)";

struct MeshVertex {
    glm::vec3 position{0};
    std::array<float, 3> color{};
    glm::vec3 seam{1};
    glm::vec3 border{1};
};

/// Of corner k: 0 on both ends of a marked edge, 1 at the corner across; 1 everywhere where the edge is not marked.
glm::vec3 edgesAt(std::size_t corner, const std::array<bool, 3>& marked) {
    glm::vec3 edges(1);
    for (std::size_t k = 0; k < 3; ++k)
        if (marked.at(k) && corner != (k + 2) % 3) edges[static_cast<glm::length_t>(k)] = 0;
    return edges;
}

std::vector<MeshVertex> verticesOf(const std::vector<ColoredMesh>& meshes, MeshShow show) {
    std::vector<MeshVertex> vertices;
    for (const ColoredMesh& colored : meshes)
        for (const MeshTriangle& triangle : colored.figures.triangles)
            for (std::size_t k = 0; k < 3; ++k) {
                const glm::dvec3 place = transformPoint(colored.world, colored.mesh->positions[triangle.corners.at(k)]);
                MeshVertex vertex{.position = place, .color = colorOf(show, triangle, colored.figures)};
                if (show == MeshShow::Seams) {
                    vertex.seam = edgesAt(k, triangle.seam);
                    vertex.border = edgesAt(k, triangle.border);
                }
                vertices.push_back(vertex);
            }
    return vertices;
}

std::vector<gpu::VertexAttribute> meshAttributes(const Shader& shader) {
    std::vector<gpu::VertexAttribute> attributes;
    for (const StageVariable& input : shader.reflection.inputs) {
        const std::size_t offset = input.semantic == "POSITION0"   ? offsetof(MeshVertex, position)
                                   : input.semantic == "COLOR0"    ? offsetof(MeshVertex, color)
                                   : input.semantic == "TEXCOORD0" ? offsetof(MeshVertex, seam)
                                                                   : offsetof(MeshVertex, border);
        attributes.push_back({.location = input.location, .components = input.components, .offset = static_cast<std::uint32_t>(offset)});
    }
    return attributes;
}

Result<Shader> compileMeshShader(std::string_view entry, ShaderStage stage, Compiler compiler) {
    return compileShader({.code = kMeshCode, .file = "the viewer's mesh", .entry = std::string(entry), .stage = stage}, compiler);
}

/// The block's bytes of one stage; the stages may know other members.
std::vector<std::byte> constantsOf(const UniformBlock& block, const Matrices& camera) {
    std::vector<std::byte> bytes(block.size);
    const glm::mat4 matrix = glm::transpose(camera.viewProjection); // host/scene/view.h
    const glm::vec4 eye(camera.position, 1);
    for (const BlockMember& member : block.members) {
        if (member.name == "gViewProjection") std::memcpy(bytes.data() + member.offset, &matrix, sizeof matrix);
        if (member.name == "gEye") std::memcpy(bytes.data() + member.offset, &eye, sizeof eye);
    }
    return bytes;
}

} // namespace

struct MeshCanvas::State {
    gpu::Device& device;
    Shader vertex;
    Shader pixel;
    gpu::Pipeline pipeline;
    gpu::Buffer vertices;
    std::uint32_t count = 0;
    gpu::Texture depth{};
};

MeshCanvas::MeshCanvas(std::unique_ptr<State> state) : state_(std::move(state)) {}
MeshCanvas::~MeshCanvas() = default;

std::vector<ColoredMesh> coloredMeshes(const SessionScene& scene) {
    std::vector<ColoredMesh> meshes;
    if (scene.mesh) meshes.push_back({.mesh = scene.mesh, .figures = examineMesh(*scene.mesh)});
    for (const RunObject& object : scene.objects)
        meshes.push_back({.mesh = object.mesh, .figures = examineMesh(*object.mesh), .world = worldMatrix(object.placement)});
    return meshes;
}

Result<std::unique_ptr<MeshCanvas>> MeshCanvas::create(gpu::Device& device, Compiler compiler, const std::vector<ColoredMesh>& meshes,
                                                       MeshShow show) {
    auto vertex = compileMeshShader("MeshVS", ShaderStage::Vertex, compiler);
    if (!vertex) return vertex.error();
    auto pixel = compileMeshShader("MeshPS", ShaderStage::Pixel, compiler);
    if (!pixel) return pixel.error();
    if (const auto linked = linkStages(*vertex, *pixel); !linked) return linked.error();
    std::vector<gpu::Binding> bindings;
    for (const Shader* shader : {&*vertex, &*pixel})
        if (const auto& globals = shader->reflection.globals)
            bindings.push_back({globals->set, globals->binding, gpu::BindingKind::UniformBuffer});
    PipelineState state;
    state.cull = CullMode::None;
    auto pipeline = device.createPipeline(gpu::PipelineDesc{.name = "mesh in false colours",
                                                            .vertex = {.spirv = vertex->spirv, .entry = vertex->entry},
                                                            .pixel = {.spirv = pixel->spirv, .entry = pixel->entry},
                                                            .bindings = std::move(bindings),
                                                            .attributes = meshAttributes(*vertex),
                                                            .vertexStride = sizeof(MeshVertex),
                                                            .colorFormats = {gpu::Format::RGBA8},
                                                            .depthFormat = gpu::Format::D32F,
                                                            .state = state});
    if (!pipeline) return pipeline.error();
    std::unique_ptr<MeshCanvas> canvas(new MeshCanvas(std::unique_ptr<State>(
        new State{.device = device, .vertex = std::move(*vertex), .pixel = std::move(*pixel), .pipeline = std::move(*pipeline)})));
    if (const auto colored = canvas->color(meshes, show); !colored) return colored.error();
    return canvas;
}

Result<void> MeshCanvas::color(const std::vector<ColoredMesh>& meshes, MeshShow show) {
    const std::vector<MeshVertex> vertices = verticesOf(meshes, show);
    auto buffer = state_->device.createBuffer(gpu::BufferUsage::Vertex, std::as_bytes(std::span(vertices)));
    if (!buffer) return buffer.error();
    state_->vertices = std::move(*buffer);
    state_->count = static_cast<std::uint32_t>(vertices.size());
    return {};
}

Result<void> MeshCanvas::draw(gpu::Texture& target, const Matrices& camera) {
    const gpu::TextureDesc& desc = target.desc();
    gpu::Texture& depth = state_->depth;
    if (!depth.state || depth.desc().width != desc.width || depth.desc().height != desc.height) {
        auto made = state_->device.createTexture(
            {.name = "depth of the mesh", .format = gpu::Format::D32F, .width = desc.width, .height = desc.height, .renderTarget = true});
        if (!made) return made.error();
        depth = std::move(*made);
    }
    gpu::Draw draw{.pipeline = &state_->pipeline, .vertices = &state_->vertices, .count = state_->count};
    std::vector<std::vector<std::byte>> blocks;
    blocks.reserve(2);
    for (const Shader* shader : {&state_->vertex, &state_->pixel})
        if (const auto& globals = shader->reflection.globals) {
            blocks.push_back(constantsOf(*globals, camera));
            draw.resources.push_back({globals->set, globals->binding, std::span<const std::byte>(blocks.back())});
        }
    const auto drawn = state_->device.run([&](gpu::Recorder& recorder) {
        if (auto cleared = recorder.clearColor(target, {0, 0, 0, 1}); !cleared) return cleared;
        if (auto cleared = recorder.clearDepthStencil(depth, 1.0F, std::nullopt); !cleared) return cleared;
        return recorder.draw({.colors = {&target}, .depth = &depth}, draw);
    });
    return drawn ? Result<void>() : Result<void>(drawn.error());
}

} // namespace tegument::view
