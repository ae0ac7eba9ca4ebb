"""Guards the speed of the tools: compares the instructions of every row of instruction_rows.py with the
committed count.

Counts do not depend on other load on the machine. Valgrind emulates the same processor on every host that has
AVX2, so they do not depend on the host either; they do depend on the compiler and the kernel, which each row
therefore names.
"""
import csv
import dataclasses
import io
import os
import pathlib
import platform
import re
import shutil
import subprocess
import tempfile

from lib.rim.command import CommandFailure
from lib.rim.output_file import expect_writable, write_file
from parts.instruction_rows import ROWS, TEXTS

TOLERATED_PERCENT = 1.0
FLAGS = {"scalar": set(), "sse4": {"sse4_2"}, "avx2": {"sse4_2", "bmi1", "bmi2", "avx2",
                                                       "fma"}}  # in /proc/cpuinfo


def compiler_of(program):
    """Name and version of the compiler, from the section .comment. Clang comes first, since a program that it
    linked contains objects of GCC's, too."""
    content = program.read_bytes()
    for name, mark in (("clang", rb"clang version (\d[\d.]*)"), ("GCC", rb"GCC: \([^)]*\) (\d[\d.]*)")):
        if found := re.search(mark, content):
            return f"{name} {found[1].decode()}"
    return "an unknown compiler"


def processor_flags():
    lines = pathlib.Path("/proc/cpuinfo").read_text().splitlines()
    return next((set(line.split(":", 1)[1].split()) for line in lines if line.startswith("flags")), set())


def lacks_kernels(tools):
    """True if the build left out the kernels of some processors."""
    cache = tools.parent / "CMakeCache.txt"
    return cache.exists() and "PIPELINE_ALL_KERNELS:BOOL=ON" not in cache.read_text()


def no_count_at_all():
    """The reason why nothing can be counted here, or None."""
    if platform.machine() != "x86_64":
        return f"the committed counts are those of x86-64, this is {platform.machine()}"
    return None if shutil.which("valgrind") else "valgrind is not installed (Debian: valgrind)"


def callgrind_count(words, folder, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, **environment):
    """The instructions of one command in `folder`, in a fixed environment, not the caller's, with the given
    variables."""
    done = subprocess.run(
        [shutil.which("valgrind"), "--tool=callgrind", "--callgrind-out-file=/dev/null", *words], cwd=folder,
        env={"PATH": "/usr/bin:/bin", "LC_ALL": "C",
             **environment}, stdin=stdin, stdout=stdout, stderr=subprocess.PIPE, text=True, errors="replace")
    collected = re.search(r"Collected : (\d+)", done.stderr)
    if done.returncode != 0 or not collected:
        own = [line for line in done.stderr.splitlines() if line and not line.startswith("==")]
        raise CommandFailure(
            f"failed with status {done.returncode}: {' '.join(own) or 'valgrind has counted nothing'}")
    return int(collected[1])


def count(row, folder):
    """The instructions of a row's run in `folder`, whose bin/ has the tools; for a pipe, of all stages."""
    def counted(stage, source, output):
        return callgrind_count(f"bin/{stage}".split(), folder, source, output, PIPELINE_KERNEL=row.kernel)

    for word in row.words.split():
        if word in TEXTS and not (folder / word).exists():
            (folder / word).write_text(TEXTS[word]())
    total, text = 0, subprocess.DEVNULL
    *before, last = row.words.split(" | ")
    try:
        for stage in before:
            source, text = text, tempfile.TemporaryFile()
            total += counted(stage, source, text)
            text.seek(0)
        return total + counted(last, text, subprocess.DEVNULL)
    except CommandFailure as error:
        raise CommandFailure(f"{row.words} {error}") from None


@dataclasses.dataclass
class Committed:
    compiler: str
    instructions: int


def committed_counts(path):
    """{(row, kernel): Committed}"""
    if not path.exists():
        return {}
    with open(path, newline="") as file:
        return {(line["row"], line["kernel"]): Committed(line["compiler"], int(line["instructions"]))
                for line in csv.DictReader(file)}


