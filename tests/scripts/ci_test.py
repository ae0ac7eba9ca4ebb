#!/usr/bin/env python3
""".ci/run, scripts/check and scripts/maintain/test-report count and name everything that did not pass. The
ctest is real, with tests of one shell line each; all other programs are stubs.

usage: ci_test.py SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
PRESETS = ("release", "asan", "fuzz", "tsan", "clang")
STUBS = ("scripts/install-packages", "scripts/build-release", "scripts/build-playground", "scripts/check",
         "scripts/measure/bench", "scripts/maintain/fuzz", "scripts/maintain/tidy",
         "scripts/maintain/compare-builds", "bin/cmake", "bin/git", "bin/clang-format", "bin/yapf3")
LIB = [str(path.relative_to(SOURCE)) for path in (SOURCE / "scripts/lib").glob("**/*.py")]
# The folder of a preset's tests, in this tree.
CTEST = f"""#!/bin/sh
[ "$1" = --preset ] || exit 99
tests=presets/$2
shift 2
exec {shutil.which("ctest")} --test-dir "$tests" "$@"
"""
GTEST_SKIP = r"printf 'a_test.cpp:7: Skipped\nno moon tonight\n\n[  SKIPPED ] A.B (0 ms)\n'"
CASES = """import unittest
class Cases(unittest.TestCase):
    def test_with_a_browser(self): self.skipTest("no browser")
    def test_with_another(self): self.skipTest("no browser")
    def test_with_nothing(self): %s
