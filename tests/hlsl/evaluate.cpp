#include "tests/hlsl/evaluate.h"

#include "host/effect/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <regex>

namespace tegument::test {

namespace {

constexpr std::uint32_t kWidth = 128; // of the grid of argument lists

constexpr const char* kVertexShader = R"(
float4 ScreenVS(uint index : SV_VertexID) : SV_Position
{
    return float4(index == 1 ? 3.0 : -1.0, index == 2 ? 3.0 : -1.0, 0.0, 1.0);
}
)";

struct Grid {
    std::uint32_t rows = 0;   // of argument lists
    std::uint32_t texels = 0; // of four components that one list takes, one below the other
    std::uint32_t quad = 1;   // pixels a side per list

    Grid(const Samples& samples, bool perQuad)
        : rows(static_cast<std::uint32_t>(samples.count() / kWidth + 1)), texels(static_cast<std::uint32_t>(samples.components + 3) / 4),
          quad(perQuad ? 2 : 1) {}
};

std::string argumentCode(const std::vector<Argument>& arguments) {
    std::string code;
    int at = 0;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const int n = arguments[i].components;
        std::string parts;
        for (int c = 0; c < n; ++c)
            parts += fmt::format("{}values[{}]", c == 0 ? "" : ", ", at + c);
        code += n == 1 ? fmt::format("    float a{} = {};\n", i, parts) : fmt::format("    float{} a{} = float{}({});\n", n, i, n, parts);
        at += n;
    }
    return code;
}

constexpr const char* kLibrary = R"(#include "../hlsl/platform.fxh"
#include "../hlsl/settings.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/surface.fxh"
#include "../hlsl/specular.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/shadow.fxh"
#include "../hlsl/scatter.fxh"
#include "../hlsl/cull.fxh"
#include "../hlsl/fur.fxh"
#include "../hlsl/peers.fxh"
Texture2D gTestMap;
TG_SAMPLER2D(gTest, POINT, CLAMP);
)";

std::vector<std::pair<std::string, std::string>> definesOf(const FunctionCase& function, int setting) {
    std::vector<std::pair<std::string, std::string>> defines = {{"TEGUMENT_SETTING", std::to_string(setting)}};
    const auto isSize = [](const auto& define) { return define.first == "TEGUMENT_MAP_SIZE"; };
    if (std::ranges::none_of(function.defines, isSize)) defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(kTestMapSize));
    defines.insert(defines.end(), function.defines.begin(), function.defines.end());
    return defines;
}

/// What compute shaders store is a variable here, which the body reads: of each store the texel of the last one does not count. What a
/// group shares is one, too: a body calls one thread after the other, as often as they wait for each other, and once more.
std::string storesAsVariables(const std::string& code) {
    static const std::regex kDeclared(R"(RWTexture2D\s*<\s*float4\s*>\s*(\w+)\s*(?:<[^;]*>)?\s*;)");
    static const std::regex kStored(R"(\b(\w+Store)\s*\[[^\]]*\])");
    static const std::regex kWait(R"(\bGroupMemoryBarrierWithGroupSync\(\);)");
    static const std::regex kShared(R"(\bgroupshared\b)");
    const std::string stored = std::regex_replace(std::regex_replace(code, kDeclared, "static float4 $1 = 0.0;"), kStored, "$1");
    return std::regex_replace(std::regex_replace(stored, kWait, ""), kShared, "static");
}

/// The source that the function stands in, its own way of naming files and all.
Result<std::string> source(const FunctionCase& function, int setting) {
    if (function.effect.empty()) return std::string(kLibrary);
    auto effect = loadEffect("effects/" + function.effect, {.defines = definesOf(function, setting), .includeFolders = {}});
    if (!effect) return effect.error();
    return storesAsVariables(effect->code);
}

std::string pixelShader(std::string code, const FunctionCase& function, const Samples& samples, const Grid& grid) {
    code += "Texture2D gInputMap;\nfloat4 call(float values[";
    code += fmt::format("{}], float2 pixel)\n{{\n{}    {}\n}}\n", grid.texels * 4, argumentCode(function.arguments), function.body);
    code += fmt::format(R"(
float4 FunctionPS(float4 position : SV_Position) : SV_Target0
{{
    int2 cell = int2(position.xy) / {};
    if (cell.y * {} + cell.x >= {}) discard;
    float values[{}];
    [unroll] for (int i = 0; i < {}; i++)
    {{
        float4 four = gInputMap.Load(int3(cell.x, cell.y * {} + i, 0));
        values[4 * i] = four.x;
        values[4 * i + 1] = four.y;
        values[4 * i + 2] = four.z;
        values[4 * i + 3] = four.w;
    }}
    return call(values, floor(position.xy));
}}
)",
                        grid.quad, kWidth, samples.count(), grid.texels * 4, grid.texels, grid.texels);
    return code;
}

