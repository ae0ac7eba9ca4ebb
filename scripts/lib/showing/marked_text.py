"""The text that a script writes between the marks <!-- NAME: begin --> and <!-- NAME: end --> of a page."""
import sys


def with_marked(text, name, words, page):
    """The text of the page with new words between the marks of that name."""
    begin, end = f"<!-- {name}: begin -->\n", f"<!-- {name}: end -->"
    if text.count(begin) != 1 or text.count(end) != 1:
        sys.exit(f"{page}: expected one line '{begin.strip()}' and one '{end}'")
    before, rest = text.split(begin)
    return before + begin + words + end + rest.split(end)[1]
