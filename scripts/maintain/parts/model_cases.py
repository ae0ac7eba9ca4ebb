"""The cases of the model stage, as grids: each drawn from one reason."""
import itertools

from parts.conformance_pack import Case

CAMERA = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n"
TRIANGLE = "triangle\n1 2 3\n-2 0.5 4\n5 -1 -3\n"
AXES = {
    "x": "1 0 0", "y": "0 1 0", "z": "0 0 1", "minus-x": "-1 0 0", "minus-y": "0 -1 0", "minus-z": "0 0 -1"}


def scene(commands, camera=CAMERA):
    return camera + commands + "end\n"


def case(name, why, paragraphs, commands, **others):
    return Case("model", name, why, paragraphs, scene(commands), **others)


def transformed(name, why, paragraphs, transforms, **others):
    """A triangle after some transforms, written `translate 1 2 3; scale ...`."""
    return case(name, why, paragraphs, commands(transforms) + TRIANGLE, **others)


def commands(words):
    """Commands, separated by semicolons, in the lines of the assignment: arguments on a line of their own. T
    is TRIANGLE."""
    lines = []
    for command in filter(None, map(str.strip, words.split(";"))):
        keyword, *arguments = command.split()
        lines.append(TRIANGLE if keyword == "T" else keyword + "\n" +
                     (" ".join(arguments) + "\n" if arguments else ""))
    return "".join(lines)


def word(number):
    return str(number).replace("-", "minus-").replace(".", "-")


def triangles():
    yield case("no-transform", "Without a transform the points stay as they are.", "M1 M6", TRIANGLE)
    yield case("no-triangle", "A scene of nothing but a camera gives no points.", "M6 M9", "")
    yield case("same-point-three-times", "A triangle may be a point: the model stage does not ask.", "M6",
               "triangle\n1 1 1\n1 1 1\n1 1 1\n")
    yield case("two-triangles", "Triangles keep their order.", "M6 T18 O1",
               TRIANGLE + "triangle\n9 8 7\n6 5 4\n3 2 1\n")
    yield case("twelve-triangles", "Triangles keep their order, however many.", "M6",
               "".join(f"triangle\n{i} {i + 1} {i + 2}\n{-i} 0 {i}\n0 {i} {-i}\n" for i in range(12)))
    yield case("large-and-small-numbers", "Coordinates of very different sizes stand in one triangle.",
               "M6 T19",
               "triangle\n100000 -200000 300000\n0.0000001 -0.0000002 0.5\n12345.678 0.001 -99999.5\n")
    yield case("unused-transform", "A transform behind the last triangle moves nothing.", "M2 M6",
        TRIANGLE + commands("translate 1 2 3; rotate 30 0 0 1"))


def translations_and_scales():
    for name, numbers in {"x": "2.5 0 0", "y": "0 2.5 0", "z": "0 0 2.5", "minus-x": "-3 0 0",
                          "minus-y": "0 -3 0", "minus-z": "0 0 -3", "all": "0.5 -1.25 7", "zero": "0 0 0",
                          "far": "10000 -20000 30000", "by-little": "0.001 0.0001 0.00001"}.items():
        yield transformed(f"translate-{name}", "Each number of translate moves its own coordinate.", "M3",
                          f"translate {numbers}")
    yield transformed("translate-twice", "Two translations add up.", "M2 M3",
                      "translate 1 2 3; translate 10 20 30")
    for name, numbers in {
            "x": "2 1 1", "y": "1 3 1", "z": "1 1 0.5", "all-alike": "2 2 2", "all": "2 -3 0.25",
            "mirror-x": "-1 1 1", "mirror-y": "1 -1 1", "mirror-z": "1 1 -1", "mirror-all": "-1 -1 -1",
            "flat": "1 0 1", "to-a-point": "0 0 0"}.items():
        yield transformed(f"scale-{name}", "Each number of scale multiplies its own coordinate.", "M3",
                          f"scale {numbers}")
    yield transformed("scale-twice", "Two scales multiply.", "M2 M3", "scale 2 3 4; scale 5 0.5 -1")


