"""Decides pixels that are uncertain with all digits by exact_pixels, and draws them."""
import collections

from lib.maths.window import Window
from lib.running.owners import NOBODY
from lib.showing.pictures import size_of, with_pixels_of
from picture_parts.exact_pixels import MOST_BITS, TooMuch, owners
from picture_parts.single_triangles import SingleTriangles

MOST_PIXELS, MOST_BYTES = 10000, 1 << 24  # of a picture, and of its scene
TOO_MUCH = "too much for the exact program"


def decide(drawing, run):
    """Corrects the Run of a CertainPicture, and says how far pixels that stay uncertain were tried."""
    if run.certainty.uncertain_count > MOST_PIXELS or len(data := drawing.scene()) > MOST_BYTES:
        return f"{run.tried} ({TOO_MUCH})"
    places, width = run.certainty.places, size_of(run.picture)[0]
    scene, window = data.decode("utf-8-sig", "surrogateescape"), Window(drawing.config())
    drawing.expect_unchanged()
    try:
        seen = owners(scene, window, [(place % width, place // width) for place in places])
    except TooMuch:
        return f"{run.tried} ({TOO_MUCH})"
    right, wrong = set(), collections.defaultdict(set)  # wrong ones by the triangle to show
    for (column, row), found in seen.items():
        number, place = found[0] if found else NOBODY, row * width + column
        if run.owners and run.owners[place] == number:
            right.add(place)
        else:
            wrong[number].add(place)
    of_number = dict(filter(None, seen.values()))
    triangles = SingleTriangles(drawing.tools, scene, drawing.draw_text)

    def drawn():
        for number, of_it in wrong.items():
            for picture, found in triangles.drawn(number, of_number.get(number), of_it):
                right.update(found)
                yield picture, found

    run.picture = with_pixels_of(run.picture, drawn())
    run.certainty.leave(set(places) - right)
    return f"at {MOST_BITS:,} bits" + (", or beyond what doubles draw" if len(seen) > len(right) else "")
