#include "tests/meshprep/prepare/hard_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numbers>
#include <random>

namespace tegument::testing_prep {

namespace {

using Faces = std::vector<std::vector<int>>;
using Points = std::vector<std::array<double, 3>>;

const Points kTetraPoints = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const Faces kTetra = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};

std::string header(const std::string& format, const std::string& vertices, const std::string& faces,
                   const std::string& coordinate = "float", const std::string& list = "uchar int") {
    return fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n"
                       "element face {}\nproperty list {} vertex_indices\nend_header\n",
                       format, vertices, coordinate, coordinate, coordinate, faces, list);
}

std::string header(const std::string& format, std::size_t vertices, std::size_t faces) {
    return header(format, std::to_string(vertices), std::to_string(faces));
}

std::string facesText(const Faces& faces) {
    std::string text;
    for (const auto& face : faces) {
        text += std::to_string(face.size());
        for (const int corner : face)
            text += " " + std::to_string(corner);
        text += "\n";
    }
    return text;
}

std::string plyText(const Points& points, const Faces& faces) {
    std::string text = header("ascii", points.size(), faces.size());
    for (const auto& p : points)
        text += fmt::format("{} {} {}\n", p[0], p[1], p[2]);
    return text + facesText(faces);
}

template <class T>
void put(std::string& bytes, T value, bool big = false) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), &value, sizeof(T));
    if (big) std::reverse(raw.begin(), raw.end());
    bytes.append(raw.data(), raw.size());
}

/// Coordinates as Real, list lengths as Length, corners as 32-bit numbers.
template <class Real, class Length>
std::string plyBody(const Points& points, const Faces& faces, bool big = false) {
    std::string bytes;
    for (const auto& p : points)
        for (const double c : p)
            put(bytes, static_cast<Real>(c), big);
    for (const auto& face : faces) {
        put(bytes, static_cast<Length>(face.size()), big);
        for (const int corner : face)
            put(bytes, static_cast<std::uint32_t>(corner), big);
    }
    return bytes;
}

std::string binaryTetra() {
    return header("binary_little_endian", 4, 4) + plyBody<float, std::uint8_t>(kTetraPoints, kTetra);
}

std::string windowsLines(std::string text) {
    for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; at += 2)
        text.replace(at, 1, "\r\n");
    return text;
}

Expected fails(int code, int line = 0, std::optional<std::size_t> byte = {}) {
    return {.error = code, .line = line, .byte = byte};
}

Expected gives(std::size_t vertices, std::size_t triangles, std::string step = {}, std::size_t changed = 0) {
    return {.vertices = vertices, .triangles = triangles, .step = std::move(step), .changed = changed};
}

class Collection {
public:
    void add(int number, std::string name, std::string bytes, Expected expected) {
        files.push_back({.number = number, .name = std::move(name), .bytes = std::move(bytes), .expected = std::move(expected)});
    }
    std::vector<HardFile> files;
};

void addValid(Collection& c) {
    const std::string text = plyText(kTetraPoints, kTetra);
    c.add(1, "tetra.ply", text, gives(4, 4));
    c.add(2, "big_endian.ply", header("binary_big_endian", 4, 4) + plyBody<float, std::uint8_t>(kTetraPoints, kTetra, true), gives(4, 4));
    c.add(3, "double_int.ply",
          header("binary_little_endian", "4", "4", "double", "int uint") + plyBody<double, std::int32_t>(kTetraPoints, kTetra),
          gives(4, 4));
    c.add(4, "crlf.ply", windowsLines(text), gives(4, 4));
    c.add(5, "crlf_binary.ply", windowsLines(header("binary_little_endian", 4, 4)) + plyBody<float, std::uint8_t>(kTetraPoints, kTetra),
          gives(4, 4));
    Points cube;
    for (int i = 0; i < 8; ++i)
        cube.push_back({static_cast<double>(i & 1), static_cast<double>(i >> 1 & 1), static_cast<double>(i >> 2)});
    c.add(6, "quads.ply", plyText(cube, {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}),
          gives(8, 12));
    c.add(7, "concave_pentagon.ply", plyText({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}}, {{0, 1, 2, 3, 4}}), gives(5, 3));
}

