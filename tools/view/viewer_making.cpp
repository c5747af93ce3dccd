// Another technique, setting or text of the effect: made while the old picture is shown and moved. What needs no device is done by another
// thread; then a session of its own draws its first frame piece by piece, while nobody asks for anything else.

#include "tools/view/viewer.h"

#include "host/run/semantics.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr int kPatientTries = 3;
constexpr double kUnknownShare = 0.375;                        // of each side of a picture
constexpr auto kBetweenTexts = std::chrono::milliseconds(250); // a line that changes costs a picture of the text

} // namespace

ToRead Viewer::toRead(const ViewRequest& request, const Wanted& wanted) {
    LoadOptions load = request.load;
    load.setting = wanted.setting;
    RunOptions options = runOptionsOf(request);
    options.technique = wanted.technique;
    return {.source = nullptr,
            .file = request.effect,
            .load = std::move(load),
            .adopt = {.bind = wanted.binds, .width = request.run.width, .height = request.run.height},
            .keeps = request.keeps,
            .scene = request.scene,
            .workspace = &request == &request_ ? state_.workspace : run::inWorld(request.workspace, request.scene),
            .run = std::move(options)};
}

void Viewer::load(std::string what, bool anew) {
    make({.what = std::move(what), .wanted = wanted_, .reads = true, .anew = anew});
}

void Viewer::makeAnother(Command command) {
    ViewState next = state_;
    next.technique = wanted_.technique;
    next.setting = wanted_.setting;
    if (apply(next, command, start_) != Request::None)
        makeWanted({.technique = next.technique, .setting = next.setting, .binds = wanted_.binds});
}

void Viewer::makeWanted(const Wanted& wanted) {
    notice_.clear();
    const bool reads = wanted.setting != wanted_.setting;
    make({.what = reads ? "setting " + wanted.setting : "technique " + wanted.technique,
          .wanted = wanted,
          .reads = reads,
          .picture = !reads});
}

/// What was begun before it is not finished, but what it would have read is.
void Viewer::make(Making making) {
    wanted_ = making.wanted;
    if (making_) {
        making.reads = making.reads || making_->reads;
        making.anew = making.anew || making_->anew;
        making.picture = making.picture || making_->picture;
        making.file = std::move(making_->file);
        making.opening = std::move(making_->opening);
        making.request = std::move(making_->request);
    }
    dropMaking();
    making_ = std::make_unique<Making>(std::move(making));
    settling_ = kSettlingFrames;
    if (making_->opening.valid()) return; // it is read once that is there
    ToRead asked = toRead(making_->request ? *making_->request : request_, making_->wanted);
    if (!making_->request && !making_->anew) asked.known.uploaded = loaded_->session.known().uploaded;
    if (!making_->reads) {
        asked.source = loaded_->source;
        asked.known = loaded_->session.known();
    }
    making_->reading = std::make_unique<Reading>(std::move(asked));
}

void Viewer::dropMaking() {
    if (making_ && making_->reading) {
        making_->reading->giveUp();
        abandoned_.push_back(std::move(making_->reading));
    }
    making_.reset();
}

Result<void> Viewer::advance(bool rests) {
    std::erase_if(abandoned_, [](const auto& reading) { return reading->done(); });
    if (!making_) return {};
    if (making_->opening.valid() && making_->opening.wait_for(std::chrono::seconds(0)) == std::future_status::ready)
        if (const auto taken = takeOpened(); !taken || !making_) return taken;
    if (making_->reading && making_->reading->done())
        if (const auto taken = takeReading(); !taken || !making_) return taken;
    const auto now = std::chrono::steady_clock::now();
    if (now - told_ >= kBetweenTexts && makingText() != madeText_) {
        madeText_ = makingText();
        told_ = now;
        settling_ = std::max(settling_, 1);
    }
    return rests && making_->loaded ? drawMaking() : Result<void>();
}

