#include "meshprep/write/glb.h"

#include "host/mesh/extent.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace tegument {

namespace {

constexpr double kSteps = 65535;

} // namespace

PositionGrid::PositionGrid(const std::vector<glm::vec3>& positions) {
    const Extent extent = extentOf(positions);
    origin = extent.low;
    step = extent.longest / kSteps;
}

std::array<std::uint16_t, 3> PositionGrid::encode(const glm::vec3& position) const {
    std::array<std::uint16_t, 3> numbers{};
    if (step == 0) return numbers;
    const glm::dvec3 scaled = glm::clamp((glm::dvec3(position) - origin) / step, 0.0, kSteps);
    for (glm::length_t i = 0; i < 3; ++i)
        numbers[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(std::lround(scaled[i]));
    return numbers;
}

std::string gltfName(const MeshAttribute& attribute) {
    const std::string& name = attribute.name;
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    const std::string word = name.substr(0, digits);
    if ((word == "TEXCOORD_" && attribute.components == 2 && digits < name.size()) ||
        (word == "COLOR_" && attribute.components >= 3 && digits < name.size()))
        return name;
    std::string own = "_";
    for (const char c : name)
        own += std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    return own;
}

bool staysWhole(const MeshAttribute& attribute) {
    return attribute.type == NumberType::Int8 || attribute.type == NumberType::Uint8 || attribute.type == NumberType::Int16 ||
           attribute.type == NumberType::Uint16;
}

std::int16_t toSnorm16(float value) {
    return static_cast<std::int16_t>(std::lround(std::clamp(static_cast<double>(value), -1.0, 1.0) * 32767));
}

} // namespace tegument
