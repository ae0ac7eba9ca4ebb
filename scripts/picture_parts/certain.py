"""Draws until every pixel is what exact arithmetic shows: with more and more digits, and keeps what is
certain."""
import argparse
import os
import re
import sys
import tempfile
import textwrap

from lib.rim.command import shown
from lib.rim.output_file import expect_writable, write_file
from lib.running.pipe_tools import ToolFailure
from lib.showing.pictures import blended, size_of, with_pixels_of

DIGITS = "7", "12", "exact"  # the default's first; 9 would cost as much as 12 and decide less
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
    """What zbuf --certify tells: how many pixels there are, how many of them are uncertain, and which, as a
    mask with the byte 255 for each, else 0; None if its list breaks off."""

    def __init__(self, path, width):
        with open(path) as file:
            _, certain, _, uncertain, *places = file.read().split()
        self.uncertain_count = int(uncertain)
        self.pixel_count = int(certain) + self.uncertain_count
        self.first = [row * width + column
                      for row, column in zip(map(int, places[::2]), map(int, places[1::2]))]
        self.mask = None
        if len(self.first) == self.uncertain_count:
            self.mask = bytearray(self.pixel_count)
            for place in self.first:
                self.mask[place] = 255


def draw_for_certain(options, draw):
    """Draws the picture, says how much of it is certain, and gives the notes of the last run; `draw` takes
    options, and gives notes."""
    is_stream = options.image == "-"
    if not is_stream:
        expect_writable(options.image)
    picture = left = None  # left: the mask of the pixels that are not certain yet, None for all
    for digits in DIGITS:
        try:
            notes, certainty, drawn = run(options, draw, digits)
        except ToolFailure as failure:
            if picture is None:
                raise
            notes.append(f"picture: note: no more digits than {most}: {failure}")
            break
        most = "all" if digits == DIGITS[-1] else digits
        picture = drawn if left is None else with_pixels_of(picture, drawn, left)
        if left is None:
            left = certainty.mask
        elif certainty.mask is not None:
            left = blended(bytes(len(left)), certainty.mask, left)
        if left is not None and not any(left):
            break
    write_file("/dev/stdout" if is_stream else options.image, picture)
    places = certainty.first if left is None else [place for place, byte in enumerate(left) if byte]
    count = certainty.uncertain_count if left is None else len(places)
    print(told(certainty.pixel_count, count, places, size_of(picture)[0], most),
          file=sys.stderr if is_stream else sys.stdout)
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


def told(pixel_count, count, places, width, digits):
    """What a user reads; `places` are those of the pixels uncertain with `digits`, or the first of them."""
    text = f"{pixel_count - count:,} of {pixel_count:,} pixels are what exact arithmetic shows"
    if count == 0:
        return text
    listed = [f"{place % width},{place // width}" for place in places[:MOST_LISTED]]
    more = f" and {count - len(listed):,} more" if count > len(listed) else ""
    return text + "\n" + textwrap.fill(
        f"undecided with {digits} digits, and drawn by the rules for ties (column,row): " + " ".join(listed) +
        more, 110)
