#pragma once
// The two compilers behind compileShader: source in, SPIR-V or DXIL as the compiler wrote it out, semantics still inside.

#include "host/spirv/compile.h"
#include "host/spirv/includes.h"

namespace tegument {

struct RawShader {
    std::vector<std::uint32_t> words;
    std::vector<Diagnostic> warnings;
    std::string listing{};      // of DXIL: its disassembly
    bool levelsRemoved = false; // DXC took out reads of textures that this stage cannot do, and called it success
};

namespace dxc {
enum class Output { Spirv, Dxil };

[[nodiscard]] bool available();
/// The loader's words where it is not.
[[nodiscard]] std::string whyNot();
/// "DXC 1.8 (fd7e54bc)"; empty when not available.
[[nodiscard]] std::string name();
/// Hash of the library's file.
[[nodiscard]] std::string identity();
/// The arguments that do not depend on the request: part of the cache key.
[[nodiscard]] std::string flags(Output output);
[[nodiscard]] Result<RawShader> compile(const ShaderRequest& request, Output output, IncludeReader& includes);
} // namespace dxc

namespace glslang_hlsl {
/// Once for the process; false: nothing of glslang can be used.
bool initialise();
/// What it makes of HLSL without that does not stand comparison: unused inputs and resources stay.
[[nodiscard]] bool optimises();
[[nodiscard]] std::string name();
[[nodiscard]] std::string identity();
[[nodiscard]] Result<RawShader> compile(const ShaderRequest& request, IncludeReader& includes);
} // namespace glslang_hlsl

} // namespace tegument
