// Light that the specular layer takes from the diffuse one: directional albedo of the Kelemen/Szirmay-Kalos lobe with rho_s = 1.
//   rho_dt(cos, m) = integral over the hemisphere of PH F / |L + V|^2 N.w dw   (d'Eon and Luebke 2007, "Specular and energy conservation")
// Stored in a texture, x = cosine, y = roughness, as two halves (surface/halves.fxh). Setting corrected: importance sampling, divided by pi. Others: the printed end-point rule.
#ifndef TEGUMENT_SETTINGS_FXH
#include "../settings.fxh"
#endif
#ifndef TEGUMENT_SURFACE_HALVES_FXH
#include "../surface/halves.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_FRESNEL_FXH
#include "../specular/fresnel.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_KELEMEN_FXH
#include "../specular/kelemen.fxh"
#endif
#ifndef TEGUMENT_SPECULAR_ENERGY_FXH
#define TEGUMENT_SPECULAR_ENERGY_FXH

// 32 x 32 nodes: within the 65,536 instructions that ps_3_0 is sure to execute.
static const int kEnergyNodes = 32;

// The printed rule: both ends of [0, 2 pi] and [0, pi/2] are nodes, every node has the same weight.
float energyNodePrinted(float3 toEye, float roughness, int i, int j)
{
    float phi = 2.0 * kPi * i / (kEnergyNodes - 1.0);
    float theta = 0.5 * kPi * j / (kEnergyNodes - 1.0);
    float3 toLight = float3(sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta));
    float weight = kPi * kPi / (kEnergyNodes * kEnergyNodes) * sin(theta);
    return weight * kelemenSpecular(float3(0.0, 0.0, 1.0), toLight, toEye, roughness, 1.0);
}

// Half vectors drawn from PH N.H / pi, so tan^2 = -m^2 ln(1 - u). With dw = 4 V.H dH and |L + V| = 2 V.H the integrand over the density becomes
// pi F N.L / (V.H N.H) = pi F (2 - N.V / (V.H N.H)), which is bounded and continuous. Midpoints; half a turn, by symmetry.
float energyNodeSampled(float3 toEye, float roughness, int i, int j)
{
    float phi = kPi * (i + 0.5) / kEnergyNodes;
    float u = (j + 0.5) / kEnergyNodes;
    float slope = roughness * sqrt(-log(1.0 - u));
    float cosine = rsqrt(1.0 + slope * slope);
    float sine = slope * cosine;
    float3 halfway = float3(sine * cos(phi), sine * sin(phi), cosine);
    float vh = dot(toEye, halfway);
    float share = vh > 0.0 ? max(2.0 - toEye.z / (vh * cosine), 0.0) : 0.0;
    return fresnelSchlick(vh, kFresnel0) * share * kPi / (kEnergyNodes * kEnergyNodes);
}

float energyDirectionalAlbedo(float cosine, float roughness)
{
    float3 toEye = float3(sqrt(max(1.0 - cosine * cosine, 0.0)), 0.0, cosine);
    float sum = 0.0;
    [loop] for (int i = 0; i < kEnergyNodes; i++)
        [loop] for (int j = 0; j < kEnergyNodes; j++)
        {
            if (kCorrected)
                sum += energyNodeSampled(toEye, roughness, i, j);
            else
                sum += energyNodePrinted(toEye, roughness, i, j);
        }
    return sum * kAlbedoScale;
}

// The printed table reaches pi times an albedo.
float2 energyTexel(float albedo)
{
    return halvesOf(albedo, albedo < 2.0 ? 1.0 / 1024.0 : 1.0 / 256.0);
}

// Share of light left to diffusion. Clamped: with rho_s = 1 the printed table exceeds 1 at grazing angles and light would turn negative.
float energyDiffuseShare(float albedo, float intensity)
{
    float weight = kAttenuateByIntensity ? intensity : 1.0;
    return max(1.0 - weight * albedo, 0.0);
}

#endif
