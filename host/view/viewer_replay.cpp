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
    while (isDraft())
        if (const auto stepped = step(wait()); !stepped) return stepped;
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    reactions.push_back({.kind = "sharp after a move", .milliseconds = took.count()});
    reactions.push_back({.kind = "its longest piece", .milliseconds = longestPiece_});
    return {};
}

Result<void> Viewer::awaitReady(std::vector<Reaction>& reactions) {
    const auto begin = std::chrono::steady_clock::now();
    double longest = 0;
    for (int still = 0; still < kSettlingFrames; still = preparing() ? 0 : still + 1) {
        const Input nothing = wait();
        const auto one = std::chrono::steady_clock::now();
        if (const auto stepped = step(nothing); !stepped) return stepped;
        longest = std::max(longest, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - one).count());
    }
    const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
    reactions.push_back({.kind = "ready to move", .milliseconds = took.count()});
    reactions.push_back({.kind = "its longest part", .milliseconds = longest});
    return {};
}

Result<std::vector<Reaction>> Viewer::replay(const std::vector<ReplayStep>& steps) {
    std::vector<Reaction> reactions;
    if (const auto ready = awaitReady(reactions); !ready) return ready.error();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const ReplayStep& next = steps[i];
        const std::size_t before = answers_;
        if (!next.file.empty())
            if (const auto edited = replaceIn(next); !edited) return edited.error();
        const auto begin = std::chrono::steady_clock::now();
        auto stepped = step(next.input);
        while (stepped && !next.file.empty() && answers_ == before)
            stepped = step(wait());
        if (!stepped) return stepped.error();
        const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - begin;
        reactions.push_back({.kind = next.kind, .milliseconds = took.count()});
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
