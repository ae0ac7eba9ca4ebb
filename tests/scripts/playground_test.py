"""The playground: its tools are the native ones to the byte, and the page shows what they write."""
import base64
import collections
import http.server
import io
import json
import os
import pathlib
import re
import shlex
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import unittest
import urllib.request
import zipfile

BIN, ROOT = (pathlib.Path(word).resolve() for word in sys.argv[1:3])

import firefox
from browser import MISSING, Browser
from conform_parts.cases import read_cases
from conform_parts.pages import CONFIG
from lib.text.scene import ARGUMENT_LINES

BUILT = ROOT / "build/playground"
STAGES, TRACED = ("model", "view", "project", "zbuf"), ("model", "view", "trace")
WITHOUT_PNG = b" (and this build is without libpng, which .png needs)"


def letters(data):
    return base64.b64encode(data).decode()


def run_of(tool, words, data, files=None, reads=()):
    return {
        "tool": tool, "words": [*words], "input": data, "files": files or {}, "reads": [*reads], "isPiped": [
            False, False]}


def runs_of_pack():
    """Every case of the pack, and each of zbuf by both rules."""
    for stage in STAGES:
        for case in read_cases(stage):
            options = case.read("options.txt").decode() if case.has("options.txt") else ""
            words = shlex.split(options)
            if stage != "zbuf":
                scene = {name: case.read(name) for name in ["scene.txt"] if case.has(name)}
                yield run_of(stage, words, case.read("input.txt"), scene)
                continue
            config = case.read("config.txt") if case.has("config.txt") else CONFIG
            for rule in ("nearest", "center"):
                yield run_of(stage, ["config.txt", "--coverage", rule, *words], case.read("input.txt"),
                             {"config.txt": config}, ["out.bmp"])


def runs_of_samples():
    """Every sample through the pipe by the native tools, each stage with all that it can write."""
    for folder in sorted(path.parent for path in (ROOT / "samples").glob("*/scene.txt")):
        data, config = (folder / "scene.txt").read_bytes(), (folder / "config.txt").read_bytes()
        for tool in STAGES[:3]:
            yield run_of(tool, ["--stats", "counts.txt"], data, reads=["counts.txt"])
            yield run_of(tool, ["--digits", "exact"], data)
            if tool == "view":
                yield run_of("trace", ["config.txt"],
                             subprocess.run([BIN / tool], input=data, capture_output=True, check=True).stdout,
                             {"config.txt": config}, ["out.bmp"])
            done = subprocess.run([BIN / tool], input=data, capture_output=True, check=False)
            if done.returncode != 0:
                break
            data = done.stdout
        else:
            for words in ([], ["--samples", "3", "-o", "out.ppm"], ["--wireframe"], [
                    "--algorithm", "scanline"], ["--fragments", "fragments.txt", "--stats", "counts.txt"]):
                yield run_of("zbuf", ["config.txt", *words], data, {"config.txt": config},
                             ["out.bmp", "out.ppm", "fragments.txt", "counts.txt"])


MODEL = {
    "a.obj": b"mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n",
    "a.mtl": b"newmtl red\nKd 1 0 0\n"}


def models():
    """A model of every format."""
    for kind in ("obj", "ply", "stl", "gltf"):
        words = [ROOT / "scripts/make-model", "room", "--detail", "2", "--format", kind]
        data = subprocess.run(words, capture_output=True, check=True).stdout
        yield f"room.{kind}", data
    size = len(data)
    yield "room.glb", struct.pack("<4s3I4s", b"glTF", 2, 20 + size, size, b"JSON") + data


def native(run):
    """A native tool's result for a run."""
    with tempfile.TemporaryDirectory() as folder:
        for name, data in run["files"].items():
            (pathlib.Path(folder) / name).write_bytes(data)
        with tempfile.TemporaryFile() as given, tempfile.TemporaryFile() as output:
            given.write(run["input"])
            given.seek(0)
            done = subprocess.run([BIN / run["tool"], *run["words"]], stdin=given, stdout=output,
                                  stderr=subprocess.PIPE, cwd=folder, check=False)
            output.seek(0)
            files = {name: pathlib.Path(folder) / name for name in run["reads"]}
            return {
                "status": done.returncode, "output": letters(output.read()), "messages": letters(done.stderr),
                "written": {
                    name: letters(path.read_bytes()) if path.exists() else None
                    for name, path in files.items()}}


def in_letters(runs):
    return [{
        **run, "input": letters(run["input"]), "files": {
            name: letters(data)
            for name, data in run["files"].items()}} for run in runs]


def check_answers(case, runs, answers):
    case.assertEqual(len(answers), len(runs))
    for run, answer in zip(runs, answers):
        with case.subTest(tool=run["tool"], words=run["words"], input=run["input"][:80]):
            told = base64.b64decode(answer["messages"]).replace(WITHOUT_PNG, b"")
            case.assertEqual({**answer, "messages": letters(told)}, native(run))


FILES = ("LICENSES.txt", "index.html", "main.js", "mesh2scene.bin", "texts.bin", "tools.bin", "worker.bin")
NOT_BUILT = "scripts/build-playground has not run here"


