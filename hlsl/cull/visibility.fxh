// Texture-space culling (seed 5.3.1; Gosselin et al. 2004): a prepass writes depth 1 where a texel cannot show, and the later passes, drawn at depth 0
// with the test EQUAL, skip it. Clip-space form of seed equations 41 and 42: p.x / p.z > tan(fov / 2) is x > w; both signs, and what is behind the
// camera is outside. normal, toEye: unit; toEye points from the surface to the eye.
#ifndef TEGUMENT_CULL_VISIBILITY_FXH
#define TEGUMENT_CULL_VISIBILITY_FXH

bool cullOutside(float4 clip)
{
    return clip.w <= 0.0 || abs(clip.x) > clip.w || abs(clip.y) > clip.w;
}

// slack: 0 in the seed. A triangle may face the eye although its interpolated normal does not yet.
bool cullHidden(float4 clip, float3 normal, float3 toEye, float slack)
{
    return cullOutside(clip) || dot(normal, toEye) < -slack;
}

bool cullBlack(float3 colour)
{
    return max(colour.r, max(colour.g, colour.b)) <= kBlack;
}

#endif
