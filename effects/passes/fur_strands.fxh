// Pass Strands: each layer sweeps the ray's way down to the next layer, through all strands near it. Lengths in spacings of the strands,
// heights in shares of the coat; places in the mesh's own axes.
#ifndef TEGUMENT_PASSES_FUR_STRANDS_FXH
#define TEGUMENT_PASSES_FUR_STRANDS_FXH

static const float kFurStep = 1.0;        // that one step of a sweep goes along the skin
static const float kFurMostSteps = 8.0;   // of a sweep; what lies beyond is taken as covered as it is to be expected
static const float kFurOpaque = 0.99;      // coverage beyond which nothing further down is looked for
static const float kFurFarSegment = 64.0; // added to gFurSegment where only coverage is expected
static const float kFurLeastCosine = 0.01; // between ray and layer, at which a ray goes on for longest
// The same where only coverage is expected: a pixel holds several strands, the skin bends within it, and one triangle's tilt is noise. The
// longest way is 1 / (2 c), three coats: what a ball of 4.5 coats' radius lets a ray go, sqrt(2 R H).
static const float kFurFarCosine = 1.0 / 6.0;
static const float kFurNearest = 1e-4; // that light is, share of the mesh's radius

// All that shader model 3 has room for. centroid and plain: as in FurVarying; what is the same everywhere takes the places that are left.
// xyz are what the members are called; w is read by the functions below.
struct StrandsVarying
{
    float4 position : SV_Position;
    centroid float4 rest : TEXCOORD0;    // place of the skin below, spacings; strandsLayersAbove
    centroid float4 normal : TEXCOORD1;  // strandsHeight
    centroid float4 fromEye : TEXCOORD2; // spacings; strandsPixel
    centroid float4 toLight : TEXCOORD3; // mm; strandsSpare
    centroid float4 lightClip : TEXCOORD4;
    centroid float4 lean : TEXCOORD5; // of the tips, share of the coat; strandsDensity
    centroid float4 coat : TEXCOORD6; // strandsLeast, strandsThickness, strandsShortest, strandsPerLength
    float4 plainRest : TEXCOORD7;     // strandsData, here and in the next two
    float4 plainNormal : TEXCOORD8;
    float4 plainFromEye : TEXCOORD9;
};

// Layers above this one, and a half.
float strandsLayersAbove(StrandsVarying input)
{
    return input.rest.w;
}

// Of the layer in the coat: 0 skin, 1 tips.
float strandsHeight(StrandsVarying input)
{
    return input.normal.w;
}

// Width of a pixel, spacings.
float strandsPixel(StrandsVarying input)
{
    return input.fromEye.w;
}

// How often layers may be halved here (tgFurSpare).
float strandsSpare(StrandsVarying input)
{
    return input.toLight.w;
}

// Share of the full density of strands.
float strandsDensity(StrandsVarying input)
{
    return input.lean.w;
}

// As in tgFurPath.
float strandsLeast(StrandsVarying input)
{
    return input.coat.x;
}

// Of the coat, spacings.
float strandsThickness(StrandsVarying input)
{
    return input.coat.y;
}

// Shortest strand, share of the longest.
float strandsShortest(StrandsVarying input)
{
    return input.coat.z;
}

// 1 / mean length of strands, share of the longest.
float strandsPerLength(StrandsVarying input)
{
    return input.coat.w;
}

// Of the roots: 1 / spacing, 1/mm; radius of a strand, spacings, over that of the data, mm; 1 / length of the coat, 1/mm, times the round.
float3 strandsData(StrandsVarying input)
{
    return float3(input.plainRest.w, input.plainNormal.w, input.plainFromEye.w);
}

// Of fur_rounds.fxh, times what is above 0.
float strandsRound(StrandsVarying input)
{
    return input.plainFromEye.w;
}

