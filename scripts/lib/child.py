"""What a child process has cost."""
import os


def finished(process):
    """Waits for a subprocess.Popen, sets its returncode, and returns its resource usage (resource.struct_rusage), which Popen.wait
    throws away."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage


def cpu_seconds(usage):
    """User and system."""
    return usage.ru_utime + usage.ru_stime
