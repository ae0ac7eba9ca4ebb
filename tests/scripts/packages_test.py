#!/usr/bin/env python3
"""install-packages and demo: as root, with sudo, and as a user who may not install anything. dpkg, apt and
sudo are stubs.

usage: packages_test.py BIN_DIR [UNITTEST ARGUMENT...]
"""
import pathlib
import re
import shutil
import subprocess
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


class Packages(ToolTest):
    def setUp(self):
        super().setUp()
        self.tree, self.state = pathlib.Path("a tree").resolve(), pathlib.Path("state").resolve()
        (self.tree / "scripts").mkdir(parents=True)
        shutil.copy(SOURCE / "scripts/install-packages", self.tree / "scripts")
        for folder in ("installed", "unknown", "bin"):
            (self.state / folder).mkdir(parents=True)
        self.environment = {
            "PATH": f"{self.state}/bin:/usr/bin:/bin", "STATE": str(self.state), "USER_NUMBER": "0",
            "LANG": "C.UTF-8"}
        for name, text in STUBS.items():
            self.put(name, text)
        self.needed = lists()["to_build"] + lists()["to_test"]
        self.optional = lists()["to_test_all"]
        self.have(*self.needed, *self.optional)

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

    def test_root_installs_what_is_missing_and_apt_chatters_into_a_log(self):
        self.lack("cmake", "xvfb")
        self.assertEqual(self.install("--tests"), (0, "installing: cmake xvfb\n", ""))
        self.assertEqual(self.calls(), ["-q update", "-q install -y --no-install-recommends cmake xvfb"])
        self.assertIn("chatter of apt-get -q install", (self.tree / "build/apt.log").read_text())

    def test_only_what_is_asked_for_counts(self):
        self.lack("xvfb", "libgtest-dev")
        self.assertEqual(self.install(), (0, "", ""))
        self.assertEqual(self.install("--checks", "--playground")[:2], (2, ""))

    def test_a_package_of_another_name_does_not_keep_the_others_out(self):
        self.lack("cmake", "chromium-driver", "xvfb")
        (self.state / "unknown/chromium-driver").touch()
        self.assertEqual(
            self.install("--tests"),
            (0, "installing: cmake xvfb chromium-driver\n",
             "install-packages: cannot install chromium-driver; tests that need these packages will be "
             "skipped\n"))
        self.assertTrue((self.state / "installed/xvfb").exists())

    def test_a_needed_package_that_cannot_be_installed_is_an_error(self):
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
            "sudo env DEBIAN_FRONTEND=noninteractive apt-get -q install -y --no-install-recommends g++",
            self.calls())

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

    def test_another_system_is_left_alone(self):
        self.as_user()
        (self.state / "bin/dpkg-query").unlink()
        status, output, messages = self.install()
        self.assertEqual((status, messages), (0, ""))
        self.assertTrue(
            output.startswith(
                "install-packages: this is not a Debian system; install equivalents of these packages: g++ "))


class BuildRelease(ToolTest):
    def test_where_nothing_can_be_written_it_fails(self):
        tree = pathlib.Path("a tree").resolve()
        (tree / "scripts").mkdir(parents=True)
        shutil.copy(SOURCE / "scripts/build-release", tree / "scripts")
        (tree / "build").symlink_to("/proc")
        done = subprocess.run([tree / "scripts/build-release"], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stderr.splitlines()[-1]),
                         (1, "build-release: failed, see above"))


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
