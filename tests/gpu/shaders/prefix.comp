#version 450
// One step of a prefix sum: out[i] = in[i] + in[i - distance].
layout(local_size_x = 64) in;
layout(set = 0, binding = 0) uniform Block { int count; int distance; };
layout(set = 0, binding = 1) readonly buffer In { float source[]; };
layout(set = 0, binding = 2) buffer Out { float result[]; };
void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i < count) result[i] = source[i] + (i >= distance ? source[i - distance] : 0.0);
}
