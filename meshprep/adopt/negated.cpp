#include "meshprep/adopt/negated.h"

#include "meshprep/adopt/spelling.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

namespace tegument::adopt {

namespace {

constexpr int kHands = 4; // that a direction goes through

/// What makes something else of a direction.
constexpr std::array<std::string_view, 9> kOtherwise{"dot", "length", "distance", "reflect", "cross", "pow", "saturate", "lerp", "max"};

bool isVectorType(const Word& word) {
    const auto shape = shapeOf({word});
    return shape && shape->columns >= 3;
}

/// One function: its body's words, the names that it declares, and those that are turned round in it.
struct Body {
    const Function* function = nullptr;
    std::set<std::string> members; // of structures, that are turned round
    std::set<std::string> local;   // of any type
    std::set<std::string> vectors; // of those with three components or more
    std::set<std::string> negated;
};

/// The member that `light`, `lights[i]` or `scene.light` names at its end, from its first word on; none of `light.xyz`.
std::optional<std::string> memberAt(const Words& words, std::size_t at) {
    std::optional<std::string> member;
    for (++at; at + 1 < words.size() && (words[at].is("[") || words[at].is("."));) {
        const bool element = words[at].is("[");
        const std::string& text = words[at + 1].text;
        if (!element && text.find_first_not_of("xyzwrgba") != std::string::npos) member = text;
        at = element ? behindBracket(words, at) : at + 2;
    }
    return member;
}

bool isUnaryMinus(const Words& words, std::size_t at) {
    if (!words[at].is("-")) return false;
    if (at == 0) return true;
    const Word& before = words[at - 1];
    return !(before.kind == TokenKind::Number || before.is(")") || before.is("]") || (before.isName() && !before.is("return")));
}

/// The name at `at` is turned round, and its member where it has one.
void turn(Body& body, const Words& words, std::size_t at) {
    body.negated.insert(words[at].text);
    if (const auto member = memberAt(words, at)) body.members.insert(*member);
}

Body read(const Function& function) {
    Body body{.function = &function};
    const Words& words = function.body;
    for (const Variable& parameter : function.parameters) {
        body.local.insert(parameter.name.text);
        if (!parameter.type.empty() && isVectorType(parameter.type.front())) body.vectors.insert(parameter.name.text);
    }
    for (std::size_t i = 1; i < words.size(); ++i) {
        if (words[i].isName() && words[i - 1].isName() && !words[i - 1].is("return")) {
            body.local.insert(words[i].text);
            if (isVectorType(words[i - 1])) body.vectors.insert(words[i].text);
        }
        if (!isUnaryMinus(words, i - 1)) continue;
        if (words[i].isName()) turn(body, words, i);
        if (i + 2 < words.size() && words[i].isName() && words[i + 1].is("(")) turn(body, words, i + 2); // -normalize(light)
        if (i + 1 < words.size() && words[i].is("(")) turn(body, words, i + 1);
    }
    return body;
}

/// `name[i].xyz = value;`: whether what is assigned to a vector that is turned round is a direction as it stands.
void followAssignments(Body& body) {
    const Words& words = body.function->body;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        if (!words[i].isName() || !body.vectors.contains(words[i].text) || !body.negated.contains(words[i].text)) continue;
        std::size_t at = i + 1;
        while (at + 1 < words.size() && (words[at].is("[") || words[at].is(".")))
            at = words[at].is("[") ? behindBracket(words, at) : at + 2;
        if (at + 1 >= words.size() || !words[at].is("=") || words[at + 1].is("=")) continue;
        std::vector<std::size_t> names;
        bool kept = true;
        for (++at; at < words.size() && !words[at].is(";"); ++at) {
            kept = kept && !words[at].is("+") && !words[at].is("-") &&
                   std::ranges::find(kOtherwise, std::string_view(words[at].text)) == kOtherwise.end();
            const bool member = at > 0 && words[at - 1].is(".");
            if (words[at].isName() && !member && !(at + 1 < words.size() && words[at + 1].is("("))) names.push_back(at);
        }
        if (!kept) continue;
        for (const std::size_t name : names)
            turn(body, words, name);
    }
}

/// `shade(normal, lightDirection)`: the argument is turned round where the function turns its parameter round.
void followCalls(Body& body, const std::map<std::string, std::set<std::size_t>>& turned) {
    const Words& words = body.function->body;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        const auto places = words[i].isName() && words[i + 1].is("(") ? turned.find(words[i].text) : turned.end();
        if (places == turned.end()) continue;
        const auto arguments = splitAtCommas(words, i + 2, std::max(i + 2, behindBracket(words, i + 1) - 1));
        for (const std::size_t place : places->second)
            if (place < arguments.size() && !arguments[place].empty()) {
                const Words& argument = arguments[place];
                const bool inside = argument.size() > 3 && argument[0].isName() && argument[1].is("("); // normalize(light)
                turn(body, argument, inside ? 2 : 0);
            }
    }
}

} // namespace

std::set<std::string> negatedNames(const Code& code) {
    std::vector<Body> bodies;
    std::set<std::string> names;
    for (const Item& item : code.items) {
        if (const auto* function = std::get_if<Function>(&item); function && !function->body.empty()) bodies.push_back(read(*function));
        if (const auto* variable = std::get_if<Variable>(&item)) // static float3 toLight = -light;
            for (std::size_t i = 1; i < variable->initial.size(); ++i)
                if (isUnaryMinus(variable->initial, i - 1) && variable->initial[i].isName()) names.insert(variable->initial[i].text);
    }
    for (int hand = 0; hand < kHands; ++hand) {
        std::map<std::string, std::set<std::size_t>> turned;
        for (Body& body : bodies) {
            followAssignments(body);
            const std::vector<Variable>& parameters = body.function->parameters;
            for (std::size_t i = 0; i < parameters.size(); ++i)
                if (body.vectors.contains(parameters[i].name.text) && body.negated.contains(parameters[i].name.text))
                    turned[body.function->name.text].insert(i);
        }
        for (Body& body : bodies)
            followCalls(body, turned);
    }
    for (const Body& body : bodies) {
        std::ranges::set_difference(body.negated, body.local, std::inserter(names, names.end()));
        for (const std::string& member : body.members)
            names.insert("." + member);
    }
    return names;
}

bool isNegated(const std::set<std::string>& names, std::string_view parameter) {
    return names.contains(std::string(parameter)) || std::ranges::any_of(names, [&](const std::string& name) {
               return name.starts_with('.') && parameter.ends_with("_" + name.substr(1));
           });
}

} // namespace tegument::adopt
