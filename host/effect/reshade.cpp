#include "host/effect/reshade.h"

#include "generated/reshade_parts.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>

namespace tegument {

namespace {

namespace fs = std::filesystem;

using Range = std::pair<std::size_t, std::size_t>; // of tokens: first, one behind the last

constexpr int kDeepestCalls = 128; // calls of intrinsics as arguments of others

/// Words of ReShade and those that stand for them here, each between blanks.
constexpr std::string_view kTheirFormats =
    " R8=L8 R16=A16B16G16R16 R16F=R16F R32F=R32F RG8=A8B8G8R8 R8G8=A8B8G8R8 RG16=A16B16G16R16 RG16F=G16R16F RG32F=G32R32F RGBA8=A8B8G8R8 "
    "R8G8B8A8=A8B8G8R8 RGBA16=A16B16G16R16 RGBA16F=A16B16G16R16F RGBA32F=A32B32G32R32F RGB10A2=A2B10G10R10 ";
constexpr std::string_view kTheirWords =
    " blendenable=AlphaBlendEnable stencilreadmask=StencilMask stencilpassop=StencilPass stencilfailop=StencilFail "
    "stencildepthfailop=StencilZFail rendertargetwritemask=ColorWriteEnable leequal=LESSEQUAL lequal=LESSEQUAL gequal=GREATEREQUAL "
    "nequal=NOTEQUAL repeat=WRAP miplodbias=MipMapLodBias vpos=SV_Position position=SV_Position depth=SV_Depth ";

std::string replaced(std::string_view table, std::string word) {
    std::string key = fmt::format(" {}=", table == kTheirWords ? toLower(word) : word);
    const std::size_t at = table.find(key);
    if (at == std::string_view::npos) return word;
    table.remove_prefix(at + key.size());
    return std::string(table.substr(0, table.find(' ')));
}

constexpr std::string_view kFunctions =
    " abs acos all any asin atan ceil clamp cos cosh cross degrees distance dot exp floor frac length lerp "
    "log max min noise normalize pow radians reflect round saturate sign sin sinh sqrt step tan tanh ";

/// Of hlsl/reshade.hlsl.
std::string_view part(std::string_view name) {
    const std::string_view all = kReshadeParts;
    const std::size_t first = all.find('\n', all.find(fmt::format("//// {}", name)));
    return all.substr(first, all.find("////", first) - first);
}

enum class Kind { Plain, Texture, Sampler, Storage };

struct Entity {
    Kind kind = Kind::Plain;
    std::string name;    // here, where there are no namespaces
    std::string texture; // of a sampler, or of a storage
    bool srgb = false;
};

/// `texture2D`, `sampler`, `storage1D`: what it is, and how many dimensions it has.
std::optional<std::pair<Kind, char>> objectType(std::string_view word) {
    for (const auto& [name, kind] : {std::pair("texture", Kind::Texture), {"sampler", Kind::Sampler}, {"storage", Kind::Storage}})
        for (const std::string_view dimensions : {"", "1D", "2D", "3D"})
            if (word == fmt::format("{}{}", name, dimensions)) return std::pair(kind, dimensions.empty() ? '2' : dimensions[0]);
    return std::nullopt;
}

class Rewriter {
public:
    Rewriter(const fs::path& effect, const PreprocessOptions& options, Preprocessed& view, Sources& sources)
        : effect_(effect), options_(options), view_(view), in_(view.tokens), sources_(sources) {}

    Result<void> run() {
        findComputeSizes();
        begin();
        while (at_ < in_.size() && !failure_)
            topLevel();
        if (!scope_.empty()) fail(1102, in_.empty() ? Token{} : in_.back(), "a namespace is never closed");
        if (failure_) return Error{Blame::Input, {*failure_}};
        technique(kPictureTechnique, "", {}, in_.empty() ? Token{} : in_.front());
        view_.tokens = std::move(out_);
        view_.pragmas.clear();
        return {};
    }

private:
    struct Object {
        std::string texture;
        std::string sampler;
        bool storage = false;
        std::string srgb; // whether it decodes, as an expression
    };
    using Properties = std::map<std::string, Range>; // by lower-case name: the tokens of a value

    void fail(int code, const Token& at, std::string text, std::string hint = {}) {
        if (!failure_) failure_ = Diagnostic{.code = code, .at = sources_.position(at), .text = std::move(text), .hint = std::move(hint)};
        at_ = in_.size();
    }
    [[nodiscard]] const Token& peek(std::size_t ahead = 0) const {
        static const Token kEnd{.kind = TokenKind::Newline};
        return at_ + ahead < in_.size() ? in_[at_ + ahead] : kEnd;
    }
    [[nodiscard]] bool isScope(std::size_t i) const {
        return i + 1 < in_.size() && in_[i].is(':') && in_[i + 1].is(':') && !in_[i + 1].space;
    }

