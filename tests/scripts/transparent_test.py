#!/usr/bin/env python3
"""A scene whose background has an alpha: the commands that draw a BMP draw it opaque, and note it; a hand-in
may be a PNG with alpha.

usage: transparent_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import csv
import pathlib
import shutil
import struct
import subprocess
import unittest
import zlib

from lib.showing.pictures import PictureError, picture_of, png_chunk
from toolbox import BIN, ToolTest, run, run_script

COLORS = {"plain": "", "lit": "light 3 4 5 1 1 1\nambient 0.2 0.2 0.2\ncolor 10 200 30\n"}
CAMERA = "3 1 6\n0 0 0\n0 1 0\n40 1.25 1 30 ratio\n"
TRIANGLES = "triangle\n-1 -1 0\n1 -1 0\n0 1 0\ntriangle\n-1 0 -1\n1 0 1\n0 0.5 -2\nend\n"
NOTE = "note: the scene's background is drawn opaque: a BMP has no alpha\n"
FIVE = ("stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt", "out.bmp")


class Transparent(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("config.txt").write_text("50 40\n")
        for name, colors in COLORS.items():
            for alpha in ("", " 0", " 127.5"):
                pathlib.Path(f"{name}{alpha.strip()}.txt").write_text(
                    f"{CAMERA}background 200 99.5 50{alpha}\n{colors}{TRIANGLES}")

    def stages(self, scene):
        done = run_script("stages", f"{scene}.txt", "config.txt", scene)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)
        return done.stderr

    def hand_in_with_alpha(self, scene):
        """The folder of the scene's five files, with a PNG that has an alpha as its picture."""
        done = run("zbuf", "config.txt", f"{scene}/stage3.txt", "--z-buffer", "none", "-o",
                   f"{scene}/out.png")
        self.assertEqual(done.returncode, 0, done.stderr)
        data = pathlib.Path(scene, "out.png").read_bytes()
        self.assertEqual(data[24:26], b"\x08\x06")  # 8 bits, RGB and alpha
        pathlib.Path(scene, "out.bmp").unlink()
        return data

    def test_stages_draws_it_opaque(self):
        for name in COLORS:
            self.assertEqual(self.stages(name), "")
            for alpha in ("0", "127.5"):
                self.assertEqual(self.stages(name + alpha), f"stages: {NOTE}")
                for file in ("z_buffer.txt", "out.bmp"):
                    self.assertEqual(
                        pathlib.Path(name + alpha, file).read_bytes(),
                        pathlib.Path(name, file).read_bytes())
                self.assertEqual(sorted(path.name for path in pathlib.Path(name + alpha).iterdir()),
                                 sorted(FIVE))

    def test_five_files_are_right(self):
        for name in COLORS:
            self.stages(name + "0")
            self.hand_in_with_alpha(name + "0")
            done = run_script("compare", "--hand-in", name + "0", f"{name}0.txt", "config.txt")
            self.assertEqual((done.returncode, done.stderr, done.stdout.count("| right ")), (0, "", 5),
                             done.stdout)

    def test_a_wrong_pixel_of_a_picture_with_alpha_is_found(self):
        self.stages("lit0")
        self.hand_in_with_alpha("lit0")
        done = run("zbuf", "config.txt", "lit0/stage3.txt", "--z-buffer", "none", "--background", "c86433ff",
                   "-o", "lit0/out.png")
        self.assertEqual(done.returncode, 0)
        done = run_script("compare", "--hand-in", "lit0", "lit0.txt", "config.txt")
        self.assertEqual((done.returncode, done.stdout.count("| right ")), (1, 4), done.stdout)

    def test_a_picture_with_alpha_that_was_cut_is_unreadable(self):
        self.stages("lit0")
        data = self.hand_in_with_alpha("lit0")
        pathlib.Path("lit0/out.png").write_bytes(data[:-60])
        done = run_script("compare", "--hand-in", "lit0", "lit0.txt", "config.txt")
        self.assertEqual((done.returncode, done.stderr), (1, ""))
        self.assertRegex(done.stdout, r"out\.png +\| unreadable")

    def test_grade_gives_the_points(self):
        for name in COLORS:
            self.stages(name + "0")
            pathlib.Path("tests", name).mkdir(parents=True)
            shutil.copy(f"{name}0.txt", f"tests/{name}/scene.txt")
            shutil.copy("config.txt", f"tests/{name}")
            shutil.copytree(name + "0", f"hand-ins/bmp/{name}")
            self.hand_in_with_alpha(name + "0")
            shutil.copytree(name + "0", f"hand-ins/png/{name}")
        done = run_script("grade", "hand-ins", "tests", "-o", "graded", "--jobs", "1")
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        with open("graded/grades.csv", newline="") as file:
            self.assertEqual({row["hand-in"]: row["score"]
                              for row in csv.DictReader(file)}, {"bmp": "2.0", "png": "2.0"})

    def test_check_stage_gives_zbuf_an_opaque_one(self):
        for name in COLORS:
            for stage, note in (("project", ""), ("zbuf", "check-stage: " + NOTE)):
                with self.subTest(scene=name, stage=stage):
                    done = run_script("check-stage", stage, "--sandbox", "no", "--scene", f"{name}127.5.txt",
                                      "--config", "config.txt", "--", BIN / stage)
                    verdict = done.stdout.partition("\n")[0]
                    more = ": only x, y and z are judged, not the numbers behind them"
                    right = f"{name}127.5.txt: right" + (more if name == "lit" and stage != "zbuf" else "")
                    self.assertEqual((done.returncode, verdict, done.stderr), (0, right, note))

    def test_trade_measures_it_opaque_and_names_a_command_that_draws(self):
        done = run_script("trade", "lit0.txt", "config.txt", "--rounds", "1")
        self.assertEqual((done.returncode, done.stderr), (0, f"trade: {NOTE}"))
        line = done.stdout.rstrip("\n").split("\n")[-1].strip()
        self.assertIn(" --background c86432 ", line)
        subprocess.run(["bash", "-c", line], check=True, env={"PATH": f"{BIN}:/usr/bin:/bin"},
                       capture_output=True)
        self.assertTrue(pathlib.Path("out.bmp").exists())


