"""The settings of the pipe, and the pipe itself on one scene."""
import dataclasses
import pathlib
import shlex
import subprocess

from lib.child import cpu_seconds, finished
from lib.command import CommandFailure
from lib.owners import owners, write_marked
from lib.pipe_tools import opaque_background

TOOLS = ("model", "view", "project", "zbuf")


@dataclasses.dataclass(frozen=True)
class Setting:
    """Options of the tools; a value that is the default's is not written."""
    digits: str = "7"
    precision: str = "extended"
    coverage: str = "nearest"
    depth: str = "f64"

    def words(self, *names):
        """The words of the options with these names, or of all."""
        defaults = {field.name: field.default for field in dataclasses.fields(self)}
        return [
            word for name in names or defaults if getattr(self, name) != defaults[name]
            for word in (f"--{name}", getattr(self, name))]

    def __str__(self):
        return " ".join(self.words()) or "default"

    @property
    def of_texts(self):
        """The setting of model, view and project alone."""
        return Setting(self.digits, self.precision)

    @property
    def under_default_coverage(self):
        return dataclasses.replace(self, coverage=DEFAULT.coverage)


DEFAULT = Setting()


def exact(rule):
    """The run that loses nothing."""
    return Setting(digits="exact", coverage=rule)


def settings(coverages):
    """Those worth comparing, for each coverage rule. What a 32-bit or 24-bit depth loses does not depend on
    the digits."""
    for coverage in coverages:
        for digits in ("5", "7", "9", "12", "exact"):
            yield Setting(digits, coverage=coverage)
        for digits in ("7", "exact"):
            yield Setting(digits, precision="double", coverage=coverage)
        for depth in ("f32", "u24"):
            yield Setting(coverage=coverage, depth=depth)


class Pipe:
    """A scene and a config on their way through the tools; `folder` holds the files in between."""

    def __init__(self, tools, scene, config, of_project, folder):
        self.tools, self.scene, self.config, self.of_project = tools, scene, config, of_project
        self.folder = pathlib.Path(folder)
        self.texts = {}  # by Setting.of_texts: (the path of project's text, bytes in the pipes, notes)
        self.opaque = [
        ]  # what zbuf needs to write a BMP in spite of a background with an alpha; of the first text()

    def words(self, tool, setting):
        """The options of a tool."""
        if tool == "zbuf":
            return [*setting.words("coverage", "depth"), *self.opaque]
        return [*setting.words("digits", "precision"), *(self.of_project if tool == "project" else [])]

    def text(self, setting):
        """The path of project's text, the bytes in the three pipes, and what the tools noted on the way."""
        key = setting.of_texts
        if key not in self.texts:
            source, size, notes = None, 0, []
            for tool in TOOLS[:3]:
                target = self.folder / f"{tool} {key}.txt"
                notes += self.tools.write(target, tool, *self.words(tool, key), source or self.scene)
                size += target.stat().st_size
                if source:
                    source.unlink()
                source = target
            with open(source, "rb") as projected:
                self.opaque = opaque_background(projected.read(1 << 16))
            self.texts[key] = source, size, notes
        return self.texts[key]

    def owners(self, setting):
        """Which triangle each pixel shows (lib.owners)."""
        marked = self.marked(setting)
        if not marked.exists():
            write_marked(self.text(setting)[0], marked)
        return owners(self.tools, marked, self.config, setting.words("coverage", "depth"),
                      self.folder / "marks.ppm")

    def marked(self, setting):
        return self.folder / f"marked {setting.of_texts}.txt"

    def remove_texts(self, setting):
        """Makes room for others; what text() has found stays known."""
        self.text(setting)[0].unlink()
        self.marked(setting).unlink()

    def empty_scene(self):
        """The path of the scene without its triangles. What its run takes, every run takes."""
        path = self.folder / "empty.txt"
        words = (line.split() for line in self.tools.output("model", "--digits", "exact", self.scene).decode(
            errors="replace").split("\n", 4)[:4])
        path.write_text("".join(" ".join(line[line[0] in ("eye", "look", "up", "perspective"):]) + "\n"
                                for line in words) + "end\n")
        return path

    def cpu_seconds(self, setting, scene=None):
        """The CPU time, user and system, of a run of the whole pipe, with the image and the depths as zbuf
        writes them."""
        processes, source = [], None
        files = {"model": [scene or self.scene], "zbuf": ["--image", self.folder / "out.bmp", self.config]}
        for tool in TOOLS:
            words = [self.tools.folder / tool, *self.words(tool, setting), *files.get(tool, [])]
            processes.append(
                subprocess.Popen(words, stdin=source or subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                                 stdout=subprocess.DEVNULL if tool == "zbuf" else subprocess.PIPE))
            if source:
                source.close()
            source = processes[-1].stdout
        seconds = 0.0
        for tool, process in zip(TOOLS, processes):
            usage = finished(process)
            if process.returncode:
                raise CommandFailure(
                    f"{tool} failed while it was timed, with {setting}: exit status {process.returncode}")
            seconds += cpu_seconds(usage)
        return seconds

    def command_line(self, setting, scene, config):
        """What to type for a setting; the files as the user named them."""
        stages = []
        for tool in TOOLS:
            words = self.words(tool, setting)
            operands = {"model": [scene] * (scene != "-"), "zbuf": [config]}.get(tool, [])
            dashes = ["--"] * any(word.startswith("-") and word != "-" for word in operands)
            stages.append(shlex.join(["pipeline", tool, *words, *dashes, *operands]))
        return " | ".join(stages) + " > z_buffer.txt"
