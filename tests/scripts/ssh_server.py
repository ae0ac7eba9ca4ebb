"""A real sshd on this machine's loopback, with keys of its own, under as many host names as wanted."""
import os
import pathlib
import shutil
import subprocess
import time


class SshServer:
    """In the current folder. `commands` gives some hosts a command that their logins run in place of a shell; it finds the client's own in
    $SSH_ORIGINAL_COMMAND. `silent` hosts lead to a port that never answers. `test` is skipped where no sshd can be had."""

    def __init__(self, test, hosts, commands=None, silent=None):
        for program in ("/usr/sbin/sshd", "rsync", "ssh-keygen"):
            if not shutil.which(program):
                test.skipTest(f"{program} is missing")
        here, commands = pathlib.Path.cwd(), commands or {}
        keys = []
        for name in ("server", *hosts):
            subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", name + ".key"], check=True)
        for host in hosts:
            command = f'command="{commands[host]}" ' if host in commands else ""
            keys.append(command + pathlib.Path(host + ".key.pub").read_text())
        pathlib.Path("authorized").write_text("".join(keys))
        if os.geteuid() == 0:
            pathlib.Path("/run/sshd").mkdir(exist_ok=True)
        port = 20000 + os.getpid() % 20000
        self.process = subprocess.Popen(["/usr/sbin/sshd", "-D", "-f", "/dev/null", "-h", here / "server.key", "-p", str(port), "-o", "ListenAddress=127.0.0.1",
                                         "-o", f"AuthorizedKeysFile={here}/authorized", "-o", "StrictModes=no", "-o", "UsePAM=no", "-o", "PidFile=none"],
                                        stderr=subprocess.DEVNULL)
        test.addCleanup(self.process.wait)
        test.addCleanup(self.process.terminate)
        texts = [f"Host {host}\n  HostName 127.0.0.1\n  Port {(silent or {}).get(host, port)}\n  IdentityFile {here}/{host}.key\n  IdentitiesOnly yes\n"
                 f"  StrictHostKeyChecking no\n  UserKnownHostsFile {here}/known\n  LogLevel ERROR\n  ConnectTimeout 2\n" for host in hosts]
        pathlib.Path("ssh.txt").write_text("".join(texts))
        self.words = ["--ssh", f"ssh -F {here}/ssh.txt"]
        for _ in range(50):
            done = subprocess.run(["ssh", "-F", "ssh.txt", hosts[0], "true"], capture_output=True, text=True)
            if done.returncode == 0:
                return
            time.sleep(0.1)
        test.skipTest("no login through a sshd of this user: " + done.stderr.strip())
