#include "lab/reference/bssrdf_cache.h"

#include "host/support/file.h"

#include <cstring>
#include <type_traits>

namespace tegument::reference {

namespace {

constexpr std::string_view kMagic = "TGBSSRD3"; // the digit: raise it with every change of what is computed
constexpr std::size_t kChecksumSize = 32;

class Key {
public:
    template <class T>
    void add(const T& value) {
        static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    template <class T>
    void add(const std::vector<T>& list) {
        add(list.size());
        bytes_ += contentHash({reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T)});
    }
    void add(const std::string& text) {
        add(text.size());
        bytes_ += text;
    }
    [[nodiscard]] std::string hash() const { return contentHash(bytes_); }

private:
    std::string bytes_ = std::string(kMagic);
};

void addMesh(Key& key, const Mesh& mesh) {
    key.add(mesh.positions);
    key.add(mesh.normals);
    key.add(mesh.tangents);
    key.add(mesh.uvs);
    key.add(mesh.indices);
    for (const EmbeddedTexture& texture : mesh.textures) {
        key.add(texture.role);
        key.add(texture.image.width);
        key.add(texture.image.channels);
        key.add(texture.image.pixels);
    }
}

/// A function has no content; its values have.
void addProfile(Key& key, const RadialProfile& profile) {
    constexpr int kValues = 256;
    key.add(profile.reach);
    key.add(profile.finest);
    for (int i = 0; i < kValues; ++i)
        key.add(profile.density(profile.reach * (i + 0.5) * (i + 0.5) / (kValues * kValues)));
    if (profile.flesh != glm::dvec3(0)) key.add(profile.flesh);
}

std::filesystem::path pathFor(const std::string& key) {
    return cacheFolder() / "reference" / (key + ".bin");
}

} // namespace

std::string diffusedKey(const SkinScene& scene, std::span<const ShadedPoint> points, const BssrdfOptions& options) {
    Key key;
    addMesh(key, scene.mesh());
    addProfile(key, options.profile);
    key.add(scene.light().eye);
    key.add(scene.lightColour());
    const SkinSettings& settings = scene.settings();
    key.add(settings.mix);
    key.add(settings.roughness); // of rho_dt
    key.add(settings.attenuation);
    key.add(settings.printedAlbedo);
    key.add(scene.more().lamps);
    key.add(scene.more().lampSide);
    key.add(scene.more().diffuseSky);
    key.add(options.quadrature.fineness);
    key.add(options.quadrature.negligible);
    key.add(options.quadrature.halvings);
    key.add(points.size());
    for (const ShadedPoint& point : points) {
        key.add(point.point.place.triangle);
        key.add(point.point.place.weights);
    }
    return key.hash();
}

std::optional<std::vector<Diffused>> loadDiffused(const std::string& key, std::size_t count) {
    std::error_code code;
    const std::filesystem::path path = pathFor(key);
    if (!std::filesystem::is_regular_file(path, code)) return {};
    const auto bytes = readFile(path);
    const std::size_t head = kMagic.size() + kChecksumSize;
    if (!bytes || !bytes->starts_with(kMagic) || bytes->size() != head + count * sizeof(Diffused)) return {};
    const std::string_view payload = std::string_view(*bytes).substr(head);
    if (contentHash(payload) != std::string_view(*bytes).substr(kMagic.size(), kChecksumSize)) return {};
    std::vector<Diffused> diffused(count);
    std::memcpy(diffused.data(), payload.data(), payload.size());
    return diffused;
}

void storeDiffused(const std::string& key, const std::vector<Diffused>& diffused) {
    static_assert(std::is_trivially_copyable_v<Diffused>);
    const std::string_view payload(reinterpret_cast<const char*>(diffused.data()), diffused.size() * sizeof(Diffused));
    std::string bytes(kMagic);
    bytes += contentHash(payload);
    bytes += payload;
    if (!writeFile(pathFor(key), bytes)) return;
}

} // namespace tegument::reference
