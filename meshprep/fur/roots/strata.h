#pragma once
// The surface cut into pieces of about equal area, each with its share of the roots: what makes counts even over any part of it.

#include "meshprep/fur/roots/fur_surface.h"

#include <array>
#include <functional>

namespace tegument {

/// Share of the full density at a point, 0..1.
using DensityAt = std::function<double(const SurfacePoint&)>;

/// Strata are what of the surface lies in one cube of space, in Morton order (G. M. Morton, 1966): runs of them are cubes of twice the
/// side, four times and so on.
class Strata {
public:
    /// Triangles larger than half of `side` are cut first. `wanted` roots are shared out in proportion to area times density, to whole
    /// numbers: any run of strata has its share to within one. `density` may be empty.
    Strata(const FurSurface& surface, double side, std::size_t wanted, const DensityAt& density);

    struct Run {
        std::uint32_t first = 0; // strata
        std::uint32_t last = 0;  // behind the last
    };
    /// Calls visit(run) for every cube of 2^level sides that holds some of the surface.
    template <class Visit>
    void forRuns(unsigned level, Visit&& visit) const {
        for (std::uint32_t first = 0, last = 0; first < strata_.size(); first = last) {
            while (last < strata_.size() && ((strata_[last].key ^ strata_[first].key) >> (3 * level)) == 0)
                ++last;
            visit(Run{first, last});
        }
    }

    [[nodiscard]] std::size_t count() const { return strata_.size(); }
    [[nodiscard]] std::size_t quota(const Run& run) const { return upTo(run.last) - upTo(run.first); }
    /// Mean of the density over a run.
    [[nodiscard]] double density(const Run& run) const;

    struct Place {
        SurfacePoint point;
        std::uint32_t stratum = 0;
    };
    /// Three numbers in [0, 1) to a point of a run, evenly by area.
    [[nodiscard]] Place point(const Run& run, const glm::dvec3& uniform) const;

private:
    /// A part of a triangle: the weights of its second and third corner at its own three corners.
    struct Piece {
        std::uint32_t triangle = 0;
        std::array<glm::vec2, 3> corners{glm::vec2(0, 0), glm::vec2(1, 0), glm::vec2(0, 1)};
    };
    struct Stratum {
        std::uint64_t key = 0;
        std::uint32_t firstPiece = 0;
        std::size_t rootsBefore = 0; // shared out to the strata before this
    };

    void cutTriangles(double longest, std::size_t mostPieces);
    void gather(double side);
    void shareOut(std::size_t wanted, const DensityAt& density);
    [[nodiscard]] glm::vec3 positionOf(const Piece& piece, const glm::vec2& weights) const;
    [[nodiscard]] double meanDensity(const Piece& piece, const DensityAt& density) const;
    [[nodiscard]] std::size_t upTo(std::uint32_t stratum) const {
        return stratum < strata_.size() ? strata_[stratum].rootsBefore : wanted_;
    }
    [[nodiscard]] std::size_t firstPiece(std::uint32_t stratum) const {
        return stratum < strata_.size() ? strata_[stratum].firstPiece : pieces_.size();
    }

    const FurSurface& surface_;
    std::size_t wanted_ = 0;
    std::vector<Piece> pieces_;
    std::vector<Stratum> strata_;
    std::vector<std::uint32_t> stratumOfPiece_;
    std::vector<double> area_;   // of all pieces before each, and of all
    std::vector<double> weight_; // area times density, likewise; empty where the density is 1
};

} // namespace tegument
