#!/usr/bin/env python3
"""Checks the proofs *.g in this folder with Gappa, and that README.md lists each."""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

FOLDER = pathlib.Path(__file__).resolve().parent
SOURCE = FOLDER.parent.parent
PROOFS = sorted(FOLDER.glob("*.g"))
CLAIM = re.compile(r"<= (\d+)b(-?\d+)(?=[^#\n]*# claim$)", re.M)
NARROWER = 8  # as a power of two


def gappa(text):
    """True if Gappa proves it and trusts no hint that is not an identity."""
    run = subprocess.run(["gappa"], input=text, capture_output=True, text=True, timeout=120)
    return run.returncode == 0 and "Warning" not in run.stderr, run.stderr


def narrower(text):
    return CLAIM.sub(lambda claim: f"<= {claim[1]}b{int(claim[2]) - NARROWER}", text)


class Table(unittest.TestCase):
    def test_has_every_proof(self):
        named = set(re.findall(r"`(\w+\.g)`", (FOLDER / "README.md").read_text()))
        self.assertEqual(named, {proof.name for proof in PROOFS})

    def test_has_tests_that_exist(self):
        sources = "\n".join(path.read_text() for path in (FOLDER.parent).rglob("*_test.cpp"))
        named = re.findall(r"`(\w+)\.(\w+)`", (FOLDER / "README.md").read_text())
        tests = [(suite, name) for suite, name in named if name != "g" and suite != "Library"]
        self.assertGreater(len(tests), 5)
        for suite, name in tests:
            self.assertTrue(re.search(rf"TEST(_P)?\({suite}, {name}\)", sources), f"{suite}.{name}")

    def test_each_proof_names_files_that_exist(self):
        for proof in PROOFS:
            named = re.findall(r"libpipeline/[\w/]+\.(?:cpp|h)", proof.read_text())
            self.assertTrue(named, proof.name)
            for path in named:
                self.assertTrue((SOURCE / path).is_file(), f"{proof.name}: {path}")

    def test_each_proof_is_named_where_its_arithmetic_is(self):
        for proof in PROOFS:
            named = re.findall(r"libpipeline/[\w/]+\.(?:cpp|h)", proof.read_text())
            self.assertTrue(any(proof.name in (SOURCE / path).read_text() for path in named), proof.name)


@unittest.skipUnless(shutil.which("gappa"), "gappa is not installed")
class Proofs(unittest.TestCase):
    def test_every_claim_is_proved(self):
        for proof in PROOFS:
            with self.subTest(proof.name):
                is_proved, message = gappa(proof.read_text())
                self.assertTrue(is_proved, message)

    def test_a_narrower_claim_is_refused(self):
        for proof in PROOFS:
            with self.subTest(proof.name):
                text = proof.read_text()
                self.assertNotEqual(narrower(text), text)
                self.assertFalse(gappa(narrower(text))[0])

    def test_a_hint_that_is_no_identity_is_refused(self):
        self.assertTrue(gappa("{ a in [0, 1] -> a * a - a in [-1, 1] }\na * a - a -> a * (a - 1);\n")[0])
        self.assertFalse(gappa("{ a in [0, 1] -> a * a - a in [-1, 1] }\na * a - a -> 0;\n")[0])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], "--verbose", *sys.argv[1:]])
