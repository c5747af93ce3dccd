#include "meshprep/assets/cached_light.h"

#include "host/image/dds.h"
#include "host/support/file.h"
#include "meshprep/light/environment.h"
#include "meshprep/light/occlusion.h"

#include <fmt/format.h>

namespace tegument::assets {

namespace fs = std::filesystem;

namespace {

/// Part of the name in the cache: a change of what is made takes another number.
constexpr int kEnvironmentVersion = 1;

} // namespace

Result<fs::path> cachedEnvironment(const std::string& generator, const Say& say) {
    const auto kind = generator == kSkyGenerator ? DefaultEnvironment::Sky : DefaultEnvironment::Studio;
    const auto make = [&](const fs::path& file) -> Result<void> {
        const auto texture = makeEnvironment(defaultEnvironment(kind), generator);
        if (!texture) return texture.error();
        return writeDds(file, *texture);
    };
    return cachedDds("light", fmt::format("{}_{}", generator, kEnvironmentVersion), "the " + generator, say, make);
}

Result<fs::path> cachedOcclusion(const Mesh& mesh, const Say& say) {
    const CacheKey key = CacheKey(kOcclusionVersion).add(mesh.positions).add(mesh.normals).add(mesh.uvs).add(mesh.indices);
    const auto make = [&](const fs::path& file) -> Result<void> {
        const auto occlusion = bakeOcclusion(mesh);
        if (!occlusion) return occlusion.error();
        return writeDds(file, makeDds(occlusion->map, DdsFormat::Rgba16F, false));
    };
    return cachedDds("light", "occlusion_" + key.text(), "occlusion for " + mesh.name, say, make);
}

} // namespace tegument::assets
