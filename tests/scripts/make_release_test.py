#!/usr/bin/env python3
"""scripts/package/make-release: what it refuses, and that it leaves nothing behind. What it makes is tried by
scripts/maintain/try-release, which needs a network and time.

usage: make_release_test.py SOURCE_DIR [UNITTEST ARGUMENT...]
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
# Hangs as mmdebstrap does, which waits for its child whatever signal comes.
STUB = '#!/bin/sh\n[ ! -e "$0.hangs" ] || { trap : TERM; : > "$0.started"; sleep 99; exit 1; }\n'
# Stands for the build in the root: writes what the words after -- and --bind ask for.
BWRAP = STUB + """[ ! -e "$0.fails" ] || { echo no namespaces >&2; exit 1; }
[ ! -e "$0.commits" ] || git -c user.name=a -c user.email=a@b.invalid commit -qm 'area: Do more' --allow-empty
while [ "$1" != --bind ]; do [ "$3" != /page ] || page=$2; shift; done
mkdir -p "$2/out"
cp "$page/playground.html" "$2/out/pipeline-9.8.7-playground.html"
echo archive > "$2/out/pipeline-9.8.7-source.tar.xz"
echo list > "$2/out/built-with.txt"
"""
PLAYGROUND = """#!/bin/sh
echo run >> "${PATH%%:*}/playground.runs"
mkdir -p "$2/playground"
echo page > "$2/playground.html"
"""
# Fails to do what the file beside it names, after half of it.
GIT = f"""#!/bin/sh
case "$*" in *"$(cat "$0.fails")"*) ;; *) exec {shutil.which("git")} "$@" ;; esac
{shutil.which("git")} "$@" scripts
exit 1
"""


class MakeRelease(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory(prefix="a release ")
        self.addCleanup(folder.cleanup)
        self.tree, self.bin = pathlib.Path(folder.name, "a tree"), pathlib.Path(folder.name, "bin")
        self.out = pathlib.Path(folder.name, "out")
        self.out.mkdir()
        package = self.tree / "scripts/package"
        package.mkdir(parents=True)
        for name in ("make-release", "make_root.sh"):
            shutil.copy(SOURCE / "scripts/package" / name, package)
        self.put(self.tree / "scripts/build-playground", PLAYGROUND)
        self.put(self.tree / "CMakeLists.txt", "project(pipeline VERSION 9.8.7 LANGUAGES CXX)\n")
        self.put(self.tree / "CHANGELOG.md",
                 "# Log\n\n## 9.8.7 - 2026-11-26\n\n- New.\n\n## 9.8.6 - 2026-11-25\n\n- Old.\n")
        self.put(self.tree / ".gitignore", "/build/\n")
        self.put(self.tree / "build/playground/root/usr/bin/emcmake", "")
        for name in ("scripts/playground/package-lock.json", "build/playground/npm/done"):
            self.put(self.tree / name, "{}")
        self.put(self.bin / "bwrap", BWRAP)
        self.put(self.bin / "mmdebstrap", STUB + 'for new; do :; done\nmkdir -p "$new"\n')
        self.put(self.bin / "node", "#!/bin/sh\necho v0\n")
        self.put(self.bin / "dpkg-query", "#!/bin/sh\necho $#\n")
        self.git("init", "--quiet")
        self.git("config", "core.autocrlf", "true")  # changes no byte of a release
        self.commit()

    def put(self, path, text):
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        path.chmod(0o755)

    def git(self, *words):
        identity = ("-c", "user.name=a", "-c", "user.email=a@b.invalid")
        return subprocess.run(["git", *identity, *words], cwd=self.tree, check=True,
                              capture_output=True).stdout

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "--quiet", "-m", "area: Do", "--allow-empty")

    def start(self, *words):
        return subprocess.Popen([self.tree / "scripts/package/make-release", *words], cwd=self.out, text=True,
                                env={**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}"},
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True)

    def run_it(self, *words):
        process = self.start(*words)
        output, messages = process.communicate(timeout=60)
        return process.returncode, output, messages

    def refused(self, message, version="9.8.7", status=1):
        self.assertEqual(self.run_it(version, "new")[::2], (status, f"make-release: {message}\n"))
        self.assertEqual(os.listdir(self.out), [])

    def test_makes_a_folder_with_notes_and_checksums(self):
        status, output, messages = self.run_it("9.8.7", "./new//.")
        self.assertEqual((status, output.splitlines()[-1], messages), (0, "made ./new//.", ""))
        self.assertRegex(output, "^building 9.8.7 on two processors takes some 30 minutes")
        self.assertEqual(os.listdir(self.out), ["new"])
        new = self.out / "new"
        self.assertEqual((new / "notes.md").read_text(), "- New.\n")
        self.assertEqual((new / "built-with.txt").read_text(),
                         "list\nfor the playground, node v0, and\n3\n2\n")
        done = subprocess.run(["sha256sum", "--strict", "-c", "SHA256SUMS"], cwd=new, capture_output=True,
                              text=True)
        self.assertEqual(done.stdout.splitlines(), [
            f"{name}: OK" for name in ("built-with.txt", "notes.md", "pipeline-9.8.7-playground.html",
                                       "pipeline-9.8.7-source.tar.xz")])

    def test_what_is_there_stays(self):
        (self.out / "link").symlink_to("nowhere")
        (self.out / "folder").mkdir()
        (self.out / "file").write_text("mine")
        for name in ("link", "folder", "file", "/"):
            self.assertEqual(self.run_it("9.8.7", name),
                             (1, "", f"make-release: {name} is there already: name a new folder\n"))
        self.assertEqual(sorted(os.listdir(self.out)), ["file", "folder", "link"])
        self.assertEqual((self.out / "file").read_text(), "mine")
        lock = self.tree / "build/package/lock"
        lock.parent.mkdir()
        lock.symlink_to(self.out / "file")
        self.assertEqual(self.run_it("9.8.7", "file/new")[0], 1)  # before anything is built
        self.assertFalse((self.bin / "playground.runs").exists())
        self.assertEqual((self.out / "file").read_text(), "mine")

    def test_only_a_clean_commit_is_released(self):
        self.git("tag", "v9.8.7")
        self.refused("expected a version such as 1.0.0, found 'HEAD'", version="HEAD", status=2)
        (self.tree / "new file").write_text("")
        self.refused("files have been changed or added since the last commit (git status)")
        (self.tree / "new file").unlink()
        self.commit()
        self.refused("the tag v9.8.7 names another commit")

    def test_when_git_fails_there_is_no_release(self):
        self.put(self.bin / "git", GIT)
        for word in ("archive", "status"):
            self.put(self.bin / "git.fails", word)
            self.assertEqual((self.run_it("9.8.7", "new")[0], os.listdir(self.out)), (1, []))

    def test_the_tag_is_the_last_step(self):
        for name in ("fails", "commits"):
            self.put(self.bin / f"bwrap.{name}", "")
        tags = self.tree / ".git/refs/tags"
        for words, status, names in ((["--tag"], 1, []), ([], 0, []), (["--tag"], 0, ["v9.8.7"])):
            self.assertEqual(self.run_it(*words, "9.8.7", f"new{len(words)}")[0], status)
            self.assertEqual(os.listdir(tags), names)
            (self.bin / "bwrap.fails").unlink(missing_ok=True)
        tagged, built = self.git("rev-parse", "v9.8.7^{commit}", "HEAD^").split()  # a commit came meanwhile
        self.assertEqual(tagged, built)
        self.git("tag", "-d", "v9.8.7")
        self.git("config", "user.name", "")
        self.assertEqual(
            self.run_it("--tag", "9.8.7", "new")[::2],
            (1, "make-release: a tag needs user.name and user.email (git config)\n"))

    def test_all_that_is_missing_is_told_at_once(self):
        shutil.rmtree(self.tree / "build")
        for name in ("node", "dpkg-query"):
            (self.bin / name).unlink()
        for name in ("sh", "dirname", "readlink", "realpath", "git", "grep", "awk", "cmp"):
            os.symlink(shutil.which(name), self.bin / name)
        done = subprocess.run([self.tree / "scripts/package/make-release", "9.8.7", "new"], cwd=self.out,
                              capture_output=True, text=True, env={"PATH": str(self.bin)})
        self.assertEqual(
            done.stderr, "make-release: missing: node flock dpkg-query "
            "build/playground/root/usr/bin/emcmake build/playground/npm; run scripts/install-packages "
            "--checks and then --playground\n")

    def test_version_and_changelog_are_those_of_the_commit(self):
        self.refused("CMakeLists.txt has another version than 9.8.6", version="9.8.6")
        for name, text, message in (("CHANGELOG.md", "## Unreleased\n\n- New.\n",
                                     "no section '## 9.8.7 - DATE'"),
                                    ("CMakeLists.txt", "project(pipeline VERSION 90807 LANGUAGES CXX)\n",
                                     "another version than 9.8.7")):
            self.put(self.tree / name, text)
            self.commit()
            self.refused(f"{name} has {message}")

    def test_a_build_that_fails_says_why_and_is_gone_on_with(self):
        self.put(self.bin / "bwrap.fails", "")
        status, _, messages = self.run_it("9.8.7", "new")
        self.assertEqual((status, messages),
                         (1, "no namespaces\nmake-release: the programs and archives: failed\n"))
        self.assertEqual(os.listdir(self.out), [])
        (self.bin / "bwrap.fails").unlink()
        self.assertEqual(self.run_it("9.8.7", "new")[::2], (0, ""))
        self.assertEqual((self.bin / "playground.runs").read_text(), "run\n")
        kept = sorted(os.listdir(self.tree / "build/package"))
        self.assertEqual(kept, ["lock", "root", "root.log", "root.packages"])

    def test_without_a_network_the_root_is_not_made(self):
        self.put(self.bin / "mmdebstrap", "#!/bin/sh\necho no network >&2\nexit 1\n")
        status, _, messages = self.run_it("9.8.7", "new")
        problem = "build/package/root could not be made; see build/package/root.log"
        self.assertEqual((status, messages.partition(".log")[0] + ".log"),
                         (1, f"no network\nmake_root.sh: {problem}"))
        self.assertEqual(sorted(os.listdir(self.tree / "build/package")), ["lock", "root.log"])

    def test_stopped_half_way_it_leaves_nothing(self):
        for name in ("mmdebstrap", "bwrap"):
            self.put(self.bin / f"{name}.hangs", "")
            process = self.start("9.8.7", "new")
            while not (self.bin / f"{name}.started").exists() and process.poll() is None:
                time.sleep(0.05)
            process.terminate()  # it alone
            process.communicate(timeout=60)
            self.assertEqual((process.returncode, os.listdir(self.out)), (1, []))
            self.assertFalse([*self.tree.glob("build/package/root.[0-9]*")])
            (self.bin / f"{name}.hangs").unlink()

    def test_an_archive_of_half_the_files_is_an_error(self):
        text = (SOURCE / "scripts/package/build_archives.sh").read_text()
        pack = re.search(r"^pack\(\) \{.*?^\}", text, re.M | re.S)[0]
        self.put(self.bin / "tar", "#!/bin/sh\nexit 1\n")
        done = subprocess.run(["sh", "-euc", f"mkdir out\n{pack}\npack x"], cwd=self.bin, capture_output=True,
                              env={"PATH": f"{self.bin}:/usr/bin:/bin", "SOURCE_DATE_EPOCH": "0"})
        self.assertEqual(done.returncode, 1)

    def test_home_is_one_setting(self):
        for name in ("README.md", "CMakeLists.txt"):
            shutil.copy(SOURCE / name, self.tree / name)
        paths = self.tree / "README.md", self.tree / "CMakeLists.txt"
        before = [path.read_text() for path in paths]
        for address, page in (("https://github.com/a/b/", "https://a.github.io/b"),
                              ("https://h.org/b", "https://h.org/b/playground")):
            self.assertEqual(self.run_it("--home", address), (0, "", ""))
            after = [path.read_text() for path in paths]
            home = address.rstrip("/")
            self.assertIn(f"({home}/releases/latest) · [**Try it in the browser**]({page})\n", after[0])
            self.assertIn(f'HOMEPAGE_URL "{home}"', after[1])
        for address, status in (("h.org", 2), ("https://h.org/|", 2), ("https://", 2), ("ht", 2), ("", 0)):
            self.assertEqual(self.run_it("--home", address)[0], status)
        self.assertEqual([path.read_text() for path in paths], before)

    def test_workflows_call_what_is_here(self):
        folder, own = SOURCE / ".github/workflows", "(apt-get|git|gh|mkdir|tar) "
        lines = "".join(path.read_text() for path in folder.iterdir()).splitlines()
        self.assertLessEqual(len(lines), 80)
        for word in [line.partition("- run: ")[2] for line in lines if "- run: " in line]:
            self.assertRegex(word, f"^({own}|scripts/)")
            self.assertTrue(re.match(own, word) or (SOURCE / word.split()[0]).exists(), word)
        if not shutil.which("yamllint"):
            self.skipTest("yamllint is missing (Debian: yamllint)")
        done = subprocess.run(["yamllint", "--strict", folder], capture_output=True, text=True)
        self.assertEqual((done.returncode, done.stdout), (0, ""))


if __name__ == "__main__":
    unittest.main()
