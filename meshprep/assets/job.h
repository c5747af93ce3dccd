#pragma once
// A render request by names and files, and what is read for it: effect, scene and values, before a device is touched. What meshes and
// effects need beside (fur maps, roots, strands, links, environment maps) is made, and cached in the cache folder.

#include "meshprep/adopt/adopt.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/scene.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tegument::assets {

/// How an effect is to be loaded, as a command line or a script says it.
struct EffectOptions {
    std::vector<std::string> defines; // NAME or NAME=VALUE
    std::vector<std::string> includeFolders;
    bool anywhere = false;
    std::string setting; // one of the effect's own; empty: its default
    int mapSize = 0;     // 0: the effect's default
    int shadowSize = 0;  // likewise
};

/// Defines in the order given; --map-size becomes TEGUMENT_MAP_SIZE, --shadow-size TEGUMENT_SHADOW_SIZE.
[[nodiscard]] LoadOptions loadOptions(const EffectOptions& options);

struct JobOptions {
    std::string file;
    EffectOptions effect;
    std::string technique;
    SceneOptions scene;
    std::string preset;                  // of the effect; empty: none
    std::vector<std::string> sets;       // NAME=VALUE of parameters, textures and switches
    std::vector<std::string> binds;      // NAME=RULE
    std::string pictureIn;               // what an effect of ReShade changes; empty: a scene of this host's
    std::string depthIn;                 // its depth, 0 to 1; empty: far, or the scene's
    std::string size;                    // empty: the workspace's
    std::string usualSize = "1024x1024"; // where that has none
    std::string
        fit; // what of the scene is kept in a picture of another shape than it is made for: width, height, both; empty: see loadJob()
    int samples = 0;               // a pixel; 0: the workspace's, else kUsualSamples, or one where the technique cannot have several
    std::string picture = "float"; // the caller's colour target: float or half
    std::string compiler;
    std::string device;
    bool validate = false;
};

struct Job {
    Effect effect;
    LoadOptions load; // that it was loaded with
    Scene scene;      // its workspace has every switch that is set
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

/// --bind NAME=RULE. TG8011 no '='.
[[nodiscard]] Result<std::map<std::string, std::string>> bindRules(const std::vector<std::string>& given);

/// "dxc", "glslang", or the default for no name. TG8015 it is not there.
[[nodiscard]] Result<Compiler> chosenCompiler(const std::string& name);

/// What the options leave open, the workspace says: technique, setting, size, samples, switches, bindings and poses.
/// TG8006 to TG8009 a file or technique that does not exist, TG8010 no size, TG8011 to TG8013 a --set that cannot be, TG8015 the compiler
/// is not there, TG8019 a workspace's value that cannot be, TG8043 no such preset; and whatever loading says.
/// A picture of another shape keeps both width and height of its scene, but for a workspace of the user's that names no size, whose field
/// of view across stays. `turns`: a mesh of one's own is framed so that it can turn. `say` is told what was made.
[[nodiscard]] Result<Job> loadJob(const JobOptions& options, MeshFor meshFor = MeshFor::Technique, bool turns = false, const Say& say = {});

/// One picture of it, with the scene's meshes as loadJob() left them.
[[nodiscard]] Result<RunResult> draw(gpu::Device& device, const Job& job);

} // namespace tegument::assets
