// tegument render: runs an effect on a scene and writes what it drew.

#include "host/gpu/gpu.h"
#include "host/mesh/extent.h"
#include "host/run/pixels.h"
#include "host/run/run.h"
#include "host/run/semantics.h"
#include "host/run/session.h"
#include "host/run/session_frame.h"
#include "host/scene/framing.h"
#include "meshprep/assets/generators.h"
#include "tools/cli/animation.h"
#include "tools/cli/command_line.h"
#include "tools/cli/foreign.h"
#include "tools/cli/job_options.h"
#include "tools/cli/output.h"
#include "tools/cli/picture_files.h"
#include "tools/cli/unread.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct Sequence {
    std::vector<std::filesystem::path> files;
    SessionFrame first; // of the pictures; its times are those of one
};
[[nodiscard]] std::filesystem::path numbered(const std::filesystem::path& output, int number);

constexpr double kTurn = 6.28318530717958647692;
constexpr int kTurnTakes = 4000; // milliseconds of a turn
constexpr int kShortest = 20;    // milliseconds: browsers slow down what is shorter

/// Takes the pictures one after another, so that not all of them are held at once.
class Sink {
public:
    Sink(const PictureOptions& options, fs::path output) : options_(options), output_(std::move(output)) {}

    /// `takes`: milliseconds that all pictures are to be seen.
    Result<void> begin(const RunOptions& run, int pictures, double takes) {
        if (!isAnimation(output_)) return {};
        const int each = std::max(kShortest, static_cast<int>(std::lround(std::min(takes, 1e6) / pictures)));
        const AnimationFormat format{.width = run.width, .height = run.height, .milliseconds = each};
        auto animation = isFilm(output_) ? makeFilm(format) : makeAnimation(format);
        if (!animation) return animation.error();
        animation_ = std::move(*animation);
        return {};
    }
    Result<void> take(const Image& image) {
        if (animation_) return animation_->add(image);
        files_.push_back(numbered(output_, static_cast<int>(files_.size()) + 1));
        return writePicture(options_, files_.back(), image);
    }
    Result<std::vector<fs::path>> end() {
        if (!animation_) return std::move(files_);
        if (const auto written = animation_->write(output_); !written) return written.error();
        return std::vector<fs::path>{output_};
    }

private:
    const PictureOptions& options_;
    fs::path output_;
    std::unique_ptr<Animation> animation_;
    std::vector<fs::path> files_;
};

/// The file of a picture, counted from 1; the first may be named.
fs::path numbered(const fs::path& output, int number) {
    std::string stem = output.stem().string();
    if (stem.ends_with("-001")) stem.resize(stem.size() - 4);
    fs::path path = output;
    return path.replace_filename(fmt::format("{}-{:03}{}", stem, number, output.extension().string()));
}

/// `pictures` of them, the first as it stands: one animation, or a file for each, numbered from 001. Camera and light stay where they are
/// for the viewer. `say` hears how many are done.
Result<Sequence> renderTurntable(gpu::Device& device, const Job& job, const PictureOptions& options, const fs::path& output, int pictures,
                                 const std::function<void(int done)>& say) {
    const SessionScene scene = assets::sessionScene(job.scene);
    const Workspace world = run::inWorld(job.scene.workspace, scene);
    const glm::dvec3 pivot = glm::dvec3(run::boundsOf(scene).centre);
    EffectSession session(device, job.effect, scene);
    Sink sink(options, output);
    if (const auto begun = sink.begin(job.run, pictures, kTurnTakes); !begun) return begun.error();
    Sequence turntable;
    for (int i = 0; i < pictures; ++i) {
        auto frame = session.draw(turnedScene(world, pivot, kTurn * i / pictures), job.run);
        if (!frame) return frame.error();
        auto image = run::readBack(device, *session.target({}));
        if (!image) return image.error();
        image->metadata = frame->metadata;
        image->metadata["turned"] = fmt::format("{:.1f} degrees", 360.0 * i / pictures);
        if (const auto taken = sink.take(*image); !taken) return taken.error();
        if (i == 0) turntable.first = std::move(*frame);
        say(i + 1);
    }
    auto files = sink.end();
    if (!files) return files.error();
    turntable.files = std::move(*files);
    return turntable;
}

