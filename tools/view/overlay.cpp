#include "tools/view/overlay.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <imgui_freetype.h>
#include <imgui_internal.h> // whether a dialog is open

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace tegument::view {

namespace {

/// A button of the mouse that changes, and where the mouse was then: by the next frame it may be elsewhere.
struct ButtonEvent {
    std::size_t button;
    bool down;
    ImVec2 at;
};

/// A key that changes, or what was typed.
struct KeyEvent {
    int key;
    int code;
    int action;
    int modifiers;
    unsigned character = 0; // 0: of a key
};

/// Keys and characters on their way to Dear ImGui. Before 1.87 it looks at keys once a frame: one that is pressed and released within a
/// frame would be lost. So a key changes once a frame, and what follows waits for the next one, characters too: with Ctrl down they would
/// not count.
class KeyQueue {
public:
    explicit KeyQueue(GLFWwindow* window) : window_(window) { current_ = this; }
    KeyQueue(const KeyQueue&) = delete;
    KeyQueue& operator=(const KeyQueue&) = delete;
    ~KeyQueue() { current_ = nullptr; }

    /// Starts Dear ImGui on the window, whose own callbacks see each event at once.
    [[nodiscard]] bool start() {
        keyOfWindow_ = glfwSetKeyCallback(window_, nullptr);
        characterOfWindow_ = glfwSetCharCallback(window_, nullptr);
        buttonOfWindow_ = glfwSetMouseButtonCallback(window_, nullptr);
        const bool started = ImGui_ImplGlfw_InitForOther(window_, true);
        glfwSetKeyCallback(window_, [](GLFWwindow* window, int key, int code, int action, int modifiers) {
            if (current_->keyOfWindow_) current_->keyOfWindow_(window, key, code, action, modifiers);
            current_->events_.push_back({key, code, action, modifiers});
        });
        glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
            if (current_->characterOfWindow_) current_->characterOfWindow_(window, character);
            current_->events_.push_back({.key = 0, .code = 0, .action = 0, .modifiers = 0, .character = character});
        });
        glfwSetMouseButtonCallback(window_, [](GLFWwindow* window, int button, int action, int modifiers) {
            if (current_->buttonOfWindow_) current_->buttonOfWindow_(window, button, action, modifiers);
            if (static_cast<std::size_t>(button) < current_->down_.size())
                current_->buttons_.push_back({static_cast<std::size_t>(button), action != GLFW_RELEASE, current_->mouse_});
        });
        // GLFW's own answer is where the mouse is now, not where it was at the event.
        moveOfWindow_ = glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
            if (current_->moveOfWindow_) current_->moveOfWindow_(window, x, y);
            current_->mouse_ = ImVec2(static_cast<float>(x), static_cast<float>(y));
        });
        return started;
    }

    /// Once a frame, behind Dear ImGui's look at the mouse: a button changes where it was pressed.
    void deliverButton() {
        ImGuiIO& io = ImGui::GetIO();
        if (!buttons_.empty()) {
            const ButtonEvent event = buttons_.front();
            buttons_.pop_front();
            down_[event.button] = event.down;
            io.MousePos = event.at;
        }
        std::ranges::copy(down_, io.MouseDown);
    }

    void deliver() {
        std::set<int> changed;
        for (; !events_.empty(); events_.pop_front()) {
            const KeyEvent& event = events_.front();
            if (event.character != 0) {
                ImGui_ImplGlfw_CharCallback(window_, event.character);
            } else {
                if (!changed.insert(event.key).second) return;
                ImGui_ImplGlfw_KeyCallback(window_, event.key, event.code, event.action, event.modifiers);
            }
        }
    }

    [[nodiscard]] bool empty() const { return events_.empty() && buttons_.empty(); }

private:
    static inline KeyQueue* current_ = nullptr; // GLFW's callbacks have no other way to it
    GLFWwindow* window_;
    GLFWkeyfun keyOfWindow_ = nullptr;
    GLFWcharfun characterOfWindow_ = nullptr;
    GLFWmousebuttonfun buttonOfWindow_ = nullptr;
    GLFWcursorposfun moveOfWindow_ = nullptr;
    std::deque<KeyEvent> events_;
    std::deque<ButtonEvent> buttons_;
    std::array<bool, 3> down_{};
    ImVec2 mouse_{-1, -1};
};

} // namespace

struct Overlay::State {
    gpu::Device* device = nullptr;
    const Window* window = nullptr;
    float scale = 0; // that the font is of
    gpu::Texture font;
    std::optional<KeyQueue> keys; // with a window
    bool started = false;

