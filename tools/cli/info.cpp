// tegument info: what an effect file offers.

#include "host/effect/model.h"
#include "host/effect/script_run.h"
#include "host/mesh/motion.h"
#include "host/mesh/read_mesh.h"
#include "host/run/semantics.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/foreign.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/emit/effect_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

namespace tegument::app {

namespace {

Json passJson(const Pass& pass) {
    Json json{{"name", pass.name}};
    const auto add = [&](const char* stage, const std::optional<ShaderReference>& shader) {
        if (!shader) return;
        json[stage] = shader->entry;
        if (!shader->arguments.empty()) json[fmt::format("{}_arguments", stage)] = shader->arguments;
    };
    add("vertex_shader", pass.vertexShader);
    add("hull_shader", pass.hullShader);
    add("domain_shader", pass.domainShader);
    add("geometry_shader", pass.geometryShader);
    add("pixel_shader", pass.pixelShader);
    add("compute_shader", pass.computeShader);
    if (pass.assemblyShaders > 0) json["assembly_shaders"] = pass.assemblyShaders;
    if (pass.streamOutput) json["stream_output"] = true;
    json["annotations"] = toJson(pass.annotations);
    return json;
}

std::vector<assets::Switch> switchesOf(const Effect& effect) {
    return assets::takesSwitches(effect) ? assets::switches() : std::vector<assets::Switch>();
}

Json effectJson(const Effect& effect) {
    Json json{{"file", effect.file.string()}, {"parameters", Json::array()}, {"targets", Json::array()}, {"techniques", Json::array()}};
    for (const Parameter& parameter : effect.parameters)
        json[parameter.isTarget() ? "targets" : "parameters"].push_back(toJson(parameter));
    for (const Technique& technique : effect.techniques) {
        Json passes = Json::array();
        for (const Pass& pass : technique.passes)
            passes.push_back(passJson(pass));
        json["techniques"].push_back({{"name", technique.name}, {"annotations", toJson(technique.annotations)}, {"passes", passes}});
    }
    json["settings"] =
        effect.settings
            ? Json{{"switch", effect.settings->define}, {"names", effect.settings->names}, {"current", effect.settings->current}}
            : Json(nullptr);
    json["switches"] = Json::array();
    for (const assets::Switch& one : switchesOf(effect))
        json["switches"].push_back({{"name", one.name}, {"least", one.least}, {"most", one.most}, {"help", one.meaning}});
    const auto& global = effect.standardsGlobal;
    json["script"] = global ? Json(global->annotations.string("Script").value_or("")) : Json(nullptr);
    return json;
}

std::string targetSize(const Annotations& annotations) {
    if (const auto size = annotations.numbers("Dimensions"); size && size->size() >= 2)
        return fmt::format("{:g}x{:g}", (*size)[0], (*size)[1]);
    const auto width = annotations.numbers("Width");
    const auto height = annotations.numbers("Height");
    if (width && !width->empty()) return fmt::format("{:g}x{:g}", (*width)[0], height && !height->empty() ? (*height)[0] : (*width)[0]);
    if (const auto ratio = annotations.numbers("ViewportRatio"); ratio && ratio->size() >= 2)
        return fmt::format("{:g}x{:g} of the view", (*ratio)[0], (*ratio)[1]);
    return "view";
}

std::string numbersText(const std::vector<double>& numbers) {
    constexpr std::size_t kMostShown = 4;
    return numbers.size() > kMostShown ? fmt::format("{} numbers", numbers.size()) : fmt::format("{:.4g}", fmt::join(numbers, " "));
}

std::string defaultText(const Parameter& parameter) {
    const auto& known = run::numericSemantics();
    const bool bound = std::ranges::any_of(known, [&](const std::string& name) { return equalsIgnoreCase(name, parameter.semantic); });
    if (!parameter.defaultValue) return bound ? "by semantic" : "-";
    if (const auto* text = std::get_if<std::string>(&*parameter.defaultValue)) return *text;
    return numbersText(std::get<std::vector<double>>(*parameter.defaultValue));
}

/// What a user may turn: the effect gives it a name for people and a value of its own, the scene gives it none.
bool isTunable(const Parameter& parameter) {
    return parameter.type.isNumeric() && parameter.defaultValue && parameter.annotations.string("UIName") && !parameter.isTarget() &&
           !equalsIgnoreCase(parameter.annotations.string("UIWidget").value_or(""), "none");
}

std::string rangeText(const Parameter& parameter) {
    const auto minimum = parameter.annotations.numbers("UIMin");
    const auto maximum = parameter.annotations.numbers("UIMax");
    const auto text = [](const auto& bound) { return bound && !bound->empty() ? fmt::format("{:.4g}", bound->front()) : std::string(); };
    return minimum || maximum ? text(minimum) + ".." + text(maximum) : std::string("any");
}

/// The name for people, and behind it the help, which begins with the unit.
std::string meaning(const Parameter& parameter) {
    const std::string name = parameter.annotations.string("UIName").value_or("");
    const std::string help = parameter.annotations.string("UIHelp").value_or("");
    return name.empty() || help.empty() ? name + help : fmt::format("{}: {}", name, help);
}

/// Where a texture comes from when nobody names a file.
std::string textureText(const Parameter& parameter) {
    if (const auto producer = parameter.annotations.string("Producer")) return fmt::format("drawn by {} when no file is named", *producer);
    std::string text = meaning(parameter);
    if (text.empty() && !parameter.semantic.empty())
        text = fmt::format("semantic {}: --set, the workspace, or the mesh file", parameter.semantic);
    return text.empty() ? "--set, or the workspace" : text;
}

/// Rows of columns, the last one wrapped to what is left of 100 columns.
void printRows(const std::string& title, const std::vector<std::vector<std::string>>& rows) {
    if (rows.empty()) return;
    std::vector<std::size_t> widths(rows.front().size() - 1);
    std::size_t left = 2;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        for (const auto& row : rows)
            widths[i] = std::max(widths[i], row[i].size());
        left += widths[i] + 2;
    }
    constexpr std::size_t kLeast = 24; // of the last column
    fmt::print("{}\n", title);
    for (const auto& row : rows) {
        std::string line = "  ";
        for (std::size_t i = 0; i < widths.size(); ++i)
            line += fmt::format("{:<{}}  ", row[i], widths[i]);
        for (const std::string& part : wrapped(row.back(), std::max(kLeast, kWidth - std::min(left, kWidth)))) {
            line += part;
            fmt::print("{}\n", line.substr(0, line.find_last_not_of(' ') + 1));
            line = std::string(left, ' ');
        }
    }
    fmt::print("\n");
}

/// Notes which passes a script runs; nothing is drawn. `on`: every switch, a whole number from 0 to 1, is 1.
class PassCounter : public ScriptSink {
public:
    explicit PassCounter(bool on) : on_(on) {}
    std::vector<const Pass*> passes; // each once, in the order of their first run

