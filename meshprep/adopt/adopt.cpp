#include "meshprep/adopt/adopt.h"

#include "host/support/text.h"
#include "meshprep/adopt/bind.h"
#include "meshprep/adopt/columns.h"
#include "meshprep/adopt/fill.h"
#include "meshprep/adopt/flow.h"
#include "meshprep/adopt/negated.h"
#include "meshprep/adopt/rewrite.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace tegument {

namespace adopt {

namespace {

void note(Adoption& adoption, const SourcePosition& at, std::string text) {
    adoption.notes.push_back({.severity = Severity::Note, .code = 3404, .at = at, .text = std::move(text)});
}

/// `Word name[`: whether the first word can be a type, or is none of a declaration.
bool mayDeclareArray(std::string_view word, const Code& code) {
    for (const std::string_view other :
         {"return", "else", "do", "case", "const", "static", "precise", "in", "out", "inout", "unsigned", "struct", "uniform", "row_major",
          "column_major", "groupshared", "nointerpolation", "linear", "centroid"})
        if (word == other) return true;
    for (const std::string_view family :
         {"Texture", "texture", "Sampler", "sampler", "tg_", "Buffer", "RW", "Structured", "ByteAddress", "TG_"})
        if (word.starts_with(family)) return true;
    return code.byName.find(word) != code.byName.end() || shapeOf({Word{.text = std::string(word), .kind = TokenKind::Word}}) ||
           isReserved(word);
}

/// What no later compiler has: a call of `noise`, and objects of effects inside functions; DXC does not survive arrays of an unknown type.
std::optional<std::string> goneWord(const std::string& code, const Code& known) {
    Sources sources;
    const LexResult lexed = lex(sources, sources.add("code", std::make_shared<const std::string>(code)));
    bool ownNoise = false;
    std::optional<std::string> gone;
    for (std::size_t i = 1; i + 1 < lexed.tokens.size(); ++i) {
        const Token& token = lexed.tokens[i];
        if (token.kind != TokenKind::Word) continue;
        const Token& before = lexed.tokens[i - 1];
        const Token& next = lexed.tokens[i + 1];
        if (token.is("noise") && next.is('(')) {
            ownNoise = ownNoise || (before.kind == TokenKind::Word && !before.is("return"));
            if (!ownNoise) gone = "calls 'noise': a Direct3D 9 intrinsic, not in shader model 4";
        }
        if (next.kind == TokenKind::Word && isEffectType(token.text) && !before.is('.'))
            return fmt::format("declares a {}, which is no type of a shader", token.text);
        const bool array = next.kind == TokenKind::Word && i + 2 < lexed.tokens.size() && lexed.tokens[i + 2].is('[');
        if (array && !mayDeclareArray(token.text, known)) return fmt::format("declares an array of the unknown type '{}'", token.text);
    }
    return gone;
}

class Adopter {
public:
    Adopter(Effect effect, const AdoptOptions& options)
        : adoption_{.effect = std::move(effect)}, options_(options), rewriter_(adoption_.effect) {}

