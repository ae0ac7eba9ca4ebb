"""Random scenes that use everything a scene can say, and random options for the four stages."""

SNAPPED_CAMERA = "0 0 5\n0 0 0\n0 1 0\northo -1 1 -1 1 1 9"
ROUND_ANGLES = ("90", "-90", "180", "45", "-30", "120", "360", "60")


def number(rng, limit):
    """A number as text: often round, sometimes tiny or large, sometimes written in an unusual way."""
    kind = rng.random()
    if kind < 0.05:
        return "%g" % (rng.uniform(-1, 1) * 10**rng.randint(-6, 4))
    if kind < 0.1:
        return rng.choice(("+1.5", ".5", "2.", "-0", "1e0", "25E-1", "0.1", "-.25"))
    return "%.*f" % (rng.choice((0, 0, 1, 2, 6, 9)), rng.uniform(-limit, limit))


def numbers(rng, count, limit=6):
    return " ".join(number(rng, limit) for _ in range(count))


def positive(rng, count, limit):
    return " ".join("%.*f" % (rng.choice((0, 1, 3)), rng.uniform(0, limit)) for _ in range(count))


def camera(rng):
    eye, look, up = rng.choice(((numbers(rng, 3), numbers(rng, 3), numbers(
        rng, 3)), ("0 0 %d" % rng.randint(2, 9), "0 0 0", "0 1 0"), ("0 %d 0" % rng.randint(2, 9), "0 0 0",
                                                                     "0 0 -1")))
    return [eye, look, up, projection(rng)]


def projection(rng):
    kind = rng.choice(("perspective",) * 6 + ("ortho", "frustum"))
    if kind == "perspective":
        rule = rng.choice(("", "", " angle", " ratio"))
        fov_y = rng.choice(("90", "60", "45", "%g" % rng.uniform(5, 120)))
        return "%s %s %s %s" % (fov_y, rng.choice(
            ("1", "1.25", "%g" % rng.uniform(0.3, 1.45))), rng.choice(
                ("0.01", "0.1", "1", "2.5")), rng.choice(("10", "100", "1e4"))) + rule
    return kind + rng.choice((" -3 4 -2.5 2 0.5 20", " -1 1 -1 1 1 10", " 2 -1.5 -1 1 0.7 30"))


def transform(rng):
    return rng.choice(
        (lambda: "translate\n" + numbers(rng, 3, 3), lambda: "scale " + numbers(rng, 3, 2),
         lambda: "scale\n-1 1 1", lambda: "rotate\n%s %s 1 %s" % (rng.choice(
             (*ROUND_ANGLES, number(rng, 400))), number(rng, 2), number(rng, 2)), lambda: "rotate %s %s" %
         (rng.choice(ROUND_ANGLES), rng.choice(("0 0 1", "1 0 0", "1 1 1", "3 0 -4")))))()


def looks(rng, has_light):
    """The lines of color and light, and whether vertex lines have colors and normals; `color` may come later
    if any has."""
    lines, columns = [], rng.choice(((), (), ("color",), ("normal",), ("color", "normal")))
    if rng.random() < 0.4:
        lines.append("background " + positive(rng, 3, 255))
    if columns:
        lines.append("attributes " + " ".join(columns))
    has_color = "color" in columns or rng.random() < 0.3
    if has_color and "color" not in columns:
        lines.append("color " + positive(rng, 3, 255))
    if has_light:
        lines += ["ambient " + positive(rng, 3, 0.5)] * rng.randint(0, 1)
        shininess = rng.choice(("0", "1", "5", "40", "16.0", "1e1"))
        lines += ["material %s %s" % (positive(rng, 3, 1.2), shininess)] * rng.randint(0, 1)
        lines += ["attenuation 1 " + positive(rng, 2, 0.2)] * rng.randint(0, 1)
        lines += ["light %s %s" % (numbers(rng, 3, 9), positive(rng, 3, 1)) for _ in range(rng.randint(1, 3))]
        if rng.random() < 0.4:
            lines += ["material %s %s" % (positive(rng, 3, 1.2), shininess) for _ in range(rng.randint(1, 3))]
    rng.shuffle(lines)
    for i in [i for i, line in enumerate(lines) if line.startswith("material")]:
        if rng.random() < 0.3:
            lines[i] += " %s %s %s" % (rng.choice(("0", "0.25", "1")), rng.choice(
                ("1", "1.5", "0.75")), rng.choice(("1", "0", "0.5")))
        if rng.random() < 0.2:
            lines[i] += "\nabsorption " + positive(rng, 3, 2)
        if rng.random() < 0.3:
            lines[i] += "\npaint " + positive(rng, 3, 255)
    return lines, columns, has_color


def vertex(rng, columns):
    words = [numbers(rng, 3, rng.choice((2, 6)))]
    if "color" in columns:
        words.append(positive(rng, 3, 255))
    if "normal" in columns:
        words.append("%s %s 1" % (number(rng, 1), number(rng, 1)))
    return " ".join(words)


