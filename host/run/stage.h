#pragma once
// The scene of a session on the device, and the one loop over its objects. Inside host/run, and for those that change a frame before it is
// drawn; all others take a session.

#include "host/run/ahead.h"
#include "host/run/held.h"
#include "host/run/products.h"

#include <deque>

namespace tegument::run {

/// A frame of all objects, ready to be drawn. Points at the workspace and the options that it was made for.
struct StagedFrame {
    std::deque<PlacedObject> placed; // these three: one for each object
    std::deque<RunInput> inputs;
    std::deque<Prepared> prepared;
    std::vector<ObjectRun> runs;
    Frame frame;
    bool givenUp = false; // RunOptions::pieces
};

class Stage {
public:
    /// Device, effect and scene must outlive it. What `before` has on the device is taken over: it draws the same scene, and need not live
    /// on. Targets of both are the same texture until either would draw into it: who draws then has one of its own.
    Stage(gpu::Device& device, const Effect& effect, SessionScene scene, const Stage* before = nullptr);
    /// What another thread has made for the next frame.
    void take(Ahead ahead);
    [[nodiscard]] Known known() const;
    /// See EffectSession.
    void learn(const Stage& other);
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Other meshes: nothing but compiled passes and pipelines is kept.
    void setScene(SessionScene scene);

    /// Plans, compiles, loads, allocates; nothing is drawn yet. What an earlier frame left is used.
    [[nodiscard]] Result<StagedFrame> prepare(const Workspace& workspace, const RunOptions& options);
    /// Draws the frame, or its first `items`, with RunOptions::keepUnchanged those that change something; the textures that other effects
    /// draw for it only the first time. Times of the passes, in order, then of the resolve.
    [[nodiscard]] Result<std::vector<gpu::TimedSection>> draw(StagedFrame& staged, std::size_t items);

    /// What the last frame that was prepared samples besides its targets, with where it comes from; until the next one is.
    struct Sampled {
        gpu::Texture* texture = nullptr;
        std::string origin;
        std::string key; // in the store
    };
    [[nodiscard]] const std::map<std::string, Sampled>& sampled() const { return sampled_; }

    /// The last bake of a texture that is sampled; none of what is not baked.
    [[nodiscard]] std::optional<Bake> bakeOf(const std::string& name) const;
    /// See EffectSession.
    void bakeAgain(const std::string& name);

    [[nodiscard]] Resources& resources() { return resources_; }
    [[nodiscard]] const Resources& resources() const { return resources_; }

private:
    void addInput(StagedFrame& staged, const Mesh* mesh, const Workspace& workspace, const RunOptions& options);
    [[nodiscard]] StagedFrame inputsOf(const Workspace& workspace, const RunOptions& options);
    /// Targets of the last frame that this one does not have, or has in another size, make room.
    void dropTargets(const std::deque<Prepared>& prepared);
    void noteSampled(const std::deque<Prepared>& prepared);
    void noteBakes(const std::deque<Prepared>& prepared);
    /// Each in a run of its own, with its time.
    [[nodiscard]] Result<void> drawNodes(StagedFrame& staged);
    void takeTargets();
    /// Textures of this session alone in place of those among `due` that another one has, too; all where none is given. Whether there was
    /// one.
    [[nodiscard]] Result<bool> separate(const std::set<std::uint64_t>* due);
    [[nodiscard]] Result<void> choose(StagedFrame& staged, std::size_t items);
    [[nodiscard]] Result<std::vector<gpu::TimedSection>> drawKeeping(StagedFrame& staged, std::size_t items);
    [[nodiscard]] Result<std::vector<gpu::TimedSection>> drawPieces(StagedFrame& staged, std::size_t items);
    [[nodiscard]] Result<void> equip(const RunInput& input, Prepared& prepared, std::vector<FrameNode>& before);

    gpu::Device& device_;
    const Effect& effect_;
    SessionScene scene_;
    Compiler compiler_ = Compiler::Dxc; // of the kit's programs
    Store store_;
    Kit kit_;
    Resources resources_{device_, store_, kit_, {}};
    std::map<std::string, TargetDesc> allocated_; // as asked for
    Products products_{device_, store_};
    Held held_;
    std::map<std::string, Sampled> sampled_;
    std::map<std::string, Bake> bakes_; // by the texture's name
    /// Of the session before.
    struct Offered {
        gpu::Texture texture;
        TargetDesc desc;
    };
    std::map<std::string, Offered> offered_; // until this has drawn
};

} // namespace tegument::run
