"""zbuf of this project. usage: pipeline.py nearest|center BIN_DIR"""
import functools
import pathlib
import re
import subprocess
import sys
import tempfile

from adapter import leave, serve

rule, zbuf = sys.argv[1], pathlib.Path(sys.argv[2], "zbuf")
PROMISE = {
    "center":
        "the pixels whose centers are in the triangle, exactly; a center on an edge belongs to it if that is "
        "a left edge, or a horizontal one at the top.",
    "nearest":
        "the assignment's rule: on each row the pixels from the one nearest to the left end to the one "
        "nearest to the right end. Neighbors share pixels."
}
FRAGMENT = re.compile(r"(\d+),(\d+): triangle (\d+), .*: (kept|lost)")
if not zbuf.exists():
    leave(f"no zbuf in {sys.argv[2]}")


@functools.cache
def fragments(case):
    """(pixel, triangle, whether it was nearer than those before) for each pixel that a triangle covers."""
    with tempfile.TemporaryDirectory() as folder:
        config, log = pathlib.Path(folder, "config.txt"), pathlib.Path(folder, "fragments.txt")
        config.write_text(case.config)
        text = "".join("\n".join(map(" ".join, triangle)) + "\n\n" for triangle in case.words)
        subprocess.run([
            zbuf, config, "--coverage", rule, "--image", "/dev/null", "--z-buffer", "/dev/null",
            "--fragments", log], input=text.encode(), check=True, stderr=subprocess.DEVNULL)
        return [(int(row) * case.width + int(column), int(triangle), verdict == "kept")
                for column, row, triangle, verdict in FRAGMENT.findall(log.read_text())]


def coverage(case, number):
    pixels = bytearray(case.width * case.height)
    for pixel, triangle, _ in fragments(case):
        if triangle == number:
            pixels[pixel] = 255
    return bytes(pixels)


def seen(case):
    owners = [-1] * (case.width * case.height)
    for pixel, triangle, is_kept in fragments(case):
        if is_kept:
            owners[pixel] = triangle
    return owners


version = subprocess.run([zbuf, "--version"], capture_output=True, text=True, check=True).stdout.split()[-1]
serve({"name": f"zbuf, {rule}", "version": version, "promise": PROMISE[rule], "grid": 0}, coverage, seen)
