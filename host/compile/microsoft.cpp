#include "host/compile/microsoft.h"

#include "host/compile/effect_binary.h"
#include "host/compile/microsoft_messages.h"
#include "host/compile/sm3.h"
#include "host/compile/wine.h"
#include "host/support/file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <span>

#include <unistd.h>

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr double kStartSeconds = 60;
constexpr double kJobSeconds = 20; // the longest seen is 1.4 s

fs::path compilerLibrary() {
    const char* own = std::getenv("TEGUMENT_D3DCOMPILER");
    std::error_code code;
    return fs::absolute(own != nullptr && *own != '\0' ? fs::path(own) : cacheFolder() / "tools/microsoft/d3dcompiler_47.dll", code);
}

/// Beside the program, where it was installed, where it was built.
fs::path driver() {
    std::error_code code;
    const fs::path here = fs::read_symlink("/proc/self/exe", code).parent_path();
    for (const fs::path& candidate : {here / "hlslc.exe", here / "../lib/tegument/hlslc.exe", fs::path(TEGUMENT_HLSLC)})
        if (!candidate.empty() && fs::is_regular_file(candidate, code)) return candidate;
    return {};
}

/// A folder of our own, removed with all that is in it.
class Folder {
public:
    Folder() {
        std::string pattern = (fs::temp_directory_path() / "tegument-XXXXXX").string();
        if (mkdtemp(pattern.data()) != nullptr) path = pattern;
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() {
        std::error_code code;
        if (!path.empty()) fs::remove_all(path, code);
    }
    fs::path path;
};

Error notRunnable(std::string text, std::string hint = {}) {
    return machineError(3104, std::move(text), std::move(hint));
}

/// Wine looks for a "native" library beside the program: both come into one folder.
Result<void> bringTogether(const fs::path& folder) {
    std::error_code code;
    if (folder.empty()) return notRunnable("cannot create a temporary folder");
    fs::create_symlink(fs::absolute(driver(), code), folder / "hlslc.exe", code);
    if (!code) fs::create_symlink(compilerLibrary(), folder / "d3dcompiler_47.dll", code);
    if (code) return notRunnable(fmt::format("cannot link the compiler into {}: {}", folder.string(), code.message()));
    return {};
}

fs::path outputPath(const MicrosoftJob& job, const fs::path& folder, std::size_t index) {
    std::error_code code;
    return job.output.empty() ? folder / fmt::format("{}.bin", index) : fs::absolute(job.output, code);
}

fs::path listingPath(const fs::path& folder, std::size_t index) {
    return folder / fmt::format("{}.asm", index);
}

bool isSm3(const MicrosoftJob& job) {
    return job.profile == "vs_3_0" || job.profile == "ps_3_0";
}

/// The list separates fields by tabs and jobs by line breaks; a backslash would end a folder's name on the other side.
bool canBeListed(const MicrosoftJob& job) {
    const auto clean = [](std::string_view text) { return std::ranges::none_of(text, [](unsigned char c) { return c < ' '; }); };
    const auto path = [&](const fs::path& p) { return clean(p.string()) && p.string().find('\\') == std::string::npos; };
    return clean(job.profile) && clean(job.entry) && path(job.source) && path(job.output) &&
           std::ranges::all_of(job.defines, [&](const auto& define) { return clean(define.first) && clean(define.second); });
}

std::string jobLine(const MicrosoftJob& job, const fs::path& folder, std::size_t index) {
    std::error_code code;
    std::string line = fmt::format("{}\t{}\t{}\t{}\t{}", job.profile, job.entry, windowsPath(fs::absolute(job.source, code)),
                                   windowsPath(outputPath(job, folder, index)), isSm3(job) ? windowsPath(listingPath(folder, index)) : "");
    for (const auto& [name, value] : job.defines)
        line += fmt::format("\t{}={}", name, value);
    return line + "\n";
}

MicrosoftResult notListable(const MicrosoftJob& job) {
    return {.diagnostics = {{.code = 3105,
                             .at = {.file = job.source.string(), .byte = {}},
                             .text = "this path or define cannot be handed to Microsoft's compiler",
                             .hint = "use names without tab, line break and backslash",
                             .sourceLine = {}}},
            .sm3 = {}};
}

void addContent(MicrosoftResult& result, const MicrosoftJob& job, const fs::path& folder, std::size_t index) {
    const auto binary = readFile(outputPath(job, folder, index));
    if (!binary) return;
    result.bytes = binary->size();
    if (const auto content = readEffectBinary(*binary); content && job.profile.starts_with("fx_")) {
        result.techniqueCount = content->techniques;
        result.passCount = content->passes;
        result.shaderCount = content->shaders;
    }
    if (!isSm3(job)) return;
    if (const auto listing = readFile(listingPath(folder, index))) result.sm3 = readSm3Listing(*listing);
}

/// Result 0x80070002: the file is not there; others come without a message, too.
Diagnostic withoutMessage(const MicrosoftJob& job, std::uint32_t code) {
    constexpr std::uint32_t kNotFound = 0x80070002;
    constexpr std::uint32_t kNoPath = 0x80070003;
    const std::string why =
        code == kNotFound || code == kNoPath ? "the file cannot be opened" : fmt::format("failed without a message (result {:#x})", code);
    return {.severity = Severity::Error,
            .code = 3101,
            .at = {.file = job.source.string(), .byte = {}},
            .text = why,
            .hint = {},
            .sourceLine = {}};
}

std::optional<MicrosoftResult> readResult(const std::string& line, const MicrosoftJob& job, const fs::path& folder, std::size_t index) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (!json.is_object() || !json.contains("ok") || !json.contains("ms") || !json.contains("messages") || !json.contains("result"))
        return {};
    MicrosoftResult result{.ok = json["ok"].get<bool>(), .diagnostics = {}, .sm3 = {}, .milliseconds = json["ms"].get<double>()};
    Messages messages = readMicrosoftMessages(json["messages"].get<std::string>(), job.source);
    if (!result.ok && messages.errors.empty()) messages.errors.push_back(withoutMessage(job, json["result"].get<std::uint32_t>()));
    result.diagnostics = shortened(std::move(messages.errors));
    for (Diagnostic& warning : shortened(std::move(messages.warnings)))
        result.diagnostics.push_back(std::move(warning));
    if (result.ok) addContent(result, job, folder, index);
    return result;
}

