// Meshes made from any bytes, small and of hard shapes, through the whole of `prep`: the reader is always passed. What comes out is a mesh
// that keeps loadMesh's promises after it is written and read again.

#include "host/support/file.h"
#include "meshprep/prepare/prepare.h"
#include "meshprep/write/write_mesh.h"
#include "tests/scene/fuzz/fuzz_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace {

constexpr std::size_t kMostVertices = 24;
constexpr std::size_t kMostFaces = 60;

/// What is left of the input; zeros behind its end.
class Bytes {
public:
    Bytes(const std::uint8_t* data, std::size_t size) : at_(data), end_(data + size) {}
    [[nodiscard]] bool left() const { return at_ != end_; }
    unsigned next() { return left() ? *at_++ : 0; }

private:
    const std::uint8_t* at_;
    const std::uint8_t* end_;
};

/// Few values, so that places coincide, lie on lines and in planes; and some that are hard to compute with.
std::string coordinate(unsigned byte) {
    static constexpr std::array kHard = {"1e30", "-1e30", "1e-30", "0.1", "16777217", "0.3333333", "1e-7", "-0"};
    return byte < 200 ? fmt::format("{}", static_cast<int>(byte % 8) - 3) : kHard[byte % kHard.size()];
}

std::string objOf(Bytes& bytes, bool uvs) {
    std::string text;
    const std::size_t vertices = 3 + bytes.next() % (kMostVertices - 2);
    for (std::size_t i = 0; i < vertices; ++i) {
        const unsigned x = bytes.next();
        const unsigned y = bytes.next();
        text += fmt::format("v {} {} {}\n", coordinate(x), coordinate(y), coordinate(bytes.next()));
        if (uvs) text += fmt::format("vt {:.3} {:.3}\n", (x % 16) / 15.0, (y % 16) / 15.0);
    }
    for (std::size_t face = 0; face < kMostFaces && bytes.left(); ++face) {
        text += 'f';
        for (unsigned corners = 3 + bytes.next() % 3; corners > 0; --corners) {
            const std::size_t vertex = 1 + bytes.next() % vertices;
            text += uvs ? fmt::format(" {0}/{0}", vertex) : fmt::format(" {}", vertex);
        }
        text += '\n';
    }
    return text;
}

tegument::prep::PrepOptions optionsOf(unsigned byte) {
    tegument::prep::PrepOptions options;
    options.read.unitMm = 1;
    options.orient = (byte & 1U) != 0;
    options.overdraw = (byte & 2U) != 0;
    options.keepDuplicates = (byte & 4U) != 0;
    options.levelMethod = (byte & 8U) != 0 ? tegument::prep::LevelMethod::OpenMesh : tegument::prep::LevelMethod::Meshoptimizer;
    options.precision = (byte & 16U) != 0 ? tegument::prep::VertexPrecision::Half : tegument::prep::VertexPrecision::Float;
    // Without the report of mappings: it takes half a minute here, however small the mesh is.
    options.chunk16 = (byte & 96U) != 0;
    return options;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Bytes bytes(data, size);
    const unsigned choices = bytes.next();
    const tegument::prep::PrepOptions options = optionsOf(choices);
    static const std::string kStem = fmt::format("/tmp/tegument-prep-fuzz-{}", ::getpid());
    const std::string obj = objOf(bytes, (choices & 128U) != 0);
    tegument::fuzz::writeAnew(kStem + ".obj", reinterpret_cast<const std::uint8_t*>(obj.data()), obj.size());
    const auto prepared = tegument::prep::prepareMesh(kStem + ".obj", options);
    if (!prepared) {
        tegument::fuzz::require(prepared.error().diagnostics.size() == 1, "one error");
        return 0;
    }
    tegument::fuzz::require(prepared->report.triangles > 0, "something was there");
    std::remove((kStem + ".glb").c_str());
    if (!tegument::writeGlb(kStem + ".glb", prepared->mesh, prepared->glb)) std::abort();
    const auto again = tegument::loadMesh(kStem + ".glb", {});
    tegument::fuzz::require(static_cast<bool>(again), again ? "" : tegument::format(again.error()).c_str());
    tegument::fuzz::checkMesh(*again);
    return 0;
}
