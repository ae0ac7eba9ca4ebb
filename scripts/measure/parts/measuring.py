"""Shared by the measuring scripts: the machine's name, and runs with their costs."""
import csv
import dataclasses
import os
import pathlib
import subprocess
import sys

from lib.rim.arguments import CommandParser
from lib.rim.child import cpu_seconds, finished
from lib.running.pipe_tools import SOURCE


def machine():
    """The processor's name and the number of available cores."""
    models = [
        line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return f"{models[0] if models else 'unknown processor'}, {len(os.sched_getaffinity(0))} cores"


def result_parser(description, rounds=0, redrawn=""):
    """Of a command that writes its figures to results/: `rounds` is the default of --rounds, if it has that,
    and `redrawn` names what --redraw reads."""
    parser = CommandParser(description=description)
    parser.add_argument("--bin", type=pathlib.Path, default=SOURCE / "build/release/bin",
                        help="the folder of the tools")
    parser.add_argument("-o", "--output", type=pathlib.Path, default=SOURCE / "scripts/measure/results",
                        help="the folder for the results")
    parser.add_argument("--quick", action="store_true", help="a test of this script, no measurement")
    if rounds:
        parser.add_argument("--rounds", type=int, default=rounds, help="timed runs (default %(default)s)")
    if redrawn:
        parser.add_argument("--redraw", action="store_true",
                            help=f"measure nothing; read the numbers from {redrawn}")
    return parser


LAUNCHER = pathlib.Path(__file__).with_name("launcher.py")


@dataclasses.dataclass(frozen=True)
class PipeCost:
    wall_seconds: float
    cpu_seconds: float     # user and system, of all stages together
    system_seconds: float
    stage_mib: tuple       # largest resident sets

    @property
    def mib(self):
        return sum(self.stage_mib)


def run_pipe(commands, folder, source="/dev/null", sink="/dev/null"):
    """The cost of commands joined by pipes, run in `folder`; ends the script if one fails, with what they
    wrote to stderr."""
    words = [word for command in commands for word in ("|", *map(str, command))][1:]
    notes = pathlib.Path(folder, "notes.txt")
    done = subprocess.run(
        [sys.executable, "-I", "-S",
         str(LAUNCHER), str(source),
         str(sink), str(notes), *words], cwd=folder, stdout=subprocess.PIPE, text=True)
    wall, *costs = (line.split() for line in done.stdout.splitlines())
    if done.returncode != 0 or any(status != "0" for status, *_ in costs):
        raise SystemExit(f"{' '.join(words)} failed: {notes.read_text(errors='replace')}")
    user, system = (sum(float(cost[i]) for cost in costs) for i in (1, 2))
    return PipeCost(float(wall[0]), user + system, system, tuple(int(kib) / 1024 for *_, kib in costs))


@dataclasses.dataclass(frozen=True)
class Cost:
    cpu_seconds: float  # user and system
    mib: float          # peak resident memory


def run(words, name="a tool", **streams):
    """The cost of one command; ends the script if it fails."""
    process = subprocess.Popen(list(map(str, words)), **streams)
    usage = finished(process)
    if process.returncode != 0:
        raise SystemExit(f"{name} failed")
    return Cost(cpu_seconds(usage), usage.ru_maxrss / 1024)


def read_csv(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def write_csv(path, rows, digits=4):
    """Writes a column for each key of any row; numbers get a fixed count of significant digits."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows({
            column: f"{value:.{digits}g}" if isinstance(value, float) else value
            for column, value in row.items()}
                        for row in rows)
