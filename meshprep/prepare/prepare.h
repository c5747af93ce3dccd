#pragma once
// The whole way of `tegument prep`: a mesh file read, cleaned, centred, given normals, indexed and put in order. docs/meshprep.md.

#include "host/mesh/read_mesh.h"
#include "meshprep/order/order.h"
#include "meshprep/prepare/centre.h"
#include "meshprep/prepare/chunks.h"
#include "meshprep/prepare/figures.h"
#include "meshprep/prepare/levels.h"
#include "meshprep/prepare/mapping.h"
#include "meshprep/prepare/points.h"
#include "meshprep/prepare/topology.h"
#include "meshprep/prepare/vertex_format.h"
#include "meshprep/prepare/vertex_normals.h"
#include "meshprep/write/glb.h"

#include <functional>

namespace tegument::prep {

struct PrepOptions {
    ReadOptions read;
    SamePlace same;
    bool keepDuplicates = false; // leave triangles that repeat another
    bool orient = false;         // turn the minority of each component
    CentreMode centre = CentreMode::Ball;
    NormalOptions normals;
    bool guessUnit = false;                                   // where no unit is given and the size is implausible: host/mesh/mesh.h
    bool flipV = false;                                       // the file's v runs against its format's convention: it is turned
    bool turnUp = false;                                      // z is up in the file: turned, so that y is, as glTF has it
    bool unwrap = false;                                      // make texture coordinates, in place of those that there are
    std::optional<order::Method> order = order::Method::Best; // none: the file's
    order::CacheModel cache = order::kWarp;
    bool overdraw = false;
    int levels = 4; // the full mesh counts as one
    LevelMethod levelMethod = LevelMethod::Meshoptimizer;
    VertexPrecision precision = VertexPrecision::Float;
    bool chunk16 = false;
    bool mappingReport = false;
    std::function<void(const std::string&)> progress; // told before each step
};

/// What one step did. `changed` counts what `text` says.
struct PrepStep {
    std::string name;
    std::size_t changed = 0;
    std::string text;
    double seconds = 0;
};

struct Count {
    std::size_t vertices = 0;
    std::size_t faces = 0;
};

struct CacheComparison {
    NamedModel model;
    order::CacheCost before; // indexed, in the file's order
    order::CacheCost after;
};

struct LevelFigures {
    std::size_t triangles = 0;
    SurfaceDistance error; // mm
};

struct PrepReport {
    Count input; // as in the file: polygons count as faces
    std::vector<PrepStep> steps;
    Count output;
    std::size_t triangles = 0; // of the input, polygons cut
    Places places;
    Topology topology; // of what is written
    Centring centring;
    std::vector<CacheComparison> cache;
    std::vector<LevelFigures> levels; // from the second on
    std::optional<Overdraw> overdraw;
    std::vector<MappingFigures> mapping;  // if asked for
    std::vector<RootMapping> rootMapping; // likewise
    VertexError precision;
    Chunks chunks;
    SizeFigures bytes;     // with all that is written of the full mesh
    SizeFigures seedBytes; // by the source document's vertex of 24 bytes: position and normal
    std::vector<Diagnostic> warnings;
};

struct Prepared {
    Mesh mesh;
    GlbOptions glb; // how to write it, with its levels
    PrepReport report;
};

[[nodiscard]] Result<Prepared> prepareMesh(const std::filesystem::path& path, const PrepOptions& options);

} // namespace tegument::prep
