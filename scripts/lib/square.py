"""Whether a scene's squares are drawn as squares."""
import os
import pathlib
import subprocess

PROGRAM = pathlib.Path(__file__).resolve().with_suffix(".awk")


def note_on_squares(projection, config):
    """The note on a projection, the words of a header line, and the text of a config; none if squares are squares."""
    command = ["awk", "-v", "projection=" + " ".join(projection), "-f", PROGRAM]
    done = subprocess.run(command, input=config, capture_output=True, text=True, errors="surrogateescape", check=True,
                          env={**os.environ, "LC_ALL": "C"})
    return done.stdout.strip()
