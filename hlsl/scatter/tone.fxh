// Skin by what is in it: the share of melanin in the epidermis' volume and of blood in the dermis'. A diffusion profile of six Gaussians
// whose widths all skins share; each weight is a sum of products of Bernstein polynomials over the logarithms of melanin (.004 to .32) and
// blood (.002 to .05). Numbers by photons (skin_tones table, lab/measure; docs/design/skin-error.md): up to melanin .1 an edge of light is
// within .002 / .005 / .014 (R, G, B) of theirs. Weights of a channel sum to what skin gives back of light that has entered it.
#ifndef TEGUMENT_SCATTER_TONE_FXH
#define TEGUMENT_SCATTER_TONE_FXH

static const float2 kTgToneLeast = float2(0.004, 0.002);
static const float2 kTgToneMost = float2(0.32, 0.05);
static const float kTgToneVariance[6] = { 0.0004, 0.0081, 0.067081, 0.222784, 1.127844, 7.41 }; // mm^2; the last is that of links
static const float3 kTgToneWeight[144] = {
    float3(0.01599, 0.02051, 0.03984), float3(0.01597, 0.01972, 0.03969), float3(0.0159, 0.02046, 0.03468),
    float3(0.0159, 0.02084, 0.03552), float3(0.01591, 0.02199, 0.00215), float3(0.0159, 0.01935, 0.00383),
    float3(0.01583, 0.02309, 0.02659), float3(0.01583, 0.02081, 0.02747), float3(0.01591, 0.01729, 0.06597),
    float3(0.01589, 0.01915, 0.06303), float3(0.01586, 0.01618, 0.04307), float3(0.0159, 0.01953, 0.03725),
    float3(0.01526, 0.02308, 0.02536), float3(0.01525, 0.02109, 0.02678), float3(0.01526, 0.02375, 0.03172),
    float3(0.01526, 0.02205, 0.03615), float3(0.01531, 0.01788, 0.02114), float3(0.01531, 0.01794, 0.02111),
    float3(0.01531, 0.01803, 0.02085), float3(0.01532, 0.01811, 0.02058), float3(0.01132, 0.01135, 0.00945),
    float3(0.01132, 0.01134, 0.0095), float3(0.01132, 0.0114, 0.00964), float3(0.01132, 0.01132, 0.00979),
    float3(0.04272, 0.06263, 0.11697), float3(0.0428, 0.06771, 0.11114), float3(0.04336, 0.06241, 0.12018),
    float3(0.04323, 0.06068, 0.10774), float3(0.04551, 0.05696, 0.04838), float3(0.04557, 0.07074, 0.06722),
    float3(0.04605, 0.05063, 0.0321), float3(0.04588, 0.06249, 0.06668), float3(0.0331, 0.06251, 0.16915),
    float3(0.03327, 0.05496, 0.15888), float3(0.03358, 0.06783, 0.17619), float3(0.03328, 0.05125, 0.15103), float3(0.05034, 0.05551, 0.0),
    float3(0.05036, 0.06557, 0.0), float3(0.05024, 0.0519, 0.0), float3(0.05015, 0.06016, 0.0), float3(0.02424, 0.01177, 0.0),
    float3(0.02425, 0.01191, 0.0), float3(0.02429, 0.01078, 0.0), float3(0.02423, 0.0105, 0.0), float3(0.00871, 0.00289, 0.0),
    float3(0.00872, 0.00301, 0.0), float3(0.00872, 0.0026, 0.0), float3(0.00869, 0.00302, 0.0), float3(0.08449, 0.12443, 0.12795),
    float3(0.08365, 0.09455, 0.13523), float3(0.07775, 0.13089, 0.09983), float3(0.07468, 0.11602, 0.08285),
    float3(0.08413, 0.10339, 0.17112), float3(0.0833, 0.05882, 0.14234), float3(0.0782, 0.12786, 0.18491),
    float3(0.07474, 0.08262, 0.10688), float3(0.07035, 0.14004, 0.02541), float3(0.06938, 0.13642, 0.03082),
    float3(0.06537, 0.13106, 0.00263), float3(0.06554, 0.14618, 0.0), float3(0.09477, 0.04352, 0.0), float3(0.09418, 0.01636, 0.0),
    float3(0.09545, 0.05494, 0.0), float3(0.09245, 0.01987, 0.0), float3(0.01928, 0.00428, 0.0), float3(0.01903, 0.0, 0.0),
    float3(0.01901, 0.0079, 0.0), float3(0.01749, 0.00394, 0.0), float3(0.00687, 0.00191, 0.0), float3(0.00679, 0.00123, 0.0),
    float3(0.00684, 0.00293, 0.0), float3(0.00638, 0.00081, 0.0), float3(0.16142, 0.15659, 0.0798), float3(0.15883, 0.20767, 0.0545),
    float3(0.16203, 0.10902, 0.02534), float3(0.15339, 0.02865, 0.0), float3(0.14596, 0.13961, 0.12585), float3(0.14382, 0.19301, 0.11198),
    float3(0.1465, 0.08406, 0.00762), float3(0.13797, 0.03627, 0.0), float3(0.17473, 0.13925, 0.0), float3(0.17379, 0.1698, 0.0),
    float3(0.17581, 0.09392, 0.0), float3(0.16074, 0.00062, 0.0), float3(0.10801, 0.02853, 0.0), float3(0.10717, 0.0541, 0.0),
    float3(0.10293, 0.0, 0.0), float3(0.08365, 0.0, 0.0), float3(0.0334, 0.01064, 0.0), float3(0.03312, 0.01758, 0.0),
    float3(0.03221, 0.00251, 0.0), float3(0.02774, 0.0, 0.0), float3(0.01221, 0.00234, 0.0), float3(0.01211, 0.00338, 0.0),
    float3(0.01178, 0.0, 0.0), float3(0.01012, 0.0, 0.0), float3(0.24233, 0.14047, 0.0298), float3(0.22994, 0.06722, 0.01919),
    float3(0.20696, 0.0, 0.00093), float3(0.14286, 0.0, 0.00032), float3(0.21804, 0.12368, 0.01114), float3(0.207, 0.06167, 0.0),
    float3(0.18624, 0.0, 0.0), float3(0.12888, 0.0, 0.0), float3(0.23454, 0.09976, 0.0), float3(0.22214, 0.041, 0.0),
    float3(0.19386, 0.0, 0.0), float3(0.13307, 0.0, 0.0), float3(0.09472, 0.01436, 0.0), float3(0.09028, 0.0, 0.0),
    float3(0.07818, 0.0, 0.0), float3(0.05587, 0.0, 0.0), float3(0.03081, 0.00558, 0.0), float3(0.02929, 0.0, 0.0),
    float3(0.0256, 0.0, 0.0), float3(0.01793, 0.0, 0.0), float3(0.01031, 0.00114, 0.0), float3(0.00983, 0.0, 0.0),
    float3(0.00865, 0.0, 0.0), float3(0.00612, 0.0, 0.0), float3(0.05265, 0.0, 0.0), float3(0.04574, 0.0, 0.0), float3(0.02625, 0.0, 0.0),
    float3(0.00972, 0.0, 0.0), float3(0.04697, 0.0, 0.0), float3(0.04074, 0.0, 0.0), float3(0.02331, 0.0, 0.0), float3(0.00853, 0.0, 0.0),
    float3(0.04495, 0.0, 0.0), float3(0.03881, 0.0, 0.0), float3(0.02249, 0.0, 0.0), float3(0.00846, 0.0, 0.0), float3(0.01066, 0.0, 0.0),
    float3(0.00911, 0.0, 0.0), float3(0.0051, 0.0, 0.0), float3(0.00114, 0.0, 0.0), float3(0.00505, 0.0, 0.0), float3(0.00441, 0.0, 0.0),
    float3(0.00266, 0.0, 0.0), float3(0.00099, 0.0, 0.0), float3(0.00158, 0.0, 0.0), float3(0.0014, 0.0, 0.0), float3(0.00087, 0.0, 0.0),
    float3(0.00033, 0.0, 0.0)
};
static const float3 kTgToneAlbedo[24] = {
    float3(0.5996, 0.50463, 0.39435), float3(0.57695, 0.45686, 0.35976), float3(0.53225, 0.32279, 0.28097),
    float3(0.43979, 0.22618, 0.22643), float3(0.55654, 0.44562, 0.35864), float3(0.53633, 0.40359, 0.32537),
    float3(0.49613, 0.28564, 0.25121), float3(0.41184, 0.2022, 0.20103), float3(0.57358, 0.45885, 0.26054),
    float3(0.55328, 0.42133, 0.25273), float3(0.50697, 0.309, 0.2219), float3(0.41698, 0.21758, 0.18827), float3(0.37375, 0.165, 0.02536),
    float3(0.36635, 0.15713, 0.02678), float3(0.34717, 0.13059, 0.03172), float3(0.29853, 0.10208, 0.03615),
    float3(0.12808, 0.05015, 0.02114), float3(0.12541, 0.04744, 0.02111), float3(0.11908, 0.03922, 0.02085),
    float3(0.10369, 0.03255, 0.02058), float3(0.051, 0.01962, 0.00945), float3(0.05017, 0.01895, 0.0095), float3(0.04817, 0.01693, 0.00964),
    float3(0.04296, 0.01515, 0.00979)
};
static const float3 kTgToneDermis[3] = {
    float3(3.38849, 4.12347, 5.17864), float3(0.03188, 0.04944, 0.10825), float3(1.24977, 27.61763, 20.99486)
};
// Bernstein polynomials of melanin (degree 5) and blood (3).
struct TgTonePlace
{
    float3 melanin0, melanin3; // 0 to 2, 3 to 5
    float4 blood;
};

