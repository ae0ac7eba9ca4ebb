"""Cases for single clauses of the specification that a program may get wrong while all else is right."""
from parts.conformance_pack import Case
from parts.refused_cases import CAMERA, CONFIG, EYE, HEADERS, PERSPECTIVE, TRIANGLE, VERTICES, refused

MATERIALS = "material 1 1 0 1\nmaterial 0.5 0.25 1 16\n"
CORNERS = ("-0.83 -0.77 0.1", "0.87 -0.31 0.5", "-0.13 0.91 0.9")


def lit_text(columns, rests, light="light 2 3 1 1 0.9 0.8", material="material 1 0.8 0.5 8",
             ambient="ambient 0.12 0.13 0.14", projected="frustum -1 1 -1 1 1 9", corners=CORNERS):
    """A text of zbuf with a light; each corner goes on with one of `rests`."""
    lines = [f"projected {projected}", f"attributes {columns}" if columns else "", light, ambient, material]
    return "\n".join(filter(None, lines)) + "\n" + "".join(
        f"{corner} {rest}".strip() + "\n" for corner, rest in zip(corners, rests)) + "\n"


def lights():
    plain, turned, slanted = ("", ) * 3, ("0 0 -1", "0.6 0 -0.8", "0 0.6 -0.8"), ("0 0 1", "0.6 0 0.8",
                                                                                  "0 0.6 0.8")
    colored = ("255 0 0", "0 255 0", "0 0 255")
    behind = "light 8 0 -30 1 0.9 0.8"
    for name, why, paragraphs, text, options in (
        ("with-normals-by-default", "Normals are lit at every pixel, unless an option says otherwise.", "L1",
         lit_text("normal", slanted), ""),
        ("without-normals-by-default", "Without normals a triangle is lit once.", "L1",
         lit_text("color", ("200 100 50", ) * 3), ""),
        ("normals-turned-to-the-eye", "A normal that points away from the eye is turned.", "L5",
         lit_text("normal", turned), "--shading phong"),
        ("normals-turned-at-corners", "So it is at corners.", "L5", lit_text("normal", turned),
         "--shading gouraud"),
        ("a-quarter-of-ambient", "AMBIENT weakens the ambient light.", "L5",
         lit_text("", plain, material="material 0.25 0.5 0 1", ambient="ambient 0.5 0.75 1"), ""),
        ("twice-the-ambient", "AMBIENT may strengthen it, and is added once for any number of lights.", "L5",
         lit_text("", plain, "light 0 0 0 0.125 0 0\nlight 1 0 0 0 0.125 0", "material 2 1 0 1"), ""),
        ("no-highlight-from-behind",
         "Where a light is behind the surface it has no highlight, however blunt.", "L5",
         lit_text("normal", ("0 0 1", ) * 3, behind, "material 1 0.8 1 0"), ""),
        ("shininess-of-0", "With a shininess of 0 the highlight is everywhere in front.", "L5",
         lit_text("normal", slanted, material="material 1 0.5 0.25 0"), ""),
        ("shininess-of-1", "With a shininess of 1 it is the cosine.", "L5",
         lit_text("normal", slanted, material="material 0 0 1 1", ambient=""), ""),
        ("a-sharp-highlight", "With a large shininess it is small.", "L5",
         lit_text("normal", ("0 0 1", "0.5 0 1", "0 0.5 1"), "light 0 1 2 1 1 1", "material 0 0.25 1 200"),
         ""),
        ("corners-that-are-clamped", "--shading gouraud clamps the colors of corners before it mixes them.",
         "L4",
         lit_text("normal", ("0 0 1", "1 0 0.125", "0 1 0.125"), "light 0 0 9 9 6 3"), "--shading gouraud"),
        ("normals-of-unequal-lengths", "Normals are mixed as they are, not as unit vectors.", "L4a T9",
         lit_text("normal", ("0 0 5", "3 0 1", "0 0.25 0.125")), "--shading phong"),
        ("flat-by-three-normals", "--shading flat uses the plane's normal, and no other.", "L4",
         lit_text("color normal", [f"{c} {n}" for c, n in zip(colored, slanted)]), "--shading flat"),
        ("default-material", "Without a material a triangle is matt, and takes all ambient light.", "L5 S19",
         lit_text("normal", slanted, "light 0 0 2 1 1 1", ""), ""),
        ("highlight-under-ortho", "Under ortho the eye is in the direction 0 0 1 of every point.", "L5",
         lit_text("normal", slanted, "light 1 2 3 1 1 1", "material 0 0.25 1 9",
                  projected="ortho -4 4 -4 4 1 9"), ""),
        ("positions-under-ortho",
         "Under ortho z goes evenly from near to far, and the window may be anywhere.",
         "L2 L5", lit_text("", plain, "attenuation 1 0.5 0.25\nlight 1 2 3 4 4 4",
                           projected="ortho 1 3 -5 1 2 20"), ""),
        ("window-beside-the-axis", "The window of a frustum may be anywhere.", "L2 L5",
         lit_text("", plain, "attenuation 0.5 0 0.25\nlight 1 2 3 9 9 9", projected="frustum 1 3 -4 1 2 20"),
         ""),
        ("without-w", "Without the column w it comes from z.", "L2",
         lit_text("normal", slanted, projected="frustum -1 1 -1 1 2 5"), ""),
        ("attenuation-constant", "CONSTANT weakens at any distance.", "L5",
         lit_text("", plain, "attenuation 2 0 0\nlight 2 3 1 1 0.9 0.8"), ""),
        ("attenuation-linear", "LINEAR counts the distance.", "L5",
         lit_text("", plain, "attenuation 0 0.5 0\nlight 2 3 1 1 0.9 0.8"), ""),
        ("attenuation-quadratic", "QUADRATIC counts its square.", "L5",
         lit_text("", plain, "attenuation 0 0 0.125\nlight 2 3 1 1 0.9 0.8"), ""),
        ("light-at-the-surface", "A light in the very point that it would light adds nothing.", "L5",
         lit_text("", plain, "light 0 0 -5 1 1 1", projected="ortho -1 1 -1 1 1 9",
                  corners=("-0.75 -0.75 0", "0.75 -0.75 0", "0 1.5 0")), ""),
        ("by-the-whole-triangle-alone", "clipped is of the pieces behind it, and of no later triangle.",
         "T11 L2",
         lit_text("", plain).replace("-0.83", "clipped\n-3 -3 2 1\n3 -1 2 4\n-0.5 3 1 3\n\n-0.83") +
         "-0.9 0.9 0.2\n-0.9 -0.1 0.9\n0.1 0.9 0.4\n", ""),
        ("two-pieces-of-one-triangle", "clipped is of all pieces with its number.", "T11 L2",
         lit_text("normal", slanted).replace("-0.83",
                                             "clipped\n-3 -3 2 1 0 0 1\n3 -1 2 4 1 0 1\n"
                                              "-0.5 3 1 3 0 1 1\n\n-0.83")
         + "triangle 0\n-0.9 0.9 0.2 0 0 1\n-0.9 -0.1 0.9 0 0 1\n0.1 0.9 0.4 0 0 1\n", ""),
        ("whole-triangle-with-w-below-0", "The w of clipped may have any sign.", "T11 L3",
         lit_text("normal", slanted).replace(
             "-0.83", "clipped\n-3 -3 2 -1 0 0 1\n3 -1 2 4 1 0 1\n-0.5 3 1 3 0 1 1\n\n-0.83"), ""),
        ("clockwise", "A triangle that runs clockwise is lit alike.", "L3 L4",
         lit_text("normal", slanted, corners=CORNERS[::-1]), "")):
        yield Case("zbuf", f"lights-{name}", why, paragraphs, text, CONFIG, options=options,
                   needs="lights colors" if "color" in text else "lights")
    small = "attributes color\n" + "".join(
        f"{xy} 0 {color}\n" for xy, color in zip(("-0.3 -0.3", "-0.2 0.4", "0.5 -0.1"), colored))
    yield Case("zbuf", "colored-small-and-clockwise", "However small, a clockwise triangle has its weights.",
               "L3", small, CONFIG, needs="colors")
    yield Case("zbuf", "colored-just-below-halves", "What is at most 2^-20 below a half counts as one.", "L6",
               "background 0.4999995 0.499998 99.4999991\n", CONFIG, needs="colors")
    for name, why, places in (
        ("line", "Where no corner has a weight, the first has it all.",
         ("0.125 -0.9", "0.125 0.9", "0.125 0.1")),
        ("diagonal", "On a triangle without area the weights that are left are divided.",
         ("-0.9 -0.8", "0.9 0.8", "0 0"))):
        text = "attributes color\n" + "".join(f"{xy} 0 {color}\n" for xy, color in zip(places, colored))
        yield Case("zbuf", f"colored-{name}", why, "L3", text, CONFIG, needs="colors",
                   open="A triangle without area may have pixels or none.")


