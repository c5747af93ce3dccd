// USD as text: BasisCurves with what stands above them. Of the language only what such files hold; anything else is passed over.

#include "meshprep/groom/formats.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>

namespace tegument::groomfile {

using namespace meshfile;

namespace {

constexpr int kDeepestPrim = 64; // prims in prims
constexpr std::size_t kMostOperations = 32;

/// What a prim says under one name: numbers, one after the other, or a word.
struct Told {
    std::vector<double> numbers;
    std::vector<std::string> words;
};

struct Prim {
    std::string type;
    std::map<std::string, Told, std::less<>> values;

    [[nodiscard]] std::string word(std::string_view name, std::string absent) const {
        const auto found = values.find(name);
        return found == values.end() || found->second.words.empty() ? std::move(absent) : found->second.words.front();
    }
    [[nodiscard]] const std::vector<double>& numbers(std::string_view name) const {
        static const std::vector<double> none;
        const auto found = values.find(name);
        return found == values.end() ? none : found->second.numbers;
    }
};

class UsdaReader {
public:
    UsdaReader(const Source& source, std::size_t frame) : source_(source), frame_(frame) {}

    Result<Groom> read() {
        if (!source_.bytes.starts_with("#usda")) return malformed(source_.atByte(0), "the file does not start with #usda");
        groom_.unitMm = 10; // as USD has it where nothing is said
        Prim stage;
        if (peek() == '(') readMetadata(stage);
        if (const auto& unit = stage.numbers("metersPerUnit"); !unit.empty()) groom_.unitMm = 1000 * unit.front();
        groom_.zIsUp = stage.word("upAxis", "Y") == "Z";
        while (!error_ && peek() != 0)
            readStatement(stage, glm::dmat4(1), 0);
        if (!error_ && !(groom_.unitMm > 0 && std::isfinite(groom_.unitMm))) fail(malformed(source_.whole(), "metersPerUnit is no length"));
        if (error_) return *error_;
        if (otherFrames_ > 0)
            ignored(groom_, source_, fmt::format("of {} frames one is read", otherFrames_ + 1), "--frame chooses another");
        if (!unread_.empty()) ignored(groom_, source_, fmt::format("its '{}' is not read", unread_));
        return std::move(groom_);
    }

private:
    void fail(Error error) {
        if (!error_) error_ = std::move(error);
        at_ = source_.bytes.size();
    }
    void wrong(const std::string& text) { fail(malformed(source_.atLine(line_), text, "write the file again, as text of USD 1.0")); }

    /// The next byte that is no space and in no comment; 0 at the end.
    char peek() {
        while (at_ < source_.bytes.size()) {
            const char c = source_.bytes[at_];
            if (c == '#')
                at_ = std::min(source_.bytes.find('\n', at_), source_.bytes.size());
            else if (c == '\n' || c == ' ' || c == '\t' || c == '\r' || c == ';') {
                line_ += c == '\n';
                ++at_;
            } else
                return c;
        }
        return 0;
    }
    bool take(char c) {
        if (peek() != c) return false;
        ++at_;
        return true;
    }
    /// Up to what ends a word or number.
    std::string_view word() {
        peek();
        static const std::array<bool, 256> kEnds = [] {
            std::array<bool, 256> ends{};
            for (const char c : std::string_view(" \t\r\n=()[]{},;\"#<@"))
                ends[static_cast<unsigned char>(c)] = true;
            return ends;
        }();
        std::size_t end = at_;
        while (end < source_.bytes.size() && !kEnds[static_cast<unsigned char>(source_.bytes[end])])
            ++end;
        const std::string_view found = source_.bytes.substr(at_, end - at_);
        at_ = end;
        return found;
    }
    std::string quoted() {
        peek();
        const char mark = source_.bytes[at_];
        const bool three = source_.bytes.substr(at_, 3) == std::string(3, mark);
        const std::string end(three ? 3 : 1, mark == '<' ? '>' : mark);
        const std::size_t from = at_ + end.size();
        std::size_t to = source_.bytes.find(end, from);
        while (to != std::string_view::npos && to > from && mark == '"' && source_.bytes[to - 1] == '\\')
            to = source_.bytes.find(end, to + 1);
        if (to == std::string_view::npos) {
            fail(truncated(source_.atLine(line_), "a text in quotes does not end"));
            return {};
        }
        line_ += static_cast<int>(std::count(source_.bytes.begin() + static_cast<std::ptrdiff_t>(at_),
                                             source_.bytes.begin() + static_cast<std::ptrdiff_t>(to), '\n'));
        at_ = to + end.size();
        return std::string(source_.bytes.substr(from, std::min<std::size_t>(to - from, 256)));
    }

