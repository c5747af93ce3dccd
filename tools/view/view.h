#pragma once
// An effect in a window.

#include "host/run/session.h"
#include "tools/view/reactions.h"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace tegument {

/// What is to be shown next: a file in the place of what was there, or values that the effect is read again for.
struct Opening {
    std::filesystem::path file;
    std::vector<std::string> sets; // NAME=VALUE of switches and textures; without a value: as if it had not been given
};

/// A switch of the effects as a control.
struct Switch {
    std::string name;
    std::string label;
    std::string help;
    int least = 0;
    int most = 1;
    int step = 1;
    int usual = 0;
    bool ofLight = false;
};

struct ViewRequest {
    std::filesystem::path effect;
    LoadOptions load;
    std::map<std::string, std::string> binds; // of effects of other hosts: AdoptOptions::bind
    SessionScene scene;
    Workspace workspace;
    RunOptions run;     // technique, size of the window, compiler, values
    std::string device; // part of its name
    bool validate = false;
    bool window = true;                     // false: a replay, drawn the same way
    std::filesystem::path beside;           // a saved picture to hold the effect's against; empty: none
    std::filesystem::path pictures = "out"; // where the keys s, w and c write
    /// Of `tegument render`, besides effect, technique, setting, workspace, size and `binds`: what the command line asked for.
    std::vector<std::string> renderArguments;
    std::shared_ptr<const void> keeps; // what `scene` points at
    std::vector<Switch> switches;      // that the effect has
    bool keepView = false;             // of one that `open` made: camera, light and parameters stay where they are
    /// The request with a file that was dropped on the window or chosen (an effect, a mesh, a workspace or a texture of `shown`), or with
    /// values.
    std::function<Result<ViewRequest>(const Opening& opening, const Effect& shown)> open;
    /// A mesh in about so many triangles, over its own vertices, for pictures of what moves; called from another thread. None: every mesh
    /// is drawn as it is.
    std::function<std::vector<std::uint32_t>(const Mesh& mesh, std::size_t triangles)> fewer;
    /// For each root of fur that a texture holds (annotation Generator "fur roots", "hair roots") the triangle of the mesh that it stands
    /// on.
    std::function<std::vector<std::uint32_t>(const Mesh& mesh, const Image& roots)> rootsOn;
};

struct Viewed {
    std::vector<std::string> validation; // what the validation layers said
    /// Empty, or a window that was closed while a compiler or a mesh still kept other threads busy: its destruction waits for them.
    std::shared_ptr<void> unfinished;
};

/// Until the window is closed. Errors in the effect's source are shown, told to `say` and mended by the next edit; only what happens before
/// the first picture, or to the device, is returned. `say` gets one line or message at a time.
[[nodiscard]] Result<Viewed> viewEffect(const ViewRequest& request, const std::function<void(const std::string&)>& say);

struct Replayed {
    std::vector<view::Reaction> reactions;
    std::vector<std::string> validation; // what the validation layers said
};

/// The steps one after another, each as soon as the one before has its picture; edits change their files. TG8049 a step has no picture, or
/// an edit finds nothing to change.
[[nodiscard]] Result<Replayed> replayEffect(const ViewRequest& request, const std::vector<view::ReplayStep>& steps,
                                            const std::function<void(const std::string&)>& say);

} // namespace tegument