def depths_of_ends():
    for name, corners in (("nearest-right", "0.1 0.9 0.5\n0.1 -0.9 0.5\n0.10000000000000002 0.1 -0.5\n"),
                          ("nearest-first", "0.125 0.9 -0.5\n0.125 -0.9 0.5\n0.125 0.1 0.75\n")):
        yield Case("zbuf", f"ends-that-meet-{name}", "Where the ends of a row meet, the smaller z counts.",
                   "Z4", corners, CONFIG, open="A triangle without area may have pixels or none.")
    wide = "-3 -0.9 -1.5\n3 -0.9 1.5\n0 3 0\n"
    yield Case("zbuf", "depth-at-front-and-rear", "A depth of FRONT is drawn, one of REAR is not.", "Z8",
               "-3 -3 -0.5\n3 -3 -0.5\n0 3 -0.5\n\n-3 0 0.5\n3 0 0.5\n0 3 0.5\n", "8 8\n-1\n-1\n-0.5 0.5\n")
    beyond = "".join(f"-3 -3 {z}\n3 -3 {z}\n0 {y} {z}\n\n" for y, z in (
        (3, 1), (2, 1.5), (1, -1.5), (0.5, 0.999), (-0.25, -1)))
    yield Case("zbuf", "depths-of-a-size-alone",
               "Without limits in the config depths are drawn from -1 to below 1.",
               "C2 Z8", beyond, "8 8\n", needs="syntax")
    yield Case("zbuf", "depth-front-above-0", "Both limits may be on one side of 0.", "Z8 C2", wide,
               "8 8\n-1\n-1\n0.25 0.5\n")
    tall = "-0.9 -0.9 0\n0.9 -0.9 0.5\n0.1 0.9 1\n"
    for words, name in (("0:1", "first"), ("7:8", "last"), ("0:8", "all")):
        yield Case("zbuf", f"rows-{name}", "--rows has the first row and not the end.", "Z13", tall, CONFIG,
                   options=f"--rows {words}")
    for count in (1, 4):
        yield Case("zbuf", f"samples-{count}-in-color", "A pixel is the rounded mean of rounded samples.",
                   "Z12 L6",
                   f"background 7 9 31\nattributes color\n" + tall.replace("\n", " 200.5 101 33\n"), CONFIG,
                   options=f"--samples {count}", needs="colors", open="The assignment has no samples.")
    for algorithm in ("zbuffer", "scanline"):
        yield Case("zbuf", f"algorithm-{algorithm}", "--algorithm changes nothing.", "Z8", tall + "\n" + wide,
                   CONFIG, options=f"--algorithm {algorithm}")
    for name, left, bottom in (("smallest", "-1e-200", "-1e-200"), ("largest", "-1e200", "-1e200"),
                               ("unequal", "-1e200", "-1e-200")):
        x, y = ("1" + left[2:], "1" + bottom[2:])
        text = f"-.5{x[1:]} -.5{y[1:]} 0\n.75{x[1:]} -.25{y[1:]} 0\n0 .75{y[1:]} 0\n"
        yield Case("zbuf", f"window-{name}-limits", "The limits of x and y may be from 1e-200 to 1e200.",
                   "C2", text, f"8 8\n{left}\n{bottom}\n-1 1\n", needs="exactness")
    for name, why, line, file in (
        ("largest-size", "A picture of 65535 rows and columns is one.", 2, "65535 65535\n1\n"),
        ("height-too-large", "A picture has at most 65535 rows.", 1, "1 65536\n"),
        ("left-limit-beyond-1e200", "The left limit is at least -1e200.", 2,
         "8 8\n-1.000001e200\n-1\n-1 1\n"),
        ("bottom-limit-beyond-1e200", "So is the bottom limit.", 3, "8 8\n-1\n-1.000001e200\n-1 1\n"),
        ("left-limit-below-1e-200", "The left limit is at most -1e-200.", 2,
         "8 8\n-9.99999e-201\n-1\n-1 1\n"),
        ("limits-of-three-lines", "All limits are there, or none.", 4, "8 8\n-1\n-1\n")):
        yield refused("zbuf", f"config-{name}", why, "C1 C2", line, VERTICES, file)
    yield Case("zbuf", "shading-none-without-lights", "--shading none needs no light.", "L1", tall, CONFIG,
               options="--shading none")
    yield Case("zbuf", "samples-16", "A pixel has up to 16 times 16 samples.", "Z12", tall, "3 2\n",
               options="--samples 16", open="The assignment has no samples.")
    yield Case("zbuf", "alpha-that-rounds-to-255", "An alpha is rounded before it is compared.", "Z11 L6",
               "background 1 2 3 254.5\n" + VERTICES, CONFIG, needs="alpha")
    yield refused("zbuf", "alpha-that-rounds-to-254", "An alpha is rounded before it is compared.", "Z11", 1,
                  "background 1 2 3 254.499\n" + VERTICES)


