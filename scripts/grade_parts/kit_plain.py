"""The plain kit, for every other system: one program that judges one hand-in."""
import os
import sys

from grade_parts.kit import BESIDE, ENTRY, judged, put
from grade_parts.page import page
from grade_parts.results import gradescope
from lib.rim.command import CommandFailure
from lib.rim.output_file import make_folders

CONTRACT = """# A judge for one assignment

    ./judge HANDIN OUT

HANDIN is what one student has handed in: a folder, or a .zip, .tar or .tar.gz. OUT is a folder, which is
made if it is not there. Two files are written into it:

- `results.json`: `score`; `output`, about the whole; and `tests`, a list of objects with `name`, `score`,
  `max_score` and `output`. It is the form of Gradescope's autograder.
- `page.html`: the same to read or to print, with pictures; it loads nothing.

Exit status: 0 judged, whatever the points; 1 the hand-in, or a file of it, could not be judged, and
`results.json` says why; 2 the judge could not run, and nothing is written.

It needs Python 3.9 or newer and the system that the tools in `pipeline/build/release/bin` were built for; no
network, and nothing outside of this folder.
{program}"""
PROGRAM = """
What is handed in is a program for the stage {stage}. It is built and run in a sandbox of bubblewrap; where
that does not work, root runs it as a user of its own (61184 to 65519), who may read nothing that is closed to
others: then close this folder and all hand-ins (`chmod -R go=`), and start the judge without a network; a
new OUT is closed. With neither, it is not run, and the exit status is 2.
"""
PACKAGES = """
It needs these packages of Debian: {packages}.
"""


def files(settings):
    """{name: (bytes, whether it is a program)} beside the judge."""
    program = settings.program
    more = PROGRAM.format(stage=program.stage) if program else ""
    if program and program.packages:
        more += PACKAGES.format(packages=", ".join(program.packages))
    run = ENTRY.format(words="Judges one hand-in; CONTRACT.md says how.", place=BESIDE, kind="plain",
                       name="judge")
    return {"CONTRACT.md": (CONTRACT.format(program=more).encode(), False), "judge": (run.encode(), True)}


def main():
    if len(sys.argv) != 3:
        raise CommandFailure("expected HANDIN and OUT (see CONTRACT.md)")
    hand_in, out = sys.argv[1:]
    if not os.path.exists(hand_in):
        raise CommandFailure(f"there is no {hand_in}")
    graded, tests, hints = judged(hand_in)
    make_folders(out)
    put(out, "page.html", page("hand-in", graded, hints).encode())
    put(out, "results.json", gradescope(graded, tests))
    return 0 if graded.is_judged else 1
