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
#include <type_traits>
#include <utility>
#include <vector>

namespace tegument::test {

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
[[nodiscard]] inline bool isUnit(const glm::dvec3& v) {
    return std::abs(glm::length(v) - 1) < 1e-3;
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
    [[nodiscard]] glm::dvec2 vec2(std::size_t argument) const { return {scalar(argument), scalar(argument, 1)}; }
    [[nodiscard]] glm::dvec3 vec3(std::size_t argument) const { return {scalar(argument), scalar(argument, 1), scalar(argument, 2)}; }
    [[nodiscard]] glm::dvec4 vec4(std::size_t argument) const { return {vec3(argument), scalar(argument, 3)}; }
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

/// Texels given to functions that sample; read by the shader through gTest (POINT, CLAMP), by the reference through `texel`.
struct TestMap {
    int size = 0;
    std::vector<std::array<float, 4>> texels;
    int height = 0;    // 0: as many rows as columns
    int mips = 1;      // their texels follow each other; the references below know the first alone
    bool cube = false; // six faces, one after the other: +X -X +Y -Y +Z -Z

    [[nodiscard]] int rows() const { return height > 0 ? height : size; }

    /// Nearest texel, as a POINT look-up at uv.
    [[nodiscard]] glm::dvec4 at(glm::dvec2 uv) const;
    [[nodiscard]] glm::dvec4 texel(int x, int y) const; // clamped
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

/// What a pixel that the function leaves without a colour counts as, where a case says that it may (FunctionCase::discards).
inline constexpr Values kDiscarded = {-7, -7, -7, -7};

struct FunctionCase {
    std::string function; // its name
    std::string body;     // HLSL that returns float4 from arguments a0, a1, ...; `pixel` is the place in a 2 x 2 quad
    std::vector<Argument> arguments;
    std::function<Values(const Inputs&)> expected;
    Tolerance tolerance;
    std::vector<int> settings = {2};
    int samples = 4096;
    const TestMap* map = nullptr;
    bool filtered = false;                              // gTest is a linear sampler
    bool perQuad = false;                               // the same arguments in each 2 x 2 quad, for derivatives
    std::map<std::string, std::vector<double>> globals; // parameters of workspace.fxh for functions that read them; matrices row by row
    std::vector<std::pair<std::string, std::string>> defines = {}; // besides setting and size of the maps
    std::function<bool(const Inputs&)> domain = {};                // elsewhere only finiteness is asked; default: everywhere
    std::string effect = {}; // of whose passes the function is, in effects/; its textures are `map`. Empty: a function of hlsl/
    std::map<std::string, GivenMap> maps = {}; // textures by their names, in place of `map`
    bool discards = false;                     // a pixel that is left out is kDiscarded, not a failure
};

/// Cases, and lists of them, in this order.
template <class... Parts>
[[nodiscard]] std::vector<FunctionCase> together(Parts... parts) {
    std::vector<FunctionCase> all;
    const auto add = [&](auto& part) {
        if constexpr (std::is_same_v<std::remove_reference_t<decltype(part)>, FunctionCase>)
            all.push_back(std::move(part));
        else
            std::ranges::move(part, std::back_inserter(all));
    };
    (add(parts), ...);
    return all;
}

/// Every case of every function.
[[nodiscard]] std::vector<FunctionCase> allCases();

[[nodiscard]] std::vector<FunctionCase> specularCases();
[[nodiscard]] std::vector<FunctionCase> lightCases();
[[nodiscard]] std::vector<FunctionCase> surfaceCases();
[[nodiscard]] std::vector<FunctionCase> workspaceCases();
[[nodiscard]] std::vector<FunctionCase> shadowCases();
[[nodiscard]] std::vector<FunctionCase> softShadowCases();
[[nodiscard]] std::vector<FunctionCase> gaussianCases();
[[nodiscard]] std::vector<FunctionCase> poissonCases();
[[nodiscard]] std::vector<FunctionCase> scatterCases();
[[nodiscard]] std::vector<FunctionCase> pyramidCases();
[[nodiscard]] std::vector<FunctionCase> postCases();
[[nodiscard]] std::vector<FunctionCase> toneCases();
[[nodiscard]] std::vector<FunctionCase> cullCases();
[[nodiscard]] std::vector<FunctionCase> furCases();
[[nodiscard]] std::vector<FunctionCase> furRootsCases();
[[nodiscard]] std::vector<FunctionCase> furRibbonCases();
[[nodiscard]] std::vector<FunctionCase> fibreCases();
[[nodiscard]] std::vector<FunctionCase> lockCases();
[[nodiscard]] std::vector<FunctionCase> lockLightCases();
[[nodiscard]] std::vector<FunctionCase> ribbonPassCases();
[[nodiscard]] std::vector<FunctionCase> strandPassCases();
[[nodiscard]] std::vector<FunctionCase> computePassCases();
[[nodiscard]] std::vector<FunctionCase> furShellCases();
[[nodiscard]] std::vector<FunctionCase> furSweepCases();
[[nodiscard]] std::vector<FunctionCase> furLayerCases();
[[nodiscard]] std::vector<FunctionCase> furMotionCases();
[[nodiscard]] std::vector<FunctionCase> lockPassCases();
[[nodiscard]] std::vector<FunctionCase> strandRibbonCases();
[[nodiscard]] std::vector<FunctionCase> furNotedCases();
[[nodiscard]] std::vector<FunctionCase> pyramidPassCases();
[[nodiscard]] std::vector<FunctionCase> pyramidLinkCases();
[[nodiscard]] std::vector<FunctionCase> pyramidFinalCases();
[[nodiscard]] std::vector<FunctionCase> skinPassCases();
[[nodiscard]] std::vector<FunctionCase> skinMapCases();
[[nodiscard]] std::vector<FunctionCase> lampPassCases();
[[nodiscard]] std::vector<FunctionCase> peerScreenCases();
[[nodiscard]] std::vector<FunctionCase> peerDiscCases();
[[nodiscard]] std::vector<FunctionCase> peerTableCases();

/// Texels along the maps that functions are tested with: TEGUMENT_MAP_SIZE.
inline constexpr int kTestMapSize = 256;

[[nodiscard]] inline Values values(double a, double b = 0, double c = 0, double d = 0) {
    return {a, b, c, d};
}
[[nodiscard]] inline Values values(const glm::dvec2& v) {
    return {v.x, v.y, 0, 0};
}
[[nodiscard]] inline Values values(const glm::dvec3& v) {
    return {v.x, v.y, v.z, 0};
}
[[nodiscard]] inline Values values(const glm::dvec4& v) {
    return {v.x, v.y, v.z, v.w};
}

} // namespace tegument::test
