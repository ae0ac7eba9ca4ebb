"""The --help of the commands, taken apart: what man pages and completion are made from."""
import dataclasses
import os
import re
import subprocess

TEXT_COLUMN = 28  # of the tools' help


@dataclasses.dataclass
class Option:
    """An option or an operand: its names, what it takes, and what it does, a paragraph each."""
    names: list
    argument: str
    paragraphs: list

    @property
    def is_option(self):
        return self.names[0].startswith("-")

    @property
    def choices(self):
        """The words of an argument such as auto|near or {auto,near}."""
        word = self.argument.strip("{}")
        separator = "," if self.argument.startswith("{") else "|"
        return word.split(separator) if re.fullmatch(r"[a-z0-9]+([|,][a-z0-9]+)+", word) else []


@dataclasses.dataclass
class Help:
    name: str
    summary: str      # one sentence
    usage: list       # lines
    paragraphs: list  # each a list of lines
    groups: list      # pairs of a title and Options
    examples: list    # command lines
    exit_status: str

    @property
    def options(self):
        return [option for _, options in self.groups for option in options if option.is_option]


def help_of(program, name):
    """The Help of a program."""
    settings = {**os.environ, "COLUMNS": "120", "LC_ALL": "C.UTF-8", "PYTHONDONTWRITEBYTECODE": "1"}
    text = subprocess.run([program, "--help"], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=True, env=settings).stdout
    return parse(text, name)


def parse(text, name):
    groups, exit_status, examples, usage, paragraphs = [], "", [], [], []
    is_tool = "\nUsage: " in text
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
            groups.append((first[:-1], options_of(block[1:], is_tool)))
        else:
            paragraphs.append(block)
    sentence = re.match(r"(.*?)(?:[.:;](?: |$)|$)", " ".join(paragraphs[0]))
    return Help(name, sentence.group(1), usage, paragraphs, groups, examples, exit_status)


def blocks_of(text):
    """Lines between blank lines; the usage and `Exit status` begin blocks of their own."""
    block = []
    for line in [*text.splitlines(), ""]:
        starts = re.match(r"(usage|exit status): ", line, re.I)
        if block and (not line or starts):
            yield block
            block = []
        if line:
            block.append(line)


def options_of(lines, is_tool):
    options = []
    for line in lines:
        is_new = len(line) - len(line.lstrip()) == 2
        if is_new:
            head, text = split_tool_line(line) if is_tool else split_line(line)
            names, argument = names_of(head)
            options.append(Option(names, argument, [text] if text else []))
        else:
            add_line(options[-1], line.strip())
    return options


def split_tool_line(line):
    """The text begins at its column, one blank behind the name at least; a name that reaches beyond it stands
    alone."""
    if len(line) > TEXT_COLUMN and line[TEXT_COLUMN -
                                        1] == " " and not re.fullmatch("[A-Z ]+", line[TEXT_COLUMN:]):
        return line[:TEXT_COLUMN].strip(), line[TEXT_COLUMN:]
    return line.strip(), ""


def split_line(line):
    head, _, text = re.match(r"  (\S.*?)(?:( {2,})(\S.*))?$", line).groups()
    return head, text or ""


def names_of(head):
    """("-o FILE, --output FILE") -> (["-o", "--output"], "FILE"); an operand is its own name."""
    if not head.startswith("-"):
        return [head], ""
    names, argument = [], ""
    for part in re.split(r",\s*(?=-)", head):
        name, _, argument = part.partition(" ")
        names.append(name)
    return names, argument


def add_line(option, line):
    """A line such as 'near: cut all triangles ...' begins a paragraph if `near` is a choice, and so does a
    sentence behind such a paragraph."""
    def is_about_choice(text):
        return ":" in text and text.partition(":")[0] in option.choices

    if not option.paragraphs or is_about_choice(line) or (is_about_choice(option.paragraphs[-1])
                                                          and line[0].isupper()):
        option.paragraphs.append(line)
    else:
        option.paragraphs[-1] += " " + line


def commands_in(folder):
    """The commands in libexec/pipeline, the stages first."""
    stages = ["model", "view", "project", "zbuf"]
    others = sorted(
        name for name in os.listdir(folder)
        if re.fullmatch("[a-z0-9-]+", name) and os.path.isfile(folder /
                                                               name) and os.access(folder / name, os.X_OK))
    return [name for name in stages if name in others] + [name for name in others if name not in stages]