    /// `1f` is no number of HLSL's, and a variable `sin` would hide the function.
    void push(Token token, bool called = true) {
        const auto text = token.text;
        const bool whole = text.find_first_of(".xXeE") == std::string_view::npos;
        if (token.kind == TokenKind::Number && whole && toLower(text).ends_with('f'))
            token.text = sources_.keep(fmt::format("{}.f", text.substr(0, text.size() - 1)));
        if (token.kind == TokenKind::Word && !called && kFunctions.find(fmt::format(" {} ", text)) != std::string_view::npos)
            token.text = sources_.keep(fmt::format("tg_{}", text));
        out_.push_back(token);
    }
    void push(std::string_view text, const Token& at) {
        std::vector<Token> made = tokensOf(sources_, sources_.keep(std::string(text)), at);
        std::erase_if(made, [](const Token& token) { return token.kind == TokenKind::Newline; });
        out_.insert(out_.end(), made.begin(), made.end());
        if (!made.empty()) out_[out_.size() - made.size()].space = true;
    }
    [[nodiscard]] std::string text(const Range& range) const {
        std::string text;
        for (std::size_t i = range.first; i < range.second; ++i)
            text += fmt::format("{}{}", in_[i].space && i > range.first ? " " : "", in_[i].text);
        return text;
    }
    /// One behind the bracket that closes the one at `open`.
    std::size_t behind(std::size_t open, char closes) {
        const char opens = in_[open].text[0];
        int depth = 0;
        for (std::size_t i = open; i < in_.size(); ++i) {
            depth += in_[i].is(opens) ? 1 : in_[i].is(closes) ? -1 : 0;
            if (depth == 0) return i + 1;
        }
        fail(1102, in_[open], fmt::format("this '{}' is never closed", opens));
        return in_.size();
    }
    /// The first of these signs outside of brackets, from `i` on.
    [[nodiscard]] std::size_t find(std::size_t i, std::size_t last, std::string_view signs) const {
        for (int depth = 0; i < last; ++i) {
            const Token& token = in_[i];
            if (token.kind != TokenKind::Sign) continue;
            if (depth == 0 && signs.find(token.text[0]) != std::string_view::npos) return i;
            depth += token.is('(') || token.is('[') || token.is('{') ? 1 : token.is(')') || token.is(']') || token.is('}') ? -1 : 0;
        }
        return last;
    }
    [[nodiscard]] std::vector<Range> split(std::size_t first, std::size_t last, char sign) const {
        std::vector<Range> parts;
        while (first < last) {
            const std::size_t end = find(first, last, std::string_view(&sign, 1));
            parts.emplace_back(first, end);
            first = end + 1;
        }
        return parts;
    }
    /// `[type] name = value;`, any number of them, as annotations and blocks have them.
    [[nodiscard]] Properties properties(std::size_t first, std::size_t last) const {
        Properties result;
        for (const auto& [from, to] : split(first, last, ';')) {
            const std::size_t sign = find(from, to, "=");
            if (sign > from && sign < to) result[toLower(in_[sign - 1].text)] = {sign + 1, to};
        }
        return result;
    }
    Properties block(char opens, char closes) {
        if (!peek().is(opens)) return {};
        const std::size_t first = at_ + 1;
        at_ = behind(at_, closes);
        return failure_ ? Properties() : properties(first, at_ - 1);
    }
    [[nodiscard]] std::string value(const Properties& list, const char* name, std::string_view otherwise) const {
        const auto found = list.find(name);
        return found == list.end() ? std::string(otherwise) : text(found->second);
    }
    [[nodiscard]] bool truth(const Properties& list, const char* name) const {
        const std::string text = toLower(value(list, name, "false"));
        return text == "true" || text == "1";
    }

    // Names.
    [[nodiscard]] std::string prefix(std::size_t depth) const {
        std::string name;
        for (std::size_t i = 0; i < depth; ++i)
            name += scope_[i] + "::";
        return name;
    }
    Entity& declare(const Token& name, Kind kind) {
        const std::string simple(name.text);
        const std::string full = prefix(scope_.size()) + simple;
        if (const auto known = entities_.find(full); known != entities_.end()) return known->second; // an overload
        std::string flat = simple;
        if (!taken_.insert(flat).second) {
            flat = full;
            for (std::size_t at; (at = flat.find("::")) != std::string::npos;)
                flat.replace(at, 2, "_");
            while (!taken_.insert(flat).second)
                flat += '_';
        }
        return entities_[full] = {.kind = kind, .name = std::move(flat)};
    }
    [[nodiscard]] const Entity* resolve(const std::string& name) const {
        for (std::size_t depth = scope_.size() + 1; depth-- > 0;)
            if (const auto found = entities_.find(prefix(depth) + name); found != entities_.end()) return &found->second;
        return nullptr;
    }
    /// `A::B::name` at `i`; `end` is one behind it.
    [[nodiscard]] std::string qualified(std::size_t i, std::size_t& end) const {
        std::string name(in_[i].text);
        for (end = i + 1; isScope(end) && end + 2 < in_.size() && in_[end + 2].kind == TokenKind::Word; end += 3)
            name += fmt::format("::{}", in_[end + 2].text);
        return name;
    }
    [[nodiscard]] std::string named(const Range& range) const {
        if (range.first >= range.second || in_[range.first].kind != TokenKind::Word) return text(range);
        std::size_t end = 0;
        const std::string name = qualified(range.first, end);
        const Entity* entity = resolve(name);
        return entity ? entity->name : name;
    }

    // Code.
    [[nodiscard]] std::optional<Object> object(Range range) const {
        while (range.second - range.first > 2 && in_[range.first].is('(')) // a macro's brackets
            ++range.first, --range.second;
        std::size_t end = 0;
        if (range.first >= range.second || in_[range.first].kind != TokenKind::Word) return std::nullopt;
        const std::string name = qualified(range.first, end);
        if (end != range.second) return std::nullopt;
        if (const auto local = locals_.find(name); local != locals_.end())
            return Object{"tg_t_" + name, name, local->second == Kind::Storage, "tg_b_" + name};
        const Entity* entity = resolve(name);
        if (!entity || (entity->kind != Kind::Sampler && entity->kind != Kind::Storage)) return std::nullopt;
        return Object{entity->texture, entity->name, entity->kind == Kind::Storage, entity->srgb ? "true" : "false"};
    }

