#include "lab/bench/ablation.h"

#include "generated/setting_names.h"
#include <fmt/format.h>

namespace tegument::bench {

namespace {

struct Variation {
    std::string group;
    std::string what;
    std::string technique;
    int setting = 2; // TEGUMENT_SETTING
    std::vector<std::pair<std::string, std::string>> defines;
    std::map<std::string, std::vector<double>> parameters;
};

constexpr const char* kCulling = "culling in texture space, DEonLuebke, seed";
constexpr const char* kShadow = "the translucent shadow map as shadow map, DEonLuebke, corrected";
constexpr const char* kMaps = "maps computed once, DEonLuebke, corrected";
constexpr const char* kBlurs = "blurs, Gosselin, corrected";

/// Culling with these causes only.
Variation culled(std::string what, bool frustum, bool backFaces, bool black) {
    const auto flag = [](bool on) { return std::string(on ? "1" : "0"); };
    return {.group = kCulling,
            .what = std::move(what),
            .technique = "DEonLuebke",
            .setting = 0,
            .defines = {{"TEGUMENT_CULL_FRUSTUM", flag(frustum)},
                        {"TEGUMENT_CULL_BACK_FACES", flag(backFaces)},
                        {"TEGUMENT_CULL_BLACK", flag(black)}},
            .parameters = {{"gUsePrePass", {1}}}};
}

std::vector<Variation> variations() {
    std::vector<Variation> list = {
        {.group = kCulling, .what = "none", .technique = "DEonLuebke", .setting = 0},
        culled("outside the view", true, false, false),
        culled("back faces", false, true, false),
        culled("black texels", false, false, true),
        culled("all three", true, true, true),
        {.group = kShadow, .what = "one map for both", .technique = "DEonLuebke"},
        {.group = kShadow, .what = "a shadow map of its own", .technique = "DEonLuebke", .defines = {{"TEGUMENT_SHADOW_FROM_TSM", "0"}}}};
    for (int count = 1; count <= 6; ++count)
        list.push_back({.group = kBlurs,
                        .what = fmt::format("{} blur{}", count, count > 1 ? "s" : ""),
                        .technique = "Gosselin",
                        .parameters = {{"gBlurCount", {static_cast<double>(count)}}}});
    return list;
}

Contender contenderOf(const Variation& variation, const BenchOptions& options) {
    Contender contender{.technique = variation.technique,
                        .setting = variation.setting == 0 ? kSettingSeed : kSettingCorrected,
                        .variant = variation.what,
                        .effect = options.effects / "Main.fx",
                        .defines = variation.defines,
                        .parameters = variation.parameters};
    contender.defines.emplace_back("TEGUMENT_SETTING", std::to_string(variation.setting));
    return contender;
}

/// A map that is computed once and kept: what its passes would cost in each frame.
struct Precomputed {
    const char* what;
    const char* effect;
    std::vector<std::string> passes;
};

Result<std::vector<AblationRow>> precomputed(gpu::Device& device, const BenchOptions& options, const BenchTools& tools,
                                             const AblationRow& whole) {
    const auto scene =
        loadScene(options.scenes.front(),
                  {.effects = options.effects, .folder = options.sceneFolder, .width = options.width, .height = options.height});
    if (!scene) return scene.error();
    std::vector<AblationRow> rows = {
        {.group = kMaps, .what = "both kept", .milliseconds = whole.milliseconds, .noise = whole.noise, .relativeL2 = whole.relativeL2}};
    const std::vector<Precomputed> maps = {{"Stretch in each frame", "Stretch", {"Charts", "Fill"}},
                                           {"energy attenuation in each frame", "EnergyAttenuation", {"Precompute"}}};
    std::vector<Contender> contenders;
    contenders.reserve(maps.size());
    for (const Precomputed& map : maps)
        contenders.push_back(contenderOf({.technique = map.effect}, options));
    for (std::size_t i = 0; i < maps.size(); ++i)
        contenders[i].effect = options.effects / (std::string(maps[i].effect) + ".fx");
    const Contest contest{.scene = *scene,
                          .width = options.width,
                          .height = options.height,
                          .mapSize = options.mapSizes.front(),
                          .compiler = options.compiler};
    const auto drawn = drawInTurns(device, entriesOf(contest, contenders), options.frames, tools.say);
    for (std::size_t i = 0; i < maps.size(); ++i) {
        if (!drawn[i]) return drawn[i].error();
        double extra = 0;
        for (const PassTime& pass : (*drawn[i]).passes)
            for (const std::string& name : maps[i].passes)
                extra += pass.name == name ? pass.milliseconds : 0;
        rows.push_back({.group = kMaps,
                        .what = maps[i].what,
                        .milliseconds = whole.milliseconds + extra,
                        .noise = whole.noise,
                        .change = extra,
                        .relativeL2 = std::nullopt});
    }
    return rows;
}

} // namespace

Result<std::vector<AblationRow>> measureAblation(gpu::Device& device, const BenchOptions& options, const BenchTools& tools) {
    const std::vector<Variation> list = variations();
    std::vector<Contender> contenders;
    contenders.reserve(list.size());
    for (const Variation& variation : list)
        contenders.push_back(contenderOf(variation, options));
    BenchOptions one = options;
    one.scenes.resize(1);
    one.mapSizes.resize(1);
    const auto measured = runBench(device, contenders, one, tools);
    if (!measured) return measured.error();
    std::vector<AblationRow> rows;
    double first = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Row& row = (*measured)[i];
        if (row.failure) return *row.failure;
        const Spread& ms = row.drawn.milliseconds;
        if (i == 0 || list[i].group != list[i - 1].group) first = ms.median;
        rows.push_back({.group = list[i].group,
                        .what = list[i].what,
                        .milliseconds = ms.median,
                        .noise = ms.noise,
                        .change = ms.median - first,
                        .relativeL2 = row.errors.relativeL2});
        if (list[i].group != kShadow || i + 1 == list.size() || list[i + 1].group == kShadow) continue;
        const auto maps = precomputed(device, one, tools, rows[rows.size() - 2]);
        if (!maps) return maps.error();
        rows.insert(rows.end(), maps->begin(), maps->end());
    }
    return rows;
}

} // namespace tegument::bench
