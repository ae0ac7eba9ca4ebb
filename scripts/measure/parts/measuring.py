"""Shared by the measuring scripts: the machine's name, and runs with their costs."""
import csv
import dataclasses
import os
import subprocess


def machine():
    """The processor's name and the number of available cores."""
    models = [line.split(":", 1)[1].strip() for line in open("/proc/cpuinfo") if line.startswith("model name")]
    return f"{models[0] if models else 'unknown processor'}, {len(os.sched_getaffinity(0))} cores"


@dataclasses.dataclass(frozen=True)
class Cost:
    cpu_seconds: float  # user and system
    mib: float          # peak resident memory


def cost_of(process, name, messages=None):
    """Waits for a process; ends the script if it failed, printing the contents of the file `messages`."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        if messages:
            messages.seek(0)
        raise SystemExit(f"{name} failed" + (f": {messages.read().decode()}" if messages else ""))
    return Cost(usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024)


def run(words, name="a tool", **streams):
    """The cost of one command."""
    return cost_of(subprocess.Popen(list(map(str, words)), **streams), name)


def write_csv(path, rows, digits=4):
    """Writes a column for each key of any row; numbers get a fixed count of significant digits."""
    columns = list(dict.fromkeys(column for row in rows for column in row))
    with open(path, "w", newline="") as file:
        table = csv.DictWriter(file, columns, restval="", lineterminator="\n")
        table.writeheader()
        table.writerows({column: f"{value:.{digits}g}" if isinstance(value, float) else value for column, value in row.items()} for row in rows)