    void rewrite(std::size_t first, std::size_t last, bool structure = false) {
        for (std::size_t i = first; i < last && !failure_;) {
            const Token& token = in_[i];
            const bool member = i > 0 && in_[i - 1].is('.') && in_[i - 1].kind == TokenKind::Sign;
            if (isScope(i) && (i == 0 || in_[i - 1].kind != TokenKind::Word)) {
                i += 2; // ::name
                continue;
            }
            if (token.kind != TokenKind::Word || member || (structure && in_[i + 1].kind != TokenKind::Word && !isScope(i + 1))) {
                push(token);
                ++i;
                continue;
            }
            std::size_t end = 0;
            const std::string name = qualified(i, end);
            const Entity* entity = resolve(name);
            if (!entity && end < last && in_[end].is('(') && intrinsic(name, i, end)) {
                i = end;
                continue;
            }
            const bool argument =
                i > 0 && end < in_.size() && (in_[i - 1].is('(') || in_[i - 1].is(',')) && (in_[end].is(')') || in_[end].is(','));
            const auto passed = argument ? object({i, end}) : std::nullopt;
            if (passed && !passed->storage)
                push(fmt::format("{}, {}, {}", passed->texture, passed->sampler, passed->srgb), token);
            else if (entity && entity->name != token.text)
                push(entity->name, token);
            else
                for (std::size_t k = i; k < end; ++k)
                    push(in_[k], entity || (end < in_.size() && in_[end].is('(')));
            i = end;
        }
    }

    void call(std::string_view before, std::span<const Range> arguments, const Token& at, std::string_view behind = ")") {
        push(before, at);
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            if (i > 0) push(",", at);
            rewrite(arguments[i].first, arguments[i].second);
        }
        push(behind, at);
    }

    /// A call of one of ReShade's own functions; `end` moves behind it. False: it is none.
    bool intrinsic(const std::string& name, std::size_t first, std::size_t& end) {
        for (const auto& [theirs, ours] : {std::pair("barrier", "GroupMemoryBarrierWithGroupSync("),
                                           {"memoryBarrier", "AllMemoryBarrier("},
                                           {"groupMemoryBarrier", "GroupMemoryBarrier("}})
            if (name == theirs) {
                push(ours, in_[first]);
                ++end;
                return true;
            }
        const bool texture = name.size() > 5 && name.starts_with("tex") && name[4] == 'D' && name[3] >= '1' && name[3] <= '3';
        if (!texture && name != "tex1D" && name != "tex2D" && name != "tex3D" && !name.starts_with("atomic")) return false;
        const std::size_t close = behind(end, ')');
        std::vector<Range> arguments = split(end + 1, close - 1, ',');
        if (failure_ || arguments.empty()) return false;
        if (++depth_ > kDeepestCalls) fail(1102, in_[first], fmt::format("calls are nested deeper than {}", kDeepestCalls));
        const bool known = !failure_ && (name.starts_with("atomic") ? atomic(name, first, arguments) : sampled(name, first, arguments));
        --depth_;
        if (known) end = close;
        return known;
    }

    bool atomic(const std::string& name, std::size_t first, std::vector<Range>& arguments) {
        const Token& at = in_[first];
        const auto storage = object(arguments[0]);
        std::string begin = fmt::format("Interlocked{}(", name.substr(6));
        if (storage && arguments.size() > 1) {
            begin += fmt::format("{}[", storage->sampler);
            call(begin, {&arguments[1], 1}, at, "],");
            arguments.erase(arguments.begin(), arguments.begin() + 2);
            begin.clear();
        }
        const bool alone = first > 0 && (in_[first - 1].is(';') || in_[first - 1].is('{') || in_[first - 1].is('}'));
        if (alone && name != "atomicExchange" && name != "atomicCompareExchange") {
            call(begin, arguments, at);
        } else {
            if (begin.empty()) return fail(2003, at, fmt::format("the value of {} on a storage cannot be used", name)), true;
            call("(" + begin, arguments, at, ", tg_old), tg_old)");
        }
        return true;
    }

