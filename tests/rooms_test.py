#!/usr/bin/env python3
"""The rooms of libpipeline, tools, scripts and tests, and their arrows, match the maps: README.md in each.

usage: rooms_test.py SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import ast
import pathlib
import re
import sys
import tempfile
import unittest

from lib.maths.matrices import TRANSFORMS
from lib.text.scene import ARGUMENT_LINES, SETTINGS

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else sys.exit(__doc__)
LIBRARY = SOURCE / "libpipeline"
MAP = (LIBRARY / "README.md").read_text()
TOOLS = SOURCE / "tools"
TOOLS_MAP = (TOOLS / "README.md").read_text()
SCRIPTS = SOURCE / "scripts"
SCRIPTS_MAP = (SCRIPTS / "README.md").read_text()
OF_SEVERAL = ("measure", "maintain")  # folders of commands with `parts` in common
INCLUDE = r'^\s*#\s*include\s+"{}/(\w+)/([\w.]+)"'


def arrows_of(text):
    """{room: the rooms it may include} from a map's lines 'room -> room room'."""
    return {
        room: set(others.split())
        for room, others in re.findall(r"^    ([\w/]+) +->((?: +[\w/]+)*)$", text, re.MULTILINE)}


def sources(root):
    return sorted(path for path in root.rglob("*") if path.suffix in (".h", ".cpp"))


def wrong_includes(root, arrows, prefix):
    """A line for every include that no arrow allows."""
    return [
        f"{path.relative_to(root)} includes {room}/{name}, but there is no arrow {path.parent.name} "
        f"-> {room}" for path in sources(root)
        for room, name in re.findall(INCLUDE.format(prefix), path.read_text(), re.MULTILINE)
        if room != path.parent.name and room not in arrows.get(path.parent.name, ())]


def python_files(root):
    return sorted(
        path for path in root.rglob("*") if path.suffix == ".py"
        or not path.suffix and path.is_file() and path.read_bytes().startswith(b"#!/usr/bin/env python3"))


def imported_folders(path, root):
    """The folders below `root`, or beside a command, from which a Python file imports."""
    for node in ast.walk(ast.parse(path.read_text())):
        module = node.module or "" if isinstance(node, ast.ImportFrom) else next(
            (name.name for name in node.names), "") if isinstance(node, ast.Import) else ""
        if re.match(r"(lib|parts|\w+_parts)\b", module):
            name = module.replace(".", "/")
            yield name if (root / name).is_dir() or "/" not in name else name.rpartition("/")[0]


def wrong_imports(root, arrows):
    """A line for every import that no arrow allows. A room that has none is of one command, X or make-X for
    X_parts: that alone imports it, and both of them all rooms of lib. The rooms of a folder of commands are
    one."""
    wrong = []
    for path in python_files(root):
        place = path.relative_to(root)
        room = place.parts[0] if place.parts[0] in OF_SEVERAL else str(place.parent)
        own = f"{place.name.removeprefix('make-')}_parts" if room == "." else room
        for folder in imported_folders(path, root):
            is_own = folder == own or folder == "parts" and room in OF_SEVERAL
            if not is_own and folder not in arrows.get(room, [to for to in arrows if to.startswith("lib/")]):
                wrong.append(f"{place} imports {folder}")
    return wrong


def named_files(text):
    """{room: the names in backquotes before the colons of its lines} of a map's lists."""
    rooms = {}
    for room, names in re.findall(r"^(?:- `([\w/]+)/`|  - (`[^:]*`)):", text, re.MULTILINE):
        if room:
            rooms[room] = files = set()
        else:
            files.update(re.findall(r"`([a-z]\w*)`", names))
    return rooms


def circle(arrows):
    """Some rooms that form a cycle, or nothing."""
    def search(path):
        for room in sorted(arrows.get(path[-1], ())):
            if room in path:
                return path[path.index(room):] + [room]
            if found := search(path + [room]):
                return found
        return None

    return next((found for room in sorted(arrows) if (found := search([room]))), None)


