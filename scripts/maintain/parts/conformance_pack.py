"""A case of the conformance pack, and its files: the outputs of the specification's program, and the mistakes
that the case catches."""
import dataclasses
import os
import pathlib
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path[:0] = [str(SOURCE / "tests/reference"), str(SOURCE / "tests/conformance")]
import reference  # noqa: E402
from conform_parts.cases import CONFIG, RULES, STAGES, read_mistakes, without_header  # noqa: E402
from conform_parts.judge import same_digits, same_picture  # noqa: E402
from conform_parts.pages import files_of, read_fields, read_page  # noqa: E402

OTHER_FORMULAS = "zbuf/other-formulas"  # a habit: a program that has it must not fail
# Includes habits. zbuf/center is left out, since the pack has the pictures of that rule, too.
MISTAKES = {
    stage: [None, *(name for name in read_mistakes(stage) if name != "zbuf/center")]
    for stage in STAGES}
# Cases that also hold the output of each mistake that they catch: a text, or a picture if only that is wrong.
# A flat depth is mostly that of one corner or the corners' mean; in FLAT's triangle these are equal.
FLAT = "depth-slopes-both-ways"
WITNESSES = {
    "model": ("arm-of-three-joints", "axis-1-2-3", "order-scale-rotate-translate", "stack-pops-in-a-row",
              "stack-pushes-in-a-row-twice", "stack-siblings-of-siblings"),
    "view": ("octant-ppm-past-the-origin", "rolled-by-30-tilted", "up-leans-all"),
    "project": ("fov-45-aspect-1-25", "fov-60-aspect-0-5"),
    "zbuf": ("crossing-one-way", "limits-across-both-with-another-behind", "three-middle-far-near",
             "window-half", FLAT),}
# The student's program (tests/conformance/student).
STUDENT = os.environ.get("STUDENT", SOURCE / "build/release/tests/baselines/student")


@dataclasses.dataclass
class Case:
    """The part of a case that a person writes; the rest is calculated. `open_nearest` concerns coverage by
    the rule `nearest` alone."""
    stage: str
    name: str
    why: str
    paragraphs: str
    text: str
    config: str = ""
    options: str = ""
    scene: str = ""  # scene.txt, for --scene
    tier: str = "digits"
    needs: str = ""
    open: str = ""
    open_nearest: str = ""
    refused: int = 0  # the line

    @property
    def is_plain(self):
        """True if a program of the assignment should have the answer."""
        return not (self.needs or self.options or self.refused or self.open)

    def answered(self):
        """The fields of the case, and its files by name, as far as a page holds them."""
        files = {"input.txt": self.text.encode("latin-1")}
        if self.stage == "zbuf" and self.config.encode("latin-1") != CONFIG:
            files["config.txt"] = self.config.encode("latin-1")
        if self.scene:
            files["scene.txt"] = self.scene.encode("latin-1")
        if self.refused:
            self.expect_refusal()
        else:
            files.update(self.expected())
        caught = self.catches(files)
        for mistake in caught if self.name in WITNESSES[self.stage] else ():
            text, *picture = self.mistaken(mistake)
            if mistake != "zbuf/flat-depth" or self.name == FLAT:
                is_picture = mistake == "zbuf/one-color"
                name = f"with-{mistake.partition('/')[2]}.{'bmp' if is_picture else 'txt'}"
                files[name] = picture[0] if is_picture else text
        return self.fields(caught), files

    def fields(self, caught):
        needs = {*self.needs.split(), *["options"] * bool(self.options), *["refusals"] * bool(self.refused)}
        fields = {
            "why": self.why, "paragraphs": self.paragraphs, "tier": self.tier, "needs": " ".join(
                sorted(needs)), "open": self.open, "open-nearest": self.open_nearest, "refused": str(
                    self.refused or ""), "options": self.options, "catches": " ".join(caught)}
        return {key: value for key, value in fields.items() if value}

    def expected(self):
        """The outputs of the specification's program."""
        if self.stage != "zbuf":
            with tempfile.TemporaryDirectory() as folder:
                scene = pathlib.Path(folder, "scene.txt")
                scene.write_text(self.scene)
                words = [str(scene) if word == scene.name else word for word in self.options.split()]
                return {"expected.txt": answer(self.stage, self.text, words)}
        outputs = {}
        for rule in RULES:
            outputs[f"depths-{rule}.txt"], outputs[f"picture-{rule}.bmp"] = self.drawn(rule)
        return outputs

    def drawn(self, rule):
        with tempfile.TemporaryDirectory() as name:
            config, image = pathlib.Path(name, "config.txt"), pathlib.Path(name, "out.bmp")
            config.write_bytes(self.config.encode("latin-1"))
            depths = answer("zbuf", self.text,
                            [str(config), "--image",
                             str(image), "--coverage", rule, *self.options.split()])
            return depths, image.read_bytes()

    def expect_refusal(self):
        for rule in RULES if self.stage == "zbuf" else RULES[:1]:
            try:
                self.drawn(rule) if self.stage == "zbuf" else self.expected()
            except reference.Refused as refusal:
                if refusal.args[0] != self.refused:
                    raise SystemExit(
                        f"{self.stage}/{self.name}: refused at line {refusal.args[0]}, not at {self.refused}"
                    ) from None
            else:
                raise SystemExit(f"{self.stage}/{self.name}: not refused")

    def catches(self, files):
        """The mistakes with which a student's program fails the case. Without a mistake it must not fail."""
        if not self.is_plain:
            return []
        failing = [mistake for mistake in MISTAKES[self.stage] if self.is_failed_with(mistake, files)]
        if {None, OTHER_FORMULAS}.intersection(failing) and not self.open_nearest:
            raise SystemExit(f"{self.stage}/{self.name}: plain doubles do not give the answer")
        return [] if None in failing else [name for name in failing if name != OTHER_FORMULAS]

    def is_failed_with(self, mistake, files):
        found, *picture = self.mistaken(mistake)
        if self.stage == "zbuf":
            return bool(
                same_digits(files["depths-nearest.txt"], found, is_stage_text=False)
                or same_picture(files["picture-nearest.bmp"], *picture, has_free_colors=True))
        return bool(same_digits(without_header(files["expected.txt"]), found))

    def mistaken(self, mistake):
        """The outputs of a student's program: the text, and for zbuf the picture."""
        words = ["config.txt"] if self.stage == "zbuf" else ["--bare"]
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            (folder / "config.txt").write_bytes(self.config.encode("latin-1"))
            done = subprocess.run([STUDENT, self.stage, *words, *["--mistake", mistake] * bool(mistake)],
                                  input=self.text.encode("latin-1"), stdout=subprocess.PIPE, cwd=folder,
                                  check=True)
            return done.stdout, *([(folder / "out.bmp").read_bytes()] if self.stage == "zbuf" else [])


def answer(stage, text, words):
    return getattr(reference, stage)(text.encode("latin-1"), reference.read_options(stage, [*words]))


def cases_of(page, text):
    """The cases of a page STAGE/SUBJECT.cases, as far as a person writes them."""
    stage = page.partition("/")[0]
    for name, about, sections in read_page(text):
        fields = read_fields(about, stage)
        files = {key: data.decode("latin-1") for key, data in files_of(stage, fields, sections).items()}
        yield Case(stage, name, fields["why"], fields["paragraphs"], files.get("input.txt", ""),
                   files.get("config.txt", ""), fields.get("options", ""), files.get("scene.txt", ""),
                   fields["tier"], fields.get("needs", ""), fields.get("open", ""),
                   fields.get("open-nearest", ""), int(fields.get("refused", 0)))
