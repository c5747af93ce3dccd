// node judge.mjs PROBE TEGUMENT [LEAST]: how glTF files move, before and after `tegument prep`, against three.js: those of generated.mjs; with
// LEAST at least so many of the folder $TEGUMENT_GLTF_SAMPLES, which are drawn at five times, too. A line for each file; exit code 1 where
// one is apart by more than 1e-5 of what it reaches, lost something, or is refused by Khronos's validator.

import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import {execFileSync} from 'node:child_process';
import {createRequire} from 'node:module';
import {generate} from './generated.mjs';
import {apart, load, open, places, player, reachOf, read} from './player.mjs';

const [probe, tegument, least] = process.argv.slice(2);
const given = least === undefined ? undefined : process.env.TEGUMENT_GLTF_SAMPLES;
const tools = path.join(process.env.TEGUMENT_CACHE ?? path.join(process.env.XDG_CACHE_HOME ?? path.join(os.homedir(), '.cache'), 'tegument'), 'tools');
const kMost = 1e-5;
const three = path.join(tools, 'three'), judges = path.join(tools, 'gltf');
for (const needed of [path.join(three, 'node_modules/three'), path.join(judges, 'node_modules/gltf-validator')])
  if (!fs.existsSync(needed)) {
    console.log(`skipped: ${needed} is not there: ./bootstrap test fetches it where npm is`);
    process.exit(77);
  }
if (least !== undefined && !given) {
  console.log("skipped: set TEGUMENT_GLTF_SAMPLES to a folder of glTF files that move, such as Khronos's samples");
  process.exit(77);
}
const validator = createRequire(import.meta.url)(path.resolve(judges, 'node_modules/gltf-validator'));
const work = fs.mkdtempSync(path.join(os.tmpdir(), 'tegument-motion-'));
process.on('exit', () => fs.rmSync(work, {recursive: true}));
console.warn = console.error = () => {};

const run = (program, ...args) => execFileSync(program, args, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe'], maxBuffer: 1 << 28});

function filesBelow(folder) {
  const moves = file => {
    try {
      const {json} = open(file);
      return json.meshes && (json.animations || json.skins || json.meshes.some(mesh => mesh.primitives.some(primitive => primitive.targets)));
    } catch { return false; }
  };
  return fs.readdirSync(folder, {recursive: true}).filter(name => /\.gl(tf|b)$/.test(name)).sort().map(name => path.join(folder, name)).filter(moves);
}

async function messages(file) {
  const report = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), {
    maxIssues: 1000, ignoredIssues: ['IO_ERROR'],
    externalResourceFunction: async uri => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))))});
  const of = severity => [...new Set(report.issues.messages.filter(message => message.severity === severity).map(message => message.code))];
  return {errors: of(0), warnings: of(1)};
}

function probed(file, animation, times) {
  const out = path.join(work, 'places.bin');
  const count = +run(probe, file, out, animation === null ? '-' : String(animation), ...times.map(String));
  return read(out, count, times.length);
}

/// Those that move nodes; KHR_animation_pointer moves other things.
const channels = animation => animation.channels.filter(channel => channel.target.node !== undefined && channel.target.path !== 'pointer');

