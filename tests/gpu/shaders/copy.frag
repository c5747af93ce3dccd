#version 450
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 1) uniform texture2D image;
layout(set = 0, binding = 2) uniform sampler imageSampler;
void main() { target = texture(sampler2D(image, imageSampler), uv); }
