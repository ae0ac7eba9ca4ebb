"""Writes the pages of the conformance pack: the reverse of tests/conformance/conform_parts/pages.py."""
import re
import string
import textwrap

from conform_parts.judge import read_bmp
from conform_parts.pages import depths_of, files_of, read_fields, read_page

WIDTH = 110
BLACK = (0, 0, 0)
LETTERS = string.ascii_letters + string.digits + "+*%&$@!?:;<>()[]{}^~/|"
# Files in the order of their sections; files of mistakes follow by name.
ORDER = ("input.txt", "config.txt", "scene.txt", "expected.txt", "picture-nearest.bmp", "picture-center.bmp",
         "with-one-color.bmp", "depths-nearest.txt", "depths-center.txt")


def page(name, blocks):
    subject = name.removesuffix(".cases").replace("/", ", ").replace("-", " ")
    count = f"{len(blocks)} case{'s' * (len(blocks) > 1)}"
    return f"# {subject}: {count}. ../README.md tells how to read them.\n\n" + "\n".join(blocks)


def block(case):
    """The text of a case; it reads back as the same fields and files."""
    stage, (fields, files) = case.stage, case.answered()
    left = {key: files[key] for key in [*ORDER, *sorted(files.keys() - {*ORDER})] if key in files}
    lines = [f"{key}: {value}".replace(stage + "/", "") for key, value in fields.items() if value != "digits"]
    lines = [textwrap.fill(line, WIDTH, subsequent_indent="  ", break_on_hyphens=False) for line in lines]
    sections, placed = drawings(left) if stage == "zbuf" else ({}, {})
    for names in alike(left, ".txt"):
        has_depths = stage == "zbuf" and names[0].startswith(("depths-", "with-"))
        text = placed.get(names[0]) or (in_runs if has_depths else escaped)(left[names[0]].decode("latin-1"))
        sections[names[0]] = f"-- {' = '.join(names)}\n{text}"
    text = "\n".join([f"== {case.name}", *lines, "".join(sections.get(key, "") for key in left)])
    (_, about, found), = read_page("\n" + text)
    assert read_fields(about, stage) == fields, text
    assert files.items() <= files_of(stage, fields, found).items(), text
    return text


def alike(files, ending):
    """The names of files with this ending, equal files in one group."""
    names = {}
    for name in files:
        if name.endswith(ending):
            names.setdefault(files[name], []).append(name)
    return list(names.values())


def drawings(files):
    """The sections of pictures, side by side if there is room, and the texts of depths, each in the place of
    its pixel. Depths given in a legend are removed from `files`."""
    columns, sections, texts = alike(files, ".bmp"), {}, {}
    rows = {name: read_bmp(files[name]) for names in columns for name in names}
    is_narrow = sum(len(rows[names[0]][0]) + 2 for names in columns) - 2 <= WIDTH
    for group in filter(None, [columns] if is_narrow else [[names] for names in columns]):
        pictures = [name for names in group for name in names if name.startswith("picture")]
        placed = {depths_of(name): beside(rows[name], files[depths_of(name)]) for name in pictures}
        pairs = {pair for lines in placed.values() for line in lines or [[None]] for pair in line}
        has_one_each = None not in pairs and len(dict(pairs)) == len(pairs)
        sections[group[0][0]] = drawing(group, rows, dict(pairs) if has_one_each else {})
        for name, lines in placed.items():
            texts[name] = lines and in_place(lines)
            if has_one_each:
                del files[name]
    return sections, texts


def beside(rows, text):
    """Rows of pixels, each with its depth; None if black ones have depths, or others have none."""
    lines = [line.split() for line in text.decode().split("\n")[:-1]]
    if [len(line) for line in lines] != [sum(pixel != BLACK for pixel in row) for row in rows]:
        return None
    cells = iter(sum(lines, []))
    return [[(color, next(cells) if color != BLACK else "") for color in row] for row in rows]


def drawing(columns, rows, depths):
    """The section of pictures side by side."""
    pictures = [rows[names[0]] for names in columns]
    colors = {pixel: None for picture in pictures for row in picture for pixel in row if pixel != BLACK}
    letters = {BLACK: ".", **dict(zip(colors, LETTERS))}
    lines = ["  ".join("".join(map(letters.get, row)) for row in line) for line in zip(*pictures)]
    legend = [
        "{} = {} {} {}".format(letters[color], *color) + f" at {depths.get(color)}" * (color in depths)
        for color in colors]
    lines += ["  ".join(legend[at:at + 3]) for at in range(0, len(legend), 3)]
    return "\n".join(["-- " + "  ".join(" = ".join(names) for names in columns), *lines, ""])


def in_place(rows):
    """Depths in the places of their pixels; empty if they are too wide."""
    size = max(len(depth) for row in rows for _, depth in row)
    lines = [" ".join(depth.rjust(size) for _, depth in row) for row in rows]
    return "".join(line.rstrip() + "\n" for line in lines) if len(lines[0]) <= WIDTH else ""


def in_runs(text):
    """Rows of depths, equal neighbors as N*VALUE."""
    text = re.sub(r"(?<!\S)(\S+\t)\1{2,}", lambda run: f"{run[0].count(chr(9))}*{run[1]}", text)
    return "".join(fitted(" ".join(line.split())) for line in text.split("\n")[:-1])


def escaped(text):
    """A text with the escapes of Python; a backslash at the end of a line removes the line feed."""
    *lines, last = (line.encode("unicode_escape").decode() for line in text.split("\n"))
    lines += [last + "\\"] if last else []
    lines = (re.sub(" {200,}", lambda run: f"\\{{{len(run[0])}}}", line) for line in lines)
    lines = (re.sub(r"^([-=])(?=\1 )| $", lambda sign: f"\\x{ord(sign[0]):x}", line) for line in lines)
    return "".join(map(fitted, lines))


def fitted(line):
    """A line, broken at blanks where it is too long."""
    lines = textwrap.wrap(line, WIDTH - 2, break_on_hyphens=False) if len(line) > WIDTH else [line]
    return " \\\n".join(lines) + "\n"
