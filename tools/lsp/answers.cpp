#include "tools/lsp/answers.h"

#include "host/effect/states.h"
#include "host/support/text.h"

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
constexpr const char* kTargets[] = {"RENDERCOLORTARGET", "RENDERDEPTHSTENCILTARGET", "STANDARDSGLOBAL"};
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
        for (const char* target : kTargets)
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

} // namespace

std::optional<SourcePosition> definition(const Question& question) {
    if (const auto name = includeAt(question)) {
        const auto path = question.include(*name);
        return path ? std::optional(SourcePosition{.file = *path, .line = 1, .column = 1, .byte = {}}) : std::nullopt;
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

} // namespace tegument::lsp