@unittest.skipUnless((BUILT / "wasm/bin/all-tools.wasm").exists(), NOT_BUILT)
@unittest.skipUnless(shutil.which("node"), "node is missing")
class TheBuild(unittest.TestCase):
    """Where the page goes."""
    def build(self, folder):
        words = [
            ROOT / "scripts/playground/build.mjs", BUILT / "npm", BUILT / "wasm/bin", "1.0.0", folder,
            BUILT / "THIRD-PARTY"]
        return subprocess.run(["node", *words], capture_output=True, text=True, timeout=60)

    def test_what_is_in_the_way_stays(self):
        def link(path):
            path.symlink_to("elsewhere")

        def write(path):
            path.parent.mkdir(exist_ok=True)
            path.write_text("mine")

        def beside_a_page(path):
            write(path / "constructor")
            (path / "index.html").write_text("<title>Pipeline playground</title>")

        for name, make in (("playground.html", link), ("playground.html", os.mkfifo), ("playground", link),
                           ("playground.html", write), ("playground", lambda path: write(path / "mine.txt")),
                           ("playground", lambda path: write(path / "index.html")),
                           ("playground", beside_a_page), ("playground", lambda path:
                                                           (path / "worker.bin").mkdir(parents=True))):
            with tempfile.TemporaryDirectory() as folder:
                make(pathlib.Path(folder, name))
                before = sorted(pathlib.Path(folder).rglob("*"))
                done = self.build(folder)
                self.assertEqual(
                    (done.returncode, done.stdout, done.stderr),
                    (1, "", f"build-playground: {folder}/{name} is in the way, and none of this page's\n"))
                self.assertEqual(sorted(pathlib.Path(folder).rglob("*")), before)

    def test_an_earlier_page_is_replaced(self):
        with tempfile.TemporaryDirectory() as folder:
            for _ in range(2):
                self.assertEqual(self.build(folder).returncode, 0)
            licenses = pathlib.Path(folder, "playground/LICENSES.txt").read_text()
            for part in ("@codemirror/view", "cli11", "emscripten", "highway", "llvm-toolchain",
                         "nlohmann-json3"):
                self.assertRegex(licenses, rf"\n  {part}\S* \S+\n")
            self.assertIn("system/lib/libc/musl/*", licenses)
            names = sorted(str(path.relative_to(folder)) for path in pathlib.Path(folder).rglob("*"))
            self.assertEqual(names,
                             ["playground", "playground.html", *(f"playground/{name}" for name in FILES)])


class TheEditor(unittest.TestCase):
    @unittest.skipUnless(shutil.which("node"), "node is missing")
    def test_a_mistake_is_one_of_the_table_and_none_is_right(self):
        script = (
            "import {MISTAKES, codeOf} from './scripts/playground/mistakes.js'; const codes = Object.keys("
            "MISTAKES).map(name => [name, codeOf(name)]); console.log(JSON.stringify(codes))")
        done = subprocess.run(["node", "--input-type=module", "-e", script], cwd=ROOT, capture_output=True,
                              text=True, check=True)
        codes = dict(json.loads(done.stdout))
        table = (ROOT / "tests/conformance/mistakes.txt").read_text()
        for name in codes:
            self.assertRegex(table, f"(?m)^(judge )?{name}: ")
        # All differ from each other, so that none is the stage which is right but for one.
        self.assertEqual(len(set(codes.values())), len(codes))


def serve(case, folder):
    """A server of a folder that lets anybody in, until the test case ends: its address, and what it is asked
    for."""
    asked = []

    class Handler(http.server.SimpleHTTPRequestHandler):
        def __init__(self, *words):
            super().__init__(*words, directory=folder)

        def end_headers(self):
            self.send_header("Access-Control-Allow-Origin", "*")
            super().end_headers()

        def log_message(self, _, *words):
            asked.append(str(words[0]))

    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    case.addCleanup(server.server_close)
    case.addCleanup(server.shutdown)
    return f"http://127.0.0.1:{server.server_port}/", asked


SET = "const page = document.body.playground; page.state = {...page.state, ...arguments[0]};"
IS_DONE = """const {client, inspector} = document.body.playground;
return client.running === null && !client.next && !client.isPending && inspector &&
  !document.querySelector(".stale");"""
IMAGE = """const canvas = document.querySelector("#image"), [w, h] = [canvas.width, canvas.height];
const data = canvas.getContext("2d").getImageData(0, 0, w, h).data;
return [w, h, [...data].filter((_, i) => i % 4 < 3).map(x => x.toString(16).padStart(2, "0")).join("")];"""


