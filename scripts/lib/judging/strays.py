"""Lines of a stage text that do not belong there: they are counted, by triangle, and the first one is
named."""
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
    """Names the lines that do not belong in a stage text; empty if there are none."""
    lines = text.split("\n")
    columns = None if any(line.split()[:1] == ["attributes"] for line in lines) else 3
    strays, blocks, in_block = [], [], []
    for number, line in enumerate([*lines, ""], 1):
        kind = kind_of(line, columns)
        if kind in ("stray", "long"):
            strays.append((number, kind))
        if kind in ("vertex", "long"):
            in_block.append(number)
        elif not line.strip() and in_block:
            blocks.append(in_block)
            in_block = []
    return "; ".join(
        filter(None, [
            of_lines([n for n, kind in strays if kind == "stray"], lines, blocks),
            of_columns([n for n, kind in strays if kind == "long"], lines),
            of_blocks(blocks)]))


def of_lines(strays, lines, blocks):
    if not strays:
        return ""
    first = shown(lines[strays[0] - 1].strip()[:LONGEST])
    count = f"{len(strays)} lines are" if len(strays) > 1 else "1 line is"
    each = f", {len(strays) // len(blocks)} for each triangle" if len(
        blocks) > 1 and len(strays) % len(blocks) == 0 else ""
    return (f"{count} neither a vertex nor a header line{each}: {'first ' if len(strays) > 1 else ''}line "
            f"{strays[0]}, '{first}'")


def of_columns(long, lines):
    if not long:
        return ""
    count = f"{len(long)} vertex lines have" if len(long) > 1 else "1 vertex line has"
    return (f"{count} more than three numbers, of which the first three count: "
            f"{'first ' if len(long) > 1 else ''}line {long[0]}, "
            f"'{shown(lines[long[0] - 1].strip()[:LONGEST])}'")


def of_blocks(blocks):
    """Triangles stand between blank lines; a text may also go without those."""
    uneven = [block for block in blocks if len(block) % 3]
    if not uneven:
        return ""
    count = f"{len(uneven)} of {len(blocks)} triangles (between blank lines) have" if len(
        uneven) > 1 else "a triangle (between blank lines) has"
    return (f"{count} another number of vertices than three: {'first ' if len(uneven) > 1 else ''}the one in "
            f"line {uneven[0][0]}, {len(uneven[0])}")
