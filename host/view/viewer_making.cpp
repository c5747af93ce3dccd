// Another technique, setting or text of the effect: made while the old picture is shown and moved. What needs no device is done by another
// thread; then a session of its own draws its first frame piece by piece, while nobody asks for anything else.

#include "host/view/viewer.h"

#include <algorithm>

namespace tegument::view {

namespace {

constexpr int kPatientTries = 3;
constexpr auto kBetweenTexts = std::chrono::milliseconds(250); // a line that changes costs a picture of the text

} // namespace

ToRead Viewer::toRead(const Wanted& wanted, LoadOptions load) {
    load.setting = wanted.setting;
    RunOptions options = runOptions();
    options.technique = wanted.technique;
    return {.source = nullptr,
            .file = request_.effect,
            .load = std::move(load),
            .adopt = {.bind = wanted.binds, .technique = {}, .width = request_.run.width, .height = request_.run.height},
            .keeps = request_.keeps,
            .scene = request_.scene,
            .workspace = state_.workspace,
            .run = std::move(options),
            .known = {.programs = {}, .uploaded = loaded_->session.known().uploaded}};
}

void Viewer::load(std::string what, bool anew) {
    make({.what = std::move(what), .wanted = wanted_, .reads = true, .anew = anew, .reading = nullptr});
}

void Viewer::makeAnother(Command command) {
    notice_.clear();
    ViewState next = state_;
    next.technique = wanted_.technique;
    next.setting = wanted_.setting;
    if (apply(next, command, start_) == Request::None) return;
    const bool reads = command == Command::NextSetting;
    make({.what = reads ? "setting " + next.setting : "technique " + next.technique,
          .wanted = {.technique = next.technique, .setting = next.setting, .binds = wanted_.binds},
          .reads = reads,
          .picture = !reads,
          .reading = nullptr});
}

/// What was begun before it is not finished, but what it would have read is.
void Viewer::make(Making making) {
    if (making_) {
        making.reads = making.reads || making_->reads;
        making.anew = making.anew || making_->anew;
        making.picture = making.picture || making_->picture;
    }
    dropMaking();
    wanted_ = making.wanted;
    ToRead asked = toRead(making.wanted, request_.load);
    if (making.anew) asked.known = {};
    if (!making.reads) {
        asked.source = loaded_->source;
        asked.known = loaded_->session.known();
    }
    making.reading = std::make_unique<Reading>(std::move(asked));
    making_ = std::make_unique<Making>(std::move(making));
    settling_ = kSettlingFrames;
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
    if (read.source)
        making_->loaded = std::make_unique<Loaded>(device_, std::move(read.source), request_.keeps, request_.scene,
                                                   making_->anew ? nullptr : loaded_.get());
    if (!read.ahead) return failMaking(read.ahead.error());
    making_->loaded->session.take(std::move(*read.ahead));
    making_->wanted.technique = techniqueOf(making_->loaded->effect, making_->wanted.technique);
    making_->how = making_->anew ? Sharpness{} : soon(); // all of it, and its times, are to be seen
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
    RunOptions options = runOptions();
    inPieces_ = false;
    if (making.how.share < 1) options.pieces.bands.clear(); // they are those of a whole picture
    if (++making.tries <= kPatientTries) {
        making.workspace = state_.workspace;
        making.parameters = state_.parameters;
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
    if (made->reads) readPresets();
    start_.presets = state_.presets;
    watchFiles(&loaded_->effect, nullptr);
    const bool all = std::ranges::none_of(frame.passes, &SessionPass::kept);
    const auto developed = develop(std::move(frame));
    costs_.note(passCosts(), 0, sharpness_.share, all ? std::optional(Moving::Rest) : std::nullopt, isDraft());
    return developed && made->tries > kPatientTries ? drawMoving(Moving::Rest, false) : developed;
}

Result<void> Viewer::failMaking(const Error& error) {
    const std::unique_ptr<Making> made = std::move(making_);
    broken_ = true;
    ++made_;
    return report(made->loaded ? &made->loaded->effect : nullptr, error);
}

std::string Viewer::makingText() const {
    if (!making_) return {};
    const std::string progress = making_->reading ? making_->reading->progress() : "drawing";
    return making_->what + (progress.empty() ? "" : ", " + progress);
}

} // namespace tegument::view
