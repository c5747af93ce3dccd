#include "host/run/plan.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::run {

namespace {

std::string colorName(const std::string& name) {
    return name.empty() ? kPicture : name;
}

std::string depthName(const std::string& name) {
    return name.empty() ? kPictureDepth : name;
}

std::vector<std::optional<std::string>> colorNames(const BoundTargets& targets) {
    std::vector<std::optional<std::string>> names;
    for (const auto& color : targets.colors)
        names.push_back(color ? std::optional(colorName(*color)) : std::nullopt);
    while (!names.empty() && !names.back())
        names.pop_back();
    return names;
}

/// Writes down what the scripts do.
class Planner final : public ScriptSink {
public:
    Planner(const Effect& effect, Values values, const std::array<float, 4>& background)
        : effect_(effect), values_(std::move(values)), background_(background) {}

    Result<void> targetsChanged(const BoundTargets&) override { return {}; }

    Result<void> clear(ClearKind what, int index, const ScriptState& state) override {
        ClearStep step{.what = what};
        if (what == ClearKind::Color) {
            const auto& bound = state.targets.colors[static_cast<std::size_t>(index)];
            if (!bound) return {};
            step.target = colorName(*bound);
        } else {
            if (!state.targets.depth) return {};
            step.target = depthName(*state.targets.depth);
        }
        if (const auto read = readClearValue(step, state.clear); !read) return read;
        plan_.steps.emplace_back(std::move(step));
        return {};
    }

    Result<void> beginPass(const Technique& technique, const Pass&) override {
        technique_ = &technique;
        if (!plan_.technique) plan_.technique = &technique;
        return {};
    }

    Result<void> draw(const Pass& pass, DrawKind kind, const ScriptState& state) override {
        const bool computes = kind == DrawKind::Compute;
        DrawStep step{.technique = technique_,
                      .pass = &pass,
                      .kind = kind,
                      .colors = computes ? std::vector<std::optional<std::string>>() : colorNames(state.targets),
                      .depth = {},
                      .written = written_};
        if (state.targets.depth && !computes) step.depth = depthName(*state.targets.depth);
        plan_.steps.emplace_back(std::move(step));
        return failure_ ? Result<void>(*failure_) : Result<void>();
    }

    Result<void> endPass(const Pass&) override { return {}; }

    Result<void> external(const ScriptState& state) override {
        if (const Technique* scene = effect_.findTechnique(kSceneTechnique)) return drawScene(*scene, state);
        for (const auto& name : colorNames(state.targets))
            if (name) plan_.steps.emplace_back(ClearStep{.target = *name, .what = ClearKind::Color, .color = background_});
        if (state.targets.depth) plan_.steps.emplace_back(ClearStep{.target = depthName(*state.targets.depth), .what = ClearKind::Depth});
        return {};
    }

    [[nodiscard]] std::vector<double> read(const Parameter& parameter) const override {
        read_.insert(parameter.name);
        auto value = values_.require(parameter);
        if (value) return std::move(*value);
        if (!failure_) failure_ = value.error();
        return std::vector<double>(static_cast<std::size_t>(parameter.type.scalarCount()), 0.0);
    }

    void write(const Parameter& parameter, double value) override {
        written_[parameter.name] = value;
        values_.write(parameter.name, {value});
    }

    Result<Plan> finish() {
        if (failure_) return *failure_;
        plan_.read = std::move(read_);
        return std::move(plan_);
    }

private:
    /// Into what the script has cleared.
    Result<void> drawScene(const Technique& scene, const ScriptState& state) {
        DrawStep step{
            .technique = &scene, .pass = &scene.passes.front(), .kind = DrawKind::Geometry, .colors = {}, .depth = {}, .written = written_};
        step.colors = colorNames(state.targets);
        if (step.colors.size() > 1) step.colors.resize(1);
        if (state.targets.depth) step.depth = depthName(*state.targets.depth);
        plan_.steps.emplace_back(std::move(step));
        return {};
    }

    Result<Numbers> valueOf(const std::string& name) const {
        const Parameter* parameter = effect_.findParameter(name);
        if (!parameter) return Numbers{}; // the effect's own check reported it
        read_.insert(name);
        return values_.require(*parameter);
    }

    Result<void> readClearValue(ClearStep& step, const ClearParameters& names) const {
        const std::string& name = step.what == ClearKind::Color ? names.color : step.what == ClearKind::Depth ? names.depth : names.stencil;
        if (name.empty()) return {};
        const auto value = valueOf(name);
        if (!value) return value.error();
        if (value->empty()) return {};
        if (step.what == ClearKind::Depth) step.depth = static_cast<float>(value->front());
        if (step.what == ClearKind::Stencil) step.stencil = static_cast<std::uint32_t>(std::clamp(value->front(), 0.0, 255.0));
        if (step.what == ClearKind::Color)
            for (std::size_t i = 0; i < 4; ++i)
                step.color[i] = i < value->size() ? static_cast<float>((*value)[i]) : i == 3 ? 1.0F : 0.0F;
        return {};
    }

    const Effect& effect_;
    Values values_;
    std::array<float, 4> background_;
    Plan plan_;
    const Technique* technique_ = nullptr;
    std::map<std::string, double> written_;
    mutable std::set<std::string> read_;
    mutable std::optional<Error> failure_; // `read` cannot hand an error on
};

} // namespace

std::set<std::string> Plan::targets() const {
    std::set<std::string> names;
    for (const Step& step : steps) {
        if (const auto* clear = std::get_if<ClearStep>(&step)) names.insert(clear->target);
        if (const auto* copy = std::get_if<CopyStep>(&step)) names.insert(copy->to);
        const auto* draw = std::get_if<DrawStep>(&step);
        if (!draw) continue;
        for (const auto& color : draw->colors)
            if (color) names.insert(*color);
        if (draw->depth) names.insert(*draw->depth);
    }
    return names;
}

std::set<const Pass*> Plan::passes() const {
    std::set<const Pass*> result;
    for (const Step& step : steps)
        if (const auto* draw = std::get_if<DrawStep>(&step)) result.insert(draw->pass);
    return result;
}

Result<Plan> planFrame(const Effect& effect, const std::string& technique, const Values& values, const std::array<float, 4>& background) {
    if (effect.techniques.empty())
        return inputError(4001, {.file = effect.file.string()}, "this effect has no technique to run",
                          effect.ownDialect ? "techniques stand inside #ifdef FX_TECHNIQUES"
                                            : "functions alone need one to be drawn: technique T { pass P { VertexShader = compile vs_3_0 "
                                              "V(); PixelShader = compile ps_3_0 P(); } }");
    Planner planner(effect, values, background);
    if (const auto run = runScripts(effect, technique, planner); !run) return run.error();
    auto plan = planner.finish();
    if (plan && !plan->technique) plan->technique = technique.empty() ? effect.defaultTechnique() : effect.findTechnique(technique);
    return plan;
}

} // namespace tegument::run
