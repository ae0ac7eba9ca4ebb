"""The work of farm: a folder with the scene's parts, what is seen of each, and what is left to do."""
import hashlib
import pathlib
import re
import shlex
import subprocess
import sys
from dataclasses import dataclass

from lib.rim.command import CommandFailure
from lib.rim.input_file import input_errors, read_input
from lib.rim.output_file import OutputFile
from lib.rim.parallel import Job, run_parallel
from lib.rim.work_folder import WorkFolder
from lib.running.pipe_tools import checked

RETRIES = 3
RETRIES_OVER_SSH = 6  # one a bad host, and some for the job's own bad luck
PER_JOIN = 8  # texts, or fewer
# Where a machine does not answer, another one has to be tried soon. A user's own --ssh is given later, and
# holds.
SSH = "ssh -o BatchMode=yes -o ConnectTimeout=10 -o ServerAliveInterval=5"
# The files of the folder.
OWN = re.compile(r"(config|parts|source|parts/\d+)\.txt|work.sh|jobs.log|seen-[-\d]+.txt(.log)?|band\d+\.\w+")
# What jobs call, in the folder. What the tools say is told with the job's output if it fails. The output
# appears complete or not at all, and zbuf makes it only of a framed text, which nobody has cut short.
WORK = r'''
seen() {
  if { "$@"; } 2> "$output.log"; then rm -f "$output.log"; return 0; fi
  sed "s|^|$output: |" "$output.log" >&2
  rm -f "$output.log"
  return 1
}
draw() { "$bin/model" --framed --first "$2" "$1" | "$bin/view" | "$bin/project" $project | keep; }
merge() { "$bin/join-seen" --expect-framed "$@" | keep; }
keep() { "$bin/zbuf" config.txt --expect-framed $zbuf $rows --seen "$output"; }
'''


@dataclass(frozen=True)
class Settings:
    parts: int
    bands: int
    project: list
    zbuf: list
    for_parallel: list


def digest(path):
    state = hashlib.sha256()
    with input_errors(path), open(path, "rb") as file:
        while block := file.read(1 << 20):
            state.update(block)
    return state.hexdigest()


