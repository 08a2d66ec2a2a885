#!/usr/bin/env python3
"""Checks every C++ file of a tree with clang-format 14 (other versions format differently).

format.py CLANG_FORMAT ROOT [--self-test]: the files below ROOT; or a clean file and a faulty one, by ROOT's style.

Exit: 0 formatted, 1 not (each place is printed), 77 no clang-format 14 to check with.
"""

import re
import shutil
import subprocess
import sys
import tempfile
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


def planted(program, root, text):
    """The complaints about a tree with one file, with the style of `root`."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(root / ".clang-format", folder)
        (Path(folder) / "planted.cpp").write_text(text)
        return complaints(program, Path(folder))


def main():
    program, root = sys.argv[1], Path(sys.argv[2])
    if major_version(program) != 14:
        print(f"{program} is not clang-format 14")
        return SKIPPED
    if sys.argv[3:] == ["--self-test"]:
        found = planted(program, root, "int main()\n{\n    return 0; }\n")
        clean = planted(program, root, "int main() { return 0; }\n")
        return 0 if "planted.cpp:1:" in found and not clean and not major_version("no-such-program") else 1
    found = complaints(program, root)
    print(found, end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
