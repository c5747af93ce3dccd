#version 450
// Reads the texture at one place, whatever the pixel.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Block { vec2 place; float lod; };
layout(set = 0, binding = 1) uniform texture2D image;
layout(set = 0, binding = 2) uniform sampler imageSampler;
void main() { target = textureLod(sampler2D(image, imageSampler), place, lod); }
