// What the keys s, w and c write.

#include "tools/view/viewer.h"

#include "host/run/pixels.h"
#include "host/run/semantics.h"
#include "host/support/kept_inputs.h"
#include "tools/view/workspace_write.h"

#include <fmt/format.h>

namespace tegument::view {

namespace fs = std::filesystem;

namespace {

constexpr int kMostPictures = 9999;

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

void Viewer::save(fs::path path) {
    auto image = run::readBack(device_, picture_);
    if (path.empty()) path = freePath(request_.pictures, request_.effect, ".png");
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

std::optional<fs::path> Viewer::saveWorkspace(fs::path path) {
    Workspace workspace = area_.seen(state_.workspace, size_);
    settle(workspace, state_.parameters, request_.run.textures);
    workspace.technique = state_.technique;
    workspace.setting = state_.setting;
    workspace.size = {static_cast<int>(size_.width), static_cast<int>(size_.height)};
    workspace.samples = request_.run.samplesAreAsked ? request_.run.samples : 0;
    workspace.binds = state_.binds;
    const bool chosen = !path.empty();
    const bool known = !chosen && !workspaceFile_.empty() && workspaceJson(workspace, workspaceFile_) == workspaceText_;
    if (known) return workspaceFile_;
    if (!chosen) path = freePath(request_.pictures, request_.effect, ".json");
    std::string text = workspaceJson(workspace, path);
    if (const auto written = chosen ? writeFile(path, text) : rewriteFile(path, text); !written) {
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
    for (const auto& [name, rule] : state_.binds)
        words.insert(words.end(), {"--bind", fmt::format("{}={}", name, rule)});
    words.insert(words.end(), request_.renderArguments.begin(), request_.renderArguments.end());
    words.insert(words.end(), {"-o", picture.string()});
    std::string line;
    for (const std::string& word : words)
        line += (line.empty() ? "" : " ") + quoted(word);
    if (window_) window_->copy(line);
    notice("copied: " + line);
}

} // namespace tegument::view
