#include "tools/cli/animation.h"

#include "host/support/file.h"
#include "tools/cli/palette.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <string>
#include <utility>

#include <gif_lib.h>

namespace tegument::app {

namespace {

constexpr int kColourBits = 8;
constexpr std::size_t kControlSize = 4; // bytes of a graphics control block

Error cannotEncode(int code) {
    const char* why = GifErrorString(code);
    return machineError(5205, fmt::format("GIF cannot be encoded: {}", why ? why : "giflib gives no reason"));
}

int append(GifFileType* file, const GifByteType* bytes, int count) {
    static_cast<std::string*>(file->UserData)->append(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count));
    return count;
}

/// All places are used, as the format has only powers of two.
std::array<GifColorType, kPaletteSize> tableOf(const std::vector<Rgb>& palette) {
    std::array<GifColorType, kPaletteSize> table{};
    std::ranges::transform(palette, table.begin(), [](const Rgb& rgb) { return GifColorType{rgb[0], rgb[1], rgb[2]}; });
    return table;
}

/// A picture has a palette of its own: one for all of them would have to serve what no single one shows.
class GifAnimation final : public Animation {
public:
    explicit GifAnimation(const AnimationFormat& format) : format_(format) {}
    ~GifAnimation() override { close(); }
    Result<void> begin();
    Result<void> add(const Image& radiance) override;
    Result<void> write(const std::filesystem::path& path) override;

private:
    bool putLoop();
    bool putPicture(std::vector<std::uint8_t> pixels, const ColorMapObject* colours);
    bool close() {
        GifFileType* file = std::exchange(file_, nullptr);
        return !file || EGifCloseFile(file, nullptr) == GIF_OK;
    }

    AnimationFormat format_;
    std::string bytes_;
    GifFileType* file_ = nullptr;
};

Result<void> GifAnimation::begin() {
    int error = 0;
    file_ = EGifOpen(&bytes_, append, &error);
    if (!file_) return cannotEncode(error);
    EGifSetGifVersion(file_, true);
    if (EGifPutScreenDesc(file_, format_.width, format_.height, kColourBits, 0, nullptr) != GIF_OK || !putLoop())
        return cannotEncode(file_->Error);
    return {};
}

/// The extension that browsers know: how often, 0 for ever.
bool GifAnimation::putLoop() {
    constexpr std::array<GifByteType, 3> kForEver = {1, 0, 0};
    const std::string name = "NETSCAPE2.0";
    return EGifPutExtensionLeader(file_, APPLICATION_EXT_FUNC_CODE) == GIF_OK &&
           EGifPutExtensionBlock(file_, static_cast<int>(name.size()), name.data()) == GIF_OK &&
           EGifPutExtensionBlock(file_, static_cast<int>(kForEver.size()), kForEver.data()) == GIF_OK &&
           EGifPutExtensionTrailer(file_) == GIF_OK;
}

bool GifAnimation::putPicture(std::vector<std::uint8_t> pixels, const ColorMapObject* colours) {
    const GraphicsControlBlock control = {DISPOSE_DO_NOT, false, (format_.milliseconds + 5) / 10, NO_TRANSPARENT_COLOR};
    std::array<GifByteType, kControlSize> bytes{};
    EGifGCBToExtension(&control, bytes.data());
    if (EGifPutExtension(file_, GRAPHICS_EXT_FUNC_CODE, static_cast<int>(bytes.size()), bytes.data()) != GIF_OK) return false;
    if (EGifPutImageDesc(file_, 0, 0, format_.width, format_.height, false, colours) != GIF_OK) return false;
    return EGifPutLine(file_, pixels.data(), static_cast<int>(pixels.size())) == GIF_OK;
}

Result<void> GifAnimation::add(const Image& radiance) {
    assert(radiance.width == format_.width && radiance.height == format_.height && radiance.channels >= 3);
    const std::vector<unsigned char> rgb = shownBytes(radiance);
    const std::vector<Rgb> palette = paletteOf(rgb);
    ColorMapObject* colours = GifMakeMapObject(static_cast<int>(kPaletteSize), tableOf(palette).data());
    if (!colours) return cannotEncode(E_GIF_ERR_NOT_ENOUGH_MEM);
    const bool put = putPicture(dithered(rgb, static_cast<std::size_t>(format_.width), palette), colours);
    GifFreeMapObject(colours);
    return put ? Result<void>() : cannotEncode(file_->Error);
}

Result<void> GifAnimation::write(const std::filesystem::path& path) {
    if (!close()) return cannotEncode(E_GIF_ERR_CLOSE_FAILED);
    return writeFile(path, bytes_);
}

} // namespace

Result<std::unique_ptr<Animation>> makeGif(const AnimationFormat& format) {
    constexpr int kLargest = std::numeric_limits<std::uint16_t>::max(); // the format's own
    if (std::max(format.width, format.height) > kLargest)
        return machineError(5205, fmt::format("GIF cannot be encoded: a side beyond {} pixels", kLargest));
    auto animation = std::make_unique<GifAnimation>(format);
    if (const auto begun = animation->begin(); !begun) return begun.error();
    return std::unique_ptr<Animation>(std::move(animation));
}

} // namespace tegument::app
