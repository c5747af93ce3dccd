// Any bytes are a PLY or glb file whose vertices have numbers of their own: as many rows as were asked for, each of all vertices, or one
// error.

#include "meshprep/fur/roots/vertex_values.h"
#include "tests/scene/fuzz/fuzz_mesh.h"

#include <array>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string kStem = "/tmp/tegument-values-fuzz-" + std::to_string(::getpid());
    const bool ply = size > 2 && data[0] == 'p';
    const std::string path = kStem + (ply ? ".ply" : ".glb");
    tegument::fuzz::writeAnew(path, data, size);
    const std::array<std::string, 2> names = {ply ? "x" : "POSITION", ply ? "red" : "_QUALITY"};
    for (std::size_t count = 1; count <= names.size(); ++count) {
        const auto read = tegument::readVertexValues(path, std::span(names).first(count), 1);
        if (!read) {
            tegument::fuzz::require(read.error().diagnostics.size() == 1, "one error");
            continue;
        }
        tegument::fuzz::require(read->values.size() == count && read->whole.size() == count, "a row for each name");
        for (const auto& row : read->values)
            tegument::fuzz::require(row.size() == read->positions.size(), "a value for each vertex");
    }
    return 0;
}
