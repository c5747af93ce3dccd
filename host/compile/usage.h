#pragma once
// What the code of a module reads: which variables, which members of blocks, which elements of arrays, which samplers compare.

#include "host/compile/module.h"

#include <set>

namespace tegument::spirv {

struct Usage {
    std::set<Id> whole;                            // loaded or handed on as a whole
    std::map<Id, std::set<std::uint32_t>> members; // first index of access chains with a constant index
    std::set<Id> comparing;                        // samplers used with a depth comparison

    [[nodiscard]] bool reads(Id variable) const { return whole.contains(variable) || members.contains(variable); }
    [[nodiscard]] bool reads(Id variable, std::uint32_t member) const;
};

/// Both compilers remove code that cannot run before this looks: what is left counts as used.
[[nodiscard]] Usage findUsage(const Module& module);

} // namespace tegument::spirv
