#pragma once
// An effect on a scene, drawn again and again: what Python calls a Scene. Needs no Python.

#include "host/image/image.h"
#include "host/run/session.h"
#include "meshprep/assets/job.h"

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace tegument::python {

/// The device, the effect's compiled passes and its textures are kept from one picture to the next. Threads take turns.
class Scene {
public:
    /// What `tegument render` reads for the same options, and its errors.
    [[nodiscard]] static Result<std::unique_ptr<Scene>> load(const assets::JobOptions& options);

    /// The caller's colour target: linear radiance, RGBA, row 0 on top. TG4001 and on where drawing fails.
    [[nodiscard]] Result<Image> render(int width, int height);
    /// A target of the last picture, 1 to 4 channels. TG8023 there is none of that name, or no picture yet.
    [[nodiscard]] Result<Image> target(const std::string& name);
    /// NAME=VALUE as on the command line, for all pictures from now on.
    [[nodiscard]] Result<void> set(const std::string& assignment);
    /// Camera and light from now on, in the frame of the workspace (docs/workspace.md); what is left out stays.
    void place(const std::optional<Camera>& camera, const std::optional<Light>& light);

    [[nodiscard]] Camera camera() const { return job_.scene.workspace.camera; }
    [[nodiscard]] Light light() const { return job_.scene.workspace.light; }
    [[nodiscard]] std::vector<std::string> targets();
    /// Milliseconds by pass of the last picture; a pass that ran several times is their sum.
    [[nodiscard]] std::map<std::string, double> times();
    [[nodiscard]] std::string device() const { return device_.info().name; }
    /// Those that came since the last call.
    [[nodiscard]] std::vector<Diagnostic> takeWarnings();

private:
    Scene(assets::Job job, gpu::Device device);
    void keep(const std::vector<Diagnostic>& warnings);

    std::mutex mutex_;
    assets::Job job_;
    gpu::Device device_;
    EffectSession session_;
    SessionFrame frame_;
    std::vector<Diagnostic> warnings_;
};

} // namespace tegument::python
