#!/usr/bin/env python3
"""Runs clang-tidy with the repository's .clang-tidy; any finding is a failure.

clang_tidy.py BUILD ROOT FOLDER...: every file of the build below ROOT/FOLDER.

Exit: 0 clean, 1 findings, 77 no run-clang-tidy-16 (older clang does not read libstdc++ 12 as C++20).
"""

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

RUN = "run-clang-tidy-16"
SKIPPED = 77


def commands(build):
    """The compile commands of the build. A unit made of several files stands for one command each."""
    entries = []
    for entry in json.loads((build / "compile_commands.json").read_text()):
        unit = entry["file"]
        parts = [unit]
        if "/Unity/" in unit:
            parts = re.findall(r'^#include "(.*)"$', Path(unit).read_text(), re.MULTILINE)
        entries += [dict(entry, file=part, command=entry["command"].replace(unit, part)) for part in parts]
    return entries


def findings(root, entries, files):
    """The warnings and errors of clang-tidy in the files that match one of the expressions `files`."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "compile_commands.json").write_text(json.dumps(entries))
        command = [RUN, "-quiet", "-p", folder, "-config-file", root / ".clang-tidy"]
        jobs = len(os.sched_getaffinity(0))
        result = subprocess.run([*command, "-j", str(jobs), *files], capture_output=True, text=True)
    found = [line for line in result.stdout.splitlines() if re.search(r": (warning|error): ", line)]
    return found or ([result.stderr] if result.returncode else [])


def check(build, root, folders):
    entries = commands(build)
    below = [f"^{re.escape(str(root / folder))}/" for folder in folders]
    for expression in below:
        if not any(re.search(expression, entry["file"]) for entry in entries):
            sys.exit(f"the build has no file that matches {expression}")
    found = findings(root, entries, below)
    print("\n".join(dict.fromkeys(found)) or "clean")
    return 1 if found else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("root", type=Path)
    parser.add_argument("folders", nargs="*")
    arguments = parser.parse_args()
    if not shutil.which(RUN):
        print(f"{RUN} is not installed (Debian: clang-tidy-16)")
        return SKIPPED
    root = arguments.root.resolve()
    return check(arguments.build, root, arguments.folders)


if __name__ == "__main__":
    sys.exit(main())
