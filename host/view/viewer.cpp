#include "host/view/viewer.h"

#include "host/adopt/adopt.h"
#include "host/run/read_back.h"
#include "host/run/scene_bounds.h"
#include "host/scene/workspace_write.h"
#include "host/support/file.h"
#include "host/view/levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace tegument::view {

namespace fs = std::filesystem;

namespace {

constexpr double kPatience = 0.2;                       // seconds between two looks at the files
constexpr auto kSaving = std::chrono::milliseconds(40); // an editor may be in the middle of a file
constexpr int kMostWaits = 25;
constexpr double kShort = 0.005; // while the text settles, or the window changes
constexpr int kSettlingFrames = 3;
constexpr int kDeviceLost = 6007;
constexpr int kMostPictures = 9999;

Result<Adoption> readEffect(const ViewRequest& request, const std::string& setting) {
    LoadOptions load = request.load;
    load.setting = setting;
    auto effect = loadEffect(request.effect, load);
    if (!effect) return effect.error();
    return adopted(std::move(*effect), {.bind = request.binds, .technique = {}, .width = request.run.width, .height = request.run.height});
}

Result<gpu::Texture> makeTarget(gpu::Device& device, const char* name, PixelSize size) {
    return device.createTexture(
        {.name = name, .format = gpu::Format::RGBA8, .width = size.width, .height = size.height, .renderTarget = true});
}

fs::path freePath(const fs::path& folder, const fs::path& effect, const char* ending) {
    fs::path path;
    std::error_code failed;
    for (int number = 1; number <= kMostPictures; ++number) {
        path = folder / fmt::format("{}-{:03}{}", effect.stem().string(), number, ending);
        if (!fs::exists(path, failed)) break;
    }
    return path;
}

/// As a shell takes it.
std::string quoted(const std::string& word) {
    constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-./,:=+%@";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
    std::string text = "'";
    for (const char c : word)
        text += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return text + "'";
}

} // namespace

Viewer::Viewer(const ViewRequest& request, const std::function<void(const std::string&)>& say, Window window, gpu::Device device)
    : request_(request), say_(say), window_(std::move(window)), device_(std::move(device)) {}

Result<std::unique_ptr<Viewer>> Viewer::start(const ViewRequest& request, const std::function<void(const std::string&)>& say) {
    const PixelSize size{static_cast<std::uint32_t>(request.run.width), static_cast<std::uint32_t>(request.run.height)};
    auto window = Window::open("tegument", size);
    if (!window) return window.error();
    const gpu::WindowSurface surface = window->surface();
    auto device = gpu::Device::create({.validation = request.validate, .prefer = request.device, .window = &surface});
    if (!device) return device.error();
    std::unique_ptr<Viewer> viewer(new Viewer(request, say, std::move(*window), std::move(*device)));
    if (const auto prepared = viewer->prepare(); !prepared) return prepared.error();
    return viewer;
}

