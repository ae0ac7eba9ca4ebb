"""The frames of a film: a folder with a picture each, and what they were drawn from."""
import hashlib
import itertools
import os
import pathlib
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
# The command that draws the text of view; $projection is split into words.
RASTERIZED = "stage project $projection | stage zbuf config.txt --expect-framed"
TRACED = "stage trace config.txt --expect-framed $projection"
# In a frame's folder: the stages on one camera. Their notes get the frame's name; the picture appears
# complete or not at all, as world.txt is framed. $1 is the picture, $2 the camera's words, $3 the
# projection's; the rest are the drawing stage's, DRAWING. A frame that fails ends all jobs that begin later.
DRAW = r'''draw() {
  picture=$1 camera=$2 projection=$3; shift 3
  [ ! -e "$picture" ] || return 0
  statuses=$({ stage view $camera world.txt | DRAWING --z-buffer none "$@" --image "$picture"; } 3>&1 \
    > /dev/null 2> "$picture.log") && [ -z "$statuses" ] || {
    fail "$picture" "${picture%.png} ($camera)"
    echo "exit 1" > "$picture.log" && mv "$picture.log" draw.sh
    exit 1
  }
  sed "s|^|${picture%.png} ($camera): |" "$picture.log" >&2
  rm -f "$picture.log"
}
'''


def is_whole(path):
    """True if it is a PNG file whose chunks all have their checksums, to the last."""
    data = pathlib.Path(path).read_bytes() if os.path.isfile(path) else b""
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


class Frames:
    def __init__(self, tools, folder, scene, cameras, drawing, drawing_words):
        if len(cameras) > MOST_FRAMES:
            raise CommandFailure(f"expected at most {MOST_FRAMES} frames, found {len(cameras)}")
        self.tools, self.folder, self.scene = tools, WorkFolder(folder, "film"), scene
        self.drawing, self.drawing_words = drawing, drawing_words
        self.names = [f"{i:05d}.png" for i in range(len(cameras))]
        self.views = [
            f"--eye {words_of(c.eye)} --look {words_of(c.look)} --up {words_of(c.up)}" for c in cameras]
        self.projections = [" ".join(scene.projection_words(c)) for c in cameras]

    def prepare(self):
        """Writes what frames are drawn from. Those that film has drawn from something else, and those that
        are not whole, are removed."""
        self.folder.take()
        source = hashlib.sha256(self.scene.world + b"\0" + self.scene.config + b"\0" +
                                " ".join([self.drawing, *self.drawing_words]).encode()).hexdigest()
        lines = zip(self.names, self.views, self.projections)
        cameras = {words[0]: " ".join(words).strip() for words in lines}
        list_file = self.folder / "frames.txt"
        former = read_input(list_file, only_regular=True) if list_file.exists() else b""
        former_source, *former = former.decode(errors="replace").splitlines() or [""]
        drawn = {line.split(" ", 1)[0]: line for line in former}
        foreign = [name for name in self.names if name not in drawn and os.path.lexists(self.folder / name)]
        if foreign:
            where = shown(self.folder.path)
            raise CommandFailure(f"expected no {foreign[0]} in {where} that film has not drawn")
        self.folder.remove_others({*self.names, *(f"{name}.log" for name in self.names)}.__contains__)
        stale = {
            name
            for name, line in drawn.items()
            if former_source != source or cameras.get(name) != line or not is_whole(self.folder / name)}
        self.folder.remove_files(stale.__contains__)
        self.folder.write("world.txt", self.scene.world)
        self.folder.write("config.txt", self.scene.config)
        self.folder.write("frames.txt", "".join(line + "\n" for line in [source, *cameras.values()]).encode())

    def job(self, frames):
        """A line of shell that draws some frames."""
        words = " ".join(map(shlex.quote, self.drawing_words))
        calls = [
            f"draw {self.names[i]} {shlex.quote(self.views[i])} {shlex.quote(self.projections[i])} {words}"
            for i in frames]
        return ". ./draw.sh; " + "; ".join(calls)

    def draw(self, options_of_parallel):
        self.prepare()
        missing = [i for i, name in enumerate(self.names) if not os.path.exists(self.folder / name)]
        if not missing:
            return
        settings = f"bin={shlex.quote(str(self.tools.folder))}\n" + STAGES_IN_SHELL
        self.folder.write("draw.sh", (settings + DRAW.replace("DRAWING", self.drawing)).encode())
        groups = [missing[i:i + FRAMES_PER_JOB] for i in range(0, len(missing), FRAMES_PER_JOB)]
        jobs = [Job(self.job(group), gives=[self.names[i] for i in group]) for group in groups]
        common = ["world.txt", "config.txt", "draw.sh"]
        printed = run_parallel(self.folder.path, jobs, "film", common, options_of_parallel)
        missing = [i for i, name in enumerate(self.names) if not is_whole(self.folder / name)]
        if missing:
            first = f"the first is {self.names[missing[0]]} ({self.views[missing[0]]})"
            raise CommandFailure(
                f"{len(missing)} of {len(self.names)} frames have not been drawn: "
                f"{failure_of_jobs(printed) or first}; the same command draws those that are missing")

    def make_film(self, path, fps):
        made = "film" + pathlib.Path(path).suffix
        self.folder.remove_others(made.__eq__)
        encode(self.folder.path, made, fps, len(self.names))
        with OutputFile(path) as film, open(self.folder / made, "rb") as file:
            film.copy(file)
            film.commit()
        self.folder.remove({*self.names, *TEXTS, made}.__contains__)
