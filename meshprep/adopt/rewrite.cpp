#include "meshprep/adopt/rewrite.h"

#include "host/support/text.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::adopt {

namespace {

Word own(std::string text) {
    return {.text = std::move(text), .kind = TokenKind::Word, .space = true};
}

void append(Words& words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
}

Words kept(const Words& modifiers, std::initializer_list<std::string_view> names) {
    Words list;
    for (const Word& word : modifiers)
        if (std::ranges::find(names, std::string_view(word.text)) != names.end()) list.push_back(word);
    return list;
}

} // namespace

WrapperJob Rewriter::job(const ShaderReference& shader, bool vertex, std::string name) const {
    return {.code = code_, .uses = uses_, .shader = shader, .vertex = vertex, .name = std::move(name), .renamed = renamed_};
}

/// The function, and the names that the pass hands to it.
std::vector<std::string> Rewriter::rootsOf(const ShaderReference& shader) {
    std::vector<std::string> roots{shader.entry};
    Sources sources;
    std::string arguments;
    for (const std::string& argument : shader.arguments)
        arguments += argument + " ; ";
    const LexResult lexed = lex(sources, sources.add("arguments", std::make_shared<const std::string>(arguments)));
    for (const Token& token : lexed.tokens)
        if (token.kind == TokenKind::Word) roots.emplace_back(token.text);
    return roots;
}

std::string Rewriter::source(const ShaderReference* shader, const Wrapper& wrapper) const {
    Printer printer(code_.files);
    printer.own("#line 1 \"tegument\"\n" + prelude());
    for (const std::string& pragma : code_.pragmas)
        printer.own(pragma);
    if (shader) {
        const Spelling spelling{.code = &code_, .legacy = profileOf(shader->profile).direct3D9(), .renamed = &renamed_, .pairs = &pairs_};
        std::set<std::string> textures;
        for (const std::size_t item : reachable(code_, rootsOf(*shader)))
            print(printer, spelling, item, textures);
    }
    // In one line of the author's: what is wrong with it is wrong where he names the shader, or, without arguments, where he writes it, so
    // that passes share it.
    std::string text = wrapper.text;
    std::ranges::replace(text, '\n', ' ');
    const auto functions = shader ? code_.functions(shader->entry) : std::vector<const Function*>();
    if (!functions.empty() && shader->arguments.empty()) {
        const Word& name = functions.back()->name;
        text = fmt::format("#line {} \"{}\"\n{}", name.line, code_.files[static_cast<std::size_t>(name.file)], text);
    } else if (shader && shader->at.line > 0) {
        text = fmt::format("#line {} \"{}\"\n{}", shader->at.line, shader->at.file, text);
    }
    printer.own(text);
    return printer.take();
}

bool Rewriter::readsMatrix(const ShaderReference& shader) const {
    for (const std::size_t index : reachable(code_, rootsOf(shader))) {
        const auto isMatrix = [](const Variable& variable) {
            const auto shape = shapeOf(variable.type);
            return shape && shape->matrix && !variable.has("static");
        };
        const Item& item = code_.items[index];
        if (const auto* variable = std::get_if<Variable>(&item); variable && isMatrix(*variable)) return true;
        if (const auto* variable = std::get_if<Variable>(&item))
            if (const auto leaves = structures_.find(variable->name.text); leaves != structures_.end())
                for (const LeafPlan& leaf : leaves->second)
                    if (const auto shape = shapeOf(leaf.type); shape && shape->matrix) return true;
    }
    return false;
}

void Rewriter::print(Printer& printer, const Spelling& spelling, std::size_t item, std::set<std::string>& textures) const {
    const Item& what = code_.items[item];
    if (const auto* structure = std::get_if<Structure>(&what)) return printStructure(printer, spelling, *structure);
    if (const auto* function = std::get_if<Function>(&what)) return printFunction(printer, spelling, *function);
    if (const auto* variable = std::get_if<Variable>(&what)) return printVariable(printer, spelling, *variable, textures);
    const Other& other = std::get<Other>(what);
    printer.print(spelling.respelt(other.words));
}

void Rewriter::printStructure(Printer& printer, const Spelling& spelling, const Structure& structure) const {
    if (!structure.whole.empty()) {
        printer.print(spelling.respelt(structure.whole));
        return printer.own(";");
    }
    Spelling members = spelling;
    members.renamed = nullptr; // no name of the effect's
    printer.own("struct " + structure.name + " {");
    for (const Variable& member : structure.members) {
        Words words = spelling.respelt(kept(member.modifiers, {"row_major", "column_major"}));
        append(words, spelling.respelt(member.type));
        Words name = members.respelt({member.name});
        name[0].space = true;
        append(words, name);
        append(words, spelling.respelt(member.array));
        words.push_back({.text = ";"});
        printer.print(words);
    }
    printer.own("};");
}

/// With the number of elements where the author wrote `[]`.
Words Rewriter::arrayOf(const Variable& variable) const {
    if (variable.array.size() != 2) return variable.array;
    const auto count = counts_.find(variable.name.text);
    if (count == counts_.end()) return variable.array;
    return {variable.array[0], own(std::to_string(count->second)), variable.array[1]};
}

void Rewriter::printSampler(Printer& printer, const std::string& name, std::set<std::string>& textures) const {
    const SamplerPlan& plan = samplers_.at(name);
    if (textures.insert(plan.texture).second)
        printer.own(fmt::format("{}<float4> {};", plan.kind == "CUBE" ? "TextureCube" : "Texture2D", plan.texture));
    printer.own(fmt::format("SamplerState {};", plan.state));
}

