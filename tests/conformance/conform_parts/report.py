"""The results of a run: TAP and a table on stdout, JSON and JUnit's XML in files."""
import json
import re
from collections import namedtuple

from . import shared
from .cases import ASSIGNMENT, BYTES, EXTENSIONS, LOOKS, REFUSALS
from .paragraph import way_to

GROUPS = (ASSIGNMENT, BYTES, REFUSALS, LOOKS, EXTENSIONS)
# state: right, wrong, open (not counted; `difference` tells whether it is right), left out (`reason` tells
# why); group: one of GROUPS
Result = namedtuple("Result", "case state difference reason group", defaults=(None, None, ASSIGNMENT))
Heading = namedtuple("Heading", "names results title",
                     defaults=("no mistake of the list",))  # mistakes that cannot be told apart, or none
MOST_NAMES = 3  # that are named together: more say nothing
MOST_OTHERS = 2  # cases that are named beside the first
LEAST_LIKE = 0.4  # of the cases that fail or catch a mistake, those that do both, if it is named as a guess


def tap_lines(number, result):
    case, difference = result.case, result.difference
    if result.state == "left out":
        return [f"ok {number} - {case.name} # SKIP {result.reason}"]
    directive = f" # TODO open: {result.reason}" if result.state == "open" else ""
    lines = [f"{'not ok' if difference else 'ok'} {number} - {case.name}{directive}"]
    if difference:
        lines += [paragraph_line(case), f"#   why: {case.why}", *difference_lines(difference)]
    return lines


def paragraph_line(case):
    labels = case.words("paragraphs")
    return f"#   paragraph{'s' * (len(labels) > 1)}: {', '.join(labels)}{way_to(labels[0])}"


def difference_lines(difference):
    lines = [f"#   {difference.message}"]
    for name, text in (("expected:", difference.expected), ("found:   ", difference.found)):
        lines += f"#   {name} {text}".replace("\n", "\n#" + 13 * " ").split("\n") if text else []
    return lines


