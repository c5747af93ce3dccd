#pragma once
// An effect, a scene and values: what the subcommands that draw read from disk before the device is touched.

#include "host/adopt/adopt.h"
#include "tools/cli/effect_options.h"
#include "tools/cli/scene.h"

#include <utility>

namespace tegument::app {

struct JobOptions {
    std::string file;
    EffectOptions effect;
    std::string technique;
    SceneOptions scene;
    std::string preset; // of the effect; empty: none
    std::vector<std::string> sets;
    std::vector<std::string> binds; // NAME=RULE
    std::string size = "1024x1024";
    int samples = 0;               // a pixel; 0: kUsualSamples, or one where the technique cannot have several
    std::string picture = "float"; // the caller's colour target: float or half
    std::string compiler;
    std::string device;
    bool validate = false;
};

struct Job {
    Effect effect;
    Scene scene;
    RunOptions run;
    std::vector<Diagnostic> warnings;         // of what the workspace gives, and what stands in for what a foreign effect lacks
    std::vector<ParameterBinding> bindings{}; // of a foreign effect
};

/// Which technique decides whether a mesh must be there.
enum class MeshFor { Technique, AnyTechnique };

/// Of a pixel, for pictures that are looked at. What is measured or compared asks for a number.
inline constexpr int kUsualSamples = 4;

/// WIDTHxHEIGHT, or one number for a square. TG8010.
[[nodiscard]] Result<std::pair<int, int>> parseSize(const std::string& text);

/// "dxc", "glslang", or the default for no name. TG8015 it is not there.
[[nodiscard]] Result<Compiler> chosenCompiler(const std::string& name);

void addJobOptions(CLI::App& command, JobOptions& options);
/// TG8006 to TG8009 a file or technique that does not exist, TG8010 no size, TG8011 to TG8013 a --set that cannot be, TG8015 the compiler
/// is not there, TG8019 a workspace's value that cannot be, TG8043 no such preset; and whatever loading says.
/// `turns`: a mesh of one's own is framed so that it can turn.
[[nodiscard]] Result<Job> loadJob(const JobOptions& options, MeshFor meshFor, bool turns = false);

} // namespace tegument::app
