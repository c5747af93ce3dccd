#pragma once
// How large a picture is drawn while something moves, where a whole one takes too long. Needs no GPU.

#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace tegument::view {

/// What moves: with the camera alone the maps on the skin, and those that the light sees, stay as they are.
enum class Moving { Camera, Rest };

/// How the picture is drawn: as it is to be, or so that it is there soon.
struct Sharpness {
    double share = 1;      // of each side of the picture
    bool drafting = false; // by the session with fewer texels in its maps
    bool coarse = false;   // with fewer triangles
    bool single = false;   // with one sample a pixel, as all that is not whole

    [[nodiscard]] bool whole() const { return share == 1 && !drafting && !coarse && !single; }
};

/// "while it moves: 240 x 135, small maps": short, or the text's panel would be wider, and the picture darker, than at rest.
[[nodiscard]] std::string draftText(const Sharpness& how, std::uint32_t width, std::uint32_t height);

/// A picture drawn while something moves.
struct QuickPicture {
    double share = 1;        // of each side of the window's picture
    double milliseconds = 0; // it took; 0: none was drawn yet
};

/// The share of each side that keeps the next picture near 70 ms: 1, 3/4, 1/2, 3/8, 1/4 or 1/8. `whole`: what the last whole picture took.
/// What does not depend on the picture's size is found from both; where that alone takes longer, the picture is no smaller than helps.
[[nodiscard]] double quickShare(double whole, const QuickPicture& last);

/// Milliseconds that passes took, of those that have the picture's size and of all others. Of a frame that kept some, those that it drew.
struct PassCosts {
    double pixels = 0;
    double others = 0;
};

/// What the next picture will take, by what the last ones did.
struct MovingCosts {
    double pixels = 0;   // of a whole picture
    QuickPicture quick;  // the last one, of the passes of the picture's size
    double camera = 0;   // of all other passes, and what is not the GPU's, where the camera moves
    double anything = 0; // likewise, where anything else does

    /// Of a picture of this share of each side. `took`: all of it; a picture that nothing moved for says nothing of the other passes.
    /// `draft`: with one sample a pixel, and perhaps fewer triangles.
    void note(const PassCosts& passes, double took, double share, std::optional<Moving> moving, bool draft);
    [[nodiscard]] double restOf(Moving moving) const { return moving == Moving::Camera ? camera : anything; }
    /// Whether a whole picture takes longer than 70 ms.
    [[nodiscard]] bool slow(Moving moving) const;
    [[nodiscard]] double share(Moving moving) const;
};

/// Milliseconds of passes that do not have the picture's size: of those that a move of the camera draws, and of all.
struct RehearsalCosts {
    double camera = 0;
    double anything = 0;
};

/// Into how many bands passes are cut, so that a picture in pieces can be left soon; learnt from what they took.
class PieceTimes {
public:
    /// A pass that took so long in the bands of now.
    void note(const std::string& pass, double milliseconds);
    [[nodiscard]] const std::map<std::string, std::uint32_t>& bands() const { return bands_; }
    void forget() { bands_.clear(); }

private:
    std::map<std::string, std::uint32_t> bands_;
};

} // namespace tegument::view
