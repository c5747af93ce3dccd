"""docs/samples/three in a headless Chromium (three.js of npm, WebGL 2 by SwiftShader), its pictures held against Vulkan's: three_test.py TEGUMENT ROOT."""

import base64
import functools
import http.server
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import threading
import unittest

PROGRAM, ROOT = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
sys.path.insert(0, str(ROOT / "tests" / "report"))
import browser  # noqa: E402
import pictures  # noqa: E402

SIZE = 256
CACHE = pathlib.Path(os.environ.get("TEGUMENT_CACHE") or pathlib.Path(os.environ.get("XDG_CACHE_HOME") or pathlib.Path.home() / ".cache") / "tegument")
THREE = CACHE / "tools" / "three" / "node_modules"

# What Vulkan's picture is drawn with, in three.js's words: camera and light of a workspace, the display's curve as its own tone mapping.
PAGE = """<!DOCTYPE html><meta charset="utf-8"><link rel="icon" href="data:,"><body><script type="importmap">
{ "imports": { "three": "./node_modules/three/build/three.module.js", "three/addons/": "./node_modules/three/examples/jsm/" } }</script>
<script type="module">
import * as THREE from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import { EffectComposer } from "three/addons/postprocessing/EffectComposer.js";
import { RenderPass } from "three/addons/postprocessing/RenderPass.js";
import { OutputPass } from "three/addons/postprocessing/OutputPass.js";
import { Skin, Fur, loadFur } from "./tegument-three.js";
const KNEE = "vec3 CustomToneMapping(vec3 c) { c = max(c, 0.0); vec3 t = max(c - 0.8, 0.0) / 0.2; return min(c, 0.8) + 0.2 * t / (1.0 + t); }";
THREE.ShaderChunk.tonemapping_pars_fragment = THREE.ShaderChunk.tonemapping_pars_fragment.replace(/vec3 CustomToneMapping\\([^}]*}/, KNEE);
const renderer = new THREE.WebGLRenderer({ preserveDrawingBuffer: true });
renderer.toneMapping = THREE.CustomToneMapping;
renderer.setSize(SIZE, SIZE);
const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(), light = new THREE.PointLight(0xffffff, Math.PI, 0, 0);
const composer = new EffectComposer(renderer);
composer.addPass(new RenderPass(scene, camera));
composer.addPass(new OutputPass());
const loader = new GLTFLoader(), models = {};
async function open(name) { return (models[name] ??= await loader.loadAsync(name)).scene; }
const own = { THREE, Skin, Fur, loadFur, renderer, scene, camera, light, composer, open };
function look({ camera: seen, light: lamp, background }, bounds) {
  const place = point => point.map((value, i) => (value * bounds.radius + bounds.centre[i]) / 1000);
  Object.assign(camera, { fov: seen.horizontal_fov, near: 0.05, far: 5 });
  camera.position.set(...place(seen.position));
  camera.lookAt(...place(seen.target));
  camera.updateProjectionMatrix();
  light.position.set(...place(lamp.position));
  light.color.setRGB(...lamp.color);
  scene.background = new THREE.Color().setRGB(...background, THREE.LinearSRGBColorSpace);
}
function shown(direct, ...objects) {
  scene.clear();
  scene.add(light, ...objects);
  direct ? (renderer.setRenderTarget(null), renderer.render(scene, camera)) : composer.render();
  return renderer.domElement.toDataURL("image/png");
}
Object.assign(window, { own, look, shown });
document.body.dataset.ready = "yes";
</script>"""


class Server(http.server.ThreadingHTTPServer):
    class Handler(http.server.SimpleHTTPRequestHandler):
        def log_message(self, *_):
            pass

    def __init__(self, folder):
        super().__init__(("127.0.0.1", 0), functools.partial(self.Handler, directory=folder))
        self.address = f"http://127.0.0.1:{self.server_address[1]}/"
        threading.Thread(target=self.serve_forever, daemon=True).start()


def bounds(file):
    data = file.read_bytes()
    return json.loads(data[20:20 + int.from_bytes(data[12:16], "little")])["meshes"][0]["extras"]["tegument"]["bounds"]


