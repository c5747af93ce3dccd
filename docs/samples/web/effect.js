// An effect of `tegument check --emit --emit-kind glsl-es` in WebGL 2: makes the targets that its manifest declares, fills the block of
// parameters, walks the scripts and draws. Plain JavaScript, no dependency; an engine's own part is `scene` (see page.js).
"use strict";

const FORMATS = {
  A16B16G16R16F: ["RGBA16F"], A32B32G32R32F: ["RGBA32F"], R16F: ["R16F"], G16R16F: ["RG16F"], R32F: ["R32F"], G32R32F: ["RG32F"],
  A8R8G8B8: ["RGBA8"], A8B8G8R8: ["RGBA8"], D24S8: ["DEPTH24_STENCIL8", "depth"],
};
const BLEND = { ZERO: "ZERO", ONE: "ONE", SRC_COLOR: "SRC_COLOR", INV_SRC_COLOR: "ONE_MINUS_SRC_COLOR", SRC_ALPHA: "SRC_ALPHA",
  INV_SRC_ALPHA: "ONE_MINUS_SRC_ALPHA", DEST_ALPHA: "DST_ALPHA", INV_DEST_ALPHA: "ONE_MINUS_DST_ALPHA", DEST_COLOR: "DST_COLOR",
  INV_DEST_COLOR: "ONE_MINUS_DST_COLOR", SRC_ALPHA_SAT: "SRC_ALPHA_SATURATE", BLEND_FACTOR: "CONSTANT_COLOR",
  INV_BLEND_FACTOR: "ONE_MINUS_CONSTANT_COLOR" };
const BLEND_OP = { ADD: "FUNC_ADD", SUBTRACT: "FUNC_SUBTRACT", REV_SUBTRACT: "FUNC_REVERSE_SUBTRACT", MIN: "MIN", MAX: "MAX" };
const COMPARE = { NEVER: "NEVER", LESS: "LESS", EQUAL: "EQUAL", LESS_EQUAL: "LEQUAL", GREATER: "GREATER", NOT_EQUAL: "NOTEQUAL",
  GREATER_EQUAL: "GEQUAL", ALWAYS: "ALWAYS" };
const ADDRESS = { CLAMP: "CLAMP_TO_EDGE", WRAP: "REPEAT", MIRROR: "MIRRORED_REPEAT" };
const VERTEX = [["POSITION0", 3, 0], ["NORMAL0", 3, 12], ["TANGENT0", 4, 24], ["TEXCOORD0", 2, 40]]; // of 48 bytes

// What effects ask of WebGL 2 besides its core; the names that are not there.
export function missing(gl) {
  return ["EXT_color_buffer_float", "OES_texture_float_linear"].filter(name => !gl.getExtension(name));
}

// ---- Meshes, textures, targets

export function makeMesh(gl, stream, indices) {
  const array = gl.createVertexArray();
  gl.bindVertexArray(array);
  gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ARRAY_BUFFER, stream, gl.STATIC_DRAW);
  VERTEX.forEach(([, size, offset], place) => {
    gl.enableVertexAttribArray(place);
    gl.vertexAttribPointer(place, size, gl.FLOAT, false, 48, offset);
  });
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, indices, gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return { array, count: indices.length, type: indices instanceof Uint16Array ? gl.UNSIGNED_SHORT : gl.UNSIGNED_INT };
}

export function makeTexture(gl, internal, width, height, levels = 1, cube = false) {
  const kind = cube ? gl.TEXTURE_CUBE_MAP : gl.TEXTURE_2D;
  const texture = { kind, handle: gl.createTexture(), width, height, levels };
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(kind, texture.handle);
  gl.texStorage2D(kind, levels, gl[internal], width, height);
  return texture;
}

// [r, g, b, a] in 0..1, linear: what a texture is that nobody gave.
export function plainTexture(gl, color, cube = false) {
  const texture = makeTexture(gl, "RGBA8", 1, 1, 1, cube);
  const texel = new Uint8Array(color.map(value => Math.round(value * 255)));
  const faces = cube ? [0, 1, 2, 3, 4, 5].map(face => gl.TEXTURE_CUBE_MAP_POSITIVE_X + face) : [gl.TEXTURE_2D];
  for (const face of faces) gl.texSubImage2D(face, 0, 0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, texel);
  return texture;
}

