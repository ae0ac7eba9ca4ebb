#!/usr/bin/env python3
"""Two at least of the six scenes that grade uses by itself show every listed mistake. shows.txt, the table of
which scene shows which, is what the judge finds in the files of the student's program; --write writes it.

usage: assignment_test.py STUDENT BIN_DIR SOURCE_DIR [--write]
"""
import os
import pathlib
import subprocess
import sys
import tempfile

STUDENT, BIN, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
os.environ |= {"BIN": str(BIN), "STUDENT_SEED": "1"}
from lib.judging.hand_in import find_files  # noqa: E402
from lib.judging.judge import judge  # noqa: E402
from lib.judging.mistakes import sentences  # noqa: E402

PLACE = SOURCE / "tests/conformance/assignment"
TABLE = PLACE / "shows.txt"
HEAD = """\
# Which of the scenes here show a mistake of ../mistakes.txt: the judge calls the files of a program with that
# mistake wrong. Written by assignment_test.py, which fails where a mistake shows in fewer
# than two.

"""


def scenes():
    return sorted(path.parent for path in PLACE.glob("*/scene.txt"))


def is_good(scene, *switches):
    """Whether all files of the student's program for a scene are right."""
    with tempfile.TemporaryDirectory() as folder:
        words = [STUDENT, "all", scene / "scene.txt", scene / "config.txt", "--folder", folder, *switches]
        subprocess.run(words, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # may stop: w is 0
        files = find_files(folder)
        return all(
            file.is_good
            for file in judge(files, (scene / "scene.txt").read_bytes(), (scene /
                                                                          "config.txt").read_bytes()).files)


def table():
    lines = []
    for name in sentences():
        shown = [scene.name for scene in scenes() if not is_good(scene, "--mistake", name)]
        lines.append(f"{name}: {' '.join(shown)}".rstrip())
    return HEAD + "\n".join(lines) + "\n"


def main():
    assert len(scenes()) == 6
    for scene in scenes():
        assert is_good(scene), f"{scene.name}: the program without a mistake is accused"
    found = table()
    if sys.argv[4:] == ["--write"]:
        TABLE.write_text(found)
    unseen = [line for line in found.splitlines() if "/" in line and len(line.split()) < 3 and line[0] != "#"]
    assert not unseen, f"fewer than two scenes show {unseen}"
    assert found == TABLE.read_text(), f"{TABLE.name} is not what the judge finds: write it again (--write)"


if __name__ == "__main__":
    main()
