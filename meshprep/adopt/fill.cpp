#include "meshprep/adopt/fill.h"

#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tegument::adopt {

namespace {

constexpr double kUsualSide = 128; // where no annotation says it
constexpr const char* kVertex = "tg_vertex";
constexpr const char* kPixel = "tg_pixel";

double sideOf(const Annotations& annotations, const char* name, std::size_t index) {
    if (const auto both = annotations.numbers("Dimensions"); both && both->size() > index) return (*both)[index];
    const auto one = annotations.numbers(name);
    return one && !one->empty() && one->front() >= 1 ? one->front() : kUsualSide;
}

/// `(float2)uv`, from coordinates of four components.
std::string argumentFor(const Variable& parameter) {
    const auto shape = shapeOf(parameter.type);
    const int columns = shape ? shape->columns : 2;
    const std::string from = toLower(parameter.semantic).starts_with("psize") ? "size" : "uv";
    constexpr const char* kComponents = "xyzw";
    return fmt::format("{}.{}", from, std::string(kComponents, static_cast<std::size_t>(std::clamp(columns, 1, 4))));
}

std::string fillText(const Function& function, double width, double height) {
    std::vector<std::string> arguments;
    for (const Variable& parameter : function.parameters)
        arguments.push_back(argumentFor(parameter));
    const auto shape = shapeOf(function.type);
    const int columns = shape ? shape->columns : 4;
    const std::string call = fmt::format("{}({})", function.name.text, fmt::join(arguments, ", "));
    const std::string colour = columns == 4   ? call
                               : columns == 3 ? fmt::format("float4({}, 1)", call)
                               : columns == 2 ? fmt::format("float4({}, 0, 1)", call)
                                              : fmt::format("float4(({}).xxx, 1)", call);
    return fmt::format(
        "void {}(float4 uv : TEXCOORD0, out float4 o : SV_Target0) {{ float4 size = float4(1.0 / {:.0f}, 1.0 / {:.0f}, 0, 0); "
        "o = {}; }}\n",
        kPixel, width, height, colour);
}

void annotate(Parameter& texture, const char* name, double value) {
    texture.annotations.list.push_back({name, {.base = BaseType::Float, .name = "float"}, std::vector<double>{value}, texture.at, {}});
}

} // namespace

std::string fillingFunction(const Parameter& texture, const Rewriter& rewriter) {
    const auto name = texture.annotations.string("Function");
    if (!name || texture.type.base != BaseType::Texture2D || texture.annotations.find("Procedure")) return {};
    const auto functions = rewriter.code().functions(*name);
    if (functions.empty() || functions.front()->typeName() == "void") return {};
    const auto placed = [](const Variable& parameter) { return !parameter.semantic.empty() && !parameter.has("out"); };
    return std::ranges::all_of(functions.front()->parameters, placed) ? *name : std::string();
}

Pass fillingPass(Parameter& texture, const std::string& function, const Rewriter& rewriter) {
    const double width = sideOf(texture.annotations, "Width", 0);
    const double height = sideOf(texture.annotations, "Height", 1);
    std::erase_if(texture.annotations.list, [](const Annotation& a) {
        return equalsIgnoreCase(a.name, "Dimensions") || equalsIgnoreCase(a.name, "Width") || equalsIgnoreCase(a.name, "Height") ||
               equalsIgnoreCase(a.name, "ViewportRatio");
    });
    annotate(texture, "Width", width);
    annotate(texture, "Height", height);
    texture.semantic = kColorTarget;
    Pass pass{.name = fmt::format("<fill {}>", texture.name), .at = texture.at};
    ShaderReference vertex{.entry = kVertex, .profile = "vs_3_0", .at = texture.at, .original = "none"};
    vertex.code = rewriter.source(nullptr, plainVertexShader(kVertex, {{"TEXCOORD0"}}, true));
    ShaderReference pixel{.entry = function, .profile = "ps_3_0", .at = texture.at, .original = function};
    pixel.code = rewriter.source(&pixel, Wrapper{.text = fillText(*rewriter.code().functions(function).front(), width, height)});
    pixel.entry = kPixel;
    pass.vertexShader = std::move(vertex);
    pass.pixelShader = std::move(pixel);
    pass.state.cull = CullMode::None;
    pass.state.depthTest = pass.state.depthWrite = false;
    pass.script.given = true;
    pass.script.commands.push_back({.kind = CommandKind::Draw, .options = {"Buffer"}, .at = texture.at});
    return pass;
}

void fillFirst(Technique& technique, const std::string& texture, Pass pass) {
    const auto command = [&](CommandKind kind, std::string option) {
        return Command{.kind = kind, .options = {std::move(option)}, .at = pass.at};
    };
    std::vector<Command> commands{command(CommandKind::RenderColorTarget, texture), command(CommandKind::Pass, pass.name),
                                  command(CommandKind::RenderColorTarget, "")};
    if (technique.script.given) {
        const int ahead = static_cast<int>(commands.size());
        for (Command& later : technique.script.commands)
            if (later.loopMatch >= 0) later.loopMatch += ahead;
        commands.insert(commands.end(), technique.script.commands.begin(), technique.script.commands.end());
    } else {
        for (const Pass& own : technique.passes)
            commands.push_back(command(CommandKind::Pass, own.name));
    }
    technique.script = {.given = true, .commands = std::move(commands)};
    technique.passes.push_back(std::move(pass));
}

} // namespace tegument::adopt
