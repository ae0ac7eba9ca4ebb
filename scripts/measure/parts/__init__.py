"""The modules of the commands that measure."""
import pathlib
import sys

SCRIPTS = pathlib.Path(__file__).resolve().parents[2]
sys.path += [str(SCRIPTS), str(SCRIPTS.parent / "tests/scripts")]  # lib is in scripts, display in tests
