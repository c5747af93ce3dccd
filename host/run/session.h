#pragma once
// An effect drawn again and again: what one frame compiled, uploaded and allocated serves the next.

#include "host/run/run.h"

#include <limits>
#include <memory>

namespace tegument {

/// What is drawn: one mesh, none, or the objects of a scene.
struct SessionScene {
    const Mesh* mesh = nullptr;
    std::span<const RunObject> objects; // where there are any, `mesh` is null
};

struct SessionPass {
    std::string name;
    int object = 0;
    std::vector<std::string> targets; // colours, then depth; empty name: the caller's
    double milliseconds = 0;          // 0 for passes that were not drawn
};

struct SessionFrame {
    std::string technique;
    std::vector<SessionPass> passes;             // of the whole frame, in order
    std::vector<std::string> targets;            // of the effect, that the frame uses
    std::map<std::string, std::string> metadata; // as a picture of it carries
    std::vector<Diagnostic> warnings;
};

/// Effect, meshes and device must outlive it.
class EffectSession {
public:
    EffectSession(gpu::Device& device, const Effect& effect, SessionScene scene);
    EffectSession(EffectSession&&) noexcept;
    EffectSession& operator=(EffectSession&&) noexcept;
    ~EffectSession();

    static constexpr std::size_t kAllPasses = std::numeric_limits<std::size_t>::max();

    /// One frame, of which the first `passes` passes are drawn. Technique, size, values, camera and light may be others than last time.
    /// Textures that other effects draw are looked up again when technique or values change, not when only camera and light move. After an
    /// error the targets hold parts of frames; the next call draws them anew.
    [[nodiscard]] Result<SessionFrame> draw(const Workspace& workspace, const RunOptions& options, std::size_t passes = kAllPasses);

    /// The caller's colour target (empty name) or a target of the last frame as its last pass left it; null when there is none.
    [[nodiscard]] gpu::Texture* target(const std::string& name);

    struct State;

private:
    std::unique_ptr<State> state_;
};

} // namespace tegument
