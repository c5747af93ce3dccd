// What techniques promise by their own definition. What is not listed promises everything.

#include "lab/invariance/cases.h"
#include "lab/invariance/invariance.h"

#include <algorithm>
#include <string_view>

namespace tegument::invariance {

namespace {

Limits usual() {
    return {.relativeL2 = 1e-3, .beyond = 1e-3};
}
/// Strands end at edges, and their edges are everywhere.
constexpr double kFurLimit = 1e-2;

/// A coat of fur grows along the axes of its mesh's file, is as long as a share of the mesh, and hangs down in the world.
bool isFur(const Subject& subject) {
    return subject.effect.findParameter("gFurLength") != nullptr;
}

std::string stem(const Subject& subject) {
    return subject.effect.file.stem().string();
}

/// By itself, or by a map that Stretch.fx has drawn.
bool knowsLengths(const Subject& subject) {
    return subject.reads.contains("gUnitMm") || subject.reads.contains("gStretchMap");
}

bool isOneOf(const std::string& name, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, name) != names.end();
}

} // namespace

bool showsMap(const Subject& subject) {
    return isOneOf(stem(subject),
                   {"Beckmann", "EnergyAttenuation", "PreintegratedTable", "Stretch", "Irradiance", "Convolution", "Atlas", "Ladder"});
}

std::string apart(const Subject& subject, const Case& each) {
    if (each.lamps && !subject.effect.findParameter("gLampPlace")) return "it takes no lamps";
    if (each.asks == Asks::NoMeshAxes && isFur(subject)) return "the coat grows along the axes of the mesh's file";
    if (each.asks == Asks::NoLengths && !isFur(subject) && knowsLengths(subject)) return "it is defined in millimetres";
    if (each.asks == Asks::NoLengths && stem(subject) == "FurSkin") return "its skin scatters light over millimetres";
    if (each.asks == Asks::MirrorPicture && stem(subject) == "Culling") return "it shows four panels, which stay where they are";
    if (each.asks == Asks::MirrorPicture && (stem(subject) == "Burley" || subject.technique == "PreintegratedPenumbra"))
        return "its samples are turned from pixel to pixel, to one sense";
    if (each.asks == Asks::MirrorPicture && stem(subject) == "SkinPost") return "its samples lie on a spiral, turned to one sense";
    if (each.asks == Asks::MirrorPicture && subject.technique == "CoatChance") return "its chances differ from pixel to pixel";
    if (each.asks == Asks::MirrorPicture && stem(subject) == "Pyramid") return "the grid of its shadow taps is turned, to one sense";
    if (each.asks == Asks::MirrorPicture && each.lamps) return "the taps of penumbras are turned from texel to texel, to one sense";
    return {};
}

Limits limitsOf(const Subject& subject, const Case& each) {
    Limits limits = usual();
    if (isFur(subject)) limits = {.relativeL2 = kFurLimit, .beyond = 1};
    if (subject.technique == "CoatChance")
        limits = {.relativeL2 = 3e-2,
                  .beyond = 1e-3,
                  .excused = "where a rounding moves a coverage across a chance a sample shows another strand"};
    if (each.lamps && each.asks == Asks::NoMeshAxes && showsMap(subject))
        limits = {.relativeL2 = 2e-3,
                  .beyond = 5e-3,
                  .excused = "maps of lamps turn with the mesh's own axes, so that shadows stand still on it"};
    for (const InvarianceException& exception : invarianceExceptions())
        if (stem(subject) == exception.effect && exception.column == (each.limitsOf.empty() ? each.column : each.limitsOf))
            limits = {.relativeL2 = exception.relativeL2, .beyond = exception.beyond, .excused = exception.cause};
    return limits;
}

} // namespace tegument::invariance

namespace tegument {

const std::vector<InvarianceException>& invarianceExceptions() {
    static const std::vector<InvarianceException> kExceptions = {
        {.effect = "FurRoots",
         .column = "order",
         .relativeL2 = 6e-2,
         .beyond = 1e-3,
         .cause =
             "layers are blended and write depth: where a layer lies before itself, at outlines, the triangle that is drawn first counts"},
        {.effect = "FurRoots",
         .column = "two draws",
         .relativeL2 = 6e-2,
         .beyond = 2e-2,
         .cause =
             "each draw has all layers: along the border the outer ones of the first part are drawn before the inner ones of the second"}};
    return kExceptions;
}

} // namespace tegument
