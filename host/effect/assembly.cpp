#include "host/effect/assembly.h"

#include "host/support/text.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <string_view>

namespace tegument {

namespace {

/// An instruction whose result is an expression of its sources, each of four components.
struct Operation {
    std::string_view name;
    std::size_t sources;
    std::string_view text;
};

constexpr std::array<Operation, 36> kOperations{{
    {"mov", 1, "{0}"},
    {"add", 2, "({0} + {1})"},
    {"sub", 2, "({0} - {1})"},
    {"mul", 2, "({0} * {1})"},
    {"mad", 3, "({0} * {1} + {2})"},
    {"rcp", 1, "(1 / {0}.x).xxxx"},
    {"rsq", 1, "rsqrt(abs({0}.x)).xxxx"},
    {"dp3", 2, "dot({0}.xyz, {1}.xyz).xxxx"},
    {"dp4", 2, "dot({0}, {1}).xxxx"},
    {"dp2add", 3, "(dot({0}.xy, {1}.xy) + {2}.x).xxxx"},
    {"min", 2, "min({0}, {1})"},
    {"max", 2, "max({0}, {1})"},
    {"slt", 2, "((float4)({0} < {1}))"},
    {"sge", 2, "((float4)({0} >= {1}))"},
    {"exp", 1, "exp2({0}.x).xxxx"},
    {"expp", 1, "exp2({0}.x).xxxx"},
    {"log", 1, "log2(abs({0}.x)).xxxx"},
    {"logp", 1, "log2(abs({0}.x)).xxxx"},
    {"frc", 1, "frac({0})"},
    {"dst", 2, "float4(1, {0}.y * {1}.y, {0}.z, {1}.w)"},
    {"lit", 1, "float4(1, max({0}.x, 0), {0}.x > 0 ? pow(max({0}.y, 0.000001), {0}.w) : 0, 1)"},
    {"abs", 1, "abs({0})"},
    {"nrm", 1, "({0} * rsqrt(dot({0}.xyz, {0}.xyz)))"},
    {"crs", 2, "float4(cross({0}.xyz, {1}.xyz), 0)"},
    {"pow", 2, "pow(abs({0}.x), {1}.x).xxxx"},
    {"lrp", 3, "lerp({2}, {1}, {0})"},
    {"sgn", 1, "sign({0})"},
    {"sincos", 1, "float4(cos({0}.x), sin({0}.x), 0, 0)"},
    {"mova", 1, "round({0})"},
    {"cmp", 3, "({0} >= 0 ? {1} : {2})"},
    {"cnd", 3, "({0} > 0.5 ? {1} : {2})"},
    {"dsx", 1, "ddx({0})"},
    {"dsy", 1, "ddy({0})"},
    {"texcrd", 1, "{0}"},
    {"setp", 2, "{0}"},
    {"bem", 2, "({0} + {1})"},
}};

/// Products with as many registers as the second number says, of the first number of components.
constexpr std::array<std::string_view, 5> kProducts{"m4x4", "m4x3", "m3x4", "m3x3", "m3x2"};

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kFactors{
    {{"_x2", "2"}, {"_x4", "4"}, {"_x8", "8"}, {"_d2", "0.5"}, {"_d4", "0.25"}, {"_d8", "0.125"}}};

struct Missing {
    std::string what;
};

/// Letters, then digits: "oPos", "c" and "12".
struct Register {
    std::string kind;
    int index = 0;
};

Register registerOf(const std::string& text) {
    const std::size_t digits = text.find_last_not_of("0123456789") + 1;
    return {text.substr(0, digits), digits < text.size() ? std::atoi(text.c_str() + digits) : 0};
}

std::vector<std::string> operandsOf(const std::string& text) {
    std::vector<std::string> list(1);
    for (const char c : text) {
        if (c == ',')
            list.emplace_back();
        else if (c != ' ' && c != '\t')
            list.back() += c;
    }
    if (list.size() == 1 && list[0].empty()) list.clear();
    return list;
}

class Translator {
public:
    explicit Translator(const Assembly& assembly) : assembly_(assembly) {}

