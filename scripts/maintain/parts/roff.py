"""Man pages in the man(7) macros of roff."""
import re

WIDTH = 78  # of the source, in bytes: mandoc asks for at most 80
SPECIAL = {"\\": "\\e", "-": "\\-", "'": "\\(aq", "`": "\\(ga", "^": "\\(ha", "~": "\\(ti"}


def escaped(text):
    return "".join(SPECIAL.get(c, c if c.isascii() else f"\\[u{ord(c):04X}]") for c in text)


def guarded(line):
    """A line, escaped if roff would take it for a request."""
    return "\\&" + line if line[:1] in (".", "'") else line


def wrapped(text):
    """The lines of a paragraph."""
    lines = [""]
    for word in text.split():
        if lines[-1] and len(lines[-1]) + 1 + len(word) > WIDTH:
            lines.append("")
        lines[-1] += (" " if lines[-1] else "") + word
    return [guarded(line) for line in lines]


class Page:
    """Lines of roff, from the heading on."""
    def __init__(self, name, section, date, version):
        self.lines = [
            f'.TH {escaped(name).upper()} {section} {date} "pipeline {version}" "The raster graphics '
            f'pipeline"']

    def section(self, title):
        self.lines.append(f".SH {escaped(title)}")

    def subsection(self, title):
        self.lines.append(f".SS {escaped(title)}")

    def paragraph(self, roff):
        if not self.lines[-1].startswith((".SH ", ".SS ")):
            self.lines.append(".PP")
        self.lines += wrapped(roff)

    def item(self, tag, paragraphs):
        """Adds a tag and its paragraphs, indented below it; all are roff."""
        self.lines += [".TP", guarded(tag)]
        for i, paragraph in enumerate(paragraphs or ["\\&"]):
            self.lines += [".br"] * (i > 0) + wrapped(paragraph)

    def bullet(self, roff):
        self.lines += [".IP \\(bu 2", *wrapped(roff)]

    def literal(self, lines):
        """Adds plain lines, unchanged."""
        if not self.lines[-1].startswith((".SH ", ".SS ")):
            self.lines.append(".PP")
        self.lines += [".RS 4", ".EX", *(guarded(escaped(line)) or "\\&" for line in lines), ".EE", ".RE"]

    def text(self):
        return "\n".join(self.lines) + "\n"


def bold(text):
    return f"\\fB{escaped(text)}\\fR"


def italic(text):
    return f"\\fI{escaped(text)}\\fR"


def add_markdown(page, text, link):
    """Adds a Markdown text without its title. `link` turns a link's text and address into roff."""
    inline = Inline(link)
    for block in re.split(r"\n{2,}", text.strip("\n")):
        lines = block.split("\n")
        if heading := re.fullmatch(r"(#{2,3}) (.*)", lines[0]):
            (page.section if heading[1] == "##" else
             page.subsection)(heading[2].upper() if heading[1] == "##" else heading[2])
            lines = lines[1:]
        if not lines:
            continue
        if lines[0].startswith("```"):
            page.literal([line for line in lines if not line.startswith("```")])
        elif all(line.startswith("    ") for line in lines):
            page.literal([line[4:] for line in lines])
        elif lines[0].startswith("|"):
            add_table(page, lines, inline)
        elif lines[0].startswith("- "):
            for item in re.split(r"\n- ", "\n" + block)[1:]:
                page.bullet(inline.roff(item))
        else:
            page.paragraph(inline.roff(" ".join(lines)))


def add_table(page, lines, inline):
    """Adds a table, an item for each row: the first cell, and below it the others, with the names of their
    columns if there are several."""
    header, _, *rows = [[
        cell.strip().replace("\\|", "|") for cell in re.split(r"(?<!\\)\|",
                                                              line.strip().strip("|"))] for line in lines]
    for row in rows:
        others = [(name, cell) for name, cell in zip(header[1:], row[1:]) if cell]
        page.item(
            inline.roff(row[0]) or "\\&",
            [inline.roff(cell if len(header) == 2 else f"{name}: {cell}") for name, cell in others])


class Inline:
    """Code, emphasis and links within a paragraph."""

    MARKS = re.compile(r"`([^`]+)`|\*\*([^*]+)\*\*|\*([^*]+)\*|\[((?:[^\]`]|`[^`]*`)+)\]\(([^)]+)\)")

    def __init__(self, link):
        self.link = link

    def roff(self, text):
        parts, end = [], 0
        for mark in self.MARKS.finditer(text):
            code, strong, emphasis, words, address = mark.groups()
            parts.append(escaped(text[end:mark.start()]))
            parts.append(
                self.link(words.replace("`", ""), address
                          ) if words else bold(code or strong) if code or strong else italic(emphasis))
            end = mark.end()
        return "".join(parts) + escaped(text[end:])