void Rewriter::printVariable(Printer& printer, const Spelling& spelling, const Variable& variable, std::set<std::string>& textures) const {
    const std::string& name = variable.name.text;
    if (isEffectType(variable.typeName()) || isTexture9(variable.typeName())) return;
    if (kindOf(variable)) {
        std::string values;
        const auto add = [&](const std::string& sampler) {
            printSampler(printer, sampler, textures);
            const SamplerPlan& plan = samplers_.at(sampler);
            values += fmt::format("{}{{ {}, {} }}", values.empty() ? "" : ", ", plan.texture, plan.state);
        };
        const std::string spelt = spelling.respelt({variable.name})[0].text;
        if (variable.array.empty()) {
            add(name);
            return printer.own(fmt::format("static const tg_s{} {} = {};", samplers_.at(name).kind, spelt, values));
        }
        const int count = counts_.contains(name) ? counts_.at(name) : 0;
        for (int i = 0; i < count; ++i)
            add(fmt::format("{}[{}]", name, i));
        if (count > 0)
            printer.own(fmt::format("static const tg_s{} {}[{}] = {{ {} }};", samplers_.at(name + "[0]").kind, spelt, count, values));
        return;
    }
    if (variable.typeName() == "Buffer" && variable.array.empty()) // nothing fills it: rows of identities, as bones at rest are
        return printer.own(fmt::format("static tg_rows {} = {{ 0 }};", spelling.respelt({variable.name})[0].text));
    if (const auto layer = layers_.find(name); layer != layers_.end()) {
        printer.own(fmt::format("Texture2D<float4> {};", layer->second));
        return printer.own(fmt::format("static tg_array {} = {{ {} }};", spelling.respelt({variable.name})[0].text, layer->second));
    }
    if (const auto size = sizes_.find(name); size != sizes_.end())
        return printer.own(fmt::format("static const int {} = {};", name, size->second));
    if (const auto leaves = structures_.find(name); leaves != structures_.end()) {
        std::string values;
        for (const LeafPlan& leaf : leaves->second) {
            Words words = spelling.respelt(leaf.type);
            words.push_back(own(leaf.name));
            append(words, leaf.array);
            words.push_back({.text = ";"});
            printer.print(words);
            values += (values.empty() ? "" : ", ") + leaf.name;
        }
        const auto count = counts_.find(name);
        return printer.own(fmt::format("static {} {}{} = {{ {} }};", spelling.respelt(variable.type)[0].text,
                                       spelling.respelt({variable.name})[0].text,
                                       count == counts_.end() || variable.array.empty() ? "" : fmt::format("[{}]", count->second), values));
    }
    if (!variable.type.empty() && variable.typeName().starts_with("Texture") && !textures.insert(name).second) return;
    const bool fixed = variable.has("static");
    Words words = kept(variable.modifiers, {"static", "row_major", "column_major", "groupshared"});
    if (fixed) append(words, kept(variable.modifiers, {"const"}));
    append(words, spelling.respelt(variable.type));
    const auto copy = renamed_.find(name);
    Word spelt = copy != renamed_.end() ? variable.name : spelling.respelt({variable.name})[0];
    spelt.space = true;
    words.push_back(spelt);
    append(words, spelling.respelt(fixed ? variable.array : arrayOf(variable)));
    if (fixed && !variable.initial.empty()) {
        words.push_back(own("="));
        append(words, spelling.respelt(variable.initial));
    }
    words.push_back({.text = ";"});
    printer.print(words);
    if (copy == renamed_.end()) return;
    Words second{own("static")};
    append(second, spelling.respelt(kept(variable.modifiers, {"row_major", "column_major"})));
    append(second, spelling.respelt(variable.type));
    second.push_back(own(copy->second));
    append(second, spelling.respelt(arrayOf(variable)));
    second.push_back(own("="));
    second.push_back(own(name + ";"));
    printer.print(second);
}

Words Rewriter::parameterWords(const Spelling& spelling, const Function& function, std::size_t place) const {
    const Variable& parameter = function.parameters[place];
    Words words = kept(parameter.modifiers, {"in", "out", "inout", "row_major", "column_major"});
    if (const auto kind = samplerKind(parameter.typeName())) {
        std::string text = *kind;
        if (const auto kinds = uses_.params.find(function.name.text); text.empty() && kinds != uses_.params.end())
            if (const auto known = kinds->second.find(place); known != kinds->second.end()) text = known->second;
        words.push_back(own("tg_s" + (text.empty() ? "2D" : text)));
    } else {
        append(words, spelling.respelt(parameter.type));
    }
    if (!parameter.name.text.empty()) {
        Word name = spelling.respelt({parameter.name})[0];
        name.space = true;
        words.push_back(name);
    }
    append(words, spelling.respelt(parameter.array));
    if (!parameter.initial.empty()) {
        words.push_back(own("="));
        append(words, spelling.respelt(parameter.initial));
    }
    return words;
}

void Rewriter::printFunction(Printer& printer, const Spelling& spelling, const Function& function) const {
    if (function.body.empty() && !code_.functions(function.name.text).empty() && function.parameters.empty()) return;
    Words words = function.attributes;
    append(words, spelling.respelt(function.type));
    Word name = spelling.respelt({function.name})[0];
    name.space = true;
    words.push_back(name);
    words.push_back({.text = "("});
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
        if (i > 0) words.push_back({.text = ","});
        append(words, parameterWords(spelling, function, i));
    }
    words.push_back({.text = ")"});
    if (function.body.empty()) words.push_back({.text = ";"});
    append(words, spelling.respelt(function.body));
    printer.print(words);
    printer.own("");
}

} // namespace tegument::adopt
