"""The student's program of the conformance pack: the stage texts that it writes for a scene, with a mistake of mistakes.txt.

A test that imports this takes the program's path behind the folder of the binaries.
"""
import pathlib
import subprocess
import sys
import tempfile

STUDENT = pathlib.Path(sys.argv.pop(1)).resolve()


def texts(scene, mistake="", in_memory=True):
    """The three stage texts; each stage goes on with the numbers of the one before, or reads its text."""
    switches = (["--mistake", mistake] if mistake else []) + (["--habit", "all/exact-in-memory"] if in_memory else [])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.txt").write_text(scene)
        (folder / "config.txt").write_text("1 1\n")
        subprocess.run([STUDENT, "all", folder / "scene.txt", folder / "config.txt", "--folder", folder, *switches], check=True)
        return [(folder / f"stage{number}.txt").read_text() for number in (1, 2, 3)]
