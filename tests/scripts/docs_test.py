#!/usr/bin/env python3
"""README.md and the pages of docs/ are true: every command of a console block prints what it shows, links
lead somewhere, and docs/README.md lists what keeps true each page that runs no command.

usage: docs_test.py BIN_DIR SOURCE_DIR [UNITTEST ARGUMENT...]

In a block ```console bash runs each line '$ COMMAND' in a copy of the source folder with the tools on the
PATH; the lines up to the next command are its expected output, stdout and stderr together. A page's commands
share a folder, which no other page sees.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
from hashlib import sha256
from importlib.machinery import SourceFileLoader
from importlib.util import module_from_spec, spec_from_loader

BIN_DIR, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
del sys.argv[1:3]

README = SOURCE / "README.md"
INDEX = SOURCE / "docs/README.md"
PAGES = [README, SOURCE / "CONTRIBUTING.md", *sorted((SOURCE / "docs").glob("*.md"))]
OTHER_PAGES = [
    SOURCE / "CHANGELOG.md",
    *(SOURCE / room / "README.md" for room in ("libpipeline", "scripts", "tests", "tests/proofs", "tools"))]
SPECIFICATION = ("scene", "stage-text", "stages")
BLOCK = re.compile(r"^```.*?^```$", re.MULTILINE | re.DOTALL)


def name_of(page):
    return str(page.relative_to(SOURCE))


def examples(text):
    """Pairs of a command and its expected output."""
    for block in re.findall(r"^```console\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        for example in re.split(r"^\$ ", block, flags=re.MULTILINE)[1:]:
            command, _, output = example.partition("\n")
            yield command, output


def prose(text):
    """The text without its blocks and inline code."""
    return re.sub(r"`[^`\n]*`", "", BLOCK.sub("", text))


def links(text):
    return re.findall(r"\]\(([^)\s]+)\)", prose(text))


def anchors(text):
    """The anchors that a link may name: the headings, in lower case, blanks as dashes, without other
    punctuation."""
    headings = re.findall(r"^#+ (.*)$", BLOCK.sub("", text), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


def dead_links(page, text):
    """Those whose file or heading is not there."""
    dead = []
    for link in links(text):
        if re.match(r"[a-z]+:", link):
            continue
        path, _, anchor = link.partition("#")
        target = (page.parent / path).resolve() if path else page
        if not target.exists() or anchor and anchor not in anchors(text if target ==
                                                                   page else target.read_text()):
            dead.append(link)
    return dead


def marked_tables(text):
    return re.findall(r"^<!-- ([\w-]+): begin -->$", text, re.MULTILINE)


def kept():
    """{page: what keeps it true} by the list in docs/README.md."""
    section = INDEX.read_text().partition("\n## What keeps these pages true\n")[2]
    items = re.findall(r"^- (.+\n(?:  .+\n)*)", section, re.MULTILINE)
    rows = (" ".join(item.split()).partition(": ") for item in items)
    return {(INDEX.parent / link).resolve(): keepers for pages, _, keepers in rows for link in links(pages)}


class Commands(unittest.TestCase):
    maxDiff = None

    def test_every_command_prints_what_the_page_shows(self):
        count, without = 0, tempfile.TemporaryDirectory()  # in no real sandbox, which is slow
        self.addCleanup(without.cleanup)
        bubblewrap = pathlib.Path(without.name, "bwrap")
        bubblewrap.write_text('#!/bin/sh\nwhile [ "$1" != -- ]; do shift; done; shift; exec "$@"\n')
        bubblewrap.chmod(0o755)
        environment = {
            **os.environ, "LC_ALL": "C.UTF-8", "PATH": f"{without.name}:{BIN_DIR}:{os.environ['PATH']}"}
        environment.pop("BIN", None)
        for page in (page for page in PAGES if "\n```console" in page.read_text()):
            with tempfile.TemporaryDirectory() as folder:
                for name in ("samples", "scripts", "docs/starter"):
                    shutil.copytree(SOURCE / name, pathlib.Path(folder) / name)
                pathlib.Path(folder, "tests").mkdir()
                pathlib.Path(folder, "tests/conformance").symlink_to(SOURCE / "tests/conformance")
                for command, output in examples(page.read_text()):
                    with self.subTest(page=name_of(page), command=command):
                        run = subprocess.run(["bash", "-c", command], cwd=folder, env=environment,
                                             stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                             stderr=subprocess.STDOUT, text=True)
                        self.assertEqual(run.stdout, output)
                    count += 1
        self.assertGreater(count, 20)


class Pages(unittest.TestCase):
    def test_they_are_few_and_short(self):
        self.assertLessEqual(len([*(SOURCE / "docs").glob("*.md")]), 20)
        for page in (page for page in PAGES if page.stem not in (*SPECIFICATION, "errors")):
            self.assertLessEqual(page.stat().st_size, 8_000 if page == README else 12 * 1024, name_of(page))

    def test_lines_fit_into_120_columns(self):
        """Except tables, examples and pictures, which cannot be broken; the specification has none that is
        longer."""
        for page in PAGES + OTHER_PAGES:
            text = page.read_text()
            kept = text if page.stem in SPECIFICATION else re.sub(r"^([|#<]|!\[|    ).*", "",
                                                                  BLOCK.sub("", text), flags=re.M)
            self.assertEqual([line for line in kept.split("\n") if len(line) > 120], [], name_of(page))

    def test_no_wrapped_line_becomes_a_bullet(self):
        for page in PAGES + OTHER_PAGES:
            bullet = re.compile(r"(?:^(?![-+*] |[\s|#]|\d+\.).*[^:\n]|\([^()\n]*)\n *[-+*] .*", re.M)
            self.assertEqual(bullet.findall(BLOCK.sub("", page.read_text())), [], name_of(page))

    def test_every_link_leads_somewhere(self):
        for page in PAGES + OTHER_PAGES:
            self.assertEqual(dead_links(page, page.read_text()), [], name_of(page))

    def test_every_picture_is_shown(self):
        shown = {(page.parent / link).resolve() for page in PAGES for link in links(page.read_text())}
        pictures = {*(SOURCE / "docs/pictures").iterdir(), *(SOURCE / "samples").glob("*/*.png")}
        self.assertEqual(sorted(map(name_of, pictures - shown)), [])

    def test_a_picture_shows_what_its_source_says_today(self):
        """make-pictures keeps a hash of it in the file."""
        script = str(SOURCE / "scripts/maintain/make-pictures")
        spec = spec_from_loader("make_pictures", SourceFileLoader("make_pictures", script))
        maker = module_from_spec(spec)
        spec.loader.exec_module(maker)
        for name, text in maker.sources().items():
            kept = (SOURCE / "docs/pictures" / name).read_bytes().partition(b"tEXtSource\0")[2][:64].decode()
            self.assertEqual(kept, sha256(text.encode()).hexdigest(), f"{name}: run make-pictures again")

    def test_the_index_names_every_page_of_docs(self):
        named = {(INDEX.parent / link.partition("#")[0]).resolve() for link in links(INDEX.read_text())}
        self.assertEqual([name_of(page) for page in PAGES if page not in named and page != INDEX], [])


class KeptTrue(unittest.TestCase):
    """The list of docs/README.md."""
    def assert_keepers(self, item, words):
        """The words name at least one test or script, and all of them are there."""
        sources = "\n".join(
            path.read_text() for path in (SOURCE / "tests").rglob("*") if path.suffix in (".cpp", ".txt"))
        tests, scripts = re.findall(r"`(\w+)\.([A-Z]\w+)`", words), re.findall(r"`(scripts/[\w/-]+)`", words)
        self.assertTrue(tests or scripts, f"{item}: nothing keeps it true")
        for suite, name in tests:
            form = (rf"tools_test\({name} |\bTools\.{name} "
                    if suite == "Tools" else rf"TEST(?:_[FP])?\({suite},\s+{name}\)|\b{suite}\.{name}\b")
            self.assertTrue(re.search(form, sources), f"{item}: no test {suite}.{name}")
        for script in scripts:
            self.assertTrue(os.access(SOURCE / script, os.X_OK), f"{item}: no script {script}")

    def test_every_page_runs_or_is_listed_with_its_keepers(self):
        pages = kept()
        history = {INDEX, SOURCE / "CONTRIBUTING.md", SOURCE / "CHANGELOG.md"}
        idle = {page for page in [*PAGES, *OTHER_PAGES] if not any(examples(page.read_text()))}
        self.assertEqual(sorted(map(name_of, idle - pages.keys() - history)), [])
        self.assertGreater(len(pages), 20)
        for page, keepers in pages.items():
            self.assert_keepers(name_of(page), keepers)

    def test_every_table_between_marks_and_every_picture_has_its_script(self):
        tables = [name for page in PAGES + OTHER_PAGES for name in marked_tables(page.read_text())]
        self.assertEqual(sorted(tables), ["bench", "extremes"])
        for name in tables:
            self.assertIn(f'"{name}"', (SOURCE / "scripts/measure" / name).read_text())
        maker = (SOURCE / "scripts/maintain/make-pictures").read_text()
        for path in (SOURCE / "docs/pictures").iterdir():
            self.assertIn(re.sub("^(mistakes)-.*", r"\1-{stage}.png", path.name), maker)


class WhatThePagesName(unittest.TestCase):
    def test_the_scene_in_fifteen_lines_is_one(self):
        section = README.read_text().split("## The scene in fifteen lines\n\n")[1]
        scene = "".join(line[4:] for line in section.split("\n\n")[0].splitlines(keepends=True)) + "\n"
        self.assertEqual(scene.count("\n"), 15)
        done = subprocess.run([BIN_DIR / "model", "--bare"], input=scene, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr, len(done.stdout.splitlines())), (0, "", 4))

    def test_the_version_is_that_of_cmake(self):
        version = re.search(r"project\(pipeline VERSION (\S+)", (SOURCE / "CMakeLists.txt").read_text())[1]
        self.assertIn(f"This is {version}.", README.read_text())

    def test_the_tests_that_hold_a_promise_are_there(self):
        tests = re.findall(r"`(\w+/\w+_test\.(?:py|cpp))`", (SOURCE / "docs/guarantees.md").read_text())
        self.assertGreater(len(tests), 15)
        self.assertEqual([test for test in tests if not (SOURCE / "tests" / test).is_file()], [])

    def test_the_run_that_holds_a_promise_is_named(self):
        """A script's tests are in the runs of tests/runs.txt; compare-builds and fuzz are steps of
        .ci/run."""
        cmake = "\n".join(path.read_text() for path in (SOURCE / "tests").rglob("CMakeLists.txt"))
        labels = re.findall(r"^(check|all|matrix) +\d+ +(.*)", (SOURCE / "tests/runs.txt").read_text(),
                            re.MULTILINE)

        def runs_of(keeper):
            if not keeper.endswith(".py"):
                return ["ci" if keeper.startswith("scripts/") else "check"]
            names = re.findall(rf"(tools_|script_)test\(([\w.]+) {keeper[:-3]}\b", cmake)
            full = ["Tools." * (kind == "tools_") + name for kind, name in names]
            return [
                next((run for run, pattern in labels if re.fullmatch(pattern, name)), "check")
                for name in full]

        rows = re.findall(r"^\| .* \| (`.*) \| (.*) \|$", (SOURCE / "docs/guarantees.md").read_text(),
                          re.MULTILINE)
        self.assertGreater(len(rows), 15)
        for keepers, named in rows:
            runs = {run for keeper in re.findall(r"`(.+?)`", keepers) for run in runs_of(keeper)}
            self.assertEqual(named, ", ".join(run for run in ("check", "all", "ci", "matrix") if run in runs),
                             keepers)

    def test_every_command_of_pipeline_is_there(self):
        for page in PAGES:
            code = "\n".join(re.findall(r"`[^`\n]*`|^    .*|^\$ .*", page.read_text(), re.MULTILINE))
            for word in sorted({*re.findall(r"(?:^|[^\w/-])pipeline ([a-z][a-z-]+)", code, re.MULTILINE)}):
                with self.subTest(page=name_of(page), command=word):
                    known = word in ("help", "env") or (BIN_DIR.parent / "libexec/pipeline" / word).exists()
                    self.assertTrue(known, f"pipeline {word}")

    def test_every_option_of_a_filter_is_there(self):
        """Options after the name of a filter in the same piece of code. The page of errors has wrong ones on
        purpose."""
        texts = {
            tool: subprocess.run([BIN_DIR / tool, "--help-all"], capture_output=True, text=True).stdout
            for tool in ("model", "view", "project", "zbuf")}
        count = 0
        for page in (page for page in PAGES if page.name != "errors.md"):
            for code in re.findall(r"`[^`\n]*`|^    .*|^\$ .*", page.read_text(), re.MULTILINE):
                for tool, words in re.findall(
                        r"(?<![\w./-])(?<!--stage )(model|view|project|zbuf)((?: +(?![|<>&;])[^\s|;&`)]+)*)",
                        code):
                    for option in re.findall(r"(?<=\s)--[a-z][a-z-]*", words):
                        self.assertIsNotNone(re.search(rf"(?<![\w-]){option}(?![\w-])", texts[tool]),
                                             f"{name_of(page)}: {tool} {option}")
                        count += 1
        self.assertGreater(count, 40)


class TheTestItself(unittest.TestCase):
    def test_it_sees_dead_links(self):
        text = ("# One two\n[a](README.md) [b](no.md) [c](#one-two) [d](#two) `[e](f.md)`\n```console\n# x\n"
                "[g](h.md)\n```\n")
        self.assertEqual(dead_links(README, text), ["no.md", "#two"])

    def test_it_finds_commands_and_tables(self):
        text = "```console\n$ a\nb\nc\n$ d\n```\n<!-- e: begin -->\n<!-- e: end -->\n"
        self.assertEqual(list(examples(text)), [("a", "b\nc\n"), ("d", "")])
        self.assertEqual(marked_tables(text), ["e"])


unittest.main()
