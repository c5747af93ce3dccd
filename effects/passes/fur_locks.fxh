// Technique Coat: each root is a lock. Its strands stand around it and come together towards its tip; short, dense underfur below them,
// guard hairs above. They lie along the flow that the strands' vertices bring (TANGENT: its part across the normal).
#ifndef TEGUMENT_PASSES_FUR_LOCKS_FXH
#define TEGUMENT_PASSES_FUR_LOCKS_FXH

static const float kLockSink = 0.15;      // spacings that roots stand below the skin
static const float3 kLockWaves = float3(1.25, 2.6, 13.0); // a coat's waves in a mesh's radius
static const float kLockWrap = 0.4;     // cosine beyond the horizon to which light wanders through the coat
static const float2 kLockShifts = float2(-0.04, 0.26); // of highlights R and TRT, along the normal: 6 and 11 degrees, as tilted scales do,
static const float kLockShift = 0.12;                  // less this of each strand, half of it on average
static const float kLockFade = 8.0;     // one in so many of the strands that are drawn is narrower than it should be
// Where strands hide nothing, what others stand before would be blended over them: there those with underfur below begin at kLockHidden
// (of the effect, shares of their length); from afar, where a pixel shows the mean of many, at the root again. Of what share is left: how
// fast that begins, and how and from where it ends.
static const float3 kLockBeginning = float3(-1.75, 1.05, -0.175);
static const float2 kLockFar = float2(5.0, -0.25); // pixels 0.05 thicknesses wide show places of strands; 0.3 wide, the mean of many
static const float2 kLockMean = float2(0.5, 0.4); // there: place along a strand, height in the coat
static const float kLockHeight = 0.8; // of the tips of a coat that lies, thicknesses
static const float kShadowFirst = 0.5;     // added to ranks of strands that throw shadows: none stands in its own as a rule
static const float kLockOfUnderfur = 64.0; // noise of its own: number of its first strand

// Numbers in (0, 1) of a strand of a lock.
float3 lockNoise(float address, float child)
{
    float row = floor(address / kTgRibbonColumns);
    return tgFurUnit(tgFurMixed(float3(address - kTgRibbonColumns * row, row, 37.0 * child + 11.0)));
}

// Waves of the coat across the mesh. place: radii from its centre.
float3 lockWaves(float3 place)
{
    float3 wave = tgFurWave(kLockWaves.x * place.zxy);
    return tgFurWave(kLockWaves.y * place.yzx + 0.3 + 0.35 * wave) + 0.5 * tgFurWave(kLockWaves.z * place.zxy + 0.1 + 0.5 * wave);
}

// A strand of a lock; lengths in world units, along the mesh's axes.
struct LockStrand
{
    float3 normal;
    float3 flow;    // across it: how far the tip lies along the skin, lengths
    float3 offset;  // of its root from the lock's, across
    float3 base;    // and how far it stands below the skin
    float3 stray;   // of its tip
    float3 side;    // of its turns, radius at the tip, and across
    float3 across;
    float height;   // its length
    float sink;     // how much lower the tip is for it
    float clump;
    float turns;
    float phase;
#if TEGUMENT_FUR_CURVES
    float2 curve; // curveFirst; world units in a mm
#endif
};

// What a vertex knows of its strand.
struct LockLooks
{
    LockStrand strand;
    float3 random;
    float3 more;
    float3 lock;   // noise of the lock
    float3 waves;
    float guard;   // 1: a guard hair
};

