#include "meshprep/fur/roots/coat_field.h"

#include <algorithm>

namespace tegument {

CoatField::CoatField(std::span<const CoatSample> samples, float radius)
    : samples_(samples), radius_(radius), grid_(radius, samples.size()) {
    for (const CoatSample& sample : samples) {
        grid_.add(sample.position, sample.normal, 0);
        longest_ = std::max(longest_, glm::length(sample.lean));
    }
}

glm::vec4 CoatField::at(const glm::vec3& place) const {
    // Normal equations of a constant and three slopes, for four values at once; steps in units of the radius.
    glm::mat4 left(0);
    glm::mat4 right(0);
    // A bucket shared by several cells is walked once for each: its points count as often, which their mean does not feel.
    grid_.visit(place, radius_, [&](std::uint32_t i, float squared) {
        const CoatSample& sample = samples_[i];
        const float share = 1 - squared / (radius_ * radius_);
        const glm::vec4 step((sample.position - place) / radius_, 1);
        left += share * share * glm::outerProduct(step, step);
        right += share * share * glm::outerProduct(glm::vec4(sample.lean, sample.density), step);
        return true;
    });
    const float weight = left[3][3];
    if (!(weight > 0)) return glm::vec4(0);
    constexpr float kStiffness = 1e-2F; // of slopes: along the normal samples tell little of them, or nothing
    for (glm::length_t i = 0; i < 3; ++i)
        left[i][i] += kStiffness * weight;
    const glm::vec4 value((glm::dmat4(right) * glm::inverse(glm::dmat4(left)))[3]); // floats would lose three digits
    const glm::vec3 lean(value);
    const float length = glm::length(lean);
    return {length > longest_ ? lean * (longest_ / length) : lean, std::clamp(value.w, 0.0F, 1.0F)};
}

} // namespace tegument
