"""The triangle that each pixel shows: every triangle is drawn in a color of its own, its mark."""
import array

from lib.rim.command import CommandFailure
from lib.showing.pictures import read_picture
from lib.text.stage_text import triangle_lines

NOBODY = 0  # a triangle's mark is its number + 1
MAX_TRIANGLES = 2**24 - 1


def write_marked(projected, path):
    """Writes a text of project without its colors and lights, and with marks."""
    with open(projected, "rb") as text, open(path, "wb") as file:
        file.write(b"attributes color\n")
        for number, corners in triangle_lines(text):
            if number >= MAX_TRIANGLES:
                raise CommandFailure(f"expected at most {MAX_TRIANGLES} triangles, found triangle {number}")
            color = b" %d %d %d\n" % tuple((number + 1).to_bytes(3, "big"))
            file.write(b"".join(b" ".join(corner.split(None, 3)[:3]) + color for corner in corners) + b"\n")


def owners(tools, marked, config, words, image):
    """The mark of the triangle that each pixel shows, or NOBODY, from the top left. write_marked wrote the
    file `marked`; `words` are options of zbuf, and `image` is the path of a .ppm to write."""
    tools.run("zbuf", *words, "--z-buffer", "none", "--image", image, config, marked)
    _, _, rows = read_picture(image)
    return array.array("I",
                       (int.from_bytes(row[i:i + 3], "big") for row in rows for i in range(0, len(row), 3)))
