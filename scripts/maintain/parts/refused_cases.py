"""The cases that must be refused, each at its line."""
from parts.conformance_pack import Case

CAMERA = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n"  # the commands of a scene begin on line 5
TRIANGLE = "triangle\n0 0 0\n1 0 0\n0 1 0\n"
VERTICES = "0 0 -2\n1 0 -2\n0 1 -2\n"
EYE = "eye 0 0 5\nlook 0 0 0\nup 0 1 0\n"
PERSPECTIVE = "perspective 60 1 1 100\n"
CONFIG = "8 8\n-1\n-1\n-1 1\n"
# What each stage needs in front of its triangles, and how many lines that is.
HEADERS = {"view": EYE + PERSPECTIVE, "project": PERSPECTIVE, "zbuf": ""}
NOT_NUMBERS = {
    "nan": "nan", "inf": "-inf", "hexadecimal": "0x10", "decimal-comma": "1,5", "letters-behind": "1.5abc",
    "too-large": "1e309", "point-alone": ".", "exponent-without-digits": "1e", "two-signs": "+-1",
    "two-points": "1.5.2", "sign-alone": "-", "word": "one", "underscore": "1_000", "exponent-alone": "e5",
    "capital-infinity": "Infinity", "exponent-with-a-point": "1e1.5", "exponent-with-a-sign-alone": "1e+",
    "just-too-large": "1.7976931348623159e308", "just-too-small": "-1.7976931348623159e308"}
# Those that each stage is asked for; of a scene it is all.
OFTEN = ("nan", "hexadecimal", "decimal-comma", "letters-behind", "too-large", "word", "underscore")


def refused(stage, name, why, paragraphs, line, text, config=CONFIG, **others):
    return Case(stage, f"refused-{name}", why, paragraphs, text, config, refused=line, **others)


def numbers():
    why = "What is not a number of the format is refused, whatever a library makes of it."
    for name, word in NOT_NUMBERS.items():
        yield refused("model", f"number-{name}", why, "S3 S5", 7,
                      CAMERA + f"triangle\n0 0 0\n1 {word} 0\n0 1 0\nend\n")
        for stage, header in HEADERS.items() if name in OFTEN else ():
            yield refused(stage, f"number-{name}", why, "S3 S5 T9",
                          header.count("\n") + 3, header + f"0 0 -2\n1 0 -2\n0 {word} -2\n")
    for name in OFTEN[1:5]:
        yield refused("zbuf", f"config-number-{name}", why, "S3 C2", 2, VERTICES,
                      f"8 8\n-{NOT_NUMBERS[name]}\n-1\n-1 1\n")


