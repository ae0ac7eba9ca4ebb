#!/usr/bin/env python3
"""scripts/grade: points, pages and results of a class, and hand-ins that mean harm.

usage: grade_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import csv
import gzip
import io
import json
import os
import pathlib
import select
import shutil
import signal
import subprocess
import sys
import tarfile
import tempfile
import time
import unittest
import zipfile
from unittest import mock

from grade_parts import graders, programs
from grade_parts.assignment import read_tests
from grade_parts.contents import contents_of
from grade_parts.hand_ins import find_hand_ins
from grade_parts.results import csv_of, gradescope
from grade_parts.summary import findings
from lib.judging.mistakes import fix, sentences
from lib.judging.verdict import Cause, FileVerdict, Verdict
from lib.rim.command import CommandFailure
from toolbox import (BIN, SOURCE, Terminal, ToolTest, end_by_signal, has_bubblewrap, heed_signals, run_script,
                     tools_with)

SAMPLE = SOURCE / "samples/worked-example"
FILES = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
ANONYMOUS = ".pipeline-grade", "grades.csv", "mistakes.md", "numbers.csv", "1/page.html", "1/results.json"
SECRET = "77.7777777"  # in a file that no hand-in may reach
DIVIDE = "The coordinates are not divided by w"
DIVIDE_FIX = "Divide x, y and z by w after the product."


class ClassTest(ToolTest):
    def setUp(self):
        super().setUp()
        self.add_test("square")
        os.mkdir("hand-ins")

    def add_test(self, name, weight=None):
        folder = pathlib.Path("tests", name)
        folder.mkdir(parents=True)
        for file in ("scene.txt", "config.txt"):
            shutil.copy(SAMPLE / file, folder)
        if weight is not None:
            (folder / "weight.txt").write_text(weight)

    def add(self, name, *inner, mistake=False, files=FILES):
        """A hand-in, right but for a missing divide if asked."""
        folder = os.path.join(os.fsencode("hand-ins"), os.fsencode(name), *map(os.fsencode, inner))
        os.makedirs(folder)
        for file in files:
            data = (SAMPLE / file).read_bytes()
            if mistake and file == "stage3.txt":
                data = data.replace(b"0.8660254", b"1.7320508").replace(b"0.1111111", b"0.2222222")
            with open(os.path.join(folder, os.fsencode(file)), "wb") as out:
                out.write(data)
        if mistake:
            where = os.fsdecode(folder)
            subprocess.run([
                BIN / "zbuf", "tests/square/config.txt", f"{where}/stage3.txt", "--z-buffer",
                f"{where}/z_buffer.txt", "-o", f"{where}/out.bmp"], check=True)

    def grade(self, *words, status=0, folders=("hand-ins", "tests")):
        done = run_script("grade", *folders, *words)
        self.assertEqual(done.returncode, status, done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        return done

    def rows(self):
        with open("graded/grades.csv", newline="") as file:
            return list(csv.DictReader(file))

    def scores(self):
        return {row["hand-in"]: float(row["score"]) for row in self.rows()}

    def files(self):
        paths = [path for path in pathlib.Path("graded").rglob("*") if path.is_file()]
        return {str(path.relative_to("graded")) for path in paths}

    def page(self, number):
        return next(pathlib.Path("graded").glob(f"{number}*/page.html")).read_text()

    def results(self, number):
        return json.loads(next(pathlib.Path("graded").glob(f"{number}*/results.json")).read_text())


class Results(ClassTest):
    def test_swapped_folders_are_told(self):
        self.add("anna", files=("scene.txt", *FILES))  # one that has its scene, too
        self.add("ben")
        self.assertEqual(
            self.grade(status=2, folders=("tests", "hand-ins")).stderr,
            "grade: tests holds tests, folders with a scene.txt: expected the hand-ins first, "
            "grade HANDINS TESTS\n")
        self.assertFalse(pathlib.Path("graded").exists())

    def test_points_pages_and_table(self):
        self.add("anna")
        self.add("ben", mistake=True)
        self.add("carl", mistake=True, files=FILES[:4])
        os.unlink("hand-ins/carl/out.bmp")
        done = self.grade("--hints", "fix")
        self.assertEqual(self.scores(), {"anna": 1.0, "ben": 0.8, "carl": 0.6})
        self.assertEqual(
            done.stdout, "| hand-ins | stage   | what                                 |\n"
            "| -------- | ------- | ------------------------------------ |\n"
            "| 2        | project | The coordinates are not divided by w |\n"
            "| 1        | zbuf    | not handed in                        |\n\n3 hand-ins, 1 right in all "
            "tests.\n\n"
            "Written to graded: grades.csv, mistakes.md and, for each hand-in, page.html and results.json, "
            "such as graded/1-anna/page.html.\n")
        self.assertTrue(pathlib.Path("graded/1-anna/page.html").is_file())
        self.assertEqual(
            pathlib.Path("graded/mistakes.md").read_text(),
            done.stdout.partition("\nWritten")[0])
        results = self.results(2)
        self.assertEqual((results["score"], [
            (test["name"], test["score"], test["max_score"]) for test in results["tests"]]),
                         (0.8, [("square", 0.8, 1.0)]))
        self.assertIn(DIVIDE, results["tests"][0]["output"])
        self.assertIn(DIVIDE_FIX, results["tests"][0]["output"])
        self.assertEqual(self.page(1).count("data:image/png;base64,"), 2)
        self.assertNotRegex(self.page(2), r'(src|href)="(?!data:)')

    def test_hints(self):
        self.add("ben", mistake=True)
        for level, shown in (("none", (False, False, False)), ("stage", (True, False, False)),
                             ("cause", (True, True, False)), ("fix", (True, True, True))):
            with self.subTest(level):
                self.grade("--hints", level)
                for text in (self.page(1), json.dumps(self.results(1))):
                    self.assertEqual(tuple(words in text for words in ("stage3.txt", DIVIDE, DIVIDE_FIX)),
                                     shown)
                self.assertEqual("0.8660254" in self.page(1), level in ("cause", "fix"))  # the right number
                self.assertIn(DIVIDE, self.rows()[0]["square verdict"])
        self.grade("--hints", "none")
        self.assertIn("4 of 5 files are right.", self.page(1))

    def test_what_is_not_handed_in_is_said_without_hints(self):
        self.add("ben", files=FILES[:4])
        self.grade("--hints", "none")
        self.assertIn("4 of 5 files are right. out.bmp is not handed in.", self.page(1))

    def test_weights_and_folders_by_name(self):
        self.add_test("b", weight="3\n")
        self.add("anna", "wrapped", "b")
        self.add("ben", "square")
        self.grade()
        self.assertEqual(self.scores(), {"anna": 3.0, "ben": 1.0})
        self.assertEqual([row["max_score"] for row in self.rows()], ["4.0", "4.0"])
        for word in ("x", "-1", "nan", "inf"):
            pathlib.Path("tests/b/weight.txt").write_text(word)
            self.assertEqual(
                self.grade(status=2).stderr,
                f"grade: tests/b/weight.txt: expected a number of 0 to 1,000,000, found '{word}'\n")

    def test_folders_and_files_as_people_name_them(self):
        os.rename("tests/square", "tests/2-one-square")
        self.add_test("13-other")
        for folder in ("2-One_Square", "2 one square", "2", "test2", "Test 02", "scene-2", "Output_2"):
            self.add(f"as {folder}", folder)
            self.add(f"as {folder}", "13")
        numbered = [f"1905042_{name}" if name[0] == "s" else name.replace(".", "_1905042.") for name in FILES]
        self.add("with a number", "2")
        self.add("with a number", "13")
        for name, other in zip(FILES, numbered):
            os.rename(f"hand-ins/with a number/2/{name}", f"hand-ins/with a number/2/{other}")
        self.add("of another test", "3")
        self.grade()
        self.assertEqual({self.scores().pop("of another test"), *self.scores().values()}, {0.0, 2.0})
        self.assertEqual([name for name, score in self.scores().items() if not score], ["of another test"])

    def test_a_cause_that_one_test_cannot_tell_is_counted_as_another_one_does(self):
        def file(*causes):
            return FileVerdict("view", "stage2.txt", "wrong", causes=[Cause("", text) for text in causes])

        tests = [
            graders.GradedTest("t", 0, 1, Verdict([file(*causes)]), "", [], [])
            for causes in (("One.", "Other."), ("Other.",), ("A third.",))]
        self.assertEqual([words for _, words in findings(graders.Graded(tests))],
                         ["Other", "Other", "A third"])

    def test_a_cause_that_another_test_contradicts_is_not_named(self):
        """A pop that takes back two transforms is one to the identity where there are two."""
        shutil.rmtree("tests/square")
        corners, identity = "triangle\n1 0 0\n0 1 0\n0 0 1\n", "pop goes back to the identity"
        for name, kept, taken, inner in (("one", "", "translate 1 0 0\n", "translate 0 1 0\n"),
                                         ("two", "translate 3 0 0\n", "scale 1 2 3\n", "rotate 30 0 0 1\n")):
            for folder, between in ((f"tests/{name}", (taken, "push\n")), (f"hand-ins/ada/{name}", ("push\n",
                                                                                                    taken))):
                os.makedirs(folder)
                pathlib.Path(
                    folder,
                    "scene.txt").write_text("0 0 5\n0 0 0\n0 1 0\n60 1 1 9\n" + kept + "".join(between) +
                                            inner + corners + "pop\n" + corners + "end\n")
            text = pathlib.Path(folder, "scene.txt").read_bytes()
            for file, stage in zip(FILES, ("model", "view", "project")):
                bare = subprocess.run([BIN / stage, "--bare"], input=text, capture_output=True).stdout
                pathlib.Path(folder, file).write_bytes(bare)
                text = subprocess.run([BIN / stage], input=text, capture_output=True).stdout
        self.assertNotIn(identity, self.grade().stdout)
        self.assertIn("but two rules it out as sole cause", self.page(1))
        shutil.rmtree("tests/two")
        self.assertIn(identity, self.grade().stdout)

    def test_archives(self):
        self.add("anna", "wrapped", "square")
        for kind in ("zip", "tar", "gztar"):
            shutil.make_archive(f"hand-ins/{kind}", kind, "hand-ins/anna")
        self.grade()
        self.assertEqual(self.scores(), {"anna": 1.0, "zip": 1.0, "tar": 1.0, "gztar": 1.0})

    def test_three_stages_without_a_config(self):
        os.unlink("tests/square/config.txt")
        self.add("anna", files=FILES[:3])
        self.grade()
        self.assertEqual(self.scores(), {"anna": 1.0})

    def test_results_of_an_earlier_run_go(self):
        """Else the pages with names would stay beside those without. Files of others stay."""
        self.add("ada")
        self.grade()
        mine = ["1-ada/comment.txt", "1-mine", "mine.csv", "1999", "2-ben/page.html", "1-a.old/results.json"]
        os.symlink("../tests/square/scene.txt", "graded/1999")
        for path in (pathlib.Path("graded", name) for name in (*mine[:3], *mine[4:], "numbers.csv")):
            path.parent.mkdir(exist_ok=True)
            path.write_text("mine")
        self.assertEqual(
            self.grade("--anonymous", status=2).stderr,
            "grade: expected no foreign file in place of a result, found graded/numbers.csv, which "
            ".pipeline-grade does not list\n")
        os.unlink("graded/numbers.csv")
        self.grade("--anonymous")
        self.assertEqual(self.files(), {*mine, *ANONYMOUS})
        self.grade()
        self.assertEqual(self.files(), {*mine, "1-ada/page.html", "1-ada/results.json", *ANONYMOUS[:3]})

    def test_names_in_what_a_killed_run_leaves_go(self):
        self.add("ada")
        for count in range(3):  # of files in their places
            code = (f"import os, runpy\nreplace, counted = os.replace, iter(range({count}))\n"
                    "def replaced(a, b):\n  counted.__length_hint__() or os.kill(os.getpid(), 9)\n"
                    "  replace(a, b), next(counted)\nos.replace = replaced\n"
                    f"runpy.run_path('{SOURCE}/scripts/grade', run_name='__main__')")
            words = [sys.executable, "-c", code, "hand-ins", "tests"]
            done = subprocess.run(words,
                                  env={**os.environ, "BIN": str(BIN), "PYTHONPATH": f"{SOURCE}/scripts"})
            self.assertEqual((done.returncode, os.path.exists("graded/1-ada")), (-signal.SIGKILL, True))
            self.grade("--anonymous")
            self.assertEqual((self.files(), os.path.exists("graded/1-ada")), ({*ANONYMOUS}, False))
            shutil.rmtree("graded")

    def test_links_in_out_are_not_followed(self):
        self.add("ada")
        self.grade()
        os.mkdir("elsewhere")
        pathlib.Path("precious").write_text("mine")
        shutil.rmtree("graded/1-ada")
        os.symlink("../elsewhere", "graded/1-ada")
        os.unlink("graded/grades.csv")
        os.symlink("../precious", "graded/grades.csv")
        self.grade()
        self.assertEqual((os.listdir("elsewhere"), pathlib.Path("precious").read_text()), ([], "mine"))

    def test_out_among_the_hand_ins_is_refused(self):
        """The next run would judge it as a hand-in; temporary files there are none."""
        self.add("ada")
        for name in ("hand-ins", "tests"):
            done = self.grade("-o", f"{name}/graded", status=2)
            self.assertEqual((done.stderr, os.path.exists(f"{name}/graded")),
                             (f"grade: -o: expected a place outside of '{name}', found '{name}/graded' "
                              "(try grade --help)\n", False))
            with mock.patch.dict(os.environ, TMPDIR=os.path.abspath(name)):
                self.grade()
            self.assertEqual(self.scores(), {"ada": 1.0})

    def test_older_results_stay_until_all_new_ones_are_written(self):
        self.add("ada")
        self.grade()
        os.unlink("graded/mistakes.md")
        os.mkdir("graded/mistakes.md")
        self.add("ben")
        before = {path: path.is_file() and path.read_bytes() for path in pathlib.Path("graded").rglob("*")}
        self.assertEqual(
            self.grade("--hints", "none", status=2).stderr,
            "grade: cannot open graded/mistakes.md: Is a directory\n")
        self.assertEqual(
            {path: path.is_file() and path.read_bytes()
             for path in pathlib.Path("graded").rglob("*")}, before)

    def test_anonymous(self):
        self.add("Anna Example", mistake=True)
        self.add("Ben Example")
        self.grade("--anonymous")
        for path in pathlib.Path("graded").rglob("*"):
            self.assertNotIn("Example", path.name)
            if path.is_file() and path.name != "numbers.csv":
                self.assertNotIn("Example", path.read_text(), path)
        of = {row["hand-in"]: row["number"] for row in csv.DictReader(open("graded/numbers.csv", newline=""))}
        self.assertEqual({row["number"]: row["score"]
                          for row in self.rows()}, {of["Anna Example"]: "0.8", of["Ben Example"]: "1.0"})

    def test_a_bar_on_a_terminal(self):
        self.add("anna")
        terminal = Terminal(self)
        subprocess.run([SOURCE / "scripts/grade", "hand-ins", "tests"], stdout=subprocess.DEVNULL,
                       stderr=terminal.channel, env={**os.environ, "BIN": str(BIN)}, check=True)
        self.assertRegex(terminal.shown(), rb"(?s)\] 0/1.*\[#{30}\] 1/1")

    def test_a_table_that_cannot_be_printed_is_said(self):
        self.add("anna")
        for channel, reason in ((">&-", "Bad file descriptor"), ("> /dev/full", "No space left on device")):
            line = ["sh", "-c", f'"$0" hand-ins tests {channel}', SOURCE / "scripts/grade"]
            done = subprocess.run(line, stderr=subprocess.PIPE, text=True, timeout=120,
                                  env={**os.environ, "BIN": str(BIN)})
            self.assertEqual((done.returncode, done.stderr), (1, f"grade: cannot write <stdout>: {reason}\n"))
            self.assertEqual(self.scores(), {"anna": 1.0})

    def test_nothing_to_grade(self):
        self.assertEqual(
            self.grade(status=2).stderr, "grade: hand-ins: expected folders or archives, found none\n")
        self.add("anna")
        pathlib.Path("tests/square/scene.txt").write_text("1 2\n")
        self.assertRegex(self.grade(status=2).stderr, r"\Agrade: tests/square: the scene is refused: model: ")
        for name in ("scene.txt", "weight.txt"):
            pathlib.Path(f"tests/square/{name}").unlink(missing_ok=True)
            os.mkfifo(f"tests/square/{name}")
            self.assertEqual(
                self.grade(status=2).stderr, f"grade: cannot read tests/square/{name}: Not a regular file\n")
            os.unlink(f"tests/square/{name}")
            pathlib.Path("tests/square/scene.txt").write_text("mine")

    def test_points_are_those_of_the_assignment(self):
        self.add_test("b")
        shutil.copytree("tests/square", "hand-ins/ben/square")
        for name, mistake in (("anna", False), ("ben", True)):
            self.add(name, "b", mistake=mistake)
        settings = pathlib.Path("tests/assignment.txt")
        settings.write_text("# of the course\nhints stage\npoints stage3.txt 3\npoints out.bmp 4.5\n"
                            "weight b 2\n")
        self.grade()
        self.assertEqual({row["hand-in"]: (row["b"], row["max_score"])
                          for row in self.rows()}, {"anna": ("15.0", "22.5"), "ben": ("9.0", "22.5")})
        self.assertNotIn(DIVIDE, self.page(2))
        settings.write_text("required stage3.txt\n")
        self.grade()
        self.assertEqual(self.scores(), {"anna": 1.0, "ben": 0.0})
        for text, message in (("points stage3.txt x\n", ":1: expected a number of 0 to 1,000,000, found 'x'"),
                              ("\npoints my.txt 1\n",
                               ":2: expected stage1.txt, stage2.txt, stage3.txt, z_buffer.txt, out.bmp, "
                               "found 'my.txt'"), ("another-rule 2\n",
                                                   ":1: expected a number of 0 to 1, found '2'"),
                              ("build make\n", ": expected a line 'program STAGE' for 'build', found none"),
                              ("program view\n",
                               ": expected a line 'run COMMAND' for the program, found none"),
                              ("weight c 1\n", ":1: expected b, square, found 'c'")):
            settings.write_text(text)
            self.assertEqual(self.grade(status=2).stderr, f"grade: tests/assignment.txt{message}\n")

    def test_another_rule_may_be_worth_less(self):
        self.add("anna")
        words = ["--z-buffer", "hand-ins/anna/z_buffer.txt", "-o", "hand-ins/anna/out.bmp"]
        subprocess.run([
            BIN / "zbuf", "tests/square/config.txt", "hand-ins/anna/stage3.txt", "--coverage", "center",
            *words], check=True)
        for share, score, words in (("1", 1.0, "counts as right"), ("0.5", 0.8, "earns 50 % of the points")):
            pathlib.Path("tests/assignment.txt").write_text(f"another-rule {share}\n")
            self.grade()
            self.assertEqual(self.scores(), {"anna": score})
            self.assertEqual(self.page(1).count(words), 3)  # in the sentence, and for each file

    def test_borders_are_decided_once_for_all_tests(self):
        """The last row is empty in one of two, which is a mistake, unless the other needs a rule of its own
        at the borders: two rows end a pixel early."""
        def cut(place, from_end, count):
            """Clears the last pixels of a row of 40, counted from the last one that has any."""
            picture, text = pathlib.Path(place, "out.bmp"), pathlib.Path(place, "z_buffer.txt")
            data, lines = bytearray(picture.read_bytes()), text.read_text().split("\n")
            row = max(i for i, line in enumerate(lines) if line) - from_end
            pixels = [54 + ((39 - row) * 40 + i) * 3 for i in range(40)]
            for pixel in [pixel for pixel in pixels if any(data[pixel:pixel + 3])][-count:]:
                data[pixel:pixel + 3] = bytes(3)
            lines[row] = "\t".join(lines[row].split("\t")[:-count - 1])
            picture.write_bytes(data)
            text.write_text("\n".join(lines))

        self.add_test("again")
        for test in "again", "square":
            pathlib.Path("tests", test, "config.txt").write_text("40 40\n")
            for name in "anna", "ben":
                self.add(name, test)
                place = f"hand-ins/{name}/{test}"
                subprocess.run([
                    BIN / "zbuf", f"tests/{test}/config.txt", f"{place}/stage3.txt", "--z-buffer",
                    f"{place}/z_buffer.txt", "-o", f"{place}/out.bmp"], check=True)
        cut("hand-ins/anna/square", 0, 40)
        cut("hand-ins/ben/square", 0, 40)
        for row in 4, 6:
            cut("hand-ins/ben/again", row, 1)
        self.grade()
        self.assertEqual(self.scores(), {"anna": 1.6, "ben": 2.0})

    def test_the_teacher_has_the_last_word(self):
        self.add("anna", mistake=True)
        pathlib.Path("hand-ins/ben.rar").write_bytes(b"Rar!\x1a\x07\x00")
        lines = pathlib.Path("lines.csv")
        lines.write_text('hand-in,test,points,comment\nanna,square,0.95,"Late, but <b>good</b>."\n'
                         "anna,,,See me.\nben,square,0.5,By mail\n")
        self.grade("--overrides", "lines.csv", status=1)
        self.assertEqual(self.scores(), {"anna": 0.95, "ben": 0.5})
        self.assertIn("Late, but &lt;b&gt;good&lt;/b&gt;. (0.95 points in place of 0.8)", self.page(1))
        self.assertIn("See me.", self.page(1))
        self.assertIn("By mail (0.5 points in place of 0)", json.dumps(self.results(2)))
        self.assertIn("By mail", self.rows()[1]["remarks"])
        for line, message in (("carl,square,1,", "the name of a hand-in, found 'carl'"),
                              ("anna,b,1,", "the name of a test, found 'b'"),
                              ("anna,square,x,", "a number of 0 to 1,000,000, found 'x'"),
                              ("anna,square", "4 columns, found 2")):
            lines.write_text(f"hand-in,test,points,comment\n{line}\n")
            self.assertEqual(
                self.grade("--overrides", "lines.csv", status=2).stderr,
                f"grade: lines.csv:2: expected {message}\n")

    def test_an_archive_that_is_not_read_has_a_row(self):
        self.add("anna")
        for name, start in (("b.rar", b"Rar!"), ("c.7z", b"7z\xbc\xaf\x27\x1c"), ("d.tar.xz", b"\xfd7zXZ\0")):
            pathlib.Path("hand-ins", name).write_bytes(start + bytes(50))
        self.grade(status=1)
        self.assertEqual([(row["hand-in"], row["score"]) for row in self.rows()], [("anna", "1.0"),
                                                                                   ("b", "0"), ("c", "0"),
                                                                                   ("d", "0")])
        self.assertIn("a 7-Zip archive is not read: expected a folder, .zip, .tar or .tar.gz",
                      self.rows()[2]["remarks"])

    def test_an_archive_in_a_folder_and_flat_files_are_found(self):
        self.add_test("b")
        self.add("anna", "square")
        shutil.copytree("hand-ins/anna/square", "hand-ins/anna/b")
        shutil.make_archive("work", "zip", "hand-ins/anna")
        os.makedirs("hand-ins/moodle/inner")
        shutil.copy("work.zip", "hand-ins/moodle/inner/My Work.ZIP")
        os.mkdir("hand-ins/flat")
        for name in FILES:
            stem, suffix = os.path.splitext(name)
            shutil.copy(SAMPLE / name, f"hand-ins/flat/square-{name}")
            shutil.copy(SAMPLE / name, f"hand-ins/flat/{stem} (B){suffix}".replace("(", "_").replace(")", ""))
        self.add("nothing")
        for name in FILES:
            os.rename(f"hand-ins/nothing/{name}", f"hand-ins/nothing/{name}.txt")
        self.grade()
        self.assertEqual(self.scores(), {"anna": 2.0, "moodle": 2.0, "flat": 2.0, "nothing": 0.0})
        self.assertIn(
            "square: nothing found; looked for stage1.txt, stage2.txt, stage3.txt, z_buffer.txt, "
            "out.bmp in a folder square, or with its name before or behind theirs, as "
            "square-stage1.txt", {row["hand-in"]: row["remarks"]
                                  for row in self.rows()}["nothing"])

    def test_wrong_files_that_are_equal_are_noted(self):
        for name in ("anna", "ben"):
            self.add(name, mistake=True)
        self.add("carl")
        self.grade()
        remarks = {row["hand-in"]: row["remarks"] for row in self.rows()}
        self.assertEqual((remarks["anna"], remarks["carl"]),
                         ("square: the wrong stage3.txt is equal to that of ben", ""))
        self.assertNotIn("ben", self.page(1))

    def test_without_tests_there_are_six_scenes(self):
        os.mkdir("hand-ins/anna")
        for scene in (SOURCE / "tests/conformance/assignment").glob("*/scene.txt"):
            subprocess.run([
                SOURCE / "scripts/stages", scene, scene.parent / "config.txt",
                f"hand-ins/anna/{scene.parent.name}"], check=True, stderr=subprocess.DEVNULL,
                           env={**os.environ, "BIN": str(BIN)})
        self.grade(folders=("hand-ins",))
        self.assertEqual(self.scores(), {"anna": 6.0})

    @unittest.skipUnless(has_bubblewrap(), "no bubblewrap")
    def test_a_program_whose_runs_differ_is_told(self):
        pathlib.Path("tests/assignment.txt").write_text("program view\nrun python3 view.py\n")
        os.mkdir("hand-ins/anna")
        pathlib.Path("hand-ins/anna/view.py").write_text(
            "import random\nfor line in open(0):\n    words = line.split()\n    if len(words) == 3:\n"
            "        print(random.random(), random.random(), words[2])\n")
        self.grade()
        self.assertEqual(self.scores(), {"anna": 0.0})
        self.assertIn("Some numbers are random: two runs of the program on the same text", self.page(1))

    def test_a_program_that_sleeps_could_not_be_judged(self):
        """It has ten seconds of the clock for each of a processor."""
        pathlib.Path("tests/assignment.txt").write_text("program view\nrun sleep 100\n")
        with mock.patch.dict(os.environ, BIN=str(BIN)):
            tests, settings = read_tests("tests")
        os.mkdir("hand-ins/anna")
        limits = graders.Limits(60, 2048, 1, (), settings.program)
        with mock.patch.object(programs, "SECONDS_OF_RUN", 0.25), \
                mock.patch("conform_parts.workers.PATIENCE", 1):
            verdicts = programs.verdicts(contents_of("hand-ins/anna"), tests, limits)
            _, verdict, remark = next(verdicts)()
        self.assertEqual([(file.verdict, file.causes) for file in verdict.files],
                         [("could not be judged", [])])
        self.assertEqual(remark, "square: the program failed: it does not end within 2.5 s")

    @unittest.skipIf(os.geteuid(), "root alone runs programs as others")
    def test_without_a_sandbox_all_open_folders_are_named_at_once(self):
        self.add("anna")
        pathlib.Path("tests/assignment.txt").write_text("program view\nrun true\n")
        pathlib.Path("bwrap").symlink_to("/bin/false")
        os.mkdir("graded")
        for name, mode in ((".", 0o711), ("hand-ins", 0o700)):
            os.chmod(name, mode)
        with mock.patch.dict(os.environ, PATH=f"{os.getcwd()}:{os.environ['PATH']}"):
            errors = self.grade(status=2).stderr
        names = " ".join(map(os.path.abspath, ("tests", "graded")))
        self.assertRegex(errors, f": chmod go= {names}( .*)?, or ")

    @unittest.skipIf(os.geteuid(), "root alone runs programs as others")
    def test_a_user_is_taken_as_long_as_its_judge_lives(self):
        self.addCleanup(os.setgroups, os.getgroups())
        with mock.patch.object(programs, "USERS", 1):
            judge = os.fork()
            if not judge:
                programs.take_user()
                os.kill(os.getpid(), signal.SIGSTOP)
            os.waitpid(judge, os.WUNTRACED)
            self.assertRaisesRegex(CommandFailure, "users from 61184 to 61184 are", programs.take_user)
            os.kill(judge, signal.SIGKILL)
            os.waitpid(judge, 0)
            self.assertEqual(programs.take_user(), 61184)

    @unittest.skipIf(os.geteuid(), "root alone gives files away")
    def test_after_a_build_root_takes_what_is_of_the_builder_alone(self):
        builder, stranger = programs.FIRST_USER, programs.FIRST_USER + 1
        pathlib.Path("built/inner").mkdir(parents=True)
        for name, owner in (("built/inner/made", builder), ("other", stranger), ("left", builder)):
            pathlib.Path(name).touch()
            os.chown(name, owner, owner)
        for name in ("other", "left"):
            os.link(name, f"built/{name}")
        for name in ("built", "built/inner"):
            os.chown(name, builder, builder)
        programs.give("built", 0, builder)
        names = "built", "built/inner", "built/inner/made", "other", "left"
        self.assertEqual([os.stat(name).st_uid for name in names], [0, 0, 0, stranger, builder])

    def test_each_mistake_has_its_fix(self):
        self.assertEqual([name for name in sentences() if not fix(name)], [])


class Hostile(ClassTest):
    """Each of them beside one that is right, and gets its full points."""
    def setUp(self):
        super().setUp()
        self.add("zoe")

    def judge(self, *words, status=1):
        self.before = sorted(os.listdir("."))
        self.grade(*words, status=status)
        self.assertEqual(self.scores()["zoe"], 1.0)
        self.assertEqual(sorted(os.listdir(".")), sorted([*self.before, "graded"]))
        return {row["hand-in"]: row for row in self.rows()}

    def test_names(self):
        long = "n" * 250
        formulas = [
            "=HYPERLINK(1)", "@SUM(1)", "+1", "-rf", " =1+1", "\uff1d1+1", " \uff0b1", "\uff0d1",
            "\uff20SUM(1)", "\ufe661"]
        names = [
            *formulas, "a\nb", "\x1b[31mred\x07", b"\xff\xfe", "<script>alert(1)</script>".replace("/", "|"),
            "\u202etxt", long, "a,b\"c", "%s%n"]
        for name in names:
            self.add(name)
        rows = self.judge(status=0)
        self.assertEqual(len(rows), len(names) + 1)
        self.assertEqual({float(row["score"]) for row in rows.values()}, {1.0})
        self.assertTrue({*("'" + name for name in formulas)} <= set(rows))
        self.assertTrue({"a\\nb", "\\x1b[31mred\\x07", "\\xff\\xfe", "\\u202etxt"} <= set(rows))
        for path in pathlib.Path("graded").iterdir():
            self.assertRegex(path.name, r"\A[A-Za-z0-9._-]{1,66}\Z")
        for page in pathlib.Path("graded").glob("*/page.html"):
            self.assertNotIn("<script", page.read_text())
            self.assertIn("Content-Security-Policy\" content=\"default-src 'none';", page.read_text())
            self.assertNotRegex(page.read_text(), "[\x00-\x08\x0b-\x1f]")

    def test_names_of_files(self):
        self.add("a", files=FILES[1:])
        for name in (b"stage1\xff.txt", b"stage 1.txt\n", b"-stage1.txt", b"stage1.txt "):
            with open(b"hand-ins/a/" + name, "wb") as file:
                file.write((SAMPLE / "stage1.txt").read_bytes())
        rows = self.judge(status=0)
        self.assertEqual(float(rows["a"]["score"]), 1.0)  # -stage1.txt, with its dash read over, is meant

    def members(self, *extra):
        """(name, data) of a right hand-in without out.bmp, and more."""
        return [*((name, (SAMPLE / name).read_bytes()) for name in FILES[:4]), *extra]

    def zip(self, name, members):
        with zipfile.ZipFile(f"hand-ins/{name}.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for member, data in members:
                archive.writestr(member, data)

    def tar(self, name, entries, members=()):
        with tarfile.open(f"hand-ins/{name}.tar", "w") as archive:
            for member, data in members:
                info = tarfile.TarInfo(member)
                info.size = len(data)
                archive.addfile(info, io.BytesIO(data))
            for member, kind, target in entries:
                info = tarfile.TarInfo(member)
                info.type, info.linkname = kind, target
                archive.addfile(info)

    def test_what_a_system_adds_to_an_archive_is_no_file_of_the_hand_in(self):
        added = [("__MACOSX/stage1.txt", b"\0\5\26\7"), ("__MACOSX/._stage1.txt", b"")]
        self.zip("zip", added + [("in/" + name, data) for name, data in self.members()])
        rows = self.judge(status=0)
        self.assertEqual((float(rows["zip"]["score"]), rows["zip"]["remarks"]), (0.8, ""))

    def test_archives_that_climb_out(self):
        picture = (SAMPLE / "out.bmp").read_bytes()
        for i, path in enumerate(
            ("../out.bmp", "/tmp/out.bmp", "a/../../out.bmp", "..\\out.bmp", "C:\\out.bmp")):
            self.zip(f"zip{i}", self.members((path, picture)))
            self.tar(f"tar{i}", (), self.members((path, picture)))
        rows = self.judge(status=0)
        for name, row in rows.items():
            if name != "zoe":
                self.assertEqual((float(row["score"]), row["remarks"]),
                                 (0.8, "1 entry not looked at: their paths lead out"), name)

    def test_links_and_devices(self):
        pathlib.Path("tests/secret").write_text(SECRET + " 0 0\n" * 3)
        secret = str(pathlib.Path("tests/secret").resolve())
        self.add("folder", files=FILES[1:4])
        os.symlink(secret, "hand-ins/folder/stage1.txt")
        os.mkfifo("hand-ins/folder/out.bmp")
        self.add("inner", files=())
        os.symlink(SAMPLE, "hand-ins/inner/square")
        os.symlink(SAMPLE, "hand-ins/itself")
        os.symlink(SAMPLE, "hand-ins/itself.zip")
        shutil.make_archive("elsewhere", "zip", SAMPLE)
        os.symlink("../elsewhere.zip", "hand-ins/link.zip")
        os.symlink("/dev/zero", "hand-ins/zero.tar")
        os.mkfifo("hand-ins/pipe.tar.gz")
        kinds = (tarfile.SYMTYPE, secret), (tarfile.LNKTYPE, secret), (tarfile.CHRTYPE,
                                                                       ""), (tarfile.FIFOTYPE,
                                                                             ""), (tarfile.LNKTYPE,
                                                                                   "stage2.txt")
        for i, (kind, target) in enumerate(kinds):
            self.tar(f"tar{i}", [("stage1.txt", kind, target)], self.members()[1:])
        info = zipfile.ZipInfo("stage1.txt")
        info.external_attr = 0o120777 << 16
        self.zip("zip", [(info, secret), *self.members()[1:]])
        rows = self.judge()
        self.assertEqual({name: float(row["score"])
                          for name, row in rows.items()}, {
                              "zoe": 1.0, "folder": 0.6, "inner": 0.0, "itself": 0.0, "link": 0.0,
                              "zero": 0.0, "pipe": 0.0, "zip": 0.6, **{f"tar{i}": 0.6
                                                                       for i in range(5)}})
        self.assertIn("1 entry not looked at: links", rows["folder"]["remarks"])
        self.assertIn("1 entry not looked at: devices and pipes", rows["folder"]["remarks"])
        for path in pathlib.Path("graded").rglob("*.*"):
            if path.is_file():
                self.assertNotIn(SECRET, path.read_text())

    def test_links_that_replace_what_was_listed(self):
        self.add("a", "in")
        contents = contents_of("hand-ins/a")
        os.rename("hand-ins/a/in/stage1.txt", "stage1.txt")
        os.symlink("../../../stage1.txt", "hand-ins/a/in/stage1.txt")
        self.assertTrue(contents.data(("in", "stage2.txt"), 10**6))
        with self.assertRaises(OSError):
            contents.data(("in", "stage1.txt"), 10**6)
        os.rename("hand-ins/a/in", "in")
        os.symlink("../../in", "hand-ins/a/in")
        with self.assertRaises(OSError):
            contents.data(("in", "stage2.txt"), 10**6)

    def test_a_lower_limit_that_only_root_could_raise_stays(self):
        no_root = "setpriv --inh-caps=-sys_resource --bounding-set=-sys_resource " * (not os.geteuid())
        line = f'ulimit -f 2048; ulimit -v 1500000; exec {no_root}"$0" "$@"'
        done = subprocess.run(["sh", "-c", line, SOURCE / "scripts/grade", "hand-ins", "tests"],
                              env={**os.environ, "BIN": str(BIN)}, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.scores(), {"zoe": 1.0})

    def test_what_a_judge_writes_has_a_limit(self):
        def greedy(*_):
            with open("large", "wb") as file:
                file.truncate(1 << 30)
                file.truncate((1 << 30) + 1)

        with mock.patch.object(graders, "grade", greedy), mock.patch.object(graders.traceback, "print_exc"):
            hand_in = find_hand_ins("hand-ins", False)[0][0]
            (_, graded), = graders.grade_all([hand_in], [], "none", graders.Limits(60, 2048, 1))
        self.assertEqual(graded.failure, "It could not be judged: OSError.")
        self.assertEqual(os.path.getsize("large"), 1 << 30)

    def test_no_judge_and_none_of_its_tools_outlives_grade(self):
        os.mkfifo("held")
        tools = tools_with("project", '[ "$1" != --scene ] || exec sleep 100 > held\nexec $real "$@"')
        for number in (signal.SIGKILL, signal.SIGTERM, signal.SIGHUP, signal.SIGINT):
            with self.subTest(number), tempfile.TemporaryDirectory() as temporary:
                reader, writer = os.pipe()  # which the judge inherits
                self.addCleanup(os.close, reader)
                with open("told", "w") as told:
                    grade = subprocess.Popen(
                        [SOURCE / "scripts/grade", "hand-ins", "tests", "-o", f"{number.name}/graded"],
                        stderr=told, stdout=subprocess.DEVNULL, pass_fds=[writer], preexec_fn=heed_signals,
                        env={**os.environ, "BIN": str(tools), "TMPDIR": temporary})
                os.close(writer)
                with open("held", "rb") as tool:  # once a judge's tool has opened it
                    end_by_signal(grade, number)
                    for end in (tool.fileno(), reader):
                        self.assertTrue(select.select([end], [], [], 60)[0])
                        self.assertEqual(os.read(end, 1), b"")
                self.assertEqual(grade.returncode, -number)
                name = signal.Signals(number).name
                self.assertRegex(pathlib.Path("told").read_text(), rf"\A(grade: ended by {name}\n)?\Z")
                if number != signal.SIGKILL:
                    self.assertEqual((os.listdir(temporary), os.path.exists(name)), ([], False))

    def test_archives_that_swell(self):
        with zipfile.ZipFile("hand-ins/zip.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for name in FILES:
                with archive.open(name, "w", force_zip64=True) as file:
                    for _ in range(100):
                        file.write(bytes(1 << 20))
        with gzip.open("hand-ins/tar.tar.gz", "wb", 1) as file:
            for _ in range(300):
                file.write(bytes(1 << 20))
        info = tarfile.TarInfo("stage1.txt")  # claims more than there is
        info.size = 1 << 40
        pathlib.Path("hand-ins/claims.tar").write_bytes(info.tobuf())
        header = tarfile.TarInfo("x")
        header.type, header.size = tarfile.XHDTYPE, 1 << 40
        pathlib.Path("hand-ins/pax.tar").write_bytes(header.tobuf() + bytes(1024))
        rows = self.judge()
        self.assertEqual([float(rows[name]["score"]) for name in ("zip", "tar", "claims", "pax")], [0.0] * 4)
        self.assertIn("swells to more than 256 MiB", rows["tar"]["remarks"])
        self.assertIn("more than the scene can need", self.page(4) + self.page(5))

    def test_archives_that_are_none(self):
        zipped = io.BytesIO()
        with zipfile.ZipFile(zipped, "w") as archive:
            for name, data in self.members():
                archive.writestr(name, data)
        data = zipped.getvalue()
        for i, content in enumerate((b"", b"PK", b"\x1f\x8b", b"\0" * 5000, b"x" * 5000, data[:-30])):
            pathlib.Path(f"hand-ins/{i}.zip").write_bytes(content)
        corrupt = bytearray(data)
        at = data.index((SAMPLE / "stage1.txt").read_bytes())
        corrupt[at] ^= 1  # its checksum fails
        pathlib.Path("hand-ins/checksum.zip").write_bytes(corrupt)
        encrypted = bytearray(data)
        for mark, offset in ((b"PK\3\4", 6), (b"PK\1\2", 8)):
            encrypted[data.index(mark) + offset] |= 1
        pathlib.Path("hand-ins/encrypted.zip").write_bytes(encrypted)
        rows = self.judge()
        self.assertEqual({name: float(row["score"])
                          for name, row in rows.items()},
                         {"zoe": 1.0, "checksum": 0.6, "encrypted": 0.6, **{str(i): 0.0
                                                                            for i in range(6)}})

    def test_many_files_and_deep_folders(self):
        with tarfile.open("hand-ins/many.tar", "w") as archive:
            for i in range(100_000):
                archive.addfile(tarfile.TarInfo(f"{i}/stage1.txt"))
        with zipfile.ZipFile("hand-ins/many too.zip", "w") as archive:
            for i in range(30_000):
                archive.writestr(f"{i}/stage1.txt", b"")
        self.add("deep", *["d"] * 15)
        self.add("folders")
        pathlib.Path("hand-ins/folders/" + "d/" * 900).mkdir(parents=True)
        self.zip("deeper", [("d/" * 5000 + "stage1.txt", b"1 2 3\n")])
        rows = self.judge()
        self.assertEqual(
            {name: float(row["score"])
             for name, row in rows.items()},
            {"zoe": 1.0, "many": 0.0, "many too": 0.0, "deep": 0.0, "folders": 1.0, "deeper": 0.0})
        for name in ("many", "many too"):
            self.assertIn("more than 20000 files", rows[name]["remarks"])

    def test_endless_files(self):
        self.add("a", files=())
        for name in FILES:
            with open(f"hand-ins/a/{name}", "wb") as file:
                file.truncate(1 << 40)
        rows = self.judge(status=0)
        self.assertEqual(float(rows["a"]["score"]), 0.0)

    def test_many_triangles_over_the_whole_screen(self):
        self.add("a")
        pathlib.Path("hand-ins/a/stage3.txt").write_text("-9 -9 0\n9 -9 0\n0 9 .5\n" * 30_000)
        self.judge("--time-limit", "60", status=0)
        self.assertIn("30000 triangles in place of 1", self.page(1))
        self.assertIn("by the right numbers, which are not those of stage3.txt", self.page(1))

    def graded_by(self, judge_files, seconds):
        """The Graded of a right hand-in with three tests, whose files are judged by a function of the right
        one and the words for it."""
        for name in ("square-2", "square-3"):
            self.add_test(name)
        for name in ("square", "square-2", "square-3"):
            self.add("a", name)
        with mock.patch.dict(os.environ, BIN=str(BIN)):
            tests, _ = read_tests("tests")
        hand_in, = [one for one in find_hand_ins("hand-ins", False)[0] if one.name == "a"]
        right, limits = graders.judge_files, graders.Limits(seconds, 2048, 1)
        with mock.patch.object(graders, "judge_files", lambda *words: judge_files(right, words)):
            (_, graded), = graders.grade_all([hand_in], tests, "cause", limits)
        return graded

    def test_a_busy_machine_changes_no_verdict(self):
        def waiting(judge_files, words):
            time.sleep(1.2)  # as a process does that gets no processor
            return judge_files(*words)

        graded = self.graded_by(waiting, 1)
        self.assertEqual((graded.score, graded.failure, graded.remarks), (3.0, "", []))

    def test_thirty_times_the_clock_gives_the_same_table(self):
        """A machine so busy that its clock runs thirty times as fast as its processor."""
        self.add("anna", mistake=True)
        self.add("ben")
        with mock.patch.dict(os.environ, BIN=str(BIN)):
            tests, _ = read_tests("tests")
        hand_ins, tables, right = find_hand_ins("hand-ins", False)[0], [], time.monotonic
        for load in 1, 30:
            with mock.patch.object(graders.time, "monotonic", lambda load=load: load * right()):
                graded = list(graders.grade_all(hand_ins, tests, "fix", graders.Limits(120, 2048, 2)))
            graded.sort(key=lambda pair: pair[0].number)
            tables.append(csv_of(graded, tests) + b"".join(gradescope(one, tests) for _, one in graded))
        self.assertEqual(*tables)

    def test_a_test_that_takes_too_long_costs_no_other(self):
        def endless(judge_files, words):
            while words[1].name == "square-2":
                pass
            return judge_files(*words)

        graded = self.graded_by(endless, 2)
        self.assertEqual([test.score for test in graded.tests], [1.0, 0.0, 1.0])
        self.assertEqual({file.verdict for file in graded.tests[1].verdict.files}, {"could not be judged"})
        self.assertEqual(
            (graded.remarks, graded.is_judged),
            (["square-2: it could not be judged: that takes longer than 2 s of the processor"], False))

    def test_a_program_that_takes_too_long_to_judge_in_one_test_is_judged_in_the_next(self):
        self.add_test("square-2")
        pathlib.Path("tests/assignment.txt").write_text("program view\nrun cat\n")
        right = programs.verdict_of_test

        def endless(built, test):
            while test.name == "square":
                pass
            return right(built, test)

        with mock.patch.dict(os.environ, BIN=str(BIN)), \
                mock.patch.object(programs, "verdict_of_test", endless):
            tests, settings = read_tests("tests")
            limits = graders.Limits(2, 2048, 1, (), settings.program)
            (_, graded), = graders.grade_all(find_hand_ins("hand-ins", False)[0], tests, "cause", limits)
        self.assertEqual([made.verdict.files[0].verdict for made in graded.tests],
                         ["could not be judged", "wrong"])

    def test_a_judge_that_is_ended_keeps_what_was_judged(self):
        def ended(judge_files, words):
            if words[1].name == "square-2":
                os.kill(os.getpid(), signal.SIGKILL)
            return judge_files(*words)

        graded = self.graded_by(ended, 60)
        self.assertEqual([test.score for test in graded.tests], [1.0, 0.0, 0.0])
        self.assertEqual(graded.failure,
                         "It could not be judged: its judge was ended, perhaps for lack of memory.")

    def test_time_and_memory_have_limits(self):
        self.add("a")
        pathlib.Path("hand-ins/a/stage3.txt").write_text("-9 -9 0\n9 -9 0\n0 9 .5\n" * 30_000)
        os.mkdir("temporary")
        os.environ["TMPDIR"] = os.path.abspath("temporary")
        self.addCleanup(os.environ.pop, "TMPDIR")
        self.grade("--time-limit", "0.01", status=1)
        self.assertEqual(os.listdir("temporary"), [])
        # The other one may be done before anybody looks.
        self.assertIn("takes longer than 0.01 s", {row["hand-in"]: row["remarks"]
                                                   for row in self.rows()}["a"])
        for end, reason in (("exit 1", "project: exit status 1, perhaps as it"),
                            ("kill -9 $$", "project: ended by SIGKILL, perhaps as it"),
                            ("echo project: not enough memory >&2; exit 1", "that")):
            tools = tools_with(  # its first run is for what is right
                "project", f'if rmdir first; then exec $real "$@"; fi 2> /dev/null\n{end}')
            os.mkdir("first")
            done = run_script("grade", "hand-ins", "tests", env={**os.environ, "BIN": str(tools)})
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"It could not be judged: {reason} needs more than", self.rows()[0]["remarks"])
        self.grade("--memory-limit", "1", status=1)
        self.assertIn("needs more than 1 MiB of memory", self.rows()[0]["remarks"])


if __name__ == "__main__":
    unittest.main()
