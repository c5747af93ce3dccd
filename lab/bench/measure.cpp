#include "lab/bench/measure.h"

#include "host/image/compare.h"
#include "host/run/pixels.h"
#include "host/run/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace tegument::bench {

namespace {

/// A contender in the ring. What the session points to stays where it is.
struct Entrant {
    std::unique_ptr<Effect> effect;
    std::unique_ptr<EffectSession> session;
    RunOptions options;
    std::uint64_t bytes = 0;
    std::uint64_t targetBytes = 0;
    std::vector<double> frames;         // of all passes
    std::vector<double> gross;          // and of clears
    std::vector<std::string> passNames; // in order of the frame
    std::map<std::string, std::vector<double>> passes;
};

std::uint64_t bytesOfTargets(Entrant& entrant, const SessionFrame& frame) {
    std::uint64_t bytes = 0;
    for (const std::string& name : frame.targets)
        if (const gpu::Texture* target = entrant.session->target(name)) bytes += target->bytes();
    return bytes;
}

Result<Entrant> enter(gpu::Device& device, const Contest& contest, const Contender& contender) {
    auto effect = loadContender(contest, contender);
    if (!effect) return effect.error();
    Entrant entrant;
    entrant.effect = std::make_unique<Effect>(std::move(*effect));
    entrant.options = runOptionsOf(contest, contender);
    const std::uint64_t before = device.allocatedBytes();
    entrant.session = std::make_unique<EffectSession>(device, *entrant.effect, SessionScene{.mesh = &contest.scene.mesh});
    const auto frame = entrant.session->draw(contest.scene.workspace, entrant.options);
    if (!frame) return frame.error();
    entrant.bytes = device.allocatedBytes() - before;
    entrant.targetBytes = bytesOfTargets(entrant, *frame);
    return entrant;
}

Result<void> drawOnce(const Contest& contest, Entrant& entrant, bool timed) {
    const auto frame = entrant.session->draw(contest.scene.workspace, entrant.options);
    if (!frame) return frame.error();
    if (!timed) return {};
    std::map<std::string, double> sums;
    double whole = 0;
    for (const SessionPass& pass : frame->passes) {
        if (entrant.frames.empty() && !sums.contains(pass.name)) entrant.passNames.push_back(pass.name);
        sums[pass.name] += pass.milliseconds;
        whole += pass.milliseconds;
    }
    entrant.frames.push_back(whole);
    entrant.gross.push_back(whole + frame->clearMilliseconds);
    for (const auto& [name, milliseconds] : sums)
        entrant.passes[name].push_back(milliseconds);
    return {};
}

Result<Drawn> outcome(gpu::Device& device, Entrant& entrant) {
    Drawn drawn{.milliseconds = spreadOf(entrant.frames),
                .gross = spreadOf(entrant.gross),
                .bytes = entrant.bytes,
                .targetBytes = entrant.targetBytes};
    for (const std::string& name : entrant.passNames)
        drawn.passes.push_back({name, quantile(entrant.passes.at(name), 0.5)});
    auto picture = run::readBack(device, *entrant.session->target(""));
    if (!picture) return picture.error();
    drawn.picture = std::move(*picture);
    return drawn;
}

/// Each pixel the mean of `side` x `side`.
Image meanOfBlocks(const Image& fine, int side) {
    Image mean = plainImage(fine.width / side, fine.height / side, fine.channels);
    const float share = 1.0F / static_cast<float>(side * side);
    for (int y = 0; y < mean.height * side; ++y)
        for (int x = 0; x < mean.width * side; ++x)
            for (int c = 0; c < mean.channels; ++c)
                mean.at(x / side, y / side, c) += share * fine.at(x, y, c);
    return mean;
}

} // namespace

