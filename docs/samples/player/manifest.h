#pragma once
// manifest.json of `tegument check --emit` (docs/emit.md) for an engine of your own: a strict reader of JSON, and what script_player.h
// walks. C++17, no other file. An engine that has a reader of JSON fills script_player::Technique from its own tree instead.
//
//   const script_player::Json manifest = script_player::readManifest(text);
//   script_player::play(script_player::techniqueOf(manifest, "DEonLuebke"), engine);
//
// Whatever is wrong with a text is one std::runtime_error; of bytes it names the place.

#include "script_player.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <limits>
#include <locale>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

namespace script_player {

/// A value as it stands. What is asked of a value of another kind, or by a name that it lacks, is a std::runtime_error.
struct Json {
    enum class Kind { Null, Bool, Number, String, Array, Object };

    Kind kind = Kind::Null;
    double value = 0; // of a bool 0 or 1
    std::string string;
    std::vector<std::string> keys; // of an object, one for each item
    std::vector<Json> items;

    const Json* find(const std::string& key) const {
        for (std::size_t i = 0; i < keys.size(); ++i)
            if (keys[i] == key) return &items[i];
        return nullptr;
    }
    const Json& at(const std::string& key) const {
        if (const Json* found = find(key)) return *found;
        throw std::runtime_error("manifest: no " + key);
    }
    const std::string& text() const { return need(Kind::String, "text"), string; }
    double number() const { return need(kind == Kind::Bool ? Kind::Bool : Kind::Number, "a number"), value; }
    /// Of more than the largest float the conversion would be undefined. (max): Windows' headers make a macro of the name.
    float small() const {
        if (std::abs(number()) > static_cast<double>((std::numeric_limits<float>::max)())) throw std::runtime_error("manifest: no float");
        return static_cast<float>(value);
    }
    /// A size or an index.
    std::uint32_t whole() const {
        const bool fits = number() >= 0 && value <= (std::numeric_limits<std::uint32_t>::max)() && value == std::floor(value);
        if (!fits) throw std::runtime_error("manifest: no whole number: " + std::to_string(value));
        return static_cast<std::uint32_t>(value);
    }
    const std::vector<Json>& list() const { return need(Kind::Array, "a list"), items; }
    std::string textOr(const std::string& key, const std::string& otherwise) const { return find(key) ? at(key).text() : otherwise; }
    double numberOr(const std::string& key, double otherwise) const { return find(key) ? at(key).number() : otherwise; }

    void need(Kind wanted, const char* what) const {
        if (kind != wanted) throw std::runtime_error(std::string("manifest: ") + what + " is wanted where something else stands");
    }
};

namespace detail {

constexpr int kMostJsonDepth = 32; // a manifest has 8

class JsonReader {
public:
    explicit JsonReader(std::string_view text) : text_(text) { numbers_.imbue(std::locale::classic()); }

    Json read() {
        Json json = value(0);
        blank();
        if (at_ != text_.size()) fail("something follows the value");
        return json;
    }

private:
    [[noreturn]] void fail(const char* what) const { throw std::runtime_error("manifest: byte " + std::to_string(at_) + ": " + what); }

    char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }
    bool take(char letter) {
        if (at_ >= text_.size() || text_[at_] != letter) return false;
        ++at_;
        return true;
    }
    void blank() {
        while (at_ < text_.size() && std::strchr(" \t\r\n", text_[at_]) && text_[at_] != '\0')
            ++at_;
    }

    Json value(int depth) {
        if (depth > kMostJsonDepth) fail("nested too deeply");
        blank();
        Json json;
        if (take('{')) return object(depth);
        if (take('[')) return array(depth);
        if (take('"')) {
            json.kind = Json::Kind::String;
            json.string = string();
            return json;
        }
        if (word("null")) return json;
        json.kind = Json::Kind::Bool;
        json.value = peek() == 't' ? 1 : 0;
        if (word("true") || word("false")) return json;
        json.kind = Json::Kind::Number;
        json.value = number();
        return json;
    }

    bool word(std::string_view wanted) {
        if (text_.substr(at_, wanted.size()) != wanted) return false;
        at_ += wanted.size();
        return true;
    }

    Json object(int depth) {
        Json json;
        std::set<std::string> known;
        json.kind = Json::Kind::Object;
        for (blank(); !take('}'); blank()) {
            if (!json.items.empty() && !take(',')) fail("neither , nor }");
            blank();
            if (!take('"')) fail("no name");
            std::string key = string();
            if (!known.insert(key).second) fail("a name stands twice");
            blank();
            if (!take(':')) fail("no : behind a name");
            json.items.push_back(value(depth + 1));
            json.keys.push_back(std::move(key));
        }
        return json;
    }

