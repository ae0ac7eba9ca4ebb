"""Mistakes of one token that a C++ source could have: another operator, another constant, a condition that is
always the same.

It relies on the format of this project's sources: blanks stand around binary operators, and around nothing
that only looks like one.
"""
import collections
import hashlib
import re

from parts import python_mutants

OPERATORS = {
    "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||", "||": "&&", "+": "-",
    "-": "+", "*": "/", "/": "*", "%": "/", "&": "|", "|": "&", "^": "|", "<<": ">>", ">>": "<<", "+=": "-=",
    "-=": "+=", "*=": "/=", "/=": "*=", "&=": "|=", "|=": "&=", "<<=": ">>=", ">>=": "<<="}
SWAPPED = {"++": "--", "--": "++", "true": "false", "false": "true"}

NO_CODE = re.compile(
    r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*',
    re.M | re.S)
ASSERTION = re.compile(r"\b(?:static_)?assert\(")
BINARY = re.compile(
    r"(?<=\s)(?:%s)(?=\s)" % "|".join(re.escape(word) for word in sorted(OPERATORS, key=len, reverse=True)))
SWAP = re.compile(r"\+\+(?=\w)|--(?=\w)|\btrue\b|\bfalse\b")
SIGN = re.compile(r"!(?=[\w(])|(?:(?<=[({\[])|(?<=[,=?:] )|(?<=return ))-(?=[\w(])")
NUMBER = re.compile(
    r"(?<![\w.'])(0x[\da-fA-F.']+(?:p[+-]?\d+)?|\d[\d']*(?:\.\d*)?(?:e[+-]?\d+)?)[uUlL]*(?![\w.'])")
CONDITION = re.compile(r"\b(if|while)(?: constexpr)? \(")


class Mutant(collections.namedtuple("Mutant", "file line begin end new name")):
    """What stands at [begin, end) of a file becomes `new`; the name is the source line with [old -> new] in
    it."""

    def applied_to(self, text):
        return text[:self.begin] + self.new + text[self.end:]


def blanked(text, begin, end):
    """The text with blanks from begin to end, the line ends excepted."""
    return text[:begin] + re.sub(r"[^\n]", " ", text[begin:end]) + text[end:]


def closing(text, begin):
    """The index of the parenthesis that closes the one at `begin`."""
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] == "(") - (text[i] == ")")
        if depth == 0:
            return i
    raise ValueError(f"nothing closes the parenthesis in {text[begin:begin + 40]!r}")


def code_of(text):
    """The text with blanks for comments, strings, the preprocessor's lines and assertions, which a release
    build leaves out."""
    code = NO_CODE.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), text)
    for match in ASSERTION.finditer(code):
        code = blanked(code, match.start(), closing(code, match.end() - 1))
    return code


def other_numbers(number):
    """The next numbers up and down; for a float, one up; for a number with an exponent, the next exponent."""
    digits = number.replace("'", "")
    if "p" in digits:
        mantissa, exponent = digits.split("p")
        return [f"{mantissa}p{int(exponent) + 1}"]
    if digits.startswith("0x"):
        return [hex(int(digits, 16) + 1)]
    if "e" in digits:
        mantissa, exponent = digits.split("e")
        return [f"{mantissa}e{int(exponent) + 1}"]
    if "." in digits:
        return [repr(float(digits) + 1)]
    is_octal = digits.startswith("0") and digits != "0"
    value = int(digits, 8 if is_octal else 10)
    return [f"0{other:o}" if is_octal else str(other) for other in (value + 1, value - 1) if other >= 0]


def changes(code):
    """(begin, end, new text) of each mutant."""
    for match in BINARY.finditer(code):
        yield *match.span(), OPERATORS[match.group()]
    for match in SWAP.finditer(code):
        yield *match.span(), SWAPPED[match.group()]
    for match in SIGN.finditer(code):
        yield *match.span(), ""
    for match in NUMBER.finditer(code):
        is_template_argument = code[match.end()] == ">" or code[match.start() - 1] == "<"
        for number in [] if is_template_argument else other_numbers(match.group(1)):
            yield *match.span(1), number
    for match in CONDITION.finditer(code):
        begin, end = match.end(), closing(code, match.end() - 1)
        begin = max(begin, code.rfind(";", begin, end) + 1)  # after a declaration
        if " = " not in code[begin:end]:  # a declaration alone
            for value in ("true", "false") if match.group(1) == "if" else ("false",):
                yield begin, end, value


def mutants_of(file, text):
    """All mutants of a source, in the order of their lines."""
    found = collections.Counter()
    mutants = []
    found_changes = python_mutants.changes(text) if file.endswith(".py") else changes(code_of(text))
    for begin, end, new in sorted(found_changes):
        first, last = text.rfind("\n", 0, begin) + 1, text.find("\n", end)
        shown = f"{text[first:begin]}[{text[begin:end]} -> {new or 'nothing'}]{text[end:last]}"
        name = f"{file}: {' '.join(shown.split())}"
        found[name] += 1
        if found[name] > 1:
            name += f" #{found[name]}"
        mutants.append(Mutant(file, text.count("\n", 0, begin), begin, end, new, name))
    return mutants


def sample(mutants, seed):
    """The mutants in random order, one of each line before a second of any. A changed line leaves the order
    of the others as it is."""
    by_line = collections.defaultdict(list)
    for mutant in sorted(mutants,
                         key=lambda mutant: hashlib.sha256(f"{seed} {mutant.name}".encode()).digest()):
        by_line[mutant.file, mutant.line].append(mutant)
    groups = list(by_line.values())
    return [group[i] for i in range(max(map(len, groups), default=0)) for group in groups if i < len(group)]
