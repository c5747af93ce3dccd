// How far a pyramid goes where links bring the widest Gaussians. A head needs no more than a few levels; a small body that fills its maps,
// such as a ball of 10 mm, needs all.
#ifndef TEGUMENT_PASSES_COARSE_LEVELS_FXH
#define TEGUMENT_PASSES_COARSE_LEVELS_FXH

int gCoarseLevels < string UIName = "All levels beside links"; string UIWidget = "CheckBox"; int UIMin = 0; int UIMax = 1;
    string UIHelp = "0 saves passes where texels are larger than 1/6 mm (maps of 1024) or 1/3 mm (maps of 512)"; > = 1;

// Last level of the pyramid beside links, without the coarse ones.
static const float kFineTop = TEGUMENT_MAP_SIZE >= 2048 ? 3.0 : 2.0;

float linkedTop()
{
    return gCoarseLevels > 0 ? kTgLadderTop : kFineTop;
}

#endif
// SPDX-License-Identifier: MIT
