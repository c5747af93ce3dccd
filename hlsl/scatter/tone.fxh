// Skin by what is in it: the share of melanin in the epidermis' volume and of blood in the dermis'. A diffusion profile of six Gaussians
// whose widths all skins share; each weight is a sum of products of Bernstein polynomials over the logarithms of melanin (.004 to .32) and
// blood (.002 to .05). Numbers by photons (skin_tones table, lab/measure; docs/design/skin-error.md): up to melanin .1 an edge of light is
// within .003 / .006 / .014 (R, G, B) of theirs. Weights of a channel sum to what skin gives back of light that has entered it.
#ifndef TEGUMENT_SCATTER_TONE_FXH
#define TEGUMENT_SCATTER_TONE_FXH

static const float2 kTgToneLeast = float2(0.004, 0.002);
static const float2 kTgToneMost = float2(0.32, 0.05);
static const float kTgToneVariance[6] = { 0.0004, 0.003969, 0.023409, 0.131044, 0.614656, 3.3124 }; // mm^2
static const float3 kTgToneWeight[144] = {
    float3(0.01506, 0.01929, 0.03604), float3(0.01508, 0.01909, 0.03457), float3(0.01506, 0.01837, 0.0305),
    float3(0.01494, 0.01942, 0.02946), float3(0.01496, 0.01925, 0.00211), float3(0.01497, 0.02024, 0.00764),
    float3(0.01496, 0.01791, 0.0261), float3(0.01485, 0.01942, 0.03377), float3(0.01491, 0.01837, 0.05318),
    float3(0.01491, 0.01807, 0.04763), float3(0.01485, 0.01727, 0.03041), float3(0.0148, 0.01919, 0.01883),
    float3(0.01467, 0.01907, 0.02536), float3(0.01467, 0.01795, 0.02678), float3(0.01469, 0.0194, 0.03172),
    float3(0.0147, 0.01878, 0.03615), float3(0.01373, 0.01675, 0.02114), float3(0.01373, 0.01664, 0.02111),
    float3(0.01373, 0.01659, 0.02085), float3(0.01372, 0.01691, 0.02058), float3(0.01078, 0.01131, 0.00945),
    float3(0.01078, 0.0112, 0.0095), float3(0.01078, 0.01136, 0.00964), float3(0.01078, 0.01128, 0.00979), float3(0.01906, 0.0267, 0.0579),
    float3(0.0189, 0.02766, 0.05795), float3(0.01887, 0.03108, 0.06331), float3(0.01946, 0.02614, 0.06283),
    float3(0.02024, 0.03018, 0.01488), float3(0.02008, 0.02483, 0.01794), float3(0.02002, 0.03668, 0.0), float3(0.02055, 0.02883, 0.0),
    float3(0.01581, 0.0188, 0.11373), float3(0.01577, 0.0204, 0.11449), float3(0.01599, 0.02428, 0.1223), float3(0.01623, 0.01549, 0.12712),
    float3(0.02036, 0.03487, 0.0), float3(0.02038, 0.04035, 0.0), float3(0.02022, 0.03306, 0.0), float3(0.0201, 0.03572, 0.0),
    float3(0.01509, 0.00875, 0.0), float3(0.0151, 0.00938, 0.0), float3(0.01508, 0.00945, 0.0), float3(0.01516, 0.00806, 0.0),
    float3(0.00536, 0.00133, 0.0), float3(0.00536, 0.00188, 0.0), float3(0.00535, 0.00111, 0.0), float3(0.00536, 0.00145, 0.0),
    float3(0.05492, 0.08516, 0.12403), float3(0.05532, 0.08173, 0.1237), float3(0.05507, 0.07384, 0.10801),
    float3(0.0525, 0.08523, 0.09567), float3(0.05785, 0.06625, 0.09501), float3(0.05815, 0.07968, 0.08661),
    float3(0.05801, 0.04998, 0.12846), float3(0.05549, 0.07033, 0.13096), float3(0.0406, 0.09949, 0.09351),
    float3(0.04076, 0.09347, 0.09016), float3(0.03982, 0.08537, 0.06975), float3(0.03875, 0.10387, 0.04238), float3(0.06862, 0.04614, 0.0),
    float3(0.06847, 0.03234, 0.0), float3(0.06897, 0.05077, 0.0), float3(0.06895, 0.04295, 0.0), float3(0.01837, 0.00555, 0.0),
    float3(0.01832, 0.00336, 0.0), float3(0.01844, 0.00397, 0.0), float3(0.01795, 0.00586, 0.0), float3(0.00662, 0.00283, 0.0),
    float3(0.00659, 0.00146, 0.0), float3(0.00664, 0.00324, 0.0), float3(0.00651, 0.00241, 0.0), float3(0.14412, 0.16946, 0.12064),
    float3(0.1412, 0.17453, 0.10808), float3(0.13494, 0.1874, 0.07921), float3(0.13369, 0.09543, 0.0386), float3(0.13413, 0.15136, 0.20525),
    float3(0.13155, 0.12927, 0.20349), float3(0.12601, 0.18086, 0.09622), float3(0.1237, 0.08343, 0.03622),
    float3(0.14525, 0.17031, 0.00002), float3(0.14366, 0.18037, 0.0), float3(0.1413, 0.18162, 0.0), float3(0.13855, 0.07943, 0.0),
    float3(0.12356, 0.03845, 0.0), float3(0.12273, 0.05771, 0.0), float3(0.12195, 0.02743, 0.0), float3(0.10824, 0.0046, 0.0),
    float3(0.0318, 0.00915, 0.0), float3(0.03144, 0.0136, 0.0), float3(0.03086, 0.00928, 0.0), float3(0.02732, 0.00171, 0.0),
    float3(0.01158, 0.00183, 0.0), float3(0.01147, 0.00373, 0.0), float3(0.01132, 0.00122, 0.0), float3(0.01005, 0.0, 0.0),
    float3(0.23138, 0.17617, 0.05553), float3(0.22507, 0.15388, 0.03529), float3(0.22331, 0.01199, 0.0), float3(0.17604, 0.0, 0.0),
    float3(0.20852, 0.1535, 0.04173), float3(0.20304, 0.14976, 0.01), float3(0.20117, 0.0, 0.0), float3(0.1587, 0.0, 0.0),
    float3(0.23671, 0.13724, 0.0), float3(0.23058, 0.10941, 0.0), float3(0.22003, 0.0, 0.0), float3(0.17008, 0.0, 0.0),
    float3(0.11124, 0.02564, 0.0), float3(0.10833, 0.0087, 0.0), float3(0.0984, 0.0, 0.0), float3(0.0744, 0.0, 0.0),
    float3(0.03514, 0.00959, 0.0), float3(0.03425, 0.00441, 0.0), float3(0.03195, 0.0, 0.0), float3(0.02486, 0.0, 0.0),
    float3(0.01223, 0.00231, 0.0), float3(0.01193, 0.00068, 0.0), float3(0.01113, 0.0, 0.0), float3(0.00871, 0.0, 0.0),
    float3(0.13472, 0.0279, 0.0), float3(0.12111, 0.0, 0.0), float3(0.08495, 0.0, 0.0), float3(0.0432, 0.0, 0.0),
    float3(0.12054, 0.02513, 0.0), float3(0.10829, 0.0, 0.0), float3(0.0759, 0.0, 0.0), float3(0.0386, 0.0, 0.0),
    float3(0.12003, 0.01444, 0.0), float3(0.10739, 0.0, 0.0), float3(0.07493, 0.0, 0.0), float3(0.03859, 0.0, 0.0),
    float3(0.03526, 0.00083, 0.0), float3(0.03175, 0.0, 0.0), float3(0.02294, 0.0, 0.0), float3(0.01218, 0.0, 0.0),
    float3(0.01392, 0.00037, 0.0), float3(0.01255, 0.0, 0.0), float3(0.00901, 0.0, 0.0), float3(0.00467, 0.0, 0.0),
    float3(0.00443, 0.0, 0.0), float3(0.00403, 0.0, 0.0), float3(0.00295, 0.0, 0.0), float3(0.00155, 0.0, 0.0)
};
static const float3 kTgToneAlbedo[24] = {
    float3(0.59926, 0.50469, 0.39414), float3(0.57668, 0.4569, 0.35959), float3(0.53219, 0.32268, 0.28103),
    float3(0.43982, 0.22622, 0.22656), float3(0.55623, 0.44566, 0.35898), float3(0.53609, 0.40377, 0.32567),
    float3(0.49608, 0.28543, 0.25078), float3(0.41187, 0.20201, 0.20095), float3(0.57332, 0.45865, 0.26044),
    float3(0.55307, 0.42171, 0.25227), float3(0.50692, 0.30854, 0.22245), float3(0.41701, 0.21798, 0.18833),
    float3(0.37372, 0.165, 0.02536), float3(0.36632, 0.15706, 0.02678), float3(0.34718, 0.13066, 0.03172),
    float3(0.29856, 0.10206, 0.03615), float3(0.12805, 0.05015, 0.02114), float3(0.12538, 0.04739, 0.02111),
    float3(0.11907, 0.03929, 0.02085), float3(0.10369, 0.03255, 0.02058), float3(0.05099, 0.01962, 0.00945),
    float3(0.05016, 0.01896, 0.0095), float3(0.04817, 0.01693, 0.00964), float3(0.04296, 0.01515, 0.00979)
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
