#!/usr/bin/env python3
"""Completion in a real bash: of commands, their options and the words after them, and of the keys a user
types.

usage: completion_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import select
import shutil
import subprocess
import time
import unittest

from toolbox import BIN, TOOLS, ToolTest

PREFIX = BIN.parent
COMPLETION = PREFIX / "share/bash-completion/completions/pipeline"
COMMANDS = sorted(os.listdir(PREFIX / "libexec/pipeline"))
# Prints what bash has as COMPREPLY for the line whose words are the arguments; the last one is being typed.
ASK = """
source "$0"; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1))
_pipeline; printf '%s\\n' "${COMPREPLY[@]}"
"""


def bash(line, *words, **settings):
    done = subprocess.run(["bash", "--norc", "--noprofile", "-c", line, *words], capture_output=True,
                          text=True, timeout=60, check=True, **settings)
    return done.stdout, done.stderr


def completed(*words):
    text, messages = bash(ASK, COMPLETION, *words)
    assert messages == "", messages
    return text.split()


class Words(unittest.TestCase):
    def test_the_first_word_is_a_command(self):
        self.assertEqual(sorted(completed("pipeline", "")),
                         sorted([*COMMANDS, "help", "env", "--help", "--version", "--licenses"]))
        self.assertEqual(completed("/some/bin/pipeline", "mo"), ["model"])
        self.assertEqual(completed("pipeline", "x"), [])

    def test_help_is_about_commands_and_formats(self):
        self.assertEqual(completed("pipeline", "help", "s"), ["stages", "scene", "stage"])
        self.assertEqual(completed("pipeline", "help", "model", ""), [])

    def test_options_are_those_of_help(self):
        for command in COMMANDS:
            with self.subTest(command):
                words = [PREFIX / "libexec/pipeline" / command, "--help-all"]
                text = subprocess.check_output(words, text=True)
                lines = "\n".join(re.findall(r"^ {1,4}(-.*?)(?:  .*)?$", text, re.M))
                options = set(re.findall(r"(?:^|(?<=,)|(?<=, ))--?[a-z][a-z-]*", lines, re.M))
                self.assertEqual(set(completed("pipeline", command, "-")), options)

    def test_some_options_are_there(self):
        self.assertEqual(completed("pipeline", "zbuf", "config.txt", "--depth"),
                         ["--depth-image", "--depth-array", "--depth", "--depth-epsilon"])
        self.assertEqual(completed("pipeline", "compare", "--ha"), ["--hand-in"])
        self.assertEqual(completed("pipeline", "inspect", "--t"), ["--theirs", "--trace", "--threshold"])

    def test_the_words_of_an_option(self):
        self.assertEqual(completed("pipeline", "project", "--clip", ""),
                         ["auto", "near", "frustum", "reject", "none"])
        self.assertEqual(completed("pipeline", "explain", "a", "b", "--coverage", "c"), ["center"])
        self.assertEqual(completed("pipeline", "model", "--digits", ""), ["exact"])
        self.assertEqual(completed("pipeline", "zbuf", "--shading", "=", "g"), ["gouraud"])
        self.assertEqual(completed("pipeline", "zbuf", "--shading", "="),
                         ["none", "flat", "gouraud", "phong"])

    def test_files_are_left_to_bash(self):
        for words in (["zbuf", "--image", ""], ["model", ""], ["stages", "s"], ["zbuf", "--", "-"], [
                "zbuf", "--threads", ""], ["unknown", ""]):
            self.assertEqual(completed("pipeline", *words), [], words)

    def test_short_names_complete_only_where_they_are_ours(self):
        lines = 'source "$0"; complete -p', 'eval "$("$1/bin/pipeline" env)"; source "$0"; complete -p'
        ours = [re.findall(r"_pipeline (\S+)$", bash(line, COMPLETION, PREFIX)[0], re.M) for line in lines]
        self.assertEqual([sorted(names) for names in ours], [["pipeline"], sorted([*COMMANDS, "pipeline"])])
        self.assertEqual(completed("project", "--cull", ""), ["back", "front"])
        for tool in TOOLS:
            self.assertIn("--stats", completed(tool, "--"))


class OtherShells(unittest.TestCase):
    CASES = {
        "pipeline pro": {"project"}, "pipeline help sc": {"scene"},
        "pipeline zbuf --samples ": set(), "pipeline project --clip ": {
            "auto", "near", "frustum", "reject", "none"}, "pipeline zbuf --depth-i": {"--depth-image"}}

    @unittest.skipUnless(shutil.which("fish"), "fish is missing")
    def test_fish_completes_the_same(self):
        script = f"source {PREFIX}/share/fish/vendor_completions.d/pipeline.fish; complete -C $argv[1]"
        for line, expected in self.CASES.items():
            done = subprocess.run(["fish", "--no-config", "-c", script, line], capture_output=True, text=True)
            found = {line.split("\t")[0] for line in done.stdout.splitlines()}
            self.assertEqual((found, done.stderr), (expected, ""))

    @unittest.skipUnless(shutil.which("zsh"), "zsh is missing")
    def test_zsh_completes_the_same(self):
        """With the words that its function adds in place of a terminal."""
        script = """compadd() { shift; printf '%s\\n' "$@" }; _files() { }; compset() { }