#if TEGUMENT_FUR_CURVES
RibbonPlace lockPlace(LockStrand s, float along)
{
    RibbonPlace place = curvePlace(s.curve.x, along, s.curve.y);
    place.offset += s.stray * (along * along);
    return place;
}
#else
RibbonPlace lockPlace(LockStrand s, float along)
{
    float2 bent = along * float2(0.4 + 0.6 * along, 1.0 - s.sink * along); // along the flow, and up
    float2 bending = float2(0.4 + 1.2 * along, 1.0 - 2.0 * s.sink * along);
    float2 apart = float2(1.0 - s.clump * along * along * (3.0 - 2.0 * along), -6.0 * s.clump * along * (1.0 - along));
    float2 turn = tgFurWave(s.turns * along + s.phase + float3(0.0, 0.75, 0.5)).xy; // as cosine and sine, turned by its angle below
    float2 turning = turn + (2.0 * kTgPi * s.turns * along) * float2(-turn.y, turn.x);
    RibbonPlace place;
    place.offset = s.height * (s.normal * bent.y + s.flow * bent.x) + s.offset * apart.x + s.stray * (along * along)
        + along * (turn.x * s.side + turn.y * s.across) - s.base;
    place.tangent = tgFurAlong(s.height * (s.normal * bending.y + s.flow * bending.x) + s.offset * apart.y + s.stray * (2.0 * along)
        + turning.x * s.side + turning.y * s.across);
    return place;
}
#endif

// Of a strand's tip, lengths along the mesh's axes. Gusts run along x, y and z alike, each lock a little by itself.
float3 lockBlownBy(LockLooks looks, TgVertexInput input, float3 wind, float time)
{
    float phase = gCoatGusts.z * dot(furPlace(input) / gMeshRadius, 1.0) + 0.25 * looks.lock.x - gCoatGusts.y * time;
    return wind * (1.0 + gCoatGusts.x * tgFurWave(phase).x);
}

float3 lockBlown(LockLooks looks, TgVertexInput input)
{
    return lockBlownBy(looks, input, strandsAxes(gCoatWind, input), gTime);
}

// under: 1 underfur.
LockLooks lockLooks(TgVertexInput input, RibbonFrame frame, TgRibbon ribbon, float4 ball, float rows, float child, float under)
{
    float2 texel = tgFurTexel(input.uv.y, rows);
    float4 up = furRootTexel(texel, 1.0);
    float spacing = rsqrt(max(furRootsHeader(3.0).w, 1e-10)) * frame.perMm;
    LockLooks looks;
    looks.random = lockNoise(input.uv.y, child);
    looks.more = frac(looks.random.zxy * 13.37 + looks.random.yzx * 7.91);
    looks.lock = frac(furRootTexel(texel, 2.0).w * float3(1.0, 256.0, 65536.0));
    looks.waves = lockWaves((furPlace(input)) / gMeshRadius);
    looks.guard = (1.0 - under) * step(looks.random.z, gCoatGuard);
    LockStrand s;
    s.normal = input.normal;
    float3 aside = tgSafeNormalize(cross(s.normal, abs(s.normal.y) < 0.9 ? float3(0.0, 1.0, 0.0) : float3(1.0, 0.0, 0.0)));
    float3 across = cross(s.normal, aside);
    float2 around = tgFurWave(looks.random.x + float3(0.0, 0.75, 0.5)).xy; // nearly a circle
    float away = sqrt(looks.random.y) * gCoatSpread * spacing;
    s.offset = away * (around.x * aside + around.y * across);
    s.base = kLockSink * spacing * s.normal;
    float thickness = coatThickness();
    float share = max(min(length(up.xyz), up.w * frame.perMm / thickness), 0.05) * (1.0 - gCoatShort * ribbon.shortness);
    s.height = thickness * share
        * (under > 0.5 ? gCoatUnderLength * (0.85 + 0.3 * looks.more.x) : 0.75 + 0.3 * looks.more.x + 0.35 * looks.guard);
    float3 flow = input.tangent.xyz + gCoatWaves * 0.5 * looks.waves + gCoatLocks * (looks.lock - 0.5);
    flow -= s.normal * dot(flow, s.normal);
    float lie = (1.25 * gCoatLean) * (0.7 + 0.15 * looks.waves.z + 0.5 * looks.lock.z) * (1.0 - 0.25 * under);
    s.flow = flow * (lie * rsqrt(1.0 + dot(flow, flow)));
    s.sink = 0.304 * min(lie, 1.75);
    s.clump = gCoatClump * (0.5 + 0.5 * looks.lock.x) * (1.0 - 0.5 * max(looks.guard, under));
#if TEGUMENT_FUR_CURVES
    float3 stray = lockBlown(looks, input);
    s.curve = float2(curveFirst(input.uv.y), frame.perMm);
#else
    float3 stray = (looks.more - 0.5) * (gCoatStray * (1.0 + under)) + lockBlown(looks, input);
#endif
    s.stray = (stray - s.normal * dot(stray, s.normal)) * s.height;
    float curl = gCoatCurl * s.height * (1.0 + under);
    s.side = curl * aside;
    s.across = curl * across;
    s.turns = gCoatTurns * (0.7 + 0.6 * looks.more.y);
    s.phase = looks.random.x;
    looks.strand = s;
    return looks;
}

