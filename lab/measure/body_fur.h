#pragma once
// Straight strands on a ball and on a torus, drawn by effects/FurRoots.fx, technique Roots, beside exact rays against the same strands.

#include "host/gpu/gpu.h"
#include "host/run/run.h"
#include "lab/reference/fur_body.h"

#include <filesystem>
#include <memory>
#include <vector>

namespace tegument::measure {

/// Where a body is looked at, from far away: so that the skin's normal there is `tilt` (radians) from the way to the eye. On a torus at
/// `around` along the tube's circle from outside (0) over the top to inside (pi), tilted along the ring; a ball is the same everywhere.
/// `across`: tilted across the tube instead, to the side from which `around` grows: a torus' top (110 degrees, tilt 90) is then the outline
/// of its near side before the coat of its far side.
struct BodyView {
    double tilt = 0;
    double around = 0;
    bool across = false;
    double pixel = 0.125; // spacings
    int size = 32;
    int samples = 6; // of the truth, along each side of a pixel
};

struct BodyCoat {
    double spacing = 0.01; // mm: bodies have a radius of 1
    double length = 0.06;  // mm
    double radius = 0.3;   // spacings
    double shortest = 0.7; // share of the longest
};

/// Brightness and coverage, pixel after pixel: kRootShade where skin is or a strand begins, 1 at its tip.
inline constexpr double kRootShade = 0.1;
struct BodyPicture {
    std::vector<double> shade;
    std::vector<double> covered;
};

class BodyFur {
public:
    [[nodiscard]] static Result<BodyFur> create(gpu::Device& device, const reference::FurBody& body, const BodyCoat& coat);
    BodyFur(BodyFur&&) noexcept;
    BodyFur& operator=(BodyFur&&) noexcept;
    ~BodyFur();

    /// Of so many layers `fewest` at least, whatever the view; as many: all. `fringes`: in two rounds, so that what lies behind a soft
    /// fringe is drawn.
    [[nodiscard]] Result<BodyPicture> draw(const BodyView& view, int layers, int fewest, bool fringes = true) const;
    [[nodiscard]] BodyPicture truth(const BodyView& view, reference::FurShape shape) const;

private:
    struct Body;
    explicit BodyFur(std::unique_ptr<Body> body);
    std::unique_ptr<Body> body_;
};

/// Of a picture from the truth. Shades are between 0 and 1.
struct BodyError {
    double rms = 0;  // of the shade
    double bias = 0; // mean of picture - truth, share of the truth's mean
    /// Area that is covered in one of the pictures more than in the other, and the difference; pixels per pixel of the outline, if the view
    /// shows one from side to side: how far the outline is off, and how far outside.
    double outline = 0;
    double outside = 0;
};
[[nodiscard]] BodyError bodyError(const BodyPicture& picture, const BodyPicture& truth, const BodyView& view);

} // namespace tegument::measure
