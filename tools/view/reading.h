#pragma once
// A picture to come, as far as another thread makes it: the effect read, its shaders compiled, its textures loaded. Needs no GPU.
// An effect and what it has on the device.
// A picture that is made while another one is shown and moved: of another technique or setting, of an edited effect, or of a file that was
// dropped on the window.

#include "host/run/ahead.h"
#include "host/run/session.h"
#include "meshprep/adopt/adopt.h"
#include "tools/view/sharpness.h"
#include "tools/view/view.h"

#include <atomic>
#include <chrono>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tegument::view {

struct ToRead {
    std::shared_ptr<const Adoption> source; // read already; none: from `file`
    std::filesystem::path file;
    LoadOptions load;
    AdoptOptions adopt;
    std::shared_ptr<const void> keeps; // what `scene` points at
    SessionScene scene;
    Workspace workspace;
    RunOptions run;   // its technique, or the effect's default one where it has none of that name
    run::Known known; // its programs: of `source`
};

struct ReadAhead {
    std::shared_ptr<const Adoption> source; // none: it could not be read
    Result<run::Ahead> ahead;
};

[[nodiscard]] Result<Adoption> readEffect(const std::filesystem::path& file, const LoadOptions& load, const AdoptOptions& adopt);

class Reading {
public:
    /// Begins. Nothing of `asked` is shared with who asks, but what never changes.
    explicit Reading(ToRead asked);
    /// Waits, but not for shaders that are not begun.
    ~Reading();
    Reading(const Reading&) = delete;
    Reading& operator=(const Reading&) = delete;

    /// The result is of no use any more: the thread ends behind the present shader.
    void giveUp() { shared_->goOn = false; }
    [[nodiscard]] bool done() const { return result_.wait_for(std::chrono::seconds(0)) == std::future_status::ready; }
    /// Once, when it is done.
    [[nodiscard]] ReadAhead take() { return result_.get(); }
    /// "shader 3 of 19"; empty: no shader is being compiled.
    [[nodiscard]] std::string progress() const;

private:
    struct Shared {
        std::atomic<bool> goOn = true;
        std::atomic<std::size_t> shaders = 0;
        std::atomic<std::size_t> compiled = 0;
    };
    std::shared_ptr<Shared> shared_ = std::make_shared<Shared>();
    std::future<ReadAhead> result_;
};

struct Loaded {
    /// `before`: of the same scene.
    Loaded(gpu::Device& device, std::shared_ptr<const Adoption> read, const std::shared_ptr<const void>& scene, const SessionScene& parts,
           const Loaded* before = nullptr)
        : keeps(scene), source(std::move(read)), effect(source->effect), bindings(source->bindings),
          session(device, effect, parts, before ? &before->session : nullptr) {}
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;

    std::shared_ptr<const void> keeps;      // the session's scene
    std::shared_ptr<const Adoption> source; // several may have it
    const Effect& effect;
    const std::vector<ParameterBinding>& bindings; // of an effect of another host
    EffectSession session;
};

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
