#!/usr/bin/env python3
"""scripts/compare on inputs that are pipes, empty, of another kind, endless or false: the status tells
whether it compared.

usage: compare_input_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import resource
import struct
import subprocess
import unittest
import zlib

from toolbox import BIN, SOURCE, ToolTest

COMPARE = SOURCE / "scripts/compare"
ENVIRONMENT = {"BIN": str(BIN), "PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
TRIANGLE = "0.1 0.2 0.3\n1 0 0.5\n0 1 0.7\n\n"
OTHER = "0.1 0.2 0.3\n1 0 0.5\n0 1 0.25\n\n"
SCENE = "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\ntriangle\n0 0 0\n1 0 0\n0 1 0\nend\n"
MEMORY = 3 << 30  # limit of memory, whatever a false header claims
SECONDS = 60


def limit_memory():
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))


def compare(*words, **settings):
    return subprocess.run([COMPARE, *words], capture_output=True, timeout=SECONDS, env=ENVIRONMENT,
                          preexec_fn=limit_memory, **settings)


def shell(line):
    return subprocess.run(["bash", "-c", line], capture_output=True, timeout=SECONDS,
                          env={**ENVIRONMENT, "COMPARE": str(COMPARE)})


def write(name, content):
    pathlib.Path(os.fsdecode(name)).write_bytes(content.encode() if isinstance(content, str) else content)


def hand_in(scene, config, folder):
    subprocess.run([SOURCE / "scripts/stages", "--", scene, config, folder], check=True, env=ENVIRONMENT,
                   stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def bmp_header(width, height, bits=24, offset=54, header_size=40, compression=0):
    return struct.pack("<2sIHHIIiiHHIIiiII", b"BM", 54, 0, 0, offset, header_size, width, height, 1, bits,
                       compression, 0, 0, 0, 0, 0)


def png_file(width, height, pixels, colors=2):
    def chunk(kind, body):
        return struct.pack(">I", len(body)) + kind + body + struct.pack(">I", zlib.crc32(kind + body))

    header = chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, colors, 0, 0, 0))
    return b"\x89PNG\r\n\x1a\n" + header + chunk(b"IDAT", pixels) + chunk(b"IEND", b"")


class InputTest(ToolTest):
    def assert_differs(self, done, first):
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 1))
        self.assertIn(f"| first difference    | {first} ", done.stdout.decode())

    def assert_same(self, done):
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))

    def assert_not_compared(self, done, message):
        self.assertEqual((done.stderr.decode(), done.stdout.decode(), done.returncode),
                         (f"compare: {message}\n", "", 2))


class TwoFiles(InputTest):
    def setUp(self):
        super().setUp()
        write("a", OTHER)
        write("b", TRIANGLE)


class Pipes(TwoFiles):
    PLACE = "line 3, z of vertex 3 of triangle 0: 0.25 in A, 0.7 in B"

    def test_each_may_be_a_pipe_and_a_dash_is_standard_input(self):
        self.assert_same(shell('"$COMPARE" <(cat a) <(cat a)'))
        for line in ('"$COMPARE" <(cat a) <(cat b)', '"$COMPARE" <(cat a) b', '"$COMPARE" - b < a',
                     'cat a | "$COMPARE" - b', 'cat b | "$COMPARE" a -'):
            with self.subTest(line):
                self.assert_differs(shell(line), self.PLACE)

    def test_one_of_two_is_standard_input_at_most(self):
        done = compare("-", "-")
        self.assertEqual(done.returncode, 2)
        self.assertIn("compare: expected - at most once", done.stderr.decode())

    def test_one_pipe_is_not_two_files(self):
        self.assert_not_compared(shell('cat a | "$COMPARE" - /dev/stdin'),
                                 "expected two files, found that <stdin> and /dev/stdin are the same pipe")

    def test_pictures_come_through_pipes(self):
        write("x.ppm", b"P6 1 1 255\n\1\2\3")
        write("y.ppm", b"P6 1 1 255\n\1\2\4")
        self.assert_same(shell('"$COMPARE" <(cat x.ppm) <(cat x.ppm)'))
        self.assertEqual(shell('"$COMPARE" <(cat x.ppm) <(cat y.ppm)').returncode, 1)

    def test_scenes_for_hints_and_for_five_come_through_pipes(self):
        write("scene", SCENE)
        write("config", "8 8\n")
        hand_in("scene", "config", "theirs")
        done = shell('"$COMPARE" --hand-in theirs <(cat scene) <(cat config)')
        self.assertEqual((done.stderr.decode(), done.returncode), ("", 0))
        self.assertIn("all five files are right", done.stdout.decode())
        self.assertEqual(shell('"$COMPARE" --hand-in theirs - config < scene').returncode, 0)
        self.assert_differs(shell('"$COMPARE" a b --scene <(cat scene)'), self.PLACE)


class Nothing(InputTest):
    NOTHING = "nothing to compare: there is no number in either text"

    def test_two_texts_without_numbers_are_not_compared(self):
        for a, b in (("", ""), ("\n\n", "\n"), ("# a\n", "# b\n"), ("eye 0 0 1\n", "eye 0 0 1\n"),
                     ("", "# b\n"), ("\t\n", "\t\n")):
            with self.subTest(a=a, b=b):
                write("a", a)
                write("b", b)
                self.assert_not_compared(compare("a", "b"), self.NOTHING)
        self.assert_not_compared(compare("/dev/null", "/dev/null"), self.NOTHING)

    def test_an_empty_text_differs_from_one_that_is_not(self):
        write("empty", "")
        write("stage", TRIANGLE)
        write("depths", "\n0.5\t\n")
        for words, told in ((("empty", "stage"), "0 and 1 triangles"), (("depths", "empty"), "2 and 0 rows")):
            done = compare(*words)
            self.assertEqual((done.stderr, done.returncode), (b"", 1))
            self.assertIn(told, done.stdout.decode())

    def test_an_image_is_not_compared_with_nothing(self):
        write("x", b"P6 1 1 255\n\1\2\3")
        self.assert_not_compared(compare("x", "/dev/null"),
                                 "expected two files of a kind, found an image and an empty text")

    def test_numbers_that_are_none_are_not_taken_for_the_same(self):
        write("b", "0.5\t\n")
        for word in ("nan", "inf", "-inf", "1_0"):
            write("a", word + "\t\n")
            self.assert_not_compared(compare("a", "b"), f"a:1: expected depths, found '{word}'")
        write("a", "infinity 1 2\n" + TRIANGLE)
        write("b", TRIANGLE)
        self.assert_not_compared(compare("a", "b"), "a:1: expected numbers, found 'infinity 1 2'")

    def test_a_tolerance_is_a_number(self):
        write("a", OTHER)
        write("b", TRIANGLE)
        for word in ("nan", "inf", "-1", "x"):
            done = compare("a", "b", f"--tolerance={word}")
            self.assertEqual(done.returncode, 2)
            self.assertIn(f"argument --tolerance: expected a number of at least 0, found '{word}'",
                          done.stderr.decode())


class OtherTexts(InputTest):
    def test_a_scene_is_called_one(self):
        write("stage", TRIANGLE)
        scenes = (SCENE, SCENE.replace(
            "\n",
            "\r\n"), "0 0 5\n0 0 0\n0 1 0\n60 1 1 100\nend\n", "0 0 5\n0 0 0\n0 1 0\n60 1 1 100 ratio\nend\n",
                  "0 0 5\n0 0 0\n0 1 0\northo -1 1 -1 1 1 9\ntriangle 0 0 0\n1 0 0\n0 1 0\nend\n",
                  SCENE.replace(" ", "\t"), SCENE.replace("end", "rotate 1 0 0 1\nend"))
        for scene in scenes:
            with self.subTest(scene):
                write("s", scene)
                self.assert_not_compared(compare("s", "stage"),
                                         "s: this is a scene, not a stage text: run model on it")
                self.assert_not_compared(compare("stage", "s"),
                                         "s: this is a scene, not a stage text: run model on it")

    def test_texts_that_are_refused(self):
        utf_16 = [(TRIANGLE.encode(encoding), ": this is UTF-16: save it as UTF-8")
                  for encoding in ("utf-16", "utf-16-le", "utf-16-be")]
        write("b", TRIANGLE)
        for text, message in (*utf_16, (TRIANGLE + "error model: something was wrong\n",
                                        ":5: model: something was wrong"),
                              ("triangle x\n" + TRIANGLE, ":1: expected a triangle's number, found 'x'"),
                              (b"1 2 gr\xfcn\n", ":1: expected numbers, found '1 2 gr\\xfcn'"), (bytes(
                                  range(256)), ": this is neither a text nor a BMP, PPM or PNG")):
            with self.subTest(message):
                write("a", text)
                self.assert_not_compared(compare("a", "b"), f"a{message}")

    def test_texts_that_are_the_same(self):
        write("b", TRIANGLE)
        for before in (b"triangle 7\n", b"\xef\xbb\xbf", b"# mine\tand only mine\n"):
            write("a", before + TRIANGLE.encode())
            self.assert_same(compare("a", "b"))

    def test_latin_1_may_stand_in_comments(self):
        write("a", b"# gr\xfcn\n" + TRIANGLE.encode())
        write("b", b"# gr\xfcn\n" + TRIANGLE.encode())
        for language in ("C.UTF-8", "C"):
            self.assert_same(
                subprocess.run([COMPARE, "a", "b"], capture_output=True,
                               env={**ENVIRONMENT, "LANG": language}))

    def test_huge_numbers_bring_no_hint_down(self):
        write("a", "1e200 -1e300 1e250\n1e200 1e308 -1e308\n-1e308 1e308 1\n")
        write("b", "-1e200 1e300 1e250\n1e200 -1e308 1e308\n1e308 1e308 2\n")
        done = compare("a", "b")
        self.assertEqual((done.stderr, done.returncode), (b"", 1))


class Files(InputTest):
    def setUp(self):
        super().setUp()
        write("b", TRIANGLE)

    def test_what_is_no_file_is_said(self):
        os.mkdir("folder")
        os.symlink("loop", "loop")
        for name, reason in (("folder", "Is a directory"), ("none", "No such file or directory"),
                             ("loop", "Too many levels of symbolic links")):
            self.assert_not_compared(compare(name, "b"), f"cannot read {name}: {reason}")

    def test_an_endless_file_is_given_up(self):
        self.assert_not_compared(compare("/dev/zero", "b"),
                                 "cannot read /dev/zero: it is longer than 512 MiB")
        self.assert_not_compared(shell('yes "1 2 3" | "$COMPARE" - b'),
                                 "cannot read <stdin>: it is longer than 512 MiB")

    def test_names_may_hold_anything(self):
        for name in (b"-a", b"--hand-in", b"a b", b"a\nb", b"a'\"b", b"a|b", b"a\xffb"):
            with self.subTest(name):
                write(name, TRIANGLE)
                self.assert_same(compare("--", name, "b"))
                for language in ("C.UTF-8", "C"):
                    done = subprocess.run([COMPARE, "--", b"b", name], capture_output=True,
                                          env={**ENVIRONMENT, "LANG": language})
                    self.assert_same(done)
                    self.assertEqual({line.count(b" | ")
                                      for line in done.stdout.splitlines()}, {1}, done.stdout)


SIDES = "expected at most 65535 columns and rows, found "


class Pictures(InputTest):
    def setUp(self):
        super().setUp()
        write("b", b"P6 1 1 255\n\1\2\3")

    def refused(self, content, message):
        """And in hardly any time."""
        write("a", content)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assert_not_compared(compare("a", "b"), f"a: {message}")
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 10)

    def test_a_bmp_that_lies_about_its_size(self):
        most = 65535
        for width, height in ((most, most), (most, 1), (most, -most), (1, most), (1, 1)):
            with self.subTest(width=width, height=height):
                needed = (abs(height) - 1) * ((3 * width + 3) // 4 * 4) + 3 * width
                self.refused(bmp_header(width, height),
                             f"expected {needed} bytes of {width} x {abs(height)} pixels, found 0")
        for width, height in ((0, 1), (1, 0), (-1, 1)):
            self.refused(
                bmp_header(width, height) + bytes(4),
                f"expected a width and a height of at least 1, found {width} x {height}")
        for width, height in ((2**31 - 1, 1), (1, 65536), (1, -2**31)):
            self.refused(bmp_header(width, height) + bytes(300000), SIDES + f"{width} x {abs(height)}")

    def test_a_bmp_that_lies_about_its_pixels(self):
        self.refused(
            bmp_header(1, 1, offset=0) + bytes(4),
            "expected a BMP with a header of 54 bytes or more, and the pixels behind it")
        self.refused(
            bmp_header(1, 1, header_size=12) + bytes(4),
            "expected a BMP with a header of 54 bytes or more, and the pixels behind it")
        self.refused(
            bmp_header(1, 1, offset=2**32 - 1) + bytes(4), "expected 3 bytes of 1 x 1 pixels, found 0")
        self.refused(
            bmp_header(1, 1, bits=32) + bytes(4),
            "expected a BMP of 24 bits a pixel, not compressed, found 32")

    def test_a_ppm_that_lies_about_its_size(self):
        self.refused(b"P6 65535 65535 255\n", "expected 12884508675 bytes of 65535 x 65535 pixels, found 0")
        self.refused(b"P6 999999999 999999999 255\n", SIDES + "999999999 x 999999999")
        self.refused(b"P6 1 65536 255\n" + bytes(3 * 65536), SIDES + "1 x 65536")
        self.refused(b"P6 0 1 255\n", "expected a width and a height of at least 1, found 0 x 1")
        for header in (b"P6", b"P6 1 1", b"P6 -1 1 255\n", b"P6 1_0 1 255\n",
                       b"P6 " + b"9" * 5000 + b" 1 255\n", b"P6" + b" " * 10**7, b"P6#"):
            self.refused(header, "expected width, height and the largest value behind P6")

    def test_a_png_that_lies_about_its_size(self):
        self.refused(png_file(2**31 - 1, 2**31 - 1, zlib.compress(b"\0\1\2\3")),
                     SIDES + "2147483647 x 2147483647")
        little = zlib.compress(b"\0\1\2\3")
        self.refused(png_file(65535, 513, little),
                     "expected a PNG of at most 33554432 pixels, found 65535 x 513")
        self.refused(png_file(65535, 512, little), "expected 100662271 bytes of 65535 x 512 pixels, found 3")
        self.refused(png_file(1, 2**24, zlib.compress(bytes(2**26), 9)), SIDES + "1 x 16777216")
        self.refused(png_file(0, 1, zlib.compress(b"\0\1\2\3")),
                     "expected a width and a height of at least 1, found 0 x 1")

    def test_a_png_that_unpacks_to_more_than_it_says(self):
        packer = zlib.compressobj(9)
        begin = packer.compress(b"") + packer.flush(zlib.Z_FULL_FLUSH)
        block = packer.compress(bytes(1 << 20)) + packer.flush(
            zlib.Z_FULL_FLUSH)  # may be repeated any number of times
        write("a", png_file(1, 1, begin + 4096 * block))
        done = compare("a", "b")
        self.assertEqual((done.stderr, done.returncode), (b"", 1))  # a single pixel, which differs

    def test_cut_pictures(self):
        whole = png_file(2, 2, zlib.compress(b"\0\1\2\3\4\5\6" * 2))
        for size in range(2, len(whole) - 20, 9):
            write("a", whole[:size])
            done = compare("a", "b")
            self.assertEqual(done.returncode, 2)
            self.assertRegex(done.stderr.decode(), r"\Acompare: a: .*\n\Z")
        self.refused(bmp_header(2, 2) + bytes(13), "expected 14 bytes of 2 x 2 pixels, found 13")
        self.refused(b"P6 2 2 255\n" + bytes(11), "expected 12 bytes of 2 x 2 pixels, found 11")

    def test_the_filters_of_png(self):
        """Rows filtered here by the definitions of the PNG specification, section 9."""
        def paeth(a, b, c):
            return min((a, b, c), key=lambda x: abs(a + b - c - x))

        guesses = (lambda a, b, c: 0, lambda a, b, c: a, lambda a, b, c: b, lambda a, b, c:
                   (a + b) // 2, paeth)
        rows = [bytes((37 * i * i + 91 * y + i * y) % 256 for i in range(21)) for y in range(10)]
        data, above = b"", bytes(21)
        for y, row in enumerate(rows):
            kind = y % 5
            data += bytes([kind]) + bytes(
                (x - guesses[kind](row[i - 3] if i > 2 else 0, above[i], above[i - 3] if i > 2 else 0)) & 255
                for i, x in enumerate(row))
            above = row
        write("a", png_file(7, 10, zlib.compress(data)))
        write("b", b"P6 7 10 255\n" + b"".join(rows))
        self.assert_same(compare("a", "b"))
        write("a", png_file(7, 10, zlib.compress(b"\5" + data[1:])))
        self.assert_not_compared(compare("a", "b"), "a: expected a filter from 0 to 4, found 5")


class Endings(TwoFiles):
    def test_a_reader_that_leaves_is_no_traceback(self):
        done = shell('"$COMPARE" a b | :; echo ${PIPESTATUS[0]}')
        self.assertEqual((done.stderr, done.stdout.strip()), (b"", b"141"))

    def test_a_result_that_cannot_be_written_is_said(self):
        done = shell('"$COMPARE" a a > /dev/full')
        self.assert_not_compared(done, "cannot write <stdout>: No space left on device")
        self.assert_not_compared(shell('"$COMPARE" a a >&-'), "cannot write <stdout>: Bad file descriptor")


class FiveFiles(InputTest):
    """A student's file that cannot be read gets a verdict, and so do the others."""
    def setUp(self):
        super().setUp()
        write("-scene", SCENE)
        write("-config", "8 8\n")
        hand_in("./-scene", "./-config", "./-theirs")

    def judged(self, status=1):
        done = compare("--hand-in", "--", "-theirs", "-scene", "-config")
        self.assertEqual((done.stderr.decode(), done.returncode), ("", status), done.stdout.decode())
        rows = [[cell.strip() for cell in line.split("|")[2:-1]]
                for line in done.stdout.decode().splitlines()[2:7]]
        return {row[0]: (row[1], row[-1]) for row in rows}

    def replaced(self, name, content):
        path = pathlib.Path("-theirs", name)
        kept = path.read_bytes()
        path.write_bytes(content)
        judgments = self.judged()
        path.write_bytes(kept)
        self.assertEqual([file for file, (verdict, _) in judgments.items() if verdict != "right"], [name])
        return judgments[name]

    def test_names_may_begin_with_a_dash(self):
        self.assertEqual({verdict for verdict, _ in self.judged(status=0).values()}, {"right"})

    def test_texts_that_are_none(self):
        self.assertEqual(self.replaced("stage1.txt", TRIANGLE.encode("utf-16")),
                         ("unreadable", "stage1.txt: this is UTF-16: save it as UTF-8"))
        self.assertEqual(self.replaced("stage2.txt", SCENE.encode()),
                         ("unreadable", "stage2.txt: this is a scene, not a stage text: run model on it"))
        self.assertEqual(self.replaced("z_buffer.txt", b"nan\t\n"),
                         ("unreadable", "z_buffer.txt:1: expected depths, found 'nan'"))
        self.assertEqual(self.replaced("stage3.txt", b"1 2 gr\xfcn\n"),
                         ("unreadable", "stage3.txt:1: expected numbers, found '1 2 gr\\xfcn'"))

    def test_latin_1_comments_are_none_of_its_business(self):
        path = pathlib.Path("-theirs/stage1.txt")
        path.write_bytes(b"# gr\xfcn\n" + path.read_bytes())
        self.assertEqual({verdict for verdict, _ in self.judged(status=0).values()}, {"right"})

    def test_no_folder_pipe_or_device_is_waited_for(self):
        for make, reason in ((os.mkdir, "Is a directory"), (os.mkfifo, "Not a regular file"),
                             (lambda path: os.symlink("/etc/passwd", path),
                              "a link that leads out of the hand-in")):
            for name in ("stage1.txt", "stage3.txt", "z_buffer.txt", "out.bmp"):
                with self.subTest(name, reason=reason):
                    path = os.path.join("-theirs", name)
                    os.rename(path, "kept")
                    make(path)
                    self.assertEqual(self.judged()[name], ("unreadable", reason))
                    os.rmdir(path) if os.path.isdir(path) else os.unlink(path)
                    os.rename("kept", path)

    def test_a_text_that_zbuf_refuses_is_judged_by_its_numbers(self):
        path = pathlib.Path("-theirs/stage3.txt")
        path.write_bytes(b"attributes color\n" + path.read_bytes())
        self.assertEqual(self.judged(status=0)["stage3.txt"][0], "right")

    def test_two_standard_inputs_are_one_too_many(self):
        self.assertEqual(compare("--hand-in", "--", "-theirs", "-", "-").returncode, 2)
        self.assertEqual(compare("--hand-in", "a", "b").returncode, 2)


class Spheres(InputTest):
    SPHERE = "sphere\n0 0 -5\n2 0 -5\n0 2 -5\n0 0 -3\n\n"

    def told(self, a, b, *words):
        write("a", a)
        write("b", b)
        done = compare("a", "b", *words)
        return done.returncode, done.stdout.decode(), done.stderr.decode()

    def test_their_points_are_compared_like_vertices(self):
        text = TRIANGLE + self.SPHERE + OTHER
        self.assertEqual(self.told(text, text)[0], 0)
        self.assertIn("| 30 ", self.told(text, text)[1])
        status, table, _ = self.told(text, text.replace("0 2 -5", "0 2 -5.5"))
        self.assertEqual(status, 1)
        self.assertIn("| line 8, z of point 3 of sphere 0: -5 in A, -5.5 in B, off by 0.5 |", table)
        self.assertIn("| 1 and 0 spheres", self.told(text, TRIANGLE + OTHER)[1])
        self.assertEqual(
            self.told(self.SPHERE, self.SPHERE.replace("0 0 -3\n", ""))[::2],
            (2, "compare: b: expected four vertices a sphere, found 3 of the last one\n"))


if __name__ == "__main__":
    unittest.main()
