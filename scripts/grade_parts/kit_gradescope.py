"""The kit for Gradescope: a zip to upload as the autograder."""
from grade_parts.kit import ENTRY, judged, put
from grade_parts.results import gradescope

SETUP = """#!/bin/sh
# Gradescope runs this once, as root, when it builds the image of the autograder.
set -e
missing() {{ for word in "$@"; do command -v "$word" > /dev/null || return 0; done; return 1; }}
if {needs}; then
  apt-get update
  DEBIAN_FRONTEND=noninteractive apt-get install -y --no-install-recommends {packages}
fi
cd /autograder/source
chmod 755 pipeline/build/release/bin/*
chmod -R go= /autograder/source  # from programs that are handed in
"""
WORDS = "Judges /autograder/submission, and writes /autograder/results/results.json."


def files(settings):
    """{name: (bytes, whether it is a program)} beside the judge."""
    program = settings.program
    packages = ["python3", *(["bubblewrap", *program.packages] if program else [])]
    needs = "true" if program and program.packages else "missing python3" + " bwrap" * bool(program)
    run = ENTRY.format(words=WORDS, place='"/autograder/source/pipeline/scripts"', kind="gradescope",
                       name="run_autograder")
    return {
        "setup.sh": (SETUP.format(needs=needs, packages=" ".join(packages)).encode(), True),
        "run_autograder": (run.encode(), True)}


def main():
    graded, tests, _ = judged("/autograder/submission")
    put("/autograder/results", "results.json", gradescope(graded, tests))
