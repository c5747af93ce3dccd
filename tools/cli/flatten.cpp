// tegument flatten: an effect and its includes, or the library of functions, as one file.

#include "tools/emit/flatten.h"
#include "host/support/file.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace {

struct FlattenArguments {
    std::string file;
    std::string output;
    std::vector<std::string> includeFolders;
    bool library = false;
    bool anywhere = false;
};

constexpr const char* kLibraryHead = "hlsl/tegument.fxh";

int flatten(const FlattenArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {}); !can) return fail(can.error(), false);
    const auto file = arguments.library && arguments.file.empty() ? assets::ownFile(kLibraryHead) : assets::findEffect(arguments.file);
    if (!file) return fail(file.error(), false);
    PreprocessOptions options{};
    for (const std::string& folder : arguments.includeFolders)
        options.includeFolders.emplace_back(folder);
    const Roots roots = rootsOfEffect(*file, options.includeFolders, {.anywhere = arguments.anywhere});
    options.read = confinedReader(*file, roots);
    const auto text = arguments.library ? flattenLibrary(*file, options) : flattenEffect(*file, options);
    if (!text) return fail(text.error(), false);
    if (arguments.output.empty()) {
        fmt::print("{}", *text);
        return 0;
    }
    if (const auto written = writeFile(arguments.output, *text); !written) return fail(written.error(), false);
    fmt::print("wrote {}\n", arguments.output);
    return 0;
}

} // namespace

void addFlatten(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<FlattenArguments>();
    CLI::App* command = program.add_subcommand("flatten", "Merge an effect and its includes into one file that compiles alone");
    auto* library =
        command->add_flag("--library", arguments->library, "The functions of hlsl/ as one header for shaders of your own: tegument.hlsl");
    auto* effect = command->add_option("effect", arguments->file, "Effect file (.fx); with --library: another head than hlsl/tegument.fxh");
    command->add_option("-o,--output", arguments->output, "The one file; without it: standard output");
    repeatable(command->add_option("-I,--include", arguments->includeFolders, "Folder searched for #include files; may be repeated"));
    command->add_flag("--anywhere", arguments->anywhere, "Includes may lie outside of the effect's project and -I");
    addExamples(*command, {{"flatten Main -o main_alone.fx", ""}, {"flatten --library -o tegument.hlsl", ""}},
                "Comments and conditionals stay: -D selects targets and settings as before.");
    command->callback([arguments, effect, library, &action] {
        if (effect->count() + library->count() == 0) throw CLI::RequiredError("effect");
        action = [arguments] { return flatten(*arguments); };
    });
}

} // namespace tegument::app
