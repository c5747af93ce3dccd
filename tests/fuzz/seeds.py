"""First inputs for the fuzzers: files of the tree, and small ones of every format, made here."""

import base64
import json
import struct
import subprocess

KEPT = {
    "effect_fuzz": ["tests/effect/fuzz/corpus", "tests/effect/expect_fail", "effects"],
    "adopt_fuzz": ["tests/adopt/effects"],
    "dds_fuzz": ["tests/image/fuzz/corpus"],
    "fuzz_workspace": ["effects/workspaces"],
    "binary_fuzz": [],
}

OBJ = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0 1 0 0\nvt 0 0\nvt 1 0\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1\nf -3//1 -1//1 -2//1\nf 1 2 4 3\n"
PLY_HEAD = ("ply\nformat {} 1.0\ncomment x\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty uchar red\n"
            "element face 1\nproperty list uchar int vertex_indices\nend_header\n")
PLACES = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]


def plys():
    text = PLY_HEAD.format("ascii") + "".join("%g %g %g 7\n" % p for p in PLACES) + "3 0 1 2\n"
    little = PLY_HEAD.format("binary_little_endian").encode() + b"".join(struct.pack("<3fB", *p, 7) for p in PLACES)
    big = PLY_HEAD.format("binary_big_endian").encode() + b"".join(struct.pack(">3fB", *p, 7) for p in PLACES)
    strips = ("ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\n"
              "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2 -1\n")
    return [text.encode(), little + struct.pack("<B3i", 3, 0, 1, 2), big + struct.pack(">B3i", 3, 0, 1, 2), strips.encode()]


def stls():
    corners = "".join("vertex %g %g %g\n" % p for p in PLACES)
    text = f"solid x\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\nendsolid x\n"
    return [text.encode(), bytes(80) + struct.pack("<I12fH", 1, 0, 0, 1, *sum(PLACES, ()), 0)]


def glb(document, binary):
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    binary += b"\0" * (-len(binary) % 4)
    return (b"glTF" + struct.pack("<II", 2, 28 + len(text) + len(binary)) + struct.pack("<I4s", len(text), b"JSON") + text +
            struct.pack("<I4s", len(binary), b"BIN\0") + binary)


def gltfs():
    binary = b"".join(struct.pack("<3f", *p) for p in PLACES) + struct.pack("<4H", 0, 1, 2, 0)
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0, "translation": [1, 2, 3], "children": [1]}, {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
                "materials": [{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                              {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
                "buffers": [{"byteLength": len(binary)}]}
    embedded = json.loads(json.dumps(document))
    embedded["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(binary).decode()
    sparse = json.loads(json.dumps(document))
    sparse["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": 1, "componentType": 5123}, "values": {"bufferView": 0}}
    return [glb(document, binary), glb(embedded, b""), glb(sparse, binary)]


def images(repository):
    """Pillow's PNG and JPEG, a Radiance picture, and what the release build writes as EXR, where there is one."""
    from PIL import Image
    import io

    files = [b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 8\n" + bytes([2, 2, 0, 8] + 4 * [136, 90]),
             b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n" + bytes(8 * [128])]
    for mode in ("1", "L", "LA", "P", "RGB", "RGBA", "I;16"):
        for form, more in (("PNG", {}), ("JPEG", {}), ("JPEG", {"progressive": True})):
            out = io.BytesIO()
            try:
                Image.new(mode, (9, 7), 1).save(out, form, **more)
            except OSError:
                continue  # JPEG has no alpha
            files.append(out.getvalue())
    program = repository / "build/release/tegument"
    out = repository / "build/fuzz/seed.exr"
    if program.exists() and subprocess.run([program, "render", "Beckmann", "--size", "8", "-o", out], capture_output=True, check=False).returncode == 0:
        files.append(out.read_bytes())
    return files


def made(name, repository):
    return {
        "fuzz_ply": plys, "fuzz_stl": stls, "fuzz_gltf": gltfs,
        "fuzz_obj": lambda: [OBJ.encode()],
        "fuzz_off": lambda: [b"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", b"COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2 255 0 0\n"],
        "fuzz_image": lambda: images(repository),
        "presets_fuzz": lambda: [file.read_bytes() for file in sorted((repository / "effects").glob("*.presets.json"))],
        "prep_fuzz": lambda: [bytes([choices, 5] + list(range(90))) for choices in range(0, 256, 17)],
    }.get(name, list)()


def folders(name, repository, build):
    """Folders with the seeds of a target."""
    kept = [repository / folder for folder in KEPT.get(name, [])]
    folder = build / "seeds" / name
    folder.mkdir(parents=True, exist_ok=True)
    for number, content in enumerate(made(name, repository)):
        (folder / str(number)).write_bytes(content)
    return kept + [folder]
