#version 450
// Each texel becomes its left neighbour plus one, around the edge: wrong by a whole number as soon as one pass reads stale texels.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 1) uniform texture2D previous;
layout(set = 0, binding = 2) uniform sampler unused;
void main() {
    ivec2 size = textureSize(sampler2D(previous, unused), 0);
    ivec2 place = ivec2(gl_FragCoord.xy);
    target = texelFetch(sampler2D(previous, unused), ivec2((place.x + size.x - 1) % size.x, place.y), 0) + 1.0;
}
