#pragma once
// An effect drawn again and again: what one frame compiled, uploaded and allocated serves the next. Textures that other effects draw
// (annotation `Producer = "Stretch.fx/gStretchMap"`) are nodes before the frame, on the same device, drawn when something that they read
// has changed.

#include "host/effect/model.h"
#include "host/gpu/gpu.h"
#include "host/run/run_options.h"
#include "host/run/session_frame.h"

#include <memory>

namespace tegument {

namespace run {
struct Ahead; // host/run/ahead.h
struct Known;
} // namespace run

/// Effect, meshes and device must outlive it.
class EffectSession {
public:
    /// `before`: a session of the same scene, before an edit, or beside this one. What it has on the device serves this one, too: textures,
    /// meshes, pipelines of equal code, and targets until either draws into them, so that with RunOptions::keepUnchanged only what an edit
    /// changes is drawn.
    EffectSession(gpu::Device& device, const Effect& effect, SessionScene scene, const EffectSession* before = nullptr);
    /// What another thread has made for the next frame, of this effect.
    void take(run::Ahead ahead);
    /// What need not be made for this session, nor for one of the same effect that follows it.
    [[nodiscard]] run::Known known() const;
    /// Pipelines of another session of the same effect, which need not be made for this one.
    void learn(const EffectSession& other);
    EffectSession(EffectSession&&) noexcept;
    EffectSession& operator=(EffectSession&&) noexcept;
    ~EffectSession();

    /// Draws a frame `options.warmUpFrames + options.frames` times, of which the first `passes` passes. Technique, size, values, camera and
    /// light may be others than last time. After an error the targets hold parts of frames; the next call draws them anew. TG4029: a name
    /// in `options.dump` that is no target of the frame. A frame that is given up, of which SessionFrame says it, may not be prepared yet:
    /// it then has nothing else.
    [[nodiscard]] Result<SessionFrame> draw(const Workspace& workspace, const RunOptions& options, std::size_t passes = kAllPasses);

    /// The next frame bakes this texture anew, whatever it has or the cache has. Until then there is none of that name.
    void bakeAgain(const std::string& name);

    /// The caller's colour target (empty name), a target of the last frame as its last pass left it, or a texture that it sampled; null
    /// when there is none.
    [[nodiscard]] gpu::Texture* target(const std::string& name);
    /// All that the last frame allocated as targets, the caller's among them, by name.
    [[nodiscard]] const std::map<std::string, gpu::Texture>& targets() const;

    struct State;

private:
    std::unique_ptr<State> state_;
};

/// The names in `asked`, each once; "all" stands for all of `targets`. TG4029: a name that is not among them.
[[nodiscard]] Result<std::vector<std::string>> targetsToDump(const Effect& effect, const SessionFrame& frame,
                                                             const std::vector<std::string>& asked);

} // namespace tegument
