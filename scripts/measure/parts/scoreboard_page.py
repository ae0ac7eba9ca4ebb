"""The generated scoreboard in docs/algorithms.md, and its pictures."""
import os

from . import scoreboard_pictures


def stage_words(counts):
    """The table of the stages."""
    lines = ["| program | right | wrong | left out | open |", "|---|--:|--:|--:|--:|"]
    lines += [
        f"| `{name}` | {count['right']} | {count['wrong']} | {count['left out']} | {count['open']} |"
        for name, count in counts.items()]
    return "\n".join(lines) + "\n"


def words(scores, cases, page, pictures):
    """The table, what each rasterizer promises, and its worst failure; the pictures are written."""
    tilings = [case for case in cases if case.is_tiling]
    lines = [
        f"{len(cases)} cases, {sum(len(case.triangles) for case in cases)} triangles; {len(tilings)} of the "
        f"cases are tilings.",
        "",
        "| rasterizer | owners asked for | gaps | twice | centers | missed | extra | by rounding | depths "
        "| wrong |",
        "|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|"]
    lines += [row(score) for score in scores.values()]
    for name, score in scores.items():
        lines += ["", f"**{score.name}** ({score.version}). Promise: {score.promise}"]
        worst = scoreboard_pictures.worst_case(score.failures)
        if worst:
            path = pictures / f"scoreboard-{name}.png"
            path.write_bytes(scoreboard_pictures.drawn(worst, score.masks[worst], score.failures[worst]))
            lines += [
                "", f"![{caption(score.failures[worst])}]({os.path.relpath(path, page.parent)})", "",
                f"`{worst.name}`: {caption(score.failures[worst])}"]
    return "\n".join(lines) + "\n\n"


def row(score):
    coverage = ["-"] * 4 if score.is_antialiased else [score.inside, score.missed, score.extra, score.rounded]
    depths = [score.compared, score.wrong_depths] if score.has_depth else ["-"] * 2
    return (
        f"| {' | '.join(map(str, (score.name, score.owners, score.gaps, score.twice, *coverage, *depths)))} |"
    )


def caption(failures):
    counts = {kind: list(failures.values()).count(kind) for kind in scoreboard_pictures.COLORS}
    phrases = {
        "gap": "that no triangle has", "twice": "that two or more have", "moved": "of the wrong triangle",
        "missed": "that a triangle misses", "extra": "that a triangle has beyond its edges"}
    parts = [f"{count} pixel{'s' * (count > 1)} {phrases[kind]}" for kind, count in counts.items() if count]
    return " and ".join([", ".join(parts[:-1]), parts[-1]] if len(parts) > 1 else parts) + "."
