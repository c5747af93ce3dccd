#pragma once
// Inside host/scene only: JSON in which every value knows where it stands, for messages with line and column.

#include "host/support/result.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

struct LocatedJson {
    enum class Kind { Null, Boolean, Number, Text, List, Object };
    Kind kind = Kind::Null;
    bool boolean = false;
    double number = 0;
    std::string text;
    std::vector<LocatedJson> items; // of a list or an object, in the file's order
    std::vector<std::string> keys;  // of an object: one for each item
    std::size_t offset = 0;         // of its first byte; of a member: of its key

    [[nodiscard]] const char* kindName() const;
};

/// Line, column and text of a byte offset.
[[nodiscard]] SourcePosition positionAt(std::string_view text, std::size_t offset, const std::string& file);
[[nodiscard]] std::string lineAt(std::string_view text, std::size_t offset);

/// Strict JSON (RFC 8259), nesting at most 32 deep. TG5400 syntax, TG5404 a key that its object already has.
[[nodiscard]] Result<LocatedJson> parseLocatedJson(std::string_view text, const std::string& file);

/// The numbers of a parameter: one number, true or false (1 or 0), or a list of at least one number. None: it is something else.
[[nodiscard]] std::optional<std::vector<double>> parameterNumbers(const LocatedJson& value);

/// What readers of such files have in common: the first error is kept, and everything after it is passed over. Text and path outlive it.
class LocatedReader {
protected:
    LocatedReader(std::string_view text, const std::filesystem::path& path) : text_(text), path_(path) {}

    /// TG5402 where the value is of another kind.
    bool expect(const LocatedJson& value, LocatedJson::Kind kind, const std::string& what);
    void fail(int code, const LocatedJson& value, std::string text, std::string hint);

    std::string_view text_;
    const std::filesystem::path& path_;
    std::optional<Error> error_;
};

} // namespace tegument
