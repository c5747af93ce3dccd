#include "tools/lsp/answers.h"

#include "host/effect/entry_points.h"
#include "host/effect/states.h"
#include "host/spirv/dxil.h"
#include "host/support/text.h"
#include "meshprep/adopt/adopt.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

namespace tegument::lsp {

namespace {

// Kinds of completions, as the protocol numbers them.
constexpr int kFunction = 3;
constexpr int kVariable = 6;
constexpr int kStruct = 22;
constexpr int kProperty = 10;
constexpr int kValue = 12;
constexpr int kKeyword = 14;

constexpr const char* kVertexSemantics[] = {
    "POSITION",         "NORMAL",     "TANGENT",       "BINORMAL",  "COLOR0",      "COLOR1",        "TEXCOORD0",      "TEXCOORD1",
    "TEXCOORD2",        "TEXCOORD3",  "TEXCOORD4",     "TEXCOORD5", "TEXCOORD6",   "TEXCOORD7",     "SV_Position",    "SV_Target0",
    "SV_Target1",       "SV_Target2", "SV_Target3",    "SV_Depth",  "SV_VertexID", "SV_InstanceID", "SV_IsFrontFace", "SV_DispatchThreadID",
    "SV_GroupThreadID", "SV_GroupID", "SV_GroupIndex", "DEPTH",     "VPOS",        "VFACE"};
constexpr const char* kShaders[] = {"VertexShader",         "PixelShader",       "GeometryShader",   "SetVertexShader",
                                    "SetPixelShader",       "SetGeometryShader", "SetComputeShader", "SetBlendState",
                                    "SetDepthStencilState", "SetRasterizerState"};
constexpr const char* kProfiles[] = {"compile vs_3_0", "compile ps_3_0", "compile vs_2_0", "compile ps_2_0"};

template <class Visit>
void eachState(bool sampler, const Visit& visit) {
    if (sampler)
        for (const auto& entry : samplerStateEntries())
            visit(entry.name, entry.vocabulary);
    else
        for (const auto& entry : direct3D9States())
            visit(entry.name, entry.vocabulary);
}

std::vector<std::string_view> valuesOf(const std::string& state, bool sampler) {
    std::vector<std::string_view> values;
    eachState(sampler, [&](std::string_view name, Vocabulary vocabulary) {
        if (!sameStateName(name, state) || !values.empty()) return;
        for (const NamedValue& value : vocabulary)
            values.push_back(value.name);
    });
    return values;
}

bool isSeen(const Declaration& declaration, const FileNames& file, const Question& question) {
    if (declaration.from == 0) return true;
    return &file == &question.files.front() && declaration.from <= question.line && question.line <= declaration.to;
}

/// The nearest before the cursor among locals, else the first of all.
const Declaration* declarationOf(const Question& question, const std::string& word) {
    const Declaration* best = nullptr;
    for (const FileNames& file : question.files)
        for (const Declaration& declaration : file.declarations) {
            if (declaration.name != word || !isSeen(declaration, file, question)) continue;
            if (!best || declaration.from > 0) best = &declaration;
        }
    return best;
}

std::optional<std::string> includeAt(const Question& question) {
    if (question.files.empty()) return std::nullopt;
    for (const auto& [line, name] : question.files.front().includes)
        if (line == question.line) return name;
    return std::nullopt;
}

std::string parameterText(const Parameter& parameter) {
    std::string text = fmt::format("```hlsl\n{} {}", parameter.type.name, parameter.name);
    if (parameter.type.elements > 0) text += fmt::format("[{}]", parameter.type.elements);
    if (!parameter.semantic.empty()) text += " : " + parameter.semantic;
    text += ";\n```\n";
    for (const char* annotation : {"SasUiDescription", "UIName", "SasUiLabel"})
        if (const auto said = parameter.annotations.string(annotation)) text += *said + "\n\n";
    return text;
}

std::string declaredText(const Question& question, const std::string& word, const Declaration* declaration) {
    if (question.effect)
        if (const Parameter* parameter = question.effect->findParameter(word)) return parameterText(*parameter);
    if (!declaration) return {};
    return fmt::format("```hlsl\n{}\n```\n{} of {}:{}\n\n", declaration->line, declaration->kind, declaration->at.file,
                       declaration->at.line);
}

std::string registerText(const Question& question, const std::string& word) {
    if (!question.compiled) return {};
    const auto found = question.compiled->registers.find(word);
    return found == question.compiled->registers.end() ? std::string() : fmt::format("registers: {}\n", fmt::join(found->second, ", "));
}

std::string stateText(const std::string& word, const Place& place) {
    std::string text;
    if (place.context != Context::PassState && place.context != Context::SamplerState) return text;
    eachState(place.context == Context::SamplerState, [&](std::string_view name, Vocabulary) {
        if (!text.empty() || !sameStateName(name, word)) return;
        const auto values = valuesOf(word, place.sampler);
        text =
            values.empty() ? fmt::format("state `{}`: a number\n", name) : fmt::format("state `{}`: {}\n", name, fmt::join(values, ", "));
    });
    return text;
}

class List {
public:
    void add(std::string_view label, int kind, std::string_view detail = {}) {
        if (label.empty() || !seen_.insert(std::string(label)).second) return;
        items_.push_back({{"label", label}, {"kind", kind}, {"detail", detail}});
    }
    Json take() { return std::move(items_); }

private:
    std::set<std::string> seen_;
    Json items_ = Json::array();
};

int kindOf(const Declaration& declaration) {
    if (declaration.kind == "function") return kFunction;
    return declaration.kind == "struct" ? kStruct : kVariable;
}

void addNames(List& list, const Question& question) {
    for (const FileNames& file : question.files)
        for (const Declaration& declaration : file.declarations)
            if (isSeen(declaration, file, question) && declaration.kind != "technique" && declaration.kind != "pass")
                list.add(declaration.name, kindOf(declaration), declaration.line);
}

void addSemantics(List& list, const Question& question, bool global) {
    if (global) {
        for (const std::string& semantic : question.semantics)
            list.add(semantic, kValue, "bound by the host");
        for (const std::string_view target : {kColorTarget, kDepthTarget, kStandardsGlobal})
            list.add(target, kValue);
        return;
    }
    for (const char* semantic : kVertexSemantics)
        list.add(semantic, kValue, "of a stage");
}

void addValues(List& list, const Question& question, const Place& place) {
    for (const std::string_view value : valuesOf(place.state, place.sampler))
        list.add(value, kValue, place.state);
    if (place.state.ends_with("Shader"))
        for (const char* profile : kProfiles)
            list.add(profile, kKeyword);
    if (place.state.ends_with("Shader") || place.sampler) addNames(list, question);
}

constexpr std::uint32_t kRegisterBytes = 16; // four floats

char letterOf(ResourceKind kind) {
    switch (kind) {
    case ResourceKind::Sampler:
    case ResourceKind::CompareSampler: return 's';
    case ResourceKind::StorageBuffer:
    case ResourceKind::StorageImage: return 'u';
    default: return 't';
    }
}

/// Constants lie as Direct3D lays them out: "c3", "c3.y to c4".
std::string constantOf(const BlockMember& member) {
    constexpr std::string_view kComponents = "xyzw";
    const std::uint32_t first = member.offset / kRegisterBytes;
    const std::uint32_t last = (member.offset + std::max(member.size, 1U) - 1) / kRegisterBytes;
    std::string text = fmt::format("c{}", first);
    if (member.offset % kRegisterBytes != 0) text += fmt::format(".{}", kComponents[member.offset % kRegisterBytes / 4]);
    return first == last ? text : text + fmt::format(" to c{}", last);
}

void addConstants(Compiled& compiled, const Reflection& reflection, const std::string& where) {
    if (!reflection.globals) return;
    for (const BlockMember& member : reflection.globals->members)
        if (member.used) compiled.registers[member.name].push_back(constantOf(member) + where);
}

void addResources(Compiled& compiled, const Reflection& reflection, const std::string& where) {
    for (const Resource& resource : reflection.resources)
        compiled.registers[resource.name].push_back(fmt::format("{}{}{}", letterOf(resource.kind), resource.binding, where));
}

void addOnce(std::vector<Diagnostic>& into, const std::vector<Diagnostic>& more) {
    for (const Diagnostic& one : more) {
        const auto same = [&](const Diagnostic& other) {
            return other.at.file == one.at.file && other.at.line == one.at.line && other.text == one.text;
        };
        if (std::ranges::none_of(into, same)) into.push_back(one);
    }
}

ShaderRequest requestOf(const Effect& effect, const ShaderUse& use) {
    const bool own = !use.shader->code.empty();
    return {.code = own ? use.shader->code : effect.code,
            .file = effect.file.string(),
            .entry = use.shader->entry,
            .stage = use.stage,
            .language2018 = own || effect.reshade};
}

/// What is said of an entry point that is drawn.
void addMessages(Compiled& compiled, const Effect& effect, const ShaderUse& use) {
    if (use.shader->obstacle) return addOnce(compiled.diagnostics, {*use.shader->obstacle});
    const auto shader = compileShader(requestOf(effect, use), defaultCompiler());
    if (shader) return addOnce(compiled.diagnostics, shader->warnings);
    std::vector<Diagnostic> failed = shader.error().diagnostics;
    for (Diagnostic& one : failed)
        if (one.at.line == 0) one.at = use.shader->at; // the validator knows no lines
    addOnce(compiled.diagnostics, failed);
}

/// Where the file's own parameters are in a shader of its own words.
void addRegisters(Compiled& compiled, const Effect& effect, const ShaderUse& use) {
    if (!use.shader->arguments.empty() || !use.shader->code.empty()) return;
    const ShaderRequest request = requestOf(effect, use);
    const auto shader = compileShader(request, defaultCompiler());
    if (!shader) return;
    const std::string where = " in " + use.shader->entry;
    addConstants(compiled, shader->reflection, where);
    if (defaultCompiler() != Compiler::Dxc) return; // SPIR-V's bindings are no registers
    if (const auto dxil = compileDxil(request)) addResources(compiled, dxil->reflection, where);
}

} // namespace

std::optional<SourcePosition> definition(const Question& question) {
    if (const auto name = includeAt(question)) {
        const auto path = question.include(*name);
        return path ? std::optional(SourcePosition{.file = *path, .line = 1, .column = 1}) : std::nullopt;
    }
    const std::string word = wordAt(lineOf(question.text, question.line), question.column);
    if (const Declaration* declaration = declarationOf(question, word); !word.empty() && declaration) return declaration->at;
    if (!question.effect) return std::nullopt; // what a macro declares is known once it is expanded
    if (const Parameter* parameter = question.effect->findParameter(word)) return parameter->at;
    const Sampler* sampler = question.effect->findSampler(word);
    return sampler ? std::optional(sampler->at) : std::nullopt;
}

std::optional<std::string> hover(const Question& question) {
    const std::string word = wordAt(lineOf(question.text, question.line), question.column);
    if (word.empty()) return std::nullopt;
    if (const std::string state = stateText(word, placeAt(question.text, question.line, question.column)); !state.empty()) return state;
    const std::string declared = declaredText(question, word, declarationOf(question, word));
    if (!declared.empty()) return declared + registerText(question, word);
    const auto semantic = std::ranges::find_if(question.semantics, [&](const std::string& name) { return equalsIgnoreCase(name, word); });
    if (semantic != question.semantics.end()) return fmt::format("semantic `{}`: bound by the host\n", *semantic);
    return std::nullopt;
}

Json completion(const Question& question) {
    List list;
    const Place place = placeAt(question.text, question.line, question.column);
    switch (place.context) {
    case Context::PassState:
    case Context::SamplerState:
        eachState(place.context == Context::SamplerState, [&](std::string_view name, Vocabulary) { list.add(name, kProperty, "state"); });
        if (place.context == Context::PassState)
            for (const char* shader : kShaders)
                list.add(shader, kProperty);
        break;
    case Context::Value: addValues(list, question, place); break;
    case Context::Semantic: addSemantics(list, question, place.global); break;
    case Context::Other: addNames(list, question); break;
    }
    return list.take();
}

Compiled compile(const Effect& effect) {
    Compiled compiled;
    if (!compilerAvailable(defaultCompiler())) return compiled;
    const bool adopts = !effect.ownDialect && defaultCompiler() == Compiler::Dxc;
    if (!adopts && direct3D9Intrinsic(effect)) return compiled;
    const Effect drawn = adopts ? adopted(effect).effect : Effect{};
    const Effect& said = adopts ? drawn : effect;
    for (const ShaderUse& use : entryPoints(said))
        if (!use.undrawn && (adopts || use.shader->arguments.empty())) addMessages(compiled, said, use);
    if (!direct3D9Intrinsic(effect))
        for (const ShaderUse& use : entryPoints(effect))
            if (!use.undrawn) addRegisters(compiled, effect, use);
    return compiled;
}

} // namespace tegument::lsp