/// `count` pictures of an animation, evenly over its length, so that they can be repeated. Each is a scene of its own: what is made of a
/// mesh is made of each of its shapes. The camera is that of the first.
Result<Sequence> renderAnimation(gpu::Device& device, const assets::JobOptions& options, const Job& first, const PictureOptions& pictures,
                                 const fs::path& output, int count, const std::function<void(int done)>& say) {
    const double seconds = first.scene.motionSeconds;
    Sink sink(pictures, output);
    if (const auto begun = sink.begin(first.run, count, 1000 * seconds); !begun) return begun.error();
    Sequence sequence;
    std::unique_ptr<Job> before, job;
    std::optional<EffectSession> last, session;
    for (int i = 0; i < count; ++i) {
        JobOptions moment = options;
        moment.scene.motion.time = seconds * i / count;
        auto loaded = assets::loadJob(moment);
        if (!loaded) return loaded.error();
        before = std::move(job); // what the last session points at lives until its pipelines are learnt
        job = std::make_unique<Job>(std::move(*loaded));
        last = std::move(session);
        session.emplace(device, first.effect, assets::sessionScene(job->scene));
        if (last) session->learn(*last);
        Workspace world = first.scene.workspace;
        world.textures = job->scene.workspace.textures;
        auto frame = session->draw(run::inWorld(world, assets::sessionScene(job->scene)), job->run);
        if (!frame) return frame.error();
        auto image = run::readBack(device, *session->target({}));
        if (!image) return image.error();
        image->metadata = frame->metadata;
        image->metadata["seconds"] = fmt::format("{:.3f}", *moment.scene.motion.time);
        if (const auto taken = sink.take(*image); !taken) return taken.error();
        if (i == 0) sequence.first = std::move(*frame);
        say(i + 1);
    }
    auto files = sink.end();
    if (!files) return files.error();
    sequence.files = std::move(*files);
    return sequence;
}

struct RenderOptions {
    JobOptions job;
    std::vector<std::string> dump;
    PictureOptions pictures;
    int frames = 1;
    int turntable = 0; // pictures of a turn; 0: one picture
    bool json = false;

    /// Pictures that follow each other; 0: one, however often it is drawn to be timed.
    [[nodiscard]] int sequence() const {
        const bool plays = !job.scene.motion.animation.empty() && !job.scene.motion.time && frames > 1;
        return turntable > 0 ? turntable : plays ? frames : 0;
    }
};

std::string metadata(const RunResult& result, const char* entry) {
    const auto found = result.image.metadata.find(entry);
    return found == result.image.metadata.end() ? std::string() : found->second;
}

int samplesOf(const RunResult& result) {
    const std::string samples = metadata(result, "samples");
    return samples.empty() ? 1 : std::atoi(samples.c_str());
}

int mapSize(const RenderOptions& options, const RunResult& result) {
    if (options.job.effect.mapSize > 0) return options.job.effect.mapSize;
    return std::atoi(metadata(result, "map_size").c_str());
}

Json vectorJson(const glm::vec3& v) {
    return {v.x, v.y, v.z};
}

Json objectsJson(const std::vector<RunObject>& objects) {
    Json json = Json::array();
    for (const RunObject& object : objects)
        json.push_back({{"mesh", object.mesh->name},
                        {"attribution", object.mesh->attribution},
                        {"position", vectorJson(object.placement.position)},
                        {"rotation", vectorJson(object.placement.rotation)},
                        {"scale", vectorJson(object.placement.scale)}});
    return json;
}

Json passesJson(const RunResult& result, bool several) {
    Json passes = Json::array();
    for (const PassReport& pass : result.passes) {
        passes.push_back({{"name", pass.name}, {"ms", pass.milliseconds}});
        if (several) passes.back()["object"] = pass.object;
    }
    return passes;
}

Json resultJson(const RenderOptions& options, const Job& job, const gpu::Device& device, const RunResult& result,
                const std::vector<fs::path>& files) {
    Json targets = Json::array();
    for (const TargetReport& target : result.targets)
        targets.push_back({{"name", target.name},
                           {"width", target.width},
                           {"height", target.height},
                           {"format", target.format},
                           {"bytes", target.bytes}});
    const bool several = !job.scene.objects.empty();
    Json json{{"effect", job.effect.file.string()},
              {"technique", result.technique},
              {"setting", metadata(result, "setting")},
              {"compiler", compilerName(job.run.compiler)},
              {"device", device.info().name},
              {"driver", device.info().driver},
              {"resolution", {job.run.width, job.run.height}},
              {"samples", samplesOf(result)},
              {"map_size", mapSize(options, result)},
              {"passes", passesJson(result, several)},
              {"targets", targets},
              {"bytes", result.bytes},
              {"device_bytes", result.deviceBytes},
              {"output", files.back().string()}};
    if (several) json["objects"] = objectsJson(job.scene.objects);
    Json dumps = Json::object();
    for (const auto& dumped : result.dumped)
        dumps[dumped.first] = dumpPath(files.back(), dumped.first, options.pictures.formats.front()).string();
    if (!dumps.empty()) json["dumped"] = dumps;
    for (const fs::path& file : files)
        json["files"].push_back(file.string());
    if (!result.warnings.empty()) json["warnings"] = toJson(result.warnings);
    for (const ParameterBinding& binding : job.bindings)
        json["bindings"].push_back({{"parameter", binding.parameter}, {"got", binding.source}, {"by", binding.rule}});
    if (job.effect.displayColours)
        if (const auto plain = plainPictureNote(result.image, job.effect.file.string())) json["picture"] = plain->text;
    if (options.job.validate) json["validation_messages"] = device.validationMessages();
    return json;
}

