"""The window of scripts/fly: keys in, frames of the real pipe out."""
import dataclasses
import math
import pathlib
import time
import tkinter
import tkinter.font
import traceback

from fly_parts.camera import STEP, Camera
from fly_parts.framing import direction, framing_distance
from fly_parts.pipe import FramePipe
from fly_parts.scene import rewritten
from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import read_input
from lib.rim.output_file import write_file
from lib.showing.pictures import png, read_picture
from lib.text.projection import window_of

KEYS = """drag           orbit around the point looked at
wheel          nearer, farther
w/s a/d q/e    forward and back, left and right, up and down
arrows         turn on the spot
Home           bring the whole scene into sight
r              back to the start
c v            clip at the frustum, or do not
z/x            open, close a gap at the sides, to see cuts
b              cull backs
f              wireframe; again: with hidden edges
1 2 3 4        shading none, flat, gouraud, phong
i/k j/l u/o    move the first light
p P            write the scene, the picture
h              show or hide these keys
Escape         leave"""
NOT_TRACED = "cvzxbf"  # keys for options that trace lacks
MOVES = {"w": (0, 0, 1), "s": (0, 0, -1), "a": (-1, 0, 0), "d": (1, 0, 0), "q": (0, 1, 0), "e": (0, -1, 0)}
TURNS = {"Left": (-1, 0), "Right": (1, 0), "Up": (0, 1), "Down": (0, -1)}
NAMED_KEYS = (*TURNS, "Home", "Escape")
LIGHT_MOVES = {
    "i": (0, 0, -1), "k": (0, 0, 1), "j": (-1, 0, 0), "l": (1, 0, 0), "u": (0, 1, 0), "o": (0, -1, 0)}
SHADINGS = {"1": "none", "2": "flat", "3": "gouraud", "4": "phong"}
ORBIT = math.radians(0.4)  # for each pixel of a drag
WHEEL_BUTTONS = {4: 1, 5: -1}  # of X11; other systems have an event of their own
COLORS = {"foreground": "#e8e8e8", "background": "#202020"}
SLOW_SECONDS = 0.05  # a frame that takes longer is drawn small first
SMALL = 4  # how many times smaller
SIGNAL_MS = 200  # between two checks for a signal
REST_MS = 150  # without a key, until the full-size frame is drawn


@dataclasses.dataclass(frozen=True)
class Settings:
    camera: Camera
    is_clipped: bool = False
    inset: float = 0
    shading: str = ""
    culls: bool = False
    wireframe: int = 0  # words of --wireframe all

    def project_words(self):
        return (["--clip", "frustum"] if self.is_clipped or self.inset else []) + (["--cull", "back"]
                                                                                   if self.culls else [])

    def gap_words(self, projection):
        return narrowed(projection, 1 - self.inset) if self.inset else []

    def limits(self, limits):
        """A config's limits, all or none, for the projection of gap_words(): nothing moves on the screen."""
        if not self.inset:
            return limits
        *sides, z = limits or (["-1"], ["-1"], ["-1", "1"])
        return [*([repr(float(word) / (1 - self.inset))] for [word] in sides), z]

    def drawing_words(self):
        shading = ["--shading", self.shading] if self.shading else []
        return shading + ["--wireframe", "all"][:self.wireframe]


def keys_of(is_traced):
    """The list of keys, without NOT_TRACED if trace draws."""
    return "\n".join(
        line for line in KEYS.splitlines() if not is_traced or line.split()[0][0] not in NOT_TRACED)


def narrowed(projection, factor):
    """Words of project for a field of view whose sides are moved in; near and far stay, and so do depths.
    (--clip-inset would move all six planes, and a tenth of NDC depth is most of the way to far.)"""
    *sides, near, far = window_of(projection)
    kind = "--ortho" if "ortho" in projection else "--frustum"
    return [kind, *(repr(side * factor) for side in sides), repr(near), repr(far)]