// Which strands are drawn, and how wide: so many as stay gCoatThin pixels wide, wider than they are. What comes next as one goes away is
// narrower already, so that none appears or vanishes at once.
struct LockShare
{
    float share;
    float rank;
    float width;
    float afar;  // below 0: strands are drawn narrower than gCoatAfar. As the host's Least
    float begin; // place along a strand from which it is drawn; below 0: all of it
};

// thinnest: gCoatThin or gCoatUnderThin. pixel: across it, at the strand. strands: of the lock; the last of them go first. first: is added
// to the root's rank.
LockShare lockShare(TgVertexInput input, float child, float strands, float thinnest, float pixel, float first)
{
    LockShare s;
    float thin = (2.0 * gCoatRadius * gMeshRadius / thinnest) / pixel;
    s.share = gFurShare * clamp(thin, gRibbonFewest, 1.0);
    s.afar = thin - (gCoatAfar / thinnest) * s.share;
    float2 rise = kLockBeginning.xy * thin + float2(-kLockBeginning.x * gCoatAfar / thinnest, kLockBeginning.z);
    s.begin = min(min(rise.x, rise.y), kLockHidden * saturate(gCoatUnderfur));
    s.rank = (child + (first > 0.0 ? frac(tgRibbonRank(input.uv.y) + first) : tgRibbonRank(input.uv.y))) * (1.0 / strands);
    float times = 1.0 / s.share;
    s.width = saturate(kLockFade - kLockFade * s.rank * times) * (kLockFade / (kLockFade - 0.5)) * times;
    return s;
}

// Of a strand, or of the underfur, which lies below strands and has no part that others hide.
LockShare lockShareOf(TgVertexInput input, float child, float under, float pixel)
{
    float strands = under > 0.5 ? gCoatUnderfur : gCoatChildren;
    LockShare s = lockShare(input, child, strands, under > 0.5 ? gCoatUnderThin : gCoatThin, pixel, 0.0);
    if (under > 0.5)
    {
        s.afar = 1.0;
        s.begin = 0.0;
    }
    return s;
}

// Half of a strand's width: even to two thirds of its length, then a point.
float lockRadius(LockLooks looks, float along, float under)
{
#if TEGUMENT_FUR_CURVES
    return curveRadius(looks.strand.curve.x, along, looks.strand.curve.y);
#else
    float radius = gCoatRadius * gMeshRadius * (0.75 + 0.5 * looks.more.y) * (1.0 + 0.3 * looks.guard - 0.25 * under);
    return radius * (1.0 - along * along * along);
#endif
}

