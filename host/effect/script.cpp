#include "host/effect/script.h"

#include "host/support/text.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

namespace tegument {

namespace {

constexpr unsigned kGlobal = 1;
constexpr unsigned kTechnique = 2;
constexpr unsigned kPass = 4;

/// How a command's value is read.
enum class ValueForm { None, Name, NameOrEmpty, OneName, ClearWhat, DrawWhat, Color, Anything };

struct CommandEntry {
    std::string_view name;
    CommandKind kind;
    unsigned levels;
    ValueForm form;
};

constexpr std::array<CommandEntry, 19> kCommands{{
    {"Technique", CommandKind::Technique, kGlobal, ValueForm::Name},
    {"Pass", CommandKind::Pass, kTechnique, ValueForm::Name},
    {"RenderColorTarget", CommandKind::RenderColorTarget, kTechnique | kPass, ValueForm::NameOrEmpty},
    {"RenderDepthStencilTarget", CommandKind::RenderDepthStencilTarget, kTechnique | kPass, ValueForm::NameOrEmpty},
    {"ClearSetColor", CommandKind::ClearSetColor, kTechnique | kPass, ValueForm::Name},
    {"ClearSetDepth", CommandKind::ClearSetDepth, kTechnique | kPass, ValueForm::Name},
    {"ClearSetStencil", CommandKind::ClearSetStencil, kTechnique | kPass, ValueForm::Name},
    {"Clear", CommandKind::Clear, kTechnique | kPass, ValueForm::ClearWhat},
    {"Draw", CommandKind::Draw, kPass, ValueForm::DrawWhat},
    {"ScriptExternal", CommandKind::ScriptExternal, kTechnique, ValueForm::Color},
    {"LoopByCount", CommandKind::LoopByCount, kTechnique, ValueForm::OneName},
    {"LoopEnd", CommandKind::LoopEnd, kTechnique, ValueForm::None},
    {"LoopGetIndex", CommandKind::LoopGetIndex, kTechnique, ValueForm::OneName},
    {"LoopGetCount", CommandKind::LoopGetCount, kTechnique, ValueForm::OneName},
    {"LoopByType", CommandKind::Reserved, kGlobal | kTechnique | kPass, ValueForm::Anything},
    {"LoopUpdate", CommandKind::Reserved, kGlobal | kTechnique | kPass, ValueForm::Anything},
    {"GeometryList", CommandKind::Reserved, kGlobal | kTechnique | kPass, ValueForm::Anything},
    {"Hint", CommandKind::Reserved, kGlobal | kTechnique | kPass, ValueForm::Anything},
    {"ScriptSignature", CommandKind::Reserved, kGlobal | kTechnique | kPass, ValueForm::Anything},
}};

unsigned bit(ScriptLevel level) {
    return level == ScriptLevel::Global ? kGlobal : level == ScriptLevel::Technique ? kTechnique : kPass;
}

std::string_view levelName(ScriptLevel level) {
    return level == ScriptLevel::Global      ? "the global script"
           : level == ScriptLevel::Technique ? "a technique's script"
                                             : "a pass's script";
}

std::string withoutSpaces(std::string_view text) {
    std::string result;
    for (const char c : text)
        if (std::isspace(static_cast<unsigned char>(c)) == 0) result += c;
    return result;
}

bool isName(std::string_view text) {
    const auto letter = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    return !text.empty() && std::ranges::all_of(text, letter);
}

std::vector<std::string> split(std::string_view text, char separator) {
    std::vector<std::string> parts;
    for (std::size_t start = 0;;) {
        const std::size_t end = text.find(separator, start);
        parts.emplace_back(text.substr(start, end - start));
        if (end == std::string_view::npos) return parts;
        start = end + 1;
    }
}

class ScriptParser {
public:
    ScriptParser(std::string_view text, ScriptLevel level, std::span<const TextPiece> pieces, bool lenient)
        : text_(text), level_(level), pieces_(pieces), lenient_(lenient) {}

