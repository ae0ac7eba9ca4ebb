"""Draws the pixels that all digits leave uncertain as the exact program says."""
import collections

from lib.maths.window import Window
from lib.showing.pictures import size_of, with_pixels_of
from picture_parts.exact_pixels import MOST_BITS, owners
from picture_parts.single_triangles import SingleTriangles

MOST_PIXELS, MOST_BYTES = 1000, 1 << 24  # of a picture, and of its scene
TOO_MUCH = f"the exact program takes {MOST_PIXELS:,} pixels, and scenes of {MOST_BYTES >> 20} MiB"


def decide(drawing, run):
    """Changes the Run of a CertainPicture, and tells how far was tried what stays uncertain."""
    if run.certainty.uncertain_count > MOST_PIXELS or len(scene := drawing.scene()) > MOST_BYTES:
        return f"{run.tried} ({TOO_MUCH})"
    places, width = run.certainty.places, size_of(run.picture)[0]
    seen = owners(scene.decode(errors="surrogateescape"), Window(drawing.config()),
                  [(place % width, place // width) for place in places])
    right, wrong = set(), collections.defaultdict(set)  # wrong ones by what should be there
    for (column, row), number in seen.items():
        place = row * width + column
        if run.owners and run.owners[place] == (-1 if number is None else number):
            right.add(place)
        else:
            wrong[number].add(place)
    triangles = SingleTriangles(drawing.tools, scene, drawing.draw_text)
    drawn = [pair for number, of_it in wrong.items() for pair in triangles.drawn(number, of_it)]
    run.picture = with_pixels_of(run.picture, drawn)
    run.certainty.leave(set(places).difference(right, *(found for _, found in drawn)))
    return f"at {MOST_BITS:,} bits"
