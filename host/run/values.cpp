#include "host/run/values.h"

#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace tegument::run {

namespace {

std::vector<std::string> namesOf(const Effect& effect) {
    std::vector<std::string> names;
    for (const Parameter& parameter : effect.parameters)
        names.push_back(parameter.name);
    return names;
}

SourcePosition fileOnly(std::string file) {
    return {.file = std::move(file)};
}

bool fitsInto(BaseType base, double number) {
    if (base == BaseType::Float) return std::abs(number) <= double{std::numeric_limits<float>::max()};
    if (base == BaseType::Int) return std::abs(number) <= double{std::numeric_limits<std::int32_t>::max()};
    return number >= 0 && number <= double{std::numeric_limits<std::uint32_t>::max()};
}

Result<void> checkNumbers(const Parameter& parameter, const Numbers& value, const SourcePosition& at) {
    const Type& type = parameter.type;
    if (!type.isNumeric())
        return inputError(4011, at, fmt::format("{} is a {}, not a number", parameter.name, type.name),
                          type.isTexture() ? fmt::format("give a file: --set {}=FILE", parameter.name) : "");
    const auto expected = static_cast<std::size_t>(type.scalarCount());
    if (value.size() != expected)
        return inputError(4011, at,
                          fmt::format("{} is a {}{}: it takes {} numbers, {} given", parameter.name, type.name,
                                      type.elements ? fmt::format("[{}]", type.elements) : "", expected, value.size()));
    const bool whole = std::ranges::all_of(value, [](double number) { return number == std::floor(number); });
    if (type.base != BaseType::Float && !whole)
        return inputError(4016, at, fmt::format("{} is a {} and takes whole numbers only", parameter.name, type.name));
    const bool fits = std::ranges::all_of(value, [&](double number) { return fitsInto(type.base, number); });
    if (!fits) return inputError(4016, at, fmt::format("{} got a number that does not fit into 32 bits", parameter.name));
    return {};
}

/// UIMin and UIMax bound each number of a value; a bound has one number or as many as the value.
bool outside(const Numbers& value, const std::optional<Numbers>& bound, double sign) {
    if (!bound || bound->empty()) return false;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const double limit = bound->size() == 1 ? bound->front() : i < bound->size() ? (*bound)[i] : value[i];
        if (sign * value[i] > sign * limit) return true;
    }
    return false;
}

/// `at`: where the value was given.
void warnOutside(const Parameter& parameter, const Numbers& value, const SourcePosition& at, std::vector<Diagnostic>& warnings) {
    const auto minimum = parameter.annotations.numbers("UIMin");
    const auto maximum = parameter.annotations.numbers("UIMax");
    if (!outside(value, minimum, -1) && !outside(value, maximum, 1)) return;
    const auto text = [](const std::optional<Numbers>& bound) {
        return bound && !bound->empty() ? fmt::format("{}", bound->front()) : "open";
    };
    warnings.push_back(inputWarning(
        4012, at,
        fmt::format("{} is set to {}, outside its range {} .. {}", parameter.name, fmt::join(value, ","), text(minimum), text(maximum)),
        "the effect was tested inside UIMin and UIMax only"));
}

/// A unit that the matrices are not in makes every length wrong.
void warnOtherUnit(const Parameter& parameter, const Numbers& value, const SceneView& scene, std::vector<Diagnostic>& warnings) {
    if (!equalsIgnoreCase(parameter.semantic, "UNITMM") || value.front() == static_cast<double>(scene.unitMm)) return;
    warnings.push_back(
        inputWarning(4052, parameter.at,
                     fmt::format("{} is set to {:g}, but one unit of the scene's world is {:g} mm: lengths are {:g} times too long",
                                 parameter.name, value.front(), scene.unitMm, value.front() / static_cast<double>(scene.unitMm)),
                     "leave it out, and say \"world_unit_mm\" in the workspace"));
}

Error missing(const Parameter& parameter) {
    const std::string name = parameter.name;
    const std::string set = fmt::format("give one: --set {}=VALUE", name);
    if (parameter.semantic.empty())
        return inputError(4018, parameter.at, fmt::format("{} is used, has no default value, and nothing sets it", name), set);
    if (asksForMesh(parameter))
        return inputError(4015, parameter.at, fmt::format("{} : {} asks for the mesh, and there is none", name, parameter.semantic),
                          "name a mesh with --mesh or in the workspace");
    const std::string near = didYouMean(parameter.semantic, numericSemantics());
    return inputError(4017, parameter.at, fmt::format("unknown semantic '{}' of {}, which has no default value", parameter.semantic, name),
                      near.empty() ? set : near);
}