def numbers_in_words():
    """S1, S2 and S4: words that only some libraries read."""
    for name, word in (("plus", "+3"), ("2-to-the-64", "18446744073709551616"), ("point", "3."),
                       ("exponent", "3e0"), ("minus", "-3"), ("underscore", "1_0")):
        for stage, header in (HEADERS if name in ("plus", "2-to-the-64") else {"view": EYE}).items():
            yield refused(stage, f"count-{name}", "A whole number is digits alone, below 2^64.", "S4 T10",
                          header.count("\n") + 1, header + f"triangle {word}\n" + VERTICES)
    for name, size in (("plus", "+8 8\n"), ("underscore", "8 1_0\n")):
        yield refused("zbuf", f"config-count-{name}", "A whole number is digits alone.", "S4 C1", 1, VERTICES,
                      size)
    for stage, header in HEADERS.items():
        number = "triangle 18446744073709551615\n"
        yield Case(stage, "numbers-after-the-last", "After 2^64 - 1 comes 0.", "T10 S4",
                   header + number + VERTICES + "\n" + VERTICES, CONFIG, needs="numbering", tier="bytes")
        yield Case(stage, "numbers-twice-and-last", "A number may stand twice, and behind the last triangle.",
                   "T10", header + "triangle 3\ntriangle 9\n" + VERTICES + "triangle 4\n", CONFIG,
                   needs="numbering", tier="bytes")
        yield Case(stage, "numbers-with-leading-zeros", "Zeros in front change nothing.", "S4 S3",
                   header + "triangle 0003\n" + VERTICES.replace("1 0 -2", "0001.0 00 -2"), CONFIG,
                   needs="numbering", tier="bytes")
        yield Case(stage, "numbers-too-small", "A number too small for a double is 0, and 0 has no sign.",
                   "S3 T19",
                   header + VERTICES.replace("1 0 -2", "1 -1e-400 -2").replace("0 1", "-0.0e9999 1"), CONFIG,
                   tier="bytes", needs="exactness")
        yield Case(stage, "lines-byte-order-mark", "A byte order mark in front does not count.", "S1",
                   "\xef\xbb\xbf" + header + VERTICES, CONFIG, needs="syntax")
        yield Case(stage, "lines-comment-in-a-triangle", "A line of comment alone does not part a triangle.",
                   "T8", header + VERTICES.replace("1 0 -2", "# c\n1 0 -2\n  # c\n#"), CONFIG, needs="syntax")
        yield Case(stage, "lines-carriage-return-before-a-comment", "It is at the end of the line.", "S1b",
                   header + VERTICES.replace("0 -2", "0 -2\r# c"), CONFIG, needs="syntax")
        yield Case(stage, "lines-indented", "Blanks and tabs may stand in front of words.", "S2 T8",
                   " " * bool(header) + header + VERTICES.replace("1", "\t 1"), CONFIG, needs="syntax")
        at = header.count("\n")
        for name, why, paragraphs, line, text in (
            ("carriage-return-between-words", "A carriage return separates no words.", "S2", 1,
             VERTICES.replace("0 0", "0\r0")),
            ("form-feed-between-words", "Nor does a form feed.", "S2", 1, VERTICES.replace("0 0", "0\f0")),
            ("byte-order-mark-in-the-middle", "A mark elsewhere is no blank.", "S1", 2,
             "\n\xef\xbb\xbf" + VERTICES),
            ("no-break-space", "A no-break space is no blank.", "S2", 1, VERTICES.replace("0 0", "0 0\xa0")),
            ("keyword-in-capitals", "Upper and lower case differ.", "S2 T1", 1, "Triangle 3\n" + VERTICES)):
            yield refused(stage, name, why, paragraphs, at + line, header + text)
    why, long = "A line has at most 2^20 bytes.", "#" + " " * (2**20 - 1)
    for stage, before in {"model": CAMERA, **HEADERS}.items():
        behind = "end\n" if stage == "model" else VERTICES
        yield Case(stage, "lines-of-2-to-the-20-bytes", why, "S1a", f"{before}{long}\n{behind}", CONFIG,
                   needs="syntax")
        yield refused(stage, "line-of-more-than-2-to-the-20-bytes", why, "S1a", before.count("\n") + 1,
                      f"{before}{long} \n{behind}")
    yield Case("model", "lines-byte-order-mark-before-a-comment",
               "A byte order mark in front does not count.", "S1",
               "\xef\xbb\xbf# c\n" + CAMERA + TRIANGLE + "end", needs="syntax")
    yield Case("zbuf", "lines-byte-order-mark-in-the-config", "Nor does it in the config.", "S1", VERTICES,
               "\xef\xbb\xbf" + CONFIG, needs="syntax")
    yield refused("model", "carriage-return-between-words", "A carriage return separates no words.", "S2", 6,
                  CAMERA + "translate\n1\r2 3\nend\n")


