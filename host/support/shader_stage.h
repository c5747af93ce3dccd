#pragma once
// The stages of a pipeline that have shaders, and what each is called.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace tegument {

enum class ShaderStage { Vertex, Pixel, Compute, Geometry };

struct StageNames {
    std::string_view name;
    std::string_view profile; // Microsoft's, without the version
    std::string_view ending;  // of files of GLSL
    std::uint32_t model;      // SPIR-V's execution model, and glslang's number
};

inline constexpr std::array<StageNames, 4> kStageNames = {
    {{"vertex", "vs", ".vert", 0}, {"pixel", "ps", ".frag", 4}, {"compute", "cs", ".comp", 5}, {"geometry", "gs", ".geom", 3}}};
[[nodiscard]] constexpr const StageNames& stageNames(ShaderStage stage) {
    return kStageNames[static_cast<std::size_t>(stage)];
}

} // namespace tegument
