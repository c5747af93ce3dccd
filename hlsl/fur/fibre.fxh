// Light on the fibres of a coat: reflection R, transmission TT and internal reflection TRT of a rough dielectric cylinder that absorbs, and
// what many of them scatter to each other. The light's colour is E / pi.
//   One fibre: S. Marschner et al., Light Scattering from Human Hair Fibers, 2003, along the fibre as E. d'Eon et al. 2011, around it and
// absorption as M. Chiang et al. 2016, averaged over its width; what depends on the azimuth comes from a table.
//   Many fibres, as three parts: light that comes straight; light that others scattered forward (A. Zinke et al., Dual Scattering, 2008),
// blurred over the front half of the azimuth and along the fibre; light scattered many times, by two streams in a half space (B. Hapke,
// Bidirectional Reflectance Spectroscopy 1, 1981), whose single-scattering albedo is that which gives the coat the colour asked for.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_FUR_FIBRE_FXH
#define TEGUMENT_FUR_FIBRE_FXH

static const float kTgFibreEta = 1.55;
// Chiang et al. 2016, equation 7, at roughness 0.3 along and around: variances of R, TT, TRT along; scale of the logistic around.
static const float3 kTgFibreVariance = float3(0.0846, 0.02115, 0.3384);
static const float kTgFibreSpread = 0.1172;
// Scales of 2 degrees tilt R by -4, TT by 2, TRT by 8.
static const float3 kTgFibreTiltSine = float3(-0.0697565, 0.0348995, 0.1391731);
static const float3 kTgFibreTiltCosine = float3(0.9975641, 0.9993908, 0.9902681);
static const float kTgFibreForward = 0.615; // mean cosine of scattering by a fibre of no absorption
static const float kTgFibreBlur = 0.03;     // variance that each fibre passed adds along
static const float kTgFibreWay = 1.9;       // radii: mean way within a fibre, over all that it scatters
// Sizes of the table. Rows of the upper half hold light from one direction, of the lower half light from half of the azimuth.
static const float kTgFibreColumns = 64.0;
static const float kTgFibreRows = 64.0;

// Absorption for each radius of the fibre that gives a coat this colour: Chiang et al. 2016, equation 9, at roughness 0.3.
float3 tgFibreAbsorption(float3 color)
{
    float3 root = log(clamp(color, 0.001, 0.999)) * (1.0 / 5.8884);
    return root * root;
}

// Reflectance of a dielectric of index kTgFibreEta for unpolarised light.
float tgFibreFresnel(float cosine)
{
    float sine = sqrt(saturate(1.0 - cosine * cosine)) / kTgFibreEta;
    float inside = sqrt(1.0 - sine * sine);
    float s = (cosine - kTgFibreEta * inside) / (cosine + kTgFibreEta * inside);
    float p = (kTgFibreEta * cosine - inside) / (kTgFibreEta * cosine + inside);
    return 0.5 * (s * s + p * p);
}

// Integral of a logistic of scale kTgFibreSpread.
float3 tgFibreSigmoid(float3 x)
{
    return 1.0 / (1.0 + exp(-clamp(x / kTgFibreSpread, -80.0, 80.0)));
}

// Mean of that logistic, wrapped around the circle, over `wide` of the azimuth around x.
float3 tgFibreAzimuth(float3 x, float wide)
{
    float3 sum = 0.0;
    x -= 2.0 * kTgPi * floor(x / (2.0 * kTgPi) + 0.5);
    [unroll] for (int i = -1; i <= 1; i++)
    {
        float3 at = x + 2.0 * kTgPi * i;
        sum += tgFibreSigmoid(at + 0.5 * wide) - tgFibreSigmoid(at - 0.5 * wide);
    }
    return sum / wide;
}

struct TgFibreTable
{
    float3 bright; // R, TT, TRT of a fibre of no absorption
    float2 path;   // mean way within the fibre of TT and TRT, radii
};

// azimuth: between light and eye; cosine: of the eye's inclination, above 0; wide: of the azimuth from which light comes.
TgFibreTable tgFibreTable(float azimuth, float cosine, float wide)
{
    static const float kSteps = 96.0; // across the fibre
    TgFibreTable table;
    table.bright = 0.0;
    table.path = 0.0;
    float sine2 = 1.0 - cosine * cosine;
    float bent = sqrt(kTgFibreEta * kTgFibreEta - sine2) / cosine;
    float straight = sqrt(1.0 - sine2 / (kTgFibreEta * kTgFibreEta));
    [loop] for (float i = 0.5; i < kSteps; i += 1.0)
    {
        float h = 2.0 * i / kSteps - 1.0;
        float inside = asin(clamp(h / bent, -1.0, 1.0));
        float across = 2.0 * cos(inside) / straight;
        float f = tgFibreFresnel(cosine * sqrt(1.0 - h * h));
        float through = (1.0 - f) * (1.0 - f);
        float3 turned = float3(0.0, 2.0 * inside + kTgPi, 4.0 * inside + 2.0 * kTgPi) - 2.0 * asin(h);
        float3 part = float3(f, through, through * f) * tgFibreAzimuth(azimuth - turned, wide) / kSteps;
        float rest = (1.0 - f) * f * f / (2.0 * kTgPi * kSteps); // after more reflections, from everywhere, with TRT
        table.bright += part + float3(0.0, 0.0, rest);
        table.path += across * float2(part.y, 2.0 * part.z + 3.0 * rest);
    }
    table.path /= max(table.bright.yz, 1e-12);
    return table;
}

