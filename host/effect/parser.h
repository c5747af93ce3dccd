#pragma once
// The parser's shared state and its parts, one file each: declarations, values, states, samplers, techniques.
// Functions that return bool say whether what they parse was well formed; on false the diagnostic is already recorded and the
// caller recovers at the next ';' or '}'.

#include "host/effect/constants.h"
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

inline constexpr double kLargestWord = 4294967295.0; // of 32 bits: what states and masks hold

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

/// VertexShader X = compile vs_3_0 F(); and what a pass may set: nothing, a function, assembly.
struct ShaderObject {
    std::optional<ShaderReference> reference;
    std::optional<TokenRange> assembly;
    bool streamOutput = false;
};

/// `Texture = <name>`; `bracket`: no word of another state stands there by mistake.
struct TextureReference {
    std::string name;
    SourcePosition at;
    bool bracket = false;
};

/// What parsing one view of the file gives.
struct Parsed {
    Effect effect;
    std::vector<TokenRange> blanks; // effect syntax, to be blanked out for the compilers
    std::set<std::string, std::less<>> functions;
    std::map<std::string, int> samplerDimensions;    // of samplers whose type says it: 1, 2, 3, 6 (cube)
    std::set<std::string> srgbSamplers;              // with SRGBTexture = TRUE
    std::vector<TextureReference> textureReferences; // from sampler blocks, to be checked
    std::set<std::string> otherTextures;             // of types that are no parameters: Texture2DArray, Texture2DMS
    std::string assembled;                           // functions of HLSL that shaders in assembly become
    std::vector<Diagnostic> errors;
};

/// As HLSL converts a number to the scalar of a type; words above 2^31 are negative as int. Of a value also its shape: one scalar fills a
/// vector, a longer one is cut.
[[nodiscard]] double convertedTo(const Type& type, double value);
[[nodiscard]] Constant convertedTo(const Type& type, Constant value);

class Parser {
public:
    /// `lenient`: LoadOptions::lenient.
    Parser(const Sources& sources, const std::vector<Token>& tokens, bool lenient = false);

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
    /// A reserved word is no name: an error, a warning where reading is lenient. `types`: a numeric type's name is none either.
    bool nameable(const Token& name, std::string_view what, bool types = false);
    [[nodiscard]] std::size_t mark() const { return at_; }
    void blankFrom(std::size_t first) { result_.blanks.push_back({first, at_}); }
    /// Skips a balanced (...), [...] or {...} whose opening sign is next. TG1102 when it is never closed.
    bool skipBalanced();
    bool skipAngles();
    void recover();

    // Messages. All return false, but for refuse() where that is lenient.
    /// An error; a warning where reading is lenient.
    bool refuse(int code, const Token& at, std::string text, std::string hint = {});
    /// Where reading is lenient, the errors from this one on are warnings.
    void soften(std::size_t firstError);
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
    [[nodiscard]] std::optional<Type> namedType(std::string_view name) const;
    bool skipTemplate(Type& type);
    std::optional<Type> type();
    bool structure(std::size_t start, const Modifiers& modifiers);
    bool declarators(std::size_t start, const Token& typeName, const Type& type, const Modifiers& modifiers);
    /// structures.cpp. What stands between a structure's braces; none when it cannot be read.
    std::shared_ptr<const std::vector<TypeMember>> members();
    bool member(std::vector<TypeMember>& list);
    bool alias();
    bool constantBuffer();
    bool constantBufferHead();
    bool constantBufferMembers(const Token& opened);
    bool arraySize(Type& type);
    bool semantic(std::string& text);
    bool function(const Token& name);
    bool declaration();
    bool declarator(Declarator d);
    bool staticValue(const Declarator& d);
    std::optional<Constant> staticNumbers(Type type);
    bool skipValue();
    bool softenValue(std::size_t sign, std::size_t firstError);
    bool defaultValue(Parameter& parameter);
    void blankQualifiers(const Declarator& d);
    void addParameter(Parameter parameter, const Declarator& d);
    bool samplerDeclarator(const Declarator& d, Annotations annotations);
    bool samplerBlock(Sampler& sampler, bool direct3D9, const Declarator& d);
    bool samplerArray(const Declarator& d, const Sampler& sampler, bool direct3D9);
    bool stateObject(std::size_t start);
    bool stateBlock(const std::string& name, const std::string& type);
    bool stateBlockObject(std::size_t start);
    bool shaderObject(std::size_t start);

    // expressions.cpp. A constant expression asks `resolve`, then looks names up among the file's constants and parameters.
    std::optional<Constant> expression(const Resolver& resolve = {});
    std::optional<Constant> conditional(int depth, const Resolver& resolve);
    std::optional<Constant> binary(int least, int depth, const Resolver& resolve);
    std::optional<Constant> unary(int depth, const Resolver& resolve);
    std::optional<Constant> postfix(int depth, const Resolver& resolve);
    std::optional<Constant> primary(int depth, const Resolver& resolve);
    std::optional<Constant> bracketed(int depth, const Resolver& resolve);
    std::optional<Constant> named(const Resolver& resolve);
    std::optional<Constant> constructor(int depth, const Resolver& resolve);
    std::optional<Constant> intrinsic(int depth, const Resolver& resolve);
    std::optional<std::vector<Constant>> callArguments(int depth, const Resolver& resolve);
    /// functions.cpp: a call of a function of the file.
    struct FunctionText {
        std::size_t parameters = 0; // their opening bracket
        std::size_t body = 0;       // its opening brace
    };
    struct Local {
        std::string name;
        Type type;
        Constant value;
    };
    using Locals = std::map<std::string, Local, std::less<>>;
    void rememberFunction(const Token& name, std::size_t parameters);
    std::vector<Local> parametersOf(const FunctionText& function);
    std::optional<Constant> called(int depth, const Resolver& resolve);
    std::optional<Constant> runFunction(const FunctionText& function, Locals locals, const Token& call);
    bool skipLocalStatement();
    bool runStatement(std::optional<Constant>& returned);
    bool runChoice(std::optional<Constant>& returned);
    bool runLoop(std::optional<Constant>& returned);
    bool runAssignments();
    bool runAssignment(const std::optional<Type>& type);

