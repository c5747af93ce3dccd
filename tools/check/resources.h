#pragma once
// Shader model 3's headroom as a table: what each pass takes, and how much there is.

#include "tools/check/check.h"

namespace tegument {

/// One stage of a pass in every variant that was checked.
struct ResourceRow {
    std::string effect; // file name
    std::string technique;
    std::string pass;
    std::string entry;
    std::string profile;
    std::vector<Sm3Usage> usage; // in the order of variants
};

struct ResourceTable {
    std::vector<std::string> variants;
    std::vector<ResourceRow> rows;
};

/// From a report that holds fx_2_0.
[[nodiscard]] ResourceTable resourceTable(const CheckReport& report);

/// As Markdown: one table for each effect; a cell holds one number, or one for each variant where they differ.
[[nodiscard]] std::string toMarkdown(const ResourceTable& table);

} // namespace tegument
