// PLY, text and both byte orders. Elements may come in any order and carry any properties; only vertices and faces are used.

#include "host/mesh/ply_values.h"
#include "host/mesh/polygons.h"
#include "host/mesh/welding.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace tegument::meshfile {

namespace {

/// Which property of a vertex row is what.
struct VertexLayout {
    std::optional<std::size_t> x, y, z, nx, ny, nz, u, v, red, green, blue, alpha;
    std::vector<std::size_t> others; // what the mesh carries along
    bool lists = false;

    explicit VertexLayout(const PlyElement& element)
        : x(element.find({"x", "X"})), y(element.find({"y", "Y"})), z(element.find({"z", "Z"})), nx(element.find({"nx"})),
          ny(element.find({"ny"})), nz(element.find({"nz"})), u(element.find({"u", "s", "texture_u"})),
          v(element.find({"v", "t", "texture_v"})), red(element.find({"red", "diffuse_red"})),
          green(element.find({"green", "diffuse_green"})), blue(element.find({"blue", "diffuse_blue"})),
          alpha(element.find({"alpha", "diffuse_alpha"})) {
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const bool list = element.properties[i].listCount.has_value();
            lists |= list;
            if (!list && !known(i)) others.push_back(i);
        }
    }

    [[nodiscard]] bool hasNormals() const { return nx && ny && nz; }
    [[nodiscard]] bool hasUvs() const { return u && v; }
    [[nodiscard]] bool hasColors() const { return red && green && blue; }

private:
    [[nodiscard]] bool known(std::size_t i) const {
        if (i == x || i == y || i == z) return true;
        if (hasNormals() && (i == nx || i == ny || i == nz)) return true;
        if (hasUvs() && (i == u || i == v)) return true;
        return hasColors() && (i == red || i == green || i == blue || i == alpha);
    }
};

/// What stands for 1 in the type of a colour or of a texture coordinate. Those in floats are 0 to 1.
double fullOne(NumberType type) {
    if (type == NumberType::Uint8) return 255;
    return type == NumberType::Uint16 ? 65535 : 1;
}

/// What stands for 1 in them is their greatest number: meshprep/fur/roots/vertex_values.h.
bool isSmall(NumberType type) {
    return type == NumberType::Int8 || type == NumberType::Uint8 || type == NumberType::Int16 || type == NumberType::Uint16;
}

std::string namesOf(const PlyElement& element, const auto& wanted) {
    std::string names;
    for (const PlyProperty& property : element.properties)
        if (wanted(property)) names += (names.empty() ? "" : ", ") + property.name;
    return names;
}

class PlyReader {
public:
    PlyReader(const Source& source, const PlyHeader& header) : source_(source), header_(header), values_(source, header) {}

    Result<ReadMesh> read() {
        for (const PlyElement& element : header_.elements) {
            if (element.name == "vertex" && !verticesRead_)
                readVertices(element);
            else if (element.name == "face")
                readFaces(element);
            else if (element.name == "tristrips")
                readStrips(element);
            else
                leaveOut(element);
            if (values_.error()) return *values_.error();
        }
        if (const auto wrong = values_.checkEnd()) return *wrong;
        if (const auto wrong = checkIndices()) return *wrong;
        if (const auto wrong = polygons_.cut(source_, mesh().positions, result_.exact, mesh().indices)) return *wrong;
        mesh().parts.push_back(
            {.name = source_.path.stem().string(), .firstIndex = 0, .indexCount = static_cast<std::uint32_t>(mesh().indices.size())});
        if (!mesh().uvs.empty()) addPicture();
        for (const auto& [word, line] : header_.otherLines)
            warn(mesh(), 5323, source_.atLine(line), fmt::format("the header's line '{}' is ignored", word));
        if (longRows_ > 0)
            warn(mesh(), 5323, source_.whole(),
                 fmt::format("{} faces have more values than the header declares: the rest of their lines is ignored", longRows_));
        if (wedges_.missing)
            warn(mesh(), 5325, source_.whole(), "some corners have no texture coordinates: their vertex's are used, or (0, 0)",
                 "unwrap the whole mesh");
        return std::move(result_);
    }

private:
    Mesh& mesh() { return result_.mesh; }

    void addPicture() {
        if (header_.pictures.empty()) return;
        if (sheet_ && otherPictures_) return useColourSheet(source_, header_.pictures, mesh());
        for (glm::vec2& uv : mesh().uvs)
            if (sheet_) uv.x *= static_cast<float>(header_.pictures.size());
        if (header_.pictures.size() > 1)
            warn(mesh(), 5326, source_.whole(),
                 fmt::format("'{}' and {} more pictures are ignored: one mesh carries one", header_.pictures[1].substr(0, 80),
                             header_.pictures.size() - 2),
                 "name the texture in the workspace, or split the mesh");
        if (source_.carryMaterials)
            carryColourMap(source_, header_.pictures.front(), mesh());
        else
            useColourMap(source_, objFileIn(source_.path.parent_path(), header_.pictures.front()), mesh());
    }

