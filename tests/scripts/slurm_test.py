#!/usr/bin/env python3
"""samples/slurm on a real Slurm of four nodes: the picture is that of one pipe, though a node and a tool
are killed in mid-run.

usage: slurm_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import shutil
import subprocess
import unittest

from random_scene import scene_of_parts
from slurm_cluster import Cluster
from toolbox import SOURCE, ToolTest, pipe, tools_with

SCRIPTS = SOURCE / "samples/slurm"
ENDED = ("COMPLETED", "FAILED", "CANCELLED", "NODE_FAIL", "TIMEOUT", "OUT_OF_MEMORY")


class Syntax(ToolTest):
    def test_shellcheck_finds_nothing(self):
        if not shutil.which("shellcheck"):
            self.skipTest("shellcheck is missing")
        done = subprocess.run(["shellcheck", SCRIPTS / "submit", SCRIPTS / "task"], capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))

    def test_a_wrong_command_line(self):
        done = subprocess.run([SCRIPTS / "submit", "scene.txt"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout, done.stderr),
                         (2, "", "usage: submit SCENE CONFIG PARTS FOLDER OUTPUT\n"))


class OnSlurm(ToolTest):
    def setUp(self):
        super().setUp()
        self.cluster = Cluster(self, ("n1", "n2", "n3", "n4"))
        pathlib.Path("config.txt").write_text("50 40\n")

    def prepare(self, script, is_lit, project="", zbuf=""):
        """Draws the picture of one pipe, and takes tools of which view first runs a script; $n is the number
        of the part, $SLURM_RESTART_COUNT is empty at first."""
        pathlib.Path("scene.txt").write_text(scene_of_parts(is_lit))
        pipe(["model", "scene.txt"], ["view"], ["project", *project.split()],
             ["zbuf", "config.txt", *zbuf.split(), "--z-buffer", "none", "-o", "one.ppm"], stdin="")
        script = f'here={pathlib.Path.cwd()} n=$SLURM_ARRAY_TASK_ID\n{script}\nexec $real "$@"'
        folder = tools_with("view", script)
        self.environment = {
            **self.cluster.environment, "PROJECT": project, "ZBUF": zbuf,
            "PATH": f"{folder}:{self.cluster.environment['PATH']}"}

    def submit(self, parts):
        """The number of the job that draws the picture."""
        words = ["scene.txt", "config.txt", str(parts), "work", "picture.ppm"]
        done = subprocess.run([SCRIPTS / "submit", *words], env=self.environment, capture_output=True,
                              text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return int(done.stdout)

    def end_of(self, job):
        """Its state at its end."""
        return self.cluster.wait(
            lambda: (state := self.cluster.job(JobId=job).get("JobState")) in ENDED and state,
            f"the end of job {job}")

    def job_of_part(self, number, **words):
        return self.cluster.job(JobName="draw", ArrayTaskId=number, **words)

    def assert_as_one_pipe(self, job):
        self.assertEqual(self.end_of(job), "COMPLETED")
        self.assertTrue(
            pathlib.Path("picture.ppm").read_bytes() == pathlib.Path("one.ppm").read_bytes(),
            "the pictures differ")

    def test_a_node_dies(self):
        """Slurm starts its jobs on another node."""
        self.prepare('touch "$here/begun-$n"; while [ ! -e "$here/go" ]; do sleep 0.1; done', True,
                     "--clip frustum", "--coverage center --samples 2")
        picture = self.submit(5)
        killed = self.cluster.wait(
            lambda: pathlib.Path("begun-1").exists() and self.job_of_part(1, JobState="RUNNING"),
            "part 1 to run")
        self.cluster.kill_node(killed["BatchHost"])
        self.assertFalse(pathlib.Path("work/seen/1.txt").exists())
        pathlib.Path("go").touch()
        self.assert_as_one_pipe(picture)
        again = self.job_of_part(1)
        self.assertEqual((again["JobState"], again["Restarts"]), ("COMPLETED", "1"))
        self.assertNotEqual(again["BatchHost"], killed["BatchHost"])
        self.assertRegex(
            pathlib.Path("slurmctld.log").read_text(),
            rf"requeue job \S*{killed['JobId']}.* due to failure of node {killed['BatchHost']}")

    def test_a_tool_fails_or_is_killed(self):
        """The job starts itself again; one that fails for good ends what waits for it, and the same command
        does what is left."""
        self.prepare(
            '[ "$n" != 2 ] || [ -n "$SLURM_RESTART_COUNT" ] || kill -9 $$\n'
            '[ "$n" != 3 ] || [ -e "$here/mended" ] || exit 9', False)
        self.assertEqual(self.end_of(self.submit(4)), "CANCELLED")
        ends = [(job["JobState"], job["Restarts"]) for job in map(self.job_of_part, (1, 2, 3, 4))]
        self.assertEqual(ends, [("COMPLETED", "0"), ("COMPLETED", "1"), ("FAILED", "2"), ("COMPLETED", "0")])
        log = next(pathlib.Path("work/log").glob("draw-*-3.txt")).read_text()
        self.assertEqual((log.count("once more\n"), log.count("failed 2 times before: giving up\n")), (2, 1))
        self.assertFalse(pathlib.Path("picture.ppm").exists())
        before = {path: path.stat().st_mtime_ns for path in pathlib.Path("work/seen").iterdir()}
        self.assertEqual({path.name for path in before}, {"1.txt", "2.txt", "4.txt"})
        pathlib.Path("mended").touch()
        self.assert_as_one_pipe(self.submit(4))
        self.assertEqual({path: path.stat().st_mtime_ns for path in before}, before)


if __name__ == "__main__":
    unittest.main()
