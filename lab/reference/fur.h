#pragma once
// The picture of shells as docs/design/fur.md defines it, in double precision: what each pixel's ray meets of every layer, in the order of
// drawing, where fur maps are looked up, how strands are lit, what is blended over what.

#include "lab/reference/pinhole.h"
#include "lab/reference/skin.h"

#include <array>
#include <functional>
#include <vector>

namespace tegument::reference {

/// The parameters of effects/Fur.fx.
struct FurCoat {
    int layers = 32;
    double length = 0.06; // share of the mesh's radius
    double lean = 0.25;
    double spread = 1; // heights are (l / n)^spread
    bool outerFirst = false;
    double taper = 0;
    double softness = 0.2;
    double alphaTest = 0.02;
    glm::dvec3 root{0.16, 0.085, 0.04}; // albedo
    glm::dvec3 tip{0.72, 0.52, 0.33};
    double kajiyaKay = 1;
    double multiple = 0.7;
    double specular = 0.08;
    double exponent = 40;
    double density = 1.2;
    glm::dvec3 fill{0};
    double deviation = 0; // of the heights in the fur map, and the footprint, radians, that holds half of their variance
    double grain = 0.006;
    bool fringes = false; // what lies behind the nearest coat is drawn first
};

/// A place on a layer, 0 the skin.
struct FurFragment {
    int layer = 0;
    std::uint32_t triangle = 0;
    double height = 0;    // in the coat
    double depth = 0;     // mm along the view
    glm::dvec3 rest{0};   // of the skin below, from the centre of the mesh's bounding sphere
    glm::dvec3 normal{0}; // interpolated, not normalised
    glm::dvec3 position{0};
    glm::dvec3 lean{0}; // of the tips, besides the coat's
    double share = 1;   // of the full density of strands
    glm::dvec3 weights{0};
};

/// The triangle of a layer that a fragment lies on, corner by corner.
struct FurFacet {
    std::array<glm::dvec3, 3> positions;
    std::array<glm::dvec3, 3> rest; // as FurFragment has them
    std::array<glm::dvec3, 3> normals;
};

enum class FurVector { Position, Normal, Combined };
/// Unit vector by which a fur map is looked up.
[[nodiscard]] glm::dvec3 furVector(FurVector kind, const FurFragment& fragment);

/// What of a fur map a pixel sees at once.
struct FurFootprint {
    double angle = 0; // radians of the map along the pixel's shorter side, at least a hundredth of the longer
    double sweep = 0; // that the ray crosses while it falls by the coat's height
};

class FurShells {
public:
    /// `mesh` must outlive the shells; the eye must be outside of the coat. `grown`: how the tips
    /// of each vertex lean besides the coat's, and share of the full density; empty: as the coat. `grid`: pixels to which a device rounds
    /// the corners between which it interpolates; 0: it does not.
    FurShells(const Mesh& mesh, const FurCoat& coat, const Pinhole& view, std::vector<glm::dvec4> grown = {}, double grid = 0);

    /// Front faces that a pixel's ray meets, in the order in which they are drawn.
    [[nodiscard]] const std::vector<FurFragment>& at(int x, int y) const { return pixels_[index(x, y)]; }
    /// Where the ray of another pixel meets the plane of a fragment's triangle.
    [[nodiscard]] FurFragment onItsPlane(const FurFragment& fragment, int x, int y) const;
    /// As devices take it: between the pixels of an aligned square of four.
    [[nodiscard]] FurFootprint footprint(FurVector kind, const FurFragment& fragment, int x, int y) const;
    /// No outline of any layer passes so near the pixel's centre that a device, which rounds corners to 1/256 pixel, may see its other
    /// side.
    [[nodiscard]] bool isClear(int x, int y) const;
    [[nodiscard]] FurFacet facet(const FurFragment& fragment) const;
    [[nodiscard]] const FurCoat& coat() const { return coat_; }

private:
    [[nodiscard]] std::size_t index(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(view_.width) + static_cast<std::size_t>(x);
    }
    [[nodiscard]] glm::dvec3 extruded(std::uint32_t vertex, double height) const;
    [[nodiscard]] std::array<glm::dvec3, 3> corners(std::uint32_t triangle, double height) const;
    [[nodiscard]] std::array<glm::dvec3, 3> placed(std::array<glm::dvec3, 3> points) const;
    [[nodiscard]] FurFragment meet(int layer, std::uint32_t triangle, double height, const glm::dvec3& direction,
                                   glm::dvec3& weights) const;
    void drawBehindFirst();
    void findEnd(std::uint32_t triangle, std::vector<double>& ends);
    /// `visit(x, y)` for the pixels that a triangle of a layer may cover; counts places beside them that it covers.
    template <class Visit>
    void cover(const std::array<glm::dvec3, 3>& t, Visit visit);
    void draw(int layer, double height);
    void draw(int layer, std::uint32_t triangle, double height);