    Result<void> targetsChanged(const BoundTargets&) override { return {}; }
    Result<void> clear(ClearKind, int, const ScriptState&) override { return {}; }
    Result<void> beginPass(const Technique&, const Pass& pass) override {
        if (std::ranges::find(passes, &pass) == passes.end()) passes.push_back(&pass);
        return {};
    }
    Result<void> draw(const Pass&, DrawKind, const ScriptState&) override { return {}; }
    Result<void> endPass(const Pass&) override { return {}; }
    Result<void> external(const ScriptState&) override { return {}; }
    [[nodiscard]] std::vector<double> read(const Parameter& parameter) const override {
        if (const auto written = written_.find(parameter.name); written != written_.end()) return {written->second};
        if (on_ && rangeText(parameter) == "0..1" && parameter.type.base != BaseType::Float) return {1.0};
        if (const auto* numbers = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr)
            return *numbers;
        return std::vector<double>(static_cast<std::size_t>(parameter.type.scalarCount()), 0.0);
    }
    void write(const Parameter& parameter, double value) override { written_[parameter.name] = value; }

private:
    bool on_;
    std::map<std::string, double> written_;
};

std::vector<const Pass*> passesRun(const Effect& effect, const Technique& technique, bool on) {
    PassCounter counter(on);
    const auto ran = runScripts(effect, technique.name, counter);
    return ran ? counter.passes : std::vector<const Pass*>();
}

/// Passes as docs/design/passes.md counts them: those that the script runs with its switches on. Declared may be more, for other values;
/// run by default may be fewer.
struct PassCount {
    std::vector<const Pass*> counted;
    std::size_t byDefault = 0;
};

PassCount countPasses(const Effect& effect, const Technique& technique) {
    const auto byDefault = passesRun(effect, technique, false);
    const auto on = passesRun(effect, technique, true);
    PassCount count{.byDefault = byDefault.size()};
    for (const Pass& pass : technique.passes)
        if (std::ranges::find(byDefault, &pass) != byDefault.end() || std::ranges::find(on, &pass) != on.end())
            count.counted.push_back(&pass);
    return count;
}

std::string stageText(const std::optional<ShaderReference>& shader) {
    if (!shader) return "-";
    return shader->arguments.empty() ? shader->entry : fmt::format("{}({})", shader->entry, fmt::join(shader->arguments, ", "));
}

/// Vertex and pixel shader, and behind them what only some passes have.
std::string stagesText(const Pass& pass) {
    std::string text = fmt::format("{} / {}", stageText(pass.vertexShader), stageText(pass.pixelShader));
    const auto add = [&](std::string_view stage, const std::optional<ShaderReference>& shader) {
        if (shader) text += fmt::format(", {} {}", stage, stageText(shader));
    };
    add("hull", pass.hullShader);
    add("domain", pass.domainShader);
    add("geometry", pass.geometryShader);
    add("compute", pass.computeShader);
    if (pass.assemblyShaders > 0) text += ", assembly";
    if (pass.streamOutput) text += ", stream output";
    return text;
}

void printTechnique(const Effect& effect, const Technique& technique, bool all) {
    const PassCount count = countPasses(effect, technique);
    const std::size_t passes = count.counted.size();
    std::string line = fmt::format("technique {}: {} pass{}", technique.name, passes, passes == 1 ? "" : "es");
    if (count.byDefault < passes) line += fmt::format(", {} of them with the default values", count.byDefault);
    if (technique.passes.size() > passes) line += fmt::format("; {} more for other values", technique.passes.size() - passes);
    fmt::print("{}\n", line);
    if (all) {
        for (const Pass& pass : technique.passes)
            fmt::print("    {:<16} {}\n", pass.name, stagesText(pass));
        return;
    }
    std::vector<std::string> names;
    for (const Pass* pass : count.counted)
        names.push_back(pass->name);
    constexpr std::size_t kInset = 4;
    for (const std::string& part : wrapped(fmt::format("{}", fmt::join(names, ", ")), kWidth - kInset))
        fmt::print("    {}\n", part);
}

void printEffect(const Effect& effect, bool all) {
    std::vector<std::vector<std::string>> tunables;
    std::vector<std::vector<std::string>> textures;
    std::vector<std::vector<std::string>> internals;
    std::vector<std::vector<std::string>> targets;
    for (const Parameter& parameter : effect.parameters) {
        if (parameter.isTarget())
            targets.push_back(
                {parameter.name, targetSize(parameter.annotations), parameter.annotations.string("Format").value_or("A8R8G8B8")});
        else if (isTunable(parameter))
            tunables.push_back(
                {parameter.name, typeName(parameter.type), rangeText(parameter), defaultText(parameter), meaning(parameter)});
        else if (parameter.type.isTexture())
            textures.push_back({parameter.name, typeName(parameter.type), textureText(parameter)});
        else
            internals.push_back({parameter.name, typeName(parameter.type), parameter.semantic.empty() ? "-" : parameter.semantic,
                                 defaultText(parameter), meaning(parameter)});
    }
    fmt::print("{}\n", effect.file.string());
    if (effect.settings)
        fmt::print("settings ({}): {}; now {}\n", effect.settings->define, fmt::join(effect.settings->names, ", "),
                   effect.settings->current);
    fmt::print("\n");
    printRows("to turn (--set NAME=VALUE): type, range, default, what it is and its unit", tunables);
    printRows("textures (--set NAME=FILE)", textures);
    std::vector<std::vector<std::string>> switched;
    for (const assets::Switch& one : switchesOf(effect))
        switched.push_back({one.name, one.range(), one.meaning});
    printRows("switches (--set NAME=VALUE, or a workspace's parameters): range, what they do", switched);
    if (all) printRows("internal parameters: type, semantic, default", internals);
    if (all) printRows("targets: size, format", targets);
    for (const Technique& technique : effect.techniques)
        printTechnique(effect, technique, all);
    if (!all && internals.size() + targets.size() > 0)
        fmt::print("\n{} internal parameters and {} targets: --all shows them\n", internals.size(), targets.size());
}

struct InfoOptions {
    std::string file;
    EffectOptions effect;
    bool all = false;
    bool json = false;
};

/// What can be said of a mesh to --animation, --time and --morph.
struct MeshMotion {
    std::vector<std::vector<std::string>> animations, morphs, skins;

