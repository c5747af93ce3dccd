#include "tools/direct3d/microsoft.h"

#include "host/support/file.h"
#include "host/support/system.h"
#include "host/support/temporary.h"
#include "tools/direct3d/driver.h"
#include "tools/direct3d/effect_binary.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/microsoft_reflection.h"
#include "tools/direct3d/sm3.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>
#include <future>
#include <iterator>
#include <span>
#include <thread>

namespace tegument {

namespace fs = std::filesystem;

namespace {

constexpr double kStartSeconds = 60;
constexpr int kStarts = 3;
constexpr std::size_t kMostProcesses = 8;

Error notRunnable(std::string text, std::string hint = {}) {
    return machineError(3104, std::move(text), std::move(hint));
}

bool isSm3(const MicrosoftJob& job) {
    return job.profile == "vs_3_0" || job.profile == "ps_3_0" || job.profile == "listing";
}

/// The list separates fields by tabs, folders by bars and jobs by line breaks; a backslash would end a folder's name on the other side.
bool canBeListed(const MicrosoftJob& job) {
    const auto clean = [](std::string_view text) { return std::ranges::none_of(text, [](unsigned char c) { return c < ' '; }); };
    const auto path = [&](const fs::path& p) { return clean(p.string()) && p.generic_string().find('\\') == std::string::npos; };
    return clean(job.profile) && clean(job.entry) && path(job.source) && path(job.output) &&
           std::ranges::all_of(job.includeFolders,
                               [&](const fs::path& p) { return path(p) && p.string().find('|') == std::string::npos; }) &&
           std::ranges::all_of(job.defines, [&](const auto& define) { return clean(define.first) && clean(define.second); });
}

MicrosoftResult failedJob(const MicrosoftJob& job, int code, std::string text, std::string hint = {}) {
    return {.ok = false,
            .diagnostics = {{.code = code, .at = {.file = job.source.string()}, .text = std::move(text), .hint = std::move(hint)}}};
}

/// Result 0x80070002: the file is not there; others come without a message, too.
Diagnostic withoutMessage(const MicrosoftJob& job, std::uint32_t code) {
    constexpr std::uint32_t kNotFound = 0x80070002;
    constexpr std::uint32_t kNoPath = 0x80070003;
    const std::string why =
        code == kNotFound || code == kNoPath ? "the file cannot be opened" : fmt::format("failed without a message (result {:#x})", code);
    return failedJob(job, 3101, why).diagnostics.front();
}

/// The first included file that may not be read; a message could show its text.
std::optional<Diagnostic> readOutside(const nlohmann::json& json, const MicrosoftJob& job) {
    if (!job.roots || !json.contains("included") || !json["included"].is_array()) return std::nullopt;
    for (const auto& name : json["included"]) {
        if (!name.is_string()) continue;
        const fs::path path = unixPath(name.get<std::string>());
        if (!job.roots->hold(path)) return outsideOf(path, {.file = job.source.string()});
    }
    return std::nullopt;
}

/// Where what was compiled is kept: a folder for each version of the compiler (and of the files' form, the number). Empty where there can
/// be none.
fs::path storeFolder() {
    const auto library = readFile(microsoftCompilerLibrary());
    if (!library) return {};
    fs::path folder = cacheFolder() / "microsoft" / ("1-" + contentHash(*library));
    std::error_code code;
    fs::create_directories(folder, code);
    return code ? fs::path() : fs::absolute(folder, code);
}

/// The jobs of one call and the folder in which they exchange files with the processes that do them.
class Jobs {
public:
    Jobs(std::span<const MicrosoftJob> jobs, double jobSeconds) : jobs_(jobs), jobSeconds_(jobSeconds), results_(jobs.size()) {}

    /// Writes the list, and the texts that it names.
    Result<ProcessCommand> prepare() {
        std::error_code code;
        const fs::path& folder = folder_.path();
        if (folder.empty()) return notRunnable("cannot create a temporary folder");
        fs::create_directory(folder / "claims", code);
        if (code) return notRunnable(fmt::format("cannot write into {}: {}", folder.string(), code.message()));
        std::string list;
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            list += line(i);
            if (jobs_[i].profile != "listing") continue;
            if (auto written = writeFile(file(i, "in"), jobs_[i].shader); !written) return written.error();
        }
        if (auto written = writeFile(folder / "jobs.txt", list); !written) return written.error();
        std::vector<std::string> arguments{windowsPath(folder / "jobs.txt"), windowsPath(folder / "claims")};
        if (const fs::path store = storeFolder(); !store.empty()) arguments.push_back(windowsPath(store));
        return driverProcess(folder, std::move(arguments));
    }

