// Camera and light of a workspace (docs/workspace.md), and what effects ask of them by semantic. Matrices are of row vectors, row after
// row; lengths are millimetres. The rules are those of host/scene/view.cpp.
"use strict";

const sub = (a, b) => a.map((value, i) => value - b[i]);
const dot = (a, b) => a.reduce((sum, value, i) => sum + value * b[i], 0);
const cross = ([a, b, c], [x, y, z]) => [b * z - c * y, c * x - a * z, a * y - b * x];
const unit = v => v.map(value => value / Math.hypot(...v));
const radians = degrees => (degrees * Math.PI) / 180;
const IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
const MARGIN = 1e-3; // of the sphere's radius, in front of the planes
const LEAST_NEAR = 1e-3;
const WIDEST_LIGHT = radians(160);

function multiply(a, b) {
  return IDENTITY.map((_, i) => [0, 1, 2, 3].reduce((sum, k) => sum + a[(i & 12) + k] * b[k * 4 + (i & 3)], 0));
}

function lookAt(eye, target, wanted = [0, 1, 0]) {
  const back = unit(sub(eye, target));
  const up = Math.hypot(...cross(back, wanted)) > 1e-6 ? wanted : [0, 0, 1];
  const right = unit(cross(up, back));
  const axes = [right, cross(back, right), back];
  return [0, 1, 2].flatMap(row => [...axes.map(axis => axis[row]), 0]).concat(axes.map(axis => -dot(eye, axis)), 1);
}

function perspective(fov, aspect, near, far) {
  const scale = 1 / Math.tan(fov / 2), depth = near - far;
  return [scale, 0, 0, 0, 0, scale * aspect, 0, 0, 0, 0, far / depth, -1, 0, 0, (near * far) / depth, 0];
}

function planes(depth, radius) {
  const margin = Math.max(radius * (1 + MARGIN), Math.abs(depth) * MARGIN);
  const far = Math.max(depth + margin, 1e-3);
  return [Math.max(depth - margin, far * LEAST_NEAR), far];
}

function viewOf(eye, target, fov, aspect, [near, far]) {
  const view = lookAt(eye, target), projection = perspective(fov, aspect, near, far);
  return { VIEW: view, PROJECTION: projection, VIEWPROJECTION: multiply(view, projection), position: eye, NEARCLIP: [near], FARCLIP: [far] };
}

// workspace: positions in radii of the mesh from its centre. turn, tilt: radians that the camera goes around; near: its distance, times.
export function makeScene(workspace, bounds, aspect, { turn = 0, tilt = 0, near = 1 } = {}) {
  const place = point => point.map((value, i) => value * bounds.radius + bounds.centre[i]);
  const target = place(workspace.camera.target);
  const eye = orbit(place(workspace.camera.position), target, turn, tilt, near);
  const depth = dot(sub(bounds.centre, eye), unit(sub(target, eye)));
  const camera = viewOf(eye, target, radians(workspace.camera.horizontal_fov), aspect, planes(depth, bounds.radius));
  const lamp = place(workspace.light.position);
  const distance = Math.hypot(...sub(bounds.centre, lamp)), wide = bounds.radius * (1 + MARGIN);
  const cone = distance > wide ? 2 * Math.asin(wide / distance) : WIDEST_LIGHT;
  const light = viewOf(lamp, bounds.centre, cone, 1, planes(distance, bounds.radius));
  const fixed = { WORLD: IDENTITY, WORLDINVERSETRANSPOSE: IDENTITY, WORLDVIEWPROJECTION: camera.VIEWPROJECTION, CAMERAPOSITION: eye, UNITMM: [1],
    TIME: [0], BOUNDINGCENTER: bounds.centre, BOUNDINGBOXMIN: bounds.minimum, BOUNDINGBOXMAX: bounds.maximum,
    BOUNDINGBOXSIZE: sub(bounds.maximum, bounds.minimum), BOUNDINGSPHERESIZE: [bounds.radius] };
  return (semantic, object) => {
    const own = object === "PointLight0" ? light : camera;
    if (object === "PointLight0" && semantic === "POSITION") return lamp;
    if (object === "PointLight0" && semantic === "DIFFUSE") return workspace.light.color;
    return own[semantic] ?? fixed[semantic];
  };
}

function orbit(eye, target, turn, tilt, near) {
  const [x, y, z] = sub(eye, target);
  const distance = Math.hypot(x, y, z);
  const around = Math.atan2(x, z) + turn;
  const above = Math.min(1.5, Math.max(-1.5, Math.asin(y / distance) + tilt));
  const offset = [Math.sin(around) * Math.cos(above), Math.sin(above), Math.cos(around) * Math.cos(above)];
  return offset.map((value, i) => value * distance * near + target[i]);
}