    Adoption run() {
        Effect& effect = adoption_.effect;
        effect.displayColours = effect.unitSize = effect.direct3D9Targets = true;
        for (const Technique& technique : effect.techniques)
            for (const Pass& pass : technique.passes)
                addDirectionSigns(rewriter_.code(), pass, signs_);
        for (Technique& technique : effect.techniques) {
            onPicture_ = drawsIntoPicture(technique);
            for (std::size_t i = 0; i < technique.passes.size(); ++i)
                pass(technique, technique.passes[i], i);
            runPassesAtAll(technique);
            std::ranges::for_each(technique.passes, nameCallersTargets);
            turnFaces(technique);
        }
        chooseShown();
        fillTextures();
        if (std::ranges::any_of(effect.techniques, drawsScene)) addScene();
        if (plain_) addOwn(kPlainMatrix, {.rows = 4, .columns = 4, .name = "float4x4"}, "WORLDVIEWPROJECTION");
        if (sized_) addOwn(kTargetSize, {.rows = 1, .columns = 2, .name = "float2"}, "VIEWPORTPIXELSIZE");
        bind();
        return std::move(adoption_);
    }

private:
    /// What this host cannot draw keeps its shaders: running it says why.
    void pass(const Technique& technique, Pass& pass, std::size_t index) {
        if (pass.geometryShader || pass.computeShader || pass.hullShader || pass.domainShader || pass.streamOutput) return;
        if (pass.name.empty()) pass.name = fmt::format("{}", index);
        const bool later = technique.kind != TechniqueKind::D3D9;
        const bool depthOnly = later && !pass.pixelShader && pass.vertexShader;
        drawAtAll(pass);
        flow_ = flowOf(pass);
        const bool quad = coversTarget(pass);
        place(pass, quad);
        std::vector<Port> written;
        const bool known = !pass.vertexShader || takeVertex(pass, quad, written);
        std::optional<Wrapper> pixel;
        if (pass.pixelShader) pixel = wrapperOf(*pass.pixelShader, false, pass.vertexShader && known ? &written : nullptr, pass);
        if (!known || (pass.pixelShader && !pixel)) return;
        if (!pass.vertexShader) standInVertex(pass, pixel, quad);
        if (!pass.pixelShader && !depthOnly) standInPixel(pass, written);
    }

    /// Whether no script of it names a target: its author's picture had eight bits, into which nothing above one is blended.
    [[nodiscard]] static bool drawsIntoPicture(const Technique& technique) {
        const auto named = [](const Script& script) {
            return std::ranges::any_of(script.commands, [](const Command& command) {
                return command.kind == CommandKind::RenderColorTarget && !command.options.front().empty();
            });
        };
        return !named(technique.script) && std::ranges::none_of(technique.passes, named, &Pass::script);
    }

    /// False: its shader says why.
    bool takeVertex(Pass& pass, bool quad, std::vector<Port>& written) {
        auto made = wrapperOf(*pass.vertexShader, true, nullptr, pass, quad);
        if (!made) return false;
        sized_ = sized_ || made->readsTargetSize;
        written = made->outputs;
        for (const std::string& text : made->standIns)
            said_.insert({pass.vertexShader->at.line, text}).second ? note(adoption_, pass.vertexShader->at, text) : void();
        if (!made->writesPosition) refuse(*pass.vertexShader, 3403, fmt::format("{} writes no position", pass.vertexShader->original));
        return true;
    }

    [[nodiscard]] std::optional<PositionFlow> flowOf(const Pass& pass) const {
        if (!pass.vertexShader) return PositionFlow{.placed = true};
        return positionFlow(rewriter_.code(), *pass.vertexShader, [&](const std::string& name) {
            const Parameter* parameter = adoption_.effect.findParameter(name);
            return parameter && parameter->type.base == BaseType::Float && isTargetSize(name, parameter->semantic);
        });
    }

    /// A pass whose vertices no matrix places gets the corners of the target as they are.
    [[nodiscard]] bool coversTarget(const Pass& pass) const {
        if (!pass.drawsGeometry()) return true;
        if (pass.vertexShader) return flow_ ? !flow_->placed : !rewriter_.readsMatrix(*pass.vertexShader);
        if (!pass.vertexShader && !pass.state.depthTest) return true; // what an application draws over the picture, as a rule
        const auto& global = adoption_.effect.standardsGlobal;
        return global && (global->scriptClass == "scene" || global->scriptOrder == "postprocess");
    }

    /// Front faces of the other handedness, and a buffer where the effect means one.
    static void place(Pass& pass, bool quad) {
        if (!quad) {
            pass.state.frontCounterClockwise = !pass.state.frontCounterClockwise;
            return;
        }
        pass.state.cull = CullMode::None;
        // Nothing lies in front of what covers the target, and the caller's depth may have another size.
        if (!pass.state.stencilTest && pass.state.depthCompare != CompareOp::Equal) pass.state.depthTest = pass.state.depthWrite = false;
        for (Command& command : pass.script.commands)
            if (command.kind == CommandKind::Draw) command.options = {"Buffer"};
        if (!pass.script.given) addDraw(pass, "Buffer");
    }