    bool sampled(const std::string& name, std::size_t first, std::vector<Range>& arguments) {
        const auto read = object(arguments[0]);
        if (!read) return false;
        const Token& at = in_[first];
        const std::string what = name.substr(5);
        const std::span<const Range> rest = std::span(arguments).subspan(1);
        const std::string cast = name[3] == '1' ? "int" : fmt::format("int{}", name[3]);
        const bool gathers = what.starts_with("gather");
        const std::string behind = fmt::format("), {})", read->srgb);
        const auto decoded = [&](const std::string& before, std::span<const Range> list) {
            call((gathers ? "tg_decode_each(" : "tg_decode(") + before, list, at, behind);
            return true;
        };
        const auto method = [&](std::string_view word) { return fmt::format("{}.{}({},", read->texture, word, read->sampler); };
        if (what == "store" && rest.size() == 2) {
            call(fmt::format("({}[({})(", read->sampler, cast), rest.subspan(0, 1), at, ")] =");
            call("", rest.subspan(1), at);
            return true;
        }
        if (what == "fetch" && read->storage && rest.size() == 1)
            return call(fmt::format("{}[({})(", read->sampler, cast), rest, at, ")]"), true;
        if (what == "size") {
            push(fmt::format("tg_size({}{}", read->storage ? read->sampler : read->texture, rest.empty() || read->storage ? "" : ","), at);
            return call("", read->storage ? std::span<const Range>() : rest, at), true;
        }
        if (read->storage || rest.empty()) return false;
        if (what == "fetch") return decoded(fmt::format("tg_fetch({},", read->texture), rest);
        if (what == "grad" || (what.empty() && rest.size() == 3)) return decoded(method("SampleGrad"), rest);
        if (what.empty() || what == "offset") return decoded(method("Sample"), rest);
        if (what == "lod" && rest.size() == 1) return decoded(fmt::format("tg_lod({}, {},", read->texture, read->sampler), rest);
        if ((what == "lod" || what == "lodoffset") && rest.size() == 2) {
            const std::array<Range, 1> place{rest[0]};
            push("tg_decode(", at);
            call(method("SampleLevel") + "(", place, at, name[3] == '2' ? ").xy, (" : name[3] == '1' ? ").x, (" : ").xyz, (");
            call("", place, at, ").w,");
            return call("", rest.subspan(1), at, behind), true;
        }
        if (!gathers) return false;
        constexpr std::array kChannels = {"GatherRed", "GatherGreen", "GatherBlue", "GatherAlpha"};
        const std::size_t letter = what.size() > 6 ? std::string_view("RGBA").find(what[6]) : std::string_view::npos;
        if (letter < 4) return decoded(method(kChannels[letter]), rest);
        const std::string channel = rest.size() > 1 ? text(rest.back()) : "0";
        const std::size_t number = channel.size() == 1 ? std::string_view("0123").find(channel) : std::string_view::npos;
        if (number > 3) return fail(2003, at, fmt::format("the component of {} is no number from 0 to 3", name)), true;
        return decoded(method(kChannels[number]), rest.size() > 1 ? rest.subspan(0, rest.size() - 1) : rest);
    }

    // Declarations.
    void topLevel() {
        const Token& token = peek();
        if (token.is(';')) return void(++at_);
        if (token.is('}') && !scope_.empty()) return scope_.pop_back(), void(++at_);
        if (token.is("namespace") && peek(1).kind == TokenKind::Word && peek(2).is('{')) {
            scope_.emplace_back(peek(1).text);
            at_ += 3;
        } else if (token.is("technique")) {
            techniqueDeclaration();
        } else if (token.is("struct") && peek(1).kind == TokenKind::Word && peek(2).is('{')) {
            structure();
        } else if (token.is('[')) {
            const std::size_t first = std::exchange(at_, behind(at_, ']'));
            rewrite(first, at_);
        } else if (const auto type = objectType(token.text)) {
            objectDeclaration(type->first, type->second);
        } else {
            declaration();
        }
    }

    void structure() {
        const std::size_t first = at_;
        const Entity& made = declare(peek(1), Kind::Plain);
        push(in_[first]);
        push(made.name, in_[first + 1]);
        at_ = behind(first + 2, '}');
        rewrite(first + 2, at_, true);
        push(";", in_[first]);
    }

    void objectDeclaration(Kind kind, char dimensions) {
        ++at_;
        if (peek().is('<')) at_ = behind(at_, '>');
        const Token name = peek();
        if (name.kind != TokenKind::Word) return fail(1101, name, fmt::format("expected a name, found '{}'", name.text));
        ++at_;
        std::string semantic;
        if (peek().is(':')) {
            semantic = peek(1).text;
            at_ += 2;
        }
        const Properties notes = block('<', '>');
        const Properties states = block('{', '}');
        if (failure_) return;
        if (!peek().is(';') && !peek().is(',')) --at_; // a block needs no ';'
        if (!in_[at_].is('}') && !peek().is(';')) return fail(1101, peek(), fmt::format("expected ';' after '{}'", name.text));
        ++at_;
        Entity& made = declare(name, kind);
        const auto texture = states.find("texture");
        if (kind != Kind::Texture && texture == states.end())
            return fail(1101, name, fmt::format("'{}' names no texture", name.text), "Texture = name; in its block");
        if (kind == Kind::Texture) return textureObject(made, name, dimensions, semantic, notes, states);
        made.texture = named(texture->second);
        if (kind == Kind::Storage) {
            made.name += made.name.ends_with("Store") ? "_" : ""; // not by our convention
            push(fmt::format("RWTexture{}D<float4> {} < string Stores = \"{}\"; >;", dimensions, made.name, made.texture), name);
            return;
        }
        made.srgb = truth(states, "srgbtexture");
        std::string block = fmt::format("SamplerState {} {{ Texture = {};", made.name, made.texture);
        for (const auto& [state, range] : states)
            if (state != "texture" && state != "srgbtexture")
                block += fmt::format(" {} = {};", replaced(kTheirWords, state), replaced(kTheirWords, text(range)));
        push(block + " };", name);
    }

