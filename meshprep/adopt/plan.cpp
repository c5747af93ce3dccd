// What an effect's declarations become: samplers, structures of parameters, names.

#include "meshprep/adopt/rewrite.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::adopt {

namespace {

BaseType textureBase(const std::string& kind) {
    return kind == "CUBE" ? BaseType::TextureCube : BaseType::Texture2D; // one dimension and three are drawn as two
}

/// Volumes are not loaded: noise stands in for all of them.
Annotation volumeNote(const SourcePosition& at) {
    return {"Procedure", {.base = BaseType::String, .name = "string"}, std::string("noise"), at, {}};
}

Parameter* find(Effect& effect, std::string_view name) {
    const auto found = std::ranges::find(effect.parameters, name, &Parameter::name);
    return found == effect.parameters.end() ? nullptr : &*found;
}

Sampler* findSampler(Effect& effect, std::string_view name) {
    const auto found = std::ranges::find(effect.samplers, name, &Sampler::name);
    return found == effect.samplers.end() ? nullptr : &*found;
}

std::string identifier(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '[' || c == '.'; }, '_');
    std::erase(text, ']');
    return text;
}

const std::vector<double>* numbersOf(const Parameter& parameter) {
    return parameter.defaultValue ? std::get_if<std::vector<double>>(&*parameter.defaultValue) : nullptr;
}

} // namespace

Rewriter::Rewriter(Effect& effect) : code_(readCode(effect.code)), uses_(usesOf(code_)) {
    planSamplers(effect);
    planStructures(effect);
    planLayers(effect);
    planNames(effect);
}

std::optional<std::string> Rewriter::kindOf(const Variable& variable) const {
    const bool read = uses_.samplers.contains(variable.name.text) && equalsIgnoreCase(variable.typeName(), "SamplerState");
    return read ? std::optional<std::string>("") : samplerKind(variable.typeName());
}

void Rewriter::planSamplers(Effect& effect) {
    for (const Item& item : code_.items) {
        const auto* variable = std::get_if<Variable>(&item);
        if (!variable || !kindOf(*variable)) continue;
        const std::string& name = variable->name.text;
        pairs_.insert(name);
        if (variable->array.empty()) {
            planSampler(effect, *variable, name);
            continue;
        }
        int count = 0;
        while (effect.findSampler(fmt::format("{}[{}]", name, count)))
            planSampler(effect, *variable, fmt::format("{}[{}]", name, count++));
        counts_[name] = count;
    }
}

void Rewriter::planSampler(Effect& effect, const Variable& variable, const std::string& name) {
    const std::string declared = *kindOf(variable);
    const auto used = uses_.samplers.find(variable.name.text);
    const std::string kind = !declared.empty() ? declared : used != uses_.samplers.end() ? used->second : "2D";
    Sampler* sampler = findSampler(effect, name);
    const SourcePosition at = sampler ? sampler->at : SourcePosition{.file = effect.file.string()};
    SamplerPlan plan{.kind = kind, .texture = textureFor(effect, sampler, name, kind, at), .state = "tg_state_" + identifier(name)};
    sampler = findSampler(effect, name); // textureFor() adds parameters, not samplers
    if (!sampler) sampler = &effect.samplers.emplace_back(Sampler{.name = name, .at = at});
    sampler->name = plan.state;
    sampler->texture = plan.texture;
    samplers_[name] = std::move(plan);
}

/// The texture's own name; another one where samplers of two kinds read it, or where the author names none.
std::string Rewriter::textureFor(Effect& effect, const Sampler* sampler, const std::string& name, const std::string& kind,
                                 const SourcePosition& at) {
    std::string texture = sampler ? sampler->texture : std::string();
    Parameter made{.name = texture, .type = {.base = textureBase(kind), .name = "texture"}, .at = at};
    if (const Parameter* own = effect.findParameter(texture); own && !texture.empty()) {
        const auto [known, first] = textureKinds_.try_emplace(texture, kind);
        if (first) find(effect, texture)->type.base = textureBase(kind);
        if (first && kind == "3D") find(effect, texture)->annotations.list.push_back(volumeNote(at));
        if (first || textureBase(known->second) == textureBase(kind)) return texture;
        made = *own;
        made.name = texture + "_" + kind;
        made.type.base = textureBase(kind);
    } else {
        made.name = identifier(name) + "_texture";
        if (sampler) made.annotations = sampler->annotations;
    }
    textureKinds_.try_emplace(made.name, kind);
    if (kind == "3D") made.annotations.list.push_back(volumeNote(at));
    if (!effect.findParameter(made.name)) effect.parameters.push_back(made);
    return made.name;
}

