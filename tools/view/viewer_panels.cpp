// What the viewer's panels and title say of the frame.

#include "tools/view/viewer.h"

#include "host/run/pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace tegument::view {

namespace {

constexpr std::chrono::milliseconds kErrorsMoment(10);

std::string firstLine(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

glm::ivec2 sizeOfLevel(const gpu::Texture& texture, int level) {
    return {std::max(texture.desc().width >> level, 1U), std::max(texture.desc().height >> level, 1U)};
}

double totalMilliseconds(const SessionFrame& frame) {
    return std::accumulate(frame.passes.begin(), frame.passes.end(), 0.0,
                           [](double sum, const SessionPass& pass) { return sum + pass.milliseconds; });
}

} // namespace

/// Of the level that is shown; of a cube all faces.
Result<Image> Viewer::shownValues(const std::string& shown) {
    const gpu::Texture* target = session().target(shown);
    if (!target || !target->desc().cube) {
        const auto image = targets_.image(device_, session(), shown, state_.level);
        return image ? Result<Image>(**image) : image.error();
    }
    const auto flat = shownTexture();
    if (!flat) return flat.error();
    return run::readBack(device_, **flat, std::min(static_cast<std::uint32_t>(state_.level), (*flat)->desc().mips - 1));
}

std::optional<Histogram> Viewer::histogram(const std::string& shown) {
    const std::string what = fmt::format("{} {} {}", frames_, shown, state_.level);
    if (!histogramMaking_.valid() && what != histogramOf_) {
        auto image = shownValues(shown);
        if (!image) return std::nullopt;
        histogramOf_ = what;
        histogramMaking_ = std::async(std::launch::async, [values = *std::move(image)] { return histogramOf(values); });
    }
    if (histogramMaking_.valid() && histogramMaking_.wait_for(kErrorsMoment) == std::future_status::ready)
        histogram_ = histogramMaking_.get();
    if (histogramMaking_.valid() || what != histogramOf_) settling_ = kSettlingFrames; // there will be a newer one
    return histogram_ ? histogram_ : Histogram{};
}

Result<PanelPictures> Viewer::panelPictures() {
    PanelPictures pictures;
    const std::string shown = shownTarget(state_, frame_);
    if (state_.probe) pictures.histogram = histogram(shown);
    if (state_.times) {
        const bool both = beside_ && beside_->loaded && beside_->drawn;
        if (both) pictures.times.push_back({.name = beside_->name, .times = &beside_->times});
        pictures.times.push_back({.name = both ? sideName() : std::string(), .times = &times_});
    }
    if (state_.mesh != MeshShow::None) describeMesh(pictures);
    if (state_.textures) pictures.textures = frame_.textures;
    if (!state_.strip) return pictures;
    pictures.arrows = arrowsOf(frame_);
    targets_.begin();
    for (const std::string& name : inOrderOfFlow(frame_)) {
        const gpu::Texture* target = session().target(name);
        if (!target) continue; // of a part of the frame
        auto small = targets_.thumbnail(device_, *canvas_, session(), name, !loaded_->effect.displayColours);
        if (!small) return small.error();
        pictures.thumbnails.push_back(
            {.name = name,
             .label = fmt::format("{} x {}", target->desc().width, target->desc().height),
             .texture = *small,
             .shown = state_.show == Show::Target ? name == state_.target : state_.show == Show::Picture && name.empty()});
    }
    if (targets_.waits()) settling_ = kSettlingFrames;
    return pictures;
}

std::optional<ProbedTexel> Viewer::probe(EffectSession& from, const std::string& name, int level, glm::dvec2 place) {
    gpu::Texture* texture = from.target(name);
    if (!texture) return std::nullopt;
    if (texture->desc().cube && &from == &session() && name == shownTarget(state_, frame_))
        if (const auto flat = shownTexture()) texture = *flat;
    level = std::min(level, static_cast<int>(texture->desc().mips) - 1); // a kept side may have fewer
    const glm::ivec2 at = texelAt(place, sizeOfLevel(*texture, level));
    const auto texel = run::readBackPart(*texture, {.x = static_cast<std::uint32_t>(at.x), .y = static_cast<std::uint32_t>(at.y)},
                                         static_cast<std::uint32_t>(level));
    if (!texel) return std::nullopt;
    return ProbedTexel{.name = name, .level = level, .at = at, .values = texel->pixels};
}

/// Nothing while the cursor is beside the picture.
std::vector<std::string> Viewer::probed() {
    const std::string shown = shownTarget(state_, frame_);
    const auto found = shownTexture();
    const gpu::Texture* texture = found ? *found : nullptr;
    if (!texture) return {};
    const glm::ivec2 size(texture->desc().width, texture->desc().height);
    const auto place = placeOnPicture(placeSeenAt(state_, area_.onPicture(cursor_)), size, glm::ivec2(size_.width, size_.height));
    if (!place) return {};
    std::vector<ProbedTexel> texels;
    std::vector<std::string> names = state_.targets;
    if (std::ranges::find(names, shown) == names.end() && !shown.empty()) names.push_back(shown); // a texture
    names.emplace_back();
    for (const std::string& name : names)
        if (auto texel = probe(session(), name, name == shown ? state_.level : 0, *place)) texels.push_back(std::move(*texel));
    std::vector<std::string> lines = probeLines(texels, shown, *place);
    const std::vector<std::string> more = probedBeside(shown, *place);
    lines.insert(lines.end(), more.begin(), more.end());
    return lines;
}

PanelText Viewer::panelText() {
    PanelText text{.status = {}, .lines = {}, .values = {}, .problem = problem_, .beside = {}};
    text.lines.push_back(
        fmt::format("{}  technique {}  setting {}", request_.effect.filename().string(), state_.technique, state_.setting));
    const auto kept = std::ranges::count_if(frame_.passes, &SessionPass::kept);
    text.lines.push_back(fmt::format("{} passes{} {:.2f} ms, frame {:.1f} ms", frame_.passes.size(),
                                     kept > 0 ? fmt::format(", {} kept,", kept) : std::string(), totalMilliseconds(frame_), milliseconds_));
    text.lines.push_back(device_.info().name);
    if (state_.probe) text.values = probed();
    text.beside = besideText();
    text.status = statusText();
    return text;
}

/// The newest first: a narrow window cuts the end.
std::string Viewer::statusText() const {
    std::string text;
    const auto add = [&](const std::string& part) { text += part.empty() ? "" : (text.empty() ? "" : "   ") + part; };
    add(notice_);
    if (making_) add("being made: " + makingText());
    if (meshesMaking_.valid()) add("being made: the mesh in false colours");
    add(shownText(state_, frame_));
    if (!state_.preset.empty()) add("preset " + state_.preset);
    constexpr std::array kChannels = {"", "red", "green", "blue", "alpha"};
    if (state_.channel != 0) add(fmt::format("channel {}", kChannels.at(static_cast<std::size_t>(state_.channel))));
    if (state_.levels > 1 && state_.show != Show::Picture) add(fmt::format("mip level {} of 0 to {}", state_.level, state_.levels - 1));
    if (state_.stops != 0) add(fmt::format("{:+.1f} stops", state_.stops));
    if (state_.zoom != 1) add(fmt::format("{:.0f} times as large", state_.zoom));
    if (isDraft()) add(draftText(sharpness_, drawnPixels().width, drawnPixels().height));
    add(fmt::format("{} x {}", size_.width, size_.height));
    if (const auto found = frame_.metadata.find("attribution"); found != frame_.metadata.end()) add(found->second);
    return text;
}

std::string Viewer::titleText() const {
    if (!problem_.empty()) return firstLine(problem_);
    return fmt::format("{} {} [{}] {}, {:.1f} ms - tegument{}", request_.effect.filename().string(), state_.technique, state_.setting,
                       shownText(state_, frame_), milliseconds_, making_ ? ", making " + making_->what : std::string());
}

} // namespace tegument::view
