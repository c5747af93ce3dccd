#version 450
layout(location = 0) in vec2 uv;
layout(location = 0, index = 0) out vec4 first;
layout(location = 0, index = 1) out vec4 second;
void main() {
    first = vec4(0.5);
    second = vec4(0.25);
}
