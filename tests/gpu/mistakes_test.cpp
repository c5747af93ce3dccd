// What is refused before Vulkan sees it: each mistake has its code and names the culprit. No validation message may appear.

#include "tests/gpu/fixture.h"

#include "shaders/copy_frag.h"
#include "shaders/mesh_vert.h"
#include "shaders/prefix_comp.h"
#include "shaders/screen_vert.h"
#include "shaders/uniform_frag.h"

#include <limits>

namespace tegument::gpu {
namespace {

/// The error has this code, and its text holds every one of the words.
template <class T>
::testing::AssertionResult fails(const Result<T>& result, int code, std::initializer_list<std::string_view> words) {
    if (result) return ::testing::AssertionFailure() << "no error, expected TG" << code;
    const std::string text = format(result.error());
    if (codeOf(result) != code) return ::testing::AssertionFailure() << "expected TG" << code << ": " << text;
    for (const std::string_view word : words)
        if (text.find(word) == std::string::npos) return ::testing::AssertionFailure() << "'" << word << "' is missing: " << text;
    return ::testing::AssertionSuccess();
}

class TextureMistakes : public Gpu {
protected:
    auto make(TextureDesc desc) {
        desc.name = "culprit";
        return device().createTexture(desc);
    }
};

TEST_F(TextureMistakes, zero_size) {
    EXPECT_TRUE(fails(make({.width = 0, .height = 4}), 6010, {"culprit", "0x4"}));
    EXPECT_TRUE(fails(make({.width = 4, .height = 0}), 6010, {"culprit", "4x0"}));
}

TEST_F(TextureMistakes, larger_than_the_device_allows) {
    EXPECT_TRUE(fails(make({.width = 1'000'000, .height = 1}), 6010, {"culprit", "1000000x1", device().info().name}));
    EXPECT_TRUE(fails(make({.width = std::numeric_limits<std::uint32_t>::max(), .height = 1, .mips = 0}), 6010, {"culprit"}));
}

TEST_F(TextureMistakes, larger_than_the_memory) {
    // 16384 x 16384 x 16 bytes x 6 faces = 24 GiB.
    const auto made = make({.format = Format::RGBA32F, .width = 16384, .height = 16384, .cube = true});
    if (made) GTEST_SKIP() << device().info().name << " has room for it";
    EXPECT_TRUE(codeOf(made) == 6008 || codeOf(made) == 6010) << format(made.error());
    EXPECT_TRUE(fails(made, codeOf(made), {"culprit"}));
}

TEST_F(TextureMistakes, cube_maps_that_cannot_be) {
    EXPECT_TRUE(fails(make({.width = 4, .height = 8, .cube = true}), 6012, {"culprit"}));
    EXPECT_TRUE(fails(make({.width = 4, .height = 4, .cube = true, .renderTarget = true}), 6012, {"culprit"}));
}

TEST_F(TextureMistakes, written_by_dispatches_and_no_colour_target) {
    EXPECT_TRUE(fails(make({.width = 4, .height = 4, .storage = true}), 6012, {"culprit", "dispatches"}));
    EXPECT_TRUE(fails(make({.format = Format::D32F, .width = 4, .height = 4, .renderTarget = true, .storage = true}), 6012,
                      {"culprit", "dispatches"}));
}

TEST_F(TextureMistakes, more_mips_than_there_are) {
    EXPECT_TRUE(fails(make({.width = 4, .height = 4, .mips = 4}), 6012, {"culprit", "4", "3"}));
}

TEST_F(TextureMistakes, uploads_of_the_wrong_size_or_place) {
    Texture image = must(make({.format = Format::R32F, .width = 2, .height = 2}));
    EXPECT_TRUE(fails(device().upload(image, bytesOf(std::vector<float>(3))), 6013, {"culprit", "16", "12"}));
    EXPECT_TRUE(fails(device().upload(image, bytesOf(std::vector<float>(4)), 1), 6014, {"culprit"}));
    EXPECT_TRUE(fails(device().upload(image, bytesOf(std::vector<float>(4)), 0, 1), 6014, {"culprit"}));
    EXPECT_TRUE(fails(device().readback(image, 1), 6014, {"culprit"}));
    EXPECT_TRUE(fails(device().readback(image, 40), 6014, {"culprit"})); // no number is shifted by so much
}

TEST_F(TextureMistakes, uploads_to_depth) {
    for (const Format format : {Format::D16, Format::D24S8, Format::D32FS8}) {
        Texture depth = must(make({.format = format, .renderTarget = true}));
        EXPECT_TRUE(fails(device().upload(depth, bytesOf(std::vector<float>(1))), 6013, {"culprit", "D32F"}));
    }
    for (const float outside : {-0.1F, 1.1F, std::numeric_limits<float>::quiet_NaN()}) {
        Texture depth = must(make({.format = Format::D32F}));
        EXPECT_TRUE(fails(device().upload(depth, bytesOf(std::vector<float>{outside})), 6013, {"culprit", "0 to 1"}));
    }
}

TEST_F(TextureMistakes, mips_of_depth) {
    Texture depth = must(make({.format = Format::D32F, .width = 4, .height = 4, .mips = 0, .renderTarget = true}));
    EXPECT_TRUE(fails(device().run([&](Recorder& recorder) { return recorder.generateMips(depth); }), 6040, {"culprit"}));
}

TEST_F(TextureMistakes, clears_of_the_wrong_kind_or_value) {
    Texture color = must(make({.renderTarget = true}));
    Texture depth = must(make({.format = Format::D32F, .renderTarget = true}));
    const auto clearDepth = [&](Texture& image, std::optional<float> value, std::optional<std::uint32_t> stencil) {
        return device().run([&](Recorder& recorder) { return recorder.clearDepthStencil(image, value, stencil); });
    };
    EXPECT_TRUE(fails(device().run([&](Recorder& recorder) { return recorder.clearColor(depth, {}); }), 6042, {"culprit"}));
    EXPECT_TRUE(fails(clearDepth(color, 1.0f, std::nullopt), 6042, {"culprit"}));
    EXPECT_TRUE(fails(clearDepth(depth, std::nullopt, 1), 6042, {"culprit", "stencil"}));
    EXPECT_TRUE(fails(clearDepth(depth, 1.5f, std::nullopt), 6042, {"culprit", "1.5"}));
    EXPECT_TRUE(fails(clearDepth(depth, std::numeric_limits<float>::quiet_NaN(), std::nullopt), 6042, {"culprit"}));
}

TEST_F(TextureMistakes, empty_buffers) {
    EXPECT_TRUE(fails(device().createBuffer(BufferUsage::Vertex, {}), 6015, {}));
}

class PipelineMistakes : public Gpu {
protected:
    PipelineDesc desc() { return screen(uniform_frag, {{0, 0}}, {Format::RGBA32F}); }
};

TEST_F(PipelineMistakes, what_is_not_spirv) {
    const std::vector<std::uint32_t> garbage(64, 0x12345678);
    PipelineDesc bad = desc();
    bad.pixel.spirv = garbage;
    EXPECT_TRUE(fails(device().createPipeline(bad), 6020, {"screen", "pixel"}));
    bad = desc();
    bad.vertex.spirv = {};
    EXPECT_TRUE(fails(device().createPipeline(bad), 6020, {"screen", "vertex"}));
    bad = desc();
    bad.pixel.spirv = std::span(uniform_frag).first(6); // the header and half an instruction
    EXPECT_TRUE(fails(device().createPipeline(bad), 6020, {"screen", "pixel"}));
}

TEST_F(PipelineMistakes, entry_points_that_are_not_there) {
    PipelineDesc bad = desc();
    bad.pixel.entry = "PSMain";
    EXPECT_TRUE(fails(device().createPipeline(bad), 6021, {"screen", "PSMain", "pixel"}));
    bad = desc();
    bad.pixel.spirv = screen_vert; // there is a main, but of another stage
    EXPECT_TRUE(fails(device().createPipeline(bad), 6021, {"main", "pixel"}));
}

TEST_F(PipelineMistakes, bindings_declared_twice) {
    PipelineDesc bad = desc();
    bad.bindings.push_back({0, 0, BindingKind::Texture});
    EXPECT_TRUE(fails(device().createPipeline(bad), 6022, {"set 0 binding 0"}));
}

TEST_F(PipelineMistakes, more_sets_than_the_device_has) {
    PipelineDesc bad = desc();
    bad.bindings.push_back({1000, 0, BindingKind::Texture});
    EXPECT_TRUE(fails(device().createPipeline(bad), 6023, {"set 1000 binding 0"}));
}

TEST_F(PipelineMistakes, targets_that_cannot_be) {
    PipelineDesc bad = desc();
    bad.colorFormats = std::vector<Format>(9, Format::RGBA8);
    EXPECT_TRUE(fails(device().createPipeline(bad), 6026, {"9"}));
    bad.colorFormats = {};
    EXPECT_TRUE(fails(device().createPipeline(bad), 6026, {"screen"}));
    bad.colorFormats = {Format::D32F};
    EXPECT_TRUE(fails(device().createPipeline(bad), 6026, {"screen"}));
    bad = desc();
    bad.depthFormat = Format::RGBA8;
    EXPECT_TRUE(fails(device().createPipeline(bad), 6026, {"RGBA8"}));
}

class DrawMistakes : public Drawing {
protected:
    auto drawCopy(std::vector<BoundResource> resources) { return drawOnce({.colors = {&image_}}, screenDraw(copy_, std::move(resources))); }
    auto drawUniform(const Targets& targets) { return drawOnce(targets, screenDraw(color_, {{0, 0, bytesOf(white_)}})); }
};

TEST_F(DrawMistakes, a_missing_binding) {
    EXPECT_TRUE(fails(drawCopy({{0, 1, &other_}}), 6030, {"screen", "set 0 binding 2", "sampler"}));
    EXPECT_TRUE(fails(drawCopy({{0, 1, static_cast<Texture*>(nullptr)}, {0, 2, &point_}}), 6030, {"set 0 binding 1", "texture"}));
}

TEST_F(DrawMistakes, a_binding_given_twice) {
    EXPECT_TRUE(fails(drawCopy({{0, 1, &other_}, {0, 1, &other_}, {0, 2, &point_}}), 6031, {"set 0 binding 1"}));
}

TEST_F(DrawMistakes, a_binding_that_the_pipeline_has_not) {
    EXPECT_TRUE(fails(drawCopy({{0, 1, &other_}, {0, 2, &point_}, {1, 7, &other_}}), 6032, {"set 1 binding 7"}));
}

TEST_F(DrawMistakes, a_resource_of_the_wrong_kind) {
    EXPECT_TRUE(fails(drawCopy({{0, 1, &point_}, {0, 2, &point_}}), 6033, {"set 0 binding 1", "texture", "sampler"}));
}

TEST_F(DrawMistakes, uniform_data_of_no_size_or_too_much) {
    const Targets targets{.colors = {&image_}};
    EXPECT_TRUE(fails(drawOnce(targets, screenDraw(color_, {{0, 0, std::span<const std::byte>()}})), 6030, {"set 0 binding 0"}));
    const std::vector<std::byte> huge(std::size_t{1} << 31);
    EXPECT_TRUE(fails(drawOnce(targets, screenDraw(color_, {{0, 0, std::span(huge)}})), 6038, {"set 0 binding 0", "2147483648"}));
}

TEST_F(DrawMistakes, targets_that_do_not_fit_the_pipeline) {
    EXPECT_TRUE(fails(drawUniform({}), 6035, {"1", "0"}));
    EXPECT_TRUE(fails(drawUniform({.colors = {&image_, &other_}}), 6035, {"1", "2"}));
    EXPECT_TRUE(fails(drawUniform({.colors = {&image_}, .depth = &depth_}), 6035, {"depth"}));
    EXPECT_TRUE(fails(drawUniform({.colors = {nullptr}}), 6035, {"colour target 0"}));
    Texture bytes = target(Format::RGBA8, 4, 4);
    EXPECT_TRUE(fails(drawUniform({.colors = {&bytes}}), 6035, {"RGBA8", "RGBA32F"}));
}

TEST_F(DrawMistakes, a_target_that_was_not_made_as_one) {
    Texture plain = texture(4, 4, std::vector<Pixel>(16));
    EXPECT_TRUE(fails(drawUniform({.colors = {&plain}}), 6037, {"image"}));
}

TEST_F(DrawMistakes, geometry_that_is_missing_or_too_short) {
    PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
    desc.attributes = {{.location = 0, .components = 4, .offset = 0}};
    desc.vertexStride = 16;
    const Pipeline pipeline = must(device().createPipeline(desc));
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(std::vector<Pixel>(3))));
    const Buffer indices = must(device().createBuffer(BufferUsage::Index, bytesOf(std::vector<std::uint32_t>(6))));
    const auto draw = [&](const Buffer* stream, const Buffer* index, std::uint32_t first, std::uint32_t count) {
        return drawOnce({.colors = {&image_}}, {.pipeline = &pipeline,
                                                .resources = {{0, 0, bytesOf(white_)}},
                                                .vertices = stream,
                                                .indices = index,
                                                .first = first,
                                                .count = count});
    };
    EXPECT_TRUE(fails(draw(nullptr, nullptr, 0, 3), 6039, {"screen"}));
    EXPECT_TRUE(fails(draw(&vertices, nullptr, 0, 4), 6039, {"4", "3"}));
    EXPECT_TRUE(fails(draw(&vertices, nullptr, 0xffffffff, 2), 6039, {"4294967297"}));
    EXPECT_TRUE(fails(draw(&vertices, &indices, 4, 3), 6039, {"7", "6"}));
    EXPECT_TRUE(fails(draw(&indices, nullptr, 0, 3), 6039, {"vertex buffer"}));
    EXPECT_TRUE(fails(draw(&vertices, &vertices, 0, 3), 6039, {"index buffer"}));
    EXPECT_EQ(codeOf(draw(&vertices, &indices, 3, 3)), 0);

