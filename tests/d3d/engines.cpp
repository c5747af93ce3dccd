#include "tests/d3d/engines.h"

#include "host/support/file.h"
#include "tests/d3d/job_file.h"
#include "tools/direct3d/microsoft.h"
#include "tools/direct3d/microsoft_messages.h"
#include "tools/direct3d/wine.h"
#include "tools/direct3d9/reference.h"
#include "tools/emit/emit.h"

#include <fmt/format.h>

#include <map>
#include <set>
#include <span>
#include <sstream>

namespace tegument::test {

namespace fs = std::filesystem;

namespace {

constexpr double kStartSeconds = 60; // a slow machine's first process in the prefix
constexpr double kDrawSeconds = 10;  // the longest technique takes under a second

std::vector<std::pair<std::string, std::string>> definesFor(const Case& drawn, const char* target) {
    auto defines = drawn.defines();
    if (*target != '\0') defines.emplace_back(target, "1");
    return defines;
}

void addEntry(const Case& drawn, const std::optional<ShaderReference>& shader, const char* profile,
              std::map<std::string, MicrosoftJob>& jobs) {
    if (!shader) return;
    const std::string file = entryFile(drawn, *shader);
    jobs[file] = {.profile = profile,
                  .entry = shader->entry,
                  .source = drawn.effect,
                  .defines = definesFor(drawn, "FX_ENTRY"),
                  .output = drawings() / file,
                  .includeFolders = drawn.includeFolders};
}

void addJobs(const Case& drawn, std::map<std::string, MicrosoftJob>& jobs) {
    for (const Engine engine : {Engine::Direct3D9, Engine::Direct3D10}) {
        if (!drawnBy(drawn, engine)) continue;
        const bool nine = engine == Engine::Direct3D9;
        const std::string file = effectFile(drawn, engine);
        jobs[file] = {.profile = nine ? "fx_2_0" : "fx_4_0",
                      .source = drawn.effect,
                      .defines = definesFor(drawn, nine ? "" : "FX_D3D10"),
                      .output = drawings() / file};
    }
    const auto effect = loadCase(drawn);
    if (!effect) return;
    for (const Pass& pass : effect->findTechnique(drawn.technique)->passes) {
        addEntry(drawn, pass.vertexShader, "vs_5_0", jobs);
        addEntry(drawn, pass.pixelShader, "ps_5_0", jobs);
        addEntry(drawn, pass.computeShader, "cs_5_0", jobs);
    }
}

std::vector<std::string> linesOf(const fs::path& file) {
    std::vector<std::string> lines;
    const auto text = readFile(file);
    std::istringstream in(text ? *text : "");
    for (std::string line; std::getline(in, line);)
        lines.push_back(line);
    return lines;
}

/// One process: as many results as it got through.
Result<std::vector<std::string>> drawBatch(Engine engine, const fs::path& client, std::span<const Case> cases,
                                           std::span<const std::string> jobFiles) {
    std::string list;
    for (std::size_t i = 0; i < cases.size(); ++i)
        list += fmt::format("{} {}.{}.\n", jobFiles[i], cases[i].name(), engineName(engine));
    const std::string jobs = engineName(engine) + ".jobs";
    const std::string results = engineName(engine) + ".results";
    std::error_code code;
    fs::remove(drawings() / results, code);
    if (const auto written = writeFile(drawings() / jobs, list); !written) return written.error();
    const auto run = [&] {
        return runInWine12(client, {engineName(engine).substr(3), windowsPath(drawings()), jobs, results},
                           kStartSeconds + kDrawSeconds * static_cast<double>(cases.size()));
    };
    auto process = run();
    // On a busy machine Wine has been seen to end at its start, without a word. What brings down the first case does so twice.
    if (process && !process->timedOut && linesOf(drawings() / results).empty()) process = run();
    if (!process) return process.error();
    std::vector<std::string> lines = linesOf(drawings() / results);
    if (lines.size() < cases.size() && (lines.empty() || lines.back() == "ok"))
        lines.push_back(process->timedOut ? "the client did not end in time"
                                          : fmt::format("the client ended with exit code {} {}", process->exitCode, process->output));
    return lines;
}

} // namespace

Result<ProcessResult> runInWine12(const fs::path& program, const std::vector<std::string>& arguments, double seconds) {
    auto command = wineProcess(program, arguments);
    if (!command) return command.error();
    for (const auto& [name, value] : {std::pair<const char*, const char*>("VK_LAYER_PATH", TEGUMENT_D3D12_LAYER),
                                      {"VK_INSTANCE_LAYERS", "VK_LAYER_TEGUMENT_listed"},
                                      {"VKD3D_CONFIG", "virtual_heaps"}})
        command->environment.emplace_back(name, value);
    return runProcess(*command, seconds);
}

Result<std::vector<std::string>> compileAll(const std::vector<Case>& cases) {
    std::map<std::string, MicrosoftJob> byFile;
    for (const Case& drawn : cases)
        addJobs(drawn, byFile);
    std::vector<MicrosoftJob> jobs;
    jobs.reserve(byFile.size());
    for (auto& [file, job] : byFile)
        jobs.push_back(std::move(job));
    const auto results = compileWithMicrosoft(jobs);
    if (!results) return results.error();
    std::vector<std::string> refused;
    for (std::size_t i = 0; i < jobs.size(); ++i)
        if (!(*results)[i].ok && !(*results)[i].diagnostics.empty())
            refused.push_back(fmt::format("{} {}: {}", jobs[i].profile, jobs[i].entry, format((*results)[i].diagnostics.front())));
    return refused;
}

Result<void> emitAll(const std::vector<Case>& cases) {
    std::set<std::string> done;
    for (const Case& drawn : cases) {
        if (!done.insert(drawn.effectName()).second) continue;
        CheckOptions options{.variants = {{.defines = drawn.defines()}}, .includeFolders = drawn.includeFolders};
        const CheckReport report = checkEffects({drawn.effect}, {Target::Sm5}, options);
        const auto written =
            emitEffect(report.files.at(0), {.folder = drawings() / (drawn.effectName() + ".emitted"), .kinds = {Target::Sm5}});
        if (!written) return written.error();
    }
    return {};
}

Result<void> drawAll(Engine engine, const std::vector<Case>& cases, const std::vector<std::string>& jobFiles) {
    const auto client = direct3dClientIn(drawings());
    if (!client) return client.error();
    for (std::size_t done = 0; done < cases.size();) {
        const auto lines = drawBatch(engine, *client, std::span(cases).subspan(done), std::span(jobFiles).subspan(done));
        if (!lines) return lines.error();
        for (const std::string& line : *lines)
            if (auto written = writeFile(statusFile(cases[done++], engine), line); !written) return written;
    }
    return {};
}

} // namespace tegument::test
