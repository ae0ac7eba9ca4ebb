#!/usr/bin/env python3
"""The commands in scripts answer --help, and work from any folder and through a link.

usage: scripts_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import ast
import itertools
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from toolbox import BIN, SOURCE, ToolTest, run_script

ROOMS = tuple(SOURCE / "scripts" / room for room in (".", "measure", "maintain", "package"))


def commands():
    return [
        path for room in ROOMS for path in sorted(room.iterdir())
        if path.is_file() and os.access(path, os.X_OK)]


class Help(ToolTest):
    def test_every_command_answers(self):
        self.assertGreater(len(commands()), 15)
        for command in commands():
            with self.subTest(command.relative_to(SOURCE)):
                done = subprocess.run([command, "--help"], capture_output=True, text=True, timeout=60)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, rf"\A[Uu]sage: {command.name}\b")
                self.assertEqual([line for line in done.stdout.splitlines() if len(line) > 80], [])

    def test_help_that_cannot_be_written_is_a_failure(self):
        """Of the commands in Python, which all end in one function, one for each status."""
        ways = ("> /dev/full", "No space left on device"), (">&-", "Bad file descriptor")
        in_python = [path for path in commands() if path.read_bytes().startswith(b"#!/usr/bin/env python3")]
        for command in in_python:
            self.assertRegex(command.read_text(), rf'\n    run_command\(main, "{command.name}"')
        chosen = [
            *(path for path in commands() if path not in in_python),
            *(SOURCE / "scripts" / name for name in ("stages", "compare", "grade", "explain"))]
        for command, (channel, reason) in itertools.product(chosen, ways):
            with self.subTest(command.relative_to(SOURCE), channel=channel):
                done = subprocess.run(["sh", "-c", f'"$0" --help {channel}', command], capture_output=True,
                                      text=True, timeout=60)
                self.assertRegex(done.stderr, rf"\A({command.name}|cat): .*{reason}\n\Z")
                self.assertEqual(done.returncode, 2 if "failure_status=2" in command.read_text() else 1)


class Writing(ToolTest):
    """Only two modules make, replace or remove what a user may have: no command does it by itself."""

    BY_ITSELF = re.compile(
        r"""\b(mkdir|makedirs|mkdtemp|rmtree|rmdir|unlink|write_text|write_bytes)\b"""
        r"""|\b(copyfile|copytree|shutil\.(copy|move)|os\.(remove|replace|rename|link|symlink)|mv|rm)\b"""
        r"""|open\([^()]*(\([^()]*\))?[^()]*["'][wax]b?\+?["']""")
    REASONS = {
        "check-stage": "removes the file of a long stderr that it kept in the round before",
        "lib/rim/output_file.py": "owns an output file",
        "lib/rim/work_folder.py": "owns a folder to work in",
        "lib/rim/command.py": "owns the temporary folder of a command",
        "lib/rim/input_file.py": "in the temporary folder: a copy of what is no file",
        "lib/running/pipe_tools.py": "in the temporary folder of trade, and the null device",
        "lib/running/pipe.py": "in its temporary folder",
        "fly_parts/pipe.py": "in its temporary folder",
        "lib/judging/program.py": "in the temporary folder of check-stage and grade",
        "grade_parts/kit_classroom50.py": "a result that was handed in, by the name of its own",
        "grade_parts/programs.py": "in the temporary folder of grade",
        "film_parts/frames.py": "its jobs, the shell code of their own",
        "check": "the folder build of the source tree",
        "build-release": "the folder build of the source tree",
        "install-packages": "the folder build of the source tree",
        "build-playground": "the folder build of the source tree, and files of its own in another",
        "playground/make-root": "the folder build of the source tree",}
    # They write into the source tree, build, or the folder that --out names.
    ROOMS_OF_DEVELOPERS = ("measure", "maintain", "package")

    def test_no_command_does_it_by_itself(self):
        found = set()
        for path in (SOURCE / "scripts").rglob("*"):
            name = path.relative_to(SOURCE / "scripts")
            if (path.is_file() and name.parts[0] not in self.ROOMS_OF_DEVELOPERS
                    and path.suffix in ("", ".py")):
                code = re.sub(r'"""[\s\S]*?"""', "", re.sub(r"(^|\s)#.*", "", path.read_text()))
                if self.BY_ITSELF.search(code):
                    found.add(str(name))
        self.assertEqual(found, set(self.REASONS))

    def test_each_way_would_be_found(self):
        for line in ("os.mkdir(x)", "path.unlink()", "shutil.rmtree(x)", "os.replace(a, b)", 'open(x, "w")',
                     "open(path / 'a', 'wb')", 'open(os.path.join(a, "b"), "ab")', 'open(x, "x")',
                     "p.write_text(s)", "shutil.copy(a, b)", "rm -rf x"):
            self.assertRegex(line, self.BY_ITSELF)
        for line in ('open(x, "rb")', "open(x)", "remove_files(x)", "firm"):
            self.assertNotRegex(line, self.BY_ITSELF)


class Columns(ToolTest):
    def test_python_fits_into_110(self):
        """But for the reference, in which a rule of the specification is a line."""
        wide = []
        for room in ("scripts", "tests"):
            for path in (SOURCE / room).rglob("*"):
                is_script = not path.suffix and path.is_file() and b"python3" in path.read_bytes()[:60]
                if path.suffix == ".py" or is_script:
                    lines = enumerate(path.read_text().splitlines(), 1)
                    wide += [f"{path.name}:{number}" for number, line in lines if len(line) > 110]
        self.assertEqual([place for place in wide if not place.startswith("reference.py:")], [])


class OldNames(ToolTest):
    def test_an_option_that_is_gone_names_the_new_one(self):
        for command, option, now in (("picture", "--up", "--up-axis"), ("compare", "--five", "--hand-in"),
                                     ("grade", "--out", "--output"), ("trade", "--coverage", "--rule")):
            for word in (option, f"{option}=z"):
                done = run_script(command, word, "a", "b")
                expected = f"{command}: expected an option of {command}, found '{word}' (now {now})"
                self.assertEqual((done.returncode, done.stdout, done.stderr),
                                 (2, "", f"{expected} (try {command} --help)\n"))


class OldPython(ToolTest):
    """The oldest Python is 3.9 for the commands, as lib/rim/command.py says, and 3.10 for the tests."""
    def test_no_command_uses_newer_syntax(self):
        modules = [path for path in (SOURCE / "scripts").rglob("*.py")]
        scripts = [path for path in commands() if path.read_bytes().startswith(b"#!/usr/bin/env python3")]
        self.assertGreater(len(scripts), 10)
        for path in modules + scripts:
            ast.parse(path.read_text(), str(path), feature_version=(3, 9))
        for path in (SOURCE / "tests").rglob("*.py"):
            ast.parse(path.read_text(), str(path), feature_version=(3, 10))

    def test_an_older_python_is_refused(self):
        refusal = "explain: Python 3.9 or newer is needed, found 3.8\n"
        for version, status, message in (((3, 8, 18), 1, refusal), ((3, 9, 0), 0, "")):
            line = (f"import sys; sys.version_info = {version}; sys.argv = ['some/explain']; "
                    f"sys.path.insert(0, {str(SOURCE / 'scripts')!r}); import lib.rim.command")
            done = subprocess.run([sys.executable, "-B", "-c", line], capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (status, message))

    def test_the_oldest_python_there_is_runs_a_command(self):
        python = shutil.which("python3.9")
        if not python or subprocess.run([python, "--version"], capture_output=True).returncode != 0:
            self.skipTest("there is no Python 3.9")
        sample = SOURCE / "samples/worked-example"
        done = subprocess.run([
            python, "-B", SOURCE / "scripts/compare", "--hand-in", sample, sample / "scene.txt",
            sample / "config.txt"], capture_output=True, text=True, env={**os.environ, "BIN": str(BIN)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))


class Readme(ToolTest):
    def test_lists_every_command(self):
        scripts = SOURCE / "scripts"
        listed = re.findall(r"^- `([^`]+[^`/])`:", (scripts / "README.md").read_text(), re.M)
        self.assertEqual(sorted(listed),
                         sorted([*(str(path.relative_to(scripts)) for path in commands()), "view.awk"]))


class ThroughALink(ToolTest):
    def setUp(self):
        super().setUp()
        self.tree = pathlib.Path("a copy").resolve()
        shutil.copytree(SOURCE / "scripts", self.tree / "scripts")
        shutil.copytree(SOURCE / "samples/worked-example", self.tree / "samples/worked-example")
        (self.tree / "build/release").mkdir(parents=True)
        (self.tree / "build/release/bin").symlink_to(BIN)
        self.elsewhere = pathlib.Path("some/where/else").resolve()
        self.elsewhere.mkdir(parents=True)

    def call(self, command, *words):
        link = self.elsewhere / pathlib.Path(command).name
        link.symlink_to(self.tree / "scripts" / command)
        return subprocess.run([link, *words], cwd=self.elsewhere, env={"PATH": "/usr/bin:/bin"},
                              capture_output=True, text=True, timeout=60)

    def test_a_shell_command_finds_the_source_tree(self):
        done = self.call("demo", "no-such-sample")
        self.assertEqual((done.returncode, done.stderr),
                         (2, "demo: no sample no-such-sample; there are: samples/worked-example/\n"))
        (self.elsewhere / "demo").unlink()
        done = self.call("demo", "no-such-sample", "more")
        self.assertEqual((done.returncode, done.stdout, done.stderr[:18]), (2, "", "usage: demo [NAME]"))

    def test_a_shell_command_finds_the_tools(self):
        sample = self.tree / "samples/worked-example"
        done = self.call("stages", sample / "scene.txt", sample / "config.txt", "five")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual((self.elsewhere / "five/stage3.txt").read_bytes(),
                         (sample / "stage3.txt").read_bytes())

    def test_a_command_that_maintains_finds_the_source_tree(self):
        done = self.call("maintain/tidy")  # it fails, since the copy cannot be built
        self.assertEqual(done.returncode, 1)
        self.assertTrue((self.tree / "build/tidy.log").exists())


if __name__ == "__main__":
    unittest.main()