def snapped(rng):
    """A scene whose vertices lie on the pixel centers and corners of 8 x 8 pixels, at few depths."""
    lines = [SNAPPED_CAMERA]
    for _ in range(rng.randint(2, 14)):
        lines.append("triangle")
        z = rng.choice(("0", "1", "4", "-4", None))
        step = rng.choice((1, 2, 2))  # 2: from center to center of 8 x 8 pixels
        xs, ys = ([rng.randrange(-9, 10, step) / 8 for _ in range(3)] for _ in "xy")
        ys[1] = ys[rng.randint(0, 1)]  # often horizontal
        lines += ["%g %g %s" % (x, y, z or rng.choice(("0", "4", "-4", "2"))) for x, y in zip(xs, ys)]
    return "\n".join(lines + ["end", ""])


def scene(rng, count=None):
    """The text of a scene that is right, of so many commands behind the lights; without `count` of a few, or
    snapped."""
    if not count and rng.random() < 0.25:
        return snapped(rng)
    lines = camera(rng)
    lines += [transform(rng)] * rng.randint(0, 1)
    more, columns, has_color = looks(rng, rng.random() < 0.4) if rng.random() < 0.6 else ([], (), False)
    lines += more
    depth, materials = 0, sum(line.startswith("material") for line in lines)
    for _ in range(count or rng.randint(3, 24)):
        command = rng.choice(("triangle",) * 5 +
                             ("transform", "transform", "push", "pop", "color", "again", "use"))
        if command == "triangle":
            corners = [vertex(rng, columns) for _ in range(3)]
            lines.append("triangle\n" + "\n".join(corners))
        elif command == "again" and lines[-1].startswith("triangle"):
            lines.append(lines[-1])  # equal depths everywhere
        elif command == "transform":
            lines.append(transform(rng))
        elif command == "push" or command == "pop" and depth:
            depth += 1 if command == "push" else -1
            lines.append(command)
        elif command == "color" and has_color:
            lines.append("color " + positive(rng, 3, 255))
        elif command == "use" and materials:
            lines.append("use %d" % rng.randrange(materials))
    text = "\n".join(lines + ["end", ""])
    return untidy(rng, text) if rng.random() < 0.3 else text


def untidy(rng, text):
    """The same scene with comments, blank lines, tabs and CRLF."""
    lines = []
    for line in text.split("\n")[:-1]:
        lines += [""] * (rng.random() < 0.1) + ["# a comment"] * (rng.random() < 0.1)
        lines.append(" " * rng.randint(0, 1) + line.replace(" ", rng.choice((" ", "\t", "  "))) +
                     rng.choice(("", "", " ", " # c", "\t")))
    return rng.choice(("\n", "\r\n")).join(lines) + rng.choice(("", "\n"))


def deep_triangle(rng, size):
    """A triangle in NDC as text, |z| up to `size`: any, narrow, seen edge-on, with a tiny x, or with corners
    on the pixel centers of 8 x 8 pixels."""
    width, left = rng.choice((2, 2, 2, 1e-3, 1e-9, 1e-14, 0)), rng.uniform(-1, 0.5)
    corners = [(left + rng.uniform(0, width), rng.uniform(-1.2, 1.2)) for _ in range(3)]
    if width == 2 and rng.random() < 0.3:
        corners = [(rng.randrange(-7, 8) / 8, rng.randrange(-7, 8, 2) / 8) for _ in range(3)]
    if width == 2 and rng.random() < 0.3:
        corners[0] = (rng.uniform(0, 1e-200), rng.uniform(-1.2, 1.2))
    form = rng.choice(("%.7f", "%.9f", "%r", "%r"))
    return "".join(" ".join(form % p for p in (*corner, rng.uniform(-size, size))) + "\n"
                   for corner in corners) + "\n"


def config(rng, scene_text):
    """A small screen; for a snapped scene one on whose pixel centers its vertices lie."""
    if SNAPPED_CAMERA in scene_text:
        return rng.choice(("8 8", "24 8", "8 24")) + rng.choice(("\n", "\n-1\n-1\n0 1\n"))
    size = "%d %d" % (rng.randint(6, 24), rng.randint(6, 20))
    return size + rng.choice(("\n", "\n", "\n-1\n-1\n0 1\n", "\n-1\n-0.75\n-0.9 1\n", "\n-1.5\n-1\n0 1.5\n",
                              "\n-1\n-1\n-1 1", "\n-0.3333333\n-0.7\n-1 0.99\n"))


def options(rng):
    """For the four stages."""
    digits = rng.choice((["--digits", "exact"], [], [], ["--digits", str(rng.randint(2, 12))]))
    of_model = digits + rng.choice(([], ["--framed"]))
    clip = rng.choice((["auto"], ["auto"], ["near"], ["frustum"], ["reject"], [
        "frustum", "--clip-inset", "0.1"], ["none"]))
    of_project = digits + ["--clip", *clip] + rng.choice(([], [], ["--cull", "back"], ["--cull", "front"]))
    of_project += rng.choice(([], [], ["--aspect", "ratio"]))
    of_zbuf = [
        "--coverage",
        rng.choice(("nearest", "center")), "--algorithm",
        rng.choice(("zbuffer", "scanline"))]
    return {"model": of_model, "view": digits, "project": of_project, "zbuf": of_zbuf}


def shading(rng):
    """For zbuf and a text with lights."""
    return rng.choice(([], ["--shading", rng.choice(("none", "flat", "gouraud", "phong"))]))
