#pragma once
// Every module over its hard cases: values that are not finite, and the largest errors with what causes them (docs/design/stability.md).

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "host/support/result.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tegument::bench {

struct StabilityRow {
    std::string part;     // one of stabilityParts()
    std::string module;   // "Main, DEonLuebke"
    std::string hardCase; // "m = 0.01, light at 60 degrees"
    std::string figure;   // what `value` is
    double value = 0;
    std::optional<double> limit; // none: reported, not judged
    std::string cause;           // the input of the largest error: pixel or texel, parameters
    std::size_t notFinite = 0;   // values that are NaN or infinite
    std::string why;             // where the limit comes from

    [[nodiscard]] bool pass() const;
};

struct StabilityOptions {
    std::filesystem::path effects = "effects"; // folder of the .fx files
    Compiler compiler = Compiler::Dxc;
    int size = 128;                   // texels a side of the maps, pixels a side of the pictures
    std::vector<std::string> parts;   // empty: all
    std::vector<std::string> modules; // names of .fx files; empty: all
    /// Another device to compare with. Null: the machine's software device, where it has one and it is not the first.
    gpu::Device* other = nullptr;
    std::function<void(const std::string&)> say; // progress; may be empty
};

struct StabilityReport {
    std::string device;
    std::string driver;
    std::string compiler;
    int size = 0; // texels a side of the maps
    std::vector<StabilityRow> rows;
    std::vector<std::string> notes; // what was not measured, and why

    [[nodiscard]] bool pass() const;
};

/// In the order of the report.
[[nodiscard]] const std::vector<std::string>& stabilityParts();

/// TG8080 a part that does not exist; TG8081 no effect to draw; and whatever loading or running an effect on the plain scene says. A hard
/// scene that an effect refuses is a row of the report.
[[nodiscard]] Result<StabilityReport> measureStability(gpu::Device& device, const StabilityOptions& options = {});

/// Every figure of a row; numbers that are not finite are null.
[[nodiscard]] std::string stabilityJson(const StabilityReport& report);
/// None when the text is not what stabilityJson wrote.
[[nodiscard]] std::optional<StabilityReport> stabilityFromJson(const std::string& text);

/// The tables of docs/design/stability.md.
[[nodiscard]] std::string stabilityMarkdown(const StabilityReport& report);

} // namespace tegument::bench
