// A strand is a cone: around its root's place p the coat is covered, at height h, within the radius r (1 - h / L). The place of a ray over
// the skin and its height change together, so a piece of a ray between two layers is a straight line in (place, height), and what it meets
// of a cone is a quadratic. Exact whatever the distance of the layers; a test at the layers alone misses every strand thinner than their
// gap.
//   from, along: place of the ray from the strand's axis where the piece begins, and how it changes, in the tangent plane. radius, growth:
//   of the strand there, and how it changes (growth at least 0). All lengths in one unit. width: of a pixel.
#ifndef TEGUMENT_FUR_CONES_FXH
#define TEGUMENT_FUR_CONES_FXH

// Shares of a pixel that a strand of these radii covers at these distances from its axis. What is narrower than a pixel is drawn a pixel
// wide, as much fainter: it neither breaks into dots nor loses light.
float2 tgFurSection(float2 radius, float2 distance, float width)
{
    float2 wide = max(radius, 0.5 * width);
    return saturate((wide - distance) / width + 0.5) * saturate(2.0 * radius / width);
}

// x: how much of what is still free the strand covers along the piece; what it covers where the piece begins was drawn by the layer above.
// y: where along the piece, 0 to 1, the ray enters the strand.
//   It covers most where radius - distance is largest: seen sideways where the ray passes the axis, seen from above at the end of the
//   piece. It enters at a root of |from + along t|^2 = (radius + growth t)^2; where even there it is not inside, it passes by: y is there.
float2 tgFurCone(float3 from, float3 along, float radius, float growth, float width)
{
    float square = max(dot(along, along), 1e-12);
    float distance = dot(from, from);
    float passing = dot(from, along);
    float k = min(growth * rsqrt(square), 0.999);
    float aside = sqrt(max(distance * square - passing * passing, 0.0)); // times |along|
    float most = k < 0.999 ? saturate((aside * k * rsqrt(1.0 - k * k) - passing) / square) : 1.0; // steeper than the cone: its end

    float middle = passing - radius * growth;
    float outside = distance - radius * radius;
    float discriminant = middle * middle - (square - growth * growth) * outside;
    // Of a ray that is inside later this is the root on the strand, not on the cone's other half above the tip: the smaller one sideways,
    // the greater one where it is steeper than the cone.
    float root = outside / (sqrt(max(discriminant, 0.0)) - middle + 1e-9);

    float2 radii = float2(radius, radius + growth * most);
    float2 distances = float2(sqrt(distance), length(from + along * most));
    float entry = radii.y > distances.y ? clamp(root, 0.0, most) : most;
    float2 covered = tgFurSection(radii, distances, width);
    return float2(saturate((covered.y - covered.x) / max(1.0 - covered.x, 1e-4)), entry);
}

#endif
// SPDX-License-Identifier: MIT