/// What an accessor stands for, as floats.
function numbersOf({json, buffers}, index) {
  const accessor = json.accessors[index];
  const width = {SCALAR: 1, VEC2: 2, VEC3: 3, VEC4: 4, MAT4: 16}[accessor.type];
  const [size, get, most] = {5120: [1, 'readInt8', 127], 5121: [1, 'readUInt8', 255], 5122: [2, 'readInt16LE', 32767], 5123: [2, 'readUInt16LE', 65535], 5125: [4, 'readUInt32LE', 1], 5126: [4, 'readFloatLE', 1]}[accessor.componentType];
  const result = new Float32Array(width * accessor.count);
  const stored = ({bufferView, byteOffset = 0}, i, stride) => {
    const view = json.bufferViews[bufferView];
    const value = buffers[view.buffer][get]((view.byteOffset ?? 0) + byteOffset + Math.floor(i / width) * (stride ?? view.byteStride ?? width * size) + i % width * size);
    return accessor.normalized ? Math.max(Math.fround(value / most), -1) : value;
  };
  if (accessor.bufferView !== undefined) result.forEach((_, i) => { result[i] = stored(accessor, i); });
  if (accessor.sparse) {
    const {count, indices, values} = accessor.sparse;
    const where = numbersOf({json: {...json, accessors: [{...indices, count, type: 'SCALAR'}]}, buffers}, 0);
    for (let i = 0; i < count * width; ++i) result[where[Math.floor(i / width)] * width + i % width] = stored(values, i, width * size);
  }
  return result;
}

/// Nodes, skins and animations of the first that the second does not have, number for number.
function lost(before, after) {
  const found = [];
  const sorted = value => Array.isArray(value) ? value.map(sorted)
    : value && typeof value === 'object' ? Object.fromEntries(Object.keys(value).sort().map(key => [key, sorted(value[key])])) : value;
  const same = (a, b) => JSON.stringify(sorted(a)) === JSON.stringify(sorted(b));
  const numbers = (file, index) => index === undefined ? [] : Array.from(numbersOf(file, index));
  const packed = before.json.bufferViews.some(view => view.extensions);
  before.json.nodes.forEach((node, i) => {
    if (node.extensions?.MSFT_lod) return;
    for (const key of ['name', 'translation', 'rotation', 'scale', 'matrix', 'children', 'camera', 'weights', 'extras'])
      if (node[key] !== undefined && !same(node[key], after.json.nodes[i][key]) && !(key === 'weights' && node.mesh === undefined)) found.push(`${key} of node ${i}`);
  });
  if (!same(before.json.cameras, after.json.cameras)) found.push('cameras');
  (before.json.skins ?? []).forEach((skin, i) => {
    const other = after.json.skins?.[i];
    if (!other || !same(skin.joints, other.joints) || (!packed && !same(numbers(before, skin.inverseBindMatrices), numbers(after, other.inverseBindMatrices)))) found.push(`skin ${i}`);
  });
  (before.json.animations ?? []).filter(animation => channels(animation).length > 0).forEach((animation, i) => {
    const other = after.json.animations?.[i];
    if (!other || animation.name !== other.name) return found.push(`animation ${i}`);
    channels(animation).forEach((channel, k) => {
      const a = animation.samplers[channel.sampler], b = other.samplers[other.channels[k].sampler];
      if (!same(channel.target.node, other.channels[k].target.node) || channel.target.path !== other.channels[k].target.path || (a.interpolation ?? 'LINEAR') !== (b.interpolation ?? 'LINEAR')) found.push(`channel ${k} of animation ${i}`);
      if (!packed && !(same(numbers(before, a.input), numbers(after, b.input)) && same(numbers(before, a.output), numbers(after, b.output)))) found.push(`keys of channel ${k} of animation ${i}`);
    });
  });
  return found;
}

function draw(file, animation, times) {
  const morphs = JSON.parse(run(tegument, 'info', file, '--json')).morphs;
  const mapped = open(file).json.meshes.every(mesh => mesh.primitives.every(primitive => primitive.attributes.TEXCOORD_0 !== undefined));
  times.forEach((seconds, i) => {
    const moment = animation !== null ? ['--animation', String(animation), '--time', String(seconds)] : morphs.length > 0 ? ['--morph', `${morphs[0].name}=${i / 4}`] : [];
    run(tegument, 'render', mapped ? 'OriginalTexture' : 'Fur', '--mesh', file, '--size', '64', '--samples', '1', ...moment, '-o', path.join(work, 'drawn.png'));
  });
}

