#pragma once
// HLSL to DXIL, what Direct3D 12 loads, by DXC in process.

#include "host/spirv/compile.h"

namespace tegument {

/// An element of a signature. Stages of Direct3D 12 meet by register, not by semantic.
struct SignatureElement {
    std::string semantic; // in upper case, always with its index: "TEXCOORD0"
    bool systemValue = false;
    std::uint32_t location = 0; // register
    MemberBase base = MemberBase::Float;
    std::uint8_t mask = 0; // components, x is bit 0
    std::uint8_t used = 0; // of them: read by the code; or, of an output, written
};

/// Of shader model 6.0, held valid by DXC's own validator. Unsigned: the library that signs is Windows'.
struct Dxil {
    std::string container;
    /// Only what the code uses; `binding` is the register, `set` is 0. Blocks have no members here: their layout is that of SPIR-V, which
    /// `tegument check` holds against Microsoft's (TG3204).
    Reflection reflection{};
    std::vector<SignatureElement> inputs{};
    std::vector<SignatureElement> outputs{};
    std::vector<Diagnostic> warnings;
};

/// Cached as compileShader's are.
[[nodiscard]] Result<Dxil> compileDxil(const ShaderRequest& request);

/// Part "ISG1" or "OSG1" of a container; empty when the bytes are not one, or are cut short. The layout is DXC's: docs/DXIL.rst,
/// DxilContainer.h.
[[nodiscard]] std::optional<std::vector<SignatureElement>> readSignature(std::string_view container, std::string_view part);

/// As Reflection lists them: of the system values only the targets.
[[nodiscard]] std::vector<StageVariable> variablesOf(const std::vector<SignatureElement>& signature);

/// Constant blocks and resources with their registers, out of DXC's disassembly (its table "Resource Bindings").
[[nodiscard]] Reflection readBindings(std::string_view listing);

} // namespace tegument
