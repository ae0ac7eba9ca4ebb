"""The hand-ins in a folder, and the files that each has for a test."""
import dataclasses
import hashlib
import os
import re

from grade_parts.contents import SUFFIXES, UNREAD, ContentsError, without_suffix
from lib.judging.hand_in import KINDS, File, fitting_names, plain
from lib.rim.command import shown
from lib.rim.input_file import InputError, input_errors

LONGEST_LABEL = 60
# The ways to name a folder after a test: by its name, by its name in upper or lower case, or by its number
# alone. The first way that fits a folder of the hand-in is taken.
SHORT, LONG = r"(?:test|scene|case|task|sample|example|output|result)?(\d+)", r"(\d+).*"
NAMINGS = (lambda name, test: name == test, lambda name, test: plain(name) == plain(test),
           lambda name, test: number_of(name, SHORT) == number_of(test, LONG))


@dataclasses.dataclass
class HandIn:
    path: str
    number: int
    name: str  # as shown; the number if hand-ins have no names
    folder: str  # of its results


def find_hand_ins(folder, is_anonymous):
    """The HandIns of a folder, sorted by name, and the names of other files. Anonymous hand-ins are numbered
    in an order that hides the order of their names, the same in every run."""
    with input_errors(folder):
        entries = [(entry.name, entry.is_dir(follow_symlinks=False)) for entry in os.scandir(folder)
                   if not entry.name.startswith(".")]
    names = [name for name, is_folder in entries if is_folder or name.lower().endswith((*SUFFIXES, *UNREAD))]
    others = sorted(shown(name) for name, _ in entries if name not in set(names))
    names.sort(key=(lambda name: hashlib.sha256(os.fsencode(name)).digest()) if is_anonymous else os.fsencode)
    width, found = len(str(len(names))), []
    for number, name in enumerate(names, 1):
        digits, label = f"{number:0{width}}", shown(without_suffix(name))
        safe = re.sub(r"[^A-Za-z0-9._-]+", "_", label)[:LONGEST_LABEL]
        names_in_results = (f"hand-in {digits}", digits) if is_anonymous else (label, f"{digits}-{safe}")
        found.append(HandIn(os.path.join(folder, name), number, *names_in_results))
    return found, others


def number_of(name, pattern):
    """The number in a name that matches the pattern; the name itself if it does not."""
    found = re.fullmatch(pattern, plain(name), re.ASCII)
    return int(found[1]) if found else name


def folder_of(paths, test_name, is_only_test):
    """The folder of a test's files, as a tuple of names: the least deep one with the test's name, or for the
    only test any with such files. None if there is none."""
    folders = {}
    for *folder, name in paths:
        folders.setdefault(tuple(folder), []).append(name)
    by_naming = ([folder for folder in folders if folder and is_named(folder[-1], test_name)]
                 for is_named in NAMINGS)
    named = next(filter(None, by_naming), [])
    fitting = [folder for folder, names in folders.items()
               if any(fitting_names(names).values())] if is_only_test and not named else named
    return min(fitting, key=lambda folder: (len(folder), folder), default=None)


def looked_for(test, is_only_test):
    """The places where files_for looks, for a hand-in in which nothing is found."""
    names = [KINDS[kind][0] for kind in test.kinds]
    places = "in any one folder" if is_only_test else (
        f"in a folder {shown(test.name)}, or with its name before or behind theirs, as {shown(test.name)}-"
        f"{names[0]}")
    return f"{shown(test.name)}: nothing found; looked for {', '.join(names)} {places}"


def files_for(contents, test, is_only_test):
    """The Files by kind that a hand-in has for a test."""
    folder = folder_of(contents.paths, test.name, is_only_test)
    paths = {path[-1]: path for path in contents.paths if path[:-1] == folder}
    if folder is None:
        paths = flat_files(contents.paths, test.name)
    return {
        kind: file_of(contents, paths, fitting, kind, test.reference.limit(kind))
        for kind, fitting in fitting_names(paths).items() if kind in test.kinds}


def flat_files(paths, test_name):
    """{name: path} of files whose names begin or end with their test's name, which `name` lacks."""
    found, wanted = {}, plain(test_name)
    for path in sorted(paths, key=len, reverse=True):
        stem, suffix = os.path.splitext(path[-1])
        short = plain(stem)
        for rest in (short.removeprefix(wanted), short.removesuffix(wanted)):
            if rest not in ("", short):
                found[rest + suffix.lower()] = path
    return found


def file_of(contents, paths, fitting, kind, limit):
    if not fitting:
        return File(KINDS[kind][0])
    name, *others = fitting
    label, *others = (shown(word)[:LONGEST_LABEL] for word in (paths[name][-1], *others[:5]))
    file = File(label, others=tuple(others))
    try:
        return dataclasses.replace(file, data=contents.data(paths[name], limit))
    except MemoryError:
        raise
    except ContentsError as error:
        reason = str(error)
    except OSError as error:
        reason = error.strerror or "it cannot be read"
    except Exception as error:  # a member whose bytes are not what the archive says
        reason = f"it cannot be unpacked ({type(error).__name__})"
    return dataclasses.replace(file, error=InputError(file.name, reason))
