"""The stack of matrices after every command of a scene that changes it, as in the assignment's table: T1, R1
and S1 name transforms, and a product names its factors, from left to right as in the code."""
import textwrap

from lib.explaining.layout import matrix_lines
from lib.maths.exact import double
from lib.maths.matrices import TRANSFORMS
from lib.text.scene import commands

WIDTH = 79
MAX_FACTORS = 8  # the most of a product that is written out
LEFT = 34  # columns before the stack


def stack_lines(text, name):
    """The report on a scene that model has accepted."""
    stack, transforms, counts, drawn = [()], [], dict.fromkeys(TRANSFORMS, 0), []
    lines = [name, "", f"{'line  command':{LEFT}}stack, its top first"]
    triangle_count = 0
    for command in commands(text):
        keyword = command.keyword
        if keyword in ("triangle", "sphere"):
            drawn.append((command.line, triangle_count))
            triangle_count += 1
            continue
        if keyword not in ("push", "pop", *TRANSFORMS):
            continue
        lines += triangle_lines(drawn, stack)
        drawn = []
        words = keyword
        if keyword == "push":
            stack.append(stack[-1])
        elif keyword == "pop":
            stack.pop()
        else:
            counts[keyword] += 1
            transform = f"{keyword[0].upper()}{counts[keyword]}"
            transforms.append((transform, command))
            stack[-1] += (transform,)
            words = f"{transform} = {keyword} {' '.join(command.arguments[0])}"
        lines += row(command.line, words, " | ".join(map(product_name, reversed(stack))))
    return lines + triangle_lines(drawn, stack) + matrices(transforms)


def triangle_lines(drawn, stack):
    """The row of triangles between two other commands."""
    if not drawn:
        return []
    (line, first), (_, last) = drawn[0], drawn[-1]
    words = f"triangle {first}" if first == last else f"triangles {first} to {last}"
    return row(line, words, f"a point p becomes {product_name(stack[-1])} p")


def product_name(factors):
    if len(factors) > MAX_FACTORS:
        half = MAX_FACTORS // 2
        return f"{' '.join(factors[:half])} ... {' '.join(factors[-half:])} ({len(factors)} factors)"
    return " ".join(factors) or "I"


def row(line, words, stack):
    """The lines of a row; words too long for their column have a line of their own."""
    left = f"{line:4}  {words}"
    rest = textwrap.wrap(stack, WIDTH - LEFT, break_on_hyphens=False)
    above = []
    if len(left) >= LEFT:
        above, left = textwrap.wrap(left, WIDTH, subsequent_indent=" " * 8), ""
    return above + [f"{(left if i == 0 else ''):{LEFT}}{part}" for i, part in enumerate(rest)]


def matrices(transforms):
    lines = ["", "I is the identity; the last factor is applied to a point first."]
    for name, command in transforms:
        lines += ["", *matrix_lines(name, command.matrix(double))]
    return lines
