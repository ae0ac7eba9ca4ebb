"""The cases of the project stage."""
import itertools

from parts.conformance_pack import Case

POINTS = "0.3 0.5 -2\n-0.75 0.25 -4\n0.5 -1.5 -9\n\n"
PERSPECTIVE = "60 1 1 10"


def case(name, why, paragraphs, perspective=PERSPECTIVE, points=POINTS, header="", **others):
    return Case("project", name, why, paragraphs, f"perspective {perspective}\n{header}{points}", **others)


def word(number):
    return str(number).replace("-", "minus-").replace(".", "-")


def fields_of_view():
    for fov, aspect in itertools.product((20, 45, 60, 90, 120), (0.5, 0.75, 1, 1.25)):
        yield case(f"fov-{fov}-aspect-{word(aspect)}",
                   "fovX is FOVY times ASPECT; x and y have their own scale.", "P2 P3 P4",
                   f"{fov} {aspect} 1 10")
    for fov, aspect in ((1, 1), (0.1, 2), (170, 1), (179, 0.5), (10, 17), (33.333, 1.7777)):
        yield case(f"fov-{word(fov)}-aspect-{word(aspect)}",
                   "Narrow and wide views near the limits of what is allowed.", "P2 P3",
                   f"{fov} {aspect} 1 10")


def near_and_far():
    for near, far in ((1, 10), (0.1, 1000), (1, 2), (0.5, 100000), (3, 3.5), (0.01, 1), (2, 20), (5, 7),
                      (0.001, 50), (1, 1.0625)):
        points = f"0.1 0.2 -{near}\n0.3 -0.1 -{far}\n-0.25 0.5 -{(near + far) / 2}\n\n"
        yield case(f"near-{word(near)}-far-{word(far)}",
                   "The near plane goes to -1, the far plane to 1; between them z is not linear.", "P3 P4",
                   f"60 1 {near} {far}", points)
    for number, d in enumerate((1, 1.001, 1.5, 2, 3, 5, 9, 9.99, 10), 1):
        yield case(f"depth-{number}-of-9",
                   "Nearer is smaller z, from -1 at the near plane to 1 at the far plane.", "P4", PERSPECTIVE,
                   f"0 0 -{d}\n1 0 -{d}\n0 1 -{d}\n\n")


def view_volume():
    # A view of 90 by 90 degrees: its sides are x = d and y = d.
    view = "90 1 1 4"
    for sides in itertools.product((-1, 1), repeat=2):
        name = ("left" if sides[0] < 0 else "right") + "-" + ("bottom" if sides[1] < 0 else "top")
        for plane, d in (("near", 1), ("far", 4)):
            yield case(
                f"corner-{name}-{plane}", "A corner of the view volume goes to a corner of the cube.", "P4",
                view,
                f"{sides[0] * d} {sides[1] * d} {-d}\n{sides[0] * 0.5} 0.25 -2\n0 {sides[1] * 0.75} -3\n\n")
    outside = {
        "left": ("-3 0 -2", "-5 1 -3", "-4 0 -3.5"),
        "right": ("3 0 -2", "5 1 -3", "4 0 -3.5"),
        "bottom": ("0 -3 -2", "1 -5 -3", "0 -4 -3.5"),
        "top": ("0 3 -2", "1 5 -3", "0 4 -3.5"),
        "near": ("0.1 0 -0.5", "0 0.2 -0.75", "0.1 0.1 -0.9"),
        "far": ("1 0 -5", "0 2 -6", "1 1 -9"),
    }
    inside = ("0.5 0.25 -2", "-0.5 1 -3", "1 -1 -3.5")
    for plane, points in outside.items():
        yield case(f"outside-{plane}",
                   "A triangle in front of the eye passes uncut, even outside the volume.", "P7", view,
                   "\n".join(points) + "\n\n")
        yield case(f"one-vertex-outside-{plane}",
                   "A triangle in front of the eye passes uncut, even across a plane.", "P7", view, "\n".join(
                       (points[0], *inside[1:])) + "\n\n")
        yield case(f"two-vertices-outside-{plane}",
                   "A triangle in front of the eye passes uncut, even across a plane.", "P7", view, "\n".join(
                       (*points[:2], inside[2])) + "\n\n")
    yield case("vertex-on-every-plane", "Points on the planes of the volume have -1 or 1 there.", "P4", view,
        "-2 0 -2\n2 0 -2\n0 -3 -3\n\n0 3 -3\n0 0 -1\n0 0 -4\n\n")
    yield case("just-in-front-of-the-eye", "Distances of at least near / 1024 are not cut.", "P7", view,
        "0.0009765625 0 -0.0009765625\n1 0 -2\n0 1 -3\n\n")
    yield case("between-eye-and-near", "What is nearer than the near plane has z below -1.", "P4 P7", view,
        "0.25 0 -0.5\n0 0.25 -0.25\n-0.125 0 -0.125\n\n")


