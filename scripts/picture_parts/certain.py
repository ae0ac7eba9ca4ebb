"""Draws every pixel as exact arithmetic shows it: first with 12 digits, then uncertain pixels with all
digits, and pixels that are still uncertain by exact_pixels."""
import argparse
import array
import dataclasses
import pathlib
import re
import sys
import tempfile
import textwrap

from lib.rim.command import CommandFailure, shown
from lib.rim.input_file import read_input, states
from lib.rim.output_file import expect_writable, own_descriptor, target_of, write_file
from lib.running.owners import owners_in
from lib.running.pipe_tools import ToolFailure
from lib.showing.pictures import size_of, with_pixels_of

DIGITS = "12"  # of the first run; 7 save a tenth of the time, but most large pictures have uncertain pixels
MOST_LISTED = 100
FORMAT = re.compile(r"(bmp|ppm|png):|.*\.(bmp|ppm|png)\Z", re.DOTALL)


def refuse(parser, options):
    """Ends the program if there are options that --certain excludes."""
    samples = options.samples not in (None, "1") and f"--samples {options.samples}"
    output = not FORMAT.match(options.output) and f"-o {shown(options.output)}"
    excluded = [(options.trace and "--trace", "zbuf tells which pixels are certain"),
                (samples, "a mean of samples is no triangle's color"),
                (options.stages is not None and "--stages", "the stages may run more than once"),
                (output, "it takes a .png, .bmp or .ppm file")]
    for option, reason in excluded:
        if option:
            parser.error(f"{option} does not go with --certain: {reason}")


class Certainty:
    """The report of zbuf --certify: the counts of all and of uncertain pixels, and the places of uncertain
    ones, or of the first."""
    def __init__(self, path, width):
        with open(path) as file:
            _, certain, _, uncertain, *places = file.read().split()
        self.uncertain_count = int(uncertain)
        self.pixel_count = int(certain) + self.uncertain_count
        self.places = [
            row * width + column for row, column in zip(map(int, places[::2]), map(int, places[1::2]))]

    @property
    def is_complete(self):
        return len(self.places) == self.uncertain_count

    def leave(self, places):
        """Keeps only the uncertain places that are in `places`; all of `places` if its own list is cut."""
        self.places = sorted({*places} & {*self.places}) if self.is_complete else places
        self.uncertain_count = len(self.places)


@dataclasses.dataclass
class Run:
    """One drawing, with some number of digits: its notes, certainty and picture file, and after a run with
    all digits the number of the triangle that each pixel shows, or -1."""
    digits: str
    notes: list
    certainty: Certainty
    picture: bytes
    owners: array.array = None

    @property
    def tried(self):
        return f"with {self.digits.replace('exact', 'all')} digits"


class CertainPicture:
    """A picture by options. `commands` returns the tools' command lines for options, `draw` runs them and
    returns their notes."""
    def __init__(self, options, tools, commands, draw):
        self.options, self.tools, self.commands, self.draw = options, tools, commands, draw
        self.kind = next(filter(None, FORMAT.match(options.output).groups()))
        self.files = [*[options.model] * (options.data is None), *filter(None, [options.config])]
        self.states = states(*self.files)

    def with_options(self, **changed):
        return argparse.Namespace(**{**vars(self.options), **changed})

    def run(self, digits):
        with tempfile.TemporaryDirectory() as folder:
            image, report, owners = (pathlib.Path(folder, name)
                                     for name in (f"image.{self.kind}", "certain.txt", "owners.npy"))
            is_last = digits != DIGITS
            notes = self.draw(
                self.with_options(output=image, bounds=["--bounds"], digits=["--digits", digits], certify=[
                    "--certify", report, *["--triangle-array", owners] * is_last]))
            self.expect_unchanged()
            picture = image.read_bytes()
            certainty = Certainty(report, size_of(picture)[0])
            return Run(digits, notes, certainty, picture, owners_in(owners) if is_last else None)

    def run_again(self, first):
        """A run with all digits that keeps the first's certain pixels; the first if a tool refuses."""
        try:
            run = self.run("exact")
        except ToolFailure as failure:
            first.notes.append(f"picture: note: no more digits than {first.digits}: {failure}")
            return first
        if first.certainty.is_complete:
            run.picture = with_pixels_of(first.picture, [(run.picture, first.certainty.places)])
            run.certainty.leave(first.certainty.places)
        return run

    def expect_unchanged(self):
        if states(*self.files) != self.states:
            raise CommandFailure(f"{shown(self.options.model)} or its config has changed while it was drawn: "
                                 "draw it again")

    def scene(self):
        """The bytes that model reads."""
        if self.options.is_scene:
            return read_input(self.options.model) if self.options.data is None else self.options.data
        first, *_ = self.commands(self.options)
        return self.tools.output(*first, stdin=self.options.data or b"")

    def config(self):
        if self.options.config:
            return read_input(self.options.config).decode("utf-8-sig", "replace")
        return self.options.size.replace("x", " ")

    def draw_text(self, text):
        """The picture file of a text of project, and the numbers of the triangles seen."""
        with tempfile.TemporaryDirectory() as folder:
            image, owners = pathlib.Path(folder, f"image.{self.kind}"), pathlib.Path(folder, "owners.npy")
            *_, words = self.commands(self.with_options(output=image, certify=["--triangle-array", owners]))
            self.tools.run(*words, stdin=text)
            return image.read_bytes(), owners_in(owners)


def draw_for_certain(options, *tools_and_calls):
    """Draws the picture, prints how much of it is certain, and returns the notes of the last run. The other
    arguments are for CertainPicture."""
    is_stream = options.image == "-" or own_descriptor(target_of(options.image)) == 1
    if not is_stream:
        expect_writable(options.image)
    drawing = CertainPicture(options, *tools_and_calls)
    run, tried = drawing.run(DIGITS), ""
    if run.certainty.uncertain_count:
        run = drawing.run_again(run)
    if run.certainty.uncertain_count:
        from picture_parts.decided import decide  # few pictures need it
        tried = decide(drawing, run)
    write_file("/dev/stdout" if is_stream else options.image, run.picture)
    print(told(run.certainty, size_of(run.picture)[0], tried), file=sys.stderr if is_stream else sys.stdout)
    return run.notes


def told(certainty, width, tried):
    """The line about a picture for its user; `tried` says how far uncertain pixels were tried."""
    count, places = certainty.uncertain_count, certainty.places[:MOST_LISTED]
    total = certainty.pixel_count
    text = f"{total - count:,} of {total:,} pixels are what exact arithmetic shows"
    if count == 0:
        return text
    listed = [f"{place % width},{place // width}" for place in places]
    more = f" and {count - len(listed):,} more" if count > len(listed) else ""
    return text + "\n" + textwrap.fill(
        f"undecided {tried}, and drawn by the rules for ties (column,row): " + " ".join(listed) + more, 110)
