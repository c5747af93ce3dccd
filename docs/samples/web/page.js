// The page: unpacks what make.py has put into it, draws, turns by pointer and keys. `view` is what tests use.
"use strict";
import { Effect, freeTarget, makeMesh, makeTarget, makeTexture, missing, plainTexture, play } from "./effect.js";
import { makeScene } from "./scene.js";

const DISPLAY = `#version 300 es
precision highp float;
uniform sampler2D picture;
out vec4 color;
void main() {
    ivec2 size = textureSize(picture, 0);
    vec3 c = max(texelFetch(picture, ivec2(gl_FragCoord.x, float(size.y) - gl_FragCoord.y), 0).rgb, 0.0);
    vec3 t = max(c - 0.8, 0.0) / 0.2;
    c = min(c, 0.8) + 0.2 * t / (1.0 + t);
    color = vec4(mix(1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, c * 12.92, lessThanEqual(c, vec3(0.0031308))), 1.0);
}`;
const CORNERS = `#version 300 es
void main() { gl_Position = vec4(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1, 0, 1); }`;

const canvas = document.querySelector("canvas");
const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
const data = JSON.parse(document.querySelector("#data").textContent);
const subjects = new Map();
const angles = { turn: 0, tilt: 0, near: 1 };

function say(text) {
  document.querySelector("#message").textContent = text;
}

async function unpack(text) {
  const packed = Uint8Array.from(atob(text), letter => letter.charCodeAt(0));
  return new Uint8Array(await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("deflate"))).arrayBuffer());
}

async function imageTexture({ picture, srgb }) {
  const image = await createImageBitmap(new Blob([await unpack(picture)]), { premultiplyAlpha: "none", colorSpaceConversion: "none" });
  const levels = 1 + Math.floor(Math.log2(Math.max(image.width, image.height)));
  const texture = makeTexture(gl, srgb ? "SRGB8_ALPHA8" : "RGBA8", image.width, image.height, levels);
  gl.pixelStorei(gl.UNPACK_PREMULTIPLY_ALPHA_WEBGL, false);
  gl.pixelStorei(gl.UNPACK_COLORSPACE_CONVERSION_WEBGL, gl.NONE);
  gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, gl.RGBA, gl.UNSIGNED_BYTE, image);
  gl.generateMipmap(gl.TEXTURE_2D);
  return texture;
}

// All levels of all faces, as a DDS file has them.
async function cubeTexture({ texels, size, levels }) {
  const bytes = await unpack(texels);
  const texture = makeTexture(gl, "RGBA8", size, size, levels, true);
  let at = 0;
  for (let face = 0; face < 6; ++face)
    for (let level = 0; level < levels; ++level) {
      const side = Math.max(1, size >> level);
      gl.texSubImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, level, 0, 0, side, side, gl.RGBA, gl.UNSIGNED_BYTE, bytes.subarray(at, (at += side * side * 4)));
    }
  return texture;
}

// What an effect draws once for others, such as a table: the target of that name.
function product({ effect, technique, target }) {
  const maker = new Effect(gl, data.effects[effect].manifest, data.effects[effect].texts);
  const picture = { color: makeTarget(gl, "A16B16G16R16F", 16, 16), depth: makeTarget(gl, "D24S8", 16, 16) };
  maker.run(technique, picture, maker.quad, () => undefined);
  return maker.target(target);
}

async function open(name) {
  const source = data.subjects[name];
  const effect = new Effect(gl, data.effects[source.effect].manifest, data.effects[source.effect].texts);
  for (const [texture, image] of Object.entries(source.textures))
    effect.setTexture(texture, image.picture ? await imageTexture(image) : await cubeTexture(image));
  for (const [texture, color] of Object.entries(source.plain)) effect.setTexture(texture, plainTexture(gl, color));
  for (const [texture, made] of Object.entries(source.products)) effect.setTexture(texture, product(made));
  for (const [parameter, value] of Object.entries(source.workspace.parameters ?? {})) effect.set(parameter, ...[value].flat());
  const [vertices, indices] = [await unpack(source.vertices), await unpack(source.indices)];
  const wide = source.index_bytes === 4 ? Uint32Array : Uint16Array;
  const mesh = makeMesh(gl, vertices, new wide(indices.buffer));
  return { source, effect, mesh };
}