    static void addDraw(Pass& pass, const char* what) {
        pass.script.given = true;
        pass.script.commands.push_back({.kind = CommandKind::Draw, .options = {what}, .at = pass.at});
    }

    /// RenderMonkey's scripts set targets and never say Draw: its passes draw all the same.
    static void drawAtAll(Pass& pass) {
        const auto draws = [](const Command& command) { return command.kind == CommandKind::Draw; };
        if (pass.script.given && std::ranges::none_of(pass.script.commands, draws)) addDraw(pass, "Geometry");
    }

    /// A script that sets targets and names no pass: they run behind it.
    static void runPassesAtAll(Technique& technique) {
        const auto runs = [](const Command& command) {
            return command.kind == CommandKind::Pass || command.kind == CommandKind::ScriptExternal;
        };
        if (!technique.script.given || std::ranges::any_of(technique.script.commands, runs)) return;
        for (const Pass& pass : technique.passes)
            technique.script.commands.push_back({.kind = CommandKind::Pass, .options = {pass.name}, .at = technique.at});
    }

    /// To other hosts an empty name is the application's own target, whatever the technique has bound when the pass runs.
    static void nameCallersTargets(Pass& pass) {
        for (Command& command : pass.script.commands) {
            if (command.kind == CommandKind::RenderColorTarget && command.index == 0)
                std::ranges::replace(command.options, std::string(), kPicture);
            if (command.kind == CommandKind::RenderDepthStencilTarget) std::ranges::replace(command.options, std::string(), kPictureDepth);
        }
    }

    /// `CullMode = CW` in every pass that draws the mesh: its host winds front faces the other way, as modelling programs do. Outlines and
    /// shells have it in some of their passes only.
    void turnFaces(Technique& technique) {
        const auto flat = [](const Pass& pass) { return !pass.drawsGeometry(); };
        const auto inside = [&](const Pass& pass) { return flat(pass) || pass.state.cull == CullMode::Front; };
        if (technique.kind != TechniqueKind::D3D9 || std::ranges::all_of(technique.passes, flat) ||
            !std::ranges::all_of(technique.passes, inside))
            return;
        for (Pass& pass : technique.passes)
            if (!flat(pass)) pass.state.cull = CullMode::Back;
        adoption_.turned.insert(technique.name);
        note(adoption_, technique.at,
             fmt::format("technique {} leaves out clockwise faces in every pass: its host winds them the other way", technique.name));
    }

    [[nodiscard]] static bool drawable(const Technique& technique) {
        const auto stage = [](const std::optional<ShaderReference>& shader) { return shader && !shader->obstacle; };
        return !technique.passes.empty() && std::ranges::all_of(technique.passes, [&](const Pass& pass) {
            const bool later = pass.geometryShader || pass.computeShader || pass.hullShader || pass.domainShader || pass.streamOutput;
            return !later && stage(pass.vertexShader) && (!pass.pixelShader || stage(pass.pixelShader)) && pass.assemblyShaders == 0;
        });
    }

    /// MME has techniques for edges, shadows and depth besides the object's own; others hold what this host cannot draw. The first that
    /// shows the object wins.
    void chooseShown() {
        Effect& effect = adoption_.effect;
        const Technique* first = effect.defaultTechnique();
        const auto coloured = [](const Pass& pass) { return pass.pixelShader.has_value(); }; // others write depth alone
        const auto shows = [&](const Technique& technique) {
            return std::ranges::any_of(technique.passes, coloured) &&
                   toLower(technique.annotations.string("MMDPass").value_or("object")).starts_with("object") && drawable(technique);
        };
        if (!first || shows(*first)) return;
        auto better = std::ranges::find_if(effect.techniques, shows);
        if (better == effect.techniques.end() && drawable(*first)) return;
        if (better == effect.techniques.end()) better = std::ranges::find_if(effect.techniques, drawable);
        if (better == effect.techniques.end()) return;
        note(adoption_, better->at, fmt::format("technique {} is drawn where none is named, not {}", better->name, first->name));
        effect.shown = better->name;
        if (effect.standardsGlobal) effect.standardsGlobal->script = {};
    }