    const Mesh& mesh_;
    FurCoat coat_;
    Pinhole view_;
    std::vector<glm::dvec4> grown_;
    double grid_ = 0;
    std::vector<std::vector<FurFragment>> pixels_;
    static constexpr std::array<glm::dvec2, 4> kAside = {{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
    std::vector<std::array<std::uint16_t, 4>> aside_; // front faces a little aside of each pixel's centre
    std::vector<std::uint16_t> ends_;                 // faces of the outermost layer at the centre that are turned away, counted aside, too
};

/// In the mirror ball of a sphere map.
[[nodiscard]] glm::dvec2 onSphereMap(const glm::dvec3& direction);
struct OnCube {
    int face = 0; // +X -X +Y -Y +Z -Z
    glm::dvec2 uv{0};
};
[[nodiscard]] OnCube onCubeMap(const glm::dvec3& direction);
/// The same on the plane of a given face, also beyond its edges; and back, not normalised.
[[nodiscard]] glm::dvec2 onCubeFace(int face, const glm::dvec3& direction);
[[nodiscard]] glm::dvec3 fromCubeMap(const OnCube& place);

/// What a texel's alpha covers at this height.
[[nodiscard]] double furCovered(const FurCoat& coat, double alpha, double height);
/// A texel that stands for many: their mean alpha, and what is seen of them.
struct FurTexel {
    double alpha = 0;
    FurFootprint footprint;
};
/// The share of a layer that is drawn over them, and how far (0..1) that, and not each texel's own coverage, is what is drawn.
struct FurMean {
    double covered = 0;
    double afar = 0;
};
[[nodiscard]] FurMean furMean(const FurCoat& coat, const FurTexel& texel, int layer);

/// Share of the light that the coat lets through to this height.
[[nodiscard]] double furOpen(const FurCoat& coat, double height, double cosine);

struct FurLight {
    glm::dvec3 position{0};
    glm::dvec3 colour{1};
};
/// The colour at a height, from root to tip.
[[nodiscard]] glm::dvec3 furAlbedo(const FurCoat& coat, double height);
/// Towards the eye; `lit`: the skin hides no light.
[[nodiscard]] glm::dvec3 furRadiance(const FurCoat& coat, const FurFragment& fragment, const glm::dvec3& albedo, const FurLight& light,
                                     const glm::dvec3& eye, bool lit);
/// With the albedo of the fragment's height.
[[nodiscard]] glm::dvec3 furRadiance(const FurCoat& coat, const FurFragment& fragment, const FurLight& light, const glm::dvec3& eye,
                                     bool lit);

/// What is seen of a fragment in the end.
struct FurShare {
    const FurFragment* fragment = nullptr;
    double weight = 0;
};
/// Depth test, alpha test and blending of a pixel's fragments. What the weights lack to 1 is background.
[[nodiscard]] std::vector<FurShare> blendFur(const FurCoat& coat, const std::vector<FurFragment>& fragments,
                                             const std::function<FurTexel(const FurFragment&)>& lookUp);

} // namespace tegument::reference
