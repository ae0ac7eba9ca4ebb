"""Pictures of what a rasterizer does with a case: its pixels, large, and the triangles' edges over them."""
from lib.showing.pictures import png

SIZE = 256  # of a picture, about
WHITE, INK, DOT = (255, 255, 255), (40, 44, 52), (90, 98, 110)
COLORS = {
    "gap": (207, 34, 46), "twice": (255, 150, 40), "moved": (190, 130, 220), "missed": (245, 180, 185),
    "extra": (250, 222, 120)}
TINTS = (
    (214, 229, 246), (226, 240, 221), (232, 224, 243), (222, 238, 238))  # of triangles that own a pixel alone


def worst_case(failures):
    """The case that shows best what goes wrong: gaps and pixels owned twice first, and most of them; None if
    nothing does."""
    def badness(case):
        kinds = list(failures[case].values())
        owned = [kind for kind in kinds if kind in ("gap", "twice")]
        return len({*owned}), len(owned), len(kinds)

    worst = max((case for case in failures if failures[case]), key=badness, default=None)
    return worst


def drawn(case, masks, failures):
    """The picture of a case, as PNG."""
    scale = max(4, SIZE // max(case.width, case.height))
    width, height = case.width * scale + 1, case.height * scale + 1
    rows = [bytearray(3 * width) for _ in range(height)]
    for y in range(height):
        for x in range(width):
            pixel = min(y // scale, case.height - 1) * case.width + min(x // scale, case.width - 1)
            put(rows, x, y, color_of(pixel, masks, failures))
    for row in range(case.height):
        for column in range(case.width):
            dot(rows, column * scale + scale // 2, row * scale + scale // 2, scale)
    for triangle in case.triangles:
        for a, b in zip(triangle, triangle[1:] + triangle[:1]):
            line(rows, [float(x) * scale for x in (*a[:2], *b[:2])])
    return png(width, height, [bytes(row) for row in rows])


def color_of(pixel, masks, failures):
    if pixel in failures:
        return COLORS[failures[pixel]]
    owners = [number for number, mask in enumerate(masks) if mask[pixel]]
    return TINTS[owners[0] % len(TINTS)] if owners else WHITE


def put(rows, x, y, color):
    if 0 <= y < len(rows) and 0 <= 3 * x < len(rows[0]):
        rows[y][3 * x:3 * x + 3] = bytes(color)


def dot(rows, x, y, scale):
    """A pixel's center."""
    radius = max(0, scale // 20)
    for dy in range(-radius, radius + 1):
        for dx in range(-radius, radius + 1):
            put(rows, x + dx, y + dy, DOT)


def line(rows, ends):
    """An edge, as far as it is in the picture."""
    x0, y0, x1, y1 = ends
    steps = int(max(abs(x1 - x0), abs(y1 - y0))) + 1
    if steps > 10**5:  # nearly all of it is far outside
        return
    for i in range(steps + 1):
        x, y = round(x0 + (x1 - x0) * i / steps), round(y0 + (y1 - y0) * i / steps)
        if 0 <= y < len(rows) and 0 <= 3 * x < len(rows[0]):
            put(rows, x, y, [(2 * below + 3 * ink) // 5 for below, ink in zip(rows[y][3 * x:3 * x + 3], INK)])