def rotations():
    for (axis, numbers), angle in itertools.product(AXES.items(), (90, 180, 270, -90)):
        yield transformed(f"right-angle-{word(angle)}-about-{axis}",
            "A right angle turns the axes into one another; its sine and cosine are 0, 1 or -1.",
                          "M4 N3", f"rotate {angle} {numbers}")
    for angle in (0, 360, 450, 1000):
        yield transformed(f"angle-{word(angle)}-about-z",
                          "Angles beyond a full turn, or of none, are angles like others.", "M4 N3",
                          f"rotate {angle} 0 0 1")
    for angle in (30, 45, 60, 120, 17.5, -33.3, 0.001):
        yield transformed(f"angle-{word(angle)}-about-z",
                          "The angle is in degrees and turns counterclockwise.", "M4",
                          f"rotate {angle} 0 0 1")
    for angle in (60, 120, -120):
        yield transformed(f"angle-{word(angle)}-about-the-diagonal",
            "An axis of three equal numbers mixes all coordinates; 120 degrees exchange them.", "M4",
                          f"rotate {angle} 1 1 1")
    for name, axis in {"double-z": "0 0 2", "tenth-of-z": "0 0 0.1", "3-0-4": "3 0 4", "10-10-10": "10 10 10",
                       "minus-5-y": "0 -5 0", "1-2-3": "1 2 3", "minus-1-half-2": "-1 0.5 2",
                       "0-3-4": "0 3 4", "hundredths": "0.01 -0.02 0.02"}.items():
        yield transformed(f"axis-{name}", "The axis has any length, and is made a unit vector first.",
                          "M4 N2", f"rotate 40 {axis}")
    yield transformed("half-turn-about-a-slanted-axis",
                      "Half a turn has no sine: only the part along the axis stays.", "M4",
                      "rotate 180 1 2 2")


def orders_of_transforms():
    kinds = {"translate": "translate 1 -2 3", "rotate": "rotate 35 1 2 -1", "scale": "scale 2 0.5 -3"}
    others = {"translate": "translate -4 5 0.5", "rotate": "rotate -50 0 1 3", "scale": "scale 0.25 4 1.5"}
    why = "The transform written last is applied first."
    for first, second in itertools.product(kinds, kinds):
        yield transformed(f"{first}-then-{second}", why, "M2", f"{kinds[first]}; {others[second]}")
    for order in itertools.permutations(kinds):
        yield transformed("order-" + "-".join(order), why, "M2", "; ".join(kinds[kind] for kind in order))
    yield transformed("turn-about-a-point",
                      "Translate there, turn, translate back: the point of the turn stays.", "M2",
                      "translate 1 2 3; rotate 90 0 0 1; translate -1 -2 -3")
    yield transformed(
        "arm-of-three-joints", "Each joint turns all that follows it.", "M2",
        "rotate 30 0 0 1; translate 2 0 0; rotate 40 0 0 1; translate 2 0 0; rotate 50 0 0 1; translate 1 0 0"
    )
    yield case("triangles-between-transforms",
               "A triangle is moved by the transforms in front of it alone.", "M2 M6",
               commands("T; translate 1 0 0; T; rotate 90 0 0 1; scale 2 2 2; T; rotate 45 1 0 0; T"))


