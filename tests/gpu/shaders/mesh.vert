#version 450
// Clip-space position and colour from the vertex stream; each instance one pixel of a 16-pixel row further right.
layout(location = 0) in vec4 position;
layout(location = 1) in vec4 color;
layout(location = 0) out vec4 outColor;
void main() {
    gl_Position = position + vec4(2.0 / 16.0 * gl_InstanceIndex, 0.0, 0.0, 0.0);
    outColor = color;
}
