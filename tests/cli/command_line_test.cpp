// The command line as people type it: names instead of paths, mistakes with the name that was meant, help, and no work before a refusal.

#include "tests/cli/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

namespace tegument::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kQuad = R"(float4 gTint < float UIMin = 0; float UIMax = 1; > = {1, 0, 0, 1};
int gCount = 1;
struct V { float4 position : SV_Position; };
V QuadVS(float3 position : POSITION) { V o; o.position = float4(position, 1); return o; }
float4 QuadPS(V i) : SV_Target0 { return gTint * gCount; }
#ifndef FX_ENTRY
technique11 Main { pass P < string Script = "Draw=Buffer;"; > {
    SetVertexShader(CompileShader(vs_5_0, QuadVS()));
    SetPixelShader(CompileShader(ps_5_0, QuadPS()));
} }
#endif
)";

std::string quad() {
    static const std::string kPath = write("quad.fx", kQuad);
    return kPath;
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        all.push_back(line);
    return all;
}

/// Every command that the help of `parents` lists, with its own.
std::vector<std::vector<std::string>> commandsBelow(const std::vector<std::string>& parents) {
    std::vector<std::string> arguments = {"help"};
    arguments.insert(arguments.end(), parents.begin(), parents.end());
    std::vector<std::vector<std::string>> commands;
    bool listed = false;
    for (const std::string& line : lines(tegument(arguments).out)) {
        if (listed && (line.empty() || line[0] != ' ')) break;
        if (listed && line[2] != ' ') {
            auto command = parents;
            command.push_back(line.substr(2, line.find(' ', 2) - 2));
            const auto below = commandsBelow(command);
            commands.push_back(command);
            commands.insert(commands.end(), below.begin(), below.end());
        }
        listed = listed || line == "Subcommands:";
    }
    return commands;
}

TEST(CommandLine, an_option_that_may_be_repeated_takes_one_word_each_time) {
    for (const std::vector<std::string>& option : {std::vector<std::string>{"-s", "gCount=1"}, {"-D", "A=1"}, {"-I", "hlsl"}}) {
        std::vector<std::string> arguments = {"render"};
        arguments.insert(arguments.end(), option.begin(), option.end());
        arguments.insert(arguments.end(), option.begin(), option.end());
        arguments.insert(arguments.end(), {quad(), "--size", "8x8", "-o", out("once.png")});
        EXPECT_EQ(tegument(arguments).code, 0) << option.front() << "\n" << tegument(arguments).err;
    }
    const Ran check = tegument({"check", "--target", "spirv-glslang", "--target", "spirv-glslang", quad()});
    EXPECT_EQ(check.code, 0) << check.err;
}

TEST(CommandLine, a_misspelt_command_comes_with_the_nearest_name) {
    expectSaid(tegument({"rendr", "effects/Main.fx"}), kUsage, {"TG8003", "'rendr'", "did you mean 'render'?"});
    expectSaid(tegument({"fur", "root", "x.glb"}), kUsage, {"TG8003", "tegument fur", "did you mean 'roots'?"});
    expectSaid(tegument({"prep", "humn"}), kUsage, {"TG8008", "did you mean 'human'?"});
    expectSaid(tegument({"xyzzy"}), kUsage, {"TG8003", "render"});
    expectSaid(tegument({}), kUsage, {"TG8003", "tegument --help"});
    expectSaid(tegument({"fur"}), kUsage, {"TG8003", "tegument help fur"});
}

TEST(CommandLine, a_misspelt_option_comes_with_the_nearest_name) {
    expectSaid(tegument({"render", quad(), "--techniqe", "Main"}), kUsage, {"TG8004", "tegument render", "did you mean '--technique'?"});
    expectSaid(tegument({"render", quad(), "--techniqe=Main"}), kUsage, {"TG8004", "no option --techniqe;"});
    expectSaid(tegument({"render", quad(), quad()}), kUsage, {"TG8005", "quad.fx"});
    expectSaid(tegument({"render"}), kUsage, {"TG8005", "effect is required", "tegument help render"});
    expectSaid(tegument({"prep", "x.obj", "--centre", "bal"}), kUsage, {"TG8005", "none of ball, box, none", "did you mean 'ball'?"});
}

