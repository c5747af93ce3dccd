// Small glTF files, each of which moves in a way of its own: node generated.mjs FOLDER.

import fs from 'node:fs';
import path from 'node:path';

const kTypes = {1: 'SCALAR', 2: 'VEC2', 3: 'VEC3', 4: 'VEC4', 16: 'MAT4'};
const kComponents = new Map([[Int8Array, 5120], [Uint8Array, 5121], [Int16Array, 5122], [Uint16Array, 5123], [Uint32Array, 5125], [Float32Array, 5126]]);

class Builder {
  constructor() {
    this.json = {asset: {version: '2.0'}, scene: 0, scenes: [{nodes: []}], nodes: [], meshes: [], accessors: [], bufferViews: []};
    this.bytes = [];
    this.size = 0;
  }
  view(array, extra = {}) {
    const bytes = Buffer.from(array.buffer, array.byteOffset, array.byteLength);
    this.json.bufferViews.push({buffer: 0, byteOffset: this.size, byteLength: bytes.length, ...extra});
    const padded = Buffer.concat([bytes, Buffer.alloc((4 - bytes.length % 4) % 4)]);
    this.bytes.push(padded);
    this.size += padded.length;
    return this.json.bufferViews.length - 1;
  }
  accessor(array, width, extra = {}) {
    const accessor = {bufferView: this.view(array), componentType: kComponents.get(array.constructor), count: array.length / width, type: kTypes[width], ...extra};
    if (width < 4 && array instanceof Float32Array) {
      accessor.min = Array.from({length: width}, (_, c) => array.reduce((m, v, i) => i % width === c ? Math.min(m, v) : m, Infinity));
      accessor.max = Array.from({length: width}, (_, c) => array.reduce((m, v, i) => i % width === c ? Math.max(m, v) : m, -Infinity));
    }
    return this.json.accessors.push(accessor) - 1;
  }
  floats(numbers, width) { return this.accessor(Float32Array.from(numbers), width); }
  sparse(count, where, what) {
    const indices = this.view(Uint16Array.from(where)), values = this.view(Float32Array.from(what));
    const each = c => what.filter((_, i) => i % 3 === c).concat(0);
    return this.json.accessors.push({componentType: 5126, count, type: 'VEC3', min: [0, 1, 2].map(c => Math.min(...each(c))), max: [0, 1, 2].map(c => Math.max(...each(c))),
      sparse: {count: where.length, indices: {bufferView: indices, componentType: 5123}, values: {bufferView: values}}}) - 1;
  }
  node(node, isRoot = true) {
    const index = this.json.nodes.push(node) - 1;
    if (isRoot) this.json.scenes[0].nodes.push(index);
    return index;
  }
  animate(name, channels) {
    const animation = {name, channels: [], samplers: []};
    for (const {node, path: what, times, values, width = {rotation: 4, weights: 1}[what] ?? 3, interpolation} of channels) {
      const output = typeof values === 'number' ? values : this.floats(values, width);
      const sampler = animation.samplers.push({input: this.floats(times, 1), output, interpolation: interpolation ?? 'LINEAR'}) - 1;
      animation.channels.push({sampler, target: {node, path: what}});
    }
    (this.json.animations ??= []).push(animation);
  }
  write(file) {
    this.json.buffers = [{byteLength: this.size}];
    let text = JSON.stringify(this.json);
    text += ' '.repeat((4 - Buffer.byteLength(text) % 4) % 4);
    const head = Buffer.alloc(20), binary = Buffer.alloc(8), length = Buffer.byteLength(text);
    head.write('glTF');
    [2, 28 + length + this.size, length, 0x4e4f534a].forEach((v, i) => head.writeUInt32LE(v, 4 + 4 * i));
    [this.size, 0x004e4942].forEach((v, i) => binary.writeUInt32LE(v, 4 * i));
    fs.writeFileSync(file, Buffer.concat([head, Buffer.from(text), binary, ...this.bytes]));
  }
}

/// A tube along y from 0 to 1, with a seam: positions, normals, texture coordinates, indices.
function tube(rings = 12, sectors = 10) {
  const tube = {positions: [], normals: [], uvs: [], indices: [], heights: []};
  for (let r = 0; r <= rings; ++r)
    for (let s = 0; s <= sectors; ++s) {
      const a = 2 * Math.PI * (s % sectors) / sectors, y = r / rings;
      tube.positions.push(0.15 * Math.cos(a), y, 0.15 * Math.sin(a));
      tube.normals.push(Math.cos(a), 0, Math.sin(a));
      tube.uvs.push(s / sectors, y);
      tube.heights.push(y);
    }
  for (let r = 0; r < rings; ++r)
    for (let s = 0; s < sectors; ++s) {
      const i = r * (sectors + 1) + s, j = i + sectors + 1;
      tube.indices.push(i, j, i + 1, i + 1, j, j + 1);
    }
  return tube;
}

