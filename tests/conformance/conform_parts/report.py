"""What a run has shown: TAP and a table on stdout, JSON in a file."""
import json
from collections import namedtuple

from .cases import ASSIGNMENT, BYTES, EXTENSIONS, LOOKS, REFUSALS

GROUPS = (ASSIGNMENT, BYTES, REFUSALS, LOOKS, EXTENSIONS)
# state: right, wrong, open (not counted; `difference` tells whether it is right), left out (`reason` tells
# why); group: one of GROUPS
Result = namedtuple("Result", "case state difference reason group", defaults=(None, None, ASSIGNMENT))
Heading = namedtuple("Heading", "names results title",
                     defaults=("no mistake of the list", ))  # mistakes that cannot be told apart, or none


def tap_lines(number, result):
    case, difference = result.case, result.difference
    if result.state == "left out":
        return [f"ok {number} - {case.name} # SKIP {result.reason}"]
    directive = f" # TODO open: {result.reason}" if result.state == "open" else ""
    lines = [f"{'not ok' if difference else 'ok'} {number} - {case.name}{directive}"]
    if difference:
        lines += [f"#   why: {case.why}", *difference_lines(difference)]
    return lines


def difference_lines(difference):
    lines = [f"#   {difference.message}"]
    for name, text in (("expected", difference.expected), ("found", difference.found)):
        rows = text.split("\n")
        lines += [f"#   {name + ':':9} {rows[0]}", *("#             " + row
                                                     for row in rows[1:])] if text else []
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
    caught_by = {}
    for result in judged:
        for mistake in result.case.words("catches"):
            caught_by.setdefault(mistake, set()).add(result.case.name)
    excused = {mistake for result in failing.values() for mistake in result.difference.excuses}
    suspects = {mistake: cases for mistake, cases in caught_by.items()
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
        found.append(Heading(sorted(names),
                             [result for name, result in failing.items() if name in explained]))
        left -= explained
    for group in GROUPS:
        others = [result for name, result in failing.items() if name in left and result.group == group]
        if others:
            found.append(Heading([], others, *([] if group == ASSIGNMENT else [group])))
    return found


def table(results, mistakes):
    """The failing cases by mistake, each with the one of the shortest input, its reason, and what it expected
    and found."""
    lines = []
    wrong = [result.difference.other_rule for result in results if result.state == "wrong"]
    if wrong and wrong[0] and wrong.count(wrong[0]) == len(wrong):
        lines += ["#", f"# By --rule {wrong[0]} all of these are right."]
    for heading in headings(results):
        first = min(heading.results, key=lambda result: len(result.case.read("input.txt")))
        count = f"{len(heading.results)} case{'s' * (len(heading.results) > 1)}"
        lines += ["#", "# " + " or ".join(heading.names or [heading.title]) + ": " + count]
        lines += ["#   " + mistakes[name] for name in heading.names]
        lines += [
            f"#   first, by length: {first.case.name}", f"#   why: {first.case.why}",
            *difference_lines(first.difference)]
    return lines


def group_lines(results):
    """How many are right and wrong of what the cases ask for, if that is more than the assignment."""
    rows = [(group, [
        result
        for result in results
        if result.group == group and result.state in ("right", "wrong")])
            for group in GROUPS]
    rows = [(group, count(members, "right"), count(members, "wrong")) for group, members in rows if members]
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


def for_people(results, mistakes, note):
    """The verdict and a note, what explains it, and the verdict again, since the beginning of a long text is
    soon out of sight."""
    why = [line[2:] for line in [*table(results, mistakes), *group_lines(results)]]
    return [verdict(results), note, *why, "", verdict(results)] if why else [verdict(results), note]


def as_json(results, terms, mistakes):
    def entry(result):
        case, difference = result.case, result.difference
        return {
            "name":
                case.name, "state":
                    result.state, "group":
                        result.group, "why":
                            case.why, "paragraphs":
                                case.words("paragraphs"), "catches":
                                    case.words("catches"),
            **({"reason": result.reason} if result.reason else {}),
            **({"difference": {key: getattr(difference, key)
                               for key in ("message", "expected", "found")}} if difference else {})}

    return json.dumps(
        {
            "command": terms.command,
            "rule": terms.rule,
            "sandbox": not terms.box.reason,
            "counts": {state: count(results, state) for state in ("right", "wrong", "open", "left out")},
            "groups": {
                    group: {
                        state: sum(result.state == state for result in results if result.group == group)
                        for state in ("right", "wrong")}
                    for group in GROUPS},
            "mistakes": [{
                        "names": heading.names,
                        "sentences": [mistakes[name] for name in heading.names],
                        "cases": [result.case.name for result in heading.results],
                    }
                         for heading in headings(results)],
            "cases": [entry(result) for result in results],
        }, indent=1) + "\n"
