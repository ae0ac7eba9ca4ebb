"""Draws every pixel as exact arithmetic shows it: with 12 digits, and what these leave uncertain with all."""
import argparse
import os
import re
import sys
import tempfile
import textwrap

from lib.rim.command import shown
from lib.rim.output_file import expect_writable, write_file
from lib.running.pipe_tools import ToolFailure
from lib.showing.pictures import size_of, with_pixels_of

DIGITS = "12"  # of the first run; 7 take a tenth less, and leave pixels of most large pictures uncertain
MOST_LISTED = 100
FORMAT = re.compile(r"(bmp|ppm|png):|.*\.(bmp|ppm|png)\Z", re.DOTALL)


def refuse(parser, options):
    """Ends the program if there are options that --certain excludes."""
    samples = options.samples not in (None, "1")
    for is_given, option, reason in (
            (options.trace, "--trace", "zbuf tells which pixels are certain"),
            (samples, f"--samples {options.samples}", "a mean of samples is no triangle's color"),
            (options.stages is not None, "--stages", "the stages may run more than once"),
            (not FORMAT.match(options.output), f"-o {shown(options.output)}",
             "it takes a .png, .bmp or .ppm file")):
        if is_given:
            parser.error(f"{option} does not go with --certain: {reason}")


class Certainty:
    """What zbuf --certify tells: how many pixels there are, how many of them are uncertain, and the places of
    these, or of the first."""

    def __init__(self, path, width):
        with open(path) as file:
            _, certain, _, uncertain, *places = file.read().split()
        self.uncertain_count = int(uncertain)
        self.pixel_count = int(certain) + self.uncertain_count
        self.places = [row * width + column
                       for row, column in zip(map(int, places[::2]), map(int, places[1::2]))]

    @property
    def is_complete(self):
        return len(self.places) == self.uncertain_count

    def keep_certain(self, earlier):
        """Makes certain what an earlier run, whose list is complete, has called certain."""
        self.places = sorted({*earlier.places} & {*self.places}) if self.is_complete else earlier.places
        self.uncertain_count = len(self.places)


def draw_for_certain(options, draw):
    """Draws the picture, says how much of it is certain, and gives the notes of the last run; `draw` takes
    options, and gives notes."""
    is_stream = options.image == "-"
    if not is_stream:
        expect_writable(options.image)
    notes, certainty, picture = run(options, draw, DIGITS)
    most = DIGITS
    if certainty.uncertain_count:
        try:
            notes, again, drawn = run(options, draw, "exact")
        except ToolFailure as failure:
            notes.append(f"picture: note: no more digits than {DIGITS}: {failure}")
        else:
            most = "all"
            picture = with_pixels_of(picture, drawn, certainty.places) if certainty.is_complete else drawn
            if certainty.is_complete:
                again.keep_certain(certainty)
            certainty = again
    write_file("/dev/stdout" if is_stream else options.image, picture)
    print(told(certainty, size_of(picture)[0], most), file=sys.stderr if is_stream else sys.stdout)
    return notes


def run(options, draw, digits):
    """The notes, the Certainty and the picture file of a run with these digits."""
    kind = next(filter(None, FORMAT.match(options.output).groups()))
    with tempfile.TemporaryDirectory() as folder:
        image, report = os.path.join(folder, "image." + kind), os.path.join(folder, "certain.txt")
        of_run = {"output": image, "bounds": ["--bounds"], "digits": ["--digits", digits],
                  "certify": ["--certify", report]}
        notes = draw(argparse.Namespace(**{**vars(options), **of_run}))
        with open(image, "rb") as file:
            picture = file.read()
        return notes, Certainty(report, size_of(picture)[0]), picture


def told(certainty, width, digits):
    """What a user reads of a picture whose pixels are uncertain with so many `digits`."""
    count, places = certainty.uncertain_count, certainty.places[:MOST_LISTED]
    total = certainty.pixel_count
    text = f"{total - count:,} of {total:,} pixels are what exact arithmetic shows"
    if count == 0:
        return text
    listed = [f"{place % width},{place // width}" for place in places]
    more = f" and {count - len(listed):,} more" if count > len(listed) else ""
    return text + "\n" + textwrap.fill(
        f"undecided with {digits} digits, and drawn by the rules for ties (column,row): " + " ".join(listed) +
        more, 110)