    /// A value of any shape: what it holds of numbers and words, in order. Dictionaries are passed over.
    void readValue(Told* value) {
        int depth = 0;
        do {
            const char c = peek();
            if (c == 0) return fail(truncated(source_.atLine(line_), "a value does not end"));
            if (c == '[' || c == '(' || c == '{') {
                ++depth;
                ++at_;
            } else if (c == ']' || c == ')' || c == '}') {
                if (depth == 0) return wrong(fmt::format("'{}' stands where a value should", c));
                --depth;
                ++at_;
            } else if (c == ',' || c == '=') {
                ++at_;
            } else if (c == '"' || c == '\'' || c == '<' || c == '@') {
                std::string text = quoted();
                if (value && !error_) value->words.push_back(std::move(text));
            } else {
                const std::string_view text = word();
                double number = 0;
                if (text.empty()) return wrong(fmt::format("'{}' is not understood", c));
                if (!value || text.ends_with(':')) continue;
                if (parseReal(text, number))
                    value->numbers.push_back(number);
                else
                    value->words.emplace_back(text.substr(0, 256));
            }
        } while (depth > 0 && !error_);
    }

    /// In parentheses: names and values, one after the other, and texts without a name.
    void readMetadata(Prim& prim) {
        ++at_;
        while (!error_ && !take(')')) {
            if (const char c = peek(); c == 0)
                return fail(truncated(source_.atLine(line_), "a parenthesis does not close"));
            else if (c == '"' || c == '\'') {
                quoted();
                continue;
            }
            std::string name;
            while (!error_ && peek() != '=' && peek() != ')' && peek() != 0) {
                name = word();
                if (name.empty()) return wrong(fmt::format("'{}' is not understood", peek()));
            }
            if (take('=')) readValue(&prim.values[name]);
        }
    }

    /// `{ 1: value, 2: value }`: the sample that is asked for, or the last.
    void readSamples(Told& value) {
        if (!take('{')) return wrong("timeSamples need a list in braces");
        for (std::size_t i = 0; !error_ && !take('}'); ++i) {
            if (take(',')) {
                --i;
                continue;
            }
            word(); // its time
            take(':');
            if (peek() == 0) return fail(truncated(source_.atLine(line_), "a brace does not close"));
            Told sample;
            readValue(&sample);
            if (i <= frame_) value = std::move(sample);
            frames_ = std::max(frames_, i);
        }
    }

    void readStatement(Prim& prim, const glm::dmat4& above, int depth) {
        std::string name;
        if (peek() == '"') return void(quoted());
        std::string_view first = word();
        if (first.empty()) return wrong(fmt::format("'{}' is not understood", peek()));
        if (first == "def" || first == "over" || first == "class") return readPrim(first == "def", above * own(prim), depth);
        if (first == "variantSet") {
            unread_ = "variantSet";
            quoted();
            if (take('=')) readValue(nullptr);
            return;
        }
        // Words up to '=', the last of which is the name: "uniform token basis", "point3f[] points".
        while (!error_) {
            const char c = peek();
            if (c == '[') {
                ++at_;
                if (!take(']')) return wrong("a type's brackets are not empty");
                continue;
            }
            const bool more = (std::isalnum(static_cast<unsigned char>(c)) != 0) || c == '_';
            if (!more) break;
            first = word();
        }
        name = first;
        const bool sampled = name.ends_with(".timeSamples");
        if (take('=')) {
            if (sampled)
                readSamples(prim.values[name.substr(0, name.size() - 12)]);
            else if (auto& value = prim.values[name]; value.numbers.empty())
                readValue(&value);
            else
                readValue(nullptr); // samples are there
        }
        if (Prim unused; peek() == '(') readMetadata(unused);
    }

    void readPrim(bool defined, const glm::dmat4& above, int depth) {
        if (depth >= kDeepestPrim) return wrong("prims stand too deep in each other");
        Prim prim;
        if (peek() != '"') prim.type = word();
        if (peek() != '"') return wrong("a prim has no name");
        quoted();
        if (Prim unused; peek() == '(') readMetadata(unused);
        if (!take('{')) return wrong("a prim has no body");
        // Its own values stand before its children, as every writer has it.
        while (!error_ && !take('}')) {
            if (peek() == 0) return fail(truncated(source_.atLine(line_), "a brace does not close"));
            readStatement(prim, above, depth + 1);
        }
        if (!error_ && defined && prim.type == "BasisCurves") addCurves(prim, above * own(prim));
        if (!error_ && (prim.type == "NurbsCurves" || prim.type == "HermiteCurves" || prim.type == "PointInstancer")) unread_ = prim.type;
    }