// variation: from strand to strand.
float3 lockAlbedo(LockLooks looks, TgRibbon ribbon, float along, float below, float under, float variation)
{
    float belly = gCoatBelly * saturate(1.6 * (below - 0.25) + 0.2 * looks.waves.y);
    float patches = saturate(0.5 + 0.8 * looks.waves.x);
    float3 tip = lerp(gCoatTipColor, 1.2 * gCoatMidColor, 0.5 * patches);
    tip = lerp(tip, gCoatGuardColor, looks.guard * (1.0 - belly));
    float3 albedo = lerp(gCoatRootColor, lerp(gCoatMidColor, 0.75 * gCoatBellyColor, belly), saturate(1.8 * along));
    albedo = lerp(albedo, lerp(tip, gCoatBellyColor, belly), saturate(2.2 * along - 1.0));
    albedo = lerp(albedo, lerp(gCoatUnderColor, 0.6 * gCoatBellyColor, belly), 0.7 * under);
    albedo = lerp(albedo, ribbon.color * (0.35 + 0.65 * along), gCoatPainted);
    albedo *= lerp(1.0, gCoatShortColor, ribbon.shortness);
    float2 tint = 1.0 + variation * (float2(looks.more.x, looks.lock.y) - 0.5);
    return albedo * (tint.x * tint.y) * (1.0 + 0.2 * variation * (looks.random.z - 0.5) * float3(0.0, 0.5, 1.0));
}

// A point of a strand, for light. Unit vectors along the mesh's axes.
struct LockPoint
{
    float3 normal;  // of the coat
    float3 tangent;
    float3 toEye;
    float3 albedo;
    float along;
    float height;   // in the coat, 0 skin, 1 tips
    float shift;    // of the highlights, of this strand
};

// One light of this direction and colour; open: share of it that comes here. Several lights are a sum of these. Underfur is dull.
float3 lockLight(LockPoint p, float3 toLight, float3 color, float open, float under)
{
    float cosine = dot(p.normal, toLight);
    float wrap = saturate((cosine + kLockWrap) / (1.0 + kLockWrap));
    float3 diffuse = p.albedo * (tgFurSine(dot(p.tangent, toLight)) * lerp(1.0, wrap, 0.8));
    if (under > 0.5)
        return color * open * diffuse;
    float2 shifts = kLockShifts - p.shift;
    float2 exponents = float2(gCoatShineExponent, gCoatSheenExponent);
    float2 lobes = tgFurHighlights(p.tangent, p.normal, toLight, p.toEye, shifts, exponents);
    float3 shine = (gCoatShine * lobes.x + gCoatSheen * lobes.y * p.albedo) * (wrap * (0.25 + 0.75 * p.along));
    float against = saturate(-dot(p.toEye, toLight));
    float through = gCoatThrough * against * against * against * against;
    return color * open * (diffuse + shine + through * p.albedo);
}

// Light from all sides, for light of colour 1: of the sky and the ground, less what the coat around hides. up: unit.
float3 lockSurroundings(LockPoint p, float3 up)
{
    float3 shaded = 0.9 * p.normal + 0.36 * p.tangent; // as long as 1 where the tangent stands at 60 degrees
    float2 gaps = lerp(float2(0.2, 0.55), 1.0, saturate(float2(1.1, 1.4) * float2(p.height, p.along)));
    float gap = gaps.x * gaps.y;
    return p.albedo * lerp(gCoatGround, gCoatSky, 0.5 + 0.5 * dot(shaded, up)) * (gap * gap);
}

// Likewise light from behind and above, seen where the coat turns away and only thin fur stops it.
float3 lockRim(LockPoint p, float3 up)
{
    float edge = 1.0 - saturate(dot(p.normal, p.toEye));
    return gCoatRim * (0.05 + p.albedo) * (edge * edge * p.along * saturate(0.6 + 0.4 * dot(p.normal, up)));
}

// 0: a pixel shows places of strands; 1: the mean of many, which is what it is to have then, for else it flickers. pixel: across it.
float lockFar(float pixel)
{
    return saturate(pixel * (kLockFar.x / max(coatThickness(), 1e-20)) + kLockFar.y);
}

#if TEGUMENT_LAMPS
// By lamps; of them the coat hides what lies deep, other parts of the body nothing.
float3 lockLamps(LockPoint p, float3 world, float under, TgVertexInput input)
{
    float3 sum = 0.0;
    [unroll] for (int i = 0; i < TEGUMENT_LAMPS; i++)
    {
        Lamp lamp = lampAt(i, world, 1.0);
        float3 toLight = strandsAxes(lamp.toLight, input);
        float open = exp(-gCoatShadow * (1.0 - p.height)) * saturate(1.0 + dot(p.normal, toLight) / kLockWrap);
        sum += lockLight(p, toLight, lamp.light, open, under);
    }
    return sum;
}
#endif

