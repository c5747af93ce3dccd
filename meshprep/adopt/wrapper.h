#pragma once
// A flat entry point around an author's function: every semantic a variable of its own, `uniform` parameters as the literals that the pass
// gives, and what Direct3D 9 did behind the shader's back as code.

#include "host/effect/model.h"
#include "meshprep/adopt/code.h"
#include "meshprep/adopt/kinds.h"
#include "meshprep/adopt/spelling.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace tegument::adopt {

/// What a stage hands on or takes: "TEXCOORD3" and its type as the wrapper declares it.
struct Port {
    std::string semantic;
    std::string type = "float4";
};

struct Wrapper {
    std::string text;
    std::vector<Port> inputs;
    std::vector<Port> outputs;
    std::vector<std::string> standIns; // "BINORMAL0 from normal and tangent": vertex inputs that the mesh does not have
    bool writesPosition = false;
    bool readsTargetSize = false; // kTargetSize
};

struct WrapperJob {
    const Code& code;
    const Uses& uses;
    const ShaderReference& shader;
    bool vertex = false;
    std::string name;                             // of the entry point to be made
    const std::vector<Port>* available = nullptr; // of a pixel shader: what its vertex shader writes; null: everything
    const Pass* pass = nullptr;                   // of a pixel shader: alpha test and encoding
    std::map<std::string, std::string> renamed;   // as in Spelling
    bool covers = false;                          // of a vertex shader: it draws over the target, texel by texel
    bool pixels = false;                          // of a vertex shader: the author's positions count pixels of the target
    bool fogs = false;                            // of a vertex shader: what it writes to FOG is read
    bool farthest = false;                        // of a pixel shader: it is drawn at the far plane, to the bit
    bool saturates = false;                       // of a pixel shader: what it blends into holds 0 to 1, as a display's picture does
};

/// TG3401 no function of that name, TG3402 a parameter that nothing gives a value, TG3403 a semantic that this stage cannot have.
[[nodiscard]] Result<Wrapper> wrap(const WrapperJob& job);

/// Stand-ins. A vertex shader that transforms the mesh, or covers the target, and writes what the pixel shader reads; a pixel shader that
/// shows the vertex colour.
[[nodiscard]] Wrapper plainVertexShader(const std::string& name, const std::vector<Port>& reads, bool quad);
[[nodiscard]] Wrapper plainPixelShader(const std::string& name, const std::vector<Port>& available, const Pass& pass);

/// The matrix that plainVertexShader() multiplies with.
inline constexpr const char* kPlainMatrix = "tg_WorldViewProjection";
/// The size of what is drawn into: Direct3D 9 has the centre of a pixel half a pixel further.
inline constexpr const char* kTargetSize = "tg_ViewportSize";
/// In the code of vertex shaders that get the corners of the target in pixels.
inline constexpr const char* kInPixels = ".xy * float2(0.5, -0.5) + 0.5) * tg_ViewportSize";

} // namespace tegument::adopt
