// `tegument check --lsp` by the library that VS Code's clients stand on: node protocol_test.js TEGUMENT. Exit code 77: it is not there.
"use strict";

const assert = require("assert");
const child = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");
const { pathToFileURL } = require("url");

const EFFECT = `#include "part.fxh"
float4 gTint : DIFFUSE = { 1, 0, 0, 1 };
float4 vertex(float3 p : POSITION) : SV_Position { return float4(p, 1); }
float4 pixel() : SV_Target { return shade(gTint); }
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, vertex())); SetPixelShader(CompileShader(ps_5_0, pixel())); } }
`;
const PART = "float4 shade(float4 c) { return c * 2; }\n";

const cache = process.env.TEGUMENT_CACHE || path.join(process.env.XDG_CACHE_HOME || path.join(os.homedir(), ".cache"), "tegument");
let protocol;
try {
    protocol = require(path.join(cache, "tools", "vscode", "node_modules", "vscode-languageserver-protocol", "node"));
} catch (error) {
    console.log("skipped: vscode-languageserver-protocol is not in the cache; ./bootstrap test fetches it where npm is");
    process.exit(77);
}

async function talk(folder) {
    const server = child.spawn(path.resolve(process.argv[2]), ["check", "--lsp"], { cwd: folder, stdio: ["pipe", "pipe", "inherit"] });
    const ended = new Promise((resolve) => server.on("exit", resolve));
    const connection = protocol.createProtocolConnection(new protocol.StreamMessageReader(server.stdout), new protocol.StreamMessageWriter(server.stdin));
    const uri = pathToFileURL(path.join(folder, "effect.fx")).href;
    const reports = [];
    let wake = () => {};
    connection.onNotification(protocol.PublishDiagnosticsNotification.type, (report) => {
        if (report.uri === uri) reports.push(report.diagnostics);
        wake();
    });
    const reported = async (holds) => {
        while (!reports.some(holds)) await new Promise((resolve) => (wake = resolve));
        return reports.find(holds);
    };
    connection.listen();

    const root = pathToFileURL(folder).href;
    const { capabilities } = await connection.sendRequest(protocol.InitializeRequest.type, { processId: process.pid, rootUri: root, capabilities: {}, workspaceFolders: null });
    assert.ok(capabilities.hoverProvider && capabilities.definitionProvider && capabilities.completionProvider, JSON.stringify(capabilities));
    await connection.sendNotification(protocol.InitializedNotification.type, {});
    await connection.sendNotification(protocol.DidOpenTextDocumentNotification.type, { textDocument: { uri, languageId: "hlsl-effect", version: 1, text: EFFECT } });
    const ask = (type, line, character) => connection.sendRequest(type, { textDocument: { uri }, position: { line, character } });

    const hover = await ask(protocol.HoverRequest.type, 1, 9);
    assert.match(hover.contents.value, /float4 gTint : DIFFUSE;/);
    const definition = await ask(protocol.DefinitionRequest.type, 3, 38);
    assert.ok(definition.uri.endsWith("/part.fxh"), JSON.stringify(definition));
    assert.deepStrictEqual(definition.range.start, { line: 0, character: 7 });
    const completion = await ask(protocol.CompletionRequest.type, 4, 25);
    assert.ok((completion.items || completion).some((item) => item.label === "AlphaBlendEnable"));

    const change = (version, text) => connection.sendNotification(protocol.DidChangeTextDocumentNotification.type, { textDocument: { uri, version }, contentChanges: [{ text }] });
    await change(2, EFFECT.replace("1, 0, 0, 1", "1, 0 0, 1"));
    const broken = await reported((diagnostics) => diagnostics.length > 0);
    assert.strictEqual(broken[0].range.start.line, 1);
    assert.strictEqual(broken[0].source, "tegument");
    reports.length = 0;
    await change(3, EFFECT);
    await reported((diagnostics) => diagnostics.length === 0);

    await connection.sendRequest(protocol.ShutdownRequest.type);
    await connection.sendNotification(protocol.ExitNotification.type);
    assert.strictEqual(await ended, 0, "exit code after shutdown");
}

const folder = fs.mkdtempSync(path.join(os.tmpdir(), "tegument-protocol-"));
fs.writeFileSync(path.join(folder, "effect.fx"), EFFECT);
fs.writeFileSync(path.join(folder, "part.fxh"), PART);
const late = setTimeout(() => { console.log("no answer within 100 s"); process.exit(1); }, 100000);
talk(folder)
    .then(() => { console.log("initialize, hover, definition, completion, diagnostics, shutdown"); return 0; }, (error) => { console.log(error); return 1; })
    .then((code) => { clearTimeout(late); fs.rmSync(folder, { recursive: true }); process.exit(code); });
