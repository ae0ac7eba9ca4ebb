"""The four tools, for scripts that run them: their location, a single run, and a pipe of them."""
import contextlib
import math
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile

from lib.rim.child import MORE, MOST_SAID, Said, beginning, cpu_seconds, finished, run
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import digest
from lib.rim.output_file import own_descriptor, target_of
from lib.showing.pictures import is_complete

SOURCE = pathlib.Path(__file__).resolve().parents[3]


class ToolFailure(CommandFailure):
    """A tool ended with a status other than 0; the text is its message."""


class ToolOutOfMemory(ToolFailure, MemoryError):
    """A ToolFailure because of a limit or too little memory, not of the input."""


class ToolCrash(CommandFailure):
    """A signal ended a tool, or it failed without a message. No ToolFailure, since the input is not to
    blame."""


def default_folder():
    """The folder of the tools: the command's own if it is installed or called through `pipeline`, else
    build/release/bin of this source tree."""
    called = pathlib.Path(sys.argv[0])
    for folder in (called.parent, called.resolve().parent):
        if os.access(folder / "zbuf", os.X_OK):
            return folder
    return SOURCE / "build/release/bin"


def without_inner_location(note, folder):
    """A note of a tool without the line of a text in `folder`, which the user never sees."""
    found = re.search(rf"{re.escape(str(folder))}/[^:]*:\d+:\d+: ", note)
    return note[:found.start()] + re.sub(r"\bof this (vertex|light)\b", r"of a \1",
                                         note[found.end():]) if found else note


# The header line of a background with an alpha.
TRANSPARENT = re.compile(rb"^(background (\S+) (\S+) (\S+)) \S+$", re.M)
OPAQUE_NOTE = "the scene's background is drawn opaque: a BMP has no alpha"


def opaque_background(text):
    """Words for zbuf to draw the background of a tool's stage text opaque, if it has an alpha, which only a
    PNG holds."""
    found = TRANSPARENT.search(text[:1 << 16].split(b"\n\n")[0])
    channels = map(float, found.groups()[1:]) if found else ()
    return ["--background", "".join(f"{math.floor(x + 0.5):02x}" for x in channels)] if found else []


def with_opaque_background(text):
    """The stage text with its background's alpha removed."""
    return TRANSPARENT.sub(rb"\1", text, count=1) if opaque_background(text) else text


def bare_blocks(tool, file):
    """The blocks of the text in a tool's file, without its frame, as users keep it; leaves the file at its
    beginning. An error if a part is missing, though the tool has ended well."""
    first, last = (b"", b"") if tool == "mesh2scene" else (b"framed\n", b"end\n")
    left = file.seek(0, os.SEEK_END) - len(first + last)
    file.seek(max(left + len(first) - 1, 0))
    is_whole = file.read() == b"\n" + last
    file.seek(0)
    if not is_whole or file.read(len(first)) != first:
        raise ToolCrash(f"{tool}: has not written all of its text, though it ended well")
    while left > 0 and (block := file.read(min(left, 1 << 20))):
        left -= len(block)
        yield block
    file.seek(0)


def of_bare_text(stderr):
    """A tool's messages on a framed text, with the lines of the text without the frame."""
    return FRAMED_LINE.sub(lambda found: b"%s%d" % (found[1], max(int(found[2]) - 1, 1)), stderr)


