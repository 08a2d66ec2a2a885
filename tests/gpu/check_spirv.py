#!/usr/bin/env python3
"""Checks shaders, the numbers that C++ includes: spirv-val accepts each, and it uses 32-bit integers alone.

Floating point, 64-bit integers and subgroup operations have no place in a decode path: their
results or their presence differ between devices.

Exit: 0 good, 1 not (each reason is printed), 77 no SPIR-V tools, or a shader was not built.
"""

import argparse
import re
import shutil
import struct
import subprocess
import sys
from pathlib import Path

SKIPPED = 77
FORBIDDEN = {
    r"OpTypeFloat\b": "floating point",
    r"OpTypeInt (?!32\b)\d+": "integers that do not have 32 bits",
    r"OpCapability (GroupNonUniform|Subgroup)": "subgroup operations",
    r"OpCapability Int64\b": "64-bit integers",
}


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


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("included", type=Path, nargs="+")
    arguments = parser.parse_args()
    missing = [tool for tool in ("spirv-val", "spirv-dis") if not shutil.which(tool)]
    missing += [str(shader) for shader in arguments.included if not shader.exists()]
    if missing:
        print(f"missing: {', '.join(missing)}")
        return SKIPPED
    found = [f"{shader.name}: {problem}" for shader in arguments.included for problem in problems(spirv_of(shader))]
    print("\n".join(found) or f"{len(arguments.included)} shaders are good")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
