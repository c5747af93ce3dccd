#pragma once
// What of a session's next frame needs no device, so that any thread can make it: shaders compiled, textures loaded, of the effect and of
// those that draw textures for it.

#include "host/run/producers.h"

namespace tegument::run {

/// What the session, or the one before it, has already.
struct Known {
    Programs programs; // of the same effect, read once; else none
    std::set<std::string> uploaded;
};

struct Ahead {
    Programs programs;
    Producers producers;
    std::map<std::string, TextureData> textures; // by key
    std::map<std::string, Bake> bakes;           // by name: those that were made now
    std::vector<Diagnostic> warnings;
};

/// Effect and scene stay where they are meanwhile. RunOptions::pieces is asked between two shaders: an error for which isGivenUp() holds.
[[nodiscard]] Result<Ahead> prepareAhead(const Effect& effect, const SessionScene& scene, const Workspace& workspace,
                                         const RunOptions& options, const Known& known);

} // namespace tegument::run