    Result<ScriptResult> run() {
        result_.script.given = true;
        for (std::size_t start = 0; start < text_.size();) {
            const std::size_t end = std::min(text_.find(';', start), text_.size());
            command(start, end);
            start = end + 1;
        }
        for (const std::size_t open : loops_) {
            fail(2007, result_.script.commands[open].at, "this loop has no LoopEnd");
            dropLoops();
        }
        if (!errors_.empty()) return Error{Blame::Input, std::move(errors_)};
        return std::move(result_);
    }

private:
    [[nodiscard]] SourcePosition position(std::size_t offset) const {
        const auto next = std::ranges::upper_bound(pieces_.begin() + 1, pieces_.end(), offset, {}, &TextPiece::offset);
        const auto piece = next - 1;
        SourcePosition at = piece->at;
        at.column += static_cast<int>(offset - piece->offset);
        return at;
    }

    void fail(int code, const SourcePosition& at, std::string text, std::string hint = {}) {
        if (lenient_)
            result_.warnings.push_back(inputWarning(code, at, std::move(text), std::move(hint)));
        else if (errors_.size() < 20)
            errors_.push_back({.code = code, .at = at, .text = std::move(text), .hint = std::move(hint)});
    }

    void command(std::size_t start, std::size_t end) {
        while (start < end && std::isspace(static_cast<unsigned char>(text_[start])) != 0)
            ++start;
        const std::string statement = withoutSpaces(text_.substr(start, end - start));
        if (statement.empty()) return;
        const SourcePosition at = position(start);
        const std::size_t equals = statement.find('=');
        const std::string left = statement.substr(0, equals);
        const std::size_t digits = left.find_last_not_of("0123456789") + 1;
        const std::string name = left.substr(0, digits);
        const CommandEntry* entry = find(name, at);
        if (entry == nullptr) return;
        Command command{.kind = entry->kind, .at = at};
        if (!index(command, left.substr(digits), name)) return;
        if (equals == std::string::npos && entry->form != ValueForm::None && entry->form != ValueForm::Anything)
            return fail(2006, at, fmt::format("{} needs a value", entry->name), fmt::format("write {}=...;", entry->name));
        if (value(command, *entry, equals == std::string::npos ? "" : statement.substr(equals + 1))) add(std::move(command), *entry);
    }

    const CommandEntry* find(const std::string& name, const SourcePosition& at) {
        std::vector<std::string> names;
        for (const CommandEntry& entry : kCommands) {
            names.emplace_back(entry.name);
            if (!equalsIgnoreCase(entry.name, name)) continue;
            if ((entry.levels & bit(level_)) != 0) return &entry;
            fail(2005, at, fmt::format("{} does not belong in {}", entry.name, levelName(level_)));
            return nullptr;
        }
        fail(2004, at, fmt::format("unknown script command '{}'", name), didYouMean(name, names));
        return nullptr;
    }

    bool index(Command& command, const std::string& digits, const std::string& name) {
        if (digits.empty()) return true;
        if (command.kind == CommandKind::RenderColorTarget && digits.size() == 1 && digits[0] <= '7') {
            command.index = digits[0] - '0';
            return true;
        }
        if (command.kind == CommandKind::RenderColorTarget)
            fail(2006, command.at, "colour targets are numbered 0 to 7");
        else
            fail(2006, command.at, fmt::format("{} takes no number", name));
        return false;
    }

    bool value(Command& command, const CommandEntry& entry, const std::string& text) {
        switch (entry.form) {
        case ValueForm::Anything: return true;
        case ValueForm::None: return text.empty() || bad(command, entry, text);
        case ValueForm::OneName: command.options = {text}; return isName(text) || bad(command, entry, text);
        case ValueForm::Name: return options(command, entry, text, false);
        case ValueForm::NameOrEmpty: return options(command, entry, text, true);
        case ValueForm::ClearWhat:
            return clear(command, text) || bad(command, entry, text, "write Color, Color0 to Color7, Depth or Stencil");
        case ValueForm::DrawWhat:
            return keyword(command, text, {"Geometry", "Buffer", "Scene", "Compute"}) ||
                   bad(command, entry, text, "write Geometry, Buffer, Scene or Compute");
        case ValueForm::Color:
            return keyword(command, text, {"Color"}) || (lenient_ && external(command)) || bad(command, entry, text, "write Color");
        }
        return false;
    }

