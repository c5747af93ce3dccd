#pragma once
// An effect on a Direct3D device, as the script player of docs/samples sees it.

#include "../../../docs/samples/player/script_player.h"
#include "job.h"
#include "pixels.h"

#include <optional>
#include <string>
#include <vector>

namespace client {

inline constexpr unsigned kMaxColors = 4; // of the devices

using Bound = script_player::Targets;
using Clear = script_player::Clear;
using Drawing = script_player::Draw;

class Engine : public script_player::Engine {
public:
    virtual std::string techniqueScript() = 0; // empty: the passes in order
    virtual std::vector<std::string> passes() = 0;
    virtual std::string passScript(const std::string& pass) = 0; // empty: Draw=Geometry
    virtual Numbers numbers(const std::string& parameter) = 0;

    /// Clears what is bound. Values: rgba, depth, or stencil.
    virtual void clear(Clear what, const Numbers& value) = 0;
    virtual void draw(const std::string& pass, Drawing drawing) = 0;

    /// Colour targets by name; the application's under the empty name.
    virtual std::vector<std::string> targets() = 0;
    virtual Pixels read(const std::string& target) = 0;

    void clear(Clear what, std::optional<std::size_t> place, const Numbers& value) override;
    void draw(const script_player::Pass& pass, Drawing drawing) override { draw(pass.name, drawing); }
    script_player::Value value(const std::string& parameter) override { return {numbers(parameter)}; }
};

void runTechnique(Engine& engine);

} // namespace client