PIPE = ("model", "view", "project", "zbuf", "trace")
# The options that make a tool refuse a text that is cut short because a tool before it was killed.
FRAMING = {"model": ["--framed"], **dict.fromkeys(("join-seen", "zbuf", "trace"), ["--expect-framed"])}
# A pipe in a job of sh, which has only the last tool's status. `run` calls a function with such a pipe:
# `record` gets the status of each stage that fails and, indented, the stderr of all stages, in memory, as the
# disk may be full. `fail` prints it for failure_of_jobs; $1 is the job's output, $2 its name.
STAGES_IN_SHELL = r'''
stage() {
  "$bin/$@" 3>&- && return
  set -- "$1" $?
  echo "$1: status $(($2 > 128 && $2 <= 192 ? 128 - $2 : $2))" >&3
  return 1
}
kept() {
  head -c MOST
  [ "$(head -c 1 | wc -c)" -eq 0 ] || printf '\n%s' 'MORE'
  cat > /dev/null
}
run() {
  record=$({
    log=$("$@" 3>&4 4>&- 2>&1 > /dev/null | kept)
    printf '%s' "$log" | sed 's/^/  /'
  } 4>&1)
  case $record in [!\ ]*) return 1 ;; esac
}
fail() {
  printf '\f%s\n%s\n\n' "$2" "$record"
  rm -f "$1"
}
'''.replace("MOST", str(MOST_SAID)).replace("MORE", MORE)
# Where a tool names a line of its framed input.
FRAMED_LINE = re.compile(rb"^((?:view|project|zbuf|trace): .*?<stdin>:)(\d+)", re.M)
STATUS = r"^(\w+): status (-?\d+)$"
# Lines of --timing, of trace's --probe, and of stages in sh.
NO_REASON = re.compile(r": note: |^\w+: \d+ triangles? in |^\d+,\d+: |" + STATUS)


class Done:
    """A tool that has ended: its name, its status and the lines of its stderr."""
    def __init__(self, name, status, stderr):
        self.name, self.status = name, status
        lines = list(map(shown, beginning(stderr).decode(errors="surrogateescape").strip().splitlines()))
        self.notes = [line for line in lines if ": note: " in line or line == MORE]
        self.reasons = [line for line in lines if not NO_REASON.search(line)]


def expect_success(*pipe):
    """Raises the error of the first tool that was killed, else of the first that failed: the others only lost
    their input or their reader."""
    failed = [tool for tool in pipe if tool.status]
    for tool in sorted(failed, key=lambda tool: (tool.status == -signal.SIGPIPE, tool.status > 0)):
        if tool.status < 0:
            names = {each: each.name for each in signal.Signals}
            raise ToolCrash(f"{tool.name}: ended by {names.get(-tool.status, f'signal {-tool.status}')}")
        if not tool.reasons:
            raise ToolCrash(f"{tool.name}: exit status {tool.status}")
        is_out = tool.reasons[-1] == f"{tool.name}: not enough memory"
        failure = (ToolOutOfMemory if is_out else ToolFailure)("\n".join(tool.reasons))
        failure.is_misuse = tool.status == 2
        raise failure


def failure_of_jobs(printed):
    """The reason why the first job failed in which a tool failed; empty if there is none."""
    job, _, record = printed.split("\n\n")[0].partition("\n")
    statuses, log = dict(re.findall(STATUS, record, re.M)), re.findall("^  (.*)", record, re.M)
    own = {tool: "\n".join(line for line in log if f"{tool}: " in line or line == MORE) for tool in statuses}
    try:
        expect_success(*(Done(tool, int(statuses[tool]), own[tool].encode()) for tool in PIPE if tool in own))
    except CommandFailure as failure:
        return f"{job}: {failure}"
    return ""


def checked(done, tool, words=()):
    """The finished run of a tool, or its error (expect_success, expect_files)."""
    expect_success(Done(tool, done.returncode, done.stderr))
    expect_files(tool, words)
    return done


def file_of_image(word):
    """The path in a word for --image, which may begin with a format."""
    return re.sub("^(bmp|ppm|png):", "", str(word))


def expect_files(tool, words, folder=None):
    """Raises an error if a file of the command's own, a Path among the words, is not there after the run in a
    folder, or the picture is not whole, unless it is a device or a pipe."""
    for option, word in zip(["", *words], words):
        is_image, is_own = option == "--image", isinstance(word, pathlib.Path)
        path = os.path.join(folder or "", file_of_image(word) if is_image else str(word))
        name = shown(os.path.basename(path) if is_own else path)
        if is_own and not os.path.exists(path):
            raise ToolCrash(f"{tool}: has not written {name}, though it ended well")
        is_picture = is_image and path != "-" and own_descriptor(target_of(path)) is None
        if is_picture and os.path.isfile(path) and os.access(path, os.R_OK) and not is_complete(path):
            raise ToolCrash(f"{tool}: has not written all of {name}, though it ended well")


def expect_rows(depths, count):
    """Raises an error if a text of depths, unless it is a device or a pipe, lacks rows."""
    if os.path.isfile(depths):
        with open(depths, "rb") as file:
            if sum(1 for _ in file) != count:
                raise ToolCrash("zbuf: has not written all of the depths, though it ended well")


