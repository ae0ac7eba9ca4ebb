"""The cases of the view stage."""
import itertools
import math

from parts.conformance_pack import Case

AXES = {
    "x": (1, 0, 0), "y": (0, 1, 0), "z": (0, 0, 1), "minus-x": (-1, 0, 0), "minus-y": (0, -1, 0),
    "minus-z": (0, 0, -1)}
POINTS = "1.0000000 2.0000000 3.0000000\n-2.0000000 0.5000000 4.0000000\n5.0000000 -1.0000000 -3.0000000\n\n"
PERSPECTIVE = "perspective 60 1 1 100\n"


def words(numbers):
    return " ".join(map(repr, numbers))


def text(eye, look, up, points=POINTS, rest=PERSPECTIVE):
    return f"eye {words(eye)}\nlook {words(look)}\nup {words(up)}\n{rest}{points}"


def case(name, why, eye, look, up, points=POINTS, paragraphs="V2", rest=PERSPECTIVE, **others):
    return Case("view", name, why, paragraphs, text(eye, look, up, points, rest), **others)


def plus(a, b):
    return tuple(x + y for x, y in zip(a, b))


def straight_ahead():
    why = "A camera that looks down -z with y up only moves: the eye is subtracted."
    for name, eye in {
        "at-the-origin": (0, 0, 0),
        "in-front": (0, 0, 12),
        "aside": (3, 0, 0),
        "above": (0, -4, 0),
        "anywhere": (1, 2, 3),
        "of-fractions": (0.5, -0.25, 7.125),
        "far-away": (1000, -2000, 3000),
    }.items():
        yield case(f"straight-{name}", why, eye, plus(eye, (0, 0, -5)), (0, 1, 0))
    yield case(
        "straight-four-triangles", why, (0, 0, 9), (0, 0, 0), (0, 2, 0), "".join(
            f"{i}.0000000 0.5000000 -1.0000000\n0.0000000 {i}.2500000 2.0000000\n-1.0000000 0.0000000 "
            f"-{i}.1250000\n\n"
            for i in range(4)))


def along_the_axes():
    for (name, along), (up_name, up) in itertools.product(AXES.items(), AXES.items()):
        if sum(map(abs, plus(along, up))) == 2 and not any(a and b for a, b in zip(along, up)):
            yield case(f"looks-along-{name}-up-{up_name}",
                       "Along the axes the rows of the rotation are the axes with their signs.", (1, 2, 3),
                       plus((1, 2, 3), [4 * x for x in along]), up)


def directions():
    direction = (2, -1, -2)
    for name, factor in {"near": 0.001, "one-step": 1, "far": 1000}.items():
        yield case(f"point-looked-at-{name}",
                   "Only the direction of the point looked at counts, not how far it is.", (1, 1, 1),
                   plus((1, 1, 1), [factor * x for x in direction]), (0, 1, 0))
    for signs in itertools.product((1, -1), repeat=3):
        eye = tuple(s * x for s, x in zip(signs, (3, 4, 5)))
        name = "".join("+" if s > 0 else "-" for s in signs).replace("+", "p").replace("-", "m")
        yield case(f"octant-{name}-to-the-origin", "From each octant to the origin: signs of all rows.", eye,
                   (0, 0, 0), (0, 1, 0))
        yield case(f"octant-{name}-past-the-origin",
                   "The point looked at is a point, not a direction: eye and look both count.", eye,
                   (1, -2, 0.5), (0, 1, 0))
    yield case("looks-down-steeply", "Nearly straight down, with y still up.", (0, 10, 0), (0.1, 0, -0.2),
               (0, 1, 0))
    yield case("looks-up-steeply", "Nearly straight up.", (1, -10, 0), (1.5, 0, 0.25), (0, 1, 0))
    yield case("looks-backwards", "Looking along +z, left and right change sides.", (0, 0, -6), (0, 0, 0),
               (0, 1, 0))


def up_directions():
    for name, up in {"tenth": (0, 0.1, 0), "ten": (0, 10, 0), "thousand": (0, 1000, 0),
                     "3-4": (3, 4, 0)}.items():
        yield case(f"up-of-length-{name}",
                   "up may have any length: r is made a unit vector, and u comes from it.", (0, 3, 8),
                   (1, 0, 0), up)
    for name, up in {
            "forwards": (0, 1, -1), "backwards": (0, 1, 1), "aside": (0.5, 1, 0), "far-forwards": (0, 1, -5),
            "all": (1, 2, 3)}.items():
        yield case(f"up-leans-{name}", "up need not be perpendicular to the direction of the look; u is.",
                   (1, 2, 7), (0, -1, 0), up)
    for degrees in (15, 30, 60, 90, 180, 315):
        up = (round(math.sin(math.radians(degrees)), 6) + 0.0,
              round(math.cos(math.radians(degrees)), 6) + 0.0, 0.0)
        yield case(f"rolled-by-{degrees}", "A camera that rolls turns the picture the other way.", (0, 1, 6),
                   (0, 1, 0), up)
        yield case(f"rolled-by-{degrees}-tilted", "Rolled and tilted at a time.", (4, 3, 6), (1, 0, -1), up)


