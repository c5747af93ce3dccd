// Starts `tegument check --lsp` and leaves the rest to the client of the protocol.
"use strict";

const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

let client;

exports.activate = async () => {
    const settings = vscode.workspace.getConfiguration("tegument");
    const args = ["check", "--lsp", ...settings.get("includeFolders").flatMap((folder) => ["-I", folder])];
    const folder = vscode.workspace.workspaceFolders?.[0]?.uri.fsPath;
    const server = { command: settings.get("program"), args, options: { cwd: folder } };
    client = new LanguageClient("tegument", "Tegument", server, { documentSelector: [{ language: "hlsl-effect", scheme: "file" }] });
    await client.start();
};

exports.deactivate = () => client?.stop();
