#pragma once
// The targets of a frame as the panels want them: their values, and small pictures of them. Read and drawn when they are asked for, once a
// frame.

#include "host/run/session.h"
#include "tools/view/canvas.h"
#include "tools/view/levels.h"

#include <chrono>
#include <map>
#include <string>

namespace tegument::view {

class ShownTargets {
public:
    /// There is another frame. Small pictures keep their textures and levels.
    void forget();
    /// Another effect, or other targets: levels are found anew.
    void forgetAll();
    /// A picture of the panels begins. What thumbnail() finds out for it ends after a while: the rest is for the next one.
    void begin();
    /// Whether some small pictures wait for that.
    [[nodiscard]] bool waits() const { return waits_; }

    /// A level of it; the picture for an empty name.
    [[nodiscard]] Result<const Image*> image(gpu::Device& device, EffectSession& session, const std::string& name, int level);
    /// Black while it waits. `radiance`: the picture is light, no display's colours.
    [[nodiscard]] Result<gpu::Texture*> thumbnail(gpu::Device& device, Canvas& canvas, EffectSession& session, const std::string& name,
                                                  bool radiance);

private:
    struct Small {
        gpu::Texture texture;
        Levels levels;
        bool known = false; // the levels
        bool drawn = false; // from this frame
    };
    std::map<std::pair<std::string, int>, Image> images_;
    std::map<std::string, Small> small_;
    std::chrono::steady_clock::time_point begun_;
    bool waits_ = false;
};

} // namespace tegument::view
