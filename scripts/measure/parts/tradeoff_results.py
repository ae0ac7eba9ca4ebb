"""The measured numbers of scripts/measure/tradeoff, and which settings another one beats."""
from parts.measuring import read_csv

COST_COLUMNS = ("cpu_seconds", "wall_seconds", "instructions", "bytes", "mib")
TIMES = ("cpu_seconds", "wall_seconds")
ERROR_COLUMNS = ("vertex_error_pixels", "flipped_pixels", "wrong_pixels", "neighbor_pixels",
                 "off_center_pixels", "depth_error_median", "depth_error_max")
TOLERANCE = dict.fromkeys(COST_COLUMNS, 0.03)  # smaller differences are none


class Results:
    """The rows of tradeoff.csv and epsilon.csv: cell(scene, setting, column) is a number, or None if not
    measured."""

    def __init__(self, rows, epsilon_rows):
        self.rows = {(row["scene"], row["setting"]): row for row in rows}
        self.epsilon = {(row["setting"], row["distance"]): row for row in epsilon_rows}
        self.scenes = list(dict.fromkeys(row["scene"] for row in rows))
        self.machine, self.counter = rows[0]["machine"], rows[0]["counter"]

    @classmethod
    def of(cls, folder):
        return cls(read_csv(folder / "tradeoff.csv"), read_csv(folder / "epsilon.csv"))

    def settings(self, scene):
        return [setting for name, setting in self.rows if name == scene]

    def cell(self, scene, setting, column):
        text = self.rows.get((scene, setting), {}).get(column)
        return float(text) if text else None

    def words(self, scene, column):
        return self.rows[scene, "default"][column]

    def per_triangle(self, scene, setting, column):
        value = self.cell(scene, setting, column)
        return None if value is None else value / self.cell(scene, setting, "triangles")

    def share(self, scene, setting, *columns):
        """The sum of columns as a share of the covered pixels."""
        return sum(self.cell(scene, setting, column)
                   for column in columns) / self.cell(scene, setting, "covered_pixels")

    # Which setting beats which

    def compared(self, scene, one, other, column):
        """-1 if the first setting is better, 1 if it is worse, 0 if they are the same, None if one was not
        measured. Times differ only if their quartiles do not overlap."""
        a, b = (self.cell(scene, setting, column) for setting in (one, other))
        if a is None or b is None:
            return None
        if column in TIMES:
            (a_low, a_high), (b_low, b_high) = ([self.cell(scene, s, f"{column}_{q}")
                                                 for q in ("q1", "q3")]
                                                for s in (one, other))
            if a_high >= b_low and b_high >= a_low:
                return 0
        if abs(a - b) <= TOLERANCE.get(column, 0) * max(abs(a), abs(b)):
            return 0
        return -1 if a < b else 1

    def beats(self, one, other):
        """Whether a setting is nowhere worse than another, and somewhere better, in every column and scene in
        which both were measured."""
        columns = [(scene, column)
                   for scene in self.scenes
                   for column in COST_COLUMNS + ERROR_COLUMNS + ("difference_mean", )]
        verdicts = [self.compared(scene, one, other, column) for scene, column in columns]
        has_errors = any(
            self.compared(scene, one, other, column) is not None
            for scene, column in columns
            if column not in COST_COLUMNS)
        return has_errors and -1 in verdicts and 1 not in verdicts

    @property
    def judged(self):
        """The settings whose errors were measured, too."""
        found = [
            setting for scene, setting in self.rows if self.cell(scene, setting, "covered_pixels") is not None
            or self.cell(scene, setting, "difference_mean") is not None]
        return list(dict.fromkeys(found))

    def beaten(self):
        """{setting: those that beat it}"""
        judged = self.judged
        winners = {
            setting: [one for one in judged if one != setting and self.beats(one, setting)]
            for setting in judged}
        return {setting: ones for setting, ones in winners.items() if ones}