void addBroken(Collection& c) {
    const std::string text = plyText(kTetraPoints, kTetra);
    const std::string binary = binaryTetra();
    // the last face begins 13 bytes before the end: the cut leaves 6 bytes of the third, behind its length
    c.add(8, "cut_binary.ply", binary.substr(0, binary.size() - 20), fails(5303, 0, binary.size() - 25));
    c.add(9, "cut_text.ply", text.substr(0, text.size() - 9), fails(5301, 0, text.size() - 9));
    const std::string body = plyBody<float, std::uint8_t>(kTetraPoints, kTetra);
    c.add(10, "four_billion_vertices.ply", header("binary_little_endian", "4294967295", "4") + body, fails(5303, 3));
    c.add(11, "two_billion_faces.ply", header("binary_little_endian", "4", "2000000000") + body, fails(5303, 7));
    c.add(12, "minus_four_vertices.ply", header("ascii", "-4", "4") + text.substr(text.find("end_header\n") + 11), fails(5302, 3));
    c.add(13, "index_9.ply", plyText(kTetraPoints, {{0, 1, 2}, {0, 1, 9}}), fails(5304, 15));
    c.add(14, "index_minus_1.ply", plyText(kTetraPoints, {{0, 1, 2}, {0, 1, -1}}), fails(5304, 15));
}

void addUnclean(Collection& c) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    Points points = kTetraPoints;
    points[3] = {nan, 0, 1};
    c.add(15, "nan.ply", plyText(points, kTetra), gives(3, 1, "not finite", 3));
    points[3] = {infinity, 0, 1};
    c.add(16, "infinity.ply", plyText(points, kTetra), gives(3, 1, "not finite", 3));
    c.add(17, "minus_zero.ply", plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-0.0, -0.0, 0}, {1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {3, 5, 4}}),
          gives(4, 2, "places", 2));
    Faces faces = kTetra;
    faces.insert(faces.end(), {{0, 0, 1}, {2, 2, 2}});
    c.add(18, "repeated_corner.ply", plyText(kTetraPoints, faces), gives(4, 4, "collapsed", 2));
    points = kTetraPoints;
    points.push_back({0.5, 0, 0});
    faces = kTetra;
    faces.push_back({0, 4, 1});
    c.add(19, "collinear.ply", plyText(points, faces), gives(5, 5));
    faces = kTetra;
    faces.insert(faces.end(), kTetra.begin(), kTetra.end());
    c.add(20, "twice.ply", plyText(kTetraPoints, faces), gives(4, 4, "duplicates", 4));
    faces = kTetra;
    for (const auto& t : kTetra)
        faces.push_back({t[0], t[2], t[1]});
    c.add(21, "and_its_flip.ply", plyText(kTetraPoints, faces), gives(8, 8));
    c.add(22, "three_on_an_edge.ply", plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}),
          gives(5, 3));
    c.add(23, "bow_tie.ply",
          plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                  {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, {0, 4, 5}, {0, 6, 4}, {4, 6, 5}, {5, 6, 0}}),
          gives(7, 8));
    c.add(24, "one_flipped.ply", plyText(kTetraPoints, {kTetra[0], kTetra[1], {1, 3, 2}, kTetra[3]}), gives(4, 4));
    points = kTetraPoints;
    points.insert(points.end(), {{9, 9, 9}, {1e30, 0, 0}});
    c.add(25, "unreferenced.ply", plyText(points, kTetra), gives(4, 4, "unreferenced", 2));
}

