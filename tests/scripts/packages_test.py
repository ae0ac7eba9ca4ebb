#!/usr/bin/env python3
"""install-packages, as root, with sudo, and as a user who may not install anything; build-release, fuzz and
demo. dpkg, apt, sudo, cmake and the fuzzer are stubs.

usage: packages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import shutil
import subprocess
import time
import unittest

from toolbox import BIN, SOURCE, ToolTest

# A package is installed if a file of its name is in installed/, and can be if none is in unknown/.
STUBS = {
    "dpkg-query": """#!/bin/sh
for package; do :; done
[ -e "$STATE/installed/$package" ] && echo "install ok installed"
""",
    "apt-get": """#!/bin/sh
echo "chatter of apt-get $*"
echo "$*" >> "$STATE/calls"
[ "$2" = install ] || exit 0
status=0
shift 4
for package; do
  if [ -e "$STATE/unknown/$package" ]; then status=100; fi
done
[ $status -eq 0 ] || exit $status
for package; do : > "$STATE/installed/$package"; done
""",
    "id": '#!/bin/sh\necho "$USER_NUMBER"\n',}
SUDO = """#!/bin/sh
[ "$SUDO_WORKS" = yes ] || { echo "sudo: a password is required" >&2; exit 1; }
echo "sudo $*" >> "$STATE/calls"
[ "$1" = -n ] || exec "$@"
"""


def lists():
    """The package lists of the script, by their names."""
    return {
        name: words.split()
        for name, words in re.findall(r"^(to_\w+)='([^']*)'", (SOURCE /
                                                               "scripts/install-packages").read_text(), re.M)}


def tree_with(script):
    tree = pathlib.Path("a tree").resolve()
    (tree / "scripts" / script).parent.mkdir(parents=True)
    shutil.copy(SOURCE / "scripts" / script, tree / "scripts" / script)
    return tree


class Packages(ToolTest):
    def setUp(self):
        super().setUp()
        self.tree, self.state = tree_with("install-packages"), pathlib.Path("state").resolve()
        for folder in ("installed", "unknown", "bin"):
            (self.state / folder).mkdir(parents=True)
        self.environment = {
            "PATH": f"{self.state}/bin:/usr/bin:/bin", "STATE": str(self.state), "USER_NUMBER": "0",
            "LANG": "C.UTF-8"}
        for name, text in STUBS.items():
            self.put(name, text)
        self.have(*lists()["to_build"], *lists()["to_test"], *lists()["to_test_all"])

    def put(self, name, text):
        (self.state / "bin" / name).write_text(text)
        (self.state / "bin" / name).chmod(0o755)

    def have(self, *packages):
        for package in packages:
            (self.state / "installed" / package).touch()

    def lack(self, *packages):
        for package in packages:
            (self.state / "installed" / package).unlink()

    def install(self, *words):
        done = subprocess.run([self.tree / "scripts/install-packages", *words], env=self.environment,
                              capture_output=True, text=True, timeout=60, stdin=subprocess.DEVNULL)
        return done.returncode, done.stdout, done.stderr

    def calls(self):
        calls = self.state / "calls"
        return calls.read_text().splitlines() if calls.exists() else []

    def as_user(self, sudo=None):
        """Leaves the system's sudo out."""
        self.environment["USER_NUMBER"] = "1000"
        if sudo:
            self.put("sudo", SUDO)
            self.environment["SUDO_WORKS"] = sudo
        for name in ("sh", "env", "dirname", "readlink", "mkdir", "tail"):
            (self.state / "bin" / name).symlink_to(shutil.which(name))
        self.environment["PATH"] = f"{self.state}/bin"

    def test_with_nothing_missing_nothing_is_called(self):
        for name in ("apt-get", "id"):
            self.put(name, "#!/bin/sh\nexit 99\n")
        self.assertEqual(self.install("--tests"), (0, "", ""))
        self.assertFalse((self.tree / "build").exists())
        self.lack("xvfb", "libgtest-dev")  # only what is asked for counts
        self.assertEqual(self.install(), (0, "", ""))
        self.assertEqual(self.install("--checks", "--playground")[:2], (2, ""))

    def test_root_installs_what_is_missing_and_apt_chatters_into_a_log(self):
        self.lack("cmake", "xvfb")
        self.assertEqual(self.install("--tests"), (0, "installing: cmake xvfb\n", ""))
        self.assertEqual(self.calls(), ["-q update", "-q install -y --no-install-recommends cmake xvfb"])
        self.assertIn("chatter of apt-get -q install", (self.tree / "build/apt.log").read_text())

    def test_a_package_of_another_name_does_not_keep_the_others_out(self):
        self.lack("cmake", "chromium-driver", "xvfb")
        (self.state / "unknown/chromium-driver").touch()
        line = "installing: cmake xvfb chromium-driver\n"
        self.assertEqual(self.install("--tests"),
                         (0, line, "install-packages: cannot install chromium-driver; "
                          "tests that need these packages will be skipped\n"))
        self.assertTrue((self.state / "installed/xvfb").exists())
        self.lack("cmake")
        (self.state / "unknown/cmake").touch()
        status, _, messages = self.install()
        self.assertEqual((status, messages.splitlines()[-1]),
                         (1, "install-packages: cannot install cmake; see build/apt.log"))

    def test_a_user_with_sudo_installs_through_it(self):
        self.as_user(sudo="yes")
        self.lack("g++")
        self.assertEqual(self.install(), (0, "installing: g++\n", ""))
        self.assertIn(
            "sudo env DEBIAN_FRONTEND=noninteractive apt-get -q install -y "
            "--no-install-recommends g++", self.calls())

    def test_a_user_without_root_is_told_what_to_ask_for(self):
        for sudo, why in ((None, "neither root nor sudo"), ("no",
                                                            "sudo does not let this user install packages")):
            with self.subTest(sudo):
                self.as_user(sudo)
                self.lack("g++", "ninja-build")
                message = f"install-packages: {why}; an administrator can install what is missing:\n" \
                          "  apt-get install --no-install-recommends g++ ninja-build\n"
                self.assertEqual(self.install(), (1, "", message))
                self.assertEqual(self.calls(), [])
                self.have("g++", "ninja-build")
                self.assertEqual(self.install(), (0, "", ""))
            for file in (self.state / "bin").iterdir():
                if file.is_symlink():
                    file.unlink()

    def test_without_optional_packages_a_user_goes_on(self):
        self.as_user()
        self.lack("chromium", "mandoc")
        status, output, messages = self.install("--tests")
        self.assertEqual((status, output), (0, ""))
        self.assertTrue(
            messages.endswith("  apt-get install --no-install-recommends chromium mandoc\n"
                              "install-packages: going on; tests that need these packages will be skipped\n"))
        (self.state / "bin/dpkg-query").unlink()  # another system is left alone
        status, output, messages = self.install()
        self.assertEqual((status, messages), (0, ""))
        self.assertTrue(
            output.startswith("install-packages: this is not a Debian system; install equivalents "
                              "of these packages: g++ "))


