#include "lab/bench/motion.h"

#include "host/run/pixels.h"
#include "host/run/session.h"
#include "lab/bench/textures.h"

#include <glm/gtc/matrix_transform.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <deque>
#include <map>

namespace tegument::bench {

namespace {

constexpr float kNearer = 0.99F;        // of the distance, in each frame of a zoom
constexpr float kStepDegrees = 0.5F;    // of a turn, and of the light
constexpr glm::vec3 kUpright(0, 1, 0);  // what a body turns around
using Pixels = std::vector<glm::dvec3>; // of one frame, in the order of the sample
using Place = std::pair<int, int>;      // y, x

/// Camera and light in mm, whatever the workspace counts in.
Workspace inWorld(const Scene& scene) {
    const PlacedScene placed = placeScene(scene.workspace, scene.mesh.bounds);
    Workspace world = scene.workspace;
    world.cameraRelative = world.lightRelative = false;
    world.camera.position = placed.camera.position;
    world.camera.target = placed.camera.target;
    world.light.position = placed.light.position;
    world.light.width = placed.light.width;
    return world;
}

glm::vec3 turned(const Scene& scene, const glm::vec3& point, float degrees) {
    const glm::mat4 turn = glm::rotate(glm::mat4(1), glm::radians(degrees), kUpright);
    return scene.mesh.bounds.centre + glm::vec3(turn * glm::vec4(point - scene.mesh.bounds.centre, 0));
}

void turnLight(const Scene& scene, Workspace& world, float degrees) {
    world.light.position = turned(scene, world.light.position, degrees);
    if (world.light.direction)
        world.light.direction = turned(scene, *world.light.direction + scene.mesh.bounds.centre, degrees) - scene.mesh.bounds.centre;
}

Workspace zoomed(const Scene& scene, int frame) {
    Workspace world = inWorld(scene);
    world.camera.position =
        world.camera.target + std::pow(kNearer, static_cast<float>(frame)) * (world.camera.position - world.camera.target);
    return world;
}

/// A body that turns under a light that stands is one that stands while camera and light go round it the other way.
Workspace bodyTurned(const Scene& scene, int frame) {
    Workspace world = inWorld(scene);
    const float degrees = -kStepDegrees * static_cast<float>(frame);
    world.camera.position = turned(scene, world.camera.position, degrees);
    world.camera.target = turned(scene, world.camera.target, degrees);
    turnLight(scene, world, degrees);
    return world;
}

Workspace lightMoved(const Scene& scene, int frame) {
    Workspace world = inWorld(scene);
    turnLight(scene, world, kStepDegrees * static_cast<float>(frame));
    return world;
}

/// A path with its truth.
struct Path {
    std::string name;
    std::vector<Workspace> frames;
    std::vector<Place> places; // the pixels that are compared
    std::vector<Pixels> truth;
};

/// A frame as the references see it.
struct StoodScene {
    StoodScene(Scene still, const Workspace& stood, const BenchOptions& options)
        : scene(std::move(still)), truth((scene.workspace = stood, truthScene(scene, options.width, options.height))),
          sample(samplePixels(scene, truth, 0)) {}

