// Skin and fur as objects of three.js (WebGLRenderer); made for a folder by make.py, which says how. An object's picture passes are its
// children, drawn where three.js draws meshes; what they read is drawn before the first of them, by `onBeforeRender`.
//
//   scene.add(new Skin((await new GLTFLoader().loadAsync("head.glb")).scene, { light }));
//   scene.add(new Fur(new THREE.Mesh(geometry), { light, map: await loadFur("fur_cube.dds"), preset: "shaggy" }));
import * as THREE from "three";
import { play, targetSize } from "./effect.js";
import { effects, presets } from "./effects.js";

const FORMATS = {
  A16B16G16R16F: [THREE.RGBAFormat, THREE.HalfFloatType], G16R16F: [THREE.RGFormat, THREE.HalfFloatType], R16F: [THREE.RedFormat, THREE.HalfFloatType],
  A32B32G32R32F: [THREE.RGBAFormat, THREE.FloatType], G32R32F: [THREE.RGFormat, THREE.FloatType], R32F: [THREE.RedFormat, THREE.FloatType],
  A8R8G8B8: [THREE.RGBAFormat, THREE.UnsignedByteType], A8B8G8R8: [THREE.RGBAFormat, THREE.UnsignedByteType],
};
const FACTORS = { ZERO: THREE.ZeroFactor, ONE: THREE.OneFactor, SRC_COLOR: THREE.SrcColorFactor, INV_SRC_COLOR: THREE.OneMinusSrcColorFactor,
  SRC_ALPHA: THREE.SrcAlphaFactor, INV_SRC_ALPHA: THREE.OneMinusSrcAlphaFactor, DEST_ALPHA: THREE.DstAlphaFactor,
  INV_DEST_ALPHA: THREE.OneMinusDstAlphaFactor, DEST_COLOR: THREE.DstColorFactor, INV_DEST_COLOR: THREE.OneMinusDstColorFactor };
const EQUATIONS = { ADD: THREE.AddEquation, SUBTRACT: THREE.SubtractEquation, REV_SUBTRACT: THREE.ReverseSubtractEquation, MIN: THREE.MinEquation,
  MAX: THREE.MaxEquation };
const DEPTHS = { NEVER: THREE.NeverDepth, LESS: THREE.LessDepth, EQUAL: THREE.EqualDepth, LESS_EQUAL: THREE.LessEqualDepth, GREATER: THREE.GreaterDepth,
  NOT_EQUAL: THREE.NotEqualDepth, GREATER_EQUAL: THREE.GreaterEqualDepth, ALWAYS: THREE.AlwaysDepth };
const INPUTS = { position: "POSITION0", normal: "NORMAL0", tangent: "TANGENT0", uv: "TEXCOORD0" };
const DEPTH_0_1 = new THREE.Matrix4().set(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0.5, 0.5, 0, 0, 0, 1); // OpenGL's -1..1 as the effects have it
const MARGIN = 1 + 1e-3; // these three as host/scene/view.cpp
const LEAST_NEAR = 1e-3;
const WIDEST_LIGHT = 160;

function fail(message) {
  throw new Error(`tegument: ${message}`);
}

// ---- Texts of `tegument check --emit --emit-kind glsl-es`

