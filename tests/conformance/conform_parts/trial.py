"""A program on one case: it runs in a folder of its own, and its output is judged."""
import contextlib
import os
import pathlib
import re
import resource
import shlex
import signal
import subprocess
import tempfile
from collections import namedtuple

from .cases import CAMERA, CONFIG, FED, RULES, camera_of, scene_of, without_header
from .judge import Difference, same_bytes, same_digits, same_picture

Terms = namedtuple("Terms", "command rule tier is_bare judges_depths judges_picture judges_lines seconds")
CASE_FILES = ("input.txt", "config.txt", *FED.values())
LARGEST_OUTPUT = 64 << 20  # bytes; a program that writes without end is stopped here
LONGEST_ROW = 200  # of what is shown of an output
PLACEHOLDERS = {"{config}": "config.txt", "{scene}": "scene.txt", "{input}": "input.txt", "{image}": "out.bmp", "{depths}": "depths.txt"}


def limit_output():
    """No program started from here writes a larger file."""
    _, hard = resource.getrlimit(resource.RLIMIT_FSIZE)
    limit = LARGEST_OUTPUT if hard == resource.RLIM_INFINITY else min(hard, LARGEST_OUTPUT)
    resource.setrlimit(resource.RLIMIT_FSIZE, (limit, hard))


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
    """What the case needs and the command does not offer; None if nothing."""
    return "options" if case.has("options.txt") and "{options}" not in command else None


def fit_for_print(text):
    """A part of a program's output, in printable characters, and not too long."""
    rows = ["".join(c if c.isprintable() else "?" for c in row[:LONGEST_ROW]) + "..." * (len(row) > LONGEST_ROW) for row in text.split("\n")]
    return "\n".join(rows)


def try_case(case, terms):
    """The Difference between what the program does and what the case expects, fit for print; None if there is none."""
    difference = run_and_judge(case, terms)
    return difference and difference._replace(expected=fit_for_print(difference.expected), found=fit_for_print(difference.found))


def run_and_judge(case, terms):
    with tempfile.TemporaryDirectory(prefix="conform.") as name:
        folder = pathlib.Path(name)
        text = case.read("input.txt")
        given = without_header(text) if terms.is_bare and case.stage != "model" else text
        (folder / "config.txt").write_bytes(case.read("config.txt") if case.has("config.txt") else CONFIG)
        (folder / "scene.txt").write_bytes(scene_of(case))
        for file in ("input.txt", FED[case.stage]):
            (folder / file).write_bytes(given)
        words = words_for(case, terms.command, text.decode("latin-1"))
        status = run(words, folder, terms.seconds)
        complaint = (folder / "stderr").read_bytes()[:1 << 16].decode("utf-8", "replace")
        if isinstance(status, Difference):
            return status
        if case.refused_line is not None:
            return judge_refusal(case, terms, status, complaint, folder)
        if status:
            return Difference(f"exit status {status}", "0", complaint.strip().rpartition("\n")[2], is_failure=True)
        difference = judge_outputs(case, terms, folder)
        return difference and difference._replace(excuses=excuses(case, terms, folder), other_rule=other_rule(case, terms, folder))


def run(words, folder, seconds):
    """The exit status of a program, or the Difference that it made by not ending by itself."""
    with open(folder / "input.txt", "rb") as stdin, open(folder / "stdout", "wb") as stdout, open(folder / "stderr", "wb") as stderr:
        try:
            process = subprocess.Popen(words, stdin=stdin, stdout=stdout, stderr=stderr, cwd=folder, start_new_session=True)
        except OSError as error:
            return Difference(f"{words[0]} cannot be run: {error.strerror}", is_failure=True)
        try:
            status = process.wait(seconds)
        except subprocess.TimeoutExpired:
            return Difference(f"no end after {seconds:g} seconds", is_failure=True)
        finally:
            with contextlib.suppress(ProcessLookupError):  # the program, if it still runs, and what it has started
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
    if status < 0:
        return Difference(f"ended by {signal.Signals(-status).name}", is_failure=True)
    return status


def judge_refusal(case, terms, status, complaint, folder):
    """Refused with a status other than 0, and with the line, the first number behind a colon or the word line."""
    expected = f"refused at line {case.refused_line}"
    if not status:
        return Difference("wrong input was accepted", expected, "exit status 0")
    told = re.search(r"(?:\bline\s+|:)(\d+)", complaint)
    if terms.judges_lines and (not told or int(told[1]) != case.refused_line):
        return Difference("the message does not name the line", expected, complaint.strip().partition("\n")[0])
    last = (folder / "stdout").read_bytes().decode("latin-1").rstrip("\n").split("\n")[-1]
    if tier_of(case, terms) == "bytes" and case.stage != "zbuf" and not last.startswith("error "):
        return Difference("the output does not end with the error", "error TOOL: ...", last)
    return None


def tier_of(case, terms):
    return terms.tier or case.tier


def text_of(terms, folder):
    """The stage text or the depths that the program has written; None if it has not."""
    path = folder / ("depths.txt" if any("{depths}" in word for word in terms.command) else "stdout")
    return path.read_bytes() if path.exists() else None


def excuses(case, terms, folder):
    """The mistakes that would have given another wrong output than this one, of those whose output the case holds."""
    if case.stage == "zbuf" and terms.rule != "nearest":
        return ()
    return tuple(mistake for mistake in case.words("catches") if is_excused(case, terms, folder, f"with-{mistake.partition('/')[2]}"))


def is_excused(case, terms, folder, name):
    found, image, is_stage_text = text_of(terms, folder), folder / "out.bmp", case.stage != "zbuf"
    if case.has(name + ".txt") and found is not None and terms.judges_depths:
        return bool(same_digits(case.read(name + ".txt"), without_header(found) if is_stage_text else found, is_stage_text))
    if case.has(name + ".bmp") and image.exists() and terms.judges_picture:
        return bool(same_picture(case.read(name + ".bmp"), image.read_bytes(), has_free_colors=True))
    return False


def other_rule(case, terms, folder):
    """The rule of coverage, other than that of the terms, by which the outputs are right; None if there is none."""
    rules = [rule for rule in RULES if rule != terms.rule and case.stage == "zbuf"]
    return next((rule for rule in rules if not judge_outputs(case, terms._replace(rule=rule), folder)), None)


def judge_outputs(case, terms, folder):
    is_strict = tier_of(case, terms) == "bytes"
    if case.stage != "zbuf":
        expected = case.read("expected.txt")
        judge = same_bytes if is_strict else same_digits
        return judge(without_header(expected) if terms.is_bare else expected, text_of(terms, folder))
    if terms.judges_depths:
        depths = text_of(terms, folder)
        if depths is None:
            return Difference("no file {depths} was written")
        expected = case.read(f"depths-{terms.rule}.txt")
        difference = same_bytes(expected, depths) if is_strict else same_digits(expected, depths, is_stage_text=False)
        if difference:
            return difference._replace(message="depths: " + difference.message)
    if terms.judges_picture:
        if not (folder / "out.bmp").exists():
            return Difference("no picture was written", "out.bmp, or the file that {image} names")
        image = (folder / "out.bmp").read_bytes()
        expected = case.read(f"picture-{terms.rule}.bmp")
        has_free_colors = not is_strict and not {"colors", "lights", "materials", "optics"} & set(case.words("needs"))
        difference = same_picture(expected, image, has_free_colors)
        if difference or not is_strict or expected == image:
            return difference
        return Difference("the bytes of the picture's file differ", f"{len(expected)} bytes", f"{len(image)} bytes")
    return None
