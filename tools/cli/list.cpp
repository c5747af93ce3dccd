// tegument list: what there is to draw, and what is missing on this machine.

#include "host/effect/model.h"
#include "host/mesh/read_mesh.h"
#include "host/scene/presets.h"
#include "host/scene/workspace.h"
#include "host/spirv/compile.h"
#include "host/support/file.h"
#include "meshprep/assets/names.h"
#include "meshprep/assets/scene.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/direct3d/microsoft.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct EffectRow {
    fs::path file;
    std::vector<std::string> techniques; // the usual one first
    std::vector<std::string> presets;
    std::string problem;
};

struct WorkspaceRow {
    fs::path file;
    std::string shows;
    std::vector<fs::path> meshes;
    std::string problem; // empty: it can be drawn
    std::string remedy;
};

struct MeshRow {
    fs::path file;
    std::vector<std::string> workspaces;
    std::string remedy; // of one that is missing
    bool there = false;
};

struct ToolRow {
    std::string name;
    std::string serves;
    std::string problem; // empty: it is there
    std::string remedy;
};

struct Listing {
    std::vector<EffectRow> effects;
    std::vector<WorkspaceRow> workspaces;
    std::vector<MeshRow> meshes;
    std::vector<ToolRow> tools;
};

EffectRow effectRow(const fs::path& file) {
    EffectRow row{.file = file};
    const auto effect = loadEffect(file);
    if (!effect) {
        row.problem = effect.error().diagnostics.front().text;
        return row;
    }
    const Technique* usual = effect->defaultTechnique();
    if (usual) row.techniques.push_back(usual->name);
    for (const Technique& technique : effect->techniques)
        if (&technique != usual) row.techniques.push_back(technique.name);
    const auto presets = loadPresets(file);
    if (!presets) row.problem = presets.error().diagnostics.front().text;
    for (std::size_t i = 0; presets && i < presets->size(); ++i)
        row.presets.push_back((*presets)[i].name);
    return row;
}

/// The first sentence of the key "comment", which means nothing to the program.
std::string commentOf(const fs::path& file) {
    const auto text = readFile(file);
    if (!text) return {};
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    if (!json.is_object() || !json.contains("comment")) return {};
    const auto& comment = json["comment"];
    std::string said;
    if (comment.is_string()) said = comment.get<std::string>();
    if (comment.is_array() && !comment.empty() && comment.front().is_string()) said = comment.front().get<std::string>();
    return said.substr(0, said.find_first_of(".;:"));
}

std::vector<fs::path> meshesOf(const Workspace& workspace) {
    std::vector<fs::path> files;
    const auto add = [&](const std::string& path) {
        if (!path.empty()) files.push_back((workspace.file.parent_path() / path).lexically_normal());
    };
    add(workspace.meshPath);
    for (const SceneObject& object : workspace.objects)
        add(object.meshPath);
    return files;
}

WorkspaceRow workspaceRow(const fs::path& file) {
    WorkspaceRow row{.file = file, .shows = commentOf(file)};
    if (const auto named = loadWorkspace(file, {.requireMesh = false})) row.meshes = meshesOf(*named);
    if (const auto loaded = loadWorkspace(file, assets::workspaceOptions()); !loaded) {
        constexpr std::string_view kMake = "make it: ";
        const Diagnostic& first = loaded.error().diagnostics.front();
        row.problem = first.text;
        row.remedy = first.hint.starts_with(kMake) ? first.hint.substr(kMake.size()) : first.hint;
    }
    return row;
}

std::vector<MeshRow> meshRows(const std::vector<WorkspaceRow>& workspaces) {
    std::map<fs::path, MeshRow> rows;
    for (const WorkspaceRow& workspace : workspaces)
        for (const fs::path& file : workspace.meshes) {
            std::error_code none;
            MeshRow& row = rows[file];
            row.file = file;
            row.there = fs::is_regular_file(file, none);
            if (!row.there) row.remedy = workspace.remedy;
            if (row.workspaces.empty() || row.workspaces.back() != workspace.file.stem())
                row.workspaces.push_back(workspace.file.stem().string());
        }
    std::vector<MeshRow> list;
    for (auto& [file, row] : rows)
        list.push_back(std::move(row));
    return list;
}

std::vector<ToolRow> toolRows() {
    const bool dxc = compilerAvailable(Compiler::Dxc);
    const std::string microsoft = microsoftCompilerMissing();
    return {{"dxc", "the usual compiler to SPIR-V; without it glslang", dxc ? "" : "it is not installed", dxc ? "" : "./bootstrap build"},
            {"d3dcompiler", "check for fx_2_0, fx_4_0 and fx_5_0", microsoft, microsoft.empty() ? "" : "./bootstrap test"}};
}

Listing listing() {
    Listing all;
    for (const fs::path& file : assets::knownEffects())
        all.effects.push_back(effectRow(file));
    for (const fs::path& file : assets::knownWorkspaces())
        all.workspaces.push_back(workspaceRow(file));
    all.meshes = meshRows(all.workspaces);
    all.tools = toolRows();
    return all;
}

