"""The modules of the commands that measure."""
import pathlib
import sys

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2]))  # lib is in scripts