void addUnusual(Collection& c) {
    c.add(26, "no_faces.ply", plyText(kTetraPoints, {}), fails(7021));
    c.add(27, "empty.ply", "", fails(5300, 0, 0));
    c.add(28, "nothing_in_it.ply", plyText({}, {}), fails(7021));
    c.add(
        29, "more_properties.ply",
        "ply\nformat ascii 1.0\ncomment hi\nobj_info x\nelement vertex 3\nproperty float nx\nproperty float x\nproperty float y\n"
        "property float z\nproperty uchar red\nproperty float confidence\nelement edge 1\nproperty int a\nproperty int b\nelement face 1\n"
        "property uchar q\nproperty list uchar int vertex_index\nproperty float area\nend_header\n"
        "0 0 0 0 255 1\n0 1 0 0 255 1\n0 0 1 0 255 1\n7 8\n3 3 0 1 2 0.5\n",
        gives(3, 1));
    c.add(30, "faces_first.ply",
          "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\nproperty float x\n"
          "property float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
          gives(3, 1));
    Faces faces = kTetra;
    faces.insert(faces.end(), {{}, {1}, {1, 2}});
    c.add(31, "small_faces.ply", plyText(kTetraPoints, faces), gives(4, 4, "small faces", 3));
    std::string bytes = header("binary_little_endian", "3", "1", "float", "uint int");
    for (const float value : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
        put(bytes, value);
    const std::size_t length = bytes.size() + 4;
    put(bytes, std::uint32_t{0x7fffffff});
    for (const int corner : {0, 1, 2})
        put(bytes, corner);
    c.add(32, "list_of_two_billion.ply", bytes, fails(5303, 0, length));
}

void addObj(Collection& c) {
    const std::string three = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    c.add(33, "relative.obj", three + "f -3 -2 -1\n", gives(3, 1));
    c.add(34, "index_0.obj", three + "f 0 1 2\nf 1 2 3\n", fails(5304, 4));
    c.add(35, "mixed.obj",
          "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nvt 0 0\nf 1//1 2//1 3//1\nf 1/1/1 3/1/1 4/1/1\nl 1 2\np 3\nf 1 2 3 4\n",
          gives(7, 3, "duplicates", 1));
    c.add(36, "decimal_commas.obj", "v 0,0 0,0 0,0\nv 1,5 0 0\nv 0 1,5 0\nf 1 2 3\n", fails(5302, 1));
    c.add(37, "colours.obj", "v 0 0 0 1 0.5 0.5\nv 1 0 0 1 0.5 0.5\nv 0 1 0 1 0.5 0.5\nf 1 2 3\n", gives(3, 1));
    c.add(38, "continued.obj", three + "f 1 \\\n2 \\\n3\n", gives(3, 1));
    std::string utf16 = "\xff\xfe";
    for (const char letter : three + "f 1 2 3\n")
        utf16 += {letter, '\0'};
    c.add(49, "utf16.obj", utf16, fails(5302, 0, 0));
    c.add(49, "byte_order_mark.obj", "\xef\xbb\xbf" + three + "f 1 2 3\n", gives(3, 1));
}

void addNumbers(Collection& c) {
    c.add(39, "size_1e20.ply", plyText({{1e20, 0, 0}, {1e20 + 1e13, 0, 0}, {1e20, 1e13, 0}}, {{0, 1, 2}}), gives(3, 1));
    c.add(40, "size_1e-40.ply", plyText({{0, 0, 0}, {1e-40, 0, 0}, {0, 1e-40, 0}, {0, 0, 1e-40}}, kTetra), gives(4, 4));
    c.add(41, "one_ulp.ply", plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.0000001, 0, 0}, {1e-7, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {3, 5, 4}}),
          gives(4, 2));
    Points rim = {{0, 0, 0}};
    Faces fan;
    constexpr int kValence = 20000;
    for (int i = 0; i < kValence; ++i) {
        const double angle = 2 * std::numbers::pi * i / kValence;
        rim.push_back({std::cos(angle), std::sin(angle), 0});
        fan.push_back({0, 1 + i, 1 + (i + 1) % kValence});
    }
    c.add(42, "fan.ply", plyText(rim, fan), gives(20001, 20000));
    c.add(54, "denormal_normals.ply",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\n"
          "property float ny\nproperty float nz\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
          "0 0 0 0 0 1e-40\n1 0 0 0 0 1e-40\n0 1 0 0 0 1e-40\n3 0 1 2\n",
          gives(3, 1));
}

