#include "meshprep/adopt/wrapper.h"

#include "host/effect/constants.h"
#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>

namespace tegument::adopt {

namespace {

/// A number or a vector inside the parameters of an entry point.
struct Leaf {
    std::string path; // `input.uv[1]`
    Shape shape;
    std::string semantic; // upper case, without its index
    int index = 0;
    std::string modifiers;    // nointerpolation and the like
    std::string type;         // as written
    std::optional<int> row{}; // of a matrix
};

/// Direct3D 10's layouts name streams freely: "POS" is POSITION0, "TEX1" TEXCOORD1.
std::string usualStream(const std::string& key) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 21> kOthers{
        {{"POS", "POSITION"},   {"VERTEX", "POSITION"},     {"VERTEXPOSITION", "POSITION"},
         {"NORM", "NORMAL"},    {"NRM", "NORMAL"},          {"NORMALS", "NORMAL"},
         {"TEX", "TEXCOORD"},   {"TEXTURE", "TEXCOORD"},    {"TEXCOORDS", "TEXCOORD"},
         {"TEXUV", "TEXCOORD"}, {"UV", "TEXCOORD"},         {"TC", "TEXCOORD"},
         {"TAN", "TANGENT"},    {"TANG", "TANGENT"},        {"BINORM", "BINORMAL"},
         {"BITAN", "BINORMAL"}, {"COL", "COLOR"},           {"COLOUR", "COLOR"},
         {"DIFFUSE", "COLOR"},  {"WEIGHTS", "BLENDWEIGHT"}, {"WEIGHT", "BLENDWEIGHT"}}};
    const std::size_t digits = key.find_last_not_of("0123456789") + 1;
    const auto* found =
        std::ranges::find(kOthers, std::string_view(key).substr(0, digits), &std::pair<std::string_view, std::string_view>::first);
    return found == kOthers.end() ? key : std::string(found->second) + key.substr(digits);
}

/// In one line, with the author's spaces and those without which two words would be one.
std::string textOf(const Words& words) {
    const auto isWord = [](const Word& word) { return word.kind == TokenKind::Word || word.kind == TokenKind::Number; };
    std::string text;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (i > 0 && (words[i].space || (isWord(words[i]) && isWord(words[i - 1])))) text += ' ';
        text += words[i].text;
    }
    return text;
}

constexpr const char* kFog = "FOG0";
constexpr std::string_view kCentroid = "_CENTROID"; // behind a semantic: where samples are taken

const char* firstComponents(int count) {
    constexpr std::array kSwizzles{"", ".x", ".xy", ".xyz", ""};
    return kSwizzles[static_cast<std::size_t>(std::clamp(count, 0, 4))];
}

std::string typeText(const std::string& scalar, int columns) {
    return columns > 1 ? fmt::format("{}{}", scalar, columns) : scalar;
}

bool isSystem(std::string_view semantic) {
    return semantic.starts_with("SV_");
}

bool isPosition(const Leaf& leaf) {
    return leaf.index == 0 && (leaf.semantic == "POSITION" || leaf.semantic == "SV_POSITION" || leaf.semantic == "POSITIONT");
}

int arrayCount(const Words& array) {
    Constant count{.numbers = {array.empty() ? 0.0 : 1.0}, .integral = true};
    std::string op = "*";
    for (const Word& word : array)
        if (word.kind == TokenKind::Number)
            count = applyOperator(op, count, {.numbers = {std::atof(word.text.c_str())}, .integral = true}).value_or(count);
        else if (word.is("*") || word.is("/") || word.is("+") || word.is("-"))
            op = word.text;
    return static_cast<int>(count.numbers[0]);
}

class Wrapping {
public:
    explicit Wrapping(const WrapperJob& job)
        : job_(job),
          profile_(profileOf(job.shader.profile)), spelling_{.code = &job.code, .legacy = profile_.direct3D9(), .renamed = &job.renamed} {}

