#include "host/effect/load.h"

#include "host/effect/code_view.h"
#include "host/effect/formats.h"
#include "host/effect/parser.h"
#include "host/effect/reshade.h"
#include "host/support/kept_inputs.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace tegument {

namespace {

enum class AnnotationKind { String, Number };

/// Annotations with a meaning, and how many numbers they take.
struct KnownAnnotation {
    std::string_view name;
    AnnotationKind kind;
    std::size_t least = 1;
    std::size_t most = 1;
};

constexpr AnnotationKind kText = AnnotationKind::String;
constexpr AnnotationKind kNumber = AnnotationKind::Number;

constexpr std::array<KnownAnnotation, 45> kAnnotations{{
    {"Script", kText},
    {"ScriptClass", kText},
    {"ScriptOrder", kText},
    {"ScriptOutput", kText},
    {"UIName", kText},
    {"UIWidget", kText},
    {"UIHelp", kText},
    {"UIGroup", kText},
    {"UIMin", kNumber, 1, 16},
    {"UIMax", kNumber, 1, 16},
    {"UIStep", kNumber, 1, 16},
    {"UIVisible", kNumber},
    {"ResourceName", kText},
    {"ResourceType", kText},
    {"TextureType", kText},
    {"Format", kText},
    {"Width", kNumber},
    {"Height", kNumber},
    {"Depth", kNumber},
    {"MipLevels", kNumber},
    {"Levels", kNumber},
    {"AntiAlias", kNumber},
    {"Function", kText},
    {"Target", kText},
    {"Object", kText},
    {"Space", kText},
    {"Units", kText},
    {"Usage", kText},
    {"Normalize", kNumber},
    {"Instances", kText},
    {"Part", kText},
    {"Stores", kText},
    {"Threads", kText},
    {"Viewport", kText},
    {"Groups", kNumber, 1, 3},
    {"GroupCount", kText},
    {"Producer", kText},
    {"ColorSpace", kText},
    {"Metadata", kText},
    {"Formerly", kText},
    {"Fallback", kNumber, 4, 4},
    {"ViewportRatio", kNumber, 2, 2},
    {"Dimensions", kNumber, 2, 3},
    {"SasUiLabel", kText},
    {"SasUiDescription", kText},
}};

class Checker {
public:
    Checker(Parsed& parsed, bool lenient) : parsed_(parsed), effect_(parsed.effect), lenient_(lenient) {}

    void run() {
        uniqueNames(effect_.parameters, "parameter");
        uniqueNames(effect_.samplers, "sampler");
        uniqueNames(effect_.techniques, "technique");
        namesApart();
        for (const Parameter& parameter : effect_.parameters)
            annotations(parameter.annotations);
        samplers();
        storages();
        textureKinds();
        halves();
        globalScript();
        for (Technique& technique : effect_.techniques)
            this->technique(technique);
    }

private:
    /// An error; where reading is lenient a warning.
    void refuse(int code, const SourcePosition& at, std::string text, std::string hint = {}) {
        if (!lenient_) return fail(code, at, std::move(text), std::move(hint));
        effect_.warnings.push_back(inputWarning(code, at, std::move(text), std::move(hint)));
    }

    void fail(int code, const SourcePosition& at, std::string text, std::string hint = {}) {
        if (parsed_.errors.size() < 20)
            parsed_.errors.push_back({.code = code, .at = at, .text = std::move(text), .hint = std::move(hint)});
    }

    template <class T>
    void uniqueNames(const std::vector<T>& list, std::string_view what, bool soft = false) {
        std::map<std::string, const T*> seen;
        for (const T& item : list) {
            if (item.name.empty()) continue;
            const auto [first, isNew] = seen.emplace(item.name, &item);
            if (isNew) continue;
            std::string text = fmt::format("{} '{}' is declared twice", what, item.name);
            std::string hint = fmt::format("the first is in line {}", first->second->at.line);
            soft ? refuse(2015, item.at, std::move(text), std::move(hint)) : fail(2015, item.at, std::move(text), std::move(hint));
        }
    }