@unittest.skipUnless((BUILT / "site/playground.html").exists(), NOT_BUILT)
@unittest.skipIf(MISSING, f"missing: {' '.join(MISSING)}")
class PageTest(unittest.TestCase):
    """A page that is open: the single file, from the disk."""

    BROWSER = Browser

    @classmethod
    def setUpClass(cls):
        cls.browser = cls.BROWSER(1400, 900)

    @classmethod
    def tearDownClass(cls):
        cls.browser.__exit__()

    def setUp(self):
        self.open("")
        self.choose("worked-example")

    def choose(self, name):
        self.browser.run("document.body.playground.choose(arguments[0])", name)
        self.browser.wait_for(lambda: self.browser.run(IS_DONE))

    def tearDown(self):
        # A run that ends now keeps nothing for the next test.
        self.browser.run("Object.assign(document.body.playground, {keep: () => true}); "
                         "sessionStorage.clear(); localStorage.clear()")
        self.browser.open("/dev/null")

    def open(self, hash_, site="site"):
        self.browser.open(f"{BUILT / site / 'playground.html'}{hash_}")
        self.browser.wait_for(lambda: self.browser.run("return document.body.dataset.runs"))

    def edit(self, **state):
        """Sets parts of the state, and waits until what the page shows is of it."""
        self.browser.run(SET, state)
        self.browser.wait_for(lambda: self.browser.run(IS_DONE))

    def messages(self):
        return self.browser.run("return document.querySelector('#messages').innerText")

    def picture_of(self, scene, config, *words, stages=STAGES):
        """The picture as the native tools draw it: columns, rows, and the pixels' bytes as words."""
        *before, last = stages
        text = subprocess.run(" | ".join(f"{BIN}/{stage}" for stage in before), input=scene, shell=True,
                              capture_output=True, check=True).stdout
        with tempfile.NamedTemporaryFile() as file:
            file.write(config)
            file.flush()
            data = subprocess.run([BIN / last, file.name, "-o", "-", *words], input=text, capture_output=True,
                                  check=True).stdout
        head, pixels = data.split(b"\n255\n", 1)
        return [*map(int, head.split()[1:3]), pixels.hex()]

    def sample(self, name):
        return [(ROOT / "samples" / name / file).read_bytes() for file in ("scene.txt", "config.txt")]

    OWN = """document.querySelector("#own").open = true;
      for (const [id, word] of Object.entries(arguments[0])) document.querySelector(id).value = word;
      document.querySelector("#own-anew").click();
      if (arguments[1]) document.body.playground.own.editor.text = arguments[1];
      document.querySelector("#own-run").click();"""
    TOLD = """const told = document.querySelector("#theirs p"), {own} = document.body.playground;
      return [own.stage ? "" : document.querySelector("#own-told").innerText, told ? told.innerText : ""];"""
    NEWS = "return document.querySelector('#told').innerText"
    VERDICT = "return document.querySelector('#own-told').innerText"
    TYPE = """const {view} = arguments[0] === "own" ? document.body.playground.own.editor :
        document.body.playground.editors[arguments[0]];
      view.dispatch({changes: {from: 0, insert: arguments[1]}});"""  # as a reader's edit

    def own(self, tool, code="", kind="js"):
        """The page's word on a stage of one's own, when it has run, after any other."""
        self.browser.run("document.body.playground.own.set(null)")
        self.browser.wait_for(lambda: not any(self.browser.run(self.TOLD)))
        self.browser.run(self.OWN, {"#own-tool": tool, "#own-kind": kind}, code)
        self.browser.wait_for(lambda: any(self.browser.run(self.TOLD)))
        return self.browser.run(self.TOLD)

    DROP = """const dataTransfer = new DataTransfer();
      for (const [name, letters] of arguments[0]) {
        const bytes = Uint8Array.from(atob(letters), letter => letter.charCodeAt(0));
        dataTransfer.items.add(new File([bytes], name));
      }
      document.dispatchEvent(new DragEvent("drop", {dataTransfer}));"""

    def drop(self, **files):
        """Drops files, {name: bytes}."""
        self.browser.run(self.DROP, [[name, letters(data)] for name, data in files.items()])

    @unittest.skipUnless((BIN / "mesh2scene").exists(), "built without PIPELINE_MODELS")
    def test_a_model_is_dropped_with_its_colors(self):
        for name, files in (("a.obj", MODEL), *((name, {name: data}) for name, data in models())):
            self.drop(**files)
            with tempfile.TemporaryDirectory() as folder:
                for file, data in files.items():
                    pathlib.Path(folder, file).write_bytes(data)
                done = subprocess.run([BIN / "mesh2scene", "--size", "800x600", name], cwd=folder, check=True,
                                      capture_output=True, text=True)
            scene = "return document.body.playground.state.scene"
            self.browser.wait_for(lambda: self.browser.run(scene) == done.stdout)
            self.assertEqual(self.browser.run(self.NEWS).split(), done.stderr.split())
            self.browser.wait_for(lambda: self.browser.run(IS_DONE))
            self.assertEqual(self.browser.run(IMAGE),
                             self.picture_of(done.stdout.encode(), b"800 600\n", "--coverage", "center"))
        self.drop(**{"a.stl": b"solid"})
        self.browser.wait_for(lambda: "a.stl" in self.browser.run(self.NEWS))

    def check_the_native_picture(self):
        scene, config = self.sample("shaded-torus")
        self.edit(scene=scene.decode(), config=config.decode())
        self.assertEqual(self.browser.run(IMAGE), self.picture_of(scene, config))
        words = {"model": "", "view": "", "project": "", "zbuf": "--shading flat --samples 2"}
        self.edit(words=words)
        self.assertEqual(self.browser.run(IMAGE), self.picture_of(scene, config, *words["zbuf"].split()))
        self.assertIn("| zbuf --shading flat --samples 2 config.txt",
                      self.browser.run("return document.body.playground.line.text"))