def cameras():
    for name, why, paragraphs, line, text in (
        ("nothing", "A scene of nothing lacks its camera.", "S5 S5b S6", 1, ""),
        ("end-in-the-camera", "The camera has four lines.", "S5 S6", 4, "0 0 5\n\n0 0 0\n"),
        ("eye-of-two-numbers", "The eye is three numbers on one line.", "S6", 1,
         "0 0\n5\n0 0 0\n0 1 0\n60 1 1 100\nend\n"),
        ("eye-of-four-numbers", "The eye is three numbers.", "S6", 1, CAMERA.replace("0 0 5",
                                                                                     "0 0 5 1") + "end\n"),
        ("up-of-zero", "An up direction of 0 0 0 is none.", "S9", 3, CAMERA.replace("0 1 0",
                                                                                    "0 0 0") + "end\n"),
        ("up-along-the-look", "An up direction along the look leaves the picture's turn open.", "S9", 3,
         CAMERA.replace("0 1 0", "0 0 2") + "end\n"),
        ("up-against-the-look", "An up direction against the look does so, too.", "S9", 3,
         CAMERA.replace("0 1 0", "0 0 -0.5") + "end\n"),
        ("up-along-a-slanted-look", "Parallel is parallel in any direction.", "S9", 3,
         "1 2 3\n3 6 9\n-1 -2 -3\n60 1 1 100\nend\n"),
        ("eye-at-the-point-looked-at", "An eye that looks at itself has no direction.", "S9", 2,
         "1 2 3\n1 2 3\n0 1 0\n60 1 1 100\nend\n"),
        ("later-line-of-the-camera-first", "The four lines are read before they are compared.", "S9", 4,
         "1 2 3\n1 2 3\n0 1 0\n60 1 1 1\nend\n")):
        yield refused("model", f"camera-{name}", why, paragraphs, line, text)
    for name, why, line in (
        ("fovy-0", "FOVY is above 0.", "0 1 1 100"),
        ("fovy-negative", "FOVY is above 0.", "-60 1 1 100"),
        ("fovy-180", "FOVY is below 180.", "180 1 1 100"),
        ("aspect-0", "ASPECT is above 0.", "60 0 1 100"),
        ("aspect-negative", "ASPECT is above 0.", "60 -1 1 100"),
        ("near-0", "NEAR is above 0.", "60 1 0 100"),
        ("near-negative", "NEAR is above 0.", "60 1 -1 100"),
        ("far-at-near", "Far is beyond near.", "60 1 2 2"),
        ("far-before-near", "Far is beyond near.", "60 1 10 1"),
        ("three-numbers", "A perspective has four numbers.", "60 1 2"),
        ("five-numbers", "A perspective has four numbers.", "60 1 1 100 9"),
        ("unknown-rule", "The rules are angle and ratio.", "60 1 1 100 square"),
        ("frustum-of-no-width", "A frustum has a width.", "frustum 1 1 -1 1 1 9"),
        ("frustum-of-no-height", "A frustum has a height.", "frustum -1 1 2 2 1 9"),
        ("frustum-near-0", "The near plane of a frustum is in front of the eye.", "frustum -1 1 -1 1 0 9"),
        ("ortho-of-no-width", "An ortho has a width.", "ortho 1 1 -1 1 -1 9"),
        ("ortho-of-no-depth", "Far is beyond near.", "ortho -1 1 -1 1 9 9"),
        ("ortho-of-five-numbers", "An ortho has six numbers.", "ortho -1 1 -1 1 1"),
        ("ortho-with-a-rule", "Only a perspective has a rule.", "ortho -1 1 -1 1 1 9 ratio"),
        ("unknown-projection", "The projections have their names.", "fisheye 1 2 3")):
        yield refused("model", f"projection-{name}", why, "S7 S8", 4,
                      CAMERA.replace("60 1 1 100", line) + "end\n")


