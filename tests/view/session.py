"""The program's window under a display of its own, as all tests of it begin: PROGRAM REPOSITORY [PICTURES] are the arguments of each of them."""

import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import screen as screens

PROGRAM, REPOSITORY = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2]).resolve()
PICTURES = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else None
SIZE = 320
PATIENCE = 60  # seconds: lavapipe beside other tests
SKIPPED = 77


def ball(rings=24, radius=80.0):
    """A closed bumpy ball in two charts, in mm."""
    lines, faces, index = [], [], 1
    for chart in range(2):
        for i in range(rings + 1):
            for j in range(rings + 1):
                u, v = j / rings, i / rings
                theta, phi = math.pi * v, math.pi * (u + chart)
                r = radius * (1 + 0.05 * math.sin(3 * theta) * math.cos(2 * phi + 0.5))
                lines.append(f"v {-r * math.cos(phi) * math.sin(theta):.6f} {r * math.cos(theta):.6f} {r * math.sin(phi) * math.sin(theta):.6f}")
                lines.append(f"vt {0.02 + 0.5 * chart + 0.46 * u:.6f} {1 - (0.02 + 0.96 * v):.6f}")
                down = index + rings + 1
                if i < rings and j < rings:
                    if i > 0:
                        faces.append(f"f {index}/{index} {down}/{down} {index + 1}/{index + 1}")
                    if i + 1 < rings:
                        faces.append(f"f {index + 1}/{index + 1} {down}/{down} {down + 1}/{down + 1}")
                index += 1
    return "\n".join(lines + faces) + "\n"


def own_copy():
    """A folder with the effects and a ball."""
    folder = pathlib.Path(tempfile.mkdtemp(prefix="tegument-view-"))
    for name in ("effects", "hlsl"):
        shutil.copytree(REPOSITORY / name, folder / name)
    (folder / "ball.obj").write_text(ball())
    scene = {"mesh": "ball.obj", "unit_mm": 1, "head": False, "camera": {"position": [1, 0.5, 5]}, "light": {"position": [-1, 2, 5]}}
    (folder / "ball.json").write_text(json.dumps(scene))
    return folder


