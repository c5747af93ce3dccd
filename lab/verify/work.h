#pragma once
// Inside lab/verify: what the sources of the modules share.

#include "host/effect/model.h"
#include "host/image/compare.h"
#include "host/run/run.h"
#include "lab/verify/scene.h"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace tegument::verify {

struct Context {
    gpu::Device& device;
    const VerifyOptions& options;
};

struct RenderJob {
    std::string effect; // "Beckmann.fx"
    std::string technique{};
    int size = 16;
    std::vector<std::string> dump{};
    std::map<std::string, std::vector<double>> parameters{};
    std::vector<std::pair<std::string, std::string>> defines{};
    std::map<std::string, std::string> textures{}; // files
};

/// With the setting and the map size of the options.
[[nodiscard]] Result<RunResult> render(const Context& context, const RenderJob& job, const Mesh* mesh = nullptr,
                                       const Workspace& workspace = {});
[[nodiscard]] Result<RunResult> render(const Context& context, const Scene& scene, const RenderJob& job);

/// Largest values that pass; a negative one leaves that figure out.
struct Limits {
    double relativeL2 = -1;
    double p99 = -1;
    double p999 = -1;
    double largest = -1;
    double bias = -1;
    double apart = -1; // relative L2 of the pixels that are treated apart
    std::string why;
};

struct Comparison {
    std::string subject;
    Image rendered;
    Image reference;
    std::vector<std::uint8_t> counts; // per pixel; empty: all
    std::vector<std::uint8_t> within; // of these, those that do not count are treated apart and measured by themselves; empty: none
};

/// Of the pixels that count; none given: of all.
[[nodiscard]] Result<Difference> differenceWhere(const std::vector<std::uint8_t>& counts, const Image& image, const Image& reference);

/// Metrics of the pixels that count, and three pictures.
[[nodiscard]] Result<void> compare(ModuleReport& report, const Context& context, const Comparison& comparison, const Limits& limits);

void addMetric(ModuleReport& report, const Context& context, std::string name, double value, double limit, std::string why);

/// Share of the pixels that do not count, of those that are `covered`.
[[nodiscard]] double shareApart(const std::vector<std::uint8_t>& counts, const std::vector<std::uint8_t>& covered);

/// Step of a half relative to the value: 2^-11 where the hardware rounds, 2^-10 where it truncates, as lavapipe does.
inline constexpr double kHalfStep = 1.0 / 1024;

inline constexpr const char* kOutline =
    "outlines and borders of charts, where a rasteriser that snaps vertices to 1/256 pixel may see the other side";
/// Texels of the shadow map by which its filter softens an edge: half of 3 + 1, and one for its grid.
inline constexpr double kShadowEdge = 3;
inline constexpr const char* kShadowApart = "within 3 texels of the shadow map from where light is cut off (the map's filter and "
                                            "resolution), or seen edge-on by the light, N.L below 0.15 "
                                            "(its tolerance and the horizon term)";
/// Limits of a picture of shadows where it is not apart: 0 and 1 exactly in setting corrected, with false shadows in the printed ones.
[[nodiscard]] Limits shadowLimits(const Context& context);

/// Of the drawn specular layer: what it mirrors of light along the normal, and of light from all sides.
[[nodiscard]] Result<void> measureAlbedos(ModuleReport& report, const Context& context);
/// Of technique CoatChance against light on paths through its strands: mean and blocks of each phase, and their pictures.
[[nodiscard]] Result<void> judgeFibres(ModuleReport& report, const Context& context);

[[nodiscard]] Result<ModuleReport> verifyOriginalTexture(const Context& context);
[[nodiscard]] Result<ModuleReport> verifySpecular(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyShadowMap(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyTsm(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyStretch(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyIrradiance(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyConvolution(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyMain(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyPyramid(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyLamps(const Context& context);
[[nodiscard]] Result<ModuleReport> verifySurroundings(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyFur(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyFurRoots(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyFurCoat(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyBeckmann(const Context& context);
[[nodiscard]] Result<ModuleReport> verifyEnergyAttenuation(const Context& context);

} // namespace tegument::verify
