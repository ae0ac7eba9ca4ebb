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
import sys
import time
import unittest
import zipfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from toolbox import BIN, SOURCE, ToolTest  # noqa: E402

FORMS = json.loads((pathlib.Path(__file__).parent / "kit_forms.json").read_text())
KINDS = ("gradescope", "classroom50", "plain")
SAMPLES = ("worked-example", "nested-transforms")
FILES = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")
SECRET = "77.25 eye of the teacher"
TYPES = {"number": (int, float), "whole": int, "string": str, "boolean": bool, "list": list, "object": dict}
ENVIRONMENT = {
    "CLASSROOM": "c", "ASSIGNMENT": "a", "SUBMISSION_TAG": "submit/1", "COMMIT_URL": "https://h/c",
    "RELEASE_URL": "https://h/r"}
RUN = {
    "gradescope": ["/autograder/run_autograder"],
    "classroom50": ["/usr/bin/python3", "/autograder/source/autograder.py"],
    "plain": ["/autograder/source/judge", "/autograder/submission", "/autograder/results"]}
# A view stage that is right: ours, whose source is in no hand-in, as a program that reads what it needs.
VIEW = '''import sys
def sub(a, b): return [x - y for x, y in zip(a, b)]
def dot(a, b): return sum(x * y for x, y in zip(a, b))
def cross(a, b): return [a[1]*b[2]-a[2]*b[1], a[2]*b[0]-a[0]*b[2], a[0]*b[1]-a[1]*b[0]]
def unit(a): return [x / dot(a, a) ** .5 for x in a]
of = {}
for line in sys.stdin:
    words = line.split()
    if words and words[0] in ("eye", "look", "up"):
        of[words[0]] = list(map(float, words[1:]))
    elif words and words[0][0] in "-0123456789":
        l = unit(sub(of["look"], of["eye"])); r = unit(cross(l, of["up"])); u = cross(r, l)
        p = sub(list(map(float, words)), of["eye"])
        print(*("%.7f" % x for x in (dot(r, p), dot(u, p), SIGN dot(l, p))))
    else:
        print(line, end="")
'''
# What a program tries: to read the test and what else is there, to write what counts, to go on for ever, to
# start more, to fill the disk.
HOSTILE = '''import glob, os, sys
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
KIND
'''
# One that is right unless it can read a test, or a secret of root's, or write a result.
CURIOUS = '''import glob, os
for path in glob.glob("/autograder/source/**", recursive=True) + glob.glob("/autograder/results/*"):
    assert not os.path.isfile(path) or not os.access(path, os.R_OK), path
for path in ("/autograder/source/pipeline/assignment", "/secret/teacher.txt"):
    try: os.listdir(path) if os.path.isdir(path) else open(path).read()
    except OSError: continue
    raise SystemExit(3)
'''
ENDINGS = {
    "hangs": "while True: pass",
    "forks": "while True: os.fork()",
    "fills": "for i in range(1000): open(f'f{i}', 'wb').write(bytes(1 << 24))",
    "daemon":
    "if not os.fork():\n    os.setsid()\n    if not os.fork():\n        import time; time.sleep(40)\n",
}


# A root that holds the system's programs, /autograder and /secret alone; $1 is the folder of both, $2 a
# program that is not there.
ENTER = """set -e
top=$1 without=$2 root=$1/../root; shift 2
mkdir -p "$root"; cd "$root"
mkdir -p usr proc dev tmp etc autograder secret
for name in bin sbin lib lib64; do ln -sf "usr/$name" .; done
mount --bind /usr usr; mount --rbind /dev dev; mount -t proc proc proc; mount -t tmpfs tmpfs tmp
mount --bind "$top" autograder; mount --bind "$top/../secret" secret
[ -z "$without" ] || mount --bind /dev/null "$without"
exec chroot . /usr/bin/env -i PATH=/usr/bin:/bin sh -c 'cd "$0" && exec env "$@"' "$@"
"""


