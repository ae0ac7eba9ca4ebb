"""The pipe for one frame after the other: every stage's output is kept in memory, and a stage runs only if what it reads or
how it is called has changed."""
import dataclasses
import os
import pathlib
import subprocess
import tempfile
import time

STAGES = ("model", "view", "project", "zbuf")


class MemoryFile:
    """A file without a name, in memory."""

    def __init__(self):
        self.descriptor = os.memfd_create("stage")

    def __del__(self):
        os.close(self.descriptor)

    def read(self):
        return os.pread(self.descriptor, os.fstat(self.descriptor).st_size, 0)

    def write(self, data):
        os.ftruncate(self.descriptor, 0)
        with open(os.dup(self.descriptor), "wb") as file:
            file.seek(0)
            file.write(data)

    def rewound(self):
        os.lseek(self.descriptor, 0, os.SEEK_SET)
        return self.descriptor


@dataclasses.dataclass
class Stage:
    words: list = None      # what it was last called with, and
    source: object = None   # the MemoryFile it read
    output: object = None
    seconds: float = None   # None if the last frame reused its output


class FramePipe:
    def __init__(self, tools, scene):
        self.tools = tools
        self.folder = tempfile.TemporaryDirectory(dir="/dev/shm" if os.access("/dev/shm", os.W_OK) else None)
        self.image = pathlib.Path(self.folder.name, "frame.ppm")
        self.config = pathlib.Path(self.folder.name, "config.txt")
        self.stages = {name: Stage() for name in STAGES}
        # The output does not depend on threads.
        self.threads = {name: ["--threads", "2"] if tools.has_option(name, "--threads") else [] for name in STAGES}
        self.run("model", [str(scene)], None)
        self.light = self.first_light()

    def close(self):
        self.folder.cleanup()

    def run(self, name, words, source):
        """Runs a stage unless its output is there already."""
        stage = self.stages[name]
        stage.seconds = None
        if stage.words == words and stage.source is source:
            return stage.output
        output = MemoryFile()
        begin = time.perf_counter()
        self.tools.run(name, *self.threads[name], *words, stdin_file=source.rewound() if source else subprocess.DEVNULL, stdout=output.descriptor)
        self.stages[name] = Stage(words, source, output, time.perf_counter() - begin)
        return output

    # The world as stage 1 tells it

    def header(self, keyword):
        """The words behind a header keyword, None if it is not there."""
        for line in self.stages["model"].output.read().split(b"\n"):
            words = line.decode().split()
            if words[:1] == [keyword]:
                return words[1:]
            if not words or not words[0].isalpha():
                return None
        return None

    def first_light(self):
        return self.header("light")

    def put_light(self, words):
        """Moves the first light; stage 1 does not run again for that."""
        old = self.stages["model"]
        output = MemoryFile()
        output.write(old.output.read().replace(("light " + " ".join(self.light)).encode(), ("light " + " ".join(words)).encode(), 1))
        self.stages["model"] = Stage(old.words, old.source, output)
        self.light = words

    # Frames

    def frame(self, camera_lines, project_words, config, zbuf_words):
        """The PPM of a frame. `config` is the text of config.txt."""
        self.stages["model"].seconds = None
        eye, look, up = camera_lines
        view = self.run("view", ["--eye", *eye, "--look", *look, "--up", *up], self.stages["model"].output)
        ndc = self.run("project", project_words, view)
        self.config.write_text(config)
        # The config's text is no word of the call, but belongs to what has to be the same.
        stage, words = self.stages["zbuf"], [*zbuf_words, config]
        stage.seconds = None
        if stage.words != words or stage.source is not ndc:
            begin = time.perf_counter()
            self.tools.run("zbuf", str(self.config), "--z-buffer", "/dev/null", "--image", str(self.image), *self.threads["zbuf"], *zbuf_words, stdin_file=ndc.rewound())
            stage = Stage(words, ndc, self.image.read_bytes(), time.perf_counter() - begin)
            self.stages["zbuf"] = stage
        return stage.output

    def seconds(self):
        """A pair for each stage: its name, and the time the last frame took there or None."""
        return [(name, self.stages[name].seconds) for name in STAGES]