// What grows at a vertex.
struct FurGrowth
{
    float3 place;     // of the vertex, spacings: in the axes of the strands' data
    float3 lean;      // besides their weight, along the mesh's axes
    float density;    // share of the full one
    float spacing;    // world units
    float shortest;   // strand, share of the longest
    float3 data;      // of the roots, as strandsData, without the round
};

// The ray's way from a layer to the next, and how it is walked.
struct FurSweep
{
    TgFurPath path;
    float3 place;  // over the skin
    float3 normal;
    float3 view;   // unit
    float height;  // of the layer,
    float bottom;  // and of the one below
    float end;     // of the path,
    float step;    // how far along it one goes at once,
    float steps;   // and how often, rounded down; below 0: other layers cover this one's part
    float width;   // of a pixel
    float fade;    // from strands to expected coverage
    float beyond;  // what the steps leave of the way
};

// A straight piece of it in (place, height), from begin to end.
struct FurPiece
{
    float3 begin;
    float3 end;
    float3 along; // tangential
    float top;
    float low;
    float2 bend;   // of a strand's axis at the top: along its own side, and across it,
    float2 bendLow;
    float reach; // how far from its middle roots may stand whose strands it meets
};

// From strands to expected coverage. width: of a pixel, spacings.
float furFade(float width)
{
    return saturate(width - 1.0);
}

// Directions are turned into the mesh's own axes here, where they change evenly across a triangle. round: of fur_rounds.fxh.
StrandsVarying strandsVarying(TgVertexInput input, float layer, FurGrowth growth, float round)
{
    float height = tgFurLayerHeight(layer, gFurLayers, 0.0);
    FurVarying coat = furVarying(input, float2(height, 1.0), round);
    float3 leaning = furFromAxes(vertexTurned(growth.lean, input)) * tgFurDistance(gFurLength, gMeshRadius, height) * height;
    float3 world = coat.world + leaning;
    float4 position = mul(float4(world, 1.0), gViewProjection);
    position.z = tgFurNearDepth(position.z, position.w);
    float thickness = max(gFurLength * gMeshRadius / growth.spacing, 1.0);
    float3 fromEye = strandsAxes(world - gCameraPosition, input) / growth.spacing;
    float width = 2.0 * tan(0.5 * gCameraFov) / gViewportSize.x * length(fromEye);
    float3 normal = strandsAxes(tgWorldNormal(coat.normal), input);
    // By the upright coat, for that alone is the same for all layers.
    float cosine = dot(tgSafeNormalize(fromEye), normal);
    float upright = thickness * tgFurSine(cosine) / max(-cosine, kFurLeastCosine);
    StrandsVarying output;
    output.position = TG_HALF_PIXEL(position, gViewportSize);
    output.rest = float4(growth.place, gFurLayers - 0.5 - layer);
    output.normal = float4(normal, height);
    output.fromEye = float4(fromEye, width);
    // Tips before the near plane of parallel light have the light before them all the same.
    float3 toLight = strandsAxes(ownLight(world).toLight, input) * max(furFromLight(world), kFurNearest * tgMillimetres(gMeshRadius));
    output.toLight = float4(toLight, tgFurSpare(gFurLayers, upright, gFurSegment + furFade(width) * kFurFarSegment, gFurFewest));
    output.lightClip = mul(float4(world, 1.0), gLightViewProjection);
    output.lean = float4(growth.lean + strandsAxes(furHang(), input), growth.density);
    float least = lerp(kFurLeastCosine, kFurFarCosine, furFade(width));
    output.coat = float4(least * least, thickness, min(growth.shortest, 0.999), 2.0 / (1.0 + growth.shortest));
    output.plainRest = float4(growth.place, growth.data.x);
    output.plainNormal = float4(normal, growth.data.y);
    output.plainFromEye = float4(fromEye, round * growth.data.z);
    return output;
}

// From a strand's root to its axis at this height: its stray along its own side, and one of its turns, which begin at that side.
float2 furBend(float height)
{
    float2 turn = tgFurWave(gFurTurns * height + float3(0.0, 0.75, 0.5)).xy; // as cosine and sine
    return height * (float2(gFurScatter * height, 0.0) + gFurCurls * turn);
}

