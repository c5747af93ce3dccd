#pragma once
// Every module of the library against an independent reference in double precision.

#include "generated/setting_names.h"
#include "host/gpu/gpu.h"
#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace tegument {

/// One figure and the largest value that passes. Relative figures are to the reference's mean, as measured over the pixels that count.
struct Metric {
    std::string module;  // "Irradiance"
    std::string setting; // "seed", "deon2007", "corrected"
    std::string name;    // "gIrradianceMap: rel_l2"
    double value = 0;
    double limit = 0;
    bool pass = false;
    std::string why; // where the limit comes from
};

enum class PictureRole { Rendered, Reference, Difference };

struct VerifyPicture {
    std::string subject; // "gIrradianceMap": pictures of one subject belong side by side
    PictureRole role = PictureRole::Rendered;
    Image image; // linear; a difference is |a - b| / mean(b), pixels that do not count are 0
};

struct ModuleReport {
    std::string module;
    std::string summary; // what was compared with what, one sentence
    std::vector<Metric> metrics;
    std::vector<VerifyPicture> pictures;
    std::vector<std::string> notes; // pixels treated apart, their share and why
    std::vector<Diagnostic> warnings;

    [[nodiscard]] bool pass() const;
};

struct VerifyOptions {
    std::filesystem::path effects = "effects"; // folder of the .fx files
    std::string setting = kSettingCorrected;
    Compiler compiler = Compiler::Dxc;
    int mapSize = 256;     // texels a side of the maps in texture space
    int pictureSize = 256; // pixels a side of what the camera sees
    /// Both or neither: what to draw instead of the built-in body (verificationMesh).
    const Mesh* mesh = nullptr;
    const Workspace* workspace = nullptr;
};

/// In the order of the pipeline; only those whose effect exists in `effects`.
[[nodiscard]] std::vector<std::string> verifiableModules(const std::filesystem::path& effects = "effects");

/// A closed body 40 x 80 mm, 2 to 12 mm thick, front and back in a chart each, with a bump that casts a shadow, a colour map and curvature
/// everywhere. Made from formulas, so every machine has it.
[[nodiscard]] Mesh verificationMesh();

/// TG4050 unknown module, TG4051 unknown setting; and whatever loading or running the effect says.
[[nodiscard]] Result<ModuleReport> verifyModule(gpu::Device& device, const std::string& module, const VerifyOptions& options = {});

} // namespace tegument
