#!/usr/bin/env python3
"""scripts/inspect in a real browser: a click in one stage highlights in all, and pixels show zbuf's report.

usage: inspect_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import base64
import pathlib
import re
import subprocess
import sys
import unittest

from browser import MISSING, Browser

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from toolbox import BIN, SOURCE, ToolTest, pipe, run, stage_texts  # noqa: E402

SAMPLE = SOURCE / "samples/tilted-camera"
# Triangle 1 reaches behind the eye and is cut into two pieces; the others are separate.
SCENE = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\ntriangle\n-2 0 0\n-1 0 0\n-2 1 0\n"
         "triangle\n0.2 -1 0\n0.2 -1 9\n3 -1 0\ntriangle\n1 1 0\n2 1 0\n1 2 0\nend\n")


def inspect(*words):
    return subprocess.run([SOURCE / "scripts/inspect", *map(str, words)], capture_output=True, text=True, timeout=300,
                          env={"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"})


class Messages(ToolTest):
    def test_what_is_wrong_with_the_scene_is_the_tools_message(self):
        pathlib.Path("scene.txt").write_text(SCENE + "x")
        done = inspect("scene.txt", "config.txt", "-o", "page.html")
        self.assertEqual(done.returncode, 1)
        self.assertRegex(done.stderr, r"\Ainspect: model: <stdin>:\d+:1: expected .*\n\Z")
        self.assertEqual(self.files(), ["config.txt", "scene.txt"])

    def test_a_missing_scene_is_named(self):
        done = inspect("none.txt", "config.txt")
        self.assertEqual((done.returncode, done.stderr), (1, "inspect: cannot read none.txt: No such file or directory\n"))

    def test_the_page_stands_alone(self):
        self.assertEqual(inspect("scene.txt", "config.txt", "-o", "page.html").returncode, 0)
        page = pathlib.Path("page.html").read_text()
        for word in ("src=", "href=", "http:", "https:", "@import", "url("):
            self.assertNotIn(word, page)


class Frustum(ToolTest):
    def test_is_the_one_that_project_uses(self):
        sys.path.insert(0, str(SOURCE / "scripts"))
        from lib.projection import window_of
        for projection in ("60 1.5 0.5 100", "60 1.5 0.5 100 ratio", "frustum -1 2 -3 4 5 6", "ortho -1 2 -3 4 -5 6"):
            with self.subTest(projection):
                line = projection if projection[0].isalpha() else "perspective " + projection
                keyword, *words = line.split()
                printed = pipe(["project"], stdin=line + "\nlight 0 0 0 1 1 1\n").decode()
                expected = re.search(r"(?:frustum|ortho) (.*)", printed)[1].split()
                for got, want in zip(window_of({keyword: words}), map(float, expected), strict=True):
                    self.assertAlmostEqual(got, want, places=12)


@unittest.skipIf(MISSING, f"needs {' and '.join(MISSING)} (Debian: chromium chromium-driver)")
class InABrowser(ToolTest):
    @classmethod
    def setUpClass(cls):
        cls.browser = cls.enterClassContext(Browser())

    def load(self, scene, config):
        done = inspect(scene, config, "-o", "page.html")
        self.assertEqual((done.stderr, done.returncode), ("", 0))
        self.browser.open(pathlib.Path("page.html").resolve())
        self.browser.wait_for(lambda: self.browser.run("return document.body.dataset.ready") == "yes")

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    def load_own_scene(self):
        pathlib.Path("scene.txt").write_text(SCENE)
        pathlib.Path("config.txt").write_text("40 40\n")
        self.load("scene.txt", "config.txt")
        return [text.decode().split("\n") for text in stage_texts(SCENE)]

    def hot_lines(self, tool):
        """Numbers and texts of the marked lines."""
        return self.browser.run("return [...document.querySelectorAll('#text-' + arguments[0] + ' .hot')].map("
                                "row => [Number(row.dataset.number), row.lastChild.textContent])", tool)

    def click_triangle(self, tool, points):
        """Clicks where the wireframe shows the center of a triangle."""
        middle = [sum(axis) / 3 for axis in zip(*points)]
        at = self.browser.run("const wire = inspector.panels[['model', 'view', 'project'].indexOf(arguments[0])].wire;"
                              "const p = wire.place(...arguments[1]); return [p[0] * 480 / wire.canvas.width, p[1] * 340 / wire.canvas.height]", tool, middle)
        self.browser.click(f"#wire-{tool}", *at)

    def marked_pixels(self):
        return {tuple(place) for place in self.browser.run(
            "const c = document.getElementById('image-mark'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data, found = [];"
            "for (let p = 0; p < c.width * c.height; ++p) if (d[4 * p + 3]) found.push([p % c.width, Math.floor(p / c.width)]);"
            "return found")}

    def test_a_triangle_that_is_clicked_shows_in_every_stage(self):
        model, view, project = self.load_own_scene()
        for tool in ("model", "view"):
            text = {"model": model, "view": view}[tool]
            first = {"model": 13, "view": 10}[tool]  # after a header of one line or four, and two triangles of four lines
            lines = text[first - 1:first + 2]
            self.click_triangle(tool, [tuple(map(float, line.split())) for line in lines])
            self.assertEqual(self.browser.run("return document.body.dataset.triangle"), "2")
            self.assertEqual(self.hot_lines("model"), [[n, model[n - 1]] for n in (13, 14, 15)])
            self.assertEqual(self.hot_lines("view"), [[n, view[n - 1]] for n in (10, 11, 12)])
            self.browser.run("inspector.select(-1)")

    def test_all_pieces_of_a_cut_triangle_are_marked(self):
        project = self.load_own_scene()[2]
        self.assertEqual(project.count("triangle 1"), 1)  # before the second piece
        self.browser.run("inspector.select(1)")
        self.assertEqual([text for _, text in self.hot_lines("project")], project[4:7] + project[9:12])

    def test_the_pixels_of_the_triangle_are_marked(self):
        project = self.load_own_scene()[2]
        self.browser.run("inspector.select(2)")
        alone = "\n".join(["triangle 2", *[line for line in project if line][-3:], ""])
        run("zbuf", "config.txt", "--image", "alone.ppm", stdin=alone)
        pixels = pathlib.Path("alone.ppm").read_bytes()[-4800:]
        drawn = {(p % 40, p // 40) for p in range(1600) if any(pixels[3 * p:3 * p + 3])}
        self.assertTrue(drawn)
        self.assertEqual(self.marked_pixels(), drawn)

    def test_a_pixel_tells_what_the_probe_tells(self):
        pathlib.Path("config.txt").write_text("42 42\n")
        self.load(SAMPLE / "scene.txt", "config.txt")
        stage3 = stage_texts((SAMPLE / "scene.txt").read_text())[2]
        scale = self.browser.run("return inspector.pixels.scale")
        for canvas, column, row in (("image", 15, 15), ("depth", 20, 20), ("image", 30, 10), ("image", 0, 0)):
            with self.subTest(column=column, row=row):
                self.browser.run("inspector.select(-1)")
                self.browser.click("#" + canvas, (column + 0.5) * scale, (row + 0.5) * scale)
                told = run("zbuf", "config.txt", "--image", "out.ppm", "--probe", f"{column},{row}", stdin=stage3).stderr.decode().splitlines()
                place = self.browser.run("return document.getElementById('pixel-place').textContent")
                self.assertTrue(place.startswith(f"row {row}, column {column}: "), place)
                rows = self.browser.run("return [...document.querySelectorAll('#competitors tbody tr')].map(r => [...r.cells].map(c => c.textContent))")
                lines = [f"zbuf: {column},{row}: triangle {name}, depth {float(depth)!r}: {fate}" for name, depth, fate in rows]
                self.assertEqual(lines or [f"zbuf: {column},{row}: no fragment"], told)
                kept = [name for name, _, fate in rows if fate == "kept"]
                self.assertIn(f"triangle {kept[-1]}," if kept else "background", place)
                if kept:
                    self.assertEqual(self.browser.run("return document.body.dataset.triangle"), kept[-1])

    def test_the_picture_is_zbufs(self):
        self.load(SAMPLE / "scene.txt", SAMPLE / "config.txt")
        run("zbuf", SAMPLE / "config.txt", "--image", "out.ppm", stdin=stage_texts((SAMPLE / "scene.txt").read_text())[2])
        shown = self.browser.run("const c = document.getElementById('image'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                                 "let s = ''; for (let i = 0; i < d.length; ++i) if (i % 4 < 3) s += String.fromCharCode(d[i]); return btoa(s)")
        self.assertTrue(pathlib.Path("out.ppm").read_bytes().endswith(base64.b64decode(shown)), "differs")

    def test_an_address_may_name_a_pixel(self):
        self.load_own_scene()
        self.browser.call("POST", "/url", {"url": f"file://{pathlib.Path('page.html').resolve()}#pixel=3,2"})
        self.browser.call("POST", "/refresh", {})
        self.browser.wait_for(lambda: self.browser.run("return document.body.dataset.ready") == "yes")
        self.assertIn("row 2, column 3:", self.browser.run("return document.getElementById('pixel-place').textContent"))

    def rows(self):
        return self.browser.run("return [...document.querySelectorAll('#counts tbody tr')].map(row => [...row.cells].map(cell => cell.textContent))")

    def test_the_table_has_the_statistics(self):
        model, view, project = ("\n".join(text).encode() for text in self.load_own_scene())
        told = {}
        for tool, data in (("model", SCENE), ("view", model), ("project", view), ("zbuf", project)):
            words = ["config.txt"] if tool == "zbuf" else []
            run(tool, *words, "--stats", "stats.txt", stdin=data)
            told[tool] = dict(line.split() for line in pathlib.Path("stats.txt").read_text().splitlines())
        rows = {row[0]: row for row in self.rows()}
        self.assertEqual(rows["model"][5:], ["", "-2 to 3", "-1 to 2", "0 to 9"])
        self.assertEqual(rows["project"][5], "1 cut")
        zbuf = {key: word for key, word in told["zbuf"].items() if word != "0" and key != "triangles" and key[:2] not in ("x_", "y_", "z_")}
        self.assertEqual(rows["zbuf"][5], ", ".join(f"{word} {key.replace('_', ' ')}" for key, word in zbuf.items()))
        self.assertIn("seen", rows["zbuf"][5])
        for tool, row in rows.items():
            for axis, cell in zip("xyz", row[6:]):
                self.assertEqual([float(word) for word in cell.split(" to ")], [float("%.4g" % float(told[tool][f"{axis}_{end}"])) for end in ("min", "max")])

    def points_out_of_sight(self, tool):
        """Corners of the guide and of the triangles that no pixel of the pane shows at first."""
        return self.browser.run(
            "const wire = inspector.panels[['model', 'view', 'project'].indexOf(arguments[0])].wire, lost = [];"
            "const points = wire.guide.flat(); for (let i = 0; i < wire.points.length; i += 3) points.push([...wire.points.slice(i, i + 3)]);"
            "for (const p of points) { const [x, y] = wire.place(...p); if (x < 0 || y < 0 || x > wire.canvas.width || y > wire.canvas.height) lost.push(p); }"
            "return lost", tool)

    def test_all_that_is_there_is_in_sight(self):
        pathlib.Path("config.txt").write_text("40 40\n")
        scenes = {"own": SCENE, "beside": SCENE.replace("triangle", "translate\n4 3 0\ntriangle", 1), "empty": SCENE[:SCENE.index("triangle")] + "end\n",
                  "behind": SCENE.replace("triangle", "translate\n0 0 30\ntriangle", 1), "ortho": SCENE.replace("60 1 1 100", "ortho -1 1 -1 1 -5 5")}
        for name, scene in scenes.items():
            pathlib.Path("scene.txt").write_text(scene)
            self.load("scene.txt", "config.txt")
            for tool in ("model", "view", "project"):
                with self.subTest(scene=name, tool=tool):
                    self.assertEqual(self.points_out_of_sight(tool), [])

    def test_a_far_plane_in_the_distance_does_not_shrink_the_rest(self):
        pathlib.Path("config.txt").write_text("40 40\n")
        pathlib.Path("scene.txt").write_text(SCENE.replace("60 1 1 100", "60 1 1 1e6"))
        self.load("scene.txt", "config.txt")
        self.assertLess(self.browser.run("return inspector.panels[1].wire.size"), 40)
        self.assertIn("(the far plane is at distance 1e+06, drawn nearer)", self.browser.run("return document.querySelector('#stages').textContent"))

    def test_a_triangle_in_the_distance_does_not_hide_the_cube(self):
        pathlib.Path("config.txt").write_text("40 40\n")
        pathlib.Path("scene.txt").write_text(SCENE.replace("triangle", "push\ntranslate\n1e6 0 0\ntriangle\n0 0 0\n1 0 0\n0 1 0\npop\ntriangle", 1))
        self.load("scene.txt", "config.txt")
        width = self.browser.run("const wire = inspector.panels[2].wire; Object.assign(wire, {yaw: 0, pitch: 0}); return wire.place(1, 0, 0)[0] - wire.place(-1, 0, 0)[0]")
        self.assertGreater(width, 5)

    def test_dragging_turns_without_choosing(self):
        self.load_own_scene()
        before = self.browser.run("return inspector.panels[0].wire.yaw")
        self.browser.call("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [
            {"type": "pointerMove", "duration": 0, "origin": {"element-6066-11e4-a52e-4f735466cecf": self.browser.element("#wire-model")}, "x": 0, "y": 0},
            {"type": "pointerDown", "button": 0}, {"type": "pointerMove", "duration": 0, "origin": "pointer", "x": 50, "y": 0},
            {"type": "pointerUp", "button": 0}]}]})
        self.assertNotEqual(self.browser.run("return inspector.panels[0].wire.yaw"), before)

    def test_a_large_scene_is_thinned_and_says_so(self):
        scene = subprocess.run([SOURCE / "scripts/make-torus", "--around", "250", "--tube", "100"], capture_output=True, check=True).stdout
        pathlib.Path("large.txt").write_bytes(scene)
        pathlib.Path("config.txt").write_text("42 42\n")
        self.load("large.txt", "config.txt")
        self.assertIn("Of 100000 triangles every 9th is drawn", self.browser.run("return document.getElementById('notes').textContent"))
        self.assertEqual(self.browser.run("return inspector.panels.map(panel => panel.wire.names.length)"), [11112] * 3)
        scale = self.browser.run("return inspector.pixels.scale")
        self.browser.click("#image", 20.5 * scale, 20.5 * scale)
        told = run("zbuf", "config.txt", "--image", "out.ppm", "--probe", "20,20", stdin=stage_texts(scene)[2]).stderr.decode().splitlines()
        self.assertEqual(self.browser.run("return document.querySelectorAll('#competitors tbody tr').length"), len(told))


if __name__ == "__main__":
    unittest.main()
