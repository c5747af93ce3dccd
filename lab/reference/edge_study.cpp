#include "lab/reference/edge_study.h"

#include "lab/reference/convolution.h"

#include <algorithm>
#include <cmath>

namespace tegument::reference {

namespace {

constexpr double kHalfWidth = 10; // mm over which errors are taken
constexpr double kStep = 0.01;    // mm between the places looked at

double kernelSum() {
    double sum = 0;
    for (double w : kPrintedKernel)
        sum += w;
    return sum;
}

/// Of the kernel with interpolated taps `spacing` texels apart, divided by its sum, in squared texels.
double kernelVariance(double spacing) {
    double sum = 0;
    for (int j = -3; j <= 3; ++j) {
        const double place = j * spacing;
        const double left = std::floor(place);
        const double f = place - left;
        sum += kPrintedKernel[static_cast<std::size_t>(j + 3)] * ((1 - f) * left * left + f * (left + 1) * (left + 1));
    }
    return sum / kernelSum();
}

double spacingFor(double variance) {
    double low = 0;
    double high = std::sqrt(std::max(variance, 0.0)) + 1;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (kernelVariance(middle) < variance ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

double between(const std::vector<double>& row, double place) {
    const double inside = std::clamp(place, 0.0, static_cast<double>(row.size() - 1));
    const auto left = std::min(static_cast<std::size_t>(inside), row.size() - 2);
    return std::lerp(row[left], row[left + 1], inside - static_cast<double>(left));
}

std::vector<double> blurred(const std::vector<double>& row, double spacing, double gain) {
    std::vector<double> result;
    for (std::size_t i = 0; i < row.size(); ++i) {
        double sum = 0;
        for (int j = -3; j <= 3; ++j)
            sum += kPrintedKernel[static_cast<std::size_t>(j + 3)] * between(row, static_cast<double>(i) + j * spacing);
        result.push_back(sum * gain);
    }
    return result;
}

/// Mean over a pixel.
glm::dvec3 seenThrough(const EdgeResponse& response, double x, double width) {
    constexpr int kParts = 24;
    glm::dvec3 sum(0);
    for (int i = 0; i < kParts; ++i)
        sum += response(x + width * ((i + 0.5) / kParts - 0.5));
    return sum / static_cast<double>(kParts);
}

} // namespace

EdgeError edgeError(const std::function<EdgeResponse(double)>& response, double footprint, int phases) {
    const EdgeResponse exact = [](double x) { return halfPlane(skinProfile(), x); };
    const int places = static_cast<int>(2 * kHalfWidth / kStep) + 1;
    EdgeError error;
    for (int phase = 0; phase < phases; ++phase) {
        const EdgeResponse rendered = response(static_cast<double>(phase) / phases);
        for (int i = 0; i < places; ++i) {
            const double x = -kHalfWidth + i * kStep;
            const glm::dvec3 difference = seenThrough(rendered, x, footprint) - seenThrough(exact, x, footprint);
            error.largest = glm::max(error.largest, glm::abs(difference));
            error.rms += difference * difference;
        }
    }
    error.rms = glm::sqrt(error.rms / (static_cast<double>(places) * phases));
    return error;
}

EdgeResponse edgeOf(const EdgePipeline& pipeline, double phase) {
    constexpr double kExtent = 40; // mm on both sides: nothing comes back from the ends
    const int half = static_cast<int>(kExtent / pipeline.texel);
    std::vector<double> row;
    for (int i = -half; i <= half; ++i) // texel i has its centre at (i + phase) texels from the edge
        row.push_back(std::clamp(i + phase + 0.5, 0.0, 1.0));

    const Profile& profile = skinProfile();
    const double square = pipeline.texel * pipeline.texel;
    double present = pipeline.normalised ? square / 12 : pipeline.countedFirst;
    std::vector<std::vector<double>> maps = {row};
    for (std::size_t i = 1; i < profile.size(); ++i) {
        const double lacking = std::max(profile[i].variance - present, 0.0) / square;
        present = std::max(present, profile[i].variance);
        const double spacing = pipeline.normalised ? spacingFor(lacking) : std::sqrt(lacking);
        maps.push_back(blurred(maps.back(), spacing, pipeline.normalised ? 1 / kernelSum() : 1));
    }
    return [=](double x) {
        glm::dvec3 sum(0);
        for (std::size_t i = 0; i < maps.size(); ++i) {
            const bool evaluated = static_cast<int>(i) < pipeline.exact;
            double value = between(maps[i], x / pipeline.texel - phase + half);
            if (evaluated) value = 0.5 * (1 + std::erf(x / std::sqrt(2 * profile[i].variance)));
            if (i == 0 && pipeline.sharpFirst) value = x > 0 ? 1 : 0;
            sum += profile[i].weight * value;
        }
        return sum;
    };
}

EdgeResponse sharpEdge() {
    return [](double x) { return glm::dvec3(x > 0 ? 1 : 0); };
}

} // namespace tegument::reference
