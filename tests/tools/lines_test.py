#!/usr/bin/env python3
"""Runs the commands of README.md, of the users' pages, of docs/samples/README.md and of every `tegument help` as they stand there, and the
blocks of code between ``` of these pages.

usage: lines_test.py PROGRAM REPOSITORY [--page NAME]... [--keep FOLDER] [--list]

Each page has a folder of its own, in which its commands run one after the other, as a reader would type them; beside effects, shaders and
samples it holds the files that the pages call the reader's own. What a command writes is opened: pictures are neither black nor of one
colour. Windows stay open for some seconds on a display of their own. Minutes to an hour, with the processors: label `slow`.
"""

import argparse
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time

try:
    import numpy
    from PIL import Image, ImageSequence
except ImportError as error:
    print(f"skipped: {error}: python3-pil and python3-matplotlib (Debian) are not installed")
    sys.exit(77)

CACHE = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tegument")
BUNNY = pathlib.Path("/usr/share/glmark2/models/bunny.obj")
PICTURES = {".png", ".jpg", ".webp"}
WINDOW = 20.0  # seconds that a window, a watch or a server runs before it is closed
LIMIT = 3600.0

# Lines that belong to another machine or change this one; each is covered where it says.
ELSEWHERE = {
    r"\./bootstrap (demo|build)": "Demo.each_picture_shows_its_subject; the build that runs this",
    r"x86_64-w64-mingw32-g\+\+|d3d(9|12)_sample\.exe": "tests/d3d/samples_test.cpp",
    r"cmake --install": "Install.a_program_outside_the_tree_builds_and_runs_against_the_package",
    r"snakemake --jobs": "Batches.of_snakemake_lose_nothing_when_a_node_dies",
    r"man tegument": "the package",
    r"NAME\[@LIGHT\]": "a synopsis",
}
# Blocks of code that another test holds, by page and by what they begin with.
HELD = {
    ("README.md", "ID3DXEffect*"): "Readme.every_parameter_set_in_the_snippets_is_one_of_the_effect",
    ("README.md", "ID3DX11Effect*"): "Readme.every_parameter_set_in_the_snippets_is_one_of_the_effect",
    ("README.md", '#include "../hlsl/platform.fxh"'): "Consumer.readme_shader_compiles_beside_a_copy_of_hlsl_alone",
    ("docs/bench.md", '{\n  "technique"'): "a template; tests/lab/bench/catalogue_test.cpp reads such entries",
    ("docs/scripts.md", ""): "schemes; tests/effect/conformance_test.cpp has the page's cases whole",
    ("docs/your-engine.md", '#include "../hlsl/platform.fxh"'): "tests/check/check_test.cpp, by hook_example.h",
}
# The rest: files to write (BLOCK is the block, HEAD its first line, REST what follows its first empty line), and the command.
BLOCKS = {
    ("docs/workspace.md", '{\n  "comment"'): ({"block.json": "BLOCK"}, "cp photograph.jpg pores.png && tegument render Specular -w block.json --size 96 -o block.png"),
    ("docs/workspace.md", '{\n  "oily"'): ({"effects/Main.presets.json": "BLOCK"}, "tegument render effects/Main.fx --preset oily --size 96 --map-size 64 -o oily.png"),
    ("docs/your-engine.md", "#include <tegument.h>"): ({"drawn.cpp": "HEAD\n#include <tuple>\nint drawn() {\nREST\nreturn 0;\n}\n"},
                                                      "c++ -std=c++20 -fsyntax-only -I REPOSITORY/meshprep/assets -I REPOSITORY drawn.cpp"),
    ("docs/your-engine.md", '#include "manifest.h"'): ({"player.cpp": """#include "script_player.h"
struct Target {};
using Values = std::map<std::string, script_player::Value>;
struct {
    void clear(script_player::Clear, std::optional<std::size_t>, const std::vector<float>&) {}
    void bind(const std::vector<Target*>&, Target*, int, const Values&) {}
    void draw(script_player::Draw) {}
} device;
std::map<std::string, int> pipelines;
Target* find(const std::string&) { return nullptr; }
CLASS
void play(Mine& mine, const std::string& text) {
USE
}
"""}, "c++ -std=c++17 -fsyntax-only -I docs/samples/player player.cpp"),
}
# Commands that wait for a person: closed after a while, when they must still run and have said no error.
WAITING = re.compile(r"tegument view|--watch|--lsp")
ANSWERED = {"--lsp": 1}  # exit code of a server whose client goes without a word
RUNS = re.compile(r"(build/release/)?(tegument|tests/d3d/vulkan_sample) |\./bootstrap|cp |python3 |cmake |snakemake|source |man |x86_64-w64|d3d\d+_sample")