class ThePage(PageTest):
    """All that it does."""
    RUNS = """const bytes = letters => Uint8Array.from(atob(letters), letter => letter.charCodeAt(0));
      const letters = data => btoa(Array.from(data, byte => String.fromCharCode(byte)).join(""));
      const {client} = document.body.playground, answers = [];
      for (const {reads, ...run} of arguments[0]) {
        const files = Object.entries(run.files).map(([name, data]) => [name, bytes(data)]);
        const single = {...run, input: bytes(run.input), files: Object.fromEntries(files)};
        const {status, output, messages, written: all} = await client.ask({single});
        const read = reads.map(name => [name, all.has(name) ? letters(all.get(name)) : null]);
        const written = Object.fromEntries(read);
        answers.push({status, output: letters(output), messages: letters(messages), written});
      }
      return answers;"""

    def check_the_pack_and_the_samples(self):
        script = f"return (async () => {{ {self.RUNS.replace('arguments', 'given')} }})()"
        runs = [*runs_of_pack(), *runs_of_samples()]
        for at in range(0, len(runs), 10):
            some = runs[at:at + 10]
            check_answers(self, some, self.browser.run(f"const given = arguments; {script}",
                                                       in_letters(some)))

    def test_the_pack_and_the_samples_are_those_of_the_native_tools(self):
        self.check_the_pack_and_the_samples()

    @unittest.skipUnless((BUILT / "plain/playground.html").exists(), f"{NOT_BUILT} with --plain")
    def test_they_are_the_same_without_simd(self):
        self.tearDown()
        self.open("", "plain")
        self.check_the_pack_and_the_samples()

    def test_it_shows_the_native_picture(self):
        self.check_the_native_picture()

    def test_trace_draws_in_place_of_project_and_zbuf(self):
        """Spheres, too; they have facets in the panels."""
        scene = (b"0 1 5\n0 0 0\n0 1 0\n45 1 1 20 ratio\nlight 3 4 5 1 1 1\nsphere 0 0 0 1\ntriangle\n"
                 b"-3 -1 3\n3 -1 3\n0 -1 -4\nend\n")
        words = {"model": "", "view": "", "project": "", "zbuf": "", "trace": "--samples 2"}
        self.edit(scene=scene.decode(), config="30 30\n", words=words)
        self.assertEqual(self.messages(), "none")
        self.assertEqual(self.browser.run("return document.body.playground.line.text"),
                         "model < scene.txt | view | trace --samples 2 config.txt")
        self.assertEqual(self.browser.run(IMAGE),
                         self.picture_of(scene, b"30 30\n", "--samples", "2", stages=TRACED))
        self.assertIn("1 sphere", self.browser.run("return document.querySelector('#title').innerText"))

    def test_a_mistake_has_the_tools_own_message_at_its_line(self):
        scene, _ = self.sample("worked-example")
        self.browser.run(SET, {"scene": scene.decode().replace("rotate", "rotat")})
        self.browser.wait_for(lambda: "did you mean rotate?" in self.messages())
        self.assertIn("scene.txt:9:3:", self.messages())
        marks = self.browser.run("return document.querySelectorAll('.cm-lint-marker-error').length")
        self.assertEqual(marks, 1)
        self.assertTrue(self.browser.run("return document.querySelector('#glass').matches('.stale')"))

    def test_a_black_picture_says_why(self):
        scene, _ = self.sample("worked-example")
        self.edit(scene=scene.decode().replace("0 0 0           # look", "0 0 9           # look"))
        self.assertIn("behind", self.messages())

    def test_a_link_holds_the_whole_state(self):
        scene, config = self.sample("nested-transforms")
        words = {"model": "--digits 3", "view": "", "project": "--cull back", "zbuf": "--coverage center"}
        self.edit(scene=scene.decode() + "# é <script>alert(1)</script>\n", config=config.decode(),
                  words=words)
        self.browser.run("document.body.playground.copyLink()")
        self.browser.wait_for(lambda: self.browser.run("return location.hash"))
        state, shown, hash_ = (self.browser.run(script)
                               for script in ("return document.body.playground.state", IMAGE,
                                              "return location.hash"))
        self.tearDown()
        self.open(hash_)
        self.assertEqual(self.browser.run("return document.body.playground.state"), state)
        self.assertEqual(self.browser.run(IMAGE), shown)
        self.tearDown()
        self.open("#p=AAAA")
        self.browser.wait_for(lambda: "cannot be read" in self.browser.run(self.NEWS))

    def test_an_edit_can_be_undone(self):
        self.browser.run(self.TYPE, "scene", "# 45 0 0 1\n")
        self.edit(scene="0 0 2\n0 0 0\n0 1 0\n60 1 1 10\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n")
        self.browser.press("#scene .cm-content", "\ue009z")
        self.browser.wait_for(
            lambda: "45 0 0 1" in self.browser.run("return document.body.playground.state.scene"))

    def test_work_outlives_its_tab_and_all_stages_of_ones_own(self):
        state = "const {version, ...state} = document.body.playground.state; return state"
        self.browser.run(self.TYPE, "scene", "# mine\n")
        pick = "const tool = document.querySelector('#own-tool'); tool.value = arguments[0]; tool.onchange()"
        for tool in ("view", "zbuf"):
            self.browser.run(pick, tool)
            self.browser.run(self.TYPE, "own", f"// my {tool}\n")
        kept = self.browser.run(state)
        self.assertIn("// my view", kept["others"][0]["text"])
        self.browser.run(pick, "view")
        self.assertIn("// my view", self.browser.run("return document.body.playground.own.editor.text"))
        self.browser.open("/dev/null")
        self.open("")
        kept = self.browser.run(state)
        self.browser.run("sessionStorage.clear(); document.body.playground.keep = () => true")
        self.browser.open("/dev/null")
        self.open("")
        self.assertEqual(self.browser.run(state), kept)
        self.assertIn("# mine", kept["scene"])
        self.assertEqual([kept["mine"]["tool"], kept["others"][0]["tool"]], ["view", "zbuf"])
        # A sample that is looked at does not take its place, neither does a stranger's link.
        self.choose("two-triangles")
        self.assertIn("// my zbuf", self.browser.run("return JSON.stringify(localStorage)"))

    def test_a_page_that_cannot_keep_its_work_asks(self):
        leave = ("const event = new Event('beforeunload', {cancelable: true}); "
                 "return [window.dispatchEvent(event), event.defaultPrevented][1]")
        self.assertFalse(self.browser.run(leave))
        self.browser.run(self.TYPE, "scene", "# mine\n")
        self.assertFalse(self.browser.run(leave))
        self.browser.run(self.TYPE, "scene", ("#" * 99 + "\n") * 60000)
        self.assertTrue(self.browser.run(leave))
        self.browser.run("document.body.playground.isWork = false")

    def test_a_link_from_a_file_says_so_and_offers_the_file(self):
        self.browser.run("document.querySelector('#link').click()")
        self.browser.wait_for(lambda: "on this computer only" in self.browser.run(self.NEWS))
        self.browser.run("document.querySelector('#told button').click()")
        self.assertEqual(self.browser.run(self.NEWS), "Saved as playground.json.")

    def test_what_is_neither_scene_nor_model_replaces_nothing(self):
        before = self.browser.run("return document.body.playground.state")
        for name, data in (("a.fbx", b"Kaydara FBX Binary"), ("scene.txt", b"hello"),
                           ("config.png", b"\x89PNG"), ("a.json", b"{}"), ("empty.txt", b"")):
            self.drop(**{name: data})
            self.browser.wait_for(lambda: f"{name} cannot be read: it is no" in self.browser.run(self.NEWS))
        self.assertEqual(self.browser.run("return document.body.playground.state"), before)
        self.drop(**dict(zip("ab", self.sample("tilted-camera"))))
        scene, config = (data.decode() for data in self.sample("tilted-camera"))
        self.browser.wait_for(lambda: self.browser.run(IS_DONE) and self.browser.run(
            "const {scene, config} = document.body.playground.state; return [scene, config]") == [
                scene, config])

    def test_it_opens_with_glass_and_the_worked_example_is_a_click_away(self):
        self.tearDown()
        self.open("")
        scene, _ = self.sample("glass-and-mirrors")
        self.assertEqual(self.browser.run(IMAGE), self.picture_of(scene, b"320 240\n", stages=TRACED))
        self.browser.run("document.querySelector('#example').click()")
        self.browser.wait_for(lambda: self.browser.run(IS_DONE) and self.browser.run(IMAGE)[0] == 10)

    def test_the_language_stands_beside_the_editor_and_has_its_pages(self):
        self.browser.run("document.querySelector('#words').click()")
        words = self.browser.run("return [...document.querySelectorAll('#language code')].map(code => "
                                 "code.innerText.split(' ')[0])")
        commands = {word for word in words if word.islower()} - {"ratio", "frustum", "ortho"}
        self.assertEqual(commands, set(ARGUMENT_LINES))
        self.assertLess(*self.browser.run("return ['#language', '#glass'].map(name => "
                                          "document.querySelector(name).getBoundingClientRect().left)"))
        titles = self.browser.run("return [...document.querySelectorAll('#pages a')].map(a => a.innerText)")
        self.assertEqual(len(titles), 5)
        where = self.browser.run("return document.querySelector('#pages a').href")
        self.browser.run("location.href = arguments[0]", where)
        page = (ROOT / "docs/scene.md").read_text()
        self.browser.wait_for(lambda: self.browser.run("return document.body.innerText") == page)
        self.open("")

    MADE = """const {data, panels} = document.body.playground.inspector;
      const texts = data.stages.filter(({text}) => text.split("\\n").length > 40);
      const drawn = panels.filter(({wire: {canvas}}) =>
        canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height).data.some(byte => byte));
      return [...texts.map(({tool}) => `text-${tool}`), ...drawn.map(({stage}) => `wire-${stage.tool}`)];"""

    def test_the_texts_can_be_read_and_a_panel_fills_the_window(self):
        """At 1400 x 900, all three coordinates of every line."""
        self.choose("torus")
        cut = """return ["model", "view", "project"].flatMap(tool => {
          const box = document.querySelector("#text-" + tool);
          const right = box.getBoundingClientRect().left + box.clientWidth;
          return [...box.querySelectorAll(".lines div")].filter(row => {
            const [words] = row.lastChild.data.match(/^\\S+ \\S+ \\S+/) || [""];
            const range = document.createRange();
            range.setStart(row.lastChild, 0);
            range.setEnd(row.lastChild, words.length);
            return range.getBoundingClientRect().right > right;
          }).map(row => row.innerText);
        });"""
        self.assertEqual(self.browser.run(cut), [])
        lines = "return document.querySelector('#text-view').clientHeight / 16"
        double = ("document.querySelector(arguments[0]).dispatchEvent(new MouseEvent("
                  "'dblclick', {bubbles: true}))")
        key = ("document.querySelector(arguments[0]).dispatchEvent(new KeyboardEvent('keydown', "
               "{key: arguments[1], bubbles: true}))")
        behind = "return getComputedStyle(document.querySelector('.large')).backgroundColor"
        self.assertLess(self.browser.run(lines), 15)
        for script, words in ((double, ["#texts section:nth-child(2) h2"]), (key, ["#text-view", "F8"])):
            self.browser.run(script, *words)
            self.browser.wait_for(lambda: self.browser.run(lines) >= 15)
            self.assertNotEqual(self.browser.run(behind), "rgba(0, 0, 0, 0)")
            self.edit(config="60 60\n" if script is key else "50 50\n")  # the panel is made anew
            self.assertGreaterEqual(self.browser.run(lines), 15)
            self.assertEqual(self.browser.run(self.MADE), ["text-view"])
            self.browser.run(key, "#text-view", "Escape")
            self.browser.wait_for(lambda: self.browser.run(lines) < 15)
            self.browser.wait_for(lambda: len(self.browser.run(self.MADE)) == 7)
        self.browser.run("document.querySelector('#glass').style = 'position: relative; top: 100vh'")
        self.edit(config="60 60\n")
        self.assertEqual(self.browser.run(self.MADE), [])
        self.browser.run("document.querySelector('#text-project').scrollIntoView()")
        self.browser.wait_for(lambda: "text-project" in self.browser.run(self.MADE))

    def test_the_legend_counts_what_the_wireframes_draw_in_its_colors(self):
        kinds = """const {fates, data} = document.body.playground.inspector;
          return Array.from({length: data.triangles}, (_, name) => fates.kindOf(name));"""
        told = """const items = [...document.querySelectorAll("#legend li")].map(item => [item.className,
            Number(item.querySelector("b").innerText.replace(",", "")),
            getComputedStyle(item, "::before").backgroundColor]);
          return items.filter(([kind]) => kind);"""
        for name, words in (("torus", "--cull back"), ("torus", "--cull front"), ("tilted-camera", "")):
            self.choose(name)
            self.edit(words={**dict.fromkeys(STAGES, ""), "project": words})
            legend = self.browser.run(told)
            self.assertEqual({kind: count
                              for kind, count, _ in legend if count},
                             collections.Counter(self.browser.run(kinds)))
            self.assertEqual(len({color for _, _, color in legend}), len(legend))

    def test_of_a_large_scene_the_panels_show_a_part(self):
        """One triangle in two, at its line; the picture and the counts are of all."""
        scene = subprocess.run([ROOT / "scripts/make-torus", "--around", "150", "--tube", "40"],
                               capture_output=True, text=True, check=True).stdout
        self.edit(config="60 60\n")
        before = self.browser.run(self.DROP + self.NEWS, [["torus.txt", letters(scene.encode())]])
        self.assertIn("torus.txt has 1.8 MB: the picture comes first", before)
        told = "return document.querySelector('#notes').innerText"
        self.browser.wait_for(lambda: "one in 2 is drawn" in self.browser.run(told))
        self.browser.wait_for(lambda: self.browser.run(IS_DONE))
        self.assertEqual(self.browser.run(IMAGE), self.picture_of(scene.encode(), b"60 60\n"))
        text = subprocess.run([BIN / "model"], input=scene, capture_output=True, text=True, check=True).stdout
        shown = "const {lines, numbers} = document.body.playground.inspector.panels[0].stage;"
        lines = self.browser.run(shown + "return [...numbers].map((number, i) => [number, lines.line(i)])")
        whole = text.split("\n")
        self.assertEqual([line for number, line in lines if number],
                         [whole[number - 1] for number, _ in lines if number])
        points = [line for _, line in lines if line and line[0] in "-0123456789"]
        self.assertEqual(len(points), 3 * 12000)

    def test_after_an_error_every_panel_says_that_it_is_older(self):
        shown = self.browser.run(IMAGE)
        self.browser.run("document.body.playground.preview({columns: 20, rows: 10, "
                         "pixels: new Uint8Array(600)})")
        self.assertNotEqual(self.browser.run(IMAGE), shown)
        self.browser.run(SET, {"scene": "what\n"})
        older = "return document.querySelector('#older').offsetHeight > 0"
        self.browser.wait_for(lambda: self.browser.run(older))
        self.assertEqual(self.browser.run(IMAGE), shown)
        self.choose("worked-example")
        self.assertFalse(self.browser.run(older))

    def test_code_has_its_errors_its_prints_and_its_verdict_beside_it(self):
        self.choose("tilted-camera")
        told = self.own("view", "console.log('a', [1, 2]);\nconst b = 1;\n  nothing();")[0]
        self.assertRegex(told, "^Your view: line 3, column 3: ReferenceError: nothing")
        self.assertEqual(self.browser.run("return document.querySelector('#own-printed').innerText"),
                         "a [1,2]\n")
        marks = "return document.querySelectorAll('#own .cm-lint-marker-error').length"
        self.browser.wait_for(lambda: self.browser.run(marks) == 1)
        self.assertRegex(
            self.own("view", "const a = 1;\nreturn a a;")[0], "^Your view: line 2, column 10: .*Syntax")
        self.own("view")
        self.browser.wait_for(lambda: self.browser.run(self.VERDICT) == "Solved: all 10000 pixels agree.")
        self.own("view", "return input")
        self.browser.wait_for(lambda: "vertices differ" in self.browser.run(self.VERDICT))
        # 80 columns of code.
        columns = (
            "const {view} = document.body.playground.own.editor; "
            "return view.scrollDOM.clientWidth - view.contentDOM.offsetLeft - 80 * view.defaultCharacterWidth"
        )
        self.assertGreaterEqual(self.browser.run(columns), 0)

    def test_a_mistake_has_the_name_that_compare_gives_it(self):
        self.choose("tilted-camera")
        scene, _ = self.sample("tilted-camera")
        press = ("const button = document.querySelector('#own-told button'); if (button) button.click(); "
                 "return Boolean(button)")
        anew = ("document.querySelector('#own-tool').value = arguments[0];"
                "const {own} = document.body.playground;"
                "document.querySelector('#own-anew').click(); return own.editor.text")
        for tool, right, wrong in (("view", "minus(line", "((p, q) => p.map((x, i) => x + q[i]))(line"),
                                   ("project", "2 * far *", "far *"), ("view", "return out",
                                                                       "return input; out")):
            code = self.browser.run(anew, tool)
            self.own(tool, code.replace(right, wrong))
            self.browser.wait_for(lambda: self.browser.run(press))
            self.browser.wait_for(lambda: not self.browser.run(self.VERDICT).endswith("Name the mistake"))
            named = self.browser.run(self.VERDICT).rsplit(". ", 1)[1].rstrip(".")
            if "return" in right:
                self.assertIn("It is none of the mistakes that this page has", named)
                continue
            with tempfile.TemporaryDirectory() as folder:
                pathlib.Path(folder, "mine").mkdir()
                pathlib.Path(folder, "scene.txt").write_bytes(scene)
                texts = [
                    self.browser.run("return document.body.playground.textOf(arguments[0])", stage)
                    for stage in STAGES[:STAGES.index(tool)]]
                texts.append(self.browser.run("return document.body.playground.own.stage.text"))
                for at, text in enumerate(texts, 1):
                    pathlib.Path(folder, f"mine/stage{at}.txt").write_text(text)
                done = subprocess.run([ROOT / "scripts/compare", "--hand-in", "mine", "scene.txt"],
                                      cwd=folder, env={**os.environ, "BIN": str(BIN)}, capture_output=True,
                                      text=True)
            self.assertIn(named, done.stdout)

    def test_a_command_to_copy_is_what_ran(self):
        """Whatever a link has for words, the shell of whoever copies them does nothing else."""
        words = {"model": "", "view": "", "project": "", "zbuf": "--z-buffer $(touch${IFS}pwned) `id`.pgm"}
        self.browser.run(SET, {"words": words})
        line = self.browser.run("return document.body.playground.line.text")
        self.assertEqual(
            shlex.split(line)[-4:], ["--z-buffer", "$(touch${IFS}pwned)", "`id`.pgm", "config.txt"])
        self.assertIn("'$(touch${IFS}pwned)' '`id`.pgm'", line)

    def test_an_option_to_add_has_its_sentence(self):
        options = "return [...document.querySelectorAll('#line span option')].map(o => o.textContent)"
        self.browser.wait_for(lambda: len(self.browser.run(options)) > 30)
        told = [text.split("  ") for text in self.browser.run(options) if text != "+"]
        self.assertEqual([words for words, sentence in told if words.endswith(sentence)], [])
        self.assertIn(["--clip near", "cut all triangles at the near plane"], told)

    def test_the_stages_to_begin_with_are_right(self):
        scene, config = self.sample("tilted-camera")
        self.edit(scene=scene.decode(), config=config.decode())
        for tool, told in (("view", "every vertex is right; "), ("project", "every vertex is right; "),
                           ("zbuf", "")):
            self.assertEqual(self.own(tool), ["", f"your own {tool}: {told}0 of 10000 pixels differ."])

    def test_a_wrong_stage_is_laid_over_ours(self):
        text = (ROOT / "samples/worked-example/stage2.txt").read_text().replace("-2.0", "2.0", 1)
        mine = {"tool": "view", "kind": "text", "text": "perspective 60 1 1 10\n" + text}
        self.browser.run(SET, {"mine": mine})
        self.assertEqual(self.browser.run(self.TOLD), ["", ""])
        self.browser.run("document.querySelector('#own-run').click()")
        self.browser.wait_for(lambda: any(self.browser.run(self.TOLD)))
        self.assertRegex(
            self.browser.run(self.TOLD)[1],
            r"^your own view: 1 of 3 vertices differ, first line 2, z of vertex 1 of triangle "
            r"0: 2 in place of -2; \d+ of 100 pixels differ\.$")
        listed = self.browser.run("return document.querySelectorAll('#theirs [data-name]').length")
        self.assertEqual(listed, 1)

    def test_nothing_is_right_that_the_stages_behind_draw_otherwise_or_refuse(self):
        text = (ROOT / "samples/worked-example/stage3.txt").read_text()
        cases = {
            text + ".5 .5 .0\n.9 .9 .0\n.1 .9 .0\n": "2 triangles in place of 1",
            "triangle 77\n" + text: "every vertex is right, but",
            text.replace("0.1111111", "0x1", 1): "1 of 3 vertices differ",
            text + "hello world\n": "do not take it: zbuf: ",
            text.replace("0.8660254", "0.8660294", 1): "1 of 3 vertices differ",
            re.sub(r"(?m)^(?=[0-9])", "+", text): "every vertex is right; 0 of"}
        for stage3, told in cases.items():
            with self.subTest(stage3=stage3):
                self.assertRegex(self.own("project", stage3, "text")[1], told)

    def test_a_picture_of_ones_own_is_compared_pixel_by_pixel(self):
        self.edit(scene="0 0 2\n0 0 0\n0 1 0\n60 1 1 10\nbackground 9 8 7\nend\n", config="2 2\n")
        right = "P3 # a comment\n2 2 255 9 8 7  9 8 7\n9 8 7  9 8 7"
        image = "<img src=x onerror='document.body.dataset.hit = 1'>"
        cases = {
            right: "0 of 4 pixels differ",
            right[:-1] + "6": "1 of 4 pixels differ, first row 1, column 1: 9 8 6 in place of 9 8 7",
            right[:-1]: "there is no picture of it: expected 12 numbers behind 255, found 11",
            right.replace("9 8 7", "9 256 7"): "expected a number from 0 to 255, found 256",
            right.replace("2 2", "2 3"): "begins with P3 2 2 255, found P3 2 3 255",
            "P3 2 2 255 " + "0 " * 9000: "it is longer than such a picture",
            image: "found <img src=x onerror='document.body.datas"}
        for text, told in cases.items():
            with self.subTest(text=text[:80]):
                self.assertIn(told, self.own("zbuf", text, "text")[1])
        hit = "return document.body.dataset.hit || document.querySelector('img')"
        self.assertIsNone(self.browser.run(hit))

    def test_code_that_ran_runs_again_on_an_edited_scene_and_a_verdict_ends_with_its_code(self):
        scene, _ = self.sample("worked-example")
        self.assertIn("every vertex is right", self.own("view")[1])
        self.edit(scene=scene.decode().replace("0 0 2 ", "1 1 3 "))
        self.browser.wait_for(lambda: any(self.browser.run(self.TOLD)))
        self.assertIn("every vertex is right", self.browser.run(self.TOLD)[1])
        self.browser.run(self.TYPE, "own", "//")
        self.browser.wait_for(lambda: not any(self.browser.run(self.TOLD)))

    def test_files_are_those_of_stages(self):
        for name, zbuf in (("nested-transforms", ""), ("tilted-camera", "--coverage center")):
            scene, config = self.sample(name)
            words = {"model": "", "view": "", "project": "", "zbuf": zbuf}
            self.edit(scene=scene.decode(), config=config.decode(), words=words)
            letters_of_zip = self.browser.run(
                "const {client, state} = document.body.playground;"
                "return client.ask({saved: state}).then(({zip}) => zip.arrayBuffer()).then(bytes => "
                "btoa([...new Uint8Array(bytes)].map(byte => String.fromCharCode(byte)).join('')))")
            with zipfile.ZipFile(io.BytesIO(base64.b64decode(letters_of_zip))) as archive:
                self.assertIsNone(archive.testzip())
                found = {entry: archive.read(entry) for entry in archive.namelist()}
            with tempfile.TemporaryDirectory() as folder:
                given = [ROOT / "samples" / name / file for file in ("scene.txt", "config.txt")]
                subprocess.run([ROOT / "scripts/stages", *given, folder], check=True,
                               env={**os.environ, "BIN": str(BIN)})
                expected = {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}
                if zbuf:
                    image, stage3 = (pathlib.Path(folder, file) for file in ("out.bmp", "stage3.txt"))
                    expected["z_buffer.txt"] = subprocess.run(
                        [BIN / "zbuf", given[1], *zbuf.split(), "-o", image], input=stage3.read_bytes(),
                        capture_output=True, check=True).stdout
                    expected["out.bmp"] = image.read_bytes()
            self.assertEqual(found, {"scene.txt": scene, "config.txt": config, **expected})

    def test_the_picture_is_there_before_all_else(self):
        scene, _ = self.sample("worked-example")
        self.browser.run("""const {client} = document.body.playground, {drawn, answered} = client;
          window.heard = [];
          client.drawn = picture => { drawn(picture); window.heard.push(picture.pixels.length); };
          client.answered = answer => { window.heard.push("all"); answered(answer); };""")
        self.edit(scene=scene.decode().replace("90 0 0 1", "45 0 0 1"))
        size = 3 * self.browser.run(IMAGE)[0] * self.browser.run(IMAGE)[1]
        self.assertEqual(self.browser.run("return window.heard.slice(0, 2)"), [size, "all"])

    def test_code_that_came_along_does_nothing_until_run_and_then_no_harm(self):
        self.edit(mine={"tool": "view", "kind": "js", "text": "return 'ran'"})
        self.assertEqual(self.browser.run(self.TOLD), ["", ""])
        self.assertIn("'ran'", self.browser.run("return document.body.playground.state.mine.text"))
        address, asked = serve(self, BUILT / "site")
        cases = {
            "for (;;);": "it has not ended after 5 seconds", "throw 5": "5", "return x(": "SyntaxError",
            "return 'a'.repeat(1e8)": "it returned too much",
            "postMessage({error: {toString: null}}); for (;;);": "it calls postMessage",
            "for (;;) postMessage(null);": "it calls postMessage",
            "throw new Error('x y '.repeat(1e6));": "^.{200,400}$",
            f"importScripts('{address}')": "NetworkError",
            f"importScripts(URL.createObjectURL(new Blob([\"importScripts('{address}')\"])))": "NetworkError",
            f"const r = new XMLHttpRequest(); r.open('GET', '{address}', false); r.send()": "NetworkError"}
        for code, told in cases.items():
            with self.subTest(code=code):
                self.assertRegex(self.own("view", code)[0], told)
        self.assertIn("found 'undefined,null'",
                      self.own("view", "return [typeof localStorage, self.origin].join() + '\\n'")[1])
        self.assertEqual(self.browser.run("return document.querySelectorAll('iframe').length"), 0)
        self.assertEqual(asked, [])
        urllib.request.urlopen(address).close()
        self.assertEqual(len(asked), 1)

    def test_it_lives_after_hostile_texts(self):
        self.browser.run(SET, {"config": "30000 30000\n"})
        self.browser.wait_for(lambda: "not enough memory" in self.messages())
        for tool, option, told in (("zbuf", "--help", "Usage: zbuf"), ("zbuf", "--rows 1:2", "cannot show"),
                                   ("model", "--first 5000000000", "more than")):
            words = {"model": "", "view": "", "project": "", "zbuf": "", tool: option}
            self.browser.run(SET, {"config": "8 8\n", "words": words})
            self.browser.wait_for(lambda: told in self.messages())
        scene, config = self.sample("two-triangles")
        self.edit(scene=scene.decode(), config=config.decode(), words=dict.fromkeys(STAGES, ""))
        self.assertEqual(self.browser.run(IMAGE), self.picture_of(scene, config))


