#include "tests/hlsl/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tegument::test {

namespace {

constexpr double kSmallestNormal = std::numeric_limits<float>::min();
/// Relative errors of smaller values are no news: they come from what is flushed to zero.
constexpr double kSmallestCounted = 1e-30;

double ulpAt(double value) {
    const double magnitude = std::max(std::abs(value), kSmallestNormal);
    return std::ldexp(1.0, std::ilogb(magnitude) - 23);
}

bool finite(std::span<const double> values) {
    return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

class Judge {
public:
    Judge(const FunctionCase& function, int setting) : function_(function), setting_(setting) {
        for (const Argument& argument : function.arguments)
            for (int c = 0; c < argument.components; ++c)
                slack_.push_back(argument.slack);
    }

    void add(std::size_t list, std::span<const float> arguments, const std::array<float, 4>& result) {
        const std::array<double, 4> actual = {result[0], result[1], result[2], result[3]};
        if (!finite(actual)) {
            verdict_.notFinite.push_back(list);
            return;
        }
        std::vector<double> exact(arguments.begin(), arguments.end());
        std::vector<double> flushed = exact; // hardware may take denormal arguments for zeros
        for (double& v : flushed)
            if (std::abs(v) < kSmallestNormal) v = 0;
        if (function_.domain && !function_.domain(Inputs(exact, function_.arguments, setting_))) return;
        const Errors taken = errors(exact, actual);
        note(list, flushed == exact ? taken : std::min(taken, errors(flushed, actual)));
        ++verdict_.compared;
    }

    [[nodiscard]] Verdict verdict() const { return verdict_; }

private:
    struct Errors {
        double allowed = 0; // first: it decides which of two is the smaller
        double absolute = 0;
        double relative = 0;
        double ulp = 0;
        std::size_t component = 0;
        // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 reads the defaulted operator's comparison with a literal 0 as a pointer
        auto operator<=>(const Errors&) const = default;
    };

    [[nodiscard]] Values expected(std::span<const double> arguments) const {
        return function_.expected(Inputs(arguments, function_.arguments, setting_));
    }

    /// How far each component of the result moves when the arguments move by what rounding may have done to them.
    [[nodiscard]] Values sensitivity(std::vector<double> arguments, const Values& at) const {
        Values moved{};
        if (function_.tolerance.backward == 0) return moved;
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const double kept = arguments[i];
            const double step = function_.tolerance.backward * ulpAt(kept) + slack_[i];
            Values here{};
            for (double sign : {-1.0, 1.0}) {
                arguments[i] = kept + sign * step;
                const Values near = expected(arguments);
                for (std::size_t c = 0; c < 4; ++c)
                    if (std::isfinite(near[c])) here[c] = std::max(here[c], std::abs(near[c] - at[c]));
            }
            arguments[i] = kept;
            for (std::size_t c = 0; c < 4; ++c)
                moved[c] += here[c];
        }
        return moved;
    }

    [[nodiscard]] Errors errors(const std::vector<double>& arguments, const std::array<double, 4>& actual) const {
        const Values should = expected(arguments);
        const Values moved = sensitivity(arguments, should);
        Errors worst;
        for (std::size_t c = 0; c < 4; ++c) {
            const double error = std::abs(actual[c] - should[c]);
            const double limit = function_.tolerance.forward * ulpAt(should[c]) + moved[c] + function_.tolerance.absolute + kSmallestNormal;
            const bool counts = std::abs(should[c]) >= std::max(kSmallestCounted, 1000 * function_.tolerance.absolute);
            const Errors here{.allowed = std::isfinite(should[c]) ? error / limit : std::numeric_limits<double>::infinity(),
                              .absolute = error,
                              .relative = counts ? error / std::abs(should[c]) : 0,
                              .ulp = counts ? error / ulpAt(should[c]) : 0,
                              .component = c};
            worst = {std::max(worst.allowed, here.allowed), std::max(worst.absolute, here.absolute),
                     std::max(worst.relative, here.relative), std::max(worst.ulp, here.ulp),
                     here.allowed > worst.allowed ? c : worst.component};
        }
        return worst;
    }

    void note(std::size_t list, const Errors& found) {
        const auto keep = [&](Worst& worst, double error) {
            if (error > worst.error) worst = {error, list, found.component};
        };
        keep(verdict_.absolute, found.absolute);
        keep(verdict_.relative, found.relative);
        keep(verdict_.ulp, found.ulp);
        keep(verdict_.allowed, found.allowed);
    }

    const FunctionCase& function_;
    int setting_;
    std::vector<double> slack_;
    Verdict verdict_;
};

} // namespace

Verdict judge(const FunctionCase& function, int setting, const Samples& samples, const Evaluated& evaluated) {
    Judge judge(function, setting);
    for (std::size_t list = 0; list < samples.finite; ++list)
        judge.add(list, samples.list(list), evaluated.results[list]);
    return judge.verdict();
}

std::string describe(const FunctionCase& function, std::span<const float> list) {
    std::string text;
    std::size_t at = 0;
    for (std::size_t i = 0; i < function.arguments.size(); ++i) {
        const auto n = static_cast<std::size_t>(function.arguments[i].components);
        const auto part = list.subspan(at, n);
        text += fmt::format("{}a{} = {}{:.9g}{}", i == 0 ? "" : ", ", i, n > 1 ? "(" : "", fmt::join(part, ", "), n > 1 ? ")" : "");
        at += n;
    }
    return text;
}

} // namespace tegument::test
