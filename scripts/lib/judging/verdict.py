"""The judge's verdict on a hand-in: a FileVerdict for each file, and from these the Verdict."""
import dataclasses

from lib.judging.mistakes import sentence

RIGHT = "right"
ANOTHER_RULE = "right by another rule"
WRONG = "wrong"
MISSING = "not handed in"
UNREADABLE = "unreadable"
TOO_FEW_DIGITS = "too few digits to judge"
UNDECIDED = "could not be judged"
BY_THE_RIGHT = "by the right numbers, which are not those of "  # begins a remark
FAILED = (WRONG, MISSING, UNREADABLE)
OPEN = (TOO_FEW_DIGITS, UNDECIDED)


@dataclasses.dataclass
class Cause:
    """A mistake that reproduces the numbers; `name` is empty if the list of mistakes lacks it."""
    name: str
    text: str
    detail: str = ""

    def __str__(self):
        return self.text.rstrip(".") + (f" ({self.detail})" if self.detail else "")


def cause_of(name, detail=""):
    return Cause(name, sentence(name), detail)


def cause_of_all(stage, names):
    """The cause of one mistake, or of several made together."""
    return joined([cause_of(f"{stage}/{name}") for name in names])


def joined(causes):
    """One or more Causes combined into one."""
    if len(causes) == 1:
        return causes[0]
    names = dict.fromkeys(cause.name for cause in causes if cause.name)
    return Cause(" and ".join(names), "; and: ".join(cause.text.rstrip(".") for cause in causes))


@dataclasses.dataclass
class FileVerdict:
    stage: str  # model, view, project, zbuf
    file: str  # as its author named it
    verdict: str  # one of the words above
    rule: str = ""  # the other rule, in words
    causes: list = dataclasses.field(default_factory=list)  # several if the numbers do not distinguish them
    remarks: list = dataclasses.field(default_factory=list)
    differing: int = None  # how many numbers or pixels
    compared: int = 0
    explained: int = 0  # how many more a cause explains
    largest: str = ""  # the largest difference, with its location
    first: str = ""  # the first one
    matrices: object = None  # a lib.judging.fit.Comparison
    places: list = dataclasses.field(default_factory=list)  # (row, column) of the pixels that differ
    worth: float = 1.0  # the share of a right file's points that another rule earns

    @property
    def shown_count(self):
        """How many differ; None if a cause explains every pixel, which leaves none."""
        return None if self.verdict == WRONG and self.differing == 0 else self.differing

    @property
    def counts(self):
        """The points that another rule earns, in words."""
        return "counts as right" if self.worth == 1 else f"earns {100 * self.worth:.4g} % of the points"

    @property
    def is_good(self):
        return self.verdict in (RIGHT, ANOTHER_RULE)

    @property
    def cause(self):
        """The causes as one phrase; empty if there is none."""
        return "either: " * (len(self.causes) > 1) + "; or: ".join(map(str, self.causes))


@dataclasses.dataclass
class Verdict:
    files: list

    @property
    def status(self):
        """0 right or by another rule, 1 wrong or not handed in, 2 could not be judged."""
        if any(file.verdict in FAILED for file in self.files):
            return 1
        return 2 if any(file.verdict in OPEN for file in self.files) else 0

    def of(self, stage):
        return [file for file in self.files if file.stage == stage]
