// tegument sheet: pictures side by side in one.

#include "host/app/commands.h"
#include "host/app/output.h"
#include "host/image/image.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace {

struct SheetArguments {
    std::vector<std::string> pictures;
    std::string output = "out/sheet.png";
    int columns = 3;
    int gap = 8;
};

constexpr float kPaper = 1.0F; // white, as the page that shows the sheet

Result<std::vector<Image>> loadAll(const std::vector<std::string>& paths) {
    std::vector<Image> images;
    for (const std::string& path : paths) {
        Result<Image> image = loadImage(path);
        if (!image) return image.error();
        images.push_back(std::move(*image));
        const Image& first = images.front();
        const Image& last = images.back();
        if (last.width != first.width || last.height != first.height)
            return inputError(8030, {.file = path, .byte = {}},
                              fmt::format("is {}x{}, the first picture {}x{}", last.width, last.height, first.width, first.height),
                              "render them with one --size");
    }
    return images;
}

float sample(const Image& image, int x, int y, int channel) {
    return image.at(x, y, image.channels < 3 ? 0 : channel);
}

Image arrange(const std::vector<Image>& images, int columns, int gap) {
    const int count = static_cast<int>(images.size());
    const int rows = (count + columns - 1) / columns;
    const int width = images.front().width;
    const int height = images.front().height;
    Image sheet{.width = columns * (width + gap) - gap,
                .height = rows * (height + gap) - gap,
                .channels = 3,
                .pixels = {},
                .metadata = images.front().metadata};
    sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3, kPaper);
    for (int i = 0; i < count; ++i)
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                for (int c = 0; c < 3; ++c)
                    sheet.at(i % columns * (width + gap) + x, i / columns * (height + gap) + y, c) =
                        sample(images[static_cast<std::size_t>(i)], x, y, c);
    return sheet;
}

int sheet(const SheetArguments& arguments) {
    const auto images = loadAll(arguments.pictures);
    if (!images) return fail(images.error(), false);
    const int columns = std::min(arguments.columns, static_cast<int>(images->size()));
    const auto written = writePng(arguments.output, arrange(*images, columns, arguments.gap), PngEncoding::Raw);
    if (!written) return fail(written.error(), false);
    fmt::print("wrote {}\n", arguments.output);
    return 0;
}

} // namespace

void addSheet(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<SheetArguments>();
    CLI::App* command = program.add_subcommand("sheet", "Put pictures of one size side by side");
    command->add_option("pictures", arguments->pictures, "PNG or JPEG files, row by row")->required();
    command->add_option("-o,--output", arguments->output, "Picture to write (.png)")->capture_default_str();
    command->add_option("--columns", arguments->columns, "Pictures in a row")->check(CLI::Range(1, 64))->capture_default_str();
    command->add_option("--gap", arguments->gap, "White pixels between pictures")->check(CLI::Range(0, 1024))->capture_default_str();
    command->callback([arguments, &action] { action = [arguments] { return sheet(*arguments); }; });
}

} // namespace tegument::app
