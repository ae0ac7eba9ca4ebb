"""The pages of the pack, cases/STAGE/SUBJECT.cases: cases/README.md tells how to read them."""
import re
import struct

CONFIG = b"8 8\n-1\n-1\n-1 1\n"  # where a page gives no other
KEYS = ("why", "paragraphs", "catches", "tier", "needs", "open", "open-nearest", "refused")  # of case.txt
LEGEND = re.compile(r"(\S) = (\d+) (\d+) (\d+)(?: at (\S+))?")


def read_page(text):
    """The cases of a page: (name, the text of the fields, the sections)."""
    for block in text.split("\n== ")[1:]:
        about, *sections = block.removesuffix("\n").split("\n-- ")
        name, _, fields = about.partition("\n")
        yield name, fields, sections


def read_fields(text, stage):
    """Lines KEY: VALUE, by key; a line that begins with blanks goes on with the one before."""
    fields = dict(line.split(": ", 1) for line in re.sub(r"\n +", " ", text).splitlines())
    if "catches" in fields:
        fields["catches"] = " ".join(f"{stage}/{name}" for name in fields["catches"].split())
    return {"tier": "digits", **fields}


def files_of(stage, fields, sections):
    """The files of a case, by name."""
    files = {"case.txt": "".join(f"{key}: {fields[key]}\n" for key in KEYS if key in fields).encode()}
    if stage == "zbuf":
        files["config.txt"] = CONFIG
    if "options" in fields:
        files["options.txt"] = (fields["options"] + "\n").encode()
    depths = {}
    for heading, line_feed, text in (section.partition("\n") for section in sections):
        columns = [names.split(" = ") for names in heading.split("  ")]
        if heading.endswith(".bmp"):
            contents = pictures(columns, text, depths)
        else:
            has_depths = stage == "zbuf" and heading.startswith(("depths-", "with-"))
            contents = [unescaped(text + line_feed, has_depths)]
        files.update({name: content for names, content in zip(columns, contents) for name in names})
    return {**depths, **files}


def unescaped(text, has_depths):
    """The bytes of a text with the escapes of Python, and of \\{N}, N blanks; of depths N*VALUE are N, and a
    tab follows each."""
    text = re.sub(r"(?<!\\)\\{(\d+)}", lambda run: " " * int(run[1]), text)
    text = text.encode("ascii").decode("unicode_escape")
    if has_depths:
        text = re.sub(r"(\d+)\*(\S+)", lambda run: " ".join([run[2]] * int(run[1])), text)
        text = "\n".join("".join(depth + "\t" for depth in line.split()) for line in text.split("\n"))
    return text.encode("latin-1")


def pictures(columns, text, depths):
    """The BMP files of pictures side by side; texts of depths that the legend gives go into `depths`."""
    entries = [(".", 0, 0, 0, ""), *LEGEND.findall(text)]
    legend = {letter: (bytes(map(int, color)), depth) for letter, *color, depth in entries}
    rows = zip(*(line.split() for line in text.splitlines() if line and " = " not in line))
    for names, picture in zip(columns, rows):
        cells = [[legend[letter][1] for letter in row] for row in picture]
        lines = "".join("".join(depth + "\t" for depth in row if depth) + "\n" for row in cells).encode()
        depths.update({depths_of(name): lines for name in names if name.startswith("picture")})
        yield bmp([[legend[letter][0] for letter in row] for row in picture])


def depths_of(picture):
    return picture.replace("picture", "depths").replace("bmp", "txt")


def bmp(rows):
    """A BMP file of 24 bits a pixel, of rows from the top, of pixels in red, green, blue."""
    data = b"".join(b"".join(pixel[::-1] for pixel in row) + bytes(-3 * len(row) % 4) for row in rows[::-1])
    sizes = len(rows[0]), len(rows), 1, 24, 0, len(data)
    return struct.pack("<2sI4xIIiiHHII16x", b"BM", 54 + len(data), 54, 40, *sizes) + data