TEST(CommandLine, a_word_in_the_wrong_place_comes_with_its_right_one) {
    expectSaid(tegument({"render", quad(), ballMesh(), "-o", out("x.png")}), kUsage, {"TG8005", "a mesh is given by --mesh"});
    expectSaid(tegument({"render", quad(), "pictures/x y.png"}), kUsage, {"TG8005", "-o 'pictures/x y.png'"});
    expectSaid(tegument({"prep", ballMesh(), "new.glb"}), kUsage, {"TG8005", "-o new.glb"});
    expectSaid(tegument({"render", quad(), "--set", "gTint", "0.3"}), kUsage, {"TG8005", "--set NAME=VALUE"});
    expectSaid(tegument({"FurCoat"}), kUsage, {"TG8003", "tegument render FurCoat"});
    expectSaid(tegument({"scan.ply"}), kUsage, {"TG8003", "tegument prep scan.ply -o NEW.glb", "--mesh scan.ply"});
}

TEST(CommandLine, a_mesh_is_not_prepared_over_itself) {
    const std::string mesh = write("only.obj", "v 0 0 0\nv 90 0 0\nv 0 90 0\nf 1 2 3\n");
    const std::string glb = out("only.glb");
    ASSERT_EQ(tegument({"prep", mesh, "-o", glb}).code, 0);
    expectSaid(tegument({"prep", glb, "--orient", "-o", glb}), kUsage, {"TG5004", "only.glb is read by this command"});
    expectSaid(tegument({"prep", glb, "--dry-run", "--report", glb}), kUsage, {"TG5004", "only.glb is read by this command"});
}

TEST(CommandLine, names_that_do_not_exist_come_with_the_nearest_one) {
    expectSaid(tegument({"render", "effects/Mian.fx"}), kUsage, {"TG8006", "did you mean 'effects/Main.fx'?"});
    expectSaid(tegument({"info", "Mian"}), kUsage, {"TG8006", "did you mean 'Main.fx'?"});
    expectSaid(tegument({"check", quad(), "effects/Mian.fx"}), kUsage, {"TG8006"});
    expectSaid(tegument({"render", "Main", "-w", "humna.json"}), kUsage, {"TG8007", "did you mean 'human.json'?"});
    expectSaid(tegument({"render", "Main", "--mesh", ballMesh().substr(0, ballMesh().size() - 8) + "bal.obj"}), kUsage,
               {"TG8008", "did you mean", "ball.obj'?"});
    static_cast<void>(write("photograph/hed.jpg", ""));
    const Ran noPicture = tegument({"portrait", out("photograph/head.obj")});
    expectSaid(noPicture, kUsage, {"TG8008"});
    EXPECT_EQ(noPicture.err.find("hed.jpg"), std::string::npos) << "no mesh: " << noPicture.err;
    expectSaid(tegument({"render", quad(), "-t", "Mian"}), kUsage, {"TG8009", "did you mean 'Main'?"});
    expectSaid(tegument({"render", quad(), "-t", "Gosselin"}), kUsage, {"TG8009", "it has Main"});
    expectSaid(tegument({"render", "Main", "-w", ballWorkspace(), "--dump", "gTsmMpa"}), kUsage, {"TG8023", "did you mean 'gTsmMap'?"});
}

TEST(CommandLine, a_choice_that_leaves_nothing_is_no_success) {
    expectSaid(tegument({"invariance", "OriginalTexture", "--technique", "Nope", "-o", out("nothing")}), kUsage, {"TG8061"});
    EXPECT_FALSE(fs::exists(out("nothing")));
}

TEST(CommandLine, effects_and_workspaces_go_by_their_names_from_any_folder) {
    const Ran shortest = tegument({"info", "Separable", "--json"});
    ASSERT_EQ(shortest.code, 0) << shortest.err;
    EXPECT_EQ(shortest.json()["file"], "effects/peers/Separable.fx") << "tests run in the tree: as short as it can be written here";
    const Ran named = tegument({"render", "OriginalTexture", "-w", "lps_head", "--size", "8x8", "-o", out("named.png")},
                               {{"LPS_HEAD", (scratch() / "nowhere").string()}});
    EXPECT_EQ(named.err.find("TG8007"), std::string::npos) << "found, whether or not its mesh is there\n" << named.err;
}

