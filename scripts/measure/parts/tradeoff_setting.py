"""The settings that scripts/measure/tradeoff compares."""
import dataclasses

TOOLS = ("model", "view", "project", "zbuf")
TRACING_TOOLS = ("model", "view", "trace")
TOOLS_WITH = {
    "--digits": TOOLS[:3], "--precision": TOOLS[:3], "--clip": ("project", ), "--cull": ("project", ),
    "--coverage": ("zbuf", ), "--depth": ("zbuf", ), "--depth-epsilon": ("zbuf", ), "--shading":
        ("zbuf", "trace"), "--samples": ("zbuf", "trace"), "--threads": ("zbuf", "trace"), }
DEFAULTS = {"--digits": "7", "--precision": "extended", "--coverage": "nearest", "--depth": "f64"}


@dataclasses.dataclass(frozen=True)
class Setting:
    words: str = ""  # options and their values, as far as they differ from the default
    is_traced: bool = False  # trace in place of project and zbuf, on one thread if words have no other

    def __str__(self):
        return " ".join(["trace"] * self.is_traced + [self.words] * bool(self.words)) or "default"

    @property
    def tools(self):
        return TRACING_TOOLS if self.is_traced else TOOLS

    @property
    def options(self):
        words = self.words.split()
        return dict(zip(words[::2], words[1::2]))

    def value(self, option):
        return self.options.get(option, DEFAULTS.get(option))

    def words_for(self, tool):
        """The options that the tool has."""
        options = {"--threads": "1", **self.options} if tool in ("zbuf", "trace") else self.options
        return [word for option, value in options.items() if tool in TOOLS_WITH[option]
                for word in (option, value)]

    def command(self, bin_dir, tool):
        return [str(bin_dir / tool), *self.words_for(tool), *drawing_words(tool, "picture.ppm")]


def drawing_words(tool, image):
    """What the last stage needs besides its setting."""
    return ["--image", image, "config.txt"] if tool in ("zbuf", "trace") else []


def settings(*words):
    return [Setting(), *map(Setting, words)]


DEFAULT = Setting()
TRACED = Setting(is_traced=True)
MOST_EXACT = Setting("--digits exact --coverage center")

# What may change numbers, and which pixel shows what: measured for its errors, too.
ACCURACY = settings(*(f"--digits {digits}" for digits in ("5", "6", "9", "12", "15", "exact")),
                    "--precision double", "--coverage center", "--depth f32", "--depth u24",
                    "--digits exact --precision double", "--digits 9 --coverage center",
                    "--digits exact --coverage center")
PLAIN = [*ACCURACY, Setting("--depth-epsilon 1e-6"), Setting("--samples 2"), Setting("--samples 4"), TRACED]
COLOR = settings("--digits 9", "--digits exact", "--coverage center", "--shading none", "--samples 2")
NORMALS = settings("--digits 9", "--digits exact", "--coverage center", "--shading none", "--shading flat",
                   "--shading gouraud", "--samples 2") + [TRACED]
CANCELLATION = settings("--precision double", "--digits 9", "--digits exact",
                        "--digits exact --precision double")
FILL = settings("--coverage center", "--depth f32", "--depth u24", "--samples 2") + [TRACED]
CULLING = settings("--cull back", "--clip near", "--clip frustum", "--clip reject", "--coverage center",
                   "--cull back --coverage center")
SHADING = settings(*(f"--shading {model}" for model in ("none", "flat", "gouraud")),
                   *(f"--samples {count}"
                     for count in (2, 4, 8)), *(f"--clip {mode}" for mode in ("near", "frustum", "reject")),
                   *(f"--shading {model} --samples 4" for model in ("flat", "gouraud"))) + [
                       TRACED, Setting("--samples 4", is_traced=True),
                       Setting("--samples 4 --threads 2", is_traced=True)]
FINEST = Setting("--samples 8")
