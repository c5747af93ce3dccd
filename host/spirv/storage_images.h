#pragma once
// Images that compute shaders write: HLSL says how many channels they have, not in which format these are stored.

#include <cstdint>
#include <vector>

namespace tegument::spirv {

/// Takes the format out of the types of storage images, where both compilers write rgba32f for float4: what is bound decides. False: two
/// types would become the same, which SPIR-V does not allow; the module is as it was.
[[nodiscard]] bool forgetStorageFormats(std::vector<std::uint32_t>& words);

} // namespace tegument::spirv
