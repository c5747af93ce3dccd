// Alembic curves in Ogawa form. A file is a tree of groups and data: a group lists the offsets of its children, of which those with the
// highest bit set are data. Objects and properties are groups whose last child names what is in them.

#include "meshprep/groom/formats.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace tegument::groomfile {

using namespace meshfile;

namespace {

constexpr std::uint64_t kData = std::uint64_t{1} << 63; // of an offset: data stand there, no group
constexpr std::size_t kOgawaHeader = 16;
constexpr std::size_t kKey = 16;    // bytes of a sample's hash, before its values
constexpr std::size_t kHashes = 32; // behind the names of an object's children
constexpr int kDeepestObject = 64;
constexpr std::uint32_t kInline = 0xff; // metadata stand with the property itself

enum Pod : std::uint32_t { kBool, kUint8, kInt8, kUint16, kInt16, kUint32, kInt32, kUint64, kInt64, kFloat16, kFloat32, kFloat64, kPods };
constexpr std::array<std::size_t, kPods> kPodBytes = {1, 1, 1, 2, 2, 4, 4, 8, 8, 2, 4, 8};
enum Kind : std::uint32_t { kCompound, kScalar, kArray };

using Group = std::vector<std::uint64_t>;

struct Property {
    std::string name;
    std::uint32_t kind = kCompound;
    std::uint32_t pod = 0;
    std::size_t extent = 1;
    std::size_t samples = 0;
    std::size_t firstChanged = 0, lastChanged = 0;
    std::uint64_t at = 0;
};

class AlembicReader {
public:
    AlembicReader(const Source& source, std::size_t frame) : source_(source), frame_(frame) {}

    Result<Groom> read() {
        if (source_.bytes.starts_with("\x89HDF"))
            return unsupported(source_.atByte(0), "an Alembic file in HDF5 form cannot be read",
                               "export it again: all programs write Ogawa since 2014");
        if (!source_.bytes.starts_with("Ogawa")) return malformed(source_.atByte(0), "the file does not start with Ogawa");
        if (source_.bytes.size() < kOgawaHeader) return truncated(source_.atByte(source_.bytes.size()), "its header has 16 bytes");
        if (source_.bytes[5] != '\xff')
            return malformed(source_.atByte(5), "the program that wrote the file has not finished it", "export it again");
        const Group root = group(numberAt<std::uint64_t>(source_.bytes, 8));
        if (!error_ && root.size() < 6) return malformed(source_.atByte(8), "the archive lacks its parts");
        if (!error_) readObject(root[2], glm::dmat4(1), 0);
        if (error_) return *error_;
        if (frames_ > 1) ignored(groom_, source_, fmt::format("of {} frames one is read", frames_), "--frame chooses another");
        if (!unread_.empty()) ignored(groom_, source_, fmt::format("its '{}' is not read", unread_));
        return std::move(groom_);
    }

private:
    void fail(Error error) {
        if (!error_) error_ = std::move(error);
    }

    /// What begins there: how many, and then that many bytes each.
    std::string_view block(std::uint64_t at, std::size_t each) {
        at &= ~kData;
        if (error_ || at == 0) return {};
        const std::size_t size = source_.bytes.size();
        if (at > size || size - at < 8) {
            fail(overclaimed(source_.atByte(size), fmt::format("an offset of {} points behind the end", at)));
            return {};
        }
        const auto count = numberAt<std::uint64_t>(source_.bytes, at);
        if (count > (size - at - 8) / each) {
            fail(overclaimed(source_.atByte(at), fmt::format("{} bytes and more are announced, {} are left", count, size - at - 8)));
            return {};
        }
        spent_ += count * each;
        if (spent_ > kPointsOfByte * 12 * size + 4096) fail(overclaimed(source_.atByte(at), "parts of the file are named again and again"));
        return error_ ? std::string_view() : source_.bytes.substr(at + 8, count * each);
    }

    Group group(std::uint64_t at) {
        const std::string_view bytes = (at & kData) != 0 ? std::string_view() : block(at, 8);
        Group children(bytes.size() / 8);
        if (!bytes.empty()) std::memcpy(children.data(), bytes.data(), bytes.size());
        return children;
    }
    std::string_view data(std::uint64_t at) { return (at & kData) != 0 ? block(at, 1) : std::string_view(); }

