#!/usr/bin/env python3
"""cmake --install: every command runs from a read-only prefix with blanks in its path, as another user, while
the source tree cannot be seen; so do the examples of its page. The library is found by CMake and pkg-config.

usage: install_test.py BUILD_DIR SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import json
import os
import pathlib
import re
import shlex
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
BUILD, SOURCE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
from display import MISSING, Display  # noqa: E402

NOBODY = 65534
TOOLS = ["model", "view", "project", "zbuf"]
# Runs the words after '--' without the folders before it, as nobody if root does, else as the same user ($1),
# who was root only to hide the folders.
HIDE = """
user=$1; shift
while [ "$1" != -- ]; do mount -t tmpfs -o mode=755 none "$1" || exit 99; shift; done
shift
[ "$user" != 0 ] || exec setpriv --reuid 65534 --regid 65534 --clear-groups "$@"
exec unshare --user --map-user="$user" "$@"
"""


def namespace():
    """The words that give a process mounts of its own, or none if the system gives none to this user."""
    for words in (["unshare", "--mount"], ["unshare", "--map-root-user", "--mount"]):
        try:
            if subprocess.run([*words, "sh", "-c", "mount -t tmpfs none /mnt"],
                              capture_output=True).returncode == 0:
                return words
        except FileNotFoundError:
            break
    return []


def setUpModule():  # noqa: N802
    """Installs once, to a prefix that only its owner may write to; nobody, if he is root."""
    global FOLDER, PREFIX
    FOLDER = tempfile.TemporaryDirectory(prefix="pipeline install ")
    os.chmod(FOLDER.name, 0o755)
    PREFIX = pathlib.Path(FOLDER.name, "the prefix")
    install(PREFIX)
    for path in [PREFIX, *PREFIX.rglob("*")]:
        if not path.is_symlink():
            path.chmod(stat.S_IMODE(path.stat().st_mode) & 0o555)


def tearDownModule():  # noqa: N802
    for path in [PREFIX, *PREFIX.rglob("*")]:
        if path.is_dir():
            path.chmod(0o755)
    FOLDER.cleanup()


def install(prefix, **settings):
    done = subprocess.run(["cmake", "--install", BUILD, "--prefix", prefix], capture_output=True, text=True,
                          **settings)
    if done.returncode != 0:
        raise AssertionError(done.stdout + done.stderr)


def commands():
    return [
        path.name for path in sorted((PREFIX / "libexec/pipeline").iterdir())
        if path.is_file() and os.access(path, os.X_OK)]


def examples(page):
    """The command lines of a man page."""
    section = (re.findall(r"^\.SH EXAMPLES\n(.*?)(?=^\.SH )", page, re.M | re.S) or [""])[0]
    for block in re.findall(r"^\.EX\n(.*?)^\.EE$", section, re.M | re.S):
        yield re.sub(r"\\\((aq|ha|ti|ga)", lambda name: {"aq": "'", "ha": "^", "ti": "~", "ga": "`"}[name[1]],
                     block.replace("\\&", "")).replace("\\-", "-").replace("\\e", "\\")


class Installed(unittest.TestCase):
    def setUp(self):
        self.work = pathlib.Path(tempfile.mkdtemp(prefix="pipeline work "))
        self.addCleanup(shutil.rmtree, self.work)
        self.is_root = os.geteuid() == 0
        self.environment = {"PATH": f"{PREFIX}/bin:/usr/bin:/bin", "HOME": str(self.work), "LANG": "C.UTF-8"}
        # The build folder may lie in the source folder.
        hidden = [str(SOURCE)] + [str(BUILD)] * (SOURCE not in BUILD.parents)
        self.words = namespace() and [*namespace(), "sh", "-c", HIDE, "sh", str(os.geteuid()), *hidden, "--"]

    def give(self):
        """Hands the work folder to the user who runs the commands."""
        if self.is_root:
            for path in [self.work, *self.work.rglob("*")]:
                os.chown(path, NOBODY, NOBODY)

    def run_line(self, line, **settings):
        if not self.words:
            self.skipTest("the system gives no process mounts of its own: the source tree cannot be hidden")
        return subprocess.run([*self.words, "bash", "-c", line], cwd=self.work, env=self.environment,
                              stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=60,
                              **settings)

    def prepare(self):
        """The files of which examples speak, for the sample of the worked example."""
        sample = SOURCE / "samples/worked-example"
        for name in ("scene.txt", "config.txt", "stage1.txt", "stage2.txt", "stage3.txt", "z_buffer.txt",
                     "out.bmp"):
            shutil.copy(sample / name, self.work)
        (self.work / "bunny.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        shutil.copy(self.work / "bunny.obj", self.work / "part.obj")
        (self.work / "path.txt").write_text("0 3 4 5 0 0 0 0 1 0\n1 5 4 3 0 0 0 0 1 0\n")
        for name in ("seen1.txt", "seen2.txt"):
            (self.work / name).write_text("framed\n0 0 0\n1 0 0\n0 1 0\n\nend\n")
        for name in ("1", "2"):
            (self.work / f"band{name}.ppm").write_text("P6\n1 1\n255\nabc")
        shutil.rmtree(self.work / "parts", ignore_errors=True)
        for name in ("mine", "torus", "hand-ins/somebody/plain", "tests/plain"):
            shutil.rmtree(self.work / name, ignore_errors=True)
            shutil.copytree(sample, self.work / name)
        self.give()

    def test_nothing_can_write_to_the_prefix_and_the_source_tree_is_gone(self):
        self.give()
        done = self.run_line(
            f"touch {shlex.quote(str(PREFIX))}/x; ls {shlex.quote(str(SOURCE))}; id -u; touch here && "
            f"echo written")
        self.assertEqual(done.stdout, f"{NOBODY if self.is_root else os.geteuid()}\nwritten\n")
        self.assertIn("Permission denied", done.stderr)

    def test_no_link_of_a_document_is_dead(self):
        documents = PREFIX / "share/doc/pipeline"
        links = {
            path.parent / link
            for path in documents.rglob("*.md")
            for link in re.findall(r"\]\(([^)#:]+)(?:#[^)]*)?\)", path.read_text())}
        self.assertGreater(len(links), 30)
        self.assertEqual([str(link) for link in links if not link.exists()], [])

    def test_without_python_a_command_says_so(self):
        os.mkdir(self.work / "bin")
        for name in ("sh", "readlink", "tr"):
            os.symlink(shutil.which(name), self.work / "bin" / name)
        reason = "pipeline: picture needs Python 3.9 or newer, and there is no python3\n"
        for command, expected in (("picture", (2, "", reason)), ("model", (0, "model (pipeline) ", ""))):
            done = subprocess.run([PREFIX / "bin/pipeline", command, "--version"], capture_output=True,
                                  text=True, env={"PATH": str(self.work / "bin")})
            self.assertEqual((done.returncode, re.sub(r"[\d.]+\n", "", done.stdout), done.stderr), expected)

    def test_every_command_answers_help(self):
        self.assertLessEqual({*TOOLS, "stages", "compare", "explain", "inspect", "fly", "trade"},
                             set(commands()))
        self.give()
        for command in commands():
            with self.subTest(command):
                done = self.run_line(f"pipeline {command} --help")
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertRegex(done.stdout, rf"(?im)^usage: {command}\b")

    def test_the_examples_of_every_page_run(self):
        for page in sorted((PREFIX / "share/man/man1").iterdir()):
            lines = list(examples(page.read_text()))
            self.assertTrue(lines, page.name)
            for line in lines:
                if "pipeline fly" in line or " -- ./" in line:
                    continue  # its window is opened below; a program after -- is the user's own
                with self.subTest(line):
                    self.prepare()
                    done = self.run_line("set -o pipefail; " + line)
                    self.assertEqual(done.returncode, 0, done.stderr)
                    self.assertNotIn("Traceback", done.stderr)
                    for file in re.findall(r"(?:> |--image |-o )(\S+\.\w+)", line):
                        self.assertGreater((self.work / file).stat().st_size,
                                           0 if file != "differences.png" else -1, file)

    @unittest.skipIf(MISSING, f"missing: {' '.join(MISSING)}")
    def test_fly_opens_its_window(self):
        self.prepare()
        with Display():
            self.environment["DISPLAY"] = os.environ["DISPLAY"]
            done = self.run_line("timeout 3 pipeline fly scene.txt config.txt; echo $?")
        self.assertEqual((done.stdout, done.stderr), ("124\n", "fly: ended by SIGTERM\n"))

    def test_the_pipe_makes_the_sample(self):
        self.prepare()
        done = self.run_line('eval "$(pipeline env)" && model scene.txt | view | project | zbuf config.txt')
        self.assertEqual((done.stdout, done.stderr),
                         ((SOURCE / "samples/worked-example/z_buffer.txt").read_text(), ""))

    def test_no_file_names_the_source_tree(self):
        for path in PREFIX.rglob("*"):
            if path.is_file() and path.suffix != ".a":
                for folder in (SOURCE, BUILD):
                    self.assertNotIn(bytes(folder) + b"/", path.read_bytes(), path)

    def test_only_bin_pipeline_is_on_the_path(self):
        self.assertEqual(os.listdir(PREFIX / "bin"), ["pipeline"])

    def test_documents_have_their_pictures(self):
        folder = PREFIX / "share/doc/pipeline"
        # Links to what is not installed are plain words.
        installed, ours = (re.sub(r"\[([^]]+)\]\([^)]*\)", r"\1", (where / "README.md").read_text())
                           for where in (folder, SOURCE))
        self.assertEqual(installed, ours)
        for page in (folder / "README.md", *folder.glob("docs/*.md")):
            for picture in re.findall(r"!\[[^]]*\]\(([^)#:]+)\)", page.read_text()):
                self.assertTrue((page.parent / picture).exists(), f"{page.name}: {picture}")

    def test_completion_and_pages_are_those_of_the_build(self):
        for path in (BUILD / "share").rglob("*"):
            if path.is_file():
                self.assertEqual((PREFIX / "share" / path.relative_to(BUILD / "share")).read_bytes(),
                                 path.read_bytes())


class ShortNames(unittest.TestCase):
    """The script that -DPIPELINE_SHORT_NAMES=ON configures, run as cmake --install runs it."""
    def test_links_lead_to_commands_and_pages(self):
        with tempfile.TemporaryDirectory() as folder:
            destination, prefix = pathlib.Path(folder, "dest dir"), pathlib.Path("/the prefix")
            install(prefix, env={**os.environ, "DESTDIR": str(destination)})
            placed = destination / prefix.relative_to("/")
            names = sorted(os.listdir(BUILD / "libexec/pipeline"))
            script = pathlib.Path(folder, "links.cmake")
            template = (SOURCE / "scripts/package/install_links.cmake.in").read_text()
            script.write_text(
                f'set(CMAKE_INSTALL_PREFIX "{prefix}")\n' +
                template.replace("@names@", " ".join(names)).replace("@PIPELINE_SHORT_NAMES@", "ON"))
            subprocess.run(["cmake", "-P", script], env={**os.environ, "DESTDIR": str(destination)},
                           check=True, capture_output=True)
            self.assertEqual(sorted(os.listdir(placed / "bin")), sorted([*names, "pipeline"]))
            for name in names:
                self.assertTrue((placed / f"share/man/man1/{name}.1").samefile(
                    placed / f"share/man/man1/pipeline-{name}.1"))
                self.assertEqual(os.readlink(placed / f"bin/{name}"), f"../libexec/pipeline/{name}")
            sample = SOURCE / "samples/worked-example"
            line = (f"stages {sample}/scene.txt {sample}/config.txt five && compare --hand-in five "
                    f"{sample}/scene.txt {sample}/config.txt")
            done = subprocess.run(["bash", "-c", line], cwd=folder, env={
                "PATH": f"{placed}/bin:/usr/bin:/bin"}, capture_output=True, text=True)
            self.assertEqual((done.returncode, done.stderr), (0, ""))


class Library(unittest.TestCase):
    """A project of someone else's."""
    def setUp(self):
        self.build = tempfile.TemporaryDirectory(prefix="pipeline build ")
        self.addCleanup(self.build.cleanup)

    def headers(self):
        text = (SOURCE / "libpipeline/CMakeLists.txt").read_text()
        return re.search(r"set\(PIPELINE_PUBLIC_HEADERS\s+([^)]+)\)", text)[1].split()

    def call(self, *words, **settings):
        done = subprocess.run(words, capture_output=True, timeout=120, **settings)
        self.assertEqual(done.returncode, 0, (done.stdout + done.stderr).decode(errors="replace"))
        return done.stdout

    def assert_draws(self, folder):
        self.assertEqual(
            self.call(pathlib.Path(folder, "draw")).decode(), "#.......\n###.....\n#####...\n#######.\n")

    def test_cmake_finds_it_and_each_public_header_compiles(self):
        self.assertGreater(len(self.headers()), 10)
        self.call("cmake", "-S", SOURCE / "tests/consumer/installed", "-B", self.build.name, "-G", "Ninja",
                  f"-DCMAKE_PREFIX_PATH={PREFIX}", "-DHEADERS=" + ";".join(self.headers()),
                  "-DCMAKE_BUILD_TYPE=Debug")
        self.call("cmake", "--build", self.build.name)
        self.assert_draws(self.build.name)
        self.assertIn(self.call(pathlib.Path(self.build.name, "picture"))[:2], (b"\x89P", b"P6"))

    def test_cmake_refuses_another_version(self):
        pathlib.Path(self.build.name, "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.22)\nproject(x LANGUAGES NONE)\nfind_package(pipeline 99)\n"
            "message(STATUS found=${pipeline_FOUND})\n")
        text = self.call("cmake", "-S", self.build.name, "-B", self.build.name + "/b",
                         f"-DCMAKE_PREFIX_PATH={PREFIX}")
        self.assertIn("found=0", text.decode())

    def test_pkg_config_finds_it(self):
        if not shutil.which("pkg-config"):
            self.skipTest("pkg-config is missing (Debian: pkgconf)")
        pc, = PREFIX.rglob("pipeline.pc")
        flags = self.call("pkg-config", "--cflags", "--libs", "pipeline",
                          env={**os.environ, "PKG_CONFIG_PATH": str(pc.parent)})
        compiler = os.environ.get("CXX", "c++")
        self.call(compiler, SOURCE / "tests/consumer/draw.cpp", "-o", self.build.name + "/draw",
                  *shlex.split(flags.decode()))
        self.assert_draws(self.build.name)