    ~State() {
        if (started) ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
};

namespace {

/// Dear ImGui's draw list as the canvas takes it: clip space and float colours.
std::vector<CanvasVertex> verticesOf(const ImDrawData& data, const ImDrawList& list) {
    std::vector<CanvasVertex> vertices;
    vertices.reserve(static_cast<std::size_t>(list.VtxBuffer.Size));
    for (const ImDrawVert& from : list.VtxBuffer) {
        const ImVec4 color = ImGui::ColorConvertU32ToFloat4(from.col);
        vertices.push_back({.x = 2 * (from.pos.x - data.DisplayPos.x) / data.DisplaySize.x - 1,
                            .y = 1 - 2 * (from.pos.y - data.DisplayPos.y) / data.DisplaySize.y,
                            .u = from.uv.x,
                            .v = from.uv.y,
                            .color = {color.x, color.y, color.z, color.w}});
    }
    return vertices;
}

struct Indices {
    std::vector<std::uint32_t> list; // of the vertices from the first one on
    std::size_t first = 0;
    std::size_t count = 0; // of vertices
};

/// A command uses a part of its list's vertices.
Indices indicesOf(const ImDrawList& list, const ImDrawCmd& command) {
    const std::span from(list.IdxBuffer.Data + command.IdxOffset, command.ElemCount);
    const auto [least, most] = std::ranges::minmax(from);
    Indices indices{.list = {from.begin(), from.end()}, .first = command.VtxOffset + least, .count = std::size_t{most} - least + 1};
    for (std::uint32_t& index : indices.list)
        index -= least;
    return indices;
}

ClipRectangle clipOf(const ImDrawData& data, const ImDrawCmd& command) {
    const ImVec2 scale = data.FramebufferScale;
    return {(command.ClipRect.x - data.DisplayPos.x) * scale.x, (command.ClipRect.y - data.DisplayPos.y) * scale.y,
            (command.ClipRect.z - data.DisplayPos.x) * scale.x, (command.ClipRect.w - data.DisplayPos.y) * scale.y};
}

constexpr float kEm = 14; // points on a screen of the usual 96 pixels to the inch

/// Where systems have a font; the first is Debian's fonts-dejavu-core.
constexpr std::array kFonts = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu-sans-fonts/DejaVuSans.ttf",
                               "/usr/share/fonts/TTF/DejaVuSans.ttf",
                               "/usr/share/fonts/dejavu/DejaVuSans.ttf",
                               "/System/Library/Fonts/SFNS.ttf",
                               "C:/Windows/Fonts/segoeui.ttf"};

/// Latin, Greek and Cyrillic, dashes, arrows, signs of mathematics.
constexpr std::array<ImWchar, 11> kGlyphs = {0x20, 0x17F, 0x370, 0x52F, 0x2010, 0x2044, 0x2190, 0x2193, 0x2200, 0x22FF, 0};

void addFont(float pixels) {
    ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
    fonts.Clear();
    fonts.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    fonts.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    std::error_code failed;
    const auto found = std::ranges::find_if(kFonts, [&](const char* file) { return std::filesystem::exists(file, failed); });
    if (found != kFonts.end() && fonts.AddFontFromFileTTF(*found, pixels, nullptr, kGlyphs.data())) return;
    fonts.FontBuilderIO = nullptr; // Dear ImGui's own, of 13 pixels
    ImFontConfig plain;
    plain.SizePixels = 13 * std::max(1.0F, std::round(pixels / kEm));
    fonts.AddFontDefault(&plain);
}

/// Sizes as shares of a letter's box; greys, so that the picture's colours are judged beside no other.
void setStyle(float em) {
    ImGuiStyle& style = ImGui::GetStyle() = ImGuiStyle();
    ImGui::StyleColorsDark();
    const auto size = [em](float x, float y) { return ImVec2(std::round(x * em), std::round(y * em)); };
    style.WindowPadding = size(0.6F, 0.5F);
    style.FramePadding = size(0.4F, 0.22F);
    style.ItemSpacing = size(0.5F, 0.3F);
    style.ItemInnerSpacing = size(0.4F, 0.3F);
    style.IndentSpacing = em;
    style.ScrollbarSize = 0.8F * em;
    style.GrabMinSize = 0.7F * em;
    style.FrameRounding = style.GrabRounding = style.PopupRounding = 0.2F * em;
    style.WindowBorderSize = 0;
    const auto grey = [](float value, float alpha = 1) { return ImVec4(value, value, value, alpha); };
    const ImVec4 accent(0.36F, 0.56F, 0.82F, 1);
    ImVec4* colors = style.Colors;
    colors[ImGuiCol_Text] = grey(0.87F);
    colors[ImGuiCol_TextDisabled] = grey(0.56F);
    colors[ImGuiCol_WindowBg] = grey(0.145F);
    colors[ImGuiCol_MenuBarBg] = grey(0.18F);
    colors[ImGuiCol_PopupBg] = grey(0.17F);
    colors[ImGuiCol_FrameBg] = grey(0.235F);
    colors[ImGuiCol_FrameBgHovered] = grey(0.30F);
    colors[ImGuiCol_FrameBgActive] = grey(0.34F);
    colors[ImGuiCol_Header] = grey(0.205F);
    colors[ImGuiCol_HeaderHovered] = grey(0.29F);
    colors[ImGuiCol_HeaderActive] = grey(0.33F);
    colors[ImGuiCol_Button] = grey(0.27F);
    colors[ImGuiCol_ButtonHovered] = grey(0.34F);
    colors[ImGuiCol_ButtonActive] = grey(0.40F);
    colors[ImGuiCol_SliderGrab] = grey(0.42F);
    colors[ImGuiCol_ModalWindowDimBg] = ImVec4(0, 0, 0, 0.45F);
    colors[ImGuiCol_SliderGrabActive] = colors[ImGuiCol_CheckMark] = accent;
    colors[ImGuiCol_TextSelectedBg] = ImVec4(accent.x, accent.y, accent.z, 0.5F);
}

Result<gpu::Texture> uploadFont(gpu::Device& device) {
    unsigned char* pixels = nullptr;
    int width = 0;
    int height = 0;
    ImGui::GetIO().Fonts->GetTexDataAsRGBA32(&pixels, &width, &height);
    auto texture = device.createTexture({.name = "font",
                                         .format = gpu::Format::RGBA8,
                                         .width = static_cast<std::uint32_t>(width),
                                         .height = static_cast<std::uint32_t>(height)});
    if (!texture) return texture;
    const std::size_t bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 4;
    if (const auto uploaded = device.upload(*texture, std::as_bytes(std::span(pixels, bytes))); !uploaded) return uploaded.error();
    return texture;
}

/// Pixels to a point of the window.
float pixelsToPoint(const Window* window) {
    return window && window->pixels().width > 0 ? static_cast<float>(window->pixels().width) / window->points().x : 1;
}

} // namespace

