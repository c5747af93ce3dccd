#include "tests/hlsl/samples.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace tegument::test {

namespace {

constexpr unsigned kSeed = 20070807; // any fixed number
constexpr int kMatesOfSpecials = 6;  // stratified lists that each special value is put into

using Random = std::mt19937;

double fraction(Random& random) {
    return static_cast<double>(random()) / 4294967296.0;
}

/// One value in each of `count` equal strata of [0, 1), in random order.
std::vector<double> strata(std::size_t count, Random& random) {
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = (static_cast<double>(i) + fraction(random)) / static_cast<double>(count);
    std::shuffle(values.begin(), values.end(), random);
    return values;
}

double logSpread(double low, double high, double t) {
    return low * std::pow(high / low, t);
}

double spreadCosine(const Argument& argument, double t) {
    constexpr double kSmallest = 1e-7;
    if (t < 0.5) return argument.low + (argument.high - argument.low) * 2 * t;
    const double magnitude = logSpread(kSmallest, 1, std::fmod(4 * (t - 0.5), 1.0));
    return std::clamp(t < 0.75 ? magnitude : -magnitude, argument.low, argument.high);
}

/// A direction, from as many numbers in [0, 1) as it has components (the last gives the length).
void direction(const Argument& argument, std::span<const double> t, std::span<float> out) {
    const double turn = 2 * std::numbers::pi * t[0];
    const double length = argument.spread == Spread::Unit ? 1 : logSpread(argument.low, argument.high, t[out.size() - 1]);
    if (out.size() == 2) {
        out[0] = static_cast<float>(length * std::cos(turn));
        out[1] = static_cast<float>(length * std::sin(turn));
        return;
    }
    const double z = 2 * t[1] - 1;
    const double ring = std::sqrt(1 - z * z);
    out[0] = static_cast<float>(length * ring * std::cos(turn));
    out[1] = static_cast<float>(length * ring * std::sin(turn));
    out[2] = static_cast<float>(length * z);
    if (out.size() == 4) out[3] = static_cast<float>(length * (2 * t[2] - 1));
}

void spread(const Argument& argument, std::span<const double> t, std::span<float> out) {
    if (argument.spread == Spread::Unit || argument.spread == Spread::Vector) return direction(argument, t, out);
    for (std::size_t c = 0; c < out.size(); ++c) {
        double value = argument.low + (argument.high - argument.low) * t[c];
        if (argument.spread == Spread::Log) value = logSpread(argument.low, argument.high, t[c]);
        if (argument.spread == Spread::Cosine) value = spreadCosine(argument, t[c]);
        if (argument.spread == Spread::Whole) value = std::floor(argument.low + (argument.high - argument.low + 1) * t[c]);
        out[c] = static_cast<float>(value);
    }
}

std::vector<float> specialScalars(const Argument& argument) {
    constexpr float kDenormal = 1e-40F;
    const float one = 1;
    std::vector<float> all = {0.0F,
                              -0.0F,
                              std::numeric_limits<float>::denorm_min(),
                              kDenormal,
                              -kDenormal,
                              std::numeric_limits<float>::min(),
                              1e-30F,
                              1e-20F,
                              1e-10F,
                              1e-7F,
                              -1e-7F,
                              1e-5F,
                              1e-4F,
                              1e-3F,
                              0.01F,
                              0.5F,
                              std::nextafter(one, 0.0F),
                              one,
                              std::nextafter(one, 2.0F),
                              -one,
                              static_cast<float>(argument.low),
                              static_cast<float>(argument.high)};
    // What lies below a logarithmic range is still an input that may occur: zero and denormals. What lies outside the others may not.
    const double low = argument.spread == Spread::Log ? 0 : argument.low;
    std::erase_if(all, [&](float v) { return v < low || v > argument.high; });
    if (argument.spread == Spread::Whole) std::erase_if(all, [](float v) { return v != std::floor(v); });
    return all;
}

/// Special values of a whole argument: of a vector also zero, denormal and axis-parallel ones.
std::vector<std::vector<float>> specials(const Argument& argument) {
    std::vector<std::vector<float>> all;
    const auto n = static_cast<std::size_t>(argument.components);
    if (argument.spread == Spread::Unit || argument.spread == Spread::Vector) {
        for (float length : {0.0F, 1e-40F, 1e-20F, 1e-10F}) // no direction is left of these, also where a unit vector is asked for
            all.emplace_back(n, length);
        const float length = argument.spread == Spread::Unit ? 1.0F : static_cast<float>(argument.high);
        for (std::size_t axis = 0; axis < n; ++axis)
            for (float sign : {1.0F, -1.0F}) {
                all.emplace_back(n, 0.0F)[axis] = sign * length;
                all.emplace_back(n, 1e-7F * length)[axis] = sign * length; // grazing
            }
        return all;
    }
    for (float value : specialScalars(argument))
        all.emplace_back(n, value);
    return all;
}

class Maker {
public:
    explicit Maker(const FunctionCase& function) : function_(function) {
        for (const Argument& argument : function.arguments)
            result_.components += argument.components;
    }

    Samples make() {
        addStratified(static_cast<std::size_t>(function_.samples));
        forEachArgument([&](const Argument& argument, std::size_t first) {
            for (const auto& special : specials(argument))
                addWith(first, special, kMatesOfSpecials);
        });
        result_.finite = result_.count();
        constexpr float kInfinity = std::numeric_limits<float>::infinity();
        for (std::size_t c = 0; c < static_cast<std::size_t>(result_.components); ++c)
            for (float hostile : {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity})
                addWith(c, {hostile}, 2);
        return std::move(result_);
    }

private:
    template <class Visit>
    void forEachArgument(Visit visit) {
        std::size_t first = 0;
        for (const Argument& argument : function_.arguments) {
            visit(argument, first);
            first += static_cast<std::size_t>(argument.components);
        }
    }

    void addStratified(std::size_t count) {
        const auto components = static_cast<std::size_t>(result_.components);
        std::vector<std::vector<double>> dimensions;
        for (std::size_t c = 0; c < components; ++c)
            dimensions.push_back(strata(count, random_));
        for (std::size_t i = 0; i < count; ++i) {
            std::vector<double> t(components);
            for (std::size_t c = 0; c < components; ++c)
                t[c] = dimensions[c][i];
            std::vector<float> list(components);
            forEachArgument([&](const Argument& argument, std::size_t first) {
                const auto n = static_cast<std::size_t>(argument.components);
                spread(argument, std::span(t).subspan(first, n), std::span(list).subspan(first, n));
            });
            result_.values.insert(result_.values.end(), list.begin(), list.end());
        }
    }

    void addWith(std::size_t first, const std::vector<float>& special, std::size_t count) {
        addStratified(count);
        const auto components = static_cast<std::size_t>(result_.components);
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t list = result_.values.size() - (i + 1) * components;
            std::ranges::copy(special, result_.values.begin() + static_cast<std::ptrdiff_t>(list + first));
        }
    }

    const FunctionCase& function_;
    Samples result_;
    Random random_{kSeed};
};

} // namespace

Samples makeSamples(const FunctionCase& function) {
    return Maker(function).make();
}

} // namespace tegument::test