    /// Textures whose annotation Function names a function of the effect.
    void fillTextures() {
        Effect& effect = adoption_.effect;
        for (Parameter& parameter : effect.parameters) {
            if (!parameter.type.isTexture() || parameter.isTarget()) continue;
            const std::string function = fillingFunction(parameter, rewriter_);
            if (function.empty()) continue;
            const Pass pass = fillingPass(parameter, function, rewriter_);
            for (Technique& technique : effect.techniques)
                if (namesOf(technique).contains(parameter.name)) fillFirst(technique, parameter.name, pass);
            adoption_.bindings.push_back({.parameter = parameter.name, .source = "drawn by " + function, .rule = "Function"});
        }
    }

    void refuse(ShaderReference& shader, int code, std::string text) {
        shader.obstacle = std::make_shared<const Diagnostic>(
            Diagnostic{.severity = Severity::Error, .code = code, .at = shader.at, .text = std::move(text)});
    }

    std::optional<Wrapper> wrapperOf(ShaderReference& shader, bool vertex, const std::vector<Port>* available, const Pass& pass,
                                     bool covers = false) {
        const std::string name = vertex ? "tg_vertex" : "tg_pixel";
        WrapperJob job = rewriter_.job(shader, vertex, name);
        job.available = available;
        job.covers = covers || options_.direct3D9Centres;
        job.pixels = vertex && covers && flow_ && flow_->pixels;
        job.farthest = !vertex && pass.vertexShader && flow_ && flow_->farthest;
        job.fogs = pass.fogs;
        job.pass = vertex ? nullptr : &pass;
        job.saturates = onPicture_ && pass.state.targets[0].enable;
        auto made = rewriter_.wrapped(job);
        if (!made) {
            shader.obstacle = std::make_shared<const Diagnostic>(made.error().diagnostics.front());
            return std::nullopt;
        }
        shader.code = rewriter_.source(&shader, *made);
        if (const auto gone = goneWord(shader.code, rewriter_.code())) {
            refuse(shader, 3405, fmt::format("{} {}", shader.entry, *gone));
            shader.code.clear();
            return std::nullopt;
        }
        shader.original = shader.entry;
        shader.entry = name;
        shader.arguments.clear();
        return std::move(*made);
    }

    void standInVertex(Pass& pass, const std::optional<Wrapper>& pixel, bool quad) {
        const std::vector<Port> reads = pixel ? pixel->inputs : std::vector<Port>{{"COLOR0"}};
        const Wrapper made = plainVertexShader("tg_vertex", reads, quad);
        plain_ = plain_ || !quad;
        ShaderReference shader{.entry = "tg_vertex", .profile = "vs_3_0", .at = pass.at, .original = "none"};
        shader.code = rewriter_.source(nullptr, made);
        pass.vertexShader = std::move(shader);
        note(adoption_, pass.at,
             fmt::format("pass {} has no vertex shader: {}", pass.name,
                         quad ? "it covers the target" : "the mesh is placed by WORLDVIEWPROJECTION"));
    }

    void standInPixel(Pass& pass, const std::vector<Port>& written) {
        ShaderReference shader{.entry = "tg_pixel", .profile = "ps_3_0", .at = pass.at, .original = "none"};
        const bool coloured = std::ranges::find(written, "COLOR0", &Port::semantic) != written.end();
        shader.code = rewriter_.source(nullptr, plainPixelShader("tg_pixel", written, pass));
        pass.pixelShader = std::move(shader);
        note(adoption_, pass.at, fmt::format("pass {} has no pixel shader: it shows {}", pass.name, coloured ? "COLOR0" : "white"));
    }

