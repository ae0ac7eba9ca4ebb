"""The frames of a film: a folder with a picture each, and what they were drawn from."""
import hashlib
import os
import pathlib
import shlex
import shutil
import subprocess

from film_parts.scene import number
from lib.command import CommandFailure
from lib.output_file import write_file
from lib.parallel import Job, run_parallel

FRAMES_PER_JOB = 8
MOST_FRAMES = 99999
# What draws the text of view; $projection is split into words.
RASTERIZED = '"$bin/project" $projection | "$bin/zbuf" config.txt'
TRACED = '"$bin/trace" config.txt $projection'
# In a frame's folder: the stages on one camera. What they say is told with the frame's name; the picture appears complete or
# not at all. $1 is the picture, $2 the camera's words, $3 the projection's; the rest are the drawing stage's, DRAWING.
DRAW = r'''draw() {
  picture=$1 camera=$2 projection=$3; shift 3
  [ ! -e "$picture" ] || return 0
  if { "$bin/view" $camera world.txt | DRAWING --z-buffer none "$@" --image "$picture"; } 2> "$picture.log"
  then done=yes; else done=no failed=yes; fi
  sed "s|^|${picture%.png} ($camera): |" "$picture.log" >&2
  rm -f "$picture.log"
}'''


def words_of(vector):
    """A component that is 0 but for the last bits of sin and cos is 0."""
    least = 1e-12 * max(map(abs, vector))
    return " ".join(number(x if abs(x) > least else 0) for x in vector)


class Frames:
    def __init__(self, tools, folder, scene, cameras, drawing, drawing_words):
        if len(cameras) > MOST_FRAMES:
            raise CommandFailure(f"expected at most {MOST_FRAMES} frames, found {len(cameras)}")
        self.tools, self.folder, self.scene, self.drawing, self.drawing_words = tools, folder, scene, drawing, drawing_words
        self.names = [f"{i:05d}.png" for i in range(len(cameras))]
        self.views = [f"--eye {words_of(c.eye)} --look {words_of(c.look)} --up {words_of(c.up)}" for c in cameras]
        self.projections = [" ".join(scene.projection_words(c)) for c in cameras]

    def prepare(self):
        """Writes what frames are drawn from. Those that were drawn from something else are removed."""
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CommandFailure(f"cannot make the folder {self.folder}: {error.strerror}") from None
        source = hashlib.sha256(self.scene.world + b"\0" + self.scene.config + b"\0" + " ".join([self.drawing, *self.drawing_words]).encode()).hexdigest()
        cameras = [f"{name} {view} {projection}".strip() for name, view, projection in zip(self.names, self.views, self.projections)]
        list_file = self.folder / "frames.txt"
        former_source, *former = list_file.read_text().splitlines() if list_file.exists() else [""]
        kept = set(former) if former_source == source else set()
        expected = set(self.names)
        for path in self.folder.glob("[0-9]" * 5 + ".png"):
            if path.name not in expected or cameras[int(path.stem)] not in kept:
                path.unlink()
        write_file(self.folder / "world.txt", self.scene.world)
        write_file(self.folder / "config.txt", self.scene.config)
        write_file(list_file, "".join(line + "\n" for line in [source, *cameras]).encode())

    def missing(self):
        return [i for i, name in enumerate(self.names) if not (self.folder / name).exists()]

    def job(self, frames):
        """A line of shell that draws some frames."""
        words = " ".join(map(shlex.quote, self.drawing_words))
        calls = [f"draw {self.names[i]} {shlex.quote(self.views[i])} {shlex.quote(self.projections[i])} {words}" for i in frames]
        return ". ./draw.sh; " + "; ".join(calls) + '; [ -z "$failed" ]'

    def draw(self, options_of_parallel):
        self.prepare()
        missing = self.missing()
        if not missing:
            return
        write_file(self.folder / "draw.sh", f"bin={shlex.quote(str(self.tools.folder))} failed=\n{DRAW.replace('DRAWING', self.drawing)}\n".encode())
        groups = [missing[i:i + FRAMES_PER_JOB] for i in range(0, len(missing), FRAMES_PER_JOB)]
        jobs = [Job(self.job(group), gives=[self.names[i] for i in group]) for group in groups]
        status = run_parallel(self.folder, jobs, "film", ["world.txt", "config.txt", "draw.sh"], options_of_parallel)
        missing = self.missing()
        if missing:
            raise CommandFailure(f"{len(missing)} of {len(self.names)} frames have not been drawn, the first is {self.names[missing[0]]} ({self.views[missing[0]]}); "
                                 "the same command draws those that are missing")
        if status != 0:
            raise CommandFailure(f"parallel ended with status {status}, though all frames are there")

    def make_film(self, path, fps):
        """Frames of an odd size get a column or a row more, which the pixel format asks for."""
        new = pathlib.Path(path).with_name(".pipeline-" + pathlib.Path(path).name)
        words = ["ffmpeg", "-loglevel", "error", "-y", "-framerate", number(fps), "-i", str(self.folder / "%05d.png")]
        if not path.lower().endswith(".gif"):
            words += ["-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p"]
        done = subprocess.run([*words, f"file:{new}"], stdin=subprocess.DEVNULL, capture_output=True, text=True)
        if done.returncode != 0:
            new.unlink(missing_ok=True)
            raise CommandFailure("ffmpeg: " + (done.stderr.strip().splitlines() or [f"status {done.returncode}"])[-1])
        os.replace(new, path)
        shutil.rmtree(self.folder)
