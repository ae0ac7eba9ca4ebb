#!/usr/bin/env python3
"""What the specification refuses is refused at its line, by the reference and by the tools.

usage: refusals_test.py BIN_DIR
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

import reference

BIN = pathlib.Path(sys.argv.pop()).resolve()
CAMERA = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\n"  # the commands of a scene begin on line 5
TRIANGLE = "triangle\n0 0 0\n1 0 0\n0 1 0\n"
VERTICES = "0 0 -2\n1 0 -2\n0 1 -2\n"
HEADER = "eye 0 0 5\nlook 0 0 0\nup 0 1 0\n"
PERSPECTIVE = "perspective 60 1 1 100\n"

SCENES = [  # paragraphs, line, text
    ("S1", 1, "0" * 1100000), ("S2", 1, "0\x000 5\n"), ("S2", 1, "0\x0b0 5\n"), ("S3", 1, "0 nan 5\n"),
    ("S3", 1, "0 0 -inf\n"), ("S3", 1, "0x10 0 5\n"), ("S3", 1, "1,5 0 5\n"), ("S3", 1, "1.5abc 0 5\n"),
    ("S3", 1, "0 0 1e309\n"), ("S3", 1, "0 0 .\n"), ("S3", 1, "0 0 1e\n"), ("S3", 1, "0 0 +-1\n"),
    ("S3", 1, "0 0 1e9223372036854775807\n"), ("S5", 1, ""), ("S5", 4, "0 0 5\n\n0 0 0\n"),
    ("S6", 1, "0 0\n5\n"), ("S6", 1, "0 0 5 1\n"), ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n0 1 1 100\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n180 1 1 100\n"), ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n60 0 1 100\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n60 1 0 100\n"), ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n60 1 2 2\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\n60 1 2\n"), ("S7", 4, "0 0 5\n0 0 0\n0 1 0\nfrustum -1 1 -1 1 -1 9\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\northo 1 1 -1 1 -1 9\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\northo -1 1 1 1 -1 9\n"),
    ("S7", 4, "0 0 5\n0 0 0\n0 1 0\northo -1 1 -1 1 1\n"),
    ("S8", 4, "0 0 5\n0 0 0\n0 1 0\n60 1 1 100 square\n"),
    ("S8", 4, "0 0 5\n0 0 0\n0 1 0\northo -1 1 -1 1 1 9 ratio\n"),
    ("S9", 3, "0 0 5\n0 0 0\n0 0 0\n60 1 1 100\n"), ("S9", 3, "0 0 5\n0 0 0\n0 0 -3\n60 1 1 100\n"),
    ("S9", 2, "1 2 3\n1 2 3\n0 1 0\n60 1 1 100\n"), ("S9", 4, "1 2 3\n1 2 3\n0 1 0\n60 1 1 1\n"),
    ("S10", 5, CAMERA + "cube 1\n"), ("S10", 5, CAMERA + "PUSH\n"),
    ("S10", 6, CAMERA + "translate\n1 2\n3\n"), ("S10", 6, CAMERA + "translate\n"),
    ("S11", 8, CAMERA + "triangle\n0 0 0\n1 0 0\nend\n"), ("S11", 9, CAMERA + TRIANGLE + "1 1 0\nend\n"),
    ("S11", 7, CAMERA + "triangle\n0 0 0\n"), ("S11", 7, CAMERA + "triangle\n0 0 0\n1 0\n0 1 0\n"),
    ("S11", 5, CAMERA + "triangle 0 0 0 1 0 0 0 1 0\n"), ("S12", 5, CAMERA + "scale 2\n"),
    ("S12", 6, CAMERA + "rotate\n90\n0 0 1\n"), ("S12", 6, CAMERA + "rotate\n90 0 0.0 -0\n"),
    ("S13", 5, CAMERA + "push 1\n"), ("S13", 7, CAMERA + "push\npop\npop\nend\n"),
    ("S14", 6, CAMERA + "push\n"), ("S14", 8, CAMERA + "end\n\n# c\n push\n"), ("S14", 5, CAMERA + "end 1\n"),
    ("S15", 9, CAMERA + TRIANGLE + "color 1 2 3\nend\n"),
    ("S15", 9, CAMERA + TRIANGLE + "light 1 2 3 1 1 1\nend\n"),
    ("S15", 6, CAMERA + "attributes color\nattributes normal\n"),
    ("S15", 6, CAMERA + "background 1 2 3\nbackground 1 2 3\n"), ("S16", 5, CAMERA + "attributes hue\n"),
    ("S16", 5, CAMERA + "attributes normal color\n"), ("S16", 5, CAMERA + "attributes w color\n"),
    ("S16", 7, CAMERA + "attributes color normal\ntriangle\n0 0 0 1 2 3\n"),
    ("S16", 7, CAMERA + "attributes normal\ntriangle\n0 0 1 0 0 0\n"), ("S17", 5, CAMERA + "color 1 2\n"),
    ("S17", 6, CAMERA + "color\n1 256 0\n"), ("S18", 5, CAMERA + "background 1 2 -1\n"),
    ("S18", 5, CAMERA + "background 1 2 3 256\n"), ("S18", 5, CAMERA + "background 1 2 3 4 5\n"),
    ("S23", 6, CAMERA + "material 1 1 0 1\nuse 1\nmaterial 1 1 0 1\n"), ("S23", 5, CAMERA + "use 0.0\n"),
    ("S23", 5, CAMERA + "use 1\n"), ("S18", 5, CAMERA + "ambient -1 0 0\n"),
    ("S19", 5, CAMERA + "material 1 1 1\n"), ("S19", 5, CAMERA + "material 1 1 1 1.5\n"),
    ("S19", 5, CAMERA + "material 1 1 1 18446744073709551616\n"), ("S19", 5, CAMERA + "material 1 -1 1 1\n"),
    ("S20", 5, CAMERA + "attenuation 0 0 0\n"), ("S20", 5, CAMERA + "attenuation 1 -1 0\n"),
    ("S21", 5, CAMERA + "light 1 2 3\n"), ("S21", 5, CAMERA + "light 1 2 3 1 1 -1\n"),
    ("N4", 9, CAMERA + "scale 1e200 1 1\nscale 1e200 1 1\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"),
    ("N4", 7, CAMERA + "scale 1 1e300 1\nlight\n0 -1e300 0 1 1 1\nend\n")]
STAGES = [  # paragraphs, line, text; refused by view, project and zbuf
    ("T1", 5, VERTICES + "\nup 0 1 0\n"), ("T1", 1, "camera 1\n"), ("T1", 5, VERTICES + "\nquad\n"),
    ("T5", 1, "attributes color w\n"), ("T6", 2, "# c\nbackground 1 2\n"),
    ("T7", 2, "background 1 2 3\nbackground 1 2 3\n"), ("T7", 2, "framed\nframed\nend\n"),
    ("T6", 1, "framed yes\n"), ("T8", 3, "0 0 -2\n1 0 -2\n\n0 1 -2\n"), ("T8", 3, "0 0 -2\n1 0 -2\n"),
    ("T8", 2, "0 0 -2\ntriangle 1\n"), ("T9", 2, "0 0 -2\n1 0\n0 1 -2\n"), ("T9", 1, "0 0 -2 1\n"),
    ("T9", 3, "0 0 -2\n1 0 -2\n0 1e999 0\n"), ("T9", 2, "attributes color\n0 0 -2 1 1\n"),
    ("T9", 2, "attributes color\n0 0 -2 1 1 256\n"), ("T10", 1, "triangle 18446744073709551616\n"),
    ("T10", 1, "triangle 1.5\n"), ("T12", 4, VERTICES + "error\n"),
    ("T12", 1, "error model: scene.txt:9:1: no #1 scene\n"), ("T13", 1, "end\n"),
    ("T13", 5, "framed\n" + VERTICES), ("T13", 2, "framed\nend"), ("T13", 3, "framed\nend\n0 0 0\n")]
OTHERS = [  # paragraphs, line, stage and options, text
    ("T3", 2, "view", HEADER.replace("look", PERSPECTIVE + "look", 1).replace(" 100", " 1")),
    ("T7", 5, "view", HEADER + PERSPECTIVE + "ortho -1 1 -1 1 1 9\n"),
    ("S9", 2, "view", "eye 0 0 5\nlook 0 0 5\n" + VERTICES), ("T2", 1, "view", "look 0 0\n" + HEADER),
    ("T14", 1, "view", "attributes w color\n" + HEADER), ("V1", 1, "view", VERTICES),
    ("V1", 4, "view", "eye 0 0 5\n# c\n\n0 0 -2\n1 0 0\n0 1 0\n"),
    ("T11", 4, "view", HEADER + "clipped\n" + VERTICES),
    ("N4", 4, "view", HEADER.replace("0 0 5", "-1e308 0 0") + "light 1.7e308 0 0 1 1 1\n"),
    ("P1", 1, "project", VERTICES), ("P1", 1, "project", ""),
    ("P2", 2, "project", "# c\nperspective 90 2 1 9\n"),
    ("T14", 2, "project", PERSPECTIVE + "attributes w\n"),
    ("P4", 3, "project --clip none", PERSPECTIVE + "0 0 -2\n1 0 0\n0 1 -2\n"),
    ("P4", 2, "project --clip reject", PERSPECTIVE + "0 0 2\n1 0 -2\n0 1 -2\n"),
    ("N4", 2, "project", "perspective 1e-9 1 1 9\n1e308 0 -1\n0 0 -1\n0 0 -1\n"),
    ("T9", 2, "zbuf", "attributes w\n0 0 0 0\n"),
    ("L1", 2, "zbuf --shading flat", "background 1 2 3\n" + VERTICES),
    ("T15", 1, "zbuf --expect-framed", VERTICES), ("T11", 3, "zbuf", "clipped\n0 0 0 1\n\n0 0 0 1\n"),
    ("T11", 8, "zbuf",
     "attributes w material\nmaterial 1 1 0 1\nmaterial 1 1 1 1\nclipped\n0 0 -2 1 1\n1 0 -2 1 1\n0 1 -2 1 "
     "1\n0 0 0 1 0\n1 0 0 1 0\n0 1 0 1 0\n"
     ), ("Z11", 2, "zbuf", "attributes color\nbackground 1 2 3 254.25\n"),
    ("T15", 2, "zbuf", "light 0 0 0 1 1 1\n" + VERTICES)]
FORGOTTEN = [  # the same, which tools of before accept
    ("T14", 1, "project", HEADER + PERSPECTIVE + VERTICES),
    ("T14", 1, "zbuf", HEADER + PERSPECTIVE + VERTICES), ("T14", 1, "zbuf", PERSPECTIVE + VERTICES),
    ("T14", 1, "view", "projected frustum -1 1 -1 1 1 9\n" + VERTICES),
    ("T14", 2, "project", "framed\nprojected ortho -1 1 -1 1 1 9\nend\n"),
    ("T4", 1, "zbuf", "projected perspective 60 1 1 9\n"),
    ("T7", 2, "zbuf", "projected ortho -1 1 -1 1 1 9\nprojected ortho -1 1 -1 1 1 9\n")]
CONFIGS = [("C1", 1, ""), ("C1", 1, "8\n8\n"), ("C1", 1, "0 8\n"), ("C1", 1, "8 65536\n"),
           ("C1", 1, "8.0 8\n"), ("C1", 1, "8 8 8\n"), ("C2", 2, "8 8\n1\n-1\n-1 1\n"),
           ("C2", 2, "8 8\n-1 -1\n-1 1\n"), ("C2", 3, "8 8\n-1\n"), ("C2", 3, "8 8\n-1\n-1e201\n-1 1\n"),
           ("C2", 4, "8 8\n-1\n-1\n1 1\n"), ("C2", 4, "8 8\n-1\n-1\n1\n"),
           ("C3", 6, "8 8\n-1\n-1\n-1 1\n\n0\n")]


class Refusals(unittest.TestCase):
    def check(self, paragraph, line, command, text, config="8 8\n"):
        stage, *words = command.split()
        with self.subTest(paragraph=paragraph, command=command, text=text[:200],
                          config=config), tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder, "config.txt")
            path.write_text(config)
            words = [str(path), "--image", str(pathlib.Path(folder, "out.bmp")), *words
                     ] if stage == "zbuf" else words
            with self.assertRaises(reference.Refused) as refused:
                getattr(reference, stage)(text.encode("latin-1"), reference.read_options(stage, [*words]))
            self.assertEqual(refused.exception.args[0], line)
            done = subprocess.run([BIN / stage, *words], input=text.encode("latin-1"), stdout=subprocess.PIPE,
                                  stderr=subprocess.PIPE)
            self.assertEqual(done.returncode, 1, done.stderr)
            if paragraph != "T12":  # one mistake is told once, by the stage that failed
                self.assertRegex(done.stderr.decode(), rf"^{stage}: (<stdin>|.*config\.txt):{line}:")
            self.assertFalse(pathlib.Path(folder, "out.bmp").exists())

    def test_scenes(self):
        for paragraph, line, text in SCENES:
            self.check(paragraph, line, "model", text)

    def test_stage_texts(self):
        for paragraph, line, text in STAGES:
            for stage in ("view --eye 0 0 0 --look 0 0 -1 --up 0 1 0", "project --ortho -1 1 -1 1 1 9",
                          "zbuf"):
                self.check(paragraph, line, stage, text)

    def test_texts_of_one_stage(self):
        for paragraph, line, command, text in OTHERS:
            self.check(paragraph, line, command, text)

    def test_texts_whose_stage_was_forgotten(self):
        for paragraph, line, command, text in FORGOTTEN:
            self.check(paragraph, line, command, text)

    def test_a_shininess_keeps_all_its_digits(self):
        scene = (CAMERA + "material 1 1 0.5 9007199254740993\nend\n").encode()
        done = subprocess.run([BIN / "model"], input=scene, stdout=subprocess.PIPE, check=True)
        self.assertIn(b"material 1 1 0.5 9007199254740993\n", done.stdout)
        self.assertEqual(done.stdout, reference.model(scene, reference.read_options("model", [])))

    def test_configs(self):
        for paragraph, line, config in CONFIGS:
            self.check(paragraph, line, "zbuf", "", config)


if __name__ == "__main__":
    unittest.main()