    /// Parameters, samplers and techniques have their names in common; what is declared first keeps it.
    void namesApart() {
        std::map<std::string_view, std::string_view> kinds;
        for (const Parameter& parameter : effect_.parameters)
            kinds.emplace(parameter.name, "parameter");
        for (const std::string& function : parsed_.functions)
            if (!kinds.emplace(function, "function").second)
                refuse(2015, effect_.findParameter(function)->at, fmt::format("parameter '{}' has the name of a function", function));
        const auto add = [&](const auto& list, std::string_view what) {
            for (const auto& item : list) {
                const auto [other, isNew] = kinds.emplace(item.name, what);
                if (!isNew && other->second != what && !item.name.empty())
                    refuse(2015, item.at, fmt::format("{} '{}' has the name of a {}", what, item.name, other->second));
            }
        };
        add(effect_.samplers, "sampler");
        add(effect_.techniques, "technique");
    }

    void annotations(const Annotations& annotations) {
        for (const Annotation& annotation : annotations.list) {
            const auto known = std::ranges::find_if(kAnnotations, [&](const auto& k) { return equalsIgnoreCase(k.name, annotation.name); });
            if (known != kAnnotations.end()) typed(annotation, *known);
        }
        oneOf(annotations, "ScriptClass", {"object", "scene", "sceneorobject"});
        oneOf(annotations, "ScriptOrder", {"standard", "preprocess", "postprocess"});
        oneOf(annotations, "ScriptOutput", {"color"});
        for (const std::string_view name : {"ResourceType", "TextureType"})
            oneOf(annotations, name, {"1D", "2D", "3D", "Volume", "Cube", "RenderTarget"});
        oneOf(annotations, "ColorSpace", {"sRGB", "linear"});
        const Annotation* format = annotations.find("Format");
        const auto* text = format != nullptr ? std::get_if<std::string>(&format->value) : nullptr;
        if (text != nullptr && !canonicalFormat(*text))
            refuse(2016, format->at, fmt::format("unknown format '{}'", *text), didYouMean(*text, formatNames()));
    }

    void typed(const Annotation& annotation, const KnownAnnotation& known) {
        const auto* numbers = std::get_if<std::vector<double>>(&annotation.value);
        if (known.kind == kText && numbers != nullptr)
            return refuse(2017, annotation.at, fmt::format("annotation {} is a string", known.name));
        if (known.kind == kText) return;
        if (numbers != nullptr && numbers->size() >= known.least && numbers->size() <= known.most) return;
        const std::string count = known.most == 1             ? "one number"
                                  : known.least == known.most ? fmt::format("{} numbers", known.most)
                                                              : fmt::format("{} to {} numbers", known.least, known.most);
        refuse(2017, annotation.at, fmt::format("annotation {} takes {}", known.name, count));
    }

    void oneOf(const Annotations& annotations, std::string_view name, std::initializer_list<std::string_view> values) {
        const std::optional<std::string> value = annotations.string(name);
        if (!value) return;
        std::vector<std::string> names(values.begin(), values.end());
        for (const std::string& allowed : names)
            if (equalsIgnoreCase(allowed, *value)) return;
        std::string hint = didYouMean(*value, names);
        if (hint.empty())
            for (const std::string& allowed : names)
                hint += (hint.empty() ? "one of " : ", ") + allowed;
        refuse(2018, annotations.find(name)->at, fmt::format("'{}' is not a value of {}", *value, name), hint);
    }

    /// What the name of a parameter may be corrected to.
    [[nodiscard]] std::vector<std::string> parameterNames(bool textures) const {
        std::vector<std::string> names;
        for (const Parameter& parameter : effect_.parameters)
            if (parameter.type.isTexture() == textures) names.push_back(parameter.name);
        return names;
    }

    [[nodiscard]] Parameter* parameter(std::string_view name) const {
        for (Parameter& candidate : effect_.parameters)
            if (equalsIgnoreCase(candidate.name, name)) return &candidate;
        return nullptr;
    }

