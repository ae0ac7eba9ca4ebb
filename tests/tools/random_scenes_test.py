#!/usr/bin/env python3
"""Random scenes come out of the four tools as reference_pipeline.py computes them.

usage: random_scenes_test.py BIN_DIR [SCENE_COUNT]
"""
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest

import reference_pipeline

scene_count = int(sys.argv.pop()) if len(sys.argv) > 2 else 60
bin_dir = pathlib.Path(sys.argv.pop()).resolve()


def random_number(rng, limit):
    """A number as text: often round, sometimes tiny or large."""
    if rng.random() < 0.1:
        return "%g" % (rng.uniform(-1, 1) * 10 ** rng.randint(-6, 4))
    return "%.*f" % (rng.choice((0, 1, 2, 6)), rng.uniform(-limit, limit))


def random_point(rng, limit=10):
    return " ".join(random_number(rng, limit) for _ in range(3))


def random_rotation(rng):
    angle = rng.choice((random_number(rng, 400), "90", "-45", "30", "180"))
    return "%s 1 %s %s" % (angle, random_number(rng, 2), random_number(rng, 2))


def random_projection(rng, aspect_rule):
    kind = rng.choice(("perspective",) * 8 + ("ortho", "frustum"))
    if kind == "perspective":
        return "%g %g %s %s%s" % (rng.uniform(5, 120), rng.uniform(0.3, 1.45), rng.choice(("0.01", "0.1", "1", "2.5")),
                                  rng.choice(("10", "100", "1e4")), aspect_rule)
    return kind + (" -3 4 -2.5 2 0.5 20" if kind == "ortho" else " -1 1.5 -0.5 1 0.7 30")


def random_scene(rng, aspect_rule):
    lines = [random_point(rng), random_point(rng), random_point(rng), random_projection(rng, aspect_rule)]
    depth = 0
    for _ in range(rng.randint(5, 40)):
        command = rng.choice(("triangle",) * 4 + ("translate", "scale", "rotate", "push", "pop"))
        if command == "pop" and depth == 0:
            continue
        depth += (command == "push") - (command == "pop")
        lines += [command] + {
            "triangle": [random_point(rng) for _ in range(3)],
            "translate": [random_point(rng)],
            "scale": [random_point(rng, 2)],
            "rotate": [random_rotation(rng)],
        }.get(command, [])
    return "\n".join(lines + ["end", ""])


def run(*command, stdin):
    return subprocess.run([bin_dir / command[0], *command[1:]], input=stdin, stdout=subprocess.PIPE, check=True).stdout


class RandomScenes(unittest.TestCase):
    def test_match_the_reference(self):
        rng = random.Random(410)
        for index in range(scene_count):
            text = random_scene(rng, ("", " ratio", " angle")[index % 3])
            with self.subTest(scene=index, text=text):
                self.compare(text)

    def compare(self, text):
        scene = reference_pipeline.Scene(text)
        in_view = reference_pipeline.view(scene)
        stage1 = run("model", "--digits", "exact", stdin=text.encode())
        stage2 = run("view", "--digits", "exact", stdin=stage1)
        stage3 = run("project", stdin=stage2)
        self.assertEqual(run("model", "--bare", stdin=text.encode()).decode(),
                         reference_pipeline.stage_text(enumerate(scene.triangles)))
        self.assert_close(run("view", "--bare", stdin=stage1).decode(),
                          reference_pipeline.stage_text(enumerate(in_view)))
        self.assert_close(stage3.decode(), reference_pipeline.stage_text(reference_pipeline.project(scene, in_view)))
        self.assert_same_picture(stage3)

    def assert_close(self, got, want):
        """Equal up to the digits of the previous stage that a double cannot carry."""
        self.assertEqual(len(got.split("\n")), len(want.split("\n")))
        for got_line, want_line in zip(got.split("\n"), want.split("\n")):
            if got_line != want_line:
                for p, q in zip(map(float, got_line.split()), map(float, want_line.split()), strict=True):
                    self.assertAlmostEqual(p, q, delta=2e-7 + 1e-10 * abs(q), msg=want_line)

    def assert_same_picture(self, stage3):
        config_text = "60 40\n-1\n-0.75\n-0.9 1\n"
        config = reference_pipeline.Config(config_text)
        depth, owners = reference_pipeline.z_buffered(stage3.decode(), config)
        with tempfile.TemporaryDirectory() as folder:
            config_file, image_file = pathlib.Path(folder, "config.txt"), pathlib.Path(folder, "out.bmp")
            config_file.write_text(config_text)
            got = run("zbuf", config_file, "--image", image_file, stdin=stage3).decode()
            self.assertEqual(got, reference_pipeline.depth_text(depth, config.rear))
            self.assertTrue(image_file.read_bytes() == reference_pipeline.bmp(reference_pipeline.colored(owners)), "the pictures differ")


if __name__ == "__main__":
    unittest.main()