function addTube(b, {uvs = true, normals = true, targets, weights, names, attributes = {}, primitives = 1} = {}) {
  const t = tube();
  const list = {POSITION: b.floats(t.positions, 3)};
  if (normals) list.NORMAL = b.floats(t.normals, 3);
  if (uvs) list.TEXCOORD_0 = b.floats(t.uvs, 2);
  for (const [name, make] of Object.entries(attributes)) list[name] = make(t);
  const mesh = {primitives: []};
  const made = targets?.map(make => make(t));
  for (let i = 0; i < primitives; ++i) {
    const size = t.indices.length / primitives;
    const primitive = {attributes: list, indices: b.accessor(Uint16Array.from(t.indices.slice(i * size, (i + 1) * size)), 1)};
    if (made) primitive.targets = made;
    mesh.primitives.push(primitive);
  }
  if (weights) mesh.weights = weights;
  if (names) mesh.extras = {targetNames: names};
  return b.json.meshes.push(mesh) - 1;
}

/// `count` joints along y, each the child of the one before; their nodes.
function addChain(b, count, {matrices = true, first = {}} = {}) {
  const joints = [];
  for (let i = 0; i < count; ++i) joints.push(b.node({name: `bone ${i}`, ...(i > 0 ? {translation: [0, 1 / count, 0]} : first)}, i === 0));
  joints.forEach((joint, i) => i > 0 && (b.json.nodes[joints[i - 1]].children = [joint]));
  const skin = {joints};
  if (matrices) skin.inverseBindMatrices = b.floats(joints.flatMap((_, i) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -i / count, 0, 1]), 16);
  (b.json.skins ??= []).push(skin);
  return joints;
}

/// The shares that a place at `height` has of `count` joints, by distance; they sum to 1.
function shares(height, count) {
  const raw = Array.from({length: count}, (_, i) => Math.max(0, 1.2 / count - Math.abs(height - i / count)) + 1e-3);
  const sum = raw.reduce((a, v) => a + v);
  return raw.map(v => v / sum);
}

const all = (t, make) => t.heights.flatMap(make);
const jointsOf = (b, first = 0, type = Uint8Array) => t => b.accessor(type.from(all(t, () => [0, 1, 2, 3].map(i => first + i))), 4);
const weightsOf = (b, count, first = 0) => t => b.floats(all(t, y => shares(y, count).slice(first, first + 4)), 4);
const around = (axis, degrees) => {
  const s = Math.sin(degrees * Math.PI / 360);
  return [axis === 'x' ? s : 0, axis === 'y' ? s : 0, axis === 'z' ? s : 0, Math.cos(degrees * Math.PI / 360)];
};
const bend = (joints, extra = {}) => joints.map((node, i) => ({node, path: 'rotation', times: [0, 0.4, 1], values: [...around('z', 0), ...around('z', 25 + 5 * i), ...around('x', -30)], ...extra}));
const skinned = b => ({JOINTS_0: jointsOf(b), WEIGHTS_0: weightsOf(b, 4)});
const bulge = b => t => ({POSITION: b.floats(t.heights.flatMap((y, i) => [0, 1, 2].map(c => 0.3 * Math.sin(3 * y) * t.normals[3 * i + c])), 3), NORMAL: b.floats(t.heights.flatMap(y => [0, -0.4 * Math.cos(3 * y), 0]), 3)});
const lean = b => t => ({POSITION: b.sparse(t.heights.length, [100, 101, 120, 140], [0.1, 0, 0, 0.1, 0.1, 0, 0.2, 0, 0.1, 0, 0.3, 0])});

