"""The student's program of the conformance pack: the stage texts that it writes for a scene, with a mistake
of mistakes.txt.

A test that imports this takes the program's path after the folder of the binaries.
"""
import pathlib
import subprocess
import sys
import tempfile

STUDENT = pathlib.Path(sys.argv.pop(1)).resolve()

# Two triangles that meet, one beyond, one without area; nested pushes, and numbers that no rule can mistake
# for another's. No two mistakes do the same to it.
SCENE = """3 4 7
0.3 -0.2 0.1
0.2 1 0.1
50 1.3 1 50
push
rotate
35 1 2 3
triangle
-1 -1 -1
1 -1 -0.5
0 1.2 0.3
push
push
translate
0.5 0.25 0.75
scale
0.5 1.5 0.75
triangle
-1 0 0
1 0 0.5
0 1 -0.5
pop
rotate
-70 0 1 1
triangle
0 0 1
0.5 0.5 1
-0.5 0.5 1.2
pop
translate
-1 0 0
triangle
-0.5 -0.5 0.5
0.7 -0.6 0.4
0.1 0.8 0.2
pop
triangle
-3 -1 -3
3 -1 -3
0 -1 2
end
"""


def texts(scene, mistake="", in_memory=True):
    """The three stage texts; each stage goes on with the numbers of the one before, or reads its text."""
    switches = (["--mistake", mistake] if mistake else []) + (["--habit", "all/exact-in-memory"]
                                                              if in_memory else [])
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "scene.txt").write_text(scene)
        (folder / "config.txt").write_text("1 1\n")
        subprocess.run(
            [STUDENT, "all", folder / "scene.txt", folder / "config.txt", "--folder", folder, *switches],
            check=True)
        return [(folder / f"stage{number}.txt").read_text() for number in (1, 2, 3)]
