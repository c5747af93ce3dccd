// Materials with pictures or colours of their own, side by side in one sheet: a mesh is drawn with one colour map and one normal map.

#include "host/mesh/mesh_file.h"
#include "host/support/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tegument::meshfile {

namespace {

constexpr int kGutter = 8;     // texels around each picture, in which it goes on: what four mips blend
constexpr int kPlainShare = 8; // plain colours take a strip, an eighth of a picture high
constexpr int kSmallest = 4;   // a small picture is enlarged to a quarter of the largest: light is gathered in the sheet's texels, too
constexpr int kLeastStrip = 4; // texels of a plain colour
constexpr std::size_t kMostSheetTexels = std::size_t{1} << 25;
constexpr std::size_t kNone = SIZE_MAX;

/// Where the coordinates of a material lie, and where its picture lies in the sheet.
struct Cell {
    glm::vec2 first{0};  // least coordinates, whole numbers where there is a picture
    glm::vec2 extent{1}; // as many tiles of the picture
    glm::ivec2 place{0}; // texels, within the gutter
    glm::ivec2 size{0};
    glm::ivec2 gutter{kGutter};
};

/// A vertex of two materials becomes two. Gives the material of each.
std::vector<std::size_t> materialOfVertices(std::span<const std::size_t> materialOfPart, ReadMesh& read) {
    Mesh& mesh = read.mesh;
    std::vector<std::size_t> owner(mesh.positions.size(), kNone);
    std::map<std::pair<std::uint32_t, std::size_t>, std::uint32_t> copies;
    for (std::size_t p = 0; p < mesh.parts.size(); ++p)
        for (std::uint32_t& index : std::span(mesh.indices).subspan(mesh.parts[p].firstIndex, mesh.parts[p].indexCount)) {
            const std::size_t material = materialOfPart[p];
            if (owner[index] == kNone) owner[index] = material;
            if (owner[index] == material) continue;
            const auto next = static_cast<std::uint32_t>(mesh.positions.size());
            const auto [copy, isNew] = copies.emplace(std::pair(index, material), next);
            if (isNew) {
                copyVertex(mesh, index);
                if (!read.exact.empty()) read.exact.push_back(glm::dvec3(read.exact[index]));
                owner.push_back(material);
            }
            index = copy->second;
        }
    return owner;
}

void findExtents(const Mesh& mesh, std::span<const std::size_t> owner, std::span<const DrawnMaterial> materials, std::vector<Cell>& cells) {
    std::vector<std::pair<glm::vec2, glm::vec2>> bounds(cells.size(), {glm::vec2(INFINITY), glm::vec2(-INFINITY)});
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        if (owner[v] == kNone) continue;
        auto& [low, high] = bounds[owner[v]];
        low = glm::min(low, mesh.uvs[v]);
        high = glm::max(high, mesh.uvs[v]);
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const auto& [low, high] = bounds[i];
        if (!(low.x <= high.x)) continue;
        cells[i].first = low;
        cells[i].extent = glm::max(high - low, glm::vec2(kUvRounding));
        if (!materials[i].hasPicture()) continue;
        cells[i].first = glm::floor(low + kUvRounding);
        cells[i].extent = glm::max(glm::ceil(high - kUvRounding) - cells[i].first, glm::vec2(1));
    }
}

/// Texels that show all of a material's pictures over its tiles.
glm::vec2 texelsOf(const DrawnMaterial& material, const Cell& cell) {
    glm::vec2 texels(1);
    for (const std::optional<Image>* image : {&material.colour, &material.normal})
        if (*image) texels = glm::max(texels, cell.extent * glm::vec2((*image)->width, (*image)->height));
    return texels;
}

/// Pictures in a grid of equal cells, each as large as it is, plain colours in a strip below. 0 x 0 where that would be too large.
glm::ivec2 layOut(std::span<const DrawnMaterial> materials, std::vector<Cell>& cells) {
    glm::vec2 inner(1);
    int pictures = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        if (!materials[i].hasPicture()) continue;
        inner = glm::max(inner, texelsOf(materials[i], cells[i]));
        ++pictures;
    }
    const int columns = static_cast<int>(std::ceil(std::sqrt(pictures)));
    const int rows = (pictures + columns - 1) / columns;
    const int plain = static_cast<int>(cells.size()) - pictures;
    const float most =
        std::min({1.0F, static_cast<float>(kMostPictureSide / columns - 2 * kGutter) / inner.x,
                  static_cast<float>(kMostPictureSide / (rows + 1) - 2 * kGutter) / inner.y,
                  std::sqrt(static_cast<float>(kMostSheetTexels) / (inner.x * inner.y * static_cast<float>(columns * (rows + 1))))});
    if (most < 0.25F) return {0, 0};
    const glm::ivec2 size = glm::max(glm::ivec2(inner * most), 1);
    const glm::ivec2 step = size + 2 * kGutter;
    const glm::ivec2 strip(plain > 0 ? columns * step.x / plain : 0, plain > 0 ? std::max(step.y / kPlainShare, 2 * kGutter + 1) : 0);
    if (plain > 0 && strip.x < kLeastStrip) return {0, 0};
    int picture = 0, colour = 0;
    for (std::size_t i = 0; i < cells.size(); ++i)
        if (materials[i].hasPicture()) {
            cells[i].place = step * glm::ivec2(picture % columns, picture / columns) + kGutter;
            cells[i].size = glm::clamp(glm::ivec2(texelsOf(materials[i], cells[i]) * most), glm::max(size / kSmallest, 1), size);
            ++picture;
        } else {
            cells[i].gutter = strip / 4; // a plain colour has room for any mip
            cells[i].place = glm::ivec2(strip.x * colour++, rows * step.y) + cells[i].gutter;
            cells[i].size = glm::max(strip - 2 * cells[i].gutter, 1);
        }
    return {columns * step.x, rows * step.y + strip.y};
}

