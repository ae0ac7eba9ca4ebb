#!/usr/bin/env python3
"""scripts/measure/scale on a tiny scene: it measures and prints every table, in the form of those on the
page.

usage: scale_test.py BIN_DIR SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

BIN, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))


class Scale(unittest.TestCase):
    def test_quick(self):
        if not shutil.which("parallel"):
            self.skipTest("GNU parallel is missing")
        done = subprocess.run([SOURCE / "scripts/measure/scale", "--quick", "--large", "--print"],
                              capture_output=True, text=True, env={**os.environ, "BIN": str(BIN)})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        page = (SOURCE / "docs/scale.md").read_text()
        tables = dict(re.findall(r"^(\w+):\n((?:\|.*\n)+)", done.stdout, re.M))
        self.assertEqual(set(tables), {"costs", "parts", "density", "projected", "compared"})
        cells = lambda line: [cell.strip() for cell in line.strip("|\n").split("|")]
        for name, text in tables.items():
            shown = re.search(rf"<!-- {name}: begin -->\n(.*?)<!-- {name}: end -->", page,
                              re.S)[1].splitlines()
            self.assertEqual(cells(text.splitlines()[0]), cells(shown[0]))
        # Parts do not change what is seen in them all together, nor, but for their beginnings, the size of
        # the scene.
        rows = [cells(line) for line in tables["parts"].splitlines()[3:]]
        self.assertEqual([row[0] for row in rows], ["1", "2", "4"])
        seen = [float(row[5].split()[0]) for row in rows]
        self.assertEqual(seen, sorted(seen))


if __name__ == "__main__":
    unittest.main()