def texts():
    yield case("no-triangle", "A text without triangles stays one.", "T8", points="")
    yield case("ten-triangles", "Triangles keep their order.", "P10 T8",
        points="".join(f"{i} 0 -{i + 1}\n0 {i} -{i + 2}\n1 1 -{i + 3}\n\n" for i in range(10)))
    yield case("triangle-of-no-area", "A triangle may be a point.", "P3", points="1 1 -5\n1 1 -5\n1 1 -5\n\n")
    yield case("same-direction", "Points on one line through the eye have one x and y, but not one z.", "P4",
        points="0.5 0.25 -2\n1 0.5 -4\n1.5 0.75 -6\n\n")
    for name, numbers in {"many-digits": "0.123456789012345 1.5 -2.718281828459045",
                          "exponents": "1e-3 25E-2 -3.5e0", "plain": "1 2 -3"}.items():
        yield case(f"numbers-{name}", "Numbers may have any digits.", "S3",
                   points=f"{numbers}\n1 0 -2\n0 1 -3\n\n")
    usual = f"perspective {PERSPECTIVE}\n{POINTS}"
    for name, why, paragraphs, changed in (
        ("carriage-returns", "Lines may end in CR LF.", "S1b", usual.replace(
            "\n",
            "\r\n")), ("comments", "Comments do not count, and lines of nothing else do not part a triangle.",
                       "S1b S1c T8", "# c\n" + usual.replace("\n", " # c\n", 3)),
        ("no-blank-lines", "No blank line need stand between triangles.", "T8",
         usual + POINTS.strip() + "\n" + POINTS.strip() + "\n"), ("several-blank-lines", "More than one may.",
                                                                  "S1c T8", usual + "\n\n" + POINTS + "\n"),
        ("tabs-and-plus-signs", "Other programs print numbers otherwise.", "S2 S3", usual.replace(
            " ", "\t").replace("0.5",
                               "+.5")), ("no-line-feed-at-the-end", "The last line may lack its line feed.",
                                         "S1", usual.rstrip("\n"))):
        yield Case("project", f"lines-{name}", why, paragraphs, changed, needs="syntax")


def clipping():
    view = "90 1 1 9"
    inside, behind = ("0.5 0.25 -2", "-1 1 -3", "1 -2 -5"), ("0.5 0 2", "-1 0.5 3", "0.25 -1 1")
    for order in range(3):
        for count, name in ((1, "one-vertex"), (2, "two-vertices")):
            for winding, step in (("", 1), ("-clockwise", -1)):
                corners = [behind[i] if i < count else inside[i] for i in range(3)]
                corners = (corners[order:] + corners[:order])[::step]
                yield case(
                    f"{name}-behind-{order + 1}{winding}",
                    "A triangle that reaches behind the eye is cut at the near plane, before the divide.",
                    "P7 P8 P9 P10", view, "\n".join(corners) + "\n\n", needs="clipping numbering")
    near = {
        "in-the-plane-of-the-eye": ("1 0 0", *inside[1:]),
        "at-the-eye": ("0 0 0", *inside[1:]),
        "on-the-near-plane": (behind[0], "0.5 0.5 -1", inside[2]),
        "two-on-the-near-plane": ("0.5 0.5 -1", "-0.5 0.5 -1", behind[0]),
        "edge-on-the-near-plane": ("0.5 0.5 -1", "-0.5 0.5 -1", "0 0 -0.0005"),
        "all-behind": behind,
        "all-before-the-near-plane": ("0 0 -0.0001", "1 0 -0.5", "0 1 -0.5"),
        "just-too-near": ("0.0009765624 0 -0.0009765624", *inside[1:]),
        "all-on-the-near-plane-but-one": ("0 0 0", "1 0 -1", "0 1 -1"),
    }
    for name, corners in near.items():
        yield case(f"cut-{name}",
                   "The corners of the rule: vertices on the near plane, in the plane of the eye, and just "
                   "too near.", "P6 P7 P8", view, "\n".join(corners) + "\n\n", needs="clipping numbering")
    three = "\n".join(inside) + "\n\n" + "\n".join(behind) + "\n\n" + "\n".join(
        (behind[0], *inside[1:])) + "\n\n" + "\n".join(inside) + "\n\n"
    yield case("numbers-behind-dropped-and-cut-triangles",
               "A triangle keeps its number when others are dropped or cut.", "T10 T10a", view, three,
               needs="clipping numbering")
    yield case("numbers-from-the-input", "Numbers of the input go on.", "T10", view,
               "triangle 5\n" + three + "triangle 20\n" + three, needs="clipping numbering")


