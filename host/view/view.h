#pragma once
// An effect in a window.

#include "host/run/session.h"

#include <functional>

namespace tegument {

struct ViewRequest {
    std::filesystem::path effect;
    LoadOptions load;
    SessionScene scene; // must live until viewEffect() returns
    Workspace workspace;
    RunOptions run;     // technique, size of the window, compiler, values
    std::string device; // part of its name
    bool validate = false;
    std::filesystem::path pictures = "out"; // where the key s writes
};

/// Until the window is closed. Errors in the effect's source are shown, told to `say` and mended by the next edit; only what happens before
/// the first picture, or to the device, is returned. `say` gets one line or message at a time. Returns what the validation layers said.
[[nodiscard]] Result<std::vector<std::string>> viewEffect(const ViewRequest& request, const std::function<void(const std::string&)>& say);

} // namespace tegument
