"""The page of docs/samples/web in a headless Chromium (WebGL 2 by SwiftShader), its pictures held against Vulkan's: page_test.py TEGUMENT ROOT."""

import base64
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(ROOT / "tests" / "report"))
import browser  # noqa: E402
import pictures  # noqa: E402

SIZE = 256


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
        return pictures.kept(f"{subject}_web", base64.b64decode(address.split(",")[1]))

    def rendered(self, subject, *arguments):
        picture = self.folder / "vulkan.png"
        subprocess.run([PROGRAM, "render", *map(str, arguments), "--picture", "half", "--size", str(SIZE), "--samples", "1", "-o", picture], check=True, capture_output=True)
        return pictures.kept(f"{subject}_vulkan", picture.read_bytes())

    def expect_alike(self, subject, arguments, most_apart, most_off):
        pictures.expect_alike(self, subject, self.drawn(subject), self.rendered(subject, *arguments), most_apart, most_off)
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

    def test_a_head_of_ones_own_is_vulkans(self):
        # The ball as a head of its own: one chart, no maps, so that only outline and shadow border may differ.
        mesh = self.folder / "own.glb"
        subprocess.run([PROGRAM, "prep", self.folder / "ball.obj", "-o", mesh, "--unit-mm", "1", "--unwrap"], check=True, capture_output=True)
        page = self.folder / "own.html"
        command = [sys.executable, ROOT / "docs" / "samples" / "web" / "make.py", page, "--program", PROGRAM, "--ball", self.folder, "--mesh"]
        subprocess.run([*command, mesh], check=True, capture_output=True)
        self.page.open(f"{page}#still")
        try:
            self.expect_alike("head", ["Separable", "-t", "Separable11", "-w", "human", "--mesh", mesh, "--no-head"], 0.025, 0.01)
        finally:
            self.page.open(f"{self.folder / 'page.html'}#still")
        refused = subprocess.run([*command, self.folder / "ball.glb"], capture_output=True, text=True)
        self.assertIn("--unwrap", refused.stderr)
        self.assertEqual(refused.returncode, 1)

    def played(self, script, pass_script="Draw=Geometry"):
        """What docs/scripts.md says of targets and clears, as effect.js plays it; or its error."""
        technique = {"annotations": {"Script": script}, "passes": [{"name": "A", "annotations": {"Script": pass_script}}]}
        return self.page.evaluate("""(() => {
            const lines = []; let bound;
            const engine = { setTargets: (colors, depth) => (bound = colors.map(name => name || "app").join() + "/" + (depth || "app")),
                clear: (what, place, value) => lines.push(`${what} ${place ?? "all"} ${value} of ${bound}`),
                draw: (pass, quad) => lines.push(`${quad ? "quad" : "mesh"} to ${bound}`), setNumber: (name, number) => lines.push(`${name}=${number}`),
                value: name => ({ numbers: [name === "gMany" ? 65536 : 2], bool: false }) };
            try { view.play(%s, engine); } catch (error) { lines.push(error.message); }
            return lines.join("; ");
        })()""" % json.dumps(technique))

    def test_scripts_do_what_their_specification_says(self):
        self.assertEqual(self.played("RenderColorTarget=gX; RenderDepthStencilTarget=gZ; Pass=a; Pass=A",
                                     "RenderColorTarget0=gY; Draw=Buffer; RenderColorTarget=; RenderDepthStencilTarget=; Draw=Geometry"),
                         "; ".join(["quad to gY/gZ", "mesh to gX/gZ"] * 2))
        self.assertEqual(self.played("ClearSetColor=gRed; Clear=Color; Clear=Color3; Clear=Depth; Hint=x"), "color all 2,0,0,0 of app/app; color 3 2,0,0,0 of app/app; depth all 1 of app/app")
        self.assertEqual(self.played("LoopByCount=gN; LoopGetIndex=gI; LoopEnd"), "gI=0; gI=1")

    def test_scripts_that_do_not_end_or_make_no_sense_are_refused(self):
        for script, error in (("LoopByCount=gMany; LoopByCount=gMany; LoopEnd; LoopEnd", "the script does not end"), ("LoopByCount=gN" + ";LoopByCount=gN" * 99, "too many loops in loops"),
                              ("LoopEnd", "LoopEnd without a loop"), ("LoopByCount=gN", "a loop has no end"), ("Draw=Buffer", "no command draw"), ("Clear=Colour", "no clear of Colour")):
            self.assertEqual(self.played(script), error)
        self.assertEqual(self.played("Pass=A", "Pass=A"), "no command pass")
        self.assertEqual(self.played("Pass=A", "Draw=Scene"), "no drawing of Scene")

    def test_what_is_chosen_last_is_shown_whatever_is_loaded_first(self):
        if "head" not in self.page.evaluate("view.subjects"):
            self.skipTest("the default head was not made (./bootstrap demo makes it)")
        self.page.open(f"{self.folder / 'page.html'}?anew#still")  # the same address would leave the document, and what it has decoded
        self.page.evaluate("""(async () => {
            const wait = milliseconds => new Promise(resolve => setTimeout(resolve, milliseconds)), decode = createImageBitmap;
            let decoded = 0;
            window.createImageBitmap = async (...image) => (await wait(3000), ++decoded, decode(...image)); // the head comes last
            const list = document.querySelector("select"), choose = name => { list.value = name; list.onchange(); };
            choose("head"); await wait(100); choose("ball");
            while (decoded < 2) await wait(100);
            await wait(3000);
        })()""")
        shown = self.page.evaluate("view.canvas.toDataURL('image/png')")
        self.page.evaluate("view.draw('ball')")
        self.assertEqual(shown, self.page.evaluate("view.canvas.toDataURL('image/png')"))

    def test_arguments_that_do_not_exist_are_named(self):
        self.assertIn("no technique Nothing", self.page.evaluate("view.draw('ball', 'Nothing').catch(error => error.message)"))


if __name__ == "__main__":
    if not browser.program():
        print("skipped: Chromium is not installed; ./bootstrap test brings it")
        sys.exit(77)
    result = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped and result.testsRun == 0 else 0)
