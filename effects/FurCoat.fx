// FurCoat: fur as strands, each a ribbon that faces the eye. Techniques Strands and StrandsSoft draw the very strands of FurRoots'
// technique Roots; Coat and CoatSoft a coat of locks, with underfur, guard hairs and a deep shadow; CoatChance the same coat of fibres that
// scatter light; StrandsCompute and CoatCompute the Soft ones by compute shaders. The mesh has the parts "strands" and "underfur":
// tegument fur strands makes them (docs/design/modules/FurCoat.md).
#include "../hlsl/platform.fxh"
#include "../hlsl/workspace.fxh"
#include "../hlsl/light.fxh"
#include "../hlsl/fur.fxh"
#include "passes/annotations.fxh"
#if TEGUMENT_FUR_POSE
#include "passes/fur_pose.fxh"
#endif
#include "passes/vertex.fxh"
#include "passes/engine_light.fxh"
#include "passes/own_light.fxh"
#include "passes/shadow_map.fxh"
#include "passes/lamp_light.fxh"
#include "passes/more_light.fxh"
#include "passes/fur_parameters.fxh"
#include "passes/fur_roots_parameters.fxh"
#include "passes/fur_ribbon_parameters.fxh"
#include "passes/fur_roots_map.fxh"
#include "passes/fur_roots_texture.fxh"
#include "passes/fur_rounds.fxh"
#include "passes/fur_coat.fxh"
#include "passes/fur_ribbons.fxh"
#include "passes/fur_curves.fxh"
#include "passes/fur_root_strands.fxh"
#include "passes/fur_lock_parameters.fxh"
#include "passes/relight.fxh"
#include "passes/fur_opacity.fxh"
#include "passes/fur_fibre_light.fxh"
static const float kLockHidden = 0.35; // of a strand, below others
#include "passes/fur_locks.fxh"
#include "passes/fur_motion.fxh"
#include "passes/fur_chance.fxh"
#include "passes/fur_compute.fxh"

float Script : STANDARDSGLOBAL < STARTS_WITH("CoatSoft") string Workspace = "bunny_roots.json"; > = 0.8;

#ifdef FX_TECHNIQUES
// Opaque cores, then blended edges; Soft: cores blended, too.
technique Strands < string Script = STRANDS_SCRIPT; >
{
    STRANDS_PASSES(RibbonCorePS, RibbonFringePS, TG_STATE_TWOSIDED)
}

technique StrandsSoft < string Script = STRANDS_SCRIPT; >
{
    STRANDS_PASSES(RibbonSoftCorePS, RibbonSoftFringePS, TG_STATE_STRAND)
}

technique Coat < string Script = COAT_SCRIPT; >
{
    COAT_PASSES(UnderfurPS, RibbonCorePS, RibbonFringePS, TG_STATE_TWOSIDED)
}

technique CoatSoft < string Script = COAT_SCRIPT; >
{
    COAT_PASSES(UnderfurSoftPS, RibbonSoftCorePS, RibbonSoftFringePS, TG_STATE_STRAND)
}
#endif
#ifdef TEGUMENT_COMPUTE_TECHNIQUES
technique StrandsCompute < string Script = STRANDS_COMPUTE_SCRIPT; >
{
    STRANDS_COMPUTE_PASSES
}

technique CoatCompute < string Script = COAT_COMPUTE_SCRIPT; >
{
    COAT_COMPUTE_PASSES
}

// Strands as fibres, each opaque where chance says so: the same from all sides.
technique CoatChance < string Script = CHANCE_SCRIPT; >
{
    CHANCE_PASSES
}
#endif
// SPDX-License-Identifier: MIT