Result<void> Viewer::takeReading() {
    ReadAhead read = making_->reading->take();
    making_->reading.reset();
    const ViewRequest& request = making_->request ? *making_->request : request_;
    const bool anew = making_->anew || making_->request;
    if (read.source)
        making_->loaded =
            std::make_unique<Loaded>(device_, std::move(read.source), request.keeps, request.scene, anew ? nullptr : loaded_.get());
    if (!read.ahead) return failMaking(read.ahead.error());
    making_->loaded->session.take(std::move(*read.ahead));
    making_->wanted.technique = techniqueOf(making_->loaded->effect, making_->wanted.technique);
    making_->how = anew ? Sharpness{} : soon(); // all of it, and its times, are to be seen
    return {};
}

Sharpness Viewer::soon() const {
    if (!costs_.slow(Moving::Rest)) return {};
    return {.share = costs_.share(Moving::Rest), .drafting = false, .coarse = fewer_ != nullptr, .single = true};
}

Result<void> Viewer::drawMaking() {
    Making& making = *making_;
    const Sharpness shown = std::exchange(sharpness_, making.how);
    inPieces_ = true;
    RunOptions options = runOptionsOf(making.request ? *making.request : request_);
    inPieces_ = false;
    if (making.how.share < 1) options.pieces.bands.clear(); // they are those of a whole picture
    if (++making.tries <= kPatientTries) {
        lookAt(making);
    } else { // who gives up all the time gets whole passes done, and of one view
        options.pieces = {.goOn = options.pieces.goOn};
    }
    sharpness_ = shown;
    options.parameters = making.parameters;
    options.technique = making.wanted.technique;
    const auto begin = std::chrono::steady_clock::now();
    auto frame = making.loaded->session.draw(making.workspace, options, making.picture ? kAllPasses : passCount(state_));
    if (!frame) return failMaking(frame.error());
    if (frame->givenUp) return {};
    milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    return finishMaking(std::move(*frame));
}

Result<void> Viewer::finishMaking(SessionFrame frame) {
    const std::unique_ptr<Making> made = std::move(making_);
    if (made->picture) (void)apply(state_, Command::Picture, start_);
    const bool opened = made->request.has_value();
    if (opened) showOpened(std::move(*made->request));
    state_.technique = made->wanted.technique;
    state_.binds = made->wanted.binds;
    adopt(state_, made->loaded->effect);
    wanted_ = {.technique = state_.technique, .setting = state_.setting, .binds = state_.binds};
    dropDraft();
    sharpness_ = made->how;
    torn_ = broken_ = false;
    ++made_;
    loaded_ = std::move(made->loaded);
    levelled_.clear();
    targets_.forgetAll();
    std::erase_if(state_.parameters, [&](const auto& value) { return !loaded_->effect.findParameter(value.first); });
    if (made->reads) readPresets();
    if (opened) {
        start_ = state_;
        notice("shown: " + made->file.string());
    }
    start_.presets = state_.presets;
    watchFiles(&loaded_->effect, nullptr);
    const bool all = std::ranges::none_of(frame.passes, &SessionPass::kept);
    const auto developed = develop(std::move(frame));
    costs_.quick = {}; // of another technique, or another text
    costs_.note(passCosts(), 0, sharpness_.share, all ? std::optional(Moving::Rest) : std::nullopt, isDraft());
    if (made->tries > kPatientTries) stale_ = true; // it is of an older view
    return developed;
}

Result<void> Viewer::failMaking(const Error& error) {
    const std::unique_ptr<Making> made = std::move(making_);
    if (made->reads && !made->request && saving()) return {}; // it may have been read half written, and is read again
    ++made_;
    if (made->request) { // refused; what was there before is as good as it was
        wanted_ = {.technique = state_.technique, .setting = state_.setting, .binds = state_.binds};
        return report(nullptr, error);
    }
    broken_ = true;
    return report(made->loaded ? &made->loaded->effect : nullptr, error);
}

std::string Viewer::makingText() const {
    if (!making_) return {};
    const std::string progress = making_->reading ? making_->reading->progress() : making_->loaded ? "drawing" : "reading";
    return making_->what + (progress.empty() ? "" : ", " + progress);
}

} // namespace tegument::view
