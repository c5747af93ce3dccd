// What stands to the left of the border, and how far the picture is from it.

#include "tools/view/viewer.h"

#include "host/run/pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace tegument::view {

namespace {

constexpr std::size_t kCorners = 4;
constexpr std::chrono::milliseconds kMoment(10);

Result<gpu::Texture> floatTexture(gpu::Device& device, const char* name, const Image& image) {
    auto texture = device.createTexture({.name = name,
                                         .format = gpu::Format::RGBA32F,
                                         .width = static_cast<std::uint32_t>(image.width),
                                         .height = static_cast<std::uint32_t>(image.height)});
    if (!texture) return texture;
    if (const auto uploaded = device.upload(*texture, std::as_bytes(std::span(image.pixels))); !uploaded) return uploaded.error();
    return texture;
}

std::string withoutEmpty(const std::string& technique, const std::string& setting, const std::string& preset) {
    std::string name = technique;
    for (const std::string& word : {setting, preset})
        if (!word.empty()) name += " " + word;
    return name;
}

} // namespace

std::string Viewer::sideName() const {
    return withoutEmpty(state_.technique, state_.setting, state_.preset);
}

Result<void> Viewer::keep() {
    if (beside_) {
        beside_.reset();
        notice("gave the kept picture up");
        return {};
    }
    beside_ = std::make_unique<Beside>();
    beside_->loaded = std::make_unique<Loaded>(device_, loaded_->source, request_.keeps, request_.scene, loaded_.get());
    beside_->name = sideName();
    beside_->technique = state_.technique;
    beside_->parameters = state_.parameters;
    notice("kept: " + beside_->name);
    shareDraft();
    return drawAs(sharpness_);
}

Result<void> Viewer::openBeside(const std::filesystem::path& file) {
    const auto stored = loadImage(file);
    if (!stored) return stored.error();
    constexpr int kFileBits = 16; // fewer than a float: a display's values
    auto beside = std::make_unique<Beside>();
    beside->name = file.filename().string();
    beside->display = stored->bitsPerChannel <= kFileBits && file.extension() != ".exr";
    beside->values = lightOf(*stored);
    auto texture = floatTexture(device_, "saved picture", beside->values);
    if (!texture) return texture.error();
    beside->stored = std::move(*texture);
    beside_ = std::move(beside);
    return {};
}

Result<void> Viewer::drawBeside() {
    if (!beside_) return {};
    Beside& beside = *beside_;
    beside.drawn = false;
    forgetError();
    if (state_.show == Show::Pass) return {}; // the other side has other passes
    if (beside.loaded) {
        beside.values = {};
        const auto frame = drawSide();
        if (!frame) return frame.error();
        beside.times.note(*frame);
        beside.costs = costsOf(*frame, beside.session());
        const gpu::Texture* same = beside.session().target(shownTarget(state_, frame_));
        if (!same || same->desc().cube) return {};
    }
    beside.drawn = true;
    return paintBeside();
}

Result<SessionFrame> Viewer::drawSide() {
    RunOptions options = runOptions();
    options.technique = beside_->technique;
    options.parameters = beside_->parameters;
    beside_->drafting = sharpness_.drafting && beside_->draft;
    return beside_->session().draw(area_.seen(state_.workspace, size_), options);
}

Result<void> Viewer::paintBeside() {
    if (!beside_ || !beside_->drawn) return {};
    Beside& beside = *beside_;
    if (std::exchange(beside.level, state_.level) != state_.level) {
        if (beside.loaded) beside.values = {};
        forgetError();
    }
    if (const auto made = makePicture(beside.picture, "picture beside"); !made) return made;
    gpu::Texture* texture = beside.loaded ? beside.session().target(shownTarget(state_, frame_)) : &beside.stored;
    Levels levels = shownLevels();
    if (beside.display) levels = {.channel = state_.channel, .toneMap = false, .encode = true};
    return canvas_->show(beside.picture, *texture, levels, fitOf(*texture));
}

Result<std::pair<Image, const Image*>> Viewer::sides() {
    Beside& beside = *beside_;
    const std::string shown = shownTarget(state_, frame_);
    const auto now = targets_.image(device_, session(), shown, state_.level);
    if (!now) return now.error();
    if (beside.values.pixels.empty()) {
        gpu::Texture& texture = *beside.session().target(shown);
        auto values = run::readBack(device_, texture, std::min(static_cast<std::uint32_t>(state_.level), texture.desc().mips - 1));
        if (!values) return values.error();
        beside.values = std::move(*values);
    }
    return std::pair<Image, const Image*>(beside.display ? displayLight(**now) : **now, &beside.values);
}

