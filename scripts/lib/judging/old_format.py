"""Scenes in the form of before 2020: the size of the screen and a background beside the camera, a color after
each triangle."""
import itertools


def without_old_lines(text):
    """The scene in today's form; None if it is not in the old one."""
    lines = text.split("\n")
    filled = [(i, words) for i, line in enumerate(lines) if (words := line.split("#")[0].split())]
    head = [*itertools.takewhile(lambda line: not is_word(line), filled)]
    dropped = {i for i, words in head if len(words) == 2}  # the size; the background is the line behind it
    if len(head) > 5:
        dropped |= {i for (_, size), (i, _) in zip(head, head[1:]) if len(size) == 2}
    for (_, word), *numbers in zip(*(filled[len(head) + k:] for k in range(5))):
        if word == ["triangle"] and not any(map(is_word, numbers)):
            dropped.add(numbers[-1][0])
    return "\n".join(line for i, line in enumerate(lines) if i not in dropped) if dropped else None


def is_word(line):
    return line[1][0][0].isalpha()
