// tegument sheet: pictures side by side in one, with labels of columns and rows.

#include "tools/cli/sheet.h"

#include "host/support/file.h"
#include "host/support/text.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/typeface.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace tegument::app {

namespace {

struct SheetArguments {
    std::vector<std::string> pictures;
    std::string output = "out/sheet.png";
    int columns = 3;
    int gap = 8;
    std::vector<std::string> columnLabels;
    std::vector<std::string> rowLabels;
    std::string font = kUsualTypeface;

    [[nodiscard]] bool labelled() const { return !columnLabels.empty() || !rowLabels.empty(); }
};

constexpr float kPaper = 1.0F; // white, as the page that shows the sheet
constexpr int kTextSize = 18;  // pixels of the em: readable where a page shows a sheet at half its size
constexpr int kMargin = 4;     // pixels between text and picture

Result<std::vector<Image>> loadAll(const std::vector<std::string>& paths) {
    std::vector<Image> images;
    for (const std::string& path : paths) {
        Result<Image> image = loadImage(path);
        if (!image) return image.error();
        images.push_back(std::move(*image));
        const Image& first = images.front();
        const Image& last = images.back();
        if (last.width != first.width || last.height != first.height)
            return inputError(8030, {.file = path},
                              fmt::format("is {}x{}, the first picture {}x{}", last.width, last.height, first.width, first.height),
                              "render them with one --size");
    }
    return images;
}

float sample(const Image& image, int x, int y, int channel) {
    return image.at(x, y, image.channels < 3 ? 0 : channel);
}

/// Where things lie, in pixels.
struct Grid {
    int columns = 0;
    int rows = 0;
    int width = 0;
    int height = 0;
    int gap = 0;
    int left = 0; // of the first picture: row labels stand before it
    int top = 0;  // column labels above it
    int line = 0; // height of text

    [[nodiscard]] int x(int column) const { return left + column * (width + gap); }
    [[nodiscard]] int y(int row) const { return top + row * (height + gap); }
};

Grid layOut(const SheetArguments& arguments, const std::vector<Image>& images, const std::optional<Typeface>& typeface) {
    const int count = static_cast<int>(images.size());
    Grid grid{.columns = std::min(arguments.columns, count),
              .width = images.front().width,
              .height = images.front().height,
              .gap = arguments.gap};
    grid.rows = (count + grid.columns - 1) / grid.columns;
    if (!typeface) return grid;
    grid.line = typeface->height();
    if (!arguments.columnLabels.empty()) grid.top = grid.line + kMargin;
    for (const std::string& label : arguments.rowLabels)
        grid.left = std::max(grid.left, typeface->width(label) + 2 * kMargin);
    return grid;
}

/// Every column and row has its label, and it fits.
Result<void> checkLabels(const SheetArguments& arguments, const Grid& grid, const std::optional<Typeface>& typeface) {
    const auto check = [](const std::vector<std::string>& labels, int count, const char* what) -> Result<void> {
        if (labels.empty() || static_cast<int>(labels.size()) == count) return {};
        return usageError(8031, fmt::format("{} labels for {} {}", labels.size(), count, what), "give one for each, separated by commas");
    };
    if (const auto columns = check(arguments.columnLabels, grid.columns, "columns"); !columns) return columns.error();
    if (const auto rows = check(arguments.rowLabels, grid.rows, "rows"); !rows) return rows.error();
    for (const std::string& label : arguments.columnLabels)
        if (const int width = typeface->width(label); width > grid.width)
            return usageError(8031, fmt::format("'{}' takes {} pixels, a picture {}", label, width, grid.width),
                              "shorten it, or render larger pictures");
    return {};
}

/// Everything that any of them says about its making: of each key the different values.
std::map<std::string, std::string> metadataOf(const std::vector<Image>& images) {
    std::map<std::string, std::vector<std::string>> values;
    for (const Image& image : images)
        for (const auto& [key, value] : image.metadata)
            if (std::ranges::find(values[key], value) == values[key].end()) values[key].push_back(value);
    std::map<std::string, std::string> metadata;
    for (const auto& [key, all] : values)
        metadata[key] = fmt::format("{}", fmt::join(all, "; "));
    metadata["Software"] = "Tegument";
    return metadata;
}

Image arrange(const std::vector<Image>& images, const Grid& grid) {
    Image sheet{
        .width = grid.x(grid.columns) - grid.gap, .height = grid.y(grid.rows) - grid.gap, .channels = 3, .metadata = metadataOf(images)};
    sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * static_cast<std::size_t>(sheet.height) * 3, kPaper);
    for (int i = 0; i < static_cast<int>(images.size()); ++i)
        for (int y = 0; y < grid.height; ++y)
            for (int x = 0; x < grid.width; ++x)
                for (int c = 0; c < 3; ++c)
                    sheet.at(grid.x(i % grid.columns) + x, grid.y(i / grid.columns) + y, c) =
                        sample(images[static_cast<std::size_t>(i)], x, y, c);
    return sheet;
}

