#!/usr/bin/env python3
"""One page without requests that draws skin and fur by WebGL 2: make.py PAGE.html [--program tegument] [--mesh HEAD.glb] [--ball FOLDER]

The default head by effects/peers/Separable.fx, and the Bunny by effects/Fur.fx; each where it has been made (`tegument prep human`,
`tegument prep bunny`). --mesh: a head of yours instead, as `tegument prep` writes it. --ball: a sphere in the Bunny's coat instead of the
Bunny, for machines that have none. Exit code 3: DXC is missing."""

import argparse
import base64
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import zlib

HERE = pathlib.Path(__file__).resolve().parent
SHARE = next(share for folder in HERE.parents for share in (folder, folder / "tegument") if (share / "effects").is_dir())  # the tree, or share/tegument
EFFECTS = {"Separable": "peers/Separable.fx", "EnergyAttenuation": "EnergyAttenuation.fx", "Fur": "Fur.fx"}
USED = {"Separable": "Separable11", "EnergyAttenuation": "EnergyAttenuation", "Fur": "CubePosition"}
TANGENT_LIMIT = 0.5
PLAIN_SKIN = (0.53, 0.34, 0.27, 1)  # docs/running.md, "Textures"


def cache():
    own = os.environ.get("TEGUMENT_CACHE") or (os.environ.get("XDG_CACHE_HOME") and os.environ["XDG_CACHE_HOME"] + "/tegument")
    return pathlib.Path(own or pathlib.Path.home() / ".cache" / "tegument")


def pack(data):
    return base64.b64encode(zlib.compress(bytes(data), 6)).decode()


def emitted(program, folder):
    """Manifests and texts of the techniques that the page draws."""
    files = [str(SHARE / "effects" / file) for file in EFFECTS.values()]
    subprocess.run([program, "check", *files, "--target", "spirv-dxc", "--emit", str(folder), "--emit-kind", "glsl-es"], check=True, stdout=subprocess.DEVNULL)
    return {name: read_effect(folder / name, USED[name]) for name in EFFECTS}


def read_effect(folder, *techniques):
    manifest = json.loads((folder / "manifest.json").read_text(encoding="utf-8"))
    manifest["techniques"] = [entry for entry in manifest["techniques"] if entry["name"] in techniques]
    used = {name for entry in manifest["techniques"] for step in entry["passes"] for name in (step["vertex_shader"], step["pixel_shader"])}
    manifest["shaders"] = [shader for shader in manifest["shaders"] if shader["name"] in used]
    files = [shader["glsl-es"]["file"] for shader in manifest["shaders"]]
    return {"manifest": {key: manifest[key] for key in ("effect", "parameters", "samplers", "techniques", "shaders")},
            "texts": {file: (folder / file).read_text(encoding="utf-8") for file in files}}


# ---- Meshes that `tegument prep` writes


class Glb:
    def __init__(self, path):
        data = path.read_bytes()
        if data[:4] != b"glTF":
            sys.exit(f"make.py: {path} is no .glb")
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20:20 + length])
        self.bytes = data[28 + length:]

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.bytes[start:start + view["byteLength"]]

    def accessor(self, index):
        entry = self.json["accessors"][index]
        return self.view(entry["bufferView"])[entry.get("byteOffset", 0):], entry

    def picture(self, reference):
        """What a material's texture shows, as it is packed; none where it has none."""
        source = self.json["textures"][reference["index"]].get("source") if reference else None
        return None if source is None else self.view(self.json["images"][source]["bufferView"])


def across(normal):
    """The tangent of a mesh without texture coordinates, as host/run/geometry.cpp has it."""
    aside = (1, 0, 0) if abs(normal[0]) < TANGENT_LIMIT else (0, 1, 0)
    v = (aside[1] * normal[2] - aside[2] * normal[1], aside[2] * normal[0] - aside[0] * normal[2], aside[0] * normal[1] - aside[1] * normal[0])
    length = math.sqrt(sum(value * value for value in v))
    return (*(value / length for value in v), 1) if length else (1, 0, 0, 1)


