#pragma once
// What the code does with its names: which picture a plain `sampler` reads, which parameters it writes, what a function needs.

#include "meshprep/adopt/code.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tegument::adopt {

struct Uses {
    std::map<std::string, std::string> samplers;                      // a global sampler's kind, from its type or from what reads it
    std::map<std::string, std::map<std::size_t, std::string>> params; // of functions: by the parameter's place
    std::set<std::string> written;                                    // globals that a function assigns to
    std::set<std::string> sizes;                                      // globals that stand between the brackets of an array
};

[[nodiscard]] Uses usesOf(const Code& code);

/// Indices of the items that these names need, in order, and whatever those need.
[[nodiscard]] std::set<std::size_t> reachable(const Code& code, std::vector<std::string> roots);

} // namespace tegument::adopt
