"""The words for rules of stage 4, for pixels that differ and for their places."""
DIFFERENCES = {
    "extra": "a pixel that no triangle covers",
    "missing": "a pixel that triangle {} covers is empty",
    "depth": "another depth than that of triangle {}",
    "other": "another triangle than triangle {}",}
DEPTHS = {
    "between ends": "depths between the rounded ends of a row",
    "from left": "depths counted on from the left end of a row"}
AT_BORDERS = "another rule at the borders"
ENDS = {"rounded": "rounded", "truncated": "truncated", "down": "rounded down", "up": "rounded up"}


def counted(count, noun):
    return f"{count:,} {noun}{'' if count == 1 else 's'}"


def rule_in_words(rule):
    """The open rules in which a rule differs from ours."""
    if (rule.left, rule.right) == ("up", "down"):
        ends = "the center rule"
    elif rule.left == rule.right:
        ends = f"ends of rows {ENDS[rule.left]}" if rule.left != "rounded" else ""
    else:
        ends = f"left ends of rows {ENDS[rule.left]}, right ends {ENDS[rule.right]}"
    return ", ".join(filter(None, (ends, DEPTHS.get(rule.depth))))


def border_rule_in_words(mismatch, pixels):
    """The pixels in which another rule at the borders differs."""
    def shows_another(row, column):  # a triangle, by the pixel's color
        return pixels.drawn[row][column] and mismatch.owners.get(
            (row, column), -1) not in mismatch.of_color(pixels.colors[row][column])

    inside = (place for place, kind in mismatch.pixels.items() if kind in ("depth", "other"))
    others = {place for place in inside if shows_another(*place)}
    offsets = [offset for place, offset in mismatch.offsets.items() if place not in others]
    words, shapes = [], mismatch.count("extra", "missing")
    if shapes:
        counts = (mismatch.count("extra"), "more"), (mismatch.count("missing"), "fewer")
        parts = ", ".join(f"{count:,} {word}" for count, word in counts if count)
        words.append(f"{AT_BORDERS}: {counted(shapes, 'pixel')} of {mismatch.drawn:,} ({parts})")
    if others:
        words.append(f"{len(others):,} of {mismatch.drawn:,} show another triangle where triangles meet")
    if offsets:
        differ = "depth differs" if len(offsets) == 1 else "depths differ"
        words.append(f"{len(offsets):,} {differ} by less than one pixel makes, up to {max(offsets):.2g}")
    return "; ".join(words)


def place_in_words(place, width):
    """A pixel's place; a column beyond the picture's width stands for the whole row."""
    row, column = place
    return f"row {row}" + (f", column {column}" if column < width else "")


def difference_in_words(mismatch, place, width):
    """A pixel that differs, with its place."""
    words = DIFFERENCES[mismatch.pixels[place]].format(mismatch.owners.get(place))
    return f"{place_in_words(place, width)}: {words if place[1] < width else 'another number of depths'}"
