#pragma once
// Options of the subcommands that load an effect, or an effect and a scene.

#include "meshprep/assets/job.h"

namespace CLI {
class App;
}

namespace tegument::app {

using assets::EffectOptions;
using assets::Job;
using assets::JobOptions;
using assets::MeshFor;
using assets::Scene;
using assets::SceneOptions;

void addEffectOptions(CLI::App& command, EffectOptions& options);
void addJobOptions(CLI::App& command, JobOptions& options);

} // namespace tegument::app
