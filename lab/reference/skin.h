#pragma once
// Light on skin, point by point, as docs/design/skin.md defines it: shadows by rays, thickness by rays, reflection evaluated, albedo by
// quadrature.

#include "lab/reference/more_light.h"
#include "lab/reference/pinhole.h"
#include "lab/reference/surface.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tegument::reference {

/// What the three settings differ in (docs/settings.md).
struct SkinSettings {
    double mix = 0.5;
    double roughness = 0.3;
    double intensity = 1;        // rho_s of the specular reflection
    double fresnel0 = 0.04;      // what it reflects at normal incidence: index 1.5
    double plainRoughness = 0.1; // of material that does not scatter
    double plainIntensity = 0.5;
    double attenuation = 1;        // what rho_dt is multiplied by in 1 - rho_s rho_dt; the seed prints none: 1
    bool printedAlbedo = false;    // rho_dt by the printed rule with 32 x 32 nodes, not divided by pi
    bool thicknessAsDepth = false; // alpha holds the difference of z/w instead of exp(-0.2 t)
    int firstTransmitted = 4;      // Gaussian, counted from 1
    double exponent = 0.5;         // k of exp(-k t^2 / v)
    bool fadeNearLitSide = true;
};
/// "seed", "deon2007" or "corrected".
[[nodiscard]] SkinSettings skinSettings(const std::string& name);

/// An image looked up bilinearly with clamped coordinates; decoded before filtering when `srgb`.
class Texture {
public:
    Texture() = default;
    Texture(const Image& image, bool srgb);
    explicit Texture(const glm::dvec4& constant) : width_(1), height_(1), texels_{constant} {}
    [[nodiscard]] glm::dvec4 at(const glm::dvec2& uv) const;
    /// Width and height of one, of the whole.
    [[nodiscard]] glm::dvec2 texel() const { return 1.0 / glm::dvec2(width_, height_); }

private:
    int width_ = 1;
    int height_ = 1;
    std::vector<glm::dvec4> texels_{glm::dvec4(0)};
};

/// Where light enters on its straight way to a point that it reaches only through the body.
struct Entry {
    double path = 0; // mm inside; what lies between entry and point counts as flesh
    SurfacePoint point;
};

class SkinScene {
public:
    /// `more`: lamps and surroundings beside the light, with what the mesh hides of them by rays.
    SkinScene(const Mesh& mesh, const Pinhole& light, const glm::dvec3& lightColour, const SkinSettings& settings, MoreLight more = {});

    /// Unit normal of the normal map (+Y), in the interpolated tangent frame.
    [[nodiscard]] glm::dvec3 mappedNormal(const SurfacePoint& point) const;
    [[nodiscard]] glm::dvec2 texelOfNormals() const { return normals_.texel(); }
    [[nodiscard]] glm::dvec4 colour(const SurfacePoint& point) const { return colour_.at(point.uv); }
    /// Radius of Gosselin's blurs here, as a share of the largest.
    [[nodiscard]] double kernelSize(const SurfacePoint& point) const { return kernelSizes_.at(point.uv).x; }
    [[nodiscard]] glm::dvec3 toLight(const SurfacePoint& point) const {
        return glm::normalize(light_.origin(point.position) - point.position);
    }

    /// What the light's view does not show is lit: there is no map that could say otherwise. Facets do not hide the round surface that
    /// their normals mean: near its horizon they turn away before it does.
    [[nodiscard]] bool lit(const SurfacePoint& point) const;
    /// The same of the flat triangles themselves, as a shadow map holds them.
    [[nodiscard]] bool litByFacets(const SurfacePoint& point) const;
    /// The shadow map cannot tell: within `texels` of its texels the light is cut off somewhere and not elsewhere, or the map ends, or the
    /// surface is seen edge-on by the light, N.L of the mesh in 0..0.15.
    [[nodiscard]] bool nearShadowEdge(const SurfacePoint& point, double texels) const;

    [[nodiscard]] std::optional<Entry> entry(const SurfacePoint& point) const;
    /// mm; none where light reaches the surface directly. Corrected for a slab that is crossed at an angle.
    [[nodiscard]] std::optional<double> thickness(const SurfacePoint& point) const;
    /// C^mix colour shadow max(N.L, 0) (1 - rho_s rho_dt(N.L)).
    [[nodiscard]] glm::dvec3 entering(const SurfacePoint& point, bool lit) const;
    /// Specular reflection towards the eye, by this unit normal.
    [[nodiscard]] glm::dvec3 reflected(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& eye, bool lit) const;
    [[nodiscard]] const MoreLight& more() const { return more_; }
    /// What of it crosses the surface, as `entering`; of plain material C times what arrives; and what is mirrored.
    [[nodiscard]] glm::dvec3 enteringMore(const SurfacePoint& point) const;
    [[nodiscard]] glm::dvec3 plainMore(const SurfacePoint& point) const;
    [[nodiscard]] glm::dvec3 reflectedMore(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& eye) const;

    /// 1 - rho_s rho_dt(cosine).
    [[nodiscard]] double diffuseShare(double cosine) const;
    /// C^(1 - mix) (1 - rho_s rho_dt(N.V)): what the diffused light is multiplied by on leaving.
    [[nodiscard]] glm::dvec3 leaving(const SurfacePoint& point, const glm::dvec3& eye) const;

    [[nodiscard]] const RayScene& rays() const { return rays_; }
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const SkinSettings& settings() const { return settings_; }
    [[nodiscard]] const Pinhole& light() const { return light_; }
    [[nodiscard]] const glm::dvec3& lightColour() const { return lightColour_; }

private:
    [[nodiscard]] bool reaches(const glm::dvec3& position, double slack) const;
    [[nodiscard]] std::vector<Beam> moreBeams(const SurfacePoint& point, const glm::dvec3& normal, const std::vector<SkyPiece>& sky) const;
    [[nodiscard]] glm::dvec3 mirrored(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& toLight,
                                      const glm::dvec3& eye) const;

    const Mesh& mesh_;
    Pinhole light_;
    glm::dvec3 lightColour_;
    SkinSettings settings_;
    RayScene rays_;
    MoreLight more_;
    double outside_ = 1;                           // mm: from any point of the mesh a way as long leads out of it
    Texture colour_{glm::dvec4(0.8, 0.6, 0.5, 1)}; // what the effects fall back to
    Texture normals_{glm::dvec4(0.5, 0.5, 1, 1)};
    Texture kernelSizes_{glm::dvec4(0.6, 0.6, 0.6, 1)};
    std::vector<double> albedo_; // rho_dt at cosines i / (size - 1)
};

} // namespace tegument::reference