class BuildRelease(ToolTest):
    def test_it_ends_as_its_build_does_also_where_others_build_or_nothing_can_be_written(self):
        tree = tree_with("build-release")
        (tree / "build").symlink_to("/proc")
        done = subprocess.run([tree / "scripts/build-release"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1]),
                         (1, "build-release: failed, see above"))
        (tree / "build").unlink()
        (tree / "cmake").write_text(
            '#!/bin/sh\n[ $1 != --build ] || { mkdir busy && sleep 0.3 && rmdir busy && '
            'exit $FAILS; }\n')
        (tree / "cmake").chmod(0o755)
        runs = [
            subprocess.Popen([tree / "scripts/build-release"], stderr=subprocess.DEVNULL, env={
                "PATH": f"{tree}:/usr/bin:/bin", "FAILS": fails}) for fails in "0100"]
        self.assertEqual([run.wait(60) for run in runs], [0, 1, 0, 0])


class Fuzz(ToolTest):
    def test_it_searches_where_it_is_told_until_the_time_is_over_or_a_signal_comes(self):
        tree = tree_with("maintain/fuzz")
        shutil.copytree(SOURCE / "tests/fuzz", tree / "tests/fuzz")
        for name, line in (("bin/cmake", ""), ("build/fuzz/tests/fuzz/scene_fuzz", 'exec sleep "${3#*=}"')):
            (tree / name).parent.mkdir(parents=True)
            (tree / name).write_text(f"#!/bin/sh\n{line}\n")
            (tree / name).chmod(0o755)
        os.mkdir("tmp")

        def fuzz(seconds):
            return subprocess.Popen(
                [tree / "scripts/maintain/fuzz", "--found", "found", "--seconds", seconds, "scene"], env={
                    "PATH": f"{tree}/bin:/usr/bin:/bin",
                    "TMPDIR": os.path.abspath("tmp")}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)

        self.assertEqual([fuzz(seconds).wait(60) for seconds in ("0", "x", "1")], [2, 2, 0])
        self.assertTrue(os.path.exists("found/scene.log"))
        process = fuzz("99")
        while not [*pathlib.Path("tmp").glob("*/*")] and process.poll() is None:
            time.sleep(0.05)
        process.terminate()
        self.assertEqual((process.wait(60), os.listdir("tmp")), (1, []))


class Demo(ToolTest):
    def test_it_ends_with_what_it_made_and_leaves_nothing_beside_out(self):
        tree = pathlib.Path("a tree").resolve()
        shutil.copytree(SOURCE / "scripts", tree / "scripts")
        shutil.copytree(SOURCE / "samples/worked-example", tree / "samples/worked-example")
        (tree / "build/release").mkdir(parents=True)
        (tree / "build/release/bin").symlink_to(BIN)
        for stub in ("install-packages", "build-release"):
            (tree / "scripts" / stub).write_text("#!/bin/sh\n")
        done = subprocess.run([tree / "scripts/demo", "worked-example"], capture_output=True, text=True, env={
            "PATH": "/usr/bin:/bin"}, timeout=60)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for name in ("", "../samples/worked-example"):
            done_nothing = subprocess.run([tree / "scripts/demo", name], capture_output=True)
            self.assertEqual((done_nothing.returncode, done_nothing.stdout), (2, b""))
        self.assertEqual(sorted(path.name for path in tree.iterdir()), ["build", "out", "samples", "scripts"])
        made = sorted(path.name for path in (tree / "out/worked-example").iterdir())
        self.assertEqual(made,
                         ["out.bmp", "picture.png", "stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt"])
        end = done.stdout.partition("made:\n")[2]
        for name in made:
            self.assertIn(
                f" {(tree / 'out/worked-example' / name).stat().st_size} out/worked-example/{name}\n", end)
        # Its last commands work, but for a viewer.
        for command in re.findall(r"^(?:  |all commands: )(build\S+ .*)$", end, re.M):
            subprocess.run(["sh", "-c", command], cwd=tree, check=True, capture_output=True, timeout=60)
        self.assertTrue((tree / "out/worked-example/report.html").exists())


if __name__ == "__main__":
    unittest.main()
