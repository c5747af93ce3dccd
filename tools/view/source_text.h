#pragma once
// The effect's text as it stands beside the picture, with its errors. Needs no window.

#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tegument::view {

struct SourceMark {
    int line = 0; // from 1
    std::string text;
};

struct SourceText {
    std::vector<std::filesystem::path> files; // the effect first, then what it includes
    std::filesystem::path file;               // the one that is shown; empty: none yet
    std::string text;                         // as edited
    std::string saved;                        // as it was read or written last
    std::vector<SourceMark> marks;            // errors in this file
    std::optional<int> goTo;                  // a line to bring into sight
    std::string problem;                      // why it could not be read or written

    [[nodiscard]] bool edited() const { return text != saved; }
};

/// Shows this file. Edits that were not written are lost.
void openSource(SourceText& source, const std::filesystem::path& file);
/// Reads the file again if nothing was edited; says so if both changed.
void refreshSource(SourceText& source);
/// Onto the disk, where the viewer finds it as an edit like any other.
void writeSource(SourceText& source);
/// The marks of an error; the file of its first place is shown, unless another has edits.
void markSource(SourceText& source, const Error& error);

} // namespace tegument::view
