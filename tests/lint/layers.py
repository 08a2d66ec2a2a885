#!/usr/bin/env python3
"""Checks the shape of the source tree and prints each violation as file:line: reason.

Layers: a file includes only its own layer, the layers below it and public headers.
Length: no source file is longer than MAX_LINES.
Lists:  each .cpp file stands in its folder's list of sources, so that none is left unbuilt.
"""

import argparse
import re
import sys
from pathlib import Path

from sources import cpp_files, source_files

MAX_LINES = 400

# What the files of model/<layer>/ may include, besides <hmlfc/...> and libraries. Public headers
# (model/include/) include no layer.
ALLOWED = {
    "include": set(),
    "bits": {"bits"},
    "values": {"bits", "values"},
    "fields": {"bits", "values", "fields"},
    "samples": {"bits", "values", "fields", "samples"},
    "render": {"bits", "values", "fields", "samples", "render"},
    "encoder": {"bits", "values", "fields", "samples", "encoder"},
    "io": {"io"},
    "scenes": {"scenes", "io"},
    "vectors": {"bits", "values", "fields", "samples", "encoder", "io", "scenes", "vectors"},
    "conform": {"bits", "values", "fields", "samples", "encoder", "io", "vectors", "conform"},
    "dut": set(),  # decoders behind public headers
    "cli": {
        *("bits", "values", "fields", "samples", "encoder", "render", "io", "scenes", "cli"),
        *("gpu_ref", "vectors", "conform"),
    },
    "gpu_ref": set(),  # beside model/: renders on a device, for cli
}

# Folders with .cpp files and the one list that names them all, relative to the list's folder; a
# folder below another has a list of its own.
SOURCE_LISTS = {
    "model": "model/CMakeLists.txt",
    "tests": "tests/CMakeLists.txt",
    "tests/decode_path": "tests/decode_path/CMakeLists.txt",
    "tests/fuzz": "tests/fuzz/CMakeLists.txt",
    "tests/mutation/rtl": "tests/mutation/rtl/CMakeLists.txt",
    "tests/stress": "tests/stress/CMakeLists.txt",
    "bench": "bench/CMakeLists.txt",
    "testbench": "testbench/CMakeLists.txt",
    "gpu_ref": "gpu_ref/CMakeLists.txt",
}
# A project of its own, with its own list.
OWN_PROJECTS = ["tests/consumer/project"]

QUOTED_INCLUDE = re.compile(r'\s*#\s*include\s*"([^"]*)"')


def layer_violations(root):
    for path in cpp_files(root / "model"):
        layer = path.relative_to(root / "model").parts[0]
        if layer not in ALLOWED:
            yield path, 1, f"model/{layer} is not a layer of the table in tests/lint/layers.py"
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            match = QUOTED_INCLUDE.match(line)
            if not match:
                continue
            target = match.group(1).split("/")[0]
            if "/" not in match.group(1) or target not in ALLOWED or target == "include":
                yield path, number, (
                    f'"{match.group(1)}" does not name a layer: '
                    "write <...> for public headers and libraries"
                )
            elif target not in ALLOWED[layer]:
                yield path, number, f'{layer} may not include {target} ("{match.group(1)}")'


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
    found = [*layer_violations(root), *length_violations(root), *list_violations(root)]
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