def headers():
    """Which header lines, columns and marks a stage text may have."""
    yield Case("zbuf", "bounds-move-nothing", "Bounds tell of a picture; they do not change it.", "T29",
               "bounds ndc 0.5 0 0.25 1e-3\n" + "\n".join(CORNERS) + "\n", CONFIG, needs="bounds")
    for stage, header in HEADERS.items():
        at = header.count("\n")
        color = "attributes color\n" + VERTICES.replace("\n", " 1 2 3\n")
        yield refused(stage, "two-numbers-of-a-triangle", "A line has one number.", "T10", at + 1,
                      header + "triangle 3 4\n" + VERTICES)
        for name, why, paragraphs, line, text in (
            ("attributes-alone", "attributes names at least one column.", "T5", 1, "attributes\n" + VERTICES),
            ("attributes-twice-the-same", "A column stands once.", "T5", 1,
             "attributes color color\n" + VERTICES),
            ("second-attributes", "Each keyword stands once.", "T7", 2,
             "attributes color\nattributes normal\n"),
            ("second-framed", "Each keyword stands once.", "T7", 2, "framed\nframed\n" + VERTICES + "end\n"),
            ("second-ambient", "Each keyword stands once.", "T7", 2,
             "ambient 1 1 1\nambient 1 1 1\n" + VERTICES),
            ("second-attenuation", "Each keyword stands once.", "T7", 2,
             "attenuation 1 1 1\nattenuation 1 1 1\n" + VERTICES),
            ("framed-with-a-word", "framed takes no arguments.", "T6b T1", 1,
             "framed 1\n" + VERTICES + "end\n"),
            ("end-with-a-word", "end takes no arguments.", "T13", 5, "framed\n" + VERTICES + "end 1\n"),
            ("end-without-a-line-feed", "The line end has its line feed.", "T13", 5,
             "framed\n" + VERTICES + "end"),
            ("frame-of-a-header-alone", "A header alone is cut without end, too.", "T13", 2, "framed\n"),
            ("end-in-a-triangle", "A text that ends within a triangle is cut.", "T8 T13", 4,
             "framed\n0 0 -2\n1 0 -2\nend\n"),
            ("header-behind-a-number", "A header line behind the header is refused.", "T1", 2,
             "triangle 1\nambient 1 1 1\n" + VERTICES),
            ("vertex-of-two-more-numbers", "A vertex has all its columns.", "T9", 3,
             color.replace("-2 1 2 3", "-2 1 2 3", 1).replace("1 0 -2 1 2 3", "1 0 -2 1 2")),
            ("material-2-to-the-64", "A material is below 2^64.", "T9 S4", 2,
             "attributes material\n" + VERTICES.replace("\n", " 18446744073709551616\n")),
            ("material-without-a-header", "Without materials in the header there is 0 alone.", "T9", 2,
             "attributes material\n" + VERTICES.replace("\n", " 1\n")),
            ("color-below-0", "Colors begin at 0.", "T9", 2, color.replace("1 2 3", "-0.001 2 3")),
            ("background-above-255", "Colors end at 255.", "T6 S18", 1, "background 1 2 256\n" + VERTICES),
            ("light-below-0", "Light is not negative.", "T6 S21", 1, "light 0 0 0 1 1 -1\n" + VERTICES),
            ("material-factor-below-0", "Factors are not negative.", "T6 S19", 1,
             "material 1 1 -1 1\n" + VERTICES),
            ("paint-of-no-material", "A paint belongs to the material above it.", "T7b S19e", 1,
             "paint 1 1 1\nmaterial 1 1 1 1\n" + VERTICES),
            ("error-in-a-triangle", "An error is one wherever it stands.", "T12", 3,
             "0 0 -2\n1 0 -2\nerror model: line 7: full\n"),
            ("error-at-once", "Even where a header would begin.", "T12", 1, "error model: line 7: full\n"),
            ("error-behind-end", "Even behind the end.", "T12", 6,
             "framed\n" + VERTICES + "end\nerror model: 1\n")):
            yield refused(stage, name, why, paragraphs, at + line, header + text)
        yield Case(stage, "material-0-without-a-header",
                   "Material 0 may stand without a material in the header.", "T9",
                   header + "attributes material\n" + VERTICES.replace("\n", " 0\n"), CONFIG,
                   needs="materials")
        yield Case(stage, "colors-at-the-limits", "Both 0 and 255 are colors.", "T9",
                   header + "attributes color\n" + VERTICES.replace("\n", " 0 255 0.5\n"), CONFIG,
                   needs="colors")
        yield Case(stage, "framed-blank-lines-behind-end", "Blank lines may follow end.", "T13",
                   header + "framed\n" + VERTICES + "end\n\n \n# c\n", CONFIG, needs="frames syntax")
    for stage in ("view", "project"):
        header, at = HEADERS[stage], HEADERS[stage].count("\n")
        for name, why, paragraphs, line, text in (
            ("column-w-of-a-projected-text", "A text with the column w has been projected.", "T14", 1,
             "attributes w\n" + VERTICES.replace("\n", " 1\n")),
            ("clipped", "Only zbuf accepts clipped.", "T11", 1,
             "clipped\n" + VERTICES.replace("\n", " 1\n") + VERTICES),
            ("clipped-behind-a-triangle", "Only zbuf accepts clipped.", "T11", 5,
             VERTICES + "\nclipped\n" + VERTICES.replace("\n", " 1\n")),
            ("second-projection-of-another-kind", "There is one projection.", "T7a", 1,
             "frustum -1 1 -1 1 1 9\n" + VERTICES),
            ("projected-line", "A text that has been projected is not for this stage.", "T14", 1,
             "projected ortho -1 1 -1 1 1 9\n" + VERTICES)):
            yield refused(stage, name, why, paragraphs, at + line, header + text)
    for name, line in (("frustum-of-no-width", "frustum 1 1 -1 1 1 9"),
                       ("frustum-of-no-height", "frustum -1 1 1 1 1 9"),
                       ("frustum-near-0", "frustum -1 1 -1 1 0 9"),
                       ("ortho-of-no-depth", "ortho -1 1 -1 1 9 9"),
                       ("perspective-fovy-180", "perspective 180 1 1 9"),
                       ("perspective-near-0", "perspective 60 1 0 9"),
                       ("perspective-aspect-0", "perspective 60 0 1 9"),
                       ("perspective-unknown-rule", "perspective 60 1 1 9 square"),
                       ("ortho-with-a-rule", "ortho -1 1 -1 1 1 9 angle")):
        for stage, before in (("view", EYE), ("project", "")):
            yield refused(stage, name, "A header's projection obeys the rules of a scene's.", "T3 S7 S8",
                          before.count("\n") + 1, before + line + "\n" + VERTICES)
        if "perspective" not in name:
            yield refused("zbuf", name, "So does that of projected.", "T4 S7", 1,
                          f"projected {line}\n{VERTICES}")
    for name, why, line, text in (
        ("projected-perspective", "What was carried out is a frustum or an ortho.", 1,
         "projected perspective 60 1 1 9\n"),
        ("projected-alone", "projected goes on.", 1, "projected\n"),
        ("second-projected", "It stands once.", 2,
         "projected ortho 0 1 0 1 0 1\nprojected ortho 0 1 0 1 0 1\n"),
        ("eye-in-a-projected-text", "The camera has been used up.", 1, "eye 0 0 0\n"),
        ("look-in-a-projected-text", "The camera has been used up.", 1, "look 0 0 0\n"),
        ("up-in-a-projected-text", "The camera has been used up.", 1, "up 0 0 1\n"),
        ("frustum-not-projected", "So has the projection.", 1, "frustum -1 1 -1 1 1 9\n"),
        ("ortho-not-projected", "So has the projection.", 1, "ortho -1 1 -1 1 1 9\n"),
        ("attributes-w-behind-color", "w is the first column.", 1, "attributes color w\n"),
        ("clipped-with-a-word", "clipped stands alone.", 1, "clipped 3\n"),
        ("clipped-and-a-blank-line", "No blank line stands behind clipped.", 2, "clipped\n\n"),
        ("clipped-of-two-vertices", "clipped has three vertices.", 4, "clipped\n0 0 0 1\n1 0 0 1\n\n"),
        ("clipped-without-w", "The vertices of clipped always have w.", 2, "clipped\n0 0 0\n1 0 0\n0 1 0\n")):
        yield refused("zbuf", name, why, "T11" if "clipped" in name else "T4 T5 T14", line, text + VERTICES)
    for name in ("eye", "look", "up"):
        yield refused("project", f"{name}-alone", "A text with a part of a camera has not been through view.",
                      "T14", 1, f"{name} 0 0 1\n" + PERSPECTIVE + VERTICES)
    for name, other in (("eye", "look"), ("look", "eye")):
        yield refused("view", f"no-{name}", "All three parts of the camera are needed.", "V1", 3,
                      f"{other} 0 0 5\nup 0 1 0\n" + VERTICES)
    yield refused("view", "second-eye", "Each keyword stands once.", "T7", 4, EYE + "eye 0 0 5\n" + VERTICES)
    yield refused("view", "up-of-zero", "An up direction of 0 0 0 is none.", "S9 T2", 3,
                  EYE.replace("0 1 0", "0 0 0") + VERTICES)
    yield refused("view", "up-of-zero-that-an-option-replaces",
                  "The header obeys S9 whatever the options are.", "T2 S9",
                  3, EYE.replace("0 1 0", "0 0 0") + VERTICES, options="--up 0 1 0")
    yield Case("view", "no-projection", "Without a projection view passes none on.", "T3 V1", EYE + VERTICES)
    yield Case("view", "bare-with-numbers", "A bare text has no lines but vertices and blank ones.", "T17",
               EYE + "triangle 5\n" + VERTICES + "triangle 9\n" + VERTICES, options="--bare",
               needs="numbering", tier="bytes")
    yield Case("view", "bare-with-columns", "A bare text has no columns.", "T17",
               EYE + "framed\nattributes color\n" + VERTICES.replace("\n", " 1 2 3\n") + "end\n",
               options="--bare", needs="colors frames", tier="bytes")
    ball = "sphere\n0 0 -3 {}\n1 0 -3 {}\n0 1 -3 {}\n0 0 -2 {}\n\n"
    yield refused("view", "sphere-of-two-materials", "A sphere has one material.", "T26", 12,
                  EYE + "attributes material\n" + MATERIALS + ball.format(1, 1, 1, 0).replace("sphere",
                                                                                              "# c\nsphere"),
                  needs="spheres")
    yield refused("view", "sphere-with-a-normal", "A sphere has no normals.", "T26", 6,
                  EYE + "attributes normal\n" + ball.format(*["0 0 1"] * 4), needs="spheres")
    yield Case("view", "sphere-with-a-comment", "A comment parts no sphere.", "T26",
               EYE + "sphere\n# c\n" + ball.format("", "", "", "").removeprefix("sphere\n"),
               needs="spheres syntax")


