"""The settings of the pipe, and the pipe itself on one scene."""
import dataclasses
import os
import pathlib
import re
import shlex
import subprocess

from lib.rim.child import run
from lib.rim.command import renamed
from lib.running.owners import owners_in
from lib.running.pipe_tools import ToolFailure, opaque_background
from lib.showing.pictures import read_picture

TOOLS = ("model", "view", "project", "zbuf")
CALLGRIND = ("valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null")
TRACING_TOOLS = ("model", "view", "trace")


@dataclasses.dataclass(frozen=True)
class Setting:
    """Options of the tools; default values are not written. With a sampling, trace draws in place of project
    and zbuf."""
    digits: str = "7"
    precision: str = "extended"
    clip: str = "auto"
    cull: str = "none"
    coverage: str = "nearest"
    depth: str = "f64"
    depth_epsilon: str = "0"
    shading: str = "the scene's"
    samples: str = "1"
    certify: str = "none"  # with the bounds that it needs
    sampling: str = "none"

    def words(self, *names):
        """The words of the options with these names, or of all options."""
        defaults = {field.name: field.default for field in dataclasses.fields(self)}
        return [
            word for name in names or defaults if getattr(self, name) != defaults[name]
            for word in (f"--{name.replace('_', '-')}", getattr(self, name))]

    def __str__(self):
        return " ".join(["trace"] * self.is_traced + self.words()) or "default"

    @property
    def of_texts(self):
        """The setting of model, view and project alone."""
        return Setting(self.digits, self.precision, self.clip, self.cull, certify=self.certify)

    @property
    def under_default_coverage(self):
        return dataclasses.replace(self, coverage=DEFAULT.coverage)

    @property
    def is_traced(self):
        return self.sampling != DEFAULT.sampling

    @property
    def is_of_color(self):
        """True if it changes colors, not which triangle a pixel shows."""
        return self.shading != DEFAULT.shading or self.is_dear

    @property
    def is_dear(self):
        return self.samples != DEFAULT.samples or self.is_traced


DEFAULT = Setting()
OPTIONS = {
    "model": ("digits", "precision"), "view": ("digits", "precision"),
    "project": ("digits", "precision", "clip", "cull"),
    "zbuf": ("coverage", "depth", "depth_epsilon", "shading", "samples", "certify"), "trace": ("sampling",)}


def exact(rule):
    """The run that loses nothing."""
    return Setting(digits="exact", coverage=rule)


