"""Runs the cases of the conformance pack on mutants of tests/reference/reference.py."""
import ast
import contextlib
import io
import multiprocessing
import pathlib
import resource
import shlex
import signal
import sys
import tempfile
import time
import types
from collections import namedtuple
from concurrent.futures import ProcessPoolExecutor as Pool
from concurrent.futures.process import BrokenProcessPool

SOURCE = pathlib.Path(__file__).resolve().parents[3]
sys.path.append(str(SOURCE / "tests/conformance"))
from conform_parts.cases import RULES, STAGES, read_cases  # noqa: E402
from conform_parts.trial import Terms, judge_outputs, judge_refusal  # noqa: E402

FILE = "tests/reference/reference.py"
MEMORY_LIMIT, SECONDS_LIMIT = 3 << 30, 600  # of a process
Ending = namedtuple("Ending", "status stdout stderr")
Outputs = namedtuple("Outputs", "text image")
Run = namedtuple("Run", "case rule")
FORKED = multiprocessing.get_context("fork")
reference = None  # of this process, mutated or not


def load(text):
    global reference
    for number in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):  # as no command's process
        signal.signal(number, signal.SIG_DFL)
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY_LIMIT, MEMORY_LIMIT))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS_LIMIT, SECONDS_LIMIT))
    reference = types.ModuleType("reference")
    try:
        exec(compile(text, FILE, "exec"), vars(reference))
    except (Exception, SystemExit):  # a mutant that does not even begin
        reference = None


def ended(case, rule, folder):
    """How the program ends on a case, with its outputs; it runs in this process."""
    words = shlex.split(case.read("options.txt").decode()) if case.has("options.txt") else []
    image, scene = pathlib.Path(folder, "out.bmp"), pathlib.Path(folder, "scene.txt")
    if case.has(scene.name):
        scene.write_bytes(case.read(scene.name))
        words = [str(scene) if word == scene.name else word for word in words]
    if case.stage == "zbuf":
        config = pathlib.Path(folder, "config.txt")
        config.write_bytes(case.read("config.txt"))
        words = [str(config), "--image", str(image), "--coverage", rule, *words]
    stdin, stdout, stderr, status = sys.stdin, io.TextIOWrapper(io.BytesIO()), io.StringIO(), 0
    sys.argv, sys.stdin = ["", case.stage, *words], io.TextIOWrapper(io.BytesIO(case.read("input.txt")))
    try:
        with contextlib.redirect_stdout(stdout), contextlib.redirect_stderr(stderr):
            reference.main()
    except SystemExit as end:
        status = end.code
    finally:
        sys.stdin = stdin
    stdout.flush()
    text, picture = stdout.buffer.getvalue(), image.read_bytes() if image.exists() else None
    return Ending(status, text, stderr.getvalue()), Outputs(text, picture)


def is_noticed(run):
    """Whether the case fails, or the program does on it."""
    signal.signal(signal.SIGALRM, lambda *_: (_ for _ in ()).throw(TimeoutError()))
    signal.alarm(60)
    terms = Terms([], run.rule, None, False, True, True, True, None, None, None)
    try:
        with tempfile.TemporaryDirectory() as folder:
            ending, outputs = ended(run.case, run.rule, folder)
            if run.case.refused_line is not None:
                return bool(judge_refusal(run.case, terms, ending, ending.stderr))
            return ending.status != 0 or bool(judge_outputs(run.case, terms, outputs))
    except Exception:  # any that a mutant may raise
        return True
    finally:
        signal.alarm(0)


def traced(run):
    """The seconds that a case takes, the first lines of the functions that it calls, and whether it fails."""
    called = set()

    def trace(frame, *_):
        if frame.f_code.co_filename == FILE:
            called.add(frame.f_code.co_firstlineno)

    began = time.monotonic()
    sys.settrace(trace)
    is_failed = is_noticed(run)
    sys.settrace(None)
    return time.monotonic() - began, called, is_failed


class ReferenceTrial:
    """The cases, from the shortest, each with the functions of the reference that it calls."""

    def __init__(self, jobs):
        self.jobs, self.text = jobs, (SOURCE / FILE).read_text()
        self.functions = [(node.lineno, node.end_lineno) for node in ast.walk(ast.parse(self.text))
                          if isinstance(node, ast.FunctionDef)]
        runs = [Run(case, rule) for stage in STAGES for case in read_cases(stage)
                for rule in (RULES if stage == "zbuf" else RULES[:1])]
        with Pool(self.jobs, FORKED, load, (self.text, )) as pool:
            traces = list(pool.map(traced, runs, chunksize=8))
        if failing := [run.case.name for run, trace in zip(runs, traces) if trace[2]]:
            sys.exit(f"mutate: these fail without a mutant: {', '.join(failing)}")
        times = sorted(range(len(runs)), key=lambda i: traces[i][0])
        self.runs = [(runs[i], traces[i][1]) for i in times]

    def outcome(self, mutant, _):
        """"survived" or "killed by CASE"."""
        around = [first for first, last in self.functions if first <= mutant.line + 1 <= last]
        chosen = [run for run, called in self.runs if around and max(around) in called] or [
            run for run, _ in self.runs]
        with Pool(self.jobs, FORKED, load, (mutant.applied_to(self.text), )) as pool:
            noticed = pool.map(is_noticed, chosen)
            try:
                return next((f"killed by {run.case.name}" for run in chosen if next(noticed)), "survived")
            except BrokenProcessPool:  # out of memory, or of time where no signal is heard
                return "killed by its end"
            finally:
                pool.shutdown(wait=False, cancel_futures=True)
