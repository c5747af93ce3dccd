#pragma once
// The ends of an effect's sliders, at which its pictures must hold.

#include "host/effect/model.h"

#include <string>
#include <vector>

namespace tegument::test {

struct SliderEnd {
    std::string parameter;
    double value = 0;
};

/// UIMin and UIMax of every parameter that has both.
inline std::vector<SliderEnd> sliderEnds(const Effect& effect) {
    std::vector<SliderEnd> ends;
    for (const Parameter& parameter : effect.parameters) {
        const auto low = parameter.annotations.numbers("UIMin");
        const auto high = parameter.annotations.numbers("UIMax");
        if (!low || !high) continue;
        ends.push_back({parameter.name, low->front()});
        ends.push_back({parameter.name, high->front()});
    }
    return ends;
}

} // namespace tegument::test
