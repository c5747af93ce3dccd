// The vertices of a glTF file as three.js moves them: its reader, its AnimationMixer, its joints and morph targets. Weights are summed here,
// for it knows no more than four. Textures are left out: they need a browser.

import fs from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

globalThis.ProgressEvent ??= class extends Event {}; // three.js reports how far it has read
globalThis.self ??= globalThis;

export async function player(tools) {
  const folder = path.resolve(tools, 'node_modules/three');
  const THREE = await import(pathToFileURL(path.join(folder, 'build/three.module.js')));
  const {GLTFLoader} = await import(pathToFileURL(path.join(folder, 'examples/jsm/loaders/GLTFLoader.js')));
  THREE.SkinnedMesh.prototype.normalizeSkinWeights = () => {}; // looks at the first four of eight weights only
  return {THREE, GLTFLoader};
}

/// {json, buffers} of a .glb or .gltf.
export function open(file) {
  const bytes = fs.readFileSync(file);
  let json, own;
  if (bytes.toString('latin1', 0, 4) === 'glTF') {
    const length = bytes.readUInt32LE(12);
    json = JSON.parse(bytes.toString('utf8', 20, 20 + length));
    if (bytes.length > 28 + length) own = bytes.subarray(28 + length, 28 + length + bytes.readUInt32LE(20 + length));
  } else {
    json = JSON.parse(bytes.toString('utf8').replace(/^\uFEFF/, ''));
  }
  const buffers = (json.buffers ?? []).map(buffer => {
    if (buffer.uri === undefined) return own;
    if (buffer.uri.startsWith('data:')) return Buffer.from(buffer.uri.slice(buffer.uri.indexOf(',') + 1), 'base64');
    return fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(buffer.uri)));
  });
  return {json, buffers};
}

export async function load({THREE, GLTFLoader}, file) {
  const {json, buffers} = open(file);
  json.buffers = buffers.map(b => ({byteLength: b.length, uri: 'data:application/octet-stream;base64,' + b.toString('base64')}));
  for (const key of ['materials', 'textures', 'images', 'samplers']) delete json[key];
  for (const mesh of json.meshes ?? [])
    for (const primitive of mesh.primitives) {
      delete primitive.material;
      delete primitive.extensions?.KHR_materials_variants;
    }
  delete json.extensions?.KHR_materials_variants;
  json.extensionsUsed = (json.extensionsUsed ?? []).filter(name => !name.includes('materials') && !name.includes('texture'));
  json.extensionsRequired = (json.extensionsRequired ?? []).filter(name => !name.includes('materials') && !name.includes('texture'));
  const gltf = await new GLTFLoader().parseAsync(JSON.stringify(json), '');
  return {THREE, gltf, json};
}

/// The default pose, or `animation` (a number) at a time; before the first and after the last key things stand still.
function pose(loaded, animation, seconds) {
  const {THREE, gltf} = loaded;
  loaded.mixer?.stopAllAction(); // and all is as it was
  if (animation !== null) {
    const mixer = loaded.mixer = new THREE.AnimationMixer(gltf.scene);
    const action = mixer.clipAction(gltf.animations[animation]);
    action.setLoop(THREE.LoopOnce);
    action.clampWhenFinished = true;
    action.play();
    mixer.setTime(Math.min(seconds, gltf.animations[animation].duration));
  }
  gltf.scene.updateMatrixWorld(true);
}

/// Weights that do not sum to 1 are divided by their sum; where it is 0 the first joint has all.
function vertexOf(THREE, mesh, i) {
  const {attributes} = mesh.geometry;
  if (!mesh.isSkinnedMesh) return mesh.getVertexPosition(i, new THREE.Vector3()).applyMatrix4(mesh.matrixWorld);
  const morphed = THREE.Mesh.prototype.getVertexPosition.call(mesh, i, new THREE.Vector3());
  const at = bone => morphed.clone().applyMatrix4(mesh.skeleton.bones[bone].matrixWorld.clone().multiply(mesh.skeleton.boneInverses[bone]));
  const place = new THREE.Vector3();
  let sum = 0;
  for (const [joints, weights] of [[attributes.skinIndex, attributes.skinWeight], [attributes.joints_1, attributes.weights_1]])
    for (const part of joints ? ['getX', 'getY', 'getZ', 'getW'] : []) {
      const weight = weights[part](i);
      if (weight !== 0) place.addScaledVector(at(joints[part](i)), weight);
      sum += weight;
    }
  return sum > 0 ? place.divideScalar(sum) : at(attributes.skinIndex.getX(i));
}

