#include "host/run/session.h"

#include "host/run/ahead.h"
#include "host/run/describe.h"
#include "host/run/pieces.h"
#include "host/run/stage.h"
#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument {

namespace {

using Sections = std::vector<gpu::TimedSection>;

/// Items in front of the draw behind the first `draws` of them.
std::size_t itemsUpTo(const run::Frame& frame, std::size_t draws) {
    std::size_t seen = 0;
    for (std::size_t i = 0; i < frame.items.size(); ++i) {
        if (!std::holds_alternative<run::FrameDraw>(frame.items[i])) continue;
        if (seen == draws) return i;
        ++seen;
    }
    return frame.items.size();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

/// Section by section, over frames that have the same ones.
std::vector<double> medians(const std::vector<Sections>& frames) {
    std::vector<double> result;
    for (std::size_t i = 0; i < frames.front().size(); ++i) {
        std::vector<double> times;
        for (const Sections& sections : frames)
            times.push_back(sections[i].milliseconds);
        result.push_back(median(std::move(times)));
    }
    return result;
}

/// Takes the clears out: all in one number, at the end of the sections.
Sections clearsLast(const Sections& sections) {
    Sections result;
    gpu::TimedSection clears{.name = run::kClears, .milliseconds = 0};
    for (const gpu::TimedSection& section : sections) {
        if (section.name == run::kClears)
            clears.milliseconds += section.milliseconds;
        else
            result.push_back(section);
    }
    result.push_back(std::move(clears));
    return result;
}

/// Of the frame's items those that draw, in order.
void noteKept(const run::Frame& staged, SessionFrame& frame) {
    std::size_t pass = 0;
    for (std::size_t i = 0; i < staged.items.size(); ++i)
        if (std::holds_alternative<run::FrameDraw>(staged.items[i])) frame.passes[pass++].kept = !staged.kept.empty() && staged.kept[i];
}

/// The sections are those of the passes that were drawn, and of the resolve; then the clears.
void readTimes(std::vector<double> times, const run::Frame& staged, SessionFrame& frame) {
    frame.clearMilliseconds = times.back();
    times.pop_back();
    if (staged.resolve) frame.resolveMilliseconds = 0;
    if (staged.resolve && !staged.resolveKept) {
        frame.resolveMilliseconds = times.back();
        times.pop_back();
    }
    noteKept(staged, frame);
    std::size_t pass = 0;
    for (const double time : times) {
        while (frame.passes[pass].kept)
            ++pass;
        frame.passes[pass++].milliseconds = time;
    }
}

void noteTextures(const run::Stage& stage, SessionFrame& frame) {
    for (const auto& [name, sampled] : stage.sampled()) {
        const gpu::TextureDesc& desc = sampled.texture->desc();
        frame.textures.push_back({.name = name,
                                  .source = sampled.origin,
                                  .width = static_cast<int>(desc.width),
                                  .height = static_cast<int>(desc.height),
                                  .format = std::string(gpu::name(desc.format)),
                                  .cube = desc.cube,
                                  .bake = stage.bakeOf(name)});
    }
}

constexpr int kMixedSamples = 4039;

bool needsOneSample(const Error& error, const RunOptions& options) {
    return !options.samplesAreAsked && options.samples > 1 && error.diagnostics.front().code == kMixedSamples;
}

} // namespace

struct EffectSession::State {
    gpu::Device& device;
    const Effect& effect;
    run::Stage stage;
    std::vector<Diagnostic> warnings{}; // that the next frame has, too
};

EffectSession::EffectSession(gpu::Device& device, const Effect& effect, SessionScene scene, const EffectSession* before)
    : state_(new State{.device = device, .effect = effect, .stage = {device, effect, scene, before ? &before->state_->stage : nullptr}}) {}
void EffectSession::take(run::Ahead ahead) {
    state_->warnings.insert(state_->warnings.end(), ahead.warnings.begin(), ahead.warnings.end());
    state_->stage.take(std::move(ahead));
}

run::Known EffectSession::known() const {
    return state_->stage.known();
}

void EffectSession::learn(const EffectSession& other) {
    state_->stage.learn(other.state_->stage);
}

EffectSession::EffectSession(EffectSession&&) noexcept = default;
EffectSession& EffectSession::operator=(EffectSession&&) noexcept = default;
EffectSession::~EffectSession() = default;

Result<SessionFrame> EffectSession::draw(const Workspace& workspace, const RunOptions& options, std::size_t passes) {
    auto staged = state_->stage.prepare(workspace, options);
    if (!staged && needsOneSample(staged.error(), options)) {
        RunOptions single = options;
        single.samples = 1;
        return draw(workspace, single, passes);
    }
    if (!staged && run::isGivenUp(staged.error())) {
        SessionFrame nothing;
        nothing.givenUp = true;
        return nothing;
    }
    if (!staged) return staged.error();
    SessionFrame frame = run::describe(staged->runs, staged->frame, state_->device.info());
    if (const auto named = targetsToDump(state_->effect, frame, options.dump); !named) return named.error();
    const std::size_t items = itemsUpTo(staged->frame, passes);
    std::vector<Sections> timed;
    const int measured = std::max(1, options.frames);
    for (int i = 0; i < options.warmUpFrames + measured; ++i) {
        auto sections = state_->stage.draw(*staged, items);
        if (!sections) return sections.error();
        if (staged->givenUp) {
            frame.givenUp = true;
            return frame;
        }
        if (i >= options.warmUpFrames) timed.push_back(clearsLast(*sections));
    }
    readTimes(medians(timed), staged->frame, frame);
    noteTextures(state_->stage, frame);
    frame.warnings.insert(frame.warnings.end(), state_->warnings.begin(), state_->warnings.end());
    state_->warnings.clear();
    return frame;
}

void EffectSession::bakeAgain(const std::string& name) {
    state_->stage.bakeAgain(name);
}

gpu::Texture* EffectSession::target(const std::string& name) {
    run::Resources& resources = state_->stage.resources();
    if (name.empty()) return resources.picture();
    if (const auto found = resources.targets.find(name); found != resources.targets.end()) return &found->second;
    const auto sampled = state_->stage.sampled().find(name);
    return sampled == state_->stage.sampled().end() ? nullptr : sampled->second.texture;
}

const std::map<std::string, gpu::Texture>& EffectSession::targets() const {
    return state_->stage.resources().targets;
}

Result<std::vector<std::string>> targetsToDump(const Effect& effect, const SessionFrame& frame, const std::vector<std::string>& asked) {
    std::set<std::string> names;
    for (const std::string& name : asked) {
        if (equalsIgnoreCase(name, "all")) {
            names.insert(frame.targets.begin(), frame.targets.end());
            continue;
        }
        if (std::ranges::find(frame.targets, name) == frame.targets.end())
            return inputError(4029, {.file = effect.file.string()}, fmt::format("technique {} uses no target '{}'", frame.technique, name),
                              didYouMean(name, frame.targets));
        names.insert(name);
    }
    return std::vector<std::string>(names.begin(), names.end());
}

} // namespace tegument
