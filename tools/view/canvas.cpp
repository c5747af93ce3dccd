#include "tools/view/canvas.h"

#include <algorithm>
#include <cstring>
#include <deque>
#include <string_view>
#include <utility>

namespace tegument::view {

namespace {

constexpr std::string_view kCode = R"(
float4 gScale;
float4 gOffset;
float4 gClip;
SamplerState gImage;
Texture2D gImageMap;

struct Varyings {
    float4 position : SV_Position;
    float2 uv : TEXCOORD0;
    float4 color : TEXCOORD1;
};

Varyings StreamVS(float2 position : POSITION0, float2 uv : TEXCOORD0, float4 color : COLOR0) {
    Varyings result;
    result.position = float4(position, 0, 1);
    result.uv = uv;
    result.color = color;
    return result;
}

// docs/conventions.md, "Colour": the knee at 0.8
float toneMapped(float radiance) {
    float t = max(0.0, radiance - 0.8) / 0.2;
    return radiance <= 0.8 ? max(0.0, radiance) : 0.8 + 0.2 * (1 - 1 / (1 + t));
}

// IEC 61966-2-1
float encoded(float x) {
    return x <= 0.0031308 ? 12.92 * x : 1.055 * pow(x, 1 / 2.4) - 0.055;
}

// The colour is the mode (x: channel, y: tone map, z: sRGB, w: mip level) and no parameter on purpose: lavapipe of Mesa 22 compiles a shader whose
// branches depend on parameters alone for their values at each draw, and keeps it.
float4 ShowPS(Varyings input) : SV_Target {
    float4 mode = input.color;
    float4 texel = gImageMap.SampleLevel(gImage, input.uv, mode.w);
    if (any(isnan(texel)) || any(isinf(texel))) return float4(1, 0, 1, 1);
    float4 level = texel * gScale + gOffset;
    float3 color = level.rgb;
    if (mode.x > 0.5) color = mode.x < 1.5 ? level.rrr : mode.x < 2.5 ? level.ggg : mode.x < 3.5 ? level.bbb : level.aaa;
    if (mode.y > 0.5) color = float3(toneMapped(color.r), toneMapped(color.g), toneMapped(color.b));
    color = saturate(color);
    if (mode.z > 0.5) color = float3(encoded(color.r), encoded(color.g), encoded(color.b));
    return float4(color, 1);
}

// What needs none of that: software devices run both sides of every branch, for each pixel of the window.
float4 CopyPS(Varyings input) : SV_Target { return float4(gImageMap.SampleLevel(gImage, input.uv, 0).rgb, 1); }

float4 BlendPS(Varyings input) : SV_Target {
    if (any(input.position.xy < gClip.xy) || any(input.position.xy >= gClip.zw)) discard;
    return input.color * gImageMap.SampleLevel(gImage, input.uv, 0);
}
)";

constexpr std::array<std::uint32_t, 6> kQuad = {0, 1, 2, 0, 2, 3};

/// The parameters of the code above, by their names there.
struct Constants {
    std::array<float, 4> scale{};
    std::array<float, 4> offset{};
    std::array<float, 4> clip{};

