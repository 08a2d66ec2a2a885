#!/usr/bin/env python3
"""Makes the suite anew in a temporary folder and names each file that differs from the one checked in."""

import argparse
import subprocess
import sys
import tempfile
from pathlib import Path

# What is written by hand and not generated.
BY_HAND = {"README.md", "CHANGES.md", "manifest.schema.json"}
BY_HAND_FOLDERS = ("recipes/", "duts/")


def files_of(folder):
    """The generated files below folder, by name."""
    return {
        name: path
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not (name := path.relative_to(folder).as_posix()).startswith(BY_HAND_FOLDERS)
        and name not in BY_HAND
    }


def differences(made, kept):
    """One line for each file that is in one folder alone or whose bytes differ."""
    left, right = files_of(made), files_of(kept)
    for name in sorted(left.keys() | right.keys()):
        if name not in right:
            yield f"{name}: generated, but not in the suite"
        elif name not in left:
            yield f"{name}: in the suite, but not generated"
        elif left[name].read_bytes() != right[name].read_bytes():
            yield f"{name}: other bytes than generated"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="hmlfc")
    parser.add_argument("suite", type=Path, help="the folder vectors/")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory(prefix="hmlfc-vectors-") as folder:
        command = [arguments.program, "vectors", "generate", "--suite", arguments.suite, "-o", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = list(differences(Path(folder), arguments.suite))
    for line in found:
        print(line)
    if found:
        print("Run ./run vectors generate, and state the change in vectors/CHANGES.md")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
