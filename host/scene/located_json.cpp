// nlohmann's SAX parser does not say where it is; an iterator that counts does.

#include "host/scene/located_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <iterator>
#include <optional>
#include <set>

namespace tegument {

namespace {

/// Reads characters and remembers how many.
class CountingIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    CountingIterator(const char* at, std::size_t* count) : at_(at), count_(count) {}
    reference operator*() const { return *at_; }
    CountingIterator& operator++() {
        ++at_;
        if (count_) ++*count_;
        return *this;
    }
    CountingIterator operator++(int) {
        CountingIterator old = *this;
        ++*this;
        return old;
    }
    bool operator==(const CountingIterator& other) const { return at_ == other.at_; }
    bool operator!=(const CountingIterator& other) const { return at_ != other.at_; }

private:
    const char* at_;
    std::size_t* count_;
};

/// Builds the tree. Its member functions are named by nlohmann's SAX interface.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
public:
    TreeBuilder(std::string_view text, const std::string& file, const std::size_t& read) : text_(text), file_(file), read_(read) {}

    bool null() override { return add({}); }
    bool boolean(bool value) override { return add({.kind = LocatedJson::Kind::Boolean, .boolean = value}); }
    bool number_integer(number_integer_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return addNumber(value); }
    bool string(string_t& value) override { return add({.kind = LocatedJson::Kind::Text, .text = value}); }
    bool binary(binary_t&) override { return false; } // JSON text has none
    bool start_object(std::size_t) override { return open(LocatedJson::Kind::Object); }
    bool start_array(std::size_t) override { return open(LocatedJson::Kind::List); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        keyOffset_ = quotedStart();
        key_ = name;
        const bool repeated = !open_.back().known.insert(name).second;
        if (repeated) fail(5404, keyOffset_, "the key '" + name + "' is there already", "remove one of the two");
        return !repeated;
    }

    bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& exception) override {
        std::string reason = exception.what();
        // nlohmann: "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing ...; last read: '...'"
        if (const std::size_t colon = reason.find(": "); colon != std::string::npos) reason = reason.substr(colon + 2);
        fail(5400, position > 0 ? position - 1 : 0, "not JSON: " + reason,
             "comments and trailing commas are not allowed; use the key \"comment\"");
        return false;
    }

    [[nodiscard]] std::optional<Error>& error() { return error_; }
    [[nodiscard]] LocatedJson& root() { return root_; }

private:
    /// An object or list whose end is still to come.
    struct Open {
        LocatedJson value;
        std::string key; // under which its parent will hold it
        std::set<std::string> known;
    };

    /// A closing quote was just read; the opening one is the nearest before it that no backslash precedes.
    [[nodiscard]] std::size_t quotedStart() const {
        std::size_t at = read_ >= 2 ? read_ - 2 : 0;
        while (at > 0 && (text_[at] != '"' || text_[at - 1] == '\\'))
            --at;
        return at;
    }

    /// Numbers and words end before the character that was read last, unless it is the file's last one.
    [[nodiscard]] std::size_t wordStart() const {
        const auto isPart = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '+' || c == '.'; };
        std::size_t at = read_;
        if (at > 0 && !isPart(text_[at - 1])) --at;
        while (at > 0 && isPart(text_[at - 1]))
            --at;
        return at;
    }

    /// Members are found at their key.
    [[nodiscard]] std::size_t offsetOfNext(LocatedJson::Kind kind) const {
        if (!open_.empty() && open_.back().value.kind == LocatedJson::Kind::Object) return keyOffset_;
        if (kind == LocatedJson::Kind::Text) return quotedStart();
        if (kind == LocatedJson::Kind::List || kind == LocatedJson::Kind::Object) return read_ - std::min<std::size_t>(read_, 1);
        return wordStart();
    }

    bool addNumber(double value) { return add({.kind = LocatedJson::Kind::Number, .number = value}); }

    bool add(LocatedJson value) {
        value.offset = offsetOfNext(value.kind);
        attach(std::move(value), key_);
        return true;
    }

    void attach(LocatedJson value, const std::string& name) {
        if (open_.empty()) {
            root_ = std::move(value);
            return;
        }
        LocatedJson& parent = open_.back().value;
        if (parent.kind == LocatedJson::Kind::Object) parent.keys.push_back(name);
        parent.items.push_back(std::move(value));
    }

    bool open(LocatedJson::Kind kind) {
        constexpr std::size_t kDeepest = 32;
        if (open_.size() == kDeepest) {
            fail(5400, read_ - 1, "JSON nested more than 32 deep", {});
            return false;
        }
        const std::size_t offset = offsetOfNext(kind);
        open_.push_back({.value = {.kind = kind, .offset = offset}, .key = key_});
        return true;
    }

    bool close() {
        Open closed = std::move(open_.back());
        open_.pop_back();
        attach(std::move(closed.value), closed.key);
        return true;
    }

    void fail(int code, std::size_t offset, std::string text, std::string hint) {
        Error error = inputError(code, positionAt(text_, offset, file_), std::move(text), std::move(hint));
        error.diagnostics.front().sourceLine = lineAt(text_, offset);
        error_ = std::move(error);
    }

    std::string_view text_;
    const std::string& file_;
    const std::size_t& read_;
    std::vector<Open> open_;
    std::string key_;
    std::size_t keyOffset_ = 0;
    LocatedJson root_;
    std::optional<Error> error_;
};

} // namespace

