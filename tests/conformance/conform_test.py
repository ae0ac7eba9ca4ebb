#!/usr/bin/env python3
"""The runner of the conformance pack reads its pages, judges outputs and says what is wrong with a program.

usage: conform_test.py BIN_DIR SOURCE_DIR
"""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN = pathlib.Path(sys.argv.pop()).resolve()
PACK = SOURCE / "tests/conformance"
sys.path.insert(0, str(PACK))
from conform_parts.cases import STAGES, Case, extract, read_cases  # noqa: E402
from conform_parts import shared  # noqa: E402
from conform_parts.confined import Ending  # noqa: E402
from conform_parts.judge import different_field, same_digits, same_picture, same_shortest  # noqa: E402
from conform_parts.trial import Terms, judge_ending  # noqa: E402

CASES = {stage: read_cases(stage) for stage in STAGES}
TERMS = Terms([], "nearest", None, False, True, True, True, None, None, None)  # each case by its own tier


def conform(*words, **others):
    """A run on programs that we trust, which a sandbox would make slower."""
    return subprocess.run([sys.executable, PACK / "conform", "--sandbox", "no", "--tap", *map(str, words)],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, timeout=600, **others)


def sh(script):
    return ["sh", "-c", script, "sh"]


class Page(unittest.TestCase):
    def test_is_short_and_explains_every_need(self):
        self.assertLessEqual((SOURCE / "docs/conformance.md").stat().st_size, 12000)
        text = conform("--help-all").stdout
        self.assertLessEqual({*re.findall(r"\{\w+\}", (SOURCE / "docs/conformance.md").read_text())},
                             {*re.findall(r"\{\w+\}", text)})
        self.assertLessEqual({*re.findall(r"--[a-z-]+\b",
                                          (SOURCE / "docs/conformance.md").read_text())} - {"--bare"},
                             {*re.findall(r"--[a-z-]+\b", text)})


