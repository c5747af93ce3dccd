#include "meshprep/write/write_mesh.h"

#include "host/support/text.h"
#include "meshprep/write/glb.h"

#include <algorithm>
#include <array>

namespace tegument {

namespace {

Result<void> writePlyOf(const std::filesystem::path& path, const Mesh& mesh, const GlbOptions& options) {
    return writePly(path, mesh, options.moved);
}

constexpr std::array<MeshWriter, 2> kWriters = {{{".glb", "glb", writeGlb, true}, {".ply", "PLY", writePlyOf, false}}};

} // namespace

const MeshWriter* meshWriterOf(const std::filesystem::path& path) {
    const std::string ending = toLower(path.extension().string());
    const auto* found = std::ranges::find(kWriters, ending, &MeshWriter::extension);
    return found == kWriters.end() ? nullptr : found;
}

} // namespace tegument
