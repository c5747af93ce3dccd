#include "tools/cli/picture_files.h"

#include "host/image/dds.h"
#include "host/support/text.h"
#include "meshprep/assets/picture.h"
#include "tools/cli/animation.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

/// Eight bits, halves or floats as the target was declared; what DDS has no such form of becomes floats. `format` is a D3DFORMAT.
DdsFormat ddsFormat(const Image& image, const std::string& format) {
    const bool halves = format.find("16F") != std::string::npos;
    if (image.channels == 1) return halves ? DdsFormat::R16F : DdsFormat::R32F;
    if (image.channels == 2) return halves ? DdsFormat::Rg16F : DdsFormat::Rg32F;
    if (format.find('8') != std::string::npos && format.find('F') == std::string::npos) return DdsFormat::Rgba8;
    return halves ? DdsFormat::Rgba16F : DdsFormat::Rgba32F;
}

Result<void> writeTarget(const PictureOptions& options, const fs::path& path, const Image& image, const std::string& format) {
    const std::string extension = toLower(path.extension().string());
    if (extension == ".png") return writePng(path, image, PngEncoding::Raw);
    if (extension == ".exr") return writeExr(path, image, format.find("16F") != std::string::npos ? ExrDepth::Half : ExrDepth::Float);
    return writeDds(path, makeDds(image, ddsFormat(image, format), options.mips),
                    options.ddsHeader == "d3d9" ? DdsHeader::Direct3D9 : DdsHeader::Dx10);
}

std::string formatOf(const RunResult& result, const std::string& target) {
    const auto found = std::ranges::find(result.targets, target, &TargetReport::name);
    return found == result.targets.end() ? std::string() : found->format;
}

} // namespace

void addPictureOptions(CLI::App& command, PictureOptions& options) {
    command.add_option("-o,--output", options.output,
                       "Picture to write (.png, .jpg, .exr, .dds; .webp and .mp4 with --turntable); default: out/<effect>.png");
    repeatable(command.add_option("--dump-format", options.formats,
                                  "Of dumped targets: exr, dds (for engines) or png (for looking); several are separated by commas"))
        ->delimiter(',')
        ->transform(oneOf({"exr", "dds", "png"}))
        ->capture_default_str();
    command.add_flag("--mips", options.mips, "Write DDS files with all their mip levels");
    command.add_option("--dds-header", options.ddsHeader, "dx10, or d3d9 for Direct3D 9's loaders")
        ->transform(oneOf({"dx10", "d3d9"}))
        ->capture_default_str();
}

Result<fs::path> outputPath(const PictureOptions& options, const fs::path& effect, bool moving) {
    const fs::path output = options.output.empty() ? fs::path("out") / effect.stem().concat(".png") : fs::path(options.output);
    const bool still = assets::isPicture(output);
    if (still || (moving && isAnimation(output))) {
        if (const auto can = checkOutput(output.string(), {}); !can) return can.error();
        return output;
    }
    if (isAnimation(output))
        return usageError(8016, fmt::format("{} is an animation, and this is one picture", output.string()),
                          "add --turntable 48, or write a .png");
    return usageError(
        8016,
        fmt::format("{} is none of {}", output.string(), moving ? ".webp, .mp4, .png, .jpg, .exr and .dds" : ".png, .jpg, .exr and .dds"),
        moving ? "WebP and MP4 are one animated picture, the others are one file for each"
               : "PNG and JPEG are for looking, EXR and DDS hold the linear floats");
}

fs::path dumpPath(const fs::path& output, const std::string& target, const std::string& format) {
    fs::path path = output;
    return path.replace_extension(fmt::format(".{}.{}", target, format));
}

Result<void> writePicture(const PictureOptions& options, const fs::path& output, const Image& image) {
    if (!assets::isDisplayed(output)) return writeTarget(options, output, image, "A32B32G32R32F");
    return assets::writePicture(output, image, options.displayReferred);
}

Result<std::vector<fs::path>> writePictures(const PictureOptions& options, const fs::path& output, const RunResult& result) {
    std::vector<fs::path> written;
    for (const auto& [name, image] : result.dumped)
        for (const std::string& format : options.formats) {
            written.push_back(dumpPath(output, name, format));
            if (const auto done = writeTarget(options, written.back(), image, formatOf(result, name)); !done) return done.error();
        }
    const auto done = writePicture(options, output, result.image);
    if (!done) return done.error();
    written.push_back(output);
    return written;
}

} // namespace tegument::app