@unittest.skipUnless(shutil.which("dpkg-query") and shutil.which("ninja"), "no Debian with Ninja")
class Licenses(unittest.TestCase):
    def test_they_are_installed_and_printed(self):
        documents = PREFIX / "share/doc/pipeline"
        text = (documents / "THIRD-PARTY").read_text()
        expected = {"cli11", "highway", "nlohmann-json3"}
        if "/libc.a" in (BUILD / "all-tools.linked").read_text():
            expected |= {"glibc", "libpng1.6", "zlib"}
        self.assertLessEqual(expected, set(re.findall(r"^  ([\w.-]+) \S+$", text, re.M)))
        for owner in ("Google LLC", "University of Cincinnati"):
            self.assertIn(owner, text)
        printed = subprocess.run([PREFIX / "bin/pipeline", "--licenses"], capture_output=True, text=True)
        self.assertEqual(printed.stdout, (SOURCE / "LICENSE").read_text() + "\n" + text + "\n")
        with tempfile.TemporaryDirectory() as folder:
            for name in ("bin/pipeline", "share/doc/pipeline/LICENSE", "libexec/pipeline/model"):
                pathlib.Path(folder, name).parent.mkdir(parents=True)
                shutil.copy(PREFIX / name, pathlib.Path(folder, name))
            done = subprocess.run([pathlib.Path(folder, "bin/pipeline"), "--licenses"], capture_output=True)
            self.assertEqual((done.returncode, b"could not print all licenses" in done.stderr), (2, True))

    def listed(self, build, *words):
        path = f"{build}/../bin:{os.environ['PATH']}"
        done = subprocess.run([SOURCE / "scripts/package/third-party", *words, build], capture_output=True,
                              text=True, env={**os.environ, "PATH": path})
        return done.stdout or done.stderr

    def test_a_part_without_a_license_is_named(self):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        for name, text in {
                "build/CMakeCache.txt": "CMAKE_HOME_DIRECTORY:INTERNAL=/s rc\n",
                "bin/ninja": "#!/bin/sh\necho 'tools/a.o: #\n    /s rc/a.h\n    /usr/include/stdio.h'\n",
                "build/tool.linked": "tool: \\\n  own.o \\\n  /prefix/include/stdio.h \\\n  /x/part.a\n",
                "npm/node_modules/@a/b/LICENSE": "of b", "npm/package-lock.json": json.dumps({
                    "packages": {
                        "": {}, "node_modules/@a/b": {"version": "2"}, "node_modules/c": {"version": "3"},
                        "node_modules/d": {"version": "4", "dev": True}}})}.items():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            (folder / name).write_text(text)
        words = [folder / "build", "--npm", folder / "npm", "--prefix", "/prefix"]
        self.assertEqual(self.listed(*words), f"third-party: ninja lists no headers of {folder}/build\n")
        (folder / "bin/ninja").chmod(0o755)
        self.assertEqual(self.listed(*words), "third-party: no package has /x/part.a\n")
        linked = folder / "build/tool.linked"
        linked.write_text(linked.read_text().replace("/x/part.a", ""))
        self.assertRegex(self.listed(*words), "^third-party: c 3 has no ")
        (folder / "npm/node_modules/c").mkdir()
        (folder / "npm/node_modules/c/LICENSE.md").write_text("see /usr/share/common-licenses/BSD.")
        text = self.listed(*words)
        for name, own in {r"glibc \S+": "", "@a/b 2": "of b", "BSD": "", "c 3": "see "}.items():
            self.assertRegex(text, f"\n{name}\n{'=' * 80}\n\n{own}")
        self.assertNotIn("d 4", text)