    /// What a scene effect works on: the mesh in squares, with light from above.
    void addScene() {
        constexpr const char* kPixel = "void tg_pixel(float4 n : NORMAL0, float4 uv : TEXCOORD0, out float4 o : SV_Target0) {\n"
                                       " float2 s = floor(uv.xy * float2(16, 8)); float odd = fmod(s.x + s.y, 2);\n"
                                       " float l = 0.3 + 0.7 * saturate(dot(tg_normalize(n.xyz), float3(-0.27, 0.53, 0.8)));\n"
                                       " o = float4(lerp(float3(0.55, 0.5, 0.45), float3(0.85, 0.8, 0.75), odd) * l, 1);\n}\n";
        Pass pass{.name = kSceneTechnique};
        ShaderReference vertex{.entry = "tg_vertex", .profile = "vs_3_0", .original = "none"};
        vertex.code = rewriter_.source(nullptr, plainVertexShader("tg_vertex", {{"NORMAL0"}, {"TEXCOORD0"}}, false));
        ShaderReference pixel{.entry = "tg_pixel", .profile = "ps_3_0", .original = "none"};
        pixel.code = rewriter_.source(nullptr, Wrapper{.text = kPixel});
        pass.vertexShader = std::move(vertex);
        pass.pixelShader = std::move(pixel);
        pass.state.frontCounterClockwise = true;
        Technique scene{.name = kSceneTechnique};
        scene.passes.push_back(std::move(pass));
        adoption_.effect.techniques.push_back(std::move(scene));
        plain_ = true;
    }

    /// What the author's code does not declare.
    void addOwn(const char* name, Type type, const char* semantic) {
        adoption_.effect.parameters.push_back(
            {.name = name, .type = std::move(type), .semantic = semantic, .at = {.file = adoption_.effect.file.string()}});
    }

    void bind() {
        const std::set<std::string> negated = negatedNames(rewriter_.code());
        const auto signOf = [&](const std::string& name) {
            const int sign = directionSign(signs_, name);
            return sign != 0 ? sign : isNegated(negated, name) ? -1 : 0;
        };
        const std::set<std::string> shown = namesOfTechnique();
        adoption_.halfPixel = shown.contains(kTargetSize);
        for (Parameter& parameter : adoption_.effect.parameters) {
            if (parameter.isTarget() || parameter.hasSemantic(kStandardsGlobal)) continue;
            if (parameter.type.isTexture()) {
                bindTexture(parameter, shown);
            } else if (parameter.type.isNumeric()) {
                convertPixels(parameter);
                ParameterBinding bound = bindParameter(parameter, options_, signOf(parameter.name));
                if (shown.contains(parameter.name) && parameter.name != kTargetSize) adoption_.bindings.push_back(std::move(bound));
            }
        }
        turnMatrices();
    }

    /// Hosts that count in columns hand over transposes. What the user binds stays as he says.
    void turnMatrices() {
        const auto turns = [&](const Parameter& parameter) {
            return parameter.type.rows > 1 && !parameter.semantic.empty() && parameter.name != kPlainMatrix &&
                   !options_.bind.contains(parameter.name);
        };
        std::set<std::string> projections;
        for (const Parameter& parameter : adoption_.effect.parameters)
            if (turns(parameter) && parameter.semantic.find("PROJECTION") != std::string::npos) projections.insert(parameter.name);
        if (!multipliesColumns(rewriter_.code(), projections)) return;
        for (Parameter& parameter : adoption_.effect.parameters) {
            if (!turns(parameter)) continue;
            parameter.semantic = transposedSemantic(parameter.semantic);
            for (ParameterBinding& binding : adoption_.bindings)
                if (binding.parameter == parameter.name) binding.source += ", for columns";
        }
    }

    /// DXUT's samples give a kernel in pixels, and an array beside it that their program fills with the same in texels.
    void convertPixels(Parameter& parameter) const {
        const auto source = parameter.annotations.string("ConvertPixelsToTexels");
        const Parameter* pixels = source ? adoption_.effect.findParameter(*source) : nullptr;
        const auto* numbers = pixels && pixels->defaultValue ? std::get_if<std::vector<double>>(&*pixels->defaultValue) : nullptr;
        if (!numbers || pixels->type.columns != 2 || pixels->type.scalarCount() != parameter.type.scalarCount()) return;
        std::vector<double> texels = *numbers;
        for (std::size_t i = 0; i < texels.size(); ++i)
            texels[i] /= i % 2 == 0 ? options_.width : options_.height;
        parameter.defaultValue = std::move(texels);
    }

