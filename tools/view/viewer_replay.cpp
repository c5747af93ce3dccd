// A session without hands: the same input, the same pictures, and how long each step takes.

#include "tools/view/viewer.h"

#include "host/support/file.h"
#include "host/support/temporary.h"

#include <fmt/format.h>

#include <chrono>

namespace tegument::view {

namespace {

constexpr int kNoReplay = 8049;
constexpr const char* kNewDigits = "{new}";

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// Files that steps change; they are put back, however the replay ends.
class Edits {
public:
    Edits() : digits_(fmt::format("{:06}", std::chrono::system_clock::now().time_since_epoch() / std::chrono::milliseconds(1) % 1000000)) {}

    Result<void> make(const ReplayStep& edit) {
        auto text = readFile(edit.file);
        if (!text) return text.error();
        const Borrowed& file = files_.try_emplace(edit.file, edit.file, *text).first->second;
        if (edit.from.empty()) return file.change(file.content());
        const std::size_t at = text->find(edit.from);
        if (at == std::string::npos)
            return inputError(kNoReplay, {.file = edit.file.string()}, "a step of the replay looks for what is not there: " + edit.from);
        std::string to = edit.to;
        if (const std::size_t asks = to.find(kNewDigits); asks != std::string::npos)
            to.replace(asks, std::string_view(kNewDigits).size(), digits_);
        return file.change(text->replace(at, edit.from.size(), to));
    }

private:
    std::string digits_;
    std::map<std::filesystem::path, Borrowed> files_;
};

} // namespace

Result<void> Viewer::awaitSharp(std::vector<Reaction>& reactions) {
    if (!isDraft() && !stale_) return {};
    const auto begin = Clock::now();
    longestPiece_ = 0;
    while (isDraft() || stale_)
        if (const auto stepped = step(wait()); !stepped) return stepped;
    reactions.push_back({.kind = "sharp after a move", .milliseconds = millisecondsSince(begin), .unanswered = longestPiece_});
    return {};
}

Result<void> Viewer::awaitReady(std::vector<Reaction>& reactions) {
    const auto begin = Clock::now();
    longestPiece_ = 0;
    for (int still = 0; still < kSettlingFrames; still = preparing() ? 0 : still + 1)
        if (const auto stepped = step(wait()); !stepped) return stepped;
    reactions.push_back({.kind = "ready to move", .milliseconds = millisecondsSince(begin), .unanswered = longestPiece_});
    return {};
}

Result<void> Viewer::awaitMade(const ReplayStep& next, std::size_t before, std::vector<Reaction>& reactions) {
    const Input drag{.camera = next.meanwhile, .any = true};
    const bool drags = next.meanwhile != glm::dvec2(0);
    while (making_ || stale_ || meshesMaking_.valid() || (!next.file.empty() && made_ == before)) {
        Input nothing = wait();
        interrupted_ = drags && making_; // from the worst moment, the beginning of a piece
        const auto begin = Clock::now();
        auto stepped = step(nothing);
        if (stepped && interrupted_ && making_) {
            stepped = step(drag);
            const double took = millisecondsSince(begin);
            reactions.push_back({.kind = "drag meanwhile", .milliseconds = took, .unanswered = took});
        }
        interrupted_ = false;
        if (!stepped) return stepped;
    }
    return {};
}

Result<std::vector<Reaction>> Viewer::replay(const std::vector<ReplayStep>& steps) {
    std::vector<Reaction> reactions;
    Edits edits;
    bool ready = false;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        const ReplayStep& next = steps[i];
        const bool begins = i == 0 || steps[i - 1].kind != next.kind; // as after a look at what the step before has shown
        if (begins && !next.soon && (!ready || preparing())) {
            if (const auto awaited = awaitReady(reactions); !awaited) return awaited.error();
            ready = true;
        }
        const std::size_t before = made_;
        if (!next.file.empty())
            if (const auto edited = edits.make(next); !edited) return edited.error();
        const auto begin = Clock::now();
        longestPiece_ = 0;
        auto stepped = step(next.input);
        const std::size_t mine = reactions.size();
        if (stepped) stepped = awaitMade(next, before, reactions);
        if (!stepped) return stepped.error();
        const Reaction reaction{.kind = next.kind, .milliseconds = millisecondsSince(begin), .unanswered = longestPiece_};
        reactions.insert(reactions.begin() + static_cast<std::ptrdiff_t>(mine), reaction);
        if (!problem_.empty())
            return inputError(kNoReplay, {.file = request_.effect.string()}, "a step of the replay has no picture: " + problem_);
        const bool moves = i + 1 < steps.size() && (steps[i + 1].kind == next.kind || steps[i + 1].soon);
        if (const auto sharp = moves ? Result<void>() : awaitSharp(reactions); !sharp) return sharp.error();
    }
    if (const auto awaited = ready ? Result<void>() : awaitReady(reactions); !awaited) return awaited.error();
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