def commands():
    for name, why, paragraphs, line, text in (
        ("unknown-command", "An unknown command is refused, not skipped.", "S10", 5, "cube 1\nend\n"),
        ("command-in-capitals", "Upper and lower case differ.", "S2 S10", 5, "PUSH\nend\n"),
        ("number-for-a-command", "A line of numbers is no command.", "S10", 5, "1 2 3\nend\n"),
        ("arguments-on-two-lines", "Arguments stand on one line.", "S10", 6, "translate\n1 2\n3\nend\n"),
        ("argument-too-many", "And nothing else does.", "S10", 6, "translate\n1 2 3 4\nend\n"),
        ("arguments-half-on-the-keywords-line", "All arguments stand on one line.", "S10", 5,
         "scale 2\n2 2\nend\n"),
        ("arguments-missing-at-the-end", "What is missing at the end is on the line after the last one.",
         "S5 S10", 6, "translate\n"),
        ("end-for-arguments", "end is no argument.", "S10", 6, "scale\nend\n"),
        ("triangle-of-two-vertices", "A triangle has three vertices.", "S11", 8,
         "triangle\n0 0 0\n1 0 0\nend\n"),
        ("triangle-of-four-vertices", "A triangle has no fourth vertex.", "S11", 9,
         TRIANGLE + "1 1 0\nend\n"),
        ("vertex-of-two-numbers", "A vertex has three numbers.", "S11", 7,
         "triangle\n0 0 0\n1 0\n0 1 0\nend\n"),
        ("vertex-of-four-numbers", "A vertex has three numbers.", "S11", 7,
         "triangle\n0 0 0\n1 0 0 1\n0 1 0\nend\n"),
        ("triangle-on-one-line", "Each vertex has a line.", "S11", 5, "triangle 0 0 0 1 0 0 0 1 0\nend\n"),
        ("triangle-cut-short", "A scene that ends in a triangle is cut.", "S11 S5", 7, "triangle\n0 0 0\n"),
        ("rotation-of-three-numbers", "A rotation has an angle and an axis.", "S12", 6,
         "rotate\n90 0 1\nend\n"),
        ("rotation-on-two-lines", "Its numbers stand on one line.", "S12", 6, "rotate\n90\n0 0 1\nend\n"),
        ("axis-of-zero", "An axis of 0 0 0 has no direction.", "S12", 6, "rotate\n90 0 0.0 -0\nend\n"),
        ("push-with-an-argument", "push takes no arguments.", "S13", 5, "push 1\nend\n"),
        ("pop-with-an-argument", "pop takes no arguments.", "S13", 6, "push\npop 1\nend\n"),
        ("pop-without-push", "A pop needs a push to undo.", "S13", 5, "pop\nend\n"),
        ("pop-once-too-often", "Each pop undoes a push of its own.", "S13", 7, "push\npop\npop\nend\n"),
        ("no-end", "end must be there.", "S14", 9, TRIANGLE),
        ("no-end-and-no-command", "end must be there.", "S14", 5, ""),
        ("end-with-an-argument", "end takes no arguments.", "S14", 5, "end 1\n"),
        ("command-behind-end", "Nothing follows end.", "S14", 8, "end\n\n# c\n push\n"),
        ("second-end", "Not even another end.", "S14", 6, "end\nend\n"),
        ("point-out-of-range", "A point beyond the range of doubles is refused at its vertex.", "N4", 9,
         "scale 1e200 1 1\nscale 1e200 1 1\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"),
        ("word-behind-a-point-out-of-range", "A triangle is read before its points are moved.", "S5a N4", 9,
         "scale 1e200 1 1\nscale 1e200 1 1\ntriangle\n1 0 0\n0 x 0\n0 1 0\nend\n"),
        ("control-character", "No other character separates words.", "S2", 6, "translate\n1\v2 3\nend\n"),
        ("second-projection", "The camera's words are no commands.", "S10", 5, "ortho -1 1 -1 1 1 9\nend\n")):
        yield refused("model", name, why, paragraphs, line, CAMERA + text)
    yield refused("model", "bytes-error-line",
                  "A stage that fails ends its output with an error line, for those behind it.", "T12", 5,
                  CAMERA + "cube\nend\n", tier="bytes")
    yield refused("model", "bytes-error-line-behind-triangles", "Even when it has written triangles.", "T12",
                  9, CAMERA + TRIANGLE + "pop\nend\n", tier="bytes")


