"""The tools beside other programs that do such work, and beside what the machine can do: measured in one run
by scripts/measure/bench.

A row's CPU time is compared with what it would take if nothing but one thing counted: the system's calls
(measured), the instructions at four a cycle, the mispredicted branches at 15 cycles each, and the cache
misses at the memory's bandwidth (counted by Valgrind's model of a processor, on fewer triangles). The largest
share is what limits the row.
"""
import collections
import dataclasses
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile

from display import display_or_none
from parts.instructions import no_count_at_all
from parts.measuring import run_pipe
from parts.tradeoff_cost_scenes import cost_scenes
from parts.tradeoff_costs import quartile_columns
from parts.tradeoff_setting import TOOLS

INSTRUCTIONS_A_CYCLE, CYCLES_A_MISPREDICTION, BYTES_A_MISS = 4, 15, 64
FEWER = 10  # a tenth of the triangles for programs that take long


@dataclasses.dataclass(frozen=True)
class Row:
    name: str
    commands: tuple   # a pipe
    source: object    # its stdin
    text_bytes: int   # read and written in its pipes
    count: int        # of triangles, or pixels
    unit: str = "triangle"
    sources: tuple = ()  # the stdin of each command, if it has to be counted alone
    is_self_timed: bool = False  # prints the seconds of what counts, on one thread


def detail_of(scene, factor):
    """The scene with fewer triangles, as large in pixels."""
    if len(scene.detail) < 2:
        return scene
    return dataclasses.replace(scene, size=tuple(max(round(n / factor**0.5), 8) for n in scene.size),
                               detail=tuple(max(round(n / factor**0.5), 4) for n in scene.detail))


class Stages:
    """A scene's texts after every stage."""

    def __init__(self, tools, folder, scene):
        folder.mkdir()
        self.paths = [folder / f"{i}.txt" for i in range(4)]
        self.config = folder / "config.txt"
        self.config.write_text("%d %d\n" % scene.size)
        self.size, self.count = scene.size, scene.write(self.paths[0])
        for tool, source, sink in zip(TOOLS[:3], self.paths, self.paths[1:]):
            run_pipe([[tools / tool]], folder, source, sink)
        self.bytes = [path.stat().st_size for path in self.paths]


def rows_of(tools, baselines, folder, scenes, factor):
    """The rows, with a `factor`-th of the triangles."""
    plain, lit, fill = (Stages(tools, folder / name, detail_of(scenes[name], factor))
                        for name in ("plain", "normals", "fill"))
    few = Stages(tools, folder / "few", detail_of(scenes["plain"], factor * FEWER))
    no_image = ["--image", "/dev/null"]

    def pipe(stages):
        return (*([tools / tool] for tool in TOOLS[:3]), [tools / "zbuf", stages.config, *no_image])

    def through(stages):
        return stages.bytes[0] + 2 * sum(stages.bytes[1:])

    def alone(name, command, source, text_bytes, count, unit="triangle"):
        return Row(name, (command,), source, text_bytes, count, unit, (source,))

    for i, tool in enumerate(TOOLS[:3]):
        yield alone(f"`{tool}`", [tools / tool], plain.paths[i], plain.bytes[i] + plain.bytes[i + 1],
                    plain.count)
    yield alone("`zbuf`", pipe(plain)[3], plain.paths[3], plain.bytes[3], plain.count)
    yield alone("`zbuf`, pictures of large triangles",
                pipe(fill)[3], fill.paths[3], fill.bytes[3], fill.count // 2 * fill.size[0] * fill.size[1],
                "pixel")
    yield alone("`zbuf`, lit", pipe(lit)[3], lit.paths[3], lit.bytes[3], lit.count)
    yield Row("the pipe", pipe(plain), plain.paths[0], through(plain), plain.count,
              sources=tuple(plain.paths))
    yield Row("the pipe, lit", pipe(lit), lit.paths[0], through(lit), lit.count, sources=tuple(lit.paths))
    if factor == 1:
        yield from drawing_rows(baselines, plain)
    yield alone("a plain filter, `from_chars`", [baselines / "filter_from_chars"], plain.paths[3],
                2 * plain.bytes[3], plain.count)
    yield alone("a plain filter, iostream", [baselines / "filter_iostream"], few.paths[3], 2 * few.bytes[3],
                few.count)
    yield alone("a student's program, all four stages",
                [baselines / "student", "all", few.paths[0], few.config, "--folder", folder], "/dev/null",
                through(few), few.count)