class Rooms(unittest.TestCase):
    def test_the_map_names_every_room_and_no_other(self):
        rooms = {path.name for path in LIBRARY.iterdir() if path.is_dir()}
        self.assertEqual(set(arrows_of(MAP)), rooms)
        self.assertLessEqual(len(rooms), 10)

    def test_a_room_has_about_thirty_files_at_most(self):
        for room in arrows_of(MAP):
            self.assertLessEqual(len(list((LIBRARY / room).iterdir())), 31, room)

    def test_arrows_make_no_circle(self):
        self.assertIsNone(circle(arrows_of(MAP)))

    def test_picture_and_visibility_are_blind_to_each_other(self):
        arrows = arrows_of(MAP)
        self.assertNotIn("visibility", arrows["picture"])
        self.assertNotIn("picture", arrows["visibility"])

    def test_every_include_follows_an_arrow(self):
        self.assertEqual(wrong_includes(LIBRARY, arrows_of(MAP), "libpipeline"), [])

    def test_every_file_is_in_a_room(self):
        self.assertEqual([path.name for path in LIBRARY.iterdir() if path.suffix in (".h", ".cpp")], [])

    def test_the_library_needs_nothing_of_the_tools(self):
        for path in sources(LIBRARY):
            self.assertNotRegex(path.read_text(), r'#\s*include\s+["<](?:tools/|CLI/)', str(path))

    def test_the_map_names_every_file_in_its_room_and_no_other(self):
        self.assertEqual(named_files(MAP),
                         {room: {path.stem
                                 for path in sources(LIBRARY / room)}
                          for room in arrows_of(MAP)})

    def test_maps_fit_into_120_columns(self):
        for text in (MAP, TOOLS_MAP, SCRIPTS_MAP, (SOURCE / "tests/README.md").read_text()):
            self.assertEqual([line for line in text.splitlines() if len(line) > 120], [])


class ToolRooms(unittest.TestCase):
    def test_the_map_names_every_room_and_no_other(self):
        self.assertEqual(set(arrows_of(TOOLS_MAP)), {path.name for path in TOOLS.iterdir() if path.is_dir()})
        self.assertIsNone(circle(arrows_of(TOOLS_MAP)))

    def test_every_include_follows_an_arrow(self):
        self.assertEqual(wrong_includes(TOOLS, arrows_of(TOOLS_MAP), "tools"), [])

    def test_the_map_names_every_file_in_its_room_and_no_other(self):
        self.assertEqual(
            named_files(TOOLS_MAP),
            {room: {path.stem
                    for path in sources(TOOLS / room)}
             for room in arrows_of(TOOLS_MAP)})
        self.assertEqual([path.name for path in sources(TOOLS) if path.parent == TOOLS], [])


class ScriptRooms(unittest.TestCase):
    def test_the_map_names_every_file_in_its_room_and_no_other(self):
        rooms = {}
        for path in SCRIPTS.rglob("*"):
            if path.suffix in (".py", ".js", ".cpp", ".h") and path.name != "__init__.py":
                rooms.setdefault(str(path.parent.relative_to(SCRIPTS)), set()).add(path.stem)
        self.assertEqual(named_files(SCRIPTS_MAP), rooms)

    def test_every_import_follows_an_arrow(self):
        self.assertEqual(wrong_imports(SCRIPTS, arrows_of(SCRIPTS_MAP)), [])

    def test_arrows_make_no_circle(self):
        self.assertIsNone(circle(arrows_of(SCRIPTS_MAP)))


class Tests(unittest.TestCase):
    """The map of tests."""
    def test_the_map_names_every_folder_and_no_other(self):
        rows = (SOURCE / "tests/README.md").read_text().split("\n\n")[2]
        named = re.findall(r"`(\w+)`", "".join(re.findall(r"^- ([^:]*):", rows, re.MULTILINE)))
        folders = [path.name for path in SOURCE.glob("tests/*") if path.is_dir() and path.name[0] not in "_."]
        self.assertEqual(sorted(named), sorted(folders))


class Invariants(unittest.TestCase):
    """The map's promises about the whole code, as far as a text search can check them."""
    def assert_only_in(self, pattern, roots, allowed):
        found = {
            str(path.relative_to(SOURCE))
            for root in roots for path in sources(SOURCE / root)
            if re.search(pattern, re.sub(r"//[^\n]*", "", path.read_text()))}
        self.assertEqual(found, set(allowed))

    def test_nothing_but_tools_writes_to_stderr(self):
        self.assert_only_in(r"(?<!/dev/)\bstderr\b|std::cerr|\bperror\b|\bdprintf\b|\bsyslog\b",
                            ["libpipeline"], [])

    def test_nothing_but_tools_exits_or_reads_the_command_line(self):
        self.assert_only_in(r"\bargv\b|\b_?[eE]xit\(|std::abort\(", ["libpipeline"], [])

    def test_the_environment_is_read_in_one_place(self):
        self.assert_only_in(r"\bgetenv\b", ["libpipeline", "tools"], ["libpipeline/numbers/kernel_choice.h"])

    def test_cli11_is_named_in_one_source(self):
        self.assert_only_in(r"#include <CLI/", ["libpipeline", "tools"], ["tools/rim/command_line.cpp"])

    def test_only_text_knows_digits(self):
        self.assert_only_in(
            r"\b(?:from_chars|to_chars|strto\w+|ato[fil]|s\w*scanf|iostream|sstream|setlocale)\b",
            [f"libpipeline/{room}" for room in arrows_of(MAP) if room != "text"], [])

    def test_commands_of_scenes_are_the_same_everywhere(self):
        table = (LIBRARY / "scene/scene_commands.h").read_text()
        rows = re.findall(r'^ *{"(\w+)", CommandKind::\w+, (\d)', table, re.MULTILINE)
        self.assertEqual({word: int(lines) for word, lines in rows}, ARGUMENT_LINES)
        settings = re.findall(r'"(\w+)", CommandKind::(?:setting|of_material)', table)
        self.assertEqual(set(settings), set(SETTINGS))
        self.assertEqual(set(re.findall(r'"(\w+)", CommandKind::transform', table)), set(TRANSFORMS))
        dictionary = re.findall(r'^"(\w+)"', (SOURCE / "tests/fuzz/dictionary.txt").read_text(), re.MULTILINE)
        self.assertLessEqual(set(ARGUMENT_LINES), set(dictionary))