@unittest.skipIf(firefox.MISSING, f"missing: {' '.join(firefox.MISSING)}")
class ThePageInFirefox(ThePage):
    BROWSER = firefox.Firefox


class TheFolder(PageTest):
    """The same, served as files; of code in the page, nothing comes back to the server."""
    def setUp(self):
        self.address, self.asked = serve(self, BUILT / "site/playground")
        super().setUp()

    def open(self, hash_):
        address = f"{self.address}index.html{hash_}"
        self.browser.call("POST", "/url", {"url": address})
        self.browser.wait_for(lambda: self.browser.run("return document.body.dataset.runs"))
        files = tuple(f"GET /{name} " for name in (*FILES, "favicon.ico"))
        self.assertEqual([line for line in self.asked if not line.startswith(files)], [])

    def test_it_shows_the_native_picture(self):
        self.check_the_native_picture()
        # Who drops no model loads no reader of models.
        self.assertEqual([line for line in self.asked if "mesh2scene" in line], [])

    def test_code_reaches_no_file_of_the_server(self):
        count, where = len(self.asked), f"{self.address}main.js"
        for code in (f"importScripts('{where}')",
                     f"const r = new XMLHttpRequest(); r.open('GET', '{where}', false); r.send()",
                     f"fetch('{where}', {{mode: 'no-cors'}}); const e = Date.now() + 500; "
                     "while (Date.now() < e); throw 1"):
            self.assertTrue(self.own("view", code)[0])
        self.assertEqual(len(self.asked), count)


