#pragma once
// One function of hlsl/ or of effects/passes/: how to call it, with which arguments, and what it should return.

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace tegument::test {

using glm::clamp, glm::cross, glm::distance, glm::dot, glm::fract, glm::inverse, glm::length, glm::mix, glm::normalize, glm::radians;
using glm::dmat2, glm::dmat3, glm::dmat4, glm::dvec2, glm::dvec3, glm::dvec4, glm::reflect, glm::sign, glm::step, glm::transpose;
using std::abs, std::acos, std::asin, std::atan, std::atan2, std::ceil, std::cos, std::cosh, std::exp, std::exp2, std::floor, std::fmod;
using std::hypot, std::log, std::log2, std::max, std::min, std::pow, std::round, std::sin, std::sqrt, std::tan, std::tanh;

[[nodiscard]] inline double saturate(double x) {
    return std::clamp(x, 0.0, 1.0);
}

/// How an argument's values are spread. Every kind adds its own special values (special_values.cpp).
enum class Spread {
    Linear, // evenly in [low, high]
    Log,    // evenly in the logarithm; low > 0
    Cosine, // half evenly in [low, high], half as +-10^-x down to 1e-7
    Unit,   // directions, float3
    Vector, // directions of lengths spread as Log, float2 to float4
    Whole   // whole numbers in [low, high]
};

struct Argument {
    int components = 1;
    Spread spread = Spread::Linear;
    double low = 0;
    double high = 1;
    double slack = 0; // absolute change of each component that the function may make by rounding sums of its own
};

[[nodiscard]] inline Argument linear(double low, double high, int components = 1, double slack = 0) {
    return {components, Spread::Linear, low, high, slack};
}
[[nodiscard]] inline Argument logarithmic(double low, double high) {
    return {1, Spread::Log, low, high};
}
[[nodiscard]] inline Argument cosine(double low = -1, double high = 1) {
    return {1, Spread::Cosine, low, high};
}
[[nodiscard]] inline Argument unit() {
    return {3, Spread::Unit, -1, 1, 1e-7};
}
/// Among the special values of unit() there are vectors that are no directions.
[[nodiscard]] inline bool isUnit(const dvec3& v) {
    return std::abs(length(v) - 1) < 1e-3;
}
[[nodiscard]] inline Argument vector(int components, double low, double high) {
    return {components, Spread::Vector, low, high};
}
[[nodiscard]] inline Argument whole(int low, int high) {
    return {1, Spread::Whole, static_cast<double>(low), static_cast<double>(high)};
}

/// The arguments of one call, as the shader received them.
class Inputs {
public:
    Inputs(std::span<const double> values, const std::vector<Argument>& arguments, int setting)
        : values_(values), arguments_(arguments), setting_(setting) {}

    [[nodiscard]] double scalar(std::size_t argument, std::size_t component = 0) const { return values_[first(argument) + component]; }
    [[nodiscard]] double operator[](std::size_t argument) const { return scalar(argument); }
    [[nodiscard]] dvec2 vec2(std::size_t argument) const { return {scalar(argument), scalar(argument, 1)}; }
    [[nodiscard]] dvec3 vec3(std::size_t argument) const { return {scalar(argument), scalar(argument, 1), scalar(argument, 2)}; }
    [[nodiscard]] dvec4 vec4(std::size_t argument) const { return {vec3(argument), scalar(argument, 3)}; }
    [[nodiscard]] bool seed() const { return setting_ == 0; }
    [[nodiscard]] bool corrected() const { return setting_ == 2; }

private:
    [[nodiscard]] std::size_t first(std::size_t argument) const {
        std::size_t at = 0;
        for (std::size_t i = 0; i < argument; ++i)
            at += static_cast<std::size_t>(arguments_[i].components);
        return at;
    }

    std::span<const double> values_;
    const std::vector<Argument>& arguments_;
    int setting_;
};
using In = const Inputs&;

/// Texels given to functions that sample; read by the shader through gTest (POINT, CLAMP), by the reference through `texel`.
struct TestMap {
    int size = 0;
    std::vector<std::array<float, 4>> texels;
    int height = 0;    // 0: as many rows as columns
    int mips = 1;      // their texels follow each other; the references below know the first alone
    bool cube = false; // six faces, one after the other: +X -X +Y -Y +Z -Z

    [[nodiscard]] int rows() const { return height > 0 ? height : size; }

    /// Nearest texel, as a POINT look-up at uv.
    [[nodiscard]] dvec4 at(dvec2 uv) const;
    [[nodiscard]] dvec4 texel(int x, int y) const; // clamped
};

/// A texture of a case: its own, or one that lives as long as the program and that many cases have.
class GivenMap {
public:
    GivenMap() = default;
    GivenMap(TestMap own) : map_(std::make_shared<const TestMap>(std::move(own))) {}    // NOLINT(google-explicit-constructor)
    GivenMap(const TestMap* shared) : map_(std::shared_ptr<const TestMap>(), shared) {} // NOLINT(google-explicit-constructor)
    [[nodiscard]] const TestMap& operator*() const { return *map_; }

private:
    std::shared_ptr<const TestMap> map_;
};

/// A result passes if it is exact for arguments changed by `backward` ULP (and their slack), then rounded by `forward` ULP, or within
/// `absolute`.
struct Tolerance {
    double forward = 4;
    double backward = 2;
    double absolute = 0;
    std::string why;
};

using Values = std::array<double, 4>;

[[nodiscard]] inline Values values(double a, double b = 0, double c = 0, double d = 0) {
    return {a, b, c, d};
}
[[nodiscard]] inline Values values(const dvec2& v) {
    return {v.x, v.y, 0, 0};
}
[[nodiscard]] inline Values values(const dvec3& v) {
    return {v.x, v.y, v.z, 0};
}
[[nodiscard]] inline Values values(const dvec4& v) {
    return {v.x, v.y, v.z, v.w};
}
[[nodiscard]] inline Values values(const Values& v) {
    return v;
}

/// What a function should return: numbers, a vector, or four values.
struct Reference : std::function<Values(In)> {
    Reference() = default;
    template <class Formula>
    requires(!std::is_base_of_v<Reference, Formula>) Reference(Formula formula) // NOLINT(google-explicit-constructor)
        : function([formula = std::move(formula)](In x) { return values(formula(x)); }) {}
};

/// "name(a0, a1)", which returns up to four numbers; or a name, and statements that return a float4. They read the arguments a0, a1, ...;
/// `pixel` is the place in a 2 x 2 quad.
struct Call {
    std::string function;
    std::string body;

    Call(const char* expression) // NOLINT(google-explicit-constructor)
        : function(expression, std::string_view(expression).find('(')), body(std::string("return tgFour(") + expression + ");") {}
    Call(std::string name, std::string statements) : function(std::move(name)), body(std::move(statements)) {}
};

/// What a pixel that the function leaves without a colour counts as, where a case says that it may (CaseOptions::discards).
inline constexpr Values kDiscarded = {-7, -7, -7, -7};

using Arguments = std::vector<Argument>;
using Defines = std::vector<std::pair<std::string, std::string>>;

struct CaseOptions {
    std::vector<int> settings = {2};
    int samples = 4096;
    const TestMap* map = nullptr;
    bool filtered = false;                              // gTest is a linear sampler
    bool perQuad = false;                               // the same arguments in each 2 x 2 quad, for derivatives
    std::map<std::string, std::vector<double>> globals; // parameters of workspace.fxh for functions that read them; matrices row by row
    Defines defines;                                    // besides setting and size of the maps
    std::function<bool(In)> domain;                     // elsewhere only finiteness is asked; default: everywhere
    std::string effect; // of whose passes the function is, in effects/; its textures are `map`. Empty: a function of hlsl/
    std::map<std::string, GivenMap> maps; // textures by their names, in place of `map`
    bool discards = false;                // a pixel that is left out is kDiscarded, not a failure
};

struct FunctionCase : CaseOptions {
    FunctionCase(Call call, Arguments given, Tolerance allowed, CaseOptions options, Reference should)
        : CaseOptions(std::move(options)), function(std::move(call.function)), body(std::move(call.body)), arguments(std::move(given)),
          expected(std::move(should)), tolerance(std::move(allowed)) {}

    std::string function;
    std::string body;
    Arguments arguments;
    Reference expected;
    Tolerance tolerance;
};

[[nodiscard]] inline FunctionCase check(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
    return {std::move(call), std::move(arguments), std::move(tolerance), {}, std::move(expected)};
}
[[nodiscard]] inline FunctionCase check(Call call, Arguments arguments, Tolerance tolerance, CaseOptions options, Reference expected) {
    return {std::move(call), std::move(arguments), std::move(tolerance), std::move(options), std::move(expected)};
}

struct Cases : std::vector<FunctionCase> {
    using vector::vector;
    void operator+=(FunctionCase one) { push_back(std::move(one)); }
    void add(Call call, Arguments arguments, Tolerance tolerance, Reference expected) {
        push_back({std::move(call), std::move(arguments), std::move(tolerance), {}, std::move(expected)});
    }
    void add(Call call, Arguments arguments, Tolerance tolerance, CaseOptions options, Reference expected) {
        push_back({std::move(call), std::move(arguments), std::move(tolerance), std::move(options), std::move(expected)});
    }
};

/// Cases, lists of them, and functions that add to a list, in this order.
template <class... Parts>
[[nodiscard]] Cases together(Parts... parts) {
    Cases all;
    const auto add = [&](auto& part) {
        if constexpr (std::is_invocable_v<decltype(part), Cases&>)
            part(all);
        else if constexpr (std::is_same_v<std::remove_reference_t<decltype(part)>, FunctionCase>)
            all += std::move(part);
        else
            std::ranges::move(part, std::back_inserter(all));
    };
    (add(parts), ...);
    return all;
}

/// Every case of every function.
[[nodiscard]] Cases allCases();

[[nodiscard]] Cases specularCases();
[[nodiscard]] Cases lightCases();
[[nodiscard]] Cases surfaceCases();
[[nodiscard]] Cases workspaceCases();
[[nodiscard]] Cases shadowCases();
[[nodiscard]] Cases softShadowCases();
[[nodiscard]] Cases gaussianCases();
[[nodiscard]] Cases poissonCases();
[[nodiscard]] Cases scatterCases();
[[nodiscard]] Cases pyramidCases();
[[nodiscard]] Cases postCases();
[[nodiscard]] Cases toneCases();
[[nodiscard]] Cases cullCases();
[[nodiscard]] Cases furCases();
[[nodiscard]] Cases furRootsCases();
[[nodiscard]] Cases furRibbonCases();
[[nodiscard]] Cases fibreCases();
[[nodiscard]] Cases lockCases();
[[nodiscard]] Cases lockLightCases();
[[nodiscard]] Cases ribbonPassCases();
[[nodiscard]] Cases strandPassCases();
[[nodiscard]] Cases computePassCases();
[[nodiscard]] Cases furShellCases();
[[nodiscard]] Cases furSweepCases();
[[nodiscard]] Cases furLayerCases();
[[nodiscard]] Cases furMotionCases();
[[nodiscard]] Cases lockPassCases();
[[nodiscard]] Cases strandRibbonCases();
[[nodiscard]] Cases furNotedCases();
[[nodiscard]] Cases pyramidPassCases();
[[nodiscard]] Cases pyramidLinkCases();
[[nodiscard]] Cases pyramidFinalCases();
[[nodiscard]] Cases skinPassCases();
[[nodiscard]] Cases skinMapCases();
[[nodiscard]] Cases lampPassCases();
[[nodiscard]] Cases peerScreenCases();
[[nodiscard]] Cases peerDiscCases();
[[nodiscard]] Cases peerTableCases();

/// Texels along the maps that functions are tested with: TEGUMENT_MAP_SIZE.
inline constexpr int kTestMapSize = 256;

} // namespace tegument::test
