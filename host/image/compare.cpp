#include "host/image/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument {

namespace {

int comparedChannels(const Image& image) {
    return std::min(image.channels, 3);
}

double meanOf(const Image& image) {
    double sum = 0;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < comparedChannels(image); ++c)
                sum += image.at(x, y, c);
    return sum / image.width / image.height / comparedChannels(image);
}

Result<double> checkedMean(const Image& image, const Image& reference) {
    if (image.width != reference.width || image.height != reference.height || comparedChannels(image) != comparedChannels(reference))
        return inputError(5260, {},
                          fmt::format("the pictures differ in size: {}x{} with {} channels, {}x{} with {}", image.width, image.height,
                                      image.channels, reference.width, reference.height, reference.channels),
                          "render both with one --size");
    const double mean = meanOf(reference);
    if (!std::isfinite(mean) || !std::isfinite(meanOf(image))) return inputError(5261, {}, "a picture holds values that are not finite");
    if (mean == 0) return inputError(5261, {}, "the reference is black: relative differences have no meaning");
    return mean;
}

/// Value below which this share of the sorted values lies.
double percentile(std::vector<double>& values, double share) {
    const auto nth = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, nth);
    return *nth;
}

struct Sums {
    double squares = 0;
    double referenceSquares = 0;
    double signedDifference = 0;
};

} // namespace

Result<Difference> compareImages(const Image& image, const Image& reference, double limit) {
    const auto mean = checkedMean(image, reference);
    if (!mean) return mean.error();
    Difference result;
    Sums sums;
    std::vector<double> differences;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            bool beyond = false;
            for (int c = 0; c < comparedChannels(image); ++c) {
                const double b = reference.at(x, y, c);
                const double difference = image.at(x, y, c) - b;
                sums.squares += difference * difference;
                sums.referenceSquares += b * b;
                sums.signedDifference += difference;
                const double relative = std::abs(difference) / *mean;
                beyond = beyond || relative > limit;
                differences.push_back(relative);
                if (relative <= result.largest) continue;
                result.largest = relative;
                result.largestX = x;
                result.largestY = y;
            }
            result.pixelsBeyond += beyond;
        }
    }
    result.relativeL2 = std::sqrt(sums.squares / sums.referenceSquares);
    result.bias = sums.signedDifference / static_cast<double>(differences.size()) / *mean;
    result.beyond = static_cast<double>(result.pixelsBeyond) / image.width / image.height;
    result.p99 = percentile(differences, 0.99);
    result.p999 = percentile(differences, 0.999);
    return result;
}

Image differenceImage(const Image& image, const Image& reference) {
    const double mean = meanOf(reference);
    Image difference = plainImage(image.width, image.height, 3);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int c = 0; c < comparedChannels(image); ++c)
                difference.at(x, y, c) = static_cast<float>(std::abs(image.at(x, y, c) - reference.at(x, y, c)) / mean);
    return difference;
}

} // namespace tegument
