// Any bytes are another host's effect: it is read leniently and respelt, or reports errors; it never crashes, hangs or eats memory.

#include "meshprep/adopt/adopt.h"
#include "tests/effect/support.h"

#include <cstdint>
#include <cstdlib>

namespace {

void require(bool condition) {
    if (!condition) std::abort();
}

/// A shader has a source, or says why not.
void check(const std::optional<tegument::ShaderReference>& shader) {
    if (shader && shader->obstacle)
        require(shader->obstacle->code >= 3401 && shader->obstacle->code <= 3405 && !shader->obstacle->text.empty());
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto read = [&](const std::filesystem::path& path) -> tegument::Result<std::string> {
        return path == "main.fx" ? text : std::string();
    };
    tegument::Result<tegument::Effect> effect = tegument::loadEffect("main.fx", {.lenient = true}, read);
    if (!effect) {
        require(!effect.error().diagnostics.empty());
        return 0;
    }
    const tegument::Adoption adoption = tegument::adopted(std::move(*effect));
    for (const tegument::Technique& technique : adoption.effect.techniques)
        for (const tegument::Pass& pass : technique.passes) {
            check(pass.vertexShader);
            check(pass.pixelShader);
        }
    for (const tegument::ParameterBinding& binding : adoption.bindings)
        require(!binding.parameter.empty() && !binding.source.empty());
    (void)tegument::needsRespelling(adoption.effect);
    return 0;
}