    void textureObject(Entity& made, const Token& name, char dimensions, std::string_view semantic, const Properties& notes,
                       const Properties& states) {
        if (equalsIgnoreCase(semantic, "COLOR") || equalsIgnoreCase(semantic, "DEPTH")) {
            made.name = equalsIgnoreCase(semantic, "COLOR") ? "tgBackBuffer" : "tgDepth";
            return;
        }
        std::string own = fmt::format("Texture{}D<float4> {}", dimensions, made.name);
        if (const auto source = notes.find("source"); source != notes.end()) {
            const std::string file = text(source->second);
            const auto found = file.size() > 2 ? picture(file.substr(1, file.size() - 2)) : std::nullopt;
            if (!found)
                view_.warnings.push_back(
                    inputWarning(4031, sources_.position(name),
                                 fmt::format("the picture {} of {} is not there: a plain one, noise, stands in", file, made.name),
                                 fmt::format("--set {}=FILE; -I FOLDER looks in FOLDER and beside it in Textures", made.name)));
            return push(own + fmt::format(" < string ResourceName = \"{}\"; string Procedure = \"noise\"; >;",
                                          found ? found->generic_string() : ""),
                        name);
        }
        const std::string format = value(states, "format", "RGBA8");
        const std::string ours = replaced(kTheirFormats, format);
        own += fmt::format(" : RENDERCOLORTARGET < string Format = \"{}\"; int2 Dimensions = {{ {}, {} }}; int MostLevels = {}; >;", ours,
                           value(states, "width", "1"), value(states, "height", "1"), value(states, "miplevels", "1"));
        push(own, name);
    }

    /// Beside the effect and the folders of -I, in them or in `Textures` at their side.
    [[nodiscard]] std::optional<fs::path> picture(const std::string& file) const {
        std::vector<fs::path> folders{effect_.parent_path()};
        folders.insert(folders.end(), options_.includeFolders.begin(), options_.includeFolders.end());
        for (const fs::path& folder : folders)
            for (const fs::path& path : {folder / file, folder / "Textures" / file, folder / ".." / "Textures" / file}) {
                std::error_code none;
                if (fs::exists(path, none)) return fs::relative(path, effect_.parent_path(), none);
            }
        return std::nullopt;
    }

    void declaration() {
        const std::size_t first = at_;
        bool isUniform = false;
        bool isConst = false;
        bool bound = false; // static or of a group
        while (peek().kind == TokenKind::Word && peek(1).kind == TokenKind::Word) {
            const std::string_view word = peek().text;
            isUniform |= word == "uniform";
            isConst |= word == "const";
            bound |= word == "static" || word == "groupshared";
            if (std::ranges::find(kModifiers, word) == kModifiers.end()) break;
            ++at_;
        }
        const std::size_t typeAt = at_;
        std::size_t behindType = at_ + 1;
        if (peek().kind == TokenKind::Word) (void)qualified(at_, behindType);
        if (behindType < in_.size() && in_[behindType].is('<')) behindType = behind(behindType, '>');
        const Range type{typeAt, behindType};
        at_ = behindType;
        if (failure_) return;
        if (in_[typeAt].kind != TokenKind::Word || peek().kind != TokenKind::Word)
            return fail(
                1101, in_[typeAt].kind == TokenKind::Word ? peek() : in_[typeAt],
                fmt::format("expected a declaration, found '{}'", in_[typeAt].kind == TokenKind::Word ? peek().text : in_[typeAt].text));
        if (peek(1).is('(')) return function(type);
        if (!bound && (isUniform || !isConst)) return uniforms(type);
        if (!bound) push("static", in_[first]);
        const std::size_t end = find(at_, in_.size(), ";");
        for (const auto& [from, to] : split(at_, end, ','))
            if (in_[from].kind == TokenKind::Word) declare(in_[from], Kind::Plain);
        rewrite(first, end);
        push(";", in_[first]);
        at_ = end + 1;
    }

    void uniforms(const Range& type) {
        for (bool more = true; more && !failure_;) {
            const Token name = peek();
            if (name.kind != TokenKind::Word) return fail(1101, name, fmt::format("expected a name, found '{}'", name.text));
            const Entity& made = declare(name, Kind::Plain);
            rewrite(type.first, type.second);
            push(made.name, name);
            const std::size_t array = ++at_;
            while (peek().is('['))
                at_ = behind(at_, ']');
            rewrite(array, at_);
            const Properties notes = block('<', '>');
            annotate(notes, name);
            const bool given = peek().is('=');
            const std::size_t first = at_;
            const std::size_t end = find(at_, in_.size(), ",;");
            if (given)
                rewrite(first, end);
            else if (array == first || !notes.empty())
                push("= " + start(notes), name);
            push(";", name);
            more = end < in_.size() && in_[end].is(',');
            at_ = end + 1;
        }
    }

    void annotate(const Properties& notes, const Token& name) {
        std::string list;
        for (const auto& [theirs, ours] : {std::pair("ui_label", "UIName"), {"ui_tooltip", "UIHelp"}, {"ui_type", "UIWidget"}})
            if (const auto found = notes.find(theirs); found != notes.end() && in_[found->second.first].kind == TokenKind::String)
                list += fmt::format("string {} = {}; ", ours, text(found->second));
        for (const auto& [theirs, ours] : {std::pair("ui_min", "UIMin"), {"ui_max", "UIMax"}, {"ui_step", "UIStep"}})
            if (const auto found = notes.find(theirs); found != notes.end()) {
                const std::string text = this->text(found->second);
                list += fmt::format("{} {} = {}; ",
                                    text.starts_with("float") || text.starts_with("int") ? text.substr(0, text.find('(')) : "float", ours,
                                    text);
            }
        if (!list.empty()) push("<" + list + ">", name);
    }

