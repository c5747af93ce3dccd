#pragma once
// What the keys do: one table for the window, its menus, the sheet of keys and --help.

#include <optional>
#include <span>
#include <string>

namespace tegument::view {

enum class Command {
    Help,
    Parameters,
    Information,
    NextTechnique,
    PreviousTechnique,
    NextPass,
    PreviousPass,
    NextTarget,
    PreviousTarget,
    Picture,
    NextSetting,
    NextChannel,
    NextLevel,
    Closer,
    Whole,
    Brighter,
    Darker,
    Automatic,
    Front,
    Side,
    Top,
    Reset,
    Reload,
    Save,
    NextPreset,
    SaveWorkspace,
    CopyCommand,
    Probe,
    Strip,
    Times,
    Mesh,
    Textures,
    Bindings,
    Keep,
    Errors,
    Source,
    Quit
};

/// Keys that type no character, in Unicode's private area.
inline constexpr char32_t kKeyLeft = 0xE000;
inline constexpr char32_t kKeyRight = 0xE001;
inline constexpr char32_t kKeyUp = 0xE002;
inline constexpr char32_t kKeyDown = 0xE003;
inline constexpr char32_t kKeyEscape = 0xE004;
inline constexpr char32_t kKeyF5 = 0xE005;
inline constexpr char32_t kKeyWrite = 0xE006; // Ctrl+S, of the text beside the picture

struct KeyBinding {
    char32_t key;
    Command command;
    const char* label; // "right"
    const char* group; // a menu
    const char* text;  // "the picture as it is after the next pass"
};

/// In the order of the table.
inline constexpr const char* kKeyGroups[] = {"File", "Picture", "Camera", "Panels", "Compare", "Help"};

[[nodiscard]] std::span<const KeyBinding> keyBindings();
[[nodiscard]] std::optional<Command> commandOf(char32_t key);

/// What the mouse does, in the same form.
struct MouseBinding {
    const char* label;
    const char* text;
};
[[nodiscard]] std::span<const MouseBinding> mouseBindings();

/// Both tables, a line each.
[[nodiscard]] std::string bindingsHelp();

} // namespace tegument::view