    /// Sampler gSkin reads texture gSkinMap where its block names none.
    void samplers() {
        for (const auto& [name, at, bracket] : parsed_.textureReferences) {
            const std::string whole = name.substr(0, name.find('[')); // an element of an array of textures
            const Parameter* texture = effect_.findParameter(whole);
            if (parsed_.otherTextures.contains(whole)) continue;
            if (texture == nullptr && bracket) // MonoGame's compiler takes it: what draws sprites sets it
                refuse(2012, at, fmt::format("unknown texture '{}'", name), didYouMean(name, parameterNames(true)));
            else if (texture == nullptr)
                fail(2012, at, fmt::format("unknown texture '{}'", name), didYouMean(name, parameterNames(true)));
            if (texture != nullptr && !texture->type.isTexture())
                refuse(2014, at, fmt::format("'{}' is a {}, not a texture", name, texture->type.name));
        }
        for (Sampler& sampler : effect_.samplers) {
            if (effect_.findParameter(sampler.texture) == nullptr) sampler.texture = sampler.texture.substr(0, sampler.texture.find('['));
            if (parsed_.otherTextures.contains(sampler.texture)) sampler.texture.clear();
            const Parameter* conventional = effect_.findParameter(sampler.name + "Map");
            if (sampler.texture.empty() && conventional != nullptr && conventional->type.isTexture()) sampler.texture = conventional->name;
        }
    }

    /// d3dcompiler_47 takes no global half with a shader (X3650) but by its flag for backwards compatibility, and no double with one of
    /// Direct3D 9.
    void halves() {
        const auto drawn = [&](bool direct3D9) {
            return std::ranges::any_of(effect_.techniques, [&](const Technique& technique) {
                return (!direct3D9 || technique.kind == TechniqueKind::D3D9) &&
                       std::ranges::any_of(technique.passes, [](const Pass& pass) { return pass.vertexShader || pass.pixelShader; });
            });
        };
        for (const Parameter& parameter : effect_.parameters) {
            const bool isDouble = parameter.type.name.starts_with("double");
            if (!parameter.type.isNumeric() || !(isDouble || parameter.type.name.starts_with("half")) || !drawn(isDouble)) continue;
            return refuse(2025, parameter.at, fmt::format("'{}' is a global {}", parameter.name, parameter.type.name), "write float");
        }
    }

    /// RWTexture2D gBaseStore writes target gBaseMap where it names no other. Effects from elsewhere may have some that no target stands
    /// behind.
    void storages() {
        constexpr std::string_view kEnding = "Store";
        for (StorageTexture& storage : effect_.storages) {
            annotations(storage.annotations);
            if (auto named = storage.annotations.string("Stores")) {
                target(*named, kColorTarget, storage.annotations.find("Stores")->at);
                storage.target = *named;
            } else if (storage.name.ends_with(kEnding)) {
                const std::string map = storage.name.substr(0, storage.name.size() - kEnding.size()) + "Map";
                const Parameter* conventional = effect_.findParameter(map);
                if (conventional != nullptr && conventional->hasSemantic(kColorTarget)) storage.target = map;
            }
        }
    }

    /// `texture t;` says nothing of its dimension: its annotation does, else the sampler that reads it.
    void textureKinds() {
        for (const Sampler& sampler : effect_.samplers) {
            Parameter* texture = parameter(sampler.texture);
            if (texture == nullptr) continue;
            if (const auto dimension = parsed_.samplerDimensions.find(sampler.name); dimension != parsed_.samplerDimensions.end())
                setDimension(*texture, dimension->second);
            if (parsed_.srgbSamplers.contains(sampler.name) && texture->annotations.find("ColorSpace") == nullptr)
                texture->annotations.list.push_back(
                    {"ColorSpace", {.base = BaseType::String, .name = "string"}, std::string("sRGB"), sampler.at, {}});
        }
        for (Parameter& texture : effect_.parameters) {
            const std::string kind =
                toLower(texture.annotations.string("ResourceType").value_or(texture.annotations.string("TextureType").value_or("")));
            setDimension(texture, kind == "1d" ? 1 : kind == "2d" ? 2 : kind == "3d" || kind == "volume" ? 3 : kind == "cube" ? 6 : 0);
        }
    }