    Result<Wrapper> run() {
        const Function* function = chosen();
        if (!function) return error(3401, fmt::format("there is no function '{}' with a body", job_.shader.entry));
        for (const Variable& parameter : function->parameters)
            if (const auto done = take(parameter); !done) return done.error();
        std::string call = fmt::format("{}({})", spelt(function->name.text), fmt::join(call_, ", "));
        if (function->typeName() == "void") {
            before_.push_back(call + ";");
        } else {
            before_.push_back(fmt::format("{} tg_result = {};", textOf(spelling_.respelt(function->type)), call));
            Variable result{.type = function->type, .name = Word{}, .semantic = function->semantic};
            auto leaves = flatten(result, "tg_result");
            results_.insert(results_.begin(), leaves.begin(), leaves.end());
        }
        for (const Leaf& leaf : results_)
            if (const auto done = give(leaf); !done) return done.error();
        finish();
        return std::move(made_);
    }

private:
    [[nodiscard]] Error error(int code, std::string text, std::string hint = {}) const {
        return inputError(code, job_.shader.at, std::move(text), std::move(hint));
    }

    std::string spelt(const std::string& name) const {
        const Words words = spelling_.respelt({Word{.text = name, .kind = TokenKind::Word}});
        return words[0].text;
    }

    /// Of several functions of that name the one with as many uniform parameters as the pass gives arguments, else the last.
    [[nodiscard]] const Function* chosen() const {
        const auto functions = job_.code.functions(job_.shader.entry);
        for (const Function* function : functions) {
            const auto uniforms = std::ranges::count_if(function->parameters, [](const Variable& p) { return p.has("uniform"); });
            if (static_cast<std::size_t>(uniforms) == job_.shader.arguments.size()) return function;
        }
        return functions.empty() ? nullptr : functions.back();
    }

    /// Compile arguments are words of the author's, as literals or as expressions of his constants.
    std::optional<std::string> argument(const Variable& parameter) {
        if (argument_ < job_.shader.arguments.size()) {
            const Code words = readCode("x = " + job_.shader.arguments[argument_++] + ";");
            Words list;
            for (const Item& item : words.items)
                if (const auto* other = std::get_if<Other>(&item)) list = other->words;
            if (list.size() > 3) return textOf(spelling_.respelt({list.begin() + 2, list.end() - 1}));
        }
        if (!parameter.initial.empty()) return textOf(spelling_.respelt(parameter.initial));
        return std::nullopt;
    }

    Result<void> take(const Variable& parameter) {
        const Words type = job_.code.resolved(parameter.type);
        const bool structure = job_.code.structure(type.front().text) != nullptr;
        const bool constant = parameter.has("uniform") || (parameter.semantic.empty() && !structure && !parameter.has("out"));
        if (constant) {
            const auto value = argument(parameter);
            if (!value)
                return error(3402, fmt::format("nothing gives {} of {} a value", parameter.name.text, job_.shader.entry),
                             "give it a semantic, or an argument where it is compiled");
            call_.push_back(*value);
            return {};
        }
        const std::string local = "tg_" + parameter.name.text;
        const std::string typeName = textOf(spelling_.respelt(type));
        before_.push_back(
            fmt::format("{} {}{}{};", typeName, local, textOf(parameter.array), structure ? fmt::format(" = ({})0", typeName) : ""));
        call_.push_back(local);
        const std::vector<Leaf> leaves = flatten(parameter, local);
        const bool out = parameter.has("out") || parameter.has("inout");
        if (!parameter.has("out"))
            for (const Leaf& leaf : leaves)
                receive(leaf);
        if (out) results_.insert(results_.end(), leaves.begin(), leaves.end());
        return {};
    }

