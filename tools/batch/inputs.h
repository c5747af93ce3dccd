#pragma once
// What a batch works on, and which part of it is ours.

#include "host/support/result.h"

#include <cstddef>
#include <string>
#include <vector>

namespace tegument::batch {

/// Part `index` (1 .. count) of `count`. Every input is in exactly one part, whoever asks.
struct Shard {
    std::size_t index = 1;
    std::size_t count = 1;
};

/// "3/100". TG8101 anything else.
[[nodiscard]] Result<Shard> shardOf(const std::string& text);

/// What is named, with * ? [] as the shell has them, then what the list holds, one a line; each input once, in this order. Empty lines
/// and lines that begin with # are passed over; "-" is standard input. TG8102 a pattern that nothing fits, or no input at all; TG5001 the
/// list cannot be read.
[[nodiscard]] Result<std::vector<std::string>> inputsOf(const std::vector<std::string>& named, const std::string& list);

/// Every count-th of them, from the index-th on: neighbours, which are often alike, fall into different parts.
[[nodiscard]] std::vector<std::string> partOf(const std::vector<std::string>& inputs, Shard shard);

} // namespace tegument::batch
