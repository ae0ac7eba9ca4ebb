"""Runs a pipe of commands and prints what it cost. Linux charges a process with the memory of the one that
started it, so this one imports next to nothing: start it with `python3 -I -S`.

usage: launcher.py STDIN STDOUT NOTES COMMAND [ARGUMENT...] [| COMMAND [ARGUMENT...]]...

STDIN, STDOUT and NOTES (the stderr of all) are files. Prints the wall seconds, then a line `STATUS
USER_SECONDS SYSTEM_SECONDS KIBIBYTES` for each command; the memory is its largest resident set.
"""
import os
import sys
import time


def started(command, stdin, stdout, notes):
    child = os.fork()
    if child == 0:
        for number, file in enumerate((stdin, stdout, notes)):
            os.dup2(file, number)
        try:
            os.execv(command[0], command)
        finally:
            os._exit(127)
    return child


def main():
    source, sink, notes_path, *words = sys.argv[1:]
    commands = [[]]
    for word in words:
        if word == "|":
            commands.append([])
        else:
            commands[-1].append(word)
    # Of pipes and files, the children keep only the copies that dup2 makes.
    write = os.O_WRONLY | os.O_CREAT | os.O_TRUNC
    notes, stdin, children = os.open(notes_path, write, 0o600), os.open(source, os.O_RDONLY), []
    begin = time.monotonic()
    for i, command in enumerate(commands):
        next_stdin, stdout = os.pipe() if i + 1 < len(commands) else (None, os.open(sink, write, 0o600))
        children.append(started(command, stdin, stdout, notes))
        os.close(stdin)
        os.close(stdout)
        stdin = next_stdin
    costs = []
    for child in children:
        _, status, usage = os.wait4(child, 0)
        costs.append((os.waitstatus_to_exitcode(status), usage.ru_utime, usage.ru_stime, usage.ru_maxrss))
    print(time.monotonic() - begin)
    for cost in costs:
        print(*cost)


main()
