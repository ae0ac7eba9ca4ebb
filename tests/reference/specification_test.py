#!/usr/bin/env python3
"""The three pages of the specification, the reference that carries them out, and the cases that ask for
them name one another's paragraphs; the grammar is that of the cases.

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
from conform_parts import paragraph  # noqa: E402
from conform_parts.pages import files_of, read_fields, read_page  # noqa: E402

NAME = r"[A-Z]\d+[a-z]?"
CASES = {
    f"{path.parent.name}/{name}": (fields := read_fields(
        text, path.parent.name), files_of(path.parent.name, fields, sections))
    for path in (SOURCE / "tests/conformance/cases").glob("*/*.cases")
    for name, text, sections in read_page(path.read_text("ascii"))}
TERMINALS = {"LF": "\n", "SP": " ", "HTAB": "\t", "DIGIT": "[0-9]"}


def page_text(page):
    return (SOURCE / "docs" / f"{page}.md").read_text()


def paragraphs():
    """(name, does it demand nothing, page, text) of all paragraphs, in their order."""
    found = rf"^\*\*({NAME})\*\*( \*\(note\)\*)?(.*?)(?=^\*\*|^#|\Z)"
    return [(name, bool(note) or name[0] == "F", page, text) for page in PAGES
            for name, note, text in re.findall(found, page_text(page), re.M | re.S)]


def expression(tokens, rules):
    """The regular expression of tokens of ABNF (RFC 5234), up to a closing bracket."""
    result = ""
    while tokens and tokens[0] not in ")]":
        token, count = tokens.pop(0), ""
        if token == "/":
            result += "|"
            continue
        if found := re.fullmatch(r"(\d*)(\*?)(\d*)", token):
            low, star, high = found.groups()
            count, token = f"{{{low or 0},{high}}}" if star else f"{{{low}}}", tokens.pop(0)
        if token in "([":
            inner, count = expression(tokens, rules), count or "?" * (token == "[")
            tokens.pop(0)
        else:
            known = re.escape(token[1:-1]) if token[0] == '"' else TERMINALS.get(token)
            inner = known or expression(rules[token][:], rules)
        result += f"(?:{inner}){count}"
    return result


def grammar():
    """The regular expressions of the grammar's rules, by name."""
    text = re.sub(";.*", "", re.search("```abnf\n(.*?)```", page_text("scene"), re.S)[1])
    rules = {
        name: re.findall(r'"[^"]*"|[A-Za-z][\w-]*|\d*\*\d*|\d+|[()\[\]/]', rule)
        for name, rule in re.findall(r"^(\w+) += (.*(?:\n +.*)*)", text, re.M)}
    return {name: re.compile(expression(rule[:], rules)) for name, rule in rules.items()}


def without_comments(data):
    """A text as the grammar has it."""
    lines = data.removeprefix(b"\xef\xbb\xbf").decode("latin-1").removesuffix("\n").split("\n")
    parts = [line.partition("#") for line in lines]
    bare = [(text.rstrip(" \t\r").lstrip(" \t"), sign) for text, sign, _ in parts]
    return "".join(text + "\n" for text, sign in bare if text or not sign)


ORDER = tuple(name for name, *_ in paragraphs())

FUNCTIONS = [(name, line, labels) for name, line, _, labels in paragraph.carried_out(REFERENCE, ORDER)
             if name != "__init__"]


