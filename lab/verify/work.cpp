#include "lab/verify/work.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace tegument::verify {

namespace {

std::size_t pixelCount(const Image& image) {
    return static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
}

bool counted(const std::vector<std::uint8_t>& counts, std::size_t pixel) {
    return counts.empty() || counts[pixel] != 0;
}

/// The pixels that count, in one row: masks are not the business of the picture comparison.
Image packed(const Image& image, const std::vector<std::uint8_t>& counts) {
    Image row{.width = 0, .height = 1, .channels = image.channels};
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t pixel = 0; pixel < pixelCount(image); ++pixel) {
        if (!counted(counts, pixel)) continue;
        const float* values = image.pixels.data() + pixel * channels;
        row.pixels.insert(row.pixels.end(), values, values + channels);
        ++row.width;
    }
    return row;
}

/// `largest`: of the pixels that count, relative to their mean; differenceImage relates to the mean of all pixels.
Image maskedDifference(const Comparison& comparison, double largest) {
    Image difference = differenceImage(comparison.rendered, comparison.reference);
    for (std::size_t pixel = 0; pixel < pixelCount(difference); ++pixel)
        if (!counted(comparison.counts, pixel)) std::fill_n(difference.pixels.begin() + static_cast<std::ptrdiff_t>(3 * pixel), 3, 0.0F);
    const float found = std::ranges::max(difference.pixels);
    for (float& value : difference.pixels)
        value = found > 0 ? value * static_cast<float>(largest) / found : value;
    return difference;
}

/// None where nothing is apart, or the reference is black there.
std::optional<double> relativeApart(const Comparison& comparison) {
    std::vector<std::uint8_t> apart = comparison.within;
    for (std::size_t i = 0; i < apart.size(); ++i)
        apart[i] = apart[i] != 0 && !counted(comparison.counts, i) ? 1 : 0;
    if (std::ranges::count(apart, 1) == 0) return std::nullopt;
    const auto difference = differenceWhere(apart, comparison.rendered, comparison.reference);
    return difference ? std::optional(difference->relativeL2) : std::nullopt;
}

} // namespace

Result<RunResult> render(const Context& context, const RenderJob& job, const Mesh* mesh, const Workspace& workspace) {
    LoadOptions load{.defines = job.defines, .setting = context.options.setting};
    load.defines.emplace_back("TEGUMENT_MAP_SIZE", std::to_string(context.options.mapSize));
    const auto effect = loadEffect(context.options.effects / job.effect, load);
    if (!effect) return effect.error();
    const RunOptions run{.technique = job.technique,
                         .width = job.size,
                         .height = job.size,
                         .compiler = context.options.compiler,
                         .parameters = job.parameters,
                         .textures = job.textures,
                         .dump = job.dump};
    return runEffect(context.device, *effect, mesh, workspace, run);
}

Result<RunResult> render(const Context& context, const Scene& scene, const RenderJob& job) {
    return render(context, job, &scene.mesh, scene.workspace);
}

void addMetric(ModuleReport& report, const Context& context, std::string name, double value, double limit, std::string why) {
    report.metrics.push_back({.module = report.module,
                              .setting = context.options.setting,
                              .name = std::move(name),
                              .value = value,
                              .limit = limit,
                              .pass = std::isfinite(value) && std::abs(value) <= limit,
                              .why = std::move(why)});
}

Result<Difference> differenceWhere(const std::vector<std::uint8_t>& counts, const Image& image, const Image& reference) {
    return compareImages(packed(image, counts), packed(reference, counts));
}

Result<void> compare(ModuleReport& report, const Context& context, const Comparison& comparison, const Limits& limits) {
    const auto difference = differenceWhere(comparison.counts, comparison.rendered, comparison.reference);
    if (!difference) return difference.error();
    const auto add = [&](const char* name, double value, double limit) {
        if (limit >= 0) addMetric(report, context, fmt::format("{}: {}", comparison.subject, name), value, limit, limits.why);
    };
    add("rel_l2", difference->relativeL2, limits.relativeL2);
    add("p99", difference->p99, limits.p99);
    add("p999", difference->p999, limits.p999);
    add("max_interior", difference->largest, limits.largest);
    add("bias", difference->bias, limits.bias);
    if (limits.apart >= 0 && !comparison.within.empty())
        if (const auto apart = relativeApart(comparison)) add("apart: rel_l2", *apart, limits.apart);
    report.pictures.push_back({comparison.subject, PictureRole::Rendered, comparison.rendered});
    report.pictures.push_back({comparison.subject, PictureRole::Reference, comparison.reference});
    report.pictures.push_back({comparison.subject, PictureRole::Difference, maskedDifference(comparison, difference->largest)});
    return {};
}

double shareApart(const std::vector<std::uint8_t>& counts, const std::vector<std::uint8_t>& covered) {
    std::size_t apart = 0;
    std::size_t all = 0;
    for (std::size_t i = 0; i < covered.size(); ++i) {
        all += covered[i] != 0;
        apart += covered[i] != 0 && counts[i] == 0;
    }
    return all == 0 ? 0 : static_cast<double>(apart) / static_cast<double>(all);
}

} // namespace tegument::verify