/// Layers and samples are not loaded: all of them are one picture.
void Rewriter::planLayers(Effect& effect) {
    for (const Item& item : code_.items) {
        const auto* variable = std::get_if<Variable>(&item);
        if (!variable || !variable->array.empty()) continue;
        const std::string& type = variable->typeName();
        if (type != "Texture2DArray" && type != "Texture2DMS" && type != "Texture2DMSArray") continue;
        const std::string name = variable->name.text + "_layer";
        layers_[variable->name.text] = name;
        effect.parameters.push_back(
            {.name = name, .type = {.base = BaseType::Texture2D, .name = "texture"}, .at = {.file = effect.file.string()}});
    }
}

void Rewriter::planStructures(Effect& effect) {
    std::vector<Parameter> added;
    const std::vector<Parameter> all = effect.parameters;
    for (const Parameter& parameter : all) {
        const Variable* variable = code_.variable(parameter.name);
        if (!parameter.type.members || !variable || variable->has("static")) continue;
        std::vector<LeafPlan> leaves;
        std::size_t next = 0;
        for (int i = 0; i < std::max(parameter.type.elements, 1); ++i) {
            const std::string path = parameter.name + (parameter.type.elements > 0 ? fmt::format("_{}", i) : "");
            Type element = parameter.type;
            element.elements = 0;
            planLeaves(effect, parameter, element, variable->type, path, next, leaves, 0);
        }
        structures_[parameter.name] = std::move(leaves);
        if (parameter.type.elements > 0) counts_[parameter.name] = parameter.type.elements;
    }
    std::erase_if(effect.parameters, [&](const Parameter& parameter) { return structures_.contains(parameter.name); });
}

void Rewriter::planLeaves(Effect& effect, const Parameter& whole, const Type& type, const Words& words, const std::string& path,
                          std::size_t& next, std::vector<LeafPlan>& leaves, int depth) {
    constexpr int kDeepest = 8;
    const Words resolved = code_.resolved(words);
    const Structure* structure = code_.structure(resolved.front().text);
    if (type.members && structure && depth < kDeepest) {
        for (int i = 0; i < std::max(type.elements, 1); ++i)
            for (std::size_t m = 0; m < std::min(type.members->size(), structure->members.size()); ++m) {
                const TypeMember& member = (*type.members)[m];
                const std::string inner = type.elements > 0 ? fmt::format("{}_{}", path, i) : path;
                planLeaves(effect, whole, member.type, structure->members[m].type, inner + "_" + member.name, next, leaves, depth + 1);
            }
        return;
    }
    if (!type.isNumeric()) return;
    LeafPlan leaf{.name = path, .type = resolved};
    if (type.elements > 0) leaf.array = {Word{.text = fmt::format("[{}]", type.elements)}};
    Parameter made{.name = path, .type = type, .annotations = whole.annotations, .at = whole.at};
    for (Annotation& annotation : made.annotations.list) // of the whole: "Sas.PointLight[0]" and its ".Position"
        if (auto* address = std::get_if<std::string>(&annotation.value); address && equalsIgnoreCase(annotation.name, "SasBindAddress"))
            *address += "." + path.substr(path.rfind('_') + 1);
    const auto count = static_cast<std::size_t>(type.scalarCount());
    if (const auto* numbers = numbersOf(whole); numbers && next + count <= numbers->size())
        made.defaultValue = std::vector<double>(numbers->begin() + static_cast<std::ptrdiff_t>(next),
                                                numbers->begin() + static_cast<std::ptrdiff_t>(next + count));
    next += count;
    leaves.push_back(std::move(leaf));
    effect.parameters.push_back(std::move(made));
}

void Rewriter::planNames(Effect& effect) {
    for (Parameter& parameter : effect.parameters) {
        const Variable* variable = code_.variable(parameter.name);
        if (parameter.type.elements > 0) counts_[parameter.name] = parameter.type.elements;
        if (!variable || !parameter.type.isNumeric()) continue;
        const auto* numbers = numbersOf(parameter);
        if (uses_.sizes.contains(parameter.name) && numbers && numbers->size() == 1 && parameter.type.base != BaseType::Float)
            sizes_[parameter.name] = fmt::format("{:.0f}", (*numbers)[0]);
        else if (uses_.written.contains(parameter.name))
            renamed_[parameter.name] = "tg_own_" + parameter.name;
        if (isReserved(parameter.name)) parameter.name += '_';
    }
}

} // namespace tegument::adopt
