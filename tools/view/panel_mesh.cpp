// What the false colours of a mesh mean, and where textures come from.

#include "tools/view/panel.h"
#include "tools/view/panel_parts.h"

#include <fmt/format.h>

#include <algorithm>

namespace tegument::view {

namespace {

const ImVec4 kSourceText(0.75F, 0.75F, 0.75F, 1.0F);
constexpr const char* kBakeAgain = "F5 reads files, and draws what effects bake, again";
constexpr const char* kOnceMore = "bake again";
constexpr std::size_t kMostBytes = 64;
constexpr double kSecond = 1000; // milliseconds

std::string timeText(double milliseconds) {
    return milliseconds < kSecond ? fmt::format("{:.1f} ms", milliseconds) : fmt::format("{:.1f} s", milliseconds / kSecond);
}

std::string sizeText(const SessionTexture& texture) {
    return fmt::format("{} x {} {}{}", texture.width, texture.height, texture.format, texture.cube ? " cube" : "");
}

/// Whether a letter of UTF-8 goes on here.
bool insideLetter(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

/// Its beginning and its end: names of files in the cache are long.
std::string shortened(const std::string& text) {
    if (text.size() <= kMostBytes) return text;
    std::size_t head = kMostBytes / 3;
    std::size_t tail = text.size() - (kMostBytes - head - 3);
    while (head > 0 && insideLetter(text[head]))
        --head;
    while (tail < text.size() && insideLetter(text[tail]))
        ++tail;
    return text.substr(0, head) + "..." + text.substr(tail);
}

} // namespace

void drawLegend(const PanelPictures& pictures) {
    ImGui::PushTextWrapPos(0);
    for (const std::string& line : pictures.figures)
        ImGui::TextUnformatted(line.c_str());
    ImGui::PopTextWrapPos();
    const float line = ImGui::GetTextLineHeight();
    for (const LegendEntry& entry : pictures.legend) {
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const ImU32 color = ImGui::ColorConvertFloat4ToU32(ImVec4(entry.color[0], entry.color[1], entry.color[2], 1));
        ImGui::GetWindowDrawList()->AddRectFilled(ImVec2(corner.x, corner.y + 1), ImVec2(corner.x + 1.6F * line, corner.y + line - 1),
                                                  color);
        ImGui::Dummy(ImVec2(1.6F * line, line));
        ImGui::SameLine();
        ImGui::TextUnformatted(entry.label.c_str());
    }
}

std::string bakeText(const SessionTexture& texture) {
    if (!texture.bake) return {};
    const Bake& bake = *texture.bake;
    if (!bake.fromCache) return "baked in " + timeText(bake.milliseconds);
    if (bake.once <= 0) return "from the cache, found in " + timeText(bake.milliseconds);
    return fmt::format("once baked in {}; from the cache now, found in {}", timeText(bake.once), timeText(bake.milliseconds));
}

void drawTextures(const std::vector<SessionTexture>& textures, const std::string& shown, PanelOutcome& outcome) {
    for (const SessionTexture& texture : textures) {
        const std::string label = fmt::format("{}  {}##{}", texture.name, sizeText(texture), texture.name);
        if (ImGui::Selectable(label.c_str(), texture.name == shown)) outcome.opened = texture.name;
        noteItem("texture/" + texture.name);
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(kSourceText, "%s", shortened(texture.source).c_str());
        ImGui::PopTextWrapPos();
        if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", texture.source.c_str());
        if (!texture.bake) continue;
        if (ImGui::SmallButton(fmt::format("{}##{}", kOnceMore, texture.name).c_str())) outcome.baked = texture.name;
        noteItem("bake/" + texture.name);
        ImGui::SameLine();
        ImGui::PushTextWrapPos(0);
        ImGui::TextColored(kSourceText, "%s", bakeText(texture).c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(kBakeAgain);
    ImGui::PopTextWrapPos();
}

} // namespace tegument::view
