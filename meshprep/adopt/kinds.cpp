#include "meshprep/adopt/kinds.h"

#include "meshprep/adopt/spelling.h"

#include <algorithm>
#include <array>

namespace tegument::adopt {

namespace {

/// A function that hands one of its samplers on to another.
struct Call {
    std::string from;
    std::vector<std::string> names; // of the caller's parameters
    std::string to;
    std::vector<std::string> arguments; // the name where the argument is one, else empty
};

std::size_t placeOf(const std::vector<std::string>& names, const std::string& name) {
    return static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
}

std::vector<std::string> parameterNames(const Function& function) {
    std::vector<std::string> names;
    for (const Variable& parameter : function.parameters)
        names.push_back(parameter.name.text);
    return names;
}

class Finder {
public:
    explicit Finder(const Code& code) : code_(code) {}

    Uses run() {
        for (const Item& item : code_.items) {
            if (const auto* function = std::get_if<Function>(&item); function && !function->body.empty()) read(*function);
            if (const auto* variable = std::get_if<Variable>(&item)) declare(*variable);
            if (const auto* structure = std::get_if<Structure>(&item))
                for (const Variable& member : structure->members)
                    size(member.array);
        }
        constexpr int kDeepest = 8; // calls that hand a sampler on
        for (int i = 0; i < kDeepest; ++i)
            for (const Call& call : calls_)
                follow(call);
        return std::move(uses_);
    }

private:
    void declare(const Variable& variable) {
        size(variable.array);
        if (const auto kind = samplerKind(variable.typeName()); kind && !kind->empty()) uses_.samplers[variable.name.text] = *kind;
    }

    void size(const Words& array) {
        for (const Word& word : array)
            if (word.isName()) uses_.sizes.insert(word.text);
    }

    void note(const Function& function, const std::vector<std::string>& names, const std::string& name, const std::string& kind) {
        const std::size_t place = placeOf(names, name);
        if (place < names.size())
            uses_.params[function.name.text].try_emplace(place, kind);
        else
            uses_.samplers.try_emplace(name, kind);
    }

    void read(const Function& function) {
        const std::vector<std::string> names = parameterNames(function);
        for (std::size_t i = 0; i < names.size(); ++i)
            if (const auto kind = samplerKind(function.parameters[i].typeName()); kind && !kind->empty())
                uses_.params[function.name.text].try_emplace(i, *kind);
        const Words& body = function.body;
        for (std::size_t i = 0; i + 1 < body.size(); ++i) {
            if (!body[i].isName()) continue;
            if (body[i + 1].is("(")) called(function, names, i);
            if ((i == 0 || (!body[i - 1].is(".") && !body[i - 1].isName())) && isAssigned(body, i)) uses_.written.insert(body[i].text);
            if (body[i + 1].is("[") && i > 0 && body[i - 1].isName()) // a local array
                size({body.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                      body.begin() + static_cast<std::ptrdiff_t>(behindBracket(body, i + 1))});
            if (body[i].is("out") || body[i].is("inout")) continue;
        }
    }

    void called(const Function& function, const std::vector<std::string>& names, std::size_t at) {
        const Words& body = function.body;
        const auto parts = splitAtCommas(body, at + 2, std::max(at + 2, behindBracket(body, at + 1) - 1));
        if (const auto fetch = fetchOf(body[at].text); fetch && !parts.empty() && !parts[0].empty()) {
            note(function, names, parts[0][0].text, fetch->kind);
            return;
        }
        const auto functions = code_.functions(body[at].text);
        if (functions.empty()) return;
        Call call{.from = function.name.text, .names = names, .to = body[at].text};
        for (std::size_t i = 0; i < parts.size(); ++i) {
            call.arguments.push_back(parts[i].empty() || !parts[i][0].isName() ? std::string() : parts[i][0].text);
            // What goes into an out parameter is written.
            for (const Function* callee : functions)
                if (i < callee->parameters.size() && (callee->parameters[i].has("out") || callee->parameters[i].has("inout")))
                    uses_.written.insert(call.arguments.back());
        }
        calls_.push_back(std::move(call));
    }

