// tegument: check, look into and render effect files; prepare meshes for them.

#include "host/support/kept_inputs.h"
#include "tools/cli/command_line.h"
#include "tools/cli/ends.h"
#include "tools/cli/max_memory.h"
#include "tools/cli/output.h"
#include "tools/cli/version.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string_view>
#include <system_error>

namespace {

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
    program.set_version_flag("--version", [&] { return tegument::app::versionText(verbose); });
    tegument::app::Action action;
    tegument::app::setUpHelp(program, action);
    tegument::app::addRender(program, action);
    tegument::app::addPortrait(program, action);
    tegument::app::addCheck(program, action);
    tegument::app::addFlatten(program, action);
    tegument::app::addInfo(program, action);
    tegument::app::addSurvey(program, action);
    tegument::app::addList(program, action);
    tegument::app::addPrep(program, action);
    tegument::app::addFur(program, action);
    tegument::app::addSheet(program, action);
    tegument::app::addCompare(program, action);
    tegument::app::addView(program, action);
    tegument::app::addBatch(program, action);
    program.footer(kStart); // after the others: a command inherits what its parent has
    tegument::app::addLab(program, action);
    program.footer(program.get_footer() + kExitCodes);
    tegument::app::limitMemory(program);
    if (const auto code = tegument::app::parse(program, argc, argv)) return *code;
    return tegument::app::keepingInputs(action());
}

/// The C++ library, and oneTBB, whose exceptions for it have no type of their own.
bool isOfThreads(const std::exception& error) {
    const auto* system = dynamic_cast<const std::system_error*>(&error);
    return (system != nullptr && system->code() == std::errc::resource_unavailable_try_again) ||
           std::string_view(error.what()).find("pthread_create") != std::string_view::npos;
}

tegument::Error errorOf(const std::exception& error) {
    if (dynamic_cast<const std::bad_alloc*>(&error) != nullptr)
        return tegument::machineError(8001, "out of memory", "try a smaller size or map size, or a larger --max-memory");
    if (isOfThreads(error))
        return tegument::machineError(8027, fmt::format("no thread can be started: {}", error.what()),
                                      "allow more processes (`ulimit -u`) or more memory (--max-memory)");
    return tegument::machineError(8002, fmt::format("unexpected failure: {}", error.what()));
}

/// The code of an action that threw.
int afterThrow(const std::exception& error) {
    if (std::ferror(stdout) != 0) return 0; // fmt throws where nothing can be written: ended() says so
    tegument::app::say(tegument::format(errorOf(error)));
    return kMachine;
}

} // namespace

int main(int argc, char** argv) {
    tegument::app::begin();
    const tegument::KeptInputs inputs;
    try {
        return tegument::app::ended(run(argc, argv));
    } catch (const std::exception& error) {
        return tegument::app::ended(afterThrow(error));
    }
}
