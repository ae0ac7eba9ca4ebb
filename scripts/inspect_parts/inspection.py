"""The data of the inspector's page: a scene sent through the real pipe, and the output of every stage."""
import io
import itertools
import math
import pathlib
import re
import tempfile

from inspect_parts.explanations import explanations
from inspect_parts.packing import packed
from inspect_parts.stage_lines import NUMBER_BEGINS, StageLines
from lib.rim.command import renaming
from lib.rim.input_file import read_input
from lib.running.pipe_tools import (FRAMING, ToolCrash, ToolFailure, bare_blocks, expect_rows, of_bare_text,
                                    opaque_background)
from lib.showing.pictures import read_picture
from lib.text.projection import line_of
from lib.text.square import note_on_squares
from lib.text.stage_text import text_of

# A page opens in a few seconds up to this number; beyond it only every n-th triangle is drawn.
MAX_DRAWN_TRIANGLES = 200000
MAX_FRAGMENTS = 3000000
MAX_FACETS = 20000  # of all spheres
BELTS = 2, 16  # the fewest and the most of a sphere
# The percentage of a large page's time after each step.
SHARES = {"model": 11, "view": 21, "project": 32, "zbuf": 48}
TITLES = {"model": "world space", "view": "view space", "project": "normalized device coordinates"}
BEGINS = (*NUMBER_BEGINS, "triangle ", "clipped", "sphere")  # of the lines after a header


def time_told(tool, stderr):
    """Seconds of a --timing line."""
    found = re.search(r"triangles? in (\d+\.\d+) s", stderr)
    if not found:
        raise ToolCrash(f"{tool}: has not written the time it took, though it ended well")
    return float(found[1])


def notes_told(stderr):
    return [line for line in stderr.splitlines() if ": note: " in line]


def statistics(path):
    """The lines of --stats, as pairs of a key and a word."""
    return [line.split() for line in path.read_text().splitlines()]