// Adds one strand to what a sweep has met: x coverage; y to w shares of coverage times height in the coat, place along the strand (0 root,
// 1 tip), brightness. root: way from it to the piece's begin, tangential. share: of the coat's height. stray: share of what strands bend.
// random: of the strand, in (0, 1).
float4 furMeet(float4 met, FurSweep sweep, FurPiece piece, float3 root, float share, float radius, float stray, float3 random)
{
    float3 side = random - 0.5;
    side = stray * tgFurAlong(side - sweep.normal * dot(side, sweep.normal));
    float3 across = cross(sweep.normal, side);
    float2 unbend = piece.bendLow - piece.bend;
    float3 from = root - piece.bend.x * side - piece.bend.y * across;
    float3 along = piece.along - unbend.x * side - unbend.y * across;
    float drop = piece.top - piece.low;
    float2 covered = tgFurCone(from, along, radius * (1.0 - piece.top / share), radius * drop / share, sweep.width);
    float height = piece.top - drop * covered.y;
    float tint = 1.0 + gFurVariation * (random.z - 0.5);
    return met + (covered.x - met.x * covered.x) * float4(1.0, height, saturate(height / share), tint);
}

// Coverage to expect takes the place of what lies beyond the steps of a sweep and, as strands grow thinner than pixels (fade), of all.
// density: per square spacing; shortest: strand, share of the longest; perLength: 1 / the mean one, likewise.
float4 furExpect(float4 met, float fade, float density, float shortest, float perLength, float2 heights, float way)
{
    float2 radius = gFurRadius * tgFurMeanRadius(heights, shortest);
    // Strands are met as often as they are wide: the mean height where the width changes evenly.
    float height = dot(2.0 * radius + radius.yx, heights) / (3.0 * radius.x + (3.0 * radius.y + 1e-4));
    float along = saturate(height * perLength);
    met *= 1.0 - fade;
    return met + (1.0 - met.x) * tgFurExpected(density, radius, way) * float4(1.0, height, along, 1.0);
}

// 1 / distance from the eye, per spacing.
float strandsNearness(StrandsVarying input)
{
    return rsqrt(dot(input.fromEye.xyz, input.fromEye.xyz));
}

float4 CoatEndPS(StrandsVarying input) : SV_Target0
{
    return float4(strandsNearness(input), 0.0, 0.0, 1.0);
}

FurSweep furSweep(StrandsVarying input, float2 pixel)
{
    FurSweep sweep;
    sweep.normal = tgFurAlong(input.normal.xyz);
    float nearness = strandsNearness(input);
    sweep.view = input.fromEye.xyz * nearness;
    sweep.place = input.rest.xyz;
    sweep.height = strandsHeight(input);
    sweep.width = strandsPixel(input);
    sweep.fade = furFade(sweep.width);
    float stride = tgFurStride(strandsSpare(input));
    sweep.bottom = max(sweep.height - stride / gFurLayers, 0.0);

    float depth = sweep.height - sweep.bottom;
    TgFurSlopes slopes;
    slopes.normalAcross = ddx(input.plainNormal.xyz);
    slopes.normalDown = ddy(input.plainNormal.xyz);
    slopes.across = ddx(input.plainFromEye.xyz);
    slopes.down = ddy(input.plainFromEye.xyz);
    slopes.placeAcross = ddx(input.plainRest.xyz);
    slopes.placeDown = ddy(input.plainRest.xyz);
    float3 strand = sweep.normal + (sweep.height + sweep.bottom) * input.lean.xyz;
    sweep.path = tgFurPath(sweep.view, strand, strandsThickness(input), strandsLeast(input), slopes);

    sweep.end = tgFurFall(sweep.path.bow, depth);
    float way = length(sweep.path.travel) * sweep.end;
    float pieces = min(way / kFurStep, kFurMostSteps - 1.0) + 1.0;
    sweep.step = sweep.end / max(way / kFurStep, 1.0);
    sweep.beyond = max(way - kFurMostSteps * kFurStep, way * sweep.fade);
    sweep.steps = frac(strandsLayersAbove(input) / stride) < 1.0 / stride ? (sweep.fade < 1.0 ? pieces : 0.0) : -1.0;
    sweep.steps = furInRound(nearness, pixel, strandsRound(input)) < 0.0 ? -1.0 : sweep.steps;
    return sweep;
}