def push_and_pop():
    why = "pop restores the matrix that the last push has saved."
    grids = {
        "push-pop": "translate 1 2 3; push; rotate 30 0 0 1; T; pop; T",
        "push-keeps-the-matrix": "translate 1 2 3; push; T; pop",
        "push-and-no-pop": "translate 1 0 0; push; scale 2 2 2; T",
        "pop-forgets": "translate 1 0 0; push; scale 2 2 2; pop; push; T; translate 0 5 0; pop; T",
        "nested-twice": "translate 1 0 0; push; rotate 30 1 0 0; push; scale 2 3 4; T; pop; T; pop; T",
        "push-push-pop-pop": "translate 1 0 0; push; push; scale 2 3 4; T; pop; translate 0 1 0; T; pop; T",
        "push-push-pop": "scale 2 1 1; push; push; translate 0 0 9; pop; T",
        "push-push-transform-pop-transform-pop":
            "scale 2 1 1; push; push; rotate 30 0 1 0; T; pop; translate 0 0 9; T; pop; T",
        "pushes-in-a-row-twice": (
            "translate 1 0 0; push; push; scale 2 2 2; pop; pop; push; push; rotate 45 1 0 0; T; pop; scale "
            "1 1 3; T; pop; T"),
        "three-pushes-in-a-row": (
            "rotate 20 0 1 0; push; push; push; translate 5 0 0; T; pop; scale 3 3 3; T; pop; translate 0 7 "
            "0; T; pop; T"),
        "siblings": (
            "translate 1 1 1; push; translate 2 0 0; T; pop; push; translate 0 2 0; T; pop; push; translate "
            "0 0 2; T; pop"),
        "siblings-of-siblings": (
            "push; translate 2 0 0; push; scale 2 2 2; T; pop; push; rotate 90 0 0 1; T; pop; pop; push; "
            "translate 0 3 0; T; pop"),
        "transform-after-pop": "translate 1 0 0; push; rotate 90 0 0 1; pop; scale 2 2 2; T",
        "pop-at-the-end": "push; translate 1 2 3; T; pop",
        "push-at-the-end": "translate 1 2 3; T; push",
        "push-of-nothing": "push; T; pop; T",
        "first-command-push": "push; translate 4 5 6; T; pop; T",
        "pop-to-the-first-matrix": "push; scale 3 3 3; push; rotate 10 1 1 0; pop; pop; T",
        "empty-push-pop": "scale 2 2 2; push; pop; T",
        "push-between-triangles": "rotate 60 0 1 0; T; push; T; translate 1 0 0; T; pop; T",
        "push-before-each-transform":
            "push; translate 1 2 3; push; rotate 40 0 1 0; push; scale 1 2 1; T; pop; T; pop; T; pop; T",
        "pops-in-a-row": (
            "translate 1 0 0; push; translate 0 1 0; push; translate 0 0 1; push; scale 5 5 5; pop; "
            "pop; pop; T"),
    }
    for name, words in grids.items():
        yield case(f"stack-{name}", why, "M5 S13", commands(words))
    deep = "; ".join(f"push; translate {i % 3} 0 1; rotate {5 * i} 0 0 1" for i in range(1, 17))
    yield case("stack-16-deep", "Sixteen levels, each with a triangle on the way out.", "M5",
        commands(deep + "; " + "; ".join(["T; pop"] * 16) + "; T"))
    yield case(
        "stack-shoulder-and-fingers", "A hand: five fingers from one palm.", "M5 M2",
        commands("translate 0 4 0; rotate 25 0 0 1; T; " +
                 "; ".join(f"push; rotate {20 * i - 40} 0 1 0; translate 0 0 {i + 1}; T; pop"
                           for i in range(5)) + "; T"))
    # The table of the assignment: the matrix after each of eleven lines.
    lines = ["push", "translate 1 2 -3", "push", "rotate 30 0 1 1", "pop", "scale 2 3 0.5", "push",
             "rotate -70 1 0 0", "pop", "scale 0.25 1 4", "pop"]
    for count in range(1, len(lines) + 1):
        yield case(f"table-of-the-assignment-line-{count:02}",
                   f"The state of the stack after line {count} of the table in the assignment.", "M5",
                   commands("; ".join(lines[:count]) + "; T"))


def numbers_and_lines():
    for name, numbers in {"exponents": "1e0 25E-1 1.5e+1", "plus-signs": "+1 +2.5 -0.5",
                          "points-at-the-ends": ".5 5. -.25", "leading-zeros": "007 -00.5 0000",
                          "many-digits": "0.1234567890123456789 3.14159265358979323846 -2.718281828459045",
                          "minus-zero": "-0 -0.0 0e5"}.items():
        yield case(f"numbers-{name}", "Numbers may be written in all the ways in which programs write them.",
                   "S3", f"triangle\n{numbers}\n1 0 0\n0 1 0\n")
    yield case("numbers-too-small", "A number too small for a double is 0.", "S3",
               "triangle\n1e-400 1 2\n1 0 1e-9999\n0 1 0\n", needs="syntax")
    text, moved = scene("push\n" + TRIANGLE + "pop\n"), scene("translate\n1 2 3\n" + TRIANGLE)
    for name, why, paragraphs, changed in (
        ("carriage-returns", "Scenes come from other systems: lines end in CR LF.", "S1b",
         moved.replace("\n", "\r\n")), ("tabs", "Tabs separate words, too.", "S2", moved.replace(" ", "\t")),
        ("several-blanks", "Words may be separated by more than one blank, and lines begin with some.", "S2",
         moved.replace(" ", "   ").replace(
             "\n", "\n  ").rstrip(" ")), ("blanks-at-the-end",
                                          "Blanks and tabs at the end of a line do not count.", "S1b",
                                          moved.replace("\n", " \t\n")),
        ("blank-lines", "Blank lines do not count, not even between a command and its arguments.", "S1c S10",
         moved.replace("\n", "\n\n")), ("comments",
                                        "A comment ends with its line, and a line of nothing else is blank.",
                                        "S1b S1c", "# a scene\n" + moved.replace("\n", " # c\n# 9 9 9\n")),
        ("byte-order-mark", "A byte order mark in front is not a word.", "S1",
         "\xef\xbb\xbf" + moved), ("no-line-feed-at-the-end", "The last line may lack its line feed.", "S1",
                                   text.rstrip("\n")),
        ("blank-lines-behind-end", "Blank lines and comments may follow end.", "S14",
         text + "\n \n# c\n"), ("arguments-on-the-keywords-line",
                                "Arguments may stand on the line of their keyword.", "S10",
                                scene("translate 1 2 3\nscale 2 2 2\nrotate 90 0 0 1\n" + TRIANGLE)),
        ("first-vertex-on-the-keywords-line",
         "The first vertex may stand on the line of its keyword.", "S10 S11",
         scene("triangle 1 2 3\n4 5 6\n7 8 9\n")), ("blank-lines-in-a-triangle",
                                                    "In a scene a blank line may stand between vertices.",
                                                    "S10 S11",
                                                    scene("triangle\n\n1 2 3\n\n# c\n4 5 6\n7 8 9\n"))):
        yield Case("model", f"lines-{name}", why, paragraphs, changed, needs="syntax")