export function makeTarget(gl, format, width, height, levels = 1) {
  const [internal, depth] = FORMATS[format] ?? fail(`no format ${format}`);
  if (!depth) return makeTexture(gl, internal, width, height, levels);
  const target = { depth: true, handle: gl.createRenderbuffer(), width, height };
  gl.bindRenderbuffer(gl.RENDERBUFFER, target.handle);
  gl.renderbufferStorage(gl.RENDERBUFFER, gl[internal], width, height);
  return target;
}

// docs/running.md, "Targets": ViewportRatio wins over Dimensions, that over Width and Height.
export function targetSize({ ViewportRatio: ratio, Dimensions: sizes, Width: width, Height: height }, picture) {
  if (ratio !== undefined) return picture.map((side, axis) => Math.max(1, Math.floor(side * ([ratio].flat()[axis] ?? [ratio].flat()[0]))));
  const [wide, high] = [sizes ?? [width, height]].flat();
  return wide === undefined ? picture : [wide, high ?? wide];
}

export function freeTarget(gl, target) {
  target.depth ? gl.deleteRenderbuffer(target.handle) : gl.deleteTexture(target.handle);
}

function fail(message) {
  throw new Error(message);
}

function makeShader(gl, kind, text, name) {
  const shader = gl.createShader(kind);
  gl.shaderSource(shader, text);
  gl.compileShader(shader);
  return gl.getShaderParameter(shader, gl.COMPILE_STATUS) ? shader : fail(`${name}: ${gl.getShaderInfoLog(shader)}`);
}

// ---- Scripts (docs/scripts.md), as ../player/script_player.h has them

const MOST_IN_LOOP = 65536, MOST_COMMANDS = 1000000, MOST_NESTED = 64; // what takes more is a typing mistake
const RESERVED = ["loopbytype", "loopupdate", "geometrylist", "hint", "scriptsignature"];
const same = (a, b) => a.toLowerCase() === b.toLowerCase();

// Each loop with the place of its end.
function commands(script) {
  const open = [];
  const list = script.replace(/\s/g, "").split(";").filter(Boolean).map((text, i) => {
    const [, word, digit, value] = /^([^=]*?)(\d?)(?:=(.*))?$/.exec(text);
    const command = { name: word.toLowerCase(), digit: Number(digit), value: value ?? "" };
    if (command.name === "loopbycount" && open.push(command) > MOST_NESTED) fail("too many loops in loops");
    if (command.name === "loopend") (open.pop() ?? fail("LoopEnd without a loop")).end = i;
    return command;
  });
  return open.length ? fail("a loop has no end") : list;
}