TEST(CommandLine, what_is_no_effect_is_refused_without_printing_its_bytes) {
    static_cast<void>(ballWorkspace()); // writes grey.png
    const std::string picture = out("grey.png");
    fs::copy_file(picture, out("picture.fx"), fs::copy_options::overwrite_existing);
    expectSaid(tegument({"render", picture}), kUsage, {"TG8006", "is a picture"});
    expectSaid(tegument({"render", ballMesh()}), kUsage, {"TG8006", "is a mesh", "--mesh"});
    expectSaid(tegument({"check", ballWorkspace()}), kUsage, {"TG8006", "is a workspace", "-w"});
    expectSaid(tegument({"info", write("wide.fx", std::string("\xff\xfe") + std::string("f\0l\0o\0a\0t\0", 10))}), kUsage,
               {"TG8006", "UTF-16", "save it as UTF-8"});
    expectSaid(tegument({"check", "tests/adopt/effects"}), kUsage, {"TG8006", "is a folder", "tegument survey tests/adopt/effects"});
    expectSaid(tegument({"info", out("picture.fx")}), kUsage, {"TG8006", "is no text"});
    // Bytes that pass for text until they are read: control characters and Latin-1.
    const Ran odd = tegument({"info", write("odd.fx", "float \x1b[31m\xe4\xff gTint;\n")});
    EXPECT_EQ(odd.code, kInput);
    for (const std::string& said : {tegument({"render", picture}).err, tegument({"info", out("picture.fx")}).err, odd.err})
        for (const char c : said)
            ASSERT_TRUE(c == '\n' || c == '\t' || (c >= ' ' && c <= '~')) << "byte " << static_cast<int>(c) << " of\n" << said;
}

TEST(CommandLine, a_value_that_cannot_be_is_the_command_line_s_fault) {
    expectSaid(tegument({"render", quad(), "-s", "gTint=1,2"}), kUsage, {"TG8013", "--set gTint=1,2", "takes 4 numbers, 2 given"});
    expectSaid(tegument({"render", quad(), "-s", "gCount=0,2"}), kUsage, {"TG8013", "a decimal has a point: --set gCount=0.5"});
    expectSaid(tegument({"render", quad(), "-s", "gCount=1.5"}), kUsage, {"TG8013", "whole numbers"});
    expectSaid(tegument({"render", quad(), "--size", "100000"}), kUsage, {"TG4004", "each side is 1 to 16384"});
    expectSaid(tegument({"render", quad(), "-s", "gTint=nan,1,1,1"}), kUsage, {"TG8013", "not a number"});
    expectSaid(tegument({"render", quad(), "-s", "gTint=2,1,1,1", "--size", "8x8", "-o", out("range.png")}), 0, {"TG4012", "0 .. 1"});
}

TEST(CommandLine, textures_go_by_their_semantic_too) {
    const Ran ran = tegument({"render", "OriginalTexture", "-w", ballWorkspace(), "-s", "DIFFUSE=" + out("grey.png"), "--size", "8x8", "-o",
                              out("semantic.png")});
    EXPECT_EQ(ran.code, 0) << ran.err;
}

std::string workspaceWith(const std::string& name, const std::string& parameters) {
    return write(name,
                 fmt::format(R"({{"mesh": "{}", "textures": {{"DIFFUSE": "grey.png"}}, "parameters": {{{}}}}})", ballMesh(), parameters));
}

Ran specular(const std::string& parameters) {
    static_cast<void>(ballWorkspace()); // writes grey.png
    return tegument({"render", "Specular", "-w", workspaceWith("values.json", parameters), "--size", "8x8", "-o", out("values.png")});
}

TEST(WorkspaceValues, a_misspelt_parameter_is_warned_of_with_the_nearest_name) {
    expectSaid(specular("\"gRougness\": 0.3"), 0, {"warning TG8018", "values.json", "did you mean 'gRoughness'?"});
}

TEST(WorkspaceValues, a_parameter_of_another_effect_is_passed_over_in_silence) {
    const Ran ran = specular("\"gFurLength\": 0.05, \"gRoughness\": 0.3");
    EXPECT_EQ(ran.code, 0);
    EXPECT_EQ(ran.err, "");
}

TEST(WorkspaceValues, one_outside_its_range_is_warned_of_with_the_range) {
    expectSaid(specular("\"gRoughness\": 9"), 0, {"warning TG4012", "0.05 .. 1"});
}

TEST(WorkspaceValues, the_wrong_number_of_values_blames_the_workspace) {
    expectSaid(specular("\"gRoughness\": [1, 2]"), kInput, {"values.json: error TG8019", "takes 1 number, 2 given"});
}

// ---- Help

TEST(Help, of_a_command_is_what_its_option_prints) {
    EXPECT_EQ(tegument({"help", "render"}).out, tegument({"render", "--help"}).out);
    EXPECT_EQ(tegument({"help", "fur", "roots"}).out, tegument({"fur", "roots", "--help"}).out);
    EXPECT_EQ(tegument({"help"}).out, tegument({"--help"}).out);
    expectSaid(tegument({"help", "rendr"}), kUsage, {"TG8003", "did you mean 'render'?"});
}