def scenes():
    """Clauses about scenes alone."""
    for name, why, paragraphs, line, text in (
        ("vertex-color-above-255", "Colors end at 255.", "S16 S17", 7,
         "attributes color\ntriangle\n0 0 0 1 2 256\n1 0 0 1 2 3\n0 1 0 1 2 3\nend\n"),
        ("vertex-color-below-0", "Colors begin at 0.", "S16 S17", 7,
         "attributes color\ntriangle\n0 0 0 1 -2 6\n1 0 0 1 2 3\n0 1 0 1 2 3\nend\n"),
        ("second-ambient", "ambient stands once.", "S15a", 6, "ambient 1 1 1\nambient 1 1 1\nend\n"),
        ("second-attenuation", "attenuation stands once.", "S15a", 6,
         "attenuation 1 0 0\nattenuation 1 0 0\nend\n"),
        ("late-attributes", "attributes stand before the triangles.", "S15", 9,
         TRIANGLE + "attributes color\nend\n"),
        ("late-ambient", "So does ambient.", "S15", 9, TRIANGLE + "ambient 1 1 1\nend\n"),
        ("late-attenuation", "So does attenuation.", "S15", 9, TRIANGLE + "attenuation 1 1 1\nend\n"),
        ("late-light-behind-a-color", "Only color may stand late behind a color.", "S15", 10,
         "color 1 2 3\n" + TRIANGLE + "light 0 0 0 1 1 1\nend\n"),
        ("late-color-behind-normals", "attributes normal allows no late color.", "S15", 10,
         "attributes normal\ntriangle\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\ncolor 1 2 3\nend\n"),
        ("index-above-100", "An index ends at 100.", "S19b", 5, "material 1 1 1 1 0 100.5 1\nend\n"),
        ("index-below-0-01", "An index begins at 0.01.", "S19b", 5, "material 1 1 1 1 0 0.0099 1\nend\n"),
        ("reflectance-below-0", "A reflectance begins at 0.", "S19b", 5, "material 1 1 1 1 -0.1 1 1\nend\n"),
        ("material-alpha-above-1", "An alpha of a material ends at 1.", "S19b", 5,
         "material 1 1 1 1 0 1 1.5\nend\n"),
        ("material-of-three-numbers", "A material has four numbers or seven.", "S19", 5,
         "material 1 1 1\nend\n"),
        ("material-of-six-numbers", "A material has four numbers or seven.", "S19b", 5,
         "material 1 1 1 1 0 1\nend\n"),
        ("material-of-eight-numbers", "A material has four numbers or seven.", "S19b", 5,
         "material 1 1 1 1 0 1 1 1\nend\n"),
        ("ambient-factor-below-0", "Factors are not negative.", "S19", 5, "material -1 1 1 1\nend\n"),
        ("specular-factor-below-0", "Factors are not negative.", "S19", 5, "material 1 1 -1 1\nend\n"),
        ("shininess-2-to-the-64", "A shininess is below 2^64.", "S19", 5,
         "material 1 1 1 18446744073709551616\nend\n"),
        ("shininess-2-to-the-64-as-a-number", "A shininess is below 2^64.", "S19", 5,
         "material 1 1 1 1e20\nend\n"),
        ("attenuation-below-0", "Attenuation is not negative.", "S20", 5, "attenuation 1 -1 1\nend\n"),
        ("attenuation-last-below-0", "Attenuation is not negative.", "S20", 5, "attenuation 1 1 -1\nend\n"),
        ("background-below-0", "Colors begin at 0.", "S18", 5, "background 1 -2 3\nend\n"),
        ("background-alpha-below-0", "An alpha begins at 0.", "S18", 5, "background 1 2 3 -1\nend\n"),
        ("background-of-five-numbers", "A background has three numbers or four.", "S18", 5,
         "background 1 2 3 4 5\nend\n"),
        ("light-of-seven-numbers", "A light has six numbers.", "S21", 5, "light 1 2 3 1 1 1 1\nend\n"),
        ("use-without-a-number", "use names a material.", "S23", 6, "use\nend\n"),
        ("use-of-two-numbers", "use names one material.", "S23", 5, "use 0 0\nend\n"),
        ("use-1-without-a-material", "Without a material there is 0 alone.", "S23", 5, "use 1\nend\n"),
        ("use-minus-0", "A whole number has no sign.", "S23 S4", 5, "use -0\nend\n"),
        ("attributes-with-a-number", "attributes name columns alone.", "S16", 5, "attributes color 1\nend\n"),
        ("late-background-behind-a-sphere", "Nor behind a sphere.", "S15", 6,
         "sphere 0 0 0 1\nbackground 1 2 3\nend\n"),
        ("sphere-of-five-numbers", "A sphere has four numbers.", "S24", 5, "sphere 0 0 0 1 1\nend\n"),
        ("sphere-too-large", "X + R is finite.", "S24", 5, "sphere 1.7e308 0 0 1.7e308\nend\n"),
        ("light-out-of-range", "A light beyond the range of doubles is refused at its arguments.", "N4 M8",
         10, "scale 1e200 1 1\nscale 1e200 1 1\nlight\n\n# c\n1 0 0 1 1 1\nend\n"),
        ("sphere-out-of-range", "So is a sphere.", "N4 M10", 7,
         "scale 1e200 1 1\nscale 1e200 1 1\nsphere 1 0 0 1\nend\n"),
        ("z-out-of-range", "Any coordinate of a vertex.", "N4", 8,
         "scale 1 1 1e200\nscale 1 1 1e200\ntriangle\n0 0 -1\n1 0 0\n0 1 0\nend\n"),
        ("axis-of-tiny-zeros", "What is too small for a double is 0, in an axis, too.", "S3 S12", 5,
         "rotate 90 0 1e-400 0\nend\n")):
        needs = {"needs": "spheres"} if "sphere" in name else {}
        yield refused("model", name, why, paragraphs, line, CAMERA + text, **needs)
    for name, why, line, camera in (
        ("up-of-zero-and-no-look", "The up direction 0 0 0 comes first.", 3,
         "1 2 3\n1 2 3\n0 0 0\n60 1 1 9\n"),
        ("no-look-and-up-parallel", "Then the point looked at.", 2, "1 2 3\n1 2 3\n1 2 3\n60 1 1 9\n"),
        ("up-parallel-in-tiny-numbers", "Parallel is parallel at any size.", 3,
         "0 0 0\n1e-300 0 0\n1e300 0 0\n60 1 1 9\n")):
        yield refused("model", f"camera-{name}", why, "S9", line, camera + "end\n")
    for name, why, paragraphs, camera in (
        ("nearly-parallel", "Nearly parallel is not parallel.", "S9",
         "0 0 0\n0 0 -1\n1e-300 0 1\n60 1 1 9\n"),
        ("of-tiny-numbers", "The cross product is exact, where doubles would give 0.", "S9",
         "0 0 0\n1e-200 0 0\n0 1e-200 0\n60 1 1 9\n"),
        ("window-mirrored", "L may be greater than R, and B than T.", "S7",
         "0 0 0\n0 0 -1\n0 1 0\nfrustum 1 -1 1 -1 1 9\n"),
        ("ortho-mirrored", "L may be greater than R, and B than T.", "S7",
         "0 0 0\n0 0 -1\n0 1 0\northo 1 -1 1 -1 -3 -2\n"),
        ("fovy-nearly-180", "FOVY is below 180.", "S7",
         "0 0 0\n0 0 -1\n0 1 0\n179.99999999999997 9 1e-300 1e300\n"),
        ("angle-is-not-written", "angle is the default, and not written.", "S8 T3",
         "0 0 0\n0 0 -1\n0 1 0\n60 1 1 9 angle\n"),
        ("ratio-is-written", "ratio is written.", "S8 T3", "0 0 0\n0 0 -1\n0 1 0\n60 1 1 9 ratio\n"),
        ("whole-numbers-with-all-digits", "A whole number is written with all its digits.", "T20",
         "1152921504606846976 123456789012345677 -9007199254740993\n0 0 -1\n0 1 0\n60 1 1 9\n"),
        ("shortest-numbers", "With an exponent if that is shorter, and of two digits at least.", "T20",
         "100000 1000000 123000000\n0.0001 0.00001 0.00123\n-1e22 1e-7 1e300\n60 1 1 1e5\n")):
        yield Case("model", f"camera-{name}", why, paragraphs, camera + TRIANGLE + "end\n", tier="bytes",
                   needs="exactness projections")
    colored = "attributes color normal\ntriangle\n0 0 0 0.125 255 0 0 0 3\n" \
        "1 0 0 1 2.5 3 0 3 4\n0 1 0 4 5 6 8 0 6\n"
    for name, why, paragraphs, text, options in (
        ("colors-of-two-digits", "Colors and normals have as many decimals as coordinates.", "T19", colored,
         "--digits 2"),
        ("colors-of-no-digits", "And none if there are none.", "T19", colored, "--digits 0"),
        ("colors-exact", "With --digits exact they are in the shortest form.", "T20", colored,
         "--digits exact"),
        ("use-0-without-a-material", "Material 0 always is.", "S23", "use 0\n" + TRIANGLE, ""),
        ("late-color", "A color may stand behind triangles if one stood before.", "S15",
         "color 1 2 3\n" + TRIANGLE + "color 4 5 6\n" + TRIANGLE, ""),
        ("late-use", "use may stand anywhere.", "S15", MATERIALS + TRIANGLE + "use 1\n" + TRIANGLE, ""),
        ("shininess-of-2-to-the-53-and-1", "A shininess of digits alone is exact.", "S19 T20",
         "material 1 1 1 9007199254740993\n" + TRIANGLE, ""),
        ("shininess-of-0-as-a-number", "A shininess may be 0, however it is written.", "S19 T20",
         "material 1 1 1 0.0\n" + TRIANGLE, ""),
        ("shininess-below-2-to-the-64", "A shininess is below 2^64.", "S19 T20",
         "material 1 1 1 18446744073709551615\n" + TRIANGLE, ""),
        ("material-at-its-limits", "The limits belong to the ranges.", "S19b",
         "material 0 0 0 0 1 100 0\nmaterial 0 0 0 0 0 0.01 1\nabsorption 0 0 0\n" + TRIANGLE, ""),
        ("attributes-on-two-lines", "attributes may stand on the line after the keyword.", "S10 S16",
         "attributes\ncolor\ntriangle\n0 0 0 0 255 0\n1 0 0 0 255 0\n0 1 0 0 255 0\n", ""),
        ("colors-at-the-limits", "Both 0 and 255 are colors.", "S17 S18",
         "background 0 255 0\ncolor 255 0 255\n" + TRIANGLE, "")):
        yield Case("model", name, why, paragraphs, CAMERA + text + "end\n", options=options, tier="bytes",
                   needs="materials" if "use" in text else "colors" if "color" in name else "lights")