// `engine`: setTargets(colors, depth), clear(what, place, value), draw(pass, quad), value(name), setNumber(name, number). Names come as the
// script writes them, which may differ from the effect's by case.
export function play(technique, engine) {
  const caller = { colors: [""], depth: "" };
  let loop = { index: 0, count: 0 }, executed = 0;
  const choose = value => {
    const [parameter, options] = value.split("?");
    if (options === undefined) return value;
    const { numbers, bool } = engine.value(parameter);
    return options.split(":")[bool ? (numbers[0] ? 0 : 1) : Math.trunc(numbers[0])] ?? fail(`no option in ${value}`);
  };
  const clear = (what, state) => {
    engine.setTargets(state.colors, state.depth);
    const [, word, place] = /^(color(?=\d?$)|depth$|stencil$)(\d?)/.exec(what.toLowerCase()) ?? fail(`no clear of ${what}`);
    const value = [...(state.clears[word] ? engine.value(state.clears[word]).numbers : { color: [], depth: [1], stencil: [0] }[word])];
    while (word === "color" && value.length < 4) value.push(0);
    engine.clear(word, place === "" ? undefined : Number(place), value);
  };
  const draw = (what, state, pass) => {
    if (!/^(geometry|buffer)$/i.test(what)) fail(`no drawing of ${what}`);
    engine.setTargets(state.colors, state.depth);
    engine.draw(pass, same(what, "buffer"));
  };
  const runPass = (name, state) => {
    const pass = technique.passes.find(other => same(other.name, name)) ?? fail(`no pass ${name}`);
    run(commands(pass.annotations.Script ?? "Draw=Geometry"), { ...state, colors: [...state.colors], clears: { ...state.clears } }, state, pass);
  };
  const execute = (command, state, outside, pass) => {
    if (RESERVED.includes(command.name)) return;
    const option = choose(command.value);
    switch (pass && command.name === "pass" ? "" : command.name) {
      case "pass": return runPass(option, state);
      case "draw": return pass ? draw(option, state, pass) : fail("no command draw");
      case "clear": return clear(option, state);
      case "clearsetcolor": case "clearsetdepth": case "clearsetstencil":
        return void (state.clears[command.name.slice(8)] = option);
      case "rendercolortarget": return void (state.colors[command.digit] = option || (command.digit === 0 ? outside.colors[0] : undefined));
      case "renderdepthstenciltarget": return void (state.depth = option || outside.depth);
      case "loopgetindex": return engine.setNumber(option, loop.index);
      case "loopgetcount": return engine.setNumber(option, loop.count);
      default: return fail(`no command ${command.name}`);
    }
  };
  const run = (list, state, outside, pass, from = 0, to = list.length) => {
    for (let i = from; i < to; ++i) {
      if (++executed > MOST_COMMANDS) fail("the script does not end");
      if (list[i].name === "loopend") continue;
      if (list[i].name !== "loopbycount") {
        execute(list[i], state, outside, pass);
        continue;
      }
      const outer = loop, count = Math.trunc(engine.value(list[i].value).numbers[0]);
      if (!(count >= 0 && count <= MOST_IN_LOOP)) fail(`a loop of ${count}`);
      for (let index = 0; index < count; ++index) {
        loop = { index, count };
        run(list, state, outside, pass, i + 1, list[i].end + 1);
      }
      loop = outer;
      i = list[i].end;
    }
  };
  const passes = technique.passes.map(pass => `Pass=${pass.name}`).join(";");
  run(commands(technique.annotations.Script ?? passes), { ...caller, colors: [...caller.colors], clears: {} }, caller);
}

// ---- An effect

export class Effect {
  // texts: of the manifest's GLSL ES files, by their paths.
  constructor(gl, manifest, texts) {
    Object.assign(this, { gl, manifest, texts, programs: new Map(), targets: new Map(), textures: new Map(), samplers: new Map() });
    this.parameters = new Map(manifest.parameters.map(parameter => [parameter.name, parameter]));
    this.shaders = new Map(manifest.shaders.map(shader => [shader.name, shader]));
    this.values = new Map();
    for (const { name, default: value, type } of manifest.parameters)
      if (value !== null) this.values.set(name, { numbers: [value].flat(2).map(Number), bool: type === "bool" });
    this.buffer = gl.createBuffer();
    this.quad = makeMesh(gl, new Float32Array([[-1, 1, 0, 0], [-1, -1, 0, 1], [1, 1, 1, 0], [1, -1, 1, 1]]
      .flatMap(([x, y, u, v]) => [x, y, 0, 0, 0, 1, 1, 0, 0, 1, u, v])), new Uint16Array([0, 1, 2, 2, 1, 3]));
  }

  set(name, ...numbers) {
    const parameter = this.parameters.get(name) ?? fail(`no parameter ${name}`);
    this.values.set(name, { numbers, bool: parameter.type === "bool" });
  }

  setTexture(name, texture) {
    this.parameters.has(name) ? this.textures.set(name, texture) : fail(`no texture ${name}`);
  }

  target(name) {
    return this.targets.get(name);
  }

  // As the effect writes a name that scripts may write in another case.
  nameOf(name) {
    if (this.parameters.has(name)) return name;
    return this.manifest.parameters.find(other => same(other.name, name))?.name ?? fail(`no parameter ${name}`);
  }

