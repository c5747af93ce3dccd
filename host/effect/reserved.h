#pragma once
// Words that Microsoft's compiler (d3dcompiler_47) takes for no name, alike for every profile from fx_2_0 to fx_5_0.

#include <string_view>

namespace tegument {

/// Neither a semantic nor the name of a pass or an annotation.
[[nodiscard]] bool isReserved(std::string_view word);

/// `float`, `half3`, `int4x4`: also no name of a parameter or a technique.
[[nodiscard]] bool isNumericType(std::string_view word);

} // namespace tegument
