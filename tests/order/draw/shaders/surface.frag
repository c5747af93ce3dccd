#version 450
// The cheapest shading that shows a shape: what is measured are the vertices.
layout(location = 0) in vec3 surfaceNormal;
layout(location = 0) out vec4 color;
void main() {
    float facing = abs(normalize(surfaceNormal).z);
    color = vec4(vec3(0.1 + 0.8 * facing), 1.0);
}