    Scene scene;
    TruthScene truth; // refers to the scene's mesh
    Sample sample;
};

/// Pixels that show skin in every frame.
std::vector<Place> commonPlaces(const std::deque<StoodScene>& stood) {
    std::map<Place, std::size_t> seen;
    for (const StoodScene& frame : stood)
        for (const reference::ShadedPoint& point : frame.sample.points)
            ++seen[{point.y, point.x}];
    std::vector<Place> common;
    for (const auto& [place, times] : seen)
        if (times == stood.size()) common.push_back(place);
    return common;
}

/// The points of a frame at these places, which it has.
Sample atPlaces(const Sample& sample, const std::vector<Place>& places) {
    std::map<Place, std::size_t> index;
    for (std::size_t i = 0; i < sample.points.size(); ++i)
        index[{sample.points[i].y, sample.points[i].x}] = i;
    Sample chosen{};
    for (const Place& place : places) {
        chosen.points.push_back(sample.points[index.at(place)]);
        chosen.interior.push_back(sample.interior[index.at(place)]);
    }
    chosen.parts = chosen.points;
    return chosen;
}

Path pathOf(const Scene& scene, const Motion& motion, const BenchOptions& options, const Say& say) {
    Path path{.name = motion.name, .frames = {}};
    std::deque<StoodScene> stood;
    for (int frame = 0; frame < kMotionFrames; ++frame) {
        path.frames.push_back(motion.stand(scene, frame));
        stood.emplace_back(scene, path.frames.back(), options);
    }
    std::vector<reference::ShadedPoint> common;
    for (const auto& [y, x] : commonPlaces(stood))
        common.push_back({.x = x, .y = y});
    for (const reference::ShadedPoint& point : reference::spreadEvenly(std::move(common), options.pixels))
        path.places.emplace_back(point.y, point.x);
    for (const StoodScene& frame : stood)
        path.truth.push_back(trueLight(frame.truth, atPlaces(frame.sample, path.places), {}, [&](std::size_t done, std::size_t total) {
            say(fmt::format("{}, frame {} of {}: reference, pixel {} of {}", motion.name, path.truth.size() + 1, kMotionFrames, done,
                            total));
        }));
    return path;
}

/// One session, as whoever moves has it.
Result<std::vector<Pixels>> drawnAlong(gpu::Device& device, const Path& path, const Contest& contest, const Contender& contender) {
    const auto effect = loadContender(contest, contender);
    if (!effect) return effect.error();
    EffectSession session(device, *effect, SessionScene{.mesh = &contest.scene.mesh});
    const RunOptions options = runOptionsOf(contest, contender);
    std::vector<Pixels> frames;
    for (const Workspace& stood : path.frames) {
        if (const auto drawn = session.draw(stood, options); !drawn) return drawn.error();
        const auto picture = run::readBack(device, *session.target(""));
        if (!picture) return picture.error();
        Pixels& pixels = frames.emplace_back();
        for (const auto& [y, x] : path.places)
            pixels.emplace_back(picture->at(x, y, 0), picture->at(x, y, 1), picture->at(x, y, 2));
    }
    return frames;
}

double squares(const Pixels& values) {
    double sum = 0;
    for (const glm::dvec3& value : values)
        sum += glm::dot(value, value);
    return sum;
}

Pixels minus(const Pixels& a, const Pixels& b) {
    Pixels result;
    for (std::size_t i = 0; i < a.size(); ++i)
        result.push_back(a[i] - b[i]);
    return result;
}

} // namespace

const std::vector<Motion>& motions() {
    static const std::vector<Motion> kMotions = {{"zoom", zoomed}, {"turn", bodyTurned}, {"light", lightMoved}};
    return kMotions;
}

MotionRow motionRow(std::span<const std::vector<glm::dvec3>> drawn, std::span<const std::vector<glm::dvec3>> truth) {
    assert(drawn.size() == truth.size() && drawn.size() > 1);
    double whole = 0;
    double error = 0;
    double change = 0;
    double light = 0;
    double largest = 0;
    std::vector<Pixels> errors;
    for (std::size_t i = 0; i < drawn.size(); ++i) {
        errors.push_back(minus(drawn[i], truth[i]));
        whole += squares(truth[i]);
        error += squares(errors.back());
    }
    for (std::size_t i = 1; i < drawn.size(); ++i) {
        const double step = squares(minus(errors[i], errors[i - 1]));
        change += step;
        largest = std::max(largest, step);
        light += squares(minus(truth[i], truth[i - 1]));
    }
    const double frame = whole / static_cast<double>(drawn.size());
    const double steps = static_cast<double>(drawn.size() - 1) * frame;
    return {.error = std::sqrt(error / whole),
            .flicker = std::sqrt(change / steps),
            .largest = std::sqrt(largest / frame),
            .light = std::sqrt(light / steps)};
}

Result<std::vector<MotionRow>> measureMotion(gpu::Device& device, const std::vector<Contender>& contenders, const BenchOptions& options,
                                             const BenchTools& tools) {
    auto scene = loadScene(options.scenes.front(),
                           {.effects = options.effects, .folder = options.sceneFolder, .width = options.width, .height = options.height});
    if (!scene) return scene.error();
    const TruthScene still = truthScene(*scene, options.width, options.height);
    fitTextures(*scene, reference::visiblePoints(still.skin, still.camera, 0));
    const Contest contest{.scene = *scene,
                          .width = options.width,
                          .height = options.height,
                          .mapSize = options.mapSizes.front(),
                          .compiler = options.compiler,
                          .shadowSize = options.shadowSizes.front(),
                          .assets = options.assets};
    std::vector<MotionRow> rows;
    for (const Motion& motion : motions()) {
        const Path path = pathOf(*scene, motion, options, tools.say);
        if (path.places.empty())
            return inputError(8075, {.file = scene->file.string()}, "no pixel shows skin in every picture of the motion",
                              "move the camera of the workspace, or choose a larger --size");
        for (const Contender& contender : contenders) {
            tools.say(fmt::format("{}: {}", motion.name, contender.name()));
            const auto drawn = drawnAlong(device, path, contest, contender);
            if (!drawn) return drawn.error();
            MotionRow row = motionRow(*drawn, path.truth);
            row.motion = motion.name;
            row.contender = contender;
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

} // namespace tegument::bench
