"""How far the tools go: the whole pipe up to 10^8 triangles, plain and lit, and the largest pictures;
measured once, by scripts/measure/bench --reach. The scenes are never on the disk: a shell repeats a million
triangles, each time turned and enlarged, so that later ones hide earlier ones.
"""
import dataclasses
import os
import pathlib
import tempfile

from parts.measuring import machine, run_pipe
from parts.tradeoff_cost_scenes import cost_scenes
from parts.tradeoff_setting import TOOLS

MOST = 65535  # columns and rows


@dataclasses.dataclass(frozen=True)
class Case:
    scene: str           # of cost_scenes
    repeats: int
    size: int
    words: tuple = ()    # for zbuf
    pixel_bytes: int = 0  # of memory, where it may not suffice


def cases(quick):
    if quick:
        return [
            Case("plain", 3, 64),
            Case("normals", 3, 64),
            Case("plain", 1, 100, ("--algorithm", "scanline")),
            Case("plain", 1, 80, (), 1 << 60)]
    return [
        *(Case(scene, repeats, 500) for scene in ("plain", "normals") for repeats in (1, 10, 100)),
        Case("plain", 1, MOST, ("--algorithm", "scanline")),
        Case("plain", 1, 32768, (), 12),
        Case("plain", 1, MOST, (), 12)]


def available_bytes():
    for line in pathlib.Path("/proc/meminfo").read_text().splitlines():
        if line.startswith("MemAvailable:"):
            return 1024 * int(line.split()[1])
    return 0


def write_parts(scene, folder):
    """The scene's head, and the text of its triangles behind the transform that each repetition adds to those
    before it."""
    scene.write_empty(folder / "head.txt")
    head = (folder / "head.txt").read_text().removesuffix("end\n")
    scene.write(folder / "whole.txt")
    with open(folder / "whole.txt") as whole, open(folder / "block.txt", "w") as block:
        whole.seek(len(head))
        block.write("rotate\n3.6 1 2 3\nscale\n1.001 1.001 1.001\n")
        block.writelines(line for line in whole if line != "end\n")
    (folder / "head.txt").write_text(head)
    (folder / "whole.txt").unlink()


def measured(tools, case, scene):
    needed = case.size**2 * case.pixel_bytes
    row = {
        "scene": case.scene, "triangles": "", "size": f"{case.size} x {case.size}",
        "zbuf": " ".join(case.words), "machine": machine()}
    if needed > 0.9 * available_bytes():
        return {**row, "needed_gib": needed / 2**30}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        child = os.fork()  # what writing the scene needs does not count
        if child == 0:
            write_parts(scene, folder)
            os._exit(0)
        if os.waitpid(child, 0)[1] != 0:
            raise SystemExit("bench: cannot write the scene")
        (folder / "config.txt").write_text(f"{case.size} {case.size}\n")
        repeat = (f"cat head.txt; i=0; while [ $i -lt {case.repeats} ]; do cat block.txt; i=$((i + 1)); "
                  f"done; echo end")
        # The picture is written, as PPM, to /dev/null; so are the depths of pictures of a usual size.
        outputs = ["-o", "-"] if case.size > 8192 else ["--image", "/dev/null"]
        costs = run_pipe([["/bin/sh", "-c", repeat], *([tools / tool] for tool in TOOLS[:3]),
                          [tools / "zbuf", "config.txt", *outputs, *case.words]], folder)
        with open(folder / "block.txt") as block:
            count = case.repeats * sum(line == "triangle\n" for line in block)
    return {**row, "triangles": count, "cpu_seconds": costs.cpu_seconds, "wall_seconds": costs.wall_seconds,
            **{f"{tool}_mib": mib for tool, mib in zip(TOOLS, costs.stage_mib[1:])}}


def rows(tools, quick):
    scenes = {scene.name: scene for scene in cost_scenes(quick)}
    for case in cases(quick):
        yield measured(tools, case, scenes[case.scene])


def report(table):
    """The table, in Markdown."""
    lines = [
        "| triangles | pixels | `zbuf` | CPU, s | wall, s | memory of `model`, `view`, `project` | of "
        "`zbuf` |",
        "|--:|--:|---|--:|--:|--:|--:|"]
    for row in table:
        what = [
            f"{int(row['triangles']):,} {'lit' if row['scene'] == 'normals' else 'plain'}"
            if row["triangles"] else "any", row["size"], f"`{row['zbuf']}`" if row["zbuf"] else ""]
        if row["needed_gib"]:
            costs = ["", "", "", f"needs {float(row['needed_gib']):.0f} GiB"]
        else:
            others = max(float(row[f"{tool}_mib"]) for tool in TOOLS[:3])
            costs = [
                f"{float(row['cpu_seconds']):.3g}", f"{float(row['wall_seconds']):.3g}",
                f"at most {others:.0f} MiB", f"{float(row['zbuf_mib']):.0f} MiB"]
        lines.append("| " + " | ".join([*what, *costs]) + " |")
    return "\n".join([
        *lines, "",
        f"One run each on {table[0]['machine']}. CPU and wall time include the `cat` that repeats the "
        f"scene's text."
    ]) + "\n"