def clip_options():
    view = "90 1 1 4"
    outside = {
        "left": "-9 0 -3", "right": "9 0 -3", "bottom": "0 -9 -3", "top": "0 9 -3", "near": "0.1 0.1 -0.25",
        "far": "0.5 0.5 -9"}
    inside = ("0.5 0.25 -2", "-0.5 1 -3", "1 -1 -3.5")
    for plane, point in outside.items():
        shifted = " ".join(str(float(a) * 1.5) for a in point.split()) if plane != "near" else "0.05 0.1 -0.5"
        for mode in ("frustum", "near", "reject"):
            why = {
                "frustum": "--clip frustum cuts at each of the six planes.",
                "near": "--clip near cuts at the near plane, and nowhere else.",
                "reject": "--clip reject drops what is outside one plane, and cuts nothing."}[mode]
            for name, corners in (("one", (point, *inside[1:])), ("two", (point, shifted, inside[2]))):
                if mode == "frustum" or plane in ("left", "near"):
                    yield case(f"clip-{mode}-{plane}-{name}-outside", why, "P6 P7 P8", view,
                               "\n".join(corners) + "\n\n", options=f"--clip {mode}", needs="numbering")
        others = [point, shifted, point.replace("0.1 0.1", "0.02 0.03").replace("-3", "-3.5")]
        yield case(f"clip-reject-{plane}-all-outside", "--clip reject drops what is outside one plane.", "P7",
                   view, "\n".join(others) + "\n\n" + "\n".join(inside) + "\n\n", options="--clip reject",
                   needs="numbering")
    for name, corners in {
        "corner": ("0.5 0.25 -2", "9 1 -3", "1 9 -3"),
        "around-the-volume": ("-20 -20 -2", "20 -20 -2", "0 40 -2"),
        "through-all-planes": ("-9 -1 -0.5", "9 -1 -9", "0 9 -4"),
        "past-an-edge": ("9 0 -2", "0 9 -2", "9 9 -2"),
        "all-on-a-plane": ("2 0 -2", "3 1 -3", "3 -1 -3"),
        "edge-on-a-plane": ("2 0 -2", "3 1 -3", "9 0 -3"),
    }.items():
        for mode in ("frustum", "reject"):
            yield case(f"clip-{mode}-{name}", "Several planes at a time, in their order.", "P7 P8 P10", view,
                       "\n".join(corners) + "\n\n", options=f"--clip {mode}", needs="numbering")
    yield case("clip-none", "--clip none cuts and drops nothing.", "P7", view,
               "-9 0 -3\n0.1 0.1 -0.0001\n1 1 -2\n\n", options="--clip none")
    for inset in ("0.25", "0.5"):
        for mode in ("near", "frustum"):
            yield case(f"clip-inset-{word(inset)}-{mode}",
                       "--clip-inset pulls the planes in, so that cuts can be seen.", "P6", view, "\n".join(
                           (outside["right"], *inside[1:])) + "\n\n",
                       options=f"--clip {mode} --clip-inset {inset}", needs="numbering")
    yield case("clip-inset-0-1-exactly", "The planes are pulled in exactly, by the double.", "P6 N1", view,
               "\n".join((outside["near"], *inside[1:])) + "\n\n", needs="exactness numbering",
               options="--clip near --clip-inset 0.1 --digits 17")
    for mode in ("reject", "frustum"):
        yield Case("project", f"{mode}-outside-by-1e-31", "However little, outside is outside.", "P6 P7",
                   "ortho 0 1 0 1 1 9\n-1e-31 0.25 -2\n-2e-31 0.5 -2\n-1e-31 0.75 -2\n\n"
                   "0 0.25 -2\n-2e-31 0.5 -2\n-1e-31 0.75 -2\n\n" + POINTS, options=f"--clip {mode}",
                   needs="clipping numbering projections")
    windings = {
        "counterclockwise": ("0 0 -2", "1 0 -2", "0 1 -2"), "clockwise": ("0 0 -2", "0 1 -2", "1 0 -2"),
        "edge-on": ("0 0 -2", "0 0 -4", "1 0 -3"), "behind-the-eye": ("0 0 2", "1 0 2", "0 1 2"),
        "reaching-behind": ("0 0 2", "1 0 -2", "0 1 -2")}
    for (name, corners), side in itertools.product(windings.items(), ("back", "front")):
        yield case(f"cull-{side}-{name}",
                   "Counterclockwise as seen is the front; what is seen edge-on is kept.", "P5", view,
                   "\n".join(corners) + "\n\n" + POINTS, options=f"--cull {side}", needs="numbering clipping")


