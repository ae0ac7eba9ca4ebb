"""More cases of zbuf: its two outputs, what the assignment leaves open, colors and light."""
from parts.zbuf_cases import TIE, case, config, flat, pixels, triangle


def text_and_file():
    corners = [(-0.83, -0.77), (0.87, -0.31), (-0.13, 0.91)]
    for name, z in {"down": 0.0078125, "up": 0.0234375, "negative": -0.0078125, "carry": 0.9999996}.items():
        yield case(f"depth-ties-{name}", "Depths have 6 decimals; a tie is rounded to the even digit.",
                   "T23 T19", flat(corners, z), tier="bytes")
    yield case("depth-ties-just-above", "Just above a tie is no tie.", "T23 T19",
               flat(corners, 9).replace(" 9\n", " 0.00781250001\n"), tier="bytes")
    yield case("depth-zero-has-no-sign", "Zero, and what is rounded to it, has no sign.", "T23 T19",
        flat(corners, -0.0000004) + flat([(x, y) for y, x in corners], 0.1), tier="bytes")
    for width in range(1, 7):
        yield case(f"picture-rows-of-{width}", "The rows of a BMP file are filled to a multiple of 4 bytes.",
                   "T24", flat([(-3, -0.9), (3, -0.7), (0.1, 0.9)]), config(width, 3), tier="bytes",
                   open="Colors are free, and so is the size of a picture file's header.")
    for count in (1, 4):
        text = "".join(
            pixels([(0.3 + i, 0.4), (6.1, 2.2 + i), (1.7, 7.1 - i)], z=0.5 - 0.1 * i) for i in range(count))
        yield case(f"colors-of-{count}", "Colors come from the generator: three draws a triangle.", "Z10",
                   text, tier="bytes", open="The colors of triangles may be any.")
    yield case("colors-of-hidden-triangles", "Triangles that are not seen have their draws, too.", "Z10",
               flat(corners, 5) + flat([(5, 5), (6, 5), (5, 6)]) + flat(corners, 0.5), tier="bytes",
               open="The colors of triangles may be any.")
    usual = triangle((-0.83, -0.77, 0.1), (0.87, -0.31, 0.5), (-0.13, 0.91, 0.9))
    for name, numbers in {
            "exponents":
                "-8.3e-1 -77E-2 1e-1\n+87e-2 -3.1e-1 5e-1\n-.13e0 9.1E-1 .9e+0\n\n",
            "many-digits":
                "-0.830000000000001 -0.77 0.1\n0.87 -0.3100000000000000001 0.5\n-0.13 0.91 "
                "0.900000000000000000000\n\n",
            "plus-signs":
                "-0.83 -0.77 +0.1\n+0.87 -0.31 +.5\n-.13 +.91 +0.9\n\n"}.items():
        yield case(f"numbers-{name}", "Numbers may be written in all the ways in which programs write them.",
                   "S3", numbers)
    yield case("numbers-of-the-config", "The config's numbers, too.", "S3 C2", usual,
               "8 8\n-1e0\n-10E-1\n-1.0e+0 +1\n")
    for name, why, paragraphs, text, file in (
        ("carriage-returns", "Lines may end in CR LF, in both files.", "S1", usual.replace("\n", "\r\n"),
         config().replace("\n", "\r\n")), ("comments", "Comments do not count, in both files.", "S1",
                                           "# c\n" + usual.replace("0.1\n", "0.1 # c\n# c\n"),
                                           "# a config\n8 8 # pixels\n\n-1 # left\n-1\n# c\n-1 1\n"),
        ("no-blank-lines", "No blank line need stand between triangles.", "T8", (usual * 2).replace(
            "\n\n", "\n"),
         config()), ("several-blank-lines", "More than one may.", "S1 T8", "\n\n" + usual + "\n\n" + usual,
                     config()), ("no-line-feed-at-the-end", "The last line may lack its line feed.", "S1",
                                 usual.rstrip("\n"), config().rstrip("\n")),
        ("size-alone", "A config of a size alone has the limits -1, -1 and -1 to 1.", "C2", usual, "8 8\n")):
        yield case(f"lines-{name}", why, paragraphs, text, file, needs="syntax")