def points():
    eye, look, up = (2, 3, 9), (0, 1, 0), (0, 1, 0)
    yield case("point-at-the-eye", "The eye goes to the origin.", eye, look, up, "2 3 9\n0 1 0\n1 2 4.5\n\n")
    yield case("points-behind-the-eye", "What is behind the eye has z above 0, and stays.", eye, look, up,
               "4 5 18\n2 3 10\n0 0 20\n\n")
    yield case("triangle-of-no-area", "A triangle may be a point.", eye, look, up, "1 1 1\n1 1 1\n1 1 1\n\n")
    yield case("no-triangle", "A text without triangles stays one.", eye, look, up, "")
    yield case("far-points", "Points far away keep their digits.", eye, look, up,
               "100000 -200000 300000\n-99999.5 0.001 5000\n1 1 1\n\n")
    yield case("ten-triangles", "Triangles keep their order.", eye, look, up,
               "".join(f"{i} 0 0\n0 {i} 0\n0 0 {-i}\n\n" for i in range(10)))


def lines():
    usual = text((1, 2, 3), (0, 0, 0), (0, 1, 0))
    for name, why, paragraphs, changed in (
        ("carriage-returns", "Lines may end in CR LF.", "S1b", usual.replace("\n", "\r\n")),
        ("comments",
         "Comments and the lines that hold nothing else do not count, nor do they part a triangle.",
         "S1b S1c T8", "# c\n" + usual.replace("\n", " # c\n")),
        ("no-blank-lines", "No blank line need stand between triangles.", "T8",
         text((1, 2, 3), (0, 0, 0), (0, 1, 0),
              (POINTS * 2).replace("\n\n", "\n"))), ("several-blank-lines", "More than one may.", "S1c T8",
                                                     text((1, 2, 3), (0, 0, 0), (0, 1, 0),
                                                          "\n\n" + POINTS + "\n \n" + POINTS + "\n")),
        ("tabs-and-exponents", "Other programs print numbers otherwise.", "S2 S3",
         text((1, 2, 3), (0, 0, 0), (0, 1, 0),
              "1e0\t2\t+3.\n-2E0 .5\t4\n5 -1 -3\n")), ("no-line-feed-at-the-end",
                                                       "The last line may lack its line feed.", "S1",
                                                       usual.rstrip("\n")),
        ("header-in-another-order", "The order of header lines is free; that of the written ones is not.",
         "T1 T17",
         PERSPECTIVE + "up 0 1 0\nlook 0 0 0\n\nbackground 1 2 3\neye 1 2 3\nframed\n" + POINTS + "end\n")):
        yield Case("view", f"lines-{name}", why, paragraphs, changed,
                   needs="syntax frames colors" if "header" in name else "syntax")


def digits():
    yield case("zero-has-no-sign", "Zero, and what is rounded to it, has no sign.", (1, 2, 3), (1, 2, 0),
               (0, 1, 0), "1 2 3\n0.99999999 2 3.00000004\n1 1.99999999 3\n\n", "T19 V2", tier="bytes")
    yield case("ties", "A tie is rounded to the even digit.", (0, 0, 0), (0, 0, -1), (0, 1, 0),
        "0.00390625 0.01171875 -0.01953125\n1 0 0\n0 1 0\n\n", "T19", tier="bytes")
    yield case("header-of-view", "view removes eye, look and up, and passes the projection on.", (1, 2, 3),
               (0, 0, 0), (0, 1, 0), POINTS, "T2 T3", "perspective 60 1.5 0.1 1e5\n")
    yield case("one-blank-between-words",
               "Words are separated by one blank, triangles followed by a blank line.", (0, 0, 5), (0, 0, 0),
               (0, 1, 0), "1 2  3\n4 5 6\n7 8 9\n", "T18", tier="bytes")
    for number in ("0", "3", "15", "exact"):
        yield case(f"digits-{number}", "--digits tells how many decimals are written.", (3, 4, 5), (0, 1, 0),
                   (0, 1, 0), POINTS, "T19 T20", options=f"--digits {number}", tier="bytes")
    yield case("bare", "--bare writes vertices and blank lines alone.", (3, 4, 5), (0, 1, 0), (0, 1, 0),
               POINTS, "T17", options="--bare", tier="bytes")
    why = "Exact arithmetic does not lose the digits that doubles lose."
    yield case("eye-far-from-the-origin", why, (100000000, 200000000, -300000000),
               (100000001, 200000002, -300000003), (0, 1, 0),
               "100000001.0000000 200000002.5000000 -300000003.0000000\n100000000.1250000 200000000.0000000 "
               "-300000001.0000000\n100000002.0000000 200000001.0000000 -300000000.5000000\n\n", "N1 V2",
               needs="exactness")
    yield case("up-nearly-parallel", why, (0, 0, 0), (1, 1, 1), (1, 1, 1.0000000001), POINTS, "N1 V2",
               needs="exactness")
    yield case("point-looked-at-very-near", why, (0, 0, 0), (1e-200, 2e-200, -2e-200), (0, 1e200, 0), POINTS,
               "N1 V2", needs="exactness")
    yield case("point-looked-at-very-far", why, (0, 0, 0), (1e200, 2e200, -2e200), (0, 1e-200, 0), POINTS,
               "N1 V2", needs="exactness")


