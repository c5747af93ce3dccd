#pragma once
// Read before xatlas.cpp. The C library's angles of floats differ in their last bit between processors, which is enough for other charts;
// doubles that are rounded do not (but where a double's own last bit decides: one in some hundred million).

#include <cmath>
#include <math.h>

#define acosf(x) static_cast<float>(std::acos(static_cast<double>(x)))
#define atan2f(y, x) static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)))
#define cosf(x) static_cast<float>(std::cos(static_cast<double>(x)))
#define sinf(x) static_cast<float>(std::sin(static_cast<double>(x)))
