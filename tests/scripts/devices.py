"""Devices to write to: only root could replace them, and root gets nodes of its own."""
import os
import stat
import unittest

IS_ROOT = os.geteuid() == 0


def device(minor, name):
    """A path to a memory device: /dev/NAME, which only root could replace. Root gets a node of its own, in
    the current folder, so that a faulty writer does no harm to the machine."""
    if not IS_ROOT:
        return f"/dev/{name}"
    try:
        os.mknod(name, 0o666 | stat.S_IFCHR, os.makedev(1, minor))
        open(name, "wb").close()
    except OSError as error:
        raise unittest.SkipTest(f"no device of its own: {error.strerror}") from None
    return name


def null_device():
    return device(3, "null")


def full_device():
    return device(7, "full")