    bool bad(const Command& command, const CommandEntry& entry, const std::string& text, std::string hint = {}) {
        fail(2006, command.at, fmt::format("'{}' is not a value of {}", text, entry.name), std::move(hint));
        return false;
    }

    /// FX Composer's `ScriptExternal=Scene` and `ScriptExternal=;`: what lies below the effect, its colours.
    static bool external(Command& command) {
        command.options = {"Color"};
        return true;
    }

    static bool keyword(Command& command, const std::string& text, std::initializer_list<std::string_view> words) {
        for (const std::string_view word : words)
            if (equalsIgnoreCase(text, word)) command.options = {std::string(word)};
        return !command.options.empty();
    }

    static bool clear(Command& command, const std::string& text) {
        command.index = -1;
        if (text.size() == 6 && text[5] >= '0' && text[5] <= '7') {
            command.index = text[5] - '0';
            return keyword(command, text.substr(0, 5), {"Color"});
        }
        return keyword(command, text, {"Color", "Depth", "Stencil"});
    }

    /// `a`, or `selector ? a : b : c`.
    bool options(Command& command, const CommandEntry& entry, const std::string& text, bool mayBeEmpty) {
        const std::size_t question = text.find('?');
        const bool selects = question != std::string::npos;
        if (selects) command.selector = text.substr(0, question);
        command.options = split(selects ? std::string_view(text).substr(question + 1) : text, ':');
        const auto good = [&](const std::string& option) { return isName(option) || (mayBeEmpty && option.empty()); };
        if ((selects && !isName(command.selector)) || !std::ranges::all_of(command.options, good)) return bad(command, entry, text);
        if (selects == (command.options.size() > 1)) return true;
        fail(2008, command.at, selects ? "a choice needs two options or more" : "a list of options needs a selector",
             "write selector?first:second");
        return false;
    }

    void add(Command command, const CommandEntry& entry) {
        std::vector<Command>& commands = result_.script.commands;
        const bool inLoopOnly = command.kind == CommandKind::LoopGetIndex || command.kind == CommandKind::LoopGetCount;
        if (inLoopOnly && loops_.empty()) return fail(2007, command.at, fmt::format("{} outside a loop", entry.name));
        if (command.kind == CommandKind::LoopEnd) {
            if (loops_.empty()) return fail(2007, command.at, "LoopEnd without LoopByCount");
            command.loopMatch = static_cast<int>(loops_.back());
            commands[loops_.back()].loopMatch = static_cast<int>(commands.size());
            loops_.pop_back();
        }
        if (command.kind == CommandKind::LoopByCount) loops_.push_back(commands.size());
        if (command.kind == CommandKind::Reserved)
            result_.warnings.push_back(
                inputWarning(2009, command.at, fmt::format("{} is reserved in DXSAS 0.8 and does nothing", entry.name)));
        commands.push_back(std::move(command));
    }

    void dropLoops() {
        for (Command& command : result_.script.commands)
            for (const CommandKind kind :
                 {CommandKind::LoopByCount, CommandKind::LoopEnd, CommandKind::LoopGetIndex, CommandKind::LoopGetCount})
                if (command.kind == kind) command.kind = CommandKind::Reserved;
    }

    std::string_view text_;
    ScriptLevel level_;
    std::span<const TextPiece> pieces_;
    ScriptResult result_;
    std::vector<std::size_t> loops_;
    std::vector<Diagnostic> errors_;
    bool lenient_;
};

} // namespace

Result<ScriptResult> parseScript(std::string_view text, ScriptLevel level, std::span<const TextPiece> pieces, bool lenient) {
    assert(!pieces.empty());
    return ScriptParser(text, level, pieces, lenient).run();
}

} // namespace tegument