UNSHARED = ["unshare", "--mount", "--pid", "--net", "--ipc", "--fork"]


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
        done = subprocess.run([SOURCE / "scripts/grade", *words], capture_output=True, text=True, timeout=280,
                              env={**os.environ, "BIN": str(BIN)})
        self.assertEqual(done.returncode, status, done.stderr)
        return done

    def make(self, kind):
        """The top of an unpacked kit, as its system lays it out."""
        self.grade("--kit", kind, "tests", "-o", f"{kind}.zip")
        top = pathlib.Path(kind).resolve()
        for name in ("source", "submission", "results"):
            (top / name).mkdir(parents=True)
        with zipfile.ZipFile(f"{kind}.zip") as archive:
            for info in archive.infolist():
                os.chmod(archive.extract(info, top / "source"), info.external_attr >> 16)
        if kind == "gradescope":
            shutil.copy2(top / "source/run_autograder", top)
        for folder, _, files in os.walk(top / "source"):  # as setup.sh does, and CONTRACT.md tells
            for name in (".", *files):
                path = pathlib.Path(folder, name)
                path.chmod(path.stat().st_mode & 0o700)
        return top

    def run_kit(self, kind, top, hand_in, can_sandbox=True):
        """What a kit makes of a hand-in: its result as an object."""
        shutil.rmtree(top / "submission")
        shutil.copytree(hand_in, top / "submission", symlinks=True)
        shutil.rmtree(top / "results")
        (top / "results").mkdir(mode=0o777)
        (top / "results").chmod(0o777)
        folder = "/autograder/submission" if kind == "classroom50" else "/autograder"
        variables = [f"{name}={value}" for name, value in ENVIRONMENT.items()]
        words = entered(top, folder, *variables, *RUN[kind], without="" if can_sandbox else "usr/bin/bwrap")
        done = subprocess.run(words, timeout=250, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""), hand_in)
        result = top / {"classroom50": "submission/result.json"}.get(kind, "results/results.json")
        self.assertFalse(result.is_symlink())
        return json.loads(result.read_text())

    def points(self, result):
        """{test: part of its points} of a result."""
        return {test.get("name", test.get("test-name")):
                test["score"] / test.get("max_score", test.get("max-score"))
                for test in result["tests"]}

    def graded(self):
        """The same of all hand-ins, by grade."""
        self.grade("hand-ins", "tests", "-o", "graded")
        with open("graded/grades.csv", newline="") as file:
            return {row["hand-in"]: {name: float(row[name]) / (float(row["max_score"]) / len(SAMPLES))
                                     for name in SAMPLES} for row in csv.DictReader(file)}

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
            self.grade("--kit", kind, "tests", "-o", "a.zip")
            time.sleep(1.1)
            self.grade("--kit", kind, "tests", "-o", "b.zip")
            self.assertEqual(pathlib.Path("a.zip").read_bytes(), pathlib.Path("b.zip").read_bytes())
            names = zipfile.ZipFile("a.zip").namelist()
            self.assertEqual(names, sorted(names))
            for name in FORMS.get(kind, {"members": ["judge", "CONTRACT.md"]})["members"]:
                self.assertIn(name, names)

    def test_only_an_assignment_goes_in(self):
        pathlib.Path("tests/solution.txt").write_text(SECRET)
        pathlib.Path("tests/worked-example/stage1.txt").write_text(SECRET)
        self.grade("--kit", "plain", "tests", "-o", "a.zip")
        names = [name for name in zipfile.ZipFile("a.zip").namelist() if "/assignment/" in name]
        self.assertEqual(names, sorted(f"pipeline/assignment/{name}/{file}" for name in SAMPLES
                                       for file in ("config.txt", "scene.txt")))

    def test_what_is_there_is_not_overwritten_by_mistake(self):
        for words, message in (
            (["--kit", "plain", "tests"], "expected --kit KIND TESTS -o FILE"),
            (["--kit", "plain", "tests", "tests", "-o", "a"], "expected --kit KIND TESTS -o FILE"),
            (["--kit", "plain", "tests", "-o", "tests/worked-example/scene.txt"], "a file outside of TESTS"),
            (["--kit", "plain", "tests", "-o", "no/a.zip"], "cannot open no/a.zip"),
            (["--kit", "plain", "none", "-o", "a.zip"], "cannot read none")):
            self.assertIn(message, self.grade(*words, status=2).stderr)
        self.assertFalse(os.path.exists("a.zip"))


