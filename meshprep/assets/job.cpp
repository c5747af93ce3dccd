#include "meshprep/assets/job.h"

#include "host/effect/reshade.h"
#include "host/image/image.h"
#include "host/support/text.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/strands.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace tegument::assets {

namespace {

constexpr const char* kCurves = "TEGUMENT_FUR_CURVES";

/// The workspace that shows the effect when none is named.
std::string usualWorkspace(const Effect& effect) {
    const auto named = effect.standardsGlobal ? effect.standardsGlobal->annotations.string("Workspace") : std::nullopt;
    return named.value_or("human.json");
}

bool needsMesh(const Effect& effect, const std::string& technique, MeshFor meshFor) {
    const auto draws = [&](const Technique& candidate) { return drawsMesh(effect, candidate); };
    if (meshFor == MeshFor::AnyTechnique) return std::ranges::any_of(effect.techniques, draws);
    const Technique* chosen = technique.empty() ? effect.defaultTechnique() : effect.findTechnique(technique);
    return chosen && draws(*chosen);
}

} // namespace

LoadOptions loadOptions(const EffectOptions& options) {
    LoadOptions load;
    for (const std::string& define : options.defines) {
        const std::size_t equals = define.find('=');
        if (equals == std::string::npos) {
            load.defines.emplace_back(define, "1");
        } else {
            load.defines.emplace_back(define.substr(0, equals), define.substr(equals + 1));
        }
    }
    load.lenient = true;
    load.setting = options.setting;
    load.roots.anywhere = options.anywhere;
    if (options.mapSize > 0) load.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(options.mapSize));
    if (options.shadowSize > 0) load.defines.emplace_back("TEGUMENT_SHADOW_SIZE", std::to_string(options.shadowSize));
    for (const std::string& folder : options.includeFolders)
        load.includeFolders.emplace_back(folder);
    return load;
}

Result<std::map<std::string, std::string>> bindRules(const std::vector<std::string>& given) {
    std::map<std::string, std::string> rules;
    for (const std::string& text : given) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0 || equals + 1 == text.size())
            return usageError(8011, fmt::format("--bind {} is not NAME=RULE", text), "for example --bind gMatrix=WORLDVIEWPROJECTION");
        rules[text.substr(0, equals)] = text.substr(equals + 1);
    }
    return rules;
}

Result<std::pair<int, int>> parseSize(const std::string& text) {
    std::pair<int, int> size{0, 0};
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.first);
    const bool square = width.ec == std::errc() && width.ptr == end;
    const bool separator = width.ec == std::errc() && !square && (*width.ptr == 'x' || *width.ptr == 'X');
    const auto height = separator ? std::from_chars(width.ptr + 1, end, size.second) : width;
    if (square) size.second = size.first;
    if ((!square && !separator) || height.ec != std::errc() || height.ptr != end || size.first < 1 || size.second < 1)
        return usageError(8010, fmt::format("--size {} is not a picture size", text),
                          "write WIDTHxHEIGHT in pixels, for example 1280x720, or one number for a square");
    return size;
}

Result<Compiler> chosenCompiler(const std::string& name) {
    const Compiler compiler = name.empty() ? defaultCompiler() : name == "dxc" ? Compiler::Dxc : Compiler::Glslang;
    // Who names a library means it: another compiler in its place would go unseen.
    const char* own = name.empty() ? std::getenv("TEGUMENT_DXC") : nullptr;
    const bool asked = own != nullptr && *own != '\0';
    if (compilerAvailable(compiler) && (!asked || compiler == Compiler::Dxc)) return compiler;
    const std::string why = whyCompilerMissing(asked ? Compiler::Dxc : compiler);
    return machineError(8015, fmt::format("the compiler is not available: {}", why), "run ./bootstrap build, or use --compiler glslang");
}