Result<Shader> compile(const FunctionCase& function, const std::string& code, Stage stage, const std::string& entry, int setting,
                       Compiler compiler) {
    ShaderRequest request{
        .code = code, .file = "effects/function_test.hlsl", .entry = entry, .stage = stage, .defines = {}, .includeFolders = {}};
    request.defines = definesOf(function, setting);
    return compileShader(request, compiler);
}

/// Textures of the argument lists and of the map that the function samples.
std::vector<std::array<float, 4>> inputTexels(const Samples& samples, const Grid& grid) {
    std::vector<std::array<float, 4>> texels(static_cast<std::size_t>(kWidth) * grid.rows * grid.texels);
    for (std::size_t index = 0; index < samples.count(); ++index) {
        const std::span<const float> list = samples.list(index);
        for (std::size_t c = 0; c < list.size(); ++c)
            texels[(index / kWidth * grid.texels + c / 4) * kWidth + index % kWidth][c % 4] = list[c];
    }
    return texels;
}

/// A column-major matrix is stored transposed (docs/conventions.md); a vector lies as it is written.
void store(const BlockMember& member, const std::vector<double>& value, std::vector<std::byte>& bytes) {
    const std::uint32_t rows = value.size() == 16 ? 4 : 1;
    const auto columns = static_cast<std::uint32_t>(value.size()) / rows;
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::uint32_t column = 0; column < columns; ++column) {
            const auto number = static_cast<float>(value[row * columns + column]);
            const std::uint32_t place = rows == 1 ? 4 * column : column * member.matrixStride + 4 * row;
            std::memcpy(bytes.data() + member.offset + place, &number, sizeof number);
        }
}

std::vector<std::byte> globals(const UniformBlock& block, const std::map<std::string, std::vector<double>>& values) {
    std::vector<std::byte> bytes(block.size);
    for (const BlockMember& member : block.members)
        if (const auto found = values.find(member.name); found != values.end()) store(member, found->second, bytes);
    return bytes;
}

struct Draw {
    gpu::Texture inputs;
    gpu::Texture map;
    std::map<std::string, gpu::Texture> maps;
    gpu::Texture target;
    gpu::Sampler sampler;
    std::vector<std::byte> globals;

    [[nodiscard]] gpu::Texture* named(const std::string& name) {
        if (name == "gInputMap") return &inputs;
        const auto found = maps.find(name);
        return found == maps.end() ? &map : &found->second;
    }
};

Result<gpu::Texture> texture(gpu::Device& device, const TestMap& map) {
    const auto width = static_cast<std::uint32_t>(map.size);
    const auto height = static_cast<std::uint32_t>(map.rows());
    auto made = device.createTexture({.name = "map",
                                      .format = gpu::Format::RGBA32F,
                                      .width = width,
                                      .height = height,
                                      .mips = static_cast<std::uint32_t>(map.mips),
                                      .cube = map.cube});
    if (!made) return made;
    std::span<const std::array<float, 4>> left(map.texels);
    for (std::uint32_t layer = 0; layer < (map.cube ? 6U : 1U); ++layer)
        for (std::uint32_t mip = 0; mip < static_cast<std::uint32_t>(map.mips); ++mip) {
            const std::size_t count = static_cast<std::size_t>(std::max(width >> mip, 1U)) * std::max(height >> mip, 1U);
            if (const auto uploaded = device.upload(*made, std::as_bytes(left.first(count)), mip, layer); !uploaded)
                return uploaded.error();
            left = left.subspan(count);
        }
    return made;
}

Result<Draw> prepare(gpu::Device& device, const FunctionCase& function, const Samples& samples, const Grid& grid, const Shader& pixel) {
    auto inputs = texture(device, TestMap{.size = static_cast<int>(kWidth),
                                          .texels = inputTexels(samples, grid),
                                          .height = static_cast<int>(grid.rows * grid.texels)});
    if (!inputs) return inputs.error();
    const TestMap none{.size = 1, .texels = {{0, 0, 0, 0}}};
    const TestMap& map = function.map ? *function.map : none;
    auto sampled = texture(device, map);
    if (!sampled) return sampled.error();
    std::map<std::string, gpu::Texture> named;
    for (const auto& [name, texels] : function.maps) {
        auto made = texture(device, *texels);
        if (!made) return made.error();
        named.emplace(name, std::move(*made));
    }
    auto target = device.createTexture({.name = "results",
                                        .format = gpu::Format::RGBA32F,
                                        .width = kWidth * grid.quad,
                                        .height = grid.rows * grid.quad,
                                        .renderTarget = true});
    if (!target) return target.error();
    const Filter filter = function.filtered ? Filter::Linear : Filter::Point;
    auto sampler = device.createSampler({.minFilter = filter,
                                         .magFilter = filter,
                                         .mipFilter = Filter::Point,
                                         .addressU = Address::Clamp,
                                         .addressV = Address::Clamp,
                                         .compare = {}});
    if (!sampler) return sampler.error();
    Draw draw{std::move(*inputs), std::move(*sampled), std::move(named), std::move(*target), std::move(*sampler), {}};
    if (pixel.reflection.globals) draw.globals = globals(*pixel.reflection.globals, function.globals);
    return draw;
}

