// `Name[index] = value;` in sampler blocks, state objects and passes, and what the values mean.

#include "host/effect/parser.h"
#include "host/effect/vocabularies.h"
#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr double kTargets = 8;
constexpr double kMostIndices = 65536;

std::optional<double> valueNamed(std::string_view name, Vocabulary vocabulary) {
    for (const NamedValue& value : vocabulary)
        if (sameStateName(value.name, name)) return value.value;
    return std::nullopt;
}

/// `<gMap>`, `(gMap)`, `gMap`, each also with an index.
bool isTextureName(std::span<const Token> value) {
    const bool bracket =
        value.size() > 2 && ((value.front().is('<') && value.back().is('>')) || (value.front().is('(') && value.back().is(')')));
    if (bracket) value = value.subspan(1, value.size() - 2);
    const bool indexed = value.size() >= 4 && value[1].is('[') && value.back().is(']');
    return (value.size() == 1 || indexed) && (value[0].kind == TokenKind::Word || value[0].is("0"));
}

bool allowed(double number, Vocabulary vocabulary) {
    if (vocabulary.data() == kWriteMask.data()) return number >= 0 && number <= 15 && number == std::floor(number);
    if (vocabulary.data() == kBool.data()) return true;
    return std::ranges::any_of(vocabulary, [&](const NamedValue& value) { return value.value == number; });
}

std::string valueHint(std::string_view name, Vocabulary vocabulary) {
    std::vector<std::string> names;
    std::string all;
    for (const NamedValue& value : vocabulary) {
        names.emplace_back(value.name);
        all += (all.empty() ? "one of " : ", ") + names.back();
    }
    const std::string near = didYouMean(name, names);
    return near.empty() ? all : near;
}

/// 0xaarrggbb, or components.
std::array<double, 3> colourOf(const std::vector<double>& value) {
    if (value.size() >= 3) return {value[0], value[1], value[2]};
    const auto word = static_cast<std::uint32_t>(static_cast<std::int64_t>(value[0]));
    const auto byte = [&](unsigned shift) { return static_cast<double>(word >> shift & 0xFFU) / 255; };
    return {byte(16), byte(8), byte(0)};
}

template <class Target>
std::string nameHint(std::string_view name, std::span<const StateEntry<Target>> table) {
    std::vector<std::string> names;
    for (const StateEntry<Target>& entry : table)
        names.emplace_back(entry.name);
    return didYouMean(name, names);
}

template <class Target>
const StateEntry<Target>* findEntry(std::string_view name, std::span<const StateEntry<Target>> table) {
    const auto found = std::ranges::find_if(table, [&](const StateEntry<Target>& entry) { return sameStateName(entry.name, name); });
    return found == table.end() ? nullptr : &*found;
}

} // namespace

bool Parser::assignment(std::vector<Assignment>& result) {
    Assignment assignment;
    if (!expectName(assignment.name, "a state's name")) return false;
    if (accept('[')) {
        const Token at = peek();
        const std::optional<Constant> index = expression();
        if (!index || !expect(']', "after the index")) return false;
        const double most = lenient_ ? kMostIndices : kTargets; // textures, lights and constants have more places than targets
        if (index->numbers.size() != 1 || !(index->numbers[0] >= 0 && index->numbers[0] < most))
            return fail(2002, at, "an index is 0 to 7");
        if (!index->integral && !refuse(2002, at, "an index is a whole number", "write 0 to 7")) return false;
        assignment.index = static_cast<int>(index->numbers[0]);
    }
    if (!expect('=', "after the state's name")) return false;
    assignment.value.first = at_;
    while (!atEnd() && !peek().is(';') && !peek().is('}')) {
        if (!peek().is('{') && !peek().is('(')) {
            take();
        } else if (!skipBalanced()) {
            return false;
        }
    }
    assignment.value.last = at_;
    if (assignment.value.first == at_) return unexpected("the state's value");
    result.push_back(assignment);
    return expect(';', "after the state");
}

/// Microsoft's compiler takes no `;` alone.
bool Parser::emptyState() {
    const Token at = take();
    return refuse(1101, at, "expected a state, found ';'");
}

/// A block `{ Name = value; ... }`. Goes on after errors, so that all of them are found.
bool Parser::assignments(std::vector<Assignment>& result) {
    const Token opened = take();
    while (!accept('}')) {
        if (atEnd()) return fail(1102, opened, "this '{' is never closed");
        if (peek().is(';')) {
            if (!emptyState()) return false;
            continue;
        }
        const std::size_t before = at_;
        if (!assignment(result)) recover();
        if (at_ == before) return unexpected("a state");
    }
    return true;
}