class Pages(unittest.TestCase):
    """The cases of a page, and their files by --extract."""
    def case(self, stage, *lines):
        """The last case of a page."""
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, stage).mkdir()
            pathlib.Path(folder, stage, "subject.cases").write_text("\n".join(["# a page", "", *lines, ""]))
            return read_cases(stage, pathlib.Path(folder))[-1]

    def files(self, stage, *lines):
        """Its files, but for case.txt."""
        files = self.case(stage, *lines).files
        return {name: files[name] for name in files if name != "case.txt"}

    def test_fields(self):
        case = self.case("model", "== a", "why: a", "  reason.", "catches: one two", "paragraphs: M1",
                         "options: --bare", "-- input.txt")
        self.assertEqual((case.name, case.why, case.tier), ("model/a", "a reason.", "digits"))
        self.assertEqual(case.words("catches"), ["model/one", "model/two"])
        about = b"why: a reason.\nparagraphs: M1\ncatches: model/one model/two\ntier: digits\n"
        self.assertEqual(case.files, {"case.txt": about, "options.txt": b"--bare\n", "input.txt": b""})

    def test_texts(self):
        found = self.files("model", "== a", "-- input.txt", "1", "", "== b", "-- input.txt", "",
                           "-- expected.txt", r"\xef\r\t\\\x20", "1 \\", "2", r"\x2d- 3", "")
        self.assertEqual(found, {"input.txt": b"\n", "expected.txt": b"\xef\r\t\\ \n1 2\n-- 3\n\n"})
        self.assertEqual(self.files("model", "== a", "-- input.txt", "end\\"), {"input.txt": b"end"})
        found = self.files("model", "== a", "-- input.txt = with-b.txt", "1")
        self.assertEqual(found, {"input.txt": b"1\n", "with-b.txt": b"1\n"})

    def test_depths(self):
        found = self.files("zbuf", "== a", "-- depths-center.txt", "", "     -0.5", "3*0.25  1",
                           "-- with-b.txt", "0 \\", "1")
        self.assertEqual(found["depths-center.txt"], b"\n-0.5\t\n0.25\t0.25\t0.25\t1\t\n")
        self.assertEqual((found["with-b.txt"], found["config.txt"]), (b"0\t1\t\n", b"8 8\n-1\n-1\n-1 1\n"))

    def test_pictures(self):
        found = self.files("zbuf", "== a", "-- config.txt", "5 2",
                           "-- picture-nearest.bmp = with-b.bmp  picture-center.bmp", ".aab.  aaaaa",
                           "..ab.  .....", "a = 0 97 167 at 0.5  b = 0 98 174")  # the colors of bmp()
        picture = bmp([".aab.", "..ab."])
        self.assertEqual(
            found, {
                "config.txt": b"5 2\n", "picture-nearest.bmp": picture, "with-b.bmp": picture,
                "picture-center.bmp": bmp(["aaaaa", "....."]), "depths-nearest.txt": b"0.5\t0.5\t\n0.5\t\n",
                "depths-center.txt": b"0.5\t0.5\t0.5\t0.5\t0.5\t\n\n"})

    def test_extract_writes_the_files_of_the_chosen_cases(self):
        with tempfile.TemporaryDirectory() as folder:
            done = conform("--extract", "out", "--stage", "model", "translate-x", "model/bare", cwd=folder)
            self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
            paths = [path for path in pathlib.Path(folder).glob("**/*") if path.is_file()]
            found = {str(path.relative_to(folder)): path.read_bytes() for path in paths}
        chosen = [case for case in CASES["model"] if case.short_name in ("translate-x", "bare")]
        expected = {f"out/{case.name}/{name}": case.read(name) for case in chosen for name in case.files}
        self.assertEqual(found, expected)
        self.assertEqual(found["out/model/bare/options.txt"], b"--bare\n")

    def test_extract_writes_nowhere_else(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for path in ("full/other", "full/model"):
                (folder / path).mkdir(parents=True)
            (folder / "link").symlink_to("full/other")
            for place in ("full", "link"):
                done = conform("--extract", place, "translate-x", cwd=name)
                message = f"conform: --extract {place}: expected a new or empty folder (try conform --help)\n"
                self.assertEqual((done.returncode, done.stdout, done.stderr), (2, "", message))
            (folder / "full/model").rmdir()
            (folder / "full/model").symlink_to("other")
            for error, *case in ((FileExistsError, "model", "a", {}, ["a.txt"]), (OSError, "view", "..", {}, [
                    "a.txt"]), (OSError, "project", "b", {}, ["../x.txt"])):
                self.assertRaises(error, extract, [Case(*case)], folder / "full")
            self.assertEqual(list((folder / "full/other").iterdir()), [])
            self.assertEqual([path for path in folder.glob("**/x.txt")], [])

    def test_extract_of_no_case_writes_nothing(self):
        with tempfile.TemporaryDirectory() as folder:
            done = conform("--extract", "out", "no-such", cwd=folder)
            message = "conform: --extract: no case is called so, or catches this mistake\n"
            self.assertEqual((done.returncode, done.stderr, os.listdir(folder)), (1, message, []))


class Groups(unittest.TestCase):
    SIGNED = sh(f"{BIN}/view | sed 's/ 0.0000000/ -0.0000000/g'")

    def test_what_the_assignment_asks_for_is_counted_apart(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "results")
            conform("--stage", "view", "--only", "refused-s*", "--only", "rolled-*", "--only", "zero-*",
                    "--json", path, "--", *self.SIGNED)
            found = json.loads(path.read_text())
        groups = found["groups"]
        self.assertEqual(groups["what the assignment asks for"]["wrong"], 0)
        for group in ("text to the byte", "refusals of wrong input"):
            self.assertGreater(groups[group]["wrong"], 0)
        for state in ("right", "wrong"):
            self.assertEqual(sum(counts[state] for counts in groups.values()), found["counts"][state])
        refused = [case["name"] for case in found["cases"] if case["group"] == "refusals of wrong input"]
        self.assertEqual(refused,
                         [case.name for case in CASES["view"] if case.short_name.startswith("refused-s")])

    def test_only_that_is_run_with_basic(self):
        done = conform("--stage", "view", "--basic", "--", *self.SIGNED)
        count = sum(not case.words("needs") for case in CASES["view"])
        self.assertEqual((done.returncode, done.stdout.splitlines()[-2:]),
                         (0, ["#", f"# {count} right, 0 wrong, {len(CASES['view']) - count} left out"]))
        self.assertNotIn("what the assignment asks for", done.stdout)


class Batch(unittest.TestCase):
    """View's cases of a camera that looks straight ahead, which view.awk gets right, and others."""
    def run_on(self, end, *words):
        """How often the program starts, and what is told."""
        with tempfile.TemporaryDirectory() as folder:
            program = sh(f"echo >> '{folder}/starts'; awk -f '{SOURCE}/scripts/view.awk'{end}")
            done = conform("--stage", "view", *words, "--", *program, "{options}")
            return pathlib.Path(folder, "starts").read_text().count("\n"), done.stdout

    def test_many_texts_go_to_one_process_with_the_same_verdict(self):
        chosen = ["--only", "straight-*", "--only", "up-leans*"]
        (alone, told), (together, as_told) = self.run_on("", *chosen), self.run_on("", *chosen, "--batch")
        wrong = told.count("\nnot ok ")
        again = 3  # so many run once more, which could be random
        self.assertEqual((alone, as_told), (8 + wrong + again, told))
        self.assertEqual(together, 1 + wrong + again)
        self.assertGreater(wrong, 2)

    def test_a_program_that_ends_otherwise_is_given_each_alone(self):
        for end, right in (("; exit 3", 0), (" | sed '/^==$/,$d'", 8), (" | sed 's/^==$/= =/'", 8)):
            starts, told = self.run_on(end, "--only", "straight-*", "--batch")
            self.assertEqual((starts, told.count("\nok ")), (9, right), told)

    def test_no_text_to_be_refused_or_without_its_last_line_feed_is_among_them(self):
        chosen = [case for case in CASES["view"] if case.is_chosen(["refused-*", "lines-no-line-feed-*"])]
        starts, _ = self.run_on("", "--only", "refused-*", "--only", "lines-no-line-feed-*", "--batch")
        self.assertEqual(starts, len(chosen) + 1)  # a wrong one that is no refusal runs once more


class Runner(unittest.TestCase):
    """Small programs, on a case or two."""
    def run_one(self, case, *words, options=()):
        stage, name = case.split("/")
        return conform("--stage", stage, "--only", name, *options, "--", *words)

    def assert_wrong(self, done, *messages):
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        for message in messages:
            self.assertIn(message, done.stdout)

    def test_runs_outside_the_source_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            copy = pathlib.Path(folder, "a copy")
            shutil.copytree(PACK, copy, ignore=shutil.ignore_patterns("__pycache__"))

            def run(*words):
                return subprocess.run([sys.executable, "-I", copy / "conform", *words], cwd=folder, text=True,
                                      env={"PATH": os.environ["PATH"]}, capture_output=True)

            stack = "--stage", "model", "--only", "stack-*", "--sandbox", "no", "--"
            done = run(*stack, BIN / "model")
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual([path.name for path in pathlib.Path(folder).iterdir()], ["a copy"])
            self.assertIn("\n  paragraphs: M5, S13\n", run(*stack, "true").stdout)
            self.assertEqual(run("--paragraph", "M5").returncode, 2)
            for page in ("scene", "stage-text", "stages"):
                shutil.copy(SOURCE / f"docs/{page}.md", copy)
            self.assertIn("\n  paragraphs: M5, S13 (conform --paragraph M5)\n", run(*stack, "true").stdout)
            self.assertIn("\ncases:\n  model/", run("--paragraph", "M5").stdout)

    def test_prints_tap(self):
        count = sum(case.short_name.startswith("cut-") for case in CASES["project"])
        done = conform("--stage", "project", "--only", "cut-*", "--", BIN / "view", "{options}")
        version, plan, *lines = done.stdout.splitlines()
        self.assertEqual((version, plan), ("TAP version 13", f"1..{count}"))
        tests = [line for line in lines if not line.startswith("#")]
        self.assertEqual([
            re.match(r"(not )?ok (\d+) - project/[a-z0-9-]+( # (SKIP|TODO) .+)?$", line)[2]
            for line in tests], [str(i + 1) for i in range(count)])

    def shown(self, *words):
        """The report of conform for people."""
        done = subprocess.run([sys.executable, PACK / "conform", "--sandbox", "no", *map(str, words)],
                              stdout=subprocess.PIPE, text=True)
        return done.returncode, done.stdout

    def test_shows_people_a_verdict_first_and_last(self):
        words = "--stage", "model", "--only", "stack-*", "--assignment"
        count = sum(case.name.startswith("model/stack-") for case in CASES["model"])
        self.assertEqual(self.shown(*words, "--", BIN / "model", "--bare"),
                         (0, f"RIGHT: all of {count} cases\nno sandbox (--sandbox no)\n"))
        status, shown = self.shown(*words, "--", *sh(f"grep -v -e push -e pop | {BIN}/model --bare"))
        verdict, note, *why, last = shown.splitlines()
        self.assertRegex(verdict, rf"^WRONG: \d+ of {count} cases$")
        self.assertEqual((status, note, last), (1, "no sandbox (--sandbox no)", verdict))
        for line in ("model/pop-ignored or model/push-and-pop-ignored: ", "  pop is ignored.\n",
                     "  paragraphs: M5, S13 (pipeline help M5)", "  so do model/"):
            self.assertIn("\n" + line, shown)
        self.assertEqual([line for line in why if line.startswith(("#", "ok", "not ok", "TAP"))], [])

    def test_writes_json(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "results.json")
            self.run_one("model/translate-x", "true", options=["--json", path])
            results = json.loads(path.read_text())
        self.assertEqual(results["counts"], {"right": 0, "wrong": 1, "open": 0, "left out": 0})
        self.assertEqual([(case["name"], case["state"], case["paragraphs"]) for case in results["cases"]],
                         [("model/translate-x", "wrong", ["M3"])])
        self.assertEqual(results["cases"][0]["difference"]["message"], "it wrote nothing")

    def test_writes_junit_that_any_parser_reads(self):
        program = sh(r"printf '1 \000\033<&]]>\303\202\377\357\277\277 2\n'")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "results.xml")
            path.write_text("old")
            path.chmod(0o640)
            done = conform("--stage", "model", "--only", "translate-*", "--only", "bare", "--junit", path,
                           "--", *program)
            self.assertEqual((done.returncode, done.stderr, os.listdir(folder)), (1, "", ["results.xml"]))
            self.assertEqual(path.stat().st_mode & 0o777, 0o640)
            root = xml.etree.ElementTree.parse(path).getroot()
        (suite,), cases = root, list(root.iter("testcase"))
        count = len([case for case in CASES["model"] if case.is_chosen(["translate-*", "bare"])])
        self.assertEqual((root.tag, suite.tag, suite.attrib), ("testsuites", "testsuite", {
            "name": "model", "tests": str(count), "failures": str(count - 1), "errors": "0", "skipped": "1"}))
        self.assertEqual((cases[0].attrib, [child.tag for child in cases[0]]),
                         ({"classname": "model", "name": "bare"}, ["skipped"]))
        for case in cases[1:]:
            self.assertEqual([child.tag for child in case], ["failure"])
            self.assertRegex(case[0].text, r"\. \(M\d.*\)\n")

    def test_shows_the_reason_and_what_was_expected_and_found(self):
        done = self.run_one("model/translate-x", *sh("echo 9 2.0 3; cat >&2"), options=["--assignment"])
        self.assert_wrong(
            done, "not ok 1 - model/translate-x\n#   paragraph: M3 (pipeline help M3)\n"
            "#   why: Each number of translate moves its own coordinate.\n",
            "#   line 1, blank ones not counted, differs\n#   expected: 3.5000000 2.0000000 3.0000000\n#   "
            "found:    9 2.0 3\n")

    def test_shows_an_output_in_printable_characters_and_not_whole(self):
        done = self.run_one("model/translate-x",
                            *sh("printf '1 \\033[2J 3 '; head -c 500 /dev/zero | tr '\\0' x"), options=[
                                "--assignment"])
        self.assert_wrong(done, "found:    1 ?[2J 3 xxx", "xxx...\n")
        self.assertLess(max(map(len, done.stdout.splitlines())), 300)

    def test_a_file_that_cannot_be_written_is_told(self):
        for path, reason in (("/no such folder/results.json", "No such file or directory"),
                             ("/dev/full", "No space left on device")):
            done = self.run_one("model/translate-x", BIN / "model", options=["--json", path])
            self.assertEqual((done.returncode, done.stderr), (1, f"conform: {path}: {reason}\n"))
        done = subprocess.run(["sh", "-c", f"'{PACK}/conform' --help > /dev/full"], stderr=subprocess.PIPE)
        self.assertEqual((done.returncode, done.stderr),
                         (1, b"conform: cannot write <stdout>: No space left on device\n"))

    def test_the_results_replace_no_file_of_the_command(self):
        with tempfile.TemporaryDirectory() as folder:
            for name in ("mine", "data"):
                pathlib.Path(folder, name).write_text(f"#!/bin/sh\nexec {BIN}/model\n")
                os.chmod(f"{folder}/{name}", 0o755)
                os.link(f"{folder}/{name}", f"{folder}/{name}.json")
            with open(f"{folder}/out.json", "w") as out:
                self.assertEqual(
                    conform("--stage", "view", "--json", f"{folder}/a", "--junit", f"{folder}/a", "--",
                            "true").returncode, 2)
                for name in ("mine", "data", "out"):
                    words = [
                        "--stage", "model", "--only", "translate-x", "--json", f"{name}.json", "--", "./mine",
                        "data"]
                    done = subprocess.run([PACK / "conform", *words], cwd=folder, stdout=out,
                                          stderr=subprocess.PIPE, text=True)
                    found = "standard output" if name == "out" else f"{os.path.realpath(folder)}/{name}"
                    told = f"--json {name}.json: expected a place of its own, found that of {found}"
                    self.assertEqual((done.returncode, done.stderr), (2, f"conform: {told}\n"))
            self.assertEqual(os.path.getsize(f"{folder}/out.json"), 0)

    def test_a_reader_of_the_report_may_leave(self):
        done = subprocess.run(["sh", "-c", f"'{PACK}/conform' --list | head -n 1"], stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE, text=True)
        self.assertEqual((done.stdout.count("\n"), done.stderr), (1, ""))

    def test_a_program_that_crashes_has_not_refused(self):
        for case in ("model/translate-x", "model/refused-no-end"):
            self.assert_wrong(self.run_one(case, *sh("kill -SEGV $$")), "ended by SIGSEGV")

    def test_a_program_that_cannot_be_run(self):
        for program, reason in (("./no-such-program", "No such file or directory"),
                                ("no-such-program", "No such file or directory"),
                                (PACK / "mistakes.txt",
                                 "Permission denied; chmod +x makes a file a program")):
            done = self.run_one("model/translate-x", program)
            self.assertEqual((done.returncode, done.stdout, done.stderr),
                             (2, "", f"conform: cannot run {program}: {reason}\n"))

    def test_what_is_missing_is_named(self):
        for words, missing in (((), "--stage and a command are"), (("--stage", "view"), "a command is"),
                               (("--", "true"), "--stage is")):
            done = conform(*words)
            self.assertEqual((done.returncode, done.stderr),
                             (2, f"conform: {missing} missing (try conform --help)\n"))

    def test_a_failure_shows_the_last_line_of_the_programs_message(self):
        script = sh("printf 'Traceback:\\n  line 3\\nmine: no camera\\n' >&2; exit 3")
        self.assert_wrong(self.run_one("model/translate-x", *script), "exit status 3",
                          "found:    mine: no camera")

    def test_failures_are_no_evidence_for_a_mistake(self):
        program = (f"text=$(cat; echo x); case $text in *push*) exit 3;; esac; printf %s \"${{text%x}}\" | "
                   f"{BIN}/model --bare")
        done = conform("--stage", "model", "--assignment", "--", *sh(program))
        self.assertRegex(done.stdout, r"\n# the program failed: \d+ cases\n#   first, by length")
        self.assertNotRegex(done.stdout, r"\n# (model/|no mistake of the list)")

    def test_a_refusal_needs_a_status_and_the_line(self):
        name = "refused-pop-without-push"  # at line 5
        case = next(case for case in CASES["model"] if case.short_name == name)
        no_line, no_end = ("the message does not name the line",
                           "the output does not end with a line `error TOOL: MESSAGE` (T12)")
        for status, stdout, stderr, terms, message in (
            (0, "", "", {}, "wrong input was accepted"), (1, "", "mine: line 6: pop\n", {},
                                                          no_line), (1, "", "", {}, no_line),
            (1, "error mine: pop\n", "mine: line 5: pop\n", {},
             None), (1, "error mine: pop\n", "scene.txt:5:1: pop\n", {}, None), (1, "error m: 1\n", "", {
                 "judges_lines": False
             }, None), *((1, end, "mine: line 5: pop\n", {"tier": tier}, None if tier == "digits" else no_end)
                         for end in ("", "error mine\n", "error mine: pop")
                         for tier in (None, "bytes", "digits"))):
            with self.subTest(status=status, stdout=stdout, stderr=stderr, **terms):
                ending = Ending(status, "", stdout.encode(), stderr.encode())
                found = judge_ending(case, TERMS._replace(**terms), ending, None)
                self.assertEqual(found and found.message, message)
        done = self.run_one(f"model/{name}", *sh("echo 'mine: line 6: pop' >&2; exit 1"))
        self.assert_wrong(done, no_line, "expected: refused at line 5")

    def test_files_in_place_of_stdin_and_stdout(self):
        self.assertEqual(self.run_one("model/translate-x", BIN / "model", "{input}").returncode, 0)
        done = self.run_one("zbuf/two-*", BIN / "zbuf", "{config}", "--image", "{image}", "--z-buffer",
                            "{depths}")
        self.assertEqual((done.returncode, done.stdout.count("\nok ")), (0, 4))

    def test_a_program_may_read_and_write_the_assignments_file_names(self):
        self.assertEqual(
            self.run_one("model/translate-x", *sh(f"{BIN}/model --bare scene.txt"), options=[
                "--assignment"]).returncode, 0)
        self.assertEqual(self.run_one("zbuf/two-back-to-front", *sh(f"{BIN}/zbuf config.txt")).returncode, 0)

    def test_names_of_files_are_those_of_the_caller(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "mine.sh").write_text(f"exec {BIN}/model\n")
            done = conform("--stage", "model", "--only", "translate-x", "--", "sh", "mine.sh", cwd=folder)
            self.assertEqual(done.returncode, 0, done.stdout)

    def test_depths_and_picture_can_be_judged_alone(self):
        only_depths, only_picture = sh(f"{BIN}/zbuf $1 --image /dev/null"), sh(f"{BIN}/zbuf $1 >&2")
        for program, option in ((only_depths, "--no-picture"), (only_picture, "--no-depths")):
            self.assertEqual(self.run_one("zbuf/two-*", *program, "{config}").returncode, 1)
            self.assertEqual(self.run_one("zbuf/two-*", *program, "{config}", options=[option]).returncode, 0)

    def test_cases_are_left_out_with_their_reason(self):
        self.assertIn("ok 1 - model/bare # SKIP needs options\n",
                      self.run_one("model/bare", BIN / "model").stdout)
        done = self.run_one("model/lines-*", BIN / "model", options=["--without", "syntax"])
        self.assertEqual((done.returncode, done.stderr), (1, "conform: no case was run and counted\n"))
        self.assertNotIn("\nok 1 - model/lines-comments\n", done.stdout)

    def test_lists_cases(self):
        done = conform("--stage", "model", "--list", "--only", "translate-twice", "--only",
                       "model/second-push-lost")
        self.assertIn("model/translate-twice: Two translations add up.\n", done.stdout)
        self.assertIn("model/stack-push-push-pop-pop: ", done.stdout)
        self.assertEqual(len(conform("--list").stdout.splitlines()), sum(map(len, CASES.values())))

    def test_a_wrong_call_is_misuse(self):
        for words in ([], ["--stage", "model"], ["--stage", "trace", "--", "true"], [
                "--stage", "model", "--without", "colour", "--", "true"], [
                    "--stage", "model", "--seconds", "0", "--", "true"]):
            self.assertEqual(conform(*words).returncode, 2, words)

    def test_names_no_mistake_of_a_program_that_gets_nothing_right(self):
        for program, chosen in (("true", "*-of-[m-z]*"), ("cat", "*-of-[m-z]*")):
            for stage in STAGES:
                with self.subTest(program=program, stage=stage):
                    done = conform("--stage", stage, "--assignment", "--only", chosen, "--", program)
                    self.assertRegex(done.stdout, r"\n# no mistake of the list: \d+ cases\n")
                    self.assertNotRegex(done.stdout, rf"\n# {stage}/")


