"""launch.py DESCRIPTOR COMMAND...: runs a command and writes what it cost to an open file as JSON.

cpu_seconds: user and system time of all its threads; peak_bytes: its largest resident memory. This
process is small and imports little: until a child has pages of its own, its peak is that of the
process it was forked from.
"""

import json
import os
import sys


def launch(report, command):
    """Exit status of the command; 128 + N where signal N ended it."""
    child = os.fork()
    if child == 0:
        os.close(report)
        try:
            os.execvp(command[0], command)
        except OSError as error:
            print(f"{command[0]} does not start: {error.strerror}", file=sys.stderr)
        os._exit(127)
    _, status, usage = os.wait4(child, 0)
    cost = {
        "cpu_seconds": usage.ru_utime + usage.ru_stime,
        "peak_bytes": usage.ru_maxrss * 1024,
    }
    os.write(report, json.dumps(cost).encode())
    code = os.waitstatus_to_exitcode(status)
    return code if code >= 0 else 128 - code


if __name__ == "__main__":
    sys.exit(launch(int(sys.argv[1]), sys.argv[2:]))
