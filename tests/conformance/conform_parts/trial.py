"""A program on one case, or on many at a time: it runs in a folder of its own, and its output is judged."""
import contextlib
import functools
import pathlib
import re
import shlex
import tempfile
from collections import namedtuple
from types import SimpleNamespace

from . import confined
from .cases import CAMERA, CONFIG, FED, RULES, camera_of, scene_of, without_header
from .judge import Difference, different_field, same_bytes, same_digits, same_picture, same_shortest
from .shared import wrong_points

# folder: where those of the cases belong
Terms = namedtuple("Terms",
                   "command rule tier is_bare judges_depths judges_picture judges_lines limits box folder")
CASE_FILES = ("input.txt", "config.txt", *FED.values())
BETWEEN = b"==\n"  # two texts of a batch
MOST_TOGETHER = 64  # texts of a batch
SILENT = "it wrote nothing"
LONGEST_ROW = 200  # of what is shown of an output
NOT_JUDGED = (ArithmeticError, MemoryError, OSError, RecursionError, ValueError)
PLACEHOLDERS = {
    "{config}": "config.txt", "{scene}": "scene.txt", "{input}": "input.txt", "{image}": "out.bmp",
    "{depths}": "depths.txt"}


def located(command):
    """The command with the names of existing files made absolute, as it runs in another folder."""
    def absolute(index, word):
        path = pathlib.Path(word)
        is_file = "/" in word or index > 0 and word not in CASE_FILES
        return str(path.resolve()) if is_file and "{" not in word and path.is_file() else word

    return [absolute(index, word) for index, word in enumerate(command)]


def words_for(case, command, text):
    """The command with its placeholders filled in."""
    options = shlex.split(case.read("options.txt").decode()) if case.has("options.txt") else []
    camera = {**CAMERA, **camera_of(text)}
    fillers = {**PLACEHOLDERS, **{"{%s}" % name: words for name, words in camera.items()}}
    words = []
    for word in command:
        for placeholder, filler in fillers.items():
            word = word.replace(placeholder, filler)
        words += options if word == "{options}" else [word]
    return words


def missing_need(case, command):
    """Names what the case needs and the command does not offer; None if nothing."""
    return "options" if case.has("options.txt") and "{options}" not in command else None


def fit_for_print(text):
    """A part of a program's output, in printable characters, and not too long."""
    rows = [row[:LONGEST_ROW] + "..." * (len(row) > LONGEST_ROW) for row in text.split("\n")]
    return "\n".join("".join(c if c.isprintable() else "?" for c in row) for row in rows)


def hint_of_header(stage, given, option):
    """Names the words over which a program stumbles that reads only numbers; empty if there are none."""
    line = fit_for_print(given.partition(b"\n")[0].decode(errors="replace"))
    return (f": it must read past the lines before the first triangle, such as '{line}' ({option} feeds none)"
            if stage in ("view", "project") and line[:1].isalpha() else "")


def given_text(case, terms):
    text = case.read("input.txt")
    return without_header(text) if terms.is_bare and case.stage != "model" else text


def batches(cases, terms):
    """(words, cases) of those whose texts one process may be given, one behind the other."""
    alike = {}
    for case in cases:
        text = case.read("input.txt")
        is_apart = case.stage == "zbuf" or case.refused_line is not None or case.has("scene.txt")
        if not is_apart and text.endswith(b"\n"):
            words = words_for(case, terms.command, text.decode("latin-1"))
            alike.setdefault(tuple(words), []).append(case)
    return [(words, group[at:at + MOST_TOGETHER]) for words, group in alike.items()
            for at in range(0, len(group), MOST_TOGETHER)]


def right_of_batch(words, cases, terms):
    """The names of the cases of a batch that a process gets right."""
    with confined.temporary_folder("batch.", terms.folder) as top, tempfile.TemporaryFile() as stdin:
        stdin.write(BETWEEN.join(given_text(case, terms) for case in cases))
        stdin.seek(0)
        (top / "work").mkdir()
        ending, right = confined.run(words, stdin, top / "work", terms.limits, terms.box), []
    texts = ending.stdout.split(BETWEEN)
    for case, text in zip(cases, texts if ending.status == 0 and len(texts) == len(cases) else ()):
        with contextlib.suppress(*NOT_JUDGED):
            right += [] if judge_outputs(case, terms, SimpleNamespace(text=text)) else [case.name]
    return right


def try_case(case, terms):
    """The Difference between what the program does and what the case expects, fit for print; None if there is
    none."""
    try:
        difference = run_and_judge(case, terms)
    except NOT_JUDGED as error:
        difference = Difference(f"its output cannot be judged: {error!r}", is_failure=True)
    return difference and difference._replace(expected=fit_for_print(difference.expected),
                                              found=fit_for_print(difference.found))


def run_and_judge(case, terms):
    with confined.temporary_folder("case.", terms.folder) as top, confined.opened_folder(
            top / "work") as opened:
        folder, text, given = top / "work", case.read("input.txt"), given_text(case, terms)
        (folder / "config.txt").write_bytes(case.read("config.txt") if case.has("config.txt") else CONFIG)
        (folder / "scene.txt").write_bytes(scene_of(case))
        for file in ("input.txt", FED[case.stage]):
            (folder / file).write_bytes(given)
        words = words_for(case, terms.command, text.decode("latin-1"))
        with open(folder / "input.txt", "rb") as stdin:
            ending = confined.run(words, stdin, folder, terms.limits, terms.box)
        return judge_ending(case, terms, ending, Outputs(ending, opened, terms))


