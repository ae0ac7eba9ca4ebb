"""The files of results: a CSV for the teacher, and for each hand-in the results.json of Gradescope."""
import csv
import io
import json
import os
import unicodedata

from grade_parts.summary import equal_files
from lib.judging.report import sentence
from lib.rim.command import shown

FORMULA = "=+-@"  # a spreadsheet takes a cell that begins so, in letters of any width, for a formula


def cell(text):
    text = shown(text)  # without control characters
    return "'" + text if unicodedata.normalize("NFKC", text.lstrip()[:1]).startswith(tuple(FORMULA)) else text


def number(x):
    return round(x, 4)


def csv_of(graded, tests):
    """The CSV of [(HandIn, Graded)], with the whole verdicts, whatever students may see."""
    equal = equal_files(graded)
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([
        "number", "hand-in", "score", "max_score", *(cell(test.name) for test in tests), "remarks",
        *(cell(test.name + " verdict") for test in tests)])
    for hand_in, result in graded:
        scores = [number(test.score) for test in result.tests] or [0.0] * len(tests)
        words = [cell(sentence(test.verdict)) for test in result.tests] or [""] * len(tests)
        changed = [f"{shown(test.name)}: {test.by_teacher}" for test in result.tests if test.by_teacher]
        remarks = cell("; ".join(result.remarks + changed + equal.get(hand_in.number, [])))
        of_all = map(number, (result.score, result.max_score))
        writer.writerow([hand_in.number, cell(hand_in.name), *of_all, *scores, remarks, *words])
    return out.getvalue().encode()


def numbers_csv(hand_ins):
    """The name for each number, as CSV."""
    out, names = io.StringIO(), (os.path.basename(hand_in.path) for hand_in in hand_ins)
    csv.writer(out, lineterminator="\n").writerows([[
        "number", "hand-in"], *([hand_in.number, cell(name)] for hand_in, name in zip(hand_ins, names))])
    return out.getvalue().encode()


def words_of(test):
    """A test's report for its student."""
    return "\n".join([test.words, *test.fixes, *[test.by_teacher] * bool(test.by_teacher)])


def gradescope(result, tests):
    """The bytes of results.json (Gradescope, Autograder specifications: output format)."""
    done = [(test, test.score, words_of(test)) for test in result.tests]
    rows = [{
        "name": shown(test.name), "score": number(score), "max_score": number(test.max_score),
        "output": words} for test, score, words in done or [(test, 0.0, result.failure) for test in tests]]
    text = {
        "score": number(result.score), "output": "\n".join(result.remarks), "output_format": "text",
        "tests": rows}
    return (json.dumps(text, indent=2, ensure_ascii=True) + "\n").encode()
