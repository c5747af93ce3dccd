// What the orders of triangles are worth when drawn: 1280 x 800, depth test, no culling, GPU timestamps, all orders interleaved in one run.
//
//     draw_time [--frames N] [--warm-up N] [--instances N] [--picture FILE.png] MESH...
//
// MESH: sphere, terrain, sphere:N, terrain:N, or a mesh file. The device is the first discrete one, or what $TEGUMENT_DEVICE names part of.
// --instances draws the mesh so many times in one call, as shells of fur are. Prints a table; ends with 1 when the orders' pictures differ,
// with 3 where there is no device.

#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "tests/order/draw/variants.h"

#include "shaders/surface_frag.h"
#include "shaders/surface_vert.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <limits>

namespace tegument::testing_order {
namespace {

constexpr std::uint32_t kWidth = 1280;
constexpr std::uint32_t kHeight = 800;

struct Options {
    int frames = 50;
    int warmUp = 10;
    std::uint32_t instances = 1;
    std::string picture;
    std::vector<std::string> meshes;
};

/// Ours in `surface.vert`.
struct View {
    glm::vec3 centre{0};
    float scale = 1;
    glm::vec4 size{0};
};

struct Drawable {
    Variant variant;
    gpu::Buffer vertices;
    gpu::Buffer indices;
    std::vector<double> milliseconds;
};

struct Stage {
    gpu::Device device;
    gpu::Texture color;
    gpu::Texture depth;
    gpu::Pipeline pipeline;
};

View viewOf(const Triangles& mesh) {
    glm::vec3 low(std::numeric_limits<float>::max());
    glm::vec3 high = -low;
    for (const glm::vec3& p : mesh.positions) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    const glm::vec3 centre = 0.5f * (low + high);
    constexpr float kFilled = 0.95f; // of the picture's height
    const float height = static_cast<float>(kHeight);
    const float radius = 0.5f * std::max({high.x - low.x, high.y - low.y, high.z - low.z, std::numeric_limits<float>::min()});
    return {.centre = centre, .scale = 1 / radius, .size = {kFilled * height / static_cast<float>(kWidth), kFilled, 0, 0}};
}

Result<Stage> makeStage() {
    auto device = gpu::Device::create();
    if (!device) return device.error();
    auto color =
        device->createTexture({.name = "color", .format = gpu::Format::RGBA8, .width = kWidth, .height = kHeight, .renderTarget = true});
    if (!color) return color.error();
    auto depth =
        device->createTexture({.name = "depth", .format = gpu::Format::D32F, .width = kWidth, .height = kHeight, .renderTarget = true});
    if (!depth) return depth.error();
    gpu::PipelineDesc desc{
        .name = "surface",
        .vertex = {.spirv = surface_vert, .entry = "main"},
        .pixel = {.spirv = surface_frag, .entry = "main"},
        .bindings = {{.set = 0, .binding = 0, .kind = gpu::BindingKind::UniformBuffer}},
        .attributes = {{.location = 0, .components = 3, .offset = 0}, {.location = 1, .components = 3, .offset = sizeof(glm::vec3)}},
        .vertexStride = sizeof(Vertex),
        .topology = gpu::Topology::TriangleList,
        .colorFormats = {gpu::Format::RGBA8},
        .depthFormat = gpu::Format::D32F};
    desc.state.cull = CullMode::None;
    auto pipeline = device->createPipeline(desc);
    if (!pipeline) return pipeline.error();
    return Stage{*std::move(device), *std::move(color), *std::move(depth), *std::move(pipeline)};
}

template <class T>
Result<gpu::Buffer> upload(gpu::Device& device, gpu::BufferUsage usage, const std::vector<T>& values) {
    return device.createBuffer(usage, std::as_bytes(std::span(values)));
}

Result<std::vector<Drawable>> makeDrawables(gpu::Device& device, const Triangles& mesh) {
    auto variants = makeVariants(mesh);
    if (!variants) return variants.error();
    std::vector<Drawable> out;
    for (Variant& variant : *variants) {
        Drawable drawable;
        auto vertices = upload(device, gpu::BufferUsage::Vertex, variant.vertices);
        if (!vertices) return vertices.error();
        drawable.vertices = *std::move(vertices);
        if (!variant.indices.empty()) {
            auto indices = upload(device, gpu::BufferUsage::Index, variant.indices);
            if (!indices) return indices.error();
            drawable.indices = *std::move(indices);
        }
        drawable.variant = std::move(variant);
        out.push_back(std::move(drawable));
    }
    return out;
}

/// Clears, then draws with a timer round the draw alone.
Result<void> record(gpu::Recorder& recorder, Stage& stage, const Drawable& drawable, const View& view, std::uint32_t instances) {
    if (auto done = recorder.clearColor(stage.color, {0, 0, 0, 1}); !done) return done;
    if (auto done = recorder.clearDepthStencil(stage.depth, 1.0f, std::nullopt); !done) return done;
    recorder.beginTimer(drawable.variant.name);
    const bool indexed = !drawable.variant.indices.empty();
    const std::size_t count = indexed ? drawable.variant.indices.size() : drawable.variant.vertices.size();
    auto done = recorder.draw({.colors = {&stage.color}, .depth = &stage.depth},
                              {.pipeline = &stage.pipeline,
                               .resources = {{.set = 0, .binding = 0, .resource = std::as_bytes(std::span(&view, 1))}},
                               .vertices = &drawable.vertices,
                               .indices = indexed ? &drawable.indices : nullptr,
                               .count = static_cast<std::uint32_t>(count),
                               .instances = instances});
    recorder.endTimer();
    return done;
}

/// Each frame draws every order, and each frame begins with another one.
Result<void> timeFrames(Stage& stage, std::vector<Drawable>& drawables, const View& view, const Options& options) {
    for (int frame = 0; frame < options.warmUp + options.frames; ++frame) {
        const std::size_t first = static_cast<std::size_t>(frame) % drawables.size();
        auto times = stage.device.run([&](gpu::Recorder& recorder) -> Result<void> {
            for (std::size_t i = 0; i < drawables.size(); ++i)
                if (auto done = record(recorder, stage, drawables[(first + i) % drawables.size()], view, options.instances); !done)
                    return done;
            return {};
        });
        if (!times) return times.error();
        if (frame < options.warmUp) continue;
        for (std::size_t i = 0; i < drawables.size(); ++i)
            drawables[(first + i) % drawables.size()].milliseconds.push_back((*times)[i].milliseconds);
    }
    return {};
}

Result<std::vector<std::byte>> pictureOf(Stage& stage, const Drawable& drawable, const View& view) {
    auto times = stage.device.run([&](gpu::Recorder& recorder) { return record(recorder, stage, drawable, view, 1); });
    if (!times) return times.error();
    return stage.device.readback(stage.color);
}

/// Pixels that differ by more than rounding: the interpolation begins at another corner.
std::size_t differences(const std::vector<std::byte>& a, const std::vector<std::byte>& b) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); i += 4)
        count += std::abs(std::to_integer<int>(a[i]) - std::to_integer<int>(b[i])) > 1;
    return count;
}

