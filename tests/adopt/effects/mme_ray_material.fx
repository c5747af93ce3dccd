// In the manner of a physically based renderer for MME: a file of defines for each material, all else in includes
#define ALBEDO_MAP_FROM 3 // 0: none 1: file 3: the material
#define ALBEDO_MAP_UV_FLIP 0
#define ALBEDO_MAP_APPLY_SCALE 0
#define ALBEDO_MAP_FILE "albedo.png"

const float3 albedo = 1.0;
const float2 albedoMapLoopNum = 1.0;

const float smoothness = 0.75;
const float metalness = 0.0;

#include ".\inc\Materials\Material_Common_2.fxsub"
