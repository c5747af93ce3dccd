// A session without a window: the same input, the same pictures, and how long each step takes.

#include "host/view/viewer.h"

#include "host/support/file.h"

#include <chrono>

namespace tegument::view {

namespace {

constexpr int kNoReplay = 8049;

Result<void> replaceIn(const ReplayStep& edit) {
    auto text = readFile(edit.file);
    if (!text) return text.error();
    const std::size_t at = text->find(edit.from);
    if (at == std::string::npos)
        return inputError(kNoReplay, {.file = edit.file.string(), .byte = {}},
                          "a step of the replay looks for what is not there: " + edit.from);
    return writeFile(edit.file, text->replace(at, edit.from.size(), edit.to));
}

} // namespace

Result<void> Viewer::awaitSharp(std::vector<Reaction>& reactions) {
    if (!isDraft()) return {};
    const auto begin = std::chrono::steady_clock::now();
    longestPiece_ = 0;
    while (isDraft())
        if (const auto stepped = step(wait()); !stepped) return stepped;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    reactions.push_back({.kind = "sharp after a move", .milliseconds = took.count()});
    reactions.push_back({.kind = "its longest piece", .milliseconds = longestPiece_});
    return {};
}

Result<void> Viewer::awaitReady(std::vector<Reaction>& reactions) {
    const auto begin = std::chrono::steady_clock::now();
    longestPiece_ = 0;
    for (int still = 0; still < kSettlingFrames; still = preparing() ? 0 : still + 1)
        if (const auto stepped = step(wait()); !stepped) return stepped;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    reactions.push_back({.kind = "ready to move", .milliseconds = took.count()});
    reactions.push_back({.kind = "its longest part", .milliseconds = longestPiece_});
    return {};
}

Result<void> Viewer::awaitMade(const ReplayStep& next, std::size_t before, std::vector<Reaction>& reactions) {
    const Input drag{.camera = next.meanwhile, .any = true};
    const bool drags = next.meanwhile != glm::dvec2(0);
    while (making_ || (!next.file.empty() && made_ == before)) {
        Input nothing = wait();
        interrupted_ = drags && making_; // from the worst moment, the beginning of a piece
        const auto begin = std::chrono::steady_clock::now();
        auto stepped = step(nothing);
        if (stepped && interrupted_ && making_) {
            stepped = step(drag);
            const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
            reactions.push_back({.kind = "drag meanwhile", .milliseconds = took.count()});
        }
        interrupted_ = false;
        if (!stepped) return stepped;
    }
    return {};
}

Result<std::vector<Reaction>> Viewer::replay(const std::vector<ReplayStep>& steps) {
    std::vector<Reaction> reactions;
    if (const auto ready = awaitReady(reactions); !ready) return ready.error();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const ReplayStep& next = steps[i];
        const std::size_t before = made_;
        if (!next.file.empty())
            if (const auto edited = replaceIn(next); !edited) return edited.error();
        const auto begin = std::chrono::steady_clock::now();
        longestPiece_ = 0;
        auto stepped = step(next.input);
        const std::size_t mine = reactions.size();
        if (stepped) stepped = awaitMade(next, before, reactions);
        if (!stepped) return stepped.error();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        reactions.insert(reactions.begin() + static_cast<std::ptrdiff_t>(mine), {.kind = next.kind, .milliseconds = took.count()});
        if (made_ != before) reactions.push_back({.kind = next.kind + ", its longest piece", .milliseconds = longestPiece_});
        if (!problem_.empty())
            return inputError(kNoReplay, {.file = request_.effect.string(), .byte = {}},
                              "a step of the replay has no picture: " + problem_);
        const bool moves = i + 1 < steps.size() && steps[i + 1].kind == next.kind;
        if (const auto sharp = moves ? Result<void>() : awaitSharp(reactions); !sharp) return sharp.error();
    }
    return reactions;
}

} // namespace tegument::view

namespace tegument {

Result<Replayed> replayEffect(const ViewRequest& request, const std::vector<view::ReplayStep>& steps,
                              const std::function<void(const std::string&)>& say) {
    const auto viewer = view::Viewer::start(request, say);
    if (!viewer) return viewer.error();
    auto reactions = (*viewer)->replay(steps);
    if (!reactions) return reactions.error();
    return Replayed{.reactions = std::move(*reactions), .validation = (*viewer)->validationMessages()};
}

} // namespace tegument