  // Those that are as large as the picture follow it.
  makeTargets(width, height) {
    for (const { name, semantic, annotations } of this.manifest.parameters) {
      const [, kind] = /^RENDER(COLOR|DEPTHSTENCIL)TARGET$/i.exec(semantic) ?? [];
      if (!kind) continue;
      const size = targetSize(annotations, [width, height]);
      const old = this.targets.get(name);
      if (old && old.width === size[0] && old.height === size[1]) continue;
      if (old) freeTarget(this.gl, old);
      const all = 1 + Math.floor(Math.log2(Math.max(...size)));
      const format = annotations.Format ?? (same(kind, "COLOR") ? "A8R8G8B8" : "D24S8");
      this.targets.set(name, makeTarget(this.gl, format, ...size, Math.min(all, annotations.MipLevels ?? 1) || all));
    }
  }

  // picture: { color, depth }, targets of one size; scene(semantic, object): numbers, or undefined.
  run(techniqueName, picture, mesh, scene) {
    this.makeTargets(picture.color.width, picture.color.height);
    for (const { name, semantic, annotations, type } of this.manifest.parameters) {
      const numbers = semantic && /^(float|int)/.test(type) ? scene(semantic.toUpperCase(), annotations.Object) : undefined;
      if (numbers) this.values.set(name, { numbers, bool: false });
    }
    const technique = this.manifest.techniques.find(({ name }) => name === techniqueName) ?? fail(`no technique ${techniqueName}`);
    const engine = { setTargets: (colors, depth) => this.setTargets(colors, depth, picture), clear: (...what) => this.clear(...what),
      draw: (pass, quad) => this.draw(pass, quad ? this.quad : mesh), value: name => this.values.get(this.nameOf(name)) ?? fail(`${name} has no value`),
      setNumber: (name, number) => this.set(this.nameOf(name), number) };
    this.framebuffer = this.gl.createFramebuffer();
    play(technique, engine);
    this.gl.deleteFramebuffer(this.framebuffer);
  }