std::optional<std::vector<double>> Parser::stateValue(const Assignment& assignment, Vocabulary vocabulary) {
    const std::size_t after = at_;
    const std::size_t errors = result_.errors.size();
    at_ = assignment.value.first;
    std::string unknown;
    std::string clash;
    const Resolver resolve = [&](std::string_view name) -> std::optional<double> {
        if (const auto value = valueNamed(name, vocabulary)) {
            if (result_.effect.findParameter(name) != nullptr || result_.effect.findSampler(name) != nullptr) clash = name;
            return value;
        }
        if (lenient_ && constants_.contains(name)) return std::nullopt; // a parameter's value
        if (equalsIgnoreCase(name, "true")) return 1.0;
        if (equalsIgnoreCase(name, "false")) return 0.0;
        if (unknown.empty()) unknown = name;
        return std::nullopt;
    };
    const Token start = peek();
    const bool truth = equalsIgnoreCase(start.text, "true") || equalsIgnoreCase(start.text, "false");
    const bool alone = assignment.value.last == assignment.value.first + 1;
    if (truth && alone && !valueNamed(start.text, vocabulary) &&
        !refuse(2002, start, fmt::format("'{}' is not a value of {}", start.text, assignment.name.text), valueHint("", vocabulary)))
        return std::nullopt;
    std::optional<std::vector<double>> result;
    if (start.is('{')) {
        std::vector<double> numbers;
        if (bracedValues(numbers, 0)) result = std::move(numbers);
    } else {
        const bool angles = lenient_ && accept('<'); // <gParameter>
        closesAngle_ = angles;
        std::optional<Constant> value = expression(resolve);
        closesAngle_ = false;
        if (value && (!angles || expect('>', "after the value"))) result = std::move(value->numbers);
    }
    if (result && at_ != assignment.value.last) {
        unexpected("';' after the state's value");
        result.reset();
    }
    at_ = after;
    if (!clash.empty() &&
        !refuse(2015, start, fmt::format("'{}' is a value of {} and the name of a parameter", clash, assignment.name.text),
                "rename the parameter"))
        return std::nullopt;
    if (lenient_ && unknown.empty()) soften(errors); // an expression that only its host can compute
    if (!unknown.empty())
        refuse(2002, start, fmt::format("'{}' is not a value of {}", unknown, assignment.name.text), valueHint(unknown, vocabulary));
    if (!unknown.empty() || !result) return std::nullopt;
    const auto outside = [&](double n) { return vocabulary.empty() ? !(std::abs(n) <= kLargestWord) : !allowed(n, vocabulary); };
    if (lenient_ && !vocabulary.empty() && result->size() > 1) result = std::vector<double>{result->front()};
    if (!result->empty() && (vocabulary.empty() ? result->size() <= 4 : result->size() == 1) && std::ranges::none_of(*result, outside))
        return result;
    refuse(2002, start, fmt::format("this is not a value of {}", assignment.name.text), valueHint("", vocabulary));
    return std::nullopt;
}

template <class Target>
bool Parser::apply(const Assignment& assignment, std::span<const StateEntry<Target>> table, Target& target, std::string_view what) {
    const StateEntry<Target>* entry = findEntry(assignment.name.text, table);
    if (entry == nullptr)
        return fail(2001, assignment.name, fmt::format("unknown {} '{}'", what, assignment.name.text),
                    nameHint(assignment.name.text, table));
    const std::optional<std::vector<double>> value = stateValue(assignment, entry->vocabulary);
    if (!value) return false;
    if (assignment.index >= static_cast<int>(kTargets)) return refuse(2002, assignment.name, "an index is 0 to 7");
    if (entry->apply != nullptr) {
        entry->apply(target, assignment.index, *value);
        return true;
    }
    if (value->size() == 1 && (*value)[0] == entry->onlyValue) return true;
    return refuse(2003, assignment.name, fmt::format("{} cannot be expressed", entry->name), std::string(entry->hint));
}

bool Parser::applyState(const Assignment& assignment, std::string_view objectType, States& states) {
    const bool single = objectType != "BlendState" || sameStateName(assignment.name.text, "AlphaToCoverageEnable") ||
                        sameStateName(assignment.name.text, "IndependentBlendEnable");
    if (!objectType.empty() && assignment.index >= 0 && single &&
        !refuse(2002, assignment.name, fmt::format("{} has no index", assignment.name.text), "leave it out"))
        return false;
    if (objectType == "DepthStencilState") return apply(assignment, depthStencilStates(), states, "depth-stencil state");
    if (objectType == "BlendState") return apply(assignment, blendStates(), states, "blend state");
    if (objectType == "RasterizerState") return apply(assignment, rasterizerStates(), states, "rasterizer state");
    const std::string_view name = assignment.name.text;
    const bool known = findEntry(name, direct3D9States()) != nullptr;
    if (!known && isFixedFunction(name)) return fixedFunction(assignment);
    if (!known && (findEntry(name, samplerStateEntries()) != nullptr || equalsIgnoreCase(name, "SRGBTexture") ||
                   equalsIgnoreCase(name, "Sampler") || equalsIgnoreCase(name, "Texture")))
        return refuse(2003, assignment.name, fmt::format("{} cannot be expressed in a pass", name), "write it in the sampler's block");
    return apply(assignment, direct3D9States(), states, "render state");
}