    explicit MeshMotion(const Mesh& mesh) {
        if (!mesh.motion) return;
        const Motion& motion = *mesh.motion;
        for (const MotionAnimation& animation : motion.animations)
            animations.push_back({animation.name, fmt::format("{:.3f}", animation.seconds), std::to_string(animation.channels.size())});
        for (const MotionRun& run : motion.runs)
            for (const MorphTarget& target : run.targets)
                if (std::ranges::find(morphs, target.name, [](const auto& row) { return row[0]; }) == morphs.end())
                    morphs.push_back({target.name, motion.nodes[run.node].name});
        for (std::size_t i = 0; i < motion.skins.size(); ++i) {
            std::vector<std::string> joints;
            for (const std::size_t joint : motion.skins[i].joints)
                joints.push_back(motion.nodes[joint].name.empty() ? std::to_string(joint) : motion.nodes[joint].name);
            const std::string& name = motion.skins[i].name;
            skins.push_back(
                {name.empty() ? std::to_string(i) : name, std::to_string(joints.size()), fmt::format("{}", fmt::join(joints, ", "))});
        }
    }
};

int meshInfo(const InfoOptions& options) {
    const auto mesh = loadMesh(options.file, {.guessUnit = true});
    if (!mesh) return fail(mesh.error(), options.json);
    warn(mesh->warnings);
    const MeshMotion motion(*mesh);
    const glm::vec3 size = mesh->bounds.maximum - mesh->bounds.minimum;
    if (!options.json) {
        fmt::print("{}\n{} vertices, {}, {}; {:.4g} x {:.4g} x {:.4g} mm\n\n", options.file, mesh->positions.size(),
                   counted(mesh->indices.size() / 3, "triangle"), counted(mesh->parts.size(), "part"), size.x, size.y, size.z);
        printRows("animations (--animation NAME --time T): seconds, channels", motion.animations);
        printRows("morph targets (--morph NAME=WEIGHT): of which node", motion.morphs);
        printRows("skins: joints", motion.skins);
        if (!mesh->motion) fmt::print("it does not move: no animation, skin or morph target\n");
        return 0;
    }
    const auto rows = [](const std::vector<std::vector<std::string>>& from, const std::vector<const char*>& keys) {
        Json list = Json::array();
        for (const auto& row : from) {
            list.push_back(Json::object());
            for (std::size_t i = 0; i < keys.size(); ++i)
                list.back()[keys[i]] = row[i];
        }
        return list;
    };
    Json json{{"mesh", options.file},
              {"vertices", mesh->positions.size()},
              {"triangles", mesh->indices.size() / 3},
              {"animations", Json::array()},
              {"morphs", rows(motion.morphs, {"name", "node"})},
              {"skins", Json::array()}};
    for (const MotionAnimation& animation : mesh->motion ? mesh->motion->animations : std::vector<MotionAnimation>())
        json["animations"].push_back({{"name", animation.name}, {"seconds", animation.seconds}, {"channels", animation.channels.size()}});
    for (const auto& row : motion.skins)
        json["skins"].push_back({{"name", row[0]}, {"joints", std::stoi(row[1])}});
    print(json);
    return 0;
}

int info(const InfoOptions& options) {
    if (meshFormatOf(options.file)) return meshInfo(options);
    const auto file = assets::findEffect(options.file);
    if (!file) return fail(file.error(), options.json);
    const Result<Effect> effect = loadEffect(*file, assets::loadOptions(options.effect));
    if (!effect) return fail(effect.error(), options.json);
    warn(effect->warnings);
    const std::vector<ParameterBinding> bindings = adopted(*effect).bindings; // none of an effect that is written for this host
    if (options.json) {
        Json json = effectJson(*effect);
        json["bindings"] = Json::array();
        for (const ParameterBinding& binding : bindings)
            json["bindings"].push_back({{"parameter", binding.parameter}, {"got", binding.source}, {"by", binding.rule}});
        print(json);
    } else {
        printEffect(*effect, options.all);
        printBindings(bindings);
    }
    return 0;
}

} // namespace

void addInfo(CLI::App& program, Action& action) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand(
        "info", "List an effect's parameters, targets, techniques and passes; or a mesh's animations, morph targets and skins");
    command->add_option("effect", options->file, "Effect: a file (.fx), or the name of one of ours, such as Main; or a mesh file")
        ->required();
    addEffectOptions(*command, options->effect);
    command->add_flag("--all", options->all, "Also internal parameters, targets and the shaders of each pass");
    command->add_flag("--json", options->json, "Print JSON, with everything");
    addExamples(
        *command,
        {{"info Main", "what can be turned"}, {"info Main --all", "and everything else"}, {"info body.glb", "how a mesh can move"}},
        "Of an effect of another host also: what each parameter gets, and by which rule (--bind of render and view says otherwise).");
    command->callback([options, &action] { action = [options] { return info(*options); }; });
}

} // namespace tegument::app
