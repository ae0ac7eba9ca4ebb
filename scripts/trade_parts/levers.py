"""The settings that are worth comparing: one lever at a time."""
import dataclasses

from lib.running.pipe import DEFAULT, exact

DIGITS = ("5", "7", "9", "12", "exact")
LEVERS = (
    {"precision": "double"},
    {"clip": "frustum"},
    {"clip": "reject"},
    {"cull": "back"},
    {"clip": "reject", "cull": "back"},
    {"depth": "f32"},
    {"depth": "u24"},
    {"depth_epsilon": "1e-6"},
    {"shading": "flat"},
    {"shading": "gouraud"},
)
DEAR_LEVERS = ({"samples": "2"},)
CERTAIN = {"digits": "12", "certify": "-"}  # as picture --certain begins
SAMPLINGS = ("basic", "jittered", "adaptive")  # of trace, which has no coverage rule


def settings(rule, with_dear=False, without=()):
    """The settings with the rule `rule`, lever by lever, then some with the other rule. `without` are the
    levers that the user has set."""
    base = dataclasses.replace(DEFAULT, coverage=rule)
    yield from (dataclasses.replace(base, digits=digits) for digits in DIGITS)
    for lever in LEVERS + DEAR_LEVERS * with_dear:
        if not set(lever) & set(without):
            yield dataclasses.replace(base, **lever)
    if rule == "center" and not without:
        yield dataclasses.replace(base, **CERTAIN)
    yield from (dataclasses.replace(DEFAULT, sampling=sampling) for sampling in SAMPLINGS * with_dear)
    if rule != DEFAULT.coverage:
        yield from (DEFAULT, exact(DEFAULT.coverage))