/// For each vertex that a triangle uses its places at all the times, one after another. Triangles with two corners at one place all the time
/// use none, for nothing of them is seen: `all` has their vertices, too.
export function places(loaded, animation, times) {
  const {THREE, gltf} = loaded;
  const rows = [], corners = [];
  times.forEach((seconds, t) => {
    pose(loaded, animation, seconds);
    let row = 0;
    gltf.scene.traverse(mesh => {
      if (!mesh.isMesh || mesh.isPoints || mesh.isLine) return;
      const index = mesh.geometry.index;
      const count = mesh.geometry.attributes.position.count;
      if (t === 0) for (let k = 0; k < (index ? index.count : count); ++k) corners.push(row + (index ? index.getX(k) : k));
      for (let i = 0; i < count; ++i, ++row) {
        const p = vertexOf(THREE, mesh, i);
        (rows[row] ??= new Float64Array(3 * times.length)).set([p.x, p.y, p.z], 3 * t);
      }
    });
  });
  const used = new Uint8Array(rows.length);
  const one = (a, b) => rows[a].every((v, i) => v === rows[b][i]);
  for (let k = 0; k + 2 < corners.length; k += 3) {
    const [a, b, c] = corners.slice(k, k + 3);
    if (!one(a, b) && !one(b, c) && !one(c, a)) used[a] = used[b] = used[c] = 1;
  }
  return Object.assign(rows.filter((_, i) => used[i]), {all: rows});
}

/// The largest distance from a row to the nearest row of the other list, in all times together, both ways; the first may have more (`all`).
export function apart(a, b, reach) {
  const cell = Math.max(reach * 1e-3, 1e-12);
  const oneWay = (from, to) => {
    const cells = new Map();
    const key = (x, y, z) => `${x},${y},${z}`;
    const at = v => Math.floor(v / cell);
    to.forEach(row => {
      const k = key(at(row[0]), at(row[1]), at(row[2]));
      if (!cells.has(k)) cells.set(k, []);
      cells.get(k).push(row);
    });
    let worst = 0;
    for (const row of from) {
      let best = Infinity;
      for (let x = -1; x <= 1; ++x)
        for (let y = -1; y <= 1; ++y)
          for (let z = -1; z <= 1; ++z)
            for (const other of cells.get(key(at(row[0]) + x, at(row[1]) + y, at(row[2]) + z)) ?? []) {
              let far = 0;
              for (let i = 0; i < row.length; i += 3) far = Math.max(far, Math.hypot(row[i] - other[i], row[i + 1] - other[i + 1], row[i + 2] - other[i + 2]));
              best = Math.min(best, far);
              if (best === 0) break;
            }
      worst = Math.max(worst, best);
    }
    return worst;
  };
  return Math.max(oneWay(a, b), oneWay(b, a.all ?? a));
}

export function read(file, vertices, times) {
  const bytes = fs.readFileSync(file);
  const numbers = new Float64Array(bytes.buffer, bytes.byteOffset, bytes.length / 8);
  const rows = [];
  for (let i = 0; i < vertices; ++i) {
    const row = new Float64Array(3 * times);
    for (let t = 0; t < times; ++t) row.set(numbers.subarray(3 * (t * vertices + i), 3 * (t * vertices + i) + 3), 3 * t);
    rows.push(row);
  }
  return rows;
}

/// The diagonal of the box round all rows in all times.
export function reachOf(rows) {
  const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
  for (const row of rows)
    row.forEach((v, i) => {
      low[i % 3] = Math.min(low[i % 3], v);
      high[i % 3] = Math.max(high[i % 3], v);
    });
  return Math.hypot(...high.map((v, i) => v - low[i]));
}
