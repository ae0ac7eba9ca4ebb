"""The tools' own texts of one triangle, and zbuf's report on a pixel.

As in scripts/stages, every stage passes lossless text on and prints its numbers rounded once; zbuf reads what
project printed."""
import collections
import dataclasses
import pathlib
import re
import tempfile

from lib.maths.exact import double
from lib.maths.window import Window
from lib.rim.command import CommandFailure
from lib.rim.input_file import MAX_BYTES, read_input
from lib.running.pipe_tools import ToolFailure, opaque_background
from lib.running.tool_options import words_of_project
from lib.text.stage_text import header_and_body, parse_stage_text, text_of

FRAGMENT = re.compile(r"(\d+),(\d+): triangle (\d+), depth (\S+): (.*)")
EXACT = ("--digits", "exact")
# The words of the tools' options; None is the tool's default.
Settings = collections.namedtuple("Settings", "digits aspect clip cull coverage",
                                  defaults=("7", None, None, None, "nearest"))


@dataclasses.dataclass
class Fragment:
    triangle: int
    depth: str
    fate: str

    @property
    def is_kept(self):
        return self.fate == "kept"


class Stages:
    """A scene, and a single triangle of it on its way through the stages."""
    def __init__(self, tools, scene, config, settings):
        self.tools, self.scene, self.config, self.settings = tools, scene, config, settings
        self.lossless = tools.output("model", *EXACT, scene)
        self.header, self.body = header_and_body(self.lossless)
        self.count = len(self.body) // 4

    def camera(self):
        """The header's lines of the camera: {keyword: words}."""
        return {words[0]: words[1:] for line in self.header if (words := line.split())}

    def send(self, number):
        """Sends triangle `number` through the stages: its text after each, lossless and as printed."""
        digits = ("--digits", self.settings.digits)
        printed = self.tools.output("model", "--bare", *digits, self.scene).decode().split("\n")
        self.world = words_of_triangle(printed[4 * number:4 * number + 3], "model", number)
        vertices = self.body[4 * number:4 * number + 3]
        self.world_lossless = words_of_triangle(vertices, "model", number)
        alone = "\n".join([*self.header, f"triangle {number}", *vertices, "", ""]).encode()
        in_view, bare = (self.tools.output("view", *words, stdin=alone)
                         for words in (EXACT, ["--bare", *digits]))
        self.view_lossless, self.view = (words_of_triangle(header_and_body(text)[1][:3], "view", number)
                                         for text in (in_view, bare))
        self.projected = self.tools.output("project", *digits, *words_of_project(self.settings),
                                           stdin=in_view)
        self.ndc = [words_of(lines) for lines in vertex_lines(self.projected)]

    def window(self):
        """The Window of the config; a ToolFailure with zbuf's message if something is wrong with it."""
        self.zbuf(self.projected)
        return Window(text_of(read_input(self.config), self.config))

    def zbuf(self, text, *options):
        with tempfile.TemporaryDirectory() as folder:
            image = pathlib.Path(folder, "out.ppm")
            done = self.tools.run("zbuf", "--coverage", self.settings.coverage,
                                  "--image", image, "--z-buffer", "/dev/null", *options,
                                  *opaque_background(text), self.config, stdin=text, most=MAX_BYTES)
            return done.stderr.decode(errors="replace")

    def fragments(self, column, row):
        """Every Fragment of the whole scene at a pixel, in the order of arrival."""
        report = self.zbuf(self.projected_whole(EXACT), "--probe", f"{column},{row}")
        return [Fragment(int(n), depth, fate) for _, _, n, depth, fate in FRAGMENT.findall(report)]

    def projected_whole(self, digits, *of_model):
        """The text of project for the whole scene; `digits` are words for model and view."""
        project = ["project", "--digits", self.settings.digits, *words_of_project(self.settings)]
        return self.tools.through(["model", *digits, *of_model, self.scene], ["view", *digits], project)

    def bounds_if_uncertain(self, column, row):
        """The numbers of the text's `bounds` if zbuf --certify calls the pixel uncertain, with the same
        digits in every stage; None if it is certain, or bounds are refused."""
        if self.settings.coverage != "center":
            return None
        try:
            text = self.projected_whole(("--digits", self.settings.digits), "--bounds")
            report = self.zbuf(text, "--certify", "/dev/stderr", "--rows", f"{row}:{row + 1}")
        except ToolFailure:
            return None
        if f"\n{row} {column}\n" not in report:
            return None
        return [double(word) for word in re.search(rb"^bounds ndc (.*)$", text, re.M)[1].decode().split()]


def words_of(lines):
    """x, y and z of vertex lines, as words."""
    return [line.split()[:3] for line in lines]


def words_of_triangle(lines, tool, number):
    """The same of a whole triangle; an error if a tool that did not fail has left out a part."""
    words = words_of(lines)
    if [len(vertex) for vertex in words] != [3, 3, 3]:
        raise CommandFailure(f"{tool}: expected three vertex lines of triangle {number}, found fewer")
    return words


def vertex_lines(data):
    """The three vertex lines of each triangle of a text of project, without the whole triangles of its
    `clipped` blocks."""
    text = data.decode()
    lines = text.split("\n")
    return [[lines[vertex.line - 1] for vertex in triangle]
            for triangle in parse_stage_text(text, "project").triangles]
