#!/usr/bin/env python3
"""Most memory that a file of each format takes, beside its size: the table of docs/design/reliability.md, measured.
usage: memory_table.py TEGUMENT REPOSITORY
"""

import io
import os
import pathlib
import random
import struct
import subprocess
import sys
import tempfile

from harness import PROGRAM, REPOSITORY
from limits_test import png

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "fuzz"))
import seeds  # noqa: E402

MIB = 1 << 20
SIDE = 400  # quads along a side of the grid: 160,801 vertices, 320,000 triangles
PIXELS = 2048


def places():
    return [(x, y, (x * 7 + y * 13) % 5 * 0.1) for y in range(SIDE + 1) for x in range(SIDE + 1)]


def faces():
    wide = SIDE + 1
    for y in range(SIDE):
        for x in range(SIDE):
            a = y * wide + x
            yield a, a + 1, a + wide
            yield a + 1, a + wide + 1, a + wide


def ply(points, triangles, binary):
    head = (f"ply\nformat {'binary_little_endian' if binary else 'ascii'} 1.0\nelement vertex {len(points)}\nproperty float x\nproperty float y\n"
            f"property float z\nelement face {len(triangles)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
    if binary:
        return head + b"".join(struct.pack("<3f", *p) for p in points) + b"".join(struct.pack("<B3i", 3, *f) for f in triangles)
    return head + "".join("%g %g %g\n" % p for p in points).encode() + "".join("3 %d %d %d\n" % f for f in triangles).encode()


def stl(points, triangles, binary):
    if binary:
        return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(
            struct.pack("<12fH", 0, 0, 1, *points[a], *points[b], *points[c], 0) for a, b, c in triangles)
    corner = "vertex %g %g %g\n"
    return ("solid x\n" + "".join("facet normal 0 0 1\nouter loop\n" + "".join(corner % points[i] for i in f) + "endloop\nendfacet\n" for f in triangles) +
            "endsolid x\n").encode()


def glb(points, triangles):
    vertices = b"".join(struct.pack("<3f", *p) for p in points)
    indices = b"".join(struct.pack("<3I", *f) for f in triangles)
    return seeds.glb({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                      "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                      "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points), "type": "VEC3"},
                                    {"bufferView": 1, "componentType": 5125, "count": 3 * len(triangles), "type": "SCALAR"}],
                      "bufferViews": [{"buffer": 0, "byteLength": len(vertices)},
                                      {"buffer": 0, "byteOffset": len(vertices), "byteLength": len(indices)}],
                      "buffers": [{"byteLength": len(vertices) + len(indices)}]}, vertices + indices)


def meshes():
    points, triangles = places(), list(faces())
    lines = ["v %g %g %g" % p for p in points] + ["f %d %d %d" % (a + 1, b + 1, c + 1) for a, b, c in triangles]
    off = f"OFF\n{len(points)} {len(triangles)} 0\n" + "".join("%g %g %g\n" % p for p in points) + "".join("3 %d %d %d\n" % f for f in triangles)
    return {"PLY, text": ("ply", ply(points, triangles, False)), "PLY, binary": ("ply", ply(points, triangles, True)),
            "OBJ": ("obj", "\n".join(lines).encode()), "OFF": ("off", off.encode()),
            "STL, text": ("stl", stl(points, triangles, False)), "STL, binary": ("stl", stl(points, triangles, True)), "glb": ("glb", glb(points, triangles))}


def pictures():
    from PIL import Image
    noise = Image.frombytes("RGB", (PIXELS, PIXELS), random.Random(1).randbytes(3 * PIXELS * PIXELS))
    files = {}
    for form, ending in (("PNG", "png"), ("JPEG", "jpg")):
        out = io.BytesIO()
        noise.save(out, form)
        files[f"{form}, noise"] = (ending, out.getvalue())
    files["PNG, one colour"] = ("png", png(PIXELS, PIXELS))
    out = io.BytesIO()
    Image.new("RGB", (PIXELS, PIXELS)).save(out, "JPEG")
    files["JPEG, one colour"] = ("jpg", out.getvalue())
    files["HDR, noise"] = ("hdr", f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {PIXELS} +X {PIXELS}\n".encode() + random.Random(2).randbytes(4 * PIXELS * PIXELS))
    row = bytes([2, 2, PIXELS >> 8, PIXELS & 255]) + 4 * (bytes([255, 1]) * (PIXELS // 127) + bytes([128 + PIXELS % 127, 1]))
    files["HDR, one colour"] = ("hdr", f"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {PIXELS} +X {PIXELS}\n".encode() + PIXELS * row)
    head = (b"DDS " + struct.pack("<7I", 124, 0x1007, PIXELS, PIXELS, 0, 0, 1) + bytes(44) + struct.pack("<8I", 32, 4, 0x30315844, 0, 0, 0, 0, 0))
    head += struct.pack("<5I", 0x1000, 0, 0, 0, 0) + struct.pack("<5I", 28, 3, 0, 1, 0)
    files["DDS, 8 bits"] = ("dds", head + bytes(4 * PIXELS * PIXELS))
    return files


def texts():
    names = range(20_000)
    return {"effect, parameters": ("fx", "".join(f"float4 gA{i} < string UIName = \"a\"; > = float4(1, 2, 3, {i});\n" for i in names).encode()),
            "effect, code": ("fx", "".join(f"float f{i}(float x) {{ return x * {i} + sin(x); }}\n" for i in names).encode()),
            "workspace": ("json", ('{"parameters": {' + ", ".join(f'"gA{i}": [1, 2, 3, {i}]' for i in names) + "}}").encode())}


# A process counts what its parent held when it was made: a small one stands between.
BETWEEN = """import os, subprocess, sys
process = subprocess.Popen(sys.argv[1:], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
_, status, used = os.wait4(process.pid, 0)
print(os.waitstatus_to_exitcode(status), used.ru_maxrss)"""


def measured(command, folder):
    said = subprocess.run([sys.executable, "-c", BETWEEN, PROGRAM, *map(str, command)], cwd=REPOSITORY, capture_output=True, text=True, check=True,
                          env=dict(os.environ, TEGUMENT_CACHE=str(folder / "cache"))).stdout.split()
    return int(said[0]), int(said[1]) * 1024


def commands(path, folder):
    if path.suffix in (".ply", ".obj", ".off", ".stl", ".glb"):
        return {"`prep`": ["prep", path, "--dry-run"]}
    if path.suffix == ".fx":
        return {"read": ["info", path]}
    if path.suffix == ".json":
        return {"read": ["render", "OriginalTexture", "-w", path, "-o", folder / "x.png"]}
    return {"read": ["compare", path, path]}


def main():
    with tempfile.TemporaryDirectory(prefix="tegument-memory-") as name:
        folder = pathlib.Path(name)
        (folder / "small.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="ascii")
        start = measured(["prep", folder / "small.obj", "--dry-run"], folder)[1]
        print(f"without a file of any size: {start / MIB:.0f} MiB\n\n| format | MB | MB taken | bytes a byte |\n|---|---|---|---|")
        for files in (meshes, pictures, texts):
            for what, (ending, content) in files().items():
                path = folder / f"file.{ending}"
                path.write_bytes(content)
                for step, command in commands(path, folder).items():
                    code, peak = measured(command, folder)
                    taken = max(0, peak - start)
                    print(f"| {what}, {step} | {len(content) / 1e6:.2f} | {taken / 1e6:.0f} | {taken / len(content):.1f} |" + ("" if code in (0, 1) else f" exit {code}"),
                          flush=True)


if __name__ == "__main__":
    main()