    /// What a still picture shows of a running game: its first second, with depth.
    [[nodiscard]] std::string start(const Properties& notes) const {
        const std::string source = value(notes, "source", "\"\"");
        for (const auto& [theirs, number] :
             {std::pair("\"timer\"", "1000"), {"\"frametime\"", "16.667"}, {"\"framecount\"", "60"}, {"\"bufready_depth\"", "1"}})
            if (source == theirs) return number;
        if (source == "\"date\"") return "float4(2020, 1, 1, 43200)";
        if (source == "\"pingpong\"") return fmt::format("float2({}, 1)", value(notes, "min", "0"));
        if (source == "\"random\"") return fmt::format("(({}) + ({})) / 2", value(notes, "min", "0"), value(notes, "max", "1"));
        return "0";
    }

    void function(const Range& type) {
        const Token name = peek();
        const Entity& made = declare(name, Kind::Plain);
        if (const auto size = computeSizes_.find(name.text); size != computeSizes_.end()) push(size->second, name);
        const std::size_t open = at_ + 1;
        const std::size_t close = behind(open, ')');
        if (failure_) return;
        locals_.clear();
        rewrite(type.first, type.second);
        push(made.name, name);
        std::string forwarded;
        std::string written;
        parameters(open, close, forwarded, written);
        std::string result;
        at_ = close;
        if (peek().is(':')) {
            result = semantic(peek(1).text);
            push(": " + result, peek(1));
            at_ += 2;
        }
        if (peek().is(';')) return push(in_[at_++]);
        if (!peek().is('{')) return fail(1101, peek(), fmt::format("expected the body of '{}', found '{}'", name.text, peek().text));
        const std::size_t body = std::exchange(at_, behind(at_, '}'));
        rewrite(body, at_);
        if (!encoding_.contains(name.text)) return;
        const std::string call = fmt::format("{}({})", made.name, forwarded);
        push(fmt::format("{} tg_srgb_{}", text(type), made.name), name);
        parameters(open, close, forwarded, written);
        if (!result.empty()) return push(fmt::format(": {} {{ return tg_encode({}); }}", result, call), name);
        push(fmt::format("{{ {}; {} }}", call, written.empty() ? "" : fmt::format("{0} = tg_encode({0});", written)), name);
    }

    /// Of an entry point besides: its arguments, and what it writes to the first target.
    void parameters(std::size_t open, std::size_t close, std::string& forwarded, std::string& written) {
        forwarded.clear();
        push("(", in_[open]);
        for (const auto& [from, to] : split(open + 1, close - 1, ',')) {
            if (from != open + 1) push(",", in_[from]);
            std::size_t at = from;
            while (at + 1 < to && std::ranges::find(kModifiers, in_[at].text) != kModifiers.end())
                ++at;
            const auto object = objectType(in_[at].text);
            const std::size_t colon = find(from, to, ":");
            const std::size_t nameAt = colon > from ? colon - 1 : from;
            if (object && object->first != Kind::Texture) {
                const Token& name = in_[to - 1];
                locals_[std::string(name.text)] = object->first;
                const std::string_view access = object->first == Kind::Storage ? "RWTexture" : "Texture";
                push(fmt::format("{}{}D<float4> {}", access, object->second,
                                 object->first == Kind::Storage ? std::string(name.text)
                                                                : fmt::format("tg_t_{0}, SamplerState {0}, bool tg_b_{0}", name.text)),
                     name);
                continue;
            }
            const bool semantics = colon < to && !isScope(colon) && colon + 1 < to;
            rewrite(from, semantics ? colon : to);
            if (semantics) push(": " + semantic(in_[colon + 1].text), in_[colon + 1]);
            forwarded += fmt::format("{}{}", forwarded.empty() ? "" : ", ", in_[nameAt].text);
            if (semantics && semantic(in_[colon + 1].text).starts_with("SV_Target")) written = in_[nameAt].text;
        }
        push(")", in_[open]);
    }

    [[nodiscard]] static std::string semantic(std::string_view word) {
        if (toLower(word).starts_with("color")) return fmt::format("SV_Target{}", word.substr(5));
        if (toLower(word).starts_with("sv_target")) return fmt::format("SV_Target{}", word.substr(9));
        return replaced(kTheirWords, std::string(word));
    }

    // Techniques.
    /// `ComputeShader = F<8, 8>` is an attribute of the function, which stands above.
    void findComputeSizes() {
        for (std::size_t i = 0; i + 1 < in_.size(); ++i) {
            if (in_[i].is("SRGBWriteEnable") && in_[i + 1].is('=') && i + 2 < in_.size() &&
                (equalsIgnoreCase(in_[i + 2].text, "true") || in_[i + 2].text == "1"))
                encodeAround(i);
            if (!in_[i].is("ComputeShader") || !in_[i + 1].is('=')) continue;
            const std::size_t end = find(i, in_.size(), ";");
            const std::size_t open = find(i, end, "<");
            if (open == end || open + 1 >= end || !in_[end - 1].is('>')) continue;
            std::string sizes = text({open + 1, end - 1});
            for (auto commas = std::ranges::count(sizes, ','); commas < 2; ++commas)
                sizes += ", 1";
            computeSizes_.emplace(std::string(in_[open - 1].text), fmt::format("[numthreads({})]", sizes));
        }
    }
    void encodeAround(std::size_t i) {
        std::size_t first = i;
        while (first > 0 && !in_[first].is('{') && !in_[first].is('}'))
            --first;
        for (std::size_t k = first; k + 2 < in_.size() && !in_[k].is('}'); ++k)
            if (in_[k].is("PixelShader")) encoding_.insert(std::string(in_[find(k, in_.size(), ";") - 1].text));
    }

