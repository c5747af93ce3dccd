"""Skin and fur effects in HLSL, drawn into NumPy arrays; effects checked, meshes prepared.

    import tegument
    tegument.run("prep", "human")                       # makes the default head, once
    head = tegument.Scene("Pyramid")
    picture = head.render(512, 512)                     # float32, 512 x 512 x 4: linear radiance, row 0 on top
    head.set(gRoughness=0.25)
    head.set_light(position=(-3, 4, 5), color=(1.5, 1.5, 1.5))
    again = head.render(512, 512)                       # nothing is compiled or uploaded again
    shown = tegument.to_srgb(again)                     # bytes, as `tegument render -o head.png` writes them

    tegument.check("mine.fx", target="spirv")           # what `tegument check --json` prints, as a dict
    tegument.prep("scan.ply", output="scan.glb", levels=3)

Whatever the command line refuses raises tegument.Error; warnings are Python's.
"""

import json
import pathlib
import subprocess

from . import _tegument

__all__ = ["Error", "Scene", "check", "fur", "info", "prep", "run", "to_srgb"]

_FOLDER = pathlib.Path(__file__).resolve().parent
_PROGRAM = _FOLDER / "bin" / "tegument"
_tegument.set_own_folder(str(_FOLDER / "share" / "tegument"))


class Error(Exception):
    """What went wrong, as the command line says it. `blame`: 1 an input file, 2 the call, 3 the machine. `codes`: ["TG8006", ...]."""

    def __init__(self, text, blame=3, codes=()):
        super().__init__(text)
        self.blame = blame
        self.codes = list(codes)


def _assignments(values):
    """{"gTint": (1, 2, 3)} as ["gTint=1,2,3"]; a string or a path is a texture's file."""
    def text(value):
        if isinstance(value, (str, pathlib.PurePath)):
            return str(value)
        numbers = value if hasattr(value, "__iter__") else [value]
        return ",".join(repr(float(number)) for number in numbers)
    return [f"{name}={text(value)}" for name, value in values.items()]


class Scene:
    """An effect on a mesh, in light, before a camera.

    effect: a file, or the name of one of ours ("Pyramid", "FurCoat"). mesh: a file in place of the workspace's; unit_mm: millimetres in one
    unit of it. workspace: camera, light and meshes (docs/workspace.md). defines: the effect's switches, ["TEGUMENT_LAMPS=3"]. values:
    parameters by name, numbers or a texture's file. samples: of a pixel, 1, 2, 4 or 8; 0: four where the technique can have them.
    device: part of the Vulkan device's name.
    """

    def __init__(self, effect, *, technique="", workspace="", mesh="", unit_mm=None, preset="", setting="", defines=(), values=None, samples=0,
                 device=""):
        self._scene = _tegument.load(str(effect), technique, str(workspace), str(mesh), unit_mm, preset, list(defines),
                                     _assignments(values or {}), setting, samples, device)

    def render(self, width=1024, height=1024):
        """A picture: float32, height x width x 4, linear radiance and coverage."""
        return self._scene.render(width, height)

    def target(self, name):
        """A texture that the last picture drew on its way, such as "gIrradianceMap": float32, height x width x channels."""
        return self._scene.target(name)

    def set(self, **values):
        """Parameters from now on: numbers, or a texture's file."""
        for assignment in _assignments(values):
            self._scene.set(assignment)

    def set_camera(self, position=None, target=None, fov=None):
        """Where the camera is and looks; fov: across, degrees. Lengths as in the workspace: radii of the mesh, or mm."""
        self._scene.set_camera(position, target, fov)

    def set_light(self, position=None, color=None):
        """color: E / pi at the middle of the mesh, linear."""
        self._scene.set_light(position, color)

    camera = property(lambda self: self._scene.camera, doc="Position of the camera.")
    light = property(lambda self: self._scene.light, doc="Position of the light.")
    targets = property(lambda self: self._scene.targets, doc="Names of the textures that the last picture drew.")
    times = property(lambda self: self._scene.times, doc="Milliseconds by pass of the last picture.")
    device = property(lambda self: self._scene.device, doc="The Vulkan device.")


def to_srgb(picture):
    """Linear radiance as bytes to look at, uint8, height x width x 3: tone mapped and encoded as `tegument render -o head.png` does it."""
    return _tegument.to_srgb(picture)


def _codes(printed):
    """Of {"diagnostics": [{"code": "TG8006"}]}, which a command with --json prints where it fails."""
    try:
        return [diagnostic["code"] for diagnostic in json.loads(printed)["diagnostics"]]
    except (ValueError, KeyError, TypeError):
        return []


def _printed(arguments, fine=(0,)):
    done = subprocess.run([_PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False)
    if done.returncode not in fine:
        raise Error((done.stderr or done.stdout).strip(), done.returncode, _codes(done.stdout))
    return done.stdout


def run(*arguments):
    """Runs `tegument ARGUMENTS` and returns what it printed. Raises Error where its exit code is not 0."""
    return _printed(arguments)


def _options(options):
    """target="spirv" as --target spirv, all_settings=True as --all-settings; a list repeats its option."""
    words = []
    for name, value in options.items():
        flag = "--" + name.replace("_", "-")
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is not None and one is not False:
                words += [flag] if one is True else [flag, one]
    return words + ["--json"]


def check(*effects, **options):
    """Compiles effects for every target, or target="spirv" and so on: what `tegument check EFFECTS --json` says, errors in them included.
    Raises Error only where nothing could be checked."""
    return json.loads(_printed(["check", *effects, *_options(options)], fine=(0, 1)))


def info(effect, **options):
    """Techniques, parameters with ranges and units, settings of an effect: `tegument info EFFECT --json`."""
    return json.loads(run("info", effect, *_options(options)))


def prep(mesh, **options):
    """Makes a mesh clean, indexed, ordered, with levels of detail: `tegument prep MESH --output FILE --json`; its report."""
    return json.loads(run("prep", mesh, *_options(options)))


def fur(kind, mesh, **options):
    """`tegument fur KIND MESH`: kind "roots" or "strands"; its report."""
    return json.loads(run("fur", kind, mesh, *_options(options)))