def colors_and_lights():
    for name, why, paragraphs, line, text in (
        ("late-color", "A first color behind a triangle comes too late.", "S15", 9,
         TRIANGLE + "color 1 2 3\nend\n"),
        ("late-light", "So does a light.", "S15", 9, TRIANGLE + "light 1 2 3 1 1 1\nend\n"),
        ("late-background", "So does a background.", "S15", 9, TRIANGLE + "background 1 2 3\nend\n"),
        ("second-attributes", "attributes stands once.", "S15a", 6,
         "attributes color\nattributes normal\nend\n"),
        ("second-background", "background stands once.", "S15a", 6,
         "background 1 2 3\nbackground 1 2 3\nend\n"),
        ("unknown-attribute", "The columns are color and normal.", "S16", 5, "attributes hue\nend\n"),
        ("attributes-in-another-order", "In this order.", "S16", 5, "attributes normal color\nend\n"),
        ("no-attribute", "At least one of them.", "S16", 6, "attributes\nend\n"),
        ("missing-columns", "A vertex has the columns that attributes names.", "S16", 7,
         "attributes color normal\ntriangle\n0 0 0 1 2 3\n1 0 0\n0 1 0\nend\n"),
        ("normal-of-zero", "A normal has a direction.", "S16", 7,
         "attributes normal\ntriangle\n0 0 1 0 0 0\n1 0 0 0 0 1\n0 1 0 0 0 1\nend\n"),
        ("color-above-255", "Colors end at 255.", "S17", 6, "color\n1 256 0\nend\n"),
        ("color-below-0", "Colors begin at 0.", "S17", 5, "color 1 2 -1\nend\n"),
        ("color-of-two-numbers", "A color has three numbers.", "S17", 5, "color 1 2\nend\n"),
        ("ambient-below-0", "Light is not negative.", "S18", 5, "ambient -1 0 0\nend\n"),
        ("alpha-above-255", "An alpha ends at 255.", "S18", 5, "background 1 2 3 255.5\nend\n"),
        ("shininess-not-whole", "A shininess is whole.", "S19", 5, "material 1 1 1 1.5\nend\n"),
        ("shininess-negative", "A shininess is not negative.", "S19", 5, "material 1 1 1 -1\nend\n"),
        ("factor-below-0", "Factors are not negative.", "S19", 5, "material 1 -1 1 1\nend\n"),
        ("material-that-is-not-there", "use names a material above it.", "S23", 7,
         "material 1 1 0 1\nmaterial 1 1 1 1\nuse 2\nend\n"),
        ("material-used-before-its-line", "use names a material above it.", "S23", 6,
         "material 1 1 0 1\nuse 1\nmaterial 1 1 0 1\nend\n"),
        ("reflectance-above-1", "A reflectance ends at 1.", "S19b", 5, "material 1 1 1 1 1.5 1 1\nend\n"),
        ("reflectance-alone", "Reflectance, index and alpha stand together.", "S19b", 5,
         "material 1 1 1 1 0.5\nend\n"),
        ("index-of-0", "An index is not 0.", "S19b", 5, "material 1 1 1 1 0 0 1\nend\n"),
        ("alpha-below-0", "An alpha is not negative.", "S19b", 5, "material 1 1 1 1 0 1 -0.5\nend\n"),
        ("absorption-below-0", "Nothing absorbs less than nothing.", "S19c", 6,
         "material 1 1 1 1\nabsorption 0 -1 0\nend\n"),
        ("absorption-of-no-material", "An absorption belongs to a material above it.", "S19c", 5,
         "absorption 1 1 1\nmaterial 1 1 1 1\nend\n"),
        ("second-absorption", "A material has one absorption.", "S19c", 7,
         "material 1 1 1 1\nabsorption 1 1 1\nabsorption 1 1 1\nend\n"),
        ("second-paint", "A material has one paint.", "S19e", 8,
         "material 1 1 1 1\npaint 1 1 1\nabsorption 1 1 1\npaint 1 1 1\nend\n"),
        ("paint-above-255", "Colors end at 255.", "S19e", 6, "material 1 1 1 1\npaint 1 1 256\nend\n"),
        ("late-material", "Materials stand before the triangles.", "S15", 9,
         TRIANGLE + "material 1 1 0 1\nend\n"),
        ("attenuation-of-zeros", "One of the three is above 0.", "S20", 5, "attenuation 0 0 0\nend\n"),
        ("light-of-three-numbers", "A light has a color, too.", "S21", 5, "light 1 2 3\nend\n"),
        ("light-below-0", "Light is not negative.", "S21", 5, "light 1 2 3 1 1 -1\nend\n")):
        yield refused("model", name, why, paragraphs, line, CAMERA + text)