    void techniqueDeclaration() {
        const Token name = peek(1);
        at_ += name.kind == TokenKind::Word ? 2 : 1;
        const Properties notes = block('<', '>');
        if (failure_) return;
        if (!peek().is('{')) return fail(1101, peek(), fmt::format("expected '{{' of the technique, found '{}'", peek().text));
        const std::size_t end = behind(at_, '}');
        ++at_;
        std::vector<std::pair<std::string, Token>> passes;
        while (at_ + 1 < end && !failure_) {
            const Token start = peek();
            if (start.is(';')) {
                ++at_;
                continue;
            }
            if (!equalsIgnoreCase(start.text, "pass")) return fail(1101, start, fmt::format("expected a pass, found '{}'", start.text));
            const bool given = peek(1).kind == TokenKind::Word;
            std::string own = given ? std::string(peek(1).text) : fmt::format("p{}", passes.size());
            if (own.starts_with("tg")) own.insert(0, "p_");
            while (std::ranges::any_of(passes, [&](const auto& other) { return other.second.text == own; }))
                own += '_';
            Token at = given ? peek(1) : start;
            at.text = sources_.keep(own);
            at_ += given ? 2 : 1;
            (void)block('<', '>');
            if (!peek().is('{')) return fail(1101, peek(), fmt::format("expected '{{' of the pass, found '{}'", peek().text));
            const Properties states = block('{', '}');
            if (!failure_) passes.emplace_back(pass(own, states, at), at);
        }
        at_ = end;
        if (!failure_) technique(name.text, value(notes, "ui_label", ""), passes, name);
    }

    void technique(std::string_view name, const std::string& label, const std::vector<std::pair<std::string, Token>>& passes,
                   const Token& at) {
        push("technique", at);
        Token own = at;
        own.kind = TokenKind::Word;
        own.text = sources_.keep(std::string(name));
        push(own);
        push((label.starts_with('"') ? fmt::format("< string UIName = {}; > ", label) : "") + "{ " + first_, at);
        for (const auto& [text, place] : passes)
            push(text, place);
        push(R"(pass tgShow < string Script = "Draw=Buffer;"; int VertexCount = 3; bool CoversTarget = true; >
            { ZEnable = FALSE; CullMode = NONE; VertexShader = compile vs_5_0 tg_cover(); PixelShader = compile ps_5_0 tg_show(); } })",
             at);
    }

    [[nodiscard]] std::string pass(const std::string& name, const Properties& states, const Token& at) {
        const auto entry = [&](const char* stage) {
            const auto found = states.find(stage);
            return found == states.end() ? std::string() : named(found->second);
        };
        if (const std::string compute = entry("computeshader"); !compute.empty())
            return fmt::format(
                "pass {} < string Script = \"Draw=Compute;\"; int3 Groups = {{ {}, {}, {} }}; > {{ ComputeShader = compile cs_5_0 {}(); }}",
                name, value(states, "dispatchsizex", "1"), value(states, "dispatchsizey", "1"), value(states, "dispatchsizez", "1"),
                compute);
        std::string script;
        for (int i = 0; i < 8; ++i)
            for (const std::string& state : {fmt::format("rendertarget{}", i), std::string(i == 0 ? "rendertarget" : "")})
                if (const auto found = states.find(state); found != states.end())
                    script += fmt::format("RenderColorTarget{}={};", i, named(found->second));
        if (script.empty()) script = "RenderColorTarget0=tgBackBuffer;";
        if (truth(states, "clearrendertargets")) script += "Clear=Color;";
        const std::string topology = toLower(value(states, "primitivetopology", value(states, "primitivetype", "TRIANGLELIST")));
        if (topology != "trianglelist" && topology != "trianglestrip")
            fail(2003, at, fmt::format("pass {} draws a {}", name, topology), "this host draws lists and strips of triangles");
        std::string text = fmt::format("pass {} < string Script = \"{}Draw=Buffer;\"; int VertexCount = {}; string Topology = \"{}\"; > "
                                       "{{ ZEnable = FALSE; CullMode = NONE; SeparateAlphaBlendEnable = TRUE; ",
                                       name, script, value(states, "vertexcount", "3"), topology);
        if (entry("vertexshader").empty() || entry("pixelshader").empty())
            fail(1101, at, fmt::format("pass {} lacks a vertex or a pixel shader", name), "VertexShader = name; PixelShader = name;");
        const bool encodes = truth(states, "srgbwriteenable");
        text += fmt::format("VertexShader = compile vs_5_0 {}(); PixelShader = compile ps_5_0 {}{}(); ", entry("vertexshader"),
                            encodes ? "tg_srgb_" : "", entry("pixelshader"));
        for (const auto& [state, range] : states) {
            const std::string ours(replaced(kTheirWords, state.ends_with('0') ? state.substr(0, state.size() - 1) : state));
            const bool apart = std::ranges::any_of(kOfPasses, [&](std::string_view word) { return state.starts_with(word); });
            const bool blends = state.starts_with("blend") || state.starts_with("src") || state.starts_with("dest"); // like target 0
            if ((apart && ours != "ColorWriteEnable") || (blends && state.back() >= '1' && state.back() <= '7')) continue;
            const std::string value(replaced(kTheirWords, this->text(range)));
            text += fmt::format("{} = {}; ", ours, value);
            if (equalsIgnoreCase(ours, "ColorWriteEnable"))
                for (int i = 1; i < 4; ++i)
                    text += fmt::format("ColorWriteEnable{} = {}; ", i, value);
        }
        return text + "}";
    }

    void begin() {
        const Token at = in_.empty() ? Token{} : in_.front();
        const auto given = [&](std::string_view name) {
            const auto found = std::ranges::find_if(options_.defines, [&](const auto& define) { return define.first == name; });
            return found == options_.defines.end() ? std::string() : found->second;
        };
        const auto number = [](const std::string& text) { return std::max(1.0, std::strtod(text.c_str(), nullptr)); };
        push(part("helpers"), at);
        push(fmt::format("static const float tg_aspect = {:.6f};", number(given("BUFFER_WIDTH")) / number(given("BUFFER_HEIGHT"))), at);
        push(part(given(kPictureIn).empty() ? "scene" : "picture"), at);
        const bool deep = !given(kDepthIn).empty();
        if (deep) push(part("depth"), at);
        constexpr std::string_view kPass =
            "pass {} < string Script = \"RenderColorTarget0=tgBackBuffer; RenderColorTarget1=tgDepth; RenderDepthStencilTarget=tgNearest; "
            "Draw={};\"; int "
            "VertexCount = 3; > {{ ZEnable = TRUE; ZWriteEnable = TRUE; ZFunc = {}; CullMode = NONE; VertexShader = compile "
            "vs_5_0 {}(); PixelShader = compile ps_5_0 {}(); }} ";
        first_ = fmt::format(fmt::runtime(kPass), "tgBegin", "Buffer", "ALWAYS", "tg_cover", deep ? "tg_deep" : "tg_begin");
        if (given(kMeshIn).empty()) return;
        push(part("mesh"), at);
        first_ += fmt::format(fmt::runtime(kPass), "tgMesh", "Geometry", "LESSEQUAL", "tg_place", "tg_mesh");
    }

    static constexpr std::array<std::string_view, 11> kModifiers = {
        "uniform", "static", "const", "groupshared", "precise", "volatile", "extern", "in", "out", "inout", "nointerpolation"};
    static constexpr std::array<std::string_view, 9> kOfPasses = {"vertexcount",     "primitive",    "clearrendertargets",
                                                                  "generatemipmaps", "dispatchsize", "srgbwrite",
                                                                  "vertexshader",    "pixelshader",  "rendertarget"};

    const fs::path& effect_;
    const PreprocessOptions& options_;
    Preprocessed& view_;
    const std::vector<Token>& in_;
    Sources& sources_;
    std::vector<Token> out_;
    std::size_t at_ = 0;
    int depth_ = 0;
    std::vector<std::string> scope_;
    std::map<std::string, Entity> entities_; // by its full name
    std::set<std::string> taken_;
    std::map<std::string, Kind> locals_;                           // samplers and storages among a function's parameters
    std::map<std::string, std::string, std::less<>> computeSizes_; // by function
    std::set<std::string, std::less<>> encoding_;                  // pixel shaders of passes with SRGBWriteEnable
    std::string first_;                                            // the passes before those of a technique
    std::optional<Diagnostic> failure_;
};

} // namespace

