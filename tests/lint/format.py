#!/usr/bin/env python3
"""Checks every C++ file of a tree with clang-format 14 (other versions format differently).

format.py CLANG_FORMAT ROOT: the files below ROOT.

Exit: 0 formatted, 1 not (each place is printed), 77 no clang-format 14 to check with.
"""

import re
import subprocess
import sys
from pathlib import Path

from sources import cpp_files

SKIPPED = 77


def major_version(program):
    """The major version of a clang-format, or None where it cannot be run."""
    try:
        answer = subprocess.run([program, "--version"], capture_output=True, text=True, check=True)
    except (OSError, subprocess.CalledProcessError):
        return None
    match = re.search(r"version (\d+)", answer.stdout)
    return int(match.group(1)) if match else None


def complaints(program, root):
    """What clang-format says of the tree; each place on a line."""
    files = cpp_files(root)
    if not files:
        return f"no C++ file below {root}\n"
    command = [program, "--style=file", "--dry-run", "-Werror", *files]
    return subprocess.run(command, stderr=subprocess.PIPE, text=True, check=False).stderr


def main():
    program, root = sys.argv[1], Path(sys.argv[2])
    if major_version(program) != 14:
        print(f"{program} is not clang-format 14")
        return SKIPPED
    found = complaints(program, root)
    print(found, end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