def stage_texts():
    for stage, header in HEADERS.items():
        at = header.count("\n")
        for name, why, paragraphs, line, text in (
            ("blank-line-in-a-triangle", "A blank line parts triangles.", "T8", 3,
             "0 0 -2\n1 0 -2\n\n0 1 -2\n"),
            ("cut-in-a-triangle", "A text that ends in a triangle is cut.", "T8", 3, "0 0 -2\n1 0 -2\n"),
            ("vertex-of-two-numbers", "A vertex has three numbers.", "T9", 2, "0 0 -2\n1 0\n0 1 -2\n"),
            ("vertex-of-four-numbers", "A vertex has no column that attributes does not name.", "T9", 1,
             "0 0 -2 1\n1 0 -2\n0 1 -2\n"),
            ("unknown-line", "An unknown line is refused, not skipped.", "T1", 5, VERTICES + "\nquad\n"),
            ("unknown-header", "Even in the header.", "T1", 1, "camera 1\n" + VERTICES),
            ("header-behind-triangles", "The header ends before the first triangle.", "T1", 5,
             VERTICES + "\nbackground 1 2 3\n"),
            ("second-background", "Each keyword stands once.", "T7", 2,
             "background 1 2 3\nbackground 1 2 3\n"),
            ("error-of-an-earlier-stage", "Where an earlier stage has failed, this one fails.", "T12", 4,
             VERTICES + "error model: no scene\n"),
            ("end-of-no-frame", "end belongs to framed texts.", "T13", 5, VERTICES + "\nend\n"),
            ("frame-without-end", "A framed text that ends without end is cut.", "T13", 5,
             "framed\n" + VERTICES),
            ("something-behind-end", "end is the last line.", "T13", 6,
             "framed\n" + VERTICES + "end\n0 0 0\n"),
            ("number-of-a-triangle-not-whole", "A triangle's number is whole.", "T10", 1,
             "triangle 1.5\n" + VERTICES),
            ("color-above-255", "Colors end at 255.", "T9", 3,
             "attributes color\n0 0 -2 1 1 1\n0 0 -2 1 1 256\n0 0 -2 1 1 1\n"),
            ("material-that-is-not-there", "A material is one of the header's.", "T9", 4,
             "attributes material\nmaterial 1 1 0 1\nmaterial 1 1 1 1\n0 0 -2 2\n1 0 -2 2\n0 1 -2 2\n"),
            ("two-materials-in-a-triangle", "A triangle has one material.", "T9", 6,
             "attributes material\nmaterial 1 1 0 1\nmaterial 1 1 1 1\n0 0 -2 1\n1 0 -2 1\n0 1 -2 0\n"),
            ("second-absorption", "A material has one absorption.", "T7b", 3,
             "material 1 1 1 1\nabsorption 1 1 1\nabsorption 1 1 1\n" + VERTICES),
            ("attributes-in-another-order", "Columns have their order.", "T5", 1,
             "attributes normal color\n" + VERTICES)):
            yield refused(stage, name, why, paragraphs, at + line, header + text)
    for name, why, paragraphs, stage, line, text, options in (
        ("eye-at-the-point-looked-at", "An eye that looks at itself has no direction.", "S9 T2", "view", 2,
         EYE.replace("look 0 0 0", "look 0 0 5") + VERTICES,
         ""), ("up-parallel-to-the-look", "An up direction along the look leaves the picture's turn open.",
               "S9 T2", "view", 3, EYE.replace("up 0 1 0", "up 0 0 1") + VERTICES,
               ""), ("no-camera", "Without a camera there is no view.", "V1", "view", 1, VERTICES,
                     ""), ("half-a-camera", "All three parts are needed.", "V1", "view", 3,
                           "eye 0 0 5\nlook 0 0 0\n" + VERTICES,
                           ""), ("text-of-project", "A text that has been projected is not for view.", "T14",
                                 "view", 1, "projected frustum -1 1 -1 1 1 9\n" + EYE + VERTICES, ""),
        ("no-projection", "Without a projection nothing is projected.", "P1", "project", 1, VERTICES,
         ""), ("text-of-model", "A text with a camera has not been through view.", "T14", "project", 1,
               EYE + PERSPECTIVE + VERTICES, ""), ("fovx-180", "fovX is below 180 degrees.", "P2", "project",
                                                   2, "# c\nperspective 90 2 1 9\n" + VERTICES, ""),
        ("far-before-near", "Far is beyond near.", "S7 T3", "project", 1, "perspective 60 1 9 1\n" + VERTICES,
         ""), ("divided-by-0", "Uncut, a vertex in the plane of the eye cannot be divided.", "P4", "project",
               3, PERSPECTIVE + "0 0 -2\n1 0 0\n0 1 -2\n",
               "--clip none"), ("divided-behind-the-eye", "Uncut, a vertex behind the eye is not divided.",
                                "P4", "project", 2, PERSPECTIVE + "0 0 2\n1 0 -2\n0 1 -2\n", "--clip none"),
        ("column-w", "A text with the column w has been projected.", "T14", "project", 2, PERSPECTIVE +
         "attributes w\n" + VERTICES, ""), ("second-projection", "There is one projection.", "T7a", "project",
                                            2, PERSPECTIVE + "ortho -1 1 -1 1 1 9\n" + VERTICES, ""),
        ("text-of-model", "A text with a camera has not been through view.", "T14", "zbuf", 1, EYE + VERTICES,
         ""), ("text-of-view", "A text with a projection has not been through project.", "T14", "zbuf", 1,
               PERSPECTIVE + VERTICES, ""), ("lights-of-no-projection", "Light needs the projection.", "T15",
                                             "zbuf", 2, "light 0 0 0 1 1 1\n" + VERTICES,
                                             ""), ("background-with-alpha", "A BMP has no alpha.", "Z11",
                                                   "zbuf", 1, "background 1 2 3 254\n" + VERTICES, ""),
        ("shading-of-no-light", "Without a light nothing is shaded.", "L1", "zbuf", 1, VERTICES,
         "--shading flat"), ("not-framed", "--expect-framed insists on a framed text.", "T15", "zbuf", 1,
                             VERTICES, "--expect-framed"),
        ("piece-of-another-material", "A piece has the material of the triangle it was cut from.", "T11",
         "zbuf", 8,
         "attributes w material\nmaterial 1 1 0 1\nmaterial 1 1 1 1\nclipped\n0 0 -2 1 1\n1 0 -2 1 1\n0 1 -2 "
         "1 1\n0 0 0 1 0\n1 0 0 1 0\n0 1 0 1 0\n",
         ""), ("w-of-0", "The column w is above 0.", "T9", "zbuf", 2,
               "attributes w\n0 0 0 0\n1 0 0 1\n0 1 0 1\n", "")):
        yield refused(stage, name, why, paragraphs, line, text, options=options)
    yield refused("view", "bounds-of-another-space", "Bounds hold for the text of one stage.", "T28", 5,
                  HEADERS["view"] + "bounds view 0 0\n" + VERTICES, needs="bounds")


