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
from toolbox import BIN, SOURCE, ToolTest, pipe

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
    NODES = ("n1", "n2", "n3", "n4")

    def setUp(self):
        super().setUp()
        self.cluster = Cluster(self, self.NODES)
        pathlib.Path("config.txt").write_text("50 40\n")

    def use_tools(self, script):
        """Tools of which view first runs a script; $n is the number of the part, $SLURM_RESTART_COUNT is
        empty at first."""
        self.folder = pathlib.Path("tools").absolute()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir()
        for name in ("model", "project", "zbuf", "cut-scene", "join-seen"):
            (self.folder / name).symlink_to(BIN / name)
        (self.folder / "view").write_text(
            f'#!/bin/sh\nhere={pathlib.Path.cwd()} n=$SLURM_ARRAY_TASK_ID\n{script}\nexec {BIN}/view "$@"\n')
        (self.folder / "view").chmod(0o755)

    def expect(self, is_lit, project=(), zbuf=()):
        pathlib.Path("scene.txt").write_text(scene_of_parts(is_lit))
        pipe(["model"], ["view"], ["project", *project],
             ["zbuf", "config.txt", *zbuf, "--z-buffer", "none", "-o", "one.ppm"],
             stdin=pathlib.Path("scene.txt").read_bytes())
        self.options = {"PROJECT": " ".join(project), "ZBUF": " ".join(zbuf)}

    def submit(self, parts):
        """The number of the job that draws the picture."""
        environment = {
            **self.cluster.environment,
            **self.options, "PATH": f"{self.folder}:{self.cluster.environment['PATH']}"}
        done = subprocess.run(
            [SCRIPTS / "submit", "scene.txt", "config.txt",
             str(parts), "work", "picture.ppm"], env=environment, capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return int(done.stdout)

    def end_of(self, job):
        return self.cluster.wait(
            lambda: (state := self.cluster.state(job)).get("JobState") in ENDED and state["JobState"],
            f"the end of job {job}")

    def job_of_part(self, number):
        """Slurm's record of the newest job that draws a part."""
        lines = [
            dict(word.split("=", 1) for word in line.split() if "=" in word)
            for line in subprocess.run(["scontrol", "show", "job", "-o"], env=self.cluster.environment,
                                       capture_output=True, text=True).stdout.splitlines()]
        found = [
            job for job in lines if job.get("JobName") == "draw" and job.get("ArrayTaskId") == str(number)]
        return max(found, key=lambda job: int(job["JobId"]), default={})

    def begun(self, number):
        """Slurm's record of the job that draws a part, as soon as its view runs."""
        self.cluster.wait(pathlib.Path(f"begun-{number}").exists, f"part {number} to begin")
        job = self.cluster.wait(
            lambda: (found := self.job_of_part(number)).get("JobState") == "RUNNING" and found,
            f"part {number} to run")
        self.assertFalse(pathlib.Path(f"work/seen/{number}.txt").exists(), "it is no longer in mid-run")
        return job

    def assert_as_one_pipe(self, job):
        self.assertEqual(self.end_of(job), "COMPLETED")
        self.assertTrue(
            pathlib.Path("picture.ppm").read_bytes() == pathlib.Path("one.ppm").read_bytes(),
            "the pictures differ")
        pathlib.Path("picture.ppm").unlink()
        shutil.rmtree("work")
        for path in pathlib.Path.cwd().glob("begun-*"):
            path.unlink()
        pathlib.Path("go").unlink(missing_ok=True)

    HOLD = 'touch "$here/begun-$n"; while [ ! -e "$here/go" ]; do sleep 0.1; done'

    def test_a_node_dies(self):
        """Slurm starts its jobs on another node."""
        self.use_tools(self.HOLD)
        self.expect(True, ["--clip", "frustum"], ["--coverage", "center", "--samples", "2"])
        picture = self.submit(5)
        killed = self.begun(1)
        self.cluster.kill_node(killed["BatchHost"])
        self.assertFalse(pathlib.Path("work/seen/1.txt").exists())
        pathlib.Path("go").touch()
        self.assertEqual(self.end_of(picture), "COMPLETED")
        again = self.cluster.state(killed["JobId"])
        self.assertEqual((again["JobState"], again["Restarts"]), ("COMPLETED", "1"))
        self.assertNotEqual(again["BatchHost"], killed["BatchHost"])
        self.assertRegex(
            pathlib.Path("slurmctld.log").read_text(),
            rf"requeue job \S*{killed['JobId']}.* due to failure of node {killed['BatchHost']}")
        self.assert_as_one_pipe(picture)

    def test_a_tool_fails_or_is_killed(self):
        """The job starts itself again; one that fails for good ends what waits for it, and the same command
        does what is left."""
        self.use_tools('[ "$n" != 2 ] || [ -n "$SLURM_RESTART_COUNT" ] || kill -9 $$\n'
                       '[ "$n" != 3 ] || [ -e "$here/mended" ] || exit 9')
        self.expect(False)
        picture = self.submit(4)
        self.assertEqual(self.end_of(picture), "CANCELLED")
        self.assertEqual([self.job_of_part(n)["JobState"] for n in (1, 2, 3, 4)],
                         ["COMPLETED", "COMPLETED", "FAILED", "COMPLETED"])
        self.assertEqual([self.job_of_part(n)["Restarts"] for n in (1, 2, 3, 4)], ["0", "1", "2", "0"])
        log = next(pathlib.Path("work/log").glob("draw-*-3.txt")).read_text()
        self.assertEqual((log.count("once more\n"), log.count("failed 2 times before: giving up\n")), (2, 1))
        self.assertFalse(pathlib.Path("picture.ppm").exists())
        before = {path.name: path.stat().st_mtime_ns for path in pathlib.Path("work/seen").iterdir()}
        self.assertEqual(set(before), {"1.txt", "2.txt", "4.txt"})
        pathlib.Path("mended").touch()
        picture = self.submit(4)
        self.assertEqual(self.end_of(picture), "COMPLETED")
        self.assertEqual({name: pathlib.Path("work/seen", name).stat().st_mtime_ns
                          for name in before}, before)
        self.assert_as_one_pipe(picture)


if __name__ == "__main__":
    unittest.main()
