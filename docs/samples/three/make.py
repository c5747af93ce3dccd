#!/usr/bin/env python3
"""A folder for three.js, skin and fur: make.py FOLDER [--program tegument] [--ball]. demo.html there shows both; it wants `npm ci` in the
folder, and a server: python3 -m http.server. The default head and the Bunny are copied where they have been made (`tegument prep human`,
`tegument prep bunny`); --ball: a sphere in the Bunny's stead. It needs DXC."""

import argparse
import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
sys.dont_write_bytecode = True
sys.path.insert(0, str(HERE.parent / "web"))
import make as web  # its make.py

EFFECTS = {
    "Separable": ("peers/Separable.fx", "Separable11"),
    "Preintegrated": ("peers/Preintegrated.fx", "Preintegrated", "PreintegratedPenumbra"),
    "PreintegratedTable": ("peers/PreintegratedTable.fx", "PreintegratedTable"),
    "EnergyAttenuation": ("EnergyAttenuation.fx", "EnergyAttenuation"),
    "Fur": ("Fur.fx", "CubePosition"),
}
COPIED = (HERE / "tegument-three.js", HERE / "demo.html", HERE / "package.json", HERE / "package-lock.json", HERE.parent / "web" / "effect.js")


def effects(program):
    files = [str(web.SHARE / "effects" / file) for file, *_ in EFFECTS.values()]
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([program, "check", *files, "--target", "spirv-dxc", "--emit", folder, "--emit-kind", "glsl-es"], check=True, stdout=subprocess.DEVNULL)
        return {name: web.read_effect(pathlib.Path(folder, name), *techniques) for name, (_, *techniques) in EFFECTS.items()}


def presets():
    """Coats of shells: effects/Fur.presets.json, and what the Bunny's workspace says."""
    named = json.loads((web.SHARE / "effects" / "Fur.presets.json").read_text(encoding="utf-8"))
    return {"bunny": web.workspace("bunny")["parameters"], **{name: preset["parameters"] for name, preset in named.items() if name != "comment"}}


def models(program, folder, ball):
    """What demo.html shows, as far as it is there."""
    human, fur = web.cache() / "human" / "human.glb", web.cache() / "fur"
    made = {"head.glb": human, "body.glb": fur / "bunny.glb", "fur_cube.dds": fur / "fur_cube.dds"}
    if ball:
        web.furry_ball(program, folder)
        made |= {"body.glb": folder / "ball.glb", "fur_cube.dds": folder / "fur" / "fur_cube.dds"}
    for name, source in made.items():
        if source.exists():
            shutil.copyfile(source, folder / name)
        else:
            print(f"make.py: {source} is not there, so {name} is not: tegument prep human; tegument prep bunny", file=sys.stderr)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--program", default="tegument", help="default: the one that is installed")
    parser.add_argument("--ball", action="store_true", help="a furry ball instead of the Bunny")
    arguments = parser.parse_args()
    arguments.folder.mkdir(parents=True, exist_ok=True)
    try:
        text = f"export const effects = {json.dumps(effects(arguments.program))};\nexport const presets = {json.dumps(presets())};\n"
        models(arguments.program, arguments.folder, arguments.ball)
    except subprocess.CalledProcessError as error:
        sys.exit(error.returncode)
    except FileNotFoundError as error:
        sys.exit(f"make.py: {error}: --program names tegument")
    (arguments.folder / "effects.js").write_text(text, encoding="utf-8")
    for file in COPIED:
        shutil.copyfile(file, arguments.folder / file.name)
    print(f"wrote {arguments.folder}: tegument-three.js, demo.html; npm ci there brings three.js")


if __name__ == "__main__":
    main()