std::uint32_t encode(double value, MemberBase base) {
    switch (base) {
    case MemberBase::Bool: return value != 0 ? 1U : 0U;
    case MemberBase::Int: return std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(value));
    case MemberBase::Uint: return static_cast<std::uint32_t>(value);
    case MemberBase::Float: break;
    }
    return std::bit_cast<std::uint32_t>(static_cast<float>(value));
}

std::size_t offsetInElement(const BlockMember& member, std::uint32_t row, std::uint32_t column) {
    if (member.rows == 1) return std::size_t{4} * column;
    return member.spirvRowMajor ? std::size_t{column} * member.matrixStride + std::size_t{4} * row
                                : std::size_t{row} * member.matrixStride + std::size_t{4} * column;
}

bool sameShape(const BlockMember& member, const Type& type) {
    const auto same = [](std::uint32_t reflected, int declared) { return reflected == static_cast<std::uint32_t>(declared); };
    return same(member.rows, type.rows) && same(member.columns, type.columns) && same(member.elements, type.elements);
}

} // namespace

Result<Values> Values::resolve(const Effect& effect, const ValueSources& sources, std::vector<Diagnostic>& warnings) {
    Values values;
    for (const Parameter& parameter : effect.parameters) {
        if (!parameter.type.isNumeric()) continue;
        if (parameter.defaultValue)
            if (const auto* numbers = std::get_if<Numbers>(&*parameter.defaultValue)) values.known_[parameter.name] = *numbers;
        auto bound = semanticValue(parameter, *sources.scene);
        if (!bound) values.failed_.emplace(parameter.name, bound.error());
        if (bound && *bound) values.known_[parameter.name] = std::move(**bound);
    }
    for (const auto& [name, value] : *sources.workspace) {
        const Parameter* parameter = effect.findParameter(name);
        if (!parameter) continue;
        const SourcePosition at = fileOnly(sources.workspaceFile);
        if (const auto checked = checkNumbers(*parameter, value, at); !checked) return checked.error();
        warnOutside(*parameter, value, at, warnings);
        warnOtherUnit(*parameter, value, *sources.scene, warnings);
        values.known_[name] = value;
        values.fixed_[name] = true;
    }
    for (const auto& [name, value] : *sources.set) {
        const Parameter* parameter = effect.findParameter(name);
        if (!parameter)
            return inputError(4010, fileOnly(effect.file.string()), fmt::format("no parameter '{}' to set", name),
                              didYouMean(name, namesOf(effect)));
        if (const auto checked = checkNumbers(*parameter, value, parameter->at); !checked) return checked.error();
        warnOutside(*parameter, value, {}, warnings);
        warnOtherUnit(*parameter, value, *sources.scene, warnings);
        values.known_[name] = value;
        values.fixed_[name] = true;
    }
    return values;
}

const Numbers* Values::find(const std::string& name) const {
    const auto found = known_.find(name);
    return found == known_.end() ? nullptr : &found->second;
}

Result<Numbers> Values::require(const Parameter& parameter) const {
    if (const auto failed = failed_.find(parameter.name); failed != failed_.end() && !fixed_.contains(parameter.name))
        return failed->second;
    if (const Numbers* value = find(parameter.name)) return *value;
    return missing(parameter);
}

void pack(const BlockMember& member, std::span<const double> value, std::span<std::byte> block) {
    std::size_t next = 0;
    const std::uint32_t elements = member.elements == 0 ? 1 : member.elements;
    for (std::uint32_t element = 0; element < elements; ++element)
        for (std::uint32_t row = 0; row < member.rows; ++row)
            for (std::uint32_t column = 0; column < member.columns; ++column) {
                const std::size_t at = member.offset + std::size_t{element} * member.arrayStride + offsetInElement(member, row, column);
                const std::uint32_t bits = encode(value[next++], member.base);
                assert(at + sizeof bits <= block.size());
                std::memcpy(block.data() + at, &bits, sizeof bits);
            }
}

Result<void> pack(const BlockMember& member, const Parameter& parameter, const Numbers& value, std::span<std::byte> block) {
    if (!sameShape(member, parameter.type))
        return inputError(4019, parameter.at,
                          fmt::format("{} is declared {} here, but the compiler saw {} rows, {} columns, {} elements", parameter.name,
                                      parameter.type.name, member.rows, member.columns, member.elements),
                          "do not declare it differently under #ifdef FX_ENTRY");
    assert(value.size() == static_cast<std::size_t>(parameter.type.scalarCount()));
    pack(member, value, block);
    return {};
}

} // namespace tegument::run