class Three(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory()))
        made = subprocess.run([sys.executable, ROOT / "docs" / "samples" / "three" / "make.py", cls.folder, "--program", PROGRAM, "--ball"], text=True, capture_output=True)
        if made.returncode == 3:
            raise unittest.SkipTest("DXC is missing")
        assert made.returncode == 0, made.stderr
        (cls.folder / "node_modules").symlink_to(THREE)
        (cls.folder / "test.html").write_text(PAGE.replace("SIZE", str(SIZE)))
        server = Server(cls.folder)
        cls.addClassCleanup(server.shutdown)
        cls.page = browser.Browser(600, 700, timeout=300, server=server.address)
        cls.addClassCleanup(cls.page.close)
        cls.server = server

    def setUp(self):
        self.page.problems.clear()
        self.page.open(self.server.address + "test.html")

    def tearDown(self):
        self.assertEqual(self.page.problems, [], "no error, no request of another server")

    def workspace(self, name, model):
        text = (ROOT / "effects" / "workspaces" / f"{name}.json").read_text()
        self.page.evaluate(f"look({text}, {json.dumps(bounds(self.folder / model))})")

    def drawn(self, name, script):
        """The picture of a script that gives objects; `direct`: without a composer."""
        address = self.page.evaluate("(async () => { const { THREE, Skin, Fur, loadFur, light, scene, camera, renderer, open } = own; let direct = false; " + script + " })()")
        return pictures.kept(f"{name}_three", base64.b64decode(address.split(",")[1]))

    def rendered(self, name, *arguments):
        picture = self.folder / "vulkan.png"
        subprocess.run([PROGRAM, "render", *map(str, arguments), "--picture", "half", "--size", str(SIZE), "--samples", "1", "-o", picture], check=True, capture_output=True)
        return pictures.kept(f"{name}_vulkan", picture.read_bytes())

    def need_head(self):
        if not (self.folder / "head.glb").exists():
            self.skipTest("the default head was not made (./bootstrap demo makes it)")
        self.workspace("human", "head.glb")

    # As in page_test.py: the outline is a pixel of background or of skin; maps are filtered by another rasteriser.
    def test_skin_that_scatters_is_vulkans(self):
        self.need_head()
        ours = self.drawn("separable", "return shown(direct, new Skin(await open('head.glb'), { light }));")
        pictures.expect_alike(self, "separable", ours, self.rendered("separable", "Separable", "-t", "Separable11", "-w", "human"), 0.025, 0.01)

    def test_preintegrated_skin_is_vulkans(self):
        self.need_head()
        ours = self.drawn("preintegrated", "return shown(direct, new Skin(await open('head.glb'), { light, technique: 'PreintegratedPenumbra' }));")
        pictures.expect_alike(self, "preintegrated", ours, self.rendered("preintegrated", "Preintegrated", "-t", "PreintegratedPenumbra", "-w", "human"), 0.025, 0.01)

    # Where 32 layers end against each other a pixel more or less shows: a strand's tip is one.
    def test_fur_is_vulkans(self):
        self.workspace("bunny", "ball.glb")
        ours = self.drawn("fur", "return shown(direct, new Fur(await open('ball.glb'), { light, map: await loadFur('fur_cube.dds'), preset: 'bunny' }));")
        theirs = self.rendered("fur", "Fur", "-w", "bunny", "--mesh", self.folder / "ball.glb", "--set", f"gFurCubeMap={self.folder / 'fur' / 'fur_cube.dds'}")
        pictures.expect_alike(self, "fur", ours, theirs, 0.04, 0.045)

    # Ears and nose end before the cheek: what is read at a pixel's place, where the coat in front ends, shows there. Read upside down: .0251.
    def test_a_furry_head_is_vulkans(self):
        if not (self.folder / "head.glb").exists():
            self.skipTest("the default head was not made (./bootstrap demo makes it)")
        self.workspace("bunny", "head.glb")
        ours = self.drawn("furry_head", "return shown(direct, new Fur(await open('head.glb'), { light, map: await loadFur('fur_cube.dds'), preset: 'bunny' }));")
        theirs = self.rendered("furry_head", "Fur", "-w", "bunny", "--mesh", self.folder / "head.glb", "--set", f"gFurCubeMap={self.folder / 'fur' / 'fur_cube.dds'}")
        pictures.expect_alike(self, "furry head", ours, theirs, 0.0235, 0.045)

    def fur(self):
        self.workspace("bunny", "ball.glb")
        return "const made = new Fur(await open('ball.glb'), { light, map: await loadFur('fur_cube.dds'), preset: 'bunny' }); "

    def test_what_is_turned_moved_and_enlarged_with_camera_and_light_looks_the_same(self):
        # A picture by other matrices. Fur hangs by the world's own down, and the light's map has the world's up: no lean, no shadow of the coat (.025).
        for made in (self.fur() + "made.set({ gFurLean: 0, gFurShadow: 0 }); ", "const made = new Skin(await open('ball.glb'), { light }); "):
            self.workspace("bunny", "ball.glb")
            _, rest = self.drawn("at_rest", made + "return shown(direct, made);")
            _, moved = self.drawn("moved", made + """made.unitMm = 400;
                const group = new THREE.Group(); group.rotation.set(0.3, 1.2, -0.5); group.position.set(0.7, -0.2, 0.4); group.scale.setScalar(2.5);
                group.add(made, camera, light); camera.near *= 2.5; camera.far *= 2.5; camera.updateProjectionMatrix();
                scene.clear(); scene.add(group); own.composer.render(); scene.add(camera, light); return renderer.domElement.toDataURL('image/png');""")
            distance, off = pictures.apart(moved, rest)
            print(f"moved: relative L2 {distance:.4f}, {off:.2%} off", flush=True)
            self.assertLess(distance, 0.005)
            self.assertLess(off, 0.005)

    def test_depth_is_three_jss_own(self):
        # A card before the ball hides its half, one behind it none of it.
        made = self.fur() + """const card = new THREE.Mesh(new THREE.PlaneGeometry(1, 2), new THREE.MeshBasicMaterial({ color: 0x00ff00 }));
            card.position.set(0.5, 0, PLACE); return shown(direct, made, card);"""
        _, alone = self.drawn("alone", made.replace("PLACE", "99"))
        _, behind = self.drawn("behind", made.replace("PLACE", "-0.2"))
        _, before = self.drawn("before", made.replace("PLACE", "0.2"))
        green = lambda picture: [r < 60 and g > 200 and b < 60 for r, g, b in picture]
        right = [i % SIZE > SIZE * 0.55 for i in range(SIZE * SIZE)]
        self.assertFalse(any(green(alone)))
        self.assertTrue(all(hidden for hidden, here in zip(green(before), right) if here))
        middle = (SIZE // 2) * SIZE + int(SIZE * 0.7)
        self.assertEqual(behind[middle], alone[middle])
        self.assertTrue(green(behind)[SIZE - 3], "the corner is the card's")

    def test_without_a_composer_the_canvas_is_encoded(self):
        # Skin does not blend: by OutputPass, from halves, it is the same but for rounding; of half, of 8 bits.
        self.workspace("human", "ball.glb")
        made = "direct = DIRECT; return shown(direct, new Skin(await open('ball.glb'), { light }));"
        _, composed = self.drawn("composed", made.replace("DIRECT", "false"))
        _, direct = self.drawn("direct", made.replace("DIRECT", "true"))
        self.assertLessEqual(max(abs(a - b) for one, other in zip(direct, composed) for a, b in zip(one, other)), 1)
        self.assertGreater(max(map(max, direct)), 150)

    def test_parallel_light_is_a_far_lamps(self):
        self.workspace("human", "ball.glb")
        made = """light.position.multiplyScalar(FAR); const sun = new THREE.DirectionalLight(light.color, Math.PI); sun.position.copy(light.position);
            return shown(direct, new Skin(await open('ball.glb'), { light: LAMP }));"""
        _, far = self.drawn("far", made.replace("FAR", "1000").replace("LAMP", "light"))
        self.workspace("human", "ball.glb")
        _, sun = self.drawn("sun", made.replace("FAR", "1").replace("LAMP", "sun"))
        self.assertLess(pictures.apart(sun, far)[0], 0.02)

    def test_light_falls_off_as_three_jss_does(self):
        # Twice as far from the ball's centre, four times as strong.
        self.workspace("human", "ball.glb")
        made = "light.position.set(0, 0, FAR); light.decay = 2; light.intensity = POWER; light.color.set(1, 1, 1); return shown(direct, new Skin(await open('ball.glb'), { light }));"
        _, near = self.drawn("near", made.replace("FAR", "40").replace("POWER", "3000"))
        _, far = self.drawn("far", made.replace("FAR", "80").replace("POWER", "12000"))
        self.assertLess(pictures.apart(near, far)[0], 0.01)
        self.assertGreater(max(map(max, near)), 100)

    def test_parameters_change_what_is_drawn(self):
        made = self.fur()
        _, long = self.drawn("long", made + "return shown(direct, made);")
        _, short = self.drawn("short", made + "return shown(direct, made.set({ gFurLength: 0.01, gFurFringes: 0 }));")
        self.assertEqual(self.page.evaluate("own.scene.children.at(-1).children.map(({ visible }) => visible)"), [True, False, True], "no fringes, no pass for them")
        self.assertGreater(pictures.apart(short, long)[1], 0.3)

    def test_a_picture_of_another_size_has_targets_of_that_size(self):
        self.need_head()
        self.page.evaluate("own.renderer.setSize(64, 64), own.composer.setSize(64, 64)")
        small = "const made = new Skin(await open('head.glb'), { light }); shown(direct, made); "
        ours = self.drawn("grown", small + f"renderer.setSize({SIZE}, {SIZE}); own.composer.setSize({SIZE}, {SIZE}); return shown(direct, made);")
        once = self.drawn("once", "return shown(direct, new Skin(await open('head.glb'), { light }));")
        self.assertEqual(ours, once)

    def test_objects_that_do_not_show_cost_no_passes(self):
        made = self.fur() + "made.position.set(VALUE, 0, 0); renderer.info.autoReset = false; shown(direct, made); renderer.info.reset(); shown(direct, made); return 'data:,' + btoa(renderer.info.render.calls);"
        calls = lambda value: int(base64.b64decode(self.page.evaluate(
            "(async () => { const { Fur, loadFur, light, scene, camera, renderer, open } = own; let direct = false; " + made.replace("VALUE", value) + " })()").split(",")[1]))
        self.assertEqual(calls("0") - calls("50"), 7, "shadow map, two hulls, the coat's end; skin, fringes, shells")

    def refused(self, script):
        return self.page.evaluate("(async () => { const { THREE, Skin, Fur, loadFur, light, open } = own; " + script + " })().catch(error => error.message)")

    def test_what_it_cannot_do_is_said(self):
        ball = "const ball = new THREE.Mesh(new THREE.SphereGeometry(0.1)); "
        for script, words in (("new Skin(new THREE.Group(), { light })", "no mesh"), ("new Skin(ball, {})", "wants a light"), ("new Fur(ball, { light })", "loadFur"),
                              ("new Fur(ball, { light, preset: 'wool' })", "no preset wool: bunny"), ("new Skin(ball, { light, technique: 'Skin' })", "no technique Skin"),
                              ("new Skin(ball, { light, parameters: { gNothing: 1 } })", "no parameter gNothing"),
                              ("new Skin(ball, { light, parameters: { gRoughness: [1, 2] } })", "gRoughness takes 1 numbers"),
                              ("new Skin(new THREE.Group().add(ball, new THREE.Mesh(new THREE.BoxGeometry())), { light })", "mergeGeometries"),
                              ("await loadFur('head.glb')", "no cube map of fur"),
                              ("shown(true, new Skin(ball, { light })); own.renderer.render(own.scene, new THREE.OrthographicCamera(-1, 1, 1, -1, -9, 9))", "perspective")):
            with self.subTest(script=script):
                self.assertIn(words, str(self.refused(ball + script)))

    def test_the_demo_is_drawn(self):
        self.page.size(480, 270)
        if not (self.folder / "head.glb").exists():
            self.skipTest("the default head was not made (./bootstrap demo makes it)")
        self.page.open(self.server.address + "demo.html")
        _, picture = pictures.kept("demo_three", self.page.screenshot())
        for x, what in ((0.38, "the head"), (0.67, "the fur")):
            red, _, blue = picture[int(0.48 * 270) * 480 + int(x * 480)]
            self.assertGreater(red, blue + 15, what)


if __name__ == "__main__":
    if not browser.program():
        print("skipped: Chromium is not installed; ./bootstrap test brings it")
        sys.exit(77)
    if not THREE.is_dir():
        print("skipped: no three.js: ./bootstrap test fetches it where npm is")
        sys.exit(77)
    result = unittest.main(argv=sys.argv[:1], verbosity=2, exit=False).result
    sys.exit(1 if not result.wasSuccessful() else 77 if result.skipped and result.testsRun == 0 else 0)