def command_of(line):
    """Without the prose behind three spaces or a # of its own."""
    return re.split(r"\s{3,}|\s+#\s|\s+\|\s+man ", line)[0].rstrip()


def lines_of(text):
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("    ") and RUNS.match(line[4:]):
            command = command_of(line[4:])
            if "[" not in command and "..." not in command:
                yield number, command


def blocks_of(page, text):
    """(line, text) of what stands between ```."""
    for match in re.finditer(r"^```\w*\n(.*?)^```", text, re.M | re.S):
        yield text.count("\n", 0, match.start()) + 1, page, match[1]


def run_block(page, block, folder, display):
    """None: another test holds it."""
    begins = lambda table: next((value for (name, start), value in table.items() if name == page and block.startswith(start)), None)
    if begins(HELD):
        return None, begins(HELD)
    if not begins(BLOCKS):
        return 0.0, "no test runs this block"
    files, command = begins(BLOCKS)
    head, _, rest = block.partition("\n\n")
    kind, _, use = block.partition("\nconst auto manifest")
    parts = {"BLOCK": block, "HEAD": head, "REST": rest, "CLASS": kind, "USE": "const auto manifest" + use}
    for name, text in files.items():
        (folder / name).write_text(re.sub("|".join(parts), lambda word: parts[word[0]], text), encoding="utf-8")
    wrong, output, seconds = run(command.replace("REPOSITORY", str(REPOSITORY)), folder, display)
    picture = re.search(r"-o (\S+)", command)
    return seconds, f"{wrong}\n{output}" if wrong else judged(folder / picture[1]) if picture else ""


def examples(program):
    """(command, its examples) of every command and of what stands below one."""
    shown = lambda *words: subprocess.run([program, "help", *words], capture_output=True, text=True, check=False).stdout
    names = [(name,) for name in sorted(set(re.findall(r"^  ([a-z]+) ", shown(), re.M)))]
    for name in list(names):
        below = shown(*name).partition("\nSubcommands:\n")[2]
        names += [(*name, part) for part in re.findall(r"^  ([a-z]+)", below.partition("\nExamples:\n")[0], re.M)]
    pages = []
    for name in names:
        lines = [(i, command_of(line.strip())) for i, line in enumerate(shown(*name).splitlines(), 1) if line.startswith("  tegument ")]
        pages.append((f"help {' '.join(name)}", [(i, command) for i, command in lines if "[" not in command]))
    return pages


# ---- the reader's own files

def accessor(document, binary, index):
    kinds, widths = {5126: "<f4", 5123: "<u2", 5125: "<u4"}, {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}
    one = document["accessors"][index]
    view = document["bufferViews"][one["bufferView"]]
    kind, width = numpy.dtype(kinds[one["componentType"]]), widths[one["type"]]
    begin = view.get("byteOffset", 0) + one.get("byteOffset", 0)
    stride = view.get("byteStride", kind.itemsize * width)
    return numpy.ndarray((one["count"], width), kind, binary, begin, (stride, kind.itemsize))


