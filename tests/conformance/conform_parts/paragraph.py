"""A paragraph of the specification: its text, its cases and known mistakes, and what carries it out."""
import ast
import functools
import re
import textwrap

from .cases import ROOT, STAGES, read_cases, read_mistakes

LABEL = r"[A-Z]\d+[a-z]?"
PAGES = ("scene", "stage-text", "stages")
WIDTH = 80
MOST_CASES = 12
MOST_LABELS, MOST_LINES = 6, 45  # of a function that is shown; one that carries out more is a whole stage


def place(in_source, installed):
    """A file or folder of the source tree, or of a prefix; None where the pack stands alone."""
    paths = ROOT.parent.parent / in_source, ROOT.parent / installed
    return next((path for path in paths if path.exists()), None)


@functools.cache
def all_cases():
    return [case for stage in STAGES for case in read_cases(stage)]


@functools.cache
def read_paragraphs():
    """{label: (page, text)}, in their order; empty where the pages are not there."""
    found, folder = {}, place("docs", "../doc/pipeline/docs") or ROOT
    for page in PAGES if (folder / "stages.md").exists() else ():
        text = (folder / f"{page}.md").read_text("utf-8")
        for label, words in re.findall(rf"^\*\*({LABEL})\*\* (.*?)(?=^\*\*{LABEL}\*\*|^#|\Z)", text,
                                       re.M | re.S):
            found[label] = page, words.strip()
    return found


def way_to(label):
    """The command that shows a paragraph, in brackets; empty where the pages are not there."""
    command = "pipeline help" if place("docs", "../doc/pipeline/docs") else "conform --paragraph"
    return f" ({command} {label})" if read_paragraphs() else ""


def labels_of(comment, order):
    """The labels that a comment begins with: `S5`, `S6 to S8, T2`."""
    labels = []
    head = re.match(rf"(?:{LABEL}(?:, | to |\b))*", comment)[0]
    for first, last in re.findall(rf"({LABEL})(?: to ({LABEL}))?", head):
        labels += order[order.index(first):order.index(last or first) + 1]
    return labels


@functools.cache
def carried_out(text, order):
    """(name, first line, last line, labels) of the functions of the reference; `order` is a tuple."""
    lines = text.splitlines()
    return [
        (node.name, node.lineno, node.end_lineno, labels_of(lines[node.lineno - 1].partition("  # ")[2],
                                                            order)) for node in ast.walk(ast.parse(text))
        if isinstance(node, (ast.FunctionDef, ast.ClassDef))]


def mistakes_of(label):
    """The sentences of mistakes.txt below a line of comment with the label."""
    below, found = [], []
    for line in (ROOT / "mistakes.txt").read_text("utf-8").splitlines():
        if line.startswith("# "):
            below = re.findall(rf"(?<!\S){LABEL}(?!\S)", line)
        elif label in below and line[:1].isalpha():
            found.append(line.removeprefix("judge "))
    return found


def why_no_case(label, text):
    """Why no case asks for a paragraph."""
    if text.startswith("*(note)*"):
        return "none: a note demands nothing"
    return "none: it permits, and demands nothing" if label[0] == "F" else "none: no case is misuse"


def case_lines(label, text):
    cases = [case for case in all_cases() if label in case.words("paragraphs")]
    own = re.search(rf"\(`((?:{'|'.join(STAGES)})/[\w-]+)`\)", text)
    first_with = {case.why: case.name for case in cases[::-1]}
    cases.sort(key=lambda case: case.name != (own and own[1]))
    shown_cases = [
        case for i, case in enumerate(cases) if not i or first_with[case.why] == case.name][:MOST_CASES]
    lines = [f"  {case.name}: {case.why}" for case in shown_cases]
    if len(cases) > len(shown_cases):
        lines.append(f"  and {len(cases) - len(shown_cases)} more: pipeline conform --list --only {label}")
    return lines or ["  " + why_no_case(label, text)]


def reference_lines(label, order):
    path = place("tests/reference/reference.py", "reference/reference.py")
    text = path.read_text("utf-8") if path else ""
    functions = [function for function in carried_out(text, order) if label in function[3]]
    lines = [f"  {shown(path)}:{first}: {name}" for name, first, _, _ in functions]
    for _, first, last, labels in functions:
        if last - first < MOST_LINES and (len(labels) <= MOST_LABELS or len(functions) == 1):
            lines += ["", *("    " + line for line in text.splitlines()[first - 1:last])]
    return lines


def shown(path):
    """A path of the source tree without that of its top."""
    top = ROOT.parent.parent
    return path.relative_to(top) if path.is_relative_to(top / "tests") else path


@functools.cache
def marks():
    """(labels, path, line, the code below) of the marks in the tools' sources; none in a prefix."""
    top = ROOT.parent.parent
    return [(mark[1].split(", "), f"{path.relative_to(top)}:{number}", mark[2])
            for room in ("libpipeline", "tools") for path in sorted((top / room).rglob("*.[ch]*"))
            for text in [path.read_text("utf-8")]
            for mark in re.finditer(rf"^ *// ({LABEL}(?:, {LABEL})*)\n(?: *template.*\n)?(.*)", text, re.M)
            for number in [text.count("\n", 0, mark.start(2)) + 1]]


def described(label):
    """The lines about a paragraph; None if there is none of this label."""
    paragraphs = read_paragraphs()
    if label not in paragraphs:
        return None
    page, text = paragraphs[label]
    body = [
        line for block in text.split("\n\n") for line in [
            *(block.splitlines() if block[0] in "|-" else textwrap.wrap(block, WIDTH, break_on_hyphens=False)
              ), ""]]
    lines = [f"{label}, docs/{page}.md", "", *body, "cases:", *case_lines(label, text)]
    for heading, found in (("known mistakes:", [
            "  " + line
            for line in mistakes_of(label)]), ("in the reference:", reference_lines(
                label, (*paragraphs,))), ("in the sources:", [
                    f"  {where}: {code}" for labels, where, code in marks() if label in labels])):
        lines += ["", heading, *found] if found else []
    return lines
