"""Pillow's ImageDraw.polygon, of Debian's Python."""
import math

from adapter import leave, serve

try:
    import PIL
    from PIL import Image, ImageDraw
except ImportError:
    leave("no Pillow (Debian: python3-pil)")


def coverage(case, number):
    image = Image.new("L", (case.width, case.height))
    ImageDraw.Draw(image).polygon(
        [tuple(map(math.floor, case.pixels(point))) for point in case.triangles[number]], fill=255)
    return image.tobytes()


serve(
    {
        "name": "Pillow",
        "version": PIL.__version__,
        "promise": (
            "nothing. It takes fractions, but truncates corners to whole pixels, and draws the pixels of the "
            "outline, too."),
        "grid": 1,
    }, coverage)