class Shared(unittest.TestCase):
    """The sentence on what most of the wrong numbers of a run share."""
    def sentence(self, expected, found, **others):
        return shared.sentence(shared.wrong_points(expected.encode(), found.encode(), True, **others))

    def test_is_told_of_three_of_four_wrong_numbers(self):
        expected = "1 2 3\n4 5 6\n7 8 9\n\n-1 0 2\n"
        for found, told in (("-1 2 -3\n-4 5 -6\n-7 8 -9\n\n1 0 -2\n",
                             "8 of 8 wrong numbers: x and z are negated"),
                            ("-1 2 -3\n-4 5 -6\n-7 8 -9\n\n1 0 2.5\n",
                             "7 of 8 wrong numbers: x and z are negated"),
                            ("2 1 3\n5 4 6\n8 7 9\n\n0 -1 2\n",
                             "8 of 8 wrong numbers: x is what y should be, y is what x should be"),
                            ("2 4 6\n8 10 12\n14 16 18\n\n-2 0 4\n",
                             "11 of 11 wrong numbers: x, y and z are 2 times what should be"),
                            ("1 2 3\n4 5 6\n7 8 9\n\n-1 0 9\n",
                             ""), ("1 2 3\n", ""), (expected, ""), ("9 1 4\n1 5 9\n2 6 5\n\n3 5 8\n", "")):
            self.assertEqual(self.sentence(expected, found), told)
        depths = [b"1\t2\t3\t\n4\t5\t6\t\n", b"-1\t-2\t-3\t\n-4\t-5\t-6\t\n"]
        self.assertEqual(shared.sentence(shared.wrong_points(*depths, False)),
                         "6 of 6 wrong numbers: the depths are negated")

    def test_is_shown_without_a_guess(self):
        program = sh(f"{BIN}/model --bare | awk 'NF {{$1 = -$1; $3 = -$3}} {{print}}'")
        done = subprocess.run([
            sys.executable, PACK / "conform", "--sandbox", "no", "--stage", "model", "--only", "r*",
            "--assignment", "--", *program], stdout=subprocess.PIPE, text=True)
        self.assertRegex(done.stdout, r"\A.+\n.+\n\n\d+ of \d+ wrong numbers: x and z are negated\n")
        self.assertNotIn("most like", done.stdout)

    def test_a_random_output_is_told(self):
        random = "$(od -An -N3 -tu4 /dev/urandom | tr -d ' ')"
        program = sh(f"{BIN}/model --bare | awk -v t={random} 'NF {{$1 = t * NR * NR}} 1'")
        done = conform("--stage", "model", "--assignment", "--only", "translate-*", "--", *program)
        self.assertRegex(done.stdout, r"\n# Its output is random: two runs on model/translate-\S+ differ.\n")

    def test_a_program_that_reads_only_numbers_is_told_of_the_header(self):
        told = (r"It wrote nothing: it must read past the lines before the first triangle, such as "
                r"'perspective [\d. ]+' \(--assignment feeds none\)\.\n")
        for program, words, count in (("true", (), 1), ("true", ("--assignment",), 0),
                                      ('text=$(cat); case $text in *"perspective 6"*) echo "$text";; esac',
                                       (), 0)):
            done = conform("--stage", "project", "--only", "fov-*", *words, "--", *sh(program))
            self.assertEqual(len(re.findall(rf"\n# {told}", done.stdout)), count, done.stdout)

    def test_a_guess_names_the_mistake_whose_cases_fail(self):
        program = sh(f"sed '/^up/s/.*/up 0 2 0/' | {BIN}/view")
        done = conform("--stage", "view", "--basic", "--without", "syntax", "--only", "[lru]*", "--",
                       *program)
        self.assertRegex(done.stdout, r"\n#   most like view/up-is-0-1-0: |\n# view/up-is-0-1-0: ")