// What is lit of a strand where the axis is at `offset`, and where that is in the world; from afar, of all strands there. pixel: across it.
struct LockSeen
{
    LockPoint lit;
    float3 world;
    float3 up;
    float pixel;
};

LockSeen lockSeen(LockLooks looks, TgRibbon ribbon, RibbonFrame frame, float3 offset, float3 tangent, float under, TgVertexInput input)
{
    LockSeen s;
    s.pixel = ribbonPixel() * length(frame.toEye);
    float far = lockFar(s.pixel);
    float height = kLockHeight * coatThickness() * (1.0 - gCoatShort * ribbon.shortness);
    float3 seen = lerp(offset, (kLockMean.y / kLockHeight) * height * looks.strand.normal, far);
    s.up = -strandsAxes(gFurDown, input);
    LockPoint p;
#if TEGUMENT_FUR_CURVES
    p.normal = curveNormal(looks.strand.normal, offset, tangent, coatThickness());
#else
    p.normal = looks.strand.normal;
#endif
    p.tangent = tangent;
    p.toEye = tgSafeNormalize(frame.toEye - offset);
    p.along = lerp(ribbon.along, kLockMean.x, far);
    p.height = saturate(dot(seen, looks.strand.normal) / height);
    p.albedo = lockAlbedo(looks, ribbon, p.along, -dot(p.normal, s.up), under, gCoatVariation * (1.0 - far));
    p.shift = kLockShift * looks.more.y;
    s.lit = p;
    s.world = ribbonWorld(frame, seen, input);
    return s;
}

#ifdef TEGUMENT_COMPUTE
float3 fibreColor(LockSeen s, float3 toLight, TgVertexInput input)
{
    FibrePoint p;
    p.normal = s.lit.normal;
    p.tangent = s.lit.tangent;
    p.toEye = s.lit.toEye;
    p.albedo = s.lit.albedo;
    FibrePassed passed = fibrePassed(s.world, kLockHeight * s.lit.height, dot(p.normal, toLight), s.pixel);
    float3 light = ownLight(s.world).color * ownVisibility(s.world, float3(0.0, 0.0, 0.0), 1.0);
    float3 color = fibreLight(p, toLight, light, passed, fibreStraight(p, toLight, passed));
    float3 normal = tgWorldNormal(meshVertex(input).normal);
    color += fibreSurroundings(p, normal, s.lit.height);
    return WITH_LAMPS(color, fibreLamps(p, s.world, s.lit.height, input));
}
#endif

// fibres: by light of fur_fibre_light.fxh, where there is any.
float3 lockColor(LockLooks looks, TgRibbon ribbon, RibbonFrame frame, float3 offset, float3 tangent, float under, bool fibres,
                 TgVertexInput input)
{
    LockSeen s = lockSeen(looks, ribbon, frame, offset, tangent, under, input);
    float3 toLight = tgSafeNormalize(ribbonToLight(frame, offset)) + strandsAxes(ownLightTurned(s.world), input);
#ifdef TEGUMENT_COMPUTE
    if (fibres)
        return fibreColor(s, toLight, input);
#endif
    float open = ownVisibility(s.world, float3(0.0, 0.0, 0.0), coatOpen(s.world, s.pixel));
    float3 lit = lockLight(s.lit, toLight, 1.0, open, under) + lockSurroundings(s.lit, s.up);
    if (under < 0.5)
        lit += lockRim(s.lit, s.up);
    return WITH_LAMPS(lit * ownLight(s.world).color, lockLamps(s.lit, s.world, under, input));
}

