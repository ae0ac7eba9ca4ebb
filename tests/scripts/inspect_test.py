#!/usr/bin/env python3
"""scripts/inspect in a real browser: a click in one stage highlights in all, and pixels show zbuf's report.

usage: inspect_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import base64
import functools
import math
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest
from unittest import mock

from browser import MISSING, Browser
from toolbox import BIN, SOURCE, Terminal, ToolTest, pipe, run, run_script, stage_texts, tools_with

TAB, ESCAPE, LEFT, UP, RIGHT, DOWN, HOME, SHIFT = ("\ue004", "\ue00c", "\ue012", "\ue013", "\ue014", "\ue015",
                                                   "\ue011", "\ue008")
from lib.showing.pictures import read_picture  # noqa: E402

SAMPLE = SOURCE / "samples/tilted-camera"
# Triangle 1 reaches behind the eye and is cut into two pieces; the others are separate.
SCENE = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\ntriangle\n-2 0 0\n-1 0 0\n-2 1 0\n"
         "triangle\n0.2 -1 0\n0.2 -1 9\n3 -1 0\ntriangle\n1 1 0\n2 1 0\n1 2 0\nend\n")
SHORT = """const {inspector} = document.body, panels = inspector?.panels,
  one = s => document.querySelector(s), all = s => [...document.querySelectorAll(s)],
  text = selector => one(selector).textContent, texts = selector => all(selector).map(e => e.textContent),
  cells = selector => all(selector).map(row => [...row.cells].map(cell => cell.textContent)),
  select = (triangle, pixel) => inspector.select({triangle, pixel}),
  choose = pixel => inspector.select(inspector.atPixel(pixel));"""
KINDS = ("hidden", "outside", "culled", "thin")
RAYS = ("ray-primary", "ray-shadow", "ray-mirrored", "ray-refracted")

inspect = functools.partial(run_script, "inspect")


class Messages(ToolTest):
    def test_what_is_wrong_with_the_scene_is_the_tools_message(self):
        sphere = SCENE.replace("triangle", "sphere 0 0 0 1\ntriangle", 1)
        for text, message in (SCENE + "x", r"model: scene\.txt:18:1: expected .*"), (
                sphere, r"model: scene\.txt:5:1: expected triangles alone, found a sphere: --trace draws it"):
            pathlib.Path("scene.txt").write_text(text)
            done = inspect("scene.txt", "config.txt", "-o", "page.html")
            self.assertEqual((done.returncode, self.files()), (1, ["config.txt", "scene.txt"]))
            self.assertRegex(done.stderr, rf"\Ainspect: {message}\n\Z")

    def test_a_stage_that_leaves_out_a_triangle_is_named(self):
        pathlib.Path("scene.txt").write_text(SCENE)
        for tool in ("model", "view"):
            tools = tools_with(tool, '$real "$@" | head -n -4')
            done = inspect("scene.txt", "config.txt", env={**os.environ, "BIN": str(tools)})
            self.assertEqual(done.stderr,
                             f"inspect: {tool}: has not written all of its text, though it ended well\n")

    def test_per_cent_on_a_terminal(self):
        pathlib.Path("scene.txt").write_text(SCENE)
        terminal = Terminal(self)
        subprocess.run([SOURCE / "scripts/inspect", "scene.txt", "config.txt", "-o", "page.html"],
                       stderr=terminal.channel, env={**os.environ, "BIN": str(BIN)}, check=True)
        shown = terminal.shown()
        self.assertRegex(shown, rb"\A\r\[\.{30}\] 0%")
        self.assertRegex(shown, rb"\r\[#{14}\.{16}\] 48%, \d+ s left")
        self.assertTrue(shown.endswith(b"\r\x1b[K"))

    def test_a_missing_scene_is_named(self):
        done = inspect("none.txt", "config.txt")
        self.assertEqual((done.returncode, done.stderr),
                         (1, "inspect: cannot read none.txt: No such file or directory\n"))

    def test_options_without_a_meaning_are_refused(self):
        for words, reason in ((
                "--trace --theirs .",
                "--theirs means nothing with --trace: a hand-in is compared with project and zbuf"),
                              ("--no-shadows", "--no-shadows is for trace: it needs --trace"),
                              ("--samples 3", "--samples is for trace: it needs --trace")):
            done = inspect("scene.txt", "config.txt", *words.split())
            self.assertEqual((done.returncode, done.stderr.splitlines()[-1]),
                             (2, f"inspect: {reason} (try inspect --help)"))

    def test_the_page_stands_alone(self):
        self.assertEqual(inspect("scene.txt", "config.txt", "-o", "page.html").returncode, 0)
        page = pathlib.Path("page.html").read_text()
        for word in ("src=", "href=", "http:", "https:", "@import", "url("):
            self.assertNotIn(word, page)


class WithoutABrowser(ToolTest):
    def test_one_that_cannot_start_is_a_skip_with_its_reason(self):
        pathlib.Path("chromedriver").write_text("#!/bin/sh\nexit 3\n")
        os.chmod("chromedriver", 0o755)
        with mock.patch.dict(os.environ, PATH=os.getcwd()), self.assertRaises(unittest.SkipTest) as raised:
            Browser()
        self.assertEqual(str(raised.exception), "chromium cannot start: chromedriver ended with status 3")


class Frustum(ToolTest):
    def test_is_the_one_that_project_uses(self):
        sys.path.insert(0, str(SOURCE / "scripts"))
        from lib.text.projection import window_of
        for projection in ("60 1.5 0.5 100", "60 1.5 0.5 100 ratio", "frustum -1 2 -3 4 5 6",
                           "ortho -1 2 -3 4 -5 6"):
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
        cls.pages = {}  # by what they are made of
        cls.browser = cls.enterClassContext(Browser())

    def load(self, scene, config, *words):
        folders = [path.read_bytes() for word in words for path in sorted(pathlib.Path(word).glob("*"))]
        key = (pathlib.Path(scene).read_bytes(), pathlib.Path(config).read_bytes(), *words, *folders)
        if key not in self.pages:
            done = inspect(scene, config, "-o", "page.html", *words)
            self.assertEqual((done.stderr, done.returncode), ("", 0))
            self.pages[key] = pathlib.Path("page.html").read_bytes()
        pathlib.Path("page.html").write_bytes(self.pages[key])
        self.browser.open(pathlib.Path("page.html").resolve())
        self.browser.wait_for(lambda: self.js("return document.body.dataset.ready") == "yes")

    def js(self, code, *arguments):
        """The result of a script, which has short names for the things on the page."""
        function = f"(function () {{ {code} }})"
        return self.browser.run(f"{SHORT} return {function}.apply(null, arguments)", *arguments)

    def tearDown(self):
        self.assertEqual(self.browser.complaints(), [])

    def load_text(self, scene, size=40, *words):
        pathlib.Path("scene.txt").write_text(scene)
        pathlib.Path("config.txt").write_text(f"{size} {size}\n")
        self.load("scene.txt", "config.txt", *words)

    def load_own_scene(self, *words):
        self.load_text(SCENE, 40, *words)
        return [text.decode().split("\n") for text in stage_texts(SCENE)]

    def hot_lines(self, tool):
        """Numbers and texts of the marked lines."""
        return self.js(
            "return [...document.querySelectorAll('#text-' + arguments[0] + ' .hot')].map(row => "
            "[Number(row.dataset.number), row.lastChild.textContent])", tool)

    def click_triangle(self, tool, points):
        """Clicks where the wireframe shows the center of a triangle."""
        middle = [sum(axis) / 3 for axis in zip(*points)]
        at = self.js(
            "const wire = panels[['model', 'view', 'project'].indexOf(arguments[0])].wire;const p "
            "= wire.view.place(...arguments[1]); return [p[0] / wire.scale, p[1] / "
            "wire.scale]", tool, middle)
        self.browser.click(f"#wire-{tool}", *at)

    def competitors(self):
        """The cells of the pixel's fragments."""
        return self.js("return cells('#competitors tbody tr')")

    def marked_pixels(self):
        return set(
            map(
                tuple,
                self.js("const {columns, fragments, name} = inspector.pixels; return "
                        "[...fragments.pixelsOf(name)].map(p => [p % columns, "
                        "Math.floor(p / columns)])")))

    def outlined(self):
        """The box of the marks over the image, in pixels of the picture: left, top, right, bottom."""
        return self.js("const c = one('#image-mark'), d = c.getContext('2d').getImageData(0, 0, c.width, "
                       "c.height).data;const scale = c.width / one('#image').width, xs = [], ys = [];for "
                       "(let p = 0; p < c.width * c.height; ++p) if (d[4 * p + 3] > 128) { xs.push(p % "
                       "c.width / scale); ys.push(Math.floor(p / c.width) / scale); }return "
                       "[Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)]")

    def test_a_triangle_that_is_clicked_shows_in_every_stage(self):
        model, view, project = self.load_own_scene()
        for tool in ("model", "view"):
            text = {"model": model, "view": view}[tool]
            first = {"model": 13,
                     "view": 10}[tool]  # after a header of one line or four, and two triangles of four lines
            lines = text[first - 1:first + 2]
            self.click_triangle(tool, [tuple(map(float, line.split())) for line in lines])
            self.assertEqual(self.js("return document.body.dataset.triangle"), "2")
            self.assertEqual(self.hot_lines("model"), [[n, model[n - 1]] for n in (13, 14, 15)])
            self.assertEqual(self.hot_lines("view"), [[n, view[n - 1]] for n in (10, 11, 12)])
            self.js("select(-1, -1)")

    def test_all_pieces_of_a_cut_triangle_are_marked(self):
        project = self.load_own_scene()[2]
        self.assertEqual(project.count("triangle 1"), 1)  # before the second piece
        self.js("select(1, -1)")
        self.assertEqual([text for _, text in self.hot_lines("project")], project[4:7] + project[9:12])

    def test_the_pixels_of_the_triangle_are_marked(self):
        project = self.load_own_scene()[2]
        self.js("select(2, -1)")
        alone = "\n".join(["triangle 2", *[line for line in project if line][-3:], ""])
        run("zbuf", "config.txt", "--image", "alone.ppm", stdin=alone)
        pixels = pathlib.Path("alone.ppm").read_bytes()[-4800:]
        drawn = {(p % 40, p // 40) for p in range(1600) if any(pixels[3 * p:3 * p + 3])}
        self.assertTrue(drawn)
        self.assertEqual(self.marked_pixels(), drawn)
        columns, rows = zip(*drawn)
        for found, wanted in zip(self.outlined(), (min(columns), min(rows), max(columns) + 1, max(rows) + 1),
                                 strict=True):
            self.assertAlmostEqual(found, wanted, delta=0.5)

    def test_a_pixel_tells_what_the_probe_tells(self):
        pathlib.Path("config.txt").write_text("42 42\n")
        self.load(SAMPLE / "scene.txt", "config.txt")
        stage3 = (SAMPLE / "stage3.txt").read_bytes()
        scale = self.js("return inspector.pixels.scale")
        for canvas, column, row in (("image", 15, 15), ("depth", 20, 20), ("image", 30, 10), ("image", 0, 0)):
            with self.subTest(column=column, row=row):
                self.js("select(-1, -1)")
                self.browser.click("#" + canvas, (column + 0.5) * scale, (row + 0.5) * scale)
                told = run("zbuf", "config.txt", "--image", "out.ppm", "--probe", f"{column},{row}",
                           stdin=stage3).stderr.decode().splitlines()
                place = self.js("return text('#pixel-place')")
                self.assertTrue(place.startswith(f"row {row}, column {column}: "), place)
                rows = self.competitors()
                lines = [
                    f"zbuf: {column},{row}: triangle {name}, depth {float(depth)!r}: "
                    f"{fate.removesuffix(', until a nearer one came')}" for name, depth, fate in rows]
                self.assertEqual(lines or [f"zbuf: {column},{row}: no fragment"], told)
                kept = [name for name, _, fate in rows if fate == "kept"]
                self.assertIn(f"triangle {kept[-1]}," if kept else "background", place)
                if kept:
                    self.assertEqual(self.js("return document.body.dataset.triangle"), kept[-1])

    def image(self):
        """The bytes of its pixels."""
        script = (
            "const c = one('#image'), d = c.getContext('2d').getImageData(0, 0, c.width, c.height).data; "
            "let s = ''; for (let i = 0; i < d.length; ++i) if (i % 4 < 3) s += "
            "String.fromCharCode(d[i]); return btoa(s)")
        return base64.b64decode(self.js(script))

    def test_the_picture_is_zbufs(self):
        self.load(SAMPLE / "scene.txt", SAMPLE / "config.txt")
        run("zbuf", SAMPLE / "config.txt", "--image", "out.ppm", stdin=(SAMPLE / "stage3.txt").read_bytes())
        self.assertTrue(pathlib.Path("out.ppm").read_bytes().endswith(self.image()), "differs")

    def test_no_script_runs_but_the_pages_own(self):
        self.load_own_scene()
        self.js("const made = document.createElement('script'); made.textContent = 'window.foreign = "
                "1';document.body.append(made); document.body.insertAdjacentHTML('beforeend', '<img "
                "src=\"http://127.0.0.1:1/\">')")
        self.assertIsNone(self.js("return window.foreign"))
        told = []

        def is_told():
            told.extend(self.browser.complaints())
            return all(any(rule in line for line in told) for rule in ("script-src", "img-src"))

        self.browser.wait_for(is_told)

    def test_an_address_may_name_a_pixel(self):
        self.load_own_scene()
        self.browser.call("POST", "/url", {"url": f"file://{pathlib.Path('page.html').resolve()}#pixel=3,2"})
        self.browser.call("POST", "/refresh", {})
        self.browser.wait_for(lambda: self.js("return document.body.dataset.ready") == "yes")
        self.assertIn("row 2, column 3:", self.js("return text('#pixel-place')"))

    def hash(self):
        return self.js("return location.hash")

    def held(self):
        return self.js("const {triangle, pixel} = inspector.held; return [triangle, pixel]")

    def test_a_click_sets_the_address_and_one_beside_clears_it(self):
        self.load_own_scene()
        scale = self.js("return inspector.pixels.scale")
        self.browser.click("#image", 3.5 * scale, 2.5 * scale)
        self.assertEqual(self.hash(), "#pixel=3,2")
        self.js("select(2, -1)")
        self.assertEqual(self.hash(), "#triangle=2")
        self.browser.click("header", 2, 2)
        self.assertEqual((self.hash(), self.held()), ("", [-1, -1]))

    def test_arrows_walk_pixels_and_escape_lets_go(self):
        self.load_own_scene()
        self.browser.press("#image", RIGHT)  # the pixel in the middle
        self.assertEqual(self.hash(), "#pixel=20,20")
        for keys, place in ((RIGHT, "21,20"), (DOWN, "21,21"), (LEFT + LEFT, "19,21"), (UP, "19,20"),
                            (SHIFT + UP + SHIFT, "19,10"), (3 * (SHIFT + LEFT + SHIFT), "0,10")):
            self.browser.press("#image", keys)
            self.assertEqual(self.hash(), "#pixel=" + place)
        self.browser.press("#image", ESCAPE)
        self.assertEqual((self.hash(), self.held()), ("", [-1, -1]))

    def test_arrows_walk_triangles_and_turn(self):
        self.load_own_scene()
        for keys, name in ((RIGHT, 0), (RIGHT, 1), (DOWN, 2), (RIGHT, 0), (LEFT, 2), (UP, 1)):
            self.browser.press("#wire-view", keys)
            self.assertEqual(self.held(), [name, -1])
        before = self.js("return panels[1].wire.view.yaw")
        self.browser.press("#wire-view", SHIFT + LEFT + SHIFT)
        self.assertEqual(self.held(), [1, -1])
        self.assertGreater(self.js("return panels[1].wire.view.yaw"), before)
        self.browser.press("#wire-view", "++")
        self.assertAlmostEqual(self.js("return panels[1].wire.view.zoom"), 1.15**2)
        self.browser.press("#wire-view", HOME)
        self.assertEqual(self.js("const {view} = panels[1].wire; return [view.yaw, view.zoom]"), [before, 1])

    def test_tab_reaches_every_view_and_the_keys_are_told(self):
        self.load_own_scene()
        reached = []
        for _ in range(30):
            self.browser.call(
                "POST", "/actions", {
                    "actions": [{
                        "type": "key",
                        "id": "keys",
                        "actions": [{"type": "keyDown", "value": TAB}, {"type": "keyUp", "value": TAB}],}]})
            reached.append(self.js("return document.activeElement.id"))
        self.assertLessEqual(
            {
                "help", "wire-model", "wire-view", "wire-project", "image", "depth", "tab-texts",
                "text-model", "text-view", "text-project", "text-zbuf"}, set(reached))
        self.browser.press("#wire-model", "?")
        self.assertTrue(self.js("return one('#keys').open"))
        self.browser.press("#keys button", ESCAPE)
        self.assertFalse(self.js("return one('#keys').open"))

    def test_a_screen_reader_finds_names_and_roles(self):
        self.load_own_scene()
        self.js("select(2, -1)")
        found = self.browser.accessibility()
        for role, name in (("application",
                            "world space, wireframe after model"), ("application",
                                                                    "view space, wireframe after view"),
                           ("application", "normalized device coordinates, wireframe after project"),
                           ("application", "image, 40 columns and 40 rows of pixels"),
                           ("application", "depth, 40 columns and 40 rows of pixels"),
                           ("button", "fit world space into its view"), ("button", "Keys"), ("tab", "Texts"),
                           ("tab", "Arithmetic"), ("tab", "Counts"), ("group", "text after project"),
                           ("list", "what became of the triangles"), ("region", "Fragments of a pixel"),
                           ("region", "texts and explanations"), ("columnheader", "triangle"),
                           ("heading", "scene.txt: 3 triangles, 40 × 40 pixels")):
            self.assertTrue(any(role == r and n.startswith(name) for r, n in found),
                            f"no {role} named {name}")
        self.assertIn("status", [role for role, _ in found])
        self.assertRegex(self.js("return text('[role=status]')"), r"^triangle 2: shown in \d+ pixels$")
        # Whatever takes the focus has a name.
        interactive = ("application", "button", "tab", "group", "tabpanel", "link", "textbox")
        self.assertEqual([role for role, name in found if role in interactive and not name], [])

    def test_all_is_in_sight_on_one_screen_and_nothing_overflows(self):
        self.load(SAMPLE / "scene.txt", SAMPLE / "config.txt")
        self.addCleanup(self.browser.devtools, "Emulation.clearDeviceMetricsOverride")
        for width in (420, 800, 1024, 1440, 2560):
            self.browser.resize(width, 900)
            with self.subTest(width=width):
                for tab in ("texts", "explanation", "statistics"):
                    self.js(
                        "document.getElementById('tab-' + arguments[0]).click(); choose(37 * 100 + "
                        "37)", tab)
                    self.assertLessEqual(
                        self.js("return document.documentElement.scrollWidth - "
                                "document.documentElement.clientWidth"), 0)
                self.js("one('#tab-texts').click()")
                if width >= 1024:
                    self.assertLessEqual(self.js("return document.documentElement.scrollHeight"), 900)
                    boxes = self.js("return all('.pane, .pane canvas, #pixel, .text').map(e => "
                                    "e.getBoundingClientRect()).map(b => [b.left, b.top, b.right, b.bottom])")
                    self.assertEqual(len(boxes), 5 + 10 + 1 + 4)
                    for left, top, right, bottom in boxes:
                        self.assertGreater(right - left, 100)
                        self.assertGreater(bottom - top, 80)
                        self.assertTrue(left >= 0 and top >= 0 and right <= width and bottom <= 900,
                                        (left, top, right, bottom))

    def test_marks_stand_out_from_any_color_in_light_and_dark(self):
        self.load_own_scene()
        self.addCleanup(self.browser.prefer, "light")

        def luminance(color):  # WCAG 2
            parts = [int(color[i:i + 2], 16) / 255 for i in (1, 3, 5)]
            return sum(share * (x / 12.92 if x <= 0.04045 else ((x + 0.055) / 1.055)**2.4)
                       for share, x in zip((0.2126, 0.7152, 0.0722), parts))

        papers = []
        for scheme in ("light", "dark"):
            self.browser.prefer(scheme)
            colors = {
                name: self.js(
                    "const style = getComputedStyle(document.documentElement); "
                    "return style.getPropertyValue(arguments[0]).trim()", "--" + name)
                for name in ("hot", "halo", "pixel", "card", "ink", "soft", "guide", "shown", *KINDS, *RAYS)}

            def contrast(a, b):
                low, high = sorted(luminance(colors[name]) for name in (a, b))
                return (high + 0.05) / (low + 0.05)

            # One of two tones that differ by a factor of 4.5 differs from any color by more than 2.
            for a, b, least in (("hot", "halo", 4.5), ("pixel", "halo", 4.5), ("ink", "card", 7),
                                ("soft", "card", 4.5), ("guide", "card", 3), ("shown", "card", 3),
                                *((kind, "card", 3) for kind in KINDS), *((ray, "halo", 4.5) for ray in RAYS),
                                *((ray, "card", 4.5) for ray in RAYS)):
                self.assertGreaterEqual(contrast(a, b), least, (scheme, a, b))
            self.browser.wait_for(lambda: papers != [paper := self.paper()])
            papers.append(self.paper())
        self.assertEqual(len(set(map(tuple, papers))), 2)

    def paper(self):
        """The color of a wireframe's background."""
        return self.js("const c = one('#wire-model'); return [...c.getContext('2d').getImageData(c.width - "
                       "1, 0, 1, 1).data]")

    def test_arithmetic_is_that_of_explain(self):
        for coverage in ("nearest", "center"):
            self.load_own_scene("--coverage", coverage)
            self.js("one('#tab-explanation').click()")
            shown = [
                self.js("return [...inspector.fragments.pixelsOf(arguments[0])]", name) for name in range(3)]
            pixels = [p for found in shown for p in (found[0], found[len(found) // 2])] + [0]
            for i, p in enumerate(pixels):
                for name in {i // 2 % 3, (i + 1) % 3}:
                    row, column = divmod(p, 40)
                    told = run_script("explain", "scene.txt", "config.txt", "--triangle", name, "--pixel",
                                      f"{column},{row}", "--coverage", coverage).stdout
                    told = re.sub(r"^  uncertain: .*\n", "", told, flags=re.M)  # of a text with bounds
                    self.js("select(arguments[0], arguments[1])", name, p)
                    shown = self.js("return texts('#explanation pre')")
                    self.assertEqual("\n\n".join(shown) + "\n", told, (coverage, name, column, row))

    def load_a_hand_in(self, change):
        """The page of the sample with a folder of files that are ours but for `change`, called in it."""
        pathlib.Path("theirs").mkdir()
        for name in ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp"):
            shutil.copy(SAMPLE / name, "theirs")
        change()
        self.load(SAMPLE / "scene.txt", SAMPLE / "config.txt", "--theirs", "theirs")
        return self.js("return one('#theirs').innerText")

    @staticmethod
    def write_right_negated():
        """Their x and y have the opposite sign: r is up x l, and all that follows from it is right."""
        rows = [line.split() for line in (SAMPLE / "stage2.txt").read_text().splitlines()]
        pathlib.Path("theirs/stage2.txt").write_text("".join(
            f"{-float(row[0]):.7f} {-float(row[1]):.7f} {row[2]}\n" if row else "\n" for row in rows))
        pathlib.Path("theirs/stage3.txt").write_bytes(
            run("project", "--scene", SAMPLE / "scene.txt", "theirs/stage2.txt").stdout)
        run("zbuf", SAMPLE / "config.txt", "theirs/stage3.txt", "--z-buffer", "theirs/z_buffer.txt", "-o",
            "theirs/out.bmp")

    def test_theirs_has_the_verdict_and_the_matrix(self):
        told = self.load_a_hand_in(self.write_right_negated)
        scene, config = SAMPLE / "scene.txt", SAMPLE / "config.txt"
        judged = run_script("compare", "--hand-in", "theirs", scene, config).stdout
        self.assertIn("theirs: " + judged.split("Verdict: ")[1].split("\nNext: ")[0], told)
        matrix = [line for line in judged.splitlines() if " | " in line and not line.startswith("|")]
        self.assertEqual(len(matrix), 5)
        self.assertIn("\n".join(matrix), self.js("return text('#theirs pre')"))
        self.assertEqual(
            self.js("return all('figcaption .good, figcaption .bad').map(e => [e.className, "
                    "e.textContent])"), [["good", "stage1.txt: right"], ["bad", "stage2.txt: wrong"],
                                         *(["good", f"{name}: right, given their stage2.txt"]
                                           for name in ("stage3.txt", "out.bmp", "z_buffer.txt"))])

    def test_theirs_lists_and_marks_what_differs(self):
        def change():
            lines = pathlib.Path("theirs/stage1.txt").read_text().split("\n")
            for at, line in ((1, "9 8 7"), (6, lines[6] + "4")):  # another point, and a digit more
                lines[at] = line
            pathlib.Path("theirs/stage1.txt").write_text("\n".join(lines))

        told = self.load_a_hand_in(change)
        self.assertIn("1 of 66 vertices differ from ours:", told)
        ours = (SAMPLE / "stage1.txt").read_text().split("\n")[1]
        self.assertEqual(
            self.js("return cells('#theirs [data-name]')"),
            [["0", "2", "2", "9 8 7", " ".join(f"{float(word):g}" for word in ours.split()[:3])]])
        self.assertEqual(told.count("every vertex is ours"), 2)
        self.js("one('#theirs [data-name] button').click()")
        self.assertEqual(self.held(), [0, -1])
        # Theirs is marked where it differs, and only there.
        color = self.js("return inspector.palette.numbers('--theirs')")
        marks = (
            "const {wire} = panels[arguments[0]], {mark} = wire; select(0, -1);"
            "const d = mark.getContext('2d').getImageData(0, 0, mark.width, mark.height).data;"
            "let count = 0; for (let i = 0; i < d.length; i += 4) count += d[i] === arguments[1][0] && d[i + "
            "1] === arguments[1][1] && d[i + 2] === arguments[1][2] && d[i + 3] === 255; return count")
        self.assertGreater(self.js(marks, 0, color), 20)
        self.assertEqual(self.js(marks, 1, color), 0)
        # In the wireframe there is a dot where their vertex is, in a color that only theirs have.
        self.js("select(-1, -1); panels[0].wire.view.approach(0.6); panels[0].wire.draw()")
        self.assertEqual(
            self.js("const {wire} = panels[0], [x, y] = wire.view.place(9, 8, 7);return "
                    "[...wire.canvas.getContext('2d').getImageData(Math.floor(x), Math.floor(y), 1, "
                    "1).data].slice(0, 3)"), self.js("return inspector.palette.numbers('--theirs')"))

    def test_theirs_may_be_missing_or_unreadable(self):
        def change():
            pathlib.Path("theirs/stage2.txt").unlink()
            pathlib.Path("theirs/stage3.txt").write_text("<b>no numbers</b>\n")
            pathlib.Path("theirs/out.bmp").write_text("BM")

        told = self.load_a_hand_in(change)
        self.assertIn("not handed in", told)
        self.assertIn("unreadable", told)
        self.assertTrue(self.js("return one('#whose').hidden"))

    def test_their_image_can_be_seen(self):
        self.load_a_hand_in(self.write_right_negated)
        theirs, ours = ([bytes(row[i:i + 3]) for row in read_picture(path)[2] for i in range(0, len(row), 3)]
                        for path in ("theirs/out.bmp", SAMPLE / "out.bmp"))
        title = "return one('#image').closest('figure').querySelector('figcaption').firstChild.textContent"
        self.assertEqual(self.js(title), "our image")
        faces, titles = [], []
        for _ in range(3):
            self.js("one('#whose').click()")
            faces.append(self.image())
            titles.append(self.js(title))
        self.assertEqual(titles, ["their image", "where theirs differs", "our image"])
        self.assertEqual(faces[0], b"".join(theirs))
        self.assertEqual(faces[2], b"".join(ours))
        color = bytes(self.js("return inspector.palette.numbers('--theirs')"))
        self.assertEqual([faces[1][3 * i:3 * i + 3] == color for i in range(10000)],
                         [a != b for a, b in zip(theirs, ours)])

    def test_a_triangle_is_counted_once_and_an_empty_picture_has_its_note(self):
        # Two are right of the window, which project finds, too, and one is in sight.
        scene = ("0 0 5\n0 0 0\n0 1 0\n60 1 1 100\ntriangle\n-1 0 0\n1 0 0\n0 1 0\ntranslate\n100 0 0\n" +
                 "triangle\n-1 0 0\n1 0 0\n0 1 0\n" * 2 + "end\n")
        for text, shown, outside in (scene, 1, 2), (SCENE.replace("triangle", "translate\n0 0 30\ntriangle",
                                                                  1), 0, 3):
            self.load_text(text)
            self.assertEqual("the picture is empty" in self.js("return text('#notes')"), not shown)
            self.assertEqual(self.js("return texts('#legend li')"),
                             [f"{shown} shown", "0 hidden", f"{outside} outside", "0 culled"])

    def rows(self):
        return self.js("return cells('#counts tbody tr')")

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
        zbuf = {
            key: word
            for key, word in told["zbuf"].items()
            if word != "0" and key != "triangles" and key[:2] not in ("x_", "y_", "z_")}
        self.assertEqual(rows["zbuf"][5], ", ".join(
            f"{word} {key.replace('_', ' ')}" for key, word in zbuf.items()))
        self.assertIn("seen", rows["zbuf"][5])
        for tool, row in rows.items():
            for axis, cell in zip("xyz", row[6:]):
                self.assertEqual(
                    [float(word) for word in cell.split(" to ")],
                    [float("%.4g" % float(told[tool][f"{axis}_{end}"])) for end in ("min", "max")])

    def points_out_of_sight(self, tool, guide="wire.guide.flat()"):
        """Corners of the guide and of the triangles that no pixel of the pane shows at first."""
        return self.browser.run(
            "const wire = document.body.inspector.panels[['model', 'view', "
            "'project'].indexOf(arguments[0])].wire, lost = [];"
            f"const points = {guide}; for (let i = 0; i < wire.stage.points.length; i += 3) "
            f"points.push([...wire.stage.points.slice(i, i + 3)]);"
            "for (const p of points) { const [x, y] = wire.view.place(...p); if (x < 0 || y < 0 || x > "
            "wire.canvas.width || y > wire.canvas.height) lost.push(p); }"
            "return lost", tool)

    def test_all_that_is_there_is_in_sight(self):
        scenes = {
            "own": SCENE,
            "beside": SCENE.replace("triangle", "translate\n4 3 0\ntriangle", 1),
            "empty": SCENE[:SCENE.index("triangle")] + "end\n",
            "behind": SCENE.replace("triangle", "translate\n0 0 30\ntriangle", 1),
            "ortho": SCENE.replace("60 1 1 100", "ortho -1 1 -1 1 -5 5"),}
        for name, scene in scenes.items():
            self.load_text(scene)
            for tool in ("model", "view", "project"):
                with self.subTest(scene=name, tool=tool):
                    self.assertEqual(self.points_out_of_sight(tool), [])

    def test_every_triangle_of_a_large_scene_is_there(self):
        """Scenes up to MAX_DRAWN_TRIANGLES differ only in their number from this one."""
        scene = run_script("make-torus", "--around", "60", "--tube", "50").stdout
        pathlib.Path("large.txt").write_text(scene)
        pathlib.Path("config.txt").write_text("42 42\n")
        self.load("large.txt", "config.txt")
        self.assertEqual(self.js("return panels.map(panel => panel.wire.names.length)"), [12000] * 3)
        scale = self.js("return inspector.pixels.scale")
        self.browser.click("#image", 20.5 * scale, 20.5 * scale)
        told = run("zbuf", "config.txt", "--image", "out.ppm", "--probe", "20,20",
                   stdin=stage_texts(scene)[2]).stderr.decode().splitlines()
        self.assertEqual(len(self.competitors()), len(told))
        # The index finds what a look at every triangle finds.
        lost = self.js("const {wire} = panels[1], lost = []; let x = 17;for (let k = 0; k < 25; ++k) { x = "
                       "x * 48271 % 2147483647; const px = x % wire.canvas.width; x = x * 48271 % "
                       "2147483647; const py = x % wire.canvas.height;  const found = wire.triangleAt(px, "
                       "py); let best = -1, nearest = -Infinity;  wire.names.forEach((name, i) => { const "
                       "near = wire.near[3 * i] + wire.near[3 * i + 1] + wire.near[3 * i + 2];    if (near "
                       "> nearest && wire.index.contains(i, px, py)) [best, nearest] = [name, near]; });  "
                       "lost.push([found, best]); } return lost")
        self.assertTrue(any(best >= 0 for _, best in lost))
        self.assertEqual([found for found, _ in lost], [best for _, best in lost])

    # The eye looks along -x at a mirror in the plane x = 0, in which it sees a triangle behind itself, at x =
    # 8.
    MIRROR = (
        "5 0 0\n0 0 0\n0 1 0\n60 1 1 100\ncolor 9 9 9\nmaterial 1 1 0 1 1 1 1\nmaterial 1 1 0 1\nuse 0\n"
        "triangle\n0 -9 9\n0 -9 -9\n0 9 0\n"
        "use 1\ncolor 10 200 30\ntriangle\n8 -3 -3\n8 -3 3\n8 3 0\nend\n")

    def load_mirror(self, size):
        self.load_text(self.MIRROR, size, "--trace")
        self.js("one('#tab-rays').click()")

    def ray_rows(self):
        return self.js("return cells('#rays tbody tr')")

    def test_the_rays_of_a_pixel_are_told_and_drawn(self):
        self.load_mirror(41)
        self.js("choose(20 * 41 + 20)")
        self.assertEqual(self.ray_rows(), [["primary", "triangle 0 front", "1", "10 200 30"],
                                           ["mirrored", "triangle 1 front", "1", "10 200 30"]])
        drawn = self.js("return panels.map(({wire}) => wire.rays)")
        self.assertEqual([[ray["kind"] for ray in rays] for rays in drawn],
                         [["primary", "mirrored"]] * 2 + [[]])
        for rays, places in zip(drawn, ([(5, 0, 0), (0, 0, 0), (0, 0, 0), (8, 0, 0)], [(0, 0, 0), (0, 0, -5),
                                                                                       (0, 0, -5),
                                                                                       (0, 0, 3)])):
            for found, expected in zip([place for ray in rays for place in (ray["from"], ray["to"])], places,
                                       strict=True):
                for x, y in zip(found, expected, strict=True):
                    self.assertAlmostEqual(x, y, 9)
        # Behind the eye, at x = 6.5 in the world, there is nothing but the mirrored ray; without a pixel it
        # is gone.
        color = (
            "const {wire} = panels[0], [x, y] = wire.view.place(6.5, 0, 0);"
            "return [...wire.mark.getContext('2d').getImageData(Math.floor(x), Math.floor(y), 1, 1).data]")
        blue = bytes.fromhex(self.js("return inspector.palette.word('--ray-mirrored')")[1:])
        for found, expected in zip(self.js(color), [*blue, 255]):
            self.assertAlmostEqual(found, expected, delta=40)
        self.js("all('#rays td button')[1].click()")
        self.assertEqual(self.held(), [1, 20 * 41 + 20])
        self.assertEqual(self.js("return all('#rays .hot').map(row => row.dataset.name)"), ["1"])
        self.js("select(-1, -1)")
        self.assertEqual((self.ray_rows(), self.js(color)[3]), ([], 0))

    def test_a_ray_that_leaves_the_scene_fades_on_its_way(self):
        self.load_mirror(41)
        # In the upper left corner the mirror shows no triangle. The eye looks along -x, and -z is to its
        # right.
        half = 40 / 41 * math.tan(math.radians(30))
        origin, way = (0, 5 * half, 5 * half), (1, half, half)
        found = self.js("inspector.show({triangle: -1, pixel: 0}); const "
                        "{wire} = panels[0], [, ray] = wire.rays;const reach = wire.view.size / 2, tone = "
                        "share => { const [x, y] = wire.view.place(...ray.from.map((at, i) => at + share * "
                        "reach * (ray.towards[i] - at))); return "
                        "wire.mark.getContext('2d').getImageData(Math.floor(x), Math.floor(y), 1, "
                        "1).data[3]; };return [ray.from, ray.towards, ray.to, [0.1, 0.5, 0.9, "
                        "1.1].map(tone)]")
        for x, y in zip(found[0] + found[1],
                        [*origin, *(at + step / math.hypot(*way) for at, step in zip(origin, way))],
                        strict=True):
            self.assertAlmostEqual(x, y, 9)
        self.assertIsNone(found[2])
        self.assertEqual(sorted(found[3], reverse=True), found[3])
        self.assertGreater(found[3][0], 200)
        self.assertGreater(found[3][2], 0)
        self.assertEqual(found[3][3], 0)
        self.assertEqual(self.ray_rows()[1][:2], ["mirrored", "nothing"])

    def test_a_sphere_is_drawn_and_can_be_chosen(self):
        # An ellipsoid whose half axes are 2, 1 and 1, at the point looked at, in front of a triangle.
        scene = ("0 0 9\n0 0 0\n0 1 0\n60 1 1 100\ncolor 9 9 9\npush\nscale 2 1 1\nsphere 0 0 0 1\npop\n"
                 "triangle\n-8 -8 -9\n8 -8 -9\n0 8 -9\nend\n")
        self.load_text(scene, 41, "--trace")
        self.assertEqual(self.js("return text('#title')"),
                         "scene.txt: 1 triangle and 1 sphere, 41 × 41 pixels")
        self.assertRegex(self.js("return text('#notes')"),
                         r"^project and zbuf have \d+ triangles for each sphere")
        # Its outline, seen from the front: an ellipse twice as wide as high, inside of which the pointer
        # finds it.
        front = ("const {wire} = panels[arguments[0]], {spheres} = wire.stage; Object.assign(wire.view, "
                 "{yaw: 0, pitch: 0}); wire.draw(); const at = (x, y) => "
                 "wire.triangleAt(...wire.view.place(x, y, arguments[1]));")
        for panel, z in ((0, 0), (1, -9)):
            found, places = self.js(
                front + "const scale = wire.view.place(1, 0, 0)[0] - wire.view.place(0, 0, 0)[0]; return "
                "[[at(1.95, 0), at(0, 0.95), at(1.4, 0.69), at(2.05, 0), at(0, 1.05), at(1.43, 0.72)], "
                "spheres.outline(0).map(([x, y]) => [x - spheres.x[0], y - spheres.y[0]].map(d => d / scale"
                "))]", panel, z)
            self.assertEqual(found, [0, 0, 0, 1, 1, 1])
            for x, y in places:
                self.assertAlmostEqual(x * x / 4 + y * y, 1, 9)
        # Its four lines are marked, a line chooses it, and the middle of the picture shows it.
        self.js("choose(20 * 41 + 20); one('#tab-texts').click()")
        self.assertEqual(self.held()[0], 0)
        model = pipe(["model"], stdin=scene).decode().split("\n")
        first = model.index("sphere") + 2
        self.assertEqual(self.hot_lines("model"), [[n, model[n - 1]] for n in range(first, first + 4)])
        self.assertEqual(
            self.js("return [0, 3, 4].map(k => panels[0].stage.nameOfLine(arguments[0] + k))", first),
            [0, 0, -1])
        self.assertRegex(self.js("return text('[role=status]')"),
                         r"^row 20, column 20: sphere 0, depth [\d.]+: shown in \d+ pixels$")
        self.assertEqual(self.ray_rows()[0][1], "sphere 0 front")
        self.browser.press("#wire-model", RIGHT)
        self.assertEqual(self.held(), [1, -1])
        self.browser.press("#wire-model", LEFT)
        self.assertEqual(self.held(), [0, -1])
        self.js("one('#tab-explanation').click()")
        self.assertIn("draw no spheres", self.js("return text('#explanation')"))

    def test_the_picture_is_traces_and_the_note_of_zbuf_is_left_out(self):
        self.load_mirror(41)
        self.assertNotIn("matt", self.js("return text('#notes')"))
        pipe(["model"], ["view"], ["trace", "config.txt", "--image", "out.ppm"], stdin=self.MIRROR)
        shown = self.js("return inspector.data.pixels")
        self.assertTrue(pathlib.Path("out.ppm").read_bytes().endswith(base64.b64decode(shown)))
        found = self.browser.accessibility()
        for role, name in (("tab", "Rays"), ("columnheader", "meets")):
            self.assertTrue(any(role == r and n.startswith(name) for r, n in found),
                            f"no {role} named {name}")

    def test_in_a_large_scene_the_pixel_is_explained_beside_the_command_for_the_rest(self):
        scene = run_script("make-torus", "--around", "25", "--tube", "11").stdout
        pathlib.Path("large.txt").write_text(scene)  # 1,100 triangles
        pathlib.Path("config.txt").write_text("42 42\n")
        self.load("large.txt", "config.txt")
        self.js("one('#tab-explanation').click(); choose(20 * 42 + 20)")
        name, _ = self.held()
        self.assertIn(f"pipeline explain large.txt config.txt --triangle {name} --pixel 20,20",
                      self.js("return text('#explanation')"))
        told = run_script("explain", "large.txt", "config.txt", "--triangle", name, "--pixel", "20,20").stdout
        shown = self.js("return text('#explanation pre + pre')") + "\n"
        begin, end = told.index("PIXEL"), told.index(
            "  at this pixel")  # explain leaves out fragments beyond its 60 lines
        self.assertEqual(shown[:end - begin], told[begin:end])
        self.assertEqual((shown.splitlines()[-1], shown.count(" depth ")),
                         (told.splitlines()[-1], len(self.competitors()) + told[begin:end].count(" depth ")))

    def test_a_background_with_an_alpha_is_no_obstacle(self):
        self.load_text(SCENE.replace("triangle", "background 200 100 50 128\ntriangle", 1))

    def test_a_scene_too_large_is_thinned_and_says_so(self):
        sys.path.insert(0, str(SOURCE / "scripts"))
        from inspect_parts import inspection
        program = (
            "import sys; sys.path.insert(0, sys.argv[1]); sys.dont_write_bytecode = True; sys.argv[1:] = "
            "['scene.txt', 'config.txt', '-o', 'page.html']\n"
            "from importlib.machinery import SourceFileLoader as Loader; from inspect_parts import "
            "inspection; inspection.MAX_DRAWN_TRIANGLES = 1\n"
            "Loader('__main__', sys.path[0] + '/inspect').load_module()")
        self.assertGreaterEqual(inspection.MAX_DRAWN_TRIANGLES, 100000)
        pathlib.Path("scene.txt").write_text(SCENE)
        pathlib.Path("config.txt").write_text("40 40\n")
        subprocess.run([sys.executable, "-c", program, SOURCE / "scripts"], check=True, env={
            "BIN": str(BIN), "PATH": "/usr/bin:/bin"})
        self.browser.open(pathlib.Path("page.html").resolve())
        self.browser.wait_for(lambda: self.js("return document.body.dataset.ready") == "yes")
        self.assertIn("Of 3 triangles one in 3 is drawn", self.js("return text('#notes')"))
        self.assertEqual(self.js("return [...panels[0].stage.points]"), [-2, 0, 0, -1, 0, 0, -2, 1, 0])


if __name__ == "__main__":
    unittest.main()
