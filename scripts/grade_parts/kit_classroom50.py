"""The kit for Classroom 50: the files of CLASSROOM/autograders/ASSIGNMENT. Its points are whole numbers."""
import datetime
import fractions
import json
import math
import os
import shutil
import subprocess

from grade_parts.kit import BESIDE, ENTRY, judged, put
from grade_parts.results import words_of
from lib.rim.command import CommandFailure, shown

WORDS = "Judges the student's checkout, the current folder, and writes result.json and release-body.md there."
FROM_ENVIRONMENT = {
    "classroom": "CLASSROOM", "assignment": "ASSIGNMENT", "submission": "SUBMISSION_TAG",
    "commit": "COMMIT_URL", "release": "RELEASE_URL"}
MOST_PARTS = 10_000  # of a point; if more are needed, points are rounded down, but a test has at least one
RESULTS = ("result.json", "release-body.md")


def files(settings):
    """{name: (bytes, whether it is a program)} beside the judge."""
    run = ENTRY.format(words=WORDS, place=BESIDE, kind="classroom50", name="autograder.py")
    apt = ["bubblewrap", *settings.program.packages] if settings.program else []
    runtime = json.dumps({"runs-on": "ubuntu-latest", **({"apt": apt} if apt else {})}, indent=2) + "\n"
    return {"autograder.py": (run.encode(), True), "runtime.json": (runtime.encode(), False)}


def parts_of_a_point(tests):
    """The smallest factor that makes every possible value of a file a whole number."""
    shares = [
        test.share(kind) * worth for test in tests for kind in test.kinds
        for worth in (1, test.settings.another_rule)] + [test.max_score for test in tests]
    parts = math.lcm(*(fractions.Fraction(share).limit_denominator(1000).denominator for share in shares))
    return min(parts, MOST_PARTS)


def result(graded, tests, environment, now):
    """The object of result.json, classroom50/result/v1."""
    parts = parts_of_a_point(tests)

    def whole(points, test):
        return math.floor(points * parts + 1e-6) or int(points > 0 and points == test.max_score)

    scores = {test.name: (test.score, words_of(test)) for test in graded.tests}
    rows = [{
        "test-name": shown(test.name), "passed": whole(
            score, test) == whole(test.max_score, test), "score": whole(score, test), "max-score": whole(
                test.max_score, test), "output": words} for test in tests
            for score, words in [scores.get(test.name, (0.0, graded.failure))]]
    missing = [name for name in FROM_ENVIRONMENT.values() if not environment.get(name)]
    if missing:
        raise CommandFailure(f"expected {', '.join(missing)} in the environment, as Classroom 50 sets them")
    identity = {field: environment[name] for field, name in FROM_ENVIRONMENT.items()}
    return {
        "schema": "classroom50/result/v1", **identity, "review": environment.get("REVIEW_URL")
        or identity["commit"], "datetime": now.strftime("%Y-%m-%dT%H:%M:%SZ"), "score": sum(
            row["score"] for row in rows), "max-score": sum(row["max-score"] for row in rows), "tests": rows}


def body(graded, made):
    """release-body.md: what the student reads. Nothing in it is Markdown but the headings."""
    lines = [f"# {made['score']} of {made['max-score']} points", ""]
    for remark in graded.remarks:
        lines += ["    " + line for line in remark.splitlines()] + [""]
    for row in made["tests"]:
        lines += [f"## {row['test-name']}: {row['score']} of {row['max-score']}", ""]
        lines += ["    " + line for line in row["output"].splitlines()] + [""]
    return "\n".join(lines)


def allow_sandbox():
    """Ubuntu forbids users the namespaces of a sandbox unless root allows them; its runners may ask root."""
    if os.geteuid() and shutil.which("bwrap") and shutil.which("sudo"):
        subprocess.run(["sudo", "-n", "sysctl", "-q", "-w", "kernel.apparmor_restrict_unprivileged_userns=0"],
                       stdin=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def main():
    allow_sandbox()
    # A hand-in may bring results, which no failure may leave in place; rm removes folders of any depth.
    if left := subprocess.run(["rm", "-rf", "--", *RESULTS], capture_output=True, text=True).stderr:
        raise CommandFailure(left.splitlines()[0])
    graded, tests, _ = judged(os.getcwd())
    made = result(graded, tests, os.environ, datetime.datetime.now(datetime.timezone.utc))
    texts = (json.dumps(made, indent=2, ensure_ascii=True) + "\n", body(graded, made))
    for name, text in zip(RESULTS, texts):
        put(os.getcwd(), name, text.encode())
