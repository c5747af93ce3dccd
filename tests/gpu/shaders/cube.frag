#version 450
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Block { vec3 direction; };
layout(set = 0, binding = 1) uniform textureCube image;
layout(set = 0, binding = 2) uniform sampler imageSampler;
void main() { target = textureLod(samplerCube(image, imageSampler), direction, 0.0); }
