"""The frames of a film: a folder with a picture each, and what they were drawn from."""
import hashlib
import itertools
import os
import pathlib
import re
import shlex
import subprocess
import tempfile

from film_parts.scene import number
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import read_input
from lib.rim.output_file import OutputFile, write_file
from lib.rim.parallel import Job, run_parallel
from lib.rim.work_folder import WorkFolder
from lib.running.pipe_tools import STAGES_IN_SHELL, failure_of_jobs
from lib.showing.pictures import PNG_SIGNATURE, png, png_chunk, png_chunks

FRAMES_PER_JOB = 8
MOST_FRAMES = 99999
TEXTS = ("world.txt", "config.txt", "frames.txt", "draw.sh")
USE = "-work"  # of a folder that goes when the film is there
WORK = ".pipeline-film-work"
# The command that draws the text of view; $projection is split into words.
RASTERIZED = "stage project $projection | stage zbuf config.txt --expect-framed"
TRACED = "stage trace config.txt --expect-framed $projection"
# In a frame's folder: the stages on one camera. Their notes get the frame's name; the picture appears
# complete or not at all, as world.txt is framed. $1 is the picture, $2 the camera's words, $3 the
# projection's; the rest are the drawing stage's, DRAWING. A frame that fails ends all jobs that begin later.
DRAW = r'''pipe() {
  picture=$1 camera=$2 projection=$3; shift 3
  stage view $camera world.txt | DRAWING --z-buffer none "$@" --image "$picture"
}
draw() {
  [ ! -e "$1" ] || return 0
  run pipe "$@" || { fail "$1" "${1%.png} ($2)"; rm -f draw.sh; exit 1; }
  printf '%s' "$record" | sed "s|^  |${1%.png} ($2): |" >&2
}
'''


def is_whole(path):
    """True if it is a PNG file whose chunks all have their checksums, to the last."""
    data = pathlib.Path(path).read_bytes() if os.path.isfile(path) and not os.path.islink(path) else b""
    chunks = list(png_chunks(data))
    return chunks[-1:] == [
        (b"IEND", b"")] and data == PNG_SIGNATURE + b"".join(itertools.starmap(png_chunk, chunks))


def words_of(vector):
    return " ".join(map(number, vector))


def encode(folder, film, fps, frame_count):
    """Makes a film of the frames in a folder. Frames of an odd size get a column or a row more, which the
    pixel format asks for. Pictures of the user after the last frame are left out."""
    words = [
        "ffmpeg", "-loglevel", "error", "-y", "-framerate",
        number(fps), "-i", "%05d.png", "-frames:v",
        str(frame_count)]
    if not film.lower().endswith(".gif"):
        words += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
    done = subprocess.run([*words, film], cwd=folder, stdin=subprocess.DEVNULL, capture_output=True,
                          text=True)
    if done.returncode != 0:
        reasons = done.stderr.strip().splitlines() or [f"status {done.returncode}"]
        raise CommandFailure(f"ffmpeg: {reasons[-1]}")


def expect_encoder(film, fps):
    """Raises the CommandFailure of an ffmpeg that makes no such film, before there is any work."""
    with tempfile.TemporaryDirectory() as folder:
        write_file(os.path.join(folder, "00000.png"), png(16, 16, [bytes(48)] * 16))
        encode(folder, "film" + pathlib.Path(film).suffix, fps, 1)


def listed(folder):
    """What the frames in a folder were drawn from, and the line of each frame there."""
    path = folder / "frames.txt"
    data = read_input(path, only_regular=True) if path.exists() else b""
    source, *lines = data.decode(errors="replace").splitlines() or [""]
    return source, {line.split(" ", 1)[0]: line for line in lines if re.match(r"\d{5}\.png\b", line)}


