#!/usr/bin/env python3
"""TypeScript's compiler finds no error in JavaScript with types in its comments.

usage: javascript.py FOLDER

First a planted fault, which it has to find.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

OPTIONS = (
    *("--noEmit", "--allowJs", "--checkJs", "--strict", "--noUnusedLocals", "--noImplicitReturns"),
    *("--target", "es2022", "--module", "es2022", "--lib", "es2022,dom,dom.iterable"),
)
PLANTED = '/** @param {number} x */\nexport const twice = (x) => 2 * x;\ntwice("1");\n'
SKIPPED = 77


def complaints(files):
    result = subprocess.run(["tsc", *OPTIONS, *map(str, files)], stdout=subprocess.PIPE, text=True, check=False)
    return result.stdout if result.returncode != 0 else ""


def main():
    if shutil.which("tsc") is None:
        print("skipped: node-typescript is missing")
        return SKIPPED
    with tempfile.TemporaryDirectory() as folder:
        planted = Path(folder) / "planted.js"
        planted.write_text(PLANTED)
        if "TS2345" not in complaints([planted]):
            print("a planted fault is not found")
            return 1
    files = sorted(Path(sys.argv[1]).glob("*.js"))
    found = complaints(files) if files else "no files"
    print(found, end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
