"""From a model file to a PNG: `picture` beside f3d, which draws in software, too; measured by
scripts/measure/bench --models."""
import dataclasses
import os
import pathlib
import shutil
import statistics
import subprocess
import sys
import tempfile

from display import display_or_none
from parts.measuring import machine, run_pipe

SCRIPTS = pathlib.Path(__file__).resolve().parents[2]
SIZE = (800, 600)
FORMATS = ("obj", "ply", "stl")


@dataclasses.dataclass(frozen=True)
class Model:
    format: str
    path: pathlib.Path
    count: int  # of triangles


def models(folder, details):
    """A terrain of each detail in each format; it has 98 triangles times the square of the detail."""
    for detail in details:
        for name in FORMATS:
            path = folder / f"terrain-{detail}.{name}"
            with open(path, "wb") as file:
                subprocess.run([
                    sys.executable, SCRIPTS / "make-model", "terrain", "--detail",
                    str(detail), "--format", name], stdout=file, check=True)
            yield Model(name, path, 98 * detail**2)


def rows(tools, rounds, quick):
    """Rows for models.csv, in turn in each round; without f3d or a display for it, only ours, and the
    reason."""
    has_f3d = shutil.which("f3d") is not None
    found, reason = [], None
    with tempfile.TemporaryDirectory() as name, display_or_none() as screen:
        folder = pathlib.Path(name)
        if not has_f3d or not screen:
            reason = "f3d: " + ("no Xvfb (Debian: xvfb)" if has_f3d else "not installed (Debian: f3d)")
        os.environ["BIN"] = str(tools)
        for model in models(folder, (2, 3) if quick else (32, 101)):
            commands = {
                "picture": [
                    SCRIPTS / "picture", "--up-axis", "y", "--size",
                    "%dx%d" % SIZE, model.path, "-o", folder / "ours.png"],
                "import": [tools / "mesh2scene", "--up-axis", "y", model.path]}
            if not reason:
                commands["f3d"] = [
                    shutil.which("f3d"), "--dry-run", "--quiet", "--up", "+Y", "--output", folder / "f3d.png",
                    "--resolution",
                    "%d,%d" % SIZE, model.path]
            costs = {program: [] for program in commands}
            for _ in range(rounds):
                for program, words in commands.items():
                    costs[program].append(run_pipe([words], folder))
            row = {"format": model.format, "triangles": model.count, "rounds": rounds}
            for program, runs in costs.items():
                row[program + "_wall_seconds"] = statistics.median(run.wall_seconds for run in runs)
                row[program + "_cpu_seconds"] = statistics.median(run.cpu_seconds for run in runs)
            found.append({**row, "machine": machine()})
    return found, reason


def report(rows):
    """The table, in Markdown."""
    def seconds(row, program):
        return [
            f"{float(row[program + key]):.2g}" if row.get(program + key) else ""
            for key in ("_wall_seconds", "_cpu_seconds")]

    lines = [
        "| | triangles | `picture`: wall, s | CPU, s | of that, `mesh2scene` | f3d: wall, s | CPU, s |",
        "|---|--:|--:|--:|--:|--:|--:|"]
    for row in rows:
        lines.append("| " + " | ".join([
            row["format"].upper(), f"{int(row['triangles']):,}", *seconds(row, "picture"),
            seconds(row, "import")[1], *seconds(row, "f3d")]) + " |")
    return "\n".join([*lines, "", f"Medians of {rows[0]['rounds']} rounds on {rows[0]['machine']}."]) + "\n"