class Shortest(unittest.TestCase):
    TEXT = "attributes w color\nclipped\n1 2 3 4 9 9 9\n1 2 3 4 9 9 9\n1 2 3 4 9 9 9\n\n1.50 2 3 4.5 9 9 9\n"

    def difference(self, found):
        return same_shortest(self.TEXT.encode(), found.encode())

    def test_w_and_clipped_are_named(self):
        self.assertIsNone(
            self.difference(self.TEXT.replace("1.50", "1.5").replace(" 9 9 9\n\n", " 9.0 9 9\n\n")))
        self.assertEqual(
            self.difference(self.TEXT.replace("4.5", "4.50")).message,
            "line 6, blank ones not counted: w is not in the shortest form (T20)")
        self.assertEqual(
            self.difference(self.TEXT.replace("3 4 9", "3.0 4 9", 1)).message,
            "line 3, blank ones not counted: a line of `clipped` is not in the shortest form "
            "(T20)")


class Digits(unittest.TestCase):
    def is_same(self, expected, found, **others):
        return same_digits(expected.encode(), found.encode(), **others) is None

    def test_any_formatting_of_right_digits_is_right(self):
        expected = "0.0000100 -1.5000000 12.3456789\n\n"
        for found in ("1e-5 -1.5 12.3457", "0.00001 -1.50 12.345679\r\n",
                      "+1.00000000e-05\t-1.500000001 12.34567890001\n", "  1E-05 -1.5 12.3456788  "):
            self.assertTrue(self.is_same(expected, found), found)
        self.assertTrue(self.is_same("0.0000000 0.0000000 0.0000000\n", "-0 -0.0000000 -6.1e-17\n"))

    def test_digits_that_are_shown_must_be_right(self):
        expected = "0.0000100 -1.5000000 12.3456789\n"
        for found in ("2e-5 -1.5 12.3457", "0.00001 -1.50 12.345671", "0.00001 1.5 12.345679",
                      "0.00001 -1.5 12.346", "0.00001 -1.5", "0.00001 -1.5 12.345679 1", "nan -1.5 12.345679",
                      "0.00001 -1.5 12,345679", ""):
            self.assertFalse(self.is_same(expected, found), found)

    def test_few_decimals_are_right_if_all_numbers_have_as_many(self):
        self.assertTrue(self.is_same("0.1234567 1.0000000 2.0000000\n", "0.123 1.000 2.000\n"))
        self.assertFalse(self.is_same("0.1234567 1.0000000 2.0000000\n", "0.124 1.000 2.000\n"))
        self.assertFalse(self.is_same("0.1234567 1.0000000 2.0000000\n", "0.123 1 2\n"))
        self.assertFalse(self.is_same("0.4000000 1.0000000 2.0000000\n", "0.0 1.0 2.0\n"))

    def test_header_lines_count_all_their_digits(self):
        self.assertTrue(
            self.is_same("perspective 60 1.5 1 100\n1.0000000 2.0000000 3.0000000\n",
                         "perspective 60.0 1.50 1 1e2\n1 2 3\n"))
        self.assertFalse(self.is_same("perspective 60 1.5 1 100\n", "perspective 60 1.51 1 100\n"))
        self.assertFalse(self.is_same("perspective 60 1.5 1 100\n", "frustum 60 1.5 1 100\n"))

    def test_rows_of_depths_are_rows(self):
        self.assertTrue(self.is_same("\n0.500000\t0.250000\t\n\n", "0.5 0.25\n", is_stage_text=False))
        self.assertFalse(self.is_same("0.500000\t0.250000\t\n", "0.5\n0.25\n", is_stage_text=False))


