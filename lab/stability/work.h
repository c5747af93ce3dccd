#pragma once
// Inside lab/bench: what the parts of the stability report share.

#include "host/effect/model.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/run/run.h"
#include "host/run/session.h"
#include "host/scene/workspace.h"
#include "lab/stability/stability.h"

#include <glm/glm.hpp>

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace tegument::bench::stability {

struct Context {
    gpu::Device& device;
    const StabilityOptions& options;
    StabilityReport& report;

    /// Whether the options ask for this module, "Main" of Main.fx.
    [[nodiscard]] bool wants(std::string_view module) const;

    void say(const std::string& line) const {
        if (options.say) options.say(line);
    }
};

using Defines = std::vector<std::pair<std::string, std::string>>;
using Numbers = std::map<std::string, std::vector<double>>;

struct HardScene {
    std::string name;
    Mesh mesh;
    Workspace workspace;
    Numbers parameters; // those that an effect does not have are left out
    Defines defines{};  // beside the setting
};

/// With the setting and the options' map size; `defines` win.
[[nodiscard]] Result<Effect> load(const Context& context, const std::filesystem::path& file, const std::string& setting,
                                  const Defines& defines = {});

/// The first and the last of an effect's settings: of ours what the seed has, and what is right. One without a name where it has none.
[[nodiscard]] Result<std::vector<std::string>> outerSettings(const Context& context, const std::filesystem::path& file);

/// Every wanted .fx file below the options' folder, sorted.
[[nodiscard]] std::vector<std::filesystem::path> effectFiles(const Context& context);

/// The picture, with the scene's parameters that the effect has.
[[nodiscard]] Result<RunResult> draw(const Context& context, const Effect& effect, const std::string& technique, const HardScene& scene,
                                     int size, std::vector<std::string> dump = {});
[[nodiscard]] RunOptions runOptions(const Context& context, const Effect& effect, const std::string& technique, const HardScene& scene,
                                    int size);

struct Worst {
    double value = 0;
    int x = 0;
    int y = 0;
};

/// Of two pictures' first three channels, relative to the mean of the second. Values that are not finite count as differing by the mean.
struct PictureError {
    double relativeL2 = 0;
    double beyond = 0; // share of the pixels beyond 1e-3
    Worst largest;
};
[[nodiscard]] PictureError differenceOf(const Image& image, const Image& reference);

struct NotFinite {
    std::size_t count = 0;
    int x = 0; // the first
    int y = 0;
    double value = 0;
};
[[nodiscard]] NotFinite notFinite(const Image& image);

/// "pixel (3, 4)"
[[nodiscard]] std::string at(const char* what, const Worst& worst);

/// Scenes of stability_scenes.cpp.
[[nodiscard]] HardScene bodyScene();
/// The whole scene `factor` times as large: mesh, camera, light, and what the effects measure in mm.
[[nodiscard]] HardScene scaled(HardScene scene, double factor);
/// A cap of a sphere up to `degrees` from its pole on +z, seen and lit along given directions from its centre. Radius in mm.
[[nodiscard]] HardScene capScene(double radius, double degrees, const glm::dvec3& toEye, const glm::dvec3& toLight);
/// What each scene asks of every effect: values must stay finite.
[[nodiscard]] std::vector<HardScene> hostileScenes();
/// The same with several lights or with surroundings, whose files go into the folder; and whatever writing them says.
[[nodiscard]] Result<std::vector<HardScene>> litScenes(const std::filesystem::path& folder);
/// Whether an effect that was loaded with the scene's defines has what they ask for.
[[nodiscard]] bool knowsLightsOf(const Effect& effect, const HardScene& scene);
/// A curved sheet under charts that are hard to blur in.
[[nodiscard]] std::vector<HardScene> chartScenes();
/// A plane under the same charts, half of it lit: an edge of light along x = 0.
[[nodiscard]] std::vector<HardScene> edgeScenes();
/// A wall on a floor, lit from behind at 45 degrees: the floor before it (0 < z < 20 mm) lies in its shadow.
[[nodiscard]] HardScene wallScene();

[[nodiscard]] Result<void> measureFinite(const Context& context);
[[nodiscard]] Result<void> measureRoughness(const Context& context);
[[nodiscard]] Result<void> measureScale(const Context& context);
[[nodiscard]] Result<void> measureShadow(const Context& context);
[[nodiscard]] Result<void> measureCharts(const Context& context);
[[nodiscard]] Result<void> measureFormats(const Context& context);
[[nodiscard]] Result<void> measureCompilers(const Context& context);
[[nodiscard]] Result<void> measureDevices(const Context& context);

} // namespace tegument::bench::stability
