#pragma once
// Words of Direct3D 9's HLSL and what later compilers call them.

#include "meshprep/adopt/code.h"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>

namespace tegument::adopt {

/// Which compiler the author wrote for, from `vs_2_0`, `ps_4_0_level_9_1` and the like.
struct Profile {
    int major = 3;
    [[nodiscard]] bool direct3D9() const { return major < 4; }
};
[[nodiscard]] Profile profileOf(std::string_view text);

/// "1D", "2D", "3D", "CUBE" of sampler2D and the like; "" of plain `sampler`; nullopt of every other type. In any case.
[[nodiscard]] std::optional<std::string> samplerKind(std::string_view type);
/// `texture`, `texture2D`: types without methods.
[[nodiscard]] bool isTexture9(std::string_view type);
/// Types that mean nothing to a shader: string, VertexShader, BlendState ...
[[nodiscard]] bool isEffectType(std::string_view type);

/// tex2D, tex2Dlod, texCUBEproj ... in any case: "2D" and "lod".
struct Fetch {
    std::string kind;
    std::string form;
};
[[nodiscard]] std::optional<Fetch> fetchOf(std::string_view word);

/// Scalar and size of a numeric type; nullopt of every other.
struct Shape {
    std::string scalar;
    int rows = 1;
    int columns = 1;
    bool matrix = false;
};
[[nodiscard]] std::optional<Shape> shapeOf(const Words& type);

/// ASCII in capitals.
[[nodiscard]] std::string upper(std::string_view text);

/// A name that later compilers keep for themselves: line, point, sample, interface ...
[[nodiscard]] bool isReserved(std::string_view word);

/// Words as DXC takes them. `functions`: names that the author declared himself and that therefore are no intrinsics. `legacy`: Direct3D
/// 9's arithmetic, where a power of a negative number is that of its absolute value and the direction of zero is zero.
struct Spelling {
    const Code* code = nullptr;
    bool legacy = false;
    const std::map<std::string, std::string>* renamed = nullptr; // of this effect's own names
    const std::set<std::string>* pairs = nullptr;                // samplers that are written with their pictures

    [[nodiscard]] Words respelt(const Words& words) const;
};

/// The functions and structures that respelt words and samplers need.
[[nodiscard]] const std::string& prelude();

} // namespace tegument::adopt
