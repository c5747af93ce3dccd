#pragma once
// What a pipeline of Direct3D 12 binds, as text in Microsoft's root signature language.

#include "host/spirv/compile.h"

#include <string>
#include <string_view>
#include <vector>

namespace tegument::emit {

/// A shader of the pass: who sees it ("VERTEX", "PIXEL"; "ALL" for compute) and its registers, by each compiler that was asked: the
/// signature has a place for all of them.
struct RootStage {
    std::string_view visibility;
    std::vector<const Reflection*> reflections;
};

/// In the order of the stages, of each: a constant buffer view for every block; one table of its textures and stores; one of its samplers.
/// D3DCompile and DXC take the text as attribute [RootSignature("...")] or by target rootsig_1_0.
[[nodiscard]] std::string rootSignature(const std::vector<RootStage>& stages);

} // namespace tegument::emit
