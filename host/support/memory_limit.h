#pragma once
// How much memory this process may write to.

#include <cstdint>

namespace tegument {

inline constexpr std::uint64_t kNoMemoryLimit = UINT64_MAX;

/// Of the machine, or of the container, what nobody uses now, in bytes; at least a gibibyte of it, if it has as much. Who takes more is
/// ended by the system without a word, or another process is.
[[nodiscard]] std::uint64_t memoryToBeHad();

/// Beyond it allocations fail. The caller's own limit is not widened, ours is; what is only reserved, or mapped to be read, does not count.
void limitMemoryTo(std::uint64_t bytes);

} // namespace tegument
