#!/usr/bin/env python3
"""doxygen.py DOXYGEN ROOT: the public headers give no warning; one with an undocumented member does."""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HEADERS = Path("model/include/hmlfc")
PLANTED = "namespace hmlfc {\n/// A planted fault.\nstruct Planted {\n  int undocumented = 0;\n};\n}\n"


def warnings(doxygen, root):
    """What Doxygen says of the tree `root`."""
    environment = {**os.environ, "HMLFC_DOCS_OUTPUT": str(root / "out")}
    (root / "out").mkdir(exist_ok=True)
    done = subprocess.run(
        [doxygen, "docs/Doxyfile"], cwd=root, env=environment, check=True, capture_output=True, text=True
    )
    return [line for line in (done.stdout + done.stderr).splitlines() if line.strip()]


def main():
    doxygen, source = sys.argv[1:]
    if not Path(doxygen).is_file():
        print("doxygen is not installed")
        return 77
    with tempfile.TemporaryDirectory() as folder:
        root = Path(folder)
        shutil.copytree(Path(source) / HEADERS, root / HEADERS)
        (root / "docs").mkdir()
        shutil.copy(Path(source) / "docs/Doxyfile", root / "docs")
        found = warnings(doxygen, root)
        (root / HEADERS / "planted.hpp").write_text(PLANTED)
        planted = warnings(doxygen, root)
    for line in found:
        print(line)
    if not any("planted.hpp" in line and "undocumented" in line for line in planted):
        print("Doxygen does not see a planted undocumented member")
        return 1
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
