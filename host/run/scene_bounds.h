#pragma once
// Where a session's scene is, and its camera and light in the world. Needs no GPU.

#include "host/run/run_options.h"

namespace tegument::run {

/// Of the mesh, or of all objects where they stand, in mm; without either the unit sphere, as semantics have it.
[[nodiscard]] Bounds boundsOf(const SessionScene& scene);

/// The workspace with camera and light in world millimetres, whatever their frames were: they can be moved on. Planes that were fitted stay
/// to be fitted.
[[nodiscard]] Workspace inWorld(const Workspace& workspace, const SessionScene& scene);

} // namespace tegument::run