// Parameters become uniforms of their own. Targets keep their first row on top, as the texts have it; the picture is three.js's, which is
// the other way round and wants three.js's tone mapping and colour space.
function converted(text, onPicture) {
  let made = text.replace(/^#version.*\n/, "").replace(/layout\(location = \d+\) in /g, "in ");
  const [block, members, name] = /layout\(std140\) uniform Globals\s*\{([^}]*)\}\s*(\w+);/.exec(made) ?? [];
  if (block) made = made.replace(block, members.replace(/layout\(\w+\) /g, "").replace(/^\s*(?=\S)/gm, "uniform ")).replaceAll(`${name}.`, "");
  if (!onPicture) return made;
  made = made.replace("gl_Position.y = -gl_Position.y;", "").replace(/\bdFdy\(/g, "-dFdy(")
    .replace(/\bgl_FragCoord\b/g, "vec4(gl_FragCoord.x - viewportPlace.x, viewportPlace.w - (gl_FragCoord.y - viewportPlace.y), gl_FragCoord.zw)");
  if (!made.includes("output_SV_TARGET0")) return made;
  return `uniform vec4 viewportPlace;\n${made.replace("void main()", "void drawn()")}
void main() {
    drawn();
    #ifdef TONE_MAPPING
    output_SV_TARGET0.rgb = toneMapping(output_SV_TARGET0.rgb);
    #endif
    output_SV_TARGET0 = linearToOutputTexel(output_SV_TARGET0);
}`;
}

function sideOf({ cull, front_counter_clockwise: usual }, onPicture) {
  if (cull === "NONE") return THREE.DoubleSide;
  return (cull === "BACK") === (usual === onPicture) ? THREE.FrontSide : THREE.BackSide; // a target is drawn upside down
}

function stated(states, onPicture) {
  const [target] = states.targets;
  if (states.stencil_test) fail("no stencil test");
  if (states.targets.some(other => JSON.stringify(other) !== JSON.stringify(target)) || ![0, 15].includes(target.write_mask)) fail("no masks of channels");
  const made = { depthTest: states.depth_test, depthWrite: states.depth_write, depthFunc: DEPTHS[states.depth_compare], side: sideOf(states, onPicture),
    colorWrite: target.write_mask !== 0, polygonOffset: states.depth_bias !== 0 || states.slope_scaled_depth_bias !== 0,
    polygonOffsetFactor: states.slope_scaled_depth_bias, polygonOffsetUnits: states.depth_bias, blending: THREE.NoBlending };
  if (!target.blend) return made;
  const factor = name => FACTORS[name] ?? fail(`no blend factor ${name}`);
  return { ...made, transparent: true, blending: THREE.CustomBlending, blendEquation: EQUATIONS[target.op], blendEquationAlpha: EQUATIONS[target.op_alpha],
    blendSrc: factor(target.src), blendDst: factor(target.dest), blendSrcAlpha: factor(target.src_alpha), blendDstAlpha: factor(target.dest_alpha) };
}

// ---- Geometry, textures, cameras

function plainTexture(color) {
  const texture = new THREE.DataTexture(new Float32Array(color), 1, 1, THREE.RGBAFormat, THREE.FloatType);
  texture.needsUpdate = true;
  return texture;
}

// The tangent of a mesh without texture coordinates, as host/run/geometry.cpp has it.
function tangentsOf({ position, normal }) {
  const made = new THREE.BufferAttribute(new Float32Array(4 * position.count), 4), n = new THREE.Vector3(), aside = new THREE.Vector3();
  for (let i = 0; i < position.count; ++i) {
    n.fromBufferAttribute(normal, i);
    aside.set(...(Math.abs(n.x) < 0.5 ? [1, 0, 0] : [0, 1, 0])).cross(n).normalize();
    made.setXYZW(i, aside.x, aside.y, aside.z, 1);
  }
  return made;
}

// The triangles of all meshes of an object as one, where they share their vertices, as those do that `tegument prep` writes.
function geometryOf(meshes) {
  const [{ geometry: first }] = meshes, { position } = first.attributes;
  if (meshes.some(other => other.geometry.attributes.position !== position)) fail("meshes with vertices of their own: BufferGeometryUtils.mergeGeometries joins them");
  if (meshes.some(({ isSkinnedMesh, geometry }) => isSkinnedMesh || geometry.morphAttributes.position)) fail("no skinned meshes, no morph targets");
  const made = new THREE.BufferGeometry();
  for (const name of Object.keys(INPUTS)) if (first.attributes[name]) made.setAttribute(name, first.attributes[name]);
  made.setIndex(meshes.flatMap(({ geometry: { index } }) => Array.from(index?.array ?? Array(position.count).keys())));
  if (!first.attributes.normal) made.computeVertexNormals();
  if (!first.attributes.tangent && first.attributes.uv) made.computeTangents();
  if (!made.attributes.tangent) made.setAttribute("tangent", tangentsOf(made.attributes));
  if (!first.attributes.uv) made.setAttribute("uv", new THREE.BufferAttribute(new Float32Array(2 * position.count), 2));
  return named(made);
}

function named(geometry) {
  for (const [name, semantic] of Object.entries(INPUTS))
    if (geometry.attributes[name]) geometry.setAttribute(`attribute_${semantic}`, geometry.attributes[name]);
  return geometry;
}

function quad() {
  const made = new THREE.BufferGeometry();
  made.setAttribute("position", new THREE.Float32BufferAttribute([-1, 1, 0, -1, -1, 0, 1, 1, 0, 1, -1, 0], 3));
  made.setAttribute("uv", new THREE.Float32BufferAttribute([0, 0, 0, 1, 1, 0, 1, 1], 2));
  made.setIndex([0, 1, 2, 2, 1, 3]);
  return named(made);
}

// A cube map of fur as `tegument fur texture` writes it: DDS, 8 bits, all levels of a face after each other.
export async function loadFur(url) {
  const answer = await fetch(url);
  if (!answer.ok) fail(`${url}: ${answer.status}`);
  const bytes = await answer.arrayBuffer(), words = new DataView(bytes), word = i => words.getUint32(i, true);
  const [size, levels] = [word(16), word(28)], least = 148;
  if (bytes.byteLength < least || word(0) !== 0x20534444 || word(128) !== 28 || (word(136) & 4) === 0) fail(`${url} is no cube map of fur`);
  let at = least;
  const faces = Array.from({ length: 6 }, () => Array.from({ length: levels }, (_, level) => {
    const side = Math.max(1, size >> level);
    return new THREE.DataTexture(new Uint8Array(bytes, at, (at += side * side * 4, side * side * 4)), side, side);
  }));
  const texture = new THREE.CubeTexture(faces.map(([largest]) => largest));
  texture.mipmaps = Array.from({ length: levels - 1 }, (_, i) => ({ image: faces.map(face => face[i + 1]) }));
  Object.assign(texture, { generateMipmaps: false, minFilter: THREE.LinearMipmapLinearFilter, colorSpace: THREE.NoColorSpace, needsUpdate: true });
  return texture;
}

function viewOf(camera) {
  const projection = new THREE.Matrix4().multiplyMatrices(DEPTH_0_1, camera.projectionMatrix);
  return { VIEW: camera.matrixWorldInverse.elements, PROJECTION: projection.elements, NEARCLIP: [camera.near], FARCLIP: [camera.far],
    VIEWPROJECTION: new THREE.Matrix4().multiplyMatrices(projection, camera.matrixWorldInverse).elements };
}

// What the light sees: a pyramid around the object, of parallel light a box. Its colour is what a white matt surface facing it reflects.
function lightOf(light, { center, radius }) {
  const place = new THREE.Vector3().setFromMatrixPosition(light.matrixWorld), wide = radius * MARGIN;
  let camera, strength = light.intensity / Math.PI;
  if (light.isDirectionalLight) {
    light.target.updateWorldMatrix(true, false);
    const along = new THREE.Vector3().setFromMatrixPosition(light.target.matrixWorld).sub(place).normalize();
    camera = new THREE.OrthographicCamera(-wide, wide, wide, -wide, 0, 2 * wide);
    place.copy(center).addScaledVector(along, -wide);
  } else {
    const away = place.distanceTo(center), margin = Math.max(wide, away * (MARGIN - 1)), far = Math.max(away + margin, LEAST_NEAR);
    const angle = away > wide ? (2 * Math.asin(wide / away) * 180) / Math.PI : WIDEST_LIGHT;
    camera = new THREE.PerspectiveCamera(angle, 1, Math.max(away - margin, far * LEAST_NEAR), far);
    strength /= away ** (light.decay ?? 0);
  }
  camera.position.copy(place);
  camera.lookAt(center);
  camera.updateMatrixWorld();
  return { ...viewOf(camera), POSITION: place.toArray(), DIFFUSE: light.color.toArray().map(value => value * strength) };
}

// ---- An effect

const stage = { scene: new THREE.Scene(), camera: new THREE.Camera(), mesh: new THREE.Mesh(), quad: quad() };
stage.scene.add(stage.mesh);
stage.scene.matrixWorldAutoUpdate = stage.mesh.matrixWorldAutoUpdate = stage.mesh.frustumCulled = false;

// What is drawn once for others, such as a table: by renderer, effect and target.
const products = new WeakMap();
function product(renderer, source) {
  const [, effect, target] = /(\w+)\.fx\/(\w+)$/.exec(source) ?? fail(`no producer ${source}`);
  if (!products.has(renderer)) products.set(renderer, new Map());
  const made = products.get(renderer);
  if (!made.has(effect)) {
    const [{ name }] = (effects[effect] ?? fail(`no effect ${effect}`)).manifest.techniques;
    made.set(effect, new Passes(effect, name));
    made.get(effect).run(renderer, [1, 1], () => undefined);
  }
  return made.get(effect).textures.get(target);
}

class Passes {
  constructor(effect, technique) {
    const { manifest, texts } = effects[effect] ?? fail(`no effect ${effect}`);
    Object.assign(this, { manifest, texts, targets: new Map(), textures: new Map(), numbers: {}, materials: new Map(), place: { value: [0, 0, 1, 1] } });
    this.technique = manifest.techniques.find(({ name }) => name === technique) ?? fail(`${effect} has no technique ${technique}`);
    this.parameters = new Map(manifest.parameters.map(parameter => [parameter.name, parameter]));
    for (const { name, default: value, type } of manifest.parameters)
      if (/^(float|int|bool)/.test(type)) this.numbers[name] = { value: Array.isArray(value) ? value.flat(2) : value ?? Array(16).fill(0) };
    this.annotated("Fallback", (name, color, { type }) => type === "Texture2D" && this.textures.set(name, plainTexture(color)));
  }

  annotated(annotation, use) {
    for (const parameter of this.manifest.parameters) if (parameter.annotations[annotation]) use(parameter.name, parameter.annotations[annotation], parameter);
  }

  set(name, value) {
    const { value: old } = this.numbers[name] ?? fail(`no parameter ${name}`);
    const numbers = [value?.toArray?.() ?? value].flat().map(Number);
    if (numbers.length !== [old].flat().length || numbers.some(Number.isNaN)) fail(`${name} takes ${[old].flat().length} numbers`);
    this.numbers[name].value = Array.isArray(old) ? numbers : numbers[0];
  }

  // The passes that a script draws now: `target(colors)` gives what to draw to, nothing for the picture.
  play(does) {
    let bound;
    const value = name => ({ numbers: [this.numbers[name]?.value ?? fail(`${name} has no value`)].flat(), bool: this.parameters.get(name).type === "bool" });
    play(this.technique, { setTargets: (colors, depth) => (bound = { colors: colors.filter(name => name !== undefined), depth }), value, setNumber: (name, number) => this.set(name, number),
      clear: (...what) => bound.colors[0] !== "" && does.clear?.(bound, ...what),
      draw: (pass, isQuad) => (bound.colors[0] === "" ? does.picture?.(pass, isQuad) : does.draw?.(bound, pass, isQuad)) });
  }

  picturePasses() {
    const passes = [];
    this.play({ picture: (pass, isQuad) => passes.push(isQuad ? fail(`pass ${pass.name} covers the picture`) : pass) });
    return passes;
  }

  material(pass, onPicture) {
    if (!this.materials.has(pass)) {
      const shaders = [pass.vertex_shader, pass.pixel_shader].map(name => this.manifest.shaders.find(shader => shader.name === name)["glsl-es"]);
      const [vertexShader, fragmentShader] = shaders.map(({ file }) => converted(this.texts[file], onPicture));
      const samplers = shaders.flatMap(shader => shader.samplers);
      const uniforms = { ...this.numbers, viewportPlace: this.place };
      for (const { name } of samplers) uniforms[name] = { value: null };
      const material = new THREE.ShaderMaterial({ name: pass.name, glslVersion: THREE.GLSL3, vertexShader, fragmentShader, uniforms, ...stated(pass.states, onPicture) });
      this.materials.set(pass, { material, samplers });
    }
    return this.materials.get(pass);
  }

  // One of three.js's render targets for each set of targets that passes write together.
  targetFor(renderer, { colors, depth }, picture) {
    const key = colors.join(), { annotations } = this.parameters.get(colors[0]);
    const [width, height] = targetSize(annotations, picture);
    let made = this.targets.get(key);
    if (!made) {
      made = new THREE.WebGLRenderTarget(width, height, { count: colors.length, depthBuffer: depth !== "", generateMipmaps: false });
      colors.forEach((name, i) => this.adopt(made.textures[i], name));
      this.targets.set(key, made);
    } else if (made.width === width && made.height === height) return made;
    made.setSize(width, height);
    renderer.initRenderTarget(made);
    return made;
  }

  adopt(texture, name) {
    if (this.textures.get(name)?.isRenderTargetTexture) fail(`${name} is drawn with other targets besides`);
    const { Format: format = "A8R8G8B8", MipLevels: levels = 1 } = this.parameters.get(name).annotations;
    if (levels !== 1) fail(`${name} has levels`);
    [texture.format, texture.type] = FORMATS[format] ?? fail(`no format ${format}`);
    this.textures.set(name, texture);
  }

  // Samplers of one target differ by pass; three.js knows one of a texture.
  bind(renderer, { material, samplers }) {
    const gl = renderer.getContext();
    for (const { name, texture: source, sampler } of samplers) {
      const texture = this.textures.get(source) ?? fail(`texture ${source} is missing`);
      material.uniforms[name].value = texture;
      const { __webglTexture: handle } = texture.isRenderTargetTexture ? renderer.properties.get(texture) : {};
      if (!handle) continue;
      const { states } = this.manifest.samplers.find(other => other.name === sampler);
      renderer.state.bindTexture(gl.TEXTURE_2D, handle);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, states.min === "POINT" ? gl.NEAREST : gl.LINEAR);
      gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, states.mag === "POINT" ? gl.NEAREST : gl.LINEAR);
    }
  }

  // All passes but the picture's. scene(semantic, object): numbers, or undefined.
  run(renderer, picture, scene, geometry, matrix = new THREE.Matrix4()) {
    for (const { name, semantic, annotations, type } of this.manifest.parameters) {
      const numbers = semantic && /^(float|int)/.test(type) ? scene(semantic.toUpperCase(), annotations.Object) : undefined;
      if (numbers) this.numbers[name].value = numbers.length === 1 ? numbers[0] : Array.from(numbers);
    }
    this.annotated("Producer", (name, source) => this.textures.has(name) || this.textures.set(name, product(renderer, source)));
    const bound = what => {
      const target = this.targetFor(renderer, what, picture);
      renderer.setRenderTarget(target);
      this.resolution(target.width, target.height);
    };
    const gl = renderer.getContext(), { color, depth } = renderer.state.buffers;
    const clear = (what, kind, index, value) => {
      bound(what);
      color.setMask(true), depth.setMask(true);
      if (kind === "depth") gl.clearBufferfv(gl.DEPTH, 0, value);
      else if (kind === "color") what.colors.forEach((_, i) => (index ?? i) === i && gl.clearBufferfv(gl.COLOR, i, value));
    };
    const draw = (what, pass, isQuad) => {
      if (pass.annotations.Instances) fail(`pass ${pass.name} draws instances into a target`);
      const made = this.material(pass, false);
      bound(what);
      this.bind(renderer, made);
      stage.mesh.material = made.material;
      stage.mesh.geometry = isQuad ? stage.quad : geometry;
      stage.mesh.matrixWorld.copy(matrix);
      renderer.render(stage.scene, stage.camera);
    };
    undisturbed(renderer, () => this.play({ clear, draw }));
    this.resolution(...picture);
  }

  resolution(width, height) {
    for (const { name, semantic } of this.manifest.parameters) if (semantic?.toUpperCase() === "VIEWPORTPIXELSIZE") this.numbers[name].value = [width, height];
  }

  dispose() {
    for (const { material } of this.materials.values()) material.dispose();
    for (const target of this.targets.values()) target.dispose();
  }
}

