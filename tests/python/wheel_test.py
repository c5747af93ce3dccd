#!/usr/bin/env python3
"""The installed Python module, as a user has it: ./bootstrap wheel runs this in an environment of its own."""

import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest
import warnings

import numpy as np

import tegument

EFFECT = """float4 gTint = { 0.25, 0.5, 2, 1 };
void VS(float4 p : POSITION, out float4 o : SV_Position) { o = p; }
float4 PS() : SV_Target0 { return gTint; }
#ifndef FX_ENTRY
RasterizerState Both { CullMode = NONE; };
DepthStencilState Off { DepthEnable = FALSE; };
technique11 Fill { pass P < string Script = "Draw=Buffer;"; > {
    SetVertexShader(CompileShader(vs_4_0, VS())); SetPixelShader(CompileShader(ps_4_0, PS()));
    SetRasterizerState(Both); SetDepthStencilState(Off, 0); } }
#endif
"""


class Wheel(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.effect = self.folder / "fill.fx"
        self.effect.write_text(EFFECT, encoding="utf-8")

    def test_pictures_are_the_effect_s_values(self):
        scene = tegument.Scene(self.effect)
        picture = scene.render(7, 3)
        self.assertEqual((picture.shape, picture.dtype), ((3, 7, 4), np.float32))
        np.testing.assert_array_equal(picture, np.broadcast_to(np.float32([0.25, 0.5, 2, 1]), (3, 7, 4)))
        scene.set(gTint=(1, 0, 0.5, 1))
        np.testing.assert_array_equal(scene.render(2, 2)[0, 0], np.float32([1, 0, 0.5, 1]))
        self.assertEqual(list(scene.times), ["P"])
        np.testing.assert_array_equal(picture[0, 0], np.float32([0.25, 0.5, 2, 1]), "a picture outlives the next")

    def test_values_are_checked_as_on_the_command_line(self):
        scene = tegument.Scene(self.effect)
        for wrong, code in (({"gTimt": 1}, "TG8012"), ({"gTint": 1}, "TG8013"), ({"gTint": (1, 2, 3, float("nan"))}, "TG8013")):
            with self.assertRaises(tegument.Error) as caught:
                scene.set(**wrong)
            self.assertEqual((caught.exception.codes, caught.exception.blame), ([code], 2), wrong)
        with self.assertRaises(tegument.Error) as caught:
            tegument.Scene("Pyramit")
        self.assertEqual(caught.exception.codes, ["TG8006"])
        self.assertIn("Pyramid", str(caught.exception))
        with self.assertRaises(tegument.Error):
            scene.render(0, 4)
        with self.assertRaises(tegument.Error):
            scene.target("gNothing")

    def test_two_threads_take_turns(self):
        scene = tegument.Scene(self.effect)
        pictures = []
        threads = [threading.Thread(target=lambda: pictures.extend(scene.render(64, 64) for _ in range(8))) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(pictures), 16)
        self.assertTrue(all((picture == pictures[0]).all() for picture in pictures))

    def test_commands_return_what_they_print_as_json(self):
        self.assertEqual(tegument.info(self.effect)["techniques"][0]["name"], "Fill")
        good = tegument.check(self.effect, target="spirv-glslang")
        self.effect.write_text(EFFECT.replace("return gTint", "return gTimt"), encoding="utf-8")
        bad = tegument.check(self.effect, target="spirv-glslang")
        self.assertNotEqual(good, bad, "an error in an effect is a report, not an exception")
        with self.assertRaises(tegument.Error) as caught:
            tegument.check(self.folder / "none.fx")
        self.assertEqual(caught.exception.codes, ["TG8006"])

    def test_meshes_are_prepared_and_drawn(self):
        source = self.folder / "patch.obj"
        corners = [(x, y) for y in range(9) for x in range(9)]
        source.write_text("".join(f"v {x} {y} {(x - 4) ** 2 / 8}\nvt {x / 8} {y / 8}\n" for x, y in corners) +
                          "".join(f"f {i}/{i} {i + 1}/{i + 1} {i + 10}/{i + 10} {i + 9}/{i + 9}\n" for i in range(1, 72) if i % 9), encoding="utf-8")
        made = self.folder / "patch.glb"
        tegument.prep(source, output=made, unit_mm=10, levels=1)
        self.assertTrue(made.exists())
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of a mesh without a colour map
            picture = tegument.Scene("Main", technique="Lambert", mesh=made).render(64, 64)
        self.assertGreater(float(picture[..., :3].max()), 0.05)

    def test_warnings_are_python_s(self):
        with self.assertWarns(UserWarning):
            tegument.Scene("Main", technique="Lambert", mesh=self.plain_mesh()).render(16, 16)

    def plain_mesh(self):
        path = self.folder / "plain.obj"
        path.write_text("v 0 0 0\nv 90 0 0\nv 0 90 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n", encoding="utf-8")
        return path

    def test_unit_tests_of_shaders_run(self):
        tests, references = self.folder / "my.test.hlsl", self.folder / "refs.py"
        tests.write_text("TG_TEST(sum) { float x = tgCases(1, 1.5); float y = tgReference(\"times\", x); tgEqual(x + x, y); }\n", encoding="utf-8")
        for value, code in ((2, 0), (3, 1)):
            references.write_text("import numpy\ndef times(x):\n    return numpy.float64(x) * %d\n" % value, encoding="utf-8")
            ran = subprocess.run([sys.executable, "-m", "tegument", "test", tests, "--reference", references], capture_output=True, text=True,
                                 check=False)
            self.assertEqual(ran.returncode, code, ran.stdout + ran.stderr)

    def test_the_lines_of_its_page_run(self):
        page = (pathlib.Path(__file__).resolve().parents[2] / "tools/python/README.md").read_text(encoding="utf-8")
        names = {}
        try:
            exec(compile(page.split("```python\n")[1].split("```")[0], "README.md", "exec"), names)
        except tegument.Error as error:
            if "TG8025" not in error.codes:
                raise
            self.skipTest(str(error))
        self.assertEqual((names["picture"].shape, names["shown"].dtype), ((512, 512, 4), np.uint8))
        self.assertGreater(names["picture"][..., :3].max(), 0.2)
        self.assertGreater(np.abs(names["again"] - names["picture"]).max(), 0.01)
        self.assertGreater(names["entering"].max(), 0)

    def test_bytes_to_look_at(self):
        shown = tegument.to_srgb(np.float32([[[0, 0.18, 1e9, 1]]]))
        self.assertEqual((shown.shape, shown.dtype), ((1, 1, 3), np.uint8))
        self.assertEqual((shown[0, 0, 0], shown[0, 0, 2]), (0, 255))
        self.assertTrue(100 < shown[0, 0, 1] < 140)
        with self.assertRaises(ValueError):
            tegument.to_srgb(np.zeros((2, 2, 2), np.float32))


if __name__ == "__main__":
    unittest.main()