    std::vector<Leaf> flatten(const Variable& variable, const std::string& path, const std::string& outer = {}, int depth = 0) const {
        constexpr int kDeepest = 16;
        std::vector<Leaf> leaves;
        const Words type = job_.code.resolved(variable.type);
        std::string semantic = variable.semantic.empty() ? outer : variable.semantic;
        if (upper(semantic).ends_with(kCentroid)) semantic.resize(semantic.size() - kCentroid.size());
        if (const Structure* structure = job_.code.structure(type.front().text); structure && depth < kDeepest) {
            for (const Variable& member : structure->members) {
                const auto more = flatten(member, path + "." + spelt(member.name.text), {}, depth + 1);
                leaves.insert(leaves.end(), more.begin(), more.end());
            }
            return leaves;
        }
        const auto shape = shapeOf(type);
        if (!shape || semantic.empty()) return leaves;
        const std::size_t digits = semantic.find_last_not_of("0123456789") + 1;
        Leaf leaf{.path = path, .shape = *shape, .semantic = upper(semantic.substr(0, digits)), .type = textOf(spelling_.respelt(type))};
        if (digits < semantic.size()) leaf.index = std::atoi(semantic.c_str() + digits);
        for (const std::string_view modifier : {"nointerpolation", "noperspective", "centroid", "linear", "sample"})
            if (variable.has(modifier)) leaf.modifiers += std::string(modifier) + " ";
        const int elements = std::max(arrayCount(variable.array), 1);
        for (int i = 0; i < elements; ++i)
            for (int row = 0; row < shape->rows; ++row) {
                Leaf part = leaf;
                if (!variable.array.empty()) part.path += fmt::format("[{}]", i);
                if (shape->matrix) {
                    part.path += fmt::format("[{}]", row);
                    part.row = row;
                }
                part.shape.rows = 1;
                part.index = leaf.index + i * shape->rows + row;
                leaves.push_back(std::move(part));
            }
        return leaves;
    }

    std::string declareInput(const std::string& type, const std::string& semantic, const std::string& modifiers = {}) {
        const std::string name = fmt::format("i{}", made_.inputs.size() + systems_);
        signature_.push_back(fmt::format("{}{} {} : {}", modifiers, type, name, semantic));
        return name;
    }

    void assign(const Leaf& leaf, const std::string& value) { before_.push_back(fmt::format("{} = {};", leaf.path, value)); }

    void receive(const Leaf& leaf) {
        const std::string key = fmt::format("{}{}", leaf.semantic, leaf.index);
        const std::string cast = fmt::format("({})", typeText(leaf.shape.scalar, leaf.shape.columns));
        if (!job_.vertex && receiveSystem(leaf, cast)) return;
        if (isSystem(leaf.semantic) && !(job_.vertex && leaf.semantic == "SV_POSITION")) {
            const auto name = declareInput(leaf.type, leaf.semantic);
            ++systems_;
            return assign(leaf, name);
        }
        if (const auto row = rowOfInstance(leaf)) {
            if (*row == 0) made_.standIns.push_back(fmt::format("{} is the identity: one instance", usualStream(key)));
            constexpr std::array kRows{"float4(1, 0, 0, 0)", "float4(0, 1, 0, 0)", "float4(0, 0, 1, 0)", "float4(0, 0, 0, 1)"};
            return assign(leaf, fmt::format("{}({}{})", cast, kRows[static_cast<std::size_t>(*row)], firstComponents(leaf.shape.columns)));
        }
        const bool integral = leaf.shape.scalar != "float" && !profile_.direct3D9();
        if (const auto known = inputs_.find(key); known != inputs_.end())
            return assign(leaf, fmt::format("{}({}{})", cast, known->second, firstComponents(leaf.shape.columns)));
        std::string name;
        if (job_.vertex && leaf.shape.scalar.ends_with("int") && usualStream(key).starts_with("TEXCOORD")) { // numbers a bone
            made_.standIns.push_back(fmt::format("{} is zero", usualStream(key)));
            name = "float4(0, 0, 0, 0)";
        } else if (job_.vertex) {
            name = vertexInput(key);
        } else if (const Port* port = provided(key); !port) {
            name = key.starts_with("COLOR") ? "float4(1, 1, 1, 1)" : "float4(0, 0, 0, 0)";
        } else {
            const std::string type = port->type == "float4" && integral ? fmt::format("{}4", leaf.shape.scalar) : port->type;
            const bool flat = type != "float4";
            name = declareInput(type, key, flat ? "nointerpolation " : leaf.modifiers);
            made_.inputs.push_back({key, type});
        }
        inputs_[key] = name;
        assign(leaf, fmt::format("{}({}{})", cast, name, firstComponents(leaf.shape.columns)));
    }