AXE = BUILT / "npm/node_modules/axe-core/axe.min.js"
VIOLATIONS = """return axe.run().then(found => found.violations.map(({impact, id, nodes}) =>
  [impact, id, nodes[0].html.slice(0, 100)]).filter(found => /critical|serious/.test(found[0])));"""


@unittest.skipUnless(AXE.exists() and (BUILT / "site/playground.html").exists(), NOT_BUILT)
@unittest.skipIf(MISSING, f"missing: {' '.join(MISSING)}")
class ForEverybody(unittest.TestCase):
    """No serious finding of axe-core, on the playground, also after an error, and on a page of inspect."""

    BROWSER = Browser

    def check(self, page, *scripts):
        for scheme in ("light", "dark"):
            with self.BROWSER(1400, 900) as browser:
                browser.prefer(scheme)
                browser.open(page)
                ready = "return document.body.dataset.runs || document.body.dataset.ready"
                browser.wait_for(lambda: browser.run(ready))
                browser.run(AXE.read_text())
                for script in scripts or ("return true",):
                    browser.wait_for(lambda: browser.run(script))
                    self.assertEqual(browser.run(VIOLATIONS), [])

    def test_the_playground(self):
        self.check(
            BUILT / "site/playground.html",
            "document.querySelector('#tour').click(); document.querySelector('#words').click();"
            "return document.querySelector('#own').open = true",
            "const {editors, own} = document.body.playground; editors.scene.view.dispatch({changes: "
            "{from: 0, insert: 'x'}}); own.tell('wrong', 'bad'); return true",
            "return document.querySelector('#glass').matches('.stale')")

    def test_the_inspector(self):
        sample = ROOT / "samples/tilted-camera"
        with tempfile.TemporaryDirectory() as folder:
            page = f"{folder}/page.html"
            words = [ROOT / "scripts/inspect", sample / "scene.txt", sample / "config.txt", "-o", page]
            subprocess.run(words, check=True, env={**os.environ, "BIN": str(BIN)})
            self.check(page)


@unittest.skipIf(firefox.MISSING, f"missing: {' '.join(firefox.MISSING)}")
class ForEverybodyInFirefox(ForEverybody):
    BROWSER = firefox.Firefox


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