class View:
    """The program with a copy of the effects of its own, so that they can be broken."""

    def __init__(self, arguments=("effects/Main.fx", "-w", "ball.json", "--map-size", "64"), files=(), before=None, size=(SIZE, SIZE), screen=(2 * SIZE, SIZE), scale=1):
        self.folder = own_copy()
        if before:
            before(self.folder)
        self.screen = screens.Screen(*screen, scale)
        self.errors = open(self.folder / "stderr.txt", "w+")
        for name, text in files:
            (self.folder / name).write_text(text)
        command = [PROGRAM, "view", *arguments, "--size", f"{size[0]}x{size[1]}", "--validate"]
        environment = {**os.environ, "DISPLAY": self.screen.name, "TEGUMENT_VIEW_PLACES": str(self.folder / "places.json")}
        environment.pop("WAYLAND_DISPLAY", None)
        self.process = screens.begin(command, cwd=self.folder, env=environment, stderr=self.errors)

    def said(self):
        return (self.folder / "stderr.txt").read_text()

    def wait(self, what, condition):
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if self.process.poll() is not None:
                raise AssertionError(f"the program ended with {self.process.returncode}: {self.said()}")
            value = condition()
            if value:
                return value
            time.sleep(0.05)
        raise AssertionError(f"{what}: not within {PATIENCE} s; title '{self.screen.title()}', said '{self.said()}'")

    def title(self, part):
        return self.wait(f"'{part}' in the title", lambda: part in self.screen.title() and self.screen.title())

    def worked(self):
        """Seconds in which its threads ran or waited for a processor: on a busy machine one that waits has work, too."""
        total = 0
        for task in pathlib.Path(f"/proc/{self.process.pid}/task").iterdir():
            try:
                ran, waited, _ = (task / "schedstat").read_text().split()
                total += int(ran) + int(waited)
            except OSError:
                continue  # the thread has ended
        return total / 1e9

    def still(self, unlike=None):
        """The screen once it stays the same while the program rests, and is not `unlike`."""
        last = [self.screen.grab(), self.worked()]

        def settled():
            time.sleep(0.4)
            now, worked = self.screen.grab(), self.worked()
            rests = now == last[0] and abs(worked - last[1]) <= 0.03  # it looks at its files now and then; a thread that ended had worked
            last[:] = now, worked
            return now if rests and (unlike is None or now != unlike) else None

        return self.wait("a picture that stays", settled)

    def places(self):
        """Panels and controls by name: left, top, width, height."""
        try:
            return json.loads((self.folder / "places.json").read_text())
        except (OSError, ValueError):
            return {}

    def place(self, name):
        """Where it stands once it stands still."""
        last = [None]

        def stands():
            now = self.places().get(name)
            same = now is not None and now == last[0]
            last[0] = now
            if not same:
                time.sleep(0.15)
            return now if same else None

        return self.wait(f"a control '{name}' of {sorted(self.places())}", stands)

    def crop(self, picture, name):
        """What of the screen a panel or a control takes."""
        left, top, width, height = (round(value) for value in self.place(name))
        width, height = min(width, picture.width - left), min(height, picture.height - top)
        rows = (picture.pixels[(y * picture.width + left) * 3:(y * picture.width + left + width) * 3] for y in range(top, top + height))
        return screens.Picture(width, height, b"".join(rows))

    def click(self, name):
        left, top, width, height = self.place(name)
        self.screen.click(round(left + min(width / 2, 20)), round(top + height / 2))

    def slide(self, name, by=0.35):
        """From near its middle, where of several numbers is no gap, by a share of its width."""
        left, top, width, height = self.place(name)
        y = round(top + height / 2)
        self.screen.drag((round(left + 0.4 * width), y), (round(left + (0.4 + by) * width), y))

    def search(self, text):
        """The search field holds this, and keys are commands again."""
        self.click("search")
        self.screen.press("a", "Control_L")
        self.screen.press("BackSpace")
        self.screen.type(text)
        self.screen.press("Return")
        self.still()

    def choose(self, control, value):
        """An entry of a list."""
        self.click(control)
        self.click(f"{control}={value}")

    def turn_to(self, technique, key):
        """One technique after the other: a key before the last one is shown would pass it."""
        while f" {technique} [" not in (title := self.screen.title()):
            self.screen.press(key)
            self.wait("another technique", lambda: self.screen.title().split("[")[0] != title.split("[")[0])

    def start_again(self):
        for key in ("Escape", "r"):
            self.screen.press(key)
        self.title("picture,")
        return self.still()

    def end(self):
        """Its exit code; killed where a test that failed left the keys with the text of the effect, say."""
        if self.process.poll() is None:
            self.screen.press("q")
            try:
                self.process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self.process.kill()
        self.screen.close()
        return self.process.wait()


def keep(picture, name):
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
        picture.save(PICTURES / f"{name}.png")
    return picture


def slow_edit(text):
    """What takes the compiler some seconds: a loop that is unrolled, and whose result counts; the picture gets darker."""
    loop = "[unroll] for (int slow = 0; slow < 600; ++slow) sum += sin(sum.yzx * float(slow) + uv.xyx);"
    edited = text.replace("float4(lerp(", "1e-9 * SlowSum(input.uv * 1e-3).xyzz + float4(0.25 * lerp(")
    edited = edited.replace("float4 FinalPS", "float3 SlowSum(float2 uv) { float3 sum = uv.xyy; " + loop + " return sum; }\n\nfloat4 FinalPS", 1)
    assert edited.count("SlowSum") == 3, "what this edits is there"
    return edited


class WideWindow(unittest.TestCase):
    """Twice as wide as high, for what stands beside or over the picture; it must end well, with no message of validation."""

    ARGUMENTS = ("effects/Main.fx", "-w", "ball.json", "--map-size", "64")
    FILES = ()
    TITLE = "Main.fx DEonLuebke [corrected] picture"

    @classmethod
    def before(cls, folder):
        """What else the folder holds when the program starts."""

    @classmethod
    def setUpClass(cls):
        cls.view = View(cls.ARGUMENTS, cls.FILES, cls.before)
        cls.view.title(cls.TITLE)
        cls.view.screen.resize(2 * SIZE, SIZE)
        cls.view.screen.press("i")  # the text holds times, which differ from frame to frame
        cls.start = cls.view.still()

    @classmethod
    def tearDownClass(cls):
        ended, said = cls.view.end(), cls.view.said()
        shutil.rmtree(cls.view.folder)
        assert ended == 0 and "validation:" not in said, said


def main():
    if screens.missing():
        print("skipped: " + screens.missing())
        sys.exit(SKIPPED)
    unittest.main(argv=sys.argv[:1], verbosity=2)
