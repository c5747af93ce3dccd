#pragma once
// An effect that has been drawn at least once.

#include "host/adopt/adopt.h"
#include "host/run/session.h"

#include <memory>
#include <utility>
#include <vector>

namespace tegument::view {

struct Loaded {
    /// `before`: of the same scene.
    Loaded(gpu::Device& device, Adoption source, const std::shared_ptr<const void>& scene, const SessionScene& parts,
           const Loaded* before = nullptr)
        : keeps(scene), effect(std::move(source.effect)), bindings(std::move(source.bindings)),
          session(device, effect, parts, before ? &before->session : nullptr) {}
    Loaded(const Loaded&) = delete; // the session points at the effect
    Loaded& operator=(const Loaded&) = delete;

    std::shared_ptr<const void> keeps; // the session's scene
    Effect effect;
    std::vector<ParameterBinding> bindings; // of an effect of another host
    EffectSession session;
};

} // namespace tegument::view