def projections():
    for name, line in {
            "like-a-perspective": "frustum -1 1 -1 1 1 9", "left-of-the-middle": "frustum -3 1 -1 1 1 9",
            "above-the-middle": "frustum -1 1 0.5 2 1 9", "beside-the-axis": "frustum 1 3 -4 -2 2 5",
            "mirrored": "frustum 1 -1 -1 1 1 9", "upside-down": "frustum -1 1 1 -1 1 9",
            "of-fractions": "frustum -0.1 0.3 -0.25 0.125 0.5 100"}.items():
        yield Case("project", f"frustum-{name}", "The window of a frustum need not be symmetric.", "P2 P3",
                   f"{line}\n{POINTS}", needs="projections")
    for name, line in {"symmetric": "ortho -2 2 -2 2 1 9", "not-symmetric": "ortho -1 5 0 2 1 9",
                       "mirrored": "ortho 2 -2 -2 2 1 9", "near-behind-the-eye": "ortho -2 2 -2 2 -5 5",
                       "all-negative": "ortho -4 -2 -8 -5 -3 -1"}.items():
        yield Case("project", f"ortho-{name}", "ortho has no divide, and z is linear.", "P2 P3",
                   f"{line}\n{POINTS}", needs="projections")
    yield Case("project", "ortho-points-behind-the-eye", "Under ortho no point is behind the eye.", "P4 P7",
        "ortho -2 2 -2 2 1 9\n0 0 5\n1 0 0\n0 1 -5\n\n", needs="projections")
    for fov, aspect in ((60, 1), (60, 1.5), (90, 0.5), (120, 4)):
        yield case(f"ratio-{fov}-{word(aspect)}",
                   "By the rule `ratio` the window is ASPECT times as wide as high.", "P2 S8",
                   f"{fov} {aspect} 1 10 ratio", needs="projections")
    for name, option in {"perspective": "--perspective 90 1 2 20", "frustum": "--frustum -1 2 -1 1 1 9",
                         "ortho": "--ortho -2 2 -2 2 1 9", "aspect-ratio": "--aspect ratio",
                         "aspect-angle": "--aspect angle"}.items():
        yield case(f"option-{name}", "Options go before the header.", "P1",
                   "60 1.5 1 10 ratio" if name == "aspect-angle" else "60 1.5 1 10", options=option)
    yield Case("project", "option-in-place-of-a-header",
               "Text without a header takes its projection from the options.", "P1 T16", POINTS,
               options="--perspective 60 1 1 10")


def digits():
    yield case("zero-has-no-sign", "Zero, and what is rounded to it, has no sign.", "T19", "90 1 1 3",
        "-0.00000001 0 -1.5\n0 -0.00000004 -2\n0.00000001 0 -1.4999999999\n\n", tier="bytes")
    yield case("ties", "A tie is rounded to the even digit.", "T19", "90 1 1 3",
        "0.00390625 0.01171875 -1\n-0.01953125 0.02734375 -1\n0.03515625 -0.04296875 -1\n\n", tier="bytes")
    for number in ("0", "3", "16", "exact"):
        yield case(f"digits-{number}", "--digits tells how many decimals are written.", "T19 T20",
                   options=f"--digits {number}", tier="bytes")
    why = "Exact arithmetic does not lose the digits that doubles lose."
    yield case("far-beyond-near", why, "N1 P3", "60 1 1 1e20", "0 0 -1e15\n0 1 -1e19\n1 0 -1e10\n\n",
               needs="exactness", options="--digits exact", tier="bytes")
    yield case("far-close-to-near", why, "N1 P3", "60 1 1 1.000000000001",
               "0 0 -1.0000000000005\n0 0 -1.00000000000025\n0 0 -1\n\n", needs="exactness")
    yield case(
        "quotients-near-ties",
        "Quotients that lie nearer to a tie than a double tells are rounded to their side, ties to even.",
        "N1 T19", "90 1 1 10",
        "7588564.0898661 0.5 -6\n0.25 4848382.6366245 -6\n1853949.5798625 -7876179.4804585 -10\n\n"
        "0 4880014.0807515 -10\n3560683.5029823 -1 -6\n-5827894.1837559 7998550.1257625 -6\n\n",
        needs="exactness", tier="bytes")
    yield case("very-narrow", why, "N1 P2", "1e-7 1 1 10", "1e-9 2e-9 -2\n3e-9 1e-9 -3\n0 0 -4\n\n",
               needs="exactness")
    yield case("very-wide", why, "N1 P2", "179.99999 1 1 10", "1e7 2e7 -2\n3e7 1e7 -3\n0 0 -4\n\n",
               needs="exactness")


