#include "tools/test/declarations.h"

#include "host/support/text.h"
#include "tools/test/rewrite.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

namespace tegument::testing {

namespace {

constexpr std::uint32_t kDraws = 256; // of random numbers where no input says how many cases there are
constexpr std::uint64_t kMostThreads = 1024;

/// Components of a type that inputs may have; 0: none of them.
std::uint32_t componentsOf(std::string_view type) {
    for (const std::string_view scalar : {"float", "int", "uint", "bool"}) {
        if (type == scalar) return 1;
        const bool vector = type.starts_with(scalar) && type.size() == scalar.size() + 1 && scalar != "bool";
        if (vector && type.back() >= '2' && type.back() <= '4') return static_cast<std::uint32_t>(type.back() - '0');
    }
    return 0;
}

constexpr std::string_view kTakes[][2] = {
    {"tgTexture", "tgTexture(name, \"file.png\"), or tgTexture(name, width, height, { numbers })"},
    {"tgBuffer", "tgBuffer(name, { numbers }), tgBuffer(name, \"file.csv\"), or tgBuffer(name, count)"},
    {"tgConstant", "tgConstant(name, numbers)"},
    {"tgSampler", "tgSampler(name, POINT or LINEAR, WRAP, MIRROR or CLAMP)"}};

} // namespace

std::string textOf(const Tokens& tokens, std::size_t first, std::size_t last) {
    std::string text;
    for (std::size_t i = first; i < last; ++i)
        text += (tokens[i].space && i > first ? " " : "") + std::string(tokens[i].text);
    return text;
}

std::vector<TokenRange> argumentsOf(const Tokens& tokens, const Partners& closing, std::size_t open) {
    std::vector<TokenRange> found;
    const std::size_t close = closing[open];
    for (std::size_t i = open + 1, first = i; i <= close && first < close; ++i) {
        if (tokens[i].is('(') || tokens[i].is('[') || tokens[i].is('{')) {
            i = closing[i];
        } else if (i == close || tokens[i].is(',')) {
            found.push_back({first, i});
            first = i + 1;
        }
    }
    return found;
}

bool isFixture(std::string_view word) {
    return std::ranges::any_of(kTakes, [&](const auto& each) { return each[0] == word; });
}

std::string unquoted(std::string text) {
    return text.size() > 1 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

void DeclarationReader::fail(const Token& at, std::string text, std::string hint) const {
    throw inputError(8203, sources_.position(at), std::move(text), std::move(hint));
}

std::uint32_t DeclarationReader::countIn(const Tokens& tokens, const TokenRange& argument) const {
    const std::string_view text = tokens[argument.first].text;
    std::uint32_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    const bool whole = error == std::errc() && (end == text.data() + text.size() || *end == 'u' || *end == 'U');
    if (argument.last != argument.first + 1 || !whole || count == 0 || count > kMostCases)
        fail(tokens[argument.first], fmt::format("'{}' is no count", textOf(tokens, argument.first, argument.last)),
             fmt::format("write a whole number of 1 to {}", kMostCases));
    return count;
}

/// Braces and the names of vectors only group them.
std::vector<double> DeclarationReader::numbersIn(const Tokens& tokens, TokenRange range) const {
    std::vector<double> numbers;
    for (std::size_t i = range.first; i < range.last; ++i) {
        const Token& token = tokens[i];
        if (token.kind == TokenKind::Number) {
            const double value = std::strtod(std::string(token.text).c_str(), nullptr);
            numbers.push_back(i > range.first && tokens[i - 1].is('-') ? -value : value);
        } else if (token.kind == TokenKind::Word
                       ? !token.text.starts_with("float") && !token.text.starts_with("int") && !token.text.starts_with("uint")
                       : std::string_view("{}(),-+").find(token.text[0]) == std::string_view::npos) {
            fail(token, fmt::format("'{}' is no number", token.text), "fixtures take numbers as they are, without arithmetic or names");
        }
    }
    return numbers;
}

std::filesystem::path DeclarationReader::fileIn(const Token& string) const {
    const std::filesystem::path file = file_.path.parent_path() / unquoted(std::string(string.text));
    std::error_code code;
    if (!std::filesystem::exists(file, code)) fail(string, fmt::format("there is no file {}", file.string()));
    if (!roots_.hold(file)) throw Error{Blame::Input, {outsideOf(file, sources_.position(string))}};
    return file;
}

/// Of tgTexture and tgBuffer, behind the name.
void DeclarationReader::sizes(const Tokens& tokens, std::span<const TokenRange> given, Fixture& made) const {
    const Token& first = tokens[given[0].first];
    if (first.kind == TokenKind::String && given.size() == 1) {
        made.file = fileIn(first);
    } else if (made.kind == "tgBuffer") {
        made.numbers = numbersIn(tokens, given[0]);
        if (!first.is('{')) made.width = countIn(tokens, given[0]);
    } else if (given.size() >= 3) {
        made.width = countIn(tokens, given[0]);
        made.height = countIn(tokens, given[1]);
        made.numbers = numbersIn(tokens, {given[2].first, given.back().last});
        const std::size_t texels = static_cast<std::size_t>(made.width) * made.height;
        if (made.numbers.empty() || made.numbers.size() % texels != 0 || made.numbers.size() / texels > 4)
            fail(first, fmt::format("{} numbers do not fill {} x {} texels", made.numbers.size(), made.width, made.height),
                 "give 1 to 4 numbers for each texel, the top row first");
    }
}

Fixture DeclarationReader::fixture(const Tokens& tokens, const Partners& closing, std::size_t at) const {
    const std::vector<TokenRange> given = argumentsOf(tokens, closing, at + 1);
    Fixture made{.kind = std::string(tokens[at].text), .name = {}, .at = sources_.position(tokens[at])};
    const bool named = given.size() > 1 && given[0].last == given[0].first + 1 && tokens[given[0].first].kind == TokenKind::Word;
    if (named) {
        made.name = tokens[given[0].first].text;
        if (made.kind == "tgConstant") made.numbers = numbersIn(tokens, {given[1].first, given.back().last});
        if (made.kind == "tgTexture" || made.kind == "tgBuffer") sizes(tokens, std::span(given).subspan(1), made);
        for (std::size_t i = 1; i < given.size() && made.kind == "tgSampler"; ++i) {
            made.words.push_back(toLower(textOf(tokens, given[i].first, given[i].last)));
            constexpr std::array kWords = {"point", "linear", "wrap", "mirror", "clamp"};
            if (std::ranges::find(kWords, made.words.back()) == kWords.end()) made.words.clear(), i = given.size();
        }
    }
    if (made.numbers.empty() && made.file.empty() && made.words.empty())
        fail(tokens[at], fmt::format("{} cannot be read", made.kind),
             std::string(std::ranges::find(kTakes, made.kind, [](const auto& each) { return each[0]; })[0][1]));
    return made;
}

std::optional<Fixture> DeclarationReader::defaultOf(const Tokens& tokens, const Partners&, std::size_t first, std::size_t last) const {
    while (first < last && (tokens[first].is("uniform") || tokens[first].is("const")))
        ++first;
    if (last < first + 4 || tokens[first].kind != TokenKind::Word || tokens[first].is("static") ||
        tokens[first + 1].kind != TokenKind::Word)
        return {};
    std::size_t equals = first + 2;
    while (equals < last && !tokens[equals].is('='))
        ++equals;
    for (std::size_t i = equals; i < last; ++i)
        if (tokens[i].kind == TokenKind::String || (tokens[i].kind == TokenKind::Word && componentsOf(tokens[i].text) == 0)) return {};
    if (equals + 1 >= last) return {};
    Fixture made{.kind = "tgConstant", .name = std::string(tokens[first + 1].text), .at = sources_.position(tokens[first])};
    made.isDefault = true;
    try {
        made.numbers = numbersIn(tokens, {equals + 1, last - 1});
    } catch (const Error&) {
        return {}; // arithmetic: the value has to be given
    }
    return made.numbers.empty() ? std::optional<Fixture>() : made;
}

std::array<std::uint32_t, 3> DeclarationReader::groupOf(const Tokens& tokens, std::size_t at, std::size_t close) const {
    std::array<std::uint32_t, 3> group = {0, 1, 1};
    std::size_t axis = 0;
    for (std::size_t i = at + 4; i < close && axis < 3; i += 2)
        group[axis++] = countIn(tokens, {i, i + 1});
    if (group[0] == 0 || static_cast<std::uint64_t>(group[0]) * group[1] * group[2] > kMostThreads)
        fail(tokens[at], fmt::format("TG_GROUP_TEST needs the threads of its group, at most {}", kMostThreads),
             "TG_GROUP_TEST(name, 64) { ... }");
    return group;
}

void DeclarationReader::start(Test& test) {
    test_ = &test;
    dimensions_.clear();
    inputs_ = 0;
    draws_ = 0;
}

DeclarationReader::Dimension& DeclarationReader::dimension(const Token& at, std::uint32_t count, std::string table) {
    std::uint64_t stride = 1;
    for (const Dimension& each : dimensions_)
        stride *= each.count;
    if (stride * count > kMostCases)
        fail(at, fmt::format("the inputs make {} cases, and {} are the most", stride * count, kMostCases),
             "inputs of one test are combined");
    dimensions_.push_back({.table = std::move(table), .count = count, .stride = static_cast<std::uint32_t>(stride), .content = {}});
    return dimensions_.back();
}

std::string DeclarationReader::fromTable(const Tokens& tokens, const std::vector<TokenRange>& given, const std::string& type) {
    const Token& named = tokens[given[0].first];
    if (given.size() > 2 || named.kind != TokenKind::String) fail(named, "tgTable takes a file and a column", "tgTable(\"file.csv\", 0)");
    const std::filesystem::path path = fileIn(named);
    auto found = std::ranges::find(dimensions_, path.string(), &Dimension::table);
    if (found == dimensions_.end()) {
        auto table = readTable(path);
        if (!table) throw Error(table.error());
        if (table->rows() > kMostCases) fail(named, fmt::format("the table has {} rows, and {} are the most", table->rows(), kMostCases));
        dimension(named, static_cast<std::uint32_t>(table->rows()), path.string());
        found = dimensions_.end() - 1;
        found->start = test_->table.size();
        for (const double number : table->numbers)
            test_->table.push_back(static_cast<float>(number));
        found->content = std::move(*table);
    }
    std::size_t column = 0;
    if (given.size() > 1 && tokens[given[1].first].kind == TokenKind::String) {
        const std::vector<std::string>& names = found->content.names;
        const std::string name = unquoted(std::string(tokens[given[1].first].text));
        column = static_cast<std::size_t>(std::ranges::find(names, name) - names.begin());
        if (column == names.size())
            fail(tokens[given[1].first], fmt::format("the table has no column '{}'", name), fmt::format("{}", fmt::join(names, ", ")));
    } else if (given.size() > 1 && !tokens[given[1].first].is("0")) {
        column = tokens[given[1].first].text == "0" ? 0 : countIn(tokens, given[1]);
    }
    const std::uint32_t components = componentsOf(type);
    if (column + components > found->content.columns)
        fail(named,
             fmt::format("{} reads columns {} to {}, and the table has {}", type, column, column + components - 1, found->content.columns));
    std::string code;
    for (std::uint32_t c = 0; c < components; ++c)
        code += fmt::format("{}tgTestTable[{}u + tgTestDigit({}u, {}u) * {}u]", c == 0 ? "" : ", ", found->start + column + c,
                            found->stride, found->count, found->content.columns);
    return fmt::format("{}({})", type, code);
}

std::optional<DeclarationReader::Input> DeclarationReader::input(const Tokens& tokens, const Partners& closing, std::size_t first,
                                                                 std::size_t last, bool inTest) {
    if (tokens[first].is("const")) ++first;
    if (last < first + 6 || !tokens[first + 2].is('=') || !tokens[first + 4].is('(')) return {};
    const Token& word = tokens[first + 3];
    if (!word.is("tgRange") && !word.is("tgRandom") && !word.is("tgCases") && !word.is("tgTable") && !word.is("tgReference")) return {};
    const std::string type(tokens[first].text);
    const std::string name(tokens[first + 1].text);
    if (!inTest) fail(word, "an input stands in a test");
    if (componentsOf(type) == 0) fail(tokens[first], fmt::format("an input cannot be a {}", type), "float, int, uint, their vectors, bool");
    const std::vector<TokenRange> given = argumentsOf(tokens, closing, first + 4);
    const auto text = [&](std::size_t a) { return textOf(tokens, given[a].first, given[a].last); };
    ++inputs_;
    if (word.is("tgTable") && !given.empty())
        return Input{first + 1, fmt::format("{} {} = {};", type, name, fromTable(tokens, given, type))};
    if (word.is("tgReference") && given.size() > 1 && tokens[given[0].first].kind == TokenKind::String) {
        const auto count = static_cast<std::uint32_t>(given.size() - 1);
        test_->references.push_back({unquoted(text(0)), sources_.position(word), test_->properties, count, componentsOf(type)});
        std::string code;
        for (std::size_t a = 1; a < given.size(); ++a) {
            const bool literal = tokens[given[a].first].kind == TokenKind::Number;
            code += fmt::format("tgTestRecord({}u, tgTestOf({}({})), 0.0); ", test_->properties++, literal ? "float" : "", text(a));
        }
        code += fmt::format("{} {} = {}(tgTestGiven(tgTestPlace({}u)).{});", type, name, type, test_->properties++,
                            std::string_view("xyzw").substr(0, componentsOf(type)));
        return Input{first + 1, std::move(code)};
    }
    if (word.is("tgCases") && !given.empty()) {
        const Dimension& of = dimension(word, static_cast<std::uint32_t>(given.size()));
        std::string list;
        for (std::size_t a = 0; a < given.size(); ++a)
            list += (a == 0 ? "" : ", ") + text(a);
        return Input{first + 1, fmt::format("{0} tgTestCases{1}[{2}] = {{ {3} }}; {0} {4} = tgTestCases{1}[tgTestDigit({5}u, {2}u)];", type,
                                            inputs_, given.size(), list, name, of.stride)};
    }
    if (word.is("tgRange") && given.size() == 3) {
        const std::uint32_t count = countIn(tokens, given[2]);
        const Dimension& of = dimension(word, count);
        return Input{
            first + 1,
            fmt::format(
                "{0} {1} = ({0})({2}); {{ const {0} tgTestHigh = ({0})({3}); const uint tgTestStep = tgTestDigit({4}u, {5}u); "
                "if (tgTestStep == {6}u) {1} = tgTestHigh; else {1} = ({0})({1} + (tgTestHigh - {1}) * (float(tgTestStep) / {6}.0)); }}",
                type, name, text(0), text(1), of.stride, count, std::max(count, 2U) - 1)};
    }
    if (word.is("tgRandom") && (given.size() == 2 || given.size() == 3)) {
        if (given.size() == 3) draws_ = std::max(draws_, countIn(tokens, given[2]));
        std::string units;
        const std::uint32_t components = componentsOf(type);
        for (std::uint32_t c = 0; c < components; ++c)
            units += fmt::format("{}tgTestUnit({}u, {}u)", c == 0 ? "" : ", ", inputs_, c);
        draws_ = std::max(draws_, 1U);
        return Input{first + 1, fmt::format("{0} {1} = ({0})(({0})({2}) + (({0})({3}) - ({0})({2})) * float{4}({5}));", type, name, text(0),
                                            text(1), components == 1 ? "" : std::to_string(components), units)};
    }
    fail(word, fmt::format("{} cannot be read", word.text),
         "tgCases(values), tgRange(low, high, count), tgRandom(low, high), tgTable(\"file.csv\", column) or tgReference(\"name\", x)");
}

std::optional<Error> DeclarationReader::finish(Test& test) const {
    std::uint64_t cases = 1;
    for (const Dimension& each : dimensions_)
        cases *= each.count;
    if (!dimensions_.empty()) test.row = dimensions_.front().count;
    const std::uint32_t drawn = draws_ == 1 && cases == 1 ? kDraws : draws_;
    test.cases = static_cast<std::uint32_t>(std::max<std::uint64_t>(cases, drawn));
    if (test.group[0] != 0 && test.cases > kMostGroups)
        return inputError(8203, test.at, fmt::format("{} groups, and {} are the most", test.cases, kMostGroups), "take fewer cases");
    return {};
}

} // namespace tegument::testing
