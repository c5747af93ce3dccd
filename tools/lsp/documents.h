#pragma once
// Texts that are open in the editor, and how the protocol names places in them.

#include "host/effect/load.h"
#include "tools/lsp/rpc.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace tegument::lsp {

/// file:///a%20b to /a b; empty where it names no file.
[[nodiscard]] std::string pathOf(const std::string& uri);
[[nodiscard]] std::string uriOf(const std::string& path);
/// Absolute, without "..".
[[nodiscard]] std::string normal(const std::filesystem::path& path);

/// The protocol counts 16-bit units from 0, everything else here bytes from 1. Beyond the line: its end.
[[nodiscard]] int byteColumn(std::string_view line, int units);
[[nodiscard]] int unitsBefore(std::string_view line, int column);

class Documents {
public:
    void set(const std::string& path, std::string text) { texts_[path] = std::move(text); }
    void close(const std::string& path) { texts_.erase(path); }
    [[nodiscard]] const std::string* find(const std::string& path) const;
    [[nodiscard]] const std::map<std::string, std::string>& all() const { return texts_; }

    /// What is open as the editor has it, everything else as it lies on the disk, within the roots of the effect.
    [[nodiscard]] FileReader reader(const std::filesystem::path& effect, const LoadOptions& options) const;
    /// Empty where it cannot be read.
    [[nodiscard]] std::string textOf(const std::string& path) const;

private:
    std::map<std::string, std::string> texts_;
};

/// {line, character} of a place; `text` is the file's.
[[nodiscard]] Json positionJson(std::string_view text, int line, int column);
/// As the protocol has them, from the place to the end of its word.
[[nodiscard]] Json rangeJson(std::string_view text, const SourcePosition& at);
[[nodiscard]] Json diagnosticJson(std::string_view text, const Diagnostic& diagnostic);

} // namespace tegument::lsp
