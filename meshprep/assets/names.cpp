#include "meshprep/assets/names.h"

#include "host/mesh/read_mesh.h"
#include "host/support/file.h"
#include "host/support/system.h"
#include "host/support/text.h"
#include "meshprep/assets/picture.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

bool isFile(const fs::path& path) {
    std::error_code code;
    return fs::is_regular_file(path, code) || fs::is_fifo(path, code) || fs::is_character_file(path, code);
}

/// Set once, before anything is looked for.
fs::path& givenFolder() {
    static fs::path folder;
    return folder;
}

/// Installed beside the program, else the tree that it was built from.
std::vector<fs::path> ownFolders() {
    if (!givenFolder().empty()) return {givenFolder()};
    const fs::path program = programFile().parent_path();
    std::vector<fs::path> folders = {program / "../share/tegument"};
    if (const auto tree = folderAboveProgramWith("hlsl/platform.fxh")) folders.push_back(*tree);
    if (const fs::path tree(TEGUMENT_TREE); !tree.empty()) folders.push_back(tree);
    return folders;
}

/// The files of a folder that end so; their names sorted, without their folder.
std::vector<std::string> filesOf(const fs::path& folder, const std::string& ending) {
    std::vector<std::string> names;
    std::error_code code;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, code))
        if (ending.empty() || entry.path().extension() == ending) names.push_back(entry.path().filename().string());
    std::ranges::sort(names);
    return names;
}

/// As named, and with the ending that may be left out.
std::vector<fs::path> spellings(const fs::path& named, const std::string& ending) {
    if (named.extension() == ending) return {named};
    return {named, fs::path(named).concat(ending)};
}

/// As short as it can be written here.
fs::path fromHere(const fs::path& path) {
    std::error_code code;
    const fs::path near = path.lexically_normal().lexically_proximate(fs::current_path(code));
    return code || near.empty() || *near.begin() == ".." ? path.lexically_normal() : near;
}

/// The first of these folders that has the file.
std::optional<fs::path> search(const std::vector<fs::path>& folders, const std::string& named, const std::string& ending) {
    for (const fs::path& folder : folders)
        for (const fs::path& spelling : spellings(named, ending))
            if (isFile(folder / spelling)) return fromHere(folder / spelling);
    return std::nullopt;
}

/// The nearest of the names in these folders, as it would be written for the one that was meant.
std::string nearest(const std::vector<fs::path>& folders, const std::string& named, const std::string& ending) {
    const std::string stem = spellings(fs::path(named).filename(), ending).back().string();
    std::vector<std::string> names;
    for (const fs::path& folder : folders)
        for (const std::string& name : filesOf(folder, ending))
            if (std::ranges::find(names, name) == names.end()) names.push_back(name);
    const std::string near = nearestName(stem, names);
    if (!near.empty()) return fmt::format("did you mean '{}'?", (fs::path(named).parent_path() / near).string());
    return names.empty() ? std::string() : fmt::format("there are {}", fmt::join(names, ", "));
}

/// What else an effect's place was given to, by its name.
std::string otherKind(const std::string& named) {
    if (meshFormatOf(named)) return "a mesh";
    if (isPicture(named)) return "a picture";
    return toLower(fs::path(named).extension().string()) == ".json" ? "a workspace" : "";
}

std::string howToGive(const std::string& kind, const std::string& named) {
    if (kind == "a mesh") return fmt::format("the effect comes first: tegument render EFFECT --mesh {}", shellWord(named));
    if (kind == "a workspace") return fmt::format("the effect comes first: tegument render EFFECT -w {}", shellWord(named));
    return "effects are HLSL files (.fx)";
}

/// Text of whatever encoding has no zero byte.
bool isBinary(const fs::path& path) {
    std::array<char, 4096> start{};
    std::ifstream in(path, std::ios::binary);
    in.read(start.data(), start.size());
    return std::find(start.data(), start.data() + in.gcount(), '\0') != start.data() + in.gcount();
}

/// As an editor writes it where one asks for "Unicode".
bool isUtf16(const fs::path& path) {
    std::array<char, 2> start{};
    std::ifstream(path, std::ios::binary).read(start.data(), start.size());
    return (start[0] == '\xff' && start[1] == '\xfe') || (start[0] == '\xfe' && start[1] == '\xff');
}

/// A pipe or a device can be read once.
Result<void> refuseOtherKinds(const fs::path& path) {
    std::error_code code;
    if (!fs::is_regular_file(path, code)) return {};
    const std::string kind = otherKind(path.string());
    if (!kind.empty()) return usageError(8006, fmt::format("{} is {}, not an effect", path.string(), kind), howToGive(kind, path.string()));
    if (isUtf16(path))
        return usageError(8006, fmt::format("{} is UTF-16, which no compiler of HLSL reads", path.string()), "save it as UTF-8");
    if (isBinary(path)) return usageError(8006, fmt::format("{} is no text, so no effect", path.string()), howToGive({}, {}));
    return {};
}

