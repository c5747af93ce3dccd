#include "host/effect/constants.h"
#include "host/effect/operators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>

namespace tegument {

namespace {

constexpr double kExactInteger = 9007199254740992.0;

/// Componentwise functions by their number of arguments.
struct Function1 {
    std::string_view name;
    double (*apply)(double);
};
struct Function2 {
    std::string_view name;
    double (*apply)(double, double);
};
struct Function3 {
    std::string_view name;
    double (*apply)(double, double, double);
};

double saturated(double x) {
    return std::clamp(x, 0.0, 1.0);
}

constexpr std::array<Function1, 28> kFunctions1{{
    {"abs", [](double x) { return std::abs(x); }},
    {"ceil", [](double x) { return std::ceil(x); }},
    {"floor", [](double x) { return std::floor(x); }},
    {"round", [](double x) { return std::nearbyint(x); }},
    {"trunc", [](double x) { return std::trunc(x); }},
    {"frac", [](double x) { return x - std::floor(x); }},
    {"sign", [](double x) { return x > 0   ? 1.0
                                   : x < 0 ? -1.0
                                           : 0.0; }},
    {"saturate", saturated},
    {"sqrt", [](double x) { return std::sqrt(x); }},
    {"rsqrt", [](double x) { return 1 / std::sqrt(x); }},
    {"rcp", [](double x) { return 1 / x; }},
    {"exp", [](double x) { return std::exp(x); }},
    {"exp2", [](double x) { return std::exp2(x); }},
    {"log", [](double x) { return std::log(x); }},
    {"log2", [](double x) { return std::log2(x); }},
    {"log10", [](double x) { return std::log10(x); }},
    {"sin", [](double x) { return std::sin(x); }},
    {"cos", [](double x) { return std::cos(x); }},
    {"tan", [](double x) { return std::tan(x); }},
    {"asin", [](double x) { return std::asin(x); }},
    {"acos", [](double x) { return std::acos(x); }},
    {"atan", [](double x) { return std::atan(x); }},
    {"sinh", [](double x) { return std::sinh(x); }},
    {"cosh", [](double x) { return std::cosh(x); }},
    {"tanh", [](double x) { return std::tanh(x); }},
    {"radians", [](double x) { return x * std::numbers::pi / 180; }},
    {"degrees", [](double x) { return x * 180 / std::numbers::pi; }},
    {"asfloat", [](double x) { return x; }},
}};

constexpr std::array<Function2, 6> kFunctions2{{
    {"min", [](double a, double b) { return std::min(a, b); }},
    {"max", [](double a, double b) { return std::max(a, b); }},
    {"pow", [](double a, double b) { return std::pow(a, b); }},
    {"fmod", [](double a, double b) { return std::fmod(a, b); }},
    {"atan2", [](double a, double b) { return std::atan2(a, b); }},
    {"step", [](double a, double b) { return b >= a ? 1.0 : 0.0; }},
}};

constexpr std::array<Function3, 4> kFunctions3{{
    {"lerp", [](double a, double b, double t) { return a + t * (b - a); }},
    {"clamp", [](double x, double least, double most) { return std::min(std::max(x, least), most); }},
    {"mad", [](double a, double b, double c) { return a * b + c; }},
    {"smoothstep",
     [](double a, double b, double x) {
         const double t = saturated((x - a) / (b - a));
         return t * t * (3 - 2 * t);
     }},
}};

constexpr std::array<std::string_view, 7> kVectorFunctions{"dot", "length", "distance", "normalize", "cross", "any", "all"};

template <class List>
auto find(const List& list, std::string_view name) {
    return std::ranges::find_if(list, [&](const auto& entry) { return entry.name == name; });
}

std::optional<double> bits(char op, double a, double b) {
    if (!(std::abs(a) < kExactInteger) || !(std::abs(b) < kExactInteger)) return std::nullopt;
    const auto x = static_cast<std::int64_t>(a);
    const auto y = static_cast<std::int64_t>(b);
    switch (op) {
    case '|': return static_cast<double>(x | y);
    case '^': return static_cast<double>(x ^ y);
    case '&': return static_cast<double>(x & y);
    case '<': return y < 0 || y > 31 ? 0.0 : static_cast<double>(x * (std::int64_t{1} << y));
    default: return y < 0 || y > 31 ? 0.0 : static_cast<double>(x >> y);
    }
}

/// HLSL's arithmetic on two scalars: between integers '/' truncates. Nullopt where the result is no finite number.
std::optional<double> calculate(std::string_view op, double a, double b, bool integral) {
    if (const auto is = truth(op, a, b)) return *is ? 1.0 : 0.0;
    if (op == "|" || op == "^" || op == "&" || op == "<<" || op == ">>") return bits(op[0], a, b);
    double value = 0;
    switch (op[0]) {
    case '+': value = a + b; break;
    case '-': value = a - b; break;
    case '*': value = a * b; break;
    case '/': value = integral ? std::trunc(a / b) : a / b; break;
    default: value = std::fmod(a, b); break;
    }
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double at(const Constant& value, std::size_t i) {
    return value.numbers[value.numbers.size() == 1 ? 0 : i];
}

/// How many components come out: those of the longest vector; vectors of two lengths are cut to the shorter one.
std::size_t commonSize(std::span<const Constant> values) {
    std::size_t size = 1;
    for (const Constant& value : values)
        if (value.numbers.size() > 1) size = size == 1 ? value.numbers.size() : std::min(size, value.numbers.size());
    return size;
}

bool isFinite(const Constant& value) {
    return std::ranges::all_of(value.numbers, [](double n) { return std::isfinite(n); });
}

double dot(const Constant& a, const Constant& b) {
    double sum = 0;
    const std::array both{a, b};
    for (std::size_t i = 0; i < commonSize(both); ++i)
        sum += at(a, i) * at(b, i);
    return sum;
}

std::optional<Constant> onVectors(std::string_view name, std::span<const Constant> v) {
    const auto scalar = [](double x) { return Constant{.numbers = {x}}; };
    if (v.size() == 1 && name == "length") return scalar(std::sqrt(dot(v[0], v[0])));
    if (v.size() == 1 && name == "any") return scalar(std::ranges::any_of(v[0].numbers, [](double n) { return n != 0; }));
    if (v.size() == 1 && name == "all") return scalar(std::ranges::all_of(v[0].numbers, [](double n) { return n != 0; }));
    if (v.size() == 1 && name == "normalize") return applyOperator("/", v[0], scalar(std::sqrt(dot(v[0], v[0]))));
    if (v.size() == 2 && name == "dot") return scalar(dot(v[0], v[1]));
    if (v.size() == 2 && name == "distance") {
        const auto between = applyOperator("-", v[0], v[1]);
        return between ? std::optional(scalar(std::sqrt(dot(*between, *between)))) : std::nullopt;
    }
    if (v.size() == 2 && name == "cross" && v[0].numbers.size() >= 3 && v[1].numbers.size() >= 3) {
        const auto &a = v[0].numbers, &b = v[1].numbers;
        return Constant{.numbers = {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
    }
    return std::nullopt;
}

bool keepsIntegers(std::string_view name) {
    return name == "abs" || name == "min" || name == "max" || name == "clamp" || name == "sign";
}

std::optional<Constant> componentwise(std::string_view name, std::span<const Constant> v) {
    const auto* one = find(kFunctions1, name);
    const auto* two = find(kFunctions2, name);
    const auto* three = find(kFunctions3, name);
    const bool known = (v.size() == 1 && one != kFunctions1.end()) || (v.size() == 2 && two != kFunctions2.end()) ||
                       (v.size() == 3 && three != kFunctions3.end());
    if (!known) return std::nullopt;
    Constant result{.integral = keepsIntegers(name) && std::ranges::all_of(v, &Constant::integral)};
    for (std::size_t i = 0; i < commonSize(v); ++i)
        result.numbers.push_back(v.size() == 1   ? one->apply(at(v[0], i))
                                 : v.size() == 2 ? two->apply(at(v[0], i), at(v[1], i))
                                                 : three->apply(at(v[0], i), at(v[1], i), at(v[2], i)));
    return result;
}

} // namespace

std::optional<Constant> applyOperator(std::string_view op, const Constant& a, const Constant& b) {
    const std::array both{a, b};
    Constant result{.integral = a.integral && b.integral, .elements = 0, .rows = std::max(a.rows, b.rows)};
    for (std::size_t i = 0; i < commonSize(both); ++i) {
        const std::optional<double> value = calculate(op, at(a, i), at(b, i), result.integral);
        if (!value) return std::nullopt;
        result.numbers.push_back(*value);
    }
    if (truth(op, 0, 0)) result.integral = true;
    return result;
}

bool isConstantIntrinsic(std::string_view name) {
    return find(kFunctions1, name) != kFunctions1.end() || find(kFunctions2, name) != kFunctions2.end() ||
           find(kFunctions3, name) != kFunctions3.end() || std::ranges::find(kVectorFunctions, name) != kVectorFunctions.end();
}

std::optional<Constant> applyIntrinsic(std::string_view name, std::span<const Constant> arguments) {
    if (std::ranges::any_of(arguments, [](const Constant& value) { return value.numbers.empty(); })) return std::nullopt;
    auto result = onVectors(name, arguments);
    if (!result) result = componentwise(name, arguments);
    return result && isFinite(*result) ? result : std::nullopt;
}

std::optional<Constant> elementOf(const Constant& value, double index, bool clamped) {
    const auto count = static_cast<double>(value.elements > 0 ? value.elements
                                           : value.rows > 1   ? value.rows
                                                              : static_cast<int>(value.numbers.size()));
    const double whole = clamped ? std::clamp(std::trunc(index), 0.0, std::max(count - 1, 0.0)) : std::trunc(index);
    if (!(whole >= 0 && whole < count)) return std::nullopt;
    const std::size_t stride = value.numbers.size() / static_cast<std::size_t>(count);
    const auto first = value.numbers.begin() + static_cast<std::ptrdiff_t>(stride * static_cast<std::size_t>(whole));
    return Constant{.numbers = {first, first + static_cast<std::ptrdiff_t>(stride)},
                    .integral = value.integral,
                    .elements = 0,
                    .rows = value.elements > 0 ? value.rows : 1,
                    .members = value.members};
}

Constant constantOf(const Type& type, std::vector<double> numbers) {
    return {.numbers = std::move(numbers),
            .integral = type.base != BaseType::Float,
            .elements = type.elements,
            .rows = type.rows,
            .members = type.members};
}

namespace {

std::optional<Constant> memberOf(const Constant& value, std::string_view name) {
    std::size_t first = 0;
    for (const TypeMember& member : *value.members) {
        const auto count = static_cast<std::size_t>(member.type.isNumeric() || member.type.members ? member.type.scalarCount() : 0);
        if (member.name == name && first + count <= value.numbers.size()) {
            const auto begin = value.numbers.begin() + static_cast<std::ptrdiff_t>(first);
            return constantOf(member.type, {begin, begin + static_cast<std::ptrdiff_t>(count)});
        }
        first += count;
    }
    return std::nullopt;
}

std::optional<Constant> swizzled(const Constant& value, std::string_view letters) {
    constexpr std::string_view kPosition = "xyzw";
    constexpr std::string_view kColor = "rgba";
    if (letters.size() > 4 || value.elements > 0 || value.rows > 1) return std::nullopt;
    Constant result{.integral = value.integral};
    for (const char letter : letters) {
        const std::size_t place = std::min(kPosition.find(letter), kColor.find(letter));
        if (place >= value.numbers.size()) return std::nullopt;
        result.numbers.push_back(value.numbers[place]);
    }
    return result;
}

} // namespace

std::optional<Constant> partOf(const Constant& value, std::string_view name) {
    return value.members && value.elements == 0 ? memberOf(value, name) : swizzled(value, name);
}

} // namespace tegument