    /// What the operations of a prim make of its points.
    glm::dmat4 own(const Prim& prim) {
        glm::dmat4 matrix(1);
        const auto order = prim.values.find("xformOpOrder");
        if (order == prim.values.end()) return matrix;
        if (order->second.words.size() > kMostOperations) wrong("a prim has too many transforms");
        for (const std::string& operation : order->second.words) {
            if (error_) break;
            const std::vector<double>& v = prim.numbers(operation);
            const auto is = [&](std::string_view kind) { return operation.starts_with("xformOp:" + std::string(kind)); };
            if (is("transform") && v.size() == 16) {
                glm::dmat4 given;
                for (glm::length_t i = 0; i < 16; ++i)
                    given[i / 4][i % 4] = v[static_cast<std::size_t>(i)]; // rows of USD are columns of GLM
                matrix *= given;
            } else if (is("translate") && v.size() == 3) {
                matrix = glm::translate(matrix, glm::dvec3(v[0], v[1], v[2]));
            } else if (is("scale") && v.size() == 3) {
                matrix = glm::scale(matrix, glm::dvec3(v[0], v[1], v[2]));
            } else if (is("rotateXYZ") && v.size() == 3) {
                for (const glm::length_t axis : {2, 1, 0}) {
                    glm::dvec3 about(0);
                    about[axis] = 1;
                    matrix = glm::rotate(matrix, glm::radians(v[static_cast<std::size_t>(axis)]), about);
                }
            } else if ((is("rotateX") || is("rotateY") || is("rotateZ")) && v.size() == 1) {
                glm::dvec3 about(0);
                about[operation[14] - 'X'] = 1;
                matrix = glm::rotate(matrix, glm::radians(v.front()), about);
            } else {
                fail(unsupported(source_.atLine(line_), fmt::format("the operation '{}' is not read", operation.substr(0, 60)),
                                 "apply transforms before the file is written"));
            }
        }
        return matrix;
    }

    template <class Vector>
    static std::vector<Vector> vectors(const std::vector<double>& numbers) {
        std::vector<Vector> list;
        constexpr auto n = static_cast<std::size_t>(Vector::length());
        for (std::size_t i = 0; i + n <= numbers.size(); i += n) {
            Vector v;
            for (std::size_t k = 0; k < n; ++k)
                v[static_cast<glm::length_t>(k)] = static_cast<float>(numbers[i + k]);
            list.push_back(v);
        }
        return list;
    }

    /// Values that fit neither points nor strands are passed over, and said.
    template <class Target, class Taken>
    void keep(const char* name, Target& target, Taken taken) {
        if (taken)
            target = *std::move(taken);
        else
            unread_ = name;
    }

    void addCurves(const Prim& prim, const glm::dmat4& matrix) {
        Groom curves;
        const std::string type = prim.word("type", "cubic"), basis = prim.word("basis", "bezier"), wrap = prim.word("wrap", "nonperiodic");
        const std::map<std::string, Spline, std::less<>> kSplines = {
            {"bezier", Spline::Bezier}, {"bspline", Spline::BSpline}, {"catmullRom", Spline::CatmullRom}};
        const auto spline = kSplines.find(basis);
        if (wrap == "periodic" || (type != "linear" && spline == kSplines.end()))
            return fail(unsupported(source_.atLine(line_), fmt::format("curves of basis '{}' and wrap '{}' are not read", basis, wrap),
                                    "export open curves: linear, bezier, bspline or catmullRom"));
        curves.spline = type == "linear" ? Spline::Linear : spline->second;
        curves.pinned = wrap == "pinned" && (curves.spline == Spline::BSpline || curves.spline == Spline::CatmullRom);
        curves.points = vectors<glm::vec3>(prim.numbers("points"));
        std::size_t sum = 0;
        for (const double count : prim.numbers("curveVertexCounts")) {
            if (!(count >= 0 && count <= static_cast<double>(curves.points.size() - sum)) || count != std::floor(count))
                return fail(
                    overclaimed(source_.atLine(line_), fmt::format("its curves have more than its {} points", curves.points.size())));
            sum += static_cast<std::size_t>(count);
            curves.first.push_back(static_cast<std::uint32_t>(sum));
        }
        if (sum != curves.points.size())
            return fail(overclaimed(source_.atLine(line_), fmt::format("its curves have {} of its {} points", sum, curves.points.size())));
        if (sum == 0) return;
        if (const auto& widths = prim.numbers("widths"); !widths.empty())
            keep("widths", curves.widths, toPoints(curves, std::vector<float>(widths.begin(), widths.end())));
        if (const auto& colors = prim.numbers("primvars:displayColor"); !colors.empty())
            keep("primvars:displayColor", curves.colors, toPoints(curves, vectors<glm::vec3>(colors)));
        for (const char* name : {"primvars:st", "primvars:groom_root_uv"})
            if (const auto& uvs = prim.numbers(name); !uvs.empty()) keep(name, curves.rootUvs, toStrands(curves, vectors<glm::vec2>(uvs)));
        const std::pair<const char*, std::vector<std::int32_t>*> lists[] = {
            {"primvars:groom_id", &curves.ids}, {"primvars:groom_guide", &curves.guides}, {"primvars:groom_clumpid", &curves.clumps}};
        for (const auto& [name, list] : lists)
            if (const auto& numbers = prim.numbers(name); !numbers.empty()) {
                std::vector<std::int32_t> whole;
                for (const double n : numbers)
                    whole.push_back(static_cast<std::int32_t>(std::clamp(n, -2147483648.0, 2147483647.0)));
                keep(name, *list, toStrands(curves, std::move(whole)));
            }
        otherFrames_ = std::max(otherFrames_, frames_);
        transform(curves, matrix);
        merge(groom_, std::move(curves), source_);
    }

