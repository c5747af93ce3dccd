#pragma once
// Inside lab/invariance: the same scene, put otherwise; and what the definition of a technique says to it.

#include "host/effect/model.h"
#include "lab/invariance/engine_scene.h"

#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace tegument::invariance {

/// What a case may look at besides the scene.
struct Subject {
    const Effect& effect;
    std::string technique;
    const std::set<std::string>& reads; // parameters and textures that its shaders read
};

/// What must hold of a technique's definition, else the case asks for nothing that it promises.
enum class Asks {
    Nothing,      // the same scene, whatever the effect
    NoMeshAxes,   // the mesh's file has other axes: coats of fur are defined along those axes
    NoLengths,    // everything is larger, gUnitMm is not: only what knows no millimetres looks alike
    MirrorPicture // the scene in a mirror
};

struct Case {
    std::string column;
    std::string name;
    Asks asks = Asks::Nothing;
    std::function<void(EngineScene&, const Subject&)> change;
    std::function<void(EngineScene&, const Subject&)> common; // done to both scenes before; may be none
    bool lamps = false;                                       // the scene has several lights
    std::string limitsOf;                                     // the column whose exceptions hold; empty: its own
};

[[nodiscard]] const std::vector<Case>& allCases();

struct Limits {
    double relativeL2 = 0;
    double beyond = 0;
    std::string excused;
};

/// Switches of an effect for several lights, and the lamps themselves: one parallel, one a spot near by, one a point beside the mesh.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> lampDefines();
void addLamps(EngineScene& scene);

/// Why the technique's definition excepts a case, or nothing.
[[nodiscard]] std::string apart(const Subject& subject, const Case& each);
[[nodiscard]] Limits limitsOf(const Subject& subject, const Case& each);
/// Its picture shows a map in texture space or of no mesh: it is the same in a mirror, not mirrored.
[[nodiscard]] bool showsMap(const Subject& subject);

} // namespace tegument::invariance
