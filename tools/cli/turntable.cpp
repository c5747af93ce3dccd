#include "tools/cli/turntable.h"

#include "host/run/read_back.h"
#include "host/run/scene_bounds.h"
#include "host/run/session.h"
#include "host/scene/framing.h"
#include "tools/cli/animation.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr double kTurn = 6.28318530717958647692;
constexpr int kTurnTakes = 4000; // milliseconds of an animation
constexpr int kShortest = 20;    // milliseconds: browsers slow down what is shorter

/// Takes the pictures one after another, so that not all of them are held at once.
class Sink {
public:
    Sink(const PictureOptions& options, fs::path output) : options_(options), output_(std::move(output)) {}

    Result<void> begin(const RunOptions& run, int pictures) {
        if (!isAnimation(output_)) return {};
        auto animation =
            makeAnimation(output_, {.width = run.width, .height = run.height, .milliseconds = std::max(kShortest, kTurnTakes / pictures)});
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

} // namespace

fs::path numbered(const fs::path& output, int number) {
    fs::path path = output;
    return path.replace_filename(fmt::format("{}-{:03}{}", output.stem().string(), number, output.extension().string()));
}

Result<Turntable> renderTurntable(gpu::Device& device, const Job& job, const PictureOptions& options, const fs::path& output, int pictures,
                                  const std::function<void(int done)>& say) {
    const SessionScene scene = assets::sessionScene(job.scene);
    const Workspace world = run::inWorld(job.scene.workspace, scene);
    const glm::dvec3 pivot = glm::dvec3(run::boundsOf(scene).centre);
    EffectSession session(device, job.effect, scene);
    Sink sink(options, output);
    if (const auto begun = sink.begin(job.run, pictures); !begun) return begun.error();
    Turntable turntable;
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

} // namespace tegument::app
