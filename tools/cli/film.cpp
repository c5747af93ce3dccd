// A film in MP4, H.264: pictures are kept as they come, and given to ffmpeg at the end.

#include "host/support/file.h"
#include "host/support/temporary.h"
#include "tools/cli/animation.h"
#include "tools/process/process.h"

#include <fmt/format.h>

#include <cassert>
#include <fstream>

namespace tegument::app {

namespace fs = std::filesystem;

namespace {

constexpr double kLongestFilm = 3600;      // seconds of encoding
constexpr const char* kFilmQuality = "16"; // strands and pores stay

class Film final : public Animation {
public:
    Film(fs::path ffmpeg, fs::path folder, const AnimationFormat& format)
        : ffmpeg_(std::move(ffmpeg)), folder_(std::move(folder)), format_(format),
          pictures_(folder_.path() / "pictures", std::ios::binary) {}
    Result<void> add(const Image& radiance) override;
    Result<void> write(const fs::path& path) override;

private:
    fs::path ffmpeg_;
    Temporary folder_;
    AnimationFormat format_;
    std::ofstream pictures_;
};

Result<void> Film::add(const Image& radiance) {
    assert(radiance.width == format_.width && radiance.height == format_.height && radiance.channels >= 3);
    const std::string bytes = shownBytes(radiance);
    if (pictures_.write(bytes.data(), static_cast<std::streamsize>(bytes.size())).flush()) return {};
    return machineError(5002, fmt::format("the pictures of a film cannot be kept in {}", folder_.path().string()),
                        "TMPDIR=FOLDER names a folder with more room");
}

// Sides become even, as H.264's halved colours need it; what is added is black. Colours are BT.709's, with sRGB's own primaries.
Result<void> Film::write(const fs::path& path) {
    pictures_.close();
    const std::string film = (folder_.path() / "film.mp4").string();
    const ProcessCommand encode{.arguments = {ffmpeg_.string(),
                                              "-nostdin",
                                              "-v",
                                              "error",
                                              "-f",
                                              "rawvideo",
                                              "-pix_fmt",
                                              "rgb24",
                                              "-s",
                                              fmt::format("{}x{}", format_.width, format_.height),
                                              "-r",
                                              fmt::format("1000/{}", format_.milliseconds),
                                              "-i",
                                              (folder_.path() / "pictures").string(),
                                              "-vf",
                                              "scale=out_color_matrix=bt709:out_range=tv,pad=ceil(iw/2)*2:ceil(ih/2)*2",
                                              "-c:v",
                                              "libx264",
                                              "-crf",
                                              kFilmQuality,
                                              "-pix_fmt",
                                              "yuv420p",
                                              "-colorspace",
                                              "bt709",
                                              "-color_primaries",
                                              "bt709",
                                              "-color_trc",
                                              "bt709",
                                              "-movflags",
                                              "+faststart",
                                              film}};
    const auto ran = runProcess(encode, kLongestFilm);
    if (!ran) return ran.error();
    if (ran->exitCode != 0)
        return machineError(5205, fmt::format("MP4 cannot be encoded: {}", ran->output.substr(0, ran->output.find('\n'))),
                            "write a .webp, which needs no other program");
    const auto bytes = readFile(film);
    return bytes ? writeFile(path, *bytes) : Result<void>(bytes.error());
}

} // namespace

Result<std::unique_ptr<Animation>> makeFilm(const AnimationFormat& format) {
    const auto ffmpeg = findProgram("ffmpeg");
    if (!ffmpeg)
        return machineError(5205, "MP4 needs the program ffmpeg, and it is not installed",
                            "apt-get install ffmpeg; or write a .webp, which needs no other program");
    return std::unique_ptr<Animation>(std::make_unique<Film>(*ffmpeg, newTemporaryFolder(), format));
}

} // namespace tegument::app
