#include "host/effect/code_view.h"

#include "host/effect/model.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace tegument {

namespace {

/// Up to so many lines are bridged by line breaks rather than a #line.
constexpr int kNearLines = 8;
/// Beyond this, columns are not kept: a file of one endless line shall not grow with every macro in it.
constexpr int kWidestGap = 400;

std::string quoted(const std::string& path) {
    std::string text;
    for (const char c : path) {
        if (c == '"' || c == '\\') text += '\\';
        text += c;
    }
    return text;
}

class Printer {
public:
    Printer(const Preprocessed& view, const Sources& sources) : view_(view), sources_(sources) {}

    std::string run(const std::vector<bool>& blanked) {
        std::size_t pragma = 0;
        for (std::size_t i = 0; i <= view_.tokens.size(); ++i) {
            for (; pragma < view_.pragmas.size() && view_.pragmas[pragma].before <= i; ++pragma)
                print(view_.pragmas[pragma]);
            if (i < view_.tokens.size() && !blanked[i]) print(view_.tokens[i], view_.tokens[i].space || (i > 0 && blanked[i - 1]));
        }
        text_ += '\n';
        return std::move(text_);
    }

private:
    void print(const Pragma& pragma) {
        moveTo(pragma.file, pragma.line);
        if (column_ > 1) text_ += '\n', ++line_;
        text_ += pragma.text + '\n';
        ++line_;
        column_ = 1;
    }

    /// Tokens of a macro's expansion all stand where it was called: only the first of them can be put into its column.
    void print(const Token& token, bool space) {
        moveTo(token.file, token.line);
        const int gap = token.line == line_ ? token.column - column_ : 0;
        if (space || column_ == 1) {
            const int spaces = std::clamp(gap, column_ > 1 ? 1 : 0, kWidestGap);
            text_.append(static_cast<std::size_t>(spaces), ' ');
            column_ += spaces;
        }
        text_ += token.text;
        column_ += static_cast<int>(token.text.size());
    }

    /// Goes to the line, unless a macro's expansion would lead back in the same file.
    void moveTo(int file, int line) {
        if (file == file_ && line <= line_) return;
        if (file == file_ && line - line_ <= kNearLines) {
            text_.append(static_cast<std::size_t>(line - line_), '\n');
        } else {
            text_ += fmt::format("{}#line {} \"{}\"\n", text_.empty() ? "" : "\n", line, quoted(sources_[file].name));
        }
        file_ = file;
        line_ = line;
        column_ = 1;
    }

    const Preprocessed& view_;
    const Sources& sources_;
    std::string text_;
    int file_ = -1;
    int line_ = 1;
    int column_ = 1;
};

} // namespace

std::string codeView(const Preprocessed& view, const Sources& sources, const std::vector<TokenRange>& blanks) {
    std::vector<bool> blanked(view.tokens.size(), false);
    for (const TokenRange& range : blanks)
        for (std::size_t i = range.first; i < range.last; ++i)
            blanked[i] = true;
    return Printer(view, sources).run(blanked);
}

} // namespace tegument