def digits():
    why = "Numbers are rounded to 7 decimals, a tie to the even digit."
    for name, numbers in {
            "down": "0.00390625 0.01953125 0.03515625", "up": "0.01171875 0.02734375 0.04296875",
            "negative": "-0.00390625 -0.01171875 -1.00390625", "carry": "0.99999996 9.99999996 -0.99999999",
            "just-beside": "0.00390626 0.00390624 0.01171874"}.items():
        yield case(f"ties-{name}", why, "T19 T21", f"triangle\n{numbers}\n1 0 0\n0 1 0\n", tier="bytes")
    yield case("zero-has-no-sign", "Zero, and what is rounded to it, has no sign.", "T19",
        "triangle\n-0 -0.00000001 0\n-0.00000004 0.00000004 -1e-30\n1 -0.00000006 0\n", tier="bytes")
    for axis in ("x", "y", "z"):
        yield transformed(f"zero-of-a-right-angle-about-{axis}",
                          "A right angle makes zeros, which have no sign.", "N3 T19",
                          f"rotate -90 {AXES[axis]}; scale 0 -1 1", tier="bytes")
    yield case("whole-numbers", "Whole numbers, too, have 7 decimals.", "T18 T19",
               "triangle\n1 -2 300\n0 0 0\n10 20 30\n", tier="bytes")
    for number in ("0", "1", "3", "12", "17", "exact"):
        yield transformed(f"digits-{number}", "--digits tells how many decimals are written.", "T19 T20",
                          "rotate 30 1 2 3", options=f"--digits {number}", tier="bytes")
    yield case("digits-exact-lengths",
               "The shortest form: a plain number or an exponent, whichever is shorter.", "T20",
               "triangle\n100000 1e5 123456\n1e-5 0.001 0.0001\n1e22 1e21 123e20\n", options="--digits exact",
               tier="bytes")
    yield transformed("bare", "--bare writes vertices and blank lines alone.", "T17 O2", "translate 1 2 3",
                      options="--bare", tier="bytes")
    yield Case(
        "model", "camera-in-the-shortest-form",
        "The camera is passed on with all its digits, in the shortest form.", "T2 T3 T17 T20",
        scene(
            TRIANGLE,
            "0.1 1e-7 100000\n0.30000000000000004 -2.50 1e30\n+0 1.0 -0\n060.0 1.3333333333333333 0.001 1e3\n"
        ), tier="bytes")
    for name, line in {
            "ratio": "60 1.5 1 100 ratio", "angle": "60 1.5 1 100 angle",
            "frustum": "frustum -1 2 -0.5 0.75 1 100", "ortho": "ortho -1 2 -0.5 0.75 -1 100"}.items():
        yield Case("model", f"projection-{name}", "The projection of the scene goes into the header.",
                   "S7 S8 T3", scene(TRIANGLE, f"0 0 5\n0 0 0\n0 1 0\n{line}\n"), needs="projections")


