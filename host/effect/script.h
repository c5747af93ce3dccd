#pragma once
// DXSAS 0.8 scripts, parsed. docs/scripts.md is the specification.

#include "host/support/result.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// Names of the application's own targets; no effect can declare them.
inline constexpr const char* kPicture = "<picture>";
inline constexpr const char* kPictureDepth = "<picture depth>";

enum class CommandKind {
    Technique,                // options: names, chosen by `selector`
    Pass,                     // options: pass names
    RenderColorTarget,        // index 0..7; options: texture name, kPicture or "" (the caller's target; index > 0: unbind)
    RenderDepthStencilTarget, // options[0] texture name, kPictureDepth or ""
    ClearSetColor,            // options[0] parameter name
    ClearSetDepth,
    ClearSetStencil,
    Clear,          // options[0] Color | Depth | Stencil; Color1: index 1; Color: index -1, every bound colour target, as Direct3D 9 does
    Draw,           // options[0] Geometry | Buffer | Scene | Compute
    ScriptExternal, // options[0] Color
    LoopByCount,    // options[0] parameter name
    LoopEnd,
    LoopGetIndex, // options[0] parameter name
    LoopGetCount,
    Reserved // in the 2004 grammar, no public host implements it: warned about, skipped
};

struct Command {
    CommandKind kind = CommandKind::Reserved;
    int index = 0;
    std::string selector;             // `selector ? a : b`; empty when there is one option
    std::vector<std::string> options; // canonical case for Clear and Draw, as written for names
    int loopMatch = -1;               // index of the matching LoopEnd or LoopByCount in the same script
    SourcePosition at;
};

enum class ScriptLevel { Global, Technique, Pass };

struct Script {
    bool given = false; // false: the default for its level applies, `commands` is empty
    std::vector<Command> commands;
};

struct ScriptResult {
    Script script;
    std::vector<Diagnostic> warnings;
};

/// Where the characters of a text from `offset` on were written: adjacent string literals concatenate.
struct TextPiece {
    std::size_t offset = 0;
    SourcePosition at;
};

/// Parses one script. Unknown commands, commands on the wrong level, unbalanced loops are errors with the position of the string in the
/// file. Names (techniques, passes, textures, parameters) are resolved later, by the effect's own check.
/// `lenient`: what is wrong is a warning, and the command is left out.
[[nodiscard]] Result<ScriptResult> parseScript(std::string_view text, ScriptLevel level, std::span<const TextPiece> pieces,
                                               bool lenient = false);

} // namespace tegument
