// Pass Fibre, and light on strands as fibres (hlsl/fur/fibre.fxh): the table of a fibre's azimuth, one light on a strand, lamps and
// surroundings. Where there are compute shaders alone: vertex shaders of model 3 have four samplers and 512 slots.
#ifndef TEGUMENT_PASSES_FUR_FIBRE_LIGHT_FXH
#define TEGUMENT_PASSES_FUR_FIBRE_LIGHT_FXH

float gCoatHotSpot < UI_SLIDER("Hot spot", 0.0, 200.0, 1.0)
    string UIHelp = "how soon light and eye part, for each radian between them; 0: never"; > = 45.0;

#ifdef TEGUMENT_COMPUTE
Texture2D gFibreBrightMap : RENDERCOLORTARGET < SQUARE_TARGET(64, "A16B16G16R16F") bool Keeps = true; >;
Texture2D gFibrePathMap : RENDERCOLORTARGET < SQUARE_TARGET(64, "A16B16G16R16F") bool Keeps = true; >;
TG_SAMPLER2D(gFibreBright, LINEAR, CLAMP);
TG_SAMPLER2D(gFibrePath, LINEAR, CLAMP);
TG_STORE2D(gFibreBrightStore)
TG_STORE2D(gFibrePathStore)

// Of the opacity map, as kCoatLayers, kCoatOwn and kCoatSoft, where it counts the strands that light passes.
static const float4 kFibreLayers = float4(0.2, 0.45, 1.0, 4.0);
static const float kFibreOwn = 0.03;
static const float kFibreSoft = 6.0;
static const float kFibreTips = 0.66;     // mean height of tips of a coat that stands upright
static const float2 kFibreLie = float2(1.19, 0.304); // as lockLooks lays its strands, on average
static const float kFibreUnder = 0.45;   // share of a strand's shadow that underfur throws
static const float kFibreLevel = 0.15;   // least cosine of ways through a coat,
static const float kFibreGrazing = 0.02; // and how softly it ends towards the horizon
static const float kFibreDeep = 4.0;     // strands above the skin, along the normal, where nothing counts them
static const float kFibreMost = 10.0;    // strands, whose blur is nearly even

// Height of the opacity map's front, shares of the coat: as tips are on average. Light that grazes a higher one runs through thicknesses
// without strands, of which the layers make an even rise, and the outermost strands are dark.
float fibreFront()
{
    return kFibreTips * (1.0 - kFibreLie.y * min(kFibreLie.x * gCoatLean, 1.75));
}

// What light has passed before it comes to a point of the coat.
struct FibrePassed
{
    float own;    // strands of the coat that the point is in
    float before; // strands of other parts of the body: what they scatter goes elsewhere
    float open;   // share that the skin leaves
};

// height: above the skin, shares of the coat; cosine: of the coat's normal and the light; pixel: as of coatOpacity.
FibrePassed fibrePassed(float3 world, float height, float cosine, float pixel)
{
    float2 place = tgShadowCoordinate(mul(float4(world, 1.0), gLightViewProjection));
    float distance = furFromLight(world);
    float depth = coatDepth(place, distance) - kFibreOwn;
    float front = fibreFront();
    float way = front * tgFurWay(saturate(height / front), cosine, front * gFurLength);
    float all = coatOpacity(place, depth, pixel, kFibreLayers, kFibreSoft);
    FibrePassed passed;
    passed.before = coatOpacity(place, depth - kTgFurOwn.x * way - kTgFurOwn.y, pixel, kFibreLayers, kFibreSoft);
    passed.own = all - passed.before;
    passed.open = coatSkinOpen(place, distance);
    return passed;
}

[numthreads(8, 8, 1)]
void FibreCS(uint3 thread : SV_DispatchThreadID)
{
    float upper = 0.5 * kTgFibreRows;
    float row = (float)thread.y;
    float azimuth = kTgPi * (float)thread.x / (kTgFibreColumns - 1.0);
    float cosine = (row < upper ? row : row - upper) / (upper - 1.0);
    TgFibreTable table = tgFibreTable(azimuth, max(cosine, 0.01), row < upper ? 0.02 : kTgPi);
    gFibrePathStore[thread.xy] = float4(table.path, 0.0, 1.0);
    gFibreBrightStore[thread.xy] = float4(table.bright, 1.0);
}

// A point of a strand. Unit vectors along the mesh's axes.
struct FibrePoint
{
    float3 normal; // of the coat
    float3 tangent;
    float3 toEye;
    float3 albedo; // of the coat
};

// Radiance for each unit of light that comes straight, and of light that fibres before have scattered forward.
struct FibreScattered
{
    float3 straight;
    float3 forward;
};