    [[nodiscard]] const std::array<float, 4>* find(std::string_view name) const {
        if (name == "gScale") return &scale;
        if (name == "gOffset") return &offset;
        return name == "gClip" ? &clip : nullptr;
    }
};

struct Program {
    Shader pixel;
    gpu::Pipeline pipeline;
};

Result<Shader> compile(std::string_view entry, ShaderStage stage, Compiler compiler) {
    return compileShader({.code = kCode, .file = "the viewer's canvas", .entry = std::string(entry), .stage = stage}, compiler);
}

std::vector<gpu::VertexAttribute> attributesOf(const Shader& vertex) {
    std::vector<gpu::VertexAttribute> attributes;
    for (const StageVariable& input : vertex.reflection.inputs) {
        const std::size_t offset = input.semantic == "POSITION0"   ? offsetof(CanvasVertex, x)
                                   : input.semantic == "TEXCOORD0" ? offsetof(CanvasVertex, u)
                                                                   : offsetof(CanvasVertex, color);
        attributes.push_back({.location = input.location, .components = input.components, .offset = static_cast<std::uint32_t>(offset)});
    }
    return attributes;
}

std::vector<gpu::Binding> bindingsOf(const Reflection& reflection) {
    std::vector<gpu::Binding> bindings;
    if (reflection.globals) bindings.push_back({reflection.globals->set, reflection.globals->binding, gpu::BindingKind::UniformBuffer});
    for (const Resource& resource : reflection.resources)
        bindings.push_back({resource.set, resource.binding,
                            resource.kind == ResourceKind::Sampler ? gpu::BindingKind::Sampler : gpu::BindingKind::Texture});
    return bindings;
}

PipelineState stateOf(bool blend) {
    PipelineState state;
    state.depthTest = false;
    state.depthWrite = false;
    state.cull = CullMode::None;
    if (blend) state.targets[0] = {.enable = true, .src = BlendFactor::SrcAlpha, .dst = BlendFactor::InvSrcAlpha};
    return state;
}

Result<Program> makeProgram(gpu::Device& device, const Shader& vertex, std::string_view entry, bool blend, Compiler compiler) {
    auto pixel = compile(entry, ShaderStage::Pixel, compiler);
    if (!pixel) return pixel.error();
    if (const auto linked = linkStages(vertex, *pixel); !linked) return linked.error();
    auto pipeline = device.createPipeline(gpu::PipelineDesc{.name = std::string(entry),
                                                            .vertex = {.spirv = vertex.spirv, .entry = vertex.entry},
                                                            .pixel = {.spirv = pixel->spirv, .entry = pixel->entry},
                                                            .bindings = bindingsOf(pixel->reflection),
                                                            .attributes = attributesOf(vertex),
                                                            .vertexStride = sizeof(CanvasVertex),
                                                            .colorFormats = {gpu::Format::RGBA8},
                                                            .state = stateOf(blend)});
    if (!pipeline) return pipeline.error();
    return Program{std::move(*pixel), std::move(*pipeline)};
}

std::vector<std::byte> layOut(const UniformBlock& block, const Constants& constants) {
    std::vector<std::byte> bytes(block.size);
    for (const BlockMember& member : block.members)
        if (const auto* value = constants.find(member.name)) std::memcpy(bytes.data() + member.offset, value->data(), sizeof(*value));
    return bytes;
}

/// `magFilter`: points, where texels are to be seen as they are.
Result<gpu::Sampler> makeSampler(gpu::Device& device, Filter minFilter, Filter magFilter = Filter::Point) {
    return device.createSampler({.minFilter = minFilter,
                                 .magFilter = magFilter,
                                 .mipFilter = Filter::Point,
                                 .addressU = Address::Clamp,
                                 .addressV = Address::Clamp,
                                 .addressW = Address::Clamp});
}

/// One side of a quad, in clip space and in texture coordinates.
struct Side {
    float at = 0;
    float uv = 0;
};

/// No farther than an end of the area.
Side clipped(const Side& side, const Side& other, double least, double most) {
    const double at = std::clamp(static_cast<double>(side.at), least, most);
    const double width = other.at - side.at;
    const double uv = width == 0 ? side.uv : side.uv + (at - side.at) / width * (other.uv - side.uv);
    return {static_cast<float>(at), static_cast<float>(uv)};
}

/// The whole texture in the middle of its area of the target, or what is seen of it there from nearer.
std::array<CanvasVertex, 4> fittedQuad(const gpu::TextureDesc& target, const gpu::TextureDesc& texture, const std::array<float, 4>& color,
                                       const Canvas::Fit& fit) {
    const auto [left, top, right, bottom] = fit.area;
    const double across = (right - left) * target.width / texture.width;
    const double down = (bottom - top) * target.height / texture.height;
    const double scale = std::min(across, down);
    const double halfWidth = (right - left) * (fit.fill ? 1 : scale / across);
    const double halfHeight = (bottom - top) * (fit.fill ? 1 : scale / down);
    const double stillX = 2 * (left + (right - left) * static_cast<double>(fit.closer.at[0])) - 1;
    const double stillY = 1 - 2 * (top + (bottom - top) * static_cast<double>(fit.closer.at[1]));
    const auto zoomed = [&](double still, double at) {
        return static_cast<float>(still + static_cast<double>(fit.closer.zoom) * (at - still));
    };
    const Side west{zoomed(stillX, left + right - 1 - halfWidth), 0};
    const Side east{zoomed(stillX, left + right - 1 + halfWidth), 1};
    const Side north{zoomed(stillY, 1 - top - bottom + halfHeight), 0};
    const Side south{zoomed(stillY, 1 - top - bottom - halfHeight), 1};
    const Side l = clipped(west, east, 2 * left - 1, 2 * right - 1);
    const Side r = clipped(east, west, 2 * left - 1, 2 * right - 1);
    const Side t = clipped(north, south, 1 - 2 * bottom, 1 - 2 * top);
    const Side b = clipped(south, north, 1 - 2 * bottom, 1 - 2 * top);
    return {CanvasVertex{l.at, t.at, l.uv, t.uv, color}, CanvasVertex{r.at, t.at, r.uv, t.uv, color},
            CanvasVertex{r.at, b.at, r.uv, b.uv, color}, CanvasVertex{l.at, b.at, l.uv, b.uv, color}};
}

/// One draw with everything that must live until it has run.
struct Prepared {
    gpu::Texture* target = nullptr;
    bool clear = false;
    std::vector<std::byte> block;
    std::vector<CanvasVertex> vertices;
    std::vector<std::uint32_t> indices;
    gpu::Draw draw;
};

} // namespace

struct Canvas::State {
    gpu::Device& device;
    gpu::Sampler smooth;
    gpu::Sampler soft;  // larger than it is, too
    gpu::Sampler exact; // depths cannot be filtered everywhere
    Program show;
    Program copy;
    Program blend;
    std::deque<Prepared> waiting; // places stay
    bool together = false;

    void add(const Program& program, const gpu::Sampler& sampler, const Canvas::Mesh& mesh, const Constants& constants,
             gpu::Texture& target, bool clear);
};