def extensions():
    colored, normals = ("0 0 -2 255 0 0\n1 0 -3 0 128.5 0\n0 1 -4 0 0 0.25\n\n",
                        "0 0 -2 0 0 1\n1 0 -3 0 1 0\n0 1 -4 0.6 0 0.8\n\n")
    for name, points, header in (("colors", colored, "attributes color\n"), ("normals", normals,
                                                                             "attributes normal\n"),
                                 ("colors-and-background", colored, "attributes color\nbackground 1 2 3\n")):
        yield case(name, "Behind attributes project adds the column w, the distance from the eye.",
                   "T5a T9 P4", "60 1 1 10", points, header, needs="colors")
    yield case("background-with-alpha", "The alpha of the background is passed on.", "T6a", "60 1 1 10",
               "0 0 -2\n1 0 -3\n0 1 -4\n\n", "background 1 2 3 0\n", needs="alpha")
    yield Case("project", "colors-under-ortho", "Under ortho w is 1.", "T5 P3",
               f"ortho -2 2 -2 2 1 9\nattributes color\n{colored}", needs="colors projections")
    cut = colored.replace("0 0 -2", "0 0 2", 1)
    yield case("colors-of-a-cut", "A cut has the weighted mean of the corners' colors, and its own w.",
               "P9 T5", "60 1 1 10", cut, "attributes color\n", needs="colors clipping numbering")
    yield case("normals-of-a-cut",
               "A cut has the weighted mean of the corners' normals, not made a unit vector.", "P9",
               "60 1 1 10", normals.replace("0 0 -2", "0 0 2",
                                            1), "attributes normal\n", needs="colors clipping numbering")
    light = "light 1 2 3 1 0.5 0\n"
    yield case("light", "In a text with lights project writes what it projected by.", "P11 T4", "60 1.5 1 10",
               POINTS, light, needs="lights")
    yield case("light-and-cut", "In a text with lights the whole triangle stands before its pieces.",
               "P11 T11a", "90 1 1 10", "0 0 2\n1 0 -3\n0 1 -4\n\n" + POINTS, light,
               needs="lights clipping numbering")
    yield case(
        "light-and-cuts-in-a-row", "Each cut triangle has its whole one before its own pieces.",
        "P11 T10 T11a", "90 1 1 10", POINTS + "0 0 2\n1 0 -3\n0 1 -4\n\n" + "0 0 2\n-1 0 -3\n0 -1 2\n\n" +
        POINTS + "1 0 -3\n0 1 2\n0 -1 -4\n\n", light, needs="lights clipping numbering")
    yield case("light-and-colored-cut", "The whole triangle has its columns, too.", "P11 T11a", "90 1 1 10",
               cut, "attributes color\n" + light, needs="lights colors clipping numbering")
    materials = "attributes material\nmaterial 1 1 0 1\nmaterial 0.5 0.25 1 16\n"
    yield case("materials", "Each triangle keeps its material.", "T5 T9", "60 1 1 10",
               "0 0 -2 1\n1 0 -3 1\n0 1 -4 1\n\n0 0 -2 0\n1 0 -3 0\n0 1 -4 0\n\n", materials,
               needs="materials")
    yield case("glass", "What a material does to rays is passed on.", "T6 T17", "60 1 1 10",
               "0 0 -2\n1 0 -3\n0 1 -4\n\n", "material 1 0.5 0.25 16 0.125 1.5 0.25\n"
               "absorption 0.5 0 2\npaint 9.5 0 255\n",
               needs="optics")
    yield case("light-and-cut-with-a-material", "The whole triangle and all its pieces have its material.",
               "P9 P11 T11a", "90 1 1 10", "0 0 2 1\n1 0 -3 1\n0 1 -4 1\n\n", materials + light,
               needs="lights materials clipping numbering")
    yield Case("project", "light-under-ortho", "The projection is passed on as what it was.", "P11 T4",
               f"ortho -2 3 -1 2 1 9\n{light}{POINTS}", needs="lights projections")
    yield case("framed", "framed and end are passed on.", "T13a", "60 1 1 10", POINTS + "end\n", "framed\n",
               needs="frames")


GRIDS = (fields_of_view, near_and_far, view_volume, texts, clipping, clip_options, projections, digits,
         extensions)
