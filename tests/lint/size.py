#!/usr/bin/env python3
"""Lines of code by folder, and whether each keeps to its limit; verification never outweighs the product.

usage: size.py ROOT

Lines are those of files that git knows, with blank ones and comments, without vectors/. A limit may fall;
what raises it is a capability that users asked for, which the commit names.
"""

import subprocess
import sys
from collections import Counter
from pathlib import Path

ENDINGS = (".cpp", ".hpp", ".h", ".c", ".sv", ".svh", ".v", ".comp", ".glsl", ".py", ".sh", ".cmake",
           ".js", ".css", ".html", "CMakeLists.txt")  # fmt: skip
SKIPPED = 77
VERIFICATION = ("tests/", "testbench/", "bench/", "rtl/formal/")
LIMITS = {
    "tests/": 42648,
    "testbench/": 10243,
    "bench/": 4000,
    "rtl/formal/": 2500,
    "tools/": 40936,
    "model/": 25080,
    "": 155528,
}


def lines_by_file(root):
    """{file: lines} of every source file. CalledProcessError where `root` is no checkout of git."""
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=root, capture_output=True, check=True).stdout
    names = (name for name in listed.decode().split("\0") if name.endswith(ENDINGS) and not name.startswith("vectors/"))
    return {name: (root / name).read_bytes().count(b"\n") for name in names if (root / name).is_file()}


def main():
    try:
        lines = lines_by_file(Path(sys.argv[1]))
    except (OSError, subprocess.CalledProcessError) as error:
        print(f"SKIPPED: {error}")
        return SKIPPED
    total = Counter()
    for name, count in lines.items():
        total[""] += count
        for folder in LIMITS:
            if folder and name.startswith(folder):
                total[folder] += count
    print(f"{'folder':<14}{'lines':>8}{'limit':>8}")
    for folder, limit in LIMITS.items():
        print(f"{folder or 'all':<14}{total[folder]:>8}{limit:>8}")
    checks = sum(count for name, count in lines.items() if name.startswith(VERIFICATION))
    print(f"{'verification':<14}{checks:>8}{total[''] - checks:>8}")
    large = [folder or "all" for folder, limit in LIMITS.items() if total[folder] > limit]
    if checks > total[""] - checks:
        large.append("verification, next to the product")
    for folder in large:
        print(f"too many lines: {folder}")
    return 1 if large else 0


if __name__ == "__main__":
    sys.exit(main())
