#include "tools/view/targets.h"

#include "host/run/pixels.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr int kRows = 64;                          // of a target, that say how bright its small picture is to be
constexpr std::chrono::milliseconds kPatience(30); // for what small pictures need, in one picture of the panels
constexpr std::uint32_t kMostShape = 8;            // times as wide as high; a window of two rows of pixels has a picture, too
constexpr std::uint32_t kHeight = 96;              // of a small picture, in texels: a little more than it is shown with

std::uint32_t widthFor(const gpu::TextureDesc& desc) {
    return std::clamp(kHeight * desc.width / std::max(1U, desc.height), 1U, kMostShape * kHeight);
}

} // namespace

void ShownTargets::forget() {
    images_.clear();
    for (auto& [name, small] : small_)
        small.drawn = false;
}

void ShownTargets::forgetAll() {
    images_.clear();
    small_.clear();
}

void ShownTargets::begin() {
    begun_ = std::chrono::steady_clock::now();
    waits_ = false;
}

Result<const Image*> ShownTargets::image(gpu::Device& device, EffectSession& session, const std::string& name, int level) {
    const auto found = images_.find({name, level});
    if (found != images_.end()) return &found->second;
    gpu::Texture* target = session.target(name);
    if (!target) return inputError(4029, {.file = name}, "the frame has no such target");
    auto image = run::readBack(device, *target, static_cast<std::uint32_t>(level));
    if (!image) return image.error();
    return &(images_[{name, level}] = std::move(*image));
}

Result<gpu::Texture*> ShownTargets::thumbnail(gpu::Device& device, Canvas& canvas, EffectSession& session, const std::string& name,
                                              bool radiance) {
    gpu::Texture& target = *session.target(name);
    Small& small = small_[name];
    const std::uint32_t width = widthFor(target.desc());
    if (!small.texture.state || small.texture.desc().width != width) {
        auto texture = device.createTexture(
            {.name = "small " + name, .format = gpu::Format::RGBA8, .width = width, .height = kHeight, .renderTarget = true});
        if (!texture) return texture.error();
        small.texture = std::move(*texture);
        small.levels = {.toneMap = radiance, .encode = radiance};
        small.known = name.empty() && !gpu::isDepth(target.desc().format);
        small.drawn = false;
    }
    if (!small.known) {
        waits_ = waits_ || std::chrono::steady_clock::now() - begun_ > kPatience;
        if (waits_) return &small.texture;
        const auto values = run::readBackRows(device, target, kRows);
        if (!values) return values.error();
        small.levels = levelsOf(*values);
        small.known = true;
        small.drawn = false;
    }
    if (!small.drawn)
        if (const auto drawn = canvas.show(small.texture, target, small.levels); !drawn) return drawn.error();
    small.drawn = true;
    return &small.texture;
}

} // namespace tegument::view