Result<Effect> loadContender(const Contest& contest, const Contender& contender) {
    LoadOptions load{.defines = contender.defines};
    load.defines.insert(load.defines.end(), contest.scene.lights.defines.begin(), contest.scene.lights.defines.end());
    load.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(contest.mapSize));
    if (contest.shadowSize > 0) load.defines.emplace_back("TEGUMENT_SHADOW_SIZE", std::to_string(contest.shadowSize));
    return loadEffect(contender.effect, load);
}

RunOptions runOptionsOf(const Contest& contest, const Contender& contender) {
    return {.technique = contender.technique,
            .width = contest.width,
            .height = contest.height,
            .compiler = contest.compiler,
            .parameters = contender.parameters,
            .assets = contest.assets,
            .clearsApart = true};
}

std::vector<Entry> entriesOf(const Contest& contest, const std::vector<Contender>& contenders) {
    std::vector<Entry> entries;
    entries.reserve(contenders.size());
    for (const Contender& contender : contenders)
        entries.push_back({contest, contender});
    return entries;
}

std::vector<Result<Drawn>> drawInTurns(gpu::Device& device, const std::vector<Entry>& entries, const Frames& frames,
                                       const std::function<void(const std::string&)>& say) {
    std::vector<Result<Entrant>> entrants;
    for (const Entry& entry : entries) {
        say(fmt::format("preparing {} {} ({} of {})", entry.contender.name(), entry.contender.setting, entrants.size() + 1,
                        entries.size()));
        entrants.push_back(enter(device, entry.contest, entry.contender));
    }
    for (int frame = -frames.warmUp; frame < frames.timed; ++frame) {
        say(fmt::format("frame {} of {}", frame + frames.warmUp + 1, frames.warmUp + frames.timed));
        for (std::size_t i = 0; i < entries.size(); ++i)
            if (entrants[i])
                if (const auto drawn = drawOnce(entries[i].contest, *entrants[i], frame >= 0); !drawn) entrants[i] = drawn.error();
    }
    std::vector<Result<Drawn>> outcomes;
    for (Result<Entrant>& entrant : entrants) {
        if (entrant)
            outcomes.push_back(outcome(device, *entrant));
        else
            outcomes.emplace_back(entrant.error());
    }
    return outcomes;
}

Result<Image> drawMean(gpu::Device& device, const Entry& entry, int grid) {
    Contest fine = entry.contest;
    fine.width *= grid;
    fine.height *= grid;
    auto entrant = enter(device, fine, entry.contender);
    if (!entrant) return entrant.error();
    const auto picture = run::readBack(device, *entrant->session->target(""));
    if (!picture) return picture.error();
    return meanOfBlocks(*picture, grid);
}

Result<Errors> errorsOf(const Image& picture, const Sample& sample, const std::vector<glm::dvec3>& truth) {
    const int count = static_cast<int>(sample.points.size());
    Image drawn{.width = count, .height = 1, .channels = 3};
    Image exact = drawn;
    double squares = 0;
    double peak = 0;
    double interior = 0;
    double sum = 0;
    for (std::size_t i = 0; i < sample.points.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const float value = picture.at(sample.points[i].x, sample.points[i].y, c);
            const double error = static_cast<double>(value) - truth[i][c];
            drawn.pixels.push_back(value);
            exact.pixels.push_back(static_cast<float>(truth[i][c]));
            squares += error * error;
            peak = std::max(peak, truth[i][c]);
            sum += truth[i][c];
            if (sample.interior[i] != 0) interior = std::max(interior, std::abs(error));
        }
    const auto difference = compareImages(drawn, exact);
    if (!difference) return difference.error();
    const double values = 3.0 * count;
    return Errors{.relativeL2 = difference->relativeL2,
                  .p99 = difference->p99,
                  .p999 = difference->p999,
                  .largestInterior = interior * values / sum,
                  .bias = difference->bias,
                  .psnr = 10 * std::log10(peak * peak * values / squares),
                  .flip = std::nullopt};
}

} // namespace tegument::bench
