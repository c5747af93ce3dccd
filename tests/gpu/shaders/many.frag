#version 450
// More colours than a draw may have targets for.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 first;
layout(location = 1) out vec4 second;
layout(location = 2) out vec4 third;
void main() {
    first = vec4(0.25, uv, 1);
    second = vec4(0.5, uv, 1);
    third = vec4(0.75, uv, 1);
}
