"""The cases of zbuf: coverage and depth."""
import itertools
import math
import random

from parts.conformance_pack import Case

WINDOW = "-1\n-1\n-1 1\n"
TIE = "which of two pixels is the nearest when the end of a row lies halfway between them"


def config(width=8, height=8, limits=WINDOW):
    return f"{width} {height}\n{limits}"


def number(x):
    return f"{x:.7f}".rstrip("0").rstrip(".") if x else "0"


def triangle(*corners):
    return "".join(" ".join(map(number, corner)) + "\n" for corner in corners) + "\n"


def flat(points, z=0.0):
    """A triangle at one depth, of points (x, y)."""
    return triangle(*((x, y, z) for x, y in points))


def pixels(points, size=8, z=0.0):
    """The same, of points in pixels of a picture of size x size in the window from -1 to 1: 0, 0 is its top
    left corner."""
    return flat([(2 * x / size - 1, 1 - 2 * y / size) for x, y in points], z)


def case(name, why, paragraphs, text, config=config(), **others):
    return Case("zbuf", name, why, paragraphs, text, config, **others)


def assignment():
    limits = "-1.00\n-1.00\n0.00 2.00\n"
    one, two = ("0.50 0.00 0.50\n-0.50 0.00 0.50\n0.00 0.50 0.50\n",
                "1.5 0 0.5\n-0.5 0 0.5\n0 1.5 0.5\n0.5 0 0.25\n-1.0 0 0.25\n0 0.5 0.25\n")
    for size in (15, 35):
        yield case(f"assignment-one-triangle-{size}",
                   "The first example of the assignment, in a smaller picture.", "Z2 Z8", one,
                   config(size, size, limits))
        yield case(f"assignment-two-triangles-{size}",
                   "The second example of the assignment, in a smaller picture.", "Z2 Z8", two,
                   config(size, size, limits))


def subpixel_positions():
    why = "Where a triangle begins between two pixels decides which it has."
    for i, j in itertools.product(range(4), repeat=2):
        x, y = 1.06 + i / 4, 1.09 + j / 4
        yield case(f"subpixel-{i}-{j}", why, "Z1 Z2 Z2a Z3 Z5",
                   pixels([(x, y), (x + 4.3, y + 0.7), (x + 1.2, y + 3.9)]))
        yield case(f"subpixel-narrow-{i}-{j}", why, "Z1 Z2 Z2a Z3 Z5",
                   pixels([(x, y), (x + 1.13, y + 0.21), (x + 3.77, y + 4.87)]))


def shapes():
    grid = {
        "up": [(1.2, 6.3), (6.7, 6.3), (3.9, 1.1)],
        "down": [(1.2, 1.3), (6.7, 1.3), (3.9, 6.8)],
        "left": [(6.4, 1.2), (6.4, 6.7), (1.1, 3.9)],
        "right": [(1.4, 1.2), (1.4, 6.7), (6.9, 3.9)],
        "slanted": [(0.8, 2.2), (6.7, 0.9), (4.1, 7.2)],
    }
    for (name, corners), order in itertools.product(grid.items(), itertools.permutations(range(3))):
        yield case(f"shape-{name}-{''.join(str(i + 1) for i in order)}",
                   "Neither winding nor the order of the corners changes the pixels.", "Z2 Z5",
                   pixels([corners[i] for i in order]))


def sizes_and_windows():
    corners = [(-0.83, -0.77), (0.87, -0.31), (-0.13, 0.91)]
    for width, height in ((1, 1), (1, 8), (8, 1), (2, 3), (3, 2), (5, 7), (7, 5), (16, 4), (4, 16), (13, 11),
                          (40, 30), (30, 40)):
        yield case(f"size-{width}-x-{height}",
                   "WIDTH counts columns, HEIGHT rows, and pixels need not be square.", "C1 Z1",
                   flat(corners), config(width, height))
    for name, (left, bottom) in {
            "2-x-2": (-2, -2), "half": (-0.5, -0.5), "wide": (-2, -0.5), "high": (-0.5, -2),
            "of-fractions": (-0.7, -1.3), "large": (-100, -300), "small": (-0.01, -0.02)}.items():
        yield case(f"window-{name}", "The window is as large as the config says, in each direction.", "C2 Z1",
            flat([(x * -left, y * -bottom) for x, y in corners]), config(9, 7, f"{left}\n{bottom}\n-1 1\n"))
        yield case(f"window-{name}-and-a-fixed-triangle", "What a window shows depends on its limits.",
                   "C2 Z1", flat(corners), config(9, 7, f"{left}\n{bottom}\n-1 1\n"))


