"""The pictures of a page: the right one, the hand-in's, and their differences."""
import base64
import contextlib

from lib.judging.verdict import UNREADABLE
from lib.showing.pictures import PictureError, picture_of, png

MOST_COLUMNS = 480
RED, ORANGE = bytes((220, 0, 0)), bytes((245, 140, 0))
DIFFERENCES = "Against your stage 3: red another triangle or none, orange another depth"


def data_uri(rows):
    """Rows of bytes as a PNG inside a page."""
    picture = png(len(rows[0]) // 3, len(rows), rows)
    return "data:image/png;base64," + base64.b64encode(picture).decode()


def smaller(rows, step):
    """Every `step`-th pixel of every `step`-th row."""
    if step == 1:
        return rows
    return [b"".join(row[i:i + 3] for i in range(0, len(row), 3 * step)) for row in rows[::step]]


def faded(rows):
    """Rows so light that marks stand out."""
    light = bytes(210 + i * 45 // 255 for i in range(256))
    return [row.translate(light) for row in rows]


def marked(rows, marks, step):
    """Rows, made smaller by `step`, with marks: pairs of places in the large picture and a color, the last
    color on top."""
    rows = [bytearray(row) for row in faded(rows)]
    columns = len(rows[0]) // 3
    for places, color in marks:
        for row, column in places:
            row, column = row // step, column // step
            if row < len(rows) and column < columns:
                rows[row][3 * column:3 * column + 3] = color
    return [bytes(row) for row in rows]


def pictures(test, files, verdict):
    """(caption, data: URI, width as a share of the widest's) for each picture of a test that can be shown."""
    theirs = None
    picture = [file for file in verdict.of("zbuf")
               if file.file == files["picture"].name] if "picture" in files else []
    if picture and picture[0].verdict != UNREADABLE and files["picture"].data:
        with contextlib.suppress(PictureError):
            theirs = picture_of(files["picture"].data, "", test.reference.background)[2]
    shape = test.picture or theirs
    if not shape:
        return []
    step = max(1, -(-len(shape[0]) // 3 // MOST_COLUMNS))
    found = [(caption, smaller(rows, step))
             for caption, rows in (("The scene, right", test.picture), ("Yours", theirs)) if rows]
    wrong = [file for file in verdict.of("zbuf") if not file.is_good and file.places]
    if wrong:
        marks = [(file.places, RED if file in picture else ORANGE)
                 for file in sorted(wrong, key=picture.__contains__)]
        found.append((DIFFERENCES, marked(smaller(theirs or shape, step), marks, step)))
    widest = max(len(rows[0]) for _, rows in found)
    return [(caption, data_uri(rows), len(rows[0]) / widest) for caption, rows in found]