MicrosoftResult broughtDown(const MicrosoftJob& job, const ProcessResult& process) {
    const std::string how = process.timedOut ? "did not end in time" : fmt::format("ended with exit code {}", process.exitCode);
    return {.ok = false,
            .diagnostics = {{.severity = Severity::Error,
                             .code = 3103,
                             .at = {.file = job.source.string(), .byte = {}},
                             .text = fmt::format("Microsoft's compiler {} on {} {}", how, job.profile, job.entry),
                             .hint = {},
                             .sourceLine = {}}},
            .sm3 = {}};
}

/// Runs jobs in one process; the results of those that it got through, then one for the job that it died of.
Result<std::vector<MicrosoftResult>> runBatch(std::span<const MicrosoftJob> jobs, const fs::path& folder, std::size_t first) {
    std::string list;
    for (std::size_t i = 0; i < jobs.size(); ++i)
        list += jobLine(jobs[i], folder, first + i);
    const fs::path jobsFile = folder / "jobs.txt";
    const fs::path resultsFile = folder / "results.txt";
    if (auto written = writeFile(jobsFile, list); !written) return written.error();
    std::error_code code;
    fs::remove(resultsFile, code);
    const auto process = runInWine(folder / "hlslc.exe", {windowsPath(jobsFile), windowsPath(resultsFile)},
                                   kStartSeconds + kJobSeconds * static_cast<double>(jobs.size()));
    if (!process) return process.error();
    const auto text = readFile(resultsFile);
    if (!text)
        return notRunnable(fmt::format("Microsoft's compiler could not be run in Wine: exit code {}{}{}", process->exitCode,
                                       process->output.empty() ? "" : ", ", process->output),
                           fmt::format("if it stays so, remove {}: Wine makes it anew", (cacheFolder() / "wine").string()));

    std::vector<MicrosoftResult> results;
    for (std::size_t at = 0; results.size() < jobs.size();) {
        const std::size_t end = text->find('\n', at);
        auto result = end == std::string::npos
                          ? std::nullopt
                          : readResult(text->substr(at, end - at), jobs[results.size()], folder, first + results.size());
        results.push_back(result ? std::move(*result) : broughtDown(jobs[results.size()], *process));
        if (!result) break;
        at = end + 1;
    }
    return results;
}

} // namespace

fs::path microsoftCompilerLibrary() {
    return compilerLibrary();
}

std::string microsoftCompilerMissing() {
    std::error_code code;
    if (std::string missing = wineMissing(); !missing.empty()) return missing;
    if (driver().empty()) return "hlslc.exe was not built (g++-mingw-w64-x86-64 was not installed)";
    if (!fs::is_regular_file(compilerLibrary(), code))
        return fmt::format("there is no {} (./bootstrap test fetches it)", compilerLibrary().string());
    return {};
}

Result<std::vector<MicrosoftResult>> compileWithMicrosoft(const std::vector<MicrosoftJob>& jobs) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) return notRunnable(missing);
    const Folder folder;
    if (auto ready = bringTogether(folder.path); !ready) return ready.error();
    std::vector<MicrosoftJob> listed;
    std::ranges::copy_if(jobs, std::back_inserter(listed), canBeListed);
    std::vector<MicrosoftResult> done;
    while (done.size() < listed.size()) {
        auto batch = runBatch(std::span(listed).subspan(done.size()), folder.path, done.size());
        if (!batch) return batch.error();
        std::ranges::move(*batch, std::back_inserter(done));
    }
    std::vector<MicrosoftResult> results;
    results.reserve(jobs.size());
    auto next = done.begin();
    for (const MicrosoftJob& job : jobs)
        results.push_back(canBeListed(job) ? std::move(*next++) : notListable(job));
    return results;
}

} // namespace tegument