Result<void> writePicture(const std::string& path, const std::vector<std::byte>& bytes, const std::string& meshName) {
    Image image{.width = static_cast<int>(kWidth), .height = static_cast<int>(kHeight), .channels = 4};
    for (const std::byte value : bytes)
        image.pixels.push_back(static_cast<float>(std::to_integer<int>(value)) / 255.0f);
    image.metadata = {{"mesh", meshName}};
    return writePng(path, image, PngEncoding::Raw);
}

double quantile(std::vector<double> values, double share) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

void print(const Stage& stage, const Triangles& mesh, const std::vector<Drawable>& drawables, const Options& options) {
    fmt::print("\n{}, {} vertices, {} triangles, {} x {}{}; {} ({}), {} frames\n\n"
               "| order | ACMR, FIFO 16 | ATVR, warp | ms, median | p5 | p95 | frames per second | against indexed |\n"
               "|---|---|---|---|---|---|---|---|\n",
               mesh.name, mesh.positions.size(), mesh.faces(), kWidth, kHeight,
               options.instances > 1 ? fmt::format(", {} instances", options.instances) : std::string(), stage.device.info().name,
               stage.device.info().driver, options.frames);
    const double base = quantile(drawables[1].milliseconds, 0.5);
    for (const Drawable& drawable : drawables) {
        const double median = quantile(drawable.milliseconds, 0.5);
        fmt::print("| {} | {:.3f} | {:.3f} | {:.4f} | {:.4f} | {:.4f} | {:.1f} | {:.2f} |\n", drawable.variant.name, drawable.variant.acmr,
                   drawable.variant.warpAtvr, median, quantile(drawable.milliseconds, 0.05), quantile(drawable.milliseconds, 0.95),
                   1000 / median, base / median);
    }
    std::fflush(stdout);
}

