#pragma once
// How much memory this process may write to.

#include <cstdint>

namespace tegument {

inline constexpr std::uint64_t kNoMemoryLimit = UINT64_MAX;

/// What is free of the memory of the machine, or of its container, in bytes; at least a gibibyte where there is as much. The system ends
/// the process that takes more, or another one, without a word. On Windows all that the machine has, for what is only reserved counts
/// there.
[[nodiscard]] std::uint64_t memoryToBeHad();

/// Beyond it allocations fail. The caller's own limit is not widened, ours is; what is only reserved, or mapped to be read, does not count.
void limitMemoryTo(std::uint64_t bytes);

} // namespace tegument
