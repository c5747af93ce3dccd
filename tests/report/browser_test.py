#!/usr/bin/env python3
"""Reports in a headless Chromium: browser_test.py TEGUMENT SAMPLE SOURCE [FOLDER FOR PICTURES].

Each page opens without an error or a request, passes axe-core in light and dark, and works by keyboard. Exit code 77: no browser, or no axe-core.
"""

import io
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import browser

try:
    from PIL import Image, ImageChops
except ImportError:
    Image = None

TEGUMENT, SAMPLE, SOURCE = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
PICTURES = pathlib.Path(sys.argv[4]) if len(sys.argv) > 4 else None
CACHE = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tegument")
CUBE = "".join(f"v {x} {y} {z}\n" for x in (0, 1) for y in (0, 1) for z in (0, 1)) + "".join(
    f"f {face}\n" for face in ("1 2 4 3", "5 7 8 6", "1 5 6 2", "3 4 8 7", "1 3 7 5", "2 6 8 4"))
BROKEN = """float4 vertex() : SV_Position { return 0; }
float4 pixel() : SV_Target { return missing; }
technique11 T { pass P { SetVertexShader(CompileShader(vs_5_0, vertex())); SetPixelShader(CompileShader(ps_5_0, pixel())); } }
"""


def axe():
    """The script of axe-core; none where ./bootstrap test has not fetched it."""
    found = CACHE / "tools" / "axe" / "axe.min.js"
    return found.read_text(encoding="utf-8") if found.exists() else None


