#include "meshprep/assets/cached_links.h"

#include "host/image/dds.h"
#include "host/support/cache.h"
#include "host/support/file.h"
#include "meshprep/fur/roots/fur_surface.h"
#include "meshprep/skin/link_cells.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kKind = "tegument skin links";

std::string keyOf(const Mesh& mesh, const LinkOptions& options) {
    return CacheKey(fmt::format("links {}", kLinkVersion))
        .add(fmt::format("{} {} {} {} {} {} {}", options.variances[0], options.variances[1], options.fourth, options.fourthShare,
                         options.lost, options.nearest, options.growth))
        .add(mesh.positions)
        .add(mesh.uvs)
        .add(mesh.indices)
        .add(skinMask(mesh))
        .text();
}

fs::path besides(const fs::path& file) {
    return fs::path(file).replace_extension(".json");
}

Json figuresJson(const SurfaceFigures& figures) {
    return {{"area", figures.area},
            {"middle", {figures.middle.x, figures.middle.y, figures.middle.z}},
            {"spread", {figures.spread.x, figures.spread.y, figures.spread.z}}};
}

Json toJson(const Mesh& mesh, const SkinLinks& links, const LinkOptions& options) {
    const double mean = links.lists > 0 ? static_cast<double>(links.links) / static_cast<double>(links.lists) : 0;
    return {
        {"kind", kKind},
        {"version", kLinkVersion},
        {"mesh", {{"name", mesh.name}, {"surface", figuresJson(surfaceFigures(mesh))}}},
        {"profile", {{"variances_mm2", options.variances}}},
        {"map", {{"side", kLinkSide}, {"texel_mm", links.sideMm}}},
        {"sheet", {{"tiles", links.tiles}, {"width", links.sheet.width}, {"height", links.sheet.height}, {"format", "R16G16B16A16_FLOAT"}}},
        {"fourth", links.fourth},
        {"lists", links.lists},
        {"links", links.links},
        {"mean", mean},
        {"longest", links.longest},
        {"quarters", links.quarters},
        {"seconds", {{"cells", links.seconds.cells}, {"links", links.seconds.links}, {"sheet", links.seconds.sheet}}}};
}

std::optional<glm::dvec3> vectorOf(const Json& json) {
    if (!json.is_array() || json.size() != 3 || !json[0].is_number() || !json[1].is_number() || !json[2].is_number()) return std::nullopt;
    return glm::dvec3(json[0].get<double>(), json[1].get<double>(), json[2].get<double>());
}

std::optional<SurfaceFigures> figuresOf(const Json& json) {
    const Json mesh = json.contains("mesh") ? json["mesh"] : Json();
    const Json surface = mesh.is_object() && mesh.contains("surface") ? mesh["surface"] : Json();
    if (!surface.is_object() || !surface.contains("area") || !surface["area"].is_number()) return std::nullopt;
    const auto middle = vectorOf(surface.value("middle", Json()));
    const auto spread = vectorOf(surface.value("spread", Json()));
    if (!middle || !spread) return std::nullopt;
    return SurfaceFigures{.middle = *middle, .area = surface["area"].get<double>(), .spread = *spread};
}

} // namespace

Result<void> writeSkinLinks(const fs::path& file, const Mesh& mesh, SkinLinks& links, const LinkOptions& options) {
    const std::string json = toJson(mesh, links, options).dump(2) + "\n";
    DdsTexture dds{.format = DdsFormat::Rgba16F};
    dds.images.push_back(std::move(links.sheet)); // a third of a gigabyte, where a map is of thousands of charts
    if (const auto written = writeDds(file, dds); !written) return written;
    return writeFile(besides(file), json);
}

Result<fs::path> cachedSkinLinks(const Mesh& mesh, const Say& say) {
    const LinkOptions options;
    const auto make = [&](const fs::path& file) -> Result<void> {
        auto links = makeSkinLinks(mesh, options);
        if (!links) return links.error();
        for (const Diagnostic& warning : links->warnings)
            say(format(warning));
        return writeSkinLinks(file, mesh, *links, options);
    };
    return cachedDds("skin", "links_" + keyOf(mesh, options), fmt::format("{} for {}", kSkinLinksGenerator, mesh.name), say, make);
}

Result<void> checkSkinLinks(const fs::path& file, const Mesh& mesh) {
    const auto text = readFile(besides(file));
    if (!text) return {};
    const Json json = Json::parse(*text, nullptr, false);
    if (!json.is_object() || !json.contains("kind") || json["kind"] != kKind) return {};
    const auto made = figuresOf(json);
    if (!made) return {};
    const auto why = whyNotSame(*made, surfaceFigures(mesh));
    if (!why) return {};
    return inputError(4055, {.file = file.string()}, fmt::format("these links were made for another mesh than {}: {}", mesh.name, *why),
                      "leave them out, and they are made; or: tegument prep links MESH -o FILE.dds");
}

} // namespace tegument::assets
