#include "tools/view/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace tegument::view {

namespace {

constexpr std::array kKeys = {
    KeyBinding{U's', Command::Save, "s", "File", "write what is shown as PNG"},
    KeyBinding{U'w', Command::SaveWorkspace, "w", "File", "write camera, light and parameters as a workspace"},
    KeyBinding{U'c', Command::CopyCommand, "c", "File", "write one, and copy the tegument render line of this picture"},
    KeyBinding{kKeyF5, Command::Reload, "F5", "File", "read the effect again"},
    KeyBinding{U'q', Command::Quit, "q", "File", "quit"},
    KeyBinding{U't', Command::NextTechnique, "t", "Picture", "next technique"},
    KeyBinding{U'T', Command::PreviousTechnique, "T", "Picture", "previous technique"},
    KeyBinding{U'm', Command::NextSetting, "m", "Picture", "next setting of the effect"},
    KeyBinding{U'n', Command::NextPreset, "n", "Picture", "next preset of the effect"},
    KeyBinding{kKeyRight, Command::NextPass, "right", "Picture", "stop after the next pass, show what it drew into"},
    KeyBinding{kKeyLeft, Command::PreviousPass, "left", "Picture", "stop after the previous pass"},
    KeyBinding{kKeyDown, Command::NextTarget, "down", "Picture", "next intermediate target of the whole frame"},
    KeyBinding{kKeyUp, Command::PreviousTarget, "up", "Picture", "previous intermediate target"},
    KeyBinding{kKeyEscape, Command::Picture, "Esc", "Picture", "back to the picture"},
    KeyBinding{U'a', Command::NextChannel, "a", "Picture", "colour, red, green, blue, alpha"},
    KeyBinding{U'l', Command::NextLevel, "l", "Picture", "next mip level of the target"},
    KeyBinding{U'z', Command::Closer, "z", "Picture", "twice as large about the cursor, up to 32 times"},
    KeyBinding{U'Z', Command::Whole, "Z", "Picture", "the whole again"},
    KeyBinding{U'+', Command::Brighter, "+", "Picture", "half a stop brighter"},
    KeyBinding{U'-', Command::Darker, "-", "Picture", "half a stop darker"},
    KeyBinding{U'0', Command::Automatic, "0", "Picture", "exposure as it was found"},
    KeyBinding{U'1', Command::Front, "1", "Camera", "from the front, as in Blender"},
    KeyBinding{U'3', Command::Side, "3", "Camera", "from the right"},
    KeyBinding{U'7', Command::Top, "7", "Camera", "from above"},
    KeyBinding{U'r', Command::Reset, "r", "Camera", "camera, light and parameters as at the start"},
    KeyBinding{U'p', Command::Parameters, "p", "Panels", "controls to the right: scene, technique, skin or fur, lights ..."},
    KeyBinding{U'i', Command::Information, "i", "Panels", "menus, controls and lights on and off: the picture alone"},
    KeyBinding{U'x', Command::Probe, "x", "Panels", "values under the cursor, and how they are spread"},
    KeyBinding{U'v', Command::Strip, "v", "Panels", "targets as small pictures, arrows between them; a click opens one"},
    KeyBinding{U'g', Command::Times, "g", "Panels", "statistics, GPU milliseconds of each pass"},
    KeyBinding{U'u', Command::Mesh, "u", "Panels", "the mesh in false colours: texels, stretch, seams, fur"},
    KeyBinding{U'o', Command::Textures, "o", "Panels", "textures: where each comes from, its size; a click opens it"},
    KeyBinding{U'b', Command::Bindings, "b", "Panels", "a foreign effect's parameters: what each got, others to choose"},
    KeyBinding{U'f', Command::Source, "f", "Panels", "the effect's text beside the picture; Ctrl+S writes it"},
    KeyBinding{U'k', Command::Keep, "k", "Compare", "keep this picture to the left of a border; again: give it up"},
    KeyBinding{U'e', Command::Errors, "e", "Compare", "error against the kept picture in false colours"},
    KeyBinding{U'h', Command::Help, "h", "Help", "these keys, beside the picture"},
};

constexpr std::array kMouse = {
    MouseBinding{"left or middle drag", "turn the camera"},
    MouseBinding{"wheel", "nearer, farther; Ctrl middle or Alt right drag, too"},
    MouseBinding{"Shift drag", "move the camera; Shift or Alt middle drag, too"},
    MouseBinding{"right or Ctrl drag", "turn the light"},
    MouseBinding{"Ctrl wheel", "light nearer, farther"},
    MouseBinding{"Shift right drag", "turn the surroundings; Ctrl Shift drag, too"},
    MouseBinding{"drag of the border", "more of the kept picture, or less"},
    MouseBinding{"files dropped", "a mesh, texture, effect or workspace is shown"},
};

} // namespace

std::span<const KeyBinding> keyBindings() {
    return kKeys;
}

std::span<const MouseBinding> mouseBindings() {
    return kMouse;
}

std::optional<Command> commandOf(char32_t key) {
    const auto found = std::ranges::find(kKeys, key, &KeyBinding::key);
    return found == kKeys.end() ? std::nullopt : std::optional(found->command);
}

std::string bindingsHelp() {
    std::string text;
    for (const KeyBinding& key : kKeys)
        text += fmt::format("  {:<22}{}\n", key.label, key.text);
    for (const MouseBinding& mouse : kMouse)
        text += fmt::format("  {:<22}{}\n", mouse.label, mouse.text);
    return text;
}

} // namespace tegument::view