class Specification(unittest.TestCase):
    def test_paragraphs_are_numbered_in_their_order(self):
        last = {}
        for name in ORDER:
            before, number = last.get(name[0], "0"), name[1:]
            follows = before + "a" if before.isdigit() else before[:-1] + chr(ord(before[-1]) + 1)
            self.assertIn(number, (str(int(before.rstrip("abcdef")) + 1), follows), name)
            last[name[0]] = number
        self.assertGreater(len(ORDER), 60)

    def test_paragraphs_that_are_mentioned_exist(self):
        for page in PAGES:
            self.assertEqual(set(re.findall(r"\b[A-Z]\d+[a-z]?\b", page_text(page))) - {*ORDER}, set(), page)
        for name, (fields, _) in CASES.items():
            self.assertEqual({*fields["paragraphs"].split()} - {*ORDER}, set(), name)

    def test_every_paragraph_has_a_case_that_asks_for_it(self):
        for name, demands_nothing, page, text in paragraphs():
            with self.subTest(paragraph=name, page=page):
                cases = re.findall(r"\(`((?:model|view|project|zbuf)/[\w-]+)`\)", text)
                self.assertEqual(len(cases), not (demands_nothing or name == "O3"))  # no case is misuse
                self.assertTrue(all(name in CASES[case][0]["paragraphs"].split() for case in cases), cases)

    def test_every_paragraph_can_be_walked(self):
        for name, demands_nothing, page, text in paragraphs():
            with self.subTest(paragraph=name):
                shown = "\n".join(paragraph.described(name))
                self.assertTrue(shown.startswith(f"{name}, docs/{page}.md\n"))
                own = re.search(r"\(`((?:model|view|project|zbuf)/[\w-]+)`\)", text)
                self.assertRegex(shown, rf"\ncases:\n  {own[1]}: " if own else r"\ncases:\n  (none: |\w+/)")
                self.assertTrue(demands_nothing
                                or re.search(r"\n  tests/reference/reference\.py:\d+: \w+", shown))
        self.assertIsNone(paragraph.described("Z99"))

    def test_marks_name_what_exists(self):
        marks = paragraph.marks()
        self.assertGreater(len(marks), 40)
        self.assertEqual({label for labels, _, _ in marks for label in labels} - {*ORDER}, set())
        self.assertTrue(all(code.endswith(("{", ",")) for _, _, code in marks), marks)

    def test_notes_grant_nothing(self):
        for name, _, page, text in paragraphs():
            if name[0] not in "FO" and re.search(r"\bmay differ\b|\bmay be off\b|to either side", text):
                self.fail(f"{page}, {name}: a freedom")

    def test_the_grammar_is_that_of_the_cases(self):
        rules, refused, wrong = grammar(), 0, 0
        for name, (fields, files) in CASES.items():
            kind = "scene" if name.startswith("model/") else "stage"
            texts = [(kind, files["input.txt"]), *[("config", files[f]) for f in files if f == "config.txt"]]
            matches = all(rules[rule].fullmatch(without_comments(text)) for rule, text in texts)
            with self.subTest(case=name):
                self.assertTrue(matches or "refused" in fields)
            refused, wrong = refused + ("refused" in fields), wrong + (not matches)
        self.assertGreater(refused, 100)
        self.assertGreater(wrong,
                           refused / 3)  # the others break a rule about numbers, order or what is there

    def test_pages_are_short(self):
        for page in PAGES:
            self.assertLessEqual(len(page_text(page).encode()), 16 * 1024, page)
            self.assertLessEqual(max(map(len, page_text(page).splitlines())), 120, page)

    def test_the_changelog_counts_the_cases(self):
        changelog = (SOURCE / "CHANGELOG.md").read_text()
        self.assertEqual(re.findall(r"`conform` runs ([\d,]+)\s+cases", changelog), [f"{len(CASES):,}"])

    def test_every_function_names_its_paragraphs(self):
        for name, line, labels in FUNCTIONS:
            with self.subTest(function=name, line=line):
                self.assertTrue(labels)

    def test_every_paragraph_is_carried_out_or_a_note(self):
        carried_out = {label for _, _, labels in FUNCTIONS for label in labels}
        for name, demands_nothing, page, _ in paragraphs():
            with self.subTest(paragraph=name, page=page):
                self.assertTrue(demands_nothing or name in carried_out)

    def test_the_functions_stand_in_the_order_of_the_pages(self):
        starts = [(number, page) for number, line in enumerate(REFERENCE.splitlines(), 1)
                  for page in re.findall(r"^# (scene|stage-text|stages)\.md: ", line)]
        self.assertEqual([page for _, page in starts], sorted((page for _, page in starts), key=PAGES.index))
        page_of = {name: page for name, _, page, _ in paragraphs()}
        for name, line, labels in FUNCTIONS:
            if name not in ("main", "read_options"):
                with self.subTest(function=name):
                    self.assertEqual(page_of[labels[0]], [page for start, page in starts if start < line][-1])

    def test_the_reference_is_short_and_needs_only_the_standard_library(self):
        self.assertLessEqual(len(REFERENCE.splitlines()), 850)
        imported = {
            name.name
            for node in ast.walk(ast.parse(REFERENCE)) if isinstance(node, ast.Import) for name in node.names}
        imported |= {
            node.module
            for node in ast.walk(ast.parse(REFERENCE)) if isinstance(node, ast.ImportFrom)}
        self.assertLessEqual(imported, set(sys.stdlib_module_names))


if __name__ == "__main__":
    unittest.main()
