#include "tools/cli/palette.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>

namespace tegument::app {

namespace {

using Colour = std::array<float, 3>;

constexpr unsigned kBits = 5; // of each channel, by which colours are counted together
constexpr std::size_t kCells = std::size_t{1} << (3 * kBits);

struct Cell {
    std::array<double, 3> sum{};
    double pixels = 0;

    [[nodiscard]] double mean(std::size_t channel) const { return sum[channel] / pixels; }
};

/// Colours that the palette will show as one.
struct Part {
    std::vector<Cell> cells;
    std::size_t channel = 0; // that varies most
    double spread = 0;       // its squared differences from the mean, over all pixels
    double middle = 0;       // that mean
};

Part partOf(std::vector<Cell> cells) {
    Part part{.cells = std::move(cells)};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        double pixels = 0, sum = 0, squares = 0;
        for (const Cell& cell : part.cells) {
            const double mean = cell.mean(channel);
            pixels += cell.pixels, sum += cell.sum[channel], squares += cell.pixels * mean * mean;
        }
        const double spread = squares - sum * sum / pixels;
        if (channel == 0 || spread > part.spread) part.channel = channel, part.spread = spread, part.middle = sum / pixels;
    }
    return part;
}

std::vector<Cell> cellsOf(std::span<const std::uint8_t> rgb) {
    std::vector<Cell> cells(kCells);
    for (std::size_t i = 0; i + 2 < rgb.size(); i += 3) {
        std::size_t index = 0;
        for (std::size_t channel = 0; channel < 3; ++channel)
            index = index << kBits | static_cast<std::size_t>(rgb[i + channel] >> (8 - kBits));
        for (std::size_t channel = 0; channel < 3; ++channel)
            cells[index].sum[channel] += rgb[i + channel];
        cells[index].pixels += 1;
    }
    std::erase_if(cells, [](const Cell& cell) { return cell.pixels == 0; });
    return cells;
}

Rgb meanOf(const Part& part) {
    Cell all;
    for (const Cell& cell : part.cells) {
        for (std::size_t channel = 0; channel < 3; ++channel)
            all.sum[channel] += cell.sum[channel];
        all.pixels += cell.pixels;
    }
    Rgb mean{};
    for (std::size_t channel = 0; channel < 3; ++channel)
        mean[channel] = static_cast<std::uint8_t>(std::lround(all.mean(channel)));
    return mean;
}

float squaredDistance(const Colour& a, const Rgb& b) {
    float sum = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const float difference = a[channel] - static_cast<float>(b[channel]);
        sum += difference * difference;
    }
    return sum;
}

/// The nearest colour of a palette; found once for colours that are alike in their upper bits.
class Nearest {
public:
    explicit Nearest(std::span<const Rgb> palette) : palette_(palette), known_(std::size_t{1} << (3 * kKept), kUnknown) {}

    std::uint8_t operator()(const Colour& colour) {
        std::size_t index = 0;
        for (const float value : colour)
            index = index << kKept | static_cast<std::size_t>(value) >> (8 - kKept);
        if (known_[index] == kUnknown) known_[index] = find(colour);
        return static_cast<std::uint8_t>(known_[index]);
    }

private:
    static constexpr unsigned kKept = 6;
    static constexpr std::uint16_t kUnknown = std::numeric_limits<std::uint16_t>::max();

    [[nodiscard]] std::uint16_t find(const Colour& colour) const {
        const auto nearest = std::ranges::min_element(palette_, {}, [&](const Rgb& entry) { return squaredDistance(colour, entry); });
        return static_cast<std::uint16_t>(nearest - palette_.begin());
    }

    std::span<const Rgb> palette_;
    std::vector<std::uint16_t> known_;
};

/// Errors that wait for the pixels of a line; one place more on each side.
using Waiting = std::vector<Colour>;

void spread(const Colour& error, std::size_t at, bool fromRight, Waiting& line, Waiting& next) {
    const std::size_t ahead = fromRight ? at - 1 : at + 1;
    const std::size_t behind = fromRight ? at + 1 : at - 1;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        line[ahead][channel] += error[channel] * (7.0F / 16);
        next[behind][channel] += error[channel] * (3.0F / 16);
        next[at][channel] += error[channel] * (5.0F / 16);
        next[ahead][channel] += error[channel] * (1.0F / 16);
    }
}

} // namespace

std::vector<Rgb> paletteOf(std::span<const std::uint8_t> rgb) {
    assert(rgb.size() >= 3);
    std::vector<Part> parts;
    parts.push_back(partOf(cellsOf(rgb)));
    while (parts.size() < kPaletteSize) {
        const auto widest = std::ranges::max_element(parts, {}, [](const Part& part) { return part.cells.size() > 1 ? part.spread : -1; });
        if (widest->cells.size() < 2) break;
        const auto upper = std::partition(widest->cells.begin(), widest->cells.end(),
                                          [&](const Cell& cell) { return cell.mean(widest->channel) <= widest->middle; });
        if (upper == widest->cells.end()) break; // all alike, within rounding
        std::vector<Cell> taken(upper, widest->cells.end());
        widest->cells.erase(upper, widest->cells.end());
        *widest = partOf(std::move(widest->cells));
        parts.push_back(partOf(std::move(taken)));
    }
    std::vector<Rgb> palette;
    std::ranges::transform(parts, std::back_inserter(palette), meanOf);
    return palette;
}

std::vector<std::uint8_t> dithered(std::span<const std::uint8_t> rgb, std::size_t width, std::span<const Rgb> palette) {
    assert(width > 0 && rgb.size() % (3 * width) == 0);
    std::vector<std::uint8_t> numbers(rgb.size() / 3);
    Nearest nearest(palette);
    Waiting line(width + 2), next(width + 2);
    for (std::size_t y = 0; y < numbers.size() / width; ++y) {
        const bool fromRight = y % 2 == 1;
        for (std::size_t i = 0; i < width; ++i) {
            const std::size_t x = fromRight ? width - 1 - i : i;
            const std::size_t pixel = y * width + x;
            Colour wanted{};
            for (std::size_t channel = 0; channel < 3; ++channel)
                wanted[channel] = std::clamp(static_cast<float>(rgb[3 * pixel + channel]) + line[x + 1][channel], 0.0F, 255.0F);
            numbers[pixel] = nearest(wanted);
            const Rgb& shown = palette[numbers[pixel]];
            for (std::size_t channel = 0; channel < 3; ++channel)
                wanted[channel] -= static_cast<float>(shown[channel]);
            spread(wanted, x + 1, fromRight, line, next);
        }
        line.swap(next);
        std::ranges::fill(next, Colour{});
    }
    return numbers;
}

} // namespace tegument::app