namespace {

/// With the switches among the values, which are taken out of them. Of a macro that is given twice the last one counts.
Result<LoadOptions> loadOptions(JobOptions& options, const std::string& workspace) {
    LoadOptions load = loadOptions(options.effect);
    if (!workspace.empty()) load.roots.folders.push_back(std::filesystem::path(workspace).parent_path());
    if (!options.scene.pose.empty() || options.scene.motion.any()) load.defines.emplace_back("TEGUMENT_FUR_POSE", "1");
    if (!options.scene.poseBefore.empty()) load.defines.emplace_back("TEGUMENT_MOTION", "1");
    const auto switched = takeSwitches(options.sets);
    if (!switched) return switched.error();
    load.defines.insert(load.defines.end(), switched->begin(), switched->end());
    std::vector<std::pair<std::string, std::string>> defines;
    for (auto& define : load.defines) {
        std::erase_if(defines, [&](const auto& before) { return before.first == define.first; });
        defines.push_back(std::move(define));
    }
    load.defines = std::move(defines);
    return load;
}

/// What the workspace says of how the picture is drawn, where the options do not. A technique or setting that the effect lacks is passed
/// over, and said.
Result<std::vector<Diagnostic>> complete(JobOptions& options, const Workspace& workspace, const Effect& effect) {
    const auto switched = switchesOf(workspace);
    if (!switched) return switched.error();
    if (takesSwitches(effect)) options.effect.defines.insert(options.effect.defines.begin(), switched->begin(), switched->end());
    std::vector<Diagnostic> notes;
    const auto lacks = [&](const char* what, const std::string& name) {
        notes.push_back(inputWarning(8018, {.file = workspace.file.string()},
                                     fmt::format("{} has no {} '{}': it is passed over", effect.file.string(), what, name),
                                     fmt::format("tegument info {} lists them", shellWord(effect.file.string()))));
    };
    if (options.technique.empty() && !workspace.technique.empty())
        effect.findTechnique(workspace.technique) ? void(options.technique = workspace.technique) : lacks("technique", workspace.technique);
    if (options.effect.setting.empty() && !workspace.setting.empty()) {
        const bool has = effect.settings && std::ranges::find(effect.settings->names, workspace.setting) != effect.settings->names.end();
        has ? void(options.effect.setting = workspace.setting) : lacks("setting", workspace.setting);
    }
    if (options.size.empty() && workspace.size) options.size = fmt::format("{}x{}", workspace.size->first, workspace.size->second);
    if (options.samples == 0) options.samples = workspace.samples;
    for (const auto& [name, rule] : workspace.binds)
        options.binds.insert(options.binds.begin(), fmt::format("{}={}", name, rule));
    const auto beside = [&](std::string& given, const std::string& path) {
        if (given.empty() && !path.empty()) given = (workspace.file.parent_path() / path).string();
    };
    if (options.scene.mesh.empty()) {
        beside(options.scene.pose, workspace.pose);
        beside(options.scene.poseBefore, workspace.poseBefore);
    }
    return notes;
}

/// An effect that changes a picture gets one, and draws as large as it is.
Result<void> givePicture(JobOptions& options, const Effect& effect) {
    for (const auto& [file, name, option] :
         {std::tuple(options.pictureIn, "tgPictureIn", "--picture-in"), {options.depthIn, "tgDepthIn", "--depth-in"}}) {
        if (file.empty()) continue;
        if (!effect.reshade)
            return usageError(8082, fmt::format("{}: {} changes no picture", option, effect.file.string()), "effects of ReShade do");
        const auto image = loadImage(file);
        if (!image) return image.error();
        if (options.size.empty() && name == std::string_view("tgPictureIn"))
            options.size = fmt::format("{}x{}", image->width, image->height);
        options.sets.push_back(fmt::format("{}={}", name, file));
    }
    if (effect.reshade && options.samples == 0) options.samples = 1;
    return {};
}

/// Such an effect is preprocessed with the picture's size.
Result<void> definePicture(const JobOptions& options, std::vector<std::pair<std::string, std::string>>& defines) {
    const auto size = parseSize(options.size.empty() ? options.usualSize : options.size);
    if (!size) return size.error();
    const auto define = [&](const char* name, std::string value) {
        if (std::ranges::none_of(defines, [&](const auto& known) { return known.first == name; }) && !value.empty())
            defines.emplace_back(name, std::move(value));
    };
    define("BUFFER_WIDTH", std::to_string(size->first));
    define("BUFFER_HEIGHT", std::to_string(size->second));
    define(kPictureIn, options.pictureIn.empty() ? "" : "1");
    define(kDepthIn, options.depthIn.empty() ? "" : "1");
    define(kMeshIn, options.scene.mesh.empty() ? "" : "1");
    return {};
}

bool isOurs(const std::filesystem::path& workspace) {
    std::error_code failed;
    return std::ranges::any_of(knownWorkspaces(), [&](const auto& known) { return std::filesystem::equivalent(known, workspace, failed); });
}

/// A scene's camera is made for the size that it names, or for a square; its field of view is across, and a wider picture would cut what is
/// above and below.
void fit(Workspace& workspace, std::string how, bool own, double aspect) {
    if (how.empty()) how = own && !workspace.size ? "width" : "both";
    const double shape = workspace.size ? static_cast<double>(workspace.size->first) / workspace.size->second : 1;
    const double wider = how == "height" ? aspect / shape : how == "both" ? std::max(1.0, aspect / shape) : 1.0;
    if (wider == 1) return;
    constexpr double kWidest = 170; // degrees, as in workspaces
    float& fov = workspace.camera.horizontalFov;
    const double half = glm::radians(0.5 * static_cast<double>(fov));
    fov = static_cast<float>(std::min(kWidest, glm::degrees(2 * std::atan(wider * std::tan(half)))));
}

} // namespace

