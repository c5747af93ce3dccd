#include "tools/cli/surroundings.h"

#include "host/image/dds.h"
#include "host/support/file.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <fmt/format.h>

#include <chrono>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

/// Part of the name in the cache: a change of what is made takes another number.
constexpr int kEnvironmentVersion = 1;

std::string occlusionKey(const Mesh& mesh) {
    const auto hash = [](const auto& values) {
        return contentHash(std::string_view(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(values[0])));
    };
    return contentHash(
        fmt::format("{} {} {} {} {}", kOcclusionVersion, hash(mesh.positions), hash(mesh.normals), hash(mesh.uvs), hash(mesh.indices)));
}

} // namespace

Result<fs::path> cachedEnvironment(const std::string& generator, const SaySurroundings& say) {
    const fs::path file = cacheFolder() / "light" / "made" / fmt::format("{}_{}.dds", generator, kEnvironmentVersion);
    if (isWholeDds(file)) return file;
    const auto start = std::chrono::steady_clock::now();
    const auto texture =
        makeEnvironment(defaultEnvironment(generator == kSkyGenerator ? DefaultEnvironment::Sky : DefaultEnvironment::Studio), generator);
    if (!texture) return texture.error();
    if (const auto written = writeDds(file, *texture); !written) return written.error();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    say(fmt::format("made the {} in {:.1f} s: {}", generator, seconds, file.string()));
    return file;
}

Result<fs::path> cachedOcclusion(const Mesh& mesh, const SaySurroundings& say) {
    const fs::path file = cacheFolder() / "light" / "made" / fmt::format("occlusion_{}.dds", occlusionKey(mesh));
    if (isWholeDds(file)) return file;
    const auto occlusion = bakeOcclusion(mesh);
    if (!occlusion) return occlusion.error();
    if (const auto written = writeDds(file, makeDds(occlusion->map, DdsFormat::Rgba16F, false)); !written) return written.error();
    say(fmt::format("made occlusion for {} in {:.1f} s: {}", mesh.name, occlusion->seconds, file.string()));
    return file;
}

} // namespace tegument::app