def spheres():
    for name, why, paragraphs, line, text, options in (
        ("sphere-of-radius-0", "A radius is above 0.", "S24", 6, "sphere\n1 2 3 0\nend\n", ""),
        ("sphere-of-radius-below-0", "A radius is above 0.", "S24", 6, "sphere\n1 2 3 -1\nend\n", ""),
        ("sphere-of-no-radius", "A sphere has four numbers.", "S24", 6, "sphere\n1 2 3\nend\n", ""),
        ("sphere-of-a-lost-radius", "A radius that is lost beside the center is none.", "S24", 5,
         "sphere 0 1e20 0 1\nend\n", ""),
        ("sphere-without-a-color", "Columns of vertices do not color a sphere.", "S24", 6,
         "attributes color\nsphere 0 0 0 1\nend\n", ""),
        ("light-behind-a-sphere", "Lights stand before the first sphere.", "S15", 6,
         "sphere 0 0 0 1\nlight 0 0 0 1 1 1\nend\n", ""),
        ("sphere-flattened", "A sphere that is scaled flat has no volume.", "M10", 7,
         "rotate 10 0 0 1\nscale 1 0 1\nsphere 0 0 0 1\nend\n", ""),
        ("bare-sphere", "A bare text has triangles alone.", "M10", 9, TRIANGLE + "sphere 0 0 0 1\nend\n",
         "--bare")):
        yield refused("model", name, why, paragraphs, line, CAMERA + text, options=options, needs="spheres")
    points = "sphere\n0 0 -3\n1 0 -3\n0 1 -3\n0 0 -2\n\n"
    for name, why, paragraphs, line, text, options in (
        ("sphere-cut-in-two", "No blank line parts the points of a sphere.", "T26", 7,
         points.replace("\n1", "\n\n1"),
         ""), ("sphere-of-three-points", "A sphere has four points.", "T26", 9, points.replace(
             "0 0 -2\n",
             ""), ""), ("sphere-with-a-number", "The number stands on a line before it.", "T26", 5,
                        points.replace("sphere", "sphere 3"), ""),
        ("sphere-of-two-colors", "A sphere has one color.", "T26", 8, "attributes color\n" +
         points.replace("-3\n", "-3 1 2 3\n", 1).replace("-3\n", "-3 1 2 4\n").replace("-2\n", "-2 1 2 3\n"),
         ""), ("bare-sphere", "A bare text has triangles alone.", "T27", 5, points, "--bare")):
        yield refused("view", name, why, paragraphs, line, HEADERS["view"] + text, options=options,
                      needs="spheres")
    for stage in ("project", "zbuf"):
        header = HEADERS[stage]
        yield refused(stage, "sphere", "Spheres are for stages that trace rays.", "T27",
                      header.count("\n") + 4, header + VERTICES + points)


