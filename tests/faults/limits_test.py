#!/usr/bin/env python3
"""Hostile files: how much memory one of a few bytes can make the program take. Files that announce what they do not hold take none; what is
compressed, or repeated, takes a stated multiple, and ends at --max-memory. usage: limits_test.py TEGUMENT REPOSITORY
"""

import io
import json
import os
import pathlib
import struct
import subprocess
import sys
import zlib

from harness import Faults, MACHINE, PROGRAM, REPOSITORY, main

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
import seeds  # noqa: E402

MIB = 1 << 20
MANY = 4_000_000_000
# A program that does nothing else takes this much for itself, its libraries and a file of no size; measured 36 to 66 MiB.
START = 96 * MIB


def ply(elements, data=b""):
    head = "ply\nformat binary_little_endian 1.0\n" + "".join(elements) + "end_header\n"
    return head.encode() + data


PLACES = "property float x\nproperty float y\nproperty float z\n"


def triangle(**changes):
    """A glTF document of one triangle without data."""
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"componentType": 5126, "count": 3, "type": "VEC3"}, {"componentType": 5125, "count": 3, "type": "SCALAR"}]}
    document.update(changes)
    return document


def jpeg(**options):
    """A JPEG of 16 pixels whose header says 16384 x 16384."""
    from PIL import Image
    out = io.BytesIO()
    Image.new("RGB", (16, 16)).save(out, "JPEG", **options)
    data = bytearray(out.getvalue())
    frame = data.index(b"\xff\xc2" if options else b"\xff\xc0")
    data[frame + 5:frame + 9] = struct.pack(">HH", 16384, 16384)
    return bytes(data)