// Made once, however often it is asked for meanwhile.
async function loaded(name) {
  if (!subjects.has(name)) {
    say("loading ...");
    subjects.set(name, open(name));
    await subjects.get(name);
    say("");
  }
  return subjects.get(name);
}

let picture;
function pictureOf(width, height) {
  if (picture?.color.width === width && picture.color.height === height) return picture;
  if (picture) freeTarget(gl, picture.color), freeTarget(gl, picture.depth);
  return (picture = { color: makeTarget(gl, "A16B16G16R16F", width, height), depth: makeTarget(gl, "D24S8", width, height) });
}

function clearPicture({ color, depth }, background) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, color.handle, 0);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_STENCIL_ATTACHMENT, gl.RENDERBUFFER, depth.handle);
  gl.colorMask(true, true, true, true);
  gl.depthMask(true);
  gl.clearBufferfv(gl.COLOR, 0, [...background, 1]);
  gl.clearBufferfi(gl.DEPTH_STENCIL, 0, 1, 0);
  gl.deleteFramebuffer(framebuffer);
}

let display;
function present({ color }) {
  if (!display) {
    display = gl.createProgram();
    for (const [kind, text] of [[gl.VERTEX_SHADER, CORNERS], [gl.FRAGMENT_SHADER, DISPLAY]]) {
      const shader = gl.createShader(kind);
      gl.shaderSource(shader, text);
      gl.compileShader(shader);
      gl.attachShader(display, shader);
    }
    gl.linkProgram(display);
  }
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.viewport(0, 0, color.width, color.height);
  for (const what of [gl.DEPTH_TEST, gl.CULL_FACE, gl.BLEND]) gl.disable(what);
  gl.colorMask(true, true, true, true);
  gl.useProgram(display);
  gl.bindVertexArray(null);
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_2D, color.handle);
  gl.bindSampler(0, null);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.drawArrays(gl.TRIANGLES, 0, 3);
}

function paint({ source, effect, mesh }, technique = source.technique) {
  const target = pictureOf(canvas.width, canvas.height);
  clearPicture(target, source.workspace.background);
  effect.run(technique, target, mesh, makeScene(source.workspace, source.bounds, canvas.width / canvas.height, angles));
  present(target);
  const error = gl.getError();
  if (error !== gl.NO_ERROR) throw new Error(`WebGL error ${error}`);
}

async function draw(name, technique) {
  paint(await loaded(name), technique);
}

let current, waiting = false;
function again() {
  if (waiting) return;
  waiting = true;
  requestAnimationFrame(async () => {
    waiting = false;
    try {
      const name = current, subject = await loaded(name);
      if (name === current) paint(subject); // another may have been chosen meanwhile
    } catch (error) {
      say(error.message);
    }
  });
}

function turn(x, y, near = 1) {
  angles.turn -= x * 0.01;
  angles.tilt += y * 0.01;
  angles.near = Math.min(2, Math.max(0.3, angles.near * near));
  again();
}

function controls() {
  const list = document.querySelector("select");
  for (const [name, { title }] of Object.entries(data.subjects)) list.add(new Option(title, name));
  list.onchange = () => {
    current = list.value;
    again();
  };
  canvas.onpointerdown = event => canvas.setPointerCapture(event.pointerId);
  canvas.onpointermove = event => event.buttons && turn(event.movementX, event.movementY);
  canvas.addEventListener("wheel", event => (event.preventDefault(), turn(0, 0, Math.exp(event.deltaY * 0.001))), { passive: false });
  const keys = { ArrowLeft: [20, 0], ArrowRight: [-20, 0], ArrowUp: [0, 10], ArrowDown: [0, -10], "+": [0, 0, 0.9], "-": [0, 0, 1.1] };
  canvas.onkeydown = event => keys[event.key] && (event.preventDefault(), turn(...keys[event.key]));
}

const lacking = gl ? missing(gl) : ["WebGL 2"];
if (lacking.length) say(`This browser has no ${lacking.join(", ")}.`);
else {
  controls();
  current = Object.keys(data.subjects)[0];
  if (!location.hash.includes("still")) again();
}
window.view = { draw, play, canvas, angles, lacking, subjects: Object.keys(data.subjects) };
document.body.dataset.ready = "yes";
