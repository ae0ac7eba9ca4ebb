"""The cases of the pack, read from its pages."""
import dataclasses
import errno
import fnmatch
import functools
import pathlib
import re

from .pages import CONFIG, files_of, read_fields, read_page

ROOT = pathlib.Path(__file__).resolve().parent.parent
STAGES = ("model", "view", "project", "zbuf")
RULES = ("nearest", "center")
# What a case may need that the assignment does not ask for.
NEEDS = {
    "syntax": "comments, carriage returns, arguments on their command's line",
    "options": "words of the command line, at {options}",
    "clipping": "triangles that reach behind the eye",
    "projections": "frustum, ortho, and the rule `ratio`",
    "numbering": "lines `triangle N`",
    "frames": "texts with `framed` and `end`",
    "colors": "colors and normals in scenes and texts",
    "lights": "lights",
    "materials": "more than one material: `use`, and the column `material`",
    "optics": "materials that mirror, are clear or absorb",
    "spheres": "spheres in scenes and texts",
    "alpha": "`background R G B A`: an alpha, which only PNG holds",
    "bounds": "texts with the header line `bounds`",
    "exactness": "more digits than plain doubles give",
    "refusals": "wrong input is refused, with its line",}
# What cases ask for, in the order of reports: the first is the assignment, the others go beyond it.
ASSIGNMENT, BYTES, REFUSALS, LOOKS, EXTENSIONS = ("what the assignment asks for", "text to the byte",
                                                  "refusals of wrong input", "colors and lights",
                                                  "other extensions")
FED = {"model": "scene.txt", "view": "stage1.txt", "project": "stage2.txt",
       "zbuf": "stage3.txt"}  # a stage's input, in the assignment
CAMERA = {"eye": "0 0 0", "look": "0 0 -1", "up": "0 1 0"}  # of a text whose camera has been used up


@dataclasses.dataclass
class Case:
    """A case; `fields` and `sections` are those of its page."""
    stage: str
    short_name: str
    fields: dict
    sections: list

    @property
    def name(self):
        return f"{self.stage}/{self.short_name}"

    @functools.cached_property
    def files(self):
        return files_of(self.stage, self.fields, self.sections)

    @property
    def why(self):
        return self.fields["why"]

    @property
    def tier(self):
        return self.fields["tier"]

    @property
    def refused_line(self):
        """The line at which the input must be refused; None if it is right."""
        return int(self.fields["refused"]) if "refused" in self.fields else None

    def words(self, key):
        return self.fields.get(key, "").split()

    def group(self, tier):
        """Which of the above the case asks for, judged by a tier."""
        needs = set(self.words("needs"))
        if "refusals" in needs:
            return REFUSALS
        if needs:
            return LOOKS if needs & {"colors", "lights", "materials", "optics", "alpha"} else EXTENSIONS
        return BYTES if tier == "bytes" else ASSIGNMENT

    def open_under(self, rule):
        """Why the assignment leaves the answer open; None if it does not."""
        return self.fields.get("open") or (self.fields.get(f"open-{rule}") if self.stage == "zbuf" else None)

    def has(self, name):
        return name in self.files

    def read(self, name):
        return self.files[name]

    def is_chosen(self, patterns):
        """True if the name, a paragraph or a mistake that the case catches fits one of the patterns, or if
        there is none."""
        names = [self.name, self.short_name, *self.words("paragraphs"), *self.words("catches")]
        return not patterns or any(
            fnmatch.fnmatchcase(name, pattern) for pattern in patterns for name in names)


def read_cases(stage, folder=ROOT / "cases"):
    """The cases of a stage, in the order of their names."""
    pages = [path.read_text("ascii") for path in (folder / stage).glob("*.cases")]
    cases = [
        Case(stage, name, read_fields(fields, stage), sections) for page in pages
        for name, fields, sections in read_page(page)]
    return sorted(cases, key=lambda case: case.short_name)


def extract(cases, folder):
    """Writes each case as a folder of its files, STAGE/NAME, in a folder that is new or empty."""
    files = {f"{case.name}/{name}": content for case in cases for name, content in case.files.items()}
    for name in files:
        if not re.fullmatch(r"[a-z]+/[a-z0-9-]+/[a-z0-9-]+\.(txt|bmp)", name):
            raise OSError(errno.EINVAL, "expected STAGE/CASE/FILE", name)
    for place in sorted({place for case in cases for place in (case.stage, case.name)}):
        (folder / place).mkdir(parents=True)
    for name, content in files.items():
        with open(folder / name, "xb") as file:
            file.write(content)


def read_mistakes(stage):
    """The sentences of mistakes.txt about a stage, and of habits.txt, by name."""
    found = re.findall(r"^([a-z]+/[^:\s]+): (.+)$",
                       (ROOT / "mistakes.txt").read_text() + (ROOT / "habits.txt").read_text(), re.M)
    return {name: sentence for name, sentence in found if name.startswith(stage + "/")}


def without_header(text):
    """A stage text in the manner of the assignment: vertices and blank lines alone."""
    return b"".join(line for line in text.splitlines(keepends=True) if not line[:1].isalpha())


def scene_of(case):
    """A scene.txt that gives the case's input: for programs that read the camera there, or that do all stages
    at once."""
    text = case.read("input.txt")
    if case.stage == "model" or case.has("scene.txt"):
        return text if case.stage == "model" else case.read("scene.txt")
    camera = {**CAMERA, "perspective": "90 1 1 100", **camera_of(text.decode("latin-1"))}
    lines = [line for line in without_header(text).splitlines() if line.strip()]
    triangles = [b"\n".join([b"triangle", *lines[i:i + 3]]) for i in range(0, len(lines) - 2, 3)]
    return b"\n".join([*(camera[name].encode() for name in (*CAMERA, "perspective")), *triangles, b"end\n"])


def camera_of(text):
    """The words behind eye, look, up and perspective in a header, by these."""
    return dict(re.findall(r"^(eye|look|up|perspective) (.*)$", text, re.M))