def headings(results):
    """The failing cases by the mistake that explains them: the cases that catch it fail, but for one in
    twenty, no output is another than it gives, and it explains the most of the cases that are left. Where
    several do so alike, all are named. The last headings have no name: what no mistake explains, by group,
    and everything if every case fails. The first one, where there is any, has the cases in which the program
    failed: they say nothing about its numbers."""
    failed = [result for result in results if result.state == "wrong" and result.difference.is_failure]
    judged = [result for result in results if result.state in ("right", "wrong") and result not in failed]
    failing = {result.case.name: result for result in judged if result.state == "wrong"}
    caught_by = cases_by_mistake(judged)
    excused = {mistake for result in failing.values() for mistake in result.difference.excuses}
    suspects = {
        mistake: cases
        for mistake, cases in caught_by.items()
        if mistake not in excused and len(cases - failing.keys()) <= len(cases) // 20}
    left, found = set(failing), [Heading([], failed, "the program failed")] if failed else []
    while len(failing) < len(judged) or len(judged) == 1:
        most = max((len(cases & left) for cases in suspects.values()), default=0)
        names = [mistake for mistake, cases in suspects.items() if most and len(cases & left) == most]
        fewest = min((len(suspects[name]) for name in names), default=0)
        names = [name for name in names if len(suspects[name]) == fewest]
        if not names:
            break
        explained = suspects[names[0]] & left
        names = [name for name in names if suspects[name] & left == explained]
        if len(names) > MOST_NAMES:
            break
        found.append(Heading(sorted(names),
                             [result for name, result in failing.items() if name in explained]))
        left -= explained
    for group in GROUPS:
        others = [result for name, result in failing.items() if name in left and result.group == group]
        if others:
            found.append(Heading([], others, *([] if group == ASSIGNMENT else [group])))
    return found


def cases_by_mistake(results):
    caught_by = {}
    for result in results:
        for mistake in result.case.words("catches"):
            caught_by.setdefault(mistake, set()).add(result.case.name)
    return caught_by


def without_a_mistake(results):
    """Those whose wrong output no mistake explains; no refusals, whose messages may name folders."""
    return [
        result for heading in headings(results) if not heading.names for result in heading.results
        if not result.difference.is_failure and result.case.refused_line is None]


def most_like(heading, results):
    """The mistakes whose cases are most nearly those that fail for no mistake of the list: a guess, or
    none."""
    if heading.names or all(result.difference.is_failure for result in heading.results):
        return []
    failing = {result.case.name for result in heading.results}
    judged = [result for result in results if result.state in ("right", "wrong")]
    likeness = {
        mistake: len(cases & failing) / len(cases | failing)
        for mistake, cases in cases_by_mistake(judged).items()}
    most = max(likeness.values(), default=0)
    names = [name for name in likeness if likeness[name] == most >= LEAST_LIKE]
    return names if len(names) <= MOST_NAMES and len(failing) > 1 else []


def shared_by_most(results):
    """A sentence on what most of the wrong numbers share; empty if nothing."""
    wrong = [result.difference for result in results if result.state == "wrong"]
    return shared.sentence([point for difference in wrong for point in difference.points])


def table(results, mistakes, chance):
    """The failing cases by mistake, each with the one of the shortest input, its reason, and what it expected
    and found; before them, what most share, and the sentence `chance`."""
    known = [*filter(None, (chance, shared_by_most(results)))]  # beside which there is nothing to guess
    lines = [line for sentence in known for line in ("#", f"# {sentence}")]
    wrong = [result.difference.other_rule for result in results if result.state == "wrong"]
    if wrong and wrong[0] and wrong.count(wrong[0]) == len(wrong):
        lines += ["#", f"# By --rule {wrong[0]} all of these are right."]
    for heading in headings(results):
        first = min(heading.results, key=lambda result: len(result.case.read("input.txt")))
        count = f"{len(heading.results)} case{'s' * (len(heading.results) > 1)}"
        lines += ["#", "# " + " or ".join(heading.names or [heading.title]) + ": " + count]
        lines += ["#   " + mistakes[name] for name in heading.names]
        names = [] if known else most_like(heading, results)
        lines += [f"#   most like {name}: {mistakes[name]}" for name in names]
        lines += [
            f"#   first, by length: {first.case.name}",
            paragraph_line(first.case), f"#   why: {first.case.why}", *difference_lines(first.difference),
            *other_lines(heading.results, first)]
    return lines


def other_lines(results, first):
    """The cases beside the first, each with its paragraph."""
    others = [
        f"{result.case.name} ({result.case.words('paragraphs')[0]})" for result in results
        if result is not first]
    rest = [f"and {len(others) - MOST_OTHERS} more (--tap shows each)"] if len(others) > MOST_OTHERS else []
    return ["#   so do " + ", ".join(others[:MOST_OTHERS] + rest)] if others else []


def group_lines(results):
    """How many are right and wrong of what the cases ask for, if that is more than the assignment."""
    counted = [result for result in results if result.state in ("right", "wrong")]
    found = [(group, [result for result in counted if result.group == group]) for group in GROUPS]
    rows = [(group, count(members, "right"), count(members, "wrong")) for group, members in found if members]
    if [group for group, _, _ in rows] in ([], [ASSIGNMENT]):
        return []
    return [
        "#", f"# {'':30} right  wrong",
        *(f"# {group:30} {right:5}  {wrong:5}" for group, right, wrong in rows)]


def count(results, state):
    return sum(result.state == state for result in results)


def summary(results):
    """One line."""
    opened = [result for result in results if result.state == "open"]
    words = [f"{count(results, 'right')} right", f"{count(results, 'wrong')} wrong"]
    if opened:
        words.append(f"{len(opened)} open ({sum(not result.difference for result in opened)} right)")
    if count(results, "left out"):
        words.append(f"{count(results, 'left out')} left out")
    return "# " + ", ".join(words)


def verdict(results):
    """One sentence."""
    right, wrong = count(results, "right"), count(results, "wrong")
    others = len(results) - right - wrong
    if not right + wrong:
        return "no case was run and counted"
    counted = f"{right + wrong} case{'s' * (right + wrong > 1)}" + (f"; {others} did not count"
                                                                    if others else "")
    return f"WRONG: {wrong} of {counted}" if wrong else f"RIGHT: all of {counted}"


def for_people(results, mistakes, chance, note):
    """The verdict and a note, what explains it, and the verdict again, since the beginning of a long text is
    soon out of sight."""
    why = [line[2:] for line in [*table(results, mistakes, chance), *group_lines(results)]]
    return [verdict(results), note, *why, "", verdict(results)] if why else [verdict(results), note]


def as_json(results, terms, mistakes):
    def entry(result):
        case, difference = result.case, result.difference
        return {
            "name": case.name, "state": result.state, "group": result.group, "why": case.why,
            "paragraphs": case.words("paragraphs"), "catches": case.words("catches"),
            **({"reason": result.reason} if result.reason else {}),
            **({"difference": {key: getattr(difference, key)
                               for key in ("message", "expected", "found")}} if difference else {})}

    groups = {
        group: {
            state: sum(result.state == state for result in results if result.group == group)
            for state in ("right", "wrong")}
        for group in GROUPS}
    named = [{
        "names": heading.names, "sentences": [mistakes[name]
                                              for name in heading.names], "most like": most_like(
                                                  heading, results), "cases": [
                                                      result.case.name for result in heading.results]}
             for heading in headings(results)]
    return json.dumps(
        {
            "command": terms.command, "rule": terms.rule, "sandbox": not terms.box.reason, "counts": {
                state: count(results, state)
                for state in ("right", "wrong", "open", "left out")}, "shared": shared_by_most(results),
            "groups": groups, "mistakes": named, "cases": [entry(result)
                                                           for result in results]}, indent=1) + "\n"


def as_junit(results, stage):
    """The form of JUnit's reports that test runners read."""
    from xml.sax.saxutils import escape, quoteattr  # which loads a client of HTTP

    def legal(text):  # XML 1.0 has no other characters
        return re.sub("[^\t\n\r -\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]", "?", text)

    wrong, skipped = count(results, "wrong"), count(results, "open") + count(results, "left out")
    lines = [
        '<?xml version="1.0" encoding="UTF-8"?>', "<testsuites>",
        f'<testsuite name="{stage}" tests="{len(results)}" failures="{wrong}" errors="0" '
        f'skipped="{skipped}">']
    for result in results:
        case, end = result.case, ""
        if result.state == "wrong":
            text = "\n".join([
                f"{case.why} ({', '.join(case.words('paragraphs'))})",
                *(line[4:] for line in difference_lines(result.difference))])
            end = (f"<failure message={quoteattr(legal(result.difference.message))}>{escape(legal(text))}"
                   "</failure>")
        elif result.state != "right":
            end = f"<skipped message={quoteattr(legal(result.reason))}/>"
        lines.append(f'<testcase classname="{stage}" name="{case.short_name}">{end}</testcase>')
    return "\n".join([*lines, "</testsuite>", "</testsuites>", ""])