class Promises(unittest.TestCase):
    def test_every_test_and_file_the_map_names_is_there(self):
        tests = "\n".join(
            path.read_text() for path in (SOURCE / "tests").rglob("*") if path.suffix in (".cpp", ".txt"))
        for suite, name in re.findall(r"`(\w+)\.(\w+)`",
                                      MAP[MAP.index("## What always holds"):MAP.index("## Public headers")]):
            form = (rf"tools_test\({name} |\bTools\.{name} "
                    if suite == "Tools" else rf"TEST(?:_[FP])?\({suite},\s+{name}\)|\b{suite}\.{name}\b")
            self.assertTrue(re.search(form, tests), f"no test {suite}.{name}")
        for room, name in re.findall(r"`(\w+)/(\w+\.(?:h|cpp))`", MAP):
            self.assertTrue((LIBRARY / room / name).is_file() or (SOURCE / room / name).is_file(),
                            f"{room}/{name}")


class PublicHeaders(unittest.TestCase):
    def test_the_map_lists_those_that_cmake_lists(self):
        in_cmake = re.search(r"set\(PIPELINE_PUBLIC_HEADERS\n(.*?)\)",
                             (LIBRARY / "CMakeLists.txt").read_text(), re.DOTALL)[1].split()
        in_map = re.findall(r"`(\w+/\w+\.h)`", MAP[MAP.index("## Public headers"):])
        self.assertEqual(sorted(in_map), sorted(in_cmake))
        for header in in_cmake:
            self.assertTrue((LIBRARY / header).is_file(), header)


class TheTestItself(unittest.TestCase):
    def test_a_wrong_include_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for room, text in {
                    "low": '#pragma once\n#include "libpipeline/high/b.h"\n',
                    "high": '#include "libpipeline/low/a.h"\n'}.items():
                (root / room).mkdir()
                (root / room / f"{'a' if room == 'low' else 'b'}.h").write_text(text)
            self.assertEqual(wrong_includes(root, {"low": set(), "high": {"low"}}, "libpipeline"),
                             ["low/a.h includes high/b.h, but there is no arrow low -> high"])

    def test_a_wrong_import_is_named(self):
        with tempfile.TemporaryDirectory() as folder:
            root, head = pathlib.Path(folder), "#!/usr/bin/env python3\n"
            for name, text in {
                    "fly": head + "from fly_parts.pipe import run\nfrom lib.high import b\n",
                    "film": head + "def f():\n    from fly_parts import pipe\n", "make-fly": head,
                    "fly_parts/pipe.py": "import film_parts.path\nimport lib.low.a\n",
                    "film_parts/path.py": "", "lib/low/a.py": "from lib.high.b import c\nimport parts.x\n",
                    "lib/high/b.py": "from lib.low import a\n",
                    "measure/bench": head + "import parts.x\nfrom lib.low import a\n",
                    "measure/parts/x.py": "from parts import y\nfrom lib.high import b\n"}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            arrows = {"lib/low": set(), "lib/high": {"lib/low"}, "measure": {"lib/low"}}
            self.assertEqual(wrong_imports(root, arrows), [
                "film imports fly_parts", "fly_parts/pipe.py imports film_parts",
                "lib/low/a.py imports lib/high", "lib/low/a.py imports parts",
                "measure/parts/x.py imports lib/high"])

    def test_a_circle_is_found(self):
        self.assertEqual(circle({"a": {"b"}, "b": {"c"}, "c": {"b"}}), ["b", "c", "b"])
        self.assertIsNone(circle({"a": {"b", "c"}, "b": {"c"}, "c": set()}))


unittest.main()
