#pragma once
// Fur by path tracing: round curves whose surfaces scatter as fibres (fibre.h), over skin that is dull. Nothing here knows ribbons, maps of
// light or the shaders' model: it is the truth that fur is judged by. Lengths in mm.

#include "host/image/image.h"
#include "host/support/result.h"
#include "lab/reference/fibre.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/surface.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace tegument::reference {

/// A strand from root to tip: places and radii of its axis, joined by straight pieces.
using FibreAxis = std::vector<glm::vec4>;

struct FibreLight {
    enum class Kind { Parallel, Point, Sphere };
    Kind kind = Kind::Parallel;
    glm::dvec3 place{0, 0, 1}; // towards parallel light, unit; else its centre
    glm::dvec3 colour{1};      // irradiance / pi across its rays, at every distance, as the workspace's light has it
    double radius = 0;         // of a sphere
};

struct FibreScene {
    std::vector<FibreAxis> strands;
    Fibre fibre;
    glm::dvec3 colour{0.5}; // of the coat: fibreAbsorption()
    const Mesh* skin = nullptr;
    glm::dvec3 skinColour{0.5};
    std::vector<FibreLight> lights;
    std::function<glm::dvec3(const glm::dvec3& direction)> environment; // radiance; none: black
};

/// Sums over samples, from which a picture and its noise follow.
struct FibreSums {
    int width = 0;
    int height = 0;
    std::uint64_t samples = 0;   // of each pixel
    std::vector<glm::dvec3> sum; // of radiance
    std::vector<glm::dvec3> square;
    std::vector<double> covered; // of camera rays that meet something

    [[nodiscard]] Image picture() const;
    /// Expected relative L2 of the means of blocks of so many pixels a side to the truth: what noise alone adds to a comparison.
    [[nodiscard]] double noise(int block) const;
};

class FibrePaths {
public:
    explicit FibrePaths(FibreScene scene);
    ~FibrePaths();
    FibrePaths(const FibrePaths&) = delete;
    FibrePaths& operator=(const FibrePaths&) = delete;

    /// Radiance towards the origin of a ray. `path`: which of its random numbers.
    [[nodiscard]] glm::dvec3 radiance(const glm::dvec3& origin, const glm::dvec3& direction, std::uint64_t path) const;

    /// Adds samples to `sums` until each pixel has so many, on all processors. The same, however often it was interrupted.
    void trace(const Pinhole& camera, std::uint64_t samples, FibreSums& sums) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Sums of an interrupted trace, so that it can go on. `scene`: a number that another scene, camera or seed would not have.
[[nodiscard]] Result<void> saveSums(const std::filesystem::path& file, const FibreSums& sums, std::uint64_t scene);
/// Empty sums where there is no file of this scene.
[[nodiscard]] FibreSums loadSums(const std::filesystem::path& file, std::uint64_t scene);

} // namespace tegument::reference