Json toJson(const Listing& all) {
    Json json{{"effects", Json::array()}, {"workspaces", Json::array()}, {"meshes", Json::array()}, {"tools", Json::array()}};
    const auto state = [](Json& row, const std::string& problem, const std::string& remedy) {
        row["ready"] = problem.empty();
        if (!problem.empty()) row["missing"] = problem;
        if (!remedy.empty()) row["command"] = remedy;
    };
    for (const EffectRow& effect : all.effects) {
        Json row{{"name", effect.file.stem().string()},
                 {"file", effect.file.string()},
                 {"techniques", effect.techniques},
                 {"presets", effect.presets}};
        if (!effect.problem.empty()) row["problem"] = effect.problem;
        json["effects"].push_back(row);
    }
    for (const WorkspaceRow& workspace : all.workspaces) {
        Json row{{"name", workspace.file.stem().string()}, {"file", workspace.file.string()}, {"shows", workspace.shows}};
        for (const fs::path& mesh : workspace.meshes)
            row["meshes"].push_back(mesh.string());
        state(row, workspace.problem, workspace.remedy);
        json["workspaces"].push_back(row);
    }
    for (const MeshRow& mesh : all.meshes) {
        Json row{{"file", mesh.file.string()}, {"workspaces", mesh.workspaces}};
        state(row, mesh.there ? "" : "the file does not exist", mesh.remedy);
        json["meshes"].push_back(row);
    }
    for (const ToolRow& tool : all.tools) {
        Json row{{"name", tool.name}, {"serves", tool.serves}};
        state(row, tool.problem, tool.remedy);
        json["tools"].push_back(row);
    }
    return json;
}

/// A name, and what there is to say of it, wrapped to 100 columns.
void printRow(const std::string& name, const std::string& text) {
    constexpr std::size_t kName = 22;
    const auto lines = wrapped(text, kWidth - kName - 2);
    fmt::print("  {:<{}}{}\n", name, kName, fmt::join(lines, "\n" + std::string(kName + 2, ' ')));
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

/// What is missing and no command brings, such as data in a folder that only some machines have, is passed over.
bool canBeHad(const WorkspaceRow& row) {
    return row.problem.empty() || row.remedy.starts_with("tegument ") || row.remedy.starts_with("./bootstrap");
}

void print(Listing all) {
    std::erase_if(all.workspaces, [](const WorkspaceRow& row) { return !canBeHad(row); });
    fmt::print("effects: techniques (tegument render EFFECT -t TECHNIQUE)\n");
    for (const EffectRow& effect : all.effects) {
        printRow(effect.file.stem().string(), effect.problem.empty() ? joined(effect.techniques) : effect.problem);
        if (!effect.presets.empty()) printRow("", "presets (--preset): " + joined(effect.presets));
    }
    fmt::print("\nworkspaces (-w NAME)\n");
    for (const WorkspaceRow& workspace : all.workspaces)
        printRow(workspace.file.stem().string(), workspace.problem.empty() ? workspace.shows : "missing: " + workspace.problem);
    fmt::print("\nmeshes of these workspaces; any other: --mesh FILE ({})\n", meshEndings());
    for (const MeshRow& mesh : all.meshes)
        printRow(mesh.file.filename().string(), (mesh.there ? "" : "missing: ") + mesh.file.string());

    std::vector<std::pair<std::string, std::string>> missing; // the command, and what it brings
    const auto note = [&](const std::string& remedy, const std::string& brings) {
        if (!remedy.empty() && std::ranges::find(missing, remedy, &std::pair<std::string, std::string>::first) == missing.end())
            missing.emplace_back(remedy, brings);
    };
    for (const MeshRow& mesh : all.meshes)
        note(mesh.remedy, mesh.file.filename().string());
    for (const WorkspaceRow& workspace : all.workspaces)
        note(workspace.remedy, workspace.file.stem().string());
    for (const ToolRow& tool : all.tools)
        note(tool.remedy, fmt::format("{}: {} ({})", tool.name, tool.serves, tool.problem));
    if (missing.empty()) {
        fmt::print("\nnothing is missing\n");
        return;
    }
    fmt::print("\nmissing, and what brings it\n");
    for (const auto& [remedy, brings] : missing) {
        fmt::print("  {}\n", remedy);
        printRow("", brings);
    }
}

} // namespace

void addList(CLI::App& program, Action& action) {
    auto json = std::make_shared<bool>(false);
    CLI::App* command =
        program.add_subcommand("list", "Effects, presets, workspaces and meshes by name, and what is missing on this machine");
    command->add_flag("--json", *json, "Print JSON");
    addExamples(*command, {{"list", "what can be drawn here"}});
    command->callback([json, &action] {
        action = [json] {
            Listing all = listing();
            if (*json)
                app::print(toJson(all));
            else
                print(std::move(all));
            return 0;
        };
    });
}

} // namespace tegument::app