def window_borders():
    why = "What lies outside the window is clipped, and nothing else."
    inside = [(0.21, 0.13), (-0.27, 0.39), (0.11, -0.47)]
    for name, far in {"left": (-2.7, 0.11), "right": (2.7, 0.11), "top": (0.11, 2.7), "bottom": (0.11, -2.7),
                      "top-left": (-2.3, 1.9), "top-right": (2.3, 1.9), "bottom-left": (-2.3, -1.9),
                      "bottom-right": (2.3, -1.9)}.items():
        yield case(f"across-{name}", why, "Z3", flat([*inside[:2], far]))
        yield case(f"far-across-{name}", why, "Z3", flat([inside[0],
            *((1000 * x + a, 1000 * y + b) for (x, y), (a, b) in ((far, (0, 300)), (far, (0.7, -300))))]))
        away = [(x + 2 * far[0] - 0.1, y + 2 * far[1] + 0.1) for x, y in inside]
        yield case(f"outside-{name}", "A triangle beside the window shows nothing, and the rest stays.", "Z3",
                   flat(away) + flat(inside, 0.5))
    yield case("covers-the-window", "A triangle may cover every pixel.", "Z3",
               flat([(-5, -5), (5, -5), (0, 9)]))
    whole = [(-1e200, -1e200), (1e200, -1e200), (0, 1e200)]
    yield case(
        "covers-the-window-from-the-ends-of-doubles",
        "A triangle may cover every pixel, and stands before others.", "Z3 Z8",
        "".join(f"{x} {y} 0.5\n" for x, y in whole) + "\n" +
        "".join(flat([(x - 0.3 * i, y + 0.2 * i)
                      for x, y in inside], 0.6 - 0.2 * i)
                for i in range(7)), needs="exactness")
    for exponent in ("e170", "e-170"):
        yield case(
            f"window-of-1{exponent}", "A window may be as large, or as small, as doubles go.", "C2 Z1 Z4",
            "".join(f"{x}{exponent} {y}{exponent} {z}\n" for x, y, z in ((-0.83, -0.77, 0.1),
                                                                         (0.87, -0.31, 0.5), (-0.13, 0.91,
                                                                                              -0.9))),
            config(9, 7, f"-1{exponent}\n-1{exponent}\n-1 1\n"), needs="exactness")
    yield case(
        "slopes-of-a-millionth-of-a-pixel",
        "Of triangles so narrow that their depth changes by whole units within a millionth of a pixel, with "
        "the depths at the centers.",
        "Z4 Z6",
        "0.1249999 -0.9 -0.8\n0.1250002 -0.3 0.9\n0.1250001 0.9 -0.3\n\n-0.3750002 -0.95 0.7\n-0.3750001 "
        "0.85 -0.6\n-0.3749997 0.15 0.1\n\n",
        needs="exactness")
    yield case("slopes-far-across",
               "Of a triangle a million times as large as the window, with the depths that it has there.",
               "Z4 Z6", "-1e6 -1e6 -8e5\n1e6 -1e6 2e5\n0 1e6 3e5\n\n", needs="exactness")
    yield case("covers-the-window-far-away", "A triangle may cover every pixel.", "Z3",
               flat([(-40000, -30000), (50000, -30000), (700, 90000)]))
    yield case("around-a-corner", "A triangle may pass by a corner of the window without a pixel.", "Z3",
               flat([(0.9, 3), (3, 3), (3, 0.9)]))
    yield case("no-triangle", "Without triangles the picture is black, and the text has empty lines.",
               "Z8 T23", "")


