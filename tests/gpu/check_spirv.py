#!/usr/bin/env python3
"""Checks one shader, the numbers that C++ includes: spirv-val accepts it, and it uses 32-bit integers alone.

Floating point, 64-bit integers and subgroup operations have no place in a decode path: their
results or their presence differ between devices. With --self-test shaders that use them are
compiled, and each must be refused.

Exit: 0 good, 1 not (each reason is printed), 77 no SPIR-V tools, or no shader was built.
"""

import argparse
import re
import shutil
import struct
import subprocess
import sys
import tempfile
from pathlib import Path

SKIPPED = 77
TARGET = "--target-env=vulkan1.2"
FORBIDDEN = {
    r"OpTypeFloat\b": "floating point",
    r"OpTypeInt (?!32\b)\d+": "integers that do not have 32 bits",
    r"OpCapability (GroupNonUniform|Subgroup)": "subgroup operations",
    r"OpCapability Int64\b": "64-bit integers",
}

HEAD = "#version 450\nlayout(local_size_x = 64) in;\n"
OUTPUT = "layout(binding = 0) buffer Out { uint word[]; };\n"
FAULTS = {
    "floating point": "void main() { word[0] = uint(float(word[1]) * 0.5); }",
    "integers that do not have 32 bits": "void main() { word[0] = uint(uint64_t(word[1]) >> 3); }",
    "subgroup operations": "void main() { word[0] = subgroupAdd(word[1]); }",
}
EXTENSIONS = (
    "#extension GL_EXT_shader_explicit_arithmetic_types_int64 : require\n"
    "#extension GL_KHR_shader_subgroup_arithmetic : require\n"
)


def spirv_of(included: Path):
    """The shader as bytes."""
    words = [int(word, 16) for word in re.findall(r"0x\w+", included.read_text())]
    return struct.pack(f"<{len(words)}I", *words)


def problems(spirv: bytes):
    """What is wrong with the shader, one line each."""
    validated = subprocess.run(
        ["spirv-val", "--target-env", "vulkan1.2", "-"], input=spirv, capture_output=True
    )
    found = [] if validated.returncode == 0 else [validated.stderr.decode().strip()]
    text = subprocess.run(["spirv-dis", "-"], input=spirv, capture_output=True).stdout.decode()
    if "OpEntryPoint" not in text:
        found.append("no entry point")
    found += [what for pattern, what in FORBIDDEN.items() if re.search(pattern, text)]
    return found


def self_test(folder: Path):
    """Faults that were not found."""
    missed = []
    for what, body in FAULTS.items():
        source = folder / "fault.comp"
        source.write_text(HEAD.replace("\n", "\n" + EXTENSIONS, 1) + OUTPUT + body)
        included = folder / "fault.inc"
        subprocess.run(["glslc", TARGET, "-mfmt=c", source, "-o", included], check=True)
        if what not in problems(spirv_of(included)):
            missed.append(what)
    if not problems(spirv_of(included)[:-8]):
        missed.append("a shader that is cut off")
    return missed


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("included", type=Path, nargs="?")
    parser.add_argument("--self-test", action="store_true")
    arguments = parser.parse_args()
    missing = [tool for tool in ("spirv-val", "spirv-dis", "glslc") if not shutil.which(tool)]
    if missing:
        print(f"missing: {', '.join(missing)}")
        return SKIPPED
    if arguments.self_test:
        with tempfile.TemporaryDirectory() as folder:
            missed = self_test(Path(folder))
        for what in missed:
            print(f"not found: {what}")
        return 1 if missed else 0
    if not arguments.included.exists():
        print(f"{arguments.included} was not built: the Vulkan headers are missing")
        return SKIPPED
    found = problems(spirv_of(arguments.included))
    for problem in found:
        print(f"{arguments.included.name}: {problem}")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