    void readObject(std::uint64_t at, glm::dmat4 matrix, int depth) {
        if (depth > kDeepestObject) return fail(malformed(source_.atByte(at), "objects stand too deep in each other"));
        const Group children = group(at);
        if (children.empty() || error_) return;
        for (const Property& property : propertiesOf(children.front())) {
            if (property.name == ".xform" && property.kind == kCompound) matrix = moved(matrix, propertiesOf(property.at));
            if (property.name == ".geom" && property.kind == kCompound) addCurves(propertiesOf(property.at), matrix);
        }
        const std::size_t objects = objectsNamed(data(children.back()));
        for (std::size_t i = 0; i < objects && i + 2 < children.size() && !error_; ++i)
            readObject(children[i + 1], matrix, depth + 1);
    }

    /// How many children have a name, each with a byte for its metadata.
    std::size_t objectsNamed(std::string_view names) {
        std::size_t count = 0;
        names = names.substr(0, names.size() - std::min(names.size(), kHashes));
        while (names.size() > 5) {
            const std::size_t length = numberAt<std::uint32_t>(names, 0);
            if (length > names.size() - 5) break;
            std::size_t used = 5 + length;
            if (static_cast<unsigned char>(names[4 + length]) == kInline) {
                if (names.size() - used < 4) break;
                const std::size_t more = numberAt<std::uint32_t>(names, used);
                if (more > names.size() - used - 4) break;
                used += 4 + more;
            }
            names.remove_prefix(used);
            ++count;
        }
        return count;
    }

    /// The names and types are the last child; the others are the properties.
    std::vector<Property> propertiesOf(std::uint64_t at) {
        std::vector<Property> properties;
        const Group children = group(at);
        if (children.empty()) return properties;
        std::string_view left = data(children.back());
        bool cut = false;
        const auto number = [&](std::uint32_t hint) -> std::size_t {
            const std::size_t bytes = std::size_t{1} << hint;
            cut |= hint > 2 || left.size() < bytes;
            std::size_t value = 0;
            for (std::size_t i = 0; i < bytes && !cut; ++i)
                value |= std::size_t{static_cast<unsigned char>(left[i])} << (8 * i);
            if (!cut) left.remove_prefix(bytes);
            return value;
        };
        const auto skip = [&](std::size_t bytes) {
            cut |= bytes > left.size();
            const std::string_view taken = cut ? std::string_view() : left.substr(0, bytes);
            left.remove_prefix(taken.size());
            return taken;
        };
        while (!left.empty() && !error_) {
            const auto info = static_cast<std::uint32_t>(number(2));
            const std::uint32_t hint = info >> 2 & 3;
            Property property{.kind = std::min<std::uint32_t>(info & 3, kArray), .pod = info >> 4 & 15, .extent = info >> 12 & 0xff};
            if (property.kind != kCompound) {
                property.samples = number(hint);
                property.firstChanged = (info & 0x800) != 0 ? 0 : 1;
                property.lastChanged = (info & 0x800) != 0 || property.samples == 0 ? 0 : property.samples - 1;
                if ((info & 0x200) != 0) {
                    property.firstChanged = number(hint);
                    property.lastChanged = number(hint);
                }
                if ((info & 0x100) != 0) number(hint); // its time sampling
            }
            property.name = skip(number(hint));
            if ((info >> 20 & 0xff) == kInline) skip(number(hint));
            if (cut || properties.size() + 1 >= children.size()) {
                fail(overclaimed(source_.atByte(at), "the names of properties do not fit them"));
                break;
            }
            property.at = children[properties.size()];
            properties.push_back(std::move(property));
        }
        return properties;
    }

    /// The bytes of the sample that is asked for, or of the last before it.
    std::string_view sampleOf(const Property& property) {
        if (property.samples == 0 || error_) return {};
        const std::size_t wanted = std::min(frame_, property.samples - 1);
        std::size_t stored = 0; // samples that repeat are stored once
        if (wanted >= property.firstChanged && property.lastChanged > 0 && property.lastChanged >= property.firstChanged)
            stored = std::min(wanted, property.lastChanged) - property.firstChanged + 1;
        const Group children = group(property.at);
        const std::size_t child = property.kind == kArray ? 2 * stored : stored;
        if (child >= children.size()) {
            fail(overclaimed(source_.atByte(property.at & ~kData),
                             fmt::format("'{}' has no sample {}", property.name.substr(0, 60), stored)));
            return {};
        }
        const std::string_view bytes = data(children[child]);
        return bytes.substr(std::min(bytes.size(), kKey));
    }

