// Techniques Strands and StrandsSoft: the strands of FurRoots' technique Roots, lit as there, as ribbons.
#ifndef TEGUMENT_PASSES_FUR_ROOT_STRANDS_FXH
#define TEGUMENT_PASSES_FUR_ROOT_STRANDS_FXH

static const float kStrandTuftSteps = 3.0; // from a root on; less from where a tuft is known near by
// Strands of few pixels: whole below so many, from twice as many on not; and how far their ribbons then face as their chords do. Along the
// chord alone parts that cross it would cover too little.
static const float kStrandFew = 4.0;
static const float kStrandChord = 0.6;
static const float kStrandBefore = 0.02; // of the coat: from there to the axis runs its tangent

// As FurRoots bends it. Lengths in mm.
struct RootStrand
{
    float3 root;
    float3 normal;
    float3 lean;   // of the tip, shares of the coat
    float3 side;   // of its turns and strays, times its curl
    float3 across;
    float coat;    // its height
    float spacing;
    float share;   // of that height
    float radius;
    float tint;
#if TEGUMENT_FUR_CURVES
    float curve; // curveFirst
#endif
};

RootStrand rootStrand(TgVertexInput input, float4 ball, float rows)
{
    float2 texel = tgFurTexel(input.uv.y, rows);
    float4 place = furRootTexel(texel, 0.0);
    float4 up = furRootTexel(texel, 1.0);
    float4 lean = furRootTexel(texel, 2.0);
    float4 strands = furRootsHeader(3.0);
    float3 random = frac(lean.w * float3(1.0, 256.0, 65536.0));
    RootStrand strand;
    strand.root = place.xyz;
    strand.normal = input.normal;
    strand.spacing = rsqrt(max(strands.w, 1e-10));
    strand.coat = max(gFurLength * ball.w, 1e-20);
    strand.share = max(min(length(up.xyz), up.w / strand.coat), 0.01);
    strand.radius = place.w * gFurRadius / strands.y * strand.spacing;
    float curl = dot(lean.xyz, strand.normal);
    float3 side = random - 0.5;
    strand.side = curl * tgFurAlong(side - strand.normal * dot(side, strand.normal));
    strand.across = cross(strand.normal, strand.side);
    strand.lean = lean.xyz - strand.normal * curl + strandsAxes(furHang(), input);
    strand.tint = 1.0 + gFurVariation * (random.z - 0.5);
#if TEGUMENT_FUR_CURVES
    strand.curve = curveFirst(input.uv.y);
#endif
    return strand;
}

// From the root's axis at this height to where the strand is. Height 0: the root. tuft: how far aside, spacings, once it has been found;
// before, a guess, from which `steps` rounds lead there.
float3 rootStrandBend(RootStrand strand, float height, float steps, inout float3 tuft)
{
    float2 turn = tgFurWave(gFurTurns * height + float3(0.0, 0.75, 0.5)).xy;
    float2 bend = height * (float2(gFurScatter * height, 0.0) + gFurCurls * turn);
    float3 stray = bend.x * strand.side + bend.y * strand.across;
    // FurRoots looks its strands up at a place that goes aside by the tuft there: the place from which it comes to this one.
    float3 place = strand.root / strand.spacing + stray;
    [unroll] for (float i = 0.0; i < steps; i += 1.0)
    {
        tuft = gFurTufts * height * height * tgFurTuft((place - tuft) / gFurTuftSize);
        tuft -= strand.normal * dot(tuft, strand.normal);
    }
    return strand.coat * height * (strand.normal + height * strand.lean) + strand.spacing * (stray - tuft);
}

#if TEGUMENT_LAMPS
// By lamps; of them the coat hides what it hides, other parts of the body nothing.
float3 rootStrandLamps(RootStrand strand, float3 albedo, float3 axis, float height, float3 toEye, float3 world, TgVertexInput input)
{
    float3 sum = 0.0;
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, world, 1.0);
        float3 toLight = strandsAxes(lamp.toLight, input);
        float open = tgFurTransmittance(height, dot(strand.normal, toLight), gFurDensity, gFurLength);
        sum += furStrandLight(albedo, axis, toLight, toEye) * lamp.light * open;
    }
    return sum;
}
#endif