class Tools:
    """The tools in a folder, by default $BIN, else default_folder(). For a command of many pipes, zbuf and
    trace draw on one thread each."""
    def __init__(self, folder=None, has_many_pipes=False):
        self.one_thread = ["--threads", "1"] if has_many_pipes else []
        # Absolute, since a bare name would be looked up on the PATH, where `view` is an editor.
        self.folder = pathlib.Path(folder or os.environ.get("BIN") or default_folder()).absolute()
        if not os.access(self.folder / "zbuf", os.X_OK):
            raise ToolFailure(f"no tools in {self.folder}: build them (scripts/demo does), or set BIN")

    def expect(self, *tools, png=False):
        """Raises a ToolFailure if the build lacks a tool, or PNG though the last tool is to write it."""
        for tool in tools:
            if not os.access(self.folder / tool, os.X_OK):
                raise ToolFailure(f"no {tool} in {self.folder}: 'cmake --build --preset release' builds it")
        if png:
            words = ["--size", "1x1", "--z-buffer", "none", "--image", f"png:{os.devnull}"]
            self.run(tool, *words, *["--ortho", *"010112"] * (tool == "trace"))

    def fingerprint(self, tools, *words):
        """One line that changes with the words, and with the bytes of the tools that work on them."""
        return " ".join([*words, *(digest(self.folder / tool) for tool in tools)])

    def command(self, tool, words):
        return [self.folder / tool, *(self.one_thread if tool in ("zbuf", "trace") else []), *map(str, words)]

    def run(self, tool, *words, stdin=b"", most=MOST_SAID):
        """A finished run with the bytes `stdin` as input, its stdout and `most` of its stderr as bytes."""
        done = run(self.command(tool, words), most, input=stdin, stdout=subprocess.PIPE)
        checked(done, tool, words)
        if tool in PIPE and not done.stdout.isascii():
            raise ToolCrash(f"{tool}: has written bytes that are no text, though it ended well")
        return done

    def output(self, tool, *words, stdin=b""):
        return self.run(tool, *words, stdin=stdin).stdout

    def pipe(self, *calls, stdin=subprocess.DEVNULL, stdout=None, tee=lambda source: source, cwd=None,
             is_kept=False):
        """Runs tools at once, each a list of its name and its words; each reads the output of the one before
        it, by way of `tee`. Returns them as Done, with CPU `seconds`. If several run, they frame texts; so
        does one whose text `is_kept` by bare_blocks."""
        self.expect(*(tool for tool, *_ in calls))
        with contextlib.ExitStack() as stack:
            runs, source = [], stdin
            for tool, *words in calls:
                framing = FRAMING.get(tool, []) if len(calls) > 1 or is_kept else []
                is_last = len(runs) == len(calls) - 1
                said = stack.enter_context(Said())
                output = stdout if is_last else subprocess.PIPE
                with source if runs else contextlib.nullcontext():  # closed also if the tool does not start
                    process = subprocess.Popen(self.command(tool, [*framing, *words]), cwd=cwd, stdin=source,
                                               stdout=output, stderr=said.file)
                source = None if is_last else tee(process.stdout)
                runs.append((tool, process, said))
            seconds = [cpu_seconds(finished(process)) for _, process, _ in runs]
        told = of_bare_text if is_kept else bytes
        done = [Done(tool, process.returncode, told(said.text)) for tool, process, said in runs]
        expect_success(*done)
        for each, each.seconds, (tool, *words) in zip(done, seconds, calls):
            expect_files(tool, words, cwd)
        return done

    def through(self, *runs, stdin=b""):
        """The output of a pipe of tools, each a list of its name and its words."""
        for words in runs:
            stdin = self.output(*words, stdin=stdin)
        return stdin

    def write(self, path, tool, *words):
        """Runs a tool with its stdout in a file; returns its notes."""
        with open(path, "wb") as file:
            [done] = self.pipe([tool, *words], stdout=file)
        return done.notes

    @staticmethod
    @contextlib.contextmanager
    def file(data):
        """The path of a file with these bytes, for an option that takes no pipe."""
        with tempfile.NamedTemporaryFile() as file:
            file.write(data)
            file.flush()
            yield file.name
