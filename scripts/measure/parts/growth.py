"""How the cost of drawing grows with triangles and pixels: measured by scripts/measure/bench, as a table and
a plot."""
import math
import random
import shutil

from lib.showing.svg import STYLE, end_labels, line, text
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
                yield {
                    "kind": kind,
                    "triangles": count,
                    "size": size,
                    "cpu_seconds": min(c.cpu_seconds for c in costs),
                    "mib": max(cost.mib for cost in costs),
                    "machine": machine(),
                }


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
    width, height, top, bottom, panel_width = 940, 400, 80, 330, 280
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" width="{width}" '
        f'height="{height}">',
        "<title>How zbuf's cost grows with triangles and pixels</title>", f"<style>{STYLE}</style>",
        f'<rect class="card" x=".5" y=".5" width="{width - 1}" height="{height - 1}" rx="8"/>']

    def y_of(value):
        return bottom - (bottom - top) * (math.log10(value) - low) / (high - low)

    for i, (kind, counts) in enumerate(kinds.items()):
        left = 80 + i * 465
        x_of = {
            count: left + 10 + j * (panel_width - 20) / max(len(counts) - 1, 1)
            for j, count in enumerate(counts)}
        parts.append(text(left - 55, 34, f"{kind} triangles", 'class="title"'))
        parts.append(text(left - 55, 52, "CPU seconds of zbuf", 'class="soft"'))
        for power in range(low, high + 1):
            y = y_of(10.0**power)
            parts += [
                line("grid", (left, y), (left + panel_width, y)),
                text(left - 8, y + 4, f"{10.0**power:g}", 'class="soft" text-anchor="end"')]
        for count in counts:
            parts.append(text(x_of[count], bottom + 22, short(count), 'class="soft" text-anchor="middle"'))
        parts.append(
            text(left + panel_width / 2, bottom + 46, "triangles", 'class="soft" text-anchor="middle"'))
        lines = {size: [(x_of[count], y_of(table[kind, count, size])) for count in counts] for size in sizes}
        labels = end_labels({size: points[-1] for size, points in lines.items()})
        for j, (size, points) in enumerate(lines.items()):
            parts.append(f'<g class="s s{j % 4}">' + line("front", *points))
            parts += [f'<circle class="dot" cx="{x:.1f}" cy="{y:.1f}" r="3.5"/>' for x, y in points]
            parts.append(text(*labels[size], f"{size} x {size}") + "</g>")
    return "\n".join(parts) + "\n</svg>\n"