class Pipe:
    """A scene and a config on their way through the tools; `folder` holds the files in between."""
    def __init__(self, tools, scene, config, of_project, folder, of_camera=(), of_view=(), name=None):
        """`of_project` and `of_camera` are the user's options for project, and for trace in its place; `name`
        is the scene's in notes."""
        self.tools, self.scene, self.config = tools, scene, config
        self.of_project, self.of_camera, self.of_view = of_project, of_camera, of_view
        self.folder, self.name = pathlib.Path(folder), name or scene
        self.texts = {}  # by Setting.of_texts: (the path of project's text, bytes in the pipes, notes)
        self.opaque = []  # words for zbuf to write a BMP of a background with an alpha; set by text()

    def words(self, tool, setting):
        """The options of a tool."""
        has_bounds = tool == "model" and setting.certify != DEFAULT.certify
        return [
            *setting.words(*OPTIONS[tool]), *["--bounds"] * has_bounds,
            *{"view": self.of_view, "project": self.of_project, "trace": self.of_camera}.get(tool, []),
            *(self.opaque if tool in ("zbuf", "trace") else [])]

    def text(self, setting):
        """The path of project's text, the bytes in the three pipes, and the tools' notes."""
        key = setting.of_texts
        if key not in self.texts:
            source, size, notes = None, 0, []
            for tool in TOOLS[:3]:
                target = self.folder / f"{tool} {key}.txt"
                printed = self.tools.write(target, tool, *self.words(tool, key), source or self.scene)
                notes += [renamed(note, {self.scene: self.name}) for note in printed]
                size += target.stat().st_size
                if source:
                    source.unlink()
                source = target
            with open(source, "rb") as projected:
                self.opaque = opaque_background(projected.read(1 << 16))
            self.texts[key] = source, size, notes
        return self.texts[key]

    def owners(self, setting):
        """Which triangle each pixel shows (lib.running.owners)."""
        path, text = self.folder / "owners.npy", self.text(setting)[0]
        self.tools.run("zbuf", *setting.words("coverage", "depth",
                                              "depth_epsilon"), *self.opaque, "--z-buffer", "none", "--image",
                       self.folder / "owners.ppm", "--triangle-array", path, self.config, text)
        return owners_in(path)

    def colors(self, setting):
        """The picture of a setting, as the bytes of its pixels; by trace, without effects that zbuf lacks."""
        image = self.folder / "colors.ppm"
        output = ["--z-buffer", "none", "--image", image, self.config]
        if setting.is_traced:
            self.tools.through(
                ["model", *self.words("model", setting), self.scene], ["view", *self.words("view", setting)],
                ["trace", *self.words("trace", setting), "--no-shadows", "--no-recursion", *output])
        else:
            self.tools.run("zbuf", *self.words("zbuf", setting), *output, self.text(setting)[0])
        return b"".join(read_picture(image)[2])

    def remove_texts(self, setting):
        """Makes room for others; the results of text() are kept."""
        if setting in self.texts:
            self.texts[setting][0].unlink()

    def forget_texts(self, setting):
        """Removes the texts so that text() makes them anew."""
        if setting in self.texts:
            self.texts.pop(setting)[0].unlink(missing_ok=True)

    def camera(self):
        """The words of the scene's camera, line by line."""
        world = self.tools.output("model", "--digits", "exact", self.scene).decode(errors="replace")
        return [line.split() for line in world.split("\n", 4)[:4]]

    def empty_scene(self):
        """The path of the scene without its triangles. The cost of its run is part of every run."""
        path = self.folder / "empty.txt"
        path.write_text("".join(" ".join(line[line[0] in ("eye", "look", "up", "perspective"):]) + "\n"
                                for line in self.camera()) + "end\n")
        return path

    def cpu_seconds(self, setting, scene=None):
        """The CPU time, user and system, of a run of the whole pipe, with the image and the depths as zbuf
        writes them."""
        output = ["--image", self.folder / "out.bmp", self.config]
        files = {"model": [scene or self.scene], "zbuf": output, "trace": output}
        tools = TRACING_TOOLS if setting.is_traced else TOOLS
        calls = ([tool, *self.words(tool, setting), *files.get(tool, [])] for tool in tools)
        return sum(done.seconds for done in self.tools.pipe(*calls, stdout=subprocess.DEVNULL))

    def with_eye(self, eye, folder):
        """The same pipe with the eye elsewhere; its files in a new folder."""
        os.mkdir(folder)
        return Pipe(self.tools, self.scene, self.config, self.of_project, folder, self.of_camera,
                    ["--eye", *map(repr, eye)])

    def instructions(self, setting, scene=None):
        """The instructions of a run of the whole pipe, counted by callgrind."""
        source, count = None, 0
        for tool in TOOLS:
            target, words = self.folder / f"counted {tool}", self.words(tool, setting)
            output = ["--image", self.folder / "out.bmp", self.config] if tool == "zbuf" else []
            command = self.tools.command(tool, [*words, *output, source or scene or self.scene])
            with open(target, "wb") as file:
                done = run([*CALLGRIND, *command], stdout=file)
            found = re.search(rb"Collected : (\d+)", done.stderr)
            if done.returncode or not found:
                raise ToolFailure(f"{tool}: valgrind counts nothing (status {done.returncode})")
            source, count = target, count + int(found[1])
        return count

    def command_line(self, setting, scene, config):
        """The command line of a setting, with the files as the user named them."""
        stages = []
        for tool in TOOLS:
            words = self.words(tool, setting)
            operands = {"model": [scene] * (scene != "-"), "zbuf": [config]}.get(tool, [])
            dashes = ["--"] * any(word.startswith("-") and word != "-" for word in operands)
            stages.append(shlex.join(["pipeline", tool, *words, *dashes, *operands]))
        return " | ".join(stages) + " > z_buffer.txt"