    /// A matrix in a vertex stream places an instance; some authors write its rows one by one.
    [[nodiscard]] std::optional<int> rowOfInstance(const Leaf& leaf) const {
        if (!job_.vertex) return std::nullopt;
        if (leaf.row && *leaf.row < 4) return leaf.row;
        const bool named = std::ranges::any_of(std::array{"WORLD", "TRANSFORM", "MATRIX"},
                                               [&](const char* word) { return leaf.semantic.find(word) != std::string::npos; });
        return named && leaf.shape.scalar == "float" && leaf.shape.columns >= 3 && leaf.index < 4 ? std::optional(leaf.index)
                                                                                                  : std::nullopt;
    }

    /// What a rasteriser gives a pixel shader.
    bool receiveSystem(const Leaf& leaf, const std::string& cast) {
        const bool nine = profile_.direct3D9();
        if (nine && leaf.semantic == "VPOS") {
            systemInput("float4", "SV_Position");
            assign(leaf, fmt::format("{}({}{} - 0.5)", cast, system_["SV_Position"], firstComponents(leaf.shape.columns)));
            return true;
        }
        if (nine && leaf.semantic == "VFACE") {
            systemInput("bool", "SV_IsFrontFace");
            assign(leaf, fmt::format("{}({} ? 1.0 : -1.0)", cast, system_["SV_IsFrontFace"]));
            return true;
        }
        if (leaf.semantic == "SV_POSITION" || (isPosition(leaf) && (nine || !provided(fmt::format("{}{}", leaf.semantic, leaf.index))))) {
            systemInput("float4", "SV_Position");
            assign(leaf, fmt::format("{}({}{})", cast, system_["SV_Position"], firstComponents(leaf.shape.columns)));
            return true;
        }
        return false;
    }

    void systemInput(const std::string& type, const std::string& semantic) {
        if (system_.contains(semantic)) return;
        system_[semantic] = declareInput(type, semantic);
        ++systems_;
    }

    const Port* provided(const std::string& key) {
        static const Port kAny;
        if (!job_.available) return &kAny;
        const auto found = std::ranges::find(*job_.available, key, &Port::semantic);
        return found == job_.available->end() ? nullptr : &*found;
    }

    /// One of the four that every mesh's stream has.
    std::string stream(const std::string& semantic, const std::string& type) {
        if (const auto known = inputs_.find("$" + semantic); known != inputs_.end()) return known->second;
        const std::string name = declareInput(type, semantic);
        made_.inputs.push_back({semantic, type});
        return inputs_["$" + semantic] = name;
    }