class Work:
    def __init__(self, tools, folder, settings):
        self.tools, self.folder, self.settings = tools, WorkFolder(folder, "farm"), settings

    def prepare(self, scene, config):
        """Cuts the scene, unless the folder has parts of this scene for these settings."""
        settings, config = self.settings, read_input(config)
        source = " ".join([
            digest(scene),
            hashlib.sha256(config).hexdigest(),
            str(settings.parts),
            str(settings.bands), *settings.project, "/", *settings.zbuf]) + "\n"
        self.folder.take()
        self.folder.remove_links(lambda name: name == "parts" or OWN.fullmatch(name))
        marker = self.folder / "source.txt"
        if not marker.exists() or marker.read_text() != source:
            self.folder.remove_files(OWN.fullmatch)
            try:
                self.cut(scene, config)
            except BaseException:  # there is nothing to go on with
                self.remove()
                raise
            self.folder.write("source.txt", source.encode())
        self.parts = [line.split() for line in (self.folder / "parts.txt").read_text().splitlines()]
        rows = int(re.sub(rb"#.*", b"", config).split()[1])
        cuts = [rows * i // settings.bands for i in range(settings.bands + 1)]
        self.bands = [(first, end) for first, end in zip(cuts, cuts[1:]) if first < end]
        words = {
            "bin": str(self.tools.folder), "project": " ".join(settings.project),
            "zbuf": " ".join(settings.zbuf)}
        settings = "".join(f"{name}={shlex.quote(word)}\n" for name, word in words.items())
        self.folder.write("work.sh", (settings + WORK).encode())

    def cut(self, scene, config):
        self.folder.write("config.txt", config)
        self.check_settings()
        words = ["cut-scene", pathlib.Path(scene).absolute(), str(self.settings.parts), "-o", "parts"]
        self.folder.write("parts.txt", self.run_here(self.tools.folder, *words).stdout)

    def run_here(self, folder, name, *words):
        done = subprocess.run([folder / name, *words], cwd=self.folder.path, capture_output=True)
        return checked(done, name)

    def check_settings(self):
        """An empty text through the tools: what they refuse, every job would. Only --shading depends on the
        scene."""
        words = self.settings.zbuf
        at = words.index("--shading") if "--shading" in words else len(words)
        ndc = self.tools.output("project", *self.settings.project,
                                stdin=b"framed\nperspective 60 1 1 2\nend\n")
        words = [*words[:at], *words[at + 2:], "--seen", "/dev/null"]
        self.tools.run("zbuf", *words, "--", self.folder / "config.txt", stdin=ndc)

    def words_of_rows(self, band):
        return f"--rows {band[0]}:{band[1]}" if len(self.bands) > 1 else ""

    def run(self, jobs, options, what):
        """Runs the jobs whose output is missing; each is (output, call, inputs, band)."""
        left = [job for job in jobs if not (self.folder / job[0]).exists()]
        if left:
            lines = [
                Job(f'. ./work.sh; output={output}; rows="{self.words_of_rows(band)}"; seen {call}', inputs,
                    [output]) for output, call, inputs, band in left]
            words = ["--joblog", f"{'+' * (self.folder / 'jobs.log').exists()}jobs.log"]
            is_over_ssh = any(word.startswith(("--sshlogin", "-S")) for word in options)
            words += ["--retries", str(RETRIES_OVER_SSH), "--ssh", SSH] if is_over_ssh else [
                "--retries", str(RETRIES)]
            run_parallel(self.folder.path, lines, "farm", ["config.txt", "work.sh"], [*words, *options])
        missing = [job for job in jobs if not (self.folder / job[0]).exists()]
        if missing:
            raise CommandFailure(
                f"no picture: {len(missing)} of {len(jobs)} {what} missing, the first is {missing[0][0]} (of "
                f"{' '.join(missing[0][2])}); "
                f"{self.folder / 'jobs.log'} tells where they ran, and the same command does what is left")

    def draw_parts(self):
        jobs = []
        for b, band in enumerate(self.bands):
            for part, first in self.parts:
                jobs.append(
                    (f"seen-{b}-0-{pathlib.Path(part).stem}.txt", f"draw {part} {first}", [part], band))
        self.run(jobs, self.settings.for_parallel, "parts are")

    def join_parts(self):
        """Joins the texts of a band as a tree, on this machine: there is little left of them."""
        self.seen = [[f"seen-{b}-0-{pathlib.Path(part).stem}.txt"
                      for part, _ in self.parts]
                     for b in range(len(self.bands))]
        level = 0
        while len(self.seen[0]) > PER_JOIN:
            level += 1
            jobs, joined = [], []
            for b, band in enumerate(self.bands):
                groups = [self.seen[b][i:i + PER_JOIN] for i in range(0, len(self.seen[b]), PER_JOIN)]
                joined.append([f"seen-{b}-{level}-{k}.txt" for k in range(len(groups))])
                jobs += [(output, "merge " + " ".join(group), group, band)
                         for output, group in zip(joined[-1], groups)]
            self.run(jobs, [], "joined texts are")
            self.seen = joined

    def make_picture(self, output, z_buffer):
        images, depths = [], []
        extension = pathlib.Path(output).suffix
        for b, band in enumerate(self.bands):
            image, depth = f"band{b}{extension}", f"band{b}.txt"
            if len(self.bands) == 1:
                image, depth = pathlib.Path(output).absolute(), pathlib.Path(
                    z_buffer).absolute() if z_buffer else "none"
            self.draw(self.seen[b], self.words_of_rows(band), image, depth if z_buffer else "none")
            images.append(image)
            depths.append(depth)
        if len(self.bands) == 1:
            return
        scripts = pathlib.Path(__file__).resolve().parents[1]
        self.run_here(scripts, "join-images", *images, "-o", pathlib.Path(output).absolute())
        if z_buffer:
            with OutputFile(z_buffer) as text:
                for depth in depths:
                    with open(self.folder / depth, "rb") as file:
                        text.copy(file)
                text.commit()

    def draw(self, texts, rows, image, depth):
        words = [self.tools.folder / "join-seen", "--expect-framed", *texts]
        joining = subprocess.Popen(words, cwd=self.folder.path, stdout=subprocess.PIPE)
        words = [
            self.tools.folder / "zbuf", "config.txt", "--expect-framed", *self.settings.zbuf, *rows.split(),
            "--image", image, "--z-buffer", depth]
        drawing = subprocess.run(words, cwd=self.folder.path, stdin=joining.stdout, stderr=subprocess.PIPE)
        joining.stdout.close()
        joining.wait()
        checked(drawing, "zbuf")
        for line in dict.fromkeys(drawing.stderr.decode(errors="replace").splitlines()):
            print(line, file=sys.stderr)

    def remove(self):
        self.folder.remove(OWN.fullmatch)
