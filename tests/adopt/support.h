#pragma once
// Effects of other hosts, for tests of what they become.

#include "meshprep/adopt/adopt.h"
#include "tests/effect/support.h"

#include <string>

namespace tegument::test {

inline Effect foreign(const std::string& text) {
    return loaded(load(Files{{"main.fx", text}}, {.lenient = true}));
}

/// Behind a pixel shader PS.
inline const std::string kRest = "float4 VS(float4 p : POSITION) : POSITION { return p; }\n"
                                 "technique T { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }\n";

} // namespace tegument::test
