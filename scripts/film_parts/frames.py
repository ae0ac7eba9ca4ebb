"""The frames of a film: numbered pictures in a folder, and a list of their cameras."""
import hashlib
import itertools
import os
import pathlib
import re
import shlex
import subprocess
import tempfile

from film_parts.scene import number
from lib.rim.child import run
from lib.rim.command import CommandFailure, shown, unbroken
from lib.rim.input_file import read_input
from lib.rim.output_file import OutputFile, write_file
from lib.rim.parallel import Job, run_parallel
from lib.rim.work_folder import OURS, WorkFolder
from lib.running.pipe_tools import STAGES_IN_SHELL, Done, failure_of_jobs
from lib.showing.pictures import PNG_SIGNATURE, png, png_chunk, png_chunks

FRAMES_PER_JOB = 8
MOST_FRAMES = 99999
COMMON = ("world.txt", "config.txt", "draw.sh")  # files that all jobs read
TEXTS = (*COMMON, "frames.txt")
USE = "-work"  # of a folder that is removed when the film is complete
WORK = OURS + "film" + USE
# The stages after view. The shell splits $projection into words.
RASTERIZED = "stage project $projection | stage zbuf config.txt --expect-framed"
TRACED = "stage trace config.txt --expect-framed $projection"
# Draws the picture $1. $2 holds options for view, $3 for project; all others are for the last stage. Since
# world.txt is framed, the picture appears complete or not at all. Each note begins with its name. A frame
# that fails removes draw.sh, so that jobs that begin later end at once.
DRAW = r'''pipe() {
  picture=$1 camera=$2 projection=$3; shift 3
  stage view $camera world.txt | DRAWING --z-buffer none "$@" --image "$picture"
}
draw() {
  [ ! -e "$1" ] || return 0
  run pipe "$@" || { fail "$1" "${1%.png} ($2)"; rm -f draw.sh; exit 1; }
  [ -z "$record" ] || printf '%s\n' "$record" | sed "s|^  |${1%.png} ($2): |" >&2
}
'''


def is_whole(path):
    """True if the file is a complete PNG with the right checksums."""
    data = pathlib.Path(path).read_bytes() if os.path.isfile(path) and not os.path.islink(path) else b""
    chunks = list(png_chunks(data))
    return chunks[-1:] == [
        (b"IEND", b"")] and data == PNG_SIGNATURE + b"".join(itertools.starmap(png_chunk, chunks))


def words_of(camera):
    """The options of view."""
    vectors = {"--eye": camera.eye, "--look": camera.look, "--up": camera.up}
    return " ".join(" ".join([option, *map(number, vector)]) for option, vector in vectors.items())


def encode(folder, film, fps, frame_count):
    """Encodes the frames in a folder as a film. The pixel format needs even sizes, so odd frames are padded
    by a column or a row. Later numbers are left out: those pictures are the user's."""
    words = ["ffmpeg", "-loglevel", "error", "-y", "-framerate", number(fps), "-i", "%05d.png"]
    words += ["-frames:v", str(frame_count)]
    if not film.lower().endswith(".gif"):
        words += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
    done = run([*words, film], cwd=folder, stdin=subprocess.DEVNULL)
    if done.returncode != 0:
        reasons = Done("ffmpeg", done.returncode, done.stderr).reasons or [f"status {done.returncode}"]
        raise CommandFailure(f"ffmpeg: {reasons[-1]}")


def expect_encoder(film, fps):
    """Encodes a tiny film, so that an ffmpeg that cannot fails before the first frame is drawn."""
    with tempfile.TemporaryDirectory() as folder:
        write_file(os.path.join(folder, "00000.png"), png(16, 16, [bytes(48)] * 16))
        encode(folder, "film" + pathlib.Path(film).suffix, fps, 1)


def listed(folder):
    """The contents of a folder's frames.txt: the fingerprint of the film, and the line of each frame."""
    path = folder / "frames.txt"
    data = read_input(path, only_regular=True) if path.exists() else b""
    source, *lines = data.decode(errors="replace").splitlines() or [""]
    return source, {line.split(" ", 1)[0]: line for line in lines if re.match(r"\d{5}\.png\b", line)}


