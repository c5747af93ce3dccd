// hlsl/cull against the definitions of docs/design/skin.md (passes 2, 3), in every setting.
#include "../../hlsl/platform.fxh"
#include "../../hlsl/cull.fxh"

bool outside(float4 clip) { return clip.w <= 0.0 || abs(clip.x) > clip.w || abs(clip.y) > clip.w; }

TG_TEST(tgCullOutside)
{
    float4 way = tgRandom(-1.0, 1.0, 4096);
    float scale = tgCases(0.0, 0.1, 1.0, 1000.0);
    tgEqual(tgCullOutside(way * scale), outside(way * scale));
}

TG_TEST(tgCullOutsideView)
{
    float4 way = tgRandom(-1.0, 1.0, 4096);
    float scale = tgCases(0.0, 0.1, 1.0, 1000.0);
    float4 clip = way * scale;
    float w = abs(clip.w) > 1e-6 ? clip.w : 1e-6;
    tgEqual(tgCullOutsideView(clip), TEGUMENT_SETTING == 2 ? outside(clip) : clip.x / w > 1.0 || clip.y / w > 1.0);
}

TG_TEST(tgCullBackFace)
{
    float3 normal = tgRandom(-1.0, 1.0, 4096);
    float3 toEye = tgRandom(-1.0, 1.0);
    float slack = tgRandom(0.0, 0.5);
    float cosine = dot(normal, toEye);
    if (abs(cosine + slack) > 1e-6) tgEqual(tgCullBackFace(normal, toEye, slack), cosine < -slack);
    tgTrue(!tgCullBackFace(normal, float3(0, 0, 0), 0.0));
}

TG_TEST(tgCullBlack)
{
    float3 colour = tgRandom(0.0, 0.002, 4096);
    float most = TEGUMENT_SETTING == 2 ? 2.0 / 255.0 / 12.92 : 0.0;
    float brightest = max(colour.r, max(colour.g, colour.b));
    if (abs(brightest - most) > 1e-9) tgEqual(tgCullBlack(colour), brightest <= most);
    tgTrue(tgCullBlack(float3(0, 0, 0)));
}