words=(${(s: :)1}); [[ $1 != *' ' ]] || words+=(''); CURRENT=$#words PREFIX=$words[-1]; source $2"""
        file = PREFIX / "share/zsh/vendor-completions/_pipeline"
        for line, expected in self.CASES.items():
            words = ["zsh", "-f", "-c", script, "zsh", line, file]
            done = subprocess.run(words, capture_output=True, text=True)
            found = {word for word in done.stdout.split() if word.startswith(line.rpartition(" ")[2])}
            self.assertEqual((found, done.stderr), (expected, ""))


class Keys(ToolTest):
    """The Tab key in a terminal."""
    def setUp(self):
        super().setUp()
        try:
            self.master, terminal = os.openpty()
        except OSError as error:
            self.skipTest(f"no terminal: {error}")
        self.bash = subprocess.Popen(["bash", "--norc", "--noprofile", "-i"], stdin=terminal, stdout=terminal,
                                     stderr=terminal, start_new_session=True, env={
                                         "PATH": "/usr/bin:/bin", "TERM": "dumb", "PS1": "> ",
                                         "HOME": os.getcwd()})
        os.close(terminal)
        pathlib.Path("some scene.txt").touch()
        self.typed(
            f"bind 'set enable-bracketed-paste off'; pipeline() {{ printf '<%s>' \"$@\"; echo; }}; source "
            f"'{COMPLETION}'; echo rea''dy\n", "ready")

    def tearDown(self):
        self.bash.kill()
        self.bash.wait()
        os.close(self.master)
        super().tearDown()

    def typed(self, keys, until):
        """The terminal's text after the keys, up to the words `until`."""
        os.write(self.master, keys.encode())
        shown, end = "", time.monotonic() + 30
        while until not in shown.replace("\r", ""):
            self.assertLess(time.monotonic(), end, f"expected {until!r}, found {shown!r}")
            if select.select([self.master], [], [], 1)[0]:
                shown += os.read(self.master, 4096).decode()
        return shown

    def test_tab_completes_command_option_and_word(self):
        self.typed("pipeline pro\t--cu\tba\t\n", "<project><--cull><back>\n")

    def test_tab_completes_behind_an_equals_sign(self):
        self.typed("pipeline zbuf --coverage=c\t\n", "<zbuf><--coverage=center>\n")

    def test_tab_completes_files_with_blanks(self):
        self.typed("pipeline model som\t\n", "<model><some scene.txt>\n")
        self.typed("pipeline view --scene som\t--bare\n", "<view><--scene><some scene.txt><--bare>\n")

    def test_tab_completes_in_a_pipe(self):
        self.typed("true | pipeline vi\t--look 1 2 3\n", "<view><--look><1><2><3>\n")

    def test_tab_offers_nothing_for_a_number(self):
        self.typed("pipeline zbuf --samples \t4\n", "<zbuf><--samples><4>\n")


if __name__ == "__main__":
    unittest.main()
