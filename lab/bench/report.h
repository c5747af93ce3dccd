#pragma once
// Results as JSON, CSV, Markdown and a table for the terminal.

#include "lab/bench/ablation.h"
#include "lab/bench/bench.h"
#include "lab/bench/growth.h"
#include "lab/bench/motion.h"

#include <string>
#include <vector>

namespace tegument::bench {

struct Machine {
    std::string device;
    std::string driver;
    std::string compiler;
    std::string date; // UTC, 2026-11-21
    std::string version;
    bool cpu = false; // times are good as ratios only
};

/// A list with one object for each row (docs/bench.md); numbers that are not known are null.
[[nodiscard]] std::string toJson(const std::vector<Row>& rows, const Machine& machine);
/// The same figures, a line for each row under a line of names (RFC 4180).
[[nodiscard]] std::string toCsv(const std::vector<Row>& rows, const Machine& machine);

/// Cells of a table for people: a header and the rows.
struct Table {
    std::vector<std::string> header;
    std::vector<std::vector<std::string>> rows;
};
[[nodiscard]] Table toTable(const std::vector<Row>& rows);
[[nodiscard]] Table toTable(const std::vector<Growth>& growth);
[[nodiscard]] Table toTable(const std::vector<AblationRow>& rows);
[[nodiscard]] Table toTable(const std::vector<MotionRow>& rows);

/// {machine, series: [{quantity, what, x, ms, exponent, factor, worst, fixed_ms, ms_per_unit, affine_worst}]}
[[nodiscard]] std::string toJson(const std::vector<Growth>& growth, const Machine& machine);
/// {machine, scene, ablation: [{group, what, ms, noise, change, rel_l2}]}
[[nodiscard]] std::string toJson(const std::vector<AblationRow>& rows, const Machine& machine, const std::string& scene);

/// {machine, scene, motion: [{motion, technique, setting, rel_l2, flicker, largest, light}]}
[[nodiscard]] std::string toJson(const std::vector<MotionRow>& rows, const Machine& machine, const std::string& scene);

/// The tables of docs/design/speed-error.md from any of these four: of a comparison one for each scene, size and machine. TG8076 when it
/// is none of them.
[[nodiscard]] Result<std::string> toMarkdown(const std::string& json, const std::string& nameForMessages);

} // namespace tegument::bench