class Comparison:
    """One run over the rows: the counts and the results."""
    def __init__(self, committed, accept):
        self.committed, self.accept = committed, accept
        self.counted = {}  # {(row, kernel): Committed}
        self.passed, self.failures, self.shrunk, self.skipped = 0, [], [], 0

    def tell(self, row, *cells):
        print(f"{row.name:36} {row.kernel:8}", *cells, flush=True)

    def skip(self, row, reason):
        self.skipped += 1
        self.tell(row, "skipped:", reason)

    def fail(self, row, reason):
        self.failures.append(f"{row.name}: {reason}")

    def compare(self, row, compiler, folder):
        key = row.name, row.kernel
        before = self.committed.get(key)
        if before and before.compiler != compiler and not self.accept:
            return self.skip(row, f"built by {compiler}, the committed count is for {before.compiler}")
        try:
            now = count(row, folder)
        except CommandFailure as error:
            self.tell(row, "failed")
            return self.fail(row, str(error))
        self.counted[key] = Committed(compiler, now)
        change = 100 * (now - before.instructions) / before.instructions if before else 0.0
        self.tell(
            row,
            *((f"{before.instructions:15,}", f"{now:15,}", f"{change:+8.2f} %") if before else
              (f"{'none':>15}", f"{now:15,}")))
        if self.accept or (before and change <= TOLERATED_PERCENT):
            self.passed += 1
        elif before:
            self.fail(row,
                      f"{before.instructions:,} instructions committed, {now:,} counted, {change:+.2f} %")
        else:
            self.fail(row, f"no count is committed, {now:,} instructions counted; commit it with --accept")
        if change < -TOLERATED_PERCENT and not self.accept:
            self.shrunk.append(f"{row.name}: {change:+.2f} %, commit the new count with --accept")

    def report(self):
        for line in self.shrunk:
            print("faster:", line)
        for line in self.failures:
            print("failed:", line)
        if not self.passed and not self.failures:
            print("NOTHING WAS COUNTED, for the reasons above")
        print(f"{self.passed} passed, {len(self.failures)} failed" +
              f", {self.skipped} skipped" * bool(self.skipped))


def write_counts(path, counts, rows):
    """Writes the counts in the order of the rows; a row that could not run here keeps its count."""
    keys = [key for row in rows if (key := (row.name, row.kernel)) in counts]
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerows([["row", "kernel", "compiler", "instructions"],
                     *([*key, *dataclasses.astuple(counts[key])] for key in keys)])
    write_file(path, text.getvalue().encode())


def hold(tools, path, accept=False, rows=ROWS):
    """Compares the instructions of a folder's tools with a CSV file, or accepts them as its new counts;
    returns the exit status."""
    if accept:
        expect_writable(path)
    there = {row.tool for row in rows if (tools / row.tool).exists()}
    if missing := sorted({row.tool for row in rows} - there - {"mesh2scene"}):
        print(f"bench: {tools} has no {', '.join(missing)}; scripts/build-release builds the tools")
        return 1
    comparison = Comparison(committed_counts(path), accept)
    compilers = {tool: compiler_of(tools / tool) for tool in there}
    nowhere, flags = no_count_at_all(), processor_flags()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        os.symlink(tools.resolve(), folder / "bin")
        print(f"{'row':36} {'kernel':8} {'committed':>15} {'counted':>15} {'change':>10}")
        for row in rows:
            if nowhere:
                comparison.skip(row, nowhere)
            elif row.tool not in there:
                comparison.skip(row, "mesh2scene is not built (PIPELINE_MODELS)")
            elif lacking := sorted(FLAGS[row.kernel] - flags):
                comparison.skip(row, f"this processor has no {', '.join(lacking)}")
            elif row.kernel == "sse4" and lacks_kernels(tools):
                comparison.skip(row, "this build has no kernels for it (PIPELINE_ALL_KERNELS)")
            else:
                comparison.compare(row, compilers[row.tool], folder)
    if accept and comparison.counted:
        write_counts(path, {**comparison.committed, **comparison.counted}, rows)
    comparison.report()
    return 1 if comparison.failures or (accept and not comparison.counted) else 0
