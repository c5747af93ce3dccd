#version 450
// An orthographic view along -z that holds the mesh's ball; clip space is Direct3D's.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(set = 0, binding = 0) uniform View {
    vec4 centreAndScale; // scale: 1 / radius
    vec4 size;           // of the ball in clip space
};
layout(location = 0) out vec3 surfaceNormal;
void main() {
    vec3 p = (position - centreAndScale.xyz) * centreAndScale.w;
    gl_Position = vec4(p.xy * size.xy, 0.5 - 0.5 * p.z, 1.0);
    surfaceNormal = normal;
}