    static double numberOf(std::string_view bytes, std::uint32_t pod, std::size_t i) {
        const std::size_t at = i * kPodBytes[pod];
        switch (pod) {
        case kBool:
        case kUint8: return numberAt<std::uint8_t>(bytes, at);
        case kInt8: return numberAt<std::int8_t>(bytes, at);
        case kUint16: return numberAt<std::uint16_t>(bytes, at);
        case kInt16: return numberAt<std::int16_t>(bytes, at);
        case kUint32: return numberAt<std::uint32_t>(bytes, at);
        case kInt32: return numberAt<std::int32_t>(bytes, at);
        case kUint64: return static_cast<double>(numberAt<std::uint64_t>(bytes, at));
        case kInt64: return static_cast<double>(numberAt<std::int64_t>(bytes, at));
        case kFloat32: return static_cast<double>(numberAt<float>(bytes, at));
        case kFloat64: return numberAt<double>(bytes, at);
        default: return std::numeric_limits<double>::quiet_NaN(); // halves are not read
        }
    }

    template <class Number>
    std::vector<Number> numbersOf(const Property& property) {
        if (property.kind == kCompound) return indexed<Number>(propertiesOf(property.at));
        const std::string_view bytes = sampleOf(property);
        if (property.pod >= kPods) return {};
        const std::size_t count = bytes.size() / kPodBytes[property.pod];
        std::vector<Number> values(count);
        if (property.pod == kFloat32 && std::is_same_v<Number, float>) {
            if (count > 0) std::memcpy(values.data(), bytes.data(), count * sizeof(float));
            return values;
        }
        for (std::size_t i = 0; i < count; ++i) {
            double value = numberOf(bytes, property.pod, i);
            if constexpr (std::is_integral_v<Number>)
                value = std::clamp(value, double(std::numeric_limits<Number>::min()), double(std::numeric_limits<Number>::max()));
            if constexpr (std::is_integral_v<Number>)
                if (std::isnan(value)) value = 0;
            values[i] = static_cast<Number>(value);
        }
        return values;
    }

    /// Values and their numbers apart.
    template <class Number>
    std::vector<Number> indexed(const std::vector<Property>& parts) {
        const auto values = std::ranges::find(parts, ".vals", &Property::name);
        const auto indices = std::ranges::find(parts, ".indices", &Property::name);
        if (values == parts.end() || indices == parts.end() || values->kind == kCompound || indices->kind == kCompound) return {};
        const std::vector<Number> table = numbersOf<Number>(*values);
        const std::vector<std::uint32_t> numbers = numbersOf<std::uint32_t>(*indices);
        const std::size_t extent = std::max<std::size_t>(values->extent, 1);
        spent_ += numbers.size() * extent * sizeof(Number);
        if (spent_ > kPointsOfByte * 12 * source_.bytes.size() + 4096) return {};
        std::vector<Number> all;
        for (const std::uint32_t i : numbers)
            for (std::size_t k = 0; k < extent; ++k)
                all.push_back(i < table.size() / extent ? table[i * extent + k] : Number{});
        return all;
    }

