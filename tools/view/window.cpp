#include "tools/view/window.h"

#include "tools/view/keys.h"

#include <fmt/format.h>

#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace tegument::view {

struct WindowState {
    GLFWwindow* window = nullptr;
    Input input;
    glm::dvec2 mouse{0};
    bool overlay = false;
    std::optional<double> border;
    std::array<double, 4> picture{0, 0, 1, 1};
    bool beside = false; // the mouse went down beside the picture
    bool holdsBorder = false;

    ~WindowState() {
        if (window) glfwDestroyWindow(window);
        glfwTerminate();
    }
};

namespace {

constexpr std::array kSpecial = {std::pair{GLFW_KEY_LEFT, kKeyLeft}, std::pair{GLFW_KEY_RIGHT, kKeyRight},
                                 std::pair{GLFW_KEY_UP, kKeyUp},     std::pair{GLFW_KEY_DOWN, kKeyDown},
                                 std::pair{GLFW_KEY_F5, kKeyF5},     std::pair{GLFW_KEY_ESCAPE, kKeyEscape}};

std::string lastError() {
    const char* text = nullptr;
    glfwGetError(&text);
    return text ? text : "no reason given";
}

bool held(GLFWwindow* window, int left, int right) {
    return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
}

bool pressed(GLFWwindow* window, int button) {
    return glfwGetMouseButton(window, button) == GLFW_PRESS;
}

/// As in Blender (middle button) and Maya (Alt), and with one button alone.
void drag(GLFWwindow* window, Input& input, const glm::dvec2& by) {
    const bool left = pressed(window, GLFW_MOUSE_BUTTON_LEFT);
    const bool middle = pressed(window, GLFW_MOUSE_BUTTON_MIDDLE);
    const bool right = pressed(window, GLFW_MOUSE_BUTTON_RIGHT);
    const bool control = held(window, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
    const bool shift = held(window, GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT);
    const bool alt = held(window, GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT);
    if ((right && alt) || (middle && control))
        input.dolly += by.x + by.y;
    else if ((right && shift) || (left && shift && control))
        input.surroundings += by.x;
    else if (right || (left && control))
        input.light += by;
    else if ((middle && (shift || alt)) || (left && shift))
        input.pan += by;
    else if (left || middle)
        input.camera += by;
}

WindowState& stateOf(GLFWwindow* window) {
    return *static_cast<WindowState*>(glfwGetWindowUserPointer(window));
}

constexpr double kGrip = 6; // pixels to each side of the border that take the mouse

int widthOf(GLFWwindow* window) {
    int width = 0;
    glfwGetWindowSize(window, &width, nullptr);
    return std::max(1, width);
}

bool isBesidePicture(const WindowState& state, GLFWwindow* window) {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(window, &width, &height);
    const glm::dvec2 at = state.mouse / glm::dvec2(std::max(1, width), std::max(1, height));
    const auto& [left, top, right, bottom] = state.picture;
    return at.x < left || at.y < top || at.x >= right || at.y >= bottom;
}

/// Here and not where the next picture is drawn: on a slow machine the mouse is elsewhere by then.
void takeBorder(GLFWwindow* window, int button, int action) {
    WindowState& state = stateOf(window);
    state.input.any = true;
    if (action == GLFW_PRESS) state.beside = isBesidePicture(state, window);
    if (action == GLFW_PRESS && (state.beside || state.overlay)) state.input.clicked = true;
    if (button != GLFW_MOUSE_BUTTON_LEFT) return;
    state.holdsBorder = action == GLFW_PRESS && !state.overlay && !state.beside && state.border &&
                        std::abs(state.mouse.x - *state.border * widthOf(window)) <= kGrip;
}

void listenToMouse(GLFWwindow* window) {
    glfwSetCursorPosCallback(window, [](GLFWwindow* w, double x, double y) {
        WindowState& state = stateOf(w);
        int width = 0;
        int height = 0;
        glfwGetWindowSize(w, &width, &height);
        const glm::dvec2 moved = (glm::dvec2(x, y) - state.mouse) / static_cast<double>(std::max(1, height));
        state.mouse = {x, y};
        state.input.any = true;
        if (state.holdsBorder) state.border = state.input.border = x / widthOf(w);
        if (!state.overlay && !state.beside && !state.holdsBorder) drag(w, state.input, {moved.x, -moved.y});
    });
    glfwSetMouseButtonCallback(window, [](GLFWwindow* w, int button, int action, int) { takeBorder(w, button, action); });
    glfwSetScrollCallback(window, [](GLFWwindow* w, double, double notches) {
        WindowState& state = stateOf(w);
        state.input.any = true;
        if (state.overlay || isBesidePicture(state, w)) return;
        const bool light = held(w, GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL);
        (light ? state.input.lightWheel : state.input.wheel) += notches;
    });
}

void listen(GLFWwindow* window) {
    glfwSetCharCallback(window, [](GLFWwindow* w, unsigned character) {
        WindowState& state = stateOf(w);
        state.input.any = true;
        state.input.keys.push_back(character);
    });
    glfwSetKeyCallback(window, [](GLFWwindow* w, int key, int, int action, int held) {
        WindowState& state = stateOf(w);
        state.input.any = true;
        const auto special = std::ranges::find(kSpecial, key, [](const auto& pair) { return pair.first; });
        if (action == GLFW_PRESS && key == GLFW_KEY_S && (held & GLFW_MOD_CONTROL) != 0) state.input.keys.push_back(kKeyWrite);
        if (action != GLFW_RELEASE && special != kSpecial.end()) state.input.keys.push_back(special->second);
    });
    listenToMouse(window);
    glfwSetDropCallback(window, [](GLFWwindow* w, int count, const char** paths) {
        WindowState& state = stateOf(w);
        state.input.any = true;
        state.input.dropped.insert(state.input.dropped.end(), paths, paths + count);
    });
    const auto redraw = [](GLFWwindow* w) { stateOf(w).input.any = true; };
    glfwSetWindowRefreshCallback(window, redraw);
    glfwSetFramebufferSizeCallback(window, [](GLFWwindow* w, int, int) { stateOf(w).input.any = true; });
}

} // namespace

Window::Window(std::unique_ptr<WindowState> state) : state_(std::move(state)) {}
Window::Window(Window&&) noexcept = default;
Window& Window::operator=(Window&&) noexcept = default;
Window::~Window() = default;

Result<Window> Window::open(const std::string& title, PixelSize size) {
    if (glfwInit() == GLFW_FALSE)
        return machineError(6060, "there is no window system to open a window on: " + lastError(),
                            "start it on a desktop, or use tegument render");
    auto state = std::make_unique<WindowState>();
    if (glfwVulkanSupported() == GLFW_FALSE)
        return machineError(6061, "no window can be opened for Vulkan: " + lastError(), "install a Vulkan driver that draws to windows");
    glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
    state->window = glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr, nullptr);
    if (!state->window) return machineError(6061, "no window can be opened: " + lastError());
    glfwSetWindowUserPointer(state->window, state.get());
    glfwGetCursorPos(state->window, &state->mouse.x, &state->mouse.y);
    listen(state->window);
    return Window(std::move(state));
}

