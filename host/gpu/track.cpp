#include "host/gpu/track.h"

namespace tegument::gpu::detail {

namespace {

template <class Flags>
bool contains(Flags all, Flags some) {
    return (all & some) == some;
}

std::optional<Dependency> advanceRead(Track& track, const Use& use) {
    const bool waited = contains(track.readStages, use.stages) && contains(track.readAccess, use.reads);
    track.readStages |= use.stages;
    track.readAccess |= use.reads;
    if (waited || !track.writeStages) return std::nullopt;
    return Dependency{track.writeStages, track.writeAccess, track.layout};
}

} // namespace

std::optional<Dependency> advance(Track& track, const Use& use) {
    const bool sameLayout = track.layout == use.layout;
    if (sameLayout && !use.writes) return advanceRead(track, use);

    const Dependency dependency{track.writeStages | track.readStages, track.writeAccess, track.layout};
    track = Track{.layout = use.layout, .writeStages = use.stages, .writeAccess = use.writes};
    // A layout change is itself a write, already available when the stages that asked for it begin: later reads wait for those stages.
    if (!use.writes) {
        track.readStages = use.stages;
        track.readAccess = use.reads;
    }
    if (sameLayout && !dependency.stages) return std::nullopt;
    return dependency;
}

} // namespace tegument::gpu::detail
