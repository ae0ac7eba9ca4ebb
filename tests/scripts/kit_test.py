#!/usr/bin/env python3
"""The kits of scripts/grade: each judges right, wrong and hostile hand-ins in a bare root, with the points of
grade and in the published form of its system.

usage: kit_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import unittest
import zipfile
from datetime import datetime
from types import SimpleNamespace
from unittest import mock

from grade_parts import kit_classroom50
from toolbox import BIN, SOURCE, ToolTest, has_bubblewrap, run_script

FORMS = json.loads((pathlib.Path(__file__).parent / "kit_forms.json").read_text())
KINDS = ("gradescope", "classroom50", "plain")
SAMPLES = ("worked-example", "nested-transforms")
SECRET = "77.25 eye of the teacher"
TYPES = {"number": (int, float), "whole": int, "string": str, "boolean": bool, "list": list, "object": dict}
ENVIRONMENT = {
    "CLASSROOM": "c", "ASSIGNMENT": "a", "SUBMISSION_TAG": "submit/1", "COMMIT_URL": "https://h/c",
    "RELEASE_URL": "https://h/r", "BIN": "/secret"}
RUN = {
    "gradescope": ["/autograder/run_autograder"], "classroom50": [
        "/usr/bin/python3", "/autograder/source/autograder.py"], "plain": [
            "/autograder/source/judge", "/autograder/submission", "/autograder/results"]}
# A view stage, right for cameras that look down -z: ours, whose source is in no hand-in, as a program.
VIEW = '''import sys
for line in sys.stdin:
    words = line.split()
    if line.startswith("eye"): eye = words[1:]
    elif line[0] in "-0123456789": print(*("%.7f" % (float(x) - float(e)) for x, e in zip(words, eye)))
    elif not line.startswith(("look", "up")): print(line, end="")
'''
# What a program tries: to read what is there, and to write what counts; then one of ENDINGS.
HOSTILE = '''import glob, os, sys, time
for path in glob.glob("/autograder/**", recursive=True) + glob.glob("/secret/*"):
    for mode in ("a", "r"):
        try:
            with open(path, mode) as file:
                if mode == "r": print(file.read(), file=sys.stderr)
                else: file.write('{"score": 1000}')
        except OSError: pass
for name in ("/autograder/results/results.json", "result.json", "../result.json", "../../result.json"):
    try:
        if os.path.lexists(name): os.unlink(name)
        os.symlink("/secret/teacher.txt", name)
    except OSError: pass
print('{"score": 1000, "tests": []}')
'''
DAEMON = "if not os.fork():\n    os.setsid()\n    if not os.fork(): time.sleep(40)\nwhile True: pass\n"
ENDINGS = {
    "hangs with a daemon": DAEMON, "forks": "while True: os.fork()\n",
    "fills": "for i in range(1000): open(f'f{i}', 'wb').write(bytes(1 << 24))\n"}
# Put before one that is right: fails if it can read a test, a result, a secret, or what an earlier run left.
CURIOUS = '''import glob, os
for path in glob.glob("/autograder/source/**", recursive=True) + glob.glob("/autograder/results/*"):
    assert not os.path.isfile(path) or not os.access(path, os.R_OK), path
for path in ("/autograder/source/pipeline/assignment", "/secret/teacher.txt"):
    try: os.listdir(path) if os.path.isdir(path) else open(path).read()
    except OSError: continue
    raise SystemExit(3)
assert os.path.exists("/secret") != SANDBOX
if not SANDBOX:
    os.makedirs("/tmp/left/closed")  # fails where an earlier run has left it
    os.chmod("/tmp/left", 0)
'''
# Each while another program runs: ends all that it can, and is right; takes another's file, or is right if it
# can read results, and leaves a segment, a queue and a folder.
KILLER = "import os, signal\nif not os.fork(): os.kill(-1, signal.SIGKILL)\nos.wait()\n"
STAYS = '''import signal, subprocess, time
signal.signal(signal.SIGTERM, signal.SIG_IGN)
subprocess.Popen(["sleep", "999"], start_new_session=True)
for path in ("/tmp/left", "/open/left"): open(path, "w")
time.sleep(999)
'''
THIEF = '''import ctypes, glob, os, sys, time
OUT = "/autograder/*.out/*"
ctypes.CDLL(None).shmget(0, 4096, 0o1600)
ctypes.CDLL(None).mq_open(b"/left", os.O_CREAT | os.O_RDWR, 0o600, None)
os.mkdir("/tmp/left")
os.chmod("/tmp/left", 0o777)
end, given = time.monotonic() + 5, sys.stdin.read()
while time.monotonic() < end and not any(os.access(path, os.R_OK) for path in glob.glob(OUT)):
    for path in glob.glob("/proc/[0-9]*/cmdline"):
        for word in open(path).read().split("\\0") if os.path.exists(path) else ():
            if word.endswith("view.py") and word != os.path.abspath(__file__) and os.access(word, os.R_OK):
                os.execvp("sh", ["sh", "-c", f"echo '{given}' | python3 {word}"])
    time.sleep(0.02)
sys.stdin = given.splitlines(True) if time.monotonic() < end else ()
'''

# A root that holds the system's programs, /autograder and /secret alone; $1 is the folder of both, $2 a
# program that is not there.
ENTER = """set -e
top=$1 without=$2 root=$1/../root; shift 2
mkdir -p "$root"; mount --bind "$root" "$root"; cd "$root"
mkdir -p usr proc dev tmp etc autograder secret old
for name in bin sbin lib lib64; do ln -sf "usr/$name" .; done
mount --bind /usr usr; mount --rbind /dev dev; mount -t proc proc proc; mount -t tmpfs tmpfs tmp
mount --bind "$top" autograder; mount --bind "$top/../secret" secret
[ -z "$without" ] || mount --bind /dev/null "$without"
pivot_root . old; umount -l old  # by chroot there would be no namespaces in it, and so no sandbox
exec /usr/bin/env -i PATH=/usr/bin:/bin sh -c 'cd "$0" && exec env "$@"' "$@"
"""

UNSHARED = ["unshare", "--kill-child", "--mount", "--pid", "--net", "--ipc", "--fork"]


def entered(top, folder, *words, without=""):
    """Words that run others in that root, without a network."""
    return [*UNSHARED, "sh", "-c", ENTER, "sh", str(top), without, folder, *words]


def missing():
    """Why such a root cannot be had; empty if it can."""
    if os.geteuid() or not os.path.exists("/usr/bin/python3"):
        return "it needs root and /usr/bin/python3"
    words = [*UNSHARED, "mount", "-t", "tmpfs", "tmpfs", "/mnt"]
    done = subprocess.run(words, capture_output=True, text=True)
    return done.stderr.strip()


def parts(result):
    """{test: part of its points} of a result."""
    return {
        test.get("name", test.get("test-name")): round(
            test["score"] / test.get("max_score", test.get("max-score")), 4)
        for test in result["tests"]}


class KitTest(ToolTest):
    def setUp(self):
        super().setUp()
        for name in SAMPLES:
            os.makedirs(f"tests/{name}")
            for file in ("scene.txt", "config.txt"):
                shutil.copy(SOURCE / "samples" / name / file, f"tests/{name}")
        os.mkdir("hand-ins")
        os.mkdir("secret")
        pathlib.Path("secret/teacher.txt").write_text(SECRET)
        os.chmod("secret/teacher.txt", 0o600)

    def grade(self, *words, status=0):
        done = run_script("grade", *words)
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def make(self, kind):
        """The top of an unpacked kit, as its system lays it out."""
        self.grade("--kit", kind, "tests", "-o", f"{kind}.zip")
        top = pathlib.Path(kind).resolve()
        with zipfile.ZipFile(f"{kind}.zip") as archive:
            for info in archive.infolist():
                os.chmod(archive.extract(info, top / "source"), info.external_attr >> 16)
        if kind == "gradescope":
            shutil.copy2(top / "source/run_autograder", top)
        (top / "source/json.py").write_text("a hand-in beside the kit is not asked")
        # As setup.sh does, and CONTRACT.md tells.
        subprocess.run(["chmod", "-R", "go=", top / "source"], check=True)
        return top

    def run_kit(self, kind, top, hand_in, can_sandbox=True):
        """The parts of its points that a kit gives a hand-in, by test."""
        for name in ("submission", "results"):
            shutil.rmtree(top / name, ignore_errors=True)
        shutil.copytree(hand_in, top / "submission", symlinks=True)
        (top / "results").mkdir()
        (top / "results").chmod(0o777)
        folder = "/autograder/submission" if kind == "classroom50" else "/autograder"
        variables = [f"{name}={value}" for name, value in ENVIRONMENT.items()]
        words = entered(top, folder, *variables, *RUN[kind], without="" if can_sandbox else "usr/bin/bwrap")
        done = subprocess.run(words, timeout=250, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), hand_in)
        path = top / {"classroom50": "submission/result.json"}.get(kind, "results/results.json")
        self.assertFalse(path.is_symlink())
        result = json.loads(path.read_text())
        self.expect_form(kind, result)
        self.assertNotIn(SECRET, path.read_text())
        self.assertEqual(pathlib.Path("secret/teacher.txt").read_text(), SECRET)
        return parts(result)

    def expect_points_of_grade(self, expected):
        """`expected`: for each hand-in, the parts of their points that it has in SAMPLES."""
        self.grade("hand-ins", "tests", "-o", "graded")
        with open("graded/grades.csv", newline="") as file:
            numbers = {row["hand-in"]: row["number"] for row in csv.DictReader(file)}
        for name, points in expected.items():
            [path] = pathlib.Path("graded").glob(f"{numbers[name]}-*/results.json")
            self.assertEqual(parts(json.loads(path.read_text())), points, name)
        for kind in KINDS:
            top = self.make(kind)
            for name, points in expected.items():
                self.assertEqual(self.run_kit(kind, top, f"hand-ins/{name}"), points, f"{kind} {name}")

    def expect_form(self, kind, result):
        form = FORMS["gradescope" if kind == "plain" else kind]
        for fields, found in ((form["result"], result), *((form["test"], test) for test in result["tests"])):
            for name, value in found.items():
                words = fields.get(name, fields.get("*"))
                self.assertIsNotNone(words, f"{kind}: {name}")
                kinds = [word for word in words if word != "required"]
                fits = isinstance(value, TYPES[kinds[0]]) and (type(value) is bool) == (
                    kinds[0] == "boolean") if kinds[0] in TYPES else value in kinds
                self.assertTrue(fits, f"{kind}: {name}: {value!r}")
            required = {name for name, words in fields.items() if "required" in words}
            self.assertLessEqual(required, set(found))


class Archives(KitTest):
    def test_the_same_kit_has_the_same_bytes(self):
        for kind in KINDS:
            for name in ("a.zip", "b.zip"):
                self.grade("--kit", kind, "tests", "-o", name)
            self.assertEqual(pathlib.Path("a.zip").read_bytes(), pathlib.Path("b.zip").read_bytes())
            members = zipfile.ZipFile("a.zip").infolist()
            self.assertEqual({member.date_time for member in members}, {(1980, 1, 1, 0, 0, 0)})
            names = [member.filename for member in members]
            self.assertEqual(names, sorted(names))
            expected = FORMS[kind]["members"] if kind in FORMS else ["judge", "CONTRACT.md"]
            self.assertLessEqual(set(expected), set(names))

    def test_only_an_assignment_goes_in(self):
        pathlib.Path("tests/solution.txt").write_text(SECRET)
        pathlib.Path("tests/worked-example/stage1.txt").write_text(SECRET)
        self.grade("--kit", "plain", "tests", "-o", "a.zip")
        names = [name for name in zipfile.ZipFile("a.zip").namelist() if "/assignment/" in name]
        self.assertEqual(
            names,
            sorted(f"pipeline/assignment/{name}/{file}" for name in SAMPLES
                   for file in ("config.txt", "scene.txt")))

    def test_what_is_there_is_not_overwritten_by_mistake(self):
        for words, message in ((["--kit", "plain", "tests"], "expected --kit KIND TESTS -o FILE"), ([
                "--kit", "plain", "tests", "tests", "-o", "a"], "expected --kit KIND TESTS -o FILE"), ([
                    "--kit", "plain", "tests", "-o",
                    "tests/worked-example/scene.txt"], "a place outside of 'tests'"), ([
                        "--kit", "plain", "tests", "-o", "no/a.zip"], "cannot open no/a.zip"), ([
                            "--kit", "plain", "none", "-o", "a.zip"], "cannot read none")):
            self.assertIn(message, self.grade(*words, status=2).stderr)
        self.assertFalse(os.path.exists("a.zip"))

    def test_in_whole_points_a_test_of_little_weight_can_be_passed_and_failed(self):
        for share, points, passed in ((1, 1, True), (0, 0, False)):
            tests = [
                SimpleNamespace(name=name, max_score=most, score=most * share, kinds=(), words="", fixes=(),
                                by_teacher="") for name, most in (("much", 1.0), ("little", 1e-6))]
            result = kit_classroom50.result(SimpleNamespace(tests=tests, failure=""), tests, ENVIRONMENT,
                                            datetime.now())
            self.assertEqual([(row["score"], row["max-score"], row["passed"]) for row in result["tests"]],
                             [(points, 1, passed)] * 2)


@unittest.skipIf(missing(), f"no bare root: {missing()}")
class Judges(KitTest):
    """Each in a bare root."""
    def test_five_files_have_the_points_of_grade(self):
        pathlib.Path("tests/assignment.txt").write_text(
            "hints fix\npoints stage1.txt 1\npoints stage3.txt 2.5\npoints out.bmp 4\nanother-rule 0.5\n"
            "weight worked-example 2\n")
        for name in ("right", "wrong", "hostile"):
            for sample in SAMPLES:
                shutil.copytree(SOURCE / "samples" / sample, f"hand-ins/{name}/{sample}")
        text = pathlib.Path("hand-ins/wrong/worked-example/stage3.txt")
        text.write_text(text.read_text().replace("0.8660254", "1.7320508"))
        for sample in SAMPLES:  # a link to what is right, and a result of its own
            path = pathlib.Path(f"hand-ins/hostile/{sample}/stage1.txt")
            path.unlink()
            path.symlink_to(f"/autograder/source/pipeline/assignment/{sample}/scene.txt")
        os.makedirs("hand-ins/hostile/result.json/of/a/folder")
        for name in ("release-body.md", "results.json"):
            pathlib.Path("hand-ins/hostile", name).symlink_to("/secret/teacher.txt")
        self.expect_points_of_grade({
            "right": dict.fromkeys(SAMPLES, 1.0), "hostile": dict.fromkeys(SAMPLES, round(6.5 / 7.5, 4)),
            "wrong": {"worked-example": round(5 / 7.5, 4), "nested-transforms": 1.0}})

    def expect_programs(self, **programs):
        if not has_bubblewrap():
            self.skipTest("no bubblewrap")
        pathlib.Path("tests/assignment.txt").write_text(
            "program view\nbuild cp view.in view.py && ! grep -q unbuildable view.py\nrun python3 view.py\n")
        for name, text in programs.items():
            os.mkdir(f"hand-ins/{name}")
            pathlib.Path(f"hand-ins/{name}/view.in").write_text(text)

    def test_programs_have_the_points_of_grade(self):
        self.expect_programs(right=VIEW, wrong=VIEW.replace("- float", "+ float"), unbuilt="unbuildable",
                             ours="import os\nos.execvp('view', ['view'])\n")
        with mock.patch.dict(os.environ, PATH=f"/usr/bin:/bin:{os.environ['PATH']}:{BIN}"):
            self.expect_points_of_grade({
                name: dict.fromkeys(SAMPLES, float(name == "right"))
                for name in ("right", "wrong", "unbuilt", "ours")})

    def test_hostile_programs_get_nothing_and_leave_nothing(self):
        """With a sandbox, and as a user of its own."""
        self.expect_programs(curious="", **{name: HOSTILE + ending for name, ending in ENDINGS.items()})
        both = self.make("gradescope").rename("both").resolve()
        shutil.rmtree("tests/nested-transforms")
        top = self.make("gradescope")

        def files():
            return {path: path.read_bytes() for path in (top / "source").rglob("*") if path.is_file()}

        before = files()
        for can_sandbox in (True, False):
            pathlib.Path("hand-ins/curious/view.in").write_text(
                CURIOUS.replace("SANDBOX", str(can_sandbox)) + VIEW)
            self.assertEqual(self.run_kit("gradescope", both, "hand-ins/curious", can_sandbox),
                             dict.fromkeys(SAMPLES, 1.0), can_sandbox)
            for name in ENDINGS:
                with self.subTest(name, can_sandbox=can_sandbox):
                    self.assertEqual(self.run_kit("gradescope", top, f"hand-ins/{name}", can_sandbox),
                                     {"worked-example": 0.0})
                    self.assertEqual(os.listdir(top / "results"), ["results.json"])
        self.assertEqual(files(), before)

    def test_programs_without_a_sandbox_neither_end_nor_read_each_other(self):
        """Two at a time; each does its worst while the other one runs."""
        slow = VIEW.replace(
            "import sys", "import os, sys, time\ntime.sleep(1)\n"
            "if os.path.exists('/tmp/left'): os.makedirs('/tmp/left/guest/x', 0o700)")
        self.expect_programs(right=slow, killer=KILLER + VIEW, thief=THIEF + VIEW)
        shutil.rmtree("tests/nested-transforms")
        top = self.make("plain")
        for hostile in ("killer", "thief"):
            for name in ("right", hostile):
                shutil.copytree(f"hand-ins/{name}", top / name, dirs_exist_ok=True)
            judges = "".join(f"source/judge {name} {name}.out & " for name in ("right", hostile)) + "wait"
            look = "mkdir -p /mq; mount -t mqueue none /mq; cat /proc/sysvipc/shm; ls -A /tmp; ls /mq"
            done = subprocess.run(
                entered(top, "/autograder", "sh", "-c", f"{judges}; {look}", without="usr/bin/bwrap"),
                timeout=250, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))
            first, second, header, *left = done.stdout.splitlines()
            for line in (first, second):
                self.assertRegex(
                    line, r"^no sandbox \(.*\): each program runs as a user of its own, with "
                    "network, abstract sockets and System V segments, which are removed after ")
            self.assertEqual(left, [])
            for name, expected in (("right", 1.0), (hostile, 0.0)):
                result = json.loads((top / f"{name}.out/results.json").read_text())
                self.assertEqual(parts(result), {"worked-example": expected}, (name, hostile))

    def test_without_a_sandbox_an_ended_judge_leaves_nothing_and_an_unreadable_program_is_no_mistake(self):
        self.expect_programs(stays=STAYS, right=VIEW)
        top = self.make("plain")
        for name in ("stays", "right"):
            shutil.copytree(f"hand-ins/{name}", top / name)
        script = """mkdir -m 1777 /open; mkdir -m 700 closed; ln -s /usr/bin/python3 closed
for signal in TERM KILL; do
  source/judge stays out > /dev/null & while [ ! -e /open/left ]; do sleep 0.05; done
  kill -$signal $!; wait $!; echo $signal $?
  i=0; while ps -eo uid= | grep -q '6....' && [ $i -lt 200 ]; do i=$((i + 1)); sleep 0.05; done
  ps -eo uid= | grep '6....'; [ $signal = KILL ] || ls -A /open /tmp; rm -rf /open/*
done
umask 077; source/judge right out2 > /dev/null; echo $?
PATH=/autograder/closed:$PATH source/judge right out > /dev/null; echo $?"""
        done = subprocess.run(entered(top, "/autograder", "sh", "-c", script, without="usr/bin/bwrap"),
                              timeout=250, capture_output=True, text=True)
        self.assertEqual(done.stdout, "TERM 143\n/open:\n\n/tmp:\nKILL 137\n0\n1\n", done.stderr)
        results = [json.loads((top / name / "results.json").read_text()) for name in ("out2", "out")]
        self.assertEqual([result["score"] for result in results], [2.0, 0.0])
        self.assertIn("could not be judged: /autograder/closed/python3 may not be run", results[1]["output"])


if __name__ == "__main__":
    unittest.main()