class Outputs:
    """The output of the program: `text`, on stdout or in {depths}, and `image`, each None if it is not
    there."""
    def __init__(self, ending, descriptor, terms):
        self.ending, self.descriptor, self.limit = ending, descriptor, terms.limits.output
        self.is_in_file = any("{depths}" in word for word in terms.command)

    @functools.cached_property
    def text(self):
        return self.file("depths.txt") if self.is_in_file else self.ending.stdout

    @functools.cached_property
    def image(self):
        return self.file("out.bmp")

    def file(self, name):
        try:
            return confined.read_output(name, self.descriptor, self.limit)
        except confined.Refused as error:
            raise confined.Refused(f"{name} is not read: {error}") from None


def judge_ending(case, terms, ending, outputs):
    complaint = ending.stderr[:1 << 16].decode("utf-8", "replace")
    if ending.why:
        return Difference(ending.why, is_failure=True)
    if case.refused_line is not None:
        return judge_refusal(case, terms, ending, complaint)
    if ending.status:
        last = complaint.strip().rpartition("\n")[2]
        return Difference(f"exit status {ending.status}", "0", last, is_failure=True)
    try:
        difference = judge_outputs(case, terms, outputs)
        return difference and difference._replace(excuses=excuses(case, terms, outputs),
                                                  other_rule=other_rule(case, terms, outputs), points=points(
                                                      case, terms, outputs))
    except confined.Refused as error:
        return Difference(str(error), is_failure=True)


def judge_refusal(case, terms, ending, complaint):
    """Refused with a status other than 0, and with the line, the first number behind a colon or the word
    line."""
    expected = f"refused at line {case.refused_line}"
    if not ending.status:
        return Difference("wrong input was accepted", expected, "exit status 0")
    told = re.search(r"(?:\bline\s+|:)0*([0-9]+)", complaint)
    if terms.judges_lines and (not told or told[1] != str(case.refused_line)):
        return Difference("the message does not name the line", expected,
                          complaint.strip().partition("\n")[0])
    *_, last, end = ["", *ending.stdout.decode("latin-1").split("\n")]
    writes_text = case.stage != "zbuf" and b"\nerror " not in b"\n" + case.read("input.txt")  # F10
    if terms.tier != "digits" and writes_text and (end or not re.match("error [^ :]+: .", last)):
        return Difference("the output does not end with a line `error TOOL: MESSAGE` (T12)",
                          "error TOOL: MESSAGE", end or last)
    return None


def tier_of(case, terms):
    return terms.tier or case.tier


def excuses(case, terms, outputs):
    """The mistakes that would have given another wrong output than this one, of those whose output the case
    holds."""
    if case.stage == "zbuf" and terms.rule != "nearest":
        return ()
    return tuple(mistake for mistake in case.words("catches")
                 if is_excused(case, terms, outputs, f"with-{mistake.partition('/')[2]}"))


def points(case, terms, outputs):
    is_stage_text, name = case.stage != "zbuf", f"depths-{terms.rule}.txt"
    if outputs.text is None or not is_stage_text and not terms.judges_depths:
        return ()
    expected = case.read("expected.txt" if is_stage_text else name)
    if is_stage_text:
        return wrong_points(without_header(expected), without_header(outputs.text), True)
    return wrong_points(expected, outputs.text, False)


def is_excused(case, terms, outputs, name):
    found, is_stage_text = outputs.text, case.stage != "zbuf"
    if case.has(name + ".txt") and found is not None and terms.judges_depths:
        return bool(
            same_digits(case.read(name + ".txt"),
                        without_header(found) if is_stage_text else found, is_stage_text))
    if case.has(name + ".bmp") and terms.judges_picture and outputs.image is not None:
        return bool(same_picture(case.read(name + ".bmp"), outputs.image, has_free_colors=True))
    return False


def other_rule(case, terms, outputs):
    """The rule of coverage, other than that of the terms, by which the outputs are right; None if there is
    none."""
    rules = [rule for rule in RULES if rule != terms.rule and case.stage == "zbuf"]
    return next((rule for rule in rules if not judge_outputs(case, terms._replace(rule=rule), outputs)), None)


def judge_outputs(case, terms, outputs):
    is_strict = tier_of(case, terms) == "bytes"
    if case.stage != "zbuf":
        expected = case.read("expected.txt")
        expected = without_header(expected) if terms.is_bare else expected
        if expected.strip() and not outputs.text.strip():
            return Difference(SILENT, expected.decode("latin-1").splitlines()[0], "nothing")
        if terms.is_bare or terms.tier:
            return (same_bytes if is_strict else same_digits)(expected, outputs.text)
        return same_bytes(expected, outputs.text) if is_strict else same_digits(
            expected, outputs.text) or same_shortest(expected, outputs.text)
    if terms.judges_depths:
        depths = outputs.text
        if depths is None:
            return Difference("no file {depths} was written")
        expected = case.read(f"depths-{terms.rule}.txt")
        difference = same_bytes(expected, depths) if is_strict else same_digits(
            expected, depths, is_stage_text=False)
        if difference:
            return difference._replace(message="depths: " + difference.message)
    if terms.judges_picture:
        image = outputs.image
        if image is None:
            return Difference("no picture was written", "out.bmp, or the file that {image} names")
        expected = case.read(f"picture-{terms.rule}.bmp")
        has_free_colors = not is_strict and not {"colors", "lights", "materials", "optics"} & set(
            case.words("needs"))
        difference = same_picture(expected, image, has_free_colors)
        if difference or not is_strict or expected == image:
            return difference
        return different_field(expected, image)
    return None
