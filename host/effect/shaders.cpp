// Which function is which stage of a pass: `compile`, CompileShader, objects that stand for shaders, and what this host cannot draw.

#include "host/effect/parser.h"
#include "host/support/text.h"

#include <cmath>

#include <fmt/format.h>

namespace tegument {

namespace {

std::optional<ShaderReference>* shaderSlot(Pass& pass, std::string_view stage) {
    if (equalsIgnoreCase(stage, "VertexShader")) return &pass.vertexShader;
    if (equalsIgnoreCase(stage, "PixelShader")) return &pass.pixelShader;
    if (equalsIgnoreCase(stage, "GeometryShader")) return &pass.geometryShader;
    if (equalsIgnoreCase(stage, "HullShader")) return &pass.hullShader;
    if (equalsIgnoreCase(stage, "DomainShader")) return &pass.domainShader;
    return equalsIgnoreCase(stage, "ComputeShader") ? &pass.computeShader : nullptr;
}

/// vs_3_0, ps_2_a, gs_4_0, hs_5_0, ds_5_0, cs_5_0; tx_1_0 fills textures.
bool isProfile(std::string_view word) {
    const bool stage = word.starts_with("tx_") ||
                       (word.size() > 3 && word.substr(1, 2) == "s_" && std::string_view("vpghdc").find(word[0]) != std::string_view::npos);
    return stage && word.size() > 3 && word[3] >= '1' && word[3] <= '9';
}

} // namespace

/// VertexShader X = CompileShader(vs_5_0, F()); VertexShader Y[2] = { compile vs_2_0 F(0), compile vs_2_0 F(1) };
bool Parser::shaderObject(std::size_t start) {
    take();
    const std::string name(take().text);
    Type shape{.name = "shader"};
    Annotations ignored;
    if (!arraySize(shape) || (peek().is('<') && !annotations(ignored))) return false;
    if (lenient_ && accept(';')) { // set by the host, if at all
        shaderObjects_.insert_or_assign(name, ShaderObject{});
        blankFrom(start);
        return true;
    }
    if (!expect('=', "after the shader object's name")) return false;
    const bool array = shape.elements > 0 || shape.unsized;
    if (array && !expect('{', "of the array")) return false;
    for (int i = 0; !(array && accept('}')); ++i) {
        ShaderObject shader;
        if (!shaderValue(shader)) return false;
        shaderObjects_.insert_or_assign(array ? fmt::format("{}[{}]", name, i) : name, shader);
        if (!array) break;
        accept(',');
    }
    if (!expect(';', "after the shader object")) return false;
    blankFrom(start);
    return true;
}

bool Parser::shaderStatement(Pass& pass, const Token& stage) {
    ShaderObject shader;
    if (!shaderValue(shader)) return false;
    std::optional<ShaderReference>* slot = shaderSlot(pass, stage.text);
    if (slot != nullptr && shader.reference && !shader.streamOutput && isProfile(shader.reference->profile) &&
        shader.reference->profile[0] != toLower(stage.text)[0] &&
        !refuse(1101, stage, fmt::format("{} is compiled as {}", stage.text, shader.reference->profile)))
        return false;
    if (slot == nullptr && shader.reference) return fail(2021, stage, fmt::format("{} is not supported", stage.text));
    const bool tessellates = equalsIgnoreCase(stage.text, "HullShader") || equalsIgnoreCase(stage.text, "DomainShader");
    if (tessellates && shader.reference && !refuse(2021, stage, fmt::format("{} is not supported", stage.text))) return false;
    if (slot != nullptr) *slot = std::move(shader.reference);
    pass.assemblyShaders += shader.assembly ? 1 : 0;
    if (equalsIgnoreCase(stage.text, "VertexShader")) vertexAssembly_ = shader.assembly;
    if (equalsIgnoreCase(stage.text, "PixelShader")) pixelAssembly_ = shader.assembly;
    pass.streamOutput = pass.streamOutput || shader.streamOutput;
    return true;
}

/// `compile ps_3_0 F(2, true)`, `CompileShader(ps_5_0, F())`; the cursor stands behind the keyword.
bool Parser::shaderCall(ShaderObject& shader, bool call) {
    if (call && !expect('(', "after CompileShader")) return false;
    Token profile;
    Token entry;
    if (!expectName(profile, "a profile such as ps_3_0")) return false;
    if (!isProfile(profile.text) && !refuse(1101, profile, fmt::format("expected a profile such as ps_3_0, found '{}'", profile.text)))
        return false;
    if (call && !expect(',', "after the profile")) return false;
    if (!expectName(entry, "the shader's function")) return false;
    shader.reference = ShaderReference{.entry = std::string(entry.text), .profile = std::string(profile.text), .at = position(entry)};
    if (!shaderArguments(shader.reference->arguments)) return false;
    return !call || expect(')', "after the shader");
}

/// NULL, `compile`, CompileShader, assembly, ConstructGSWithSO(shader, "..."), BindInterfaces(shader, ...), or the name of a shader object,
/// bare, indexed or in brackets.
bool Parser::shaderValue(ShaderObject& shader) {
    constexpr int kDeepest = 16; // bounds our own recursion
    const Token start = peek();
    if (shaderDepth_ > kDeepest) return fail(1106, start, fmt::format("shaders are nested deeper than {}", kDeepest));
    ++shaderDepth_;
    const bool good = shaderValueHere(shader);
    --shaderDepth_;
    return good;
}

bool Parser::shaderValueHere(ShaderObject& shader) {
    const Token start = peek();
    const bool zero = start.kind == TokenKind::Number && (start.text == "0" || start.text == "0x0");
    if (isWord("NULL") || zero) {
        take();
        return true;
    }
    if (isWord("asm")) {
        if (!lenient_) return fail(2021, start, "assembly shaders are not supported", "write HLSL");
        take();
        if (!peek().is('{')) return unexpected("'{' of the assembly");
        const std::size_t first = mark() + 1;
        if (!skipBalanced()) return false;
        shader.assembly = TokenRange{first, mark() - 1};
        return true;
    }
    for (const std::string_view wrapper : {"ConstructGSWithSO", "BindInterfaces"})
        if (isWord(wrapper)) {
            const bool output = wrapper == "ConstructGSWithSO";
            if (!refuse(2021, start, output ? "stream output is not supported" : "instances of interfaces are not bound")) return false;
            take();
            if (!expect('(', "of the call") || !shaderValue(shader)) return false;
            while (!atEnd() && !peek().is(')') && !peek().is(';'))
                if (peek().is('{') || peek().is('(') ? !skipBalanced() : (take(), false)) return false;
            shader.streamOutput = output;
            return expect(')', "at the end of the call");
        }
    const bool call = isWord("CompileShader");
    if (!isWord("compile") && !call) {
        const bool bracket = peek().is('(') && (equalsIgnoreCase(peek(1).text, "compile") || equalsIgnoreCase(peek(1).text, "NULL"));
        if (!bracket) return shaderByName(shader);
        take();
        return shaderValue(shader) && expect(')', "after the shader");
    }
    take();
    return shaderCall(shader, call);
}

bool Parser::shaderByName(ShaderObject& shader) {
    const Token at = peek();
    const std::optional<std::string> name = objectName("a shader");
    if (!name) return false;
    const auto object = shaderObjects_.find(*name);
    if (object == shaderObjects_.end()) {
        const bool call = result_.functions.contains(*name) || name->ends_with("PS") || name->ends_with("VS");
        return fail(
            2019, at, fmt::format("unknown shader object '{}'", *name),
            call ? fmt::format("for a function: compile PROFILE {}(); ReShade's language, whose passes name functions, is not read", *name)
                 : std::string());
    }
    shader = object->second;
    return true;
}

/// `name`, `(name)`, `<name>`, `name[index]`: the name that the object has here. Which one it is follows from the default values.
std::optional<std::string> Parser::objectName(std::string_view what) {
    const char opening = peek().is('(') || peek().is('<') ? take().text[0] : '\0';
    Token name;
    if (!expectName(name, what)) return std::nullopt;
    std::string text(name.text);
    if (accept('[')) {
        const std::optional<Constant> index = expression();
        if (!index || !expect(']', "after the index")) return std::nullopt;
        text = elementNamed(text, index->numbers.empty() ? 0 : index->numbers[0], name);
    }
    if (opening != '\0' && !expect(opening == '(' ? ')' : '>', fmt::format("after the name of {}", what))) return std::nullopt;
    return text;
}

/// `list[2]`. A host sets the index before it draws: until then one below the array is its first element, as in Microsoft's library, and
/// one beyond it the last.
std::string Parser::elementNamed(const std::string& array, double index, const Token& at) {
    const auto named = [&](double i) { return fmt::format("{}[{:.0f}]", array, std::trunc(i)); };
    const auto exists = [&](const std::string& name) { return shaderObjects_.contains(name) || stateObjects_.contains(name); };
    if (!lenient_ || exists(named(index)) || !exists(named(0))) return named(index);
    if (index < 0) return named(0);
    double last = 0;
    while (exists(named(last + 1)))
        ++last;
    warn(2019, position(at), fmt::format("'{}' has no element {:.0f}: its last one is taken", array, index));
    return named(last);
}

/// The arguments for `uniform` parameters, each as written but for its spaces.
bool Parser::shaderArguments(std::vector<std::string>& arguments) {
    const std::size_t first = mark() + 1;
    if (!peek().is('(')) return unexpected("'(' after the shader's function");
    if (!skipBalanced()) return false;
    int depth = 0;
    for (std::size_t i = first; i + 1 < mark(); ++i) {
        const Token& token = tokens_[i];
        const bool nothing = token.is('(') && tokens_[i + 1].is(')') && tokens_[i - 1].kind != TokenKind::Word; // no call
        if (nothing && !refuse(1101, tokens_[i + 1], "expected a value, found ')'")) return false;
        depth += token.is('(') ? 1 : token.is(')') ? -1 : 0;
        if (arguments.empty() || (depth == 0 && token.is(','))) arguments.emplace_back();
        if (depth > 0 || !token.is(',')) arguments.back() += token.text;
    }
    return true;
}

} // namespace tegument