Overlay::Overlay(std::unique_ptr<State> state) : state_(std::move(state)) {}
Overlay::Overlay(Overlay&&) noexcept = default;
Overlay& Overlay::operator=(Overlay&&) noexcept = default;
Overlay::~Overlay() = default;

Result<Overlay> Overlay::create(gpu::Device& device, const Window* window) {
    ImGui::CreateContext();
    auto state = std::make_unique<State>();
    ImGui::GetIO().IniFilename = nullptr; // leaves no file behind
    ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    if (window) state->started = state->keys.emplace(window->handle()).start();
    state->device = &device;
    state->window = window;
    Overlay overlay(std::move(state));
    if (const auto fitted = overlay.fitFont(); !fitted) return fitted.error();
    return overlay;
}

/// A window may have come to another screen.
Result<void> Overlay::fitFont() {
    const float scale = state_->window ? state_->window->scale() : 1;
    if (scale == state_->scale) return {};
    state_->scale = scale;
    addFont(std::round(kEm * scale));
    ImGui::GetIO().FontGlobalScale = 1 / pixelsToPoint(state_->window);
    auto font = uploadFont(*state_->device);
    if (!font) return font.error();
    state_->font = std::move(*font);
    setStyle(em()); // which is known now
    return {};
}

float Overlay::em() const {
    const ImGuiIO& io = ImGui::GetIO();
    return io.Fonts->Fonts.front()->FontSize * io.FontGlobalScale;
}

bool Overlay::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Overlay::wantsKeys() const {
    // Dear ImGui says at its next frame that a field was clicked.
    return ImGui::GetIO().WantTextInput || ImGui::GetCurrentContext()->WantTextInputNextFrame == 1 || ImGui::GetTopMostPopupModal();
}

bool Overlay::hasKeys() const {
    return state_->keys && !state_->keys->empty();
}

Result<void> Overlay::draw(Canvas& canvas, gpu::Texture& target, const std::function<void()>& content) {
    if (state_->keys) state_->keys->deliver();
    if (const auto fitted = fitFont(); !fitted) return fitted;
    if (state_->started)
        ImGui_ImplGlfw_NewFrame();
    else
        ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(target.desc().width), static_cast<float>(target.desc().height));
    if (state_->keys) state_->keys->deliverButton();
    ImGui::NewFrame();
    content();
    ImGui::Render();
    const ImDrawData& data = *ImGui::GetDrawData();
    std::deque<std::vector<CanvasVertex>> vertices;
    std::deque<Indices> indices;
    std::vector<Canvas::Mesh> meshes;
    for (int i = 0; i < data.CmdListsCount; ++i) {
        const ImDrawList& list = *data.CmdLists[i];
        vertices.push_back(verticesOf(data, list));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            if (command.ElemCount == 0) continue;
            const Indices& used = indices.emplace_back(indicesOf(list, command));
            auto* texture = static_cast<gpu::Texture*>(command.GetTexID()); // of a picture; the font has none
            meshes.push_back({.vertices = std::span(vertices.back()).subspan(used.first, used.count),
                              .indices = used.list,
                              .texture = texture ? texture : &state_->font,
                              .clip = clipOf(data, command)});
        }
    }
    return meshes.empty() ? Result<void>() : canvas.blend(target, meshes);
}

} // namespace tegument::view
