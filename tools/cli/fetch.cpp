#include "tools/cli/fetch.h"

#include "host/support/text.h"
#include "meshprep/assets/names.h"
#include "tools/process/process.h"

#include <fmt/format.h>

namespace tegument::app {

namespace {

constexpr const char* kScript = "meshprep/fetch.py";
constexpr double kTimeLimit = 1800; // seconds: 48 MB over a slow line

std::string lastLine(std::string_view text) {
    text = trim(text);
    const std::size_t end = text.rfind('\n');
    return std::string(end == std::string_view::npos ? text : text.substr(end + 1));
}

} // namespace

Result<void> fetch(const std::string& what, const std::filesystem::path& folder) {
    const auto python = findProgram("python3");
    if (!python)
        return machineError(8025, fmt::format("{} cannot be fetched: there is no python3", what),
                            "Debian: apt-get install python3 python3-pip");
    const auto done = runProcess({.arguments = {python->string(), assets::ownFile(kScript).string(), what, folder.string()}}, kTimeLimit);
    if (!done) return done.error();
    if (done->timedOut) return machineError(8025, fmt::format("fetching {} took more than {} s", what, kTimeLimit), "try again");
    if (done->exitCode == 0) return {};
    return machineError(8025, fmt::format("{} cannot be fetched", what), lastLine(done->output));
}

} // namespace tegument::app
