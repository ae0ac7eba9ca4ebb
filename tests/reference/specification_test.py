#!/usr/bin/env python3
"""The three pages of the specification and the reference that carries them out name one another's paragraphs.

usage: specification_test.py SOURCE_DIR
"""
import ast
import pathlib
import re
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
PAGES = ("scene", "stage-text", "stages")
REFERENCE = (SOURCE / "tests/reference/reference.py").read_text()


def paragraphs():
    """(name, is it a note, page) of all paragraphs, in their order."""
    return [
        (name, bool(note), page)
        for page in PAGES
        for name, note in re.findall(r"^\*\*([A-Z]\d+)\*\*( \*\(note\)\*)?", (SOURCE / "docs" /
                                                                              f"{page}.md").read_text(), re.M)
    ]


def named_in(comment):
    """The paragraphs that a comment begins with: `S5`, `S6 to S8, T2`."""
    names = []
    for first, last in re.findall(r"([A-Z]\d+)(?: to ([A-Z]\d+))?",
                                  re.match(r"[A-Z]\d+(?:(?:, | to )[A-Z]\d+)*", comment)[0]):
        names += [f"{first[0]}{n}" for n in range(int(first[1:]), int((last or first)[1:]) + 1)]
    return names


def functions():
    """(name, first line, comment behind its first line) of all functions and classes but constructors."""
    lines = REFERENCE.splitlines()
    for node in ast.walk(ast.parse(REFERENCE)):
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)) and node.name != "__init__":
            yield node.name, node.lineno, lines[node.lineno - 1].partition("  # ")[2]


class Specification(unittest.TestCase):
    def test_paragraphs_are_numbered_in_their_order(self):
        last = {}
        for name, _, _ in paragraphs():
            self.assertEqual(int(name[1:]), last.get(name[0], 0) + 1, name)
            last[name[0]] = int(name[1:])
        self.assertGreater(len(paragraphs()), 60)

    def test_paragraphs_that_are_mentioned_exist(self):
        names = {name for name, _, _ in paragraphs()}
        for page in PAGES:
            text = (SOURCE / "docs" / f"{page}.md").read_text()
            self.assertEqual(set(re.findall(r"\b[SCTNMVPZL]\d+\b", text)) - names, set(), page)

    def test_pages_are_short(self):
        for page in PAGES:
            self.assertLessEqual((SOURCE / "docs" / f"{page}.md").stat().st_size, 14 * 1024, page)

    def test_every_function_names_its_paragraphs(self):
        names = {name for name, _, _ in paragraphs()}
        for name, line, comment in functions():
            with self.subTest(function=name, line=line):
                self.assertRegex(comment, r"^[A-Z]\d+")
                self.assertEqual(set(named_in(comment)) - names, set())

    def test_every_paragraph_is_carried_out_or_a_note(self):
        carried_out = {name for _, _, comment in functions() for name in named_in(comment)}
        for name, is_note, page in paragraphs():
            with self.subTest(paragraph=name, page=page):
                self.assertTrue(is_note or name in carried_out)

    def test_the_functions_stand_in_the_order_of_the_pages(self):
        starts = [(number, page) for number, line in enumerate(REFERENCE.splitlines(), 1)
                  for page in re.findall(r"^# (scene|stage-text|stages)\.md: ", line)]
        self.assertEqual([page for _, page in starts], sorted((page for _, page in starts), key=PAGES.index))
        page_of = {name: page for name, _, page in paragraphs()}
        for name, line, comment in functions():
            if name not in ("main", "read_options"):
                with self.subTest(function=name):
                    self.assertEqual(page_of[named_in(comment)[0]],
                                     [page for start, page in starts if start < line][-1])

    def test_the_reference_is_short_and_needs_only_the_standard_library(self):
        self.assertLessEqual(len(REFERENCE.splitlines()), 780)
        imported = {
            name.name
            for node in ast.walk(ast.parse(REFERENCE)) if isinstance(node, ast.Import) for name in node.names}
        imported |= {
            node.module
            for node in ast.walk(ast.parse(REFERENCE))
            if isinstance(node, ast.ImportFrom)}
        self.assertLessEqual(imported, set(sys.stdlib_module_names))


if __name__ == "__main__":
    unittest.main()