TEST(Help, of_every_command_fits_into_100_columns_and_has_examples_of_its_own) {
    for (const std::string& line : lines(tegument({"--help"}).out))
        EXPECT_LE(line.size(), 100U) << line;
    const auto commands = commandsBelow({});
    EXPECT_GE(commands.size(), 12U);
    std::set<std::string> examples;
    for (const auto& command : commands) {
        std::vector<std::string> arguments = {"help"};
        arguments.insert(arguments.end(), command.begin(), command.end());
        const Ran ran = tegument(arguments);
        const std::string name = fmt::format("{}", command.back());
        ASSERT_EQ(ran.code, 0) << name;
        for (const std::string& line : lines(ran.out))
            EXPECT_LE(line.size(), 100U) << name << ": " << line;
        EXPECT_EQ(ran.out.find("->"), std::string::npos) << name << ": enumerations are words\n" << ran.out;
        const std::size_t at = ran.out.find("\nExamples:\n");
        ASSERT_NE(at, std::string::npos) << name;
        EXPECT_TRUE(examples.insert(ran.out.substr(at)).second) << name << " has the examples of another command";
        EXPECT_NE(ran.out.find("\n  tegument " + fmt::format("{}", arguments[1]), at), std::string::npos) << name;
    }
}

/// What bash offers behind these words.
std::vector<std::string> offered(const std::vector<std::string>& words) {
    static const std::string kScript = write("completion.bash", tegument({"help", "--completion", "bash"}).out);
    const std::string file = out("offered.txt");
    const std::string command = fmt::format(
        "bash -c 'source \"$0\"; COMP_WORDS=(\"$@\"); COMP_CWORD=$(($# - 1)); _tegument; printf \"%s\\n\" \"${{COMPREPLY[@]}}\"' "
        "'{}' '{}' >'{}'",
        kScript, fmt::join(words, "' '"), file);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    std::ifstream in(file);
    return lines({std::istreambuf_iterator<char>(in), {}});
}

TEST(Help, completions_name_every_command_its_options_and_effects) {
    const auto commands = commandsBelow({});
    ASSERT_GT(commands.size(), 20U);
    for (auto command : commands) {
        command.insert(command.begin(), "tegument");
        const std::string last = command.back();
        const auto named = offered(command);
        EXPECT_NE(std::ranges::find(named, last), named.end()) << last;
        command.emplace_back("--help");
        EXPECT_EQ(offered(command), std::vector<std::string>{"--help"}) << last;
    }
    EXPECT_EQ(offered({"tegument", "render", "Stret"}), std::vector<std::string>{"Stretch"});
    EXPECT_EQ(offered({"tegument", "render", "Main", "--techn"}), std::vector<std::string>{"--technique"});
    for (const char* shell : {"zsh", "fish"}) {
        const Ran ran = tegument({"help", "--completion", shell});
        EXPECT_EQ(ran.code, 0) << ran.err;
        for (const auto& command : commands)
            EXPECT_NE(ran.out.find(command.back()), std::string::npos) << shell << ": " << command.back();
    }
    expectSaid(tegument({"help", "--completion", "bahs"}), kUsage, {"TG8005", "did you mean 'bash'?"});
}

TEST(Help, says_what_the_exit_codes_mean) {
    const std::string help = tegument({"--help"}).out;
    for (const char* line : {"\n  0  ", "\n  1  ", "\n  2  ", "\n  3  "})
        EXPECT_NE(help.find(line), std::string::npos) << help;
}

// ---- Output

const std::map<std::string, std::string> kNoDevice = {{"VK_ICD_FILENAMES", "/nonexistent.json"}, {"VK_DRIVER_FILES", "/nonexistent.json"}};

