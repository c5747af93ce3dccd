#!/usr/bin/env python3
"""Runs the demo of bootstrap with small pictures, and looks at each of them. usage: demo_test.py PROGRAM REPOSITORY

Each judge also sees a scene that is broken on purpose, and must refuse it. $TEGUMENT_TEST_PICTURES: a folder that keeps the pictures."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy
    from PIL import Image
except ImportError as error:
    print(f"skipped: {error}: python3-pil and python3-matplotlib (Debian) are not installed")
    sys.exit(77)

REPOSITORY = pathlib.Path(sys.argv.pop()).resolve()
PROGRAM = pathlib.Path(sys.argv.pop()).resolve()
SIZE = 256
MISSING = 4  # exit code of the demo where the default head was not made

# The demo as it stands, but for what it installs and builds.
DEMO = f"""source ./bootstrap
build() {{ :; }}
install_human() {{ [ -f "$cache/human/human.glb" ] || exit {MISSING}; }}
install_packages() {{ [ -z "$(missing_packages "${{@:2}}")" ]; }}
main demo
"""
WRAPPER = f"""#!/bin/sh
if [ "$1" = render ]; then exec "{PROGRAM}" "$@" --size {SIZE}; fi
exec "{PROGRAM}" "$@"
"""


def read(path):
    return numpy.asarray(Image.open(path).convert("RGB"), float)


def subject(picture):
    """Pixels that are not of the colour in the corner."""
    return numpy.abs(picture - picture[2, 2]).max(axis=2) > 8


def boxed(picture, left, right, top, bottom):
    """Sides in shares of the picture."""
    height, width = picture.shape[:2]
    return picture[int(top * height) : int(bottom * height), int(left * width) : int(right * width)]


def red_of_dark_skin(picture):
    """Share of pixels that are clearly red where light ends on the head."""
    level = picture.mean(axis=2)
    dim = (numpy.abs(picture - picture[2, 2]).max(axis=2) > 6) & (level > 8) & (level < 20)
    return (picture[..., 0] > 1.8 * picture[..., 1])[dim].mean() if dim.any() else 0


def is_a_head(picture):
    lit = subject(picture) & (picture[..., 0] > 1.1 * picture[..., 2]) & (picture[..., 0] > 40)
    return 0.08 < lit.mean() < 0.9


def has_scattered_light(picture):
    return is_a_head(picture) and red_of_dark_skin(picture) > 0.4


def has_no_scattered_light(picture):
    return is_a_head(picture) and red_of_dark_skin(picture) < 0.1


def is_lit_from_everywhere(picture):
    return is_a_head(picture) and (picture.max(axis=2) < 12).mean() < 0.001


def has_hair(picture):
    scalp = boxed(picture, 0.18, 0.80, 0.02, 0.33)
    level = scalp.mean(axis=2)
    dark = (numpy.abs(scalp - picture[2, 2]).max(axis=2) > 8) & (level > 6) & (level < 60)  # bare skin in shadow is black
    return is_a_head(picture) and dark.mean() >= 0.35


def has_a_glowing_ear(picture):
    ear = boxed(picture, 0.57, 0.71, 0.40, 0.78)
    lit = (numpy.abs(ear - picture[2, 2]).max(axis=2) > 8) & (ear.max(axis=2) > 20)
    return lit.mean() > 0.1 and ear[..., 0][lit].sum() >= 2 * ear[..., 1][lit].sum()


def has_fur_beyond(bald):
    outline = subject(bald)
    return lambda picture: (subject(picture) & ~outline).sum() >= 0.05 * outline.sum()


def shows_beside_each_other(left, right):
    def judge(picture):
        return (picture[:SIZE, :SIZE] == left).all() and (picture[:SIZE, -SIZE:] == right).all()

    return judge


class Demo(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        scratch = tempfile.TemporaryDirectory()
        cls.addClassCleanup(scratch.cleanup)
        cls.tree = pathlib.Path(scratch.name)
        for entry in ("effects", "hlsl", "meshprep"):
            (cls.tree / entry).symlink_to(REPOSITORY / entry)
        shutil.copy(REPOSITORY / "bootstrap", cls.tree)
        (cls.tree / "build" / "release").mkdir(parents=True)
        wrapper = cls.tree / "build" / "release" / "tegument"
        wrapper.write_text(WRAPPER, encoding="utf-8")
        wrapper.chmod(0o755)
        (cls.tree / "out").mkdir()
        done = cls.run_demo()
        if done.returncode == MISSING:
            raise unittest.SkipTest("the default head was not made (./bootstrap demo makes it)")
        if done.returncode != 0:
            raise AssertionError(f"the demo ended with {done.returncode}\n{done.stdout}")
        cls.said = done.stdout
        cls.pictures = {path.stem: read(path) for path in (cls.tree / "out").glob("*.png")}
        if keep := os.environ.get("TEGUMENT_TEST_PICTURES"):
            shutil.copytree(cls.tree / "out", keep, dirs_exist_ok=True)

    @classmethod
    def run_demo(cls):
        return subprocess.run(["bash", "-c", DEMO], cwd=cls.tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)

    def drawn(self, name, *arguments):
        picture = self.tree / f"{name}.png"
        done = subprocess.run([PROGRAM, *arguments, "-o", picture], cwd=self.tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        return read(picture)

    def broken(self, name, effect, *arguments):
        return self.drawn(name, "render", f"effects/{effect}.fx", "--size", str(SIZE), *arguments)

    def expect(self, judge, good, bad):
        self.assertIn(good, self.pictures, "the demo has not drawn it")
        self.assertTrue(judge(self.pictures[good]), f"{good}.png does not show what it is named for")
        self.assertFalse(judge(bad), f"the judge of {good}.png takes a broken scene for it")

    def test_each_picture_that_it_names_is_there(self):
        named = {word.rstrip(",.:").removeprefix("out/").removesuffix(".png") for word in self.said.split() if word.startswith("out/") and "=" not in word}
        self.assertGreater(len(named), 5)
        self.assertLessEqual(named - ({"bunny"} if "no furry Bunny" in self.said else set()), set(self.pictures))

    def test_light_scatters_in_the_skin(self):
        self.expect(has_scattered_light, "human", self.pictures["human_lambert"])

    def test_light_does_not_scatter_without(self):
        self.expect(has_no_scattered_light, "human_lambert", self.pictures["human"])

    def test_both_stand_beside_each_other(self):
        swapped = self.drawn("swapped", "sheet", "out/human_lambert.png", "out/human.png", "--columns", "2")
        self.expect(shows_beside_each_other(self.pictures["human"], self.pictures["human_lambert"]), "human_beside_lambert", swapped)

    def test_nothing_is_black_in_the_studio(self):
        self.expect(is_lit_from_everywhere, "human_studio", self.pictures["human"])

    def test_hair_covers_the_scalp(self):
        bald = self.broken("bald", "Pyramid", "--technique", "PyramidLinked", "--workspace", "effects/workspaces/human_hair.json")
        self.expect(has_hair, "human_hair", bald)

    def test_an_ear_glows(self):
        self.expect(has_a_glowing_ear, "human_backlit", self.broken("dull", "Main", "--technique", "Lambert", "--workspace", "effects/workspaces/human_backlit.json"))

    def test_fur_stands_beyond_the_mesh(self):
        if "no furry Bunny" in self.said:
            self.skipTest("glmark2-data (Debian) is not installed")
        bald = self.broken("shorn", "FurCoat", "--set", "gFurLength=0.0001")
        self.expect(has_fur_beyond(bald), "bunny", bald)

    def test_every_view_shows_a_head(self):
        nothing = numpy.zeros((SIZE, SIZE, 3)) + (20, 20, 22)
        views = {path.stem for path in (REPOSITORY / "effects" / "workspaces").glob("human_*.json")} - {"human_hair", "human_backlit"}
        self.assertGreater(len(views), 4)
        for view in views:
            self.expect(is_a_head, view, nothing)

    def test_a_step_is_skipped_after_itself_alone(self):
        hair = self.tree / "out" / "human_hair.png"
        shutil.copy(self.tree / "out" / "human.png", hair)
        done = self.run_demo()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertIn("out/human.png is there", done.stdout)
        self.assertNotIn("out/human_hair.png is there", done.stdout)
        self.assertTrue(has_hair(read(hair)), "another's picture stands in its place")
        again = self.run_demo().stdout
        self.assertIn("out/human_hair.png is there", again)

    def test_two_steps_never_write_one_picture(self):
        script = "source ./bootstrap\nstep() { touch \"$1\"; }\nmkdir -p build/demo\ndraw out/twice.png one\ndraw out/twice.png other\n"
        done = subprocess.run(["bash", "-c", script], cwd=self.tree, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("two steps of the demo write out/twice.png", done.stdout)


if __name__ == "__main__":
    program = unittest.main(argv=sys.argv[:1], exit=False, verbosity=2)
    if not program.result.wasSuccessful():
        sys.exit(1)
    if not program.result.testsRun:
        print(f"skipped: {program.result.skipped[0][1]}")
        sys.exit(77)
