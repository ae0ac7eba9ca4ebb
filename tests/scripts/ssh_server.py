"""A real sshd on this machine's loopback, with keys of its own, under as many host names as wanted."""
import os
import pathlib
import shutil
import socket
import subprocess
import time

PATIENCE = 120  # seconds: where the machine is busy, a login takes long
FULL_BYTES = 8192  # of the disk of a full host, less than a part of a test's scene


class SshServer:
    """In the current folder; each host's logins start in a folder of its name. `full` is a host with a full
    disk, `silent` hosts lead to a port that never answers. `test` is skipped where no sshd can be had."""
    def __init__(self, test, hosts, full=None, silent=None):
        for program in ("/usr/sbin/sshd", "ssh", "rsync", "ssh-keygen"):
            if not shutil.which(program):
                test.skipTest(
                    f"{program} is missing (Debian packages openssh-server, openssh-client and rsync)")
        self.here, silent = pathlib.Path.cwd(), silent or {}
        for name in ("server", *hosts):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", name + ".key"], check=True)
        for host in hosts:
            pathlib.Path(host).mkdir()
        # A disk of its own, which only sshd and its logins see, and which goes with them; else a limit on
        # files is the disk's end.
        mount = [
            "unshare", "-m", "sh", "-c", 'mount -t tmpfs -o size="$0" tmpfs "$1" && shift && exec "$@"',
            str(FULL_BYTES),
            str(full)]
        self.has_full_disk = bool(full) and subprocess.run([*mount, "true"],
                                                           capture_output=True).returncode == 0
        keys = ""
        for host in hosts:
            limit = "ulimit -f 1; " if host == full and not self.has_full_disk else ""
            keys += (f'command="cd {self.here}/{host}; {limit}eval \\"$SSH_ORIGINAL_COMMAND\\"" '
                     f'{pathlib.Path(host + ".key.pub").read_text()}')
        pathlib.Path("authorized").write_text(keys)
        pathlib.Path("home").mkdir()
        if os.geteuid() == 0:
            pathlib.Path("/run/sshd").mkdir(exist_ok=True)
        with socket.create_server(("127.0.0.1", 0)) as free:
            port = free.getsockname()[1]
        # The home is empty, as what a user's shell reads there at its start may take long, or speak.
        options = [
            f"ListenAddress=127.0.0.1:{port}", f"AuthorizedKeysFile={self.here}/authorized", "StrictModes=no",
            "UsePAM=no", "PidFile=none", "MaxStartups=100", "LoginGraceTime=0",
            f"SetEnv=HOME={self.here}/home"]
        words = [
            "/usr/sbin/sshd", "-D", "-f", "/dev/null", "-h",
            str(self.here / "server.key"), *(word for option in options for word in ("-o", option))]
        self.process = subprocess.Popen([*(mount if self.has_full_disk else []), *words],
                                        stderr=subprocess.DEVNULL)
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.terminate)
        texts = [
            f"Host {host}\n  HostName 127.0.0.1\n  Port {silent.get(host, port)}\n  ConnectTimeout "
            f"{1 if host in silent else PATIENCE}\n"
            f"  IdentityFile {self.here}/{host}.key\n  IdentitiesOnly yes\n  StrictHostKeyChecking no\n  "
            f"UserKnownHostsFile {self.here}/known\n"
            f"  LogLevel ERROR\n" for host in hosts]
        pathlib.Path("ssh.txt").write_text("".join(texts))
        self.words = ["--ssh", f"ssh -F {self.here}/ssh.txt"]
        self.expect_login(test, next(host for host in hosts if host not in silent and host != full))

    def expect_login(self, test, host):
        end = time.monotonic() + PATIENCE
        while True:
            done = subprocess.run(["ssh", "-F", "ssh.txt", host, "true"], stdin=subprocess.DEVNULL,
                                  capture_output=True, text=True)
            if done.returncode == 0:
                return
            if "refused" not in done.stderr or self.process.poll() is not None or time.monotonic() > end:
                test.skipTest("no login through a sshd of this user: " + done.stderr.strip())
            time.sleep(0.1)