Result<Job> loadJob(const JobOptions& given, MeshFor meshFor, bool turns, const Say& say) {
    JobOptions options = given;
    const auto file = findEffect(options.file);
    if (!file) return file.error();
    SceneOptions sceneOptions = options.scene;
    sceneOptions.effect = file->string();
    if (!options.scene.workspace.empty()) {
        const auto workspace = findWorkspace(options.scene.workspace, *file);
        if (!workspace) return workspace.error();
        sceneOptions.workspace = workspace->string();
    }
    if (!options.scene.mesh.empty())
        if (const auto exists = fileExists(options.scene.mesh, "--mesh"); !exists) return exists.error();
    auto load = loadOptions(options, sceneOptions.workspace);
    if (!load) return load.error();
    auto effect = loadEffect(*file, *load);
    if (!effect) return effect.error();
    sceneOptions.usual = usualWorkspace(*effect);
    const auto workspace = chooseWorkspace(sceneOptions, false);
    if (!workspace) return workspace.error();
    options.sets = given.sets;
    if (const auto given = givePicture(options, *effect); !given) return given.error();
    const auto notes = complete(options, *workspace, *effect);
    if (!notes) return notes.error();
    const LoadOptions before = std::exchange(*load, *loadOptions(options, sceneOptions.workspace));
    const std::filesystem::path meshFile =
        sceneOptions.mesh.empty() ? workspace->file.parent_path() / workspace->meshPath : std::filesystem::path(sceneOptions.mesh);
    const bool curves = curvesBeside(meshFile).has_value();
    if (curves && takesSwitches(*effect) &&
        std::ranges::find(load->defines, kCurves, &std::pair<std::string, std::string>::first) == load->defines.end())
        load->defines.emplace_back(kCurves, "1");
    if (effect->reshade)
        if (const auto defined = definePicture(options, load->defines); !defined) return defined.error();
    if (load->defines != before.defines || load->setting != before.setting) effect = loadEffect(*file, *load);
    if (!effect) return effect.error();
    const std::vector<std::string>& sets = options.sets;
    const auto size = parseSize(options.size.empty() ? options.usualSize : options.size);
    if (!size) return size.error();
    for (const std::string& pose : {options.scene.pose, options.scene.poseBefore})
        if (!pose.empty())
            if (const auto exists = fileExists(pose, "--pose"); !exists) return exists.error();
    sceneOptions.pose = options.scene.pose;
    sceneOptions.poseBefore = options.scene.poseBefore;
    sceneOptions.bends = sceneOptions.motion.any() && effect->findParameter("gFurPoseMap");
    sceneOptions.pictures = std::ranges::any_of(sets, [](const std::string& set) { return isPainted(set); });
    sceneOptions.roots = load->roots;
    sceneOptions.roots.folders.insert(sceneOptions.roots.folders.end(), load->includeFolders.begin(), load->includeFolders.end());
    if (const auto exists = techniqueExists(*effect, options.technique); !exists) return exists.error();
    const auto rules = bindRules(options.binds);
    if (!rules) return rules.error();
    Adoption foreign =
        adopted(std::move(*effect), {.bind = *rules, .technique = options.technique, .width = size->first, .height = size->second});
    Job job{.effect = std::move(foreign.effect), .load = std::move(*load)};
    job.bindings = std::move(foreign.bindings);
    job.run.technique = options.technique;
    job.run.width = size->first;
    job.run.height = size->second;
    job.run.samples = options.samples > 0 ? options.samples : foreign.halfPixel ? 1 : kUsualSamples;
    job.run.halfPicture = options.picture == "half";
    job.run.samplesAreAsked = options.samples > 0;
    job.run.plainSkin = {0.53F, 0.34F, 0.27F, 1}; // the mean of the default human's colour map
    const auto compiler = chosenCompiler(options.compiler);
    if (!compiler) return compiler.error();
    job.run.compiler = *compiler;
    if (!options.preset.empty())
        if (const auto applied = applyPreset(options.preset, job.effect, job.run); !applied) return applied.error();
    for (const std::string& set : sets)
        if (const auto applied = applySet(set, job.effect, job.run); !applied) return applied.error();

    if (sceneOptions.portrait)
        if (const auto map = job.run.textures.find("gSkinMap"); map != job.run.textures.end())
            sceneOptions.portrait->colorMap = map->second;
    sceneOptions.aspect = static_cast<double>(size->first) / size->second;
    sceneOptions.turns = turns;
    sceneOptions.unitSize = job.effect.unitSize;
    const bool mesh = needsMesh(job.effect, options.technique, meshFor);
    auto scene = loadScene(sceneOptions, mesh);
    if (!scene) return scene.error();
    if (!mesh && !options.scene.mesh.empty())
        job.warnings.push_back(inputWarning(8054, {}, fmt::format("--mesh {} changes nothing: no mesh is drawn", options.scene.mesh),
                                            needsMesh(job.effect, {}, MeshFor::AnyTechnique) ? "another technique draws one"
                                                                                             : "the effect draws whole pictures alone"));
    job.scene = std::move(*scene);
    const bool own = !options.scene.workspace.empty() && !isOurs(job.scene.workspace.file);
    if (sceneOptions.mesh.empty()) fit(job.scene.workspace, options.fit, own, sceneOptions.aspect);
    auto warnings = checkWorkspaceValues(job.effect, job.scene.workspace);
    if (!warnings) return warnings.error();
    for (const auto& [name, value] : job.load.defines)
        if (findSwitch(name)) job.scene.workspace.parameters[name] = {std::strtod(value.c_str(), nullptr)}; // so that it is saved
    std::ranges::move(foreign.notes, std::back_inserter(job.warnings));
    job.warnings.insert(job.warnings.end(), notes->begin(), notes->end());
    job.warnings.insert(job.warnings.end(), warnings->begin(), warnings->end());
    job.run.assets = meshAssets(say);
    setFurMapParameters(job.effect, job.run, job.scene);
    if (const auto grown = growStrands(job.effect, job.run, job.scene, meshFile); !grown) return grown.error();
    if (const auto posed = poseStrands(job.effect, job.run, job.scene); !posed) return posed.error();
    return job;
}

Result<RunResult> draw(gpu::Device& device, const Job& job) {
    return runScene(device, job.effect, job.scene, job.run);
}

} // namespace tegument::assets
