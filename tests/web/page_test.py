"""The page of docs/samples/web in a headless Chromium (WebGL 2 by SwiftShader), its pictures held against Vulkan's: page_test.py TEGUMENT ROOT."""

import base64
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(ROOT / "tests" / "report"))
import browser  # noqa: E402

KEEP = os.environ.get("TEGUMENT_TEST_PICTURES")  # a folder for the pictures, to look at
SIZE = 256
STEPS = 4  # of 255: what is further apart than this is off


def png(data):
    from PIL import Image

    image = Image.open(io.BytesIO(data)).convert("RGB")
    return image.size, list(image.getdata())


def apart(ours, theirs):
    """Relative L2 of the pictures as they are shown, and the share of pixels with a channel that is off."""
    squares = sum((a - b) ** 2 for one, other in zip(ours, theirs) for a, b in zip(one, other))
    whole = sum(b * b for other in theirs for b in other)
    off = sum(max(abs(a - b) for a, b in zip(one, other)) > STEPS for one, other in zip(ours, theirs))
    return (squares / whole) ** 0.5, off / len(ours)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        page = cls.folder / "page.html"
        made = subprocess.run([sys.executable, ROOT / "docs" / "samples" / "web" / "make.py", page, "--program", PROGRAM, "--ball", cls.folder], text=True, capture_output=True)
        if made.returncode == 3:
            raise unittest.SkipTest("DXC is missing")
        assert made.returncode == 0, made.stderr
        cls.page = browser.Browser(600, 700, timeout=300)
        cls.addClassCleanup(cls.page.close)
        cls.page.open(f"{page}#still")

    def drawn(self, subject):
        self.page.evaluate(f"view.canvas.width = view.canvas.height = {SIZE}")
        address = self.page.evaluate(f"view.draw('{subject}').then(() => view.canvas.toDataURL('image/png'))")
        return self.kept(f"{subject}_web", base64.b64decode(address.split(",")[1]))

    def rendered(self, subject, *arguments):
        picture = self.folder / "vulkan.png"
        subprocess.run([PROGRAM, "render", *map(str, arguments), "--picture", "half", "--size", str(SIZE), "--samples", "1", "-o", picture], check=True, capture_output=True)
        return self.kept(f"{subject}_vulkan", picture.read_bytes())

    def kept(self, name, data):
        if KEEP:
            pathlib.Path(KEEP, f"{name}.png").write_bytes(data)
        return png(data)

    def expect_alike(self, subject, arguments, most_apart, most_off):
        (size, ours), (expected, theirs) = self.drawn(subject), self.rendered(subject, *arguments)
        self.assertEqual(size, expected)
        distance, off = apart(ours, theirs)
        print(f"{subject}: relative L2 {distance:.4f}, {off:.2%} of the pixels more than {STEPS} of 255 off", flush=True)
        self.assertLess(distance, most_apart)
        self.assertLess(off, most_off)
        self.assertEqual(self.page.problems, [], "no error, no request")

    # The outline is a pixel of background or of skin; normal maps and colours are filtered by another rasteriser.
    def test_the_head_is_vulkans(self):
        if "head" not in self.page.evaluate("view.subjects"):
            self.skipTest("the default head was not made (./bootstrap demo makes it)")
        self.expect_alike("head", ["Separable", "-t", "Separable11", "-w", "human"], 0.025, 0.01)

    # Where 32 layers end against each other a pixel more or less shows: a strand's tip is one.
    def test_the_fur_is_vulkans(self):
        arguments = ["Fur", "-w", "bunny", "--mesh", self.folder / "ball.glb", "--set", f"gFurCubeMap={self.folder / 'fur' / 'fur_cube.dds'}"]
        self.expect_alike("ball", arguments, 0.04, 0.045)

    def test_arguments_that_do_not_exist_are_named(self):
        self.assertIn("no technique Nothing", self.page.evaluate("view.draw('ball', 'Nothing').catch(error => error.message)"))


if __name__ == "__main__":
    if not browser.program():
        print("skipped: Chromium is not installed; ./bootstrap test brings it")
        sys.exit(77)
    result = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped and result.testsRun == 0 else 0)