def exactness():
    why = "Numbers that cancel leave the digits that stood behind them."
    for name, words in {
            "1e12": "translate 1e12 0 0; translate -1e12 0 0",
            "1e20": "translate 1e20 0 0; translate -1e20 0 0",
            "after-turns": "translate 1e15 0 0; rotate 120 1 1 1; rotate 240 1 1 1; translate -1e15 0 0",
            "of-scales": "scale 1e200 1 1; scale 1e200 1 1; scale 1e-200 1 1; scale 1e-200 1 1"}.items():
        yield transformed(f"cancelling-{name}", why, "N1", words, needs="exactness")
    yield case("large-coordinates", "A number of twenty digits has 7 decimals as well.", "T19",
        "triangle\n12345678901234567890 1e22 -1e25\n0 0 0\n1 1 1\n", tier="bytes", needs="exactness")
    yield transformed("many-small-turns", "Thirty-six turns by ten degrees are no turn.", "N1 M2",
                      "; ".join(["rotate 10 1 2 3"] * 36), needs="exactness")


def extensions():
    colored, normals = ("triangle\n0 0 0 255 0 0\n1 0 0 0 128.5 0\n0 1 0 0 0 0.25\n",
                        "triangle\n0 0 0 0 0 1\n1 0 0 0 0 2\n0 1 0 1 1 1\n")
    for name, why, paragraphs, words in (
        ("color", "color holds for the triangles that follow.", "S17 T5", "color\n255 128 0\n" + TRIANGLE +
         "color 1 2 3\n" + TRIANGLE), ("color-not-saved", "push and pop do not save the color.", "S17",
                                       "color 9 8 7\npush\ncolor 1 2 3\npop\n" + TRIANGLE),
        ("attributes-color", "Vertex lines carry colors, which no transform moves.", "S16 T5 M6",
         "attributes color\nscale 2 3 4\n" + colored),
        ("color-before-attributes-color", "Colors of vertex lines go before color.", "S17",
         "color 1 2 3\nattributes color\n" + colored), ("attributes-normal", "Normals become unit vectors.",
                                                        "S16 M7", "attributes normal\n" + normals),
        ("attributes-both", "Colors stand before normals.", "S16 T5",
         "attributes color normal\ntriangle\n0 0 0 1 2 3 0 0 1\n1 0 0 4 5 6 0 1 0\n0 1 0 7 8 9 1 0 0\n"),
        ("normals-turned", "A rotation turns normals as it turns points.", "M7",
         "attributes normal\nrotate 90 1 0 0\n" +
         normals), ("normals-not-translated", "A translation leaves normals alone.", "M7",
                    "attributes normal\ntranslate 5 6 7\n" + normals),
        ("normals-scaled", "Under a scale of unequal factors normals stay perpendicular to their surface.",
         "M7", "attributes normal\nscale 1 1 4\n" +
         normals), ("normals-mirrored", "Under a mirror normals stay on their side of the surface.", "M7",
                    "attributes normal\nscale -1 1 1\n" +
                    normals), ("normals-turned-and-scaled", "Cofactors, not the matrix, move normals.",
                               "M7 M2", "attributes normal\nrotate 30 0 1 1\nscale 3 1 0.5\n" + normals),
        ("normals-flattened", "What is scaled flat has the normals of its plane, or none.", "M7 T22",
         "attributes normal\nscale 1 1 0\n" +
         normals.replace("1 1 1", "1 1 0")), ("background", "The background goes into the header.", "S18 T6",
                                              "background\n10 20.5 255\n" + TRIANGLE)):
        yield case(name, why, paragraphs, words, needs="colors")
    for name, why, words in (
        ("background-with-alpha", "A background may have an alpha.", "background 10 20.5 255 63.5\n"),
        ("background-invisible", "Down to 0.", "background\n0 0 0 0\n"),
        ("background-opaque", "An alpha of 255 is as good as none, and is not written.",
         "background 1 2 3 255\n")):
        yield case(name, why, "S18 T6a", words + TRIANGLE, needs="alpha")
    for name, why, paragraphs, words in (
        ("light", "A light goes into the header, at its place in the world.", "S21 M8",
         "light 1 2 3 1 0.5 0\n" + TRIANGLE),
        ("light-moved", "The matrix in force moves a light.", "M8",
         "translate 1 2 3\nrotate 90 0 0 1\nlight 1 0 0 1 1 1\n" + TRIANGLE),
        ("light-not-moved-later", "Transforms behind a light leave it alone.", "M8",
         "light 1 0 0 1 1 1\ntranslate 5 5 5\n" + TRIANGLE),
        ("light-in-a-push", "A light stands where its push has put it.", "M8 M5",
         "push\ntranslate 0 3 0\nlight 1 0 0 1 1 1\npop\nlight 0 0 1 0.25 0 0\n" + TRIANGLE),
        ("lights-in-their-order", "Lights keep their order and stand behind the rest of the header.", "T17",
         "light 1 0 0 1 1 1\nlight 2 0 0 1 1 1\nattenuation 1 0.5 0.25\nmaterial 1 0.5 0.25 16\nambient 0.1 "
         "0.2 0.3\nbackground 1 2 3\ncolor 4 5 6\n" + TRIANGLE),
        ("shininess-of-a-whole-number", "A shininess may be written 16.0 and is written 16.", "S19 T20",
         "material 1 1 1 16.0\n" + TRIANGLE)):
        yield case(name, why, paragraphs, words, needs="lights",
                   tier="bytes" if "T20" in paragraphs else "digits")
    materials = "material 1 1 0 1\nmaterial 0.5 0.25 1 16\n"
    for name, why, paragraphs, words in (
        ("materials", "Several materials keep their order, and triangles name them by number.",
         "S19a S23 T5 T5a T17", materials + TRIANGLE + "use 1\n" + TRIANGLE + "use\n0\n" + TRIANGLE),
        ("material-not-saved", "push and pop do not save the material.", "S23",
         materials + "push\nuse 1\npop\n" + TRIANGLE),
        ("material-behind-colors-and-normals", "The material is the last column.", "T5 S23",
         "attributes normal\ncolor 1 2 3\n" + materials + "use 1\n" + normals),
        ("one-material-used", "With one material there is no column.", "S23 T5a",
         "material 1 1 0 1\nuse 0\n" + TRIANGLE)):
        yield case(name, why, paragraphs, words, needs="materials")
    for name, why, paragraphs, words in (
        ("sphere", "A sphere is its center and three points of it, moved by M.", "S24 M10 T26",
         "rotate 30 1 2 3\nscale 1 2 -0.5\nsphere\n0.1 0.2 -0.3 1.25\n"),
        ("sphere-among-triangles", "A sphere is numbered as triangles are, so no line says so.", "S24 T26",
         TRIANGLE + "sphere 0 0 0 1\n" + TRIANGLE),
        ("sphere-with-columns", "Its lines have the color and the material in force, and no normal.",
         "S24 T26",
         "attributes normal\ncolor 1 2 3\nmaterial 1 1 0 1\nmaterial 1 1 1 9\nuse 1\nsphere 0 0 0 1\n"
         "color 4 5 6\n" + normals),
        ("sphere-of-rounded-sums", "Center plus radius is rounded to a double.", "M10",
         "scale 100000000 1 1\nsphere 0.1 0.2 0.3 0.2\n")):
        yield case(name, why, paragraphs, words, needs="spheres")
    glass = "material 1 0.5 0.25 16 0.125 1.5 0.25\nabsorption 0.5 0 2\n"
    for name, why, paragraphs, words in (
        ("glass", "A material goes on with reflectance, index and alpha, and its absorption follows it.",
         "S19b T17", glass + TRIANGLE),
        ("material-neither-mirror-nor-glass",
         "A reflectance of 0, an index of 1, an alpha of 1 and an absorption of 0 0 0 are not written.",
         "S19b S19c T6a T17", "material 1 0.5 0.25 16 0 1 1\nabsorption 0 0 0\n" + TRIANGLE),
        ("absorption-of-the-material-above", "Each absorption follows its own material.", "S19c T17",
         "material 1 1 0 1\n" + glass + "light 1 2 3 1 1 1\n" + "material 0 0 0 1 1 1 1\n" +
         "background 1 2 3\nabsorption 1e-3 0.25 1\nuse 1\n" + TRIANGLE),
        ("paint", "A paint follows what its material absorbs, and gives no column.", "S19e T5 T17",
         "material 1 1 0 1\n" + glass.replace("abs", "paint 255 0.5 0\nabs") + TRIANGLE)):
        yield case(name, why, paragraphs, words,
                   needs="optics" if "use" not in words else "lights materials optics")
    yield case("framed", "--framed announces the end, and writes it.", "M9 T13", TRIANGLE, options="--framed",
               needs="frames")
    yield case("framed-empty", "A framed text may be empty.", "M9 T13", "", options="--framed",
               needs="frames")


GRIDS = (triangles, translations_and_scales, rotations, orders_of_transforms, push_and_pop, numbers_and_lines,
         digits, exactness, extensions)
