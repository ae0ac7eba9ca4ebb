#!/usr/bin/env python3
"""scripts/check-stage: a program of one's own in the place of a stage.

usage: check_stage_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import signal
import subprocess
import unittest

from toolbox import BIN, SOURCE, ToolTest, has_bubblewrap, run_script

SCENE = ("3 4 7\n0.3 -0.2 0.1\n0.2 1 0.1\n50 1.3 1 50\ntriangle\n0 0 0\n1 0 0.3\n0 1 0\ntriangle\n0.5 0.2 "
         "-1\n1 0.7 0\n0 -1 0\nend\n")
SCENES = ("1-one-triangle", "2-camera", "3-transforms", "4-push-and-pop", "5-window", "6-hidden-surfaces")

# As root, without a sandbox where bubblewrap does not work.
MODE = "no" if os.geteuid() == 0 and not has_bubblewrap() else "auto"


def check(*words):
    """A finished run of check-stage; its stdout without the last line, on the sandbox, if there is one."""
    done = run_script("check-stage", "--sandbox", MODE, "--read", BIN, *words)
    done.stdout, done.note = re.fullmatch(r"((?s:.*?))((?:no|in a) sandbox.*\n)?", done.stdout).groups()
    return done


def script(text):
    """A program ./mine, in sh; `$BIN/view` is our own."""
    path = pathlib.Path("mine")
    path.write_text(f"#!/bin/sh\nBIN='{BIN}'\n{text}\n")
    path.chmod(0o755)
    return "./mine"


class Program(ToolTest):
    def setUp(self):
        super().setUp()
        pathlib.Path("scene").write_text(SCENE)
        pathlib.Path("config").write_text("60 50\n-0.5\n-0.5\n-1 1\n")

    def told(self, stage, text, *options, status=1):
        done = check(stage, "--scene", "scene", "--config", "config", *options, "--", script(text))
        self.assertEqual((done.returncode, done.stderr), (status, ""), done.stdout)
        return done.stdout

    def test_ours_are_right(self):
        for stage in ("model", "view", "project", "zbuf"):
            self.assertEqual(self.told(stage, f'exec "$BIN/{stage}" "$@"', status=0), "scene: right\n")

    @unittest.skipUnless(has_bubblewrap(), "no bubblewrap")
    def test_ours_are_found_only_if_they_are_named(self):
        os.mkdir("tools")
        for tool in ("model", "view", "project", "zbuf"):
            os.symlink(BIN / tool, f"tools/{tool}")
        environment = {**os.environ, "BIN": os.path.abspath("tools"), "PATH": f"{BIN}:{os.environ['PATH']}"}
        script("exec view")
        conform = SOURCE / "tests/conformance/conform", "--stage", "view", "--only", "background"
        for words, status in (["./mine"], 1), (["view"], 0), ([f"{BIN}/pipeline", "view"], 0):
            for command in (SOURCE / "scripts/check-stage", "view", "--scene", "scene"), conform:
                done = subprocess.run([*command, "--sandbox", "yes", "--", *words], env=environment,
                                      capture_output=True, text=True)
                self.assertEqual((done.returncode, done.stderr), (status, ""), (words, done.stdout))

    def test_root_runs_none_without_a_sandbox_unasked(self):
        os.symlink("/bin/false", "bwrap")
        environment = {**os.environ, "BIN": str(BIN), "PATH": f"{os.getcwd()}:{os.environ['PATH']}"}
        program = script('exec "$BIN/view"')
        reason = "bubblewrap does not work here: no reason given"
        refused = (
            f"{reason}, and without a sandbox a program would be run as root: --sandbox no does that with a "
            "program that you trust\n")
        conform = SOURCE / "tests/conformance/conform", "--stage", "view", "--only", "background"
        for command in (SOURCE / "scripts/check-stage", "view", "--scene", "scene"), conform:
            for mode, told in ("auto", reason), ("no", "--sandbox no"):
                words = [*command, "--sandbox", mode, "--", program]
                done = subprocess.run(words, env=environment, capture_output=True, text=True)
                if mode == "auto" and os.geteuid() == 0:
                    self.assertEqual((done.returncode, done.stdout, done.stderr),
                                     (2, "", f"{command[0].name}: {refused}"))
                else:
                    self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
                    self.assertIn(f"no sandbox ({told})\n", done.stdout)

    def test_ours_are_right_on_the_six_scenes(self):
        for stage in ("model", "zbuf"):
            *tried, others = check(stage, "--", BIN / stage).stdout.splitlines()
            self.assertEqual(tried, [f"{name}: right" for name in SCENES])
            self.assertRegex(others, "^not tried: parallel projections, ")

    def test_limits_that_are_ignored_are_found(self):
        for lines, ignored, words in ("2,3", "-1", "window's"), ("4", "-1 1", "depth"):
            program = f"sed '{lines}s/.*/{ignored}/' {{config}} > mine; exec {BIN}/zbuf mine"
            self.assertIn(f"  cause: The {words} limits are -1 and 1 in place of those of the config\n",
                          check("zbuf", "--", "sh", "-c", program).stdout)

    def test_comments_are_taken_out_unless_asked_for(self):
        pathlib.Path("scene").write_text("# a camera\n" + SCENE)
        words = "--scene", "scene", "--", "sh", "-c", f"tee text | {BIN}/model; ! grep -q '#' text {{scene}}"
        self.assertEqual(check("model", *words).stdout, "scene: right\n")
        self.assertIn("wrong: its exit status is 1", check("model", "--comments", *words).stdout)

    def test_watch_runs_again_when_the_program_has_changed(self):
        words = [
            SOURCE / "scripts/check-stage", "--sandbox", MODE, "--read", BIN, "view", "--scene", "scene",
            "--watch", "--",
            script("seq 1000 >&2; cat")]
        with subprocess.Popen(words, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                              env={**os.environ, "BIN": str(BIN)}) as process:
            told = [process.stdout.readline()]
            while "sandbox" not in told[-1]:
                told.append(process.stdout.readline())
            kept = pathlib.Path(re.search("all of it: (.*)\n", "".join(told))[1])
            self.assertTrue(kept.exists())
            script('exec "$BIN/view"')
            told += [process.stdout.readline() for _ in range(3)]
            process.send_signal(signal.SIGINT)
            self.assertIn("SIGINT", process.stderr.read())
        self.assertEqual(told[0], "scene: wrong\n")
        self.assertEqual(told[-3:], ["\n", "The program has changed.\n", "scene: right\n"])
        self.assertFalse(kept.exists())

    def test_a_sphere_is_refused_with_its_line(self):
        pathlib.Path("scene").write_text(SCENE.replace("end\n", "sphere 0 0 0 1\nend\n"))
        line = SCENE.count("\n")
        for stage in ("model", "view", "project", "zbuf"):
            done = check(stage, "--scene", "scene", "--config", "config", "--", BIN / stage)
            self.assertEqual(
                (done.returncode, done.stdout, done.stderr),
                (2, "",
                 f"check-stage: the scene is refused: model: <stdin>:{line}:1: expected triangles alone, "
                 "found a sphere: trace draws it, and model --facets N makes triangles of it\n"))

    def test_right_numbers_in_a_text_that_the_next_stage_refuses_are_wrong(self):
        told = self.told("view", 'cat > text; sed -n 1p text; exec "$BIN/view" text')
        self.assertRegex(
            told,
            r"^scene: wrong: its numbers are right, but project refuses it: line 1, column 1: .* must drop "
            r"the lines eye, look and up\n$")
        self.assertIn(
            "zbuf refuses it: line 1, column 1: expected the output of project, found 'perspective'",
            self.told("project", 'tee text | sed 2,999d; "$BIN/project" text'))

    def test_a_text_without_a_header_may_be_meant(self):
        bare = f'exec "$BIN/view" --bare --scene "{os.path.abspath("scene")}"'
        self.assertRegex(
            self.told("view", bare),
            r"^scene: wrong: its numbers are right, but project refuses it: .* \(--bare, if your stages go "
            r"without header lines\)\n$")
        self.assertEqual(self.told("view", bare, "--bare", status=0), "scene: right\n")

    def test_prints_between_the_vertices_are_wrong_and_counted(self):
        talk = """"$BIN/project" | awk 'NF { print "vertex", $1 } 1'"""
        told = self.told("project", talk)
        self.assertIn("scene: wrong: its numbers are right, but zbuf refuses it: line 1, column 1: ", told)
        self.assertRegex(
            told,
            r"\n  6 lines are neither a vertex nor a header line, 3 for each triangle: first line 1, 'vertex "
            r"-?[0-9.]+'\n$")
        scene = os.path.abspath("scene")
        self.assertIn(
            "scene: wrong: its numbers are right, but project refuses it: ",
            self.told("view", talk.replace('/project"', f'/view" --bare --scene "{scene}"'), "--bare"))

    def test_the_aspect_of_opengl_is_right_where_a_scene_says_so(self):
        program = script("""exec "$BIN/project" --aspect ratio""")
        done = check("project", "--", program)
        self.assertRegex(
            done.stdout, "\n2-camera: wrong\n(?:  .*\n)*  if your course takes the aspect as width "
            "/ height, as OpenGL does, this is right: ")
        pathlib.Path("scene").write_text(SCENE.replace("50 1.3 1 50", "50 1.3 1 50 ratio"))
        done = check("project", "--scene", "scene", "--", program)
        self.assertEqual((done.stdout, done.returncode), ("scene: right\n", 0))

    def test_a_program_that_fails_is_told_of_a_parallel_projection(self):
        pathlib.Path("scene").write_text(SCENE.replace("50 1.3 1 50", "ortho -2 2 -2 2 1 50"))
        told = self.told("project", "echo no such camera >&2; exit 1")
        self.assertEqual(
            told, "scene: wrong: its exit status is 1\n  its stderr:\n    no such camera\n"
            "  the projection of this scene is no perspective but ortho -2 2 -2 2 1 50\n")

    def test_an_aspect_that_is_ignored_is_found(self):
        ignoring = """sed 's/^\\(perspective [^ ]*\\) [^ ]*/\\1 1/' | "$BIN/project\""""
        done = check("project", "--", script(ignoring))
        self.assertIn("1-one-triangle: right\n2-camera: wrong\n", done.stdout)
        self.assertIn("  cause: The horizontal angle of view is the vertical one: the aspect is ignored\n",
                      done.stdout)
        self.assertEqual(done.returncode, 1)
        pathlib.Path("scene").write_text(SCENE.replace(" 1.3 ", " 1 "))
        self.assertEqual(
            self.told("project", ignoring, status=0),
            "scene: right\n  not tried: the aspect, which is 1 in this scene, so that a program that ignores "
            "it is right, too\n")

    def test_the_first_wrong_number_and_the_cause(self):
        told = self.told("view", 'exec "$BIN/view" --eye 0 0 0 --look -2.7 -4.2 -6.9')
        self.assertIn("scene: wrong\n  first difference: line 2, x of vertex 1 of triangle 0: ",
                      told)  # line 1 is the projection
        self.assertIn("  cause: The eye is not subtracted\n", told)

    def test_the_matrix_is_shown_beside_ours(self):
        # A y that is twice too large, in six points that determine the matrix.
        told = self.told("project", """"$BIN/project" | awk 'NF { $2 = sprintf("%.7f", 2 * $2) } 1'""")
        self.assertIn("found in the points (* differs)", told)
        rows = told.split("| right\n")[1].splitlines()
        self.assertEqual([row.count("*") for row in rows], [0, 1, 0, 0])

    def test_a_scene_without_a_cause_leads_to_one_that_shows_the_matrix(self):
        mix = """awk '/^[-0-9]/ { print 1.3 * $1 + 0.2 * $2, 0.9 * $2 - 0.1, 1.1 * $3; next } 1'"""
        told = check("view", "--", script(f'"$BIN/view" | {mix}')).stdout
        self.assertRegex(
            told, r"^1-one-triangle: wrong\n(?:  .*\n)*  cause: none of those known\n"
            r"2-camera: wrong\n")
        rows = told.split("| right\n")[1].splitlines()
        self.assertEqual([row.count("*") for row in rows[:4]], [4, 4, 4, 0])

    def test_a_program_that_fails_leads_to_a_scene_that_shows_a_cause(self):
        """It divides by the length of the look, which is 0 in the first scene."""
        for at_0, words in ("exit 3", "wrong: its exit status is 3"), ('print "nan nan nan"', "unreadable: "):
            done = check("view", "--",
                         script(f"exec awk '/^look 0 0 0$/ {{ {at_0} }} /^[elu]/ {{ next }} 1'"))
            self.assertRegex(
                done.stdout, rf"^1-one-triangle: {words}(?s:.*?)\n2-camera: wrong\n"
                r"(?:  .*\n)*  cause: The points are those of the stage before, unchanged\n")

    def test_a_cause_is_named_as_far_as_the_next_scene_confirms_it(self):
        """All these write the same for the first scene, whose camera looks along z from 0 0 4."""
        for factor, cause in ("0",
                              "The points are those of the stage before, unchanged"), ("eye",
                                                                                       "none of those known"):
            done = check(
                "view", "--",
                script("exec awk '/^eye/ { eye = $2 } /^[elu]/ { next } "
                       f"NF == 3 {{ $2 += {factor} * $1 * $2 }} 1'"))
            self.assertIn(
                "1-one-triangle: wrong\n  first difference: line 2, z of vertex 1 of triangle 0: 0 in place "
                f"of -4, off by 4\n  cause: {cause}\n", done.stdout)

    def test_a_zbuf_gets_its_config_and_writes_its_picture(self):
        told = self.told("zbuf", 'exec "$BIN/zbuf" --coverage center "$1"', status=0)
        self.assertRegex(
            told, r"^scene: right by another rule: the center rule\n  that counts as right: .*\n"
            r"  first difference: row \d+, column \d+: .* \(counted from 0\)\n$")
        self.assertEqual(self.told("zbuf", '"$BIN/zbuf" "$1" --image output.bmp > zBuffer.txt', status=0),
                         "scene: right\n")
        self.assertIn("(out.bmp)", self.told("zbuf", 'exec "$BIN/zbuf" "$1" --image none.bmp'))

    def test_the_scene_stands_where_the_command_wants_it(self):
        done = check("view", "--scene", "scene", "--bare", "--", BIN / "view", "--scene", "{scene}", "--bare")
        self.assertEqual((done.stdout, done.returncode), ("scene: right\n", 0))

    def test_a_program_that_fails_is_told(self):
        self.assertEqual(self.told("view", "echo no such matrix >&2; exit 3"),
                         "scene: wrong: its exit status is 3\n  its stderr:\n    no such matrix\n")
        self.assertEqual(self.told("view", "kill -9 $$"), "scene: wrong: it was ended by SIGKILL\n")

    def test_a_file_in_this_folder_is_found_from_another(self):
        pathlib.Path("mine.sh").write_text(f"exec '{BIN}/view'\n")
        for name in ("mine.sh", "./mine.sh", os.path.abspath("mine.sh")):
            self.assertEqual(check("view", "--scene", "scene", "--", "sh", name).stdout, "scene: right\n")

    def test_a_long_stderr_is_kept_in_a_file(self):
        told = self.told("view", "seq 1000 >&2; exit 1")
        self.assertIn("  its stderr, the last 10 of 1000 lines:\n    991\n", told)
        path = pathlib.Path(re.search("  all of it: (.*)\n$", told)[1])
        self.addCleanup(path.unlink)
        self.assertEqual(path.read_text(), "".join(f"{i}\n" for i in range(1, 1001)))

    def test_what_a_wrong_program_noted_is_shown(self):
        told = self.told("view",
                         'echo "no up vector" >&2; exec "$BIN/view" --eye 0 0 0 --look -2.7 -4.2 -6.9')
        self.assertIn("  its stderr:\n    no up vector\n", told)
        self.assertEqual(self.told("view", 'echo busy >&2; exec "$BIN/view"', status=0), "scene: right\n")

    def test_an_empty_output_has_a_cause(self):
        header = (": it must read past the lines before the first triangle, such as 'perspective 50 1.3 1 "
                  "50' (--bare feeds none)")
        stops = "exec awk '/^[a-z]/ { exit } 1'"  # at a header line
        loses_all = 'exec "$BIN/project" | grep -v .'
        for program, options, words in (stops, (), header), (loses_all, (), ""), ("exec true", ("--bare",),
                                                                                  ""):
            self.assertEqual(self.told("project", program, *options),
                             f"scene: wrong: it is empty\n  cause: It wrote nothing{words}\n")
        self.assertIn("  cause: It wrote nothing\n", self.told("zbuf", "exec true"))

    def test_an_output_that_another_run_does_not_repeat_has_a_cause(self):
        text = """t=$(od -An -N3 -tu4 /dev/urandom | tr -d ' ')
            "$BIN/STAGE" "$@" | awk -v t=$t '/^[-0-9]/ { $1 = t * NR * NR } 1'"""
        for stage, words in ("zbuf", "Some pixels are random"), ("view", "Some numbers are random"):
            told = self.told(stage, text.replace("STAGE", stage))
            self.assertIn(f"  cause: {words}: two runs of the program on the same text differ\n", told)

    def test_an_unchanged_input_has_a_cause(self):
        for stage in ("model", "view", "project", "zbuf"):
            self.assertIn("  cause: It wrote its input unchanged\n", self.told(stage, "exec cat"))

    def test_an_endless_output_ends(self):
        self.assertIn("it writes more than", self.told("view", "exec yes 1 2 3", "--time-limit", "100"))

    def test_a_program_that_does_not_read_may_be_right(self):
        self.told("view", f'"$BIN/model" "{os.path.abspath("scene")}" | "$BIN/view"', status=0)

    def test_what_cannot_be_run_is_a_wrong_command_line(self):
        for words, message in ((("view", "--", "no-such-program"), "no program no-such-program on the PATH"),
                               (("sight", "--", "cat"),
                                "invalid choice"), (("zbuf", "--scene", "scene", "--", "cat"),
                                                    "expected --config beside --scene for zbuf"),
                               (("view", "--time-limit", "0", "--", "cat"), "expected more than 0 seconds")):
            done = check(*words)
            self.assertEqual(done.returncode, 2)
            self.assertIn(message, done.stderr)

    def test_what_cannot_be_started_is_no_verdict(self):
        pathlib.Path("plain").write_text("no program\n")
        pathlib.Path("empty").write_text("print(1)\n")
        pathlib.Path("empty").chmod(0o755)
        for word, reason in (("./none", "No such file or directory"),
                             ("./plain", "Permission denied; chmod +x makes a file a program"),
                             ("./empty",
                              "Exec format error; a script begins with a line like #!/usr/bin/env python3")):
            done = check("view", "--scene", "scene", "--", word)
            self.assertEqual((done.returncode, done.stdout, done.stderr),
                             (2, "", f"check-stage: cannot run {word}: {reason}\n"))


if __name__ == "__main__":
    unittest.main()
