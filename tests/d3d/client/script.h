#pragma once
// The scripts of docs/scripts.md as an engine would run them: the commands that effects of this project use.

#include "job.h"
#include "pixels.h"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace client {

inline constexpr unsigned kMaxColors = 4;

/// Names of textures; empty: the application's own target. Nothing: not bound.
struct Bound {
    std::array<std::optional<std::string>, kMaxColors> colors{""};
    std::optional<std::string> depth = "";
};

enum class Clear { Color, Depth, Stencil };
enum class Drawing { Mesh, Quad, Nothing }; // nothing: a compute shader runs

/// An effect loaded on a Direct3D device, as its scripts see it.
class Engine {
public:
    virtual ~Engine() = default;

    virtual std::string techniqueScript() = 0; // empty: the passes in order
    virtual std::vector<std::string> passes() = 0;
    virtual std::string passScript(const std::string& pass) = 0; // empty: Draw=Geometry
    virtual Numbers numbers(const std::string& parameter) = 0;
    virtual void setNumber(const std::string& parameter, float value) = 0;

    /// Binds the targets; everything that depends on the size of the first one (viewport, VIEWPORTPIXELSIZE) follows.
    virtual void bind(const Bound& bound) = 0;
    /// Clears what is bound. Values: rgba, depth, or stencil.
    virtual void clear(Clear what, const Numbers& value) = 0;
    virtual void draw(const std::string& pass, Drawing drawing) = 0;

    /// Colour targets by name; the application's under the empty name.
    virtual std::vector<std::string> targets() = 0;
    virtual Pixels read(const std::string& target) = 0;
};

void runTechnique(Engine& engine);

} // namespace client