def shared_edges():
    why = ("Two triangles that share an edge: each keeps its side, and under `center` no pixel has both "
           "or none.")
    ends = {
        "vertical": ((4.2, 0.3), (4.2, 7.8)),
        "horizontal": ((0.3, 4.2), (7.8, 4.2)),
        "diagonal": ((0.6, 0.8), (7.3, 7.1)),
        "other-diagonal": ((7.3, 0.8), (0.6, 7.1)),
        "steep": ((3.3, 0.4), (5.2, 7.7)),
        "flat": ((0.4, 3.3), (7.7, 5.2)),
        "steep-back": ((5.2, 0.4), (3.3, 7.7)),
        "flat-back": ((0.4, 5.2), (7.7, 3.3)),
    }
    for (name, (p, q)), order in itertools.product(ends.items(), (1, -1)):
        middle, across = ((p[0] + q[0]) / 2, (p[1] + q[1]) / 2), (0.41 * (q[1] - p[1]), 0.43 * (p[0] - q[0]))
        sides = [pixels([p, q, (middle[0] + s * across[0], middle[1] + s * across[1])], z=0.25 * s)
                 for s in (1, -1)]
        yield case(f"shared-edge-{name}-{'near-first' if order < 0 else 'far-first'}", why, "Z2 Z5 Z8",
                   "".join(sides[::order]))
    for count, name in ((4, "four"), (5, "five"), (8, "eight")):
        rim = [(4.1 + 3.7 * x, 4.2 + 3.6 * y)
               for x, y in ((1, 0), (0.7, 0.71), (0.02, 1), (-0.69, 0.73), (-1, 0.03), (-0.72, -0.7),
                            (0.01, -1), (0.71, -0.68))]
        rim = rim[::8 // count] if count != 5 else rim[:5]
        yield case(f"fan-of-{name}", "Triangles around one vertex share it and an edge each.", "Z5 Z8",
                   "".join(pixels([(4.1, 4.2), rim[i], rim[(i + 1) % len(rim)]], z=0.1 * i - 0.4)
                           for i in range(len(rim))))
    yield case("strip", "A strip of triangles, each at a depth of its own.", "Z5 Z8",
               "".join(pixels([(0.7 + 1.1 * i, (1.2, 6.3)[i % 2]), (1.8 + 1.1 * i, (6.3, 1.2)[i % 2]),
                               (2.9 + 1.1 * i, (1.2, 6.3)[i % 2])], z=0.3 - 0.1 * i) for i in range(5)))


def edges_in_fours():
    """Programs that draw four triangles, or four rows, at a time: one of each four has a horizontal edge on a
    row of centers."""
    for name, edge, tip in (("top", 1.5, 3.2), ("bottom", 3.5, 0.8)):
        cells = [(4 * j, 4 * i, edge if i == j else edge - 0.6, edge if i == j else edge - 0.3)
                 for i in range(4) for j in range(4)]
        yield case(f"edges-on-rows-in-fours-{name}",
                   "A horizontal edge on a row of centers is one wherever its triangle stands among others.",
                   "Z2 Z5", "".join(pixels([(x + 0.6, y + left), (x + 3.3, y + right), (x + 1.2, y + tip)],
                                           16, 0.1) for x, y, left, right in cells), config(16, 16))


def corners_on_centers():
    """In pixels of a picture of 8 x 8, whose centers are at halves: all numbers are exact in doubles."""
    why = ("Centers that lie exactly on edges: under `center` left and top edges have them, under `nearest` "
           "both ends of a row.")
    grids = {
        "right-angle-bottom-left": [(1.5, 1.5), (1.5, 5.5), (5.5, 5.5)],
        "right-angle-bottom-right": [(5.5, 1.5), (1.5, 5.5), (5.5, 5.5)],
        "right-angle-top-left": [(1.5, 1.5), (5.5, 1.5), (1.5, 5.5)],
        "right-angle-top-right": [(1.5, 1.5), (5.5, 1.5), (5.5, 5.5)],
        "roof": [(0.5, 4.5), (4.5, 0.5), (8.5, 4.5)],
        "bowl": [(0.5, 2.5), (8.5, 2.5), (4.5, 6.5)],
        "arrow-left": [(0.5, 4.5), (4.5, 0.5), (4.5, 8.5)],
        "arrow-right": [(6.5, 4.5), (2.5, 0.5), (2.5, 8.5)],
        "half-as-steep": [(0.5, 0.5), (0.5, 4.5), (8.5, 4.5)],
        "twice-as-steep": [(0.5, 0.5), (4.5, 0.5), (0.5, 8.5)],
        "one-pixel": [(2.5, 2.5), (3.5, 2.5), (2.5, 3.5)],
        "two-pixels": [(2.5, 2.5), (4.5, 2.5), (2.5, 4.5)],
        "to-the-border": [(0, 0), (8, 0), (0, 8)],
        "whole-window": [(-0.5, -0.5), (15.5, -0.5), (-0.5, 15.5)],
    }
    for name, corners in grids.items():
        for turn, step in (("", 1), ("-turned", -1)):
            yield case(f"on-centers-{name}{turn}", why, "Z2 Z3 Z5 Z5a", pixels(corners[::step]))
    yield case(
        "on-centers-square-of-two",
        "A square of two triangles whose corners are centers: under `center` each pixel has one owner.",
        "Z5 Z5a",
        pixels([(1.5, 1.5), (5.5, 1.5), (1.5, 5.5)], z=0.25) + pixels([(5.5, 1.5), (5.5, 5.5),
                                                                       (1.5, 5.5)], z=0.5))
    yield case(
        "on-centers-four-squares", "Four squares that meet at a center.", "Z5", "".join(
            pixels([(x, y), (x + 2, y), (x, y + 2)], z=z) +
            pixels([(x + 2, y), (x + 2, y + 2), (x, y + 2)], z=z + 0.125)
            for x, y, z in ((2.5, 2.5, 0), (4.5, 2.5, 0.25), (2.5, 4.5, 0.5), (4.5, 4.5, 0.75))))
    for name, corners in {"vertical-ends": [(2, 1), (6, 1), (6, 7)], "wide": [(1, 2), (7, 2), (7, 6)],
        "narrow": [(2, 0.5), (2, 7.5), (5, 0.5)]}.items():
        yield case(f"ends-between-centers-{name}",
                   "An end halfway between two centers belongs to the right one, which is half a pixel up.",
                   "Z3", pixels(corners), open_nearest=TIE)


def slivers():
    yield case("as-large-as-doubles", "Where differences overflow, halves are subtracted.", "Z2 Z2b Z4",
               "-1.7e308 -1.7e308 0\n1.7e308 1.7e308 0\n-1.7e308 1.7e308 0.5\n", needs="exactness")
    for name, corners in {
        "row": [(0.7, 3.2), (7.4, 3.6), (0.9, 3.7)],
        "between-rows": [(0.7, 3.6), (7.4, 3.9), (0.9, 4.3)],
        "column": [(3.2, 0.7), (3.6, 7.4), (3.7, 0.9)],
        "between-columns": [(3.6, 0.7), (3.9, 7.4), (4.3, 0.9)],
        "diagonal": [(0.7, 0.8), (7.4, 7.3), (7.2, 7.5)],
        "other-diagonal": [(7.3, 0.8), (0.7, 7.3), (0.6, 7.1)],
        "steep": [(2.3, 0.3), (3.1, 7.7), (3.2, 7.7)],
        "flat": [(0.3, 2.2), (7.7, 3.1), (7.7, 3.4)],
        "smaller-than-a-pixel": [(3.1, 3.2), (3.9, 3.4), (3.6, 3.8)],
        "between-four-centers": [(3.6, 3.6), (4.3, 3.7), (4.1, 4.4)],
        "point-at-a-center": [(0.6, 2.9), (0.7, 3.1), (7.3, 3.4)],
    }.items():
        yield case(f"sliver-{name}",
                   "A triangle thinner than a pixel has the pixels of the rule, and no more.", "Z2 Z3 Z5",
                   pixels(corners))
    yield case("sliver-fan", "Thin triangles side by side, each at a depth of its own.", "Z5 Z8",
               "".join(pixels([(0.3, 0.4), (7.7, 0.6 + 1.3 * i), (7.7, 1.9 + 1.3 * i)], z=0.4 - 0.1 * i)
                       for i in range(5)))


def depths():
    corners = [(-0.83, -0.77), (0.87, -0.31), (-0.13, 0.91)]
    why = "The depth of a pixel is that of the triangle's plane at its center."
    for name, zs in {
            "right": (-0.5, 0.7, 0), "left": (0.6, -0.6, 0.1), "up": (-0.5, -0.4, 0.8),
            "down": (0.5, 0.6, -0.9), "first": (-0.8, 0.3, 0.3), "second": (0.2, -0.9, 0.2), "third":
                (0.1, 0.1, 0.9), "both-ways": (0.1, -0.6, 0.8), "gently": (0.5, 0.501, 0.502), "below-0":
                    (-0.9, -0.3, -0.6)}.items():
        yield case(f"depth-slopes-{name}", why, "Z4 Z7",
                   triangle(*((x, y, z) for (x, y), z in zip(corners, zs))))
    for name, limits, zs in (("large", "-1\n-1\n0 5000\n",
                              (100, 2500, 4000)), ("negative", "-1\n-1\n-900 -100\n", (-850, -200, -300)),
                             ("tiny", "-1\n-1\n0 0.01\n", (0.001, 0.005, 0.009))):
        yield case(f"depth-of-{name}-numbers", why, "Z4 Z7",
                   triangle(*((x, y, z) for (x, y), z in zip(corners, zs))), config(8, 8, limits))
    yield case("depth-in-a-wide-window", why, "Z1 Z4 Z7",
               triangle((-2.7, -0.3, 0), (2.5, -0.2, 0.9), (0.4, 0.45, -0.7)),
               config(14, 6, "-3\n-0.5\n-1 1\n"))
    yield case("depth-of-a-clipped-triangle", "What is clipped at the window keeps the depths of its plane.",
               "Z4 Z7", triangle((-3.1, -0.7, -0.9), (2.9, -1.3, 0.8), (0.3, 4.7, 0.2)))
    yield case(
        "depth-of-two-clipped-triangles", "What is clipped at the window keeps the depths of its plane.",
        "Z4 Z7 Z8",
        triangle((-3.1, -0.7, -0.9), (2.9, -1.3, 0.8), (0.3, 4.7, 0.2)) + triangle(
            (-2.1, 0.7, 0.6), (2.3, 1.3, -0.7), (0.1, -3.7, 0.1)))


def hidden_surfaces():
    back, front = [(-0.91, -0.83), (0.81, -0.37), (-0.21, 0.87)], [(-0.57, 0.61), (0.93, 0.29), (0.17, -0.89)]
    for name, (first, second) in {
            "back-to-front": ((back, 0.5), (front, 0.25)),
            "front-to-back": ((front, 0.25), (back, 0.5))}.items():
        yield case(f"two-{name}", "The nearer of two triangles is seen, in whatever order they come.", "Z8",
                   flat(*first) + flat(*second))
        yield case(f"two-{name}-below-0", "Nearer is smaller, also below 0.", "Z8",
                   flat(first[0], first[1] - 0.9) + flat(second[0], second[1] - 0.9))
    layers = {
        "near": (back, -0.5),
        "middle": (front, 0.0),
        "far": ([(-0.93, 0.41), (0.89, 0.71), (0.31, -0.93)], 0.5),
    }
    for chosen in itertools.permutations(layers):
        yield case("three-" + "-".join(chosen),
                   "The nearest of three triangles is seen, in whatever order they come.", "Z8", "".join(
                       flat(*layers[name]) for name in chosen))
    slopes = [
        triangle(*((x, y, z)
                   for (x, y), z in zip(points, zs)))
        for points, zs in ((back, (-0.7, 0.6, -0.1)), (front, (0.8, -0.6, 0.2)))]
    for name, chosen in (("one-way", slopes), ("the-other-way", slopes[::-1])):
        yield case(f"crossing-{name}", "Triangles that cross are each seen where they are nearer.", "Z8",
                   "".join(chosen))
    small = [(-0.33, -0.41), (0.29, -0.23), (0.07, 0.37)]
    for name, text in {"small-before-large": flat(back, 0.5) + flat(small, 0.1),
                       "large-before-small": flat(small, 0.5) + flat(back, 0.1),
                       "small-hidden-at-last": flat(back, 0.1) + flat(small, 0.5)}.items():
        yield case(f"hidden-{name}", "A triangle may hide another whole, or a part of it.", "Z8", text)
    yield case("seven-side-by-side", "Each triangle has a color of its own.", "Z8",
               "".join(pixels([(1.1 * i + 0.2, 0.3), (1.1 * i + 1.2, 3.4), (1.1 * i + 0.1, 7.6)],
                              z=0.1 * i - 0.3) for i in range(7)))
    yield case("five-in-a-pile", "Each triangle is seen where it is not hidden.", "Z8",
               "".join(pixels([(0.7 + i / 2, 0.3 + 0.6 * i), (6.3 + 0.3 * i, 1.2 + 0.7 * i),
                               (1.7, 6.1 + 0.3 * i)], z=0.4 - 0.2 * i) for i in range(5)))
    near_miss = {"by-a-thousandth": 0.001, "by-a-hundred-thousandth": 0.00001}
    for name, gap in near_miss.items():
        for which, zs in (("first", (0.5, 0.5 + gap)), ("last", (0.5 + gap, 0.5))):
            yield case(f"nearer-{name}-{which}", "However little nearer, the nearer is seen.", "Z8 Z9",
                       flat(back, zs[0]) + flat(front, zs[1]))
    rng, spread = random.Random(5), [triangle((-1.9, -1.3, -0.51), (1.9, -1.3, 0.13), (0.1, 3.1, 0.32))]
    for _ in range(16):
        x, y, z = rng.uniform(-1, 0.6), rng.uniform(-1, 0.5), rng.uniform(-0.6, 0.5)
        spread.append(triangle((x, y, z), (x + rng.uniform(0.1, 1.4), y + rng.uniform(-0.2, 0.2),
                                           z + rng.uniform(-0.2, 0.2)), (x + 0.3, y + 0.5, z)))
    for name, chosen in {"from-near-to-far": spread, "from-far-to-near": spread[::-1]}.items():
        yield case(f"wide-{name}", "In long rows, too, parts of triangles are hidden.", "Z8", "".join(chosen),
                   config(100, 12))


def front_and_rear_limits():
    large, small = [(-0.91, -0.83), (0.81, -0.37), (-0.21, 0.87)], [(-0.57, 0.61), (0.93, 0.29),
                                                                    (0.17, -0.89)]
    why = "Points before the front limit or beyond the rear one are not drawn."
    for name, (limit, zs) in {
            "before-the-front": ("0 2", (-0.25, )), "beyond-the-rear": ("0 2", (2.5, )),
            "just-inside-the-front": ("0 2", (0.001, )), "just-before-the-front":
                ("0 2", (-0.001, )), "just-inside-the-rear": ("0 2", (1.999, )), "just-beyond-the-rear":
                    ("0 2", (2.001, )), "narrow-limits": ("0.25 0.75", (0.2, 0.8)), "between-narrow-limits":
                        ("0.25 0.75", (0.5, 0.8)), "all-far-away": ("10 20", (15, 5)), "all-below-0":
                            ("-20 -10", (-15, -5)), "front-hides-nothing": ("0 1", (-0.5, 0.5)),
            "front-hides-nothing-drawn-last": ("0 1", (0.5, -0.5)), "rear-hides-nothing":
                ("0 1", (1.5, 0.5)), "one-of-each": ("0 1", (-0.5, 1.5))}.items():
        yield case(f"limits-{name}", why, "Z8 C2",
                   "".join(flat(points, z) for points, z in zip((large, small), zs)),
                   config(8, 8, f"-1\n-1\n{limit}\n"))
    for name, limit, z in (("front", "0.25 1", 0.25), ("rear", "-1 0.25", 0.25), ("front-of-0", "0 1", 0),
                           ("rear-of-0", "-1 0", 0)):
        yield case(f"limits-exactly-at-the-{name}",
                   "A point at the front limit is drawn, one at the rear limit is not.", "Z8", flat(large, z),
                   config(8, 8, f"-1\n-1\n{limit}\n"))
    for name, zs in {
            "the-front": (-1.37, 0.81, 0.22), "the-rear": (0.21, 2.13, 0.12), "both": (-1.43, 2.37, 0.11),
            "the-front-upwards": (0.37, 0.83, -1.31), "the-rear-upwards": (0.13, 0.22, 2.41)}.items():
        yield case(f"limits-across-{name}", "Of a triangle across a limit the part inside is drawn.", "Z8",
            triangle(*((x, y, z) for (x, y), z in zip(large, zs))), config(8, 8, "-1\n-1\n0.0123 1.0321\n"))
        yield case(f"limits-across-{name}-with-another-behind", "The part that is not drawn hides nothing.",
                   "Z8",
                   triangle(*((x, y, z) for (x, y), z in zip(large, zs))) + flat(small, 0.9),
                   config(8, 8, "-1\n-1\n0.0123 1.0321\n"))


def meshes():
    for size, step in ((9, 3), (12, 2)):
        points = {(i, j): (0.37 + i * step + 0.31 * ((i * 7 + j * 3) % 3),
            0.29 + j * step + 0.27 * ((i * 5 + j * 2) % 3)) for i in range(4) for j in range(4)}
        text = "".join(
            pixels([points[a]
                    for a in corners], size, z=0.03 * (i + 3 * j) + 0.01 * half - 0.2)
            for j in range(3) for i in range(3)
            for half, corners in enumerate((((i, j), (i + 1, j), (i, j + 1)), ((i + 1, j), (i + 1, j + 1),
                                                                               (i, j + 1)))))
        yield case(f"mesh-of-18-in-{size}-pixels",
                   "A mesh has no holes, and under `center` no pixel is taken twice.", "Z5 Z8", text,
                   config(size, size))


def tilings():
    """Grids, a fan and a strip of slivers, with a depth for each triangle; no two triangles overlap."""
    why = ("Where triangles do not overlap, each pixel has one owner under `center`; under `nearest` "
           "neighbors share pixels.")
    rng = random.Random(2026)
    grids = {
        "with-corners-on-centers": (16, lambda i, j: (i * 4 - 0.5, j * 4 - 0.5)),
        "with-corners-between-centers": (16, lambda i, j: (i * 4, j * 4)),
        "with-corners-anywhere": (
            24, lambda i, j: (i * 4 + rng.uniform(-1.3, 1.3), j * 4 + rng.uniform(-1.3, 1.3))),
        "that-leans": (24, lambda i, j: (i * 4 + 0.37 * j - 0.61, j * 4 - 0.23 * i + 0.83)),
    }
    for name, (size, corner) in grids.items():
        count = size // 4
        at = {(i, j): corner(i, j) for i in range(count + 1) for j in range(count + 1)}
        triangles = []
        for i, j in itertools.product(range(count), repeat=2):
            a, b, c, d = at[i, j], at[i + 1, j], at[i + 1, j + 1], at[i, j + 1]
            triangles += [(a, b, d), (b, c, d)] if (i + j) % 2 else [(a, b, c), (a, c, d)]
        yield tiling(name, why, triangles, size, open_nearest=TIE if "between" in name else "")
    rim = [(12.5 + 14 * math.cos(i * math.pi / 16 + 0.05), 12.5 + 14 * math.sin(i * math.pi / 16 + 0.05))
           for i in range(32)]
    yield tiling("around-a-center", why, [((12.5, 12.5), rim[i - 1], rim[i]) for i in range(32)], 24)
    left, right = ([(x, y + 0.23 * i) for i in range(41)] for x, y in ((0.31, 0.43), (23.63, 11.71)))
    yield tiling("of-slivers", why, [
        corners for i in range(40)
        for corners in ((left[i], right[i], right[i + 1]), (left[i], right[i + 1], left[i + 1]))], 24)


def tiling(name, why, triangles, size, **others):
    text = "".join(pixels(corners, size, z=0.8 - 1.6 * (7 * i % len(triangles)) / len(triangles))
                   for i, corners in enumerate(triangles))
    return case(f"tiling-{name}", why, "Z5 Z8", text, config(size, size), **others)


GRIDS = (assignment, subpixel_positions, shapes, sizes_and_windows, window_borders, shared_edges,
         edges_in_fours, corners_on_centers, slivers, depths, hidden_surfaces, front_and_rear_limits, meshes,
         tilings)
