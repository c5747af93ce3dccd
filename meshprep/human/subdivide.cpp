#include "meshprep/human/subdivide.h"

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <cassert>
#include <memory>

namespace tegument {

namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// What OpenSubdiv's refiner asks of a value; the names are its own.
template <class Vector>
struct Blended {
    Vector value{0};
    // NOLINTNEXTLINE(readability-identifier-naming)
    void Clear() { value = Vector(0); }
    // NOLINTNEXTLINE(readability-identifier-naming)
    void AddWithWeight(const Blended& other, float weight) { value += other.value * weight; }
};

using Position = Blended<glm::vec3>;
using Coordinate = Blended<glm::vec2>;

template <class Vector>
std::vector<Blended<Vector>> wrap(const std::vector<Vector>& values) {
    std::vector<Blended<Vector>> result;
    for (const Vector& value : values)
        result.push_back({value});
    return result;
}

template <class Vector>
std::vector<Vector> unwrap(const std::vector<Blended<Vector>>& values) {
    std::vector<Vector> result;
    for (const Blended<Vector>& value : values)
        result.push_back(value.value);
    return result;
}

std::unique_ptr<Far::TopologyRefiner> makeRefiner(std::size_t positions, std::size_t uvs, const std::vector<Quad>& quads) {
    std::vector<int> corners(quads.size(), 4);
    std::vector<int> positionIndices;
    std::vector<int> uvIndices;
    for (const Quad& quad : quads) {
        positionIndices.insert(positionIndices.end(), quad.position.begin(), quad.position.end());
        uvIndices.insert(uvIndices.end(), quad.uv.begin(), quad.uv.end());
    }
    Far::TopologyDescriptor::FVarChannel channel;
    channel.numValues = static_cast<int>(uvs);
    channel.valueIndices = uvIndices.data();
    Far::TopologyDescriptor descriptor;
    descriptor.numVertices = static_cast<int>(positions);
    descriptor.numFaces = static_cast<int>(quads.size());
    descriptor.numVertsPerFace = corners.data();
    descriptor.vertIndicesPerFace = positionIndices.data();
    descriptor.numFVarChannels = 1;
    descriptor.fvarChannels = &channel;

    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER);
    options.SetFVarLinearInterpolation(Sdc::Options::FVAR_LINEAR_CORNERS_PLUS1);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(descriptor, Factory::Options(Sdc::SCHEME_CATMARK, options)));
}

void limitSurface(const Far::PrimvarRefiner& primvars, const std::vector<Position>& refined, Subdivided& result) {
    std::vector<Position> points(refined.size());
    std::vector<Position> first(refined.size());
    std::vector<Position> second(refined.size());
    primvars.Limit(refined, points, first, second);
    result.positions = unwrap(points);
    for (std::size_t i = 0; i < refined.size(); ++i)
        result.normals.push_back(glm::normalize(glm::cross(first[i].value, second[i].value)));
}

void copyQuads(const Far::TopologyRefiner& refiner, int levels, Subdivided& result) {
    const Far::TopologyLevel& last = refiner.GetLevel(levels);
    for (int face = 0; face < last.GetNumFaces(); ++face) {
        const Far::ConstIndexArray positions = last.GetFaceVertices(face);
        const Far::ConstIndexArray uvs = last.GetFaceFVarValues(face, 0);
        Quad quad;
        for (int c = 0; c < 4; ++c) {
            quad.position[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(positions[c]);
            quad.uv[static_cast<std::size_t>(c)] = static_cast<std::uint32_t>(uvs[c]);
        }
        result.quads.push_back(quad);
        int ancestor = face;
        for (int level = levels; level > 0; --level)
            ancestor = refiner.GetLevel(level).GetFaceParentFace(ancestor);
        result.parents.push_back(static_cast<std::uint32_t>(ancestor));
    }
}

} // namespace

Result<Subdivided> subdivide(const std::vector<glm::vec3>& positions, const std::vector<glm::vec2>& uvs, const std::vector<Quad>& quads,
                             int levels) {
    assert(levels >= 1 && !quads.empty());
    const std::unique_ptr<Far::TopologyRefiner> refiner = makeRefiner(positions.size(), uvs.size(), quads);
    if (!refiner)
        return inputError(7006, {}, "the faces cannot be subdivided: their edges or corners do not fit together",
                          "the file is damaged; fetch it again");
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true; // the limit masks need it
    refiner->RefineUniform(uniform);

    const Far::PrimvarRefiner primvars(*refiner);
    std::vector<Position> points = wrap(positions);
    std::vector<Coordinate> coordinates = wrap(uvs);
    for (int level = 1; level <= levels; ++level) {
        std::vector<Position> finerPoints(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
        std::vector<Coordinate> finerCoordinates(static_cast<std::size_t>(refiner->GetLevel(level).GetNumFVarValues(0)));
        primvars.Interpolate(level, points, finerPoints);
        primvars.InterpolateFaceVarying(level, coordinates, finerCoordinates, 0);
        points = std::move(finerPoints);
        coordinates = std::move(finerCoordinates);
    }
    Subdivided result;
    limitSurface(primvars, points, result);
    result.uvs = unwrap(coordinates);
    copyQuads(*refiner, levels, result);
    return result;
}

} // namespace tegument