@unittest.skipIf(missing(), f"no bare root: {missing()}")
class FiveFiles(KitTest):
    def test_points_are_those_of_grade(self):
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
        for name in ("result.json", "results.json"):
            pathlib.Path("hand-ins/hostile", name).symlink_to("/secret/teacher.txt")
        with_csv = self.grade("hand-ins", "tests", "-o", "graded")
        self.assertIn("3 hand-ins, 1 right", with_csv.stdout)
        with open("graded/grades.csv", newline="") as file:
            rows = {row["hand-in"]: row for row in csv.DictReader(file)}
        most = {"worked-example": 15.0, "nested-transforms": 7.5}
        expected = {name: {test: float(row[test]) / most[test] for test in SAMPLES}
                    for name, row in rows.items()}
        self.assertEqual(expected["right"], {name: 1.0 for name in SAMPLES})
        self.assertEqual(float(rows["wrong"]["worked-example"]), 15.0 - 2 * 2.5 - 2 * 4 * (
            "out.bmp" in rows["wrong"]["worked-example verdict"]))
        self.assertEqual(expected["hostile"], {name: 6.5 / 7.5 for name in SAMPLES})
        for kind in KINDS:
            top = self.make(kind)
            for name in rows:
                result = self.run_kit(kind, top, f"hand-ins/{name}")
                self.expect_form(kind, result)
                for test, part in self.points(result).items():
                    self.assertAlmostEqual(part, expected[name][test], 4, f"{kind} {name} {test}")
            self.assertEqual(pathlib.Path("secret/teacher.txt").read_text(), SECRET)


@unittest.skipIf(missing(), f"no bare root: {missing()}")
@unittest.skipUnless(shutil.which("bwrap") and shutil.which("setpriv"), "no bubblewrap or no setpriv")
class Programs(KitTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("tests/assignment.txt").write_text(
            "program view\nbuild cp view.in view.py && ! grep -q unbuildable view.py\nrun python3 view.py\n")
        os.environ["PATH"] = f"/usr/bin:/bin:{os.environ['PATH']}:{BIN}"
        self.add("right", VIEW.replace("SIGN", "-"))
        self.add("wrong", VIEW.replace("SIGN", ""))
        self.add("unbuilt", "unbuildable")

    def add(self, name, text):
        os.mkdir(f"hand-ins/{name}")
        pathlib.Path(f"hand-ins/{name}/view.in").write_text(text)

    def test_points_are_those_of_grade(self):
        self.add("hangs", HOSTILE.replace("KIND", ENDINGS["hangs"]))
        self.add("ours", "import os\nos.execvp('view', ['view'])\n")
        expected = self.graded()
        part = {"right": 1.0, "wrong": 0.0, "unbuilt": 0.0, "hangs": 0.0, "ours": 0.0}
        self.assertEqual(expected, {name: dict.fromkeys(SAMPLES, points) for name, points in part.items()})
        for kind in KINDS:
            top = self.make(kind)
            for name in part:
                result = self.run_kit(kind, top, f"hand-ins/{name}")
                self.expect_form(kind, result)
                self.assertEqual(self.points(result), expected[name], f"{kind} {name}")
                self.assertNotIn(SECRET, json.dumps(result))
            self.assertEqual(pathlib.Path("secret/teacher.txt").read_text(), SECRET)

    def test_hostile_programs_get_nothing_and_leave_nothing(self):
        """With a sandbox, and as nobody."""
        top = self.make("gradescope")

        def files():
            return {path: path.read_bytes() for path in (top / "source").rglob("*") if path.is_file()}

        before = files()
        for name, text in ENDINGS.items():
            self.add(name, HOSTILE.replace("KIND", text))
            for can_sandbox in (True, False):
                with self.subTest(name, can_sandbox=can_sandbox):
                    result = self.run_kit("gradescope", top, f"hand-ins/{name}", can_sandbox=can_sandbox)
                    self.assertEqual(self.points(result), {test: 0.0 for test in SAMPLES})
                    self.assertNotIn(SECRET, json.dumps(result))
                    self.assertEqual(os.listdir(top / "results"), ["results.json"])
        self.assertEqual(files(), before)
        self.assertEqual(pathlib.Path("secret/teacher.txt").read_text(), SECRET)
        self.add("curious", CURIOUS + VIEW.replace("SIGN", "-"))
        for can_sandbox in (True, False):
            result = self.run_kit("gradescope", top, "hand-ins/curious", can_sandbox=can_sandbox)
            self.assertEqual(self.points(result), {test: 1.0 for test in SAMPLES}, can_sandbox)


if __name__ == "__main__":
    unittest.main()
