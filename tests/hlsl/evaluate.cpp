#include "tests/hlsl/evaluate.h"

#include "host/effect/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numbers>
#include <optional>
#include <random>
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

std::string argumentCode(const Arguments& arguments) {
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

Defines definesOf(const FunctionCase& function, int setting) {
    Defines defines = {{"TEGUMENT_SETTING", std::to_string(setting)}};
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
    auto effect = loadEffect("effects/" + function.effect, {.defines = definesOf(function, setting)});
    if (!effect) return effect.error();
    return storesAsVariables(effect->code);
}

/// Of up to four numbers.
constexpr const char* kFour = R"(
float4 tgFour(float v) { return float4(v, 0.0, 0.0, 0.0); }
float4 tgFour(float2 v) { return float4(v, 0.0, 0.0); }
float4 tgFour(float3 v) { return float4(v, 0.0); }
float4 tgFour(float4 v) { return v; }
)";

std::string pixelShader(std::string code, const FunctionCase& function, const Samples& samples, const Grid& grid) {
    code += kFour;
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

Result<Shader> compile(const FunctionCase& function, const std::string& code, ShaderStage stage, const std::string& entry, int setting,
                       Compiler compiler) {
    ShaderRequest request{.code = code, .file = "effects/function_test.hlsl", .entry = entry, .stage = stage};
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
                           .colorFormats = {gpu::Format::RGBA32F}};
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

constexpr unsigned kSeed = 20070807; // any fixed number
constexpr int kMatesOfSpecials = 6;  // stratified lists that each special value is put into

using Random = std::mt19937;

double fraction(Random& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

/// One value in each of `count` equal strata of [0, 1), in random order.
std::vector<double> strata(std::size_t count, Random& random) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = (static_cast<double>(i) + fraction(random)) / static_cast<double>(count);
    std::shuffle(values.begin(), values.end(), random);
    return values;
}

double logSpread(double low, double high, double t) {
    return low * std::pow(high / low, t);
}

double spreadCosine(const Argument& argument, double t) {
    constexpr double kSmallest = 1e-7;
    if (t < 0.5) return argument.low + (argument.high - argument.low) * 2 * t;
    const double magnitude = logSpread(kSmallest, 1, std::fmod(4 * (t - 0.5), 1.0));
    return std::clamp(t < 0.75 ? magnitude : -magnitude, argument.low, argument.high);
}

/// A direction, from as many numbers in [0, 1) as it has components (the last gives the length).
void direction(const Argument& argument, std::span<const double> t, std::span<float> out) {
    const double turn = 2 * std::numbers::pi * t[0];
    const double length = argument.spread == Spread::Unit ? 1 : logSpread(argument.low, argument.high, t[out.size() - 1]);
    if (out.size() == 2) {
        out[0] = static_cast<float>(length * std::cos(turn));
        out[1] = static_cast<float>(length * std::sin(turn));
        return;
    }
    const double z = 2 * t[1] - 1;
    const double ring = std::sqrt(1 - z * z);
    out[0] = static_cast<float>(length * ring * std::cos(turn));
    out[1] = static_cast<float>(length * ring * std::sin(turn));
    out[2] = static_cast<float>(length * z);
    if (out.size() == 4) out[3] = static_cast<float>(length * (2 * t[2] - 1));
}

void spread(const Argument& argument, std::span<const double> t, std::span<float> out) {
    if (argument.spread == Spread::Unit || argument.spread == Spread::Vector) return direction(argument, t, out);
    for (std::size_t c = 0; c < out.size(); ++c) {
        double value = argument.low + (argument.high - argument.low) * t[c];
        if (argument.spread == Spread::Log) value = logSpread(argument.low, argument.high, t[c]);
        if (argument.spread == Spread::Cosine) value = spreadCosine(argument, t[c]);
        if (argument.spread == Spread::Whole) value = std::floor(argument.low + (argument.high - argument.low + 1) * t[c]);
        out[c] = static_cast<float>(value);
    }
}

std::vector<float> specialScalars(const Argument& argument) {
    constexpr float kDenormal = 1e-40F;
    const float one = 1;
    std::vector<float> all = {0.0F,
                              -0.0F,
                              std::numeric_limits<float>::denorm_min(),
                              kDenormal,
                              -kDenormal,
                              std::numeric_limits<float>::min(),
                              1e-30F,
                              1e-20F,
                              1e-10F,
                              1e-7F,
                              -1e-7F,
                              1e-5F,
                              1e-4F,
                              1e-3F,
                              0.01F,
                              0.5F,
                              std::nextafter(one, 0.0F),
                              one,
                              std::nextafter(one, 2.0F),
                              -one,
                              static_cast<float>(argument.low),
                              static_cast<float>(argument.high)};
    // What lies below a logarithmic range is still an input that may occur: zero and denormals. What lies outside the others may not.
    const double low = argument.spread == Spread::Log ? 0 : argument.low;
    std::erase_if(all, [&](float v) { return v < low || v > argument.high; });
    if (argument.spread == Spread::Whole) std::erase_if(all, [](float v) { return v != std::floor(v); });
    return all;
}

/// Special values of a whole argument: of a vector also zero, denormal and axis-parallel ones.
std::vector<std::vector<float>> specials(const Argument& argument) {
    std::vector<std::vector<float>> all;
    const auto n = static_cast<std::size_t>(argument.components);
    if (argument.spread == Spread::Unit || argument.spread == Spread::Vector) {
        for (float length : {0.0F, 1e-40F, 1e-20F, 1e-10F}) // no direction is left of these, also where a unit vector is asked for
            all.emplace_back(n, length);
        const float length = argument.spread == Spread::Unit ? 1.0F : static_cast<float>(argument.high);
        for (std::size_t axis = 0; axis < n; ++axis)
            for (float sign : {1.0F, -1.0F}) {
                all.emplace_back(n, 0.0F)[axis] = sign * length;
                all.emplace_back(n, 1e-7F * length)[axis] = sign * length; // grazing
            }
        return all;
    }
    for (float value : specialScalars(argument))
        all.emplace_back(n, value);
    return all;
}

class Maker {
public:
    explicit Maker(const FunctionCase& function) : function_(function) {
        for (const Argument& argument : function.arguments)
            result_.components += argument.components;
    }

    Samples make() {
        addStratified(static_cast<std::size_t>(function_.samples));
        forEachArgument([&](const Argument& argument, std::size_t first) {
            for (const auto& special : specials(argument))
                addWith(first, special, kMatesOfSpecials);
        });
        result_.finite = result_.count();
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        for (std::size_t c = 0; c < static_cast<std::size_t>(result_.components); ++c)
            for (float hostile : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity})
                addWith(c, {hostile}, 2);
        return std::move(result_);
    }

private:
    template <class Visit>
    void forEachArgument(Visit visit) {
        std::size_t first = 0;
        for (const Argument& argument : function_.arguments) {
            visit(argument, first);
            first += static_cast<std::size_t>(argument.components);
        }
    }

    void addStratified(std::size_t count) {
        const auto components = static_cast<std::size_t>(result_.components);
        std::vector<std::vector<double>> dimensions;
        for (std::size_t c = 0; c < components; ++c)
            dimensions.push_back(strata(count, random_));
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<double> t(components);
            for (std::size_t c = 0; c < components; ++c)
                t[c] = dimensions[c][i];
            std::vector<float> list(components);
            forEachArgument([&](const Argument& argument, std::size_t first) {
                const auto n = static_cast<std::size_t>(argument.components);
                spread(argument, std::span(t).subspan(first, n), std::span(list).subspan(first, n));
            });
            result_.values.insert(result_.values.end(), list.begin(), list.end());
        }
    }

    void addWith(std::size_t first, const std::vector<float>& special, std::size_t count) {
        addStratified(count);
        const auto components = static_cast<std::size_t>(result_.components);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t list = result_.values.size() - (i + 1) * components;
            std::ranges::copy(special, result_.values.begin() + static_cast<std::ptrdiff_t>(list + first));
        }
    }

    const FunctionCase& function_;
    Samples result_;
    Random random_{kSeed};
};

} // namespace

