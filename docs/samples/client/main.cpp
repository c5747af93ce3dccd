// client EFFECT [-t TECHNIQUE] [-D NAME=VALUE] [--size WxH] MESH -o PICTURE: any effect on any mesh, by the installed library.
#include <tegument.h>

#include <cstdio>
#include <map>

int main(int count, char** words) {
    tegument::assets::JobOptions options;
    std::string picture, define;
    const std::map<std::string, std::string*> named = {
        {"-t", &options.technique}, {"-D", &define}, {"--size", &options.size}, {"-o", &picture}};
    for (int i = 1; i < count; ++i) {
        const auto found = named.find(words[i]);
        const bool isNamed = found != named.end() && i + 1 < count;
        (isNamed ? *found->second : options.file.empty() ? options.file : options.scene.mesh) = words[isNamed ? ++i : i];
    }
    if (!define.empty()) options.effect.defines.push_back(define);
    const auto fail = [](const tegument::Error& error) { return std::puts(format(error).c_str()), static_cast<int>(error.blame); };
    const auto job = tegument::assets::loadJob(options);
    if (!job) return fail(job.error());
    auto device = tegument::gpu::Device::create();
    if (!device) return fail(device.error());
    const auto drawn = tegument::assets::draw(*device, *job);
    if (!drawn) return fail(drawn.error());
    const auto written = tegument::assets::writePicture(picture, drawn->image, job->effect.displayColours);
    return written ? 0 : fail(written.error());
}