def configs():
    for name, why, paragraphs, line, text in (
        ("nothing", "A config of nothing lacks its size.", "C1", 1, ""),
        ("size-on-two-lines", "The size is two numbers on one line.", "C1", 1, "8\n8\n"),
        ("width-0", "A picture has a pixel.", "C1", 1, "0 8\n"),
        ("height-0", "A picture has a pixel.", "C1", 1, "8 0\n"),
        ("width-negative", "Sizes have no sign.", "C1 S4", 1, "-8 8\n"),
        ("width-too-large", "A picture has at most 65535 columns.", "C1", 1, "65536 8\n"),
        ("size-not-whole", "Sizes are whole.", "C1 S4", 1, "8.0 8\n"),
        ("third-number", "A size has two numbers.", "C1", 1, "8 8 8\n"),
        ("left-limit-positive", "The left limit is below 0.", "C2", 2, "8 8\n1\n-1\n-1 1\n"),
        ("left-limit-0", "The left limit is below 0.", "C2", 2, "8 8\n0\n-1\n-1 1\n"),
        ("bottom-limit-positive", "The bottom limit is below 0.", "C2", 3, "8 8\n-1\n1\n-1 1\n"),
        ("limits-on-one-line", "Each limit has a line.", "C2", 2, "8 8\n-1 -1\n-1 1\n"),
        ("limits-cut-short", "All limits are there, or none.", "C2 S5", 3, "8 8\n-1\n"),
        ("rear-before-front", "The rear limit is behind the front limit.", "C2", 4, "8 8\n-1\n-1\n1 0\n"),
        ("rear-at-front", "The rear limit is behind the front limit.", "C2", 4, "8 8\n-1\n-1\n1 1\n"),
        ("front-alone", "There are two limits of z.", "C2", 4, "8 8\n-1\n-1\n1\n"),
        ("something-behind", "Nothing follows.", "C3", 6, CONFIG + "\n0\n")):
        yield refused("zbuf", f"config-{name}", why, paragraphs, line, VERTICES, text)


GRIDS = (numbers, cameras, commands, colors_and_lights, stage_texts, spheres, configs)
