"""The pipe for one frame after another: every stage's output is kept in memory, and a stage runs only if its
input or its arguments have changed. Stages that run do so in parallel, as in a shell's pipe."""
import contextlib
import dataclasses
import functools
import os
import pathlib
import subprocess
import tempfile
import threading

from fly_parts.framing import Ball
from lib.rim.command import leftovers, unbroken
from lib.rim.output_file import write_file
from lib.running.pipe_tools import opaque_background
from lib.text.projection import line_of
from lib.text.stage_text import header_of

RASTERIZING = ("model", "view", "project", "zbuf")
TRACING = ("model", "view", "trace")


def write_all(descriptor, data):
    rest = memoryview(data)
    while rest:
        rest = rest[os.write(descriptor, rest):]


class MemoryFile:
    """A file without a name, in memory."""
    def __init__(self):
        self.descriptor = os.memfd_create("stage")

    def __del__(self):
        os.close(self.descriptor)

    def read(self):
        return os.pread(self.descriptor, os.fstat(self.descriptor).st_size, 0)

    def append(self, data):
        write_all(self.descriptor, data)

    def rewound(self):
        os.lseek(self.descriptor, 0, os.SEEK_SET)
        return self.descriptor


@dataclasses.dataclass
class Stage:
    words: list = None  # its last arguments
    source: object = None  # the MemoryFile it read
    output: object = None
    seconds: float = None  # of processor time; None if the last frame reused its output
    notes: tuple = ()  # on stderr


class Copy:
    """Passes on what a stage writes, and keeps it as the `output`."""
    def __init__(self, source):
        self.output, self.source = MemoryFile(), source
        reader, self.sink = os.pipe()
        self.reader = os.fdopen(reader)
        self.copier = threading.Thread(target=self.copy)
        self.copier.start()

    def copy(self):
        with self.source, os.fdopen(self.sink, "wb", 0) as sink:
            while data := os.read(self.source.fileno(), 1 << 20):
                self.output.append(data)
                with contextlib.suppress(BrokenPipeError):  # the next stage has failed, and says so
                    write_all(sink.fileno(), data)


class FramePipe:
    """`is_traced` puts trace in place of project and zbuf."""
    def __init__(self, tools, scene, is_traced=False):
        self.tools = tools
        self.names = TRACING if is_traced else RASTERIZING
        self.last = self.names[-1]
        with unbroken():
            place = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
            self.folder = tempfile.TemporaryDirectory(dir=place)
            leftovers.add(self.folder.name)
        self.image = pathlib.Path(self.folder.name, "frame.ppm")
        self.config = pathlib.Path(self.folder.name, "config.txt")
        self.config_text = self.frame_image = None
        self.stages = {name: Stage() for name in self.names}
        self.run([("model", ["--framed", str(scene)])], None)
        self.light = self.header("light")  # the first one
        # The window has nothing behind it.
        self.opaque = opaque_background(self.stages["model"].output.read())
        keyword, *words = line_of(self.header)
        self.projection = {keyword: words}

    def close(self):
        self.folder.cleanup()

    def run(self, calls, source):
        """Runs the stages, pairs of a name and its words, as a pipe. The first reads `source`."""
        # zbuf after other stages shares the processors with them. The output does not depend on threads.
        threads = {"zbuf": ["--threads", "2"]} if len(calls) == 1 else {}
        copies, last = [], MemoryFile()

        def tee(output):
            copies.append(Copy(output))
            return copies[-1].reader

        try:
            done = self.tools.pipe(
                *([name, *self.files(name), *threads.get(name, []), *words] for name, words in calls),
                stdin=source.rewound() if source else subprocess.DEVNULL, stdout=last.descriptor, tee=tee)
        finally:
            for copy in copies:
                copy.copier.join()
        for (name, words), tool, output in zip(calls, done, [*(copy.output for copy in copies), last]):
            self.stages[name] = Stage(words, source, output, tool.seconds, tuple(tool.notes))
            source = output

    def files(self, name):
        return [self.config, "--z-buffer", "/dev/null", "--image", self.image, *self.opaque
                ] if name == self.last else []

    # The world, from the output of stage 1

    def header(self, keyword):
        """The words after a header keyword, None if it is not there."""
        return header_of(self.stages["model"].output.read()).get(keyword)

    @functools.cached_property
    def ball(self):
        """The Ball around the scene; None if the scene is empty."""
        return Ball.around(self.stages["model"].output.read())

    def put_light(self, words):
        """Moves the first light without running stage 1 again."""
        old = self.stages["model"]
        output = MemoryFile()
        output.append(old.output.read().replace(("light " + " ".join(self.light)).encode(),
                                                ("light " + " ".join(words)).encode(), 1))
        self.stages["model"] = Stage(old.words, old.source, output)
        self.light = words

    # Frames

    def frame(self, camera_lines, project_words, config, drawing_words):
        """The PPM of a frame. `config` is the text of config.txt; trace has no use for `project_words`."""
        eye, look, up = camera_lines
        words = {
            "view": ["--eye", *eye, "--look", *look, "--up", *up], "project": project_words,
            self.last: drawing_words}
        calls = [(name, words[name]) for name in self.names[1:]]
        if self.config_text != config:
            write_file(self.config, config.encode())
            self.config_text = config
            self.stages[self.last].words = None  # not to be reused
        source = self.stages["model"].output
        for stage in self.stages.values():
            stage.seconds = None
        while calls and (stage := self.stages[calls[0][0]]).words == calls[0][1] and stage.source is source:
            source = stage.output
            calls.pop(0)
        if calls:
            self.run(calls, source)
            self.frame_image = self.image.read_bytes()
        return self.frame_image

    def is_empty(self):
        """True if the last stage noted that the last frame shows nothing."""
        return any("the picture is empty" in note for note in self.stages[self.last].notes)

    def seconds(self):
        """A pair for each stage: its name and its processor time in the last frame, or None."""
        return [(name, self.stages[name].seconds) for name in self.names]