/// What of a pass is no state of a pipeline.
bool Parser::applyToPass(const Assignment& assignment, Pass& pass, States& states) {
    const std::string_view name = assignment.name.text;
    if (!lenient_) return applyState(assignment, "", states);
    if (sameStateName(name, "SRGBWriteEnable")) {
        const auto value = stateValue(assignment, kBool);
        if (value) pass.encodesSrgb = (*value)[0] != 0;
        return value.has_value();
    }
    for (const auto& [state, member] : {std::pair("SpecularEnable", &Pass::addsSpecular), std::pair("FogEnable", &Pass::fogs)})
        if (sameStateName(name, state)) {
            const auto value = stateValue(assignment, kBool);
            if (value) pass.*member = (*value)[0] != 0;
            return value.has_value();
        }
    if (sameStateName(name, "FogColor")) {
        const auto value = stateValue(assignment, Vocabulary());
        if (value) pass.fogColor = colourOf(*value);
        return value.has_value();
    }
    if (toLower(name).starts_with("vertexshaderconstant") || toLower(name).starts_with("pixelshaderconstant") ||
        equalsIgnoreCase(name, "Texture") || equalsIgnoreCase(name, "Sampler")) {
        registers_.push_back(assignment);
        return true;
    }
    if (sameStateName(name, "AlphaTestEnable") || sameStateName(name, "AlphaFunc") || sameStateName(name, "AlphaRef"))
        return alphaTest(assignment, pass);
    const auto stage = static_cast<std::size_t>(std::max(assignment.index, 0));
    if (findEntry(name, samplerStateEntries()) != nullptr && stage < result_.effect.samplers.size()) {
        Assignment state = assignment; // of the samplers in the order in which they are declared; what is shown is the first technique
        state.index = -1;
        if (result_.effect.techniques.empty()) apply(state, samplerStateEntries(), result_.effect.samplers[stage].state, "sampler state");
        return true;
    }
    return applyState(assignment, "", states);
}

bool Parser::alphaTest(const Assignment& assignment, Pass& pass) {
    const std::string_view name = assignment.name.text;
    const bool compares = sameStateName(name, "AlphaFunc");
    const auto value = stateValue(assignment, compares ? Vocabulary(kCompare) : sameStateName(name, "AlphaRef") ? Vocabulary() : kBool);
    if (!value) return false;
    if (compares) pass.alphaTest.compare = static_cast<CompareOp>((*value)[0] - 1);
    if (sameStateName(name, "AlphaRef")) pass.alphaTest.reference = static_cast<unsigned>(std::clamp((*value)[0], 0.0, 255.0));
    if (sameStateName(name, "AlphaTestEnable")) pass.alphaTest.enable = (*value)[0] != 0;
    return true;
}

/// Turning a fixed-function stage off says nothing new, and many files do it.
bool Parser::fixedFunction(const Assignment& assignment) {
    const Token& value = tokens_[assignment.value.first];
    const bool single = assignment.value.last - assignment.value.first == 1;
    for (const std::string_view off : {"FALSE", "NONE", "DISABLE", "0"})
        if (single && equalsIgnoreCase(value.text, off)) return true;
    return refuse(2003, assignment.name, fmt::format("fixed-function state {}: not expressible", assignment.name.text),
                  "write it in a shader");
}

/// `Texture = <gMap>`, `Texture = (gMap)`, `Texture = gMap`.
bool Parser::samplerTexture(Sampler& sampler, const Assignment& assignment) {
    const std::span value(tokens_.data() + assignment.value.first, assignment.value.last - assignment.value.first);
    if (!isTextureName(value) && !refuse(1101, value.front(), "Texture takes the name of a texture: Texture = <gMap>;")) return false;
    sampler.texture.clear(); // of two the last one counts
    for (std::size_t i = assignment.value.first; i < assignment.value.last; ++i)
        if (tokens_[i].kind == TokenKind::Word && sampler.texture.empty()) sampler.texture = tokens_[i].text;
    if (lenient_ && (equalsIgnoreCase(sampler.texture, "NULL") || tokens_[assignment.value.first].is("0"))) {
        sampler.texture.clear();
        return true;
    }
    if (sampler.texture.empty()) return fail(1101, assignment.name, "Texture takes the name of a texture: Texture = <gMap>;");
    const Token& first = tokens_[assignment.value.first];
    result_.textureReferences.push_back({.name = sampler.texture, .at = position(first), .bracket = first.is('<') || first.is('(')});
    return true;
}

bool Parser::samplerStates(Sampler& sampler, bool block, bool direct3D9) {
    sampler.state = direct3D9 ? direct3D9SamplerDefaults() : direct3D10SamplerDefaults();
    std::vector<Assignment> list;
    if (block && !assignments(list)) return false;
    for (const Assignment& assignment : list) {
        if (equalsIgnoreCase(assignment.name.text, "Texture")) {
            samplerTexture(sampler, assignment);
        } else if (equalsIgnoreCase(assignment.name.text, "SRGBTexture")) {
            const std::optional<std::vector<double>> value = stateValue(assignment, kBool);
            if (value && (*value)[0] != 0) result_.srgbSamplers.insert(sampler.name);
        } else {
            apply(assignment, samplerStateEntries(), sampler.state, "sampler state");
        }
    }
    return true;
}

} // namespace tegument
