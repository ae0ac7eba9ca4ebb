"""A real Slurm of several nodes on this machine, with a munged of its own, in the current folder."""
import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import time

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "sinfo", "scontrol")
ALONE = ("unshare", "--pid", "--fork", "--kill-child", "--mount-proc")
SETTINGS = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
AuthInfo=socket={here}/munge/socket,cred_expire=5
SlurmctldPort={port}
StateSaveLocation={here}/state
SlurmdSpoolDir={here}/spool-%n
SlurmctldPidFile={here}/slurmctld.pid
SlurmdPidFile={here}/slurmd-%n.pid
SlurmctldLogFile={here}/slurmctld.log
SlurmdLogFile={here}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
SelectType=select/cons_tres
SchedulerParameters=bf_interval=1,sched_interval=2,batch_sched_delay=1
SlurmdParameters=config_overrides
SlurmdTimeout=10
KillWait=2
ReturnToService=2
{nodes}
PartitionName=all Nodes=ALL Default=YES State=UP MaxTime=INFINITE
"""


def free_ports(count):
    """Ports that nobody listens on."""
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.create_server(("127.0.0.1", 0))) for _ in range(count)]
        return [one.getsockname()[1] for one in sockets]


def end(process):
    """Kills the process and what it has started in its session."""
    with contextlib.suppress(ProcessLookupError):
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()


class Cluster:
    """`test` is skipped where no Slurm can be had."""
    def __init__(self, test, names):
        path = os.environ["PATH"] + ":/usr/sbin:/sbin"
        for program in PROGRAMS:
            if not shutil.which(program, path=path):
                test.skipTest(f"{program} is missing (Debian packages slurm-wlm and munge)")
        if os.geteuid() != 0:
            test.skipTest("a Slurm of several nodes on one machine needs root")
        self.here, self.test = pathlib.Path.cwd(), test
        own = {name: word for name, word in os.environ.items() if not name.startswith(("SLURM_", "SBATCH_"))}
        self.environment = {**own, "PATH": path, "SLURM_CONF": f"{self.here}/slurm.conf"}
        host = socket.gethostname().split(".")[0]
        port, *ports = free_ports(len(names) + 1)
        nodes = [
            f"NodeName={name} NodeHostname={host} NodeAddr=127.0.0.1 Port={number} CPUs=2"
            for name, number in zip(names, ports)]
        for folder in ("state", *(f"spool-{name}" for name in names)):
            (self.here / folder).mkdir()
        pathlib.Path("slurm.conf").write_text(
            SETTINGS.format(host=host, here=self.here, port=port, nodes="\n".join(nodes)))
        self.start_munged()
        self.start("slurmctld", "-D")
        self.nodes = {name: self.start(*ALONE, "slurmd", "-D", "-N", name) for name in names}
        self.wait(lambda: self.output("sinfo", "-h", "-o", "%t %D") == f"idle {len(names)}\n",
                  "the nodes to be idle")

    def start_munged(self):
        """The folder is closed to others, against which --force is: no other user has to reach its socket."""
        folder = self.here / "munge"
        folder.mkdir()
        (folder / "key").write_bytes(os.urandom(128))
        (folder / "key").chmod(0o400)
        self.start("munged", "--foreground", "--force", f"--socket={folder}/socket",
                   f"--key-file={folder}/key", f"--pid-file={folder}/pid", f"--log-file={folder}/log",
                   f"--seed-file={folder}/seed")
        self.wait((folder / "socket").exists, "munged to listen")

    def start(self, *words):
        with open(self.here / "daemons.log", "ab") as log:
            process = subprocess.Popen(words, env=self.environment, stdin=subprocess.DEVNULL, stdout=log,
                                       stderr=log, start_new_session=True)
        self.test.addCleanup(end, process)
        return process

    def output(self, *words):
        return subprocess.run(words, env=self.environment, capture_output=True, text=True, timeout=120).stdout

    def wait(self, condition, what, seconds=240):
        """The condition's value, as soon as it is true."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if value := condition():
                return value
            time.sleep(0.1)
        logs = "".join(f"\n{path.name}:\n" + "".join(path.read_text(errors="replace").splitlines(True)[-30:])
                       for path in sorted(self.here.glob("*.log")))
        raise AssertionError(f"waited {seconds} s for {what}{logs}")

    def job(self, **words):
        """Words of the newest job that has these, as scontrol shows them: JobState, Restarts, BatchHost,
        Reason ...; {} if there is none, or if Slurm has forgotten it."""
        jobs = [
            dict(word.split("=", 1) for word in line.split() if "=" in word)
            for line in self.output("scontrol", "show", "job", "-o").splitlines()]
        found = [job for job in jobs if all(job.get(name) == str(word) for name, word in words.items())]
        return max(found, key=lambda job: int(job["JobId"]), default={})

    def kill_node(self, node):
        """As if the power were cut: a name space of processes ends at once with its first."""
        end(self.nodes[node])
