#!/usr/bin/env python3
"""scripts/maintain/mutate: the mutants of a source, and a run on a tiny tree with known survivors.

usage: mutate_test.py PROJECT_SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "scripts/maintain"))
from parts.mutant_trial import succeeds  # noqa: E402
from parts.mutants import mutants_of, sample  # noqa: E402


def changes_in(line):
    """The mutants of a line of code, each with [old -> new] in it."""
    return sorted(mutant.name.removeprefix("a.cpp: ") for mutant in mutants_of("a.cpp", line + "\n"))


class Mutants(unittest.TestCase):
    def test_operators_and_constants(self):
        self.assertEqual(changes_in("x = a < b + 7;"), [
            "x = a < b + [7 -> 6];", "x = a < b + [7 -> 8];", "x = a < b [+ -> -] 7;",
            "x = a [< -> <=] b + 7;"])
        self.assertEqual(changes_in("x += !a && b >> 0x1p-53;"), [
            "x += !a && b >> [0x1p-53 -> 0x1p-52];", "x += !a && b [>> -> <<] 0x1p-53;",
            "x += !a [&& -> ||] b >> 0x1p-53;", "x += [! -> nothing]a && b >> 0x1p-53;",
            "x [+= -> -=] !a && b >> 0x1p-53;"])
        self.assertEqual(changes_in("return f(-a, true, 10'000u);"), [
            "return f(-a, [true -> false], 10'000u);", "return f(-a, true, [10'000 -> 10001]u);",
            "return f(-a, true, [10'000 -> 9999]u);", "return f([- -> nothing]a, true, 10'000u);"])
        self.assertEqual(changes_in("x = 0677 ^ 0xff;"), [
            "x = 0677 [^ -> |] 0xff;", "x = 0677 ^ [0xff -> 0x100];", "x = [0677 -> 0676] ^ 0xff;",
            "x = [0677 -> 0700] ^ 0xff;"])
        self.assertEqual(changes_in("x = 0.5; y = 1e200;"),
                         ["x = 0.5; y = [1e200 -> 1e201];", "x = [0.5 -> 1.5]; y = 1e200;"])

    def test_clauses_of_python(self):
        def clauses(line):
            return sorted(mutant.name.removeprefix("a.py: ") for mutant in mutants_of("a.py", line + "\n"))

        self.assertEqual(clauses("x = a[0] <= -b"), ["x = a[0] <= [- -> nothing]b", "x = a[0] [<= -> <] -b",
                                                     "x = a[0] [<= -> >=] -b"])
        self.assertEqual(clauses("if a and not b: f(c)"), [
            "if [a and -> nothing]not b: f(c)", "if [a and not b -> False]: f(c)",
            "if [a and not b -> True]: f(c)", "if a [and -> or] not b: f(c)",
            "if a and [not -> nothing]b: f(c)",
            "if a and not b: [f(c) -> pass]", "if a[ and not b -> nothing]: f(c)"])
        self.assertEqual(clauses("x = ('a', 'b') if a in ('c', 'd') else min(b)"), [
            "x = ('a', 'b') if [a in ('c', 'd') -> False] else min(b)",
            "x = ('a', 'b') if [a in ('c', 'd') -> True] else min(b)",
            "x = ('a', 'b') if a [in -> not in] ('c', 'd') else min(b)",
            "x = ('a', 'b') if a in ('c', 'd') else [min -> max](b)",
            "x = ('a'[, 'b' -> nothing]) if a in ('c', 'd') "
            "else min(b)", "x = (['a', 'b' -> 'b', 'a']) if a in ('c', 'd') else min(b)"])
        self.assertEqual(clauses("x = [y for y in z if y] + [3]"), [
            "x = [y for y in z if [y -> True]] + [3]", "x = [y for y in z if y] + [[3 -> 2]]",
            "x = [y for y in z if y] + [[3 -> 4]]", "x = [y for y in z if y] [+ -> -] [3]"])

    def test_conditions(self):
        self.assertEqual(changes_in("if (is_fine(a)) return b;"),
                         ["if ([is_fine(a) -> false]) return b;", "if ([is_fine(a) -> true]) return b;"])
        self.assertEqual(changes_in("if (auto a = f(); a.is_fine()) return;"), [
            "if (auto a = f();[ a.is_fine() -> false]) return;",
            "if (auto a = f();[ a.is_fine() -> true]) return;"])
        self.assertEqual(changes_in("while (is_fine()) go();"), ["while ([is_fine() -> false]) go();"])
        self.assertEqual(changes_in("if (auto* a = f()) return;"), [])

    def test_what_is_no_code_or_does_not_run_is_left_alone(self):
        for line in ("// a < b", "/* a < b */", 'f("a < 1", \'1\');', "#if A > 1", "#define A \\\n  1",
                     "assert(a < (b + 1));", "static_assert(a < 1);", "std::array<int, 3> a1;",
                     "void f(Type&& a, const Type& b, Type* c);", "template <typename T>"):
            self.assertEqual(changes_in(line), [])

    def test_equal_lines_have_different_names(self):
        self.assertEqual([mutant.name for mutant in mutants_of("a.cpp", "  ++a;\n++a;  \n")],
                         ["a.cpp: [++ -> --]a;", "a.cpp: [++ -> --]a; #2"])

    def test_a_mutant_is_the_source_with_one_change(self):
        self.assertEqual([mutant.applied_to("a - b;\n") for mutant in mutants_of("a.cpp", "a - b;\n")],
                         ["a + b;\n"])

    def test_a_sample_takes_every_line_before_a_second_mutant_of_any(self):
        mutants = mutants_of("a.cpp", "a + b + c + d + e;\na * b;\n++a;\n")
        for seed in range(20):
            order = sample(mutants, seed)
            self.assertEqual(sorted(order), mutants)
            self.assertEqual({mutant.line for mutant in order[:3]}, {0, 1, 2})

    def test_a_changed_line_leaves_the_order_of_the_others(self):
        lines = [f"a{i} + b;" for i in range(20)]
        before = [mutant.name for mutant in sample(mutants_of("a.cpp", "\n".join(lines) + "\n"), 1)]
        lines[7] = "c * d;"
        after = [mutant.name for mutant in sample(mutants_of("a.cpp", "\n".join(lines) + "\n"), 1)]
        self.assertNotEqual(before, sorted(before))
        self.assertEqual([name for name in before if "a7" not in name],
                         [name for name in after if "c [" not in name])


class Limits(unittest.TestCase):
    def test_a_program_that_does_not_end_has_failed_and_leaves_no_child(self):
        with tempfile.TemporaryDirectory() as folder:
            os.chmod(folder, 0o777)
            began = time.monotonic()
            self.assertFalse(succeeds(["sh", "-c", "(sleep 2; touch left) & wait"], 0.5, folder, os.environ))
            time.sleep(max(0.0, began + 3 - time.monotonic()))
            self.assertEqual(os.listdir(folder), [])

    def test_memory_is_limited(self):
        self.assertTrue(succeeds(["sh", "-c", 'test "$(ulimit -v)" -le 4194304'], 30, "/tmp",
                                 os.environ))  # in KiB

    def test_root_becomes_nobody(self):
        if os.geteuid() != 0:
            self.skipTest("the user is not root")
        self.assertTrue(
            succeeds(["sh", "-c", 'test "$(id -u)" = 65534 && ! test -w /dev'], 30, "/tmp", os.environ))


HALF = """alignas(4) const int two = 2;
int half(int x) {
  if (x < 0) return 0;
  return x / two;
}
"""
SURVIVORS = [
    "libpipeline/text/half.cpp: if (x < [0 -> 1]) return 0;",
    "libpipeline/text/half.cpp: if (x [< -> <=] 0) return 0;"]
TREE = {
    "libpipeline/text/half.cpp": HALF,
    "tests/text/half_test.cpp": "int half(int x);\nint main() { return half(7) == 3 ? 0 : 1; }\n",
    "tests/tools/negative.cpp": "int half(int x);\nint main() { return half(-2) == 0 ? 0 : 1; }\n",
    "tests/tools/CMakeLists.txt": "add_test(NAME Samples.AreTheSame COMMAND zbuf)\n",
    "tests/survivors.txt": f"Half of 0 is 0.\n    {SURVIVORS[0]}\n",
    "CMakeLists.txt": """cmake_minimum_required(VERSION 3.22)
