"""Model files in the place of scenes."""
import os
import re
import sys
import tempfile

from lib.rim.input_file import read_input
from lib.rim.output_file import write_file
from lib.running.pipe_tools import Tools

# The last ones are formats that mesh2scene refuses with a hint on conversion.
ENDINGS = (".obj", ".stl", ".ply", ".gltf", ".glb", ".3mf", ".3ds", ".dae", ".fbx", ".off", ".amf", ".x3d")
KEPT = []  # folders, until the program ends


def words_of_outputs(outputs):
    """Options that make mesh2scene refuse a model that reads one of these files, which may be None."""
    return [word for path in outputs if path and os.path.isfile(path) for word in ("--writes", path)]


def take_model(options, outputs, size="800x600"):
    """If SCENE is a model file, replaces it by the scene that mesh2scene makes of it, framed for CONFIG;
    without a CONFIG, makes one of this size. The model may read none of `outputs`."""
    path = options.scene
    if not path.lower().endswith(ENDINGS) or not os.path.isfile(path):
        return
    options.model = path  # no output may replace it
    KEPT.append(tempfile.TemporaryDirectory())
    if options.config:
        found = re.match(rb"\s*(\d+)\s+(\d+)", read_input(options.config))
        size = "x".join(number.decode() for number in found.groups()) if found else size
    model = os.path.join(os.curdir, path) if path.startswith("-") else path
    done = Tools().run("mesh2scene", *words_of_outputs(outputs), "--size", size, model)
    sys.stderr.buffer.write(done.stderr)  # with names in any encoding
    sys.stderr.flush()
    options.scene = os.path.join(KEPT[-1].name, os.path.basename(path))
    write_file(options.scene, done.stdout)
    if not options.config:
        options.config = os.path.join(KEPT[-1].name, "config.txt")
        write_file(options.config, size.replace("x", " ").encode() + b"\n")
