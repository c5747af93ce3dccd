// tegument info: what an effect file offers.

#include "host/app/command_line.h"
#include "host/app/effect_options.h"
#include "host/app/names.h"
#include "host/app/output.h"
#include "host/effect/model.h"
#include "host/emit/effect_json.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

namespace tegument::app {

namespace {

bool isTarget(const Parameter& parameter) {
    return equalsIgnoreCase(parameter.semantic, "RENDERCOLORTARGET") || equalsIgnoreCase(parameter.semantic, "RENDERDEPTHSTENCILTARGET");
}

Json passJson(const Pass& pass) {
    Json json{{"name", pass.name}};
    if (pass.vertexShader) json["vertex_shader"] = pass.vertexShader->entry;
    if (pass.pixelShader) json["pixel_shader"] = pass.pixelShader->entry;
    json["annotations"] = toJson(pass.annotations);
    return json;
}

Json effectJson(const Effect& effect) {
    Json json{{"file", effect.file.string()}, {"parameters", Json::array()}, {"targets", Json::array()}, {"techniques", Json::array()}};
    for (const Parameter& parameter : effect.parameters)
        json[isTarget(parameter) ? "targets" : "parameters"].push_back(toJson(parameter));
    for (const Technique& technique : effect.techniques) {
        Json passes = Json::array();
        for (const Pass& pass : technique.passes)
            passes.push_back(passJson(pass));
        json["techniques"].push_back({{"name", technique.name}, {"annotations", toJson(technique.annotations)}, {"passes", passes}});
    }
    const Parameter* global = nullptr;
    for (const Parameter& parameter : effect.parameters)
        if (equalsIgnoreCase(parameter.semantic, "STANDARDSGLOBAL")) global = &parameter;
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

std::string defaultText(const Parameter& parameter) {
    if (!parameter.defaultValue) return parameter.semantic.empty() ? "-" : "by semantic";
    if (const auto* text = std::get_if<std::string>(&*parameter.defaultValue)) return *text;
    const auto& numbers = std::get<std::vector<double>>(*parameter.defaultValue);
    if (numbers.size() > 4) return fmt::format("{} numbers", numbers.size());
    return fmt::format("{:.6g}", fmt::join(numbers, " "));
}

void printEffect(const Effect& effect) {
    std::vector<std::vector<std::string>> parameters;
    std::vector<std::vector<std::string>> targets;
    for (const Parameter& parameter : effect.parameters) {
        if (isTarget(parameter)) {
            targets.push_back(
                {parameter.name, targetSize(parameter.annotations), parameter.annotations.string("Format").value_or("A8R8G8B8")});
        } else {
            parameters.push_back({parameter.name, typeName(parameter.type), parameter.semantic, defaultText(parameter),
                                  parameter.annotations.string("UIHelp").value_or("")});
        }
    }
    fmt::print("{}\n\n", effect.file.string());
    if (!parameters.empty()) fmt::print("{}\n", table({"parameter", "type", "semantic", "default", "help"}, parameters));
    if (!targets.empty()) fmt::print("{}\n", table({"target", "size", "format"}, targets));
    for (const Technique& technique : effect.techniques) {
        fmt::print("technique {}: {} passes\n", technique.name, technique.passes.size());
        for (const Pass& pass : technique.passes)
            fmt::print("    {:<16} {} / {}\n", pass.name, pass.vertexShader ? pass.vertexShader->entry : "-",
                       pass.pixelShader ? pass.pixelShader->entry : "-");
    }
}

struct InfoOptions {
    std::string file;
    EffectOptions effect;
    bool json = false;
};

int info(const InfoOptions& options) {
    const auto file = findEffect(options.file);
    if (!file) return fail(file.error(), options.json);
    const Result<Effect> effect = loadEffect(*file, loadOptions(options.effect));
    if (!effect) return fail(effect.error(), options.json);
    warn(effect->warnings);
    if (options.json) {
        print(effectJson(*effect));
    } else {
        printEffect(*effect);
    }
    return 0;
}

} // namespace

void addInfo(CLI::App& program, Action& action) {
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = program.add_subcommand("info", "List an effect's parameters, targets, techniques and passes");
    command->add_option("effect", options->file, "Effect file (.fx)")->required();
    addEffectOptions(*command, options->effect);
    command->add_flag("--json", options->json, "Print JSON");
    addExamples(*command, {{"info Main", "what can be turned"}});
    command->callback([options, &action] { action = [options] { return info(*options); }; });
}

} // namespace tegument::app
