#pragma once
// A file chosen from folders, to be read or to be written. Needs no window.

#include <filesystem>
#include <string>
#include <vector>

namespace tegument::view {

enum class FileUse { None, Mesh, Effect, Workspace, Environment, SavePicture, SaveWorkspace };

struct FileDialog {
    struct Entry {
        std::string name;
        bool folder = false;
    };

    FileUse use = FileUse::None; // it is closed
    std::filesystem::path folder;
    std::string typed; // a path, from the folder on
    bool all = false;  // whatever a file's ending
    std::vector<Entry> entries;
    std::string problem;
    std::filesystem::path replaced; // that is there already: chosen once more it is replaced

    void open(FileUse what, const std::filesystem::path& near);
    [[nodiscard]] bool saves() const { return use == FileUse::SavePicture || use == FileUse::SaveWorkspace; }
    [[nodiscard]] const char* title() const;
    /// "*.obj *.glb ..."
    [[nodiscard]] std::string filter() const;
    /// Folders, then files, of `folder`.
    void list();
    /// What was typed; empty: that is a folder, which is entered, or `problem` says what is wrong.
    [[nodiscard]] std::filesystem::path choose();
};

} // namespace tegument::view
