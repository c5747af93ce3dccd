#include "meshprep/fur/ribbons/pose.h"

#include "host/mesh/pose.h"
#include "host/support/parallel.h"
#include "meshprep/fur/ribbons/below.h"
#include "meshprep/fur/ribbons/ribbons.h"
#include "meshprep/fur/roots/root_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tegument {

namespace {

constexpr int kPolarRounds = 24;      // of the polar decomposition: it converges quadratically
constexpr double kSettled = 1e-14;    // of them
constexpr double kLeastVolume = 1e-9; // below which a triangle says nothing of a turn

/// A triangle and the normal at a place on it.
struct Frame {
    std::array<glm::dvec3, 3> corners;
    glm::dvec3 place{0};
    glm::dvec3 normal{0, 0, 1};
    bool operator==(const Frame&) const = default;
};

Frame frameAt(const RootSeat& seat, const Mesh& mesh) {
    Frame frame;
    const glm::dvec3 weights(1 - static_cast<double>(seat.weights.x) - static_cast<double>(seat.weights.y), glm::dvec2(seat.weights));
    glm::dvec3 normal(0);
    for (int i = 0; i < 3; ++i) {
        const std::uint32_t vertex = mesh.indices[3 * std::size_t{seat.triangle} + static_cast<std::size_t>(i)];
        frame.corners[static_cast<std::size_t>(i)] = glm::dvec3(mesh.positions[vertex]);
        frame.place += weights[i] * frame.corners[static_cast<std::size_t>(i)];
        normal += weights[i] * glm::dvec3(mesh.normals[vertex]);
    }
    if (glm::length(normal) > 1e-12) frame.normal = glm::normalize(normal);
    return frame;
}

/// Two edges, and the normal as long as they are.
glm::dmat3 axesOf(const Frame& frame) {
    const glm::dvec3 u = frame.corners[1] - frame.corners[0];
    const glm::dvec3 v = frame.corners[2] - frame.corners[0];
    return {u, v, frame.normal * std::sqrt(glm::length(glm::cross(u, v)))};
}

glm::dquat fromTo(const glm::dvec3& a, const glm::dvec3& b) {
    const double cosine = glm::dot(a, b);
    if (cosine > -0.999999) return glm::normalize(glm::dquat(1 + cosine, glm::cross(a, b)));
    const glm::dvec3 aside = std::abs(a.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    return glm::normalize(glm::dquat(0, glm::cross(a, aside)));
}

/// The rotation nearest to what takes one frame into the other (N. Higham, Computing the Polar Decomposition, 1986), and what of the normal
/// that leaves: strands stand on the skin.
glm::dquat turnOf(const Frame& rest, const Frame& posed) {
    const glm::dmat3 from = axesOf(rest);
    const glm::dmat3 to = axesOf(posed);
    const double volume = glm::length(from[0]) * glm::length(from[1]) * glm::length(from[2]);
    if (!(std::abs(glm::determinant(from)) > kLeastVolume * volume) || !(volume > 0)) return fromTo(rest.normal, posed.normal);
    glm::dmat3 turn = to * glm::inverse(from);
    if (!(glm::determinant(turn) > kLeastVolume)) return fromTo(rest.normal, posed.normal);
    for (int i = 0; i < kPolarRounds; ++i) {
        const glm::dmat3 next = 0.5 * (turn + glm::transpose(glm::inverse(turn)));
        const glm::dmat3 change = next - turn;
        turn = next;
        if (glm::dot(change[0], change[0]) + glm::dot(change[1], change[1]) + glm::dot(change[2], change[2]) < kSettled * kSettled) break;
    }
    const glm::dquat nearest = glm::normalize(glm::quat_cast(turn));
    return glm::normalize(fromTo(nearest * rest.normal, posed.normal) * nearest);
}

Image textureLike(const Image& roots) {
    return plainImage(roots.width, roots.height, 4);
}

float* texelsOf(Image& image, float address) {
    return &image.pixels[4 * static_cast<std::size_t>(address)];
}

} // namespace

bool sameTriangles(const Mesh& rest, const Mesh& posed) {
    std::size_t ribbons = 0; // indices, behind those of the skin
    for (const MeshPart& part : rest.parts) {
        if (isRibbons(part) && part.firstIndex < posed.indices.size()) return false;
        ribbons += isRibbons(part) ? part.indexCount : 0;
    }
    const bool same = !posed.indices.empty() && posed.indices.size() + ribbons == rest.indices.size() &&
                      std::equal(posed.indices.begin(), posed.indices.end(), rest.indices.begin());
    const std::size_t vertices = posed.positions.size();
    return same && posed.normals.size() == vertices &&
           (ribbons > 0 ? vertices <= rest.positions.size() : vertices == rest.positions.size());
}

Mesh skinOf(const Mesh& rest, const Mesh& posed) {
    Mesh skin;
    skin.name = rest.name;
    const auto count = static_cast<std::ptrdiff_t>(posed.positions.size());
    skin.positions.assign(rest.positions.begin(), rest.positions.begin() + count);
    skin.normals.assign(rest.normals.begin(), rest.normals.begin() + count);
    skin.indices = posed.indices;
    skin.bounds = rest.bounds;
    return skin;
}

Result<RootSeats> seatsOfRoots(const Mesh& skin, const Image& roots, unsigned threads) {
    const auto rooted = readRooted(skin, roots, threads);
    if (!rooted) return rooted.error();
    const FurSurface surface(skin);
    const Below below(surface, threads);
    RootSeats seats;
    seats.seats.resize(rooted->roots.size());
    inChunks(seats.seats.size(), threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i)
            if (const auto point = below.found(rooted->roots[i]))
                seats.seats[i] = {.address = rooted->roots[i].address, .triangle = point->triangle, .weights = point->barycentric};
    });
    seats.lost = std::erase_if(seats.seats, [](const RootSeat& seat) { return seat.address == 0; });
    return seats;
}