def png(size, rows):
    """A black RGBA PNG whose rows are all there only if `rows` is `size`."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packed = zlib.compress(bytes((1 + 4 * size) * rows), 9)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", size, size, 8, 6, 0, 0, 0)) + chunk(b"IDAT", packed) +
            chunk(b"IEND", b""))


def dds(size):
    return (b"DDS " + struct.pack("<7I", 124, 0x1007, size, size, 0, 0, 15) + bytes(44) + struct.pack("<8I", 32, 4, 0x30315844, 0, 0, 0, 0, 0) +
            struct.pack("<5I", 0x1000, 0, 0, 0, 0) + struct.pack("<5I", 2, 3, 0, 1, 0))


def doubling():
    lines = ["#define A x x x x x x x x"]
    for i in range(20):
        lines.append(f"#define {chr(66 + i)} " + f"{chr(65 + i)} " * 7)
    return "\n".join(lines) + "\nfloat a = U;\n"


def liars():
    """Files that announce more than they hold, nest without end, or include themselves."""
    nested = 100_000
    chain = [{"children": [i + 1]} for i in range(50_000)] + [{"mesh": 0}]
    twice = [{"children": [i + 1, i + 1]} for i in range(40)] + [{"mesh": 0}]
    return {
        "count.ply": ply([f"element vertex {MANY}\n{PLACES}element face {MANY}\nproperty list uchar int vertex_indices\n"]),
        "list.ply": ply([f"element vertex 3\n{PLACES}element face 1\nproperty list uint int vertex_indices\n"], bytes(36) + struct.pack("<I", MANY)),
        "properties.ply": ply(["element vertex 3\n"] + [f"property float p{i}\n" for i in range(20_000)]),
        "count.stl": bytes(80) + struct.pack("<I", MANY) + bytes(50),
        "count.off": f"OFF\n{MANY} {MANY} 0\n0 0 0\n".encode(),
        "corners.off": f"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n{MANY} 0 1 2\n".encode(),
        "index.obj": f"v 0 0 0\nf 1 2 {MANY}\n".encode(),
        "zeros.glb": seeds.glb(triangle(accessors=[{"componentType": 5126, "count": 60_000_000, "type": "VEC3"},
                                                   {"componentType": 5125, "count": 200_000_001, "type": "SCALAR"}]), b""),
        "chain.glb": seeds.glb(triangle(nodes=chain), b""),
        "twice.glb": seeds.glb(triangle(nodes=twice), b""),
        "nested.gltf": b'{"asset":' + b"[" * nested,
        "rows.png": png(8192, 1),
        "rows.hdr": b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 16384 +X 16384\n",
        "rows.jpg": jpeg(), "progressive.jpg": jpeg(progressive=True),
        "size.dds": dds(16384),
        "attribute.exr": b"v/1\x01\x02\0\0\0note\0string\0" + struct.pack("<I", 2_000_000_000),
        "doubling.fx": doubling().encode(),
        "itself.fx": b'#include "itself.fx"\n',
        "brackets.fx": ("float a = " + "(" * nested + "1" + ")" * nested + ";\n").encode(),
        "braces.fx": ("void f() {" + "{" * nested + "}" * nested + "}\n").encode(),
        "conditions.fx": b"#if 1\n" * nested,
        "condition.fx": ("#if " + "(" * nested + "1" + ")" * nested + "\n#endif\n").encode(),
        "signs.fx": ("float a = " + "-" * nested + "1;\n").encode(),
        "choices.fx": ("#if " + "1?" * nested + "1" + ":1" * nested + "\n#endif\n").encode(),
        "nested.json": b"[" * nested,
    }


def grooms():
    """Likewise, of strands; and files that name the same points a thousand times."""
    again = [{"attributes": {"POSITION": 0}, "mode": 3}] * 1000
    points = bytes(12 * 1000)
    ogawa = b"Ogawa\xff\0\1" + struct.pack("<Q", 16)
    return {
        "count.hair": b"HAIR" + struct.pack("<4I", MANY, MANY, 2, 0) + bytes(108 + 24),
        "segments.hair": b"HAIR" + struct.pack("<4I", 1, MANY, 2, MANY - 1) + bytes(108 + 24),
        "count.tfx": struct.pack("<f8I", 4, 1 << 25, 64, 160, 0, 0, 0, 0, 0) + bytes(124 + 64),
        "counts.usda": f'#usda 1.0\ndef BasisCurves "a" {{ int[] curveVertexCounts = [{MANY}] point3f[] points = [(0,0,0)] }}\n'.encode(),
        "deep.usda": b"#usda 1.0\n" + b'def "a" {' * 100_000,
        "moves.usda": b'#usda 1.0\ndef "a" { uniform token[] xformOpOrder = [' + b'"xformOp:scale",' * 20_000 + b"]\n" + b'def "b" {}\n' * 20_000 + b"}",
        "children.abc": ogawa + struct.pack("<Q", 1 << 60),
        "itself.abc": ogawa + struct.pack("<7Q", 6, 1 << 63, 1 << 63, 16, 1 << 63, 1 << 63, 1 << 63),
        "again.gltf": seeds.glb({"asset": {"version": "2.0"}, "meshes": [{"primitives": again}], "buffers": [{"byteLength": len(points)}],
                                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 1000, "type": "VEC3"}],
                                "bufferViews": [{"buffer": 0, "byteLength": len(points)}]}, points),
        "lines.obj": b"v 0 0 0\nv 0 1 0\nl" + b" 1" * 500_000 + b"\n",
        "edges.ply": ply([f"element vertex 3\n{PLACES}element edge {MANY}\nproperty int vertex1\nproperty int vertex2\n"], bytes(36)),
    }


class Limits(Faults):
    def command(self, path):
        if path.name in grooms():
            return ["fur", "info", path]
        return {".fx": ["info", path], ".json": ["render", "OriginalTexture", "-w", path, "-o", self.out / "x.png"]}.get(
            path.suffix, ["compare", path, path] if path.suffix in (".png", ".jpg", ".hdr", ".dds", ".exr") else ["prep", path, "--dry-run"])

    def measured(self, name, content, *more):
        """Exit code, its most memory in bytes, what it said."""
        path = self.folder / name
        path.write_bytes(content)
        with open(self.folder / "said", "w+", encoding="utf-8", errors="replace") as said:
            process = subprocess.Popen([PROGRAM, *map(str, self.command(path)), *more], cwd=REPOSITORY, env=self.environment, stdout=said, stderr=said)
            _, status, used = os.wait4(process.pid, 0)
            process.returncode = os.waitstatus_to_exitcode(status)
            said.seek(0)
            return process.returncode, used.ru_maxrss * 1024, said.read()

    def test_what_a_file_only_announces_takes_no_memory(self):
        for name, content in {**liars(), **grooms()}.items():
            with self.subTest(name):
                code, peak, said = self.measured(name, content)
                self.assertIn(code, (0, 1), said[:2000])
                self.assertLess(peak, START + 200 * len(content), "memory")
                self.assertLess(len(said), 100_000 + len(content))

    def test_what_is_compressed_or_repeated_takes_what_it_stands_for(self):
        """Floats of all pixels, twice: the file is compared with itself. A mesh that 3,000 nodes show, as triangles of their own."""
        size = 2048
        code, peak, said = self.measured("black.png", png(size, size))
        self.assertIn(code, (0, 1), said)
        self.assertLess(peak, START + 3 * 16 * size * size, "3 copies of 4 floats a pixel")
        points = b"".join(struct.pack("<3f", i % 7, i % 11, i % 13) for i in range(3000))
        document = triangle(nodes=[{"mesh": 0}] * 300, scenes=[{"nodes": list(range(300))}], buffers=[{"byteLength": len(points)}],
                            bufferViews=[{"buffer": 0, "byteLength": len(points)}], meshes=[{"primitives": [{"attributes": {"POSITION": 0}}]}],
                            accessors=[{"bufferView": 0, "componentType": 5126, "count": 3000, "type": "VEC3"}])
        code, peak, said = self.measured("copies.glb", seeds.glb(document, points))
        self.assertEqual(code, 0, said)
        self.assertLess(peak, START + 200 * 300 * 3000, "200 bytes a corner")
        self.assertIn("copies of meshes", said)

    def test_memory_ends_at_the_limit_that_is_given(self):
        code, peak, said = self.measured("black.png", png(8192, 8192), "--max-memory", "600")
        self.assertEqual(code, MACHINE, said)
        self.assertEqual(said.count("error TG"), 1, said)
        self.assertRegex(said, "TG(8001|5205)")
        self.assertLess(peak, 700 * MIB)
        self.refused(self.run_it("info", "Main", "--max-memory", "much"), "TG8005", code=2)

    def test_records_of_commands_that_print_any_json_are_a_table(self):
        odd = ({"code": 1, "severity": 5, "file": [], "line": {}, "text": {}}, {"code": "TG1", "text": 7}, {"severity": "error", "code": None, "text": None})
        results = self.folder / "results/records"
        results.mkdir(parents=True)
        for number, result in enumerate(odd):
            record = dict(seeds.RECORD, input=str(number), exit_code=1, messages="", result=result)
            (results / f"{number}.json").write_text(json.dumps(record), encoding="ascii")
        nested = json.dumps(dict(seeds.RECORD, input="nested", exit_code=1, messages="", result=0)).replace('"result": 0', '"result": ' + "[" * 50_000 + "]" * 50_000)
        (results / "nested.json").write_text(nested, encoding="ascii")
        ran = self.run_it("batch", "--results", results.parent, "--column", "/code/0")
        self.assertIn(ran.returncode, (0, 1), ran.stderr)
        self.assertNotIn("unexpected failure", ran.stderr)

    def test_scripts_come_to_an_end(self):
        """Loops in loops of scripts: a million commands, then an error."""
        loops = "LoopByCount=gMany;" * 6 + "LoopEnd=;" * 6 + "Pass=P;"
        path = self.folder / "loops.fx"
        path.write_text("float gMany = 60000;\nvoid VS(float4 p : POSITION, out float4 o : SV_Position) { o = p; }\n"
                        "float4 PS() : SV_Target0 { return 1; }\n#ifndef FX_ENTRY\n"
                        f'technique11 T < string Script = "{loops}"; > {{ pass P < string Script = "Draw=Buffer;"; > {{\n'
                        "SetVertexShader(CompileShader(vs_5_0, VS()));\nSetPixelShader(CompileShader(ps_5_0, PS())); } }\n#endif\n", encoding="utf-8")
        self.refused(self.run_it("render", path, "--size", "16", "-o", self.out / "x.png"), "TG2303", code=1)


if __name__ == "__main__":
    main()
