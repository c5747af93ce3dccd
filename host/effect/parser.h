#pragma once
// The parser's shared state and its parts, one file each: declarations, values, states, samplers, techniques.
// Functions that return bool say whether what they parse was well formed; on false the diagnostic is already recorded and the
// caller recovers at the next ';' or '}'.

#include "host/effect/model.h"
#include "host/effect/preprocess.h"
#include "host/effect/source.h"
#include "host/effect/states.h"

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tegument {

/// A constant while it is computed: `integral` decides how '/' divides.
struct Constant {
    std::vector<double> numbers;
    bool integral = false;
};

struct TokenRange {
    std::size_t first = 0;
    std::size_t last = 0; // one behind
};

/// `DepthEnable = TRUE`, `BlendEnable[0] = FALSE`, `AddressU = WRAP`: kept until it is known what it applies to.
struct Assignment {
    Token name;
    int index = -1; // -1: no index
    TokenRange value;
};

/// DepthStencilState X { ... }, BlendState, RasterizerState.
struct StateObject {
    std::string type;
    States states;
};

/// What parsing one view of the file gives.
struct Parsed {
    Effect effect;
    std::vector<TokenRange> blanks; // effect syntax, to be blanked out for the compilers
    std::set<std::string, std::less<>> functions;
    std::map<std::string, int> samplerDimensions;                          // of samplers whose type says it: 1, 2, 3, 6 (cube)
    std::set<std::string> srgbSamplers;                                    // with SRGBTexture = TRUE
    std::vector<std::pair<std::string, SourcePosition>> textureReferences; // from sampler blocks, to be checked
    std::vector<Diagnostic> errors;
};

class Parser {
public:
    Parser(const Sources& sources, const std::vector<Token>& tokens);

    Parsed run();

private:
    // The cursor.
    [[nodiscard]] bool atEnd() const { return at_ >= tokens_.size(); }
    [[nodiscard]] const Token& peek(std::size_t ahead = 0) const;
    const Token& take();
    bool accept(char sign);
    [[nodiscard]] bool isWord(std::string_view word) const; // ignores case
    bool acceptWord(std::string_view word);
    bool expect(char sign, std::string_view where);
    bool expectName(Token& name, std::string_view what);
    [[nodiscard]] std::size_t mark() const { return at_; }
    void blankFrom(std::size_t first) { result_.blanks.push_back({first, at_}); }
    /// Skips a balanced (...), [...] or {...} whose opening sign is next. TG1102 when it is never closed.
    bool skipBalanced();
    bool skipAngles();
    void recover();

    // Messages. All return false.
    bool fail(int code, const Token& at, std::string text, std::string hint = {});
    bool unexpected(std::string_view expected);
    void warn(int code, const SourcePosition& at, std::string text, std::string hint = {});
    [[nodiscard]] SourcePosition position(const Token& token) const { return sources_.position(token); }
    [[nodiscard]] bool full() const;

    struct Modifiers {
        bool isStatic = false;
        bool isConst = false;
        std::size_t last = 0; // one behind them
    };
    struct Declarator {
        std::size_t start = 0; // of the whole declaration
        Token typeName;
        Token name;
        Type type;
        Modifiers modifiers;
    };
    using Resolver = std::function<std::optional<double>(std::string_view)>;

    bool topLevel();
    bool skipStatement();

    // declarations.cpp
    std::optional<Type> type();
    bool structure();
    bool alias();
    bool constantBuffer();
    bool arraySize(Type& type);
    bool semantic(std::string& text);
    bool function(const Token& name);
    bool declaration();
    bool declarator(Declarator d);
    bool staticValue(const Declarator& d);
    bool skipValue();
    bool defaultValue(Parameter& parameter);
    void blankQualifiers(const Declarator& d);
    void addParameter(Parameter parameter, const Declarator& d);
    bool samplerDeclarator(const Declarator& d, Annotations annotations);
    bool stateObject(std::size_t start);
    bool shaderObject(std::size_t start);

    // values.cpp. A constant expression looks names up among the file's static constants, then asks `resolve`.
    std::optional<Constant> expression(const Resolver& resolve = {});
    std::optional<Constant> binary(int least, int depth, const Resolver& resolve);
    std::optional<Constant> unary(int depth, const Resolver& resolve);
    std::optional<Constant> primary(int depth, const Resolver& resolve);
    std::optional<Constant> constructor(int depth, const Resolver& resolve);
    std::optional<double> number(const Token& token, bool& integral);
    bool bracedValues(std::vector<double>& numbers, int depth);
    bool initialiser(const Type& type, Value& value);
    bool string(std::string& text, std::vector<TextPiece>& pieces);
    bool annotation(Annotations& result);
    bool annotations(Annotations& result);

    // assignments.cpp
    bool assignments(std::vector<Assignment>& result);
    bool assignment(std::vector<Assignment>& result);
    bool samplerStates(Sampler& sampler, bool block, bool direct3D9);
    bool samplerTexture(Sampler& sampler, const Assignment& assignment);
    std::optional<std::vector<double>> stateValue(const Assignment& assignment, Vocabulary vocabulary);
    template <class Target>
    bool apply(const Assignment& assignment, std::span<const StateEntry<Target>> table, Target& target, std::string_view what);
    bool applyState(const Assignment& assignment, std::string_view objectType, States& states);
    bool fixedFunction(const Assignment& assignment);

    // techniques.cpp
    bool technique();
    bool group();
    bool pass(Technique& technique);
    bool passStatement(const Technique& technique, Pass& pass, States& states);
    bool shaderStatement(Pass& pass, const Token& stage);
    bool shaderValue(std::optional<ShaderReference>& shader);
    bool setStatement(const Technique& technique, Pass& pass, States& states);
    bool shaderByName(std::optional<ShaderReference>& shader);
    bool shaderArguments(std::vector<std::string>& arguments);
    bool setState(const Technique& technique, const std::string& type, States& states);
    bool setStateArguments(const std::string& type, PipelineState& state);

    const Sources& sources_;
    const std::vector<Token>& tokens_;
    std::size_t at_ = 0;
    Parsed result_;
    std::map<std::string, Constant, std::less<>> constants_;
    std::map<std::string, StateObject, std::less<>> stateObjects_;
    std::map<std::string, ShaderReference, std::less<>> shaderObjects_;
    std::map<std::string, Type, std::less<>> aliases_;
    std::set<std::string, std::less<>> structures_;
    Token end_;
};

} // namespace tegument
