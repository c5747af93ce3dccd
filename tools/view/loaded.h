#pragma once
// An effect and what it has on the device.

#include "host/adopt/adopt.h"
#include "host/run/session.h"

#include <memory>
#include <utility>
#include <vector>

namespace tegument::view {

struct Loaded {
    /// `before`: of the same scene.
    Loaded(gpu::Device& device, std::shared_ptr<const Adoption> read, const std::shared_ptr<const void>& scene, const SessionScene& parts,
           const Loaded* before = nullptr)
        : keeps(scene), source(std::move(read)), effect(source->effect), bindings(source->bindings),
          session(device, effect, parts, before ? &before->session : nullptr) {}
    Loaded(const Loaded&) = delete;
    Loaded& operator=(const Loaded&) = delete;

    std::shared_ptr<const void> keeps;      // the session's scene
    std::shared_ptr<const Adoption> source; // several may have it
    const Effect& effect;
    const std::vector<ParameterBinding>& bindings; // of an effect of another host
    EffectSession session;
};

} // namespace tegument::view
