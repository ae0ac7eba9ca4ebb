"""The four stages as a student writes them, in plain doubles, with each of the mistakes of
tests/conformance/mistakes.txt, and those habits of habits.txt that give another output.

They tell which of these a case of the conformance pack catches; no expected value comes from here.
"""
import math
import struct

OTHER_FORMULAS = "zbuf/other formulas"
IDENTITY = [[float(i == j) for j in range(4)] for i in range(4)]


def product(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def transposed(a):
    return [list(column) for column in zip(*a)]


def moved(m, p):
    return [sum(a * b for a, b in zip(row, (*p, 1.0))) for row in m]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit(v):
    return [x / math.hypot(*v) for x in v]


def with_offset(rows, offset=(0, 0, 0)):
    return [[*row, x] for row, x in zip(rows, offset)] + [[0.0, 0.0, 0.0, 1.0]]


def translation(offset):
    return with_offset([row[:3] for row in IDENTITY[:3]], offset)


def rotation(angle, axis, mistake):
    a = axis if mistake == "model/axis-not-normalized" else unit(axis)
    angle = angle if mistake == "model/angle-in-radians" else math.radians(angle)
    angle = -angle if mistake == "model/angle-negated" else angle
    c, s = math.cos(angle), math.sin(angle)
    columns = []
    for x in [row[:3] for row in IDENTITY[:3]]:
        along = (1 - c) * sum(p * q for p, q in zip(a, x))
        columns.append([c * p + along * q + s * t for p, q, t in zip(x, a, cross(a, x))])
    rows = transposed(columns)
    if mistake == "model/rotation-element-from-the-wrong-column":
        rows[0][2] = rows[0][1]
    return with_offset(columns if mistake == "model/rotation-transposed" else rows)


def stage_text(points):
    return "".join(" ".join(f"{x:.7f}" for x in p) + "\n" * (1 + (i % 3 == 2)) for i, p in enumerate(points))


def vertices(text):
    return [[float(word) for word in line.split()] for line in text.splitlines() if line.strip()
            and not line[0].isalpha()]


def model(scene, mistake=None):
    words = iter(scene.split()[13:])

    def numbers(count):
        return [float(next(words)) for _ in range(count)]

    m, saved, points, last = IDENTITY, [], [], None
    for word in words:
        t = None
        if word == "triangle":
            points += [moved(m, numbers(3))[:3] for _ in range(3)]
        elif word == "translate":
            t = translation(numbers(3))
        elif word == "scale":
            sx, sy, sz = numbers(3)
            t = with_offset([[sx, 0.0, 0.0], [0.0, sy, 0.0], [0.0, 0.0, sz]])
        elif word == "rotate":
            angle, *axis = numbers(4)
            t = rotation(angle, axis, mistake)
        elif word == "push" and mistake != "model/push-and-pop-ignored":
            saved = [] if mistake == "model/push-does-not-nest" else saved
            if not (mistake == "model/second-push-lost" and last == "push"):
                saved.append(m)
            m = IDENTITY if mistake == "model/push-of-the-identity" else m
        elif word == "pop" and mistake not in ("model/push-and-pop-ignored", "model/pop-ignored") and saved:
            m = saved.pop()
            m = IDENTITY if mistake == "model/pop-to-the-identity" else m
        if t:
            m = product(t, m) if mistake == "model/multiplied-on-the-left" else product(m, t)
        last = word
    return stage_text(points)


def camera(header):
    """The numbers behind each keyword of a header."""
    lines = [line.split() for line in header.splitlines() if line[:1].isalpha()]
    return {line[0]: [float(word) for word in line[1:]] for line in lines}


def view(text, mistake=None):
    numbers = camera(text)
    eye, look, up = numbers["eye"], numbers["look"], numbers["up"]
    eye, look = (look, eye) if mistake == "view/eye-and-look-exchanged" else (eye, look)
    up = {"view/up-is-a-point": [b - a for a, b in zip(eye, up)], "view/up-is-0-1-0": [0.0, 1.0,
                                                                                       0.0]}.get(mistake, up)
    l = look if mistake == "view/look-is-a-direction" else [b - a for a, b in zip(eye, look)]
    l = l if mistake == "view/l-not-unit" else unit(l)
    r = cross(up, l) if mistake == "view/r-is-up-cross-l" else cross(l, up)
    r = r if mistake == "view/r-not-unit" else unit(r)
    u = cross(
        l, r) if mistake == "view/u-is-l-cross-r" else up if mistake == "view/up-as-given" else cross(r, l)
    turn = with_offset([r, u, l if mistake == "view/l-not-negated" else [-x for x in l]])
    turn = transposed(turn) if mistake == "view/rotation-transposed" else turn
    sign = {"view/eye-added": 1, "view/no-translation": 0}.get(mistake, -1)
    shift = translation([sign * x for x in eye])
    m = product(shift, turn) if mistake == "view/translation-after-rotation" else product(turn, shift)
    m = transposed(m) if mistake == "view/matrix-transposed" else m
    return stage_text([moved(m, p)[:3] for p in vertices(text)])


def project(text, mistake=None):
    fov, aspect, near, far = camera(text)["perspective"]

    def window(angle):
        angle = angle if mistake == "project/fov-in-radians" else math.radians(angle)
        return near * math.tan(angle if mistake == "project/fov-not-halved" else angle / 2)

    t = window(fov)
    fov_x = {"project/fovx-equals-fovy": fov,
             "project/fovx-divided-by-aspect": fov / aspect}.get(mistake, fov * aspect)
    r = t * aspect if mistake == "project/r-is-t-times-aspect" else window(fov_x)
    r, t = (t, r) if mistake == "project/r-and-t-swapped" else (r, t)
    x_scale, y_scale = near / r, near / t
    near, far = (far, near) if mistake == "project/near-and-far-swapped" else (near, far)
    two, sign = 1 if mistake == "project/missing-two" else 2, -1 if mistake == "project/z-row-sign" else 1
    m = [[x_scale, 0, 0, 0], [0, y_scale, 0, 0],
         [0, 0, -sign * (far + near) / (far - near), -sign * two * far * near / (far - near)],
         [
             0, 0, 1 if mistake == "project/w-is-plus-z" else -1,
             1 if mistake == "project/last-element-is-one" else 0]]
    m = transposed(m) if mistake == "project/matrix-transposed" else m
    points = [moved(m, p) for p in vertices(text)]
    if mistake == "project/depth-from-0-to-1":
        points = [(x, y, (z + w) / 2, w) for x, y, z, w in points]
    if mistake == "project/z-not-divided":
        points = [(x, y, z * w, w) for x, y, z, w in points]
    if mistake == "project/depth-is-linear":
        points = [(x, y, w * (2 * (-p[2] - near) / (far - near) - 1), w)
                  for p, (x, y, _, w) in zip(vertices(text), points)]
    return stage_text([
        (x, y, z) if mistake == "project/no-divide" else (x / w, y / w, z / w) for x, y, z, w in points])


def zbuf(text, config, mistake=None):
    """(z-buffer text, picture). `OTHER_FORMULAS` is no mistake, but makes doubles err otherwise."""
    words = config.split()
    width, height = map(int, words[:2])
    left, bottom, front, rear = map(float, words[2:] or (-1, -1, -1, 1))
    left, bottom = (-1.0, -1.0) if mistake == "zbuf/window-is-one" else (left, bottom)
    dx, dy = -2 * left / width, -2 * bottom / height
    x_0 = left + (0 if mistake == "zbuf/no-half-pixel-in-x" else dx / 2)
    top = -bottom - (0 if mistake == "zbuf/no-half-pixel-in-y" else dy / 2)
    start = {"zbuf/rear-limit-ignored": math.inf, "zbuf/farthest-wins": -math.inf}.get(mistake, rear)
    depths = [[start] * width for _ in range(height)]
    owners = [[0] * width for _ in range(height)]

    def draw(row, column, z, owner):
        row += mistake == "zbuf/shifted-by-a-row"
        column += mistake == "zbuf/shifted-by-a-column"
        if not (0 <= row < height
                and 0 <= column < width) or z < front and mistake != "zbuf/front-limit-ignored":
            return
        old = depths[row][column]
        is_seen = {"zbuf/farthest-wins": old < z < rear, "zbuf/last-wins": z < rear}.get(mistake, z < old)
        if is_seen:
            depths[row][column], owners[row][column] = z, owner

    points = vertices(text)
    for number in range(len(points) // 3):
        corners = points[3 * number:3 * number + 3]
        owner = 1 if mistake == "zbuf/one-color" else number + 1
        highest, lowest = max(p[1] for p in corners), min(p[1] for p in corners)
        first, last = math.ceil((top - highest) / dy), math.floor(
            (top - lowest) / dy) - (mistake == "zbuf/row-short")
        for row in range(max(0, first), min(height - 1, last) + 1):
            for column, z in row_of(corners, top - row * dy, x_0, dx, width, mistake):
                draw(row, column, z, owner)
    depths = [[z if z != -math.inf else rear for z in row] for row in depths]
    depths = depths[::-1] if mistake in ("zbuf/upside-down", "zbuf/text-upside-down") else depths
    depths = [row[::-1] for row in depths] if mistake == "zbuf/mirrored" else depths
    owners = owners[::-1] if mistake == "zbuf/upside-down" else owners
    owners = [row[::-1] for row in owners] if mistake == "zbuf/mirrored" else owners
    limit = math.inf if mistake in ("zbuf/rear-limit-ignored", "zbuf/everything-printed") else rear
    return "".join("".join(f"{z:.6f}\t" for z in row if z < limit) + "\n" for row in depths), bmp(owners)


def row_of(corners, y, x_0, dx, width, mistake):
    """(column, depth) of the pixels of a triangle on a row."""
    met = []
    for i, j in ((0, 1), (1, 2), (2, 0)):
        low, high = sorted((corners[i], corners[j]), key=lambda p: (p[1], p[0], p[2]))
        if mistake == OTHER_FORMULAS and low[1] <= y <= high[1] and low[1] != high[1]:
            slope = [(q - p) / (low[1] - high[1]) for p, q in zip(low, high)]
            met.append((high[0] + slope[0] * (high[1] - y), high[2] + slope[2] * (high[1] - y)))
        elif low[1] <= y <= high[1] and low[1] != high[1]:
            t = (y - low[1]) / (high[1] - low[1])
            met.append((low[0] + t * (high[0] - low[0]), low[2] + t * (high[2] - low[2])))
    if len(met) < 2:
        return
    (x_left, z_left), (x_right, z_right) = min(met), max(met)
    to_column = int if mistake == "zbuf/truncated-ends" else lambda x: math.floor(x + 0.5)
    first, last = to_column((x_left - x_0) / dx), to_column(
        (x_right - x_0) / dx) - (mistake == "zbuf/column-short")
    if mistake == "zbuf/rounded-ends-depth":
        x_left, x_right = x_0 + first * dx, x_0 + last * dx
        z_left = min(z_left, z_right) if first == last else z_left
    slope = (z_right - z_left) / (x_right - x_left) if x_right > x_left else 0
    for column in range(max(0, first), min(width - 1, last) + 1):
        x = x_0 + column * dx
        z = z_right - (x_right - x) * slope if mistake == OTHER_FORMULAS else z_left + (x - x_left) * slope
        yield column, sum(p[2] for p in corners) / 3 if mistake == "zbuf/flat-depth" else z


def bmp(owners):
    """A picture in which each owner has a color of its own, and 0 is black."""
    pixels = b"".join(b"".join(struct.pack("<I", 40503 * owner)[:3]
                               for owner in row) + bytes(-3 * len(row) % 4) for row in reversed(owners))
    return struct.pack("<2s6I2H6I", b"BM", 54 + len(pixels), 0, 54, 40, len(owners[0]), len(owners), 1, 24, 0,
                       len(pixels), 0, 0, 0, 0) + pixels