    static void setDimension(Parameter& texture, int dimension) {
        if (!equalsIgnoreCase(texture.type.name, "texture")) return;
        if (dimension == 1) texture.type.base = BaseType::Texture1D;
        if (dimension == 2) texture.type.base = BaseType::Texture2D;
        if (dimension == 3) texture.type.base = BaseType::Texture3D;
        if (dimension == 6) texture.type.base = BaseType::TextureCube;
    }

    void globalScript() {
        for (const Parameter& parameter : effect_.parameters) {
            if (!parameter.hasSemantic(kStandardsGlobal)) continue;
            if (effect_.standardsGlobal) return refuse(2015, parameter.at, "a second STANDARDSGLOBAL parameter");
            StandardsGlobal global{.name = parameter.name, .annotations = parameter.annotations, .at = parameter.at};
            const auto* version = parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
            if (version != nullptr) global.version = (*version)[0];
            global.scriptClass = toLower(parameter.annotations.string("ScriptClass").value_or(global.scriptClass));
            global.scriptOrder = toLower(parameter.annotations.string("ScriptOrder").value_or(global.scriptOrder));
            global.scriptOutput = toLower(parameter.annotations.string("ScriptOutput").value_or(global.scriptOutput));
            global.script = script(parameter.annotations, ScriptLevel::Global, nullptr);
            effect_.standardsGlobal = std::move(global);
        }
    }

    void technique(Technique& technique) {
        annotations(technique.annotations);
        uniqueNames(technique.passes, "pass", true);
        technique.script = script(technique.annotations, ScriptLevel::Technique, &technique);
        for (Pass& pass : technique.passes) {
            annotations(pass.annotations);
            pass.script = script(pass.annotations, ScriptLevel::Pass, &technique);
            for (const auto* shader : {&pass.vertexShader, &pass.pixelShader, &pass.geometryShader, &pass.computeShader})
                if (*shader) function(**shader);
            namedNumbers(pass);
            dispatch(pass);
        }
    }

    /// The names of parameters in a pass's annotations get the spelling of their declaration, like those in scripts.
    void namedNumbers(Pass& pass) {
        for (Annotation& annotation : pass.annotations.list)
            if (auto* name = std::get_if<std::string>(&annotation.value); name != nullptr && equalsIgnoreCase(annotation.name, "Instances"))
                scalar(*name, annotation.at);
    }

    /// How many threads: names get the spelling of their declaration. A pass either draws or computes.
    void dispatch(Pass& pass) {
        for (Annotation& annotation : pass.annotations.list) {
            auto* name = std::get_if<std::string>(&annotation.value);
            if (name == nullptr) continue;
            if (equalsIgnoreCase(annotation.name, "Threads")) target(*name, kColorTarget, annotation.at);
            if (equalsIgnoreCase(annotation.name, "Viewport") && !name->empty()) target(*name, kColorTarget, annotation.at);
            if (equalsIgnoreCase(annotation.name, "GroupCount")) numeric(*name, annotation.at);
        }
        if (pass.computeShader && (pass.vertexShader || pass.pixelShader))
            fail(2024, pass.at, fmt::format("pass {} has a compute shader beside one that draws", pass.name), "write two passes");
        for (const Command& command : pass.script.commands)
            if (command.kind == CommandKind::Draw && (command.options[0] == "Compute") != pass.computeShader.has_value())
                fail(2024, command.at,
                     fmt::format("pass {} has {} compute shader, and its script says Draw={}", pass.name, pass.computeShader ? "a" : "no",
                                 command.options[0]),
                     "Draw=Compute for a compute shader, Draw=Geometry or Draw=Buffer for the others");
    }

    void function(const ShaderReference& shader) {
        if (parsed_.functions.contains(shader.entry)) return;
        const std::vector<std::string> names(parsed_.functions.begin(), parsed_.functions.end());
        fail(2022, shader.at, fmt::format("unknown function '{}'", shader.entry), didYouMean(shader.entry, names));
    }