/// Centred over their columns, right-aligned before their rows.
void drawLabels(const SheetArguments& arguments, const Grid& grid, const Typeface& typeface, Image& sheet) {
    for (int column = 0; column < static_cast<int>(arguments.columnLabels.size()); ++column) {
        const std::string& label = arguments.columnLabels[static_cast<std::size_t>(column)];
        typeface.draw(sheet, grid.x(column) + (grid.width - typeface.width(label)) / 2, 0, label);
    }
    for (int row = 0; row < static_cast<int>(arguments.rowLabels.size()); ++row) {
        const std::string& label = arguments.rowLabels[static_cast<std::size_t>(row)];
        const int y = grid.y(row) + (grid.height - grid.line) / 2;
        typeface.draw(sheet, grid.left - kMargin - typeface.width(label), y, label);
    }
}

bool isJpeg(const std::string& path) {
    const std::string ending = toLower(std::filesystem::path(path).extension().string());
    return ending == ".jpg" || ending == ".jpeg";
}

Result<void> checkFiles(const SheetArguments& arguments) {
    if (!isJpeg(arguments.output) && toLower(std::filesystem::path(arguments.output).extension().string()) != ".png")
        return usageError(8032, fmt::format("{} is neither a .png nor a .jpg", arguments.output), "PNG is exact, JPEG is smaller");
    if (const auto can = checkOutput(arguments.output, {}); !can) return can.error();
    for (const std::string& picture : arguments.pictures)
        if (const auto exists = assets::fileExists(picture, "the picture"); !exists) return exists.error();
    return {};
}

Result<void> makeSheet(const SheetArguments& arguments) {
    if (const auto fine = checkFiles(arguments); !fine) return fine.error();
    const auto images = loadAll(arguments.pictures);
    if (!images) return images.error();
    std::optional<Typeface> typeface; // only labels need one
    if (arguments.labelled()) {
        auto opened = Typeface::open(arguments.font, kTextSize);
        if (!opened) return opened.error();
        typeface = std::move(*opened);
    }
    const Grid grid = layOut(arguments, *images, typeface);
    if (const auto checked = checkLabels(arguments, grid, typeface); !checked) return checked.error();
    Image sheet = arrange(*images, grid);
    if (typeface) drawLabels(arguments, grid, *typeface, sheet);
    return isJpeg(arguments.output) ? writeJpeg(arguments.output, sheet) : writePng(arguments.output, sheet, PngEncoding::Raw);
}

int sheet(const SheetArguments& arguments) {
    const auto made = makeSheet(arguments);
    if (!made) return fail(made.error(), false);
    fmt::print("wrote {}\n", arguments.output);
    return 0;
}

} // namespace

Image contactSheet(const std::vector<Image>& images, int columns, int gap) {
    Image sheet = arrange(images, layOut({.columns = columns, .gap = gap}, images, std::nullopt));
    sheet.metadata = {{"Software", "Tegument"}}; // of hundreds
    return sheet;
}

void addSheet(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<SheetArguments>();
    CLI::App* command = program.add_subcommand("sheet", "Put pictures of one size side by side");
    command->add_option("pictures", arguments->pictures, "PNG or JPEG files, row by row")->required();
    command->add_option("-o,--output", arguments->output, "Picture to write (.png or .jpg)")->capture_default_str();
    command->add_option("--columns", arguments->columns, "Pictures in a row")->check(CLI::Range(1, 64))->capture_default_str();
    command->add_option("--gap", arguments->gap, "White pixels between pictures")->check(CLI::Range(0, 1024))->capture_default_str();
    repeatable(command->add_option("--column-labels", arguments->columnLabels, "Text above each column, separated by commas"))
        ->delimiter(',');
    repeatable(command->add_option("--row-labels", arguments->rowLabels, "Text before each row, separated by commas"))->delimiter(',');
    command->add_option("--font", arguments->font, "TrueType file of the labels")->capture_default_str();
    addExamples(*command, {{"sheet a.png b.png --columns 2 -o both.png", ""},
                           {"sheet a.png b.png --columns 2 --column-labels before,after -o both.jpg", ""}});
    command->callback([arguments, &action] { action = [arguments] { return sheet(*arguments); }; });
}

} // namespace tegument::app