def drawing_rows(baselines, stages):
    """Drawing alone, from memory: ours and, if it is there, Mesa's."""
    size, path = [str(length) for length in stages.size], stages.paths[3]
    yield Row("drawing alone, `--coverage center`",
              ([baselines / "draw_triangles", *size, path, "center", "1"], ), "/dev/null", 0, stages.count,
              is_self_timed=True)
    if (baselines / "draw_osmesa").exists():
        # Mesa counts additional threads.
        yield Row("drawing alone, Mesa",
                  (["/usr/bin/env", "LP_NUM_THREADS=0", baselines / "draw_osmesa", *size, path], ),
                  "/dev/null", 0, stages.count, is_self_timed=True)


def cost_of(row, folder):
    cost = run_pipe(row.commands, folder, row.source,
                    folder / "printed.txt" if row.is_self_timed else "/dev/null")
    if not row.is_self_timed:
        return cost
    seconds = float((folder / "printed.txt").read_text().split()[0])
    return dataclasses.replace(cost, wall_seconds=seconds, cpu_seconds=seconds, system_seconds=0.0)


# Programs that are not always there

def write_obj(scene_text, path):
    """The lit scene as a model file: each vertex once."""
    numbers, points, normals, faces = {}, [], [], []
    with open(scene_text) as file:
        for line in file:
            if line == "triangle\n":
                corners = []
                for _ in range(3):
                    words = file.readline().split()
                    key = " ".join(words)
                    if key not in numbers:
                        numbers[key] = len(numbers) + 1
                        points.append("v " + " ".join(words[:3]))
                        normals.append("vn " + " ".join(words[6:9]))
                    corners.append("%d//%d" % (numbers[key], numbers[key]))
                faces.append("f " + " ".join(corners))
    path.write_text("\n".join([*points, *normals, *faces]) + "\n")


def f3d_row(folder, scene):
    """f3d draws the lit model in software into a file."""
    path = folder / "lit.obj"
    # In a process of its own: what it needs does not count as ours.
    child = os.fork()
    if child == 0:
        write_obj(folder / "normals/0.txt", path)
        os._exit(0)
    if os.waitpid(child, 0)[1] != 0:
        raise SystemExit("bench: cannot write the model for f3d")
    count = (folder / "normals/0.txt").read_bytes().count(b"triangle\n")
    command = [
        shutil.which("f3d"), "--dry-run", "--quiet", "--output", folder / "f3d.png", "--resolution",
        "%d,%d" % scene.size, path]
    return Row("f3d, the lit model", (command,), "/dev/null", path.stat().st_size, count)


# What they take

def simulated(command, source, folder):
    """{event: count} of a program, by Valgrind's model of a processor."""
    words = [
        shutil.which("valgrind"), "--tool=callgrind", "--callgrind-out-file=/dev/null", "--cache-sim=yes",
        "--branch-sim=yes", *map(str, command)]
    with open(source, "rb") as stdin:
        done = subprocess.run(words, cwd=folder, stdin=stdin, stdout=subprocess.DEVNULL,
                              stderr=subprocess.PIPE, text=True, errors="replace")
    events, counts = (re.search(rf"{name} *: (.+)", done.stderr) for name in ("Events", "Collected"))
    if done.returncode != 0 or not counts:
        raise SystemExit(f"bench: {command[0]} failed under valgrind: {done.stderr}")
    return collections.Counter(dict(zip(events[1].split(), map(int, counts[1].split()))))


def counted(row, folder):
    """What a triangle or pixel takes."""
    counts = sum((simulated(command, source, folder) for command, source in zip(row.commands, row.sources)),
                 collections.Counter())
    events = {"instructions": ("Ir",), "mispredictions": ("Bcm", "Bim"), "misses": ("ILmr", "DLmr", "DLmw")}
    return {name: sum(counts[event] for event in parts) / row.count for name, parts in events.items()}


def bandwidth(baselines, quick):
    words = subprocess.run([baselines / "memory_bandwidth", "4" if quick else "256"], capture_output=True,
                           text=True, check=True).stdout.split()
    return dict(zip(("read", "copy", "clock"), map(float, words)))