@unittest.skipUnless(
    shutil.which("dpkg-deb") and shutil.which("dpkg-shlibdeps"), "this is no Debian system with dpkg-dev")
class Packages(unittest.TestCase):
    """The packages of cpack."""
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory(prefix="pipeline-packages-")
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        (cls.folder / "c++ (a tree)").symlink_to(SOURCE)
        cls.other = cls.folder / "a build"
        lines = """cd "$1"; cpack -B "$2"; cd "$2"
            cmake -G Ninja -S "c++ (a tree)" -B "a build" -DPIPELINE_TESTS=OFF
            cd "a build"; cpack --config CPackSourceConfig.cmake -B "$2\""""
        done = subprocess.run(["sh", "-euc", lines, "sh", BUILD, folder.name], capture_output=True, text=True)
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls.package, = cls.folder.glob("*.deb")
        cls.archive, = cls.folder.glob("*.tar.gz")
        subprocess.run(["dpkg-deb", "-x", cls.package, cls.folder / "root"], check=True)

    def files(self):
        root = self.folder / "root"
        return [path.relative_to(root) for path in root.rglob("*") if not path.is_dir() or path.is_symlink()]

    def test_it_has_what_was_installed_and_what_debian_asks_for(self):
        installed = {
            str("usr" / path.relative_to(PREFIX))
            for path in PREFIX.rglob("*") if not path.is_dir() or path.is_symlink()}
        packed = {re.sub(r"(/man/.*)\.gz$", r"\1", str(path)) for path in self.files()}
        documents = "usr/share/doc/pipeline/"
        self.assertEqual(
            packed - installed,
            {documents + "copyright", documents + "changelog.gz", "usr/share/lintian/overrides/pipeline"})
        self.assertEqual(installed - packed, {documents + "LICENSE"})

    def test_it_runs_where_it_is_unpacked(self):
        done = subprocess.run([self.folder / "root/usr/bin/pipeline", "--version"], capture_output=True,
                              text=True)
        self.assertRegex(done.stdout + done.stderr, r"\Apipeline \d+\.\d+\.\d+\n\Z")

    def test_no_file_is_in_another_packages_way(self):
        bins = [path.name for path in self.files() if path.parent == pathlib.Path("usr/bin")]
        self.assertEqual(bins, ["pipeline"])
        names = [f"/{path}" for path in self.files()]
        owners = subprocess.run(["dpkg-query", "-S", *names], capture_output=True,
                                text=True).stdout.splitlines()
        self.assertEqual([line for line in owners if not line.startswith("pipeline: ")], [])

    def test_the_folders_that_licenses_are_looked_for_in_may_have_blanks(self):
        text = (self.other / "scripts/cmake_install.cmake").read_text()
        script = self.folder / "licenses.cmake"
        script.write_text(re.search(r"execute_process\(.*?endif\(\)", text, re.S)[0])
        done = subprocess.run(["cmake", "-P", script], capture_output=True, text=True)
        self.assertEqual(done.stderr, f"third-party: ninja lists no headers of {self.other}\n")

    @unittest.skipUnless(shutil.which("lintian"), "lintian is missing (Debian: lintian)")
    def test_lintian_finds_no_error(self):
        done = subprocess.run(["lintian", "--fail-on", "error", self.package], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout)

    def test_the_archive_has_the_files_of_the_repository(self):
        listed = subprocess.run(
            ["git", "-C", SOURCE, "ls-files", "--cached", "--others", "--exclude-standard"],
            capture_output=True, text=True)
        if listed.returncode != 0:
            self.skipTest("there is no repository")
        packed = subprocess.run(["tar", "-tzf", self.archive], capture_output=True, text=True,
                                check=True).stdout.splitlines()
        names = {line.partition("/")[2] for line in packed if not line.endswith("/")}
        self.assertEqual(names, {name for name in listed.stdout.splitlines() if (SOURCE / name).exists()})


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))  # a time limit: clean up
    unittest.main()