    [[nodiscard]] const char* operatorHere(int& precedence, std::size_t& length) const;
    std::optional<double> number(const Token& token, bool& integral);

    // values.cpp
    bool bracedValues(std::vector<double>& numbers, int depth);
    bool initialiser(Type& type, Value& value);
    [[nodiscard]] const Token* namedSince(std::size_t first) const;
    bool literal(std::size_t first);
    bool string(std::string& text, std::vector<TextPiece>& pieces);
    bool annotation(Annotations& result);
    bool annotationValue(const Type& type, Annotations& result);
    bool annotationList(Annotations& result);
    bool annotations(Annotations& result);

    // assignments.cpp
    bool assignments(std::vector<Assignment>& result);
    bool assignment(std::vector<Assignment>& result);
    bool samplerStates(Sampler& sampler, bool block, bool direct3D9);
    bool samplerTexture(Sampler& sampler, const Assignment& assignment);
    bool emptyState();
    std::optional<std::vector<double>> stateValue(const Assignment& assignment, Vocabulary vocabulary);
    template <class Target>
    bool apply(const Assignment& assignment, std::span<const StateEntry<Target>> table, Target& target, std::string_view what);
    bool applyState(const Assignment& assignment, std::string_view objectType, States& states);
    bool applyToPass(const Assignment& assignment, Pass& pass, States& states);
    bool alphaTest(const Assignment& assignment, Pass& pass);
    /// assembled.cpp: shaders in assembly, with what the pass gives their registers.
    void assemble(Pass& pass);
    void assemble(Pass& pass, bool vertex, const TokenRange& text);
    void giveConstant(const Assignment& given, std::map<int, std::string>& constants) const;
    std::string stageSampler(const Assignment& given);
    [[nodiscard]] std::string textOf(const TokenRange& range) const;
    bool fixedFunction(const Assignment& assignment);

    // techniques.cpp
    bool technique();
    bool group();
    bool pass(Technique& technique);
    bool passStatement(const Technique& technique, Pass& pass, States& states);
    bool passStatements(const Technique& technique, Pass& pass, States& states, const Token& opened);
    bool applyStateBlock(const Technique& technique, const Assignment& assignment, Pass& pass, States& states);
    bool direct3D10Assignment(const Technique& technique, const Assignment& assignment, Pass& pass, States& states);
    bool setStatement(const Technique& technique, Pass& pass, States& states);
    bool setState(const Technique& technique, const std::string& type, States& states);
    bool setStateArguments(const std::string& type, PipelineState& state);
    std::optional<std::string> objectName(std::string_view what);

    // shaders.cpp
    bool shaderStatement(Pass& pass, const Token& stage);
    bool shaderValue(ShaderObject& shader);
    bool shaderValueHere(ShaderObject& shader);
    bool shaderByName(ShaderObject& shader);
    std::string elementNamed(const std::string& array, double index, const Token& at);
    bool shaderArguments(std::vector<std::string>& arguments);
    bool shaderCall(ShaderObject& shader, bool call);

    const Sources& sources_;
    const std::vector<Token>& tokens_;
    std::size_t at_ = 0;
    Parsed result_;
    std::map<std::string, Constant, std::less<>> constants_;
    std::map<std::string, std::vector<FunctionText>, std::less<>> functionTexts_;
    Locals* locals_ = nullptr;                    // of the function that is evaluated
    int calls_ = 0;                               // that are evaluated, one inside of another
    int steps_ = 0;                               // of statements in them
    std::set<std::string, std::less<>> changing_; // parameters, and constants that are made of them
    std::map<std::string, StateObject, std::less<>> stateObjects_;
    std::map<std::string, std::size_t> stateBlocks_;                 // Direct3D 9's: where each opens
    std::map<std::string, ShaderObject, std::less<>> shaderObjects_; // of arrays by "name[0]", "name[1]" ...
    std::map<std::string, Type, std::less<>> aliases_;
    std::map<std::string, std::shared_ptr<const std::vector<TypeMember>>, std::less<>> structures_; // null: cannot be read
    bool lenient_ = false;
    bool inBuffer_ = false; // between the braces of a constant buffer
    int shaderDepth_ = 0;
    std::optional<TokenRange> vertexAssembly_; // of the pass in hand
    std::optional<TokenRange> pixelAssembly_;
    std::vector<Assignment> registers_; // that it gives: VertexShaderConstant[4] = ..., Texture[0] = ...
    int assembled_ = 0;                 // shaders so far
    bool closesAngle_ = false;          // a '>' ends `<value>` or annotations and is no operator
    Token end_;
};

} // namespace tegument