/// A channel of a picture: grey stands for three, alpha is 1 where there is none.
float channelOf(const Image& image, const glm::ivec2& texel, int channel) {
    const bool grey = image.channels < 3;
    if (channel == 3) return image.channels % 2 == 0 ? image.at(texel.x, texel.y, image.channels - 1) : 1;
    return image.at(texel.x, texel.y, grey ? 0 : channel);
}

/// Of a picture at a place counted in pictures: its texel where the cell is as fine, else between four.
std::array<float, 4> sample(const Image& image, const glm::vec2& at, bool asFine, const PictureEdges& edges) {
    const glm::vec2 texel = at * glm::vec2(image.width, image.height) - (asFine ? 0.0F : 0.5F);
    const glm::ivec2 low(glm::floor(texel));
    const glm::vec2 share = asFine ? glm::vec2(0) : texel - glm::vec2(low);
    std::array<float, 4> value{};
    for (int k = 0; k < (asFine ? 1 : 4); ++k) {
        const glm::ivec2 next(k % 2, k / 2);
        const float weight = (next.x ? share.x : 1 - share.x) * (next.y ? share.y : 1 - share.y);
        const glm::ivec2 from(wrapped(low.x + next.x, image.width, edges[0]), wrapped(low.y + next.y, image.height, edges[1]));
        for (int c = 0; c < 4; ++c)
            value[static_cast<std::size_t>(c)] += weight * channelOf(image, from, c);
    }
    return value;
}

void draw(const DrawnMaterial& material, const std::optional<Image>& picture, bool colour, const Cell& cell, Image& sheet) {
    const glm::vec3 plain = colour ? glm::vec3(1) : glm::vec3(0.5F, 0.5F, 1);
    const glm::ivec2 low = glm::max(cell.place - cell.gutter, glm::ivec2(0));
    const glm::ivec2 high = glm::min(cell.place + cell.size + cell.gutter, glm::ivec2(sheet.width, sheet.height));
    const bool asFine = picture && glm::vec2(cell.size) == cell.extent * glm::vec2(picture->width, picture->height);
    const bool tinted = colour && material.factor != glm::vec3(1);
    forEachInParallel(static_cast<std::size_t>(high.y - low.y), [&](std::size_t row) {
        for (glm::ivec2 at(low.x, low.y + static_cast<int>(row)); at.x < high.x; ++at.x) {
            std::array<float, 4> value = {plain.r, plain.g, plain.b, 1};
            const glm::vec2 place = (glm::vec2(at - cell.place) + 0.5F) / glm::vec2(cell.size);
            if (picture) value = sample(*picture, cell.first + place * cell.extent, asFine, material.edges);
            for (int c = 0; c < 4; ++c) {
                float& texel = sheet.at(at.x, at.y, c);
                texel = value[static_cast<std::size_t>(c)];
                if (tinted && c < 3) texel = linearToSrgb(srgbToLinear(texel) * material.factor[c]);
            }
        }
    });
}

} // namespace

int wrapped(int texel, int side, PictureEdge edge) {
    if (edge == PictureEdge::Clamp) return std::clamp(texel, 0, side - 1);
    const int tile = texel >= 0 ? texel / side : (texel + 1) / side - 1;
    const int within = texel - tile * side;
    return edge == PictureEdge::Mirror && tile % 2 != 0 ? side - 1 - within : within;
}

void tint(const glm::vec3& factor, Image& picture) {
    if (factor == glm::vec3(1)) return;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
            for (int c = 0; c < std::min(picture.channels, 3); ++c) // grey stays grey, by the factor's red
                if (picture.channels != 2 || c == 0) picture.at(x, y, c) = linearToSrgb(srgbToLinear(picture.at(x, y, c)) * factor[c]);
}

bool layOutMaterials(std::span<const DrawnMaterial> materials, std::span<const std::size_t> materialOfPart, ReadMesh& read) {
    Mesh& mesh = read.mesh;
    std::vector<Cell> cells(materials.size());
    const std::vector<std::size_t> owner = materialOfVertices(materialOfPart, read);
    findExtents(mesh, owner, materials, cells);
    const glm::ivec2 size = layOut(materials, cells);
    if (size.x == 0) return false;
    for (const bool colour : {true, false}) {
        const auto of = [&](const DrawnMaterial& material) -> const std::optional<Image>& {
            return colour ? material.colour : material.normal;
        };
        if (std::ranges::none_of(materials, [&](const DrawnMaterial& material) { return of(material).has_value(); })) continue;
        Image sheet{.width = size.x, .height = size.y, .channels = 4, .bitsPerChannel = 8};
        sheet.pixels.assign(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4, 1.0F);
        for (std::size_t i = 0; i < cells.size(); ++i) {
            draw(materials[i], of(materials[i]), colour, cells[i], sheet);
            if (of(materials[i])) sheet.bitsPerChannel = std::max(sheet.bitsPerChannel, of(materials[i])->bitsPerChannel);
        }
        mesh.textures.push_back({.role = colour ? "color" : "normal", .image = std::move(sheet)});
    }
    for (std::size_t v = 0; v < mesh.uvs.size(); ++v) {
        if (owner[v] == kNone) continue;
        const Cell& cell = cells[owner[v]];
        const glm::vec2 within = (mesh.uvs[v] - cell.first) / cell.extent;
        mesh.uvs[v] = (glm::vec2(cell.place) + within * glm::vec2(cell.size)) / glm::vec2(size);
    }
    return true;
}

} // namespace tegument::meshfile