RibbonVarying lockVarying(TgVertexInput input, float child, float under, bool fibres)
{
    RibbonVarying output = ribbonNowhere();
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    LockShare share = lockShareOf(input, child, under, ribbonPixel() * length(frame.toEye));
    [branch] if (ribbonDrawn(input, share.rank, share.share) && ribbonSeen(input, frame))
    {
        TgRibbon ribbon = tgRibbon(input.uv.x);
        ribbon.along = max(ribbon.along, share.begin);
        float number = child + kLockOfUnderfur * under;
        LockLooks looks = lockLooks(input, frame, ribbon, ball, furRootsHeader(2.0).x, number, under);
        RibbonPlace place = lockPlace(looks.strand, ribbon.along);
        float3 color = lockColor(looks, ribbon, frame, place.offset, place.tangent, under, fibres, input);
        float radius = share.width * lockRadius(looks, ribbon.along, under);
        output = ribbonVarying(input, frame, place.offset, place.tangent, radius, color);
        output.color.w = share.afar < 0.0 ? -output.color.w : output.color.w;
    }
    return output;
}

RibbonVarying LocksVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockVarying(input, TG_LAYER_INDEX(gFurChild), 0.0, false);
}

RibbonVarying UnderfurVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockVarying(input, TG_LAYER_INDEX(gFurChild), 1.0, false);
}

// Underfur is drawn once: what is below it hides its edges.
float4 UnderfurPS(RibbonVarying input) : SV_Target0
{
    clip(tgRibbonCoverage(ribbonEdge(input)) - max(gFurCut, 0.5));
    return float4(input.color.rgb, 1.0);
}

float4 UnderfurSoftPS(RibbonVarying input) : SV_Target0
{
    float coverage = tgRibbonCoverage(ribbonEdge(input));
    clip(coverage - gFurCut);
    return float4(input.color.rgb, coverage);
}

// From the light: the strands that throw shadows, as opaque as all of their lock. underfur: share of a strand's shadow that each of the
// underfur throws.
OpacityVarying lockOpacity(TgVertexInput input, float child, float underfur)
{
    OpacityVarying output;
    output.position = float4(2.0, 2.0, 2.0, 1.0);
    output.edge = 0.0;
    output.place = float4(0.0, 0.0, 1.0, 0.0);
    float4 ball = furRootsHeader(4.0);
    RibbonFrame frame = ribbonFrame(input, ball);
    float pixel = tgShadowFootprint(mul(float4(frame.world, 1.0), gLightViewProjection).w, tgLightSpread()) / tgMillimetres(1.0);
    // Nor is drawn what a picture as wide as the map would not show.
    float coarser = max(pixel, ribbonPixel() * length(frame.toEye));
    LockShare share = lockShare(input, child, gCoatShadowStrands, gCoatThin, coarser, kShadowFirst);
    [branch] if (ribbonDrawn(input, share.rank, share.share))
    {
        TgRibbon ribbon = tgRibbon(input.uv.x);
        LockLooks looks = lockLooks(input, frame, ribbon, ball, furRootsHeader(2.0).x, child, 0.0);
        RibbonPlace place = lockPlace(looks.strand, ribbon.along);
        float3 aside = tgSafeNormalize(cross(place.tangent, ribbonToLight(frame, place.offset)));
        float3 world = ribbonWorld(frame, place.offset, input);
        float radius = share.width * lockRadius(looks, ribbon.along, 0.0);
        float2 width = tgRibbonWidth(radius, pixel);
        float drawn = (width.x + gFurEdge * pixel) * input.tangent.w;
        float4 lightClip = mul(float4(ribbonWorld(frame, place.offset + drawn * aside, input), 1.0), gLightViewProjection);
        output.position = TG_HALF_PIXEL(lightClip, gViewportSize);
        output.edge = float3(drawn / pixel, width.x / pixel, width.y * (gCoatChildren + underfur * gCoatUnderfur) / gCoatShadowStrands);
        output.place = float4(lightClip.xyw, furFromLight(world));
    }
    return output;
}