    Json array(int depth) {
        Json json;
        json.kind = Json::Kind::Array;
        for (blank(); !take(']'); blank()) {
            if (!json.items.empty() && !take(',')) fail("neither , nor ]");
            json.items.push_back(value(depth + 1));
        }
        return json;
    }

    bool digits() {
        const std::size_t from = at_;
        while (peek() >= '0' && peek() <= '9')
            ++at_;
        return at_ > from;
    }

    /// By a stream: libc++ has no from_chars for it before version 20. Too small a number is 0.
    double number() {
        const std::size_t from = at_;
        take('-');
        if (!take('0') && !digits()) fail("no value");
        if (take('.') && !digits()) fail("no digit behind the point");
        if (take('e') || take('E')) {
            if (!take('+')) take('-');
            if (!digits()) fail("no digit in the exponent");
        }
        double number = 0;
        numbers_.clear();
        numbers_.str(std::string(text_.substr(from, at_ - from)));
        if (!(numbers_ >> number) && std::abs(number) > 1) fail("a number that is too large");
        return number;
    }

    std::string string() {
        std::string result;
        while (!take('"')) {
            if (at_ >= text_.size() || static_cast<unsigned char>(text_[at_]) < 0x20) fail("a text has no end");
            if (take('\\'))
                escape(result);
            else
                result += text_[at_++];
        }
        return result;
    }

    void escape(std::string& result) {
        constexpr std::string_view kLetters = "\"\\/bfnrt";
        constexpr std::string_view kMeant = "\"\\/\b\f\n\r\t";
        const std::size_t which = at_ < text_.size() ? kLetters.find(text_[at_]) : std::string_view::npos;
        if (which != std::string_view::npos) {
            result += kMeant[which];
            ++at_;
            return;
        }
        std::uint32_t code = unit();
        if (code >= 0xD800 && code < 0xDC00) {
            if (!take('\\')) fail("half of a letter");
            const std::uint32_t low = unit();
            if (low < 0xDC00 || low > 0xDFFF) fail("half of a letter");
            code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        } else if (code >= 0xDC00 && code <= 0xDFFF)
            fail("half of a letter");
        appendUtf8(result, code);
    }

    std::uint32_t unit() {
        if (!take('u') || text_.size() - at_ < 4) fail("no such escape");
        std::uint32_t code = 0;
        const auto end = std::from_chars(text_.data() + at_, text_.data() + at_ + 4, code, 16);
        if (end.ptr != text_.data() + at_ + 4) fail("no such escape");
        at_ += 4;
        return code;
    }

    static void appendUtf8(std::string& result, std::uint32_t code) {
        const auto add = [&](std::uint32_t byte) { result += static_cast<char>(byte); };
        if (code < 0x80) return add(code);
        if (code < 0x800)
            add(0xC0 | code >> 6);
        else {
            if (code < 0x10000)
                add(0xE0 | code >> 12);
            else {
                add(0xF0 | code >> 18);
                add(0x80 | (code >> 12 & 0x3F));
            }
            add(0x80 | (code >> 6 & 0x3F));
        }
        add(0x80 | (code & 0x3F));
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::istringstream numbers_;
};

inline std::optional<std::string> scriptOf(const Json& owner) {
    if (const Json* script = owner.at("annotations").find("Script")) return script->text();
    return owner.find("compute_shader") ? std::optional<std::string>("Draw=Compute") : std::nullopt;
}

} // namespace detail

inline Json readJson(std::string_view text) {
    return detail::JsonReader(text).read();
}

inline Json readManifest(std::string_view text) {
    Json manifest = readJson(text);
    if (manifest.textOr("format", "") != "tegument-effect 1") throw std::runtime_error("manifest: of another format");
    return manifest;
}

/// The element of a list that has this name: a technique, a pass, a shader, a parameter. Scripts ignore case.
inline const Json& named(const Json& list, const std::string& name) {
    for (const Json& one : list.list())
        if (detail::upper(one.at("name").text()) == detail::upper(name)) return one;
    throw std::runtime_error("manifest: no " + name);
}

inline Technique techniqueOf(const Json& manifest, const std::string& name) {
    const Json& technique = named(manifest.at("techniques"), name);
    Technique steps{technique.at("name").text(), detail::scriptOf(technique), {}};
    for (const Json& pass : technique.at("passes").list())
        steps.passes.push_back({pass.at("name").text(), detail::scriptOf(pass)});
    return steps;
}

/// The default of a parameter; no numbers where the effect has none.
inline Value defaultOf(const Json& parameter) {
    const Json& written = parameter.at("default");
    Value value{{}, parameter.at("type").text().compare(0, 4, "bool") == 0};
    if (written.kind == Json::Kind::Number || written.kind == Json::Kind::Bool) value.numbers = {written.small()};
    if (written.kind == Json::Kind::Array)
        for (const Json& number : written.items)
            value.numbers.push_back(number.small());
    return value;
}

} // namespace script_player
