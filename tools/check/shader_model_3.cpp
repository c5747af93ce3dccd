// What the passes of an fx_2_0 effect take of shader model 3, read from the shaders inside it: Microsoft's compiler holds few of the
// limits.

#include "tools/check/work.h"

#include "tools/direct3d/effect_binary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace tegument::check {

namespace {

/// The listings of all shaders of all effects, each compiled shader disassembled once.
class Listings {
public:
    void add(std::string_view shader) {
        if (!jobs_.emplace(shader, list_.size()).second) return;
        list_.push_back({.profile = "listing", .shader = std::string(shader)});
    }

    Result<void> run() {
        if (list_.empty()) return {};
        auto results = compileWithMicrosoft(list_);
        if (!results) return results.error();
        results_ = std::move(*results);
        return {};
    }

    [[nodiscard]] const MicrosoftResult& of(std::string_view shader) const { return results_[jobs_.at(shader)]; }

private:
    std::map<std::string_view, std::size_t> jobs_;
    std::vector<MicrosoftJob> list_;
    std::vector<MicrosoftResult> results_;
};

constexpr int kMostSlots = 32768; // D3DMAX30SHADERINSTRUCTIONS

struct PassShaders {
    const Technique* technique;
    const Pass* pass;
    const MicrosoftResult* vertex = nullptr;
    const MicrosoftResult* pixel = nullptr;
};

/// 512 slots is what every device has, and most have 32768: foreign effects of more run where their authors ran them.
void warnOfSlots(const ShaderReference& shader, int slots, bool vertex, TargetCheck& report) {
    report.diagnostics.push_back(
        inputWarning(3203, shader.at,
                     fmt::format("{} takes {} instruction slots: {} promises 512, and devices may have up to 32768", shader.entry, slots,
                                 vertex ? "vs_3_0" : "ps_3_0"),
                     "split the pass where every device shall draw it"));
}

void holdAgainstLimits(const ShaderReference& shader, const Sm3Usage& usage, bool vertex, bool own, TargetCheck& report) {
    for (const Sm3Limit& limit : kSm3Limits) {
        const int most = vertex ? limit.vertex : limit.pixel;
        if (usage.*limit.used <= most) continue;
        if (!own && limit.used == &Sm3Usage::instructionSlots && usage.instructionSlots <= kMostSlots) {
            warnOfSlots(shader, usage.instructionSlots, vertex, report);
            continue;
        }
        addError(report, 3203, shader.at,
                 fmt::format("{} takes {} {}, {} has {}", shader.entry, usage.*limit.used, limit.what, vertex ? "vs_3_0" : "ps_3_0", most),
                 "split the pass, or keep this entry point out of fx_2_0");
    }
}

void takeStage(const PassShaders& shaders, bool vertex, Work& work, TargetCheck& report) {
    const auto* listing = vertex ? shaders.vertex : shaders.pixel;
    const auto& shader = vertex ? shaders.pass->vertexShader : shaders.pass->pixelShader;
    if (listing == nullptr || !shader) return;
    if (!listing->ok)
        std::ranges::copy(listing->diagnostics, std::back_inserter(report.diagnostics)); // what is not measured is not within the limits
    const auto& usage = listing->sm3;
    if (!usage) return; // of an older model
    work.report.sm3.push_back({.technique = shaders.technique->name,
                               .pass = shaders.pass->name,
                               .entry = shader->entry,
                               .profile = vertex ? "vs_3_0" : "ps_3_0",
                               .usage = *usage});
    holdAgainstLimits(*shader, *usage, vertex, work.effect().ownDialect, report);
}

/// Direct3D 9 joins stages by semantic; what nobody wrote is undefined there, without a word from any compiler.
void link(const PassShaders& shaders, TargetCheck& report) {
    if (shaders.vertex == nullptr || shaders.pixel == nullptr || !shaders.vertex->sm3 || !shaders.pixel->sm3 || !shaders.pass->pixelShader)
        return;
    const auto& written = shaders.vertex->sm3->varyings;
    for (const auto& [semantic, components] : shaders.pixel->sm3->varyings) {
        const auto output = written.find(semantic);
        if (output != written.end() && output->second >= components) continue;
        const std::string vertex = shaders.pass->vertexShader ? shaders.pass->vertexShader->entry : "the vertex shader";
        addError(report, output == written.end() ? 3004 : 3005, shaders.pass->pixelShader->at,
                 fmt::format("{} reads {} component{} of {}, {} writes {}", shaders.pass->pixelShader->entry, components,
                             components == 1 ? "" : "s", semantic, vertex, output == written.end() ? 0 : output->second),
                 "give both the same struct");
    }
}

std::vector<PassShaders> passesOf(const Work& work, const Listings& listings) {
    std::vector<PassShaders> passes;
    const auto techniques = techniquesIn(work, Target::Fx2);
    for (const EffectShader& shader : fx2Shaders(work.report.binaries.at(Target::Fx2))) {
        const auto technique = static_cast<std::size_t>(shader.technique);
        const auto pass = static_cast<std::size_t>(shader.pass);
        if (technique >= techniques.size() || pass >= techniques[technique]->passes.size()) continue; // TG3202 says so
        const Pass* found = &techniques[technique]->passes[pass];
        if (passes.empty() || passes.back().pass != found) passes.push_back({techniques[technique], found});
        (isPixelShader(shader) ? passes.back().pixel : passes.back().vertex) = &listings.of(shader.bytes);
    }
    return passes;
}

} // namespace

void measureShaderModel3(std::vector<Work>& works) {
    Listings listings;
    for (Work& work : works)
        if (const auto binary = work.report.binaries.find(Target::Fx2); binary != work.report.binaries.end())
            for (const EffectShader& shader : fx2Shaders(binary->second))
                listings.add(shader.bytes);
    const auto ran = listings.run();
    for (Work& work : works) {
        TargetCheck* report = work.find(Target::Fx2);
        if (report == nullptr || !work.report.binaries.contains(Target::Fx2)) continue;
        if (!ran) {
            std::ranges::copy(ran.error().diagnostics, std::back_inserter(report->diagnostics));
            continue;
        }
        for (const PassShaders& shaders : passesOf(work, listings)) {
            takeStage(shaders, true, work, *report);
            takeStage(shaders, false, work, *report);
            link(shaders, *report);
        }
    }
}

} // namespace tegument::check
