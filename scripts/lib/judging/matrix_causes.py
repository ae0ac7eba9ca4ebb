"""Why the points of view or project are those of another matrix."""
from lib.judging.forms import changed_elements, other_forms
from lib.judging.matrices import IDENTITY
from lib.judging.some_vertices import ALL_VERTICES
from lib.judging.verdict import Cause, cause_of, cause_of_all

MOST_PAIRS = 3
UNCHANGED = "The points are those of the stage before, unchanged"


class MatrixCauses:
    """Each way gives a list of (Cause, matrix, whether it divides), with more than one if the numbers cannot
    tell them apart. `mistakes` are (name, matrix, whether it divides), and so are `pairs` with two names;
    is_by(matrix, whether it divides, parts) tells whether those parts of the points (slices) are what the
    matrix makes of them."""

    def __init__(self, stage, right, mistakes, pairs, is_by):
        self.stage, (self.ours, self.divides), self.is_by = stage, right, is_by
        self.mistakes, self.pairs = mistakes, pairs

    def of_the_list(self, parts=ALL_VERTICES):
        """The mistakes with a name."""
        found = {}
        for name, m, is_divided in self.mistakes:
            if name not in found and self.is_by(m, is_divided, parts):
                found[name] = (cause_of(f"{self.stage}/{name}"), m, is_divided)
        return list(found.values())

    def of_the_form(self, parts=ALL_VERTICES):
        """The input unchanged, or what may have become of the matrix as a whole."""
        if self.is_by(IDENTITY, False, parts):
            return [(Cause("", UNCHANGED), IDENTITY, False)]
        found = {}
        for text, m, is_divided in other_forms(self.stage, self.ours, self.divides):
            if text not in found and self.is_by(m, is_divided, parts):
                found[text] = (Cause("", text), m, is_divided)
        return list(found.values())

    def of_two(self):
        """Two mistakes of the list at once; nothing if more than MOST_PAIRS would do."""
        found = [(cause_of_all(self.stage, pair), m, is_divided) for pair, m, is_divided in self.pairs
                 if m is not None and self.is_by(m, is_divided, ALL_VERTICES)]
        return found if len(found) <= MOST_PAIRS else []

    def of_an_element(self):
        """A row with the opposite sign, or one other element; nothing if several would do."""
        found = [(Cause("", text), m, self.divides)
                 for text, m in changed_elements(self.stage, self.ours)
                 if self.is_by(m, self.divides, ALL_VERTICES)]
        return found if len(found) == 1 else []
