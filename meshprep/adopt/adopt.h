#pragma once
// An effect of another host as this host draws it: its shaders respelt for DXC, its parameters bound by what they are called.

#include "host/effect/model.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace tegument {

/// What gives a parameter its value, for one line of a report.
struct ParameterBinding {
    std::string parameter;
    std::string source; // "WORLDVIEWPROJECTION", "white", "a sphere's sky"
    std::string rule;   // "semantic", "name", "SasBindAddress", "Object", "--bind", "its default", "nothing: zero"
};

struct AdoptOptions {
    /// --bind: parameter name -> a semantic of this host, "default" or "zero"; of a texture a picture of this host's, "checker".
    std::map<std::string, std::string> bind;
    std::string technique; // whose bindings are reported; empty: the effect's default
    int width = 1024;      // of the picture
    int height = 1024;
    bool direct3D9Centres = false; // of pixels: meshes are drawn half a pixel off, too, as shaders of Direct3D 9 are there
};

struct Adoption {
    Effect effect;
    std::vector<ParameterBinding> bindings;
    std::vector<Diagnostic> notes; // stand-ins for what the effect or the mesh does not have
    std::set<std::string> turned;  // techniques whose host winds front faces the other way
    bool halfPixel = false; // the technique reported on covers its targets half a pixel off, as Direct3D 9 does: edges have no samples
};

/// What `bind` takes for a parameter of this type, in the order of a list to choose from; empty: nothing.
[[nodiscard]] std::vector<std::string> bindChoices(const Parameter& parameter);

/// Whether DXC and glslang cannot take the effect as it is, or this host not what they make of it: words of Direct3D 9, shaders compiled
/// with arguments, profiles before 4, structures among the parameters.
[[nodiscard]] bool needsRespelling(const Effect& effect);

/// Effects that are written for this host (Effect::ownDialect) come back as they are. A shader that cannot be respelt keeps its name and
/// says why (ShaderReference::obstacle: TG3401 to TG3403).
[[nodiscard]] Adoption adopted(Effect effect, const AdoptOptions& options = {});

} // namespace tegument
