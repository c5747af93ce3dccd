#pragma once
// A picture that is made while another one is shown and moved: of another technique or setting, of an edited effect, or of a file that was
// dropped on the window.

#include "tools/view/loaded.h"
#include "tools/view/reading.h"
#include "tools/view/sharpness.h"
#include "tools/view/view.h"

#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace tegument::view {

/// What was asked for last. What is shown is ViewState's, until its picture is there.
struct Wanted {
    std::string technique;
    std::string setting;
    std::map<std::string, std::string> binds;
    bool operator==(const Wanted&) const = default;
};

struct Making {
    std::string what; // "technique Lambert"
    Wanted wanted;
    bool reads = false;                         // the effect is read again
    bool anew = false;                          // its textures, too
    bool picture = false;                       // then the picture is shown, whatever was before
    std::filesystem::path file{};               // that was dropped
    std::future<Result<ViewRequest>> opening{}; // it is read first
    std::optional<ViewRequest> request{};       // then: what is to be shown of it
    std::unique_ptr<Reading> reading{};         // then
    std::unique_ptr<Loaded> loaded{};           // whose first frame is drawn in pieces
    Sharpness how{};
    int tries = 0;         // of that frame
    Workspace workspace{}; // that it is drawn with, once there were many
    std::map<std::string, std::vector<double>> parameters{};
};

} // namespace tegument::view