Result<void> Viewer::prepare() {
    auto presenter = gpu::Presenter::create(device_);
    if (!presenter) return presenter.error();
    presenter_ = std::move(*presenter);
    auto canvas = Canvas::create(device_, request_.run.compiler);
    if (!canvas) return canvas.error();
    canvas_ = std::move(*canvas);
    auto overlay = Overlay::create(device_, window_);
    if (!overlay) return overlay.error();
    overlay_ = std::move(*overlay);
    begin();
    size_ = {static_cast<std::uint32_t>(request_.run.width), static_cast<std::uint32_t>(request_.run.height)};
    auto effect = readEffect(request_, state_.setting);
    if (!effect) return effect.error();
    auto loaded = std::make_unique<Loaded>(device_, std::move(*effect), request_);
    auto frame = drawWith(*loaded);
    if (!frame) return frame.error();
    loaded_ = std::move(loaded);
    adopt(state_, loaded_->effect);
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

Result<void> Viewer::run() {
    while (running_)
        if (const auto stepped = step(); !stepped) return stepped;
    return {};
}

Result<void> Viewer::step() {
    const PixelSize pixels = window_.pixels();
    const bool seen = pixels.width > 0 && pixels.height > 0;
    const Input input = window_.wait(seen && settling_ > 0 ? kShort : kPatience, overlay_->wantsMouse());
    if (input.any) settling_ = kSettlingFrames;
    cursor_ = input.cursor;
    if (input.closed) running_ = false;
    if (const auto obeyed = obey(input); !obeyed) return obeyed;
    for (const fs::path& file : input.dropped)
        if (const auto opened = open(file); !opened) return opened;
    if (watch_.changed()) {
        waitForEditor();
        if (const auto loaded = load(); !loaded) return loaded;
    }
    if (const auto resized = resize(); !resized) return resized;
    return seen && settling_ > 0 ? show() : Result<void>();
}

void Viewer::waitForEditor() {
    for (int waited = 0; waited < kMostWaits; ++waited) {
        std::this_thread::sleep_for(kSaving);
        if (!watch_.changed()) return;
    }
}

Result<void> Viewer::obey(const Input& input) {
    if (apply(state_, input))
        if (const auto drawn = draw(); !drawn) return drawn;
    if (overlay_->wantsKeys()) return {};
    for (const char32_t key : input.keys)
        if (const auto command = commandOf(key))
            if (const auto done = fulfil(apply(state_, *command, start_)); !done) return done;
    return {};
}

Result<void> Viewer::fulfil(Request request) {
    notice_.clear();
    switch (request) {
    case Request::None: return {};
    case Request::Draw: return draw();
    case Request::Levels: return paint();
    case Request::Load: return load();
    case Request::Save: save(); return {};
    case Request::SaveWorkspace:
        if (const auto path = saveWorkspace()) notice("wrote " + path->string());
        return {};
    case Request::CopyCommand: copyCommand(); return {};
    case Request::Quit: running_ = false; return {};
    }
    return {};
}

Result<void> Viewer::resize() {
    const PixelSize pixels = window_.pixels();
    if (pixels.width == 0 || pixels.height == 0 || pixels == size_) return {};
    size_ = pixels;
    return draw();
}

Result<void> Viewer::load() {
    auto effect = readEffect(request_, state_.setting);
    if (!effect) return report(nullptr, effect.error());
    auto loaded = std::make_unique<Loaded>(device_, std::move(*effect), request_);
    const ViewState before = state_;
    adopt(state_, loaded->effect);
    auto frame = drawWith(*loaded);
    if (!frame) {
        state_.techniques = before.techniques;
        state_.technique = before.technique;
        return report(&loaded->effect, frame.error());
    }
    loaded_ = std::move(loaded);
    levelled_.clear();
    targets_.forgetAll();
    readPresets();
    start_.presets = state_.presets;
    watchFiles(&loaded_->effect, nullptr);
    return develop(std::move(*frame));
}

Result<void> Viewer::open(const fs::path& file) {
    notice_.clear();
    if (!request_.open) return {};
    auto next = request_.open(file, loaded_->effect);
    if (!next) return report(nullptr, next.error());
    const ViewRequest before = std::exchange(request_, std::move(*next));
    const ViewState state = state_;
    request_.pictures = before.pictures;
    state_.show = Show::Picture;
    if (!request_.keepView) begin();
    auto effect = readEffect(request_, state_.setting);
    std::unique_ptr<Loaded> loaded;
    Result<SessionFrame> frame = effect ? Result<SessionFrame>(SessionFrame{}) : Result<SessionFrame>(effect.error());
    if (effect) {
        loaded = std::make_unique<Loaded>(device_, std::move(*effect), request_);
        adopt(state_, loaded->effect);
        std::erase_if(state_.parameters, [&](const auto& value) { return !loaded->effect.findParameter(value.first); });
        frame = drawWith(*loaded);
    }
    if (!frame) {
        request_ = before;
        state_ = state;
        return report(nullptr, frame.error());
    }
    loaded_ = std::move(loaded);
    levelled_.clear();
    targets_.forgetAll();
    readPresets();
    start_ = state_;
    notice("shown: " + file.string());
    watchFiles(&loaded_->effect, nullptr);
    return develop(std::move(*frame));
}

Result<void> Viewer::draw() {
    auto frame = drawWith(*loaded_);
    if (!frame) return report(&loaded_->effect, frame.error());
    return develop(std::move(*frame));
}

Result<SessionFrame> Viewer::drawWith(Loaded& loaded) {
    const auto begin = std::chrono::steady_clock::now();
    auto frame = loaded.session.draw(state_.workspace, runOptions(), passCount(state_));
    milliseconds_ = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
    settling_ = kSettlingFrames;
    return frame;
}

Result<void> Viewer::develop(SessionFrame frame) {
    if (!problem_.empty()) say_("the picture is up to date again");
    problem_.clear();
    if (frame.technique != frame_.technique) targets_.forgetAll();
    frame_ = std::move(frame);
    targets_.forget();
    adopt(state_, frame_);
    for (const Diagnostic& warning : frame_.warnings)
        if (std::string text = format(warning); warned_.insert(text).second) say_(text);
    const std::string name = shownTarget(state_, frame_);
    gpu::Texture* texture = loaded_->session.target(name);
    assert(texture); // the frame has drawn into it
    if (const auto found = findLevels(*texture, name); !found) return found;
    return paint();
}

Result<void> Viewer::findLevels(gpu::Texture& texture, const std::string& name) {
    const std::string what =
        fmt::format("{} {} {} {} {}", static_cast<int>(state_.show), state_.pass, name, state_.technique, state_.setting);
    if (what == levelled_) return {};
    levelled_ = what;
    const bool radiance = !loaded_->effect.adopted; // colours of other hosts' effects are a display's
    levels_ = {.toneMap = radiance, .encode = radiance};
    if (name.empty() && !gpu::isDepth(texture.desc().format)) return {};
    const auto image = run::readBack(device_, texture);
    if (!image) return image.error();
    levels_ = levelsOf(*image);
    return {};
}

Result<void> Viewer::paint() {
    if (!picture_.state || PixelSize{picture_.desc().width, picture_.desc().height} != size_) {
        auto picture = makeTarget(device_, "picture in the window", size_);
        if (!picture) return picture.error();
        picture_ = std::move(*picture);
    }
    Levels levels = brightened(levels_, state_.stops);
    if (state_.channel != 0) levels.channel = state_.channel;
    settling_ = kSettlingFrames;
    return canvas_->show(picture_, *loaded_->session.target(shownTarget(state_, frame_)), levels);
}

Result<void> Viewer::show() {
    --settling_;
    const PixelSize pixels = window_.pixels();
    if (!composed_.state || PixelSize{composed_.desc().width, composed_.desc().height} != pixels) {
        auto composed = makeTarget(device_, "window", pixels);
        if (!composed) return composed.error();
        composed_ = std::move(*composed);
    }
    if (const auto shown = canvas_->show(composed_, picture_, {}); !shown) return shown;
    const auto pictures = panelPictures();
    if (!pictures) return pictures.error();
    PanelOutcome outcome;
    const auto text = [&] { outcome = drawPanel(state_, start_, loaded_->effect, panelText(), *pictures); };
    if (const auto drawn = overlay_->draw(*canvas_, composed_, text); !drawn) return drawn;
    if (std::string title = titleText(); title != title_) window_.setTitle(title_ = std::move(title));
    const auto shown = presenter_->show(composed_, pixels.width, pixels.height);
    if (!shown) return shown.error();
    if (!*shown) settling_ = kSettlingFrames;
    if (outcome.opened) return fulfil(showTarget(state_, *outcome.opened));
    return outcome.moved ? draw() : Result<void>();
}

void Viewer::save() {
    auto image = run::readBack(device_, picture_);
    const fs::path path = freePath(request_.pictures, request_.effect, ".png");
    Result<void> written;
    if (image) {
        image->metadata = frame_.metadata;
        image->metadata["shown"] = shownText(state_, frame_);
        for (std::size_t alpha = 3; alpha < image->pixels.size(); alpha += 4)
            image->pixels[alpha] = 1;
        written = writePng(path, *image, PngEncoding::Raw);
    }
    const bool done = image && written;
    notice(done ? "wrote " + path.string() : format(image ? written.error() : image.error()));
}

void Viewer::notice(std::string text) {
    notice_ = std::move(text);
    settling_ = kSettlingFrames;
    say_(notice_);
}

std::optional<fs::path> Viewer::saveWorkspace() {
    Workspace workspace = state_.workspace;
    settle(workspace, state_.parameters, request_.run.textures);
    const bool known = !workspaceFile_.empty() && workspaceJson(workspace, workspaceFile_) == workspaceText_;
    if (known) return workspaceFile_;
    const fs::path path = freePath(request_.pictures, request_.effect, ".json");
    std::string text = workspaceJson(workspace, path);
    if (const auto written = writeFile(path, text); !written) {
        notice(format(written.error()));
        return std::nullopt;
    }
    workspaceFile_ = path;
    workspaceText_ = std::move(text);
    return path;
}

void Viewer::copyCommand() {
    const auto workspace = saveWorkspace();
    if (!workspace) return;
    fs::path picture = *workspace;
    picture.replace_extension(".png");
    std::vector<std::string> words = {"tegument", "render", request_.effect.string(), "-t", state_.technique};
    if (!state_.setting.empty()) words.insert(words.end(), {"--setting", state_.setting});
    words.insert(words.end(), {"-w", workspace->string(), "--size", fmt::format("{}x{}", size_.width, size_.height)});
    words.insert(words.end(), request_.renderArguments.begin(), request_.renderArguments.end());
    words.insert(words.end(), {"-o", picture.string()});
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + quoted(word);
    window_.copy(line);
    notice("copied: " + line);
}

RunOptions Viewer::runOptions() const {
    RunOptions options = request_.run;
    options.technique = state_.technique;
    options.parameters = state_.parameters;
    options.width = static_cast<int>(size_.width);
    options.height = static_cast<int>(size_.height);
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
}

Result<void> Viewer::report(const Effect* effect, const Error& error) {
    if (error.diagnostics.front().code == kDeviceLost) return error;
    problem_ = format(error);
    say_(problem_);
    watchFiles(effect, &error);
    settling_ = kSettlingFrames;
    return {};
}

} // namespace tegument::view

namespace tegument {

Result<std::vector<std::string>> viewEffect(const ViewRequest& request, const std::function<void(const std::string&)>& say) {
    const auto viewer = view::Viewer::start(request, say);
    if (!viewer) return viewer.error();
    if (const auto ran = (*viewer)->run(); !ran) return ran.error();
    return (*viewer)->validationMessages();
}

} // namespace tegument