def beyond_doubles():
    """N4 and P11: what would be infinite."""
    view = "eye -1e308 0 0\nlook 0 0 0\nup 0 1 0\n"
    for name, why, line, text in (
        ("point-out-of-range", "A vertex beyond the range of doubles is refused at its line.", 5,
         "1 0 0\n1.5e308 0 0\n0 1 0\n"),
        ("light-out-of-range", "So is a light.", 4, "light 1.5e308 0 0 1 1 1\n" + VERTICES),
        ("word-behind-a-point-out-of-range", "A triangle is read before its points are moved.", 5,
         "1.5e308 0 1\n0 x 1\n0 1 1\n")):
        yield refused("view", name, why, "N4 S5a", line, view + text)
    narrow = "frustum -1e-300 1e-300 -1 1 1 9\n"
    for name, why, line, text in (
        ("point-out-of-range", "NDC beyond the range of doubles are refused at the vertex.", 3,
         narrow + "0 0 -2\n1e10 0 -2\n0 1 -2\n"),
        ("cut-out-of-range", "Those of a cut are refused at the corner with the largest weight.", 3,
         narrow + "0 0 -2\n0 1 -2\n1e12 0 2\n"),
        ("cut-out-of-range-by-the-third", "Which may be any.", 4, narrow + "0 0 -4\n0 1 -4\n1e12 0 0.0001\n"),
        ("cut-out-of-range-of-equal-weights", "Of equal weights the first counts.", 3,
         narrow + "0 0 -2\n0 1 -2\n1e12 0 0\n"),
        ("window-out-of-range", "With lights the window must be finite.", 2,
         "light 0 0 0 1 1 1\nperspective 179.9999999 1 1e308 1.5e308\n")):
        yield refused("project", name, why, "P11" if "window" in name else "N4 P9", line, text)
    yield Case("project", "window-beyond-doubles", "Without lights the window may be infinite.", "P11 P2",
               "perspective 179.9999999 1 1e308 1.5e308\n0 0 -1.1e308\n1e307 0 -1.2e308\n0 1e308 -1.3e308\n",
               needs="exactness")
    yield Case("project", "fovx-nearly-180", "fovX may be anything below 180 degrees.", "P2",
               "perspective 60 2.9999999 1 9\n" + VERTICES, needs="exactness")
    yield Case("project", "fovx-of-180-by-ratio", "The rule ratio has no limit.", "P2",
               "perspective 90 4 1 9 ratio\n" + VERTICES, needs="projections")
    light, cut = "light 1 2 3 1 1 1\n", "0 0 -2\n0 1 -2\n{} 0 1e13\n"
    yield Case("project", "light-and-cut-beyond-doubles",
               "clipped is not written where it would be infinite.", "P11",
               "frustum -1e-20 1e-20 -1 1 1 9\n" + light + cut.format("1e300"),
               needs="lights clipping exactness", options="--digits exact")
    yield Case("project", "light-and-cut-in-range", "It is written where it is finite, however large.",
               "P11 T11 T20", "frustum -1e-20 1e-20 -1 1 1 9\n" + light + cut.format("1e280"),
               needs="lights clipping exactness", options="--digits exact")
    yield Case("project", "w-of-cuts", "Each cut has its own w.", "P9 T5a T20",
               "perspective 90 1 1 9\nattributes color\n0 0 -2 1 2 3\n0 1 -7 4 5 6\n1 0 3 7 8 9\n\n"
               "0 0 3 1 2 3\n0 1 -7 4 5 6\n1 0 3 7 8 9\n", options="--clip frustum --clip-inset 0.1",
               needs="colors clipping numbering exactness")
    for mode in ("near", "frustum", "reject"):
        yield Case("project", f"clip-inset-0-3-{mode}",
                   "The inset is the double, in all modes that cut or drop.", "P6",
                   "perspective 90 1 1 9\n0.5 0 -1.2\n0 1.9 -2\n-8 0 -8.5\n\n"
                   "0.1 0 -1.1\n0.2 0 -1.1\n0 0.1 -1.2\n",
                   options=f"--clip {mode} --clip-inset 0.3 --digits 17", tier="bytes",
                   needs="clipping numbering exactness")
    yield Case("project", "near-by-1024", "auto cuts nothing whose distances are at least NEAR / 1024.", "P7",
               "perspective 90 1 1 9\n0.0009765625 0 -0.0009765625\n0 1 -2\n-1 0 -2\n\n"
               "0.0009765625 0 -0.0009765624\n0 1 -2\n-1 0 -2\n", needs="clipping numbering")


