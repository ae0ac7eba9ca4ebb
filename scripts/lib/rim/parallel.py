"""Jobs side by side: GNU parallel runs lines of shell in a folder, here or on other machines over ssh."""
import contextlib
import os
import shutil
import subprocess
from dataclasses import dataclass, field

from lib.rim.child import adopt_orphans
from lib.rim.command import CommandFailure
from lib.rim.progress import Progress


@dataclass(frozen=True)
class Job:
    line: str  # of sh
    takes: list = field(default_factory=list)  # the files it reads, besides those that all jobs read
    gives: list = field(default_factory=list)  # the files it writes


def expect_parallel():
    if not shutil.which("parallel"):
        raise CommandFailure("parallel is missing (Debian package parallel)")


def run_parallel(folder, jobs, name, common=(), options=()):
    """Runs the jobs in the folder; returns their stdout from a form feed on. `common` are files that all
    jobs read, `name` is the command's. Another machine works in a folder of its own, which is removed
    afterwards: files are sent there, and those of a job come back."""
    words = ["parallel", "--will-cite"]
    if os.access("/dev/shm", os.W_OK):  # what jobs print is kept in memory: the disk may be full
        words += ["--tmpdir", "/dev/shm"]
    if any(word.startswith(("--sshlogin", "-S")) for word in options):
        takes, gives = max(len(job.takes) for job in jobs), max(len(job.gives) for job in jobs)
        columns = [f"{{{i}}}" for i in range(2, 2 + takes + gives)]  # with the files of a job
        files = {"--basefile": common, "--transferfile": columns[:takes], "--return": columns[takes:]}
        words += ["--workdir", f"pipeline-{name}-{os.getpid()}", "--cleanup", "--colsep", "\t"]
        words += [word for option, names in files.items() for file in names for word in (option, file)]
        lines = [
            "\t".join([job.line, *job.takes, *[""] * (takes - len(job.takes)), *job.gives]) for job in jobs]
        words += [*options, "eval", "{1}"]
    else:
        lines = [job.line for job in jobs]
        words += options
    adopt_orphans()
    with os.fdopen(os.memfd_create("printed"), "r+") as printed, subprocess.Popen(
            words, cwd=folder, stdin=subprocess.PIPE, stdout=printed, text=True,
            env={**os.environ, "PARALLEL_SHELL": "/bin/sh"}) as process:
        try:
            with contextlib.suppress(BrokenPipeError):
                process.stdin.write("".join(line + "\n" for line in lines))
                process.stdin.close()
            show_files(process, [os.path.join(folder, file) for job in jobs for file in job.gives])
        except BaseException:
            process.kill()
            raise
        printed.seek(0)
        others, _, failures = printed.read().partition("\f")
        print(others, end="", flush=True)  # of an option such as --dry-run
        return failures


def show_files(process, files):
    """Shows how many of the files are there, until the process ends."""
    with Progress(len(files)) as progress:
        while True:
            try:
                return process.wait(0.2 if progress.is_shown else None)
            except subprocess.TimeoutExpired:
                progress.reach(sum(map(os.path.exists, files)))
