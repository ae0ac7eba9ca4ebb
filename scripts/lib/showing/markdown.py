"""Markdown of at most 120 columns. Tables, code and pictures stay as they are, since they cannot be
broken."""
import re

COLUMNS = 120
WHOLE = re.compile(r"[|#<]|!\[|```|    ")  # the beginnings of lines that are kept
BLOCK = re.compile(r"\s*([-*+]|\d+\.)\s|[|#<>]|!\[|```|\*\*[A-Z]\d+\*\*")  # of lines that begin a block


def words_of(text):
    """The words of a text; code between backquotes is one word."""
    return [
        word.replace("\0", " ")
        for word in re.sub(r"`[^`]*`", lambda code: code[0].replace(" ", "\0"), text).split()]


def filled(text):
    """The text with each paragraph refilled from its first line that is too long."""
    lines, result, is_code = text.split("\n"), [], False
    while lines:
        line = lines.pop(0)
        is_code ^= line.startswith("```")
        result.append(line)
        if is_code or len(line) <= COLUMNS or WHOLE.match(line):
            continue
        first = re.match(r"\s*(?:(?:[-*+]|\d+\.)\s+)?", line)[0]
        rest = " " * len(first)
        words, result[-1] = words_of(line[len(first):]), first
        while lines and re.match(rest + r"\S", lines[0]) and not BLOCK.match(lines[0]):
            words += words_of(lines.pop(0))
        for i, word in enumerate(words):
            if i and len(result[-1]) + len(word) >= COLUMNS:
                result.append(rest + word)
            else:
                result[-1] += " " * (i > 0) + word
    return "\n".join(result)