    std::string vertexInput(const std::string& written) {
        const std::string key = usualStream(written);
        if (job_.pixels && (key == "POSITION0" || key == "POSITIONT0" || key == "SV_POSITION0")) {
            made_.readsTargetSize = true;
            return fmt::format("float4(({0}{1}, {0}.z, 1)", stream("POSITION", "float3"), kInPixels);
        }
        if (key == "POSITION0" || key == "POSITIONT0" || key == "SV_POSITION0")
            return fmt::format("float4({}, 1)", stream("POSITION", "float3"));
        if (key == "NORMAL0") return fmt::format("float4({}, 1)", stream("NORMAL", "float3"));
        if (key == "TANGENT0") return stream("TANGENT", "float4");
        if (key == "TEXCOORD0") return fmt::format("float4({}, 0, 1)", stream("TEXCOORD0", "float2"));
        if (key == "BINORMAL0" || key == "BITANGENT0") {
            const std::string normal = stream("NORMAL", "float3");
            const std::string tangent = stream("TANGENT", "float4");
            made_.standIns.push_back(fmt::format("{} is the normal times the tangent", key));
            return fmt::format("float4(cross({0}, {1}.xyz) * {1}.w, 1)", normal, tangent);
        }
        if (key.starts_with("TEXCOORD")) {
            made_.standIns.push_back(fmt::format("{} is TEXCOORD0", key));
            return fmt::format("float4({}, 0, 1)", stream("TEXCOORD0", "float2"));
        }
        if (key.starts_with("COLOR")) {
            made_.standIns.push_back(fmt::format("{} is white", key));
            return "float4(1, 1, 1, 1)";
        }
        if (key == "BLENDWEIGHT0" || key == "BLENDWEIGHTS0") {
            made_.standIns.push_back(fmt::format("{} is all of the first bone", key));
            return "float4(1, 0, 0, 0)";
        }
        made_.standIns.push_back(fmt::format("{} is zero", key));
        return "float4(0, 0, 0, 0)";
    }

    /// An output once; the second of one semantic is dropped, as Direct3D 9 does.
    std::string declareOutput(const std::string& type, const std::string& semantic, const std::string& modifiers = {}) {
        const std::string name = fmt::format("o{}", given_.size());
        given_[semantic] = name;
        signature_.push_back(fmt::format("out {}{} {} : {}", modifiers, type, name, semantic));
        return name;
    }

    Result<void> give(const Leaf& leaf) {
        const std::string key = fmt::format("{}{}", leaf.semantic, leaf.index);
        return job_.vertex ? giveVarying(leaf, key) : givePixel(leaf, key);
    }

    static std::string padded(const Leaf& leaf, const char* last) {
        const int columns = leaf.shape.columns;
        if (columns == 4 && leaf.shape.scalar == "float") return leaf.path;
        std::string text = "float4(" + leaf.path;
        for (int i = columns; i < 4; ++i)
            text += i == 3 ? fmt::format(", {}", last) : ", 0";
        return text + ")";
    }

    Result<void> giveVarying(const Leaf& leaf, const std::string& key) {
        // Later models compiled with /Gec have POSITION for the system's, too; elsewhere it stands beside that.
        const bool position =
            leaf.semantic == "SV_POSITION" ||
            (isPosition(leaf) && (profile_.direct3D9() || std::ranges::find(results_, "SV_POSITION", &Leaf::semantic) == results_.end()));
        if (position) {
            if (given_.contains("SV_Position")) return {};
            const std::string place = declareOutput("float4", "SV_Position");
            after_.push_back(fmt::format("{} = {};", place, padded(leaf, "1")));
            made_.writesPosition = true;
            // There an author moves his texture coordinates or his corners by half a pixel, or has the blur that comes of not doing so.
            const bool shifted = job_.covers && profile_.direct3D9();
            made_.readsTargetSize = made_.readsTargetSize || shifted;
            if (shifted) after_.push_back(fmt::format("{0}.xy += float2(1, -1) / {1} * {0}.w;", place, kTargetSize));
            return {};
        }
        if (leaf.semantic == "PSIZE" || (profile_.direct3D9() && leaf.semantic == "FOG" && !job_.fogs))
            return {}; // for stages that no longer exist
        if (isSystem(leaf.semantic)) {
            if (given_.contains(key)) return {};
            after_.push_back(fmt::format("{} = {};", declareOutput(leaf.type, key), leaf.path));
            return {};
        }
        if (given_.contains(key)) return {};
        if (leaf.shape.scalar != "float" && !profile_.direct3D9()) {
            const std::string type = typeText(leaf.shape.scalar == "bool" ? "uint" : leaf.shape.scalar, leaf.shape.columns);
            after_.push_back(fmt::format("{} = {};", declareOutput(type, key, "nointerpolation "), leaf.path));
            made_.outputs.push_back({key, type});
            return {};
        }
        // Before shader model 3 colours went through saturating interpolators.
        const bool saturates = leaf.semantic == "COLOR" && profile_.major < 3;
        const std::string value = padded(leaf, "0");
        after_.push_back(
            fmt::format("{} = {};", declareOutput("float4", key, leaf.modifiers), saturates ? fmt::format("saturate({})", value) : value));
        made_.outputs.push_back({key});
        return {};
    }