// Radiance: as furStrandColor of fur_strands.fxh.
float3 rootStrandColor(RootStrand strand, RibbonFrame frame, float3 offset, float along, TgVertexInput input)
{
    float3 albedo = lerp(gFurRootColor, gFurTipColor, along) * strand.tint;
#if TEGUMENT_FUR_CURVES
    float height = saturate(dot(offset, strand.normal) / (strand.coat * frame.perMm));
    float3 axis = curvePlace(strand.curve, along, 1.0).tangent;
#else
    float height = along * strand.share;
    float3 axis = tgFurAlong(strand.normal + 2.0 * height * strand.lean);
#endif
    float3 world = ribbonWorld(frame, offset, input);
    float3 toLight = tgSafeNormalize(ribbonToLight(frame, offset)) + strandsAxes(ownLightTurned(world), input);
    float4 lightClip = mul(float4(world, 1.0), gLightViewProjection);
    float open = ownVisibility(world, float3(0.0, 0.0, 0.0), furSkinShadow(lightClip, furFromLight(world))) *
                 tgFurTransmittance(height, dot(strand.normal, toLight), gFurDensity, gFurLength);
    float3 direct = furStrandLight(albedo, axis, toLight, tgSafeNormalize(frame.toEye - offset)) * ownLight(world).color * open;
    return WITH_LAMPS(direct + albedo * gFurFill * tgFurFill(height, gFurDensity, gFurMultiple),
                      rootStrandLamps(strand, albedo, axis, height, tgSafeNormalize(frame.toEye - offset), world, input));
}

#if TEGUMENT_FUR_CURVES
RibbonPlace strandPlace(RootStrand strand, RibbonFrame frame, float along)
{
    return curvePlace(strand.curve, along, frame.perMm);
}
#else
RibbonPlace strandPlace(RootStrand strand, RibbonFrame frame, float along)
{
    float height = along * strand.share;
    float3 tuft = 0.0;
    RibbonPlace place;
    place.offset = rootStrandBend(strand, height, kStrandTuftSteps, tuft);
    place.tangent = (place.offset - rootStrandBend(strand, height - kStrandBefore, 2.0, tuft)) / (kStrandBefore * strand.coat);
    place.offset *= frame.perMm;
    // A strand that points at the eye turns back in the picture, and its ribbon turns over: where it is hardly longer than it is drawn wide
    // that covers far more than the strand does.
    float3 chord = strand.normal + strand.share * strand.lean;
    float few = strand.coat * strand.share * frame.perMm * rsqrt(dot(frame.toEye, frame.toEye)) / (kStrandFew * ribbonPixel());
    place.tangent += (kStrandChord * saturate(2.0 - few)) * (chord - place.tangent);
    return place;
}
#endif

// As it is drawn: those that are stand for all.
float strandRadius(RootStrand strand, RibbonFrame frame, float along)
{
#if TEGUMENT_FUR_CURVES
    return curveRadius(strand.curve, along, frame.perMm) / gFurShare;
#else
    return strand.radius * frame.perMm * (1.0 - along) / gFurShare;
#endif
}

// core: only where a part of the strand is wide enough for pass Core.
RibbonVarying strandVarying(TgVertexInput input, bool core)
{
    RibbonVarying output = ribbonNowhere();
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    // Of a root, spacings, shares of the widest: those that are drawn stand for all.
    float widest = gFurRadius * rsqrt(max(furRootsHeader(3.0).w, 1e-10)) * frame.perMm / gFurShare;
    [branch] if (ribbonDrawn(input, tgRibbonRank(input.uv.y), gFurShare) && !(core && ribbonThin(frame, widest)))
    {
        RootStrand strand = rootStrand(input, ball, furRootsHeader(2.0).x);
        float along = tgRibbon(input.uv.x).along;
        RibbonPlace place = strandPlace(strand, frame, along);
        float3 color = rootStrandColor(strand, frame, place.offset, along, input);
        float radius = strandRadius(strand, frame, along);
        output = ribbonVarying(input, frame, place.offset, place.tangent, radius, color);
    }
    return output;
}

RibbonVarying StrandsVS(TgVertexInput input)
{
    return strandVarying(input, false);
}

RibbonVarying StrandsCoreVS(TgVertexInput input)
{
    return strandVarying(input, true);
}

#define STRANDS_SHARE RIBBON_SHARE float SegmentFewest = 3.0;
#if TEGUMENT_FUR_CURVES
#define STRANDS_TAPER
#else
#define STRANDS_TAPER float LeastTaper = 1.0;
#endif
#define STRANDS_CORE STRANDS_SHARE string Least = "gRibbonThin"; string LeastSpacings = "gFurRadius"; STRANDS_TAPER
#define STRANDS_SCRIPT LIGHT_SCRIPT(SHADOW_MAP_SCRIPT) \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Skin; Pass=Core; Pass=Fringe;" STRANDS_MOTION_SCRIPT
#define STRANDS_PASSES(core, fringe, coreState) \
    TG_PART_PASS(ShadowMap, "skin", ShadowMapVS, ShadowMapPS, TG_STATE_TWOSIDED) \
    TG_PART_PASS(Skin, "skin", SkinVS, SkinPS, TG_STATE_SOLID) \
    TG_SEEN_PASS(Core, "strands", RIBBON_REACH STRANDS_CORE, StrandsCoreVS, core, coreState) \
    TG_SEEN_PASS(Fringe, "strands", RIBBON_REACH STRANDS_SHARE, StrandsVS, fringe, TG_STATE_FRINGE) \
    STRANDS_MOTION_PASSES

#endif
// SPDX-License-Identifier: MIT
