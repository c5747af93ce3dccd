#pragma once
// Surroundings of a scene as a cube map that effects read with one fetch: each level is what a lobe of another width sees of them.
//   level k < kEnvironmentLobes: what a mirror of roughness k * kEnvironmentRoughnessStep reflects that is looked at from straight in front
//   level kEnvironmentLobes and those behind it: irradiance over pi of a surface that faces that way
// The outermost texels of a face lie on its edge, so that faces meet whether a device filters across edges or not (Castano 2012); the
// shader shrinks a face by half a texel all around (hlsl/light/surroundings.fxh).

#include "host/image/dds.h"
#include "host/support/result.h"

#include <glm/glm.hpp>

#include <array>
#include <vector>

namespace tegument {

inline constexpr int kEnvironmentSide = 256; // of level 0, texels
inline constexpr int kEnvironmentLobes = 4;
inline constexpr double kEnvironmentRoughnessStep = 0.15; // Beckmann m

/// Where a picture of the whole sphere looks, `u` and `v` in 0..1: its middle row at the horizon, row 0 straight up (+y), its middle column
/// along -z, its right half towards +x. Unit.
[[nodiscard]] glm::dvec3 panoramaDirection(double u, double v);

/// Equirectangular pictures that need no file: width 2 * height, linear radiance, three channels. Both light a white surface that faces
/// +z with irradiance pi, as a light of colour 1 does.
///   studio: a large soft box in front on the left, a dim one on the right, two strips behind, dark walls
///   sky: clear, the sun 40 degrees high in front on the left (CIE S 011, type 12), over ground of albedo 0.2
enum class DefaultEnvironment { Studio, Sky };
[[nodiscard]] Image defaultEnvironment(DefaultEnvironment which);

class LobeTable;

/// The radiance of a panorama gathered into directions, each with its light (radiance times solid angle): 6 * 64^2 of them at most.
class EnvironmentLight {
public:
    /// `panorama` has three channels or more; not finite and negative values count as 0.
    explicit EnvironmentLight(const Image& panorama);

    /// Irradiance over pi of a surface with this unit normal.
    [[nodiscard]] glm::dvec3 irradiance(const glm::dvec3& normal) const;
    /// Mean radiance in the lobe that a mirror of this roughness (Beckmann m > 0) reflects towards `direction`, seen along it.
    [[nodiscard]] glm::dvec3 reflected(const glm::dvec3& direction, double roughness) const;
    [[nodiscard]] glm::dvec3 reflectedBy(const glm::dvec3& direction, const LobeTable& lobe) const;
    /// Nine coefficients of its radiance in real spherical harmonics, orders 0 to 2 (Ramamoorthi and Hanrahan 2001).
    [[nodiscard]] std::array<glm::dvec3, 9> harmonics() const;

private:
    template <class Weight>
    [[nodiscard]] glm::dvec3 sum(const glm::dvec3& axis, double least, Weight weight, double& total) const;

    struct Source {
        glm::vec3 direction{0}; // of its light's centre
        float solidAngle = 0;
        glm::dvec3 light{0};
    };
    /// A run of sources, and the cone around them: many lie outside of what a lobe sees.
    struct Block {
        glm::vec3 axis{0};
        float cosine = 1;
        std::size_t end = 0; // of the run, in sources_
    };
    void addBlock(std::size_t first);

    std::vector<Source> sources_;
    std::vector<Block> blocks_;
};

/// Irradiance over pi that nine coefficients give (Ramamoorthi and Hanrahan 2001, equation 7); may be below 0.
[[nodiscard]] glm::dvec3 harmonicIrradiance(const std::array<glm::dvec3, 9>& harmonics, const glm::dvec3& normal);

/// The direction of a texel of the cube map: `x`, `y` from 0 to side - 1, the outermost on the edges.
[[nodiscard]] glm::dvec3 environmentDirection(int face, int x, int y, int side);

/// The cube map, halves. Values beyond 64512 are cut there. TG7060: the panorama is not twice as wide as it is high, or black.
[[nodiscard]] Result<DdsTexture> makeEnvironment(const Image& panorama, const std::string& nameForMessages);

/// Largest difference of nine coefficients from the irradiance itself, over the latter's largest value.
[[nodiscard]] double harmonicError(const EnvironmentLight& light);

} // namespace tegument
