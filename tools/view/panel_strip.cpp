// Every target as a small picture, and what is drawn from what as arrows between them.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument::view {

namespace {

constexpr float kThumbnail = 5; // em high, where there is room
constexpr float kLeastThumbnail = 1.7F;
constexpr float kLane = 2.8F; // em above them, for the arrows
constexpr float kLeastLane = 1.4F;
constexpr float kHead = 0.36F; // of an arrow
constexpr float kThin = 0.11F;
constexpr float kThick = 0.18F;
const ImVec4 kShownFrame(0.45F, 0.75F, 1.0F, 1.0F);
constexpr ImU32 kOnward = IM_COL32(150, 190, 225, 190);
constexpr ImU32 kBack = IM_COL32(235, 130, 205, 200); // to what was drawn before, or to itself
constexpr ImU32 kOfThis = IM_COL32(255, 190, 60, 255);

/// Of a small picture, on the screen.
struct Place {
    std::size_t index = 0;
    float left = 0;
    float right = 0;
    float top = 0;
};
using Places = std::map<std::string, Place>;

/// Side by side: what comes in on the left half of a picture, what goes out on the right half.
float portOf(const Place& place, std::size_t port, std::size_t ports, bool out) {
    const float half = 0.5F * (place.right - place.left);
    const float share = (static_cast<float>(port) + 0.5F) / static_cast<float>(ports);
    return place.left + (out ? half : 0) + half * share;
}

struct Ports {
    std::size_t in = 0;
    std::size_t out = 0;
};

float distanceBetween(const Place& a, const Place& b) {
    return std::abs(static_cast<float>(a.index) - static_cast<float>(b.index));
}

void drawArrow(const ImVec2& from, const ImVec2& to, float height, ImU32 color, float thickness) {
    constexpr float kRise = 1 / 0.75F; // a Bezier curve comes to three quarters of its handles
    const float head = kHead * ImGui::GetFontSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end(to.x, to.y - head);
    list.AddBezierCubic(from, ImVec2(from.x, from.y - kRise * height), ImVec2(to.x, to.y - kRise * height), end, color, thickness);
    list.AddTriangleFilled(to, ImVec2(to.x - 0.7F * head, to.y - 1.5F * head), ImVec2(to.x + 0.7F * head, to.y - 1.5F * head), color);
}

/// `bold`: of this picture they are drawn on top, in a colour of their own.
void drawArrows(const std::vector<TargetArrow>& arrows, const Places& places, const std::string& bold, float lane) {
    std::map<std::string, Ports> all;
    float farthest = 1;
    const auto known = [&](const TargetArrow& arrow) { return places.contains(arrow.from) && places.contains(arrow.to); };
    for (const TargetArrow& arrow : arrows) {
        if (!known(arrow)) continue;
        ++all[arrow.from].out;
        ++all[arrow.to].in;
        farthest = std::max(farthest, distanceBetween(places.at(arrow.from), places.at(arrow.to)));
    }
    for (const bool boldOnes : {false, true}) {
        std::map<std::string, Ports> used;
        for (const TargetArrow& arrow : arrows) {
            if (!known(arrow)) continue;
            const Place& from = places.at(arrow.from);
            const Place& to = places.at(arrow.to);
            const float x = portOf(from, used[arrow.from].out++, all[arrow.from].out, true);
            const float y = portOf(to, used[arrow.to].in++, all[arrow.to].in, false);
            const bool isBold = arrow.from == bold || arrow.to == bold;
            if (isBold != boldOnes) continue;
            const float height = (lane - kHead * ImGui::GetFontSize()) * (0.4F + 0.55F * distanceBetween(from, to) / farthest);
            const ImU32 color = isBold ? kOfThis : from.index < to.index ? kOnward : kBack;
            drawArrow(ImVec2(x, from.top), ImVec2(y, to.top), height, color, (isBold ? kThick : kThin) * ImGui::GetFontSize());
        }
    }
}

/// Once another one is shown than before.
void scrollTo(const Thumbnail& thumbnail) {
    int* last = ImGui::GetStateStorage()->GetIntRef(ImGui::GetID("shown"), 0);
    const auto now = static_cast<int>(ImGui::GetID(thumbnail.name.c_str()) | 1U);
    if (thumbnail.shown && *last != now) {
        if (*last != 0) ImGui::SetScrollHereX();
        *last = now;
    }
}

/// Picture, name and size.
Place drawThumbnail(const Thumbnail& thumbnail, float height) {
    const gpu::TextureDesc& desc = thumbnail.texture->desc();
    const ImVec2 size(height * static_cast<float>(desc.width) / static_cast<float>(desc.height), height);
    ImGui::BeginGroup();
    const ImVec4 frame = thumbnail.shown ? kShownFrame : ImVec4(0, 0, 0, 0);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::PushID(thumbnail.name.c_str());
    ImGui::Image(thumbnail.texture, size, ImVec2(0, 0), ImVec2(1, 1), ImVec4(1, 1, 1, 1), frame);
    ImGui::PopID();
    ImGui::TextUnformatted(nameOf(thumbnail).c_str());
    ImGui::TextDisabled("%s", thumbnail.label.c_str());
    ImGui::EndGroup();
    return {.index = 0, .left = corner.x, .right = corner.x + size.x, .top = corner.y};
}

float textHeight() {
    return 2 * ImGui::GetTextLineHeightWithSpacing() + 2 * ImGui::GetStyle().WindowPadding.y + ImGui::GetStyle().ScrollbarSize;
}

} // namespace

std::string nameOf(const Thumbnail& thumbnail) {
    return thumbnail.name.empty() ? "picture" : thumbnail.name;
}

std::optional<std::string> drawStrip(const PanelPictures& pictures, const Area& area) {
    std::optional<std::string> opened;
    const FixedPanel panel("targets", area, ImGuiWindowFlags_HorizontalScrollbar);
    if (!panel) return opened;
    const float em = ImGui::GetFontSize();
    const float room = area.height - textHeight();
    const float lane = pictures.arrows.empty() ? 0 : std::clamp(room - kThumbnail * em, kLeastLane * em, kLane * em);
    const float height = std::clamp(room - lane, kLeastThumbnail * em, kThumbnail * em);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + lane);
    Places places;
    std::string bold;
    const Thumbnail* hovered = nullptr;
    for (const Thumbnail& thumbnail : pictures.thumbnails) {
        Place place = drawThumbnail(thumbnail, height);
        place.index = places.size();
        places.emplace(thumbnail.name, place);
        if (thumbnail.shown) bold = thumbnail.name;
        if (ImGui::IsItemHovered()) hovered = &thumbnail;
        if (ImGui::IsItemClicked()) opened = thumbnail.name;
        noteItem("target/" + nameOf(thumbnail));
        scrollTo(thumbnail);
        ImGui::SameLine();
    }
    drawArrows(pictures.arrows, places, hovered ? hovered->name : bold, lane);
    if (hovered) ImGui::SetTooltip("%s\n%s", nameOf(*hovered).c_str(), arrowText(pictures.arrows, hovered->name).c_str());
    return opened;
}

} // namespace tegument::view