void defineReshade(std::vector<std::pair<std::string, std::string>>& defines) {
    const auto add = [&](const char* name, std::string value) {
        if (std::ranges::none_of(defines, [&](const auto& define) { return define.first == name; }))
            defines.emplace_back(name, std::move(value));
    };
    add("BUFFER_WIDTH", "1024");
    add("BUFFER_HEIGHT", "1024");
    for (const auto& [name, value] : {std::pair("BUFFER_RCP_WIDTH", "(1.0 / BUFFER_WIDTH)"),
                                      {"BUFFER_RCP_HEIGHT", "(1.0 / BUFFER_HEIGHT)"},
                                      {"BUFFER_COLOR_BIT_DEPTH", "8"},
                                      {"BUFFER_COLOR_SPACE", "1"},
                                      {"__RESHADE__", "60000"},
                                      {"__RESHADE_PERFORMANCE_MODE__", "0"},
                                      {"__RENDERER__", "0xb000"},
                                      {"__VENDOR__", "0"},
                                      {"__DEVICE__", "0"},
                                      {"__APPLICATION__", "0"},
                                      {"RESHADE_DEPTH_INPUT_IS_REVERSED", "0"}})
        add(name, value);
}

bool isReshade(const std::vector<Token>& tokens) {
    std::set<std::string_view> functions;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        if (tokens[i].kind != TokenKind::Word) continue;
        if (tokens[i + 1].is('(')) functions.insert(tokens[i].text);
        if (!tokens[i + 1].is('=') || !(tokens[i].is("VertexShader") || tokens[i].is("ComputeShader"))) continue;
        std::size_t end = i + 2;
        while (end < tokens.size() && (tokens[end].kind == TokenKind::Word || tokens[end].is(':')))
            ++end;
        const bool single = end < tokens.size() && (end == i + 3 || tokens[end - 2].is(':'));
        if (single && (tokens[end].is(';') || tokens[end].is('<')) && functions.contains(tokens[end - 1].text)) return true;
    }
    return false;
}

Result<void> rewriteReshade(const fs::path& effect, const PreprocessOptions& options, Preprocessed& view, Sources& sources) {
    return Rewriter(effect, options, view, sources).run();
}

} // namespace tegument
