#include "tools/view/reading.h"

#include "tools/view/state.h"

#include <fmt/format.h>

namespace tegument::view {

namespace {

ReadAhead readAhead(ToRead asked) {
    if (!asked.source) {
        auto effect = readEffect(asked.file, asked.load, asked.adopt);
        if (!effect) return {.source = nullptr, .ahead = effect.error()};
        asked.source = std::make_shared<const Adoption>(std::move(*effect));
    }
    const Effect& effect = asked.source->effect;
    asked.run.technique = techniqueOf(effect, asked.run.technique);
    std::erase_if(asked.run.parameters, [&](const auto& value) { return !effect.findParameter(value.first); }); // of the text before
    return {.source = asked.source, .ahead = run::prepareAhead(effect, asked.scene, asked.workspace, asked.run, asked.known)};
}

} // namespace

Result<Adoption> readEffect(const std::filesystem::path& file, const LoadOptions& load, const AdoptOptions& adopt) {
    auto effect = loadEffect(file, load);
    if (!effect) return effect.error();
    return adopted(std::move(*effect), adopt);
}

Reading::Reading(ToRead asked) {
    asked.run.pieces = {.goOn = [shared = shared_] { return shared->goOn.load(); }};
    asked.run.coarser = {};
    asked.run.compiling = [shared = shared_](std::size_t done, std::size_t total) {
        shared->shaders = total;
        shared->compiled = done;
    };
    result_ = std::async(std::launch::async, readAhead, std::move(asked));
}

Reading::~Reading() {
    giveUp();
    if (result_.valid()) result_.wait();
}

std::string Reading::progress() const {
    const std::size_t shaders = shared_->shaders;
    const std::size_t compiled = shared_->compiled;
    return compiled < shaders ? fmt::format("shader {} of {}", compiled + 1, shaders) : std::string();
}

} // namespace tegument::view
