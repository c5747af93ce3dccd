#include "tools/python/scene.h"

#include "host/run/read_back.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/given_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace tegument::python {

Result<std::unique_ptr<Scene>> Scene::load(const assets::JobOptions& options) {
    auto job = assets::loadJob(options, assets::MeshFor::Technique);
    if (!job) return job.error();
    auto device = gpu::Device::create({.validation = options.validate, .prefer = options.device});
    if (!device) return device.error();
    return std::unique_ptr<Scene>(new Scene(std::move(*job), std::move(*device)));
}

Scene::Scene(assets::Job job, gpu::Device device)
    : job_(std::move(job)), device_(std::move(device)), session_(device_, job_.effect, assets::sessionScene(job_.scene)) {
    keep(job_.effect.warnings);
    keep(job_.warnings);
    for (const Mesh& mesh : job_.scene.meshes)
        keep(mesh.warnings);
}

Result<Image> Scene::render(int width, int height) {
    const std::scoped_lock lock(mutex_);
    const auto size = assets::parseSize(fmt::format("{}x{}", width, height));
    if (!size) return size.error();
    std::tie(job_.run.width, job_.run.height) = *size;
    auto frame = session_.draw(job_.scene.workspace, job_.run);
    if (!frame) return frame.error();
    frame_ = std::move(*frame);
    keep(frame_.warnings);
    return run::readBack(device_, *session_.target({}));
}

Result<Image> Scene::target(const std::string& name) {
    const std::scoped_lock lock(mutex_);
    gpu::Texture* texture = session_.target(name);
    if (texture != nullptr) return run::readBack(device_, *texture);
    const std::string there = frame_.targets.empty() ? "render() first" : fmt::format("it has {}", fmt::join(frame_.targets, ", "));
    return usageError(8023, fmt::format("{} has no such target: {}", job_.effect.file.string(), name), there);
}

Result<void> Scene::set(const std::string& assignment) {
    const std::scoped_lock lock(mutex_);
    return assets::applySet(assignment, job_.effect, job_.run);
}

void Scene::place(const std::optional<Camera>& camera, const std::optional<Light>& light) {
    const std::scoped_lock lock(mutex_);
    if (camera) job_.scene.workspace.camera = *camera;
    if (light) job_.scene.workspace.light = *light;
}

std::vector<std::string> Scene::targets() {
    const std::scoped_lock lock(mutex_);
    return frame_.targets;
}

std::map<std::string, double> Scene::times() {
    const std::scoped_lock lock(mutex_);
    std::map<std::string, double> times;
    for (const SessionPass& pass : frame_.passes)
        times[pass.name] += pass.milliseconds;
    return times;
}

void Scene::keep(const std::vector<Diagnostic>& warnings) {
    warnings_.insert(warnings_.end(), warnings.begin(), warnings.end());
}

std::vector<Diagnostic> Scene::takeWarnings() {
    const std::scoped_lock lock(mutex_);
    return std::exchange(warnings_, {});
}

} // namespace tegument::python