class Frames:
    """The frames are drawn in a work folder, which a retry uses again, and appear when all are complete."""
    def __init__(self, tools, scene, cameras, drawing, drawing_words):
        if len(cameras) > MOST_FRAMES:
            raise CommandFailure(f"expected at most {MOST_FRAMES} frames, found {len(cameras)}")
        self.tools, self.scene, self.drawing, self.drawing_words = tools, scene, drawing, drawing_words
        words = ((words_of(camera), " ".join(scene.projection_words(camera))) for camera in cameras)
        self.frames = {f"{i:05d}.png": pair for i, pair in enumerate(words)}
        self.lines = {name: " ".join([name, *words]).strip() for name, words in self.frames.items()}
        stages = ["view", *re.findall(r"stage (\w+)", drawing)]
        words = tools.fingerprint(stages, drawing, *drawing_words).encode()
        self.source = hashlib.sha256(b"\0".join([scene.world, scene.config, words])).hexdigest()

    def list_of(self, lines):
        return "".join(line + "\n" for line in [self.source, *lines]).encode()

    def stock(self, folder):
        """The names of the frames in a folder that film has drawn: complete ones of this film, and others."""
        source, lines = listed(folder)
        foreign = [name for name in self.frames if name not in lines and os.path.lexists(folder / name)]
        if foreign:
            raise CommandFailure(f"expected no {foreign[0]} in {shown(folder.path)} that film has not drawn")
        same = lines.items() & self.lines.items() if source == self.source else ()
        right = {name for name, _ in same if is_whole(folder / name)}
        return right, lines.keys() - right

    def job(self, names):
        """The job that draws these frames."""
        calls = [shlex.join(["draw", name, *self.frames[name], *self.drawing_words]) for name in names]
        return Job(". ./draw.sh 2> /dev/null; " + "; ".join(calls), gives=names)

    def draw(self, folder, options_of_parallel, others=frozenset()):
        """Draws the frames that are neither in the folder yet nor among the `others`."""
        right, stale = self.stock(folder)
        folder.remove_others(stale.__contains__)
        folder.remove_files(stale.__contains__)
        draw = f"bin={shlex.quote(str(self.tools.folder))}\n" + STAGES_IN_SHELL
        draw += DRAW.replace("DRAWING", self.drawing)
        texts = self.scene.world, self.scene.config, draw.encode(), self.list_of(self.lines.values())
        for name, data in zip(TEXTS, texts):
            folder.write(name, data)
        missing = [name for name in self.frames if name not in right | others]
        if not missing:
            return
        jobs = [self.job(missing[i:i + FRAMES_PER_JOB]) for i in range(0, len(missing), FRAMES_PER_JOB)]
        printed = run_parallel(folder.path, jobs, "film", COMMON, options_of_parallel)
        missing = [name for name in missing if not is_whole(folder / name)]
        if missing:
            first = f"the first is {missing[0]} ({self.frames[missing[0]][0]})"
            raise CommandFailure(
                f"{len(missing)} of {len(self.frames)} frames have not been drawn: "
                f"{failure_of_jobs(printed) or first}; the same command draws those that are missing")

    def keep(self, path, options_of_parallel):
        """Makes a folder of frames. Older frames stay until all new ones are complete."""
        out = WorkFolder(path, "film")
        with out.taken(), (work := WorkFolder(out / WORK, "film", USE)).taken():
            right, stale = self.stock(out)
            self.draw(work, options_of_parallel, right)
            new = self.frames.keys() - right
            with unbroken():
                # If we are killed here, the list names every frame, and no older one as one of this film's.
                out.write("frames.txt", self.list_of([*stale | new, *map(self.lines.get, right)]))
                work.move([*sorted(new), *COMMON], out)
                out.remove_files((stale - new).__contains__)
                work.move(["frames.txt"], out)
                work.remove(self.frames.__contains__)

    def make_film(self, path, fps, options_of_parallel):
        made = "film" + pathlib.Path(path).suffix
        with (work := WorkFolder(path + ".frames", "film", USE)).taken():
            self.draw(work, options_of_parallel)
            work.remove_others(made.__eq__)
            encode(work.path, made, fps, len(self.frames))
            with OutputFile(path) as film, open(work / made, "rb") as file:
                film.copy(file)
                film.commit()
            work.remove({*self.frames, *TEXTS, made}.__contains__)