    /// Operations of a transform, the outermost first: scale, translate, rotate, matrix, rotate about x, y, z.
    glm::dmat4 moved(const glm::dmat4& above, const std::vector<Property>& parts) {
        std::vector<std::uint8_t> operations;
        std::vector<double> v;
        glm::dmat4 matrix = above;
        for (const Property& part : parts) {
            if (part.kind == kCompound) continue;
            if (part.name == ".ops") operations = numbersOf<std::uint8_t>(part);
            if (part.name == ".vals") v = numbersOf<double>(part);
            if (part.name != ".inherits") continue;
            if (const auto inherits = numbersOf<std::uint8_t>(part); !inherits.empty() && inherits.front() == 0) matrix = glm::dmat4(1);
        }
        constexpr std::array<std::size_t, 7> kNumbers = {3, 3, 4, 16, 1, 1, 1};
        std::size_t at = 0;
        for (const std::uint8_t operation : operations) {
            const std::size_t kind = operation >> 4;
            if (kind >= kNumbers.size() || kNumbers[kind] > v.size() - at) break;
            const double* n = &v[at];
            at += kNumbers[kind];
            glm::dvec3 axis(0);
            if (kind >= 4) axis[static_cast<glm::length_t>(kind - 4)] = 1;
            if (kind == 0) matrix = glm::scale(matrix, glm::dvec3(n[0], n[1], n[2]));
            if (kind == 1) matrix = glm::translate(matrix, glm::dvec3(n[0], n[1], n[2]));
            if (kind == 2) axis = {n[0], n[1], n[2]};
            if ((kind == 2 && glm::length(axis) > 0) || kind >= 4) matrix = glm::rotate(matrix, glm::radians(n[kind == 2 ? 3 : 0]), axis);
            if (kind != 3) continue;
            glm::dmat4 given;
            for (glm::length_t i = 0; i < 16; ++i)
                given[i / 4][i % 4] = n[i]; // rows of Imath are columns of GLM
            matrix *= given;
        }
        return matrix;
    }

    template <class Vector>
    std::vector<Vector> vectorsOf(const Property& property) {
        const std::vector<float> numbers = numbersOf<float>(property);
        std::vector<Vector> list(numbers.size() / static_cast<std::size_t>(Vector::length()));
        if (!list.empty()) std::memcpy(static_cast<void*>(list.data()), numbers.data(), list.size() * sizeof(Vector));
        return list;
    }

    template <class Target, class Taken>
    void keep(const Property& property, Target& target, Taken taken) {
        if (taken)
            target = *std::move(taken);
        else
            unread_ = property.name.substr(0, 60);
    }

    void addCurves(const std::vector<Property>& geometry, const glm::dmat4& matrix) {
        const auto named = [&](const char* name) { return std::ranges::find(geometry, name, &Property::name); };
        const auto places = named("P"), counts = named("nVertices"), kind = named("curveBasisAndType");
        if (places == geometry.end() || counts == geometry.end() || kind == geometry.end()) return; // a mesh, or points
        const std::vector<std::uint8_t> basis = numbersOf<std::uint8_t>(*kind);
        if (basis.size() < 3 || error_) return fail(malformed(source_.whole(), "curves do not say of which kind they are"));
        Groom curves;
        constexpr std::array<Spline, 4> kSplines = {Spline::Linear, Spline::Bezier, Spline::BSpline, Spline::CatmullRom};
        if (basis[0] > 1 || basis[1] != 0 || (basis[0] == 0 && basis[2] >= kSplines.size()))
            return fail(unsupported(source_.whole(),
                                    fmt::format("curves of type {}, wrap {} and basis {} are not read", basis[0], basis[1], basis[2]),
                                    "export open curves: linear, or cubic Bezier, B-spline or Catmull-Rom"));
        curves.spline = basis[0] == 1 ? Spline::Linear : kSplines[basis[2]];
        curves.points = vectorsOf<glm::vec3>(*places);
        std::size_t sum = 0;
        for (const std::int32_t count : numbersOf<std::int32_t>(*counts)) {
            if (count < 0 || static_cast<std::size_t>(count) > curves.points.size() - sum)
                return fail(overclaimed(source_.whole(), fmt::format("curves have more than their {} points", curves.points.size())));
            sum += static_cast<std::size_t>(count);
            curves.first.push_back(static_cast<std::uint32_t>(sum));
        }
        if (error_ || sum == 0) return;
        if (sum != curves.points.size())
            return fail(overclaimed(source_.whole(), fmt::format("curves have {} of their {} points", sum, curves.points.size())));
        frames_ = std::max({frames_, places->samples, counts->samples});
        std::vector<Property> told = geometry;
        if (const auto more = named(".arbGeomParams"); more != geometry.end() && more->kind == kCompound)
            for (Property& property : propertiesOf(more->at))
                told.push_back(std::move(property));
        for (const Property& property : told)
            readTold(property, curves);
        transform(curves, matrix);
        merge(groom_, std::move(curves), source_);
    }