// What three.js was about to draw goes on as if nothing had been drawn between.
function undisturbed(renderer, draw) {
  const [target, face, level] = [renderer.getRenderTarget(), renderer.getActiveCubeFace(), renderer.getActiveMipmapLevel()];
  const kept = [[renderer, "autoClear"], [renderer.xr, "enabled"], [renderer.shadowMap, "autoUpdate"], [renderer.info, "autoReset"]].map(([owner, name]) => [owner, name, owner[name]]);
  for (const [owner, name] of kept) owner[name] = false;
  try {
    draw();
  } finally {
    for (const [owner, name, value] of kept) owner[name] = value;
    renderer.setRenderTarget(target, face, level);
  }
}

// ---- Objects

class Drawn extends THREE.Group {
  // object: a mesh or what a loader gives; it stays as it is, and this stands where it stood.
  constructor(effect, technique, object, { light, unitMm = 1000, parameters = {} }) {
    super();
    if (!light?.isLight) fail("{ light } wants a light of three.js");
    const meshes = [];
    object.updateWorldMatrix(true, true);
    object.traverse(child => child.isMesh && meshes.push(child));
    if (!meshes.length) fail("no mesh in the object");
    const [{ matrixWorld, material, userData }] = meshes;
    matrixWorld.decompose(this.position, this.quaternion, this.scale);
    this.passes = new Passes(effect, technique);
    Object.assign(this, { light, unitMm, source: [material].flat()[0], geometry: geometryOf(meshes) });
    this.bounds = this.boundsOf(userData.tegument?.bounds);
    this.set(parameters);
  }

