#include "fresnel.hlsl"

TG_TEST(straight_on_is_the_square_of_the_indices)
{
    float index = tgCases(1.0, 1.33, 1.5, 2.4);
    float root = (index - 1.0) / (index + 1.0);
    tgNear(fresnel(1.0, index), root * root, tgRelative(1e-5), tgAbsolute(1e-7));
}

TG_TEST(grazing_light_is_mirrored)
{
    float index = tgRange(1.1, 2.5, 50);
    tgNear(fresnel(0.0, index), 1.0, tgUlp(4));
    tgEqual(fresnel(0.1, 0.5), 1.0);
}

TG_TEST(schlick_is_near)
{
    float cosine = tgRange(0.0, 1.0, 100);
    float index = tgRandom(1.3, 1.6);
    tgWatch(fresnelFast(cosine, index));
    tgBetween(fresnelFast(cosine, index), 0.0, 1.0);
    tgNear(fresnelFast(cosine, index), fresnel(cosine, index), 0.07);
}