std::vector<std::string> Viewer::probedBeside(const std::string& shown, glm::dvec2 place) {
    if (!beside_ || !beside_->drawn) return {};
    auto here = probe(session(), shown, state_.level, place);
    const auto there =
        beside_->loaded ? probe(beside_->session(), shown, state_.level, place) : std::optional(probedTexel(shown, beside_->values, place));
    if (!here || !there) return {};
    if (beside_->display) {
        const Image texel{.width = 1, .height = 1, .channels = static_cast<int>(here->values.size()), .pixels = here->values};
        here->values = displayLight(texel).pixels;
    }
    return besideLines(*here, *there);
}

/// By another thread: of a large picture it takes longer than a window may be silent.
Result<void> Viewer::measureBeside() {
    if (!beside_ || !beside_->drawn || !beside_->error.empty()) return {};
    if (!measuring_.valid()) {
        const auto both = sides();
        if (!both) return both.error();
        measuredView_ = besideViews_;
        measuring_ = std::async(std::launch::async,
                                [now = std::move(both->first), before = *both->second] { return errorLine(compareImages(now, before)); });
    }
    if (measuring_.wait_for(kMoment) != std::future_status::ready) return {};
    std::string line = measuring_.get();
    if (measuredView_ != besideViews_) return {}; // of another picture
    beside_->error = std::move(line);
    settling_ = kSettlingFrames;
    return {};
}

/// What is known of the error is that of another picture.
void Viewer::forgetError() {
    ++besideViews_;
    beside_->error.clear();
    beside_->haveErrors = false;
}

Result<void> Viewer::findErrors() {
    Beside& beside = *beside_;
    if (beside.haveErrors) return {};
    const auto both = sides();
    if (!both) return both.error();
    const bool alike = both->first.width == both->second->width && both->first.height == both->second->height;
    if (!alike) return {}; // the line says so
    auto texture = floatTexture(device_, "errors", falseColours(both->first, *both->second));
    if (!texture) return texture.error();
    beside.errors = std::move(*texture);
    beside.haveErrors = true;
    return {};
}

Result<void> Viewer::compose() {
    const std::array<double, 4> area = area_.shares();
    const bool beside = beside_ && beside_->drawn;
    if (beside && state_.errors)
        if (const auto found = findErrors(); !found) return found;
    const bool errors = beside && state_.errors && beside_->haveErrors;
    const bool small = !errors && PixelSize{picture_.desc().width, picture_.desc().height} != size_;
    const Canvas::Fit fit{.area = area, .fill = small, .closer = errors ? closer() : Closer{}};
    if (const auto shown = canvas_->show(composed_, errors ? beside_->errors : picture_, {}, fit); !shown) return shown;
    if (!beside || errors) return {};
    const auto [left, top, right, bottom] = area;
    const auto corner = [](double x, double y, float u, float v) {
        return CanvasVertex{static_cast<float>(2 * x - 1), static_cast<float>(1 - 2 * y), u, v};
    };
    const std::array<CanvasVertex, kCorners> quad = {corner(left, top, 0, 0), corner(right, top, 1, 0), corner(right, bottom, 1, 1),
                                                     corner(left, bottom, 0, 1)};
    constexpr std::array<std::uint32_t, 6> kTriangles = {0, 1, 2, 0, 2, 3};
    const double border = (left + (right - left) * state_.border) * composed_.desc().width;
    const Canvas::Mesh mesh{.vertices = quad,
                            .indices = kTriangles,
                            .texture = &beside_->picture,
                            .clip = {0, 0, static_cast<float>(std::round(border)), static_cast<float>(composed_.desc().height)},
                            .soft = small};
    return canvas_->blend(composed_, std::span(&mesh, 1));
}

std::optional<double> Viewer::borderOfWindow() const {
    const bool stands = beside_ && beside_->drawn && !state_.errors;
    const auto [left, top, right, bottom] = area_.shares();
    return stands ? std::optional(left + (right - left) * state_.border) : std::nullopt;
}

std::optional<BesideText> Viewer::besideText() const {
    if (!beside_) return std::nullopt;
    BesideText text{.left = beside_->name, .right = sideName(), .error = beside_->error, .colours = state_.errors && beside_->haveErrors};
    if (!beside_->drawn) text.error = "nothing to compare: the kept side has no such target";
    if (text.error.empty()) text.error = "...";
    return text;
}

} // namespace tegument::view
