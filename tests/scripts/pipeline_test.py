#!/usr/bin/env python3
"""The command `pipeline` runs what lies in libexec/pipeline beside its folder, wherever that is and however
it is called.

usage: pipeline_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import contextlib
import os
import pathlib
import re
import shutil
import subprocess
import unittest

from toolbox import BIN, SOURCE, ToolTest

SAMPLE = SOURCE / "samples/worked-example"
PLAIN = {"PATH": "/usr/bin:/bin", "LANG": "C.UTF-8"}
# A command that shows its name and its arguments.
ECHO = """#!/bin/sh
# Shows its words. See --help.
printf '%s' "${0##*/}"; printf ' <%s>' "$@"; echo
"""
VERSION = """#!/bin/sh
case $1 in --help) printf 'Usage: model\\n\\nExample:\\n  model x\\n\\nRuns\\nthe commands.\\n\\n' ;; esac
echo "model (pipeline) 1.2.3"
"""


def run(program, *words, **settings):
    settings.setdefault("env", PLAIN)
    done = subprocess.run([program, *words], capture_output=True, text=True, timeout=60, **settings)
    return done.returncode, done.stdout, done.stderr


class Prefix(ToolTest):
    """A prefix with a blank, a quote and a dollar in its name, and commands that only show how they were
    called."""
    def setUp(self):
        super().setUp()
        self.prefix = pathlib.Path("it's a $HOME\n").resolve()
        self.commands = self.prefix / "libexec/pipeline"
        self.commands.mkdir(parents=True)
        (self.prefix / "bin").mkdir()
        self.pipeline = self.prefix / "bin/pipeline"
        shutil.copy(SOURCE / "tools/pipeline", self.pipeline)
        self.add("model", VERSION)
        self.add("show", ECHO)
        (self.commands / "lib").mkdir()
        (self.commands / "README").write_text("not a program")
        self.add("helper.py", ECHO)

    def add(self, name, text):
        (self.commands / name).write_text(text)
        (self.commands / name).chmod(0o755)

    def refuses(self, words, message):
        self.assertEqual(run(self.pipeline, *words), (2, "", f"pipeline: {message}\n"))

    def test_a_command_gets_its_arguments_and_gives_its_status(self):
        self.assertEqual(run(self.pipeline, "show", "a b", "", "*", "--help"),
                         (0, "show <a b> <> <*> <--help>\n", ""))
        self.add("fails", "#!/bin/sh\nexit 41\n")
        self.assertEqual(run(self.pipeline, "fails"), (41, "", ""))

    def test_a_command_added_later_is_known_and_listed(self):
        self.add("later", ECHO)
        self.assertEqual(run(self.pipeline, "later", "1"), (0, "later <1>\n", ""))
        self.assertIn("\nOther commands:\n  later        Shows its words\n", run(self.pipeline, "help")[1])

    def test_it_is_found_through_links_and_the_path(self):
        elsewhere = pathlib.Path("some where").resolve()
        elsewhere.mkdir()
        (elsewhere / "one").symlink_to(self.pipeline)
        (elsewhere / "pipeline").symlink_to("one")
        for program in (elsewhere / "one", elsewhere / "pipeline", "some where/pipeline"):
            self.assertEqual(run(program, "show", "1"), (0, "show <1>\n", ""), program)
        path = {"PATH": f"{elsewhere}:/usr/bin:/bin", "CDPATH": "/"}
        self.assertEqual(run("sh", "-c", "cd /; pipeline show 1", env=path), (0, "show <1>\n", ""))

    def test_help_lists_commands_and_nothing_else(self):
        status, text, messages = run(self.pipeline, "--help")
        self.assertEqual((status, messages), (0, ""))
        self.assertEqual(re.findall(r"^  ([a-z0-9-]+) {2,}(.*)$", text, re.M),
                         [("model", "Runs the commands"), ("show", "Shows its words")])
        self.assertEqual(run(self.pipeline, "help", env={**PLAIN, "POSIXLY_CORRECT": "1"}), (0, text, ""))
        self.assertEqual(run(self.pipeline), (2, "", text))

    def test_help_of_a_command_is_its_own(self):
        self.assertEqual(run(self.pipeline, "help", "show"), (0, "show <--help>\n", ""))
        self.assertTrue(run(self.pipeline, "help", "env")[1].startswith("Usage: pipeline COMMAND"))

    def test_help_of_a_paragraph_is_that_of_conform(self):
        self.refuses(["help", "Z5"], "expected a command, found 'Z5' (try pipeline help)")
        self.add("conform", ECHO)
        self.assertEqual(run(self.pipeline, "help", "Z5"), (0, "conform <--paragraph> <Z5>\n", ""))
        self.refuses(["help", "Z5", "x"], "expected no further word, found 'x' (try pipeline help)")

    def test_help_on_a_terminal_is_the_man_page(self):
        page = self.prefix / "share/man/man1/pipeline-show.1.gz"
        page.parent.mkdir(parents=True)
        page.touch()
        folder = pathlib.Path("programs").resolve()
        folder.mkdir()
        (folder / "man").write_text(ECHO)
        (folder / "man").chmod(0o755)
        path = {"PATH": f"{folder}:/usr/bin:/bin"}
        man = f"man <-M> <{self.prefix}/share/man> <1> <pipeline-show>\n"
        self.assertEqual(self.on_terminal("show", env=path), man)
        self.assertEqual(run(self.pipeline, "help", "show", env=path), (0, "show <--help>\n", ""))
        page.unlink()
        self.assertEqual(self.on_terminal("show", env=path), "show <--help>\n")

    def on_terminal(self, command, **settings):
        """The output of `help` on a terminal."""
        try:
            master, terminal = os.openpty()
        except OSError as error:
            self.skipTest(f"no terminal: {error}")
        subprocess.run([self.pipeline, "help", command], stdin=subprocess.DEVNULL, stdout=terminal,
                       timeout=60, check=True, **settings)
        os.close(terminal)
        shown = b""
        with open(master, "rb", buffering=0) as screen, contextlib.suppress(OSError):  # the terminal is gone
            while piece := screen.read(1000):
                shown += piece
        return shown.decode().replace("\r", "")

    def test_help_about_a_format_is_its_page_or_its_document(self):
        message = f"expected the man page pipeline-scene(5) in {self.prefix}/share/man, and the program man"
        self.refuses(["help", "scene"], message.replace("\n", "?"))
        source = pathlib.Path("source").resolve()
        (source / "scripts").mkdir(parents=True)
        (self.commands / "stages").symlink_to(source / "scripts/stages")
        for top in (source, self.prefix / "share/doc/pipeline"):
            (top / "docs").mkdir(parents=True)
            (top / "docs/scene.md").write_text(f"# {top}\n")
            self.assertEqual(run(self.pipeline, "help", "scene"), (0, f"# {top}\n", ""))
        page = self.prefix / "share/man/man5/pipeline-scene.5"
        page.parent.mkdir(parents=True)
        page.touch()
        pathlib.Path("man").write_text(ECHO + "exit 0\n")  # also where it cannot write
        pathlib.Path("man").chmod(0o755)
        path = {"PATH": f"{os.getcwd()}:/usr/bin:/bin"}
        self.assertEqual(run(self.pipeline, "help", "scene", env=path),
                         (0, f"man <-M> <{self.prefix}/share/man> <5> <pipeline-scene>\n", ""))
        full = run("sh", "-c", '"$0" help scene > /dev/full', self.pipeline, env=path)
        self.assertEqual((full[0], full[2].splitlines()[-1]),
                         (1, "cat: write error: No space left on device"))

    def test_version_is_that_of_the_tools(self):
        self.add("model", '#!/bin/sh\necho "model (pipeline) 1.2.3"\n')
        self.assertEqual(run(self.pipeline, "--version"), (0, "pipeline 1.2.3\n", ""))

    def test_an_unknown_command_is_refused_with_the_nearest_word(self):
        for word, hint in (("shwo", "show"), ("sow", "show"), ("shows", "show"), ("hlep", "help"), ("modle",
                                                                                                    "model")):
            self.refuses([word],
                         f"expected a command, found '{word}' (did you mean {hint}?) (try pipeline help)")
        for name in ("check-stage", "make-chess", "make-torus"):
            self.add(name, ECHO)
        for word, hint in (("check", "check-stage"), ("make", "make-chess or make-torus"),
                           ("mak", "make-chess or make-torus")):
            self.refuses([word],
                         f"expected a command, found '{word}' (did you mean {hint}?) (try pipeline help)")
        for word in ("", "x", "ma", "-v", "--", "lib", "README", "helper.py", "../bin/pipeline", "x" * 5000,
                     "sho\\w", "sho\nw"):
            self.refuses([word, "1"], f"expected a command, found '{word}' (try pipeline help)".replace(
                "\n", "?"))
        self.refuses(["help", "shoe"],
                     "expected a command, found 'shoe' (did you mean show?) (try pipeline help)")

    def test_an_old_name_is_refused_with_the_new_one(self):
        for word, now in (("split", "cut-scene"), ("join", "join-seen")):
            self.refuses([word, "1"], f"expected a command, found '{word}' (now {now})")
            self.refuses(["help", word], f"expected a command, found '{word}' (now {now})")

    def test_a_tool_that_was_not_built_is_named(self):
        for tool in ("view", "trace"):
            self.refuses([tool],
                         f"no {tool} in {self.commands}: 'cmake --build --preset release' builds it".replace(
                             "\n", "?"))

    def test_further_words_are_refused(self):
        for words in (["--version", "x"], ["--help", "x"], ["env", "x"], ["help", "show", "x"]):
            self.refuses(words, "expected no further word, found 'x' (try pipeline help)")

    def test_a_copy_without_commands_is_refused(self):
        pathlib.Path("lone/bin").mkdir(parents=True)
        shutil.copy(self.pipeline, "lone/bin/pipeline")
        folder = pathlib.Path("lone/libexec/pipeline").resolve()
        message = f"pipeline: expected the commands in {folder}: link to this program instead of copying it\n"
        self.assertEqual(run("lone/bin/pipeline", "show"), (2, "", message))

    def test_env_puts_the_short_names_first(self):
        for path, then in (("/usr/bin:/bin", ":/usr/bin:/bin"), ("", "")):
            line = 'PATH=/usr/bin:/bin; text=$("$0" env); PATH=$1; eval "$text"; show "$PATH"'
            self.assertEqual(run("/bin/sh", "-c", line, self.pipeline, path),
                             (0, f"show <{self.commands}{then}>\n", ""))

    def test_env_refuses_a_folder_that_no_path_can_name(self):
        moved = pathlib.Path("a:b").resolve()
        self.prefix.rename(moved)
        message = f"pipeline: a PATH cannot name {moved}/libexec/pipeline: there is a colon in it\n"
        self.assertEqual(run(moved / "bin/pipeline", "env"), (2, "", message))


class BuildTree(ToolTest):
    """The commands as built."""
    def test_the_stages_make_the_sample(self):
        scene, config = SAMPLE / "scene.txt", SAMPLE / "config.txt"
        line = f'"$0" model "{scene}" | "$0" view | "$0" project | "$0" zbuf "{config}"'
        self.assertEqual(run("sh", "-c", line, BIN / "pipeline"),
                         (0, (SAMPLE / "z_buffer.txt").read_text(), ""))

    def test_scripts_use_the_tools_of_this_build(self):
        # Through a link and by the short name, without $BIN.
        self.assertEqual(run(BIN / "pipeline", "stages", SAMPLE / "scene.txt", SAMPLE / "config.txt", "five"),
                         (0, "", ""))
        self.assertEqual(pathlib.Path("five/stage3.txt").read_bytes(), (SAMPLE / "stage3.txt").read_bytes())
        line = ('eval "$("$0" env)" && compare --hand-in five "$1/scene.txt" "$1/config.txt" && command -v '
                'compare && command -v view')
        status, text, messages = run("sh", "-c", line, BIN / "pipeline", SAMPLE)
        self.assertEqual((status, messages), (0, ""))
        folder = BIN.parent / "libexec/pipeline"
        self.assertTrue(text.endswith(f"{folder}/compare\n{folder}/view\n"))

    def test_scripts_prefer_the_tools_beside_them_to_those_of_the_source_tree(self):
        folder = pathlib.Path("libexec/pipeline").resolve()
        folder.mkdir(parents=True)
        for name in ("stages", "inspect"):
            (folder / name).symlink_to(SOURCE / "scripts" / name)
        for tool in ("model", "zbuf"):
            (folder / tool).write_text("#!/bin/sh\necho 'the tool beside' >&2\nexit 3\n")
            (folder / tool).chmod(0o755)
        self.assertEqual(run(folder / "stages", SAMPLE / "scene.txt", SAMPLE / "config.txt", "five"),
                         (1, "", "stages: the tool beside\n"))
        self.assertEqual(run(folder / "inspect", SAMPLE / "scene.txt", SAMPLE / "config.txt"),
                         (1, "", "inspect: the tool beside\n"))

    def test_help_of_a_paragraph_shows_what_carries_it_out(self):
        status, text, messages = run(BIN / "pipeline", "help", "Z5")
        self.assertEqual((status, messages, text.splitlines()[0]), (0, "", "Z5, docs/stages.md"))
        for line in ("cases:\n  zbuf/on-centers-four-squares: ",
                     "in the reference:\n  tests/reference/reference.py:",
                     "in the sources:\n  libpipeline/coverage/center.cpp:"):
            self.assertIn("\n" + line, text)
        self.assertEqual(run(BIN / "pipeline", "help", "Z99")[0], 2)

    def test_every_command_has_a_short_description(self):
        text = run(BIN / "pipeline", "help")[1]
        self.assertLessEqual(max(map(len, text.splitlines())), 80)
        self.assertNotIn("Other commands", text)
        text = re.sub(r"\n {15}", " ", text)
        described = dict(re.findall(r"^  ([a-z0-9-]+) {2,}(.*)$", text, re.M))
        self.assertEqual(list(described)[:4], ["model", "view", "project", "zbuf"])
        self.assertEqual(set(described), set(os.listdir(BIN.parent / "libexec/pipeline")))
        for name, words in described.items():
            self.assertRegex(words, r"\A[A-Z][a-z]+s .{10,130}[^.]\Z", name)


if __name__ == "__main__":
    unittest.main()
