#!/usr/bin/env python3
"""Makes the suite anew in a temporary folder and names each file that differs from the one checked in.

Key images with several layers are what OpenJPEG's encoder makes of them, which is not the same in each of its versions:
with another than that of the suite, their vectors are named and left out.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

# What is written by hand and not generated.
BY_HAND = {"README.md", "CHANGES.md", "manifest.schema.json"}
BY_HAND_FOLDERS = ("recipes/", "duts/")

OPENJPEG = "2.5.0"  # made the suite
LAYERED = {"syntax/key-layers-3", "syntax/key-pairs-12", "syntax/key-pairs-18"}


def content(path, left_out):
    """The bytes of a file, of the manifest all but the vectors that are left out."""
    if path.name != "manifest.json" or not left_out:
        return path.read_bytes()
    manifest = json.loads(path.read_bytes())
    manifest["vectors"] = [vector for vector in manifest["vectors"] if vector["id"] not in left_out]
    return manifest


def files_of(folder):
    """The generated files below folder, by name."""
    return {
        name: path
        for path in sorted(folder.rglob("*"))
        if path.is_file() and not (name := path.relative_to(folder).as_posix()).startswith(BY_HAND_FOLDERS)
        and name not in BY_HAND
    }


def differences(made, kept, left_out):
    """One line for each file that is in one folder alone or whose bytes differ, but those of vectors left out."""
    left, right = files_of(made), files_of(kept)
    for name in sorted(left.keys() | right.keys()):
        if name not in right:
            yield f"{name}: generated, but not in the suite"
        elif name not in left:
            yield f"{name}: in the suite, but not generated"
        elif name.rsplit(".", 1)[0] not in left_out and content(left[name], left_out) != content(right[name], left_out):
            yield f"{name}: other bytes than generated"


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=Path, help="hmlfc")
    parser.add_argument("suite", type=Path, help="the folder vectors/")
    parser.add_argument("openjpeg", help="the version of OpenJPEG")
    arguments = parser.parse_args()
    left_out = LAYERED if arguments.openjpeg != OPENJPEG else set()
    for vector in sorted(left_out):
        print(f"{vector}: left out, since OpenJPEG {arguments.openjpeg} makes other layers than {OPENJPEG}")
    with tempfile.TemporaryDirectory(prefix="hmlfc-vectors-") as folder:
        command = [arguments.program, "vectors", "generate", "--suite", arguments.suite, "-o", folder]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
        found = list(differences(Path(folder), arguments.suite, left_out))
    for line in found:
        print(line)
    if found:
        print("Run ./run vectors generate, and state the change in vectors/CHANGES.md")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
