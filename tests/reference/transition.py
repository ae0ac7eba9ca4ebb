"""What the specification says and tools of before it do not do: they are tested as far as they go. To be removed with them."""
import pathlib
import re
import subprocess
import tempfile

CAMERA = b"0 0 0\n0 0 -1\n0 1 0\n90 1 1 10"


def as_projected(text):
    """The text of stage 3 with `projected` (T4)."""
    return re.sub(rb"(?m)^(frustum|ortho) ", rb"projected \1 ", text)


def output(bin_dir, stage, *words, stdin):
    return subprocess.run([bin_dir / stage, *words], input=stdin, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)


def reads_what_is_new(bin_dir):
    """S8 and S19: `ratio`, and a shininess of 16.0."""
    return output(bin_dir, "model", stdin=CAMERA + b" ratio\nmaterial 1 1 1 16.0\nend\n").returncode == 0


def lights_fronts_only(bin_dir):
    """L5: a black surface that would shine, with a light behind it, stays black."""
    text = CAMERA + b"\ncolor 0 0 0\nmaterial 0 0 1 1\nlight 9 0 -3 1 1 1\ntriangle\n-9 -9 -2\n9 -9 -2\n0 9 -2\nend\n"
    for stage in ("model", "view", "project"):
        text = output(bin_dir, stage, stdin=text).stdout
    with tempfile.TemporaryDirectory() as folder:
        config, image = pathlib.Path(folder, "config.txt"), pathlib.Path(folder, "out.bmp")
        config.write_text("1 1\n")
        output(bin_dir, "zbuf", config, "--image", image, stdin=text)
        return image.read_bytes()[54:57] == b"\0\0\0"


def refuses_forgotten_stages(bin_dir):
    """T14."""
    return output(bin_dir, "project", stdin=b"eye 0 0 5\northo -1 1 -1 1 1 9\n").returncode == 1
