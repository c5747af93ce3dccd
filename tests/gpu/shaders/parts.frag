#version 450
// A colour that is written by its parts and read again.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
void main() {
    second.x = uv.x;
    second.yzw = vec3(0.5);
    first = vec4(second.yzw, 1);
}