    void bindTexture(Parameter& parameter, const std::set<std::string>& shown) {
        if (parameter.annotations.find("Fallback") || parameter.annotations.find("Producer")) return;
        const auto volume = parameter.annotations.string("Procedure");
        std::string standIn = volume ? "noise in two dimensions: volumes are not loaded" : textureStandIn(parameter);
        std::string rule = "where no file is found";
        if (const auto asked = options_.bind.find(parameter.name); asked != options_.bind.end() && !volume) {
            const std::vector<std::string> known = bindChoices(parameter);
            const bool ours = std::ranges::find(known, toLower(asked->second)) != known.end();
            rule = ours ? "--bind" : fmt::format("--bind names no picture of this host: '{}'", asked->second);
            if (ours) {
                standIn = toLower(asked->second);
                parameter.semantic.clear(); // of the mesh's own pictures
                std::erase_if(parameter.annotations.list, [](const Annotation& a) { return equalsIgnoreCase(a.name, "ResourceName"); });
            }
        }
        if (!volume)
            parameter.annotations.list.push_back({"Procedure", {.base = BaseType::String, .name = "string"}, standIn, parameter.at, {}});
        if (shown.contains(parameter.name)) adoption_.bindings.push_back({.parameter = parameter.name, .source = standIn, .rule = rule});
    }

    /// The words of the sources that the technique in question is drawn with.
    [[nodiscard]] std::set<std::string> namesOfTechnique() const {
        const Effect& effect = adoption_.effect;
        const Technique* technique = options_.technique.empty() ? effect.defaultTechnique() : effect.findTechnique(options_.technique);
        return technique ? namesOf(*technique) : std::set<std::string>();
    }

    [[nodiscard]] static std::set<std::string> namesOf(const Technique& technique) {
        std::set<std::string> names;
        for (const Pass& pass : technique.passes)
            for (const auto* shader : {&pass.vertexShader, &pass.pixelShader}) {
                if (!*shader || (*shader)->code.empty()) continue;
                const std::string& code = (*shader)->code;
                const std::size_t ours = code.find(prelude()); // its names are not the author's
                const auto theirs = std::make_shared<const std::string>(
                    ours == std::string::npos ? code : code.substr(0, ours) + code.substr(ours + prelude().size()));
                Sources sources;
                for (const Token& token : lex(sources, sources.add("code", theirs)).tokens)
                    if (token.kind == TokenKind::Word) names.emplace(token.text);
            }
        return names;
    }

    Adoption adoption_;
    const AdoptOptions& options_;
    Rewriter rewriter_;
    std::set<std::pair<int, std::string>> said_;
    std::map<std::string, int> signs_; // addDirectionSigns()
    std::optional<PositionFlow> flow_; // of the pass in hand
    bool onPicture_ = false;           // drawsIntoPicture() of the technique in hand
    bool plain_ = false;               // something is placed by kPlainMatrix
    bool sized_ = false;               // something reads kTargetSize
};

} // namespace

} // namespace adopt

bool needsRespelling(const Effect& effect) {
    if (effect.ownDialect) return false;
    const auto structure = [](const Parameter& parameter) { return parameter.type.members != nullptr; };
    if (direct3D9Intrinsic(effect) || std::ranges::any_of(effect.parameters, structure)) return true;
    const auto old = [](const std::optional<ShaderReference>& shader) {
        return shader && (!shader->arguments.empty() || adopt::profileOf(shader->profile).direct3D9());
    };
    return std::ranges::any_of(effect.techniques, [&](const Technique& technique) {
        return std::ranges::any_of(technique.passes, [&](const Pass& pass) { return old(pass.vertexShader) || old(pass.pixelShader); });
    });
}

Adoption adopted(Effect effect, const AdoptOptions& options) {
    if (effect.ownDialect) return {.effect = std::move(effect)};
    return adopt::Adopter(std::move(effect), options).run();
}

} // namespace tegument
