"""The page of a hand-in, to be read or printed: one file that holds its pictures and needs no network and no
script."""
import html

from grade_parts.hints import gives, shown_of
from lib.judging.fit import shown
from lib.judging.report import remarks_of
from lib.showing.page_policy import policy

STYLE = """
body { font: 11pt/1.4 sans-serif; max-width: 56rem; margin: 2rem auto; padding: 0 1rem; color: #1a1a1a }
h1 { font-size: 1.4rem; margin: 0 }
h2 { font-size: 1.1rem; margin: 1.6rem 0 .3rem; border-top: 1px solid #999; padding-top: .8rem }
h2 span, h1 span { float: right; font-weight: normal } p { margin: .4rem 0; overflow-wrap: anywhere }
table { border-collapse: collapse; width: 100%; margin: .6rem 0; font-size: .85rem }
th, td { text-align: left; vertical-align: top; padding: .15rem .5rem; border-bottom: 1px solid #ccc }
th, td { overflow-wrap: anywhere }
th, td:nth-child(1), td:nth-child(3), td:nth-child(4) { white-space: nowrap }
td:nth-child(2) { min-width: 6rem }
.good { color: #146c2e } .bad { color: #a31515 } .open { color: #7a5200 }
.teacher { border-left: 3px solid #7a5200; padding-left: .6rem }
.fix { border-left: 3px solid #3465a4; padding-left: .6rem }
.matrix { display: inline-table; width: auto; margin-right: 2rem }
.matrix td { min-width: 0; padding: .1rem .3rem; text-align: right } caption { text-align: left }
figure { display: inline-block; vertical-align: top; margin: .4rem .8rem 0 0 }
img { width: 100%; image-rendering: pixelated; border: 1px solid #999 } figcaption { font-size: .8rem }
@media (max-width: 40rem) { tr { display: block; border-bottom: 1px solid #ccc }
tr td:nth-child(n) { display: inline; white-space: normal; border: 0; padding: 0 .4rem 0 0 }
tr:first-child:has(th) { display: none } .matrix tr { display: table-row }
.matrix tr td:nth-child(n) { display: table-cell; padding: .1rem .3rem } }
.matrix tr td:nth-child(n) { white-space: nowrap }
@media print { body { margin: 0; max-width: none } h2 { break-after: avoid }
figure, table { break-inside: avoid } }
"""
HEADER = ("stage", "file", "verdict", "differ", "first difference", "remarks")


def heading(kind, name, scored):
    points = f"{scored.score:.4g} of {scored.max_score:.4g} points"
    return f"<{kind}>{html.escape(name)} <span>{points}</span></{kind}>"


def page(name, graded, level):
    """The HTML of a hand-in's page. `graded` is a grade_parts.graders.Graded."""
    lines = [heading("h1", name, graded)]
    lines += [f"<p>{html.escape(remark)}</p>".replace("\n", "<br>") for remark in graded.remarks]
    for test in graded.tests:
        lines += section(test, level)
    title = html.escape(name)
    return (f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">{policy()}<title>{title}</title>'
            f"<style>{STYLE}</style></head><body>\n" + "\n".join(lines) + "\n</body></html>\n")


def section(test, level):
    yield heading("h2", test.name, test)
    if test.by_teacher:
        yield f'<p class="teacher">{html.escape(test.by_teacher)}</p>'
    yield f"<p>{html.escape(test.words)}</p>"
    for text in test.fixes:
        yield f'<p class="fix">{html.escape(text)}</p>'
    if not gives(level, "stage") or not test.verdict.files:
        return
    verdict = shown_of(test.verdict, level)
    yield "<table><tr>" + "".join(f"<th>{word}</th>" for word in HEADER) + "</tr>"
    for file in verdict.files:
        kind = "good" if file.is_good else "bad" if file.verdict in ("wrong", "unreadable",
                                                                     "not handed in") else "open"
        cells = [file.stage, file.file, file.verdict, counted(file), file.first, "; ".join(remarks_of(file))]
        yield f'<tr class="{kind}">' + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells) + "</tr>"
    yield "</table>"
    for file in verdict.files:
        if file.matrices:
            points = f"the points of {html.escape(file.file)}"
            yield f"<p>The matrix of {file.stage}, from {points}, and the right one:</p>"
            yield matrices(file.matrices)
    for caption, uri, share in test.pictures:
        yield (f'<figure style="width: {30 * share:.4g}%"><img src="{uri}" alt="{caption}">'
               f"<figcaption>{caption}</figcaption></figure>")


def matrices(comparison):
    """A fit.Comparison as two tables, one below the other if the page is narrow."""
    if not hasattr(comparison, "theirs"):
        return f"<p>{html.escape(str(comparison).strip())}</p>"
    marked = "found in the points (* differs)", comparison.theirs, comparison.differing
    tables = []
    for caption, m, places in (marked, ("right", comparison.ours, ())):
        rows = ("".join(f"<td>{shown(x)}{'*' * ((i, j) in places)}</td>" for j, x in enumerate(row))
                for i, row in enumerate(m))
        tables.append(f'<table class="matrix"><caption>{caption}</caption>' +
                      "".join(f"<tr>{row}</tr>" for row in rows) + "</table>")
    return f"<div>{''.join(tables)}</div>"


def counted(file):
    if file.explained:
        return (f"{file.explained + file.differing:,} of {file.compared:,}, of which the cause leaves "
                f"{file.differing:,}")
    return "" if file.shown_count is None else f"{file.shown_count:,} of {file.compared:,}"