void Canvas::State::add(const Program& program, const gpu::Sampler& sampler, const Canvas::Mesh& mesh, const Constants& constants,
                        gpu::Texture& target, bool clear) {
    const Reflection& reflection = program.pixel.reflection;
    const auto& globals = reflection.globals;
    Prepared& prepared = waiting.emplace_back(Prepared{.target = &target,
                                                       .clear = clear,
                                                       .block = globals ? layOut(*globals, constants) : std::vector<std::byte>(),
                                                       .vertices = {mesh.vertices.begin(), mesh.vertices.end()},
                                                       .indices = {mesh.indices.begin(), mesh.indices.end()}});
    prepared.draw = {.pipeline = &program.pipeline,
                     .vertexBytes = std::as_bytes(std::span(prepared.vertices)),
                     .indexBytes = std::as_bytes(std::span(prepared.indices)),
                     .count = static_cast<std::uint32_t>(prepared.indices.size())};
    if (globals) prepared.draw.resources.push_back({globals->set, globals->binding, std::span<const std::byte>(prepared.block)});
    for (const Resource& resource : reflection.resources) {
        gpu::BoundResource bound{.set = resource.set, .binding = resource.binding, .resource = mesh.texture};
        if (resource.kind == ResourceKind::Sampler) bound.resource = &sampler;
        prepared.draw.resources.push_back(bound);
    }
}

Canvas::Canvas(std::unique_ptr<State> state) : state_(std::move(state)) {}
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;
Canvas::~Canvas() = default;

Result<Canvas> Canvas::create(gpu::Device& device, Compiler compiler) {
    const auto vertex = compile("StreamVS", ShaderStage::Vertex, compiler);
    if (!vertex) return vertex.error();
    auto show = makeProgram(device, *vertex, "ShowPS", false, compiler);
    if (!show) return show.error();
    auto copy = makeProgram(device, *vertex, "CopyPS", false, compiler);
    if (!copy) return copy.error();
    auto blend = makeProgram(device, *vertex, "BlendPS", true, compiler);
    if (!blend) return blend.error();
    auto smooth = makeSampler(device, Filter::Linear);
    if (!smooth) return smooth.error();
    auto soft = makeSampler(device, Filter::Linear, Filter::Linear);
    if (!soft) return soft.error();
    auto exact = makeSampler(device, Filter::Point);
    if (!exact) return exact.error();
    return Canvas(std::unique_ptr<State>(new State{.device = device,
                                                   .smooth = std::move(*smooth),
                                                   .soft = std::move(*soft),
                                                   .exact = std::move(*exact),
                                                   .show = std::move(*show),
                                                   .copy = std::move(*copy),
                                                   .blend = std::move(*blend)}));
}

Result<void> Canvas::show(gpu::Texture& target, gpu::Texture& texture, const Levels& levels) {
    return show(target, texture, levels, Fit{});
}

Result<void> Canvas::show(gpu::Texture& target, gpu::Texture& texture, const Levels& levels, const Fit& fit) {
    const std::array<float, 4> mode{static_cast<float>(levels.channel), levels.toneMap ? 1.0F : 0.0F, levels.encode ? 1.0F : 0.0F,
                                    static_cast<float>(levels.mip)};
    const auto quad = fittedQuad(target.desc(), texture.desc(), mode, fit);
    const Constants constants{.scale = levels.scale, .offset = levels.offset};
    const gpu::Sampler& sampler = gpu::isDepth(texture.desc().format) ? state_->exact : fit.fill ? state_->soft : state_->smooth;
    const bool plain = levels == Levels{} && texture.desc().format == gpu::Format::RGBA8; // which holds no NaN
    state_->add(plain ? state_->copy : state_->show, sampler, {.vertices = quad, .indices = kQuad, .texture = &texture}, constants, target,
                true);
    return state_->together ? Result<void>() : draw();
}

Result<void> Canvas::blend(gpu::Texture& target, std::span<const Mesh> meshes) {
    for (const Mesh& mesh : meshes)
        state_->add(state_->blend, mesh.soft ? state_->soft : state_->smooth, mesh, {.clip = mesh.clip}, target, false);
    return state_->together ? Result<void>() : draw();
}

Result<void> Canvas::together(const std::function<Result<void>()>& what) {
    state_->together = true;
    const auto done = what();
    state_->together = false;
    if (done) return draw();
    state_->waiting.clear();
    return done;
}

Result<void> Canvas::draw() {
    const std::deque<Prepared> draws = std::exchange(state_->waiting, {});
    const auto run = state_->device.run([&](gpu::Recorder& recorder) -> Result<void> {
        for (const Prepared& prepared : draws) {
            if (prepared.clear)
                if (auto cleared = recorder.clearColor(*prepared.target, {0, 0, 0, 1}); !cleared) return cleared;
            if (auto drawn = recorder.draw({.colors = {prepared.target}}, prepared.draw); !drawn) return drawn;
        }
        return {};
    });
    return run ? Result<void>() : Result<void>(run.error());
}

} // namespace tegument::view
