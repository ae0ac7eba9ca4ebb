"""Lines that do not belong in a stage text: counts them, or their triangles, and names the first."""
from lib.rim.command import shown
from lib.text.plain_stage_text import KEYWORD, NO_KEYWORDS, real
from lib.text.scene import SETTINGS

WORDS = {
    "eye", "look", "up", "perspective", "ortho", "frustum", "projected", "framed", "end", "triangle",
    "clipped", "error", "sphere", *SETTINGS}
LONGEST = 40  # characters of a line, as shown


def kind_of(line, columns):
    """'vertex', 'word', '' for a blank line or a comment, 'stray', or 'long': a vertex with more numbers than
    `columns`."""
    words = line.split("#")[0].split()
    if not words:
        return ""
    if KEYWORD.match(words[0]) and words[0].lower() not in NO_KEYWORDS:
        return "word" if words[0] in WORDS else "stray"
    try:
        count = len([real(word) for word in words])
    except ValueError:
        return "stray"
    return "stray" if count < 3 else "vertex" if columns is None or count <= columns else "long"


def of_a_text(text):
    """Names the lines that do not belong in a stage text; empty if there are none. Triangles stand between
    blank lines; a text may also go without those."""
    lines = text.split("\n")
    columns = None if any(line.split()[:1] == ["attributes"] for line in lines) else 3
    strays, long, blocks = [], [], [[]]
    for number, line in enumerate(lines, 1):
        kind = kind_of(line, columns)
        (strays if kind == "stray" else long if kind == "long" else []).append(number)
        if kind in ("vertex", "long"):
            blocks[-1].append(number)
        elif not line.strip():
            blocks.append([])
    blocks = [*filter(None, blocks)]
    is_of_each = len(blocks) > 1 and strays and len(strays) % len(blocks) == 0
    each = f", {len(strays) // len(blocks)} for each triangle" if is_of_each else ""

    def quoted(number):
        return f"line {number}, '{shown(lines[number - 1].strip()[:LONGEST])}'"

    return "; ".join(
        filter(None, [
            counted(strays, "1 line is", "lines are", f"neither a vertex nor a header line{each}", quoted),
            counted(long, "1 vertex line has", "vertex lines have",
                    "more than three numbers, of which the first three count", quoted),
            counted([block for block in blocks if len(block) % 3], "a triangle (between blank lines) has",
                    f"of {len(blocks)} triangles (between blank lines) have",
                    "another number of vertices than three",
                    lambda block: f"the one in line {block[0]}, {len(block)}")]))


def counted(some, one, many, words, first):
    """The count of some lines or triangles in words, and the first of them; empty if there are none."""
    if not some:
        return ""
    count = f"{len(some)} {many} {words}: first " if len(some) > 1 else f"{one} {words}: "
    return count + first(some[0])