def cameras():
    """V1, P1 and S5b: the camera of options, of a scene and of the header."""
    scene, at = "# c\n1 2 9\n1 0 0\n\n0 1 2\n90 1.5 2 30 ratio\nend\n", "--scene scene.txt"
    for name, why, stage, text, options in (
        ("scene-alone", "The whole camera may be that of a scene.", "view", "", at),
        ("scene-before-header", "Its parts go before the header's.", "view", HEADERS["view"], at),
        ("eye-before-scene", "A part of the options goes before that of the scene.", "view", HEADERS["view"],
         at + " --eye 3 -4 5"),
        ("two-parts-before-scene", "The others are its own.", "view", "", "--up 1 0 0 --look 3 3 3 " + at),
        ("projection-before-scene", "So with the projection.", "view", "", at + " --ortho -4 4 -3 3 1 9"),
        ("eye-before-header", "The other parts are the header's.", "view", HEADERS["view"], "--eye 1 2 3"),
        ("scene-alone", "The projection may be that of a scene.", "project", "", at),
        ("scene-before-header", "It goes before the header's.", "project", HEADERS["project"], at),
        ("option-before-scene", "That of an option goes before both.", "project", HEADERS["project"],
         at + " --frustum -1 2 -1 1 1 9"),
        ("aspect-before-scene", "--aspect goes before the word in the scene.", "project", "",
         "--aspect angle " + at)):
        yield Case(stage, f"camera-{name}", why, "V1" if stage == "view" else "P1", text + VERTICES,
                   options=options, scene=scene if "--scene" in options else "")
    for name, why, paragraphs, stage, line, text, options, scene in (
        ("look-that-is-an-options-eye", "The part at fault is the header's.", "V1 S9", "view", 2, EYE,
         "--eye 0 0 0", ""),
        ("up-along-an-options-eye", "The part at fault is the header's.", "V1 S9", "view", 3, EYE,
         "--eye 0 3 0", ""),
        ("up-of-a-scene-along-an-options-eye", "The line is one of the scene.", "V1 S5b", "view", 5, "",
         at + " --eye 1 1 2", scene),
        ("scene-with-a-word", "The line is one of the scene.", "S5b", "view", 3, EYE, at,
         scene.replace("1 0 0", "1 x 0")),
        ("scene-of-fovx-180", "The line is one of the scene.", "P2 S5b", "project", 6, PERSPECTIVE, at,
         scene.replace("1.5 2 30 ratio", "2 1 9"))):
        yield refused(stage, name, why, paragraphs, line, text + VERTICES, options=options, scene=scene)


GRIDS = (lights, depths_of_ends, numbers_in_words, headers, scenes, cameras, beyond_doubles)