    /// One process after the other until every job is claimed; a process that ends early takes one job with it. One that ends, or is
    /// silent, before its first job is started again: Wine's server, ending after the last program, can take a new one with it.
    Result<void> work(const ProcessCommand& command) {
        for (int left = kStarts;;) {
            auto process = BackgroundProcess::start(command);
            if (!process) return process.error();
            const Ended ended = follow(*process);
            if (ended.regular) return {};
            if (!ended.at && (left -= ended.timedOut ? 2 : 1) > 0) continue;
            if (!ended.at || results_[*ended.at]) return notStarted(ended); // each job is claimed once: Wine says what it should not
            results_[*ended.at] = failedJob(jobs_[*ended.at], 3103, broughtDown(jobs_[*ended.at], ended.timedOut));
        }
    }

    std::vector<MicrosoftResult> results() && {
        std::vector<MicrosoftResult> all;
        for (std::size_t i = 0; i < results_.size(); ++i)
            all.push_back(results_[i] ? std::move(*results_[i]) : failedJob(jobs_[i], 3103, broughtDown(jobs_[i], false)));
        return all;
    }

private:
    struct Ended {
        bool regular = false;
        bool timedOut = false;
        std::optional<std::size_t> at; // the job in hand
        std::string said;
    };

    [[nodiscard]] fs::path file(std::size_t job, std::string_view ending) const {
        return folder_.path() / fmt::format("{}.{}", job, ending);
    }

    [[nodiscard]] std::string line(std::size_t index) const {
        const MicrosoftJob& job = jobs_[index];
        std::error_code code;
        const fs::path source = job.profile == "listing" ? file(index, "in") : fs::absolute(job.source, code);
        std::string folders;
        for (const fs::path& folder : job.includeFolders)
            folders += (folders.empty() ? "" : "|") + windowsPath(fs::absolute(folder, code));
        std::string text = fmt::format("{}\t{}\t{}\t{}\t{}\t{}", job.profile, job.entry, windowsPath(source),
                                       windowsPath(file(index, "bin")), isSm3(job) ? windowsPath(file(index, "asm")) : "", folders);
        for (const auto& [name, value] : job.defines)
            text += fmt::format("\t{}={}", name, value);
        return text + (job.compatible ? "\t/Gec=1\n" : "\n");
    }

    static std::string broughtDown(const MicrosoftJob& job, bool timedOut) {
        return fmt::format("Microsoft's compiler {} on {} {}", timedOut ? "did not end in time" : "crashed", job.profile, job.entry);
    }

    static Error notStarted(const Ended& ended) {
        return notRunnable(fmt::format("Microsoft's compiler could not be run in Wine: {}{}", ended.timedOut ? "no answer" : "it ended",
                                       ended.said.empty() ? "" : ", " + ended.said),
                           fmt::format("if it stays so, remove {}: Wine makes it anew", (cacheFolder() / "wine").string()));
    }

    /// Reads what the process says until it ends, says that it has done, or is silent for too long.
    Ended follow(BackgroundProcess& process) {
        Ended ended;
        for (;;) {
            const auto said = process.readLine(ended.at ? jobSeconds_ : kStartSeconds);
            if (!said) {
                ended.timedOut = process.running();
                return ended;
            }
            if (*said == "end") {
                ended.regular = true;
                return ended;
            }
            if (said->starts_with("begin "))
                ended.at = static_cast<std::size_t>(std::atoll(said->c_str() + 6));
            else if (said->starts_with('{') && ended.at)
                take(*said, *std::exchange(ended.at, std::nullopt));
            else
                ended.said = *said;
            if (ended.at && *ended.at >= jobs_.size()) ended.at.reset();
        }
    }