  // Of what `tegument prep` wrote, its own; else three.js's.
  boundsOf(prepared) {
    if (prepared) return new THREE.Sphere(new THREE.Vector3(...prepared.centre), prepared.radius);
    this.geometry.computeBoundingSphere();
    return this.geometry.boundingSphere.clone();
  }

  // { gRoughness: 0.4, ... }: the names that `tegument info` prints, lengths in millimetres unless it says otherwise.
  set(parameters) {
    for (const [name, value] of Object.entries(parameters)) this.passes.set(name, value);
    const { gFurLength, gFurLayers } = this.passes.numbers;
    this.geometry.boundingSphere = this.bounds.clone();
    this.geometry.boundingSphere.radius *= 1 + Math.max(gFurLength?.value ?? 0, 0);
    const passes = this.passes.picturePasses();
    for (const pass of passes) if (!this.children.some(child => child.userData.pass === pass)) this.add(this.meshOf(pass));
    for (const child of this.children) {
      child.visible = passes.includes(child.userData.pass);
      child.geometry.boundingSphere = this.geometry.boundingSphere;
      if (child.geometry.isInstancedBufferGeometry) child.geometry.instanceCount = Math.max(0, Math.trunc(gFurLayers.value));
    }
    return this;
  }

  meshOf(pass) {
    const made = this.passes.material(pass, true);
    let { geometry } = this;
    if (pass.annotations.Instances) {
      geometry = new THREE.InstancedBufferGeometry();
      Object.assign(geometry, { index: this.geometry.index, attributes: this.geometry.attributes });
    }
    const mesh = new THREE.Mesh(geometry, made.material);
    mesh.userData.pass = pass;
    mesh.onBeforeRender = (renderer, scene, camera) => {
      if (mesh === this.children[0]) this.prepare(renderer, camera);
      this.passes.bind(renderer, made);
    };
    return mesh;
  }