RootPose poseOfRoot(const RootSeat& seat, const Mesh& rest, const Mesh& posed) {
    const Frame before = frameAt(seat, rest);
    const Frame after = frameAt(seat, posed);
    if (before == after) return {};
    return {.moved = after.place - before.place, .turn = turnOf(before, after)};
}

Image poseTexture(const RootSeats& seats, const Mesh& rest, const Mesh& posed, const Image& roots, unsigned threads) {
    Image image = textureLike(roots);
    inChunks(seats.seats.size(), threads, [&](std::size_t first, std::size_t last, std::size_t) {
        for (std::size_t i = first; i < last; ++i) {
            const RootPose pose = poseOfRoot(seats.seats[i], rest, posed);
            const glm::vec4 turn(glm::vec3(pose.turn.x, pose.turn.y, pose.turn.z), pose.turn.w);
            float* texels = texelsOf(image, seats.seats[i].address);
            for (int c = 0; c < 3; ++c)
                texels[c] = static_cast<float>(pose.moved[c]);
            for (int c = 0; c < 4; ++c)
                texels[4 + c] = turn[c];
        }
    });
    return image;
}

Image seatTexture(const RootSeats& seats, const Mesh& skin, const Image& roots) {
    Image image = textureLike(roots);
    for (const RootSeat& seat : seats.seats) {
        float* texels = texelsOf(image, seat.address);
        for (std::size_t c = 0; c < 3; ++c)
            texels[c] = static_cast<float>(skin.indices[3 * std::size_t{seat.triangle} + c]);
        texels[3] = static_cast<float>(seat.triangle);
        texels[4] = 1 - seat.weights.x - seat.weights.y;
        texels[5] = seat.weights.x;
        texels[6] = seat.weights.y;
    }
    return image;
}

void applyPose(Mesh& mesh, const Mesh& posed, const Image& pose) {
    std::vector<glm::vec3> positions = mesh.positions;
    std::vector<glm::vec3> normals = mesh.normals;
    std::ranges::copy(posed.positions, positions.begin());
    std::ranges::copy(posed.normals, normals.begin());
    for (std::size_t i = posed.positions.size(); i < positions.size(); ++i) {
        const float* texels = &pose.pixels[4 * static_cast<std::size_t>(mesh.uvs[i].y)];
        positions[i] += glm::vec3(texels[0], texels[1], texels[2]);
        normals[i] = glm::quat(texels[7], texels[4], texels[5], texels[6]) * normals[i];
    }
    setPose(mesh, positions, normals);
}

} // namespace tegument