dvec4 TestMap::texel(int x, int y) const {
    const auto column = static_cast<std::size_t>(glm::clamp(x, 0, size - 1));
    const auto row = static_cast<std::size_t>(glm::clamp(y, 0, rows() - 1));
    const auto& t = texels[row * static_cast<std::size_t>(size) + column];
    return {t[0], t[1], t[2], t[3]};
}

dvec4 TestMap::at(dvec2 uv) const {
    const auto place = [](double x, int count) { return static_cast<int>(std::floor(glm::clamp(x, -1.0, 2.0) * count)); };
    return texel(place(uv.x, size), place(uv.y, rows()));
}

Result<Evaluated> evaluate(gpu::Device& device, const FunctionCase& function, int setting, const Samples& samples, Compiler compiler) {
    const Grid grid(samples, function.perQuad);
    const auto vertex = compile(function, kVertexShader, ShaderStage::Vertex, "ScreenVS", setting, compiler);
    if (!vertex) return vertex.error();
    auto code = source(function, setting);
    if (!code) return code.error();
    const auto pixel =
        compile(function, pixelShader(std::move(*code), function, samples, grid), ShaderStage::Pixel, "FunctionPS", setting, compiler);
    if (!pixel) return pixel.error();
    auto draw = prepare(device, function, samples, grid, *pixel);
    if (!draw) return draw.error();
    if (const auto ran = run(device, *vertex, *pixel, *draw); !ran) return ran.error();
    const auto bytes = device.readback(draw->target);
    if (!bytes) return bytes.error();
    return collect(*bytes, samples, grid, function.discards);
}

Samples makeSamples(const FunctionCase& function) {
    return Maker(function).make();
}

} // namespace tegument::test