std::vector<fs::path> effectFolders(const std::string& named) {
    std::vector<fs::path> folders;
    if (const fs::path folder = fs::path(named).parent_path(); !folder.empty()) folders.push_back(folder);
    for (const fs::path& own : ownFolders())
        folders.insert(folders.end(), {own / "effects", own / "effects/peers"});
    return folders;
}

bool isFolder(const std::string& named) {
    std::error_code code;
    return fs::is_directory(named, code);
}

/// The files of these folders, each name once, sorted folder by folder.
std::vector<fs::path> eachOnce(const std::vector<fs::path>& folders, const std::string& ending) {
    std::vector<fs::path> files;
    std::vector<std::string> known;
    for (const fs::path& folder : folders)
        for (const std::string& name : filesOf(folder, ending)) {
            if (std::ranges::find(known, name) != known.end()) continue;
            known.push_back(name);
            files.push_back(fromHere(folder / name));
        }
    return files;
}

} // namespace

void setOwnFolder(fs::path folder) {
    givenFolder() = std::move(folder);
}

fs::path ownFile(const fs::path& named) {
    std::error_code code;
    if (named.is_absolute() || fs::exists(named, code)) return named;
    for (const fs::path& folder : ownFolders())
        if (fs::exists(folder / named, code)) return (folder / named).lexically_normal();
    return named;
}

Result<fs::path> findEffect(const std::string& named) {
    std::vector<fs::path> folders = {""};
    for (const fs::path& own : ownFolders())
        folders.insert(folders.end(), {own, own / "effects", own / "effects/peers"});
    const auto found = search(folders, named, ".fx");
    if (!found && isFolder(named))
        return usageError(8006, fmt::format("{} is a folder, not an effect", named),
                          fmt::format("tegument survey {} looks into all effects below it", shellWord(named)));
    if (!found) return usageError(8006, fmt::format("there is no effect '{}'", named), nearest(effectFolders(named), named, ".fx"));
    const fs::path path = isFile(named) ? fs::path(named) : *found; // as it was written, for messages
    if (const auto kind = refuseOtherKinds(path); !kind) return kind.error();
    return path;
}

Result<fs::path> findWorkspace(const std::string& named, const fs::path& effect) {
    if (isFile(named)) return fs::path(named);
    std::vector<fs::path> folders = {"", effect.parent_path() / "workspaces"};
    for (const fs::path& own : ownFolders())
        folders.push_back(own / "effects/workspaces");
    if (const auto found = search(folders, named, ".json")) return *found;
    if (isFolder(named)) return usageError(8007, fmt::format("{} is a folder, not a workspace", named), "workspaces are JSON files");
    folders.front() = fs::path(named).parent_path().empty() ? fs::path(".") : fs::path(named).parent_path();
    return usageError(8007, fmt::format("there is no workspace '{}'", named), nearest(folders, named, ".json"));
}

std::vector<fs::path> knownEffects() {
    std::vector<fs::path> folders = {"effects", "effects/peers"};
    for (const fs::path& own : ownFolders())
        folders.insert(folders.end(), {own / "effects", own / "effects/peers"});
    return eachOnce(folders, ".fx");
}

std::vector<fs::path> knownWorkspaces() {
    std::vector<fs::path> folders = {"effects/workspaces"};
    for (const fs::path& own : ownFolders())
        folders.push_back(own / "effects/workspaces");
    return eachOnce(folders, ".json");
}

Result<void> fileExists(const std::string& named, const std::string& what, const std::vector<std::string>& others) {
    if (isFile(named)) return {};
    if (isFolder(named)) return usageError(8008, fmt::format("{} {} is a folder, not a file", what, named));
    const fs::path folder = fs::path(named).parent_path();
    std::vector<std::string> names = others;
    for (const std::string& name : filesOf(folder.empty() ? fs::path(".") : folder, ""))
        if (!meshFormatOf(named) == !meshFormatOf(name)) names.push_back((folder / name).string());
    return usageError(8008, fmt::format("{} {} does not exist", what, named), didYouMean(named, names));
}

Result<void> techniqueExists(const Effect& effect, const std::string& named) {
    if (named.empty() || effect.findTechnique(named)) return {};
    std::vector<std::string> names;
    for (const Technique& technique : effect.techniques)
        names.push_back(technique.name);
    const std::string near = didYouMean(named, names);
    return usageError(8009, fmt::format("{} has no technique '{}'", effect.file.string(), named),
                      near.empty() ? fmt::format("it has {}", names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))) : near);
}

std::vector<fs::path> effectsBeside(const fs::path& effect) {
    const fs::path own = effect.has_parent_path() ? effect.parent_path() : fs::path(".");
    std::vector<fs::path> folders = {own, own / "peers"};
    if (own.filename() == "peers") folders.push_back(own.parent_path());
    std::vector<fs::path> files;
    for (const fs::path& folder : folders)
        for (const std::string& name : filesOf(folder, ".fx"))
            files.push_back(folder / name);
    return files;
}

} // namespace tegument::assets
