#pragma once
// HLSL to SPIR-V by DXC or glslang in process: validated, reflected, cached. Knows nothing of effects, scenes or Vulkan objects.

#include "host/support/result.h"
#include "host/support/shader_stage.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tegument {

enum class Compiler { Dxc, Glslang };

/// One entry point of one source. `code` is plain HLSL (effect syntax already blanked out) with `#line` directives.
struct ShaderRequest {
    std::string_view code;
    std::string file; // for messages
    std::string entry;
    ShaderStage stage = ShaderStage::Pixel;
    std::vector<std::pair<std::string, std::string>> defines; // in addition to FX_ENTRY=1
    std::vector<std::filesystem::path> includeFolders;        // usually empty: `code` is preprocessed
    bool apart = false;        // DXC in a process of its own, whatever the language; the code has its includes in it
    bool language2018 = false; // DXC reads HLSL as it was before 2021: `?:` and `&&` on vectors, implicit truncation
};

enum class MemberBase { Bool, Int, Uint, Float };

/// A member of a uniform block. Offsets, sizes and strides in bytes, taken from the SPIR-V. `size` reaches from the first to the last byte
/// that holds a value. An HLSL bool arrives as Uint: SPIR-V has no bool in memory.
struct BlockMember {
    std::string name;
    MemberBase base = MemberBase::Float;
    std::uint32_t offset = 0;
    std::uint32_t size = 0;
    std::uint32_t rows = 1;    // HLSL rows: float4x4 4, float3 1
    std::uint32_t columns = 1; // float3 3
    std::uint32_t elements = 0;
    std::uint32_t arrayStride = 0;
    std::uint32_t matrixStride = 0;
    bool spirvRowMajor = false; // the SPIR-V decoration; an HLSL column_major matrix shows RowMajor (docs/conventions.md)
    bool used = true;           // read by this entry point after optimisation
    bool operator==(const BlockMember&) const = default;
};

struct UniformBlock {
    std::string name; // "$Globals", or as written behind `cbuffer`
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    std::uint32_t size = 0;
    std::vector<BlockMember> members;
};

enum class ResourceKind { Texture1D, Texture2D, Texture3D, TextureCube, Sampler, CompareSampler, StorageBuffer, StorageImage };

struct Resource {
    std::string name;
    ResourceKind kind = ResourceKind::Texture2D;
    std::uint32_t set = 0;
    std::uint32_t binding = 0;
    bool used = true; // read by this entry point after optimisation
};

/// A vertex input, varying or pixel output. Semantic in upper case, always with its index: "TEXCOORD0", "NORMAL0", pixel outputs
/// "SV_TARGET0". Every other system value (SV_Position, SV_Depth, SV_VertexID...) is not listed. An element of an array, a row of a matrix
/// is a variable of its own with the next index and location. Inputs that the code does not read are not listed.
struct StageVariable {
    std::string semantic;
    std::uint32_t location = 0;
    std::uint32_t components = 4;
    MemberBase base = MemberBase::Float;
};

/// The vertex stage uses descriptor set 0, the pixel stage set 1, the compute stage set 0: stages never collide. Bindings count from 0:
/// $Globals first, then constant buffers, then the other resources by name, so that both compilers agree wherever they see the same use.
struct Reflection {
    std::optional<UniformBlock> globals;
    std::vector<UniformBlock> constantBuffers; // `cbuffer` blocks; effects of this project have none
    std::vector<Resource> resources;
    std::vector<StageVariable> inputs;
    std::vector<StageVariable> outputs;
    std::uint32_t localSize[3] = {1, 1, 1};
};

struct Shader {
    ShaderStage stage = ShaderStage::Pixel;
    std::string file;  // as given in the request, for messages
    std::string entry; // the name inside the SPIR-V
    std::vector<std::uint32_t> spirv;
    Reflection reflection;
    std::vector<Diagnostic> warnings;
};

/// True when the DXC library was built in and can be loaded.
[[nodiscard]] bool compilerAvailable(Compiler compiler);
/// Why it is not available.
[[nodiscard]] std::string whyCompilerMissing(Compiler compiler);
/// "DXC 1.8 (fd7e54bc)", "glslang 12.0.0".
[[nodiscard]] std::string compilerName(Compiler compiler);
/// DXC when available, else glslang.
[[nodiscard]] Compiler defaultCompiler();

/// Compiles, validates (for Vulkan 1.3), reflects. Results come from the disk cache when source, entry, stage, defines, flags and compiler
/// are the same.
[[nodiscard]] Result<Shader> compileShader(const ShaderRequest& request, Compiler compiler);

/// Makes `pixel` read what `vertex` writes: inputs are matched by semantic, and the locations inside the pixel shader's SPIR-V and
/// reflection are changed where the two structs differ. TG3004: an input without an output, TG3005: another type or fewer components.
[[nodiscard]] Result<void> linkStages(const Shader& vertex, Shader& pixel);

/// Differences between the two compilers' views of one entry point: members, types, sizes, offsets, resources used, semantics. Empty: they
/// agree.
[[nodiscard]] std::vector<std::string> compareReflections(const Reflection& a, const Reflection& b);

} // namespace tegument