/// The passes' times; of several objects summed over them.
std::vector<std::vector<std::string>> timeRows(const RunResult& result) {
    double total = 0;
    std::vector<std::pair<std::string, double>> times;
    int object = 0;
    std::size_t next = 0; // of this object's passes
    for (const PassReport& pass : result.passes) {
        if (pass.object != object) next = 0;
        object = pass.object;
        if (next < times.size() && times[next].first == pass.name)
            times[next].second += pass.milliseconds;
        else
            times.emplace_back(pass.name, pass.milliseconds);
        ++next;
        total += pass.milliseconds;
    }
    times.emplace_back("total", total);
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, milliseconds] : times)
        rows.push_back({name, fmt::format("{:.3f}", milliseconds)});
    return rows;
}

/// A wrong unit shows in no picture, but in how soft skin looks and how long fur.
void printSize(const Job& job) {
    if (job.scene.meshes.size() != 1) return;
    const Bounds& bounds = job.scene.meshes.front().bounds;
    const glm::vec3 size = bounds.maximum - bounds.minimum;
    fmt::print("the mesh is {} x {} x {} mm (another size: --unit-mm X; it lies down: --up z; it shows its back: --turn 180)\n",
               lengthText(static_cast<double>(size.x)), lengthText(static_cast<double>(size.y)), lengthText(static_cast<double>(size.z)));
}

void printReport(const Job& job, const gpu::Device& device, const RunResult& result, const std::vector<fs::path>& files) {
    fmt::print("{} {}, {}x{}, {}\n{} ({}){}\n\n{}", job.effect.file.filename().string(), result.technique, job.run.width, job.run.height,
               compilerName(job.run.compiler), device.info().name, device.info().driver,
               device.info().cpu ? ", a software device: times are good as ratios only" : "", table({"pass", "ms"}, timeRows(result)));
    fmt::print("\n{}, {:.1f} MiB\n", counted(result.targets.size(), "target"), static_cast<double>(result.bytes) / (1024.0 * 1024.0));
    if (job.scene.isOwn) printSize(job);
    if (!job.scene.objects.empty()) fmt::print("{} objects, {} meshes\n", job.scene.objects.size(), job.scene.meshes.size());
    if (const auto found = result.image.metadata.find("attribution"); found != result.image.metadata.end())
        fmt::print("mesh: {}\n", found->second);
    for (const fs::path& file : files)
        fmt::print("wrote {}\n", file.string());
}

Result<void> targetsExist(const Effect& effect, const std::vector<std::string>& dump) {
    std::vector<std::string> targets;
    for (const Parameter& parameter : effect.parameters)
        if (parameter.isTarget()) targets.push_back(parameter.name);
    for (const std::string& name : dump) {
        if (name == "all" || std::ranges::find(targets, name) != targets.end()) continue;
        const std::string near = didYouMean(name, targets);
        return usageError(8023, fmt::format("--dump {}: {} has no such target", name, effect.file.string()),
                          near.empty() ? fmt::format("it has {}", targets.empty() ? "none" : fmt::format("{}", fmt::join(targets, ", ")))
                                       : near);
    }
    return {};
}

int endOf(const gpu::Device& device) {
    const auto messages = device.validationMessages();
    for (const std::string& message : messages)
        fmt::print(stderr, "validation: {}\n", message);
    return messages.empty() ? 0 : static_cast<int>(Blame::Machine);
}

int renderSequence(const RenderOptions& options, const Job& job, gpu::Device& device, const fs::path& output, int pictures,
                   Progress& progress) {
    const auto say = [&](int done) { progress.count("rendering", static_cast<std::size_t>(done), static_cast<std::size_t>(pictures)); };
    const auto turned = options.turntable > 0 ? renderTurntable(device, job, options.pictures, output, pictures, say)
                                              : renderAnimation(device, options.job, job, options.pictures, output, pictures, say);
    progress.clear();
    if (!turned) return fail(turned.error(), options.json);
    warn(turned->first.warnings);
    if (options.json) {
        Json files = Json::array();
        for (const fs::path& file : turned->files)
            files.push_back(file.string());
        print({{"effect", job.effect.file.string()},
               {"technique", turned->first.technique},
               {"device", device.info().name},
               {"resolution", {job.run.width, job.run.height}},
               {options.turntable > 0 ? "turntable" : "frames", pictures},
               {"files", files}});
    } else {
        fmt::print("{} {}, {} pictures of {}x{}, {}\n", job.effect.file.filename().string(), turned->first.technique, pictures,
                   job.run.width, job.run.height, device.info().name);
        for (const fs::path& file : turned->files)
            fmt::print("wrote {}\n", file.string());
    }
    return endOf(device);
}

