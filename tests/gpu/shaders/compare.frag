#version 450
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Block { float reference; };
layout(set = 0, binding = 1) uniform texture2D depth;
layout(set = 0, binding = 2) uniform samplerShadow depthSampler;
void main() { target = vec4(texture(sampler2DShadow(depth, depthSampler), vec3(uv, reference))); }