unittest.main(module=None if __name__ != "__main__" else "__main__")
"""


class Tree(unittest.TestCase):
    """A source tree in which everything passes."""

    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.tree = pathlib.Path(folder.name, "tree")
        for stub in STUBS:
            self.put(stub, "#!/bin/sh\n")
        for sums in ("scripts/check", "scripts/measure/bench", "scripts/maintain/fuzz",
                     "scripts/maintain/compare-builds"):
            self.put(sums, "#!/bin/sh\necho 1 passed, 0 failed\n")
        self.put("tests/reference/agreement_test.py", "")
        self.put("bin/ctest", CTEST)
        self.put("Makefile.samples", "check:\n\t@echo 2 passed, 0 failed\n")
        for preset in PRESETS:
            self.set_tests(preset, ("ThreadPool.Works", "true"))
        self.set_tests("release", ("Passes", "true"), ("Takes.Longer", "true", "LABELS", "all"),
                       ("Takes.Minutes", "true", "LABELS", "matrix"),
                       ("Tools.RunInTheBrowser", "true", "LABELS", "matrix"))
        for real in (".ci/run", "scripts/maintain/test-report", *LIB):
            self.put(real, (SOURCE / real).read_text())

    def put(self, path, text):
        (self.tree / path).parent.mkdir(parents=True, exist_ok=True)
        (self.tree / path).write_text(text)
        (self.tree / path).chmod(0o755)

    def set_tests(self, preset, *tests):
        """Sets the tests of a preset: (name, shell command, property, its value)."""
        lines = []
        for name, command, *properties in tests:
            lines.append(f"add_test([=[{name}]=] sh -c [=[{command}]=])")
            if properties:
                lines.append(
                    f"set_tests_properties([=[{name}]=] PROPERTIES {properties[0]} [=[{properties[1]}]=])")
        self.put(f"presets/{preset}/CTestTestfile.cmake", "\n".join(lines) + "\n")

    def run_there(self, *words, **variables):
        environment = {
            name: value
            for name, value in os.environ.items() if not name.startswith(("CTEST_", "LIMIT"))}
        environment |= {"PATH": f"{self.tree}/bin:{os.environ['PATH']}", **variables}
        return subprocess.run(words, cwd=self.tree, env=environment, stdin=subprocess.DEVNULL,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=100)

    def assert_ends(self, done, status, *lines):
        """The run ends with this status, these named failures and skips, and the counts."""
        printed = done.stdout.splitlines()
        begin = max(number for number, line in enumerate(printed)
                    if not line.startswith(("failed: ", "skipped: ")) and number < len(printed) - 1)
        self.assertEqual((done.returncode, printed[begin + 1:]), (status, list(lines)), done.stdout)


class Check(Tree):
    def setUp(self):
        super().setUp()
        self.put("scripts/check", (SOURCE / "scripts/check").read_text())

    def check(self, *options):
        return self.run_there("scripts/check", *options)

    def cases(self, name, last):
        """A test with three Python cases, whose last one is `last`."""
        self.put(f"{name}.py", CASES % last)
        return name, f"python3 {SOURCE}/tests/run_cases.py {self.tree}/{name}.py", "SKIP_RETURN_CODE", "77"

    def test_tests_and_samples_add_up(self):
        self.assert_ends(self.check(), 0, "3 passed, 0 failed")

    def test_what_takes_longer_is_run_on_demand(self):
        self.assert_ends(self.check("--all"), 0, "4 passed, 0 failed")

    def test_an_old_name_gives_the_new_one(self):
        done = self.check("--long")
        self.assertEqual((done.returncode, done.stdout),
                         (2, "check: --long is now .ci/run --matrix; check --all runs all other tests\n"))

    def test_every_failed_test_is_named(self):
        self.set_tests("release", ("First", "true"), ("Second", "false"), ("Third.Fails", "kill -SEGV $$"),
                       ("Fourth", "sleep 9", "TIMEOUT", "1"))
        self.assert_ends(self.check(), 1, "failed: Second", "failed: Third.Fails", "failed: Fourth",
                         "3 passed, 3 failed")

    def test_a_failed_case_is_named_with_its_test(self):
        self.set_tests("release", self.cases("Cases", "self.fail()"))
        self.assert_ends(self.check(), 1, "failed: Cases: test_with_nothing",
                         "skipped: Cases: no browser (2 cases)", "2 passed, 1 failed, 2 skipped")

    def test_a_skipped_test_has_not_passed(self):
        self.set_tests("release", ("Passes", "true"),
                       ("A.B", GTEST_SKIP, "SKIP_REGULAR_EXPRESSION", r"\[  SKIPPED \]"))
        self.assert_ends(self.check(), 0, "skipped: A.B: no moon tonight", "3 passed, 0 failed, 1 skipped")

    def test_skipped_cases_are_counted_beside_their_test(self):
        self.set_tests("release", self.cases("Cases", "print('x' * 5000)"))
        self.assert_ends(self.check(), 0, "skipped: Cases: no browser (2 cases)",
                         "3 passed, 0 failed, 2 skipped")

    def test_a_test_whose_cases_are_all_skipped_has_not_passed(self):
        self.set_tests("release", ("Passes", "true"), self.cases("Cases", "self.skipTest('nor this')"))
        self.assert_ends(self.check(), 0, "skipped: Cases: no browser (2 cases)", "skipped: Cases: nor this",
                         "3 passed, 0 failed, 3 skipped")

    def test_a_test_without_its_program_is_a_failure(self):
        self.put("presets/release/CTestTestfile.cmake",
                 "add_test(Missing /no/such/program)\nadd_test(Passes true)\n")
        self.assert_ends(self.check(), 1, "failed: Missing", "3 passed, 1 failed")

    def test_no_test_is_a_failure(self):
        self.assert_ends(self.check("-R", "NoSuchTest"), 1, "failed: no test ran", "2 passed, 1 failed")

    def test_a_ctest_that_fails_without_results_is_one(self):
        self.put("bin/ctest", "#!/bin/sh\nexit 8\n")
        self.assert_ends(self.check(), 1, "failed: ctest: there are no results", "2 passed, 1 failed")

    def test_a_ctest_that_fails_though_its_tests_passed_is_one(self):
        self.put("bin/ctest", CTEST.replace("exec ", "") + "exit 7\n")
        self.assert_ends(self.check(), 1, "failed: ctest: exit status 7", "3 passed, 1 failed")

    def test_a_sample_that_differs_is_named(self):
        self.put("Makefile.samples",
                 "check:\n\t@echo 'FAIL  samples/a differs'; echo 1 passed, 1 failed; false\n")
        self.assert_ends(self.check(), 1, "failed: samples/a differs", "2 passed, 1 failed")

    def test_samples_that_are_not_made_are_a_failure(self):
        self.put("Makefile.samples", "check:\n\t@false\n")
        self.assert_ends(self.check(), 1, "failed: samples: they were not made", "1 passed, 1 failed")

    def test_packages_or_a_build_that_fail_are_named(self):
        for stub, name in (("install-packages", "packages"), ("build-release", "build")):
            with self.subTest(stub):
                self.put(f"scripts/{stub}", "#!/bin/sh\nexit 1\n")
                self.assert_ends(self.check(), 1, f"failed: {name}", "0 passed, 1 failed")
                self.put(f"scripts/{stub}", "#!/bin/sh\n")


class Ci(Tree):
    def ci(self, *options, **variables):
        return self.run_there("bash", ".ci/run", *options, CI="true", **variables)

    def test_what_passes_adds_up(self):
        done = self.ci()
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertRegex(done.stdout, r"\n[1-9][0-9]* passed, 0 failed\n$")

    def test_without_time_every_step_is_a_failure(self):
        done = self.ci(LIMIT="0")
        names = done.stdout.splitlines()[:-1]
        self.assertGreater(len(names), 8)
        for name in names:
            self.assertRegex(name, "^failed: .*: left out, the time was over$")
        self.assertEqual((done.returncode, done.stdout.splitlines()[-1]),
                         (1, f"0 passed, {len(names)} failed"))

    def test_a_step_that_is_stopped_is_a_failure(self):
        for step, name in (("scripts/install-packages", "packages and preset"), ("scripts/check",
                                                                                 "gcc, release: all tests")):
            with self.subTest(step):
                before = (self.tree / step).read_text()
                self.put(step, "#!/bin/sh\necho 1 passed, 0 failed\nsleep 60\n")
                done = self.ci(LIMIT="0.05")
                self.assertIn(f"failed: {name}: stopped, the time was over\n", done.stdout)
                self.assertRegex(done.stdout, r"\n(\d+) passed, [1-9]\d* failed\n$")
                self.assertEqual(done.returncode, 1)
                self.put(step, before)

    def test_a_limit_that_is_no_number_is_a_mistake(self):
        for limit in ("soon", "-1", "1e9", "."):
            done = self.ci(LIMIT=limit)
            self.assertEqual((done.returncode, done.stdout),
                             (2, "usage: [LIMIT=MINUTES] .ci/run [--matrix]\n"))
        self.assertEqual(self.ci("--quick").returncode, 2)

    def test_the_matrix_has_steps_of_its_own_and_no_limit(self):
        self.put("scripts/maintain/tidy", "#!/bin/sh\nexit 1\n")
        self.assertEqual(self.ci().returncode, 0)
        self.assert_ends(self.ci("--matrix", LIMIT="0"), 1, "failed: clang-tidy",
                         self.ci("--matrix").stdout.splitlines()[-1])

    def test_failed_and_skipped_tests_of_all_presets_are_named(self):
        self.put(
            "scripts/check",
            "#!/bin/sh\necho failed: A.B\necho 'skipped: C.D: no moon'\necho 3 passed, 1 failed, 1 skipped\n"
            "exit 1\n")
        self.set_tests("asan", ("Overflows.Here", "false"))
        self.set_tests("fuzz", ("Ends.Early", "false"),
                       ("A.B", GTEST_SKIP, "SKIP_REGULAR_EXPRESSION", r"\[  SKIPPED \]"))
        done = self.ci("--matrix")
        self.assert_ends(done, 1, "failed: gcc, release: all tests: A.B",
                         "skipped: gcc, release: all tests: C.D: no moon",
                         "failed: gcc, ASan and UBSan: modules: Overflows.Here",
                         "failed: clang, ASan and UBSan: modules: Ends.Early",
                         "skipped: clang, ASan and UBSan: modules: A.B: no moon tonight",
                         done.stdout.splitlines()[-1])
        self.assertRegex(done.stdout.splitlines()[-1], r"^\d+ passed, 3 failed, 2 skipped$")

    def test_counts_without_names_are_named_by_their_step(self):
        self.put("scripts/measure/bench", "#!/bin/sh\necho 0 passed, 0 failed, 39 skipped\n")
        self.put("scripts/maintain/fuzz", "#!/bin/sh\necho 7 passed, 1 failed\nexit 1\n")
        done = self.ci()
        self.assert_ends(done, 1, "skipped: gcc, release: instructions: 39, see there",
                         "failed: clang, ASan and UBSan: corpora and new inputs: 1, see there",
                         done.stdout.splitlines()[-1])

    def test_a_status_or_counts_that_are_missing_are_a_failure(self):
        self.put("scripts/check", "#!/bin/sh\necho 3 passed, 0 failed\nexit 1\n")
        self.put("scripts/measure/bench", "#!/bin/sh\n")
        self.put("bin/cmake", "#!/bin/sh\ncase $* in *asan*) echo no compiler; exit 1 ;; esac\n")
        done = self.ci()
        self.assert_ends(done, 1, "failed: gcc, release: all tests", "failed: gcc, release: instructions",
                         "failed: gcc, ASan and UBSan: modules",
                         done.stdout.splitlines()[-1])
        self.assertIn("no compiler\n", done.stdout)


if __name__ == "__main__":
    unittest.main()
