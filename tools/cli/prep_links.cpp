// tegument prep links: where the light of skin comes from, by place, for effects/Pyramid.fx.

#include "meshprep/assets/cached_links.h"
#include "tools/cli/command_line.h"
#include "tools/cli/output.h"
#include "tools/cli/prep_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

struct LinkArguments {
    std::string input;
    std::string output = "links.dds";
    MeshOptions mesh;
    LinkOptions links;
    bool json = false;
};

int prepLinks(LinkArguments& arguments) {
    const fs::path beside = fs::path(arguments.output).replace_extension(".json");
    for (const auto& can : {checkOutput(arguments.output, {".dds"}), checkOutput(beside.string(), {})})
        if (!can) return fail(can.error(), arguments.json);
    Progress progress;
    progress.say("reading the mesh");
    const auto mesh = loadMesh(arguments.input, arguments.mesh);
    if (!mesh) return fail(mesh.error(), arguments.json);
    progress.say("linking");
    auto links = makeSkinLinks(*mesh, arguments.links);
    progress.clear();
    if (!links) return fail(links.error(), arguments.json);
    warn(links->warnings);
    const int width = links->sheet.width;
    const int height = links->sheet.height;
    if (const auto written = assets::writeSkinLinks(arguments.output, *mesh, *links, arguments.links); !written)
        return fail(written.error(), arguments.json);
    if (arguments.json) {
        print({{"files", {arguments.output, beside.string()}}, {"links", links->links}, {"lists", links->lists}});
        return 0;
    }
    const SkinLinks::Seconds& s = links->seconds;
    fmt::print("{} links to {} texels of {:.3g} mm: {:.1f} each, at most {}\n", links->links, links->lists, links->sideMm,
               static_cast<double>(links->links) / static_cast<double>(std::max<std::size_t>(links->lists, 1)), links->longest);
    constexpr double kTexelBytes = 8;
    fmt::print("sheet of {} x {} texels, {:.1f} MB\n", width, height, kTexelBytes * width * height / 1e6);
    fmt::print("{:.3f} s to make: cells {:.3f}, links {:.3f}, sheet {:.3f}\n", s.cells + s.links + s.sheet, s.cells, s.links, s.sheet);
    fmt::print("wrote {}\nwrote {}\n", arguments.output, beside.string());
    return 0;
}

} // namespace

void addPrepLinks(CLI::App& command, Action& action) {
    auto arguments = std::make_shared<LinkArguments>();
    CLI::App* links = command.add_subcommand(
        "links", "Find where the light of skin comes from, texel by texel, as a texture (docs/design/modules/Pyramid.md)");
    links->add_option("mesh", arguments->input, "Mesh with texture coordinates, as the effect will draw it")->required();
    links->add_option("-o,--output", arguments->output, "DDS to write; a JSON file of the same name says what is in it")
        ->capture_default_str();
    links->add_option("--unit-mm", arguments->mesh.unitMm, "Millimetres per unit of the mesh file");
    links->add_option("--lost", arguments->links.lost, "Share of the light whose links may be left out")
        ->check(CLI::Range(0.0, 0.5))
        ->capture_default_str();
    links->add_option("--nearest", arguments->links.nearest, "Largest source where its light arrives, mm")
        ->check(CLI::Range(0.01, 100.0))
        ->capture_default_str();
    links->add_option("--growth", arguments->links.growth, "How sources grow with their distance, mm per mm")
        ->check(CLI::Range(0.0, 10.0))
        ->capture_default_str();
    links->add_option("--threads", arguments->links.threads, "Threads; 0: one a processor")->capture_default_str();
    links->add_flag("--json", arguments->json, "Print JSON");
    addExamples(*links, {{"prep links head.glb -o links.dds", "then: tegument render Pyramid --mesh head.glb --set gLinksMap=links.dds"}});
    links->callback([arguments, &action] { action = [arguments] { return prepLinks(*arguments); }; });
}

} // namespace tegument::app