def interleaved(positions, normals, tangents=None, places=None):
    stream = bytearray()
    for i, (position, normal) in enumerate(zip(positions, normals)):
        stream += struct.pack("<12f", *position, *normal, *(tangents[i] if tangents else across(normal)), *(places[i] if places else (0, 0)))
    return stream


def read_mesh(path):
    file = Glb(path)
    mesh = file.json["meshes"][0]
    bounds = mesh.get("extras", {}).get("tegument", {}).get("bounds")
    if not bounds:
        sys.exit(f"make.py: {path} was not written by tegument prep: tegument prep {path} -o PREPARED.glb")
    attributes = mesh["primitives"][0]["attributes"]

    def rows(name, size):
        if name not in attributes:
            return None
        data, entry = file.accessor(attributes[name])
        return list(struct.iter_unpack(f"<{size}f", data[:entry["count"] * size * 4]))

    stream = interleaved(rows("POSITION", 3), rows("NORMAL", 3), rows("TANGENT", 4), rows("TEXCOORD_0", 2))
    indices = bytearray()
    for primitive in mesh["primitives"]:
        data, entry = file.accessor(primitive["indices"])
        size = {5123: 2, 5125: 4}[entry["componentType"]]
        indices += data[:entry["count"] * size]
    return file, {"vertices": pack(stream), "indices": pack(indices), "index_bytes": size, "bounds": bounds}


def ball(path, steps=48):
    """A sphere of 80 mm as an OBJ file, and as the page has it."""
    points, faces = [], []
    for row in range(steps + 1):
        for column in range(2 * steps):
            down, around = math.pi * row / steps, math.pi * column / steps
            points.append((math.sin(down) * math.sin(around), math.cos(down), math.sin(down) * math.cos(around)))
    for row in range(steps):
        for column in range(2 * steps):
            a, b = row * 2 * steps + column, row * 2 * steps + (column + 1) % (2 * steps)
            faces += [(a, a + 2 * steps, b + 2 * steps)] * (row < steps - 1) + [(a, b + 2 * steps, b)] * (row > 0)
    lines = [f"v {x * 80:.6f} {y * 80:.6f} {z * 80:.6f}\nvn {x:.8f} {y:.8f} {z:.8f}" for x, y, z in points]
    path.write_text("\n".join(lines + ["f " + " ".join(f"{i + 1}//{i + 1}" for i in face) for face in faces]) + "\n")


# ---- Subjects


def workspace(name):
    text = json.loads((SHARE / "effects" / "workspaces" / f"{name}.json").read_text(encoding="utf-8"))
    return {key: text[key] for key in ("camera", "light", "background", "parameters") if key in text}


def head(own=None):
    path = own or cache() / "human" / "human.glb"
    if not path.exists():
        return None
    file, mesh = read_mesh(path)
    primitive = file.json["meshes"][0]["primitives"][0]
    if "TEXCOORD_0" not in primitive["attributes"]:
        sys.exit(f"make.py: {path} has no texture coordinates: tegument prep --unwrap makes them")
    material = file.json["materials"][primitive["material"]] if "material" in primitive else {}
    pictures = {"gSkinMap": (material.get("pbrMetallicRoughness", {}).get("baseColorTexture"), True), "gNormalMap": (material.get("normalTexture"), False)}
    textures = {name: {"picture": pack(data), "srgb": srgb} for name, (reference, srgb) in pictures.items() if (data := file.picture(reference))}
    if "gSkinMap" not in textures:
        print(f"make.py: {path} has no colour map: its skin has one plain colour", file=sys.stderr)
    return {"title": f"{own.stem if own else 'The default head'}: separable scattering in screen space", "effect": "Separable", "technique": USED["Separable"], **mesh,
            "workspace": workspace("human"),
            "textures": textures, "plain": {} if "gSkinMap" in textures else {"gSkinMap": PLAIN_SKIN},
            "products": {"gEnergyAttenuationMap": {"effect": "EnergyAttenuation", "technique": "EnergyAttenuation", "target": "gEnergyAttenuationMap"}}}


