#!/usr/bin/env python3
"""Writes the layouts of the records that host and kernels share, and the numbers that both know, as the shaders have them.

SHADERS is gpu_ref/shaders; each line of the file OUT is a macro for record_layout_test.cpp: MEMBER(record of C++, member, offset, bytes),
SIZE(record, bytes) or NUMBER(name, value). Layouts are those of the SPIR-V, numbers those of block_entry.glsl.
"""

import argparse
import re
import subprocess
from pathlib import Path

# Records by name: GLSL, C++.
RECORDS = {
    "Arguments": "Arguments",
    "Area": "AreaRecord",
    "ColourArea": "ColourAreaRecord",
    "StreamShape": "StreamShapeRecord",
    "LevelShape": "LevelShapeRecord",
    "PlaneShape": "PlaneShapeRecord",
    "MotionPlaneShape": "MotionPlaneShapeRecord",
    "Frame": "FrameShape",
    "FrameRecord": "FrameRecord",
}
MEMBERS = {("FrameRecord", "filter_kind"): "filter"}  # those of another name in C++
KERNELS = ("expand", "colour", "mark")  # these have them all


class Module:
    """The types of a module, with the offsets of their members."""

    def __init__(self, assembly: str):
        self.names, self.offsets, self.strides, self.types, self.constants = {}, {}, {}, {}, {}
        for line in assembly.splitlines():
            words = line.split()
            if words[:1] == ["OpMemberName"]:
                self.names[words[1], int(words[2])] = words[3].strip('"')
            elif words[:1] == ["OpMemberDecorate"] and words[3] == "Offset":
                self.offsets[words[1], int(words[2])] = int(words[4])
            elif words[:1] == ["OpDecorate"] and words[2] == "ArrayStride":
                self.strides[words[1]] = int(words[3])
            elif words[1:2] == ["="] and words[2].startswith("OpType"):
                self.types[words[0]] = words[2:]
            elif words[1:3] == ["=", "OpConstant"]:
                self.constants[words[0]] = words[4]

    def bytes_of(self, name: str) -> int:
        kind, *operands = self.types[name]
        if kind == "OpTypeVector":
            return int(operands[1]) * self.bytes_of(operands[0])
        if kind == "OpTypePointer":
            return 8
        if kind == "OpTypeArray":
            return int(self.constants[operands[1]]) * self.strides[name]
        if kind == "OpTypeStruct":
            return self.offsets[name, len(operands) - 1] + self.bytes_of(operands[-1])
        if kind == "OpTypeInt":
            return 4
        raise RuntimeError(f"{kind} has no size in a record")

    def lines(self) -> set[str]:
        """The macros of all records here whose members have offsets."""
        found = set()
        for name, (kind, *operands) in self.types.items():
            record = re.sub(r"_\d+$", "", name.lstrip("%"))
            if kind == "OpTypeStruct" and record in RECORDS and (name, 0) in self.offsets:
                found |= {self.member(name, record, i, operands[i]) for i in range(len(operands))}
            element = re.sub(r"_\d+$", "", operands[0].lstrip("%")) if kind == "OpTypeRuntimeArray" else ""
            if element in RECORDS:
                found.add(f"SIZE({RECORDS[element]}, {self.strides[name]})")
            elif element == "Request":
                found.add(f"NUMBER(kRequestBytes, {self.strides[name]})")
        return {line for line in found if line}

    def member(self, name: str, record: str, i: int, kind: str) -> str:
        member = self.names[name, i]
        if re.fullmatch(r"pad\d", member):
            return ""
        member = MEMBERS.get((record, member), member)
        return f"MEMBER({RECORDS[record]}, {member}, {self.offsets[name, i]}, {self.bytes_of(kind)})"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shaders", type=Path)
    parser.add_argument("out", type=Path)
    options = parser.parse_args()
    words = re.search(r"ENTRY_WORDS = (\d+)u;", (options.shaders / "block_entry.glsl").read_text()).group(1)
    lines = {f"NUMBER(kEntryWords, {words})"}
    for kernel in KERNELS:
        command = ["glslc", "--target-env=vulkan1.2", "-O0", options.shaders / f"{kernel}.comp", "-o", "-"]
        spirv = subprocess.run(command, capture_output=True, check=True).stdout
        lines |= Module(subprocess.run(["spirv-dis", "-"], input=spirv, capture_output=True, check=True).stdout.decode()).lines()
    options.out.write_text("\n".join(sorted(lines)) + "\n")


if __name__ == "__main__":
    main()