/// Gives the largest number of pixels that differ between two orders.
Result<std::size_t> measure(Stage& stage, const std::string& what, const Options& options) {
    const auto mesh = loadTriangles(what);
    if (!mesh) return mesh.error();
    auto drawables = makeDrawables(stage.device, *mesh);
    if (!drawables) return drawables.error();
    const View view = viewOf(*mesh);
    if (auto done = timeFrames(stage, *drawables, view, options); !done) return done.error();
    print(stage, *mesh, *drawables, options);
    const auto first = pictureOf(stage, drawables->front(), view);
    if (!first) return first.error();
    std::size_t most = 0;
    for (const Drawable& drawable : *drawables) {
        const auto picture = pictureOf(stage, drawable, view);
        if (!picture) return picture.error();
        most = std::max(most, differences(*first, *picture));
    }
    fmt::print("\nPixels that differ between orders: {}\n", most);
    if (!options.picture.empty())
        if (auto done = writePicture(options.picture, *first, mesh->name); !done) return done.error();
    return most;
}

Options parse(const std::vector<std::string>& arguments) {
    Options options;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const bool value = i + 1 < arguments.size();
        if (value && arguments[i] == "--frames")
            options.frames = std::max(std::atoi(arguments[++i].c_str()), 1);
        else if (value && arguments[i] == "--warm-up")
            options.warmUp = std::max(std::atoi(arguments[++i].c_str()), 0);
        else if (value && arguments[i] == "--instances")
            options.instances = static_cast<std::uint32_t>(std::max(std::atoi(arguments[++i].c_str()), 1));
        else if (value && arguments[i] == "--picture")
            options.picture = arguments[++i];
        else
            options.meshes.push_back(arguments[i]);
    }
    return options;
}

int fail(const Error& error) {
    fmt::print(stderr, "{}\n", format(error));
    return static_cast<int>(error.blame);
}

constexpr int kSkipped = 77; // for ctest: this machine has no device to draw on

bool hasNoDevice(const Error& error) {
    const int code = error.diagnostics.front().code;
    return code == 6001 || code == 6002 || code == 6003;
}

int run(const Options& options) {
    if (options.meshes.empty()) {
        fmt::print(stderr, "draw_time [--frames N] [--warm-up N] [--instances N] [--picture FILE.png] MESH...\n");
        return 2;
    }
    auto stage = makeStage();
    if (!stage) return hasNoDevice(stage.error()) ? (fail(stage.error()), kSkipped) : fail(stage.error());
    std::size_t most = 0;
    for (const std::string& mesh : options.meshes) {
        const auto pixels = measure(*stage, mesh, options);
        if (!pixels) return fail(pixels.error());
        most = std::max(most, *pixels);
    }
    return most == 0 ? 0 : 1;
}

} // namespace
} // namespace tegument::testing_order

int main(int argc, char** argv) {
    return tegument::testing_order::run(tegument::testing_order::parse({argv + 1, argv + argc}));
}
