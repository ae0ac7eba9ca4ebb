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


def columns(jobs, files_of, first):
    """The columns from `first` on that hold the files of jobs."""
    return range(first, first + max(len(files_of(job)) for job in jobs))


def run_parallel(folder, jobs, name, common=(), options=()):
    """Runs the jobs in the folder; returns their stdout from a form feed on. `common` are files that all
    jobs read, `name` is the command's. Another machine works in a folder of its own, which is removed
    afterwards: files are sent there, and those of a job come back."""
    words = ["parallel", "--will-cite"]
    if os.access("/dev/shm", os.W_OK):  # what jobs print is kept in memory: the disk may be full
        words += ["--tmpdir", "/dev/shm"]
    if any(word.startswith(("--sshlogin", "-S")) for word in options):
        takes = columns(jobs, lambda job: job.takes, 2)
        gives = columns(jobs, lambda job: job.gives, takes.stop)
        words += ["--workdir", f"pipeline-{name}-{os.getpid()}", "--cleanup", "--colsep", "\t"]
        for file in common:
            words += ["--basefile", file]
        for column in takes:
            words += ["--transferfile", f"{{{column}}}"]
        for column in gives:
            words += ["--return", f"{{{column}}}"]
        lines = [
            "\t".join([job.line, *job.takes, *[""] * (len(takes) - len(job.takes)), *job.gives])
            for job in jobs]
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
