#pragma once
// What `tegument verify` found, as one HTML page with its pictures beside it.

#include "host/lab/verify/verify.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

/// A module as it was verified, or why it could not be.
struct VerifiedModule {
    std::string module;
    std::string setting;
    ModuleReport report;
    std::optional<Error> error;

    [[nodiscard]] bool pass() const { return !error && report.pass(); }
};

struct PageHeader {
    std::string device;
    std::string driver;
    std::string compiler;
    std::string mesh;
    int mapSize = 0;
};

/// Writes index.html and the pictures into `folder`; returns the page's path.
[[nodiscard]] Result<std::filesystem::path> writePage(const std::filesystem::path& folder, const PageHeader& header,
                                                      const std::vector<VerifiedModule>& modules);

} // namespace tegument::app