    Assembled run() {
        std::string version = toLower(assembly_.lines.empty() ? "" : assembly_.lines[0]);
        std::erase(version, ' ');
        std::ranges::replace(version, '.', '_');
        vertex_ = version.starts_with("vs_");
        if (version.size() < 6 || (!vertex_ && !version.starts_with("ps_"))) throw Missing{version};
        major_ = version[3] - '0';
        for (std::size_t i = 1; i < assembly_.lines.size(); ++i)
            line(assembly_.lines[i]);
        return {version.substr(0, 6), text()};
    }

private:
    void line(std::string instruction) {
        const std::size_t start = instruction.find_first_not_of(" \t+"); // '+': at the same time as the one before
        if (start == std::string::npos) return;
        instruction.erase(0, start);
        const std::size_t end = std::min(instruction.find(' '), instruction.size());
        std::string name = toLower(instruction.substr(0, end));
        const std::vector<std::string> operands = operandsOf(instruction.substr(end));
        if (name == "phase" || name == "nop" || name == "end") return;
        if (name == "def") return define(operands);
        if (name.starts_with("dcl")) return declare(name, operands);
        if (name.starts_with("if") || name == "else" || name == "endif") return condition(name, operands);
        std::string modifiers;
        if (const std::size_t under = name.find('_'); under != std::string::npos) {
            modifiers = name.substr(under);
            name.resize(under);
        }
        if (operands.empty()) throw Missing{name};
        if (name == "texkill") return add(fmt::format("clip({}.xyz);", source(operands[0])));
        store(operands[0], modifiers, value(name, operands));
    }

    void define(const std::vector<std::string>& operands) {
        if (operands.size() != 5) throw Missing{"def"};
        constants_[registerOf(operands[0]).index] =
            fmt::format("float4({}, {}, {}, {})", operands[1], operands[2], operands[3], operands[4]);
    }

    void declare(const std::string& name, const std::vector<std::string>& operands) {
        if (operands.empty()) throw Missing{name};
        const std::string target = operands[0].substr(0, operands[0].find('.'));
        const Register where = registerOf(target);
        std::string usage = name.size() > 4 ? name.substr(4) : std::string();
        for (const std::string_view modifier : {"_centroid", "_pp", "_sat"})
            if (const std::size_t at = usage.find(modifier); at != std::string::npos) usage.resize(at);
        if (where.kind == "s") {
            samplerKinds_[where.index] = usage == "cube" ? "CUBE" : usage == "volume" ? "3D" : "2D";
            return;
        }
        if (usage.empty()) return; // ps_2_0's v# and t# say themselves what they are
        std::string semantic = usage;
        for (char& c : semantic)
            c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        (where.kind == "o" ? outputs_ : inputs_)[target] = semantic;
    }

    void condition(const std::string& name, const std::vector<std::string>& operands) {
        if (name == "else") return add("} else {");
        if (name == "endif") return add("}");
        constexpr std::array<std::pair<std::string_view, std::string_view>, 6> kCompare{
            {{"if_lt", "<"}, {"if_gt", ">"}, {"if_le", "<="}, {"if_ge", ">="}, {"if_eq", "=="}, {"if_ne", "!="}}};
        for (const auto& [word, sign] : kCompare)
            if (name == word && operands.size() == 2)
                return add(fmt::format("if ({}.x {} {}.x) {{", source(operands[0]), sign, source(operands[1])));
        throw Missing{name};
    }

    std::string value(const std::string& name, const std::vector<std::string>& operands) {
        if (name.starts_with("tex")) return texel(name, operands);
        if (std::ranges::find(kProducts, std::string_view(name)) != kProducts.end() && operands.size() == 3) return product(name, operands);
        const auto* found = std::ranges::find(kOperations, std::string_view(name), &Operation::name);
        if (found == kOperations.end() || operands.size() < found->sources + 1) throw Missing{name};
        std::vector<std::string> sources(3);
        for (std::size_t i = 0; i < found->sources; ++i)
            sources[i] = source(operands[i + 1]);
        return fmt::format(fmt::runtime(found->text), sources[0], sources[1], sources[2]);
    }

    std::string product(const std::string& name, const std::vector<std::string>& operands) {
        const int rows = name[3] - '0';
        const std::string components = name[1] == '4' ? "" : ".xyz";
        const Register first = registerOf(operands[2].substr(0, operands[2].find('.')));
        std::vector<std::string> parts;
        for (int i = 0; i < 4; ++i)
            parts.push_back(i < rows ? fmt::format("dot({}{}, {}{})", source(operands[1]), components,
                                                   source(fmt::format("{}{}", first.kind, first.index + i)), components)
                                     : "1");
        return fmt::format("float4({})", fmt::join(parts, ", "));
    }

