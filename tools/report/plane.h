#pragma once
// Pictures in a report: their floats as text, and what belongs side by side.

#include "host/image/image.h"
#include "tools/report/report.h"

namespace tegument::report {

/// {width, height, channels, scale, data}: halves times `scale`, the high bytes of all values and then the low ones, each as its difference
/// to the value before it, deflated, in base64. What is not finite stays so. A value keeps 11 bits.
[[nodiscard]] Json plane(const Image& image);

} // namespace tegument::report
