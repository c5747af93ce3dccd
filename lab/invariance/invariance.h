#pragma once
// Every technique of every effect draws the same picture of the same scene, however that scene is put: in another unit, turned, mirrored,
// its triangles in another order (docs/design/invariance.md).

#include "host/gpu/gpu.h"
#include "host/mesh/mesh.h"
#include "host/scene/workspace.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument {

struct InvarianceOptions {
    std::string setting; // empty: as the effects have it
    Compiler compiler = Compiler::Dxc;
    int mapSize = 192;                   // texels a side of the maps in texture space and of the light's map
    int pictureSize = 192;               // pixels a side; as many as texels, so that a map that is shown is shown texel by texel
    std::vector<std::string> techniques; // only these; empty: all
    std::vector<std::string> cases;      // only these, by name or column; empty: all
    /// Both or neither: what to draw instead of the generated head. In millimetres, where its file has it; `objects` are not looked at.
    const Mesh* mesh = nullptr;
    const Workspace* workspace = nullptr;
    std::filesystem::path folder; // for textures that fur needs; empty: the system's folder for temporary files
};

/// One picture held against the technique's picture of the scene as it was.
struct InvarianceCell {
    std::string effect; // "peers/Burley.fx", as the file was named
    std::string technique;
    std::string column; // "world's unit": what the table shows of several cases is their largest difference
    std::string name;   // "world in metres"
    double relativeL2 = 0;
    double beyond = 0;      // share of the pixels that differ by more than 1e-2 of the mean
    double largest = 0;     // relative to the mean
    double limit = 0;       // of relativeL2
    double beyondLimit = 0; // of `beyond`
    std::string apart;      // not empty: why the technique's own definition excepts this case; nothing was drawn
    std::string excused;    // not empty: the limits are wider than usual, and this is the measured cause
    std::optional<Error> error;

    [[nodiscard]] bool pass() const;
};

/// The .fx files of a folder and of `peers` in it, sorted.
[[nodiscard]] std::vector<std::filesystem::path> effectFiles(const std::filesystem::path& effects);

/// Names of all cases, in order; and their columns, each once.
[[nodiscard]] std::vector<std::string> invarianceCases();
[[nodiscard]] std::vector<std::string> invarianceColumns();

/// Cells of one column whose limits are wider than usual, with what causes the difference, measured (docs/design/invariance.md,
/// "Exceptions").
struct InvarianceException {
    std::string effect; // "FurRoots"
    std::string column;
    double relativeL2 = 0;
    double beyond = 0;
    std::string cause;
};
[[nodiscard]] const std::vector<InvarianceException>& invarianceExceptions();

/// A head of 200 mm made from formulas: six charts, one of them mirrored, with a colour map and a normal map. No side is like another.
[[nodiscard]] Mesh invarianceMesh();
/// Camera and light that it is seen with.
[[nodiscard]] Workspace invarianceWorkspace();

/// All cells of one effect. What cannot be drawn is an error in its cell; errors of the machine end the run. TG4051 unknown setting.
[[nodiscard]] Result<std::vector<InvarianceCell>> measureInvariance(gpu::Device& device, const std::filesystem::path& effect,
                                                                    const InvarianceOptions& options = {});

/// One row for each technique, one column for each kind of case, and below it whatever is apart, excused or beyond its limits.
[[nodiscard]] std::string invarianceMarkdown(const std::vector<InvarianceCell>& cells);
/// A list of {effect, technique, column, case, rel_l2, beyond, largest, limit, beyond_limit, apart, excused, error, pass}.
[[nodiscard]] std::string invarianceJson(const std::vector<InvarianceCell>& cells);

} // namespace tegument
