"""usage: test_marks_test.py TEGUMENT

Over standard input and output: failures of a file of tests are marked when it is opened and when it, or what it includes, is saved."""

import json
import pathlib
import subprocess
import sys
import tempfile


class Editor:
    def __init__(self, program):
        self.server = subprocess.Popen([program, "check", "--lsp"], stdin=subprocess.PIPE, stdout=subprocess.PIPE)

    def tell(self, method, **parameters):
        text = json.dumps({"jsonrpc": "2.0", "method": method, "params": parameters}).encode()
        self.server.stdin.write(b"Content-Length: %d\r\n\r\n%s" % (len(text), text))
        self.server.stdin.flush()

    def marks(self, uri):
        """Lines, from 0, and codes that are published next of this file."""
        while True:
            length = 0
            while line := self.server.stdout.readline().strip():
                if line.lower().startswith(b"content-length:"):
                    length = int(line.split(b":")[1])
            message = json.loads(self.server.stdout.read(length))
            if message.get("method") == "textDocument/publishDiagnostics" and message["params"]["uri"] == uri:
                return [(each["range"]["start"]["line"], each["code"]) for each in message["params"]["diagnostics"]]


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / ".git").mkdir()
        shader, tests = folder / "twice.hlsl", folder / "twice.test.hlsl"
        shader.write_text("float twice(float x) { return x + x; }\n")
        text = '#include "twice.hlsl"\nTG_TEST(a) { float x = tgCases(1, 2); tgEqual(twice(x), 2 * x); }\nTG_TEST(b)\n{\n    tgEqual(twice(3), 7);\n}\n'
        tests.write_text(text)
        editor = Editor(program)
        for path, language in ((tests, text), (shader, shader.read_text())):
            editor.tell("textDocument/didOpen", textDocument={"uri": path.as_uri(), "languageId": "hlsl", "version": 1, "text": language})
        uri = tests.as_uri()
        while (said := editor.marks(uri)) == []:  # read, not run yet
            pass
        assert said == [(4, "TG8210")], said
        shader.write_text("float twice(float x) { return x * x; }\n")
        editor.tell("textDocument/didSave", textDocument={"uri": shader.as_uri()})
        while (said := editor.marks(uri)) == []:
            pass
        assert said == [(1, "TG8210"), (4, "TG8210")], said
        editor.tell("exit")
        assert editor.server.wait(60) == 1


main(sys.argv[1])