gpu::WindowSurface Window::surface() const {
    std::uint32_t count = 0;
    const char** names = glfwGetRequiredInstanceExtensions(&count);
    gpu::WindowSurface surface;
    surface.instanceExtensions.assign(names, names + (names ? count : 0));
    surface.create = [window = state_->window](void* instance) -> Result<std::uint64_t> {
        VkSurfaceKHR handle = VK_NULL_HANDLE;
        if (glfwCreateWindowSurface(static_cast<VkInstance>(instance), window, nullptr, &handle) != VK_SUCCESS)
            return machineError(6061, "Vulkan cannot draw to this window: " + lastError());
        return (std::uint64_t)handle; // a pointer or a 64-bit number, as the platform has it
    };
    return surface;
}

Input Window::wait(double seconds, bool overlay, std::optional<double> border, const std::array<double, 4>& picture) {
    state_->picture = picture;
    state_->overlay = overlay;
    state_->border = border;
    if (seconds > 0 && !state_->input.any) // hears() may have taken what would wake it
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    state_->input.cursor = state_->mouse / glm::dvec2(points());
    state_->input.closed = glfwWindowShouldClose(state_->window) == GLFW_TRUE;
    return std::exchange(state_->input, Input{});
}

bool Window::hears() {
    glfwPollEvents();
    return asks(state_->input) || glfwWindowShouldClose(state_->window) == GLFW_TRUE;
}

PixelSize Window::pixels() const {
    if (glfwGetWindowAttrib(state_->window, GLFW_ICONIFIED) == GLFW_TRUE) return {};
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(state_->window, &width, &height);
    return {static_cast<std::uint32_t>(std::max(0, width)), static_cast<std::uint32_t>(std::max(0, height))};
}

glm::vec2 Window::points() const {
    int width = 0;
    int height = 0;
    glfwGetWindowSize(state_->window, &width, &height);
    return {std::max(1, width), std::max(1, height)};
}

float Window::scale() const {
    float across = 1;
    float down = 1;
    glfwGetWindowContentScale(state_->window, &across, &down);
    return std::clamp(across, 0.5F, 8.0F);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(state_->window, title.c_str());
}

void Window::copy(const std::string& text) {
    glfwSetClipboardString(state_->window, text.c_str());
}

GLFWwindow* Window::handle() const {
    return state_->window;
}

} // namespace tegument::view