    void follow(const Call& call) {
        const auto callee = uses_.params.find(call.to);
        if (callee == uses_.params.end()) return;
        const std::map<std::size_t, std::string> kinds = callee->second;
        for (const auto& [place, kind] : kinds) {
            if (place >= call.arguments.size() || call.arguments[place].empty()) continue;
            const std::size_t own = placeOf(call.names, call.arguments[place]);
            if (own < call.names.size())
                uses_.params[call.from].try_emplace(own, kind);
            else
                uses_.samplers.try_emplace(call.arguments[place], kind);
        }
    }

    /// `name.xy[2] += `: the name at `i` begins an assignment.
    static bool isAssigned(const Words& body, std::size_t i) {
        std::size_t at = i + 1;
        if (i >= 2 && (body[i - 1].is("+") || body[i - 1].is("-")) && body[i - 2].is(body[i - 1].text) && !body[i - 1].space) return true;
        while (at < body.size() && (body[at].is(".") || body[at].is("[")))
            at = body[at].is(".") ? at + 2 : behindBracket(body, at);
        if (at + 1 >= body.size()) return false;
        const auto sign = [&](std::size_t k, std::string_view text) { return body[k].is(text); };
        if (sign(at, "=")) return !(sign(at + 1, "=") && !body[at + 1].space);
        for (const std::string_view op : {"+", "-", "*", "/", "%", "&", "|", "^"})
            if (sign(at, op) && sign(at + 1, "=") && !body[at + 1].space) return true;
        for (const std::string_view op : {"+", "-"})
            if (sign(at, op) && sign(at + 1, op) && !body[at + 1].space) return true;
        return false;
    }

    const Code& code_;
    Uses uses_;
    std::vector<Call> calls_;
};

void addWords(const Words& words, std::set<std::string>& names) {
    for (const Word& word : words)
        if (word.isName()) names.insert(word.text);
}

void addVariable(const Variable& variable, std::set<std::string>& names) {
    addWords(variable.type, names);
    addWords(variable.array, names);
    addWords(variable.initial, names);
}

std::set<std::string> namesIn(const Item& item) {
    std::set<std::string> names;
    if (const auto* structure = std::get_if<Structure>(&item)) {
        for (const Variable& member : structure->members)
            addVariable(member, names);
        addWords(structure->whole, names);
    } else if (const auto* function = std::get_if<Function>(&item)) {
        addWords(function->type, names);
        addWords(function->body, names);
        addWords(function->attributes, names);
        for (const Variable& parameter : function->parameters)
            addVariable(parameter, names);
    } else if (const auto* variable = std::get_if<Variable>(&item)) {
        addVariable(*variable, names);
    } else {
        addWords(std::get<Other>(item).words, names);
    }
    return names;
}

} // namespace

Uses usesOf(const Code& code) {
    return Finder(code).run();
}

std::set<std::size_t> reachable(const Code& code, std::vector<std::string> roots) {
    std::set<std::size_t> items;
    std::set<std::string> seen;
    for (std::size_t i = 0; i < code.items.size(); ++i) // what has no name may be a method's body
        if (const auto* other = std::get_if<Other>(&code.items[i]); other && other->name.empty()) {
            items.insert(i);
            for (const std::string& name : namesIn(code.items[i]))
                roots.push_back(name);
        }
    while (!roots.empty()) {
        const std::string name = std::move(roots.back());
        roots.pop_back();
        if (!seen.insert(name).second) continue;
        const auto found = code.byName.find(name);
        if (found == code.byName.end()) continue;
        for (const std::size_t index : found->second) {
            if (!items.insert(index).second) continue;
            for (const std::string& needed : namesIn(code.items[index]))
                if (!seen.contains(needed)) roots.push_back(needed);
        }
    }
    return items;
}

} // namespace tegument::adopt