struct Bound {
    std::vector<gpu::Binding> bindings;
    std::vector<gpu::BoundResource> resources;

    void add(std::uint32_t set, std::uint32_t binding, gpu::BindingKind kind, decltype(gpu::BoundResource::resource) resource) {
        bindings.push_back({set, binding, kind});
        resources.push_back({set, binding, resource});
    }
};

Bound bind(const Reflection& reflection, Draw& draw) {
    Bound bound;
    if (reflection.globals)
        bound.add(reflection.globals->set, reflection.globals->binding, gpu::BindingKind::UniformBuffer,
                  std::span<const std::byte>(draw.globals));
    for (const Resource& resource : reflection.resources) {
        if (resource.kind == ResourceKind::Sampler)
            bound.add(resource.set, resource.binding, gpu::BindingKind::Sampler, &draw.sampler);
        else
            bound.add(resource.set, resource.binding, gpu::BindingKind::Texture, draw.named(resource.name));
    }
    return bound;
}

Result<void> run(gpu::Device& device, const Shader& vertex, const Shader& pixel, Draw& draw) {
    Bound bound = bind(pixel.reflection, draw);
    gpu::PipelineDesc desc{.name = "function",
                           .vertex = {.spirv = vertex.spirv, .entry = vertex.entry},
                           .pixel = {.spirv = pixel.spirv, .entry = pixel.entry},
                           .bindings = bound.bindings,
                           .attributes = {},
                           .colorFormats = {gpu::Format::RGBA32F},
                           .depthFormat = {}};
    desc.state.cull = CullMode::None;
    desc.state.depthTest = false;
    const auto pipeline = device.createPipeline(desc);
    if (!pipeline) return pipeline.error();
    const auto ran = device.run([&](gpu::Recorder& recorder) -> Result<void> {
        if (const auto cleared = recorder.clearColor(draw.target, {kPoison, kPoison, kPoison, kPoison}); !cleared) return cleared;
        return recorder.draw({.colors = {&draw.target}}, {.pipeline = &*pipeline, .resources = bound.resources, .count = 3});
    });
    if (!ran) return ran.error();
    return {};
}

Evaluated collect(const std::vector<std::byte>& bytes, const Samples& samples, const Grid& grid, bool discards) {
    std::vector<std::array<float, 4>> pixels(bytes.size() / sizeof(std::array<float, 4>));
    std::memcpy(pixels.data(), bytes.data(), bytes.size());
    Evaluated evaluated;
    const std::size_t pitch = static_cast<std::size_t>(kWidth) * grid.quad;
    for (std::size_t index = 0; index < static_cast<std::size_t>(kWidth) * grid.rows; ++index) {
        const auto& pixel = pixels[index / kWidth * grid.quad * pitch + index % kWidth * grid.quad];
        const bool poisoned = pixel[0] == kPoison || pixel[1] == kPoison || pixel[2] == kPoison || pixel[3] == kPoison;
        if (index >= samples.count()) {
            evaluated.overwritten += !poisoned;
            continue;
        }
        const bool left = poisoned && discards;
        evaluated.unwritten += poisoned && !left;
        const auto nothing = static_cast<float>(kDiscarded[0]);
        evaluated.results.push_back(left ? std::array{nothing, nothing, nothing, nothing} : pixel);
    }
    return evaluated;
}

} // namespace

glm::dvec4 TestMap::texel(int x, int y) const {
    const auto column = static_cast<std::size_t>(glm::clamp(x, 0, size - 1));
    const auto row = static_cast<std::size_t>(glm::clamp(y, 0, rows() - 1));
    const auto& t = texels[row * static_cast<std::size_t>(size) + column];
    return {t[0], t[1], t[2], t[3]};
}

glm::dvec4 TestMap::at(glm::dvec2 uv) const {
    const auto place = [](double x, int count) { return static_cast<int>(std::floor(glm::clamp(x, -1.0, 2.0) * count)); };
    return texel(place(uv.x, size), place(uv.y, rows()));
}

Result<Evaluated> evaluate(gpu::Device& device, const FunctionCase& function, int setting, const Samples& samples, Compiler compiler) {
    const Grid grid(samples, function.perQuad);
    const auto vertex = compile(function, kVertexShader, Stage::Vertex, "ScreenVS", setting, compiler);
    if (!vertex) return vertex.error();
    auto code = source(function, setting);
    if (!code) return code.error();
    const auto pixel =
        compile(function, pixelShader(std::move(*code), function, samples, grid), Stage::Pixel, "FunctionPS", setting, compiler);
    if (!pixel) return pixel.error();
    auto draw = prepare(device, function, samples, grid, *pixel);
    if (!draw) return draw.error();
    if (const auto ran = run(device, *vertex, *pixel, *draw); !ran) return ran.error();
    const auto bytes = device.readback(draw->target);
    if (!bytes) return bytes.error();
    return collect(*bytes, samples, grid, function.discards);
}

} // namespace tegument::test
