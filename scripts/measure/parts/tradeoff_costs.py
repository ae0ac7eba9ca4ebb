"""The cost of settings on a scene: time and memory of whole pipes in turn, instructions and bytes of a
smaller scene."""
import concurrent.futures
import pathlib
import random
import re
import shutil
import statistics
import subprocess
import tempfile

from lib.showing.figures import quartiles
from parts.instructions import callgrind_count, no_count_at_all
from parts.measuring import run_pipe
from parts.tradeoff_setting import DEFAULT, FINEST, TOOLS, Setting, drawing_words


CLOCK = 1e-6  # seconds, the resolution of CPU times: what a few triangles add may be less


def quartile_columns(name, values):
    found = quartiles(values)
    return {f"{name}_q1": found.first, name: found.median, f"{name}_q3": found.third}


class Pipes:
    """Runs the pipe on a scene, and on the same scene without triangles: what a run costs anyway."""

    def __init__(self, bin_dir, folder, scene):
        self.bin_dir, self.folder, self.size = pathlib.Path(bin_dir).resolve(), pathlib.Path(
            folder), scene.size
        self.triangle_count = scene.write(self.folder / "scene.txt")
        scene.write_empty(self.folder / "empty.txt")
        (self.folder / "config.txt").write_text("%d %d\n" % scene.size)

    def cost(self, setting, name):
        return run_pipe([setting.command(self.bin_dir, tool) for tool in setting.tools], self.folder,
                        self.folder / name)

    def picture(self, setting):
        """The channels of the image, from the top left."""
        self.cost(setting, "scene.txt")
        return (self.folder / "picture.ppm").read_bytes()[-3 * self.size[0] * self.size[1]:]


def times(pipes, settings, rounds):
    """{setting: columns}. A round runs all settings once, in a new order, so that other load on the machine
    affects all alike."""
    dice, runs, empty_runs = random.Random(1), {s: [] for s in settings}, {s: [] for s in settings}
    for _ in range(rounds):
        for setting in dice.sample(settings, len(settings)):
            empty_runs[setting].append(pipes.cost(setting, "empty.txt"))
            runs[setting].append(pipes.cost(setting, "scene.txt"))
    added = {
        s: {
            kind: [
                max(getattr(run, kind) - getattr(empty, kind), CLOCK)
                for run, empty in zip(runs[s], empty_runs[s])]
            for kind in ("cpu_seconds", "wall_seconds")}
        for s in settings}

    def columns(setting):
        # The smallest memory: which pages of a file are mapped at the end of a run varies.
        ratios = [
            own / base for own, base in zip(added[setting]["cpu_seconds"], added[DEFAULT]["cpu_seconds"])]
        return {
            "empty_cpu_seconds": statistics.median(run.cpu_seconds for run in empty_runs[setting]),
            **quartile_columns("cpu_seconds", added[setting]["cpu_seconds"]),
            **quartile_columns("wall_seconds", added[setting]["wall_seconds"]), **quartile_columns(
                "ratio", ratios), "empty_mib": min(run.mib for run in empty_runs[setting]), "mib": min(
                run.mib for run in runs[setting])}

    return {setting: columns(setting) for setting in settings}


# Instructions

def perf_count(words, folder):
    """The instructions of a command outside the kernel, or None where the processor's counter cannot be
    read."""
    if not shutil.which("perf"):
        return None
    done = subprocess.run(["perf", "stat", "-x,", "-e", "instructions:u", *words], cwd=folder,
                          stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                          text=True, errors="replace")
    found = re.search(r"^(\d+),", done.stderr, re.MULTILINE)
    return int(found[1]) if done.returncode == 0 and found else None


def counter():
    """(its name, what counts a command's instructions), or (why not, None)."""
    if perf_count(["true"], "/"):
        return "perf", perf_count
    reason = no_count_at_all()
    return (reason, None) if reason else ("callgrind", callgrind_count)