class Frames:
    """They are drawn in a folder to work in, which stays for a retry, and appear when all are there."""
    def __init__(self, tools, scene, cameras, drawing, drawing_words):
        if len(cameras) > MOST_FRAMES:
            raise CommandFailure(f"expected at most {MOST_FRAMES} frames, found {len(cameras)}")
        self.tools, self.scene, self.drawing, self.drawing_words = tools, scene, drawing, drawing_words
        self.names = [f"{i:05d}.png" for i in range(len(cameras))]
        self.views = [
            f"--eye {words_of(c.eye)} --look {words_of(c.look)} --up {words_of(c.up)}" for c in cameras]
        self.projections = [" ".join(scene.projection_words(c)) for c in cameras]
        self.lines = {
            words[0]: " ".join(words).strip()
            for words in zip(self.names, self.views, self.projections)}
        stages = ["view", *re.findall(r"stage (\w+)", drawing)]
        words = tools.fingerprint(stages, drawing, *drawing_words).encode()
        self.source = hashlib.sha256(scene.world + b"\0" + scene.config + b"\0" + words).hexdigest()

    def list_of(self, lines):
        return "".join(line + "\n" for line in [self.source, *lines]).encode()

    def stock(self, folder):
        """The names of frames in a folder: whole ones of these cameras, and others that film has drawn."""
        source, lines = listed(folder)
        foreign = [name for name in self.names if name not in lines and os.path.lexists(folder / name)]
        if foreign:
            raise CommandFailure(f"expected no {foreign[0]} in {shown(folder.path)} that film has not drawn")
        same = lines.items() & self.lines.items() if source == self.source else ()
        right = {name for name, _ in same if is_whole(folder / name)}
        return right, lines.keys() - right

    def job(self, frames):
        """A line of shell that draws some frames."""
        words = " ".join(map(shlex.quote, self.drawing_words))
        calls = [
            f"draw {self.names[i]} {shlex.quote(self.views[i])} {shlex.quote(self.projections[i])} {words}"
            for i in frames]
        return ". ./draw.sh 2> /dev/null; " + "; ".join(calls)

    def draw(self, folder, options_of_parallel, others=frozenset()):
        """Draws frames in a folder, but for those that it has and the `others`."""
        right, stale = self.stock(folder)
        folder.remove_others(stale.__contains__)
        folder.remove_files(stale.__contains__)
        settings = f"bin={shlex.quote(str(self.tools.folder))}\n" + STAGES_IN_SHELL
        for name, data in zip(TEXTS, (self.scene.world, self.scene.config, self.list_of(self.lines.values()),
                                      (settings + DRAW.replace("DRAWING", self.drawing)).encode())):
            folder.write(name, data)
        missing = [i for i, name in enumerate(self.names) if name not in right | others]
        if not missing:
            return
        groups = [missing[i:i + FRAMES_PER_JOB] for i in range(0, len(missing), FRAMES_PER_JOB)]
        jobs = [Job(self.job(group), gives=[self.names[i] for i in group]) for group in groups]
        common = ["world.txt", "config.txt", "draw.sh"]
        printed = run_parallel(folder.path, jobs, "film", common, options_of_parallel)
        missing = [i for i in missing if not is_whole(folder / self.names[i])]
        if missing:
            first = f"the first is {self.names[missing[0]]} ({self.views[missing[0]]})"
            raise CommandFailure(
                f"{len(missing)} of {len(self.names)} frames have not been drawn: "
                f"{failure_of_jobs(printed) or first}; the same command draws those that are missing")

    def keep(self, path, options_of_parallel):
        """Makes a folder of frames. Older ones there stay until all new ones are whole."""
        out = WorkFolder(path, "film")
        with out.taken(), (work := WorkFolder(out / WORK, "film", USE)).taken():
            right, stale = self.stock(out)
            self.draw(work, options_of_parallel, right)
            new = set(self.names) - right
            # Whenever this is killed, the list has all names, and no new frame as one of the older film.
            out.write("frames.txt", self.list_of([*stale | new, *map(self.lines.get, right)]))
            work.move([*sorted(new), *(name for name in TEXTS if name != "frames.txt")], out)
            out.remove_files((stale - new).__contains__)
            work.move(["frames.txt"], out)
            work.remove({*self.names}.__contains__)

    def make_film(self, path, fps, options_of_parallel):
        made = "film" + pathlib.Path(path).suffix
        with (work := WorkFolder(path + ".frames", "film", USE)).taken():
            self.draw(work, options_of_parallel)
            work.remove_others(made.__eq__)
            encode(work.path, made, fps, len(self.names))
            with OutputFile(path) as film, open(work / made, "rb") as file:
                film.copy(file)
                film.commit()
            work.remove({*self.names, *TEXTS, made}.__contains__)