    Script script(const Annotations& annotations, ScriptLevel level, const Technique* technique) {
        const Annotation* annotation = annotations.find("Script");
        const auto* text = annotation != nullptr ? std::get_if<std::string>(&annotation->value) : nullptr;
        if (text == nullptr) return {};
        Result<ScriptResult> parsed = parseScript(*text, level, annotation->pieces, lenient_);
        if (!parsed) {
            for (const Diagnostic& diagnostic : parsed.error().diagnostics)
                fail(diagnostic.code, diagnostic.at, diagnostic.text, diagnostic.hint);
            return {};
        }
        effect_.warnings.insert(effect_.warnings.end(), parsed->warnings.begin(), parsed->warnings.end());
        bool loops = true;
        for (Command& command : parsed->script.commands)
            if (!this->command(command, technique)) {
                loops = loops && command.kind != CommandKind::LoopByCount;
                drop(command);
            }
        for (Command& command : parsed->script.commands) // what is inside a loop without a count runs once
            if (!loops && isLoop(command.kind)) drop(command);
        return std::move(parsed->script);
    }

    static bool isLoop(CommandKind kind) {
        return kind == CommandKind::LoopByCount || kind == CommandKind::LoopEnd || kind == CommandKind::LoopGetIndex ||
               kind == CommandKind::LoopGetCount;
    }

    /// In its place nothing happens.
    static void drop(Command& command) {
        command.kind = CommandKind::Reserved;
        command.options.clear();
        command.selector.clear();
    }

    /// False: the command names what is not there, which has been said.
    bool command(Command& command, const Technique* technique) {
        const std::size_t said = parsed_.errors.size() + effect_.warnings.size();
        if (!command.selector.empty()) selector(command);
        for (std::string& option : command.options) {
            switch (command.kind) {
            case CommandKind::Technique: techniqueName(option, command.at); break;
            case CommandKind::Pass: passName(option, *technique, command.at); break;
            case CommandKind::RenderColorTarget: target(option, kColorTarget, command.at); break;
            case CommandKind::RenderDepthStencilTarget: target(option, kDepthTarget, command.at); break;
            case CommandKind::ClearSetColor: color(option, command.at); break;
            case CommandKind::ClearSetDepth:
            case CommandKind::ClearSetStencil:
            case CommandKind::LoopByCount:
            case CommandKind::LoopGetIndex:
            case CommandKind::LoopGetCount: scalar(option, command.at); break;
            default: break;
            }
        }
        return !lenient_ || said == parsed_.errors.size() + effect_.warnings.size();
    }

    /// FX Composer writes a label in front of the choice: `Technique=Technique?A:B;` is A until somebody turns it.
    void selector(Command& command) {
        if (lenient_ && parameter(command.selector) == nullptr) {
            command.selector.clear();
            command.options.resize(1);
            return;
        }
        const Parameter* parameter = scalar(command.selector, command.at);
        if (parameter != nullptr && parameter->type.base == BaseType::Bool && command.options.size() != 2)
            refuse(2008, command.at, fmt::format("bool '{}' chooses between two options, not {}", parameter->name, command.options.size()));
    }

    void techniqueName(std::string& name, const SourcePosition& at) {
        if (const Technique* technique = effect_.findTechnique(name)) {
            name = technique->name;
            return;
        }
        std::vector<std::string> names;
        for (const Technique& technique : effect_.techniques)
            names.push_back(technique.name);
        refuse(2010, at, fmt::format("unknown technique '{}'", name), didYouMean(name, names));
    }

    void passName(std::string& name, const Technique& technique, const SourcePosition& at) {
        if (const Pass* pass = technique.findPass(name)) {
            name = pass->name;
            return;
        }
        std::vector<std::string> names;
        for (const Pass& pass : technique.passes)
            names.push_back(pass.name);
        refuse(2011, at, fmt::format("technique '{}' has no pass '{}'", technique.name, name), didYouMean(name, names));
    }