    const Source& source_;
    std::size_t frame_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::optional<Error> error_;
    Groom groom_;
    std::string unread_;
    std::size_t frames_ = 0; // samples but one
    std::size_t otherFrames_ = 0;
};

template <class Value, class Text>
void writeList(std::string& text, const char* declaration, const std::vector<Value>& values, const char* interpolation, Text&& one) {
    if (values.empty()) return;
    text += fmt::format("    {} = [", declaration);
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i > 0) text += ", ";
        one(values[i]);
    }
    text += interpolation ? fmt::format("] (\n        interpolation = \"{}\"\n    )\n", interpolation) : "]\n";
}

} // namespace

Result<Groom> readUsda(const Source& source, std::size_t frame) {
    return UsdaReader(source, frame).read();
}

std::string writeUsda(const Groom& groom) {
    constexpr std::array<const char*, 4> kBases = {"", "bezier", "bspline", "catmullRom"};
    std::string text = fmt::format(
        "#usda 1.0\n(\n    doc = \"Tegument\"\n    defaultPrim = \"groom\"\n    metersPerUnit = {:.9g}\n    upAxis = \"{}\"\n)\n\n"
        "def BasisCurves \"groom\"\n{{\n",
        groom.unitMm / 1000, groom.zIsUp ? "Z" : "Y");
    auto to = std::back_inserter(text);
    const auto number = [&](auto n) { fmt::format_to(to, "{}", n); };
    const auto real = [&](float v) { fmt::format_to(to, "{:.9g}", v); };
    const auto vector = [&](const auto& v) {
        for (glm::length_t i = 0; i < v.length(); ++i) {
            text += i == 0 ? "(" : ", ";
            real(v[i]);
        }
        text += ")";
    };
    text += groom.spline == Spline::Linear ? "    uniform token type = \"linear\"\n"
                                           : fmt::format("    uniform token type = \"cubic\"\n    uniform token basis = \"{}\"\n",
                                                         kBases[static_cast<std::size_t>(groom.spline)]);
    if (groom.pinned) text += "    uniform token wrap = \"pinned\"\n";
    std::vector<std::size_t> counts;
    for (std::size_t i = 0; i < groom.strands(); ++i)
        counts.push_back(groom.length(i));
    writeList(text, "int[] curveVertexCounts", counts, nullptr, number);
    writeList(text, "point3f[] points", groom.points, nullptr, vector);
    writeList(text, "float[] widths", groom.widths, "vertex", real);
    writeList(text, "color3f[] primvars:displayColor", groom.colors, "vertex", vector);
    writeList(text, "texCoord2f[] primvars:st", groom.rootUvs, "uniform", vector);
    writeList(text, "int[] primvars:groom_id", groom.ids, "uniform", number);
    writeList(text, "int[] primvars:groom_guide", groom.guides, "uniform", number);
    writeList(text, "int[] primvars:groom_clumpid", groom.clumps, "uniform", number);
    return text + "}\n";
}

} // namespace tegument::groomfile