def left_open_by_the_assignment():
    equal, area = ("Which of two equal depths stays is free.",
                   "A triangle without area may have pixels or none.")
    a, b = [(1.2, 1.3), (6.7, 2.1), (2.3, 6.8)], [(6.9, 1.1), (1.3, 2.4), (5.2, 7.1)]
    for name, text in {
        "two": pixels(a, z=0.25) + pixels(b, z=0.25),
        "two-turned": pixels(b, z=0.25) + pixels(a, z=0.25),
        "the-same-twice": pixels(a) * 2,
        "behind-a-nearer": pixels(a, z=0.5) + pixels(b, z=0.5) + pixels(a, z=0.25),
        "sharing-an-edge": pixels([(1.2, 1.3), (6.7, 2.1), (2.3, 6.8)]) + pixels([(6.7, 2.1), (7.2, 6.3),
                                                                                  (2.3, 6.8)]),
        "three": pixels(a) + pixels(b) + pixels([(0.4, 0.3), (7.5, 3.1), (0.6, 7.4)]),
    }.items():
        yield case(f"equal-depths-{name}", "Of equal depths the first stays.", "Z8", text, open=equal)
    for name, corners in {"horizontal": [(1.2, 3.5), (6.7, 3.5), (2.3, 3.5)],
                          "vertical": [(3.3, 1.2), (3.3, 6.7), (3.3, 2.3)],
                          "diagonal": [(1, 1), (6, 6), (3, 3)], "point": [(3.5, 3.5)] * 3,
                          "two-corners-alike": [(1.2, 1.3), (6.7, 5.1), (6.7, 5.1)],
                          "point-beside-a-center": [(3.2, 3.1)] * 3}.items():
        yield case(
            f"without-area-{name}",
            "A triangle without area has no pixel under `center`; under `nearest` each row has those from "
            "end to end.",
            "Z3 Z5", pixels(corners), open=area)
    tenths = [(1.5, 1.5), (7.5, 1.5), (1.5, 7.5)]
    for name, corners in {
        "tenths": tenths,
        "tenths-turned": tenths[::-1],
        "tenths-slanted": [(0.5, 0.5), (9.5, 3.5), (3.5, 9.5)],
    }.items():
        yield case(
            f"ends-between-{name}",
            "Ends and centers at tenths, which no double is: doubles decide under `nearest`, and `center` "
            "is exact.",
            "Z1 Z2 Z6", pixels([(x + 0.5, y) for x, y in corners],
                               10), config(10, 10), open_nearest=TIE, needs="exactness")


