#pragma once
// How large a picture is drawn while something moves, where a whole one takes too long. Needs no GPU.

namespace tegument::view {

/// A picture drawn while something moves.
struct QuickPicture {
    double share = 1;        // of each side of the window's picture
    double milliseconds = 0; // it took; 0: none was drawn yet
};

/// The share of each side that keeps the next picture near 70 ms: 1, 3/4, 1/2, 3/8, 1/4 or 1/8. `whole`: what the last whole picture took.
/// What does not depend on the picture's size is found from both; where that alone takes longer, the picture is no smaller than helps.
[[nodiscard]] double quickShare(double whole, const QuickPicture& last);

} // namespace tegument::view
