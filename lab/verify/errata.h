#pragma once
// What the printed forms cost: each finding about the sources measured, as printed and as corrected (docs/design/skin-error.md).

#include "lab/verify/verify.h"

#include <optional>
#include <string>
#include <vector>

namespace tegument {

/// One figure of one finding. `truth` is the exact value of what the printed form aims at, and the corrected one where it has none of its
/// own: reflectances at normal incidence differ.
struct Erratum {
    std::string finding;  // "Transmission exponent"
    std::string quantity; // "red light through 2 mm"
    double printed = 0;
    double corrected = 0;
    double truth = 0;
    std::optional<double> correctedTruth = {};

    [[nodiscard]] double printedError() const { return printed - truth; }
    [[nodiscard]] double correctedError() const { return corrected - correctedTruth.value_or(truth); }
};

/// Largest and root mean square error of an edge of light on a plane, per channel.
struct EdgeRow {
    std::string name;
    double texel = 0; // mm
    double largest[3] = {0, 0, 0};
    double rms[3] = {0, 0, 0};
};

struct Errata {
    std::vector<Erratum> list;
    std::vector<EdgeRow> edges;
};

/// Formulas in double precision, tables and kernels as the device draws them. `options`: device-side compiler and effects.
[[nodiscard]] Result<Errata> measureErrata(gpu::Device& device, const VerifyOptions& options = {});

/// The tables of docs/design/skin-error.md as Markdown.
[[nodiscard]] std::string errataMarkdown(const Errata& errata);

} // namespace tegument