def extensions():
    usual, two = pixels([(1.2, 1.3), (6.7, 2.1), (2.3, 6.8)]), pixels([(6.9, 1.1), (1.3, 2.4), (5.2, 7.1)],
                                                                      z=-0.5)
    yield case("numbers-choose-colors", "A triangle's number chooses its color.", "T10 Z10",
               "triangle 3\n" + usual + "triangle 9\n" + two, needs="numbering", tier="bytes")
    yield case("pieces-of-one-triangle", "Pieces of a cut triangle have one color.", "T10 Z10",
               usual + "triangle 0\n" + two + "triangle 4294967295\n" + pixels([(0, 7), (8, 7),
                                                                                (4, 8)]), needs="numbering")
    yield case("framed", "A framed text ends with end.", "T6b T13", "framed\n" + usual + "end\n",
               needs="frames")
    yield case("framed-option", "--expect-framed insists on a framed text.", "T15",
               "framed\n" + usual + "end\n", needs="frames", options="--expect-framed")
    for count in (2, 3):
        yield case(f"samples-{count}", "A pixel is the mean of its samples, a depth that of its center.",
                   "Z12", usual + two, options=f"--samples {count}")
    yield case("rows", "Some rows alone are drawn.", "Z13", usual + two, options="--rows 2:5")
    colored = "attributes color\n-0.83 -0.77 0.1 255 0 0\n0.87 -0.31 0.5 0 255 0\n-0.13 0.91 0.9 0 0 255\n"
    for name, why, paragraphs, text in (
        ("one-color", "A triangle has the color of its corners, not a paint.", "L4a Z10",
         "attributes color\nmaterial 1 1 0 1\npaint 1 2 3\n" + usual.replace("\n", " 200 100 50\n", 3)),
        ("three-colors", "Between corners of different colors the color is their mean.", "L3 L4a",
         colored), ("colors-with-w", "With w the mean is taken in space, not on the screen.", "L2 L3",
                    colored.replace("attributes", "attributes w").replace("0.1 255", "0.1 1 255").replace(
                        "0.5 0", "0.5 4 0").replace("0.9 0", "0.9 9 0")),
        ("w-of-3e21", "A corner that is much nearer has all the weight, but on the far edge.", "L3 L7",
         "attributes w color\n-0.0625 -0.5 0.5 1e21 255 0 0\n0.8125 2.25 0.5 3e21 0 255 0\n"
         "-0.75 -1 0.5 1 0 0 255\n"),
        ("background", "Pixels without a triangle have the background's color.", "Z10 T6",
         "background 10 20 30\n" + usual), ("opaque-background", "An alpha of 255 changes nothing.",
                                            "Z11 S18", "background 10 20 30 255\n" + usual),
        ("fractions-of-colors", "Colors are rounded to whole numbers, halves up.", "L6",
         "background 0.5 1.5 2.49\nattributes color\n" + usual.replace("\n", " 200.6 100.49 0.51\n", 3)),
        ("colors-and-depth", "The nearer color is seen.", "Z8 L4a",
         "attributes color\n" + (usual + two.replace("\n", " 9 8 7\n", 3)).replace("\n", " 1 2 3\n", 3))):
        yield case(f"colored-{name}", why, paragraphs, text,
                   needs="colors alpha" if "opaque" in name else "colors")
    lit = ("projected frustum -1 1 -1 1 1 9\n{}light 2 3 1 1 0.9 0.8\nambient 0.12 0.13 0.14\nmaterial 1 "
           "0.8 0.5 8\n", "-0.83 -0.77 0.1", "0.87 -0.31 0.5", "-0.13 0.91 0.9")
    for shading in ("none", "flat", "gouraud", "phong"):
        text = lit[0].format("attributes w color normal\n") + "".join(f"{p} {rest}\n" for p,
            rest in zip(lit[1:], ("2 250 40 30 0 0 1", "3 40 200 60 0.6 0 0.8", "5 30 60 220 0 0.6 0.8")))
        yield case(f"lit-{shading}", f"--shading {shading} on a triangle of three colors and normals.",
                   "L1 L4a L5", text, needs="lights colors", options=f"--shading {shading}")
        two = lit[0].format("attributes w normal material\n").replace(
            "material 1 0.8", "material 1 1 0 1\nmaterial 1 0.8") +"".join(
                f"{p} {rest} {k}\n" for k, xs in ((1, lit[1:]),
                                                  (0, ("-0.9 0.9 0.2", "-0.9 -0.1 0.2", "0.1 0.9 0.2")))
                for p, rest in zip(xs, ("2 0 0 1", "3 0.6 0 0.8", "5 0 0.6 0.8")))
        yield case(f"lit-materials-{shading}", f"--shading {shading} on triangles of two materials.",
                   "L4a L5 T9", two, needs="lights materials", options=f"--shading {shading}")
    plain_lit = lit[0].format("") + "\n".join(lit[1:]) + "\n"
    painted = two.replace("material 1 0.8 0.5 8\n", "material 1 0.8 0.5 8\npaint 200 100.5 0\n")
    yield case("lit-paint", "The color of a triangle is its material's paint, and white without one.",
               "Z10 L4a L5", painted, needs="lights materials")
    yield case("paint", "So it is without light.", "Z10 L4a",
               "".join(line + "\n" for line in painted.splitlines() if line.split()[0] not in
                       ("light", "ambient", "projected")), needs="materials")
    yield case(
        "lit-glass", "Glass is drawn as if it were none.", "S19d L5",
        plain_lit.replace("material 1 0.8 0.5 8\n", "material 1 0.8 0.5 8 0.5 1.5 0.25\nabsorption 1 2 3\n"),
        needs="lights optics")
    odd = lit[0].format("attributes color\n").replace("light 2 3 1 1 0.9 0.8", "light 2 3 1 0 0 0")
    yield case(
        "lit-halves", "Halves go up, and a flat triangle has one color.", "L1 L4a L6 L7",
        odd.replace("0.12 0.13 0.14", "0.5 0.5 0.5") + "".join(
            f"-0.9 {y} 0 {color}\n0.9 {y} 0 {color}\n0.1 {y + 0.6} 0.25 {color}\n"
            for y, color in ((-0.9, "101 33 77"), (-0.6, "7 99 251"), (0.5, "1 3 5"), (0.75, "55 155 253"))),
        needs="lights colors")
    for name, why, text in (("by-its-plane", "Without normals a triangle is lit by its plane.",
                             plain_lit), ("from-behind", "A light behind the surface gives it none.",
                                          plain_lit.replace("light 2 3 1", "light 0 0 -30")),
                            ("by-two-lights", "Lights add up, and channels end at 255.",
                             plain_lit.replace("light 2", "light -2 0 0 2 2 2\nlight 2")),
                            ("with-attenuation", "Light falls off with distance.",
                             "attenuation 1 0.25 0.125\n" + plain_lit), ("under-ortho",
                                                                         "Under ortho the eye is far away.",
                                                                         plain_lit.replace(
                                                                             "frustum", "ortho")),
                            ("in-color", "The color of the material is that of the triangle.",
                             plain_lit.replace("light", "attributes w color\nlight",
                                               1).replace("0.1\n0", "0.1 2 255 128 0\n0").replace(
                                                   "0.5\n-", "0.5 3 255 128 0\n-").replace(
                                                       "0.91 0.9\n", "0.91 0.9 5 255 128 0\n")),
                            ("as-the-whole-triangle", "A piece is lit as the uncut triangle would be.",
                             plain_lit.split("-0.83")[0] + "clipped\n-3 -3 2 1\n3 -1 2 4\n-0.5 3 1 3\n\n" +
                             "\n".join(lit[1:]) + "\n"), ("without-specular", "Diffuse light alone.",
                                                          plain_lit.replace("0.8 0.5 8", "0.8 0 1")),
                            ("by-ambient-alone", "Ambient light alone.",
                             plain_lit.replace("1 0.8 0.5 8", "1 0 0 1"))):
        yield case(f"lit-{name}", why, "L1 L2 L5", text, needs="lights")


GRIDS = (text_and_file, left_open_by_the_assignment, extensions)
