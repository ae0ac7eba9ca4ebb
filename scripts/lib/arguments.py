"""The command line of a script: how --help looks, and how a mistake in it is told."""
import argparse
import re
import textwrap


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Fits the paragraphs of a description to the terminal; those with lines that are indented, such as examples, stay as they are."""

    def _fill_text(self, text, width, indent):
        paragraphs = re.split(r"\n\s*\n", text.strip("\n"))
        return "\n\n".join(self._paragraph(paragraph, width, indent) for paragraph in paragraphs)

    def _paragraph(self, paragraph, width, indent):
        if re.search(r"^\s", paragraph, re.MULTILINE):
            return textwrap.indent(paragraph, indent)
        return textwrap.fill(paragraph, width, initial_indent=indent, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


class CommandParser(argparse.ArgumentParser):
    """Tells a mistake in one line, as the tools do."""

    def __init__(self, **settings):
        super().__init__(formatter_class=HelpFormatter, **settings)

    def error(self, message):
        self.exit(2, f"{self.prog}: {message} (try {self.prog} --help)\n")
