// The maps that Atlas.fx makes of a mesh.
#ifndef TEGUMENT_PASSES_ATLAS_FXH
#define TEGUMENT_PASSES_ATLAS_FXH

Texture2D gAtlasPositionMap < string Producer = "Atlas.fx/gAtlasPositionMap"; string ResourceName = "atlas_position.dds"; >;
Texture2D gAtlasNormalMap < string Producer = "Atlas.fx/gAtlasNormalMap"; string ResourceName = "atlas_normal.dds"; >;
Texture2D gAtlasMeshNormalMap < string Producer = "Atlas.fx/gAtlasMeshNormalMap"; string ResourceName = "atlas_mesh_normal.dds"; >;
Texture2D gAtlasMetricMap < string Producer = "Atlas.fx/gAtlasMetricMap"; string ResourceName = "atlas_metric.dds"; >;
TG_SAMPLER2D(gAtlasPosition, POINT, CLAMP);
TG_SAMPLER2D(gAtlasNormal, POINT, CLAMP);
TG_SAMPLER2D(gAtlasMeshNormal, POINT, CLAMP);
TG_SAMPLER2D(gAtlasMetric, POINT, CLAMP);

#endif
// SPDX-License-Identifier: MIT