    void target(std::string& name, std::string_view semantic, const SourcePosition& at) {
        if (name.empty()) return;
        const Parameter* texture = parameter(name);
        if (texture == nullptr) return refuse(2012, at, fmt::format("unknown texture '{}'", name), didYouMean(name, parameterNames(true)));
        name = texture->name;
        if (!texture->type.isTexture()) return refuse(2014, at, fmt::format("'{}' is a {}, not a texture", name, texture->type.name));
        if (!texture->hasSemantic(semantic))
            refuse(2014, at, fmt::format("texture '{}' is not declared as a target", name),
                   fmt::format("declare it with ': {}'", semantic));
    }

    const Parameter* numeric(std::string& name, const SourcePosition& at) {
        const Parameter* found = parameter(name);
        if (found == nullptr) {
            refuse(2013, at, fmt::format("unknown parameter '{}'", name), didYouMean(name, parameterNames(false)));
            return nullptr;
        }
        name = found->name;
        return found;
    }

    const Parameter* scalar(std::string& name, const SourcePosition& at) {
        const Parameter* found = numeric(name, at);
        if (found == nullptr || (found->type.isNumeric() && found->type.scalarCount() == 1)) return found;
        refuse(2014, at, fmt::format("'{}' is a {}; one number is needed here", name, found->type.name));
        return nullptr;
    }

    void color(std::string& name, const SourcePosition& at) {
        const Parameter* found = numeric(name, at);
        if (found == nullptr || (found->type.isNumeric() && found->type.scalarCount() == 4)) return;
        refuse(2014, at, fmt::format("'{}' is a {}; ClearSetColor needs a float4", name, found->type.name));
    }