    void take(const std::string& said, std::size_t index) {
        const MicrosoftJob& job = jobs_[index];
        const auto json = nlohmann::json::parse(said, nullptr, false);
        const auto has = [&](const char* name, bool (nlohmann::json::*is)() const noexcept) {
            return json.is_object() && json.contains(name) && (json[name].*is)();
        };
        using Json = nlohmann::json;
        if (!has("ok", &Json::is_boolean) || !has("ms", &Json::is_number) || !has("messages", &Json::is_string) ||
            !has("result", &Json::is_number))
            return;
        MicrosoftResult result{.ok = json["ok"].get<bool>(), .milliseconds = json["ms"].get<double>()};
        result.kept = json.value("kept", false);
        if (const auto outside = readOutside(json, job)) {
            result.ok = false;
            result.diagnostics = {*outside};
            results_[index] = std::move(result);
            return;
        }
        Messages messages = readMicrosoftMessages(json["messages"].get<std::string>(), job.source, job.includeFolders,
                                                  job.roots.value_or(Roots{.anywhere = true}));
        if (!result.ok && messages.errors.empty()) messages.errors.push_back(withoutMessage(job, json["result"].get<std::uint32_t>()));
        result.diagnostics = shortened(std::move(messages.errors));
        for (Diagnostic& warning : shortened(std::move(messages.warnings)))
            result.diagnostics.push_back(std::move(warning));
        if (result.ok && json.contains("reflection")) result.sm5 = readSm5Reflection(json["reflection"]);
        if (result.ok) addContent(result, index);
        results_[index] = std::move(result);
    }

    void addContent(MicrosoftResult& result, std::size_t index) const {
        const MicrosoftJob& job = jobs_[index];
        if (isSm3(job))
            if (const auto listing = readFile(file(index, "asm"))) result.sm3 = readSm3Listing(*listing);
        if (job.profile == "listing") return;
        if (auto binary = readFile(file(index, "bin"))) result.binary = std::move(*binary);
        if (!job.output.empty())
            if (const auto written = writeFile(job.output, result.binary); !written) {
                result.ok = false;
                result.diagnostics = written.error().diagnostics;
            }
        if (!job.profile.starts_with("fx_")) return;
        if (const auto content = readEffectBinary(result.binary)) {
            result.techniqueCount = content->techniques;
            result.passCount = content->passes;
            result.shaderCount = content->shaders;
        }
    }

    Temporary folder_{newTemporaryFolder()};
    std::span<const MicrosoftJob> jobs_;
    double jobSeconds_;
    std::vector<std::optional<MicrosoftResult>> results_; // each written by the one process that claimed the job
};

/// The processes' threads live as long as their processes, which would otherwise end with them.
Result<std::vector<MicrosoftResult>> runAll(const std::vector<MicrosoftJob>& listed, double jobSeconds) {
    Jobs jobs(listed, jobSeconds);
    const auto command = jobs.prepare();
    if (!command) return command.error();
    const std::size_t count = std::min<std::size_t>({listed.size(), std::max(1U, std::thread::hardware_concurrency()), kMostProcesses});
    std::vector<std::future<Result<void>>> workers;
    for (std::size_t i = 0; i < count; ++i)
        workers.push_back(std::async(std::launch::async, [&] { return jobs.work(*command); }));
    std::optional<Error> failure;
    for (auto& worker : workers)
        if (const auto done = worker.get(); !done) failure = done.error();
    if (failure) return *failure;
    return std::move(jobs).results();
}

} // namespace

fs::path microsoftCompilerLibrary() {
    const char* own = std::getenv("TEGUMENT_D3DCOMPILER");
    std::error_code code;
    return fs::absolute(own != nullptr && *own != '\0' ? fs::path(own) : usualCompiler().file, code);
}

std::string microsoftCompilerMissing() {
    std::error_code code;
    if (std::string missing = driverMissing(); !missing.empty()) return missing;
    if (fs::is_regular_file(microsoftCompilerLibrary(), code)) return {};
    const UsualCompiler usual = usualCompiler();
    if (microsoftCompilerLibrary() != fs::absolute(usual.file, code))
        return fmt::format("there is no {}", microsoftCompilerLibrary().string());
    return fmt::format("there is no {} ({})", usual.file.filename().string(), usual.hint); // manifests hold this: no folder of this machine
}

Result<std::vector<MicrosoftResult>> compileWithMicrosoft(const std::vector<MicrosoftJob>& jobs, double jobSeconds) {
    if (const std::string missing = microsoftCompilerMissing(); !missing.empty()) return notRunnable(missing);
    std::vector<MicrosoftJob> listed;
    std::ranges::copy_if(jobs, std::back_inserter(listed), canBeListed);
    auto done = runAll(listed, jobSeconds);
    if (!done) return done.error();
    std::vector<MicrosoftResult> results;
    results.reserve(jobs.size());
    auto next = done->begin();
    for (const MicrosoftJob& job : jobs)
        results.push_back(canBeListed(job) ? std::move(*next++)
                                           : failedJob(job, 3105, "this path or define cannot be handed to Microsoft's compiler",
                                                       "use names without tab, line break, backslash, and folders without '|'"));
    return results;
}

} // namespace tegument
