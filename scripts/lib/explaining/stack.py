"""The stack of matrices after every command of a scene that changes it, as in the assignment's table: T1, R1
and S1 name transforms, and a product names its factors, from left to right as in the code."""
import collections
import itertools
import textwrap

from lib.explaining.layout import matrix_lines
from lib.maths.matrices import TRANSFORMS
from lib.text.scene import commands

WIDTH = 79
HALF = 4  # the factors written out at each end of a long product
LEFT = 34  # columns before the stack
DRAWN = ("triangle", "sphere")


def stack_lines(text, name):
    """The report on a scene that model has accepted."""
    stack, matrices, counts, drawn_count = [()], [], collections.Counter(), 0
    lines = [name, "", f"{'line  command':{LEFT}}stack, its top first"]
    shown = (command for command in commands(text) if command.keyword in (*DRAWN, "push", "pop", *TRANSFORMS))
    for is_drawn, run in itertools.groupby(shown, lambda command: command.keyword in DRAWN):
        for command in run:
            keyword = words = command.keyword
            if is_drawn:
                first, last = drawn_count, drawn_count + len([*run])  # ends the loop
                drawn_count = last + 1
                words = f"triangle {first}" if first == last else f"triangles {first} to {last}"
            elif keyword == "push":
                stack.append(stack[-1])
            elif keyword == "pop":
                stack.pop()
            else:
                counts[keyword] += 1
                transform = f"{keyword[0].upper()}{counts[keyword]}"
                matrices += ["", *matrix_lines(transform, command.matrix())]
                stack[-1] += (transform,)
                words = f"{transform} = {keyword} {' '.join(command.arguments[0])}"
            products = [product_name(factors) for factors in reversed(stack)]
            lines += row(command.line, words,
                         f"a point p becomes {products[0]} p" if is_drawn else " | ".join(products))
    return [*lines, "", "I is the identity; the last factor is applied to a point first.", *matrices]


def product_name(factors):
    if len(factors) > 2 * HALF:
        return f"{' '.join(factors[:HALF])} ... {' '.join(factors[-HALF:])} ({len(factors)} factors)"
    return " ".join(factors) or "I"


def row(line, words, stack):
    """The lines of a row; words too long for their column have a line of their own."""
    left = f"{line:4}  {words}"
    above = textwrap.wrap(left, WIDTH, subsequent_indent=" " * 8) if len(left) >= LEFT else []
    return above + textwrap.wrap(f"{'' if above else left:{LEFT}}{stack}", WIDTH,
                                 subsequent_indent=" " * LEFT, break_on_hyphens=False)
