"""The errors of a setting on a scene, against a lossless run."""
import math
import pathlib
import subprocess

from parts.tradeoff_setting import MOST_EXACT, TOOLS, Setting


class Bench:
    """Runs the tools of `bin_dir` on one scene, in `folder`."""

    def __init__(self, bin_dir, folder, scene):
        self.bin_dir = pathlib.Path(bin_dir).resolve()
        self.folder = pathlib.Path(folder)
        self.scene = scene
        self.set_depth_limits(1)

    def set_depth_limits(self, limit):
        size = f"{self.scene.columns} {self.scene.rows}"
        (self.folder / "config.txt").write_text(f"{size}\n-1\n-1\n{-limit} {limit}\n")

    def run(self, tool, setting, text):
        """The tool's output for a text."""
        done = subprocess.run(setting.command(self.bin_dir, tool), cwd=self.folder, input=text,
                              capture_output=True)
        if done.returncode != 0:
            raise SystemExit(f"tradeoff: {tool}, {setting}: {done.stderr.decode()}")
        return done.stdout

    def projected(self, setting):
        """The output of project."""
        text = self.scene.text.encode()
        for tool in TOOLS[:3]:
            text = self.run(tool, setting, text)
        return text

    def pixels(self):
        """The pixels of the last picture, three bytes each, from the top left."""
        channels = (self.folder / "picture.ppm").read_bytes()[-3 * self.scene.columns * self.scene.rows:]
        return [channels[i:i + 3] for i in range(0, len(channels), 3)]


# The text of the z-buffer has six decimals. To show smaller errors, depths are multiplied by this before zbuf
# reads them, and so are its limits: a power of two changes neither roundings nor comparisons.
DEPTH_SCALE = 2.0**20
NOBODY = bytes(3)  # black, the background


def colors_by_number(count):
    """The colors zbuf gives triangles 0, 1, 2 ...: red, green and blue are successive numbers of its
    generator."""
    state, drawn = 1, bytearray()
    for _ in range(3 * count):
        state = (214013 * state + 2531011) % 2**32
        drawn.append((state >> 16 & 0x7fff) % 256)
    return [bytes(drawn[i:i + 3]) for i in range(0, len(drawn), 3)]


def distinct_colors(count):
    """{color: number} for `count` triangles that zbuf gives different colors, none of them the
    background's."""
    numbers = {}
    for number, color in enumerate(colors_by_number(count + count // 8 + 8)):
        if color != NOBODY and len(numbers) < count:
            numbers.setdefault(color, number)
    assert len(numbers) == count
    return numbers


class Errors:
    """The errors of settings on a scene, against a lossless run with the same coverage rule."""

    def __init__(self, bench):
        self.bench = bench
        self.scene = bench.scene
        self.owner_of_color = {NOBODY: None}
        self.numbers = []
        for triangle, (color, number) in enumerate(distinct_colors(self.scene.triangle_count).items()):
            self.owner_of_color[color] = triangle
            self.numbers.append(number)
        self.projections = {}  # by digits and precision: the vertices as words
        self.pictures = {}     # by setting
        true_vertices = self.projection(MOST_EXACT)
        # The scenes avoid clipping.
        assert len(true_vertices) == 3 * self.scene.triangle_count
        self.corners = [{tuple(vertex) for vertex in true_vertices[3 * i:3 * i + 3]}
                        for i in range(self.scene.triangle_count)]

    def of(self, setting):
        lossless = MOST_EXACT if setting.value("--coverage") == "center" else Setting("--digits exact")
        picture, true_picture = self.picture(setting), self.picture(lossless)
        differences = self.differences(picture, true_picture)
        against_centers = self.differences(picture, self.picture(MOST_EXACT))
        depth_errors = sorted(abs(depth - true_depth) for (owner, depth), (true_owner, true_depth)
                              in zip(picture, true_picture) if owner == true_owner is not None)
        return {
            "vertex_error_pixels": self.vertex_error(setting, lossless),
            "covered_pixels": sum(owner is not None for owner, _ in true_picture),
            "flipped_pixels": differences["flip"],
            "wrong_pixels": differences["wrong"],
            "neighbor_pixels": differences["neighbor"],
            "off_center_pixels": sum(against_centers.values()),
            "depth_error_median": depth_errors[len(depth_errors) // 2] if depth_errors else "",
            "depth_error_max": depth_errors[-1] if depth_errors else "",
        }

    def projection(self, setting):
        key = setting.value("--digits"), setting.value("--precision")
        if key not in self.projections:
            lines = self.bench.projected(setting).decode().split("\n")
            self.projections[key] = [line.split() for line in lines if line]
        return self.projections[key]

    def picture(self, setting):
        """The triangle seen at each pixel, or None, and its depth, from the top left."""
        if setting not in self.pictures:
            vertices = self.projection(setting)
            lines = []
            for i, number in enumerate(self.numbers):
                lines.append(f"triangle {number}")
                lines += [f"{x} {y} {DEPTH_SCALE * float(z)!r}" for x, y, z in vertices[3 * i:3 * i + 3]]
                lines.append("")
            self.bench.set_depth_limits(DEPTH_SCALE)
            depths = iter(self.bench.run("zbuf", setting, "\n".join(lines).encode()).split())
            owners = [self.owner_of_color[color] for color in self.bench.pixels()]
            self.pictures[setting] = [(None, 1.0) if owner is None else
                                      (owner, float(next(depths)) / DEPTH_SCALE) for owner in owners]
            assert next(depths,
                        None) is None, "the z-buffer's text has more depths than the image has colored pixels"
        return self.pictures[setting]

    def differences(self, picture, true_picture):
        """How many pixels are covered in only one of two pictures (flip), show a neighbor of the right
        triangle, with a common vertex (neighbor), or show another triangle that should be hidden (wrong)."""
        counts = {"flip": 0, "neighbor": 0, "wrong": 0}
        for (owner, _), (true_owner, _) in zip(picture, true_picture):
            if owner == true_owner:
                continue
            if owner is None or true_owner is None:
                counts["flip"] += 1
            elif self.corners[owner] & self.corners[true_owner]:
                counts["neighbor"] += 1
            else:
                counts["wrong"] += 1
        return counts

    def vertex_error(self, setting, lossless):
        """The largest error, in pixels, of a vertex on the screen."""
        largest = 0.0
        for words, true_words in zip(self.projection(setting), self.projection(lossless)):
            if words == true_words:
                continue
            (x, y, _), (true_x, true_y, true_z) = map(float, words), map(float, true_words)
            if max(abs(true_x), abs(true_y), abs(true_z)) <= 1:
                dx, dy = (x - true_x) * self.scene.columns / 2, (y - true_y) * self.scene.rows / 2
                largest = max(largest, math.hypot(dx, dy))
        return largest
