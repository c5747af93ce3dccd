// The Python module's part in C++: a Scene that is kept between pictures. All else is tools/python/tegument/__init__.py.

#include "host/image/image.h"
#include "host/run/pixels.h"
#include "host/run/session.h"
#include "meshprep/assets/generators.h"
#include "meshprep/assets/given_values.h"
#include "meshprep/assets/job.h"
#include "meshprep/assets/names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nanobind/nanobind.h>
#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace nb = nanobind;
using namespace nb::literals;
using tegument::Diagnostic;
using tegument::Image;
using tegument::Result;
using tegument::python::Scene;

namespace tegument::python {
namespace {

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

} // namespace
} // namespace tegument::python

namespace {

using Vector = std::array<float, 3>;
using Picture = nb::ndarray<nb::numpy, float, nb::ndim<3>>;

/// tegument.Error, which __init__.py defines: raised with (text, blame, codes).
[[noreturn]] void raise(const tegument::Error& error) {
    nb::list codes;
    for (const Diagnostic& diagnostic : error.diagnostics)
        codes.append(fmt::format("TG{}", diagnostic.code));
    const nb::object type = nb::module_::import_("tegument").attr("Error");
    const nb::object raised = type(tegument::format(error), static_cast<int>(error.blame), codes);
    PyErr_SetObject(type.ptr(), raised.ptr());
    throw nb::python_error();
}

/// Each as a UserWarning, which a filter may turn into an exception.
void warn(Scene& scene) {
    for (const Diagnostic& diagnostic : scene.takeWarnings())
        if (PyErr_WarnEx(PyExc_UserWarning, tegument::format(diagnostic).c_str(), 1) != 0) throw nb::python_error();
}

/// Height x width x channels; NumPy takes the pixels over, without a copy.
Picture pictureOf(Result<Image> image) {
    if (!image) raise(image.error());
    auto* kept = new Image(std::move(*image));
    const nb::capsule owner(kept, [](void* pointer) noexcept { delete static_cast<Image*>(pointer); });
    const std::size_t shape[] = {static_cast<std::size_t>(kept->height), static_cast<std::size_t>(kept->width),
                                 static_cast<std::size_t>(kept->channels)};
    return Picture(kept->pixels.data(), 3, shape, owner);
}

nb::ndarray<nb::numpy, std::uint8_t, nb::ndim<3>>
toSrgb(const nb::ndarray<const float, nb::ndim<3>, nb::c_contig, nb::device::cpu>& picture) {
    if (picture.shape(2) < 3 || picture.shape(2) > 4) throw nb::value_error("a picture has 3 or 4 channels");
    Image radiance{.width = static_cast<int>(picture.shape(1)),
                   .height = static_cast<int>(picture.shape(0)),
                   .channels = static_cast<int>(picture.shape(2)),
                   .pixels = {picture.data(), picture.data() + picture.size()}};
    const Image shown = tegument::displayed(radiance);
    auto* bytes = new std::vector<std::uint8_t>(shown.pixels.size());
    const nb::capsule owner(bytes, [](void* pointer) noexcept { delete static_cast<std::vector<std::uint8_t>*>(pointer); });
    std::ranges::transform(shown.pixels, bytes->begin(),
                           [](float value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255)); });
    return {bytes->data(), {picture.shape(0), picture.shape(1), 3}, owner};
}

glm::vec3 vectorOf(const Vector& v) {
    return {v[0], v[1], v[2]};
}

Vector listOf(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

std::unique_ptr<Scene> load(const std::string& effect, const std::string& technique, const std::string& workspace, const std::string& mesh,
                            std::optional<double> unitMm, const std::string& preset, const std::vector<std::string>& defines,
                            const std::vector<std::string>& sets, const std::string& setting, int samples, const std::string& device) {
    tegument::assets::JobOptions options;
    options.file = effect;
    options.technique = technique;
    options.scene.workspace = workspace;
    options.scene.mesh = mesh;
    options.scene.unitMm = unitMm;
    options.preset = preset;
    options.effect.defines = defines;
    options.effect.setting = setting;
    options.sets = sets;
    options.samples = samples;
    options.device = device;
    auto scene = [&] {
        const nb::gil_scoped_release others;
        return Scene::load(options);
    }();
    if (!scene) raise(scene.error());
    warn(**scene);
    return std::move(*scene);
}

Picture render(Scene& scene, int width, int height) {
    auto image = [&] {
        const nb::gil_scoped_release others;
        return scene.render(width, height);
    }();
    warn(scene);
    return pictureOf(std::move(image));
}

void setCamera(Scene& scene, const std::optional<Vector>& position, const std::optional<Vector>& target, std::optional<float> fov) {
    tegument::Camera camera = scene.camera();
    if (position) camera.position = vectorOf(*position);
    if (target) camera.target = vectorOf(*target);
    if (fov) camera.horizontalFov = *fov;
    scene.place(camera, {});
}

void setLight(Scene& scene, const std::optional<Vector>& position, const std::optional<Vector>& color) {
    tegument::Light light = scene.light();
    if (position) light.position = vectorOf(*position);
    if (color) light.color = vectorOf(*color);
    scene.place({}, light);
}

} // namespace

NB_MODULE(_tegument, module) {
    module.def("set_own_folder", [](const std::string& folder) { tegument::assets::setOwnFolder(folder); });
    module.def("load", &load);
    module.def("to_srgb", &toSrgb);
    nb::class_<Scene>(module, "Scene")
        .def("render", &render)
        .def("target", [](Scene& scene, const std::string& name) { return pictureOf(scene.target(name)); })
        .def("set",
             [](Scene& scene, const std::string& assignment) {
                 if (const auto done = scene.set(assignment); !done) raise(done.error());
             })
        .def("set_camera", &setCamera, "position"_a = nb::none(), "target"_a = nb::none(), "fov"_a = nb::none())
        .def("set_light", &setLight, "position"_a = nb::none(), "color"_a = nb::none())
        .def_prop_ro("camera", [](const Scene& scene) { return listOf(scene.camera().position); })
        .def_prop_ro("light", [](const Scene& scene) { return listOf(scene.light().position); })
        .def_prop_ro("targets", &Scene::targets)
        .def_prop_ro("times", &Scene::times)
        .def_prop_ro("device", &Scene::device);
}