    const std::vector<Pixel> stream(3);
    const std::vector<std::uint32_t> order(6);
    Draw once{.pipeline = &pipeline, .resources = {{0, 0, bytesOf(white_)}}, .vertexBytes = bytesOf(stream), .count = 4};
    EXPECT_TRUE(fails(drawOnce({.colors = {&image_}}, once), 6039, {"4 vertices", "3"}));
    once.indexBytes = bytesOf(order);
    EXPECT_EQ(codeOf(drawOnce({.colors = {&image_}}, once)), 0);
    once.count = 7;
    EXPECT_TRUE(fails(drawOnce({.colors = {&image_}}, once), 6039, {"7 indices", "6"}));
    once.count = 6;
    once.indices = &indices;
    EXPECT_TRUE(fails(drawOnce({.colors = {&image_}}, once), 6039, {"bytes of indices"}));
    once.indices = nullptr;
    once.vertices = &vertices;
    EXPECT_TRUE(fails(drawOnce({.colors = {&image_}}, once), 6039, {"bytes of vertices"}));
}

TEST_F(DrawMistakes, indices_beyond_the_vertices_end_nothing) {
    PipelineDesc desc = screen(uniform_frag, {{0, 0}}, {Format::RGBA32F});
    desc.attributes = {{.location = 0, .components = 4, .offset = 0}};
    desc.vertexStride = 16;
    const Pipeline pipeline = must(device().createPipeline(desc));
    const Buffer vertices = must(device().createBuffer(BufferUsage::Vertex, bytesOf(std::vector<Pixel>(3))));
    const Buffer indices = must(device().createBuffer(BufferUsage::Index, bytesOf(std::vector<std::uint32_t>(3, 1'000'000'000))));
    EXPECT_EQ(codeOf(drawOnce(
                  {.colors = {&image_}},
                  {.pipeline = &pipeline, .resources = {{0, 0, bytesOf(white_)}}, .vertices = &vertices, .indices = &indices, .count = 3})),
              0);
}

TEST_F(DrawMistakes, more_work_groups_than_the_device_allows) {
    const Pipeline pipeline = must(device().createPipeline(ComputePipelineDesc{
        .name = "prefix",
        .shader = {.spirv = prefix_comp, .entry = "main"},
        .bindings = {{0, 0, BindingKind::UniformBuffer}, {0, 1, BindingKind::StorageBuffer}, {0, 2, BindingKind::StorageBuffer}}}));
    const auto dispatched = device().run([&](Recorder& recorder) { return recorder.dispatch(pipeline, {}, {1, 0xffffffff, 1}); });
    EXPECT_TRUE(fails(dispatched, 6041, {"prefix", "4294967295"}));
}

} // namespace
} // namespace tegument::gpu
