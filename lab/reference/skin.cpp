#include "lab/reference/skin.h"

#include "generated/setting_names.h"
#include "lab/reference/specular.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tegument::reference {

namespace {

/// mm by which a surface may lie before itself: facets under a smooth normal.
constexpr double kFacets = 0.3;
constexpr double kEdgeOn = 0.15;

const Image* textureOf(const Mesh& mesh, const std::string& role) {
    const auto found = std::ranges::find(mesh.textures, role, &EmbeddedTexture::role);
    return found == mesh.textures.end() ? nullptr : &found->image;
}

double decoded(double encoded) { // IEC 61966-2-1
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

} // namespace

SkinSettings skinSettings(const std::string& name) {
    SkinSettings settings;
    if (name == kSettingCorrected) return settings;
    settings.printedAlbedo = true;
    settings.fresnel0 = 0.028; // index 1.4, rounded
    settings.intensity = 0.18;
    settings.attenuation = settings.intensity;
    if (name == kSettingDeon2007) return settings;
    settings.mix = 0.4;
    settings.attenuation = 1;
    settings.thicknessAsDepth = true;
    settings.firstTransmitted = 2;
    settings.exponent = 1;
    settings.fadeNearLitSide = false;
    return settings;
}

Texture::Texture(const Image& image, bool srgb) : width_(image.width), height_(image.height) {
    texels_.clear();
    for (int y = 0; y < height_; ++y)
        for (int x = 0; x < width_; ++x) {
            glm::dvec4 texel(0, 0, 0, 1);
            for (int c = 0; c < image.channels; ++c)
                texel[c] = srgb && c < 3 ? decoded(image.at(x, y, c)) : image.at(x, y, c);
            texels_.push_back(texel);
        }
}

glm::dvec4 Texture::at(const glm::dvec2& uv) const {
    const glm::dvec2 size(width_, height_);
    const glm::dvec2 place = glm::clamp(uv * size - 0.5, glm::dvec2(0), size - 1.0);
    const glm::ivec2 a(place);
    const glm::ivec2 b = glm::min(a + 1, glm::ivec2(size) - 1);
    const glm::dvec2 f = place - glm::dvec2(a);
    const auto texel = [&](int x, int y) {
        return texels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
    };
    return glm::mix(glm::mix(texel(a.x, a.y), texel(b.x, a.y), f.x), glm::mix(texel(a.x, b.y), texel(b.x, b.y), f.x), f.y);
}

SkinScene::SkinScene(const Mesh& mesh, const Pinhole& light, const glm::dvec3& lightColour, const SkinSettings& settings, MoreLight more)
    : mesh_(mesh), light_(light), lightColour_(lightColour), settings_(settings), rays_(mesh), more_(std::move(more)) {
    if (const Image* image = textureOf(mesh, "color")) colour_ = Texture(*image, true);
    if (const Image* image = textureOf(mesh, "normal")) normals_ = Texture(*image, false);
    if (const Image* image = textureOf(mesh, "kernelSize")) kernelSizes_ = Texture(*image, false);
    for (const glm::vec3& position : mesh.positions)
        outside_ = std::max(outside_, 2.01 * static_cast<double>(glm::length(position - mesh.positions.front())));
    constexpr int kCosines = 1025; // rho_dt bends little: linear between these is exact to 1e-5
    constexpr double kFirst = 1e-3;
    for (int i = 0; i < kCosines; ++i) {
        const double cosine = std::max(static_cast<double>(i) / (kCosines - 1), kFirst);
        albedo_.push_back(settings.printedAlbedo ? directionalAlbedoPrinted(cosine, settings.roughness, settings.fresnel0, 32)
                                                 : directionalAlbedo(cosine, settings.roughness, settings.fresnel0) / std::numbers::pi);
    }
}

glm::dvec3 SkinScene::mappedNormal(const SurfacePoint& point) const {
    const glm::dvec3 t = 2.0 * glm::dvec3(normals_.at(point.uv)) - 1.0;
    const glm::dvec3 tangent(point.tangent);
    const glm::dvec3 bitangent = point.tangent.w * glm::cross(point.normal, tangent);
    return glm::normalize(t.x * tangent + t.y * bitangent + t.z * point.normal);
}

bool SkinScene::lit(const SurfacePoint& point) const {
    return reaches(outsideFacet(mesh_, point), kFacets);
}

bool SkinScene::litByFacets(const SurfacePoint& point) const {
    return reaches(point.position, kFacets);
}

bool SkinScene::reaches(const glm::dvec3& position, double slack) const {
    return !light_.shows(position) || rays_.reaches(light_.origin(position), position, slack);
}

bool SkinScene::nearShadowEdge(const SurfacePoint& point, double texels) const {
    const glm::dvec3 normal = glm::normalize(point.normal);
    const glm::dvec3 l = toLight(point);
    const double cosine = glm::dot(normal, l);
    if (cosine < 0) return false; // its own shadow, whatever the map says
    if (cosine < kEdgeOn) return true;
    const double step = texels * light_.footprint(glm::dot(point.position - light_.eye, light_.forward));
    const double sag = step * 0.5; // curved surfaces leave the plane through the point
    const bool here = lit(point);
    if (light_.shows(point.position, texels) && !light_.shows(point.position, -texels)) return true;
    for (int j = -1; j <= 1; ++j)
        for (int i = -1; i <= 1; ++i) {
            const glm::dvec3 sideways = step * (static_cast<double>(i) * light_.right + static_cast<double>(j) * light_.up);
            const glm::dvec3 inPlane = sideways - l * (glm::dot(normal, sideways) / cosine);
            if (reaches(point.position + inPlane, kFacets + sag) != here) return true;
        }
    return false;
}

std::optional<Entry> SkinScene::entry(const SurfacePoint& point) const {
    if (!light_.shows(point.position)) return std::nullopt;
    const glm::dvec3 origin = light_.origin(point.position);
    const glm::dvec3 way = point.position - origin;
    const double distance = glm::length(way);
    const auto hit = rays_.nearest(origin, way / distance);
    if (!hit || hit->distance > distance) return std::nullopt;
    return Entry{distance - hit->distance, interpolate(mesh_, hit->place)};
}

std::optional<double> SkinScene::thickness(const SurfacePoint& point) const {
    const glm::dvec3 normal = glm::normalize(point.normal);
    const double cosine = glm::dot(normal, toLight(point));
    if (cosine > 0) return std::nullopt;
    const auto found = entry(point);
    if (!found) return std::nullopt;
    const double parallel = std::max(0.0, -glm::dot(glm::normalize(found->point.normal), normal));
    return std::lerp(found->path, std::min(1.0, -cosine) * found->path, parallel);
}

double SkinScene::diffuseShare(double cosine) const {
    const double place = std::clamp(cosine, 0.0, 1.0) * static_cast<double>(albedo_.size() - 1);
    const auto left = std::min(static_cast<std::size_t>(place), albedo_.size() - 2);
    const double albedo = std::lerp(albedo_[left], albedo_[left + 1], place - static_cast<double>(left));
    return std::max(0.0, 1 - settings_.attenuation * albedo); // clamped: the printed table exceeds 1 (docs/design/skin.md)
}

glm::dvec3 SkinScene::entering(const SurfacePoint& point, bool lit) const {
    const double cosine = glm::dot(mappedNormal(point), toLight(point));
    if (!lit || cosine <= 0) return glm::dvec3(0);
    return glm::pow(glm::dvec3(colour(point)), glm::dvec3(settings_.mix)) * lightColour_ * (cosine * diffuseShare(cosine));
}

glm::dvec3 SkinScene::reflected(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& eye, bool lit) const {
    return lit ? lightColour_ * mirrored(point, normal, toLight(point), eye) : glm::dvec3(0);
}

glm::dvec3 SkinScene::mirrored(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& l, const glm::dvec3& eye) const {
    const double scatters = colour(point).w;
    const double m = std::lerp(settings_.plainRoughness, settings_.roughness, scatters);
    const double rhoS = std::lerp(settings_.plainIntensity, settings_.intensity, scatters);
    const Lobe lobe{.m = m, .f0 = settings_.fresnel0, .rhoS = rhoS};
    return glm::dvec3(std::max(0.0, glm::dot(normal, l)) * kelemenBrdf(normal, l, glm::normalize(eye - point.position), lobe));
}

std::vector<Beam> SkinScene::moreBeams(const SurfacePoint& point, const glm::dvec3& normal, const std::vector<SkyPiece>& sky) const {
    // From the mesh's own normal on its horizon hides light, whatever the normal map says.
    const glm::dvec3 meshNormal = glm::normalize(point.normal);
    return beamsAt(more_, sky, point.position, normal, [&](const glm::dvec3& direction, double distance) {
        return glm::dot(direction, meshNormal) > 0 &&
               rays_.reaches(point.position + std::min(distance, outside_) * direction, point.position, kFacets);
    });
}

glm::dvec3 SkinScene::enteringMore(const SurfacePoint& point) const {
    const glm::dvec3 normal = mappedNormal(point);
    glm::dvec3 sum(0);
    for (const Beam& beam : moreBeams(point, normal, more_.diffuseSky)) {
        const double cosine = glm::dot(normal, beam.towards);
        sum += beam.light * (cosine * diffuseShare(cosine));
    }
    return glm::pow(glm::dvec3(colour(point)), glm::dvec3(settings_.mix)) * sum;
}

glm::dvec3 SkinScene::plainMore(const SurfacePoint& point) const {
    const glm::dvec3 normal = mappedNormal(point);
    glm::dvec3 sum(0);
    for (const Beam& beam : moreBeams(point, normal, more_.diffuseSky))
        sum += beam.light * glm::dot(normal, beam.towards);
    return glm::dvec3(colour(point)) * sum;
}

glm::dvec3 SkinScene::reflectedMore(const SurfacePoint& point, const glm::dvec3& normal, const glm::dvec3& eye) const {
    glm::dvec3 sum(0);
    for (const Beam& beam : moreBeams(point, normal, more_.specularSky))
        sum += beam.light * beam.highlight * mirrored(point, normal, beam.towards, eye);
    return sum;
}

glm::dvec3 SkinScene::leaving(const SurfacePoint& point, const glm::dvec3& eye) const {
    const double cosine = glm::dot(mappedNormal(point), glm::normalize(eye - point.position));
    return glm::pow(glm::dvec3(colour(point)), glm::dvec3(1 - settings_.mix)) * diffuseShare(cosine);
}

} // namespace tegument::reference
