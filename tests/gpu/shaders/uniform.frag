#version 450
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 0) uniform Block { vec4 color; };
void main() { target = color; }
