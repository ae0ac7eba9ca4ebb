"""Builds mutants in a copy of the source tree, and runs the tests that should fail."""
import contextlib
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

NOBODY = 65534
MEMORY_LIMIT = 4 << 30  # a mutant may never cease to allocate
CCACHE = {"CCACHE_NOHASHDIR": "1", "CCACHE_SLOPPINESS": "pch_defines,time_macros"}


class DoesNotCompile(Exception):
    pass


def copy_tree(source, target):
    """Makes the target a copy without build folders and hidden files; what has not changed keeps its time."""
    def visible(folder):
        return {path.name for path in folder.iterdir() if path.name != "build"
                and not path.name.startswith((".", "__pycache__"))}

    target.mkdir(parents=True, exist_ok=True)
    for name in visible(target) - visible(source):
        path = target / name
        shutil.rmtree(path) if path.is_dir() else path.unlink()
    for name in visible(source):
        path, copy = source / name, target / name
        if path.is_dir():
            copy_tree(path, copy)
        elif not copy.exists() or copy.read_bytes() != path.read_bytes():
            shutil.copy(path, copy)


def run(words, limit, environment, **settings):
    """The exit status of a program, None if it does not end within the limit in seconds, and its output. None
    of its children stays."""
    with tempfile.TemporaryFile("w+", errors="replace") as output:
        process = subprocess.Popen([str(word) for word in words], env=environment, start_new_session=True,
                                   stdin=subprocess.DEVNULL, stdout=output, stderr=subprocess.STDOUT,
                                   **settings)
        try:
            status = process.wait(limit)
        except subprocess.TimeoutExpired:
            status = None
        finally:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()
        output.seek(0)
        return status, output.read()


def succeeds(words, limit, folder, environment):
    """True if a test program ends with status 0 within the limit in seconds. It runs as nobody if root
    started it, since a mutant of code that writes files may replace any of them, even a device."""
    user = {"user": NOBODY, "group": NOBODY, "extra_groups": []} if os.geteuid() == 0 else {}
    status, _ = run(words, limit, dict(environment, TMPDIR=str(folder)), cwd=folder,
                    preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS,
                                                          (MEMORY_LIMIT, MEMORY_LIMIT)), **user)
    return status == 0


class Trial:
    """The copy, its build folder, and how long the tests take there without a mutant."""

    def __init__(self, source, scratch, jobs):
        self.copy, self.build, self.temporary = (scratch / name for name in ("source", "build", "temporary"))
        self.jobs = str(jobs)
        self.seconds = {}
        self.environment = dict(os.environ, CCACHE_BASEDIR=str(self.copy), **CCACHE)
        copy_tree(source, self.copy)
        options = ["-DCMAKE_CXX_COMPILER_LAUNCHER=ccache"] if shutil.which("ccache") else []
        if shutil.which("ld.lld"):
            options.append("-DCMAKE_EXE_LINKER_FLAGS=-fuse-ld=lld")  # links in half the time
        if os.geteuid() == 0:
            options.append("-DPython3_EXECUTABLE=" +
                           shutil.which("python3", path="/usr/bin:/bin"))  # one that nobody may run
        # GoogleTest's list of tests is not needed, and a mutant may be unable to write it.
        self.call("cmake", "-S", self.copy, "-B", self.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                  "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DPIPELINE_TESTS=ON", "-DCMAKE_UNITY_BUILD=OFF",
                  "-DCMAKE_GTEST_DISCOVER_TESTS_DISCOVERY_MODE=PRE_TEST", *options)

    def call(self, *words):
        # A compiler may never cease to evaluate a constant.
        status, output = run(words, 1800, self.environment)
        if status != 0:
            raise DoesNotCompile(output)

    def make(self, *targets):
        self.call("cmake", "--build", self.build, "-j", self.jobs, "--target", *targets)

    def test(self, test, limit=None):
        """True if a test succeeds within the limit in seconds; its temporary files do not stay."""
        shutil.rmtree(self.temporary, ignore_errors=True)
        self.temporary.mkdir()
        self.temporary.chmod(0o777)
        return succeeds(self.words_of(test), limit, self.temporary, self.environment)

    def programs_of(self, file):
        """The test programs of a source: that of its room, then those of rooms whose tests include its
        header."""
        path = pathlib.PurePath(file)
        tests = sorted((self.copy / "tests").glob("*/*_test.cpp"))
        including = [test.parent.name for test in tests if f'"{path.with_suffix(".h")}"' in test.read_text()]
        rooms = [room for room in (path.parent.name,) if any(test.parent.name == room for test in tests)]
        return [f"{room}_tests" for room in dict.fromkeys(rooms + including)]

    def words_of(self, test):
        """The command of a test program, or of end-to-end tests, which are named by a regular expression."""
        if test.startswith("^"):
            return ["ctest", "--test-dir", self.build / "tests/tools", "--stop-on-failure", "-j", self.jobs,
                    "-R", test]
        return [self.build / "tests" / test, "--gtest_brief=1", "--gtest_fail_fast",
                "--gtest_filter=-*.Long*:*Long.*"]

    def check_unchanged(self, tests):
        """Measures the tests without a mutant; they have to pass."""
        if os.geteuid() == 0:
            for folder, _, files in os.walk(self.build / "tests/tools"):
                for path in (folder, *(os.path.join(folder, file) for file in files)):
                    os.chown(path, NOBODY, NOBODY)  # ctest keeps its notes there
        for test in tests:
            began = time.monotonic()
            if not self.test(test):
                sys.exit(f"mutate: {test} fails without a mutant")
            self.seconds[test] = time.monotonic() - began

    def outcome(self, mutant, end_to_end):
        """"survived", "does not compile", or "killed by ..."."""
        path = self.copy / mutant.file
        original = path.read_text()
        path.write_text(mutant.applied_to(original))
        try:
            self.make("pipeline")
            for program in self.programs_of(mutant.file):
                self.make(program)
                if not self.test(program, 10 + 10 * self.seconds[program]):
                    return f"killed by {program}"
            if end_to_end:
                self.make("model", "view", "project", "zbuf")
                if not self.test(end_to_end, 10 + 10 * self.seconds[end_to_end]):
                    return "killed by end-to-end tests"
            return "survived"
        except DoesNotCompile:
            return "does not compile"
        finally:
            path.write_text(original)