    Result<void> givePixel(const Leaf& leaf, const std::string& key) {
        if (leaf.semantic == "DEPTH" || leaf.semantic == "SV_DEPTH") {
            if (!given_.contains("SV_Depth"))
                after_.push_back(
                    fmt::format("{} = {}{};", declareOutput("float", "SV_Depth"), leaf.path, leaf.shape.columns > 1 ? ".x" : ""));
            return {};
        }
        if (leaf.semantic == "SV_COVERAGE" || leaf.semantic.starts_with("SV_DEPTH")) {
            if (!given_.contains(leaf.semantic))
                after_.push_back(fmt::format("{} = {};", declareOutput(leaf.type, leaf.semantic), leaf.path));
            return {};
        }
        if (leaf.semantic != "COLOR" && leaf.semantic != "SV_TARGET")
            return error(3403, fmt::format("{} writes {}, which no pixel shader has", job_.shader.entry, key),
                         "write COLOR0 or SV_Target0");
        const std::string semantic = fmt::format("SV_Target{}", leaf.index);
        if (given_.contains(semantic)) return {};
        if (leaf.shape.scalar != "float") { // targets of integers
            after_.push_back(fmt::format("{} = {};", declareOutput(leaf.type, semantic), leaf.path));
            return {};
        }
        after_.push_back(fmt::format("{} = {};", declareOutput("float4", semantic), padded(leaf, "1")));
        return {};
    }

    void finish() {
        if (!job_.vertex && job_.pass) finishColours();
        std::string text = made_.readsTargetSize ? fmt::format("float2 {};\n", kTargetSize) : std::string();
        text += fmt::format("void {}({}) {{\n", job_.name, fmt::join(signature_, ", "));
        for (const std::string& line : before_)
            text += " " + line + "\n";
        for (const std::string& line : after_)
            text += " " + line + "\n";
        made_.text = text + "}\n";
    }

    void finishColours();

    const WrapperJob& job_;
    Profile profile_;
    Spelling spelling_;
    Wrapper made_;
    std::vector<std::string> signature_;
    std::vector<std::string> before_;
    std::vector<std::string> after_;
    std::vector<std::string> call_;
    std::vector<Leaf> results_;
    std::map<std::string, std::string> inputs_; // by semantic: the variable, or the value that stands in
    std::map<std::string, std::string> system_;
    std::map<std::string, std::string> given_;
    std::size_t argument_ = 0;
    std::size_t systems_ = 0;
};

/// The alpha test as code: of eight bits, as its reference is.
std::string alphaTestCode(const AlphaTest& test, const std::string& alpha) {
    constexpr std::array kOperators{"", "<", "==", "<=", ">", "!=", ">=", ""};
    const auto compare = static_cast<std::size_t>(test.compare);
    if (!test.enable || test.compare == CompareOp::Always) return {};
    if (test.compare == CompareOp::Never) return "discard;";
    return fmt::format("if (!(floor(saturate({}) * 255 + 0.5) {} {})) discard;", alpha, kOperators[compare], test.reference);
}

