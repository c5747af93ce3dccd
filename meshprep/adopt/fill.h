#pragma once
// Textures that an effect computes itself: the annotation Function names a function of texture coordinates and the size of a texel.

#include "host/effect/model.h"
#include "meshprep/adopt/rewrite.h"

#include <optional>
#include <string>

namespace tegument::adopt {

/// The function that fills the texture; empty where none does, or where this host cannot make such a target: cubes and volumes.
[[nodiscard]] std::string fillingFunction(const Parameter& texture, const Rewriter& rewriter);

/// Makes the texture a target of the size that its annotations say, and a pass that fills it.
[[nodiscard]] Pass fillingPass(Parameter& texture, const std::string& function, const Rewriter& rewriter);

/// Runs the pass before everything else that the technique does.
void fillFirst(Technique& technique, const std::string& texture, Pass pass);

} // namespace tegument::adopt
