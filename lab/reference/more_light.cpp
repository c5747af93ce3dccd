#include "lab/reference/more_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tegument::reference {

namespace {

constexpr double kEndlesslyFar = std::numeric_limits<double>::infinity();

double smoothStep(double share) {
    const double s = std::clamp(share, 0.0, 1.0);
    return s * s * (3 - 2 * s);
}

/// What a point sees of a lamp: nodes of equal solid angle in the cap that the sphere fills.
struct LampNode {
    glm::dvec3 direction{0};
    double distance = 0; // to the lamp's centre, for points
    double share = 1;    // of the light: the cap has the irradiance that a point in its middle would have
};
std::vector<LampNode> lampNodes(const Lamp& lamp, const glm::dvec3& towards, int side) {
    const bool near = lamp.place.w > 0.5;
    const double distance = glm::length(towards);
    const glm::dvec3 axis = towards / distance;
    double far = kEndlesslyFar;
    if (near) far = distance;
    const double sine = std::min(near ? lamp.axis.w / distance : lamp.axis.w, 0.99);
    if (side == 1 || sine <= 0) return {{axis, far, 1}};
    const glm::dvec3 right = glm::normalize(glm::cross(axis, std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0)));
    const glm::dvec3 up = glm::cross(right, axis);
    const double least = std::sqrt(1 - sine * sine);
    const double share = 2 / (1 + least) / (side * side); // the mean cosine over the cap is (1 + least) / 2
    std::vector<LampNode> nodes;
    for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) {
            // Archimedes: equal steps of the cosine are equal solid angles.
            const double cosine = 1 - (1 - least) * (j + 0.5) / side;
            const double around = 2 * std::numbers::pi * (i + 0.5 * (j % 2)) / side;
            const double across = std::sqrt(1 - cosine * cosine);
            nodes.push_back({cosine * axis + across * (std::cos(around) * right + std::sin(around) * up), far, share});
        }
    return nodes;
}

void addLamp(const Lamp& lamp, int side, const glm::dvec3& point, const glm::dvec3& normal, const Visible& visible,
             std::vector<Beam>& beams) {
    const glm::dvec3 towards = lamp.place.w > 0.5 ? glm::dvec3(lamp.place) - point : glm::dvec3(lamp.place);
    const double distance = glm::length(towards);
    if (distance <= 0) return;
    const double cone = glm::dot(-towards / distance, glm::dvec3(lamp.axis));
    const double spot = smoothStep((cone - lamp.spot.y) / std::max(lamp.spot.x - lamp.spot.y, 1e-4));
    const double falloff = lamp.colour.w > 0 ? lamp.colour.w * lamp.colour.w / (distance * distance) : 1;
    for (const auto& [direction, far, share] : lampNodes(lamp, towards, side)) {
        if (glm::dot(direction, normal) <= 0) continue;
        const double seen = lamp.spot.z > 0 && !visible(direction, far) ? 1 - lamp.spot.z : 1;
        if (seen * spot <= 0) continue;
        beams.push_back(
            {.towards = direction, .light = glm::dvec3(lamp.colour) * (falloff * spot * seen * share), .highlight = lamp.spot.w});
    }
}

} // namespace

std::map<std::string, std::vector<double>> lampParameters(const std::vector<Lamp>& lamps) {
    std::map<std::string, std::vector<double>> parameters;
    for (const Lamp& lamp : lamps)
        for (const auto& [name, value] : {std::pair("gLampPlace", lamp.place), std::pair("gLampColor", lamp.colour),
                                          std::pair("gLampAxis", lamp.axis), std::pair("gLampSpot", lamp.spot)})
            for (glm::length_t i = 0; i < 4; ++i)
                parameters[name].push_back(value[i]);
    return parameters;
}

std::vector<SkyPiece> skyPieces(const Image& panorama, int rows) {
    struct Sum {
        glm::dvec3 towards{0};
        glm::dvec3 light{0};
    };
    const int columns = 2 * rows;
    std::vector<Sum> sums(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
    for (int y = 0; y < panorama.height; ++y) {
        const double down = std::numbers::pi * (y + 0.5) / panorama.height;
        const double top = std::cos(std::numbers::pi * y / panorama.height);
        const double bottom = std::cos(std::numbers::pi * (y + 1) / panorama.height);
        const double angle = 2 * std::numbers::pi / panorama.width * (top - bottom);
        const int row = std::min(static_cast<int>((1 - std::cos(down)) / 2 * rows), rows - 1);
        for (int x = 0; x < panorama.width; ++x) {
            const double around = 2 * std::numbers::pi * ((x + 0.5) / panorama.width - 0.5);
            const glm::dvec3 direction(std::sin(around) * std::sin(down), std::cos(down), -std::cos(around) * std::sin(down));
            const glm::dvec3 radiance(panorama.at(x, y, 0), panorama.at(x, y, 1), panorama.at(x, y, 2));
            Sum& sum = sums[static_cast<std::size_t>(row * columns + x * columns / panorama.width)];
            sum.light += radiance * angle / std::numbers::pi;
            sum.towards += direction * (angle * (radiance.x + radiance.y + radiance.z));
        }
    }
    std::vector<SkyPiece> pieces;
    for (const Sum& sum : sums)
        if (glm::length(sum.towards) > 0) pieces.push_back({glm::normalize(sum.towards), sum.light});
    return pieces;
}

std::vector<Beam> beamsAt(const MoreLight& more, const std::vector<SkyPiece>& sky, const glm::dvec3& point, const glm::dvec3& normal,
                          const Visible& visible) {
    std::vector<Beam> beams;
    for (const Lamp& lamp : more.lamps)
        addLamp(lamp, more.lampSide, point, normal, visible, beams);
    for (const SkyPiece& piece : sky)
        if (glm::dot(piece.direction, normal) > 0 && visible(piece.direction, kEndlesslyFar))
            beams.push_back({piece.direction, piece.light, 1});
    return beams;
}

} // namespace tegument::reference