    void readTold(const Property& property, Groom& curves) {
        const std::string& name = property.name;
        const auto is = [&](std::initializer_list<std::string_view> names) { return std::ranges::find(names, name) != names.end(); };
        if (is({"width", "groom_width"}))
            keep(property, curves.widths, toPoints(curves, numbersOf<float>(property)));
        else if (is({"groom_color", "Cd", "displayColor"}))
            keep(property, curves.colors, toPoints(curves, vectorsOf<glm::vec3>(property)));
        else if (is({"uv", "groom_root_uv"}))
            keep(property, curves.rootUvs, toStrands(curves, vectorsOf<glm::vec2>(property)));
        else if (name == "groom_id")
            keep(property, curves.ids, toStrands(curves, numbersOf<std::int32_t>(property)));
        else if (name == "groom_guide")
            keep(property, curves.guides, toStrands(curves, numbersOf<std::int32_t>(property)));
        else if (name == "groom_clumpid")
            keep(property, curves.clumps, toStrands(curves, firstOf(property)));
        else if (name.starts_with("groom_") && !name.starts_with("groom_version"))
            unread_ = name.substr(0, 60);
    }

    /// Of vectors, their first number each: Unreal's clumps are of three levels.
    std::vector<std::int32_t> firstOf(const Property& property) {
        const std::vector<std::int32_t> all = numbersOf<std::int32_t>(property);
        const std::size_t extent = property.kind == kCompound ? 1 : std::max<std::size_t>(property.extent, 1);
        std::vector<std::int32_t> first;
        for (std::size_t i = 0; i < all.size(); i += extent)
            first.push_back(all[i]);
        return first;
    }

