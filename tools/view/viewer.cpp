#include "tools/view/viewer.h"

#include "host/run/pixels.h"
#include "host/run/semantics.h"
#include "host/support/file.h"
#include "meshprep/adopt/adopt.h"
#include "tools/view/levels.h"
#include "tools/view/places.h"
#include "tools/view/workspace_write.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>

namespace tegument::view {

namespace fs = std::filesystem;

namespace {

constexpr double kBetweenLooks = 0.05;                  // seconds between two looks at the files
constexpr auto kSaving = std::chrono::milliseconds(40); // an editor may be in the middle of a file
constexpr auto kMostSaving = std::chrono::seconds(1);
constexpr double kShort = 0.005; // while the text settles, or the window changes
constexpr int kMostFailures = 5;
constexpr int kDeviceLost = 6007;
constexpr const char* kNoSurroundings = "nothing to turn here: skin stands in surroundings with --set TEGUMENT_SURROUNDINGS=1";
constexpr std::uint32_t kUnknownBands = 8; // of a pass that was not drawn yet

Result<gpu::Texture> makeTarget(gpu::Device& device, const char* name, PixelSize size) {
    return device.createTexture(
        {.name = name, .format = gpu::Format::RGBA8, .width = size.width, .height = size.height, .renderTarget = true});
}

} // namespace

Viewer::Viewer(const ViewRequest& request, const std::function<void(const std::string&)>& say, std::optional<Window> window,
               gpu::Device device)
    : request_(request), say_(say), window_(std::move(window)), device_(std::move(device)) {}

Result<std::unique_ptr<Viewer>> Viewer::start(const ViewRequest& request, const std::function<void(const std::string&)>& say) {
    const PixelSize size{static_cast<std::uint32_t>(request.run.width), static_cast<std::uint32_t>(request.run.height)};
    std::optional<Window> window;
    std::optional<gpu::WindowSurface> surface;
    if (request.window) {
        auto opened = Window::open("tegument", size);
        if (!opened) return opened.error();
        window = std::move(*opened);
        surface = window->surface();
    }
    auto device = gpu::Device::create({.validation = request.validate, .prefer = request.device, .window = surface ? &*surface : nullptr});
    if (!device) return device.error();
    std::unique_ptr<Viewer> viewer(new Viewer(request, say, std::move(window), std::move(*device)));
    if (const auto prepared = viewer->prepare(); !prepared) return prepared.error();
    return viewer;
}

Result<void> Viewer::prepare() {
    if (window_) {
        auto presenter = gpu::Presenter::create(device_);
        if (!presenter) return presenter.error();
        presenter_ = std::move(*presenter);
    }
    auto canvas = Canvas::create(device_, request_.run.compiler);
    if (!canvas) return canvas.error();
    canvas_ = std::move(*canvas);
    auto overlay = Overlay::create(device_, window_ ? &*window_ : nullptr);
    if (!overlay) return overlay.error();
    overlay_ = std::move(*overlay);
    begin();
    area_.shape = static_cast<double>(request_.run.width) / std::max(1, request_.run.height);
    arrangePanels();
    size_ = area_.pixels();
    auto effect = readSource();
    if (!effect) return effect.error();
    if (!request_.beside.empty())
        if (const auto opened = openBeside(request_.beside); !opened) return opened;
    auto loaded = std::make_unique<Loaded>(device_, std::move(*effect), request_.keeps, request_.scene);
    auto frame = drawWith(*loaded);
    if (!frame) return frame.error();
    loaded_ = std::move(loaded);
    adopt(state_, loaded_->effect);
    wanted_ = {.technique = state_.technique, .setting = state_.setting, .binds = state_.binds};
    readPresets();
    start_ = state_;
    watchFiles(&loaded_->effect, nullptr);
    return develop(std::move(*frame));
}

void Viewer::begin() {
    state_.workspace = run::inWorld(request_.workspace, request_.scene);
    state_.parameters = request_.run.parameters;
    state_.preset.clear();
    state_.technique = request_.run.technique;
    state_.setting = request_.load.setting;
    state_.binds = request_.binds;
}

void Viewer::readPresets() {
    auto presets = loadPresets(request_.effect);
    if (!presets) notice(format(presets.error()));
    state_.presets = presets ? std::move(*presets) : std::vector<Preset>();
    for (Preset& preset : state_.presets) // an edit may have left some behind
        std::erase_if(preset.parameters, [&](const auto& value) {
            const Parameter* parameter = loaded_->effect.findParameter(value.first);
            return !parameter || static_cast<std::size_t>(parameter->type.scalarCount()) != value.second.size();
        });
}

Result<std::shared_ptr<const Adoption>> Viewer::readSource() const {
    LoadOptions load = request_.load;
    load.setting = state_.setting;
    auto effect = readEffect(request_.effect, load, {.bind = state_.binds, .width = request_.run.width, .height = request_.run.height});
    if (!effect) return effect.error();
    return std::make_shared<const Adoption>(std::move(*effect));
}

/// What goes wrong is shown, as an error of the effect is. It may be in what the panels need: they go.
Result<void> Viewer::run() {
    int failed = 0; // in a row
    while (running_) {
        const auto stepped = step(wait());
        if (stepped) failed = 0;
        if (stepped || !running_) continue;
        if (++failed > kMostFailures) return stepped;
        state_.strip = state_.probe = state_.times = state_.errors = false;
        state_.mesh = MeshShow::None;
        if (const auto reported = report(nullptr, stepped.error()); !reported) return reported;
    }
    return {};
}

bool Viewer::isBusy() const {
    const auto runs = [](const auto& work) { return work.valid() && work.wait_for(std::chrono::seconds(0)) != std::future_status::ready; };
    const auto reads = [](const auto& reading) { return reading && !reading->done(); };
    return (making_ && (runs(making_->opening) || reads(making_->reading))) || std::ranges::any_of(abandoned_, reads) ||
           runs(meshesMaking_) || std::ranges::any_of(meshesAbandoned_, runs);
}

Input Viewer::wait() {
    const PixelSize pixels = area_.window;
    const bool settles = pixels.width > 0 && pixels.height > 0 && settling_ > 0;
    const double patience =
        settles || !waitingKeys_.empty() || making_ || stale_ || meshesMaking_.valid() || firstSaved_ ? kShort : kBetweenLooks;
    if (window_) return window_->wait(patience, overlay_->wantsMouse(), borderOfWindow(), area_.shares());
    std::this_thread::sleep_for(
        std::chrono::duration<double>(making_ || stale_ || meshesMaking_.valid() || firstSaved_ ? kShort : kBetweenLooks));
    return {};
}

Result<void> Viewer::step(const Input& input) {
    pieceBegan_ = std::chrono::steady_clock::now();
    arrangePanels();
    const bool seen = area_.window.width > 0 && area_.window.height > 0;
    if (input.any || overlay_->hasKeys()) settling_ = kSettlingFrames;
    cursor_ = input.cursor;
    state_.cursor = glm::clamp(area_.onPicture(cursor_), 0.0, 1.0);
    if (input.closed) running_ = false;
    if (input.border) state_.border = std::clamp(area_.onPicture({*input.border, 0}).x, 0.0, 1.0);
    if (const auto obeyed = obey(input); !obeyed) return obeyed;
    for (const fs::path& file : input.dropped)
        dropped_.push_back({.file = file, .sets = {}});
    openDropped();
    if (edited()) load("the edit");
    if (const auto resized = resize(); !resized) return resized;
    if (torn_)
        if (const auto drawn = drawAs(sharpness_); !drawn) return drawn;
    if (meshesMaking_.valid() && !stale_ && haveMeshes())
        if (const auto painted = paint(); !painted) return painted;
    if (const auto advanced = advance(!asks(input) && !stale_); !advanced) return advanced;
    if (stale_ || !making_ || !making_->loaded)
        if (const auto sharpened = sharpen(); !sharpened) return sharpened;
    if (!input.any && !isDraft() && !stale_ && !making_) { // once nothing moves
        if (const auto measured = measureBeside(); !measured) return measured;
        if (const auto prepared = prepareToMove(); !prepared) return prepared;
    }
    const auto shown = seen && settling_ > 0 && !torn_ ? show() : Result<void>();
    notePiece();
    return shown;
}

bool Viewer::saving() {
    if (watch_.changed()) {
        lastSaved_ = std::chrono::steady_clock::now();
        if (!firstSaved_) firstSaved_ = lastSaved_;
    }
    return firstSaved_.has_value();
}

bool Viewer::edited() {
    (void)saving();
    const auto now = std::chrono::steady_clock::now();
    const bool whole = firstSaved_ && (now - lastSaved_ >= kSaving || now - *firstSaved_ >= kMostSaving);
    if (whole) firstSaved_.reset();
    return whole;
}

Result<void> Viewer::obey(const Input& input) {
    if (input.surroundings != 0 && !hasSurroundings(state_)) notice(kNoSurroundings);
    if (apply(state_, input))
        if (const auto drawn = drawMoving(movesLight(input) ? Moving::Rest : Moving::Camera); !drawn) return drawn;
    if (state_.source && std::ranges::find(input.keys, kKeyWrite) != input.keys.end()) writeSource(source_);
    std::vector<char32_t> keys = std::exchange(waitingKeys_, {});
    auto& later = input.clicked ? waitingKeys_ : keys; // the click may have been on a field that takes what is typed
    later.insert(later.end(), input.keys.begin(), input.keys.end());
    if (overlay_->wantsKeys()) return {};
    for (const char32_t key : keys)
        if (const auto command = commandOf(key))
            if (const auto done = obey(*command); !done) return done;
    return {};
}

Result<void> Viewer::obey(Command command) {
    switch (command) {
    case Command::NextTechnique:
    case Command::PreviousTechnique:
    case Command::NextSetting: makeAnother(command); return {};
    case Command::NextPreset:
    case Command::Reset:
        if (apply(state_, command, start_) == Request::None) return {};
        notice_.clear();
        return drawMoving(Moving::Rest, false);
    default: return fulfil(apply(state_, command, start_));
    }
}

Result<void> Viewer::fulfil(Request request) {
    notice_.clear();
    switch (request) {
    case Request::None: return {};
    case Request::Draw: return drawSoon();
    case Request::Move: return drawMoving(Moving::Camera);
    case Request::Levels: return stale_ ? Result<void>() : paint();
    case Request::Load: load("all of it, read anew", true); return {};
    case Request::Save:
        if (isDraft() || stale_)
            if (const auto drawn = draw(); !drawn) return drawn;
        save();
        return {};
    case Request::SaveWorkspace:
        if (const auto path = saveWorkspace()) notice("wrote " + path->string());
        return {};
    case Request::CopyCommand: copyCommand(); return {};
    case Request::Keep: return keep();
    case Request::Quit: running_ = false; return {};
    }
    return {};
}

Result<void> Viewer::resize() {
    const Layout before = area_.layout;
    arrangePanels(); // keys may have opened some
    if (area_.layout != before) settling_ = kSettlingFrames;
    const PixelSize pixels = area_.pixels();
    if (pixels.width == 0 || pixels.height == 0 || pixels == size_) return {};
    size_ = pixels;
    return drawMoving(Moving::Camera, false);
}

void Viewer::arrangePanels() {
    area_.window = window_ ? window_->pixels()
                           : PixelSize{static_cast<std::uint32_t>(request_.run.width), static_cast<std::uint32_t>(request_.run.height)};
    area_.points = window_ ? window_->points() : glm::vec2(area_.window.width, area_.window.height);
    const float em = overlay_->em();
    const bool sheets = state_.help || state_.probe || state_.times || state_.textures || state_.bindings || state_.mesh != MeshShow::None;
    area_.layout = arrange(area_.points.x, area_.points.y,
                           {.em = em,
                            .frame = state_.information,
                            .controls = state_.controls,
                            .sheets = sheets,
                            .strip = state_.strip,
                            .source = state_.source,
                            .problem = problemHeight(problem_, area_.points.x, em)});
}

Result<SessionFrame> Viewer::drawWith(Loaded& loaded) {
    const auto begin = std::chrono::steady_clock::now();
    auto frame = loaded.session.draw(area_.seen(state_.workspace, size_), runOptions(), passCount(state_));
    milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    settling_ = kSettlingFrames;
    return frame;
}

Result<void> Viewer::develop(SessionFrame frame) {
    if (!problem_.empty() && !broken_) say_("the picture is up to date again");
    if (!broken_) problem_.clear();
    if (frame.technique != frame_.technique) {
        targets_.forgetAll();
        pieces_.forget();
    }
    frame_ = std::move(frame);
    times_.note(frame_);
    moved_ = std::chrono::steady_clock::now();
    stale_ = false;
    ++frames_;
    targets_.forget();
    adopt(state_, frame_);
    state_.fur = !rootsTexture().empty();
    if (!state_.fur && state_.mesh == MeshShow::Fur) state_.mesh = MeshShow::None;
    for (const Diagnostic& warning : frame_.warnings)
        if (std::string text = format(warning); warned_.insert(text).second) say_(text);
    const std::string name = shownTarget(state_, frame_);
    const auto found = shownTexture();
    if (!found) return found.error();
    gpu::Texture* texture = *found;
    assert(texture); // the frame has drawn into it
    state_.levels = static_cast<int>(texture->desc().mips);
    state_.level = std::min(state_.level, state_.levels - 1);
    if (const auto levels = findLevels(*texture, name); !levels) return levels;
    if (const auto drawn = drawBeside(); !drawn) return report(nullptr, drawn.error());
    noteCosts();
    return paint();
}

Result<void> Viewer::findLevels(gpu::Texture& texture, const std::string& name) {
    const std::string what =
        fmt::format("{} {} {} {} {}", static_cast<int>(state_.show), state_.pass, name, state_.technique, state_.setting);
    if (what == levelled_) return {};
    levelled_ = what;
    const bool radiance = !loaded_->effect.displayColours;
    levels_ = {.toneMap = radiance, .encode = radiance};
    if (name.empty() && !gpu::isDepth(texture.desc().format)) return {};
    const auto image = run::readBack(device_, texture);
    if (!image) return image.error();
    levels_ = levelsOf(*image);
    return {};
}

Result<void> Viewer::makePicture(gpu::Texture& picture, const char* name) {
    const PixelSize pixels = paintedPixels();
    if (picture.state && PixelSize{picture.desc().width, picture.desc().height} == pixels) return {};
    auto made = makeTarget(device_, name, pixels);
    if (!made) return made.error();
    picture = std::move(*made);
    return {};
}

Levels Viewer::shownLevels() const {
    Levels levels = brightened(levels_, state_.stops);
    if (state_.channel != 0) levels.channel = state_.channel;
    levels.mip = state_.level;
    return levels;
}

Result<void> Viewer::paint() {
    if (const auto made = makePicture(picture_, "picture in the window"); !made) return made;
    settling_ = kSettlingFrames;
    if (const auto painted = paintBeside(); !painted) return painted;
    if (state_.mesh != MeshShow::None && (request_.scene.mesh || !request_.scene.objects.empty()) && haveMeshes()) return paintMesh();
    if (state_.mesh == MeshShow::None) dropMeshes();
    const auto texture = shownTexture();
    if (!texture) return texture.error();
    return canvas_->show(picture_, **texture, shownLevels(), fitOf(**texture));
}

Result<gpu::Texture*> Viewer::shownTexture() {
    gpu::Texture* texture = session().target(shownTarget(state_, frame_));
    if (!texture || !texture->desc().cube) return texture;
    if (unfoldedFrom_ != gpu::identityOf(*texture)) {
        auto flat = unfolded(device_, *texture);
        if (!flat) return flat.error();
        unfolded_ = std::move(*flat);
        unfoldedFrom_ = gpu::identityOf(*texture);
    }
    return &unfolded_;
}

Result<void> Viewer::show() {
    --settling_;
    const PixelSize pixels = area_.window;
    if (!composed_.state || PixelSize{composed_.desc().width, composed_.desc().height} != pixels) {
        auto composed = makeTarget(device_, "window", pixels);
        if (!composed) return composed.error();
        composed_ = std::move(*composed);
    }
    PanelOutcome outcome;
    if (const auto drawn = canvas_->together([&] { return composeWithText(outcome); }); !drawn) return drawn;
    writePlaces();
    if (!window_) return {};
    if (std::string title = titleText(); title != title_) window_->setTitle(title_ = std::move(title));
    const auto shown = presenter_->show(composed_, pixels.width, pixels.height);
    if (!shown) return shown.error();
    if (!*shown) settling_ = kSettlingFrames;
    return follow(outcome);
}

Result<void> Viewer::composeWithText(PanelOutcome& outcome) {
    if (const auto composed = compose(); !composed) return composed;
    if (state_.source && source_.file.empty()) openSource(source_, request_.effect);
    const auto pictures = panelPictures();
    if (!pictures) return pictures.error();
    const PanelScene scene{.start = start_,
                           .loaded = *loaded_,
                           .request = request_,
                           .seen = area_.seen(state_.workspace, size_),
                           .layout = area_.layout,
                           .size = size_};
    return overlay_->draw(*canvas_, composed_, [&] { outcome = drawPanel(state_, panels_, scene, panelText(), *pictures, source_); });
}

Result<void> Viewer::follow(const PanelOutcome& outcome) {
    if (outcome.asked) dropped_.push_back(*outcome.asked);
    if (outcome.wanted) makeWanted(*outcome.wanted);
    if (!outcome.saved.empty()) {
        if (outcome.saved.extension() == ".json") {
            if (const auto path = saveWorkspace(outcome.saved)) notice("wrote " + path->string());
        } else {
            if (const auto drawn = isDraft() || stale_ ? draw() : Result<void>(); !drawn) return drawn;
            save(outcome.saved);
        }
    }
    if (outcome.command) return obey(*outcome.command);
    if (outcome.opened) return fulfil(showTarget(state_, *outcome.opened));
    if (outcome.bound) return bind(*outcome.bound);
    if (outcome.baked) return bakeAgain(*outcome.baked);
    if (outcome.painted) return fulfil(Request::Levels);
    return outcome.moved ? drawMoving(*outcome.moved) : Result<void>();
}

Result<void> Viewer::bind(const BindingChoice& choice) {
    if (choice.rule.empty())
        wanted_.binds.erase(choice.parameter);
    else
        wanted_.binds[choice.parameter] = choice.rule;
    load("another binding");
    return {};
}

void Viewer::notice(std::string text) {
    notice_ = std::move(text);
    settling_ = kSettlingFrames;
    say_(notice_);
}

RunOptions Viewer::runOptionsOf(const ViewRequest& request) {
    RunOptions options = request.run;
    options.technique = state_.technique;
    options.parameters = state_.parameters;
    options.width = static_cast<int>(drawnPixels().width);
    options.height = static_cast<int>(drawnPixels().height);
    options.keepUnchanged = true;
    if (isDraft()) options.samples = 1;
    if (sharpness_.coarse) options.coarser = {.triangles = fewer_, .everywhere = sharpness_.drafting};
    if (inPieces_) options.pieces = {.goOn = [this] { return mayGoOn(); }, .bands = pieces_.bands(), .others = kUnknownBands};
    return options;
}

void Viewer::watchFiles(const Effect* effect, const Error* error) {
    std::vector<fs::path> files = {request_.effect, presetsFile(request_.effect)};
    if (loaded_) files.insert(files.end(), loaded_->effect.includes.begin(), loaded_->effect.includes.end());
    if (effect) files.insert(files.end(), effect->includes.begin(), effect->includes.end());
    if (error) {
        for (const Diagnostic& diagnostic : error->diagnostics)
            if (!diagnostic.at.file.empty()) files.emplace_back(diagnostic.at.file);
        const std::size_t count = files.size();
        for (std::size_t i = 0; i < count; ++i)
            files.push_back(files[i].has_parent_path() ? files[i].parent_path() : fs::path("."));
    }
    watch_.watch(files);
    const Effect& sources = effect ? *effect : loaded_->effect;
    source_.files = {request_.effect};
    source_.files.insert(source_.files.end(), sources.includes.begin(), sources.includes.end());
    if (!error) source_.marks.clear();
    refreshSource(source_);
}

Result<void> Viewer::report(const Effect* effect, const Error& error) {
    if (error.diagnostics.front().code == kDeviceLost) return error;
    problem_ = format(error);
    say_(problem_);
    watchFiles(effect, &error);
    markSource(source_, error);
    settling_ = kSettlingFrames;
    return {};
}

} // namespace tegument::view

namespace tegument {

Result<Viewed> viewEffect(const ViewRequest& request, const std::function<void(const std::string&)>& say) {
    auto viewer = view::Viewer::start(request, say);
    if (!viewer) return viewer.error();
    if (const auto ran = (*viewer)->run(); !ran) return ran.error();
    Viewed viewed{.validation = (*viewer)->validationMessages(), .unfinished = nullptr};
    if ((*viewer)->isBusy()) viewed.unfinished = std::shared_ptr<view::Viewer>(std::move(*viewer));
    return viewed;
}

} // namespace tegument