/// name: what is in the file.
export const kFiles = {
  two_joints(b) {
    const mesh = addTube(b, {attributes: {JOINTS_0: t => b.accessor(Uint8Array.from(all(t, () => [0, 1, 0, 0])), 4), WEIGHTS_0: t => b.floats(all(t, y => [1 - y, y, 0, 0]), 4)}});
    const joints = addChain(b, 2);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  eight_weights(b) {
    const mesh = addTube(b, {attributes: {JOINTS_0: jointsOf(b), WEIGHTS_0: weightsOf(b, 8), JOINTS_1: jointsOf(b, 4, Uint16Array), WEIGHTS_1: weightsOf(b, 8, 4)}});
    const joints = addChain(b, 8);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  sparse_morph(b) {
    const node = b.node({mesh: addTube(b, {targets: [lean(b), bulge(b)], weights: [0.25, 0], names: ['lean', 'bulge']})});
    b.animate('shapes', [{node, path: 'weights', times: [0, 0.5, 1.5], values: [0, 0, 1, 0.3, 0.2, 1]}]);
  },
  sparse_base(b) {
    const mesh = addTube(b);
    const accessor = b.json.accessors[b.json.meshes[mesh].primitives[0].attributes.POSITION];
    accessor.sparse = {count: 1, indices: {bufferView: b.view(Uint16Array.from([60])), componentType: 5123}, values: {bufferView: b.view(Float32Array.from([0.1, 0.6, 0.1]))}};
    b.animate('go', [{node: b.node({mesh}), path: 'translation', times: [0, 1], values: [0, 0, 0, 1, 2, 3]}]);
  },
  tangent_morph(b) {
    const tangents = t => b.floats(t.heights.flatMap((_, i) => [-t.normals[3 * i + 2], 0, t.normals[3 * i], 1]), 4);
    const target = t => ({...bulge(b)(t), TANGENT: b.floats(t.heights.flatMap(y => [0, 0.2 * y, 0]), 3)});
    const node = b.node({mesh: addTube(b, {attributes: {TANGENT: tangents}, targets: [target]})});
    b.animate('0', [{node, path: 'weights', times: [0, 1], values: [0, 1]}]);
  },
  cubic_rotation(b) {
    const node = b.node({mesh: addTube(b)});
    const turn = (degrees, slope) => [0, 0, slope, 0, ...around('z', degrees), 0.1, 0, slope, 0];
    b.animate('turn', [{node, path: 'rotation', times: [0.2, 0.7, 2], values: [...turn(0, 1), ...turn(70, -0.5), ...turn(160, 0.3)], interpolation: 'CUBICSPLINE'}]);
  },
  cubic_weights(b) {
    const node = b.node({mesh: addTube(b, {targets: [lean(b), bulge(b)]})});
    b.animate('swell', [{node, path: 'weights', times: [0, 1], values: [0, 0, 0, 0, 2, 1, 1, 3, 1, 0.5, 0, 0], interpolation: 'CUBICSPLINE'}]);
  },
  cubic_place(b) {
    const node = b.node({mesh: addTube(b), rotation: around('y', 30)});
    b.animate('fly', [
      {node, path: 'translation', times: [0, 0.3, 1], values: [0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0, 1, 1, 0, 0, 2, 0, 0, 0, 1, 1, 2, 3, 0, 0, 0], interpolation: 'CUBICSPLINE'},
      {node, path: 'scale', times: [0, 1], values: [0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 1, 0, 2, 1, 0.5, 0, 0, 0], interpolation: 'CUBICSPLINE'}]);
  },
  step(b) {
    const node = b.node({mesh: addTube(b)});
    b.animate('jump', [{node, path: 'translation', times: [0, 0.5, 1], values: [0, 0, 0, 1, 0, 0, 0, 1, 0], interpolation: 'STEP'},
                       {node, path: 'rotation', times: [0.25, 0.75], values: [...around('x', 0), ...around('x', 90)], interpolation: 'STEP'}]);
  },
  mirrored_node(b) {
    const node = b.node({mesh: addTube(b), scale: [-1, 1, 1]});
    b.animate('mirror', [{node, path: 'scale', times: [0, 1], values: [-1, 1, 1, 1.5, 0.8, 1]}, {node, path: 'rotation', times: [0, 1], values: [...around('z', 10), ...around('z', 200)]}]);
  },
  mirrored_skin(b) {
    const mesh = addTube(b, {attributes: skinned(b)});
    const joints = addChain(b, 4, {first: {scale: [1, 1, -2]}});
    b.node({mesh, skin: 0, translation: [5, 5, 5]});
    b.animate('bend', bend(joints));
  },
  uneven_scale(b) {
    const mesh = addTube(b, {attributes: skinned(b), targets: [bulge(b)], weights: [0.5]});
    const joints = addChain(b, 4, {first: {scale: [1, 2, 0.5], rotation: around('x', 40)}});
    const node = b.node({mesh, skin: 0});
    b.animate('bend', [...bend(joints), {node: joints[2], path: 'scale', times: [0, 1], values: [1, 1, 1, 0.3, 1, 3]}, {node, path: 'weights', times: [0, 1], values: [1, 0]}]);
  },
  two_meshes_one_skin(b) {
    const meshes = [addTube(b, {attributes: skinned(b)}), addTube(b, {attributes: skinned(b), uvs: false})];
    const joints = addChain(b, 4);
    meshes.forEach(mesh => b.node({mesh, skin: 0}));
    b.animate('bend', bend(joints));
  },
  byte_weights(b) {
    const bytes = t => b.accessor(Uint8Array.from(all(t, y => { const a = Math.round(255 * (1 - y)); return [a, 255 - a, 0, 0]; })), 4, {normalized: true});
    const mesh = addTube(b, {attributes: {JOINTS_0: jointsOf(b), WEIGHTS_0: bytes}});
    const joints = addChain(b, 4);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  short_weights(b) {
    const shorts = t => b.accessor(Uint16Array.from(all(t, y => { const a = Math.round(65535 * y * y); return [a, 65535 - a, 0, 0]; })), 4, {normalized: true});
    const mesh = addTube(b, {attributes: {JOINTS_0: jointsOf(b, 0, Uint16Array), WEIGHTS_0: shorts}});
    const joints = addChain(b, 4);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  short_rotations(b) {
    const node = b.node({mesh: addTube(b)});
    const values = b.accessor(Int16Array.from([around('x', 0), around('x', 80), around('y', 100)].flat().map(v => Math.round(32767 * v))), 4, {normalized: true});
    b.animate('turn', [{node, path: 'rotation', times: [0, 0.5, 1], values}]);
  },
  no_matrices(b) {
    const mesh = addTube(b, {attributes: skinned(b)});
    const joints = addChain(b, 4, {matrices: false});
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  matrix_parent(b) {
    const child = b.node({mesh: addTube(b), translation: [0, 1, 0]}, false);
    b.node({matrix: [0, 2, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 3, 0, 0, 1], children: [child]});
    b.animate('turn', [{node: child, path: 'rotation', times: [0, 1], values: [...around('y', 0), ...around('y', 170)]}]);
  },
  sum_not_one(b) {
    const mesh = addTube(b, {attributes: {JOINTS_0: jointsOf(b), WEIGHTS_0: t => b.floats(all(t, y => [2 - y, y, 0, 0]), 4)}});
    const joints = addChain(b, 4);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  node_weights(b) {
    const mesh = addTube(b, {targets: [lean(b), bulge(b)], weights: [1, 0]});
    b.node({mesh, weights: [0, 0.6]});
    b.node({mesh, translation: [2, 0, 0]});
  },
  shared_vertices(b) {
    const mesh = addTube(b, {attributes: skinned(b), targets: [bulge(b), lean(b)], primitives: 3});
    const joints = addChain(b, 4);
    const node = b.node({mesh, skin: 0});
    b.animate('both', [...bend(joints), {node, path: 'weights', times: [0, 1], values: [0, 0, 1, 1]}]);
    b.animate('shape', [{node, path: 'weights', times: [0, 2], values: [1, 0, 0, 1]}]);
  },
  no_normals(b) {
    const mesh = addTube(b, {attributes: skinned(b), normals: false, uvs: false});
    const joints = addChain(b, 4);
    b.node({mesh, skin: 0});
    b.animate('bend', bend(joints));
  },
  /// Between two halves, closed at rest: triangles that have no area there, and a row of vertices of their own.
  opening_gap(b) {
    const row = y => [0, 1, 2].flatMap(i => [i, y, 0]);
    const list = {POSITION: b.floats([...row(1), ...row(0), ...row(0), ...row(0), ...row(-1)], 3)};
    const strip = above => [0, 1].flatMap(i => [above + i, above + 3 + i, above + i + 1, above + i + 1, above + 3 + i, above + i + 4]);
    const indices = b.accessor(Uint16Array.from([0, 3, 6, 9].flatMap(strip)), 1);
    const opens = b.floats([[0, 0.5, 0], [0, 0.5, 0], [0, 0, 0.3], [0, -0.5, 0], [0, -0.5, 0]].flatMap(by => [...by, ...by, ...by]), 3);
    const mesh = b.json.meshes.push({primitives: [{attributes: list, indices, targets: [{POSITION: opens}]}]}) - 1;
    b.animate('open', [{node: b.node({mesh}), path: 'weights', times: [0, 1], values: [0, 1]}]);
  },
  camera_and_nodes(b) {
    b.json.cameras = [{type: 'perspective', perspective: {yfov: 0.8, znear: 0.1}}];
    const camera = b.node({name: 'camera', camera: 0, translation: [0, 0, 5]}, false);
    const still = b.node({name: 'still', mesh: addTube(b), translation: [1, 0, 0]}, false);
    const root = b.node({name: 'root', children: [camera, still], extras: {kept: [1, 2]}});
    b.animate('orbit', [{node: root, path: 'rotation', times: [0, 1], values: [...around('y', 0), ...around('y', 120)]}]);
  },
};

export function generate(folder) {
  fs.mkdirSync(folder, {recursive: true});
  return Object.entries(kFiles).map(([name, make]) => {
    const b = new Builder();
    make(b);
    const file = path.join(folder, name + '.glb');
    b.write(file);
    return file;
  });
}

if (process.argv[1]?.endsWith('generated.mjs')) generate(process.argv[2]);