    const Source& source_;
    std::size_t frame_;
    std::optional<Error> error_;
    Groom groom_;
    std::size_t frames_ = 1;
    std::size_t spent_ = 0; // bytes that were looked at
    std::string unread_;
};

/// Groups and data are written before what lists them.
class AlembicWriter {
public:
    std::string write(const Groom& groom) {
        bytes_ = std::string("Ogawa\xff\0\1", 8);
        append(bytes_, std::uint64_t{0}); // of the root group, set at the end
        const std::uint64_t metadata = addData("_ai_AlembicVersion=Alembic 1.8.5;_ai_Application=Tegument");
        Compound more;
        const std::string params = "arrayExtent=1;geoScope={};{}isGeomParam=true;podExtent={};podName={}";
        const auto param = [&](const char* scope, const char* is, int extent, const char* pod) {
            return fmt::format(fmt::runtime(params), scope, is, extent, pod);
        };
        if (!groom.colors.empty())
            array(more, "groom_color", kFloat32, 3, groom.colors, param("vtx", "interpretation=rgb;", 3, "float32_t"));
        if (!groom.rootUvs.empty()) array(more, "groom_root_uv", kFloat32, 2, groom.rootUvs, param("uni", "", 2, "float32_t"));
        const std::pair<const char*, const std::vector<std::int32_t>*> numbers[] = {
            {"groom_id", &groom.ids}, {"groom_guide", &groom.guides}, {"groom_clumpid", &groom.clumps}};
        for (const auto& [name, list] : numbers)
            if (!list->empty()) array(more, name, kInt32, 1, *list, param("uni", "", 1, "int32_t"));

        Compound geometry;
        glm::vec3 low = groom.points.front(), high = low;
        std::vector<std::int32_t> counts;
        for (const glm::vec3& p : groom.points) {
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        for (std::size_t i = 0; i < groom.strands(); ++i)
            counts.push_back(static_cast<std::int32_t>(groom.length(i)));
        const std::vector<glm::dvec3> box = {low, high};
        scalar(geometry, ".selfBnds", kFloat64, 6, box, "interpretation=box");
        array(geometry, "P", kFloat32, 3, groom.points, "geoScope=vtx;interpretation=point");
        array(geometry, "nVertices", kInt32, 1, counts, "");
        const auto basis = static_cast<std::uint8_t>(groom.spline);
        const std::vector<std::uint8_t> kinds = {static_cast<std::uint8_t>(groom.spline == Spline::Linear ? 1 : 0), 0, basis, basis};
        scalar(geometry, "curveBasisAndType", kUint8, 4, kinds, "");
        if (!groom.widths.empty()) array(geometry, "width", kFloat32, 1, groom.widths, param("vtx", "", 1, "float32_t"));
        if (!groom.rootUvs.empty())
            array(geometry, "uv", kFloat32, 2, groom.rootUvs, param("uni", "interpretation=vector;", 2, "float32_t"));
        if (!more.children.empty()) compound(geometry, ".arbGeomParams", close(more), "");

        Compound properties;
        const std::string schema = "schema=AbcGeom_Curve_v2;schemaBaseType=AbcGeom_GeomBase_v1";
        compound(properties, ".geom", close(geometry), schema);
        const std::uint64_t curves = addGroup({close(properties), addData(std::string(kHashes, '\0'))});
        std::string names;
        const std::string name = "groom", title = schema + ";schemaObjTitle=AbcGeom_Curve_v2:.geom";
        append(names, static_cast<std::uint32_t>(name.size()));
        names += name + static_cast<char>(kInline);
        append(names, static_cast<std::uint32_t>(title.size()));
        names += title + std::string(kHashes, '\0');
        const std::uint64_t top = addGroup({0, curves, addData(names)});
        std::string times; // one sampling: its most samples, seconds of a cycle, times
        append(times, std::uint32_t{1});
        append(times, 1.0);
        append(times, std::uint32_t{1});
        append(times, 0.0);
        const std::uint64_t root = addGroup({addData(std::string(4, '\0')), addData(number(10805)), top, metadata, addData(times), kData});
        std::memcpy(bytes_.data() + 8, &root, sizeof root);
        return std::move(bytes_);
    }

private:
    struct Compound {
        Group children;
        std::string headers;
    };

    static std::string number(std::uint32_t value) {
        std::string bytes;
        append(bytes, value);
        return bytes;
    }

    std::uint64_t addData(std::string_view values) {
        const std::uint64_t at = bytes_.size();
        append(bytes_, std::uint64_t{values.size()});
        bytes_ += values;
        return at | kData;
    }
    std::uint64_t addGroup(const Group& children) {
        const std::uint64_t at = bytes_.size();
        append(bytes_, std::uint64_t{children.size()});
        append(bytes_, children);
        return at;
    }
    std::uint64_t close(Compound& compound) {
        compound.children.push_back(addData(compound.headers));
        return addGroup(compound.children);
    }

    /// Names and metadata are shorter than 256 bytes: their lengths are single ones.
    static void header(Compound& to, std::string_view name, std::uint32_t info, std::string_view metadata) {
        append(to.headers, info | (metadata.empty() ? 0U : kInline << 20));
        if ((info & 3) != kCompound) to.headers.push_back('\1'); // samples
        to.headers.push_back(static_cast<char>(name.size()));
        to.headers += name;
        if (metadata.empty()) return;
        to.headers.push_back(static_cast<char>(metadata.size()));
        to.headers += metadata;
    }

    /// A hash of the values stands before them, by which readers know equal ones.
    template <class Value>
    std::uint64_t sample(const std::vector<Value>& values) {
        std::string data;
        append(data, (counter_ += 0x9E3779B97F4A7C15U));
        append(data, std::uint64_t{values.size()});
        append(data, values);
        return addData(data);
    }
    template <class Value>
    void property(Compound& to, const char* name, Kind kind, Pod pod, std::uint32_t extent, const std::vector<Value>& values,
                  const std::string& metadata) {
        const std::uint64_t data = sample(values);
        to.children.push_back(kind == kArray ? addGroup({data, kData}) : addGroup({data}));
        header(to, name, kind | pod << 4 | 0xC00U | extent << 12, metadata); // all of one size, and the same at all times
    }
    template <class Value>
    void array(Compound& to, const char* name, Pod pod, std::uint32_t extent, const std::vector<Value>& values,
               const std::string& metadata) {
        property(to, name, kArray, pod, extent, values, metadata);
    }
    template <class Value>
    void scalar(Compound& to, const char* name, Pod pod, std::uint32_t extent, const std::vector<Value>& values,
                const std::string& metadata) {
        property(to, name, kScalar, pod, extent, values, metadata);
    }
    static void compound(Compound& to, const char* name, std::uint64_t at, const std::string& metadata) {
        to.children.push_back(at);
        header(to, name, kCompound, metadata);
    }

    std::string bytes_;
    std::uint64_t counter_ = 0;
};

} // namespace

Result<Groom> readAlembic(const Source& source, std::size_t frame) {
    return AlembicReader(source, frame).read();
}

std::string writeAlembic(const Groom& groom) {
    return AlembicWriter().write(groom.pinned ? evaluated(groom) : groom);
}

} // namespace tegument::groomfile
