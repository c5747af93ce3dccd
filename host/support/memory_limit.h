#pragma once
// How much memory this process may write to.

#include <cstdint>

namespace tegument {

inline constexpr std::uint64_t kNoMemoryLimit = UINT64_MAX;

/// Of the machine, or of the container, in bytes.
[[nodiscard]] std::uint64_t memoryOfTheMachine();

/// Beyond it allocations fail. A limit that is narrower already stays; what is only reserved, or mapped to be read, does not count.
void limitMemoryTo(std::uint64_t bytes);

} // namespace tegument