    /// tex t0; texld r0, t0; texld r0, t0, s0; texreg2ar t1, t0 ...
    std::string texel(const std::string& name, const std::vector<std::string>& operands) {
        const Register target = registerOf(operands[0].substr(0, operands[0].find('.')));
        const std::string own = source(fmt::format("t{}", target.index));
        if (name == "texcoord" || name == "texcrd") return operands.size() > 1 ? source(operands[1]) : fmt::format("saturate({})", own);
        const int stage = operands.size() > 2 && operands[2][0] == 's' ? registerOf(operands[2]).index : target.index;
        const std::string kind = samplerKinds_.contains(stage) ? samplerKinds_[stage] : "2D";
        const std::string at = name == "tex" || operands.size() < 2 ? own : source(operands[1]);
        const std::string sampler = samplerOf(stage);
        const auto read = [&](std::string_view form, const std::string& place) {
            return sampler.empty() ? "float4(1, 1, 1, 1)" : fmt::format("tex{}{}({}, {})", kind, form, sampler, place);
        };
        const std::string place = kind == "2D" ? at + ".xy" : at + ".xyz";
        if (name == "tex" || name == "texld") return read("", place);
        if (name == "texldp") return read("proj", at);
        if (name == "texldb") return read("bias", at);
        if (name == "texldl") return read("lod", at);
        if (name == "texreg2ar") return read("", at + ".wx");
        if (name == "texreg2gb") return read("", at + ".yz");
        if (name == "texreg2rgb") return read("", at + ".xyz");
        if (name == "texbem" || name == "texbeml") return read("", fmt::format("({}.xy + {}.xy)", own, at));
        throw Missing{name};
    }

    std::string samplerOf(int stage) const {
        const auto found = assembly_.samplers.find(stage);
        return found == assembly_.samplers.end() ? std::string() : found->second;
    }

    /// `-r0.xyz`, `1-r0`, `r0_bx2`, `c[a0.x+3].x`, `r0_abs`: four components in brackets.
    std::string source(std::string operand) {
        std::string before;
        if (operand.starts_with("1-")) {
            before = "1 - ";
            operand.erase(0, 2);
        } else if (operand.starts_with("-")) {
            before = "-";
            operand.erase(0, 1);
        }
        std::string index;
        if (const std::size_t open = operand.find('['); open != std::string::npos) {
            const std::size_t close = operand.find(']', open);
            if (close == std::string::npos) throw Missing{operand};
            index = operand.substr(open + 1, close - open - 1);
            operand.erase(open, close - open + 1);
        }
        std::string swizzle;
        if (const std::size_t dot = operand.find('.'); dot != std::string::npos) {
            swizzle = operand.substr(dot + 1);
            operand.resize(dot);
        }
        std::string form;
        for (std::string* part : {&operand, &swizzle})
            if (const std::size_t under = part->find('_'); under != std::string::npos) {
                form = part->substr(under);
                part->resize(under);
            }
        std::string text = index.empty() ? named(operand) : element(operand, index);
        if (!swizzle.empty()) text += "." + swizzle + std::string(4 - std::min<std::size_t>(4, swizzle.size()), swizzle.back());
        if (form == "_bx2") text = fmt::format("(2 * ({} - 0.5))", text);
        if (form == "_bias") text = fmt::format("({} - 0.5)", text);
        if (form == "_x2") text = fmt::format("(2 * {})", text);
        if (form == "_abs") text = fmt::format("abs({})", text);
        if (form == "_dz" || form == "_db") text = fmt::format("({0} / {0}.z)", text);
        if (form == "_dw" || form == "_da") text = fmt::format("({0} / {0}.w)", text);
        return before.empty() ? text : fmt::format("({}{})", before, text);
    }

    /// `c[a0.x + 3]`, `c4[a0.x]`, `c[7]`.
    std::string element(const std::string& operand, std::string index) {
        const Register base = registerOf(operand);
        if (base.kind != "c") throw Missing{operand};
        const std::size_t relative = index.find("a0");
        if (relative == std::string::npos) return named(fmt::format("c{}", base.index + std::atoi(index.c_str())));
        locals_.insert("a0");
        indexed_ = true;
        std::string component = ".x";
        index.erase(relative, 2);
        if (relative < index.size() && index[relative] == '.') {
            component = index.substr(relative, 2);
            index.erase(relative, 2);
        }
        std::erase(index, '+');
        return fmt::format("tg_c[clamp((int)a0{} + {}, 0, {})]", component, base.index + std::atoi(index.c_str()), kConstants - 1);
    }

    std::string named(const std::string& operand) {
        const Register where = registerOf(operand);
        if (where.kind == "c") {
            used_.insert(where.index);
            return fmt::format("tg_c{}", where.index);
        }
        if (where.kind == "v" || where.kind == "t" || operand == "vFace" || operand == "vPos") {
            read_.insert(operand);
            return operand;
        }
        if (where.kind != "r" && where.kind != "a" && where.kind != "oC" && where.kind != "oT" && where.kind != "oD")
            throw Missing{operand};
        if (where.kind[0] == 'o') written_.insert(operand);
        if (where.kind[0] != 'o') locals_.insert(operand);
        return operand;
    }