/// `fog`: the variable that holds how much of the colour the fog leaves; empty: none.
std::vector<std::string> colourCode(const Pass& pass, const std::string& colour, const std::string& fog) {
    std::vector<std::string> lines;
    if (auto test = alphaTestCode(pass.alphaTest, colour + ".a"); !test.empty()) lines.push_back(std::move(test));
    if (!fog.empty())
        lines.push_back(fmt::format("{0}.rgb = lerp(float3({2}, {3}, {4}), {0}.rgb, saturate({1}.x));", colour, fog, pass.fogColor[0],
                                    pass.fogColor[1], pass.fogColor[2]));
    if (pass.encodesSrgb) lines.push_back(fmt::format("{0}.rgb = tg_encoded({0}.rgb);", colour));
    return lines;
}

void Wrapping::finishColours() {
    if (job_.farthest && !given_.contains("SV_Depth")) after_.push_back(fmt::format("{} = 1;", declareOutput("float", "SV_Depth")));
    const auto colour = given_.find("SV_Target0");
    if (colour == given_.end()) return;
    std::string fog;
    if (job_.pass->fogs && profile_.major < 3 && job_.available && provided(kFog)) {
        fog = declareInput("float4", kFog);
        made_.inputs.push_back({kFog});
    }
    for (std::string& line : colourCode(*job_.pass, colour->second, fog))
        after_.push_back(std::move(line));
    if (job_.saturates) after_.push_back(fmt::format("{0} = saturate({0});", colour->second));
}

} // namespace

Result<Wrapper> wrap(const WrapperJob& job) {
    return Wrapping(job).run();
}

Wrapper plainVertexShader(const std::string& name, const std::vector<Port>& reads, bool quad) {
    Wrapper made{.writesPosition = true};
    std::vector<std::string> signature{"float3 p : POSITION"};
    std::string body = quad ? " o = float4(p, 1);\n" : fmt::format(" o = mul(float4(p, 1), {});\n", kPlainMatrix);
    bool uv = false;
    bool normal = false;
    std::vector<std::string> outs{"out float4 o : SV_Position"};
    for (std::size_t i = 0; i < reads.size(); ++i) {
        const Port& port = reads[i];
        outs.push_back(fmt::format("out float4 t{} : {}", i, port.semantic));
        const bool isNormal = port.semantic.starts_with("NORMAL");
        const bool isColour = port.semantic.starts_with("COLOR");
        uv = uv || (!isNormal && !isColour);
        normal = normal || isNormal;
        body += fmt::format(" t{} = {};\n", i, isNormal ? "float4(n, 0)" : isColour ? "float4(1, 1, 1, 1)" : "float4(uv, 0, 1)");
        made.outputs.push_back({port.semantic});
    }
    if (normal) signature.emplace_back("float3 n : NORMAL");
    if (uv) signature.emplace_back("float2 uv : TEXCOORD0");
    signature.insert(signature.end(), outs.begin(), outs.end());
    made.text = fmt::format("{}void {}({}) {{\n{}}}\n", quad ? "" : fmt::format("float4x4 {};\n", kPlainMatrix), name,
                            fmt::join(signature, ", "), body);
    return made;
}

Wrapper plainPixelShader(const std::string& name, const std::vector<Port>& available, const Pass& pass) {
    Wrapper made;
    std::string signature;
    const auto read = [&](const char* variable, const char* semantic) {
        if (std::ranges::find(available, semantic, &Port::semantic) == available.end()) return false;
        made.inputs.push_back({semantic});
        signature += fmt::format("float4 {} : {}, ", variable, semantic);
        return true;
    };
    std::string body = read("c", "COLOR0") ? " o = c;\n" : " o = float4(1, 1, 1, 1);\n";
    if (pass.addsSpecular && read("s", "COLOR1")) body += " o.rgb = saturate(o.rgb + s.rgb);\n";
    const bool fogs = pass.fogs && read("f", kFog);
    for (const std::string& line : colourCode(pass, "o", fogs ? "f" : ""))
        body += " " + line + "\n";
    made.text = fmt::format("void {}({}out float4 o : SV_Target0) {{\n{}}}\n", name, signature, body);
    return made;
}

} // namespace tegument::adopt