class Alpha(unittest.TestCase):
    """Pixels by hand; (PNG specification, 13.16: alpha compositing)."""
    def png(self, rows, width, cut=0):
        packed = zlib.compress(b"".join(b"\0" + row for row in rows)[:-cut or None])
        return b"\x89PNG\r\n\x1a\n" + png_chunk(
            b"IHDR", struct.pack(">IIBBBBB", width, len(rows), 8, 6, 0, 0, 0)) + png_chunk(
                b"IDAT", packed) + png_chunk(b"IEND", b"")

    def test_what_is_transparent_shows_what_is_behind(self):
        data = self.png([bytes((10, 20, 30, 255, 1, 2, 3, 0)),
                         bytes((200, 100, 0, 51, 255, 255, 255, 128))], 2)
        # A fifth of 200, 100 and 0 and four fifths of 50, 60 and 70; 128/255 of white.
        self.assertEqual(picture_of(data, "a.png", bytes((50, 60, 70))),
                         (2, 2, [bytes((10, 20, 30, 50, 60, 70)),
                                 bytes((80, 68, 56, 153, 158, 163))]))

    def test_without_anything_behind_it_is_refused(self):
        with self.assertRaisesRegex(PictureError, "found one with alpha"):
            picture_of(self.png([bytes(8)], 2), "a.png")

    def test_missing_bytes_are_told(self):
        with self.assertRaisesRegex(PictureError, "a.png: expected 17 bytes of 2 x 2 pixels, found 16"):
            picture_of(self.png([bytes(8), bytes(8)], 2, cut=1), "a.png", bytes(3))


if __name__ == "__main__":
    unittest.main()
