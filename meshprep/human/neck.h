#pragma once
// The neck as a sculptor ends it: it goes down as wide as it is, instead of widening into shoulders that the level cut would leave as
// stubs.

#include "meshprep/human/bust.h"

namespace tegument {

/// Below `fromMm` under the chin no point of the skin lies farther from the neck's axis than the outline at that height, which widens by
/// a tenth over 24 mm. Returns how far the farthest point came in, mm.
float straightenNeck(Bust& bust, float fromMm);

} // namespace tegument
