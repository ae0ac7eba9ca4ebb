"""Reads mistakes.txt: beginners' mistakes, each an edit of three small files, a command, and the tools'
answer."""
import dataclasses
import os
import pathlib
import subprocess
import tempfile

DATA = pathlib.Path(__file__).with_name("mistakes.txt")


@dataclasses.dataclass
class Mistake:
    group: str
    name: str
    title: str
    line: int
    files: dict  # name to text, with the mistake in it
    edits: dict  # name to the lines that show it, each with its -, + or |
    command: str = ""
    stderr: str = ""
    status: int = 0
    advice: str = ""
    on_page: bool = True


def load(path=DATA):
    """The unbroken files, name to text, and the mistakes in the order of the data file."""
    base, mistakes, group = {}, [], ""
    name = None  # of the file that the lines belong to
    for number, line in enumerate(path.read_text().splitlines(), 1):
        if line.startswith("--- "):
            name = line[4:]
            base[name] = ""
        elif line.startswith("## "):
            group = line[3:]
        elif line.startswith(("=== ", "=-= ")):
            short, title = line[4:].split(": ", 1)
            mistakes.append(Mistake(group, short, title, number, {}, {}, on_page=line[1] == "="))
            name = None
        elif not line:
            continue
        elif not mistakes:
            if name:
                base[name] += line + "\n"
        elif line[0] in "-+|":
            mistakes[-1].edits[name].append(line)
        else:
            name = take_answer(mistakes[-1], line)
    for mistake in mistakes:
        mistake.files = {
            file: edited(text, mistake.edits.get(file, []), mistake)
            for file, text in base.items()}
    return base, mistakes


def take_answer(mistake, line):
    """Takes a line that is no edit. Returns the file's name if the line announces edits, else None."""
    if line.endswith(".txt:"):
        mistake.edits[line[:-1]] = []
        return line[:-1]
    if line.startswith("$ "):
        mistake.command = line[2:]
    elif line.startswith(">"):
        mistake.stderr += line[2:] + "\n"
    elif line.startswith("= "):
        mistake.status = int(line[2:])
    else:
        mistake.advice = (mistake.advice + " " + line).strip()
    return None


def edited(text, edits, mistake):
    """The text with each block of - lines replaced by the + lines behind it; | lines replace the whole
    text."""
    if edits and edits[0].startswith("|"):
        return "".join(edit[2:] + "\n" for edit in edits)
    blocks = []  # pairs of old and new lines
    for edit in edits:
        if edit.startswith("-") and (not blocks or blocks[-1][1]):
            blocks.append(([], []))
        blocks[-1][edit.startswith("+")].append(edit[2:] + "\n")
    for old, new in blocks:
        if text.count("\n" + "".join(old)) + text.startswith("".join(old)) != 1:
            raise ValueError(
                "mistakes.txt:%d: the lines of '%s' do not occur once" % (mistake.line, mistake.name))
        text = ("\n" + text).replace("\n" + "".join(old), "\n" + "".join(new), 1)[1:]
    return text


def run(mistake, bin_dir, scripts):
    """Makes the mistake in a folder of its own, with the tools and scripts of two folders. Returns the exit
    status of the last command and stderr. The stages of a pipe share it: a later one writes only after an
    earlier one has ended its text, so the order of the lines is certain."""
    with tempfile.TemporaryDirectory() as folder:
        for name, text in mistake.files.items():
            pathlib.Path(folder, name).write_text(text, encoding="utf-8")
        path = os.pathsep.join([str(bin_dir), str(scripts), os.environ["PATH"]])
        done = subprocess.run(["sh", "-c", mistake.command], cwd=folder, env=dict(
            os.environ, PATH=path, BIN=str(bin_dir), LC_ALL="C"), stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, timeout=60)
        return done.returncode, done.stderr.decode("utf-8", "backslashreplace")