std::string stl(std::uint32_t announced, std::string start, std::size_t facets) {
    start.resize(80, ' ');
    put(start, announced);
    for (std::size_t i = 0; i < facets; ++i) {
        for (const float value : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
            put(start, value);
        put(start, std::uint16_t{0});
    }
    return start;
}

void addStl(Collection& c) {
    c.add(43, "thousand_facets.stl", stl(1000, "", 1), fails(5303, 0, 80));
    c.add(44, "solid_but_binary.stl", stl(1, "solid binary file that starts with solid", 1), gives(3, 1));
}

/// Grid of n triangles and at least as many vertices as wanted.
std::string stripOf(std::size_t vertices) {
    Points points;
    Faces faces;
    for (std::size_t i = 0; i < vertices; ++i) {
        const std::size_t row = i / 2;
        points.push_back({static_cast<double>(row), static_cast<double>(i % 2), 0});
    }
    for (int i = 0; i + 2 < static_cast<int>(vertices); ++i)
        faces.push_back(i % 2 == 0 ? std::vector{i, i + 1, i + 2} : std::vector{i + 1, i, i + 2});
    return plyText(points, faces);
}

void addMore(Collection& c) {
    std::mt19937 random(45);
    Points points;
    Faces faces;
    for (int i = 0; i < 1000; ++i)
        points.push_back(
            {static_cast<double>(random() % 4096), static_cast<double>(random() % 4096), static_cast<double>(random() % 4096)});
    for (int i = 0; i < 10000; ++i) // three different corners, drawn with a step so that no face comes twice
        faces.push_back({i % 1000, (i + 1 + i / 1000) % 1000, (i + 500 + i / 1000) % 1000});
    c.add(45, "soup.ply", plyText(points, faces), gives(1000, 10000));
    c.add(50, "one_triangle.ply", plyText({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}), gives(3, 1));
    for (const std::size_t vertices : {65535u, 65536u, 65537u})
        c.add(51, fmt::format("{}_vertices.ply", vertices), stripOf(vertices), gives(vertices, vertices - 2));
    Points circle;
    std::vector<int> corners;
    for (int i = 0; i < 300; ++i) {
        circle.push_back({std::cos(2 * std::numbers::pi * i / 300), std::sin(2 * std::numbers::pi * i / 300), 0});
        corners.push_back(i);
    }
    c.add(52, "300_corners.ply",
          header("binary_little_endian", "300", "1", "float", "uint uint") + plyBody<float, std::uint32_t>(circle, {corners}),
          gives(300, 298));
    const std::string overflowing = header("binary_little_endian", 300, 1) + plyBody<float, std::uint8_t>(circle, {corners});
    c.add(52, "300_corners_of_255.ply", overflowing, fails(5302, 0, overflowing.size() - 4 * 256));
    points = kTetraPoints;
    points.insert(points.end(), kTetraPoints.begin(), kTetraPoints.end());
    faces = kTetra;
    for (const auto& t : kTetra)
        faces.push_back({t[0] + 4, t[1] + 4, t[2] + 4});
    c.add(53, "two_at_one_place.ply", plyText(points, faces), gives(4, 4, "duplicates", 4));
}

} // namespace

std::vector<HardFile> hardFiles() {
    Collection c;
    addValid(c);
    addBroken(c);
    addUnclean(c);
    addUnusual(c);
    addObj(c);
    addNumbers(c);
    addStl(c);
    addMore(c);
    for (HardFile& file : moreHardFiles())
        c.files.push_back(std::move(file));
    return std::move(c.files);
}

} // namespace tegument::testing_prep