    Parsed& parsed_;
    Effect& effect_;
    bool lenient_;
};

/// Parses the scripts into the model, resolves every name (script names get the spelling of their declaration), appends to parsed.errors.
/// `lenient`: what only a host of DXSAS would refuse is a warning; a script's command that cannot be is dropped.
void checkEffect(Parsed& parsed, bool lenient) {
    Checker(parsed, lenient).run();
}

constexpr std::size_t kMostWarnings = 100;

/// How files are read, and where one that is missing lies.
struct Access {
    FileReader read;
    IncludeSearch search = {};
};

Access accessTo(const std::filesystem::path& file, const Roots& roots) {
    return {.read = confinedReader(file, roots), .search = [=](const std::string& name) { return folderOfInclude(name, file, roots); }};
}

Error quoted(Error error, const Sources& sources) {
    for (Diagnostic& diagnostic : error.diagnostics)
        quote(diagnostic, sources);
    return error;
}

/// After these, names may be missing that the file does declare: a check would report what is no error.
bool losesDeclarations(const Diagnostic& diagnostic) {
    return diagnostic.code >= 1101 && diagnostic.code <= 1103;
}

Result<Preprocessed> view(const std::filesystem::path& file, const LoadOptions& options, const Access& access, Sources& sources,
                          std::pair<std::string, std::string> define) {
    PreprocessOptions preprocessing{.defines = options.defines,
                                    .includeFolders = options.includeFolders,
                                    .read = access.read,
                                    .search = access.search,
                                    .anyCase = options.lenient};
    preprocessing.defines.push_back(std::move(define));
    auto plain = preprocess(file, preprocessing, sources);
    const auto techniques = [](const Token& token) { return equalsIgnoreCase(token.text.substr(0, 9), "technique"); };
    if (plain && (plain->ownDialect || (std::ranges::any_of(plain->tokens, techniques) && !isReshade(plain->tokens)))) return plain;
    defineReshade(preprocessing.defines);
    auto theirs = preprocess(file, preprocessing, sources);
    if (!theirs || !isReshade(theirs->tokens)) return plain;
    theirs->reshade = theirs->ownDialect = true;
    const auto rewritten = rewriteReshade(file, preprocessing, *theirs, sources);
    return rewritten ? theirs : rewritten.error();
}

/// The plain HLSL. Its own errors matter only if the metadata view had none; they come from `#ifdef FX_ENTRY` branches.
Result<void> addCode(Effect& effect, const LoadOptions& options, const Access& access) {
    Sources sources;
    const Result<Preprocessed> code = view(effect.file, options, access, sources, {"FX_ENTRY", "1"});
    if (!code) return quoted(code.error(), sources);
    const Parsed parsed = Parser(sources, code->tokens, options.lenient && (!code->ownDialect || code->reshade)).run();
    if (!parsed.errors.empty()) return quoted({Blame::Input, parsed.errors}, sources);
    effect.code = codeView(*code, sources, parsed.blanks) + parsed.assembled;
    for (const std::filesystem::path& include : code->includes)
        if (std::ranges::find(effect.includes, include) == effect.includes.end()) effect.includes.push_back(include);
    return {};
}

/// The setting asked for as a definition of its switch. The preprocessor alone finds which that is.
Result<LoadOptions> withSetting(const std::filesystem::path& file, LoadOptions options, const Access& access) {
    if (options.setting.empty()) return options;
    Sources sources;
    const Result<Preprocessed> plain = view(file, options, access, sources, {"FX_D3D11", "1"});
    if (!plain) return quoted(plain.error(), sources);
    const std::vector<std::string> names = plain->settings ? plain->settings->names : std::vector<std::string>();
    const auto found = std::ranges::find(names, options.setting);
    if (found == names.end())
        return usageError(4051, fmt::format("{} has no setting '{}'", file.string(), options.setting),
                          names.empty() ? "it has none at all: no FX_SETTINGS" : fmt::format("{}", fmt::join(names, ", ")));
    options.defines.emplace_back(plain->settings->define, std::to_string(found - names.begin()));
    options.setting.clear();
    return options;
}

Result<Effect> load(const std::filesystem::path& file, const LoadOptions& options, const Access& access, const char* target) {
    Sources sources;
    Result<Preprocessed> metadata = view(file, options, access, sources, {target, "1"});
    if (!metadata) return quoted(metadata.error(), sources);
    const bool lenient = options.lenient && (!metadata->ownDialect || metadata->reshade);
    Parsed parsed = Parser(sources, metadata->tokens, lenient).run();
    if (std::ranges::none_of(parsed.errors, losesDeclarations)) checkEffect(parsed, lenient);
    if (!parsed.errors.empty()) return quoted({Blame::Input, std::move(parsed.errors)}, sources);

    Effect effect = std::move(parsed.effect);
    effect.file = file;
    effect.defines = options.defines;
    effect.includeFolders = options.includeFolders;
    effect.roots.anywhere = true;
    effect.includes = metadata->includes;
    effect.ownDialect = metadata->ownDialect;
    effect.reshade = effect.displayColours = effect.direct3D9Targets = metadata->reshade;
    effect.settings = std::move(metadata->settings);
    effect.metadata = std::move(metadata->metadata);
    effect.warnings.insert(effect.warnings.begin(), metadata->warnings.begin(), metadata->warnings.end());
    effect.warnings.resize(std::min(effect.warnings.size(), kMostWarnings));
    for (Diagnostic& warning : effect.warnings)
        quote(warning, sources);
    if (Result<void> code = addCode(effect, options, access); !code) return code.error();
    return effect;
}

Result<Effect> loadFrom(const std::filesystem::path& file, const LoadOptions& options, const Access& access, const char* target) {
    const auto chosen = withSetting(file, options, access);
    return chosen ? load(file, *chosen, access, target) : chosen.error();
}

} // namespace

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options, const FileReader& read) {
    return loadFrom(file, options, {.read = read}, "FX_D3D11");
}

Result<Effect> loadEffect(const std::filesystem::path& file, const LoadOptions& options) {
    Roots roots = rootsOfEffect(file, options.includeFolders, options.roots);
    auto effect = loadFrom(file, options, accessTo(file, roots), "FX_D3D11");
    if (!effect) // an include that is to be written counts as one that is not there
        if (const auto kept = inputsAreKept(); !kept) return kept.error();
    if (effect) effect->roots = std::move(roots);
    return effect;
}

Result<Effect> loadEffectOfDirect3D9(const std::filesystem::path& file, const LoadOptions& options) {
    return loadFrom(file, options, accessTo(file, rootsOfEffect(file, options.includeFolders, options.roots)), "FX_D3D9");
}

} // namespace tegument
