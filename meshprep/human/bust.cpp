#include "meshprep/human/bust.h"

#include "meshprep/human/atlas.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace tegument {

namespace {

struct Extent {
    glm::vec3 low{std::numeric_limits<float>::max()};
    glm::vec3 high{std::numeric_limits<float>::lowest()};

    void add(const glm::vec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
};

/// Quads and vertices of one chart.
struct Chart {
    std::vector<std::size_t> quads;
    std::set<std::uint32_t> vertices;
    Extent extent;
};

std::vector<Chart> splitCharts(const QuadMesh& mesh, const std::vector<Quad>& quads) {
    const std::vector<std::uint32_t> numbers = chartsOf(quads);
    std::vector<Chart> charts(std::size_t{1} + std::ranges::max(numbers));
    for (std::size_t q = 0; q < quads.size(); ++q) {
        Chart& chart = charts[numbers[q]];
        chart.quads.push_back(q);
        for (const std::uint32_t vertex : quads[q].position) {
            chart.vertices.insert(vertex);
            chart.extent.add(mesh.positions[vertex]);
        }
    }
    return charts;
}

bool touches(const Chart& a, const Chart& b) {
    return std::ranges::any_of(b.vertices, [&](std::uint32_t vertex) { return a.vertices.contains(vertex); });
}

/// Moves the quads of `left` that touch `front` to `ring`; `front` becomes the ring's vertices.
void takeRing(const std::vector<Quad>& quads, std::vector<std::size_t>& left, std::set<std::uint32_t>& front,
              std::vector<std::size_t>& ring) {
    const auto touchesFront = [&](std::size_t q) {
        return std::ranges::any_of(quads[q].position, [&](std::uint32_t vertex) { return front.contains(vertex); });
    };
    const auto inRing = std::stable_partition(left.begin(), left.end(), [&](std::size_t q) { return !touchesFront(q); });
    ring.assign(inRing, left.end());
    left.erase(inRing, left.end());
    for (const std::size_t q : ring)
        front.insert(quads[q].position.begin(), quads[q].position.end());
}

struct Selection {
    std::vector<Quad> quads;
    std::vector<std::uint8_t> support;

    void add(const std::vector<Quad>& from, const std::vector<std::size_t>& which, bool isSupport) {
        for (const std::size_t q : which) {
            quads.push_back(from[q]);
            support.push_back(isSupport ? 1 : 0);
        }
    }
};

Selection selectSkin(const QuadMesh& mesh, const std::vector<Quad>& body, int neckRings) {
    const std::vector<Chart> charts = splitCharts(mesh, body);
    const Chart& head = *std::ranges::max_element(charts, {}, [](const Chart& chart) { return chart.extent.high.y; });
    Selection selection;
    selection.add(body, head.quads, false);
    bool neck = false;
    for (const Chart& chart : charts) {
        if (&chart == &head || !touches(head, chart)) continue;
        if (chart.extent.low.y >= head.extent.low.y) { // inside the head: mouth, eye sockets
            selection.add(body, chart.quads, false);
            continue;
        }
        neck = true;
        std::vector<std::size_t> left = chart.quads;
        std::vector<std::size_t> ring;
        std::set<std::uint32_t> front = head.vertices;
        for (int i = 0; i <= neckRings; ++i) {
            takeRing(body, left, front, ring);
            selection.add(body, ring, i == neckRings);
        }
    }
    if (!neck) selection.quads.clear();
    return selection;
}

/// Adds quads of the file to the bust, with new numbers for their positions and texture coordinates.
class BustBuilder {
public:
    BustBuilder(const QuadMesh& mesh, Bust& bust) : mesh_(mesh), bust_(bust) {}

    void add(const Quad& quad, BustPart part, bool support) {
        Quad renumbered;
        for (std::size_t c = 0; c < 4; ++c) {
            renumbered.position[c] = number(positions_, quad.position[c], mesh_.positions, bust_.positions);
            renumbered.uv[c] = number(uvs_, quad.uv[c], mesh_.uvs, bust_.uvs);
        }
        bust_.quads.push_back(renumbered);
        bust_.parts.push_back(part);
        bust_.support.push_back(support ? 1 : 0);
    }

private:
    template <class Value>
    static std::uint32_t number(std::map<std::uint32_t, std::uint32_t>& known, std::uint32_t old, const std::vector<Value>& from,
                                std::vector<Value>& to) {
        const auto [entry, isNew] = known.try_emplace(old, static_cast<std::uint32_t>(to.size()));
        if (isNew) to.push_back(from[old]);
        return entry->second;
    }