def measured(tools, baselines, rounds, quick):
    """Rows for yardsticks.csv, and the reasons why some are missing."""
    scenes, missing, runs, speeds = {scene.name: scene for scene in cost_scenes(quick)}, [], {}, []
    with tempfile.TemporaryDirectory() as name, display_or_none() as screen:
        folder = pathlib.Path(name)
        rows = list(rows_of(tools, baselines, folder, scenes, 1))
        if not (baselines / "draw_osmesa").exists():
            missing.append("Mesa: not installed (Debian: libosmesa6-dev)")
        if not shutil.which("f3d") or not screen:
            missing.append("f3d: " + (
                "no Xvfb (Debian: xvfb)" if shutil.which("f3d") else "not installed (Debian: f3d)"))
        else:
            rows.append(f3d_row(folder, scenes["normals"]))
        for _ in range(rounds):
            speeds.append(bandwidth(baselines, quick))
            for row in rows:
                runs.setdefault(row.name, []).append(cost_of(row, folder))
        small = {}
        if reason := no_count_at_all():
            missing.append(f"instructions: {reason}")
        else:
            (folder / "small").mkdir()
            small = {
                row.name: counted(row, folder / "small")
                for row in rows_of(tools, baselines, folder / "small", scenes, 1 if quick else 25)
                if row.sources}
    speed = {key: statistics.median(each[key] for each in speeds) for key in speeds[0]}
    table = [{**columns_of(row, runs[row.name]), **small.get(row.name, {}), **speed} for row in rows]
    return table, missing


def columns_of(row, runs):
    return {
        "name": row.name, "unit": row.unit, "count": row.count, "text_bytes": row.text_bytes,
        "rounds": len(runs), **quartile_columns("cpu_seconds", [run.cpu_seconds for run in runs]),
        **quartile_columns("wall_seconds", [run.wall_seconds for run in runs]),
        "system_seconds": statistics.median(run.system_seconds for run in runs),
        "mib": min(run.mib for run in runs)}


# The table

def shares(row):
    """{what: the share of the CPU time that it would take alone}"""
    seconds = float(row["cpu_seconds"])
    found = {} if row["text_bytes"] == "0" else {"the system": float(row["system_seconds"]) / seconds}
    if row["instructions"]:
        cycles = seconds / float(row["count"]) * float(row["clock"]) * 1e9
        found["instructions"] = float(row["instructions"]) / INSTRUCTIONS_A_CYCLE / cycles
        found["mispredicted branches"] = float(row["mispredictions"]) * CYCLES_A_MISPREDICTION / cycles
        found["memory"] = float(row["misses"]) * BYTES_A_MISS * float(
            row["count"]) / (float(row["copy"]) * 1e9) / seconds
    return found


def number(value):
    return f"{value:,.0f}" if value >= 100 else f"{value:.2g}"


def cells(row):
    each = 1 / float(row["count"])
    found = shares(row)
    yield row["name"]
    yield number(1e9 * each * float(row["cpu_seconds"])) + " a pixel" * (row["unit"] == "pixel")
    yield number(1e9 * each * float(row["wall_seconds"]))
    yield number(float(row["text_bytes"]) / float(row["cpu_seconds"]) /
                 1e6) if row["text_bytes"] != "0" else ""
    yield number(float(row["instructions"])) if row["instructions"] else ""
    yield from (f"{100 * found[what]:.0f} %" if what in found else ""
                for what in ("instructions", "mispredicted branches", "memory", "the system"))
    yield max(found, key=found.get) if row["instructions"] else "not counted"


def report(rows):
    """The table, in Markdown."""
    header = [
        "", "CPU, ns a triangle", "wall, ns", "text, MB/s", "instructions", "of the CPU time: instructions",
        "branches", "memory", "the system", "limit"]
    lines = ["| " + " | ".join(words) + " |" for words in (header, *(cells(row) for row in rows))]
    lines.insert(1, "|---|" + "--:|" * 8 + "---|")
    first = rows[0]
    return "\n".join([
        *lines, "",
        f"Medians of {first['rounds']} rounds on {first['machine']}, which at {float(first['clock']):.1f} "
        f"GHz reads {float(first['read']):.0f} "
        f"and copies {float(first['copy']):.0f} GB/s (read and written)."]) + "\n"
