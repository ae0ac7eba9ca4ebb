"""A z-buffer text as rows of numbers."""
from lib.rim.command import shown
from lib.rim.input_file import name_of
from lib.text.plain_stage_text import real
from lib.text.stage_text import StageTextError


def parse_z_buffer(text, path):
    """Rows of depths, one a line."""
    rows = []
    for number, line in enumerate(text.split("\n"), 1):
        try:
            rows.append([real(word) for word in line.split()])
        except ValueError:
            raise StageTextError(
                f"{name_of(path)}:{number}: expected depths, found '{shown(line.strip()[:40])}'") from None
    while rows and not rows[-1]:  # rows at the end may be empty
        rows.pop()
    return rows