    const QuadMesh& mesh_;
    Bust& bust_;
    std::map<std::uint32_t, std::uint32_t> positions_;
    std::map<std::uint32_t, std::uint32_t> uvs_;
};

/// Centre of the bounding box, mean distance from it.
Eyeball measureEye(const QuadMesh& mesh, const std::vector<Quad>& quads) {
    std::set<std::uint32_t> vertices;
    Extent extent;
    for (const Quad& quad : quads)
        vertices.insert(quad.position.begin(), quad.position.end());
    for (const std::uint32_t vertex : vertices)
        extent.add(mesh.positions[vertex]);
    Eyeball eye{.centre = (extent.low + extent.high) / 2.0f};
    for (const std::uint32_t vertex : vertices)
        eye.radius += glm::distance(mesh.positions[vertex], eye.centre) / static_cast<float>(vertices.size());
    return eye;
}

/// The file's eyeballs lie behind its lids with air between them; grown and moved by so much they touch the lids' inner rim. (Eyeballs of
/// 15 mm radius are a quarter larger than real ones: the file's, kept because its lids were made for them.)
constexpr float kEyeForward = 0.8f; // mm
constexpr float kEyeGrowth = 1.02f;

/// The eyes get texture coordinates of their own: one per vertex, so that each eyeball is a chart.
void addEye(const QuadMesh& mesh, const std::vector<Quad>& quads, BustPart part, Bust& bust) {
    Eyeball& eye = bust.eyes[part == BustPart::LeftEye ? 0 : 1];
    const Eyeball found = measureEye(mesh, quads);
    eye = {.centre = found.centre + glm::vec3(0, 0, kEyeForward), .radius = found.radius * kEyeGrowth};
    QuadMesh charted;
    for (const glm::vec3& p : mesh.positions) {
        charted.positions.push_back(eye.centre + (p - found.centre) * kEyeGrowth);
        charted.uvs.push_back(eyeChart(eye, charted.positions.back()));
    }
    BustBuilder builder(charted, bust);
    for (const Quad& quad : quads)
        builder.add({.position = quad.position, .uv = quad.position}, part, false);
}

void centre(Bust& bust) {
    Extent extent;
    for (std::size_t q = 0; q < bust.quads.size(); ++q)
        for (const std::uint32_t vertex : bust.quads[q].position)
            if (bust.support[q] == 0) extent.add(bust.positions[vertex]);
    const glm::vec3 middle = (extent.low + extent.high) / 2.0f;
    for (glm::vec3& p : bust.positions)
        p -= middle;
    for (Eyeball& eye : bust.eyes)
        eye.centre -= middle;
}

} // namespace

glm::vec2 eyeChart(const Eyeball& eye, const glm::vec3& position) {
    const glm::vec3 d = position - eye.centre;
    const float across = std::hypot(d.x, d.y);
    if (across == 0) return glm::vec2(0);
    return glm::vec2(d.x, d.y) * (eye.radius * std::atan2(across, d.z) / across);
}

float eyeSurface(const Eyeball& eye, const glm::vec3& outward) {
    // A cornea's radius of curvature is 7.8 mm: at its middle it stands 1 mm before a sphere of 15 that it leaves at the iris's border.
    constexpr float kCornea = 1.05f; // mm
    constexpr float kSulcus = 0.2f;  // mm: so softly it passes into the white
    constexpr float kBorder = kIrisRadius + 0.3f;
    const float along = eye.radius * std::atan2(std::hypot(outward.x, outward.y), outward.z) / kBorder;
    const float height = kCornea * (1 - along * along);
    return eye.radius + (height + std::hypot(height, kSulcus)) / 2 * (1 - glm::smoothstep(1.2f, 1.8f, along));
}

glm::vec3 eyeNormal(const Eyeball& eye, const glm::vec3& outward) {
    constexpr float kStep = 0.01f; // rad
    const glm::vec3 side = glm::normalize(glm::cross(outward, std::abs(outward.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0)));
    const auto at = [&](const glm::vec3& way) {
        const glm::vec3 direction = glm::normalize(outward + kStep * way);
        return direction * eyeSurface(eye, direction);
    };
    const glm::vec3 up = glm::cross(side, outward);
    const glm::vec3 normal = glm::normalize(glm::cross(at(side) - at(-side), at(up) - at(-up)));
    return glm::dot(normal, outward) < 0 ? -normal : normal;
}

void raiseLids(Bust& bust) {
    constexpr float kLid = 3.5f; // mm before the eyeball: as thick as lids are
    constexpr float kFace = 8;
    std::vector<std::uint8_t> moved(bust.positions.size(), 0);
    for (std::size_t q = 0; q < bust.quads.size(); ++q)
        for (const std::uint32_t v : bust.quads[q].position) {
            if (bust.parts[q] != BustPart::Skin || moved[v] != 0) continue;
            moved[v] = 1;
            for (const Eyeball& eye : bust.eyes) {
                const glm::vec3 from = bust.positions[v] - eye.centre;
                const float off = glm::length(from) - eye.radius;
                if (from.z <= 0 || off > kFace) continue;
                const glm::vec3 outward = glm::normalize(from);
                bust.positions[v] += outward * (eyeSurface(eye, outward) - eye.radius) * (1 - glm::smoothstep(kLid, kFace, off));
            }
        }
}

Result<Bust> takeBust(const QuadMesh& body, const std::string& file, int neckRings) {
    const Result<std::vector<Quad>> skin = quadsOfGroup(body, "body", file);
    if (!skin) return skin.error();
    const Result<std::vector<Quad>> left = quadsOfGroup(body, "helper-l-eye", file);
    if (!left) return left.error();
    const Result<std::vector<Quad>> right = quadsOfGroup(body, "helper-r-eye", file);
    if (!right) return right.error();

    const Selection selection = selectSkin(body, *skin, neckRings);
    if (selection.quads.empty())
        return inputError(7005, {.file = file}, "no chart of group 'body' goes on below the head's",
                          "the head is found as the chart with the highest vertex, y up; the neck as the chart that meets it from below");
    Bust bust;
    BustBuilder builder(body, bust);
    for (std::size_t q = 0; q < selection.quads.size(); ++q)
        builder.add(selection.quads[q], BustPart::Skin, selection.support[q] != 0);
    addEye(body, *left, BustPart::LeftEye, bust);
    addEye(body, *right, BustPart::RightEye, bust);
    centre(bust);
    return bust;
}

} // namespace tegument
