// tegument compare: how far is one picture from another, and where?

#include "host/image/compare.h"
#include "meshprep/assets/names.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"

#include <fmt/format.h>

#include <memory>

namespace tegument::app {

namespace {

struct CompareArguments {
    std::string image;
    std::string reference;
    std::string output;
    double limit = 1e-3;
    double gain = 100;
    bool json = false;
};

Json differenceJson(const CompareArguments& arguments, const Difference& difference) {
    Json json{{"image", arguments.image},
              {"reference", arguments.reference},
              {"rel_l2", difference.relativeL2},
              {"p99", difference.p99},
              {"p999", difference.p999},
              {"largest", difference.largest},
              {"largest_at", {difference.largestX, difference.largestY}},
              {"bias", difference.bias},
              {"limit", arguments.limit},
              {"beyond", difference.beyond},
              {"pixels_beyond", difference.pixelsBeyond}};
    if (!arguments.output.empty()) json["output"] = arguments.output;
    return json;
}

void printDifference(const CompareArguments& arguments, const Difference& difference) {
    const auto number = [](double value) { return fmt::format("{:.3g}", value); };
    fmt::print("{}",
               table({"of the reference's mean", ""},
                     {{"relative L2", number(difference.relativeL2)},
                      {"99 % of values within", number(difference.p99)},
                      {"99.9 % of values within", number(difference.p999)},
                      {"largest", fmt::format("{} at ({}, {})", number(difference.largest), difference.largestX, difference.largestY)},
                      {"bias", number(difference.bias)},
                      {fmt::format("pixels beyond {}", number(arguments.limit)),
                       fmt::format("{} ({:.4f} %)", difference.pixelsBeyond, 100 * difference.beyond)}}));
    if (!arguments.output.empty()) fmt::print("wrote {}\n", arguments.output);
}

Result<Difference> compareFiles(const CompareArguments& arguments) {
    if (const auto can = checkOutput(arguments.output, {".png"}); !can) return can.error();
    for (const std::string& file : {arguments.image, arguments.reference})
        if (const auto exists = assets::fileExists(file, "the picture"); !exists) return exists.error();
    auto image = loadImage(arguments.image);
    if (!image) return image.error();
    const auto reference = loadImage(arguments.reference);
    if (!reference) return reference.error();
    auto difference = compareImages(*image, *reference, arguments.limit);
    if (!difference || arguments.output.empty()) return difference;
    Image picture = differenceImage(*image, *reference);
    picture.metadata["Software"] = "Tegument";
    for (float& value : picture.pixels)
        value *= static_cast<float>(arguments.gain);
    if (const auto written = writePng(arguments.output, picture, PngEncoding::Raw); !written) return written.error();
    return difference;
}

int compare(const CompareArguments& arguments) {
    const auto difference = compareFiles(arguments);
    if (!difference) return fail(difference.error(), arguments.json);
    if (arguments.json) {
        print(differenceJson(arguments, *difference));
    } else {
        printDifference(arguments, *difference);
    }
    return 0;
}

} // namespace

void addCompare(CLI::App& program, Action& action) {
    auto arguments = std::make_shared<CompareArguments>();
    CLI::App* command = program.add_subcommand("compare", "Hold one picture against another, in linear radiance");
    command->add_option("image", arguments->image, "EXR (or PNG, JPEG as stored)")->required();
    command->add_option("reference", arguments->reference, "What it is held against")->required();
    command->add_option("--limit", arguments->limit, "Count pixels that differ by more than this share of the reference's mean")
        ->capture_default_str();
    command->add_option("-o,--output", arguments->output, "Write the differences as a picture (.png)");
    command->add_option("--gain", arguments->gain, "Brightness of that picture: 1 / the difference that is white")->capture_default_str();
    command->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*command, {{"compare out/a.exr out/b.exr", "how far, as shares of the reference's mean"},
                           {"compare out/a.exr out/b.exr -o out/where.png", "and where"}});
    command->callback([arguments, &action] { action = [arguments] { return compare(*arguments); }; });
}

} // namespace tegument::app