// Distribution M along the fibre of R, TT, TRT (d'Eon et al. 2011, equation 7, by S. Olivares' approximation of I0, 2018): its integral
// over the sine's cosine is 1. Sines and cosines: of the inclinations.
float3 tgFibreAlong(float sineLight, float cosineLight, float sineEye, float cosineEye, float3 variance)
{
    float3 sine = sineEye * kTgFibreTiltCosine + cosineEye * kTgFibreTiltSine;
    float3 cosine = abs(cosineEye * kTgFibreTiltCosine - sineEye * kTgFibreTiltSine);
    float3 x = cosineLight * cosine / variance;
    float3 x2 = x * x;
    float3 bessel = 0.5 * (1.0 + exp(-2.0 * x)) * (1.0 + 0.24273 * x2) / ((1.0 + 0.43023 * x2) * sqrt(sqrt(1.0 + 0.25 * x2)));
    return exp((cosineLight * cosine - sineLight * sine - 1.0) / variance) * bessel / (variance * (1.0 - exp(-2.0 / variance)));
}

// What a fibre sends to the eye for each unit of light across it: bright and path as of TgFibreTable, along as of tgFibreAlong.
float3 tgFibreScattered(float3 bright, float2 path, float3 along, float3 absorption)
{
    return along.x * bright.x + along.y * bright.y * exp(-absorption * path.x) + along.z * bright.z * exp(-absorption * path.y);
}

// Share of what a fibre catches that it scatters, and with it what of the optical depth of a fibre counts: the similarity of forward and
// isotropic scattering.
float3 tgFibreAlbedo(float3 absorption)
{
    return exp(-kTgFibreWay * absorption);
}

float3 tgFibreDepth(float3 albedo)
{
    return 1.0 - kTgFibreForward * albedo;
}

// Light scattered many times, where E / pi of the light is 1: its mean over all directions, and half of what more goes up than down.
struct TgFibreField
{
    float3 mean;
    float3 up;
};

// At this optical depth of a half space, along its normal; cosine: of the normal and the light, above 0. color: of the coat.
TgFibreField tgFibreField(float3 color, float3 depth, float cosine)
{
    float3 dark = (1.0 - color) / (1.0 + color); // sqrt(1 - albedo)
    float3 albedo = 1.0 - dark * dark;
    // At 0 both parts are infinite, and their difference is not: it is nearly the same beside that.
    float3 off = 2.0 * dark * cosine - 1.0;
    off = lerp(max(off, 0.02), min(off, -0.02), step(off, 0.0));
    dark = (1.0 + off) / (2.0 * cosine);
    float3 q = -off * (2.0 + off);
    float3 first = albedo * (0.5 * cosine * (1.0 + 2.0 * cosine)) / ((1.0 + dark) * q) * exp(-2.0 * dark * depth);
    float3 second = albedo * (cosine * cosine) / q * exp(-depth / cosine);
    TgFibreField field;
    field.mean = max(first - second, 0.0);
    field.up = 0.5 * (second / cosine - 2.0 * dark * first);
    return field;
}

// The same of light from all sides, as much from each.
TgFibreField tgFibreFieldAround(float3 color, float3 depth)
{
    float3 dark = (1.0 - color) / (1.0 + color);
    TgFibreField field;
    field.mean = exp(-2.0 * dark * depth) / (1.0 + dark);
    field.up = -dark * field.mean;
    return field;
}

// Chance that light comes straight to a fibre that the eye sees. passed: fibres on the light's way, eyePassed: on the eye's. A gap that the
// eye looks through is one for the light, too, as long as both ways run together (A. Kuusk, The Hot Spot Effect of a Uniform Vegetative
// Cover, 1985). apart: angle of the two ways, over that at which they part by a fibre's width for each fibre passed.
float tgFibreStraight(float passed, float eyePassed, float apart)
{
    float together = apart > 1e-3 ? (1.0 - exp(-apart)) / apart : 1.0;
    return exp(-max(passed - sqrt(passed * eyePassed) * together, 0.0));
}

#endif
// SPDX-License-Identifier: MIT
