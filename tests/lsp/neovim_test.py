#!/usr/bin/env python3
"""`tegument check --lsp` with a client that is not ours: neovim_test.py TEGUMENT. Exit code 77: no Neovim."""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

EFFECT = """#include "part.fxh"
float4 gTint : DIFFUSE = { 1, 0, 0, 1 };
float4 vertex(float3 p : POSITION) : SV_Position { return float4(p, 1); }
float4 pixel() : SV_Target { return shade(gTint); }
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, vertex())); SetPixelShader(CompileShader(ps_5_0, pixel())); } }
"""
PART = "float4 shade(float4 c) { return c * 2; }\n"
# Everything that is asked ends up in one file: what Neovim itself made of the answers.
SCRIPT = """
local out, program = ...
local said = {}
vim.cmd("edit effect.fx")
local id = vim.lsp.start_client({ name = "tegument", cmd = { program, "check", "--lsp" }, root_dir = vim.fn.getcwd() })
vim.lsp.buf_attach_client(0, id)
local function at(method, line, character)
  local p = { textDocument = { uri = vim.uri_from_bufnr(0) }, position = { line = line, character = character } }
  local answers, problem = vim.lsp.buf_request_sync(0, method, p, 20000)
  return answers and answers[id] and answers[id].result or { problem = problem }
end
vim.wait(20000, function() return vim.lsp.get_client_by_id(id) and vim.lsp.get_client_by_id(id).initialized end)
said.hover = at("textDocument/hover", 1, 9)
said.definition = at("textDocument/definition", 3, 38)
said.completion = at("textDocument/completion", 4, 25)
vim.api.nvim_buf_set_lines(0, 1, 2, false, { "float4 gTint : DIFFUSE = { 1, 0 0, 1 };" })
vim.wait(20000, function() return #vim.diagnostic.get(0) > 0 end)
said.broken = vim.diagnostic.get(0)
vim.api.nvim_buf_set_lines(0, 1, 2, false, { "float4 gTint : DIFFUSE = { 1, 0, 0, 1 };" })
said.mended = vim.wait(20000, function() return #vim.diagnostic.get(0) == 0 end)
for _, one in ipairs(said.broken) do one.user_data = nil one.namespace = nil one.bufnr = nil end
local file = io.open(out, "w")
file:write(vim.fn.json_encode(said))
file:close()
vim.lsp.stop_client(id)
vim.wait(2000, function() return vim.lsp.client_is_stopped(id) end)
vim.cmd("qall!")
"""


def main():
    neovim = shutil.which("nvim")
    if not neovim:
        print("skipped: Neovim is not installed; ./bootstrap test brings it")
        return 77
    with tempfile.TemporaryDirectory(prefix="tegument-neovim-") as scratch:
        folder = pathlib.Path(scratch)
        (folder / ".git").mkdir()
        (folder / "effect.fx").write_text(EFFECT)
        (folder / "part.fxh").write_text(PART)
        (folder / "session.lua").write_text(SCRIPT)
        # 0.7 gives Lua scripts no arguments on its command line.
        command = f"lua loadfile('session.lua')([[{folder / 'said.json'}]], [[{pathlib.Path(sys.argv[1]).resolve()}]])"
        done = subprocess.run([neovim, "--headless", "--clean", "-c", command, "-c", "qall!"], cwd=folder, capture_output=True, text=True, timeout=150, check=False,
                              env={**os.environ, "XDG_STATE_HOME": scratch, "XDG_CACHE_HOME": os.environ.get("XDG_CACHE_HOME") or str(pathlib.Path.home() / ".cache")})
        if not (folder / "said.json").exists():
            print(done.stdout + done.stderr)
            return 1
        said = json.loads((folder / "said.json").read_text())
    failed = []

    def expect(right, what):
        if not right:
            failed.append(f"{what}: {json.dumps(said, indent=1)}")

    expect("float4 gTint : DIFFUSE;" in said["hover"]["contents"]["value"], "hover")
    expect(said["definition"]["uri"].endswith("/part.fxh") and said["definition"]["range"]["start"] == {"line": 0, "character": 7}, "definition")
    expect("AlphaBlendEnable" in [item["label"] for item in said["completion"]], "completion")
    expect(len(said["broken"]) >= 1 and said["broken"][0]["lnum"] == 1 and said["broken"][0]["source"] == "tegument", "diagnostics")
    expect(said["mended"], "diagnostics of what was mended")
    print("\n".join(failed) or "Neovim: hover, definition, completion, diagnostics")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