const char* LocatedJson::kindName() const {
    switch (kind) {
    case Kind::Null: return "null";
    case Kind::Boolean: return "true or false";
    case Kind::Number: return "a number";
    case Kind::Text: return "a string";
    case Kind::List: return "a list";
    case Kind::Object: return "an object";
    }
    return "";
}

SourcePosition positionAt(std::string_view text, std::size_t offset, const std::string& file) {
    const std::string_view before = text.substr(0, std::min(offset, text.size()));
    const std::size_t lineStart = before.rfind('\n') + 1; // npos + 1 is 0
    return {.file = file,
            .line = static_cast<int>(std::ranges::count(before, '\n')) + 1,
            .column = static_cast<int>(before.size() - lineStart) + 1};
}

std::string lineAt(std::string_view text, std::size_t offset) {
    const std::size_t start = text.substr(0, std::min(offset, text.size())).rfind('\n') + 1;
    const std::size_t end = std::min(text.find_first_of("\r\n", start), text.size());
    constexpr std::size_t kLongest = 200;
    return std::string(text.substr(start, std::min(end - start, kLongest)));
}

Result<LocatedJson> parseLocatedJson(std::string_view text, const std::string& file) {
    std::size_t read = 0;
    TreeBuilder builder(text, file, read);
    const bool good =
        nlohmann::json::sax_parse(CountingIterator(text.data(), &read), CountingIterator(text.data() + text.size(), nullptr), &builder);
    if (builder.error()) return *builder.error();
    assert(good);
    (void)good;
    return std::move(builder.root());
}

std::optional<std::vector<double>> parameterNumbers(const LocatedJson& value) {
    using Kind = LocatedJson::Kind;
    if (value.kind == Kind::Number) return std::vector{value.number};
    if (value.kind == Kind::Boolean) return std::vector{value.boolean ? 1.0 : 0.0};
    if (value.kind != Kind::List || value.items.empty()) return std::nullopt;
    std::vector<double> numbers;
    for (const LocatedJson& item : value.items) {
        if (item.kind != Kind::Number) return std::nullopt;
        numbers.push_back(item.number);
    }
    return numbers;
}

bool LocatedReader::expect(const LocatedJson& value, LocatedJson::Kind kind, const std::string& what) {
    if (error_) return false;
    if (value.kind == kind) return true;
    fail(5402, value, fmt::format("{} is {}, but must be {}", what, value.kindName(), LocatedJson{.kind = kind}.kindName()), {});
    return false;
}

void LocatedReader::fail(int code, const LocatedJson& value, std::string text, std::string hint) {
    if (error_) return;
    error_ = inputError(code, positionAt(text_, value.offset, path_.string()), std::move(text), std::move(hint));
    error_->diagnostics.front().sourceLine = lineAt(text_, value.offset);
}

} // namespace tegument
