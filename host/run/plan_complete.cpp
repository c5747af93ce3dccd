// The second half of planning: what the compiled shaders use decides attachments, first clears and mip chains.

#include "host/run/plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::run {

namespace {

struct Completion {
    const std::map<const Pass*, PassUse>& uses;
    const std::map<std::string, TargetShape>& shapes;
    const std::array<float, 4>& background;
    std::vector<Diagnostic>& warnings;
    AddedTargets* added; // null: the effect must do without
};

bool writesColor(const Pass& pass, const PassUse& use, std::size_t slot) {
    return (use.writtenColors >> slot & 1U) != 0 && pass.state.targets[slot].writeMask != 0;
}

/// Whether nothing of what the slot's target held remains.
bool overwrites(const DrawStep& draw, const PassUse& use, std::size_t slot) {
    const Pass& pass = *draw.pass;
    const auto covers = pass.annotations.numbers("CoversTarget");
    const TargetBlend& target = pass.state.targets[slot];
    return draw.kind == DrawKind::Buffer && covers && covers->front() != 0 && !usesDepth(pass.state) && !use.discards &&
           (use.writtenColors >> slot & 1U) != 0 && target.writeMask == 15 && !target.enable && !pass.state.alphaToCoverage &&
           !pass.state.scissorTest;
}

bool coversStored(const Pass& pass) {
    const auto covers = pass.annotations.numbers("CoversTarget");
    return covers && covers->front() != 0;
}

bool fit(const TargetShape& a, const TargetShape& b) {
    return a.width == b.width && a.height == b.height && a.samples == b.samples;
}

/// In Direct3D 9 and Vulkan a depth target may be larger than the colours, which use its upper left part; from Direct3D 10 on it may not.
bool depthFits(const TargetShape& depth, const TargetShape& size, bool larger) {
    return fit(depth, size) || (larger && depth.width >= size.width && depth.height >= size.height && depth.samples == size.samples);
}

/// The target whose size the pass draws at: the first colour it writes, else its depth, else whatever is bound.
const std::string* leadingTarget(const DrawStep& draw, const PassUse& use) {
    for (std::size_t slot = 0; slot < draw.colors.size(); ++slot)
        if (draw.colors[slot] && writesColor(*draw.pass, use, slot)) return &*draw.colors[slot];
    if (draw.depth && usesDepth(draw.pass->state)) return &*draw.depth;
    for (const auto& color : draw.colors)
        if (color) return &*color;
    return draw.depth ? &*draw.depth : nullptr;
}

Error doNotFit(const Pass& pass, const std::string& a, const TargetShape& sizeA, const std::string& b, const TargetShape& sizeB) {
    if (sizeA.samples != sizeB.samples)
        return inputError(4039, pass.at,
                          fmt::format("pass {} has targets of different samples a pixel: {} has {}, {} has {}", pass.name, a, sizeA.samples,
                                      b, sizeB.samples),
                          "draw with one sample a pixel, or bind a depth target of the effect's own beside its colour target");
    return inputError(4025, pass.at,
                      fmt::format("pass {} has targets of different sizes: {} is {} x {}, {} is {} x {}", pass.name, a, sizeA.width,
                                  sizeA.height, b, sizeB.width, sizeB.height),
                      "bind targets of one size, or switch the depth test off if the pass needs no depth");
}

/// Drops the depth target of a pass that tests nothing, and colour targets that do not fit and cannot change; what is left has one size and
/// one number of samples.
Result<void> fitAttachments(DrawStep& draw, const Completion& with) {
    const PassUse& use = with.uses.at(draw.pass);
    const std::string* leading = leadingTarget(draw, use);
    if (!leading) return inputError(4027, draw.pass->at, fmt::format("pass {} draws with no target bound", draw.pass->name));
    const std::string name = *leading;
    const TargetShape& size = with.shapes.at(name);
    for (std::size_t slot = 0; slot < draw.colors.size(); ++slot) {
        auto& color = draw.colors[slot];
        if (!color || fit(with.shapes.at(*color), size)) continue;
        if (writesColor(*draw.pass, use, slot)) return doNotFit(*draw.pass, name, size, *color, with.shapes.at(*color));
        color.reset();
    }
    while (!draw.colors.empty() && !draw.colors.back())
        draw.colors.pop_back();
    for (const auto& color : draw.colors)
        if (!color)
            return inputError(4028, draw.pass->at, fmt::format("pass {} leaves a gap between its colour targets", draw.pass->name),
                              "bind them from 0 upwards");
    if (!usesDepth(draw.pass->state)) draw.depth.reset();
    if (!draw.depth || depthFits(with.shapes.at(*draw.depth), size, with.added != nullptr)) return {};
    if (with.added && *draw.depth == kPictureDepth) {
        draw.depth = fmt::format("<depth of {}>", name);
        with.added->depths.emplace(*draw.depth, name);
        return {};
    }
    return doNotFit(*draw.pass, name, size, *draw.depth, with.shapes.at(*draw.depth));
}

/// What a pass writes it binds once. What it samples too is sampled from a copy, where that is allowed.
Result<void> avoidFeedback(DrawStep& draw, const PassUse& use, const Completion& with, std::vector<Step>& steps) {
    std::vector<std::optional<std::string>> bound = draw.colors;
    bound.push_back(draw.depth);
    bound.insert(bound.end(), use.stored.begin(), use.stored.end());
    for (auto at = bound.begin(); at != bound.end(); ++at) {
        const auto& name = *at;
        if (name && std::find(at + 1, bound.end(), name) != bound.end())
            return inputError(4024, draw.pass->at, fmt::format("pass {} has {} as two of its targets", draw.pass->name, *name),
                              "bind another one in one of the places");
        if (!name || !use.sampled.contains(*name)) continue;
        const std::string text = fmt::format("pass {} samples {} while drawing into it", draw.pass->name, *name);
        if (!with.added || draw.kind == DrawKind::Compute)
            return inputError(4024, draw.pass->at, text, "draw into a second target and swap the two");
        const std::string copy = fmt::format("<copy of {}>", *name);
        if (with.added->copies.emplace(copy, *name).second)
            with.warnings.push_back(
                inputWarning(4024, draw.pass->at, text + ": it reads a copy of what was there before",
                             "what a device of Direct3D does then is not defined; draw into a second target and swap the two"));
        draw.copies.emplace(*name, copy);
        steps.emplace_back(CopyStep{.from = *name, .to = copy});
    }
    return {};
}

/// Follows the frame: what has been written, which mip chains are stale, what must be cleared before the first step.
class Tracker {
public:
    explicit Tracker(const Completion& with) : with_(with) {}

