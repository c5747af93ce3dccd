#pragma once
// The D3DFORMAT names that effect files may use.

#include <span>
#include <string>

namespace tegument {

[[nodiscard]] std::span<const std::string> formatNames();

} // namespace tegument