TEST(Output, that_cannot_be_written_is_found_before_any_work) {
    const std::string file = write("file", "");
    const std::string below = file + "/x"; // a file where a folder should be: refused to root as well
    const std::string& mesh = ballMesh();
    const std::vector<std::vector<std::string>> all = {
        {"render", quad(), "-o", below + ".png"},
        {"view", quad(), "-o", below},
        {"verify", "-o", below},
        {"invariance", "-o", below},
        {"bench", "--json", below + ".json"},
        {"bench", "--plot", below},
        {"check", quad(), "--emit", below},
        {"flatten", quad(), "-o", below + ".fx"},
        {"fur", "texture", "-o", below, "--size", "16"},
        {"fur", "roots", mesh, "-o", below + ".dds"},
        {"prep", mesh, "-o", below + ".glb"},
        {"prep", mesh, "--dry-run", "--report", below + ".json"},
        {"prep", "human", "-o", below},
        {"prep", "shape", "cube", "-o", below + ".ply"},
        {"compare", out("grey.png"), out("grey.png"), "-o", below + ".png"},
        {"sheet", out("grey.png"), "-o", below + ".png"},
        {"survey", "tests/adopt/effects", "-o", below},
    };
    static_cast<void>(ballWorkspace()); // writes grey.png
    for (const auto& arguments : all) {
        const Ran ran = tegument(arguments, kNoDevice); // what needs a device would say that there is none
        EXPECT_EQ(ran.code, kMachine) << arguments[0] << "\n" << ran.err;
        EXPECT_NE(ran.err.find("TG5002"), std::string::npos) << arguments[0] << "\n" << ran.err;
        EXPECT_EQ(ran.out, "") << arguments[0];
    }
}

TEST(Output, of_a_kind_that_is_not_written_is_refused_by_its_name) {
    static_cast<void>(ballWorkspace());
    const std::string grey = out("grey.png");
    const std::vector<std::pair<std::string, std::vector<std::string>>> all = {
        {"TG8024", {"fur", "roots", ballMesh(), "-o", out("z.png")}}, {"TG8024", {"prep", "shape", "cube", "-o", out("z.glb")}},
        {"TG8024", {"compare", grey, grey, "-o", out("z.exr")}},      {"TG8032", {"sheet", grey, "-o", out("z.gif")}},
        {"TG8042", {"prep", ballMesh(), "-o", out("z.obj")}},         {"TG8016", {"render", quad(), "-o", out("z.gif")}},
    };
    for (const auto& [code, arguments] : all)
        expectSaid(tegument(arguments), kUsage, {code});
    for (const char* ending : {"png", "dds", "gif", "glb", "exr", "obj"})
        EXPECT_FALSE(fs::exists(out(fmt::format("z.{}", ending)))) << ending;
}

std::vector<std::string> filesBelow(const fs::path& folder) {
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
        if (entry.is_regular_file()) files.push_back(entry.path().string());
    return files;
}

TEST(Output, every_file_that_is_written_is_said) {
    static_cast<void>(ballWorkspace());
    const fs::path folder = scratch() / "said";
    const auto in = [&](const std::string& name) { return (folder / name).string(); };
    const std::string grey = out("grey.png");
    const std::vector<std::vector<std::string>> all = {
        {"render", "Beckmann", "--size", "8x8", "--dump", "all", "--dump-format", "exr,dds", "-o", in("a.png")},
        {"flatten", quad(), "-o", in("flat.fx")},
        {"fur", "texture", "-o", in(""), "--size", "32"},
        {"fur", "texture", "-o", in(""), "--size", "32", "--seeds", "1..2"},
        {"fur", "roots", ballMesh(), "--count", "200", "-o", in("r.dds")},
        {"prep", ballMesh(), "-o", in("b.glb"), "--report", in("b.json")},
        {"prep", "shape", "cube", "-o", in("cube.ply")},
        {"compare", grey, grey, "-o", in("where.png")},
        {"sheet", grey, "-o", in("sheet.png")},
        {"verify", "Beckmann", "-o", in(""), "--map-size", "32", "--size", "32"},
    };
    for (const auto& arguments : all) {
        fs::remove_all(folder);
        fs::create_directories(folder);
        const Ran ran = tegument(arguments);
        EXPECT_EQ(ran.code, 0) << arguments[0] << "\n" << ran.err;
        const auto files = filesBelow(folder);
        EXPECT_FALSE(files.empty()) << arguments[0];
        const std::string said = ran.out + ran.err; // of a report beside what --json prints: on standard error
        for (const std::string& file : files)
            EXPECT_NE(said.find(file), std::string::npos) << arguments[0] << " does not say " << file << "\n" << said;
    }
}

TEST(Output, of_check_says_the_folders) {
    const Ran ran = tegument({"check", quad(), "--target", "spirv-glslang", "--emit", out("emitted")});
    EXPECT_EQ(ran.code, 0) << ran.err;
    EXPECT_NE(ran.out.find("wrote " + out("emitted")), std::string::npos) << ran.out;
}

} // namespace
} // namespace tegument::test