FurPiece furFirstPiece()
{
    FurPiece piece;
    piece.begin = 0.0;
    piece.end = 0.0;
    piece.along = 0.0;
    piece.top = 0.0;
    piece.low = 1.0;
    piece.bend = 0.0;
    piece.bendLow = 0.0;
    piece.reach = 0.0;
    return piece;
}

// The piece from where the last one ends to where the path has come after so many steps. Places are those in the strands' own lattice, in
// which tufts lean together.
FurPiece furNextPiece(FurPiece last, FurSweep sweep, float steps)
{
    float drop = min(steps * sweep.step, sweep.end);
    FurPiece piece;
    piece.begin = last.end;
    piece.top = last.low;
    piece.bend = last.bendLow;
    piece.low = sweep.height - tgFurFallen(sweep.path.bow, drop);
    piece.bendLow = furBend(piece.low);
    float3 place = sweep.place + sweep.path.travel * drop;
    float3 tuft = gFurTufts * piece.low * piece.low * tgFurTuft(place / gFurTuftSize);
    float sink = 0.5 * drop * drop * dot(sweep.path.travel, sweep.path.turn); // as the skin bends away
    piece.end = place + tuft - sweep.normal * (dot(tuft, sweep.normal) + sink);
    piece.along = piece.end - piece.begin;
    piece.along -= sweep.normal * dot(piece.along, sweep.normal);
    float stray = gFurRadius * (1.0 - piece.low) + piece.top * (gFurScatter * piece.top + gFurCurls);
    piece.reach = stray + sweep.width + 0.5 * length(piece.along);
    return piece;
}

// What strands send to the eye. met: as furMeet.
float3 furStrandRadiance(StrandsVarying input, FurSweep sweep, float4 met)
{
    float3 mean = met.yzw / met.x;
    float3 albedo = lerp(gFurRootColor, gFurTipColor, mean.y) * mean.z;
    float3 strand = tgFurAlong(sweep.normal + 2.0 * mean.x * input.lean.xyz);
    float perDistance = rsqrt(dot(input.toLight.xyz, input.toLight.xyz));
    float3 toLight = input.toLight.xyz * perDistance;
    float open = furSkinShadow(input.lightClip, 1.0 / perDistance) *
                 tgFurTransmittance(mean.x, dot(sweep.normal, toLight), gFurDensity, gFurLength);
    float3 direct = furStrandLight(albedo, strand, toLight, -sweep.view) * gLightColor * open;
    return direct + albedo * gFurFill * tgFurFill(mean.x, gFurDensity, gFurMultiple);
}

// The layer's colour and coverage; only what is drawn is lit. met: as furMeet; last: the last piece. density: as furExpect.
float4 furStrandColor(StrandsVarying input, FurSweep sweep, FurPiece last, float4 met, float density)
{
    float top = lerp(last.low, sweep.height, sweep.fade);
    met = furExpect(met, sweep.fade, density * strandsDensity(input), strandsShortest(input), strandsPerLength(input),
                    float2(top, sweep.bottom), sweep.beyond);
    float left = sweep.steps < 0.0 ? -1.0 : met.x - 0.004; // an 8-bit target would not show it
    float4 color = float4(0.0, 0.0, 0.0, met.x);
    [branch] if (left >= 0.0 || !TG_LEAVES_EARLY)
        color.rgb = furStrandRadiance(input, sweep, met);
    clip(left);
    return color;
}

#endif
// SPDX-License-Identifier: MIT
