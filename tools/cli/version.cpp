#include "tools/cli/version.h"

#include "host/gpu/gpu.h"
#include "host/spirv/compile.h"
#include "host/support/file.h"

#include <CLI/Version.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace tegument::app {

namespace {

std::string compilerText(Compiler compiler) {
    return compilerAvailable(compiler) ? compilerName(compiler) : whyCompilerMissing(compiler);
}

#ifdef __clang__
constexpr const char* kBuiltBy = __VERSION__; // begins with the compiler's name
#else
constexpr const char* kBuiltBy = "GCC " __VERSION__;
#endif

std::string deviceText() {
    const auto device = gpu::Device::create({});
    if (!device) return device.error().diagnostics.front().text;
    const gpu::DeviceInfo& info = device->info();
    return fmt::format("{} ({}), Vulkan {}", info.name, info.driver, info.apiVersion);
}

} // namespace

std::string versionText(bool verbose) {
    if (!verbose) return TEGUMENT_VERSION;
    return fmt::format(
        "tegument {}\nbuilt by    {}\nlibraries   fmt {}.{}.{}, CLI11 {}, nlohmann-json {}.{}.{}\nDXC         {}\nglslang     {}\n"
        "device      {}\ncache       {}",
        TEGUMENT_VERSION, kBuiltBy, FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100, CLI11_VERSION,
        NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH, compilerText(Compiler::Dxc),
        compilerText(Compiler::Glslang), deviceText(), cacheFolder().string());
}

} // namespace tegument::app
