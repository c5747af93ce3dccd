#include "host/run/pieces.h"

#include <algorithm>
#include <chrono>
#include <span>

namespace tegument::run {

namespace {

constexpr std::uint32_t kTile = 64;
constexpr double kLongBand = 60;          // milliseconds
constexpr std::uint32_t kLeastRows = 128; // of a band of a pass of which nothing is known

using TimedSections = std::vector<gpu::TimedSection>;

/// At work on one frame.
struct PieceWork {
    gpu::Device& device;
    const Frame& frame;
    const DrawnInPieces& pieces;
    PiecesDrawn drawn{};
    std::vector<const FrameItem*> waiting{}; // what stands in front of the next draw
    bool first = true;

    /// Whether the next piece is to be drawn.
    bool goesOn() {
        if (!first && !drawn.givenUp) drawn.givenUp = !pieces.goOn();
        first = false;
        return !drawn.givenUp;
    }

    Result<TimedSections> run(const std::function<Result<void>(gpu::Recorder&)>& record) { return device.run(record); }
};

Result<void> asVoidOf(const Result<TimedSections>& sections) {
    return sections ? Result<void>() : Result<void>(sections.error());
}

/// None: the draw is not cut.
std::vector<std::optional<gpu::RowRange>> bandsFor(const FrameDraw& draw, const DrawnInPieces& pieces) {
    const auto bands = pieces.bands.find(draw.described.name);
    const gpu::Texture* target = draw.targets.colors.empty() ? draw.targets.depth : draw.targets.colors.front();
    if (draw.computes() || !target) return {std::nullopt};
    const std::uint32_t height = target->desc().height;
    const std::uint32_t count = bands == pieces.bands.end() ? std::min(pieces.others, height / kLeastRows) : bands->second;
    if (count < 2) return {std::nullopt};
    const std::vector<gpu::RowRange> rows = bandsOf(height, count);
    return {rows.begin(), rows.end()};
}

std::vector<std::optional<gpu::RowRange>> halved(std::span<const std::optional<gpu::RowRange>> bands) {
    std::vector<std::optional<gpu::RowRange>> halves;
    for (const auto& band : bands) {
        const std::uint32_t upper = band ? (band->count / 2 + kTile - 1) / kTile * kTile : 0;
        if (!band || upper >= band->count) {
            halves.push_back(band);
            continue;
        }
        halves.emplace_back(gpu::RowRange{.first = band->first, .count = upper});
        halves.emplace_back(gpu::RowRange{.first = band->first + upper, .count = band->count - upper});
    }
    return halves;
}

Result<void> recordWaiting(PieceWork& work, gpu::Recorder& recorder) {
    for (const FrameItem* item : work.waiting)
        if (auto done = recordItem(*item, recorder); !done) return done;
    work.waiting.clear();
    return {};
}

/// The frame's item of that number. One section, whatever the number of bands.
Result<void> drawBands(PieceWork& work, const FrameDraw& draw, std::size_t item) {
    gpu::TimedSection whole{.name = draw.described.name, .milliseconds = 0};
    std::vector<std::optional<gpu::RowRange>> bands = bandsFor(draw, work.pieces);
    for (std::size_t i = 0; i < bands.size(); ++i) {
        if (!work.goesOn()) return {};
        work.drawn.begun = item + 1;
        const std::optional<gpu::RowRange> rows = bands[i];
        const auto begin = std::chrono::steady_clock::now();
        const auto sections = work.run([&](gpu::Recorder& recorder) -> Result<void> {
            if (auto before = recordWaiting(work, recorder); !before) return before;
            recorder.beginTimer(draw.described.name);
            auto done = recordDrawIn(draw, rows, recorder);
            recorder.endTimer();
            return done;
        });
        if (!sections) return sections.error();
        whole.milliseconds += sections->back().milliseconds;
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        if (took.count() <= kLongBand) continue;
        const auto rest = halved(std::span(bands).subspan(i + 1));
        bands.resize(i + 1);
        bands.insert(bands.end(), rest.begin(), rest.end());
    }
    work.drawn.sections.push_back(std::move(whole));
    return {};
}

Result<void> drawItems(PieceWork& work, std::size_t items) {
    PiecesDrawn& drawn = work.drawn;
    for (std::size_t i = 0; i < std::min(items, work.frame.items.size()); ++i) {
        if (!work.frame.kept.empty() && work.frame.kept[i]) continue;
        const FrameItem& item = work.frame.items[i];
        const auto* draw = std::get_if<FrameDraw>(&item);
        if (!draw) {
            work.waiting.push_back(&item);
            continue;
        }
        if (const auto done = drawBands(work, *draw, i); !done || drawn.givenUp) return done;
        drawn.done = i + 1;
    }
    if (work.waiting.empty()) return {};
    return asVoidOf(work.run([&](gpu::Recorder& recorder) { return recordWaiting(work, recorder); }));
}

constexpr int kGivenUp = 0; // no diagnostic has it

} // namespace

std::vector<gpu::RowRange> bandsOf(std::uint32_t height, std::uint32_t bands) {
    const std::uint32_t tiles = (height + kTile - 1) / kTile;
    const std::uint32_t each = kTile * ((tiles + std::max(1U, bands) - 1) / std::max(1U, bands));
    std::vector<gpu::RowRange> rows;
    for (std::uint32_t first = 0; first < height; first += each)
        rows.push_back({.first = first, .count = std::min(each, height - first)});
    return rows;
}

Result<PiecesDrawn> drawInPieces(gpu::Device& device, const Frame& frame, std::size_t items, const DrawnInPieces& pieces) {
    PieceWork work{.device = device, .frame = frame, .pieces = pieces};
    if (const auto drawn = drawItems(work, items); !drawn) return drawn.error();
    if (!frame.resolve || frame.resolveKept || !work.goesOn()) return std::move(work.drawn);
    const auto resolved = work.run([&](gpu::Recorder& recorder) { return recordResolve(*frame.resolve, recorder); });
    if (!resolved) return resolved.error();
    work.drawn.sections.push_back(resolved->back());
    return std::move(work.drawn);
}

Error givenUp() {
    return inputError(kGivenUp, {}, "given up");
}

bool isGivenUp(const Error& error) {
    return error.diagnostics.size() == 1 && error.diagnostics.front().code == kGivenUp;
}

Result<void> pauseAfter(const RunOptions& options) {
    if (!options.pieces.goOn || options.pieces.goOn()) return {};
    return givenUp();
}

} // namespace tegument::run
