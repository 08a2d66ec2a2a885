#!/usr/bin/env python3
"""Checks the shape of the source tree and prints each violation as file:line: reason.

Layers: a file includes only its own folder, the folders that ALLOWED names for it and public headers.
Golden: nothing that the golden path includes, directly or not, belongs to the fast path.
Cycles: ALLOWED names only folders above in the table, so that there is no cycle; no CMake file names
        a folder on top of its own.
Length: no source file is longer than MAX_LINES.
Lists:  the nearest CMakeLists.txt above a .cpp file names it, so that none is left unbuilt.
"""

import argparse
import re
import sys
from pathlib import Path

from sources import cpp_files, source_files

MAX_LINES = 320

SYNTAX = {"model/bits", "model/arithmetic", "model/syntax"}
DECODER = {*SYNTAX, "model/decoder", "model/decoder/golden", "model/decoder/fast"}
CODEC = {*DECODER, "model/render", "model/encoder"}
TOOLS = {f"tools/{name}" for name in ("terminal", "io", "remote", "scenes", "vectors", "conform", "cli", "view")}
GPU = {f"gpu_ref/{name}" for name in ("device", "decode", "render")}
APPLICATIONS = {*CODEC, *TOOLS, *GPU}
CHECKS = {*DECODER, "rtl/driver", "tools/io", "testbench/oracle", "testbench/stimulus"}
TESTBENCH = {"rtl/driver", *(f"testbench/{name}" for name in ("oracle", "stimulus", "unit", "systemc", "tlm", "gpu", "view"))}

# What the files of a folder may include with quotes, besides the folder itself, in the order of the
# layers; all may include <hmlfc/...> and libraries. A file belongs to the longest folder that holds it.
ALLOWED = {
    "rtl/driver": set(),
    "rtl/example": {"rtl/driver"},
    "rtl/fpga": {"rtl/driver", "rtl/example"},
    "model/include": set(),
    "model/bits": set(),
    "model/arithmetic": {"model/bits"},
    "model/syntax": {"model/bits", "model/arithmetic"},
    "model/decoder": DECODER,
    "model/decoder/golden": DECODER - {"model/decoder/fast"},
    "model/decoder/fast": DECODER,
    "model/render": DECODER,
    "model/encoder": DECODER,
    "model/capi": {"model/bits"},
    "gpu_ref/include": set(),
    "gpu_ref/shaders": set(),
    "gpu_ref/device": {"model/bits", "model/arithmetic", "gpu_ref/shaders"},
    "gpu_ref/decode": {*DECODER, "gpu_ref/device"},
    "gpu_ref/render": {*DECODER, "model/render", "gpu_ref/device", "gpu_ref/decode"},
    "gpu_ref/wasm": {*DECODER, "model/render", "gpu_ref/device", "gpu_ref/decode"},
    "gpu_ref": {*DECODER, *GPU},
    "tools/terminal": set(),
    "tools/io": {"model/bits"},
    "tools/remote": {"model/bits", "tools/io"},
    "tools/scenes": {"tools/io"},
    "tools/vectors": {*CODEC, "tools/io", "tools/scenes"} - {"model/render"},
    "tools/dut": {"tools/io"},
    "tools/conform": {*CODEC, "tools/io", "tools/vectors", "tools/dut"} - {"model/render"},
    "tools/tables": SYNTAX,
    "tools/python": {"tools/io", "tools/remote"},
    "tools/cli": APPLICATIONS - {"tools/view"},
    "tools/view": APPLICATIONS,
    "fallback": {"model/bits", "model/encoder", "tools/io", "tools/remote"},
    "fallback/windows": APPLICATIONS,
    "testbench/oracle": DECODER,
    "testbench/stimulus": {*DECODER, "testbench/oracle", "tools/scenes", "tools/vectors"},
    "testbench/unit": CHECKS,
    "testbench/systemc": {*CHECKS, "tools/scenes", "testbench/unit"},
    "testbench/tlm": {*CHECKS, "testbench/unit", "testbench/systemc"},
    "testbench/view": {*CHECKS, "testbench/unit"},
    "testbench/gpu": {*CHECKS, "model/render", *GPU},
    "testbench/programs": {*APPLICATIONS, *TESTBENCH},
    "bench": {*APPLICATIONS, "testbench/gpu"},
    "tests": {*APPLICATIONS, *TESTBENCH},
    "examples": set(),
}
# The shared files of the decoder and its two paths include each other.
ONE_LAYER = {"model/decoder", "model/decoder/golden", "model/decoder/fast"}
# Folder to one that its files must not reach through any chain of includes.
UNREACHABLE = {"model/decoder/golden": "model/decoder/fast"}
# Where a quoted name is looked up, after the folder of the file and its topmost folder.
ROOTS = ("model", "tools", "gpu_ref", "rtl", "testbench", ".")

PROJECT_FOLDER = re.compile(r"\$\{PROJECT_SOURCE_DIR\}/(\w+)")
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
    if layer.endswith("/include") and folder != layer:
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
    tops = list(dict.fromkeys(folder.split("/")[0] for folder in ALLOWED))
    for path in source_files(root):
        top = path.relative_to(root).parts[0]
        if path.suffix not in (".txt", ".cmake") or top not in tops:
            continue
        for number, line in enumerate(path.read_text().splitlines(), 1):
            for named in PROJECT_FOLDER.findall(line):
                if named in tops and tops.index(named) > tops.index(top):
                    yield path, number, f"{top} may not use {named}"


def includes_of(root, name):
    """The files of the repository that file `name` includes with quotes, by line."""
    path = root / name
    for number, line in enumerate(path.read_text().splitlines(), 1):
        match = QUOTED_INCLUDE.match(line)
        target = match and included_file(root, path, match.group(1))
        if target:
            yield number, target


def reach_violations(root):
    """Chains of two includes or more from a folder of UNREACHABLE; layer_violations has the others."""
    for path in cpp_files(root):
        folder = folder_of(path.relative_to(root).as_posix())
        forbidden = UNREACHABLE.get(folder)
        if forbidden is None:
            continue
        for number, first in includes_of(root, path.relative_to(root).as_posix()):
            chain = chain_to(root, first, forbidden)
            if len(chain) > 1:
                yield path, number, f"{folder} reaches {forbidden}: {' -> '.join(chain)}"


def chain_to(root, first, folder):
    """The shortest chain of includes from file `first` to a file of `folder`; empty if there is none."""
    chains = [[first]]
    known = {first}
    for chain in chains:  # grows
        if folder_of(chain[-1]) == folder:
            return chain
        for _, target in includes_of(root, chain[-1]):
            if target not in known:
                known.add(target)
                chains.append([*chain, target])
    return []


def length_violations(root):
    for path in source_files(root):
        lines = path.read_text().count("\n")
        if lines > MAX_LINES:
            yield path, MAX_LINES + 1, f"{lines} lines, more than {MAX_LINES}"


def list_violations(root):
    for path in cpp_files(root):
        lists = [folder / "CMakeLists.txt" for folder in path.parents if folder.is_relative_to(root)]
        nearest = next((file for file in lists if file.is_file()), lists[-1])
        listed = re.split(r"[\s()]+", nearest.read_text()) if nearest.is_file() else []
        if path.suffix == ".cpp" and path.relative_to(nearest.parent).as_posix() not in listed:
            yield path, 1, f"not listed in {nearest.relative_to(root)}"


def violations(root):
    """All violations below root, as 'file:line: reason' with the file relative to root."""
    checks = (layer_violations, reach_violations, cycle_violations, length_violations, list_violations)
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
