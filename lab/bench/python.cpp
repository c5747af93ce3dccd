#include "lab/bench/python.h"

#include "host/support/file.h"
#include "host/support/temporary.h"
#include "host/support/text.h"
#include "tools/process/process.h"

#include <fmt/format.h>

#include <charconv>
#include <sstream>
#include <unistd.h>

namespace tegument::bench {

namespace {

namespace fs = std::filesystem;

constexpr double kTimeLimit = 600; // seconds; a plot takes two, FLIP of a large picture one
constexpr int kPackageMissing = 3; // exit code of the helpers

/// Gone when we are.
class ScratchFolder : public Temporary {
public:
    ScratchFolder() : Temporary(fs::temp_directory_path() / fmt::format("tegument-bench-{}", ::getpid())) {
        std::error_code code;
        fs::create_directories(path(), code);
    }
};

std::vector<double> numbersOf(const std::string& text) {
    std::vector<double> numbers;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        double number = 0;
        const auto parsed = std::from_chars(line.data(), line.data() + line.size(), number);
        if (parsed.ec == std::errc()) numbers.push_back(number);
    }
    return numbers;
}

/// The picture where the mask is white, black elsewhere: what surrounds the skin is not compared.
Image within(const Image& picture, const Image& mask) {
    Image masked = mask;
    for (int y = 0; y < mask.height; ++y)
        for (int x = 0; x < mask.width; ++x)
            for (int c = 0; c < 3; ++c)
                masked.at(x, y, c) *= picture.at(x, y, c);
    return masked;
}

Result<std::vector<double>> measureFlip(const fs::path& script, const Image& reference, const std::vector<const Image*>& pictures,
                                        const Image& mask) {
    const ScratchFolder folder;
    std::vector<std::string> files;
    const auto write = [&](const char* name, const Image& image, PngEncoding encoding) {
        files.push_back((folder.path() / fmt::format("{}{}.png", name, files.size())).string());
        return writePng(files.back(), image, encoding);
    };
    if (auto written = write("reference", reference, PngEncoding::Display); !written) return written.error();
    if (auto written = write("mask", mask, PngEncoding::Raw); !written) return written.error();
    for (const Image* picture : pictures)
        if (auto written = write("picture", within(*picture, mask), PngEncoding::Display); !written) return written.error();
    const auto output = runHelper(script, files);
    if (!output) return output.error();
    return numbersOf(*output);
}

} // namespace

Result<std::string> runHelper(const fs::path& script, const std::vector<std::string>& arguments) {
    std::optional<fs::path> python = findProgram("/usr/bin/python3");
    if (!python) python = findProgram("python3");
    const char* const kHint = "install python3 and python3-matplotlib, or ./bootstrap bench";
    if (!python) return machineError(8078, "there is no python3 for plots", kHint);
    ProcessCommand command{.arguments = {python->string(), script.string()},
                           .environment = {{"PYTHONPATH", (cacheFolder() / "tools" / "flip").string()}, {"PYTHONDONTWRITEBYTECODE", "1"}}};
    command.arguments.insert(command.arguments.end(), arguments.begin(), arguments.end());
    const auto ran = runProcess(command, kTimeLimit);
    if (!ran) return ran.error();
    if (ran->exitCode == 0) return ran->output;
    const std::string reason(trim(ran->output));
    return machineError(
        8078, fmt::format("{} {}: {}", script.filename().string(), ran->exitCode == kPackageMissing ? "cannot run" : "failed", reason),
        kHint);
}

FlipMeter flipMeter(const fs::path& script) {
    return [script](const Image& reference, const std::vector<const Image*>& pictures, const Image& mask) {
        const auto values = measureFlip(script, reference, pictures, mask);
        return values && values->size() == pictures.size() ? *values : std::vector<double>();
    };
}

} // namespace tegument::bench
