#version 450
// One triangle over the whole target. uv (0, 0) is Direct3D's top left corner: clip y up, v down.
layout(location = 0) out vec2 uv;
void main() {
    uv = vec2(gl_VertexIndex & 2, (gl_VertexIndex << 1) & 2);
    gl_Position = vec4(2.0 * uv.x - 1.0, 1.0 - 2.0 * uv.y, 0.5, 1.0);
}
