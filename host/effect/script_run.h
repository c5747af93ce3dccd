#pragma once
// Executes an effect's scripts: global -> technique -> pass -> Draw. docs/scripts.md is the specification. Nothing here knows a GPU: what
// the scripts do to the outside goes through ScriptSink, which host/run implements with Vulkan and the conformance tests with a log.

#include "host/effect/model.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

enum class ClearKind { Color, Depth, Stencil };
enum class DrawKind { Geometry, Buffer, Scene, Compute };

/// Texture names as declared in the effect. "" is the application's own target; nullopt: nothing is bound in this place.
struct BoundTargets {
    std::array<std::optional<std::string>, 8> colors{""};
    std::optional<std::string> depth = "";
    bool operator==(const BoundTargets&) const = default;
};

/// Names of the parameters that hold the clear values, read when a Clear runs. Empty: (0,0,0,0), 1 and 0.
struct ClearParameters {
    std::string color;
    std::string depth;
    std::string stencil;
    bool operator==(const ClearParameters&) const = default;
};

/// What commands have set. A script starts with its caller's state and its caller gets the old state back when it returns.
struct ScriptState {
    BoundTargets targets;
    ClearParameters clear;
    bool operator==(const ScriptState&) const = default;
};

/// The world as scripts see it. An Error returned by any member stops the run and is handed on.
class ScriptSink {
public:
    virtual ~ScriptSink() = default;

    /// The bound targets are now these: after a command that changed one, and when a script's return or ScriptExternal restores the former
    /// ones. ViewportPixelSize follows colors[0].
    virtual Result<void> targetsChanged(const BoundTargets& targets) = 0;

    /// Clears one bound target now; `Clear=Color` without an index comes as one call per bound colour target, ascending.
    virtual Result<void> clear(ClearKind what, int index, const ScriptState& state) = 0;

    /// Around a pass script (also around a pass without script); a pass may draw any number of times in between.
    virtual Result<void> beginPass(const Technique& technique, const Pass& pass) = 0;
    virtual Result<void> draw(const Pass& pass, DrawKind kind, const ScriptState& state) = 0;
    virtual Result<void> endPass(const Pass& pass) = 0;

    /// ScriptExternal=Color: render what lies below this effect into the bound targets. The interpreter restores targets and clear values.
    virtual Result<void> external(const ScriptState& state) = 0;

    /// The present value of a numeric parameter, as Parameter::defaultValue holds it. Called with names of the effect's parameters only.
    [[nodiscard]] virtual std::vector<double> read(const Parameter& parameter) const = 0;
    /// LoopGetIndex, LoopGetCount: sets a scalar parameter. The value stays after the loop.
    virtual void write(const Parameter& parameter, double value) = 0;
};

/// A count above this in one LoopByCount is an error, and so are more commands than this in one run: a script that never ends is a typing
/// mistake.
inline constexpr int kMaxLoopCount = 65536;
inline constexpr long kMaxCommands = 1'000'000;

/// Runs `technique`, or what the global script says when it is empty (without global script: the first technique).
/// TG2301 selector out of range, TG2302 loop count, TG2303 too many commands, TG2304 no such technique.
[[nodiscard]] Result<void> runScripts(const Effect& effect, std::string_view technique, ScriptSink& sink);

} // namespace tegument
