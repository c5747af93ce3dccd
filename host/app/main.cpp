// tegument: check, look into and render effect files; prepare meshes for them.

#include "host/app/commands.h"
#include "host/app/output.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <exception>

namespace {

constexpr int kUsage = 2;
constexpr int kMachine = 3;

constexpr const char* kStart = R"(
Start here:
  tegument info effects/Main.fx               what an effect offers
  tegument check effects/Main.fx              does it compile for every Direct3D and for SPIR-V?
  tegument prep human                         make the default head, once
  tegument render effects/Main.fx -o head.png
  tegument render effects/Main.fx --dump all  the same, with every intermediate target as EXR
  tegument view effects/Main.fx               the same in a window; edits of the source show at once)";

constexpr const char* kExitCodes = R"(

Exit codes: 0 success, 1 the input is at fault, 2 the command line is, 3 the machine is.)";

int run(int argc, char** argv) {
    CLI::App program("Skin and fur effects in HLSL: check them, look into them, render them.", "tegument");
    program.require_subcommand(1);
    program.set_version_flag("--version", TEGUMENT_VERSION);
    program.footer(kStart);

    tegument::app::Action action;
    tegument::app::addRender(program, action);
    tegument::app::addCheck(program, action);
    tegument::app::addFlatten(program, action);
    tegument::app::addInfo(program, action);
    tegument::app::addPrep(program, action);
    tegument::app::addFur(program, action);
    tegument::app::addSheet(program, action);
    tegument::app::addCompare(program, action);
    tegument::app::addView(program, action);
    tegument::app::addLab(program, action);
    program.footer(program.get_footer() + kExitCodes);
    try {
        program.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return program.exit(error) == 0 ? 0 : kUsage;
    }
    return action();
}

} // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::bad_alloc&) {
        fmt::print(stderr, "{}\n", tegument::format(tegument::machineError(8001, "out of memory", "try a smaller size or map size")));
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", tegument::format(tegument::machineError(8002, fmt::format("unexpected failure: {}", error.what()))));
    }
    return kMachine;
}
