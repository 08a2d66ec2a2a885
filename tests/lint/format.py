#!/usr/bin/env python3
"""Checks every C++ file of a tree with clang-format 14 (other versions format differently).

Exit: 0 formatted, 1 not (each place is printed), 77 no clang-format 14 to check with.
"""

import argparse
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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", help="clang-format 14")
    parser.add_argument("root", type=Path, help="the folder to check, with a .clang-format")
    arguments = parser.parse_args()
    if major_version(arguments.program) != 14:
        print(f"{arguments.program} is not clang-format 14")
        return SKIPPED
    files = cpp_files(arguments.root)
    if not files:
        print(f"no C++ file below {arguments.root}")
        return 1
    command = [arguments.program, "--style=file", "--dry-run", "-Werror", *files]
    return 1 if subprocess.run(command, check=False).returncode != 0 else 0


if __name__ == "__main__":
    sys.exit(main())