// Skins outside of the ranges are the nearest ones within.
TgTonePlace tgTonePlace(float melanin, float blood)
{
    float2 t = saturate(log2(max(float2(melanin, blood), 1e-6) / kTgToneLeast) / log2(kTgToneMost / kTgToneLeast));
    float2 s = 1.0 - t;
    TgTonePlace place;
    place.melanin0 = s.x * s.x * s.x * float3(s.x * s.x, 5.0 * s.x * t.x, 10.0 * t.x * t.x);
    place.melanin3 = t.x * t.x * t.x * float3(10.0 * s.x * s.x, 5.0 * s.x * t.x, t.x * t.x);
    place.blood = float4(s.y * s.y * s.y, 3.0 * s.y * s.y * t.y, 3.0 * s.y * t.y * t.y, t.y * t.y * t.y);
    return place;
}

// Six sums over blood, each times its polynomial of melanin. first: of the table's numbers.
#define TG_TONE_ROW(table, first, place) \
    (place.blood.x * table[(first)] + place.blood.y * table[(first) + 1] + place.blood.z * table[(first) + 2] + \
     place.blood.w * table[(first) + 3])
#define TG_TONE_SUM(table, first, place) \
    (place.melanin0.x * TG_TONE_ROW(table, first, place) + place.melanin0.y * TG_TONE_ROW(table, (first) + 4, place) + \
     place.melanin0.z * TG_TONE_ROW(table, (first) + 8, place) + place.melanin3.x * TG_TONE_ROW(table, (first) + 12, place) + \
     place.melanin3.y * TG_TONE_ROW(table, (first) + 16, place) + place.melanin3.z * TG_TONE_ROW(table, (first) + 20, place))

// Of a Gaussian, from the narrowest (0) to the widest (5).
float3 tgToneWeight(int gaussian, float melanin, float blood)
{
    TgTonePlace place = tgTonePlace(melanin, blood);
    return TG_TONE_SUM(kTgToneWeight, gaussian * 24, place);
}

// What skin gives back of light that has entered it: the sum of the six.
float3 tgToneAlbedo(float melanin, float blood)
{
    TgTonePlace place = tgTonePlace(melanin, blood);
    return TG_TONE_SUM(kTgToneAlbedo, 0, place);
}

// c of flesh.fxh, per mm: 1.1 times the dermis' effective attenuation at 620, 540 and 460 nm.
float3 tgToneFlesh(float blood)
{
    float3 absorbed = lerp(kTgToneDermis[1], kTgToneDermis[2], clamp(blood, kTgToneLeast.y, kTgToneMost.y));
    return 1.1 * sqrt(3.0 * absorbed * (absorbed + kTgToneDermis[0]));
}

#endif
// SPDX-License-Identifier: MIT