def bmp(rows, depth=24, is_top_down=False):
    """An image of rows of letters, '.' black, each letter a color of its own."""
    pixels = b"".join(b"".join(
        bytes([0 if c == "." else 7 * ord(c) % 256, 0 if c == "." else ord(c), 0]) + b"\xff" * (depth == 32)
        for c in row).ljust((len(row) * depth // 8 + 3) // 4 * 4, b"\0")
                      for row in (rows if is_top_down else rows[::-1]))
    numbers = [(54 + len(pixels), 4), (0, 4), (54, 4), (40, 4), (len(rows[0]), 4),
               (-len(rows) if is_top_down else len(rows), 4), (1, 2), (depth, 2), (0, 4), (len(pixels), 4)]
    return b"BM" + b"".join(number.to_bytes(size, "little", signed=number < 0)
                            for number, size in numbers) + bytes(16) + pixels


class Pictures(unittest.TestCase):
    EXPECTED = bmp([".aab.", "..ab."])

    def test_colors_may_be_free_but_each_triangle_has_one(self):
        for rows, is_right in ((["..xy.", "....."], False), ([".xxy.", "..xy."], True), ([
                ".xxx.", "..xx."], False), ([".xzy.", "..xy."], False), ([".xx..", "..x.."], False)):
            self.assertEqual(
                same_picture(self.EXPECTED, bmp(rows), has_free_colors=True) is None, is_right, rows)
        self.assertIsNotNone(same_picture(self.EXPECTED, bmp([".xxy.", "..xy."]), has_free_colors=False))
        self.assertIsNone(same_picture(self.EXPECTED, self.EXPECTED, has_free_colors=False))

    def test_shows_both_pictures(self):
        difference = same_picture(self.EXPECTED, bmp([".aab.", "..bb."]), has_free_colors=True)
        self.assertEqual((difference.expected, difference.found), (".aab.\n..ab.", ".aab.\n..bb."))

    def test_names_the_field_that_differs(self):
        self.assertIsNone(different_field(self.EXPECTED, self.EXPECTED))
        for at, message in ((2, "bytes 2 to 5: the file's size"), (27, "bytes 26 to 27: the planes"),
                            (38, "bytes 38 to 41: pixels a meter in x"),
                            (69, "byte 69: the pixels, or their filling")):
            found = self.EXPECTED[:at] + b"\x77" + self.EXPECTED[at + 1:]
            self.assertEqual(different_field(self.EXPECTED, found).message, f"the picture's file, {message}")
        self.assertEqual(
            different_field(self.EXPECTED, self.EXPECTED[:28] + b"\x20" + self.EXPECTED[29:])[1:3],
            ("24", "32"))

    def test_other_forms_of_bmp_are_read(self):
        for depth in (24, 32):
            for is_top_down in (False, True):
                self.assertIsNone(
                    same_picture(self.EXPECTED, bmp([".aab.", "..ab."], depth, is_top_down),
                                 has_free_colors=False))

    def test_what_is_no_picture_is_told(self):
        for data in (b"", b"P6 1 1 255 abc", self.EXPECTED[:-1]):
            self.assertIn("the picture is not a BMP file",
                          same_picture(self.EXPECTED, data, has_free_colors=True).message)
        self.assertEqual(
            same_picture(self.EXPECTED, bmp(["..."]), has_free_colors=True).found, "3 x 1 pixels")


if __name__ == "__main__":
    unittest.main()
