#include "tools/view/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <deque>
#include <vector>

namespace tegument::view {

struct Overlay::State {
    gpu::Texture font;
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
    ImGui::StyleColorsDark();
    state->started = window && ImGui_ImplGlfw_InitForOther(window->handle(), true);
    auto font = uploadFont(device);
    if (!font) return font.error();
    state->font = std::move(*font);
    return Overlay(std::move(state));
}

bool Overlay::wantsMouse() const {
    return ImGui::GetIO().WantCaptureMouse;
}

bool Overlay::wantsKeys() const {
    return ImGui::GetIO().WantTextInput;
}

Result<void> Overlay::draw(Canvas& canvas, gpu::Texture& target, const std::function<void()>& content) {
    if (state_->started)
        ImGui_ImplGlfw_NewFrame();
    else
        ImGui::GetIO().DisplaySize = ImVec2(static_cast<float>(target.desc().width), static_cast<float>(target.desc().height));
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