def stage_counts(pipes, name, settings, count):
    """{setting: [(instructions of its run, bytes of its output) of each stage]}. Settings share the stages
    they have in common."""
    known = {(): (None, None, pipes.folder / name)}

    def run(key):
        tool, *words = key[-1].split()
        source = known[key[:-1]][2]
        draws = drawing_words(tool, "/dev/null")
        command = [str(pipes.bin_dir / tool), *words, *draws, str(source)]
        output = pipes.folder / (name + "".join(f"-{stage}".replace(" ", "") for stage in key))
        if draws:
            return key, (count(command, pipes.folder) if count else None, 0, None)
        with open(output, "wb") as file:
            subprocess.run(command, stdout=file, stderr=subprocess.DEVNULL, check=True)
        return key, (count(command, pipes.folder) if count else None, output.stat().st_size, output)

    keys = {
        setting: tuple(" ".join([tool, *setting.words_for(tool)]) for tool in setting.tools)
        for setting in settings}
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        for stages in range(1, len(TOOLS) + 1):
            known.update(
                pool.map(run, dict.fromkeys(key[:stages] for key in keys.values() if stages <= len(key))))
    return {
        setting: [known[key[:stages]][:2] for stages in range(1,
                                                              len(key) + 1)]
        for setting, key in keys.items()}


def counts(bin_dir, scene, settings, count):
    """{setting: columns}: instructions of a run without triangles, those that a triangle adds, and its bytes
    in the three pipes."""
    small = scene.smaller()
    with tempfile.TemporaryDirectory() as folder:
        pipes = Pipes(bin_dir, folder, small)
        full, empty = stage_counts(pipes, "scene.txt", settings,
                                   count), stage_counts(pipes, "empty.txt", settings, count)
        (pathlib.Path(folder) / "config.txt").write_text("%d %d\n" % scene.size)
        shown = stage_counts(pipes, "empty.txt", settings, count) if small is not scene else empty

    def columns(setting):
        text_bytes = sum(f[1] - e[1] for f, e in zip(full[setting], empty[setting]))
        row = {"bytes": text_bytes / pipes.triangle_count, "empty_instructions": None, "instructions": None}
        if count:
            row["empty_instructions"] = sum(stage[0] for stage in shown[setting])
            row["instructions"] = sum(f[0] - e[0]
                                      for f, e in zip(full[setting], empty[setting])) / pipes.triangle_count
        return row

    return {setting: columns(setting) for setting in settings}


# What light and culling change in the picture

def differences(pipes, settings):
    """{setting: columns}: from the finest picture where samples are compared; from the picture without
    culling where that is."""
    if FINEST in settings:
        finest = pipes.picture(FINEST)
        for setting in settings:
            if setting.is_traced:
                continue  # shadows make it another picture
            distances = [abs(a - b) for a, b in zip(pipes.picture(setting), finest)]
            yield setting, {"difference_mean": statistics.fmean(distances), "difference_max": max(distances)}
    for setting in settings:
        if setting.value("--cull"):
            pictures = [pipes.picture(s) for s in (setting, Setting(" ".join(setting.words_for("zbuf"))))]
            yield setting, {
                "channels": len(pictures[0]), "channels_changed": sum(a != b for a, b in zip(*pictures))}


def costs(bin_dir, scene, rounds, count):
    """{setting: columns}"""
    settings = list(scene.settings)
    with tempfile.TemporaryDirectory() as folder:
        pipes = Pipes(bin_dir, folder, scene)
        rows = {
            s: {"triangles": pipes.triangle_count, "size": "%d x %d" % scene.size, "rounds": rounds}
            for s in settings}
        for setting, columns in times(pipes, settings, rounds).items():
            rows[setting].update(columns)
        for setting, columns in differences(pipes, settings):
            rows[setting].update(columns)
    for setting, columns in counts(bin_dir, scene, settings, count if scene.is_counted else None).items():
        rows[setting].update(columns)
    return rows
