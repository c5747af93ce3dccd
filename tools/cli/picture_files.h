#pragma once
// The files that a run leaves: its picture and its targets.

#include "host/run/run.h"

#include <filesystem>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tegument::app {

struct PictureOptions {
    bool displayReferred = false;               // of foreign effects: colours are a display's already, nothing is tone mapped
    std::string output;                         // empty: out/<effect>.png
    std::vector<std::string> formats = {"exr"}; // of dumped targets: exr, dds, png
    std::string ddsHeader = "dx10";             // or d3d9
    bool mips = false;                          // DDS files get their whole mip chain
};

void addPictureOptions(CLI::App& command, PictureOptions& options);

/// `moving`: of several pictures, which may be one animation. TG8016 for an ending that is not written, TG5002 for a place that cannot be
/// written to.
[[nodiscard]] Result<std::filesystem::path> outputPath(const PictureOptions& options, const std::filesystem::path& effect,
                                                       bool moving = false);

/// The picture alone, as its ending says.
[[nodiscard]] Result<void> writePicture(const PictureOptions& options, const std::filesystem::path& output, const Image& image);

/// <output without extension>.<target>.<format>
[[nodiscard]] std::filesystem::path dumpPath(const std::filesystem::path& output, const std::string& target, const std::string& format);

/// Writes the picture and every dumped target in each format: halves as halves, floats as floats. Returns what was written, the picture
/// last.
[[nodiscard]] Result<std::vector<std::filesystem::path>> writePictures(const PictureOptions& options, const std::filesystem::path& output,
                                                                       const RunResult& result);

} // namespace tegument::app
