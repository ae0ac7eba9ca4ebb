#!/usr/bin/env python3
"""Man pages: every command has one, with the options of its --help; the formats' pages say what docs/ says.
Their examples are run by install_test.py, where they are installed.

usage: man_pages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import re
import shutil
import subprocess
import sys
import unittest

sys.dont_write_bytecode = True
from toolbox import BIN, SOURCE, ToolTest  # noqa: E402

sys.path.insert(0, str(SOURCE / "scripts/maintain"))
from parts.roff import Page, add_markdown, bold, escaped  # noqa: E402

PREFIX = BIN.parent
MAN = PREFIX / "share/man"
COMMANDS = sorted(os.listdir(PREFIX / "libexec/pipeline"))
FORMATS = {"scene": "scene.md", "stage": "stage-text.md"}
with_mandoc = unittest.skipUnless(shutil.which("mandoc"), "mandoc is missing (Debian: mandoc)")


def rendered(text):
    """The text that mandoc shows, without header and footer, in very long lines."""
    done = subprocess.run(["mandoc", "-T", "utf8", "-O", "width=900"], input=text, capture_output=True,
                          text=True, check=True)
    return re.sub(".\b", "", done.stdout).split("\n", 1)[1].rsplit("\n", 2)[0]


def page_of(command):
    return (MAN / f"man1/pipeline-{command}.1").read_text()


class Pages(ToolTest):
    def test_every_command_has_a_page_and_every_page_a_command(self):
        self.assertEqual(sorted(os.listdir(MAN / "man1")),
                         sorted(["pipeline.1", *(f"pipeline-{name}.1" for name in COMMANDS)]))
        self.assertEqual(sorted(os.listdir(MAN / "man5")), ["pipeline-scene.5", "pipeline-stage.5"])

    def test_pages_and_help_have_the_same_options(self):
        for command in COMMANDS:
            with self.subTest(command):
                words = [PREFIX / "libexec/pipeline" / command, "--help-all"]
                text = subprocess.check_output(words, text=True)
                lines = re.findall(r"^ {1,4}(-.*?)(?:  .*)?$", text, re.M)
                tags = re.findall(r"^\.TP\n(\\fB\\-.*)$", page_of(command), re.M)
                plain = [re.sub(r"\\f.", "", tag).replace("\\-", "-") for tag in tags]
                names = re.compile(r"--?[a-z][a-z-]*(?=[ ,=]|$)")
                self.assertEqual([names.findall(tag) for tag in plain],
                                 [names.findall(line) for line in lines])
                self.assertGreaterEqual(len(lines), 1)

    def test_every_page_has_an_example(self):
        for command in COMMANDS:
            example = r"\n\.SH EXAMPLES\n\.RS 4\n\.EX\n(.*\n)?.*pipeline " + re.escape(escaped(command))
            self.assertRegex(page_of(command), example, command)

    def test_the_page_of_pipeline_names_every_command(self):
        page = (MAN / "man1/pipeline.1").read_text()
        for command in COMMANDS:
            self.assertIn(f"\n.BR {escaped('pipeline-' + command)} (1)", page)
            self.assertIn(f"\n{bold('pipeline-' + command)}(1)\n", page)

    def test_every_page_named_exists(self):
        for page in [*MAN.glob("man*/*")]:
            for name, section in re.findall(r"^\.BR (\S+) \((\d)\)", page.read_text(), re.M):
                file = MAN / f"man{section}" / f"{name.replace(chr(92), '')}.{section}"
                self.assertTrue(file.exists(), f"{page.name} names {file.name}")

    @with_mandoc
    def test_mandoc_finds_nothing_wrong(self):
        pages = sorted(MAN.glob("man*/*"))
        done = subprocess.run(["mandoc", "-T", "lint", *pages], capture_output=True, text=True)
        self.assertEqual((done.stdout, done.stderr, done.returncode), ("", "", 0))

    @with_mandoc
    def test_the_pages_of_formats_have_the_words_of_the_documents(self):
        for name, file in FORMATS.items():
            text = (SOURCE / "docs" / file).read_text()
            paragraphs = re.split(r"\n{2,}", text)[1:]  # without the title
            shown = re.sub(r"(?m)^\S.*\n", "", rendered(
                (MAN / f"man5/pipeline-{name}.5").read_text()))  # without headings
            blocks = [" ".join(block.split()).replace("*", "") for block in re.split(r"\n\s*\n", shown)]
            count = 0
            for paragraph in paragraphs:
                if paragraph.startswith(("#", "|", "    ", "- ", "```")):
                    continue
                plain = re.sub(r"\[((?:[^\]`]|`[^`]*`)+)\]\([^)]*\)", r"\1", paragraph).replace("`",
                                                                                                "").replace(
                                                                                                    "*", "")
                plain = re.sub(r"scene\.md", "pipeline-scene(5)",
                               re.sub(r"stage-text\.md", "pipeline-stage(5)", plain))
                self.assertIn(" ".join(plain.split()), blocks)
                count += 1
            self.assertGreater(count, 10)
            for cell in re.findall(r"^\| `([^`]+)`", text, re.M):
                self.assertRegex(shown, rf"(?m)^ +{re.escape(cell)}(\W|$)")


class Roff(unittest.TestCase):
    """Texts that roff would take for something else."""
    def shown(self, page):
        return [line.strip() for line in rendered(page.text()).split("\n") if line.strip()]

    def page(self):
        page = Page("test", 1, "2026-11-22", "1")
        page.section("NAME")
        page.paragraph("test \\- a test")
        page.section("TEXT")
        return page

    @with_mandoc
    def test_odd_characters_are_shown_as_they_are(self):
        page, odd = self.page(), ".TH 'a' `b` c\\n ^ ~ - -- \"q\" \\fB é × ."
        page.paragraph(escaped(odd))
        page.literal([odd, "'x", "", "a   b"])
        page.item(bold(".x"), [escaped("'y")])
        self.assertEqual(self.shown(page)[3:], [odd, odd, "'x", "a   b", ".x     'y"])

    @with_mandoc
    def test_markdown_becomes_what_it_means(self):
        page = self.page()
        add_markdown(
            page,
            "A `code_1 *` and **bold**, *light*\nwith [a `link`](x.md#y).\n\n- one\n- two\n\n### Sub\n\n"
            "```console\n$ ls | wc\n```\n\n"
            "| key | what |\n|---|---|\n| `a\\|b` | the *key* |\n",
            lambda words, address: escaped(f"<{words}|{address}>"))
        self.assertEqual(
            self.shown(page)[3:], [
                "A code_1 * and bold, light with <a link|x.md#y>.", "• one", "• two", "Sub", "$ ls | wc",
                "a|b    the key"])


if __name__ == "__main__":
    unittest.main()
