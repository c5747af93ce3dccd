// readGroom on any bytes: the first says of which format. A groom that keeps its promises, or one error.

#include "meshprep/groom/groom_file.h"
#include "tests/scene/fuzz/fuzz_mesh.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace tegument;
    constexpr std::array<const char*, 8> kEndings = {"hair", "tfx", "abc", "usda", "glb", "obj", "ply", "gltf"};
    if (size < 2) return 0;
    const std::string path = "/tmp/tegument-fuzz-" + std::to_string(::getpid()) + "." + kEndings[data[0] % kEndings.size()];
    fuzz::writeAnew(path, data + 1, size - 1);
    const Result<Groom> groom = readGroom(path, {.frame = data[0] / kEndings.size() % 3});
    if (!groom) {
        fuzz::require(groom.error().diagnostics.size() == 1 && !format(groom.error()).empty(), "one error");
        return 0;
    }
    const std::size_t strands = groom->strands(), points = groom->points.size();
    fuzz::require(strands > 0 && groom->first.front() == 0 && groom->first.back() == points, "strands that cover the points");
    fuzz::require(groom->widths.empty() || groom->widths.size() == points, "a width for each point");
    fuzz::require(groom->colors.empty() || groom->colors.size() == points, "a colour for each point");
    for (const auto* numbers : {&groom->ids, &groom->guides, &groom->clumps})
        fuzz::require(numbers->empty() || numbers->size() == strands, "a number for each strand");
    const GroomFigures figures = figuresOf(evaluated(*groom, 4));
    fuzz::require(figures.strands == strands && figures.fewest >= 2, "chains of two points and more");
    return 0;
}