async function judge(file, drawn) {
  const faults = [];
  let worst = 0;
  const note = (what, value, reach) => {
    worst = Math.max(worst, value / reach);
    if (!(value <= kMost * reach)) faults.push(`${what}: ${(value / reach).toExponential(2)} of its reach apart`);
  };
  const made = path.join(work, 'made.glb'), report = path.join(work, 'report.json');
  run(tegument, 'prep', file, '--unit-mm', '1000', '-o', made, '--report', report);
  const {centre, warnings} = JSON.parse(fs.readFileSync(report));
  const moved = centre.moved.map(v => v / 1000);
  const back = rows => rows.map(row => row.map((v, i) => v - moved[i % 3]));
  const before = await load(await library, file), after = await load(await library, made);
  const moving = (before.json.animations ?? []).map((animation, i) => channels(animation).length > 0 ? i : -1).filter(i => i >= 0);
  const animations = moving.length > 0 ? moving.map((_, i) => i).slice(0, 4) : [null];
  for (const animation of animations) {
    const theirs = animation === null ? null : moving[animation];
    const length = animation === null ? 0 : before.gltf.animations[theirs].duration;
    const times = [0, 0.21, 0.5, 0.83, 1.1].map(share => share * length);
    const wanted = places(before, theirs, times);
    const reach = reachOf(wanted);
    note(`animation ${animation} as read`, apart(wanted, probed(file, animation, times), reach), reach);
    note(`animation ${animation} as written, by three.js`, apart(wanted, back(places(after, animation, times)), reach), reach);
    note(`animation ${animation} as written, as read again`, apart(wanted, back(probed(made, animation, times)), reach), reach);
    if (drawn) draw(made, animation, times);
  }
  faults.push(...lost(open(file), open(made)).map(what => `${what} is lost`));
  const was = await messages(file), is = await messages(made);
  const refused = is.errors.filter(code => !was.errors.includes(code));
  if (refused.length > 0) faults.push(`the validator refuses it: ${refused}`);
  // a root with a skin whose joints are its children is moved with them, by a node above
  const rooted = before.json.scenes?.[before.json.scene ?? 0]?.nodes.some(i => before.json.nodes[i].skin !== undefined && before.json.nodes[i].children);
  const fresh = is.warnings.filter(code => !was.warnings.includes(code) && !(rooted && code === 'NODE_SKINNED_MESH_NON_ROOT'));
  if (fresh.length > 0) faults.push(`the validator warns anew: ${fresh}`);
  const told = warnings.filter(warning => warning.code === 'TG5331' || warning.code === 5331).map(warning => warning.text);
  console.log(`${faults.length > 0 ? 'FAILED' : 'ok'} ${path.basename(file)}: ${animations.length} animations, ${worst.toExponential(2)} apart${told.length > 0 ? '; ' + told.join('; ') : ''}`);
  faults.forEach(fault => console.log('    ' + fault));
  return {good: faults.length === 0, worst};
}

const library = player(three);
const files = given ? filesBelow(given) : generate(path.join(work, 'generated'));
let good = 0, failed = 0, worst = 0, skipped = 0;
for (const file of files) {
  try {
    const result = await judge(file, given !== undefined);
    result.good ? ++good : ++failed;
    worst = Math.max(worst, result.worst);
  } catch (error) {
    const text = String(error.stderr || error.stack || error);
    const unknown = /DRACOLoader|setMeshoptDecoder/.test(text); // the reference cannot read it
    unknown ? ++skipped : ++failed;
    console.log(`${unknown ? 'not judged' : 'FAILED'} ${path.basename(file)}: ${text.trim().split('\n').slice(0, 3).join(' | ')}`);
  }
}
console.log(`${good} files move as three.js moves them, ${failed} do not, ${skipped} cannot be read by it; ${worst.toExponential(2)} apart at most`);
process.exit(failed > 0 || good < +(least ?? 20) ? 1 : 0);
