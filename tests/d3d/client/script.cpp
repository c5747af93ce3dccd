#include "script.h"

#include "com.h"

namespace client {

namespace {

std::optional<std::string> given(const std::string& script) {
    return script.empty() ? std::nullopt : std::optional(script);
}

} // namespace

void Engine::clear(Clear what, std::optional<std::size_t> place, const Numbers& value) {
    if (place) fail("the script clears one of several targets");
    clear(what, value);
}

void runTechnique(Engine& engine) {
    script_player::Technique technique{"", given(engine.techniqueScript()), {}};
    for (const std::string& pass : engine.passes())
        technique.passes.push_back({pass, given(engine.passScript(pass))});
    script_player::play(technique, engine);
}

} // namespace client
