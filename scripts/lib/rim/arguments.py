"""The command line of a script: how --help looks, and how errors in it are reported."""
import argparse
import contextlib
import difflib
import itertools
import math
import os
import re
import shutil
import sys
import textwrap

from lib.rim.command import shown
from lib.rim.output_file import place_of

STANDARD_OUTPUT = ("", "/dev/stdout")
RARE = frozenset("""--threshold --min-contribution --max-depth --no-recursion --facets --crease --nodes
    --max-input --memory-limit --time-limit --linear --threads --address-space --processes
    --env""".split())  # shown by --help-all alone
OPERANDS = ("scene", "config", "path", "model")
OTHER_WAYS = {  # {(command, option that is not there, or no longer): what to use}
    ("picture", "--up"): "now --up-axis",
    ("picture", "--floor"): "docs/models.md adds one to the scene of --stages",
    ("picture", "--wireframe"): "zbuf --wireframe draws edges, of stage3.txt of --stages",
    ("picture", "--transparent"): "--background transparent; of glass: docs/models.md",
    ("picture", "--rotate"): "--eye-from AZIMUTH ELEVATION looks from elsewhere",
    ("picture", "--shadows"): "--trace draws them",
    ("compare", "--five"): "now --hand-in",
    ("grade", "--out"): "now --output",
    ("trade", "--coverage"): "now --rule",
}