project(tiny LANGUAGES CXX)
enable_testing()
add_library(pipeline libpipeline/text/half.cpp)
add_executable(text_tests tests/text/half_test.cpp)
set_target_properties(text_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/tests)
target_link_libraries(text_tests pipeline)
add_executable(zbuf tests/tools/negative.cpp)
target_link_libraries(zbuf pipeline)
foreach(tool model view project)
  add_custom_target(${tool})
endforeach()
add_subdirectory(tests/tools)
""",
}


class Run(unittest.TestCase):
    maxDiff = None

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        os.chmod(folder.name, 0o755)  # nobody runs the tests
        self.tree = pathlib.Path(folder.name)
        for name, text in TREE.items():
            (self.tree / name).parent.mkdir(parents=True, exist_ok=True)
            (self.tree / name).write_text(text)
        for room in ("lib", "maintain"):
            shutil.copytree(SOURCE / "scripts" / room, self.tree / "scripts" / room)

    def mutate(self, *options):
        done = subprocess.run(
            [self.tree / "scripts/maintain/mutate", *options, self.tree / "libpipeline/text"],
            capture_output=True, text=True, timeout=240)
        self.assertEqual(done.stderr, "")
        return done.returncode, done.stdout

    def test_a_planted_mistake_is_killed_and_a_planted_survivor_is_found(self):
        summary = ("text: 6 of 8 killed, 75.0 %\nall: 6 of 8 killed, 75.0 %\n"
                   f"2 survived, 1 of them with a reason\n    {SURVIVORS[1]}\n")
        status, output = self.mutate()
        self.assertEqual((status, output[output.index("text:"):]), (1, summary))
        lines = sorted(line.split(" s  ")[1] for line in output.splitlines() if " s  " in line)
        self.assertEqual(lines, sorted([
            "does not compile | libpipeline/text/half.cpp: alignas([4 -> 3]) const int two = 2;",
            "does not compile | libpipeline/text/half.cpp: alignas([4 -> 5]) const int two = 2;",
            "killed by text_tests | libpipeline/text/half.cpp: alignas(4) const int two = [2 -> 1];",
            "killed by text_tests | libpipeline/text/half.cpp: alignas(4) const int two = [2 -> 3];",
            "killed by end-to-end tests | libpipeline/text/half.cpp: if ([x < 0 -> false]) return 0;",
            "killed by text_tests | libpipeline/text/half.cpp: if ([x < 0 -> true]) return 0;",
            "killed by end-to-end tests | libpipeline/text/half.cpp: if (x < 0) return [0 -> 1];",
            "killed by text_tests | libpipeline/text/half.cpp: return x [/ -> *] two;",
            *(f"survived | {name}" for name in SURVIVORS)]))
        self.assertEqual((self.tree / "libpipeline/text/half.cpp").read_text(), HALF)
        self.assertEqual(self.mutate(), (1, summary))  # nothing is left to do
        # Survivors are tried again on request; with a reason for each, there is nothing to report.
        with (self.tree / "tests/survivors.txt").open("a") as reasons:
            reasons.write(f"    {SURVIVORS[1]}\n")
        status, output = self.mutate("--survivors")
        self.assertEqual((status, [line.split(" s  ")[-1] for line in output.splitlines()][2:]), (0, [
            "text: 6 of 8 killed, 75.0 %", "all: 6 of 8 killed, 75.0 %", "2 survived, 2 of them with a reason"
        ]))

        # A reason for what is no mutant, or no longer, is reported; one for a file that is not asked for is
        # not.
        with (self.tree / "tests/survivors.txt").open("a") as reasons:
            reasons.write(
                "    libpipeline/text/half.cpp: if (x < 0) return [0 -> 7];\n    libpipeline/other.cpp: x = "
                "[0 -> 1];\n"
            )
        status, output = self.mutate()
        self.assertEqual((status, output.splitlines()[-2:]), (1, [
            "These have a reason, but are no mutants:",
            "    libpipeline/text/half.cpp: if (x < 0) return [0 -> 7];"]))

    def test_a_test_that_fails_without_a_mutant_ends_the_run(self):
        (self.tree / "tests/text/half_test.cpp").write_text("int main() { return 1; }\n")
        done = subprocess.run([self.tree / "scripts/maintain/mutate", self.tree / "libpipeline/text"],
                              capture_output=True, text=True, timeout=240)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (1, "", "mutate: text_tests fails without a mutant\n"))


if __name__ == "__main__":
    unittest.main()
