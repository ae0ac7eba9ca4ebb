"""The places of files beside the scripts: in the source tree, or where it is installed."""
import pathlib

from lib.rim.command import CommandFailure

HERE = pathlib.Path(__file__).resolve()


def place(in_source, installed):
    """The path of a file or folder, given from the source tree's top and from the prefix."""
    paths = HERE.parents[3] / in_source, HERE.parents[4] / installed
    for path in paths:
        if path.exists():
            return path
    raise CommandFailure(f"there is neither {paths[0]} nor {paths[1]}")
