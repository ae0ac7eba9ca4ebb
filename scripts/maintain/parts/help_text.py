"""The text of --help, option by option, from which man pages and completion are made."""
import argparse
import contextlib
import dataclasses
import io
import os
import re
import runpy
import subprocess
import sys
from unittest import mock


@dataclasses.dataclass
class Option:
    """An option, an operand or a command: its names, its argument, and its description in paragraphs."""
    names: list
    argument: str
    paragraphs: list

    @property
    def is_option(self):
        return self.names[0].startswith("-")


@dataclasses.dataclass
class Help:
    name: str
    summary: str  # one sentence
    usage: list  # lines
    paragraphs: list  # each a list of lines
    groups: list  # pairs of a title and Options
    examples: list  # command lines
    exit_status: str

    @property
    def options(self):
        return [option for _, options in self.groups for option in options if option.is_option]


def help_of(program, name):
    """The Help of a program."""
    with open(program, "rb") as file:
        is_in_python = b"python3" in file.readline()
    if is_in_python:
        return parse(python_help(program, name), name)
    words = [program, "--help" if name == "pipeline" else "--help-fields"]
    return parse(
        subprocess.run(words, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True).stdout,
        name)


def python_help(program, name):
    """The output of a command in Python with --help-all, with options as in a tool's --help-fields."""
    words = [name, "--help-all"]
    with mock.patch.object(sys, "argv", words), mock.patch.dict(os.environ, {"COLUMNS": "120"}), \
            mock.patch.object(argparse.HelpFormatter, "_format_action", fields_of), \
            contextlib.redirect_stdout(io.TextIOWrapper(io.BytesIO())) as text, \
            contextlib.suppress(SystemExit):
        runpy.run_path(os.path.realpath(program))["main"]()
    text.seek(0)
    return text.read()


def fields_of(formatter, action):
    """A line: names and argument of an option, a tab, its description."""
    head = ",".join(action.option_strings) or formatter._format_action_invocation(action)
    if action.option_strings and action.nargs != 0:
        head += " " + formatter._format_args(action, formatter._get_default_metavar_for_optional(action))
    text = " ".join(formatter._expand_help(action).split()) if action.help else ""
    return f"  {head}\t{text}\n"


def parse(text, name):
    groups, exit_status, examples, usage, paragraphs = [], "", [], [], []
    for block in blocks_of(text):
        first = block[0]
        if first.lower().startswith("usage: "):
            usage = [line[len("usage: "):] for line in block]
        elif first.lower() in ("examples:", "example:"):
            examples = [line.strip() for line in block[1:]]
        elif first.lower().startswith("example: "):
            examples = [first[len("example: "):]]
        elif first.lower().startswith("exit status: "):
            exit_status = " ".join(block)[len("exit status: "):].rstrip(".")
        elif first.endswith(":") and len(block) > 1 and all(line.startswith("  ") for line in block[1:]):
            groups.append((first[:-1], options_of(block[1:])))
        else:
            paragraphs.append(block)
    sentence = re.match(r"(.*?)(?:[.:;](?: |$)|$)", " ".join(paragraphs[0]))
    return Help(name, sentence.group(1), usage, paragraphs, groups, examples, exit_status)


def blocks_of(text):
    """Blocks of lines between blank lines; usage and `Exit status` begin blocks of their own."""
    block = []
    for line in [*text.splitlines(), ""]:
        starts = re.match(r"(usage|exit status): ", line, re.I)
        if block and (not line or starts):
            yield block
            block = []
        if line:
            block.append(line)


def options_of(lines):
    """The Options in lines of fields, or of columns with blanks between them."""
    options = []
    for line in lines:
        if line.startswith("   "):
            options[-1].paragraphs[-1] += " " + line.strip()
            continue
        head, *paragraphs = re.split(r"\t| {2,}", line.strip())
        names, argument = [head], ""  # of an operand
        if head.startswith("-"):
            names, _, argument = head.partition(" ")
            names = names.split(",")
        options.append(Option(names, argument, paragraphs))
    return options


def commands_in(folder):
    """The commands in libexec/pipeline, the stages first."""
    stages = ["model", "view", "project", "zbuf"]
    others = sorted(
        name for name in os.listdir(folder)
        if re.fullmatch("[a-z0-9-]+", name) and os.path.isfile(folder /
                                                               name) and os.access(folder / name, os.X_OK))
    return [name for name in stages if name in others] + [name for name in others if name not in stages]
