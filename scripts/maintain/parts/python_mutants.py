"""Mistakes of one clause that a Python source could have: another operator or limit, a condition that is
always the same, a check, a word or a condition left out, two words in each other's place."""
import ast
import re

COMPARISONS = {"<": ("<=", ">"), "<=": ("<", ">="), ">": (">=", "<"), ">=": (">", "<="), "==": ("!=", ),
               "!=": ("==", ), "in": ("not in", ), "not in": ("in", ), "is": ("is not", ), "is not": ("is", )}
ARITHMETIC = {"+": "-", "-": "+", "*": "/", "/": "*", "//": "/", "%": "/", "**": "*"}
FUNCTIONS = {"min": "max", "max": "min", "any": "all", "all": "any", "floor": "ceil", "ceil": "floor"}


def changes(text):
    """(begin, end, new text) of each mutant."""
    lines = [0]
    for line in text.splitlines(keepends=True):
        lines.append(lines[-1] + len(line))

    def span(node, last=None):
        last = last or node
        return lines[node.lineno - 1] + node.col_offset, lines[last.end_lineno - 1] + last.end_col_offset

    tree = ast.parse(text)
    # Another element of a vector is no clause of its own; nor is the order of words that one may be.
    beside = [node.slice for node in ast.walk(tree) if isinstance(node, ast.Subscript)]
    beside += [side for node in ast.walk(tree) if isinstance(node, ast.Compare)
               for side in node.comparators if isinstance(side, ast.Tuple)]
    left_out = {id(part) for node in beside for part in ast.walk(node)}
    for node in ast.walk(tree):
        if id(node) not in left_out:
            yield from changes_of(node, span, text)


def changes_of(node, span, text):
    kind = type(node)
    if kind is ast.Compare:
        for a, b in zip([node.left, *node.comparators], node.comparators):
            yield from replaced(span(a)[1], span(b)[0], COMPARISONS, text)
    elif kind is ast.BinOp:
        yield from replaced(span(node.left)[1], span(node.right)[0], ARITHMETIC, text)
    elif kind is ast.BoolOp:
        other = {"and": "or", "or": "and"}
        for a, b in zip(node.values, node.values[1:]):
            yield from replaced(span(a)[1], span(b)[0], other, text)
            yield span(a)[1], span(b)[1], ""
        yield span(node.values[0])[0], span(node.values[1])[0], ""
    elif kind is ast.UnaryOp:
        yield span(node)[0], span(node.operand)[0], ""
    elif kind is ast.Constant and type(node.value) in (int, float):
        yield *span(node), repr(node.value + 1)
        yield *span(node), repr(node.value - 1)
    elif kind in (ast.If, ast.IfExp):
        yield *span(node.test), "True"
        yield *span(node.test), "False"
    elif kind is ast.comprehension:
        yield from ((*span(test), "True") for test in node.ifs)
    elif kind is ast.Expr and isinstance(node.value, ast.Call):
        yield *span(node), "pass"
    elif kind in (ast.Tuple, ast.List) and len(node.elts) > 1 and any(map(is_word, node.elts)):
        for a, b in zip(node.elts, node.elts[1:]):
            yield *span(a, b), text[slice(*span(b))] + text[span(a)[1]:span(b)[0]] + text[slice(*span(a))]
            yield span(a)[1], span(b)[1], ""
    elif kind is ast.Name and node.id in FUNCTIONS:
        yield *span(node), FUNCTIONS[node.id]
    elif kind is ast.Attribute and node.attr in FUNCTIONS:
        end = span(node)[1]
        yield end - len(node.attr), end, FUNCTIONS[node.attr]


def is_word(node):
    return isinstance(node, ast.Constant) and isinstance(node.value, str)


def replaced(begin, end, others, text):
    """The operator between two operands, by each of the others; brackets may stand beside it."""
    found = re.search(r"[^\s()]+(?: not| in)?", text[begin:end])
    new = others.get(found[0], ())
    for word in [new] if isinstance(new, str) else new:
        yield begin + found.start(), begin + found.end(), word
