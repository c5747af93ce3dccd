#pragma once
// How long each step of a replayed session takes to its picture.

#include "tools/view/input.h"

#include <string>
#include <vector>

namespace tegument::view {

/// One step: input, or an edit of a file.
struct ReplayStep {
    std::string kind; // steps of one kind make one line of the table
    Input input;
    std::filesystem::path file; // of an edit
    std::string from;           // its first occurrence in the file becomes `to`; empty: the file becomes what it was at first
    std::string to;             // "{new}" in it: six digits that no session had before, so that no cache knows the shaders
    bool soon = false;          // does not wait until what a first move needs is made
    glm::dvec2 meanwhile{0};    // drags of the camera, again and again, until a picture that takes a while is there
};

struct Reaction {
    std::string kind;
    double milliseconds = 0; // from the input, or the file's writing, to the picture that answers it
    double unanswered = 0;   // the longest part of it in which nobody was listened to
};

struct ReactionRow {
    std::string kind;
    std::size_t count = 0;
    double median = 0;
    double p95 = 0; // the value that 95 of 100 do not exceed
    double most = 0;
    double unanswered = 0; // of all of them
};

/// A row for each kind, in the order in which they come first.
[[nodiscard]] std::vector<ReactionRow> reactionRows(const std::vector<Reaction>& reactions);

} // namespace tegument::view
