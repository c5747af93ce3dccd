#include "meshprep/prepare/figures.h"

namespace tegument::prep {

SizeFigures sizes(std::size_t vertices, std::size_t triangles, std::size_t vertexBytes, bool small) {
    SizeFigures figures{.vertexBytes = vertexBytes, .indexBytes = small ? 2u : 4u};
    figures.before = triangles * 3 * vertexBytes;
    figures.after = vertices * vertexBytes + triangles * 3 * figures.indexBytes;
    return figures;
}

} // namespace tegument::prep