FibreScattered fibreScattered(FibrePoint p, float3 toLight, float3 absorption, float passed)
{
    float sineLight = dot(p.tangent, toLight);
    float sineEye = dot(p.tangent, p.toEye);
    float cosineLight = sqrt(max(1.0 - sineLight * sineLight, 1e-6));
    float cosineEye = sqrt(max(1.0 - sineEye * sineEye, 1e-6));
    float cosine = clamp((dot(toLight, p.toEye) - sineLight * sineEye) / (cosineLight * cosineEye), -1.0, 1.0);
    float column = (acos(cosine) / kTgPi * (kTgFibreColumns - 1.0) + 0.5) / kTgFibreColumns;
    float row = (cosineEye * (0.5 * kTgFibreRows - 1.0) + 0.5) / kTgFibreRows;
    float4 one = float4(column, row, 0.0, 0.0);
    float4 many = float4(column, row + 0.5, 0.0, 0.0);
    float3 blurred = kTgFibreVariance + kTgFibreBlur * min(passed, kFibreMost);
    FibreScattered scattered;
    scattered.straight = tgFibreScattered(tex2Dlod(gFibreBright, one).xyz, tex2Dlod(gFibrePath, one).xy,
        tgFibreAlong(sineLight, cosineLight, sineEye, cosineEye, kTgFibreVariance), absorption);
    scattered.forward = tgFibreScattered(tex2Dlod(gFibreBright, many).xyz, tex2Dlod(gFibrePath, many).xy,
        tgFibreAlong(sineLight, cosineLight, sineEye, cosineEye, blurred), absorption);
    return scattered;
}

// Cosine of the coat's normal and the light, that does not end at the horizon.
float fibreCosine(float cosine)
{
    return 0.5 * (cosine + sqrt(cosine * cosine + kFibreGrazing));
}

// Of light scattered many times, what a fibre sends to the eye.
float3 fibreField(FibrePoint p, TgFibreField field, float3 albedo)
{
    float3 turned = (1.5 * kTgFibreForward * saturate(dot(p.normal, p.toEye))) * albedo;
    return albedo * max(field.mean + turned * field.up, 0.0);
}

// One light of this direction and colour. straight: chance that no strand stops the light. Several lights are a sum of these.
float3 fibreLight(FibrePoint p, float3 toLight, float3 color, FibrePassed passed, float straight)
{
    float3 absorption = tgFibreAbsorption(p.albedo);
    float3 albedo = tgFibreAlbedo(absorption);
    float3 depth = tgFibreDepth(albedo) * passed.own;
    FibreScattered scattered = fibreScattered(p, toLight, absorption, passed.own);
    float left = exp(-passed.before);
    float3 forward = max(exp(-depth) - exp(-passed.own), 0.0) * left;
    float up = fibreCosine(dot(p.normal, toLight));
    float3 many = left * fibreField(p, tgFibreField(p.albedo, depth * up, up), albedo);
    return color * passed.open * (kTgPi * (straight * scattered.straight + forward * scattered.forward) + many);
}

// As tgFibreStraight. In a flat coat the way to the eye passes as many strands for each unit of depth as that to the light.
float fibreStraight(FibrePoint p, float3 toLight, FibrePassed passed)
{
    float all = passed.own + passed.before;
    float eye = max(dot(p.normal, p.toEye), kFibreLevel);
    float light = max(dot(p.normal, toLight), kFibreLevel);
    float apart = gCoatHotSpot * acos(clamp(dot(toLight, p.toEye), -1.0, 1.0));
    return tgFibreStraight(all, all * light / eye, apart);
}

#if TEGUMENT_LAMPS
// Of a lamp, whose strands are not counted: a coat that is as dense everywhere. Other parts of the body hide nothing.
FibrePassed fibrePassedByLamp(float height, float cosine)
{
    FibrePassed passed;
    passed.own = kFibreDeep * (1.0 - height) / max(cosine, kFibreLevel);
    passed.before = 0.0;
    passed.open = saturate(1.0 + cosine / kFibreLevel);
    return passed;
}

// height: in the coat.
float3 fibreLamps(FibrePoint p, float3 world, float height, TgVertexInput input)
{
    float3 sum = 0.0;
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, world, 1.0);
        float3 toLight = strandsAxes(lamp.toLight, input);
        FibrePassed passed = fibrePassedByLamp(height, dot(p.normal, toLight));
        sum += fibreLight(p, toLight, lamp.light, passed, fibreStraight(p, toLight, passed));
    }
    return sum;
}
#endif

// What comes from around to a coat that looks there: of the cube map, or thrown back by what stands around, as for other coats. normal: of
// the world.
float3 fibreAround(float3 normal)
{
#if TEGUMENT_SURROUNDINGS
    return surroundingsAt(normal, kTgSurroundingsDiffuse);
#else
    return gLightColor * lerp(gCoatSky, gCoatGround, 0.5 + 0.5 * dot(normal, gFurDown));
#endif
}

// height: in the coat.
float3 fibreSurroundings(FibrePoint p, float3 normal, float height)
{
    float3 albedo = tgFibreAlbedo(tgFibreAbsorption(p.albedo));
    TgFibreField field = tgFibreFieldAround(p.albedo, tgFibreDepth(albedo) * (kFibreDeep * (1.0 - height)));
    return fibreAround(normal) * fibreField(p, field, albedo);
}

CoatFrontVarying FibreFrontVS(TgVertexInput input)
{
    return coatFrontVarying(input, fibreFront());
}

float4 FibreOpacityPS(OpacityVarying input) : SV_Target0
{
    return opacityBefore(input, kFibreLayers);
}
#endif

#endif
// SPDX-License-Identifier: MIT