class Inspection:
    """A run of the pipe that keeps every stage's output. As in scripts/stages, the stages pass lossless text
    on, and zbuf reads project's printed text. `names` are the user's names of scene and config, and
    `progress` is a Progress of 100 steps. For spheres, project and zbuf get facets."""
    def __init__(self, tools, scene, config, names, is_traced, coverage, progress):
        self.tools, self.scene, self.config, self.is_traced = tools, scene, config, is_traced
        self.coverage, self.progress = coverage, progress
        self.scene_data, self.config_data = read_input(scene), read_input(config)
        self.name, self.config_name = names
        self.notes = []
        self.statistics = {}
        with tempfile.TemporaryDirectory() as folder:
            self.run(pathlib.Path(folder))

    def run(self, folder):
        texts, self.lossless, self.lines, data = {}, {}, {}, self.scene_data
        for tool in TITLES:
            if tool == "project":
                data = self.faceted(data)
            # Timed without counting.
            framed = FRAMING.get(tool, [])
            done = texts[tool] = self.first_run(tool, data, *framed)
            data = self.tools.output(tool, *framed, "--digits", "exact", "--stats", folder / tool, stdin=data)
            done.stdout, self.lossless[tool] = (b"".join(bare_blocks(tool, io.BytesIO(text)))
                                                for text in (done.stdout, data))
            self.statistics[tool] = statistics(folder / tool)
            self.lines[tool] = StageLines.of(done.stdout.decode())
            self.progress.reach(SHARES[tool])
        self.header = self.lines["model"].header
        self.count = self.lines["model"].count
        self.step = max(1, math.ceil(self.count / MAX_DRAWN_TRIANGLES))
        self.stages = [self.stage(tool, TITLES[tool], texts[tool]) for tool in texts]
        self.draw(texts["project"].stdout, folder)  # refuses what is no config
        note = note_on_squares(line_of(self.header.get), text_of(self.config_data, self.config))
        self.square_notes = [f"note: {note}"] if note else []

    def first_run(self, tool, data, *words):
        with renaming({"model: <stdin>:": f"model: {self.name}:"}):  # model has read the scene from a pipe
            return self.tools.run(tool, "--timing", *words, stdin=data)

    def faceted(self, stage2):
        """The input of project: the output of view, with facets in place of spheres."""
        spheres = len(self.lines["model"].spheres)
        if not spheres:
            return stage2
        if not self.is_traced:
            try:
                self.first_run("model", self.scene_data, "--bare")
            except ToolFailure as failure:
                raise ToolFailure(str(failure).split(": trace draws it")[0] + ": --trace draws it") from None
        # N belts of a sphere become 4 N (N - 1) triangles.
        belts = max(BELTS[0], min(BELTS[1], math.isqrt(MAX_FACETS // (4 * spheres))))
        self.notes.append(
            f"project and zbuf have {4 * belts * (belts - 1)} triangles for each sphere, and count these")
        return self.tools.through(["model", "--framed", "--digits", "exact", "--facets", belts],
                                  ["view", "--digits", "exact"], stdin=self.scene_data)

    def stage(self, tool, title, done):
        read, stderr = self.lines[tool], of_bare_text(done.stderr).decode(errors="replace")
        self.notes += notes_told(stderr)
        lines = self.thinned(read) if self.step > 1 else [(0, line) for line in read.lines]
        return {
            "tool": tool, "title": title, "seconds": time_told(tool, stderr), "triangles": len(
                read.names), "missing": self.count - len(set(read.names)), "bytes": len(done.stdout),
            "statistics": self.statistics[tool], "text": "\n".join(line for _, line in lines),
            "numbers": packed("i", [number for number, _ in lines]) if self.step > 1 else None}

    def thinned(self, read):
        """The header of a long text, its drawn triangles and all spheres, each after an added line with its
        number: a list of (line number, line), 0 for an added line."""
        triangles = zip(read.first_lines, read.names)
        pieces = [(line, 3, name) for line, name in triangles if name % self.step == 0]
        found = [*enumerate(itertools.takewhile(lambda line: not line.startswith(BEGINS), read.lines), 1)]
        pieces += [(line - 1, 5, name) for name, line in read.spheres]
        for first, count, name in sorted(pieces):
            found.append((0, f"triangle {name}"))
            found += enumerate(read.lines[first - 1:first - 1 + count], first)
        return found

    def draw(self, stage3, folder):
        z_buffer, image, log = (folder / name for name in ("z_buffer.txt", "out.ppm", "fragments.txt"))
        zbuf_words = [self.config, "--coverage", self.coverage, *opaque_background(stage3)]
        # Timed without log and counts, which take longer than the picture.
        timed = self.tools.run("zbuf", *zbuf_words, "--timing", "--z-buffer", z_buffer, "--image", image,
                               stdin=stage3).stderr.decode(errors="replace")
        self.tools.run("zbuf", *zbuf_words, "--z-buffer", "/dev/null", "--image", folder / "again.ppm",
                       "--fragments", log, "--stats", folder / "zbuf", stdin=stage3)
        self.notes += notes_told(timed)
        self.columns, self.rows, pixels = read_picture(image)
        expect_rows(z_buffer, self.rows)
        text = z_buffer.read_text()
        self.stages.append({
            "tool": "zbuf", "title": "pixels", "seconds": time_told("zbuf", timed), "triangles": len(
                self.lines["project"].names), "bytes": len(text), "statistics": statistics(folder / "zbuf"),
            "text": text})
        self.pixels = packed("B", b"".join(pixels))
        self.fragments = self.fragments_of(log)
        self.progress.reach(SHARES["zbuf"])

    def fragments_of(self, log):
        """zbuf's lines on all fragments; if they are very many, without those that lost."""
        text = log.read_text(encoding="ascii")
        count = text.count("\n")
        if count > MAX_FRAGMENTS:
            text = "".join(line for line in text.splitlines(keepends=True) if line.endswith(": kept\n"))
        self.left_out_count = count - text.count("\n")
        return text

    def limits(self):
        """The words of the config's limits in x and y."""
        lines = text_of(self.config_data, self.config).split("\n")
        return " ".join(line.split("#")[0] for line in lines).split()[2:4] or ["-1", "-1"]

    def as_json(self):
        return {
            "scene": self.name,
            "config": self.config_name,
            "triangles": self.count,
            "spheres": len(self.lines["model"].spheres),
            "step": self.step,
            "columns": self.columns,
            "rows": self.rows,
            "stages": self.stages,
            "pixels": self.pixels,
            "fragments": self.fragments,
            "leftOut": self.left_out_count,
            "notes": self.notes + self.square_notes,
            "limits": self.limits(),
            "coverage": self.coverage,
            "explanations": explanations(self, text_of(self.scene_data, self.scene),
                                         text_of(self.config_data, self.config)),}