def run(*arguments, codes=(0,)):
    done = subprocess.run([TEGUMENT, *map(str, arguments)], cwd=SOURCE, capture_output=True, text=True, timeout=560, check=False)
    if done.returncode not in codes:
        raise AssertionError(f"tegument {arguments}: exit code {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done


class Report(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory(prefix="tegument-report-")
        cls.folder = pathlib.Path(cls.scratch.name)
        cls.sample = cls.folder / "sample.html"
        subprocess.run([SAMPLE, cls.sample], check=True)
        cls.page = browser.Browser()

    @classmethod
    def tearDownClass(cls):
        cls.page.close()
        cls.scratch.cleanup()

    def open(self, path):
        self.page.problems.clear()
        self.page.size(1400, 1000)
        self.page.colours("light")
        self.page.open(path)

    def keep(self, name):
        if PICTURES:
            self.page.screenshot(PICTURES / f"{name}.png", whole=True)

    def count(self, selector):
        return self.page.evaluate(f"document.querySelectorAll({json.dumps(selector)}).length")

    def text(self, selector):
        return self.page.evaluate(f"document.querySelector({json.dumps(selector)}).textContent")

    def focus(self, selector):
        self.page.evaluate(f"document.querySelector({json.dumps(selector)}).focus()")

    def expect_accessible(self, name):
        """axe-core finds nothing, in both schemes and on a narrow screen."""
        script = axe()
        for scheme, width in (("light", 1400), ("dark", 1400), ("light", 420)):
            self.page.colours(scheme)
            self.page.size(width, 1000)
            self.keep(f"{name}-{scheme}-{width}")
            self.page.evaluate(script + ";0")
            found = self.page.evaluate("axe.run().then(r => r.violations.map(v => v.id + ': ' + v.nodes.map(n => n.target.join(' ') + ' ' + n.failureSummary).join('; ')))")
            self.assertEqual(found, [], f"{name}, {scheme}, {width} pixels wide")
        self.assertEqual(self.page.problems, [])

    def test_axe_core_would_find_an_image_without_a_name(self):
        self.open(self.sample)
        self.page.evaluate("document.querySelector('main').append(document.createElement('img'))")
        self.page.evaluate(axe() + ";0")
        self.assertIn("image-alt", self.page.evaluate("axe.run().then(r => r.violations.map(v => v.id))"))

    def test_every_kind_of_section_is_drawn_and_accessible(self):
        self.open(self.sample)
        self.page.wait("document.body.dataset.opened === 'ball'")
        self.assertEqual(self.count("section"), 6)
        self.assertEqual(self.text("#section-5 p:nth-of-type(2)"), "Two </script> & <i>three</i>.")
        self.expect_accessible("sample")

    def test_a_table_is_sorted_and_filtered_by_keyboard(self):
        self.open(self.sample)
        names = "[...document.querySelectorAll('#section-4 tbody tr')].map(r => r.cells[1].textContent)"
        self.assertEqual(len(self.page.evaluate(names)), 12)
        self.focus("#section-4 th:nth-child(3) button")
        self.page.press("Enter")
        self.assertEqual(self.page.evaluate(names)[:2], ["row 0", "row 1"])
        self.assertEqual(self.page.evaluate(names)[-1], "row 3", "what has no value comes last")
        self.page.press("Enter")
        self.assertEqual(self.page.evaluate("document.querySelector('#section-4 th:nth-child(3)').getAttribute('aria-sort')"), "descending")
        self.assertEqual(self.page.evaluate(names)[1:3], ["row 11", "row 10"])
        self.focus("#section-4 input")
        self.page.type("row 11")
        self.assertEqual(self.page.evaluate(names), ["row 11"])
        self.assertEqual(self.text("#section-4 [role=status]"), "1 of 12 rows")
        self.assertEqual(self.text("#section-0 tbody td:last-child"), "100")

    def test_the_slider_goes_from_picture_to_reference_to_difference(self):
        self.open(self.sample)
        self.page.wait("document.body.dataset.opened === 'ball'")
        centre = "[...document.querySelector('.stage canvas').getContext('2d').getImageData({},20,1,1).data].slice(0,3)"
        shown = []
        for key in "123":
            self.focus(".stage")
            self.page.press(f"Digit{key}", key)
            shown.append(self.page.evaluate(centre.format(30)))
        picture, reference, difference = shown
        self.assertGreater(sum(picture), sum(reference), "the one pixel that is too bright")
        for value, expected in zip(difference, (245, 149, 61)):  # log10(.02) is .717 of the way from -6 to 0, 3.58 of the ramp's five steps
            self.assertAlmostEqual(value, expected, delta=3, msg=str(difference))
        # Half way: the difference to the left of the border, the reference to its right.
        self.page.evaluate("(s => { s.value = 1.5; s.dispatchEvent(new Event('input')); })(document.querySelector('.wipe input'))")
        self.assertEqual(self.page.evaluate(centre.format(30)), reference)
        self.focus(".wipe input")
        for _ in range(60):
            self.page.press("ArrowRight")
        self.assertEqual(self.page.evaluate(centre.format(30)), difference)

    def seen(self, whole=False):
        """What a person sees, as a picture."""
        return Image.open(io.BytesIO(self.page.screenshot(whole=whole))).convert("RGB")

    def test_the_page_looks_the_same_whenever_it_is_opened(self):
        pictures = []
        for changed in ("", "", "document.querySelector('#section-2').style.visibility = 'hidden'"):
            self.open(self.sample)
            self.page.wait("document.body.dataset.opened === 'ball'")
            self.page.evaluate(f"{changed or '0'};0")
            self.assertLessEqual(self.page.evaluate("document.documentElement.scrollWidth"), 1400, "nothing is beside the page")
            pictures.append(self.seen(whole=True))
        first, again, without = pictures
        self.assertIsNone(ImageChops.difference(first, again).getbbox(), "not one pixel is another one")
        self.assertGreater(sum(ImageChops.difference(first, without).convert("L").histogram()[8:]), 5000, "a section that is not there would be seen")

    def test_the_screen_shows_the_picture_the_reference_and_the_difference(self):
        self.open(self.sample)
        self.page.wait("document.body.dataset.opened === 'ball'")
        self.page.evaluate("document.querySelector('.stage').scrollIntoView({block: 'center', behavior: 'instant'})")
        stage, canvas = "document.querySelector('.stage')", "document.querySelector('.stage canvas')"
        box = self.page.evaluate(f"(b => [b.x, b.y, b.width, b.height])({stage}.getBoundingClientRect())")
        for key in "123":
            self.focus(".stage")
            self.page.press(f"Digit{key}", key)
            data = self.page.evaluate(f"[...{canvas}.getContext('2d').getImageData(0, 0, 48, 48).data]")
            screen = self.seen()
            wrong = 0
            for x, y in ((x, y) for x in range(48) for y in range(48)):
                shown = screen.getpixel((int(box[0] + box[2] * (x + 0.5) / 48), int(box[1] + box[3] * (y + 0.5) / 48)))
                wrong += max(abs(a - b) for a, b in zip(shown, data[4 * (48 * y + x):])) > 2
            # Frames and the mark of the worst pixel may lie on some.
            self.assertLess(wrong, 48 * 48 // 20, f"pixels of the screen that are not the canvas's, key {key}")

    def test_the_probe_tells_the_values_of_a_pixel(self):
        self.open(self.sample)
        self.page.wait("document.body.dataset.opened === 'ball'")
        values = "[...document.querySelectorAll('.values tbody tr')].map(r => [...r.cells].slice(1).map(c => Number(c.textContent.replace('−', '-'))))"
        self.assertIn("pixel 30, 20", self.text(".place"), "it begins at the worst pixel")
        red = self.page.evaluate(values)[0]
        light = 0.9 * (1 - ((30 - 23.5) ** 2 + (20 - 23.5) ** 2) / 23**2) ** 0.5
        self.assertAlmostEqual(red[1], light, delta=light * 2**-11 + 5e-5, msg="halves keep 11 bits, the page shows four digits")
        self.assertAlmostEqual(red[2], 0.02, delta=0.0001)
        self.focus(".stage")
        self.page.press("ArrowRight")
        self.page.press("ArrowDown", shift=True)
        self.assertIn("pixel 31, 30", self.text(".place"))
        self.assertIn("pixel 31, 30: red", self.text("[aria-live=polite]"), "it is said aloud, too")
        box = self.page.evaluate("(b => [b.x, b.y, b.width, b.height])(document.querySelector('.stage').getBoundingClientRect())")
        self.page.evaluate("document.querySelector('.stage').scrollIntoView({block: 'center', behavior: 'instant'})")
        box = self.page.evaluate("(b => [b.x, b.y, b.width, b.height])(document.querySelector('.stage').getBoundingClientRect())")
        self.page.move(box[0] + box[2] * 10.5 / 48, box[1] + box[3] * 24.5 / 48)
        self.assertIn("pixel 10, 24", self.text(".place"), "under the pointer")
        self.page.press("KeyW", "w")
        self.assertIn("pixel 30, 20", self.text(".place"))

    def test_points_are_walked_filtered_and_named(self):
        self.open(self.sample)
        self.assertEqual(self.count(".point"), 4, "of one scene at a time")
        self.assertEqual(self.page.evaluate("[...document.querySelectorAll('.chart text.name:not(.other)')].map(t => t.textContent)"), ["Quick", "Middle", "Slow"])
        self.focus(".point")
        self.page.press("ArrowRight")
        self.assertIn("Middle, milliseconds: 2, relative L2: 0.05", self.page.evaluate("document.activeElement.getAttribute('aria-label')"))
        self.assertEqual(self.text(".tip strong"), "Middle")
        self.page.press("Escape")
        self.assertTrue(self.page.evaluate("document.querySelector('.tip').hidden"))
        self.focus("#section-2 input[type=search]")
        self.page.type("slow")
        self.assertEqual(self.count(".point"), 3, "by name or group")
        self.page.evaluate("document.querySelector('.legend input').click()")
        self.assertEqual(self.count(".point"), 3, "the other group is not among them")

    def test_a_row_of_passes_opens_by_keyboard(self):
        self.open(self.sample)
        self.focus(".timeline button")
        self.page.press("Enter")
        self.assertIn("Blur: 1.5 ms, 75 %", self.text(".timeline ol"))
        self.assertEqual(self.page.evaluate("document.activeElement.getAttribute('aria-expanded')"), "true")

    def test_tab_reaches_every_control_in_the_order_of_the_page(self):
        self.open(self.sample)
        seen, places = set(), []
        for _ in range(80):
            self.page.press("Tab")
            found = self.page.evaluate("(e => e === document.body ? null : [e.tagName + (e.id || e.className.baseVal || e.className), e.closest('section')?.id ?? ''])(document.activeElement)")
            if not found:
                break
            seen.add(found[0])
            places.append(found[1])
        sections = [place for place in places if place]
        self.assertEqual(sections, sorted(sections), "from section to section")
        self.assertEqual(len(set(sections)), 5, "all but the notes have a control")
        self.assertIn("DIVstage", seen)
        self.assertIn("gpoint", seen)

    def test_the_colours_can_be_chosen(self):
        self.open(self.sample)
        ground = "getComputedStyle(document.body).backgroundColor"
        light = self.page.evaluate(ground)
        self.focus("header button")
        for _ in range(2):
            self.page.press("Enter")
        self.assertNotEqual(self.page.evaluate(ground), light)
        self.page.evaluate("localStorage.clear()")

    def test_the_page_of_check(self):
        effect = self.folder / "broken.fx"
        effect.write_text(BROKEN)
        page, before = self.folder / "check.html", self.folder / "before.json"
        before.write_text(run("check", "effects/Beckmann.fx", "--target", "spirv-glslang", "--json").stdout)
        run("check", "effects/Beckmann.fx", effect, "--target", "spirv-glslang", "--html", page, "--against", before, codes=(1,))
        self.open(page)
        self.assertIn("1 passed, 1 failed", self.text(".summary"))
        self.assertIn("missing", self.text("#section-2"), "the diagnostic of the broken effect")
        self.assertIn("docs/diagnostics.md", self.text("#section-2 .note"))
        self.expect_accessible("check")

    def test_the_page_of_prep_and_what_got_worse(self):
        mesh, page, before = self.folder / "cube.obj", self.folder / "prep.html", self.folder / "prep.json"
        mesh.write_text(CUBE)
        done = json.loads(run("prep", mesh, "--dry-run", "--json", "--html", page).stdout)
        self.open(page)
        self.assertIn("12 triangles", self.text(".summary"))
        self.expect_accessible("prep")
        done["bytes"]["after"] /= 2
        before.write_text(json.dumps(done))
        told = run("prep", mesh, "--dry-run", "--html", page, "--against", before, "--threshold", "30")
        self.assertIn(f"worse: {mesh}: bytes", told.stderr)
        self.open(page)
        self.assertIn("worse", self.text("#section-0"))

    def test_a_file_that_is_no_run_is_refused_before_the_work(self):
        other = self.folder / "other.json"
        for text in ("", "{", "[]", '{"rows": 7}', '[{"module": 7}]', '{"files": {"targets": 3}}'):
            other.write_text(text)
            for command in (["check", "effects/Beckmann.fx"], ["prep", "effects/Main.fx", "--dry-run"]):
                self.assertIn("TG8091", run(*command, "--against", other, codes=(1,)).stderr, text)
        self.assertIn("TG8024", run("check", "effects/Beckmann.fx", "--html", self.folder / "page.png", codes=(2,)).stderr)

    def test_the_page_of_verify(self):
        page = self.folder / "verify.html"
        run("verify", "Beckmann", "--map-size", "32", "--size", "32", "-o", self.folder / "verify", "--html", page)
        self.open(page)
        self.page.wait("document.body.dataset.opened")
        self.assertIn("1 of 1", self.text(".summary"))
        self.expect_accessible("verify")

    def test_the_page_of_bench(self):
        page = self.folder / "bench.html"
        run("bench", "--scene", "sphere-10", "-t", "Lambert", "-t", "Separable7", "--setting", "corrected", "--size", "48x48", "--map-size", "64", "--frames", "2", "--reference", "full",
            "--keep-scenes", self.folder / "scenes", "--html", page)
        self.open(page)
        self.page.wait("document.body.dataset.opened")
        self.assertEqual(self.count(".point"), 2)
        self.assertEqual(self.count(".subjects label"), 2, "every pixel has its truth: the pictures are shown")
        self.expect_accessible("bench")


if __name__ == "__main__":
    missing = [what for what, there in (("Chromium", browser.program()), ("axe-core", axe()), ("Pillow", Image)) if not there]
    if missing:
        print(f"skipped: {' and '.join(missing)} missing; ./bootstrap test brings it")
        sys.exit(77)
    if PICTURES:
        PICTURES.mkdir(parents=True, exist_ok=True)
    unittest.main(argv=sys.argv[:1], verbosity=2)