int render(const RenderOptions& given) {
    RenderOptions options = given;
    const int pictures = options.sequence();
    const auto output = outputPath(options.pictures, options.job.file, pictures > 0);
    if (!output) return fail(output.error(), options.json);
    if (pictures > 0 && options.turntable == 0) options.frames = 1;
    for (int i = 1; i <= pictures && !isAnimation(*output); ++i)
        if (const auto can = checkOutput(numbered(*output, i).string(), {}); !can) return fail(can.error(), options.json);
    Progress progress;
    progress.say("reading");
    auto job = assets::loadJob(options.job, MeshFor::Technique, options.turntable > 0, [&](const std::string& made) {
        progress.clear();
        say(made);
    });
    if (!job) return fail(job.error(), options.json);
    if (const auto exist = targetsExist(job->effect, options.dump); !exist) return fail(exist.error(), options.json);
    if (options.frames > 1 && options.job.samples == 0) job->run.samples = 1; // what is measured, as bench does
    options.pictures.displayReferred = job->effect.displayColours;
    job->run.frames = options.frames;
    job->run.warmUpFrames = options.frames > 1 ? 2 : 0;
    job->run.dump = options.dump;
    progress.clear();
    warn(job->effect.warnings);
    warn(job->warnings);
    for (const Mesh& mesh : job->scene.meshes)
        warn(mesh.warnings);

    auto device = gpu::Device::create({.validation = options.job.validate, .prefer = options.job.device});
    if (!device) return fail(device.error(), options.json);
    job->run.compiling = [&](std::size_t done, std::size_t total) {
        done < total ? progress.count("compiling shader", done, total) : progress.say("rendering");
    };
    progress.say("rendering");
    if (pictures > 0) return renderSequence(options, *job, *device, *output, pictures, progress);
    auto result = assets::runScene(*device, job->effect, job->scene, job->run);
    progress.clear();
    if (!result) return fail(result.error(), options.json);
    std::ranges::move(unreadValues(options.job.sets, job->effect, *result), std::back_inserter(result->warnings));
    warn(result->warnings);
    if (job->effect.displayColours)
        if (const auto plain = plainPictureNote(result->image, job->effect.file.string())) warn({*plain});
    const auto files = writePictures(options.pictures, *output, *result);
    if (!files) return fail(files.error(), options.json);

    if (options.json) {
        print(resultJson(options, *job, *device, *result, *files));
    } else {
        printReport(*job, *device, *result, *files);
        printBindings(job->bindings);
    }
    return endOf(*device);
}

} // namespace

void addRender(CLI::App& program, Action& action) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command = program.add_subcommand("render", "Run an effect on a mesh and write the picture");
    addJobOptions(*command, options->job);
    CLI::Option* dump =
        repeatable(command->add_option("--dump", options->dump, "Write this target beside the picture, or all of them; may be repeated"));
    addPictureOptions(*command, options->pictures);
    CLI::Option* frames = command
                              ->add_option("--frames", options->frames,
                                           "With --animation and without --time: so many pictures of it, evenly over its length, as "
                                           "--turntable writes them; else frames to time, of which the table shows medians")
                              ->check(CLI::Range(1, 10000))
                              ->capture_default_str();
    command
        ->add_option(
            "--turntable", options->turntable,
            "So many pictures while the scene turns once: files numbered from 001, or one animation where -o names a .webp or .mp4")
        ->check(CLI::Range(2, 999))
        ->excludes(dump)
        ->excludes(frames);
    command->add_flag("--json", options->json, "Print JSON");
    addExamples(*command, {{"render Main -o head.png", "the default head"},
                           {"render Main --mesh head.glb --set gRoughness=0.25", "a head of your own"},
                           {"render Fur --mesh scan.ply -o scan.jpg", "any mesh in fur"},
                           {"render Fur --mesh scan.ply --turntable 48 -o scan.webp", "from all sides, as an animation"},
                           {"render Main --mesh body.glb --animation walk --frames 24 -o walk.webp", "as its animation moves it"},
                           {"render Main --dump all", "with every intermediate target as EXR"}});
    command->callback([options, &action] { action = [options] { return render(*options); }; });
}

} // namespace tegument::app
