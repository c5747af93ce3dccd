// tegument: check, look into and render effect files; prepare meshes for them.

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "host/support/memory_limit.h"
#include "tools/cli/command_line.h"
#include "tools/cli/ends.h"
#include "tools/cli/output.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

namespace tegument::app {

namespace {

std::string compilerText(Compiler compiler) {
    return compilerAvailable(compiler) ? compilerName(compiler) : whyCompilerMissing(compiler);
}

#ifdef __clang__
constexpr const char* kBuiltBy = __VERSION__; // begins with the compiler's name
#else
constexpr const char* kBuiltBy = "GCC " __VERSION__;
#endif

std::string deviceText() {
    const auto device = gpu::Device::create({});
    if (!device) return device.error().diagnostics.front().text;
    const gpu::DeviceInfo& info = device->info();
    return fmt::format("{} ({}), Vulkan {}", info.name, info.driver, info.apiVersion);
}

/// The version alone, or with compilers, libraries and the device, one to a line: for reports of faults.
std::string versionText(bool verbose) {
    if (!verbose) return TEGUMENT_VERSION;
    return fmt::format(
        "tegument {}\nbuilt by    {}\nlibraries   fmt {}.{}.{}, CLI11 {}, nlohmann-json {}.{}.{}\nDXC         {}\nglslang     {}\n"
        "device      {}\ncache       {}",
        TEGUMENT_VERSION, kBuiltBy, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION,
        NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, compilerText(Compiler::Dxc),
        compilerText(Compiler::Glslang), deviceText(), cacheFolder().string());
}

constexpr std::uint64_t kMebibyte = 1024ULL * 1024;
constexpr std::uint64_t kMostMebibytes = kNoMemoryLimit / kMebibyte;

void addMemoryLimit(CLI::App& command) {
    const auto below = command.get_subcommands([](CLI::App*) { return true; });
    for (CLI::App* each : below)
        addMemoryLimit(*each);
    if (command.get_parent() == nullptr || command.get_option_no_throw("--max-memory") != nullptr) return;
    command
        .add_option_function<std::uint64_t>(
            "--max-memory", [](std::uint64_t given) { limitMemoryTo(given * kMebibyte); }, "MiB of memory; default: what is free")
        ->check(CLI::Range(std::uint64_t{1}, kMostMebibytes))
        ->type_name("MIB");
}

/// Limits this process to what is free of the memory of the machine, or of the container, and adds `--max-memory MiB` to every command that
/// has no such option of its own, so that a hostile file ends this program and not the machine. Beyond it allocations fail: TG8001. What is
/// only reserved, or mapped to be read, does not count (RLIMIT_DATA).
void limitMemory(CLI::App& program) {
    limitMemoryTo(memoryToBeHad());
    addMemoryLimit(program);
}

constexpr int kMachine = 3;

constexpr const char* kStart = R"(
Start here:
  tegument list                               effects, scenes, meshes, and what is missing here
  tegument info Main                          what an effect offers
  tegument check Main                         does it compile for every Direct3D and for SPIR-V?
  tegument prep human                         make the default head, once
  tegument render Main -o head.png            draw it
  tegument portrait head.glb -o head.png      a head of your own in skin, in a studio
  tegument view Main                          in a window; edits of the source show at once)";

constexpr const char* kExitCodes = R"(
  tegument help render                        what a command takes

Exit codes:
  0  done, and true
  1  the input is at fault: the content of a file, or a figure beyond its limit
  2  the command line is: an option, or a file, technique or parameter that does not exist
  3  the machine is: the message says what it lacks, and what brings it)";

int run(int argc, char** argv) {
    CLI::App program("Skin and fur effects in HLSL: check them, look into them, render them.", "tegument");
    program.require_subcommand(1);
    program.allow_windows_style_options(false); // "/a/b.fx" is a file there, too
    bool verbose = false;
    program.add_flag("--verbose", verbose, "With --version: compilers, libraries and the device, too");
    program.set_version_flag("--version", [&] { return versionText(verbose); });
    Action action;
    setUpHelp(program, action);
    addRender(program, action);
    addPortrait(program, action);
    addCheck(program, action);
    addTest(program, action);
    addFlatten(program, action);
    addInfo(program, action);
    addSurvey(program, action);
    addList(program, action);
    addPrep(program, action);
    addFur(program, action);
    addSheet(program, action);
    addCompare(program, action);
    addView(program, action);
    addBatch(program, action);
    program.footer(kStart); // after the others: a command inherits what its parent has
    addLab(program, action);
    program.footer(program.get_footer() + kExitCodes);
    limitMemory(program);
    if (const auto code = parse(program, argc, argv)) return *code;
    return keepingInputs(action());
}

/// The C++ library, and oneTBB, whose exceptions for it have no type of their own.
bool isOfThreads(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
           std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

Error errorOf(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return machineError(8001, "out of memory", "try a smaller size or map size, or a larger --max-memory");
    if (isOfThreads(error))
        return machineError(8027, fmt::format("no thread can be started: {}", error.what()),
                            "allow more processes (`ulimit -u`) or more memory (--max-memory)");
    return machineError(8002, fmt::format("unexpected failure: {}", error.what()));
}

/// The code of an action that threw.
int afterThrow(const std::exception& error) {
    if (std::ferror(stdout) != 0) return 0; // fmt throws where nothing can be written: ended() says so
    say(format(errorOf(error)));
    return kMachine;
}

} // namespace

} // namespace tegument::app

int main(int argc, char** argv) {
    tegument::app::begin();
    const tegument::KeptInputs inputs;
    try {
        return tegument::app::ended(tegument::app::run(argc, argv));
    } catch (const std::exception& error) {
        return tegument::app::ended(tegument::app::afterThrow(error));
    }
}