OpacityVarying OpacityVS(TG_LAYER_INPUT(TgVertexInput, input))
{
    return lockOpacity(input, TG_LAYER_INDEX(gFurChild), 0.3);
}

// The opaque layer below, up to gCoatUndercoat.
FurVarying UndercoatVS(TgVertexInput input)
{
    return furVarying(input, float2(gCoatUndercoat * (1.0 - gCoatShort), 1.0), kFurNear);
}

float3 undercoatAlbedo(float cosine, float pixel)
{
    float belly = gCoatBelly * saturate(1.6 * (cosine - 0.25));
    float3 albedo = lerp(gCoatRootColor, 0.4 * gCoatBellyColor, belly);
    return lerp(albedo, lerp(gCoatMidColor, 0.75 * gCoatBellyColor, belly), 0.5 * lockFar(pixel));
}

float4 UndercoatPS(FurVarying input) : SV_Target0
{
    float3 normal = tgWorldNormal(input.normal);
    float cosine = dot(normal, gFurDown);
    float pixel = ribbonPixel() * length(gCameraPosition - input.world);
    float3 albedo = undercoatAlbedo(cosine, pixel);
    TgLight ours = ownLight(input.world);
    float open = ownVisibility(input.world, normal, coatOpen(input.world, pixel));
    float lit = saturate(0.7 * dot(normal, ours.toLight) + 0.3) * open;
    float3 around = lerp(gCoatSky, gCoatGround, 0.5 + 0.5 * cosine);
    return float4(albedo * ours.color * (0.5 * lit + 0.12 * around), 1.0);
}

#define LOCK_SHARE LOCK_SHARE_OF("gCoatThin")
#define LOCK_SHARE_OF(thinnest) string Share = "gFurShare"; string ShareRadius = "gCoatRadius"; string ShareThinnest = thinnest; LOCK_FEWER
#define LOCK_FEWER string ShareFewest = "gRibbonFewest"; string Segment = "gCoatSegment"; string SegmentsOf = "gFurLength";
#define OPACITY_SHARE LOCK_SHARE float SegmentFewest = 2.0; float ShareFirst = 0.5;
#define COAT_SCRIPT LIGHT_SCRIPT(OPACITY_SCRIPT) \
    "RenderColorTarget0=; RenderDepthStencilTarget=; Pass=Undercoat;" \
    TG_LAYER_SCRIPT("gCoatUnderfur", "gFurChild", "Underfur") TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Core") \
    TG_LAYER_SCRIPT("gCoatChildren", "gFurChild", "Fringe") COAT_MOTION_SCRIPT
#define LOCK_SEEN RIBBON_REACH LOCK_SHARE float SegmentFewest = 2.0;
// Least: of Core as lockAfar; of the underfur the widest, lockRadius times lockShare, and no pixel shows it.
#define LOCK_CORE LOCK_SEEN string Least = "gCoatAfar"; string LeastRadius = "gCoatRadius";
#define LOCK_UNDER RIBBON_REACH LOCK_SHARE_OF("gCoatUnderThin") LOCK_LEAST float SegmentScale = 0.5;
#define LOCK_LEAST string Least = "gFurCut"; string LeastRadius = "gCoatRadius"; float LeastScale = 1.01; float LeastTaper = 3.0;
#define COAT_PASSES(under, core, fringe, coreState) OPACITY_PASSES \
    TG_PART_PASS(Undercoat, "skin", UndercoatVS, UndercoatPS, TG_STATE_SOLID) \
    TG_SEEN_LAYER_PASS(Underfur, "underfur", LOCK_UNDER, "gCoatUnderfur", UnderfurVS, under, coreState) \
    TG_SEEN_LAYER_PASS(Core, "underfur", LOCK_CORE, "gCoatChildren", LocksVS, core, coreState) \
    TG_SEEN_LAYER_PASS(Fringe, "underfur", LOCK_SEEN, "gCoatChildren", LocksVS, fringe, TG_STATE_FRINGE) COAT_MOTION_PASSES

#endif
// SPDX-License-Identifier: MIT