    void leaveOut(const PlyElement& element) {
        values_.skip(element);
        if (element.count > 0)
            warn(mesh(), 5331, source_.atLine(element.line), fmt::format("the {} elements '{}' are left out", element.count, element.name));
    }

    void readVertices(const PlyElement& element) {
        const VertexLayout layout(element);
        verticesRead_ = true;
        if (!layout.x || !layout.y || !layout.z)
            return values_.fail(malformed(source_.atLine(element.line), "the vertices have no x, y and z"));
        if (element.count > kMaxVertices) return values_.fail(tooLarge(source_.atLine(element.line)));
        result_.counts.vertices = element.count;
        reserve(element.count, layout); // the header's counts were held against the file's size
        result_.floats = header_.format != PlyFormat::Ascii && element.properties[*layout.x].type == PlyType::Float32;
        if (layout.lists)
            warn(mesh(), 5331, source_.atLine(element.line),
                 fmt::format("lists of vertices are left out: {}",
                             namesOf(element, [](const PlyProperty& p) { return p.listCount.has_value(); })));
        for (const std::size_t other : layout.others)
            mesh().attributes.push_back({.name = element.properties[other].name,
                                         .type = element.properties[other].type,
                                         .normalised = isSmall(element.properties[other].type)});
        std::vector<double> row;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            values_.nextRow(element, row);
            const glm::vec3 position = scaled({row[*layout.x], row[*layout.y], row[*layout.z]}, source_.unitMm);
            if (!source_.keepNotFinite && !isFinite(position))
                values_.fail(notFinite(values_.at(), fmt::format("vertex {} has a coordinate that is not finite", i)));
            if (values_.error()) return;
            mesh().positions.push_back(position);
            if (!result_.floats) result_.exact.push_back(glm::dvec3(row[*layout.x], row[*layout.y], row[*layout.z]) * source_.unitMm);
            keepRest(element, layout, row);
            if (layout.hasNormals()) mesh().normals.emplace_back(row[*layout.nx], row[*layout.ny], row[*layout.nz]);
            if (layout.hasUvs()) // PLY's v points up, as in OBJ
                mesh().uvs.emplace_back(row[*layout.u] / fullOne(element.properties[*layout.u].type),
                                        1 - row[*layout.v] / fullOne(element.properties[*layout.v].type));
        }
    }

    void keepRest(const PlyElement& element, const VertexLayout& layout, const std::vector<double>& row) {
        for (std::size_t k = 0; k < layout.others.size(); ++k)
            mesh().attributes[k].values.push_back(row[layout.others[k]]);
        if (!layout.hasColors()) return;
        const auto channel = [&](std::size_t i) { return row[i] / fullOne(element.properties[i].type); };
        mesh().colors.push_back(
            linearColor({channel(*layout.red), channel(*layout.green), channel(*layout.blue), layout.alpha ? channel(*layout.alpha) : 1}));
    }

    void reserve(std::size_t count, const VertexLayout& layout) {
        mesh().positions.reserve(count);
        if (layout.hasNormals()) mesh().normals.reserve(count);
        if (layout.hasUvs()) mesh().uvs.reserve(count);
    }

    void readFaces(const PlyElement& element) {
        auto list = element.find({"vertex_indices", "vertex_index"});
        if (!list) list = onlyList(element);
        if (!list || !element.properties[*list].listCount)
            return values_.fail(malformed(source_.atLine(element.line), "the faces have no list vertex_indices"));
        result_.counts.faces += element.count;
        const auto uvs = startWedges(element);
        const std::string others = namesOf(element, [&](const PlyProperty& p) {
            const auto at = static_cast<std::size_t>(&p - element.properties.data());
            return at != list && at != uvs && !(uvs && p.name == "texnumber");
        });
        if (!others.empty() && element.count > 0)
            warn(mesh(), 5331, source_.atLine(element.line), fmt::format("what the faces carry is left out: {}", others),
                 "give it to the vertices to keep it");
        std::vector<std::uint32_t> corners;
        std::vector<double> numbers; // u and v of each corner
        const auto picture = element.find({"texnumber"});
        sheet_ = sheet_ || (uvs && picture && header_.pictures.size() > 1 && !source_.carryMaterials);
        double number = 0;
        for (std::uint64_t face = 0; face < element.count && !values_.error(); ++face) {
            bool usable = true;
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty& property = element.properties[i];
                if (i == *list)
                    usable = readCorners(property, face, corners);
                else if (i == uvs)
                    readNumbers(property, numbers);
                else if (property.listCount)
                    values_.skipList(property);
                else if (const double value = values_.next(property.type); i == picture) {
                    number = value;
                    otherPictures_ = otherPictures_ || number != 0;
                }
            }
            longRows_ += values_.skipRestOfLine();
            if (!usable || values_.error()) continue;
            for (std::size_t i = 0; sheet_ && i < numbers.size(); i += 2) {
                const auto pictures = static_cast<double>(header_.pictures.size());
                numbers[i] = (numbers[i] + std::clamp(number, 0.0, pictures - 1)) / pictures;
            }
            if (uvs) splitAtSeams(corners, numbers);
            addFace(corners, face);
        }
    }

    /// Some programs call the corners otherwise; where there is one list of whole numbers it can be nothing else.
    static std::optional<std::size_t> onlyList(const PlyElement& element) {
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < element.properties.size(); ++i) {
            const PlyProperty& property = element.properties[i];
            if (!property.listCount || property.type == PlyType::Float32 || property.type == PlyType::Float64) continue;
            if (found) return std::nullopt;
            found = i;
        }
        return found;
    }

    /// Texture coordinates of corners, where the vertices have none: MeshLab's list `texcoord`.
    std::optional<std::size_t> startWedges(const PlyElement& element) {
        const auto list = element.find({"texcoord"});
        const bool goesOn = !wedges_.vertex.empty(); // of faces in several elements
        const bool ofVertices = !mesh().uvs.empty() && !goesOn;
        if (!list || !element.properties[*list].listCount || !verticesRead_ || ofVertices) return std::nullopt;
        if (goesOn) return list;
        wedges_.vertex.resize(mesh().positions.size());
        std::iota(wedges_.vertex.begin(), wedges_.vertex.end(), 0U);
        wedges_.taken.resize(mesh().positions.size());
        mesh().uvs.resize(mesh().positions.size());
        return list;
    }

    void readNumbers(const PlyProperty& property, std::vector<double>& numbers) {
        numbers.clear();
        for (std::size_t left = values_.nextCount(property); left > 0 && !values_.error(); --left)
            numbers.push_back(values_.next(property.type));
    }

    void splitAtSeams(std::vector<std::uint32_t>& corners, const std::vector<double>& numbers) {
        const bool whole = numbers.size() == 2 * corners.size();
        wedges_.missing = wedges_.missing || !whole;
        for (std::size_t i = 0; whole && i < corners.size(); ++i)
            corners[i] = withUv(corners[i], glm::vec2(numbers[2 * i], 1 - numbers[2 * i + 1]));
        if (mesh().positions.size() > kMaxVertices) values_.fail(tooLarge(values_.at()));
    }

    /// The vertex with these texture coordinates: itself for the first of them, copies for others.
    std::uint32_t withUv(std::uint32_t vertex, const glm::vec2& uv) {
        const auto keyOf = [&](std::uint32_t of, const glm::vec2& at) {
            const auto bits = floatKey<2>({at.x, at.y});
            return std::array<std::uint32_t, 3>{of, bits[0], bits[1]};
        };
        const auto wanted = keyOf(vertex, uv);
        const bool first = wedges_.taken[vertex] == 0;
        const std::uint32_t next = first ? vertex : static_cast<std::uint32_t>(mesh().positions.size());
        const std::uint32_t found = wedges_.known.findOrAdd(
            hashWords(wanted), next, [&](std::uint32_t other) { return keyOf(wedges_.vertex[other], mesh().uvs[other]) == wanted; });
        if (found != next) return found;
        if (!first) copyVertex(vertex);
        wedges_.taken[next] = 1;
        mesh().uvs[next] = uv;
        return next;
    }

    void copyVertex(std::uint32_t vertex) {
        const auto copy = [&](auto& list) {
            if (!list.empty()) list.push_back(list[vertex]);
        };
        copy(mesh().positions), copy(mesh().normals), copy(mesh().uvs), copy(mesh().colors), copy(result_.exact);
        for (MeshAttribute& attribute : mesh().attributes)
            copy(attribute.values);
        wedges_.vertex.push_back(vertex);
        wedges_.taken.push_back(0);
    }

    /// Strips of triangles, each turned against the one before; -1 begins a new strip (G. Turk's own files, Stanford's archive).
    void readStrips(const PlyElement& element) {
        const auto list = element.find({"vertex_indices", "vertex_index"});
        if (!list || !element.properties[*list].listCount || element.properties.size() != 1)
            return values_.fail(malformed(source_.atLine(element.line), "the strips have no list vertex_indices, or more than that"));
        const double end = endOfVertices();
        const PlyType type = element.properties[*list].type;
        for (std::uint64_t strip = 0; strip < element.count && !values_.error(); ++strip) {
            std::vector<std::uint32_t> run;
            for (std::size_t left = values_.nextCount(element.properties[*list]); left > 0 && !values_.error(); --left) {
                const double index = values_.next(type);
                if (index >= 0 && index < end)
                    run.push_back(static_cast<std::uint32_t>(index));
                else if (index == -1)
                    run.clear();
                else if (source_.dropBadFaces)
                    run.clear(), ++result_.counts.badFaces;
                else
                    values_.fail(badIndex(values_.at(), badIndexText(result_.counts.faces, index)));
                if (run.size() >= 3) addStripFace(run);
            }
        }
    }

    void addStripFace(const std::vector<std::uint32_t>& run) {
        const std::size_t last = run.size() - 1;
        std::vector<std::uint32_t> corners = {run[last - 2], run[last - 1], run[last]};
        if (last % 2 == 1) std::swap(corners[0], corners[1]);
        addFace(corners, result_.counts.faces++);
    }

    /// False for a face that refers to no vertex and is left out. Vertices may follow: then only what no vertex can have is found here.
    bool readCorners(const PlyProperty& property, std::uint64_t face, std::vector<std::uint32_t>& corners) {
        const double end = endOfVertices();
        bool usable = true;
        corners.clear();
        for (std::size_t left = values_.nextCount(property); left > 0 && !values_.error(); --left) {
            const double index = values_.next(property.type);
            if (index >= 0 && index < end)
                corners.push_back(static_cast<std::uint32_t>(index));
            else if (source_.dropBadFaces)
                usable = false;
            else
                values_.fail(badIndex(values_.at(), badIndexText(face, index)));
        }
        result_.counts.badFaces += !usable;
        return usable;
    }

    [[nodiscard]] std::string badIndexText(std::uint64_t face, double index) {
        if (!verticesRead_) return fmt::format("face {} refers to vertex {}", face, index);
        return fmt::format("face {} refers to vertex {} of {}", face, index, result_.counts.vertices);
    }

    /// Of the file's: copies that seams have made follow them, and no face of the file means one.
    [[nodiscard]] double endOfVertices() const { return static_cast<double>(verticesRead_ ? result_.counts.vertices : kMaxVertices); }

    void addFace(const std::vector<std::uint32_t>& corners, std::uint64_t face) {
        result_.counts.smallFaces += corners.size() < 3;
        polygons_.add(corners, mesh().indices);
        if (!verticesRead_) lastIndexOfFace_.emplace_back(mesh().indices.size(), face);
        if (mesh().indices.size() > kMaxIndices) values_.fail(tooLarge(values_.at()));
    }

    /// Of faces that came before their vertices: these are refused even with `dropBadFaces`, for a polygon is no longer told from a fan.
    [[nodiscard]] std::optional<Error> checkIndices() {
        if (lastIndexOfFace_.empty()) return std::nullopt;
        const std::vector<std::uint32_t>& indices = mesh().indices;
        const auto wrong = std::ranges::find_if(indices, [&](std::uint32_t index) { return index >= mesh().positions.size(); });
        if (wrong == indices.end()) return std::nullopt;
        const auto at = static_cast<std::size_t>(wrong - indices.begin());
        const auto face = std::ranges::upper_bound(lastIndexOfFace_, at, {}, &std::pair<std::size_t, std::uint64_t>::first);
        return badIndex(source_.whole(), badIndexText(face->second, *wrong));
    }

    const Source& source_;
    const PlyHeader& header_;
    PlyValues values_;
    ReadMesh result_;
    Polygons polygons_;
    std::vector<std::pair<std::size_t, std::uint64_t>> lastIndexOfFace_; // (indices so far, face), when vertices follow the faces
    bool verticesRead_ = false;
    std::size_t longRows_ = 0;
    bool sheet_ = false;         // pictures lie side by side, as faces name them by number,
    bool otherPictures_ = false; // and not all name the first
    struct {
        std::vector<std::uint32_t> vertex; // of each: which of the file it is
        std::vector<std::uint8_t> taken;   // it has texture coordinates
        UniqueItems known;                 // by vertex and texture coordinates
        bool missing = false;
    } wedges_;
};

} // namespace

Result<ReadMesh> readPly(const Source& source) {
    const Result<PlyHeader> header = readPlyHeader(source);
    if (!header) return header.error();
    return PlyReader(source, *header).read();
}

} // namespace tegument::meshfile
