#pragma once
// Values of parameters as the command line and the workspace give them, held against the effect before anything runs.

#include "host/effect/model.h"
#include "host/run/run.h"
#include "host/scene/presets.h"
#include "host/scene/workspace.h"

#include <string>
#include <utility>
#include <vector>

namespace tegument::assets {

/// A switch of the effects: a macro, so that what it leaves out is never compiled.
struct Switch {
    std::string name;
    std::string meaning;
    int least = 0;
    int most = 1;
    int step = 1;

    [[nodiscard]] std::string range() const;
};

/// Those of hlsl/settings.fxh that have numbers.
[[nodiscard]] const std::vector<Switch>& switches();
/// None: it is no switch.
[[nodiscard]] const Switch* findSwitch(std::string_view name);
/// The effect includes hlsl/settings.fxh; another's macros are not known.
[[nodiscard]] bool takesSwitches(const Effect& effect);

/// Takes those of them that name a switch: NAME=VALUE, as definitions. TG8013 a value that it does not have.
[[nodiscard]] Result<std::vector<std::pair<std::string, std::string>>> takeSwitches(std::vector<std::string>& sets);
/// Those among a workspace's parameters, as NAME=VALUE. TG8019 a value that it does not have.
[[nodiscard]] Result<std::vector<std::string>> switchesOf(const Workspace& workspace);

/// NAME=VALUE: numbers for a numeric parameter, a file for a texture. TG8011 no '=', TG8012 no such parameter, TG8013 not that many finite
/// numbers, or not whole ones; TG8008 no such file.
[[nodiscard]] Result<void> applySet(const std::string& set, const Effect& effect, RunOptions& run);

/// The values of the effect's preset of this name, whatever its case. TG8043 it has none, TG8044 a parameter that the effect does not have,
/// or a value that it cannot take; and what loadPresets() says.
[[nodiscard]] Result<void> applyPreset(const std::string& name, const Effect& effect, RunOptions& run);
/// All of them, checked likewise.
[[nodiscard]] Result<std::vector<Preset>> presetsOf(const Effect& effect);

/// A workspace serves many effects: what this one does not have is passed over when one beside it does, else TG8018 warns of it. TG8019 a
/// value that the parameter cannot take.
[[nodiscard]] Result<std::vector<Diagnostic>> checkWorkspaceValues(const Effect& effect, const Workspace& workspace);

} // namespace tegument::assets