  setTargets(names, depthName, picture) {
    const { gl } = this;
    const own = name => this.targets.get(this.nameOf(name)) ?? fail(`no target ${name}`);
    const colors = names.map(name => (name === undefined ? undefined : name === "" ? picture.color : own(name)));
    const depth = depthName === "" ? picture.depth : own(depthName);
    const { width, height } = colors[0];
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.framebuffer);
    for (let place = 0; place < 4; ++place)
      gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0 + place, gl.TEXTURE_2D, colors[place]?.handle ?? null, 0);
    const fits = depth.width === width && depth.height === height; // passes that test no depth leave another size bound
    gl.framebufferRenderbuffer(gl.FRAMEBUFFER, gl.DEPTH_STENCIL_ATTACHMENT, gl.RENDERBUFFER, fits ? depth.handle : null);
    gl.drawBuffers(colors.map((color, place) => (color ? gl.COLOR_ATTACHMENT0 + place : gl.NONE)));
    gl.viewport(0, 0, width, height);
    this.bound = colors;
    const size = this.manifest.parameters.find(({ semantic }) => same(semantic, "VIEWPORTPIXELSIZE"));
    if (size) this.set(size.name, width, height);
  }

  clear(what, place, value) {
    const { gl } = this;
    gl.colorMask(true, true, true, true);
    gl.depthMask(true);
    if (what === "depth") return gl.clearBufferfv(gl.DEPTH, 0, value);
    if (what === "stencil") return gl.clearBufferiv(gl.STENCIL, 0, value);
    this.bound.forEach((color, i) => color && (place ?? i) === i && gl.clearBufferfv(gl.COLOR, i, value));
  }

  draw(pass, mesh) {
    const { gl } = this;
    const program = this.program(pass);
    gl.useProgram(program.handle);
    this.upload(program);
    const textures = program.samplers.map(({ texture }) => this.texture(texture)); // made before any is bound
    program.samplers.forEach(({ sampler }, unit) => {
      gl.activeTexture(gl.TEXTURE0 + unit);
      gl.bindTexture(textures[unit].kind, textures[unit].handle);
      gl.bindSampler(unit, this.sampler(sampler));
    });
    this.setStates(pass.states);
    gl.bindVertexArray(mesh.array);
    const count = pass.annotations.Instances;
    if (count) gl.drawElementsInstanced(gl.TRIANGLES, mesh.count, mesh.type, 0, Math.trunc(this.values.get(this.nameOf(count)).numbers[0]));
    else gl.drawElements(gl.TRIANGLES, mesh.count, mesh.type, 0);
    const [target] = this.bound;
    if (target?.levels > 1) gl.bindTexture(target.kind, target.handle), gl.generateMipmap(target.kind);
  }

  program(pass) {
    const key = `${pass.vertex_shader} ${pass.pixel_shader}`;
    if (!this.programs.has(key)) this.programs.set(key, this.link(pass));
    return this.programs.get(key);
  }

  link(pass) {
    const { gl } = this;
    const handle = gl.createProgram();
    const samplers = [];
    for (const [name, kind] of [[pass.vertex_shader, gl.VERTEX_SHADER], [pass.pixel_shader, gl.FRAGMENT_SHADER]]) {
      const shader = this.shaders.get(name)?.["glsl-es"] ?? fail(`${name} has no GLSL ES`);
      // Each text numbers its own inputs; by name all meshes fit all of them.
      const text = kind === gl.VERTEX_SHADER ? this.texts[shader.file].replace(/layout\(location = \d+\) in /g, "in ") : this.texts[shader.file];
      gl.attachShader(handle, makeShader(gl, kind, text, name));
      for (const entry of shader.samplers) if (!samplers.some(other => other.name === entry.name)) samplers.push(entry);
    }
    VERTEX.forEach(([semantic], place) => gl.bindAttribLocation(handle, place, `attribute_${semantic}`));
    gl.linkProgram(handle);
    if (!gl.getProgramParameter(handle, gl.LINK_STATUS)) fail(`${pass.name}: ${gl.getProgramInfoLog(handle)}`);
    gl.useProgram(handle);
    samplers.forEach(({ name }, unit) => gl.uniform1i(gl.getUniformLocation(handle, name), unit));
    return { handle, samplers, ...this.layout(handle) };
  }

  // Where each parameter lies in the block, as the browser says it.
  layout(handle) {
    const { gl } = this;
    const block = gl.getUniformBlockIndex(handle, "Globals");
    if (block === gl.INVALID_INDEX) return { size: 0, members: [] };
    gl.uniformBlockBinding(handle, block, 0);
    const indices = gl.getActiveUniformBlockParameter(handle, block, gl.UNIFORM_BLOCK_ACTIVE_UNIFORM_INDICES);
    const [offsets, matrix, array] = [gl.UNIFORM_OFFSET, gl.UNIFORM_MATRIX_STRIDE, gl.UNIFORM_ARRAY_STRIDE]
      .map(what => gl.getActiveUniforms(handle, indices, what));
    const members = [...indices].map((index, i) => {
      const { name, type } = gl.getActiveUniform(handle, index);
      return { name: name.replace(/^.*\./, "").replace(/\[0\]$/, ""), type, offset: offsets[i], matrix: matrix[i], array: array[i] };
    });
    return { size: gl.getActiveUniformBlockParameter(handle, block, gl.UNIFORM_BLOCK_DATA_SIZE), members };
  }

  upload({ size, members }) {
    const { gl } = this;
    if (!size) return;
    const view = new DataView(new ArrayBuffer(size));
    const whole = [gl.INT, gl.INT_VEC2, gl.INT_VEC3, gl.INT_VEC4, gl.BOOL, gl.UNSIGNED_INT];
    for (const { name, type, offset, matrix, array } of members) {
      const parameter = this.parameters.get(name);
      const value = this.values.get(name)?.numbers;
      if (!value) continue;
      const [, high, columns] = /(?:(\d)x)?(\d)(?:\[\d+\])?$/.exec(parameter.type)?.map(digit => Number(digit ?? 1)) ?? [0, 1, 1];
      const cells = high * columns; // numbers of one matrix
      value.forEach((number, i) => {
        // Rows of vectors are the matrix's columns to GLSL: it is written turned.
        const place = matrix ? Math.trunc(i / cells) * array + (i % columns) * matrix + (Math.trunc(i / columns) % high) * 4
          : array ? Math.trunc(i / columns) * array + (i % columns) * 4 : i * 4;
        if (offset + place + 4 > size) return;
        if (whole.includes(type)) view.setInt32(offset + place, number, true);
        else view.setFloat32(offset + place, number, true);
      });
    }
    gl.bindBufferBase(gl.UNIFORM_BUFFER, 0, this.buffer);
    gl.bufferData(gl.UNIFORM_BUFFER, view.buffer, gl.DYNAMIC_DRAW);
  }

  texture(name) {
    if (!this.targets.has(name) && !this.textures.has(name)) {
      const { type, annotations } = this.parameters.get(name);
      if (!annotations.Fallback) fail(`texture ${name} is missing`);
      this.textures.set(name, plainTexture(this.gl, annotations.Fallback, type === "TextureCube"));
    }
    return this.textures.get(name) ?? this.targets.get(name);
  }

  sampler(name) {
    if (this.samplers.has(name)) return this.samplers.get(name);
    const { gl } = this;
    const { states } = this.manifest.samplers.find(other => other.name === name) ?? fail(`no sampler ${name}`);
    const sampler = gl.createSampler();
    const plain = states.min === "POINT" ? "NEAREST" : "LINEAR";
    const mip = states.mip === "NONE" ? "" : states.mip === "POINT" ? "_MIPMAP_NEAREST" : "_MIPMAP_LINEAR";
    gl.samplerParameteri(sampler, gl.TEXTURE_MIN_FILTER, gl[plain + mip]);
    gl.samplerParameteri(sampler, gl.TEXTURE_MAG_FILTER, states.mag === "POINT" ? gl.NEAREST : gl.LINEAR);
    gl.samplerParameterf(sampler, gl.TEXTURE_MIN_LOD, states.lod[0]);
    gl.samplerParameterf(sampler, gl.TEXTURE_MAX_LOD, states.lod[1]);
    ["S", "T", "R"].forEach((axis, i) => {
      const address = ADDRESS[states.address[i]] ?? fail(`sampler ${name}: WebGL has no address mode ${states.address[i]}`);
      gl.samplerParameteri(sampler, gl[`TEXTURE_WRAP_${axis}`], gl[address]);
    });
    this.samplers.set(name, sampler);
    return sampler;
  }

  setStates(states) {
    const { gl } = this;
    const enable = (what, on) => (on ? gl.enable(what) : gl.disable(what));
    enable(gl.DEPTH_TEST, states.depth_test);
    gl.depthMask(states.depth_write);
    gl.depthFunc(gl[COMPARE[states.depth_compare]]);
    enable(gl.CULL_FACE, states.cull !== "NONE");
    gl.cullFace(states.cull === "FRONT" ? gl.FRONT : gl.BACK);
    gl.frontFace(states.front_counter_clockwise ? gl.CW : gl.CCW); // the shaders turn y (docs/emit.md)
    enable(gl.POLYGON_OFFSET_FILL, states.depth_bias !== 0 || states.slope_scaled_depth_bias !== 0);
    gl.polygonOffset(states.slope_scaled_depth_bias, states.depth_bias);
    if (states.stencil_test) fail("this sample has no stencil test");
    const [target] = states.targets;
    if (states.targets.some(other => JSON.stringify(other) !== JSON.stringify(target))) fail("WebGL 2 blends all targets alike");
    gl.colorMask(...[1, 2, 4, 8].map(bit => (target.write_mask & bit) !== 0));
    enable(gl.BLEND, target.blend);
    if (!target.blend) return;
    const factor = name => gl[BLEND[name] ?? fail(`no blend factor ${name}`)];
    gl.blendFuncSeparate(factor(target.src), factor(target.dest), factor(target.src_alpha), factor(target.dest_alpha));
    gl.blendColor(...states.blend_constant);
    gl.blendEquationSeparate(gl[BLEND_OP[target.op]], gl[BLEND_OP[target.op_alpha]]);
  }
}