    /// Depth targets are cleared at first sight whatever the script clears: it may clear the depth and leave the stencil.
    void clear(const ClearStep& step) {
        if (step.what != ClearKind::Color && !known_.contains(step.target)) addClear(step.target, true);
        touch(step.target);
    }

    void draw(const DrawStep& step, std::vector<Step>& steps) {
        for (const std::string& name : with_.uses.at(step.pass).sampled)
            if (with_.shapes.contains(name)) sample(name, step, steps);
        for (std::size_t slot = 0; slot < step.colors.size(); ++slot) {
            if (!step.colors[slot]) continue;
            if (overwrites(step, with_.uses.at(step.pass), slot) && with_.shapes.at(*step.colors[slot]).mips == 1)
                touch(*step.colors[slot]);
            else
                use(*step.colors[slot], false);
        }
        if (step.depth) use(*step.depth, true);
        for (const std::string& name : with_.uses.at(step.pass).stored) {
            if (coversStored(*step.pass) && with_.shapes.at(name).mips == 1)
                touch(name);
            else
                use(name, false);
        }
    }

    [[nodiscard]] std::vector<Step> firstClears() const { return clears_; }

private:
    void touch(const std::string& name) {
        known_.insert(name);
        stale_.insert(name);
    }

    void use(const std::string& name, bool depth) {
        if (!known_.contains(name)) addClear(name, depth);
        touch(name);
    }

    void addClear(const std::string& name, bool depth) {
        ClearStep step{.target = name, .what = depth ? ClearKind::Depth : ClearKind::Color};
        if (name == kPicture) step.color = with_.background;
        clears_.emplace_back(step);
        if (depth) clears_.emplace_back(ClearStep{.target = name, .what = ClearKind::Stencil});
        touch(name);
    }

    void sample(const std::string& name, const DrawStep& step, std::vector<Step>& steps) {
        if (!known_.contains(name) && !with_.shapes.at(name).keeps) {
            with_.warnings.push_back(
                inputWarning(4026, step.pass->at,
                             fmt::format("pass {} samples {} before anything was drawn into it: it reads zeros", step.pass->name, name),
                             "clear the target in the script, or draw into it first"));
            addClear(name, with_.shapes.at(name).depth);
        }
        if (with_.shapes.at(name).mips != 1 && stale_.erase(name) > 0) steps.emplace_back(MipStep{name});
    }

    const Completion& with_;
    std::set<std::string> known_;
    std::set<std::string> stale_;
    std::vector<Step> clears_;
};

} // namespace

bool usesDepth(const PipelineState& state) {
    return state.depthTest || state.stencilTest;
}

Result<void> completePlan(Plan& plan, const std::map<const Pass*, PassUse>& uses, const std::map<std::string, TargetShape>& shapes,
                          const std::array<float, 4>& background, std::vector<Diagnostic>& warnings, AddedTargets* added) {
    const Completion with{uses, shapes, background, warnings, added};
    Tracker tracker(with);
    std::vector<Step> steps;
    for (Step& step : plan.steps) {
        if (auto* draw = std::get_if<DrawStep>(&step)) {
            if (draw->kind != DrawKind::Compute)
                if (const auto fitted = fitAttachments(*draw, with); !fitted) return fitted;
            std::vector<Step> copies;
            if (const auto checked = avoidFeedback(*draw, uses.at(draw->pass), with, copies); !checked) return checked;
            tracker.draw(*draw, steps);
            steps.insert(steps.end(), std::make_move_iterator(copies.begin()), std::make_move_iterator(copies.end()));
        }
        if (const auto* clear = std::get_if<ClearStep>(&step)) tracker.clear(*clear);
        steps.push_back(std::move(step));
    }
    std::vector<Step> first = tracker.firstClears();
    first.insert(first.end(), std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
    plan.steps = std::move(first);
    return {};
}

} // namespace tegument::run