  prepare(renderer, camera) {
    if (renderer.capabilities.logarithmicDepthBuffer || camera.reversedDepth) fail("no logarithmic, no reversed depth");
    if (!camera.isPerspectiveCamera) fail("only perspective cameras");
    const place = renderer.getCurrentViewport(new THREE.Vector4());
    this.light.updateWorldMatrix(true, false);
    const center = this.bounds.center.clone().applyMatrix4(this.matrixWorld), radius = this.bounds.radius * this.matrixWorld.getMaxScaleOnAxis();
    const views = { PointLight0: lightOf(this.light, { center, radius }), "": viewOf(camera) };
    const fixed = { WORLD: this.matrixWorld.elements, WORLDINVERSETRANSPOSE: this.matrixWorld.clone().invert().transpose().elements, UNITMM: [this.unitMm],
      CAMERAPOSITION: new THREE.Vector3().setFromMatrixPosition(camera.matrixWorld).toArray(), BOUNDINGCENTER: center.toArray(), BOUNDINGSPHERESIZE: [radius] };
    this.passes.place.value = place.toArray();
    this.passes.run(renderer, [place.z, place.w], (semantic, object) => views[object ?? ""]?.[semantic] ?? fixed[semantic], this.geometry, this.matrixWorld);
  }

  dispose() {
    this.passes.dispose();
    for (const { geometry } of this.children) geometry.dispose();
  }
}

// technique: "Separable11" scatters in screen space; "PreintegratedPenumbra", "Preintegrated" look scattering up.
export class Skin extends Drawn {
  constructor(object, { technique = "Separable11", map, normalMap, ...rest }) {
    super(technique.startsWith("Pre") ? "Preintegrated" : "Separable", technique, object, rest);
    const { source } = this;
    this.passes.textures.set("gSkinMap", map ?? source.map ?? plainTexture([...(source.color ?? new THREE.Color(0xc08d78)).toArray(), 1]));
    if (normalMap ?? source.normalMap) this.passes.textures.set("gNormalMap", normalMap ?? source.normalMap);
  }
}

// Shells. map: of loadFur; preset: a name of `presets`, whose parameters come first.
export class Fur extends Drawn {
  constructor(object, { map, preset, parameters, ...rest }) {
    if (preset && !presets[preset]) fail(`no preset ${preset}: ${Object.keys(presets).join(", ")}`);
    super("Fur", "CubePosition", object, { ...rest, parameters: { ...presets[preset], ...parameters } });
    this.passes.textures.set("gFurCubeMap", map?.isCubeTexture ? map : fail("{ map } wants a cube map of loadFur"));
  }
}

export { presets };
