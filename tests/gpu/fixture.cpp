#include "tests/gpu/fixture.h"

#include "shaders/copy_frag.h"
#include "shaders/screen_vert.h"
#include "shaders/uniform_frag.h"

namespace tegument::gpu {

void Gpu::SetUp() {
    auto made = Device::create({.validation = true});
    const int code = codeOf(made);
    if (code == 6001 || code == 6002 || code == 6003) GTEST_SKIP() << format(made.error());
    device_.emplace(must(std::move(made)));
}

void Gpu::TearDown() {
    if (!device_ || messagesExpected) return;
    for (const std::string& message : device_->validationMessages())
        ADD_FAILURE() << message;
}

Texture Gpu::target(Format format, std::uint32_t width, std::uint32_t height) {
    return must(device().createTexture({.name = "target", .format = format, .width = width, .height = height, .renderTarget = true}));
}

Texture Gpu::texture(std::uint32_t width, std::uint32_t height, const std::vector<Pixel>& pixels) {
    Texture made = must(device().createTexture({.name = "image", .format = Format::RGBA32F, .width = width, .height = height}));
    must(device().upload(made, bytesOf(pixels)));
    return made;
}

std::vector<Pixel> Gpu::pixels(Texture& texture, std::uint32_t mip) {
    return fromBytes<Pixel>(must(device().readback(texture, mip)));
}

Sampler Gpu::sampler(Filter filter, Address address) {
    return must(device().createSampler(
        {.minFilter = filter, .magFilter = filter, .mipFilter = filter, .addressU = address, .addressV = address, .addressW = address}));
}

PipelineDesc Gpu::screen(std::span<const std::uint32_t> pixelShader, std::vector<Binding> bindings, std::vector<Format> colors) {
    PipelineDesc desc{.name = "screen",
                      .vertex = {.spirv = screen_vert, .entry = "main"},
                      .pixel = {.spirv = pixelShader, .entry = "main"},
                      .bindings = std::move(bindings),
                      .colorFormats = std::move(colors)};
    desc.state.cull = CullMode::None;
    desc.state.depthTest = false;
    return desc;
}

Draw Gpu::screenDraw(const Pipeline& pipeline, std::vector<BoundResource> resources) {
    return {.pipeline = &pipeline, .resources = std::move(resources), .count = 3};
}

Result<std::vector<TimedSection>> Gpu::drawOnce(const Targets& targets, const Draw& draw) {
    return device().run([&](Recorder& recorder) { return recorder.draw(targets, draw); });
}

Pipeline Gpu::reading(std::span<const std::uint32_t> pixelShader) {
    return must(
        device().createPipeline(screen(pixelShader, {{0, 1, BindingKind::Texture}, {0, 2, BindingKind::Sampler}}, {Format::RGBA32F})));
}

void Drawing::SetUp() {
    Gpu::SetUp();
    if (IsSkipped()) return;
    image_ = target(Format::RGBA32F, 4, 4);
    other_ = target(Format::RGBA32F, 4, 4);
    depth_ = target(Format::D32F, 4, 4);
    point_ = sampler(Filter::Point, Address::Clamp);
    color_ = must(device().createPipeline(screen(uniform_frag, {{0, 0}}, {Format::RGBA32F})));
    copy_ = reading(copy_frag);
}

} // namespace tegument::gpu