def files_of(name, folder):
    """Inputs for expect_separate: the entries of a folder, if it exists."""
    names = os.listdir(folder) if os.path.isdir(folder or "") else []
    return [(name, os.path.join(folder, file)) for file in names]


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Fits the paragraphs of a description to the terminal, and to 80 columns; those with lines that are
    indented, such as examples, stay as they are."""
    def __init__(self, prog):
        super().__init__(prog, width=min(80, shutil.get_terminal_size().columns))

    def _fill_text(self, text, width, indent):
        paragraphs = re.split(r"\n\s*\n", text.strip("\n"))
        return "\n\n".join(self._paragraph(paragraph, width, indent) for paragraph in paragraphs)

    def _paragraph(self, paragraph, width, indent):
        if re.search(r"^\s", paragraph, re.MULTILINE):
            return textwrap.indent(paragraph, indent)
        return textwrap.fill(paragraph, width, initial_indent=indent, subsequent_indent=indent,
                             break_long_words=False, break_on_hyphens=False)


def whole(least, most=math.inf):
    """A function that reads the word of an option, a whole number."""
    limits = f"of at least {least}" if most == math.inf else f"from {least} to {most}"

    def read(word):
        if word.isascii() and word.isdigit() and least <= int(word) <= most:
            return int(word)
        raise argparse.ArgumentTypeError(f"expected a whole number {limits}, found '{word}'")

    return read


def number(is_zero_fine=False, most=math.inf):
    """Likewise for a number greater than 0, or of at least 0."""
    limits = ("of at least 0" if is_zero_fine else "greater than 0") + f", at most {most}" * (most < math.inf)

    def read(word):
        with contextlib.suppress(ValueError):
            if 0 < (value := float(word)) <= most and value < math.inf or is_zero_fine and value == 0:
                return value
        raise argparse.ArgumentTypeError(f"expected a number {limits}, found '{word}'")

    return read


def config_beside(scene):
    """The config.txt in the folder of a scene; None if there is none."""
    config = os.path.join(os.path.dirname(scene), "config.txt")
    return config if scene != "-" and os.path.isfile(config) else None


class HelpAction(argparse.Action):
    def __call__(self, parser, namespace, values, option_string=None):
        sys.stdout.write(parser.format_help(has_rare=option_string == "--help-all"))
        parser.exit()


class CommandParser(argparse.ArgumentParser):
    """Reports a mistake in one line, as the tools do. --help begins with the usage, the first example and the
    first paragraph of the description; the options follow, without rare ones, then the other paragraphs."""
    def __init__(self, **settings):
        super().__init__(formatter_class=HelpFormatter, add_help=False, allow_abbrev=False, **settings)
        self._positionals.title, self._optionals.title = "Operands", "Options"
        for *names, text in (("-h", "--help", "print this help and exit; --help-all: every option"),
                             ("--help-all", argparse.SUPPRESS)):
            self.add_argument(*names, action=HelpAction, nargs=0, default=argparse.SUPPRESS, help=text)

    def format_help(self, has_rare=False):
        paragraphs = (self.description or "").strip("\n").split("\n\n")
        example = next((text.split("\n")[1] for text in paragraphs if text.startswith("Examples:\n")), None)
        formatter = self._get_formatter()
        formatter.add_usage(self.usage, self._actions, self._mutually_exclusive_groups, "Usage: ")
        formatter.add_text(example and "Example:\n" + example)
        formatter.add_text(paragraphs[0])
        for group in self._action_groups:
            formatter.start_section(group.title)
            formatter.add_text(group.description)
            shown = [
                action for action in group._group_actions
                if has_rare or RARE.isdisjoint(action.option_strings)]
            formatter.add_arguments(sorted(shown, key=lambda action: "--help" in action.option_strings))
            formatter.end_section()
        formatter.add_text("\n\n".join(paragraphs[1:]))
        return formatter.format_help()

    def parse_args(self, *arguments):
        for word in itertools.takewhile(lambda word: word != "--", sys.argv[1:]):
            if way := OTHER_WAYS.get((self.prog, word.split("=")[0])):
                self.error(f"expected an option of {self.prog}, found '{word}' ({way})")
        return super().parse_args(*arguments)

    def error(self, message):
        if message.startswith("unrecognized arguments: "):
            word = message.split()[2].split("=")[0]
            known = [name for action in self._actions for name in action.option_strings]
            for name in difflib.get_close_matches(word, known, 1, cutoff=0.75):
                message += f" (did you mean {name}?)"
        self.exit(2, f"{self.prog}: {message} (try {self.prog} --help)\n")

    def add_config(self):
        """The operand CONFIG, which may be left out where there is one beside SCENE."""
        self.add_argument(
            "config", metavar="CONFIG", nargs="?",
            help="the config of zbuf (default: the config.txt beside SCENE); - is standard input")

    def take_config(self, options):
        """Takes CONFIG, or the config.txt beside SCENE."""
        options.config = options.config or config_beside(options.scene)
        if options.config is None:
            self.error("expected CONFIG, found no config.txt beside SCENE")

    def expect_outside(self, folder, options, *files):
        """Ends the program where an operand or one of `files`, as for expect_separate, is in a folder from
        which the command removes files."""
        inside = os.path.join(os.path.realpath(folder), "")
        for name, path in [*((name.upper(), getattr(options, name, None)) for name in OPERANDS), *files]:
            if path and os.path.realpath(path).startswith(inside):
                self.error(f"{name}: expected a place outside of '{shown(folder)}', found '{shown(path)}'")

    def expect_separate(self, options, *outputs, inputs=(), folder=None):
        """Ends the program where an output is another output or an input, by path, link or inode, or has no
        name, as a folder, or is `-`: commands that take it pass STANDARD_OUTPUT. Outputs are pairs of a name
        for messages and a path or None, and so are inputs beside the usual operands."""
        if folder == "":
            self.error("expected the name of a folder, found ''")
        operands = [(name.upper(), getattr(options, name, None)) for name in OPERANDS]
        names = {}
        for is_output, files in ((False, [*operands, *inputs]), (True, outputs)):
            for name, path in files:
                if is_output and path == "":
                    self.error(f"{name}: expected the name of a file, found ''")
                if is_output and path == "-":
                    self.error(f"{name}: expected no standard output, found '-' (./- for one of this name)")
                if path is None or (place := place_of(path)) is None:
                    continue
                told = f"{name} '{shown(path)}'" if name else "standard output"
                if is_output and place in names:
                    self.error("expected a place of its own for every output, "
                               f"found the same one for {names[place]} and {told}")
                names.setdefault(place, told)
