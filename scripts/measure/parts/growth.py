"""How the cost of drawing grows with triangles and pixels: measured by scripts/measure/bench, as a table and
a plot."""
import math
import random
import shutil

from lib.showing.svg import LINES_BOTTOM, LINES_TOP, line_panels
from parts.measuring import machine, run_pipe

SIZES = (100, 500, 2000, 8192)
SMALL_COUNTS = (10**3, 10**4, 10**5, 10**6, 10**7)
LARGE_COUNTS = (1, 10, 100)
DISTINCT = 10**6  # larger counts repeat these triangles


def write_small(path, count, size):
    """Triangles of about three pixels on a screen of size x size, all over it."""
    rng = random.Random(1)
    reach = 3.4 / size
    with open(path, "w") as file:
        for _ in range(min(count, DISTINCT)):
            x, y, z = (rng.uniform(-1, 1) for _ in range(3))
            for _ in range(3):
                file.write(
                    "%.7f %.7f %.7f\n" % (x + rng.uniform(-reach, reach), y + rng.uniform(-reach, reach), z))
            file.write("\n")
    if count > DISTINCT:
        once = path.with_suffix(".once")
        path.rename(once)
        with open(path, "wb") as file:
            for _ in range(count // DISTINCT):
                with open(once, "rb") as block:
                    shutil.copyfileobj(block, file, 1 << 20)
        once.unlink()


def write_large(path, count):
    """Triangles that each cover half the screen, alternately nearer and farther."""
    rng = random.Random(2)
    corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    with open(path, "w") as file:
        for i in range(count):
            for x, y in (corners[(i + j) % 4] for j in range(3)):
                file.write("%.7f %.7f %.7f\n" % (x, y, rng.uniform(-0.9, 0.9)))
            file.write("\n")


def measured(zbuf, folder, rounds, quick):
    """Rows {kind, triangles, size, cpu_seconds, mib}: whole runs of zbuf, including reading and writing text,
    the fastest of each kind: other load on the machine can only add CPU time, never take any away."""
    sizes, small, large = ((50, 100), (10, 100), (1, 2)) if quick else (SIZES, SMALL_COUNTS, LARGE_COUNTS)
    triangles, config = folder / "growth.txt", folder / "growth-config.txt"
    for size in sizes:
        config.write_text(f"{size} {size}\n")
        for kind, counts in (("small", small), ("screen-filling", large)):
            for count in counts:
                if kind == "small":
                    write_small(triangles, count, size)
                else:
                    write_large(triangles, count)
                words = [zbuf, config, triangles, "--image", "/dev/null", "--z-buffer", "/dev/null"]
                costs = [run_pipe([words], folder) for _ in range(rounds)]
                yield {"kind": kind, "triangles": count, "size": size,
                       "cpu_seconds": min(c.cpu_seconds for c in costs),
                       "mib": max(cost.mib for cost in costs), "machine": machine()}


def rows_of(table):
    """The rows of growth.csv, read by csv.DictReader."""
    return [{
        **row, "triangles": int(row["triangles"]), "size": int(row["size"]),
        "cpu_seconds": float(row["cpu_seconds"]), "mib": float(row["mib"]) if row["mib"] else ""}
            for row in table]


def cells(rows):
    return {(row["kind"], row["triangles"], row["size"]): row["cpu_seconds"] for row in rows}


def axes(rows):
    """The kinds with their counts, and the sizes."""
    kinds = {}
    for row in rows:
        counts = kinds.setdefault(row["kind"], [])
        if row["triangles"] not in counts:
            counts.append(row["triangles"])
    return kinds, sorted({row["size"] for row in rows})


def report(rows):
    """The table, in Markdown."""
    table = cells(rows)
    kinds, sizes = axes(rows)
    lines = [
        "| triangles | " + " | ".join(f"{size} x {size}" for size in sizes) + " |",
        "|---|" + "--:|" * len(sizes)]
    for kind, counts in kinds.items():
        for count in counts:
            lines.append(f"| {count:,} {kind} | " +
                         " | ".join(f"{table[kind, count, size]:.3g}" for size in sizes) + " |")
    largest = max(rows, key=lambda row: (row["size"], row["triangles"]))
    memory = f"Memory at {largest['size']} x {largest['size']}: {largest['mib']:.0f} MiB. " if largest[
        "mib"] else ""
    return "\n".join([
        *lines, "",
        f"CPU seconds of the fastest of three runs of `zbuf` on one thread, text in and out included; small "
        f"triangles have about three "
        f"pixels. {memory}{rows[0]['machine']}.", ""])


def short(count):
    """1,000,000 is 1 M."""
    return f"{count // 10**6} M" if count >= 10**6 else f"{count:,}"


def plot(rows):
    """CPU seconds over triangles, both logarithmic: one panel for each kind, one line for each size."""
    table = cells(rows)
    kinds, sizes = axes(rows)
    seconds = [row["cpu_seconds"] for row in rows]
    low, high = math.floor(math.log10(min(seconds))), math.ceil(math.log10(max(seconds)))

    def y_of(value):
        return LINES_BOTTOM - (LINES_BOTTOM - LINES_TOP) * (math.log10(value) - low) / (high - low)

    ticks = [("grid", y_of(10.0**power), f"{10.0**power:g}") for power in range(low, high + 1)]
    return line_panels("How zbuf's cost grows with triangles and pixels", [
        (f"{kind} triangles", "CPU seconds of zbuf", ticks, [short(n) for n in counts],
         {f"{size} x {size}": [y_of(table[kind, n, size]) for n in counts] for size in sizes})
        for kind, counts in kinds.items()])
