#version 450
// Sets 1 and 2 do not exist.
layout(location = 0) in vec2 uv;
layout(location = 0) out vec4 target;
layout(set = 0, binding = 5) uniform First { vec4 a; };
layout(set = 3, binding = 7) uniform Second { vec4 b; };
void main() { target = a + b; }
