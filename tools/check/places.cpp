// The same parameters everywhere: what an entry point of Direct3D 11 and its SPIR-V place where, and the defaults of the file.

#include "tools/check/work.h"

#include "host/support/text.h"
#include "tools/direct3d/effect_binary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tegument::check {

namespace {

struct Comparison {
    const EntryPoint& entry;
    TargetCheck& report;
    const std::string& standardsGlobal; // its name; empty: the effect has none

    void differ(const std::string& what) const {
        addError(report, 3204, entry.at, fmt::format("{}: {}", entry.name, what),
                 "fill every 16 bytes of the parameters exactly (docs/design/compilers.md)");
    }
};

/// SPIR-V has no bool in memory.
bool sameBase(MemberBase a, MemberBase b) {
    const auto plain = [](MemberBase base) { return base == MemberBase::Bool ? MemberBase::Uint : base; };
    return plain(a) == plain(b);
}

constexpr std::uint32_t kRegister = 16;

/// Where the STANDARDSGLOBAL parameter lies: compilers to SPIR-V never see it, so what follows moves up by the register that it takes.
std::uint32_t scriptOffset(const Comparison& comparison, const UniformBlock& direct3D) {
    const auto found = std::ranges::find(direct3D.members, comparison.standardsGlobal, &BlockMember::name);
    return found == direct3D.members.end() ? ~0U : found->offset;
}

void compareMember(const Comparison& comparison, const BlockMember& direct3D, const BlockMember& spirv, std::uint32_t script) {
    if (!direct3D.used || !spirv.used) return;
    if (!sameBase(direct3D.base, spirv.base) || direct3D.rows != spirv.rows || direct3D.columns != spirv.columns ||
        direct3D.elements != spirv.elements)
        comparison.differ(fmt::format("{} has another type in Direct3D 11 than in SPIR-V", direct3D.name));
    else if (direct3D.offset != spirv.offset + (direct3D.offset > script ? kRegister : 0) || direct3D.size != spirv.size)
        comparison.differ(fmt::format("{} has {} bytes from byte {} in Direct3D 11, {} from byte {} in SPIR-V", direct3D.name,
                                      direct3D.size, direct3D.offset, spirv.size, spirv.offset));
}

void compareBlocks(const Comparison& comparison, const UniformBlock& direct3D, const UniformBlock& spirv) {
    for (const BlockMember& member : direct3D.members) {
        const auto found = std::ranges::find(spirv.members, member.name, &BlockMember::name);
        if (found != spirv.members.end()) compareMember(comparison, member, *found, scriptOffset(comparison, direct3D));
    }
}

void compareLayouts(const Comparison& comparison, const Reflection& direct3D, const Reflection& spirv) {
    if (direct3D.globals && spirv.globals) compareBlocks(comparison, *direct3D.globals, *spirv.globals);
    for (const UniformBlock& block : direct3D.constantBuffers) {
        const auto found = std::ranges::find(spirv.constantBuffers, block.name, &UniformBlock::name);
        if (found != spirv.constantBuffers.end()) compareBlocks(comparison, block, *found);
    }
}

/// The compiler rounds to float as we do, or to the neighbour.
bool sameNumber(double a, double b) {
    constexpr double kRounding = 1.2e-7;
    return std::abs(a - b) <= kRounding * std::max(std::abs(a), std::abs(b));
}

/// The numbers that the file gives a parameter; null where it gives none.
const std::vector<double>* defaultOf(const Effect& effect, const std::string& name) {
    const Parameter* parameter = effect.findParameter(name);
    return parameter == nullptr || !parameter->defaultValue ? nullptr : std::get_if<std::vector<double>>(&*parameter->defaultValue);
}

void compareDefaults(const Comparison& comparison, const Effect& effect, const Sm5Reflection& reflection) {
    for (const auto& [name, compiled] : reflection.defaults)
        if (const auto* written = defaultOf(effect, name); written != nullptr && !std::ranges::equal(*written, compiled, sameNumber))
            comparison.differ(fmt::format("the default of {} is {} in the file, {} in Direct3D 11", name, fmt::join(*written, " "),
                                          fmt::join(compiled, " ")));
}

/// Every number that the file declares is a parameter of the Direct3D 9 effect, with its semantic and default.
void compareEffect9(const Work& work, TargetCheck& report) {
    const auto binary = work.report.binaries.find(Target::Fx2);
    if (binary == work.report.binaries.end()) return;
    const std::vector<EffectParameter> compiled = fx2Parameters(binary->second);
    for (const Parameter& parameter : work.effect().parameters) {
        if (!parameter.type.isNumeric()) continue;
        const auto found = std::ranges::find(compiled, parameter.name, &EffectParameter::name);
        const auto differ = [&](const std::string& what) {
            addError(report, 3204, parameter.at, fmt::format("{} {}", parameter.name, what), "");
        };
        if (found == compiled.end()) {
            differ("is no parameter of the Direct3D 9 effect");
            continue;
        }
        if (found->semantic != parameter.semantic)
            differ(fmt::format("has the semantic '{}' in the file, '{}' in Direct3D 9", parameter.semantic, found->semantic));
        const auto* written = defaultOf(work.effect(), parameter.name);
        if (written != nullptr && !std::ranges::equal(*written, found->numbers, sameNumber))
            differ(
                fmt::format("has the default {} in the file, {} in Direct3D 9", fmt::join(*written, " "), fmt::join(found->numbers, " ")));
    }
}

void compareEntries(const Work& work, TargetCheck& sm5) {
    const auto& global = work.effect().standardsGlobal;
    const std::string script = global ? global->name : "";
    for (const EntryPoint& entry : work.report.entries) {
        if (!entry.sm5Reflection) continue;
        const Comparison comparison{entry, sm5, script};
        const auto& shader = entry.dxc ? entry.dxc : entry.glslang;
        if (shader) compareLayouts(comparison, entry.sm5Reflection->reflection, shader->reflection);
        compareDefaults(comparison, work.effect(), *entry.sm5Reflection);
    }
}

} // namespace

void compareTargets(Work& work) {
    if (!work.loaded()) return;
    TargetCheck* sm5 = work.find(Target::Sm5);
    TargetCheck* nine = work.find(Target::Fx2);
    if (sm5 != nullptr && wasChecked(*sm5)) {
        compareEntries(work, *sm5);
        conclude(*sm5);
    }
    if (nine != nullptr && wasChecked(*nine)) {
        compareEffect9(work, *nine);
        conclude(*nine);
    }
}

} // namespace tegument::check
