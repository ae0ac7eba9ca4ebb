"""Scenes in the form of before 2020: the size of the screen and a background beside the camera, a color after
each triangle."""


def without_old_lines(text):
    """The scene in today's form; None if it is not in the old one."""
    lines = [(line, line.split("#")[0].split()) for line in text.split("\n")]
    filled = [(i, words) for i, (_, words) in enumerate(lines) if words]
    head = []
    for i, words in filled:
        if words[0][0].isalpha():
            break
        head.append((i, len(words)))
    dropped = set()
    for place, (i, count) in enumerate(head):
        if count == 2:  # the size; the background is the line behind it
            dropped.add(i)
            if place + 1 < len(head) and len(head) > 5:
                dropped.add(head[place + 1][0])
    numbers = None  # of lines of numbers since the word triangle
    for i, words in filled[len(head):]:
        if words[0][0].isalpha():
            numbers = 0 if words == ["triangle"] else None
        elif numbers is not None:
            numbers += 1
            if numbers == 4:
                dropped.add(i)
    return "\n".join(line for i, (line, _) in enumerate(lines) if i not in dropped) if dropped else None
