#!/usr/bin/env python3
"""The tools for Windows, which compare-builds has made and compared, in lines of cmd under wine: CRLF,
backslashes, letters beyond ASCII, a closed pipe and a full disk.

usage: windows_test.py SOURCE_DIR
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop()).resolve()
BIN = SOURCE / "build/variants/windows/bin"
SAMPLE = SOURCE / "samples/worked-example"


@unittest.skipUnless((BIN / "trace.exe").is_file(), "compare-builds has not built windows")
class Windows(unittest.TestCase):
    def test_lines_of_cmd(self):
        read, closed = os.pipe()
        os.close(read)
        settings = {"WINEPREFIX": f"{BIN.parents[1]}/wine", "WINEDEBUG": "-all", "WINEPATH": f"Z:{BIN}"}
        with tempfile.TemporaryDirectory() as name, open("/dev/full", "wb") as full:
            folder = pathlib.Path(name, "ä")
            folder.mkdir()
            for file in (SAMPLE / "scene.txt", SAMPLE / "config.txt"):
                (folder / file.name).write_bytes(file.read_bytes().replace(b"\n", b"\r\n"))
            for line, out, status, message in (
                (r"model < ä\scene.txt | view | project | zbuf ä\config.txt -o ä\out.bmp > ä\z_buffer.txt",
                 None, 0, b"$"),
                (r"zbuf ä\config.txt -o .\out.bmp --z-buffer ä\..\OUT.bmp < NUL", None, 2,
                 b"zbuf: expected a place of its own for every output"),
                (r"model ä\scene.txt", closed, 1, b"$"),
                (r"model ä\scene.txt", full, 1,
                 b"model: cannot write <stdout>: No space left on device\r?\n$"),
            ):
                with self.subTest(line):
                    done = subprocess.run(["setarch", "-R", "/usr/lib/wine/wine64", "cmd", "/c", line],
                                          cwd=name, stdout=out, stderr=subprocess.PIPE,
                                          env=os.environ | settings, timeout=300)
                    self.assertRegex(done.stderr, b"^" + message)
                    self.assertEqual(done.returncode, status)
            for made in ("out.bmp", "z_buffer.txt"):
                self.assertEqual((folder / made).read_bytes(), (SAMPLE / made).read_bytes())
            self.assertEqual(sorted(os.listdir(folder)),
                             ["config.txt", "out.bmp", "scene.txt", "z_buffer.txt"])
            self.assertEqual(os.listdir(name), ["ä"])


if __name__ == "__main__":
    unittest.main()
