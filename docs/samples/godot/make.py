#!/usr/bin/env python3
"""A folder for Godot 3, skin and shell fur: make.py FOLDER [--program tegument]. skin.gdshader and fur.gdshader there are complete; demo.gd
shows how they are used. godot4/ holds the same texts for Godot 4, untried. Functions are those of hlsl/, compiled; it needs DXC."""

import argparse
import json
import pathlib
import re
import struct
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent / "web"))
import make as web  # its make.py

WORDS = {
    3: {"VERSION": "For Godot 3.", "COLOR_HINT": "hint_albedo", "VALUE_HINT": "hint_color", "NORMAL_MAP": "NORMALMAP", "ALBEDO": " * ALBEDO", "VIEW_MATRIX": "INV_CAMERA_MATRIX"},
    4: {"VERSION": "For Godot 4; untried.", "COLOR_HINT": "source_color", "VALUE_HINT": "source_color", "NORMAL_MAP": "NORMAL_MAP", "ALBEDO": "", "VIEW_MATRIX": "VIEW_MATRIX"},
}


def compiled(program):
    """Each pixel shader of functions.fx as a function of four vectors, by its name."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "check", str(HERE / "functions.fx"), "-I", str(web.SHARE), "--target", "spirv-dxc", "--emit", folder, "--emit-kind", "glsl-es"],
                       check=True, stdout=subprocess.DEVNULL)
        return {file.stem: function(file.stem, file.read_text(encoding="utf-8")) for file in pathlib.Path(folder, "functions", "glsl-es").glob("*.frag")}


def function(name, text):
    body = text[text.index("{", text.index("void main()")) + 1:text.rindex("}")]
    body = re.sub(r"varying_TEXCOORD(\d)", r"argument_\1", body).replace("output_SV_TARGET0 = ", "return ")
    body = re.sub(r"(\d+\.\d{8})\d+", r"\1", re.sub(r"\b_(\d+)\b", r"v\1", re.sub(r"\d+\.\d+e-\d+", lambda found: f"{float(found[0]):.9e}", body)))
    arguments = ", ".join(f"vec4 argument_{i}" for i in range(4))
    return f"vec4 {name}({arguments}) {{\n{body.strip(chr(10)).replace('    ', chr(9))}}}\n"


def shader(text, functions, version):
    text = re.sub(r"@FUNCTIONS ([\w ]+)@\n", lambda found: "".join(functions[name] + "\n" for name in found[1].split()), text)
    return re.sub(r"@(\w+)@", lambda found: WORDS[version][found[1]], text)


def write_subject(folder, name, source):
    unpack = lambda text: web.zlib.decompress(web.base64.b64decode(text))
    vertices, indices = unpack(source["vertices"]), unpack(source["indices"])
    letter = {2: "H", 4: "I"}[source["index_bytes"]]
    numbers = struct.unpack(f"<{len(indices) // source['index_bytes']}{letter}", indices)
    mesh = struct.pack("<I", len(vertices) // 48) + vertices + struct.pack(f"<I{len(numbers)}I", len(numbers), *numbers)
    (folder / f"{name}.mesh").write_bytes(mesh)
    place = lambda point: [a * source["bounds"]["radius"] + b for a, b in zip(point, source["bounds"]["centre"])]
    shown = source["workspace"]
    encoded = [1.055 * value ** (1 / 2.4) - 0.055 if value > 0.0031308 else value * 12.92 for value in shown["background"]]
    (folder / f"{name}.json").write_text(json.dumps({"eye": place(shown["camera"]["position"]), "target": place(shown["camera"]["target"]),
        "fov": shown["camera"]["horizontal_fov"], "lamp": place(shown["light"]["position"]), "light": max(shown["light"]["color"]), "background": encoded}))
    for key, texture in source["textures"].items():
        if "picture" in texture:
            (folder / f"{name}_{'color' if key == 'gSkinMap' else 'normal'}.png").write_bytes(unpack(texture["picture"]))
        else:
            write_cube(folder / f"{name}.cube", unpack(texture["texels"]), texture["size"], texture["levels"])


def write_cube(path, texels, size, levels):
    whole = sum(max(1, size >> level) ** 2 for level in range(levels)) * 4
    path.write_bytes(struct.pack("<I", size) + b"".join(texels[face * whole:face * whole + size * size * 4] for face in range(6)))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="tegument", help="default: the one that is installed")
    arguments = parser.parse_args()
    try:
        functions = compiled(arguments.program)
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
    except FileNotFoundError as error:
        sys.exit(f"make.py: {error}: --program names tegument")
    (arguments.folder / "godot4").mkdir(parents=True, exist_ok=True)
    (arguments.folder / "godot4" / ".gdignore").touch()
    for name in ("skin.gdshader", "fur.gdshader"):
        text = (HERE / name).read_text(encoding="utf-8")
        (arguments.folder / name).write_text(shader(text, functions, 3))
        (arguments.folder / "godot4" / name).write_text(shader(text, functions, 4))
    (arguments.folder / "demo.gd").write_text((HERE / "demo.gd").read_text(encoding="utf-8"))
    (arguments.folder / "project.godot").write_text('config_version=4\n[application]\nconfig/name="Tegument"\n[display]\nwindow/size/width=512\nwindow/size/height=512\n')
    subjects = {name: made for name, made in (("head", web.head()), ("bunny", web.bunny())) if made}
    for name, source in subjects.items():
        write_subject(arguments.folder, name, source)
    print(f"wrote {arguments.folder}: {', '.join(subjects) or 'texts alone: neither head nor Bunny has been made'}")


if __name__ == "__main__":
    main()