def extensions():
    eye, look, up = (3, 4, 5), (0, 1, 0), (0, 1, 0)
    usual = text(eye, look, up)
    for name, option in {
            "eye": "--eye 5 5 5", "look": "--look 1 1 1", "up": "--up 1 1 0",
            "all": "--eye 0 0 9 --look 0 0 0 --up 1 0 0", "perspective": "--perspective 45 1 0.5 50",
            "ortho": "--ortho -1 1 -2 2 0 9"}.items():
        yield Case("view", f"option-{name}", "Options go before the header, part by part.", "V1", usual,
                   options=option)
    yield Case("view", "option-in-place-of-a-header",
               "Text without a header takes its camera from the options.", "V1 T16", POINTS,
               options="--eye 1 2 3 --look 0 0 0 --up 0 1 0")
    for name, line in {"ratio": "perspective 60 1.5 1 100 ratio", "frustum": "frustum -1 2 -0.5 0.75 1 100",
        "ortho": "ortho -1 2 -0.5 0.75 -1 100"}.items():
        yield case(f"projection-{name}", "Each projection is passed on.", eye, look, up, POINTS, "T3",
                   line + "\n", needs="projections")
    yield case("numbers-of-triangles",
               "The number of a triangle is passed on where counting alone would be wrong.", eye, look, up,
               "triangle 2\n" + POINTS + "triangle 3\n" + POINTS + "triangle 7\n" + POINTS, "T10",
               needs="numbering")
    ball = "sphere\n1 2 3\n2 2 3\n1 3.5 3\n1 2 0\n\n"
    yield case("sphere", "The four points of a sphere move as all points do.", eye, look, up,
               ball + POINTS + "triangle 7\n" + ball, "T26 T27 V2", needs="spheres numbering")
    yield case("sphere-with-columns", "A sphere has all columns but the normal.", eye, look, up,
        "sphere\n" + "".join(f"{p} 9 8 7\n" for p in ("0 0 0", "1 0 0", "0 1 0", "0 0 1")) + "\n", "T26",
        "attributes color normal\n", needs="spheres colors")
    yield Case("view", "framed", "framed and end are passed on.", "T13a", "framed\n" + usual + "end\n",
               needs="frames")
    colored = "0 0 0 255 0 0\n1 0 0 0 128.5 0\n0 1 0 0 0 0.25\n"
    normals = "0 0 0 0 0 1\n1 0 0 0 1 0\n0 1 0 0.6 0 0.8\n"
    for name, why, points, rest in (
        ("colors", "Colors are passed on.", colored, "attributes color\n"),
        ("normals", "Normals turn with the camera, and do not move.", normals, "attributes normal\n"),
        ("normals-of-any-length", "Normals become unit vectors, and a normal of 0 stays one.",
         normals.replace("0 1 0\n", "0 7 0\n").replace("0.6 0 0.8", "0 0 0"), "attributes normal\n"),
        ("background", "The background is passed on.", POINTS, "background 1 2.5 3\n")):
        yield case(name, why, eye, look, up, points, "V2 T6 T9", PERSPECTIVE + rest, needs="colors")
    yield case("background-with-alpha", "Its alpha, too.", eye, look, up, POINTS, "T6a",
               PERSPECTIVE + "background 1 2.5 3 0.25\n", needs="alpha")
    yield case("colors-of-17-digits", "Colors have as many decimals as coordinates.", eye, look, up, colored,
               "T9 T19", PERSPECTIVE + "attributes color\n", needs="colors", options="--digits 17")
    for name, why, rest in (
        ("light", "A light moves as points do.", "light 1 2 3 1 0.5 0\n"),
        ("lights", "Lights keep their order; ambient, material and attenuation stay as they are.",
         "light 5 0 0 1 1 1\nlight 0 5 0 2 2 2\nambient 0.1 0.2 0.3\nmaterial 1 0.5 0.25 16\nattenuation 1 "
         "0.5 0.25\n")):
        yield case(name, why, eye, look, up, POINTS, "V2 T6 T17", PERSPECTIVE + rest, needs="lights")
    yield case("glass", "What a material does to rays is passed on.", eye, look, up, POINTS, "T6 T17",
        PERSPECTIVE + "material 1 0.5 0.25 16 0.125 1.5 0.25\n"
        "absorption 0.5 0 2\npaint 9.5 0 255\n", needs="optics")


GRIDS = (straight_ahead, along_the_axes, directions, up_directions, points, lines, digits, extensions)