def cube_map(path):
    data = path.read_bytes()
    levels, size = struct.unpack_from("<I", data, 28)[0], struct.unpack_from("<I", data, 16)[0]
    return {"texels": pack(data[148:]), "size": size, "levels": levels}


def furry(mesh_file, map_file, title):
    return {"title": title, "effect": "Fur", "technique": USED["Fur"], **read_mesh(mesh_file)[1], "workspace": workspace("bunny"),
            "textures": {"gFurCubeMap": cube_map(map_file)}, "plain": {}, "products": {}}


def bunny():
    folder = cache() / "fur"
    if not (folder / "bunny.glb").exists() or not (folder / "fur_cube.dds").exists():
        return None
    return furry(folder / "bunny.glb", folder / "fur_cube.dds", "The Bunny: shells of fur")


def furry_ball(program, folder):
    """Its mesh and map are left in the folder, so that Vulkan can draw the same."""
    ball(folder / "ball.obj")
    for command in (["prep", folder / "ball.obj", "-o", folder / "ball.glb", "--unit-mm", "1"], ["fur", "texture", "--size", "256", "-o", folder / "fur"]):
        subprocess.run([program, *map(str, command)], check=True, stdout=subprocess.DEVNULL)
    return furry(folder / "ball.glb", folder / "fur" / "fur_cube.dds", "A ball: shells of fur")


def script():
    """effect.js, scene.js and page.js as one: a page that is opened as a file may not import others."""
    texts = [(HERE / name).read_text(encoding="utf-8") for name in ("effect.js", "scene.js", "page.js")]
    lines = [line.removeprefix("export ") for text in texts for line in text.splitlines() if not line.startswith(("import ", '"use strict"'))]
    return "\n".join(lines)


def data_of(arguments):
    """What the page shows, and the effects for it."""
    subjects = {}
    if not arguments.no_head and (made := head(arguments.mesh)):
        subjects["head"] = made
    if arguments.ball:
        arguments.ball.mkdir(parents=True, exist_ok=True)
        subjects["ball"] = furry_ball(arguments.program, arguments.ball)
    elif made := bunny():
        subjects["bunny"] = made
    if not subjects:
        sys.exit("make.py: there is neither the head nor the Bunny: tegument prep human; tegument prep bunny; or --mesh HEAD.glb; or --ball FOLDER")
    with tempfile.TemporaryDirectory() as folder:
        return {"effects": emitted(arguments.program, pathlib.Path(folder)), "subjects": subjects}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=pathlib.Path)
    parser.add_argument("--program", default="tegument", help="default: the one that is installed")
    parser.add_argument("--ball", type=pathlib.Path, metavar="FOLDER", help="a furry ball instead of the Bunny; its files stay in FOLDER")
    parser.add_argument("--mesh", type=pathlib.Path, metavar="HEAD.glb", help="a head of yours, from tegument prep, instead of the default one")
    parser.add_argument("--no-head", action="store_true")
    arguments = parser.parse_args()
    if arguments.mesh and not arguments.mesh.is_file():
        parser.error(f"there is no {arguments.mesh}")
    try:
        data = data_of(arguments)
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
    except FileNotFoundError as error:
        sys.exit(f"make.py: {error}: --program names tegument")
    text = (HERE / "page.html").read_text(encoding="utf-8").replace("@SCRIPT@", script()).replace("@DATA@", json.dumps(data).replace("<", "\\u003c"))
    arguments.page.parent.mkdir(parents=True, exist_ok=True)
    arguments.page.write_text(text, encoding="utf-8")
    print(f"wrote {arguments.page}, {len(text) / 1e6:.1f} MB: {', '.join(data['subjects'])}")


if __name__ == "__main__":
    main()
