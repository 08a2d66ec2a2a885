#!/usr/bin/env python3
"""Checks the shape of the source tree and prints each violation as file:line: reason.

Layers: a file includes only its own folder, the folders that ALLOWED names for it and public headers.
Cycles: ALLOWED names only folders above in the table, so that there is no cycle.
Length: no source file is longer than MAX_LINES.
Lists:  each .cpp file is in the list of sources of its folder, so that none is left unbuilt.
"""

import argparse
import re
import sys
from pathlib import Path

from sources import cpp_files, source_files

MAX_LINES = 400

SYNTAX = {"model/bits", "model/arithmetic", "model/syntax"}
DECODER = {*SYNTAX, "model/decoder", "model/decoder/golden", "model/decoder/fast"}
CODEC = {*DECODER, "model/render", "model/encoder"}
TOOLS = {f"tools/{name}" for name in ("io", "scenes", "vectors", "conform", "cli")}
APPLICATIONS = {*CODEC, *TOOLS, "gpu_ref"}

# What the files of a folder may include with quotes, besides the folder itself, in the order of the
# layers; all may include <hmlfc/...> and libraries. A file belongs to the longest folder that holds it.
ALLOWED = {
    "model/include": set(),
    "model/bits": set(),
    "model/arithmetic": {"model/bits"},
    "model/syntax": {"model/bits", "model/arithmetic"},
    "model/decoder": DECODER,
    "model/decoder/golden": DECODER - {"model/decoder/fast"},
    "model/decoder/fast": DECODER,
    "model/render": DECODER,
    "model/encoder": DECODER,
    "gpu_ref": CODEC - {"model/encoder"},
    "tools/io": {"model/bits"},
    "tools/scenes": {"tools/io"},
    "tools/vectors": {*CODEC, "tools/io", "tools/scenes"} - {"model/render"},
    "tools/conform": {*CODEC, "tools/io", "tools/vectors"} - {"model/render"},
    "tools/dut": set(),
    "tools/tables": SYNTAX,
    "tools/cli": APPLICATIONS,
    "testbench": APPLICATIONS,
    "bench": APPLICATIONS,
    "tests": {*APPLICATIONS, "testbench", "bench"},
    "examples": set(),
}
# The decoder's shared files and its two paths include each other; tests keep golden off fast.
ONE_LAYER = {"model/decoder", "model/decoder/golden", "model/decoder/fast"}
# Where a quoted name is looked up, after the folder of the file and its topmost folder.
ROOTS = ("model", "tools", "gpu_ref", "testbench", "bench", ".")

# Folders with .cpp files and the list that names them all, relative to the folder; a folder below
# another has its own list.
SOURCE_LISTS = {
    "model": "model/CMakeLists.txt",
    "tools": "tools/CMakeLists.txt",
    "tests": "tests/CMakeLists.txt",
    "tests/decode_path": "tests/decode_path/CMakeLists.txt",
    "tests/fuzz": "tests/fuzz/CMakeLists.txt",
    "tests/mutation/rtl": "tests/mutation/rtl/CMakeLists.txt",
    "tests/mutation/shaders": "tests/mutation/shaders/CMakeLists.txt",
    "tests/stress": "tests/stress/CMakeLists.txt",
    "bench": "bench/CMakeLists.txt",
    "testbench": "testbench/CMakeLists.txt",
    "gpu_ref": "gpu_ref/CMakeLists.txt",
}
# A separate project with its own list.
OWN_PROJECTS = ["tests/consumer/project"]

QUOTED_INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]*)"')


def folder_of(name):
    """The folder of ALLOWED that holds file `name`, or None."""
    parts = name.split("/")[:-1]
    for length in range(len(parts), 0, -1):
        if "/".join(parts[:length]) in ALLOWED:
            return "/".join(parts[:length])
    return None


def included_file(root, path, name):
    """The file that `#include "name"` in `path` means, relative to root; None: no source file."""
    top = root / path.relative_to(root).parts[0]
    for base in (path.parent, top, *(root / folder for folder in ROOTS)):
        found = (base / name).resolve()
        if found.is_file() and found.is_relative_to(root):
            return found.relative_to(root).as_posix()
    return None


def layer_violations(root):
    for path in cpp_files(root):
        name = path.relative_to(root).as_posix()
        folder = folder_of(name)
        if folder is None:
            if name.split("/")[0] in ("model", "tools"):
                yield path, 1, f"{Path(name).parent} is not a folder of the table in tests/lint/layers.py"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = QUOTED_INCLUDE.match(line)
            if match:
                reason = include_violation(root, path, folder, match.group(1))
                if reason:
                    yield path, number, reason


def include_violation(root, path, folder, name):
    """Why a file of `folder` may not include "name", or None."""
    target = included_file(root, path, name)
    if target is None:  # generated, or missing
        known = folder.split("/")[0] in ("model", "tools")
        return f'"{name}" is no file: write <...> for public headers and libraries' if known else None
    layer = folder_of(target)
    if layer == "model/include" and folder != layer:
        return f'"{name}" is a public header: write <...>'
    if layer not in {folder, *ALLOWED[folder]}:
        return f'{folder} may not include {layer} ("{name}")'
    return None


def cycle_violations(root):
    rank = {folder: number for number, folder in enumerate(ALLOWED)}
    for folder, targets in ALLOWED.items():
        for target in sorted(targets):
            if rank[target] > rank[folder] and not {folder, target} <= ONE_LAYER:
                yield root / "tests/lint/layers.py", 1, f"ALLOWED: {folder} names {target}, which is not above it"


def length_violations(root):
    for path in source_files(root):
        lines = path.read_text().count("\n")
        if lines > MAX_LINES:
            yield path, MAX_LINES + 1, f"{lines} lines, more than {MAX_LINES}"


def list_violations(root):
    for folder, list_name in SOURCE_LISTS.items():
        if not (root / folder).is_dir():
            continue
        list_path = root / list_name
        listed = set(re.split(r"[\s()]+", list_path.read_text())) if list_path.exists() else set()
        inner = [other for other in SOURCE_LISTS if other.startswith(folder + "/")]
        for path in cpp_files(root / folder):
            if any(path.is_relative_to(root / other) for other in inner):
                continue
            name = path.relative_to(root / folder).as_posix()
            own = any(path.is_relative_to(root / project) for project in OWN_PROJECTS)
            if path.suffix == ".cpp" and name not in listed and not own:
                yield path, 1, f"not listed in {list_name}"


def violations(root):
    """All violations below root, as 'file:line: reason' with the file relative to root."""
    checks = (layer_violations, cycle_violations, length_violations, list_violations)
    found = [violation for check in checks for violation in check(root)]
    return [f"{path.relative_to(root)}:{line}: {reason}" for path, line, reason in found]


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("root", type=Path, help="the repository")
    found = violations(parser.parse_args().root.resolve())
    for violation in found:
        print(violation)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