    void store(std::string operand, const std::string& modifiers, std::string text) {
        std::string mask;
        if (const std::size_t dot = operand.find('.'); dot != std::string::npos) {
            mask = operand.substr(dot);
            operand.resize(dot);
        }
        const Register where = registerOf(operand);
        if (where.kind == "t") read_.insert(operand);
        if (where.kind == "r" || where.kind == "a") locals_.insert(operand);
        if (where.kind[0] == 'o') written_.insert(operand);
        for (const auto& [form, factor] : kFactors)
            if (modifiers.find(form) != std::string::npos) text = fmt::format("({} * {})", text, factor);
        if (modifiers.find("_sat") != std::string::npos) text = fmt::format("saturate({})", text);
        const bool scalar = operand == "oFog" || operand == "oPts" || operand == "oDepth";
        if (scalar) text += mask.size() == 2 ? mask : ".x";
        if (where.kind == "a" && major_ == 1) text = fmt::format("floor({})", text);
        add(scalar ? fmt::format("{} = {};", operand, text) : fmt::format("{}{} = ({}){};", operand, mask, text, mask));
    }

    void add(std::string line) { body_.push_back(std::move(line)); }

    [[nodiscard]] std::string semanticOf(const std::string& name) const {
        if (const auto known = inputs_.find(name); known != inputs_.end()) return known->second;
        const Register where = registerOf(name);
        if (name == "vPos") return "VPOS";
        if (name == "vFace") return "VFACE";
        if (!vertex_) return fmt::format("{}{}", where.kind == "t" ? "TEXCOORD" : "COLOR", where.index);
        constexpr std::array<std::string_view, 7> kUsual{"POSITION", "BLENDWEIGHT", "BLENDINDICES", "NORMAL", "PSIZE", "COLOR0", "COLOR1"};
        return where.index < 7 ? std::string(kUsual[static_cast<std::size_t>(where.index)]) : fmt::format("TEXCOORD{}", where.index - 7);
    }

    [[nodiscard]] std::string outputOf(const std::string& name) const {
        if (const auto known = outputs_.find(name); known != outputs_.end()) return known->second;
        const Register where = registerOf(name);
        if (name == "oPos") return "POSITION";
        if (name == "oFog") return "FOG";
        if (name == "oPts") return "PSIZE";
        if (name == "oDepth") return "DEPTH";
        if (where.kind == "oT") return fmt::format("TEXCOORD{}", where.index);
        return fmt::format("COLOR{}", where.index);
    }

    std::string text() {
        const bool result = !vertex_ && major_ == 1; // in r0
        std::vector<std::string> signature;
        std::vector<std::string> lines;
        for (const std::string& name : read_)
            signature.push_back(fmt::format("{} {} : {}", name == "vFace" ? "float" : "float4", name, semanticOf(name)));
        for (const std::string& name : written_) {
            const bool scalar = name == "oFog" || name == "oPts" || name == "oDepth";
            signature.push_back(fmt::format("out {} {} : {}", scalar ? "float" : "float4", name, outputOf(name)));
            lines.push_back(fmt::format("{} = 0;", name));
        }
        if (result) signature.emplace_back("out float4 tg_result : COLOR0");
        if (result) locals_.insert("r0");
        const auto constant = [&](int i) {
            if (const auto own = constants_.find(i); own != constants_.end()) return own->second;
            const auto given = assembly_.constants.find(i);
            return given == assembly_.constants.end() ? std::string("float4(0, 0, 0, 0)") : given->second;
        };
        for (const int i : used_)
            lines.push_back(fmt::format("float4 tg_c{} = {};", i, constant(i)));
        if (indexed_) lines.push_back(fmt::format("float4 tg_c[{}] = (float4[{}])0;", kConstants, kConstants));
        for (int i = 0; indexed_ && i < kConstants; ++i)
            if (constants_.contains(i) || assembly_.constants.contains(i)) lines.push_back(fmt::format("tg_c[{}] = {};", i, constant(i)));
        for (const std::string& name : locals_)
            lines.push_back(fmt::format("float4 {} = 0;", name));
        lines.insert(lines.end(), body_.begin(), body_.end());
        if (result) lines.emplace_back("tg_result = r0;");
        return fmt::format("void {}({}) {{ {} }}\n", assembly_.name, fmt::join(signature, ", "), fmt::join(lines, " "));
    }

    static constexpr int kConstants = 96;

    const Assembly& assembly_;
    bool vertex_ = false;
    int major_ = 1;
    std::vector<std::string> body_;
    std::map<int, std::string> constants_;
    std::map<int, std::string> samplerKinds_;
    std::map<std::string, std::string> inputs_;  // semantics by register
    std::map<std::string, std::string> outputs_; // the same of vs_3_0
    std::set<std::string> read_;
    std::set<std::string> written_;
    std::set<std::string> locals_;
    std::set<int> used_;
    bool indexed_ = false;
};

} // namespace

std::optional<Assembled> translateAssembly(const Assembly& assembly, std::string& why) {
    try {
        return Translator(assembly).run();
    } catch (const Missing& missing) {
        why = missing.what;
        return std::nullopt;
    }
}

} // namespace tegument