def write_head(folder):
    """The default head as a scanner's OBJ, in metres, with its photograph."""
    data = (CACHE / "human/human.glb").read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    part = document["meshes"][0]["primitives"][0]
    positions = accessor(document, binary, part["attributes"]["POSITION"]) / 1000
    places = accessor(document, binary, part["attributes"]["TEXCOORD_0"])
    faces = accessor(document, binary, part["indices"]).reshape(-1, 3).astype(int) + 1
    with open(folder / "head.obj", "w", encoding="ascii") as out:
        out.write("mtllib head.mtl\n")
        out.writelines(f"v {x:.6f} {y:.6f} {z:.6f}\n" for x, y, z in positions)
        out.writelines(f"vt {u:.6f} {1 - v:.6f}\n" for u, v in places)
        out.write("usemtl skin\n")
        out.writelines(f"f {a}/{a} {b}/{b} {c}/{c}\n" for a, b, c in faces)
    (folder / "head.mtl").write_text("newmtl skin\nmap_Kd photograph.jpg\n", encoding="ascii")
    Image.open(CACHE / "human/color.png").convert("RGB").resize((1024, 1024)).save(folder / "photograph.jpg", quality=92)


def write_walk(source, path):
    """The same file with an animation of its node: a step forward in a second."""
    data = source.read_bytes()
    length = struct.unpack("<I", data[12:16])[0]
    document, binary = json.loads(data[20:20 + length]), data[28 + length:]
    begin = len(binary)
    binary += struct.pack("<8f", 0, 1, 0, 0, 0, 0, 0, 0.1)
    views, accessors = document["bufferViews"], document["accessors"]
    views += [{"buffer": 0, "byteOffset": begin, "byteLength": 8}, {"buffer": 0, "byteOffset": begin + 8, "byteLength": 24}]
    accessors += [{"bufferView": len(views) - 2, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]},
                  {"bufferView": len(views) - 1, "componentType": 5126, "count": 2, "type": "VEC3"}]
    document["animations"] = [{"name": "walk", "samplers": [{"input": len(accessors) - 2, "output": len(accessors) - 1}],
                               "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]
    document["buffers"][0]["byteLength"] = len(binary)
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    path.write_bytes(struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text
                     + struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def write_panorama(path):
    height, width = 32, 64
    rows = numpy.linspace(0, 1, height)[:, None, None]
    light = numpy.clip(numpy.ones((height, width, 3)) * (1 - rows) * [0.9, 1.0, 1.2] + rows * [0.2, 0.15, 0.1], 1e-3, None)
    light[6:9, 20:26] = 12
    mantissa, exponent = numpy.frexp(light.max(axis=2))
    texels = numpy.empty((height, width, 4), numpy.uint8)
    texels[..., :3] = light * (mantissa * 256 / light.max(axis=2))[..., None]
    texels[..., 3] = exponent + 128
    path.write_bytes(f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {height} +X {width}\n".encode() + texels.tobytes())


EFFECT = """float4x4 gMatrix;
float3 gColour = { 0.2, 0.5, 0.9 };
float gScale = 1;
struct Lit { float4 place : SV_Position; float3 normal : TEXCOORD0; };
Lit VS(float4 place : POSITION, float3 normal : NORMAL) { Lit o; o.place = mul(place, gMatrix); o.normal = normal; return o; }
float4 PS(Lit i) : SV_Target { return float4(gColour * gScale * (0.5 + 0.5 * normalize(i.normal).y), 1); }
technique Flat { pass P { VertexShader = compile vs_2_0 VS(); PixelShader = compile ps_2_0 PS(); } }
"""


def prepare(program, folder, shared):
    """What every page finds beside it. `shared` holds what takes time to make."""
    if not shared.exists():
        shared.mkdir()
        tegument = lambda *words: subprocess.run([program, *map(str, words)], check=True, stdout=subprocess.DEVNULL, cwd=shared)
        write_head(shared)
        tegument("prep", BUNNY, "-o", "scan.ply")
        write_panorama(shared / "hall.hdr")
        tegument("prep", "head.obj", "-o", "head.glb")
        tegument("prep", "scan.ply", "-o", "bunny.glb")
        (shared / "my.fx").write_text(EFFECT, encoding="ascii")
        (shared / "my_effects").mkdir()
        shutil.copy(shared / "my.fx", shared / "my_effects/my.fx")
        (shared / "my/includes").mkdir(parents=True)
        shutil.copy(shared / "bunny.glb", shared / "my.glb")
        write_walk(shared / "head.glb", shared / "body.glb")
        for name in ("fresnel.hlsl", "fresnel.test.hlsl"):
            shutil.copy(REPOSITORY / "docs/samples/test" / name, shared / name)
        shutil.copy(shared / "fresnel.test.hlsl", shared / "my.test.hlsl")
        tegument("fur", "roots", "bunny.glb", "-o", "made.dds")
        tegument("fur", "strands", "bunny.glb", "-o", "strands.glb")
        tegument("fur", "export", "strands.glb", "--share", "0.02", "-o", "groom.abc")
        shutil.copy(shared / "groom.abc", shared / "hair.abc")
        (shared / "scans").mkdir()
        for name in ("a", "b"):
            tegument("prep", "shape", "torus" if name == "a" else "cube", "-o", f"scans/{name}.ply")
        (shared / "before").mkdir()
        tegument("verify", "Beckmann", "--size", "32", "--map-size", "32", "-o", "before")
        tegument("bench", "--scene", "sphere-10", "--technique", "Lambert", "--size", "64", "--map-size", "64", "--frames", "2", "--json", "old.json")
        (shared / "out").mkdir()
        for name, red in (("a", 0.2), ("b", 0.4)):
            tegument("render", REPOSITORY / "effects/Beckmann.fx", "--size", "32", "-o", f"{name}.png")
            tegument("render", REPOSITORY / "effects/Specular.fx", "--set", f"gRoughness={red}", "--size", "64", "-o", f"out/{name}.exr")
    shutil.copytree(shared, folder, dirs_exist_ok=True)
    for name in ("effects", "hlsl"):
        shutil.copytree(REPOSITORY / name, folder / name)
    shutil.copytree(REPOSITORY / "docs/samples", folder / "docs/samples")
    for name in ("meshprep", "bootstrap", "lab"):
        (folder / name).symlink_to(REPOSITORY / name)
    (folder / "build/release").mkdir(parents=True)  # a program takes the effects above it
    shutil.copy(program, folder / "build/release/tegument")
    for entry in program.parent.iterdir():
        if entry.name != "tegument":
            (folder / "build/release" / entry.name).symlink_to(entry)


def judged(path):
    """What is wrong with a picture; empty: nothing."""
    try:
        with Image.open(path) as picture:
            kind = "RGBA" if "A" in picture.getbands() else "RGB"  # alpha is what a map of fur has
            frames = [numpy.asarray(frame.convert(kind), float) for frame in ImageSequence.Iterator(picture)]
    except (OSError, SyntaxError, ValueError) as error:
        return f"cannot be opened: {error}"
    for frame in frames:
        if (frame.max(axis=(0, 1)) - frame.min(axis=(0, 1))).max() < 16:
            return "is of one colour"
        if frame[..., :3].max() < 40 and kind == "RGB":
            return "is black"
    return ""


def files_of(folder):
    return {path: path.stat().st_mtime_ns for path in folder.rglob("*") if path.is_file() and not path.is_symlink() and "build" not in path.parts}


class Display:
    """For windows: none is needed until the first."""

    def __init__(self):
        self.process, self.name = None, os.environ.get("DISPLAY", "")

    def environment(self):
        if not self.name and shutil.which("Xvfb"):
            reading, writing = os.pipe()
            self.process = subprocess.Popen(["Xvfb", "-displayfd", str(writing), "-screen", "0", "1280x1024x24"], pass_fds=[writing], stderr=subprocess.DEVNULL)
            os.close(writing)
            self.name = ":" + os.read(reading, 16).decode().strip()
        return {"DISPLAY": self.name} if self.name else {}

    def close(self):
        if self.process:
            self.process.terminate()
            self.process.wait()


def run(command, folder, display):
    """(what is wrong, output, seconds)."""
    waits = WAITING.search(command)
    environment = dict(os.environ, PATH=f"{folder / 'build/release'}:{os.environ['PATH']}", **(display.environment() if waits else {}))
    begun = time.monotonic()
    process = subprocess.Popen(["bash", "-c", command], cwd=folder, env=environment, text=True, errors="replace", start_new_session=True,
                               stdin=subprocess.DEVNULL if "--lsp" in command else None, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    try:
        output, _ = process.communicate(timeout=WINDOW if waits else LIMIT)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGTERM)
        output, _ = process.communicate()
        wrong = "" if waits and "error" not in output else f"runs after {LIMIT:.0f} s"
        return wrong, output, time.monotonic() - begun
    expected = next((code for word, code in ANSWERED.items() if word in command), 0)
    wrong = f"ends with {process.returncode}" if process.returncode != expected else ""
    if waits and not wrong and "--lsp" not in command:
        wrong = "ended by itself"
    return wrong, output, time.monotonic() - begun


def run_page(lines, folder, display):
    """Rows of (place, command, seconds, what is wrong)."""
    for number, command in lines:
        elsewhere = next((why for pattern, why in ELSEWHERE.items() if re.match(pattern, command)), None)
        if elsewhere:
            yield number, command, None, elsewhere
            continue
        before = files_of(folder)
        wrong, output, seconds = run(command, folder, display)
        after = files_of(folder)
        for path in sorted(path for path, changed in after.items() if path.suffix in PICTURES and before.get(path) != changed):
            fault = judged(path)
            wrong += f"{'; ' if wrong and fault else ''}{path.relative_to(folder)} {fault}" if fault else ""
        target = re.search(r"(?:-o|--output) (\S+)", command)
        if not wrong and target and "prepared/{" not in command and not (folder / target[1]).exists():
            wrong = f"{target[1]} was not written"
        yield number, command, seconds, wrong and f"{wrong}\n{output[-1500:]}"


def main():
    global REPOSITORY
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("repository", type=pathlib.Path)
    parser.add_argument("--page", action="append", help="only pages whose name contains this")
    parser.add_argument("--keep", type=pathlib.Path, help="a folder that keeps what the commands wrote")
    parser.add_argument("--list", action="store_true", help="print the commands, run nothing")
    options = parser.parse_args()
    program, REPOSITORY = options.program.resolve(), options.repository.resolve()
    pages = [(str(page.relative_to(REPOSITORY)), list(lines_of(page.read_text(encoding="utf-8"))))
             for page in [REPOSITORY / "README.md", *sorted((REPOSITORY / "docs").glob("*.md")), REPOSITORY / "docs/samples/README.md"]]
    blocks = {name: list(blocks_of(name, (REPOSITORY / name).read_text(encoding="utf-8"))) for name, _ in pages}
    pages += examples(program)
    pages = [(name, lines) for name, lines in pages if (lines or blocks.get(name)) and (not options.page or any(part in name for part in options.page))]
    if options.list:
        for name, lines in pages:
            for number, command in [*lines, *((number, "block of code") for number, _, _ in blocks.get(name, []))]:
                print(f"{name}:{number}: {command}")
        return 0
    for needed in (CACHE / "human/human.glb", BUNNY):
        if not needed.exists():
            print(f"skipped: {needed} is not there (./bootstrap demo)")
            return 77
    scratch = pathlib.Path(options.keep or tempfile.mkdtemp(prefix="tegument-lines-"))
    scratch.mkdir(parents=True, exist_ok=True)
    display, ran, failed, apart = Display(), 0, 0, 0
    try:
        for name, lines in pages:
            folder = scratch / re.sub(r"\W+", "-", name)
            folder.mkdir()
            prepare(program, folder, scratch / "shared")
            code = ((number, "block of code", *run_block(page, block, folder, display)) for number, page, block in blocks.get(name, []))
            for number, command, seconds, wrong in itertools.chain(run_page(lines, folder, display), code):
                apart += seconds is None
                ran += seconds is not None
                failed += seconds is not None and bool(wrong)
                state = "elsewhere" if seconds is None else "FAILED" if wrong else f"{seconds:.1f} s"
                print(f"{name}:{number}: {state}: {command}{': ' + wrong if wrong else ''}", flush=True)
    finally:
        display.close()
        if not options.keep:
            shutil.rmtree(scratch, ignore_errors=True)
    print(f"[cases] {ran - failed} passed, {failed} failed, {apart} run by other tests")
    return 1 if failed or not ran else 0


if __name__ == "__main__":
    sys.exit(main())
