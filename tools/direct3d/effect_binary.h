#pragma once
// What Microsoft's compiler put into an effect: it drops techniques of another Direct3D version without a word, so they are counted.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// A compiled vertex or pixel shader inside an fx_2_0 effect; `bytes` points into the effect.
struct EffectShader {
    int technique = 0;
    int pass = 0;
    std::string_view bytes;
};

/// A number, vector or matrix among the parameters of an fx_2_0 effect.
struct EffectParameter {
    std::string name;
    std::string semantic;
    std::vector<double> numbers; // its default, in row order; zeros where the file gives none
};

/// The numeric ones, in their order.
[[nodiscard]] std::vector<EffectParameter> fx2Parameters(std::string_view bytes);

struct EffectContent {
    int techniques = 0;
    int passes = -1;  // fx_2_0 only
    int shaders = -1; // fx_4_0 and fx_5_0 only
};

[[nodiscard]] bool isPixelShader(const EffectShader& shader);

/// The shaders of model 3 (and below) that the passes of an fx_2_0 effect hold, in the order of passes, vertex shaders first.
[[nodiscard]] std::vector<EffectShader> fx2Shaders(std::string_view bytes);

/// Reads the header of fx_2_0 (0xfeff0901), fx_4_0 (0xfeff1001, inside a DXBC container) or fx_5_0 (0xfeff2001). Nothing: not an effect.
[[nodiscard]] std::optional<EffectContent> readEffectBinary(std::string_view bytes);

} // namespace tegument
