#pragma once
// A SPIR-V module as SPIRV-Cross reads it, with what it finds out but does not hand out. Inside this room: SPIRV-Cross throws
// spirv_cross::CompilerError, which no function of another header lets through.

#include <spirv_cross/spirv_cross.hpp>

#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <vector>

namespace tegument::spirv {

using Words = std::span<const std::uint32_t>;

class Reader : public spirv_cross::Compiler {
public:
    /// The module must be valid (validate.h); the words are copied.
    explicit Reader(Words words);

    /// What is reachable from the entry point counts: both compilers remove code that cannot run.
    [[nodiscard]] bool reads(spirv_cross::VariableID variable) const { return active_.contains(variable); }
    /// A member of a block, an element of an array or a row of a matrix.
    [[nodiscard]] bool reads(spirv_cross::VariableID variable, std::uint32_t member) const;
    /// A sampler or a picture used with a depth comparison.
    [[nodiscard]] bool compares(spirv_cross::VariableID variable) const { return comparison_ids.contains(variable); }

private:
    std::unordered_set<spirv_cross::VariableID> active_;
    std::set<std::uint32_t> whole_;                            // read, or indexed by what is computed
    std::map<std::uint32_t, std::set<std::uint32_t>> members_; // first index of access chains with a constant index
};

/// Overwrites a number that decorates a variable, where the module has it.
void redecorate(const spirv_cross::Compiler& module, std::vector<std::uint32_t>& words, spirv_cross::VariableID variable,
                spv::Decoration decoration, std::uint32_t value);

} // namespace tegument::spirv