def size_of_scene(projection, width):
    """A config with `width` columns and the aspect of the projection's window."""
    left, right, bottom, top, *_ = window_of(projection)
    return f"{width} {max(1, round(width * abs((top - bottom) / (right - left))))}\n"


class FlyWindow:
    """`config` is the text of a config, by default of least_width pixels with the scene's aspect. The window
    begins at least `least_width` pixels wide, and no larger than the screen. `words` are for the tool that
    draws the frames: trace where `is_traced`, else zbuf."""
    def __init__(self, tools, scene, config=None, scene_out="fly.txt", picture_out="fly.png", least_width=1,
                 words=(), is_traced=False):
        self.tools, self.scene = tools, pathlib.Path(scene)
        self.is_traced, self.more_words = is_traced, [*words]
        self.pipe = FramePipe(tools, scene, self.is_traced)
        config = config or size_of_scene(self.pipe.projection, least_width)
        self.outputs = scene_out, picture_out
        size, *self.limits = [
            line.split("#")[0].split() for line in config.split("\n") if line.split("#")[0].strip()]
        self.whole = tuple(map(int, size))
        self.least_width = least_width
        self.settings = self.start = Settings(
            Camera.of(*(self.pipe.header(name) for name in ("eye", "look", "up"))))
        self.start_light = self.pipe.light
        self.is_light_moved = False
        self.before = self.settings  # restored if a tool refuses the new ones
        self.whole_seconds = 0
        self.pending = self.resting = None
        self.drag = None  # the pointer's place while a button is down
        self.end = None  # the KeyboardInterrupt or Ended raised while a key or a frame was handled
        self.build()
        self.draw(self.size)

    def build(self):
        self.root = tkinter.Tk()
        self.root.title(f"fly {shown(self.scene.name)}")
        self.size = self.first_size()
        self.font = tkinter.font.nametofont("TkFixedFont", self.root).copy()
        self.font.configure(size=9)
        self.photo = tkinter.PhotoImage(master=self.root)
        # Of a fixed size: texts must not resize the window.
        self.status, self.readout = (tkinter.Label(self.root, anchor="nw", justify="left", font=self.font,
                                                   width=1, height=height, padx=6, **COLORS)
                                     for height in (2, 1))
        self.status.pack(side="bottom", fill="x")
        self.status.bind("<Configure>", lambda event: self.status.configure(wraplength=event.width - 12))
        self.readout.pack(side="bottom", fill="x")
        self.picture = tkinter.Label(self.root, image=self.photo, borderwidth=0, background="#202020",
                                     width=self.size[0], height=self.size[1])
        self.picture.pack(fill="both", expand=True)
        self.picture.bind("<Configure>", lambda event: self.resize(event.width, event.height))
        self.keys = self.note_over_picture(keys_of(self.is_traced), justify="left")
        self.lost = self.note_over_picture("")
        self.root.bind("<Key>", self.key)
        self.bind_pointer()

    def first_size(self):
        """The size of the config, enlarged to the least width, but no larger than the screen."""
        width, height = self.whole
        scale = max(1, self.least_width / width)
        scale = min(scale, 0.9 * self.root.winfo_screenwidth() / width,
                    0.85 * self.root.winfo_screenheight() / height)
        return tuple(max(1, round(scale * x)) for x in self.whole)

    def note_over_picture(self, text, **options):
        """A text that can be laid over the picture."""
        return tkinter.Label(self.root, text=text, font=self.font, padx=10, pady=6, **COLORS, **options)

    def bind_pointer(self):
        self.picture.bind("<ButtonPress-1>", lambda event: self.drag_from(event.x, event.y))
        self.picture.bind("<B1-Motion>", lambda event: self.drag_to(event.x, event.y))
        self.picture.bind("<ButtonRelease-1>", lambda event: self.drag_from(None, None))
        for button, step in WHEEL_BUTTONS.items():
            self.picture.bind(f"<Button-{button}>",
                              lambda event, step=step: self.move(self.settings.camera.neared(step)))
        self.picture.bind("<MouseWheel>",
                          lambda event: self.move(self.settings.camera.neared(1 if event.delta > 0 else -1)))

    # The pointer

    def drag_from(self, x, y):
        self.drag = None if x is None else (x, y)

    def drag_to(self, x, y):
        """The scene follows the pointer: the camera goes the other way."""
        if self.drag:
            right, down = x - self.drag[0], y - self.drag[1]
            self.drag = x, y
            self.move(self.settings.camera.orbited(-right * ORBIT, down * ORBIT))

    def move(self, camera):
        self.change(dataclasses.replace(self.settings, camera=camera))

    def change(self, settings):
        if settings != self.settings:
            self.before, self.settings = self.settings, settings
            self.draw_soon()

    # Keys

    def key(self, event):
        name = event.keysym if event.keysym in NAMED_KEYS else event.char or event.keysym
        if self.is_traced and name in tuple(NOT_TRACED):
            return self.say("trace needs no clipping, and has neither --cull nor --wireframe")
        changed = self.changed(name)
        if changed is not None:
            self.change(changed)
        if name == "Escape":
            self.root.quit()
        elif name == "h" and self.keys.winfo_manager():
            self.keys.place_forget()
        elif name == "h":
            self.keys.place(in_=self.picture, x=8, y=8)
        elif name in LIGHT_MOVES and self.pipe.light is None:
            self.say("the scene has no light")
        elif name in LIGHT_MOVES:
            self.move_light(LIGHT_MOVES[name])
        elif name == "p":
            self.write(self.outputs[0], self.scene_text)
        elif name == "P" and self.draw(self.size):
            self.write(self.outputs[1], lambda: png(*read_picture(self.pipe.image)))
        return None

    def changed(self, name):
        """The settings after a key, None if it does not change any."""
        now, camera = self.settings, self.settings.camera
        if name in MOVES:
            return dataclasses.replace(now, camera=camera.stepped(*MOVES[name]))
        if name in TURNS:
            return dataclasses.replace(now, camera=camera.turned(*TURNS[name]))
        if name == "r":
            if self.is_light_moved:
                self.put_light(self.start_light)
            return self.start
        if name == "Home":
            ball = self.pipe.ball
            return ball and dataclasses.replace(
                now, camera=camera.framing(ball.center, framing_distance(ball, self.pipe.projection)))
        if name in ("c", "v"):
            return dataclasses.replace(now, is_clipped=name == "c", inset=now.inset if name == "c" else 0)
        if name in ("z", "x"):
            inset = round(now.inset + (0.05 if name == "z" else -0.05), 2)
            return dataclasses.replace(now, inset=min(0.95, max(0, inset)))
        if name in SHADINGS:
            return dataclasses.replace(now, shading=SHADINGS[name])
        if name == "b":
            return dataclasses.replace(now, culls=not now.culls)
        if name == "f":
            return dataclasses.replace(now, wireframe=(now.wireframe + 1) % 3)
        return None

    def move_light(self, steps):
        step = STEP * self.settings.camera.distance
        place = [repr(float(x) + step * way) for x, way in zip(self.pipe.light, steps)]
        self.put_light(place + self.pipe.light[3:])

    def put_light(self, words):
        self.pipe.put_light(words)
        self.is_light_moved = words != self.start_light
        self.draw_soon()

    def resize(self, width, height):
        """The largest picture with the config's aspect ratio that fits into the window."""
        scale = min(width / self.whole[0], height / self.whole[1])
        size = tuple(max(1, round(scale * x)) for x in self.whole)
        if size != self.size:
            self.size = size
            self.draw_soon()

    # Frames

    def draw_soon(self):
        if self.pending is None:
            self.pending = self.root.after_idle(self.draw_first)

    def draw_first(self):
        """Draws the next frame; if full size takes long, a small one first, and full size when no key has
        been pressed for a moment."""
        self.pending = None
        if self.resting is not None:
            self.root.after_cancel(self.resting)
            self.resting = None
        if self.whole_seconds <= SLOW_SECONDS:
            return self.draw(self.size)
        self.draw(tuple(max(1, x // SMALL) for x in self.size))
        self.resting = self.root.after(REST_MS, self.draw_rest)
        return None

    def draw_rest(self):
        self.resting = None
        self.draw(self.size)

    def drawing_words(self):
        return self.more_words + self.settings.drawing_words()

    def draw(self, size):
        begin = time.perf_counter()
        limits = self.settings.limits(self.limits)
        config = "\n".join([f"{size[0]} {size[1]}", *(" ".join(words) for words in limits), ""])
        try:
            project_words = self.settings.project_words() + self.settings.gap_words(self.pipe.projection)
            frame = self.pipe.frame(self.settings.camera.lines(), project_words, config, self.drawing_words())
        except CommandFailure as error:
            if self.pipe.frame_image is None:  # the first one
                raise
            self.settings = self.before
            return self.say(str(error))
        self.photo.configure(data=frame)
        shown = self.photo
        if size != self.size:
            shown = self.enlarged = self.photo.zoom(SMALL)
        self.picture.configure(image=shown)
        self.root.update_idletasks()  # show the frame before reading the clock
        seconds = time.perf_counter() - begin
        if size == self.size:
            self.whole_seconds = seconds
        self.tell(size, seconds)
        return frame

    def tell(self, size, seconds):
        times = "   ".join(f"{name} {'reused' if spent is None else f'{1000 * spent:.0f} ms'}"
                           for name, spent in self.pipe.seconds())
        words = " ".join(self.settings.project_words() + self.drawing_words())
        gap = f"gap {self.settings.inset:.0%}   " if self.settings.inset else ""
        self.say(f"{times}   all {1000 * seconds:.0f} ms   {size[0]}x{size[1]}   {gap}{words}")
        self.readout.configure(text=self.read_out())
        if self.pipe.is_empty():
            self.lost.configure(text=self.way_back())
            self.lost.place(in_=self.picture, relx=0.5, rely=0.5, anchor="center")
        else:
            self.lost.place_forget()

    def read_out(self):
        camera = self.settings.camera
        places = 5 - math.floor(math.log10(
            camera.distance))  # six digits of the distance; the others are rounding
        eye, look, _ = camera.lines()
        [(kind, words)] = self.pipe.projection.items()
        field = f"fovY {words[0]}" if kind == "perspective" else kind
        return "   ".join([
            "h: keys", *(f"{name} {' '.join(f'{round(float(x), places) + 0.0:.6g}' for x in place)}"
                         for name, place in (("eye", eye), ("look", look))), field])

    def way_back(self):
        ball = self.pipe.ball
        if ball is None:
            return "the scene has no triangles"
        return (f"nothing is in sight: the scene is {direction(self.settings.camera, ball)}\nHome "
                f"brings it back")

    def say(self, words):
        self.status.configure(text=words)

    # Files

    def scene_text(self):
        light = self.pipe.light if self.is_light_moved else None
        # Comments keep bytes that are not UTF-8.
        text = read_input(str(self.scene), only_regular=True).decode("utf-8-sig", errors="surrogateescape")
        return rewritten(text, self.settings.camera.lines(), light).encode(errors="surrogateescape")

    def write(self, path, content):
        try:
            write_file(path, content())
        except (CommandFailure, BrokenPipeError) as error:
            return self.say(str(error))
        return self.say(f"wrote {shown(path)}")

    # Running and closing

    def run(self):
        """Runs until the window is closed or a signal ends it."""
        self.root.protocol("WM_DELETE_WINDOW", self.root.quit)
        self.root.report_callback_exception = self.failed
        self.look_up()
        try:
            self.root.mainloop()
        finally:
            self.close()
        if self.end:
            raise self.end

    def look_up(self):
        """Wakes Python regularly, so that it handles signals: a waiting window would not run it."""
        self.root.after(SIGNAL_MS, self.look_up)

    def failed(self, kind, error, trace):
        if issubclass(kind, Exception):
            traceback.print_exception(kind, error, trace)
        else:
            self.end = error
            self.root.quit()

    def close(self):
        self.root.destroy()
        self.pipe.close()
