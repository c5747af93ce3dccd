// node judge_glb.js TOOLS FOLDER: every glb of the folder by Khronos's validator, and read by gltfpack, whose reader is cgltf. TOOLS: a folder
// with node_modules/gltf-validator and node_modules/gltfpack. One line for each finding; exit code 1 when there is one.
'use strict';
const fs = require('fs');
const path = require('path');
const url = require('url');
const [tools, folder] = process.argv.slice(2);
const validator = require(path.resolve(tools, 'node_modules/gltf-validator'));

// What the file says of itself, by its JSON alone: the triangles of the scene's mesh.
function triangles(bytes) {
  const json = JSON.parse(bytes.subarray(20, 20 + bytes.readUInt32LE(12)).toString('utf8'));
  let count = 0;
  for (const primitive of (json.meshes || [{primitives: []}])[0].primitives) count += json.accessors[primitive.indices].count / 3;
  return count;
}

async function read(pack, file, bytes) {
  const files = {read: (name) => fs.readFileSync(name), write: () => {}};
  const said = await pack(['-i', file, '-o', 'out.glb', '-v'], files);
  const found = /input: .*?\((\d+) triangles/.exec(said);
  if (!found) return `${path.basename(file)}: gltfpack read no triangles: ${said.split('\n')[0]}`;
  return Number(found[1]) >= triangles(bytes) ? null : `${path.basename(file)}: gltfpack read ${found[1]} of ${triangles(bytes)} triangles`;
}

async function judge(pack, file) {
  const bytes = fs.readFileSync(file);
  const findings = [];
  const report = await validator.validateBytes(new Uint8Array(bytes), {maxIssues: 20});
  for (const message of report.issues.messages)
    if (message.severity <= 1) findings.push(`${path.basename(file)}: ${message.code} ${message.pointer || ''}: ${message.message}`);
  try {
    const wrong = await read(pack, file, bytes);
    if (wrong) findings.push(wrong);
  } catch (error) {
    findings.push(`${path.basename(file)}: gltfpack cannot read it: ${String(error.message || error).split('\n')[0]}`);
  }
  return findings;
}

(async () => {
  const {pack} = await import(url.pathToFileURL(path.resolve(tools, 'node_modules/gltfpack/library.js')));
  const files = fs.readdirSync(folder).filter((name) => name.endsWith('.glb')).sort();
  let wrong = 0;
  for (const name of files)
    for (const finding of await judge(pack, path.join(folder, name))) {
      console.log(finding);
      ++wrong;
    }
  console.log(`${files.length} files, ${wrong} findings`);
  process.exit(wrong > 0 || files.length === 0 ? 1 : 0);
})();
