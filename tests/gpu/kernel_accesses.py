#!/usr/bin/env python3
"""What each kernel reads and writes, by its SPIR-V, against the table that gpu_ref checks barriers with.

SHADERS has the kernels as NAME.inc; SOURCE is gpu_ref/, with the table in device/kernel_accesses.cpp. An address is followed from the push constants
(arguments.glsl) or the record of the frame (frame.glsl) to every load, store and atomic operation. Each kernel is read in each variant of
VARIANTS, which are those that the library dispatches.

Exit: 0 equal, 1 not (each difference is printed), 77 no SPIR-V tools or no shaders.
"""

import argparse
import re
import shutil
import subprocess
import sys
from pathlib import Path

from check_spirv import spirv_of

SKIPPED = 77

# Numbers of specialisation constants (Variant of kernels.hpp) that are true.
CHUNKED, REFERENCE_PASS, STAGES, COUNTED, POOL_CHUNKED, GEOMETRY, TEXELS = range(7)
VARIANTS = {
    "expand": {"kPlain": set(), "kReferencePass": {REFERENCE_PASS}},
    "walk": {"kPlain": set(), "kReferencePass": {REFERENCE_PASS}, "kCounted": {COUNTED}},
    "residuals": {"kReferencePass": {REFERENCE_PASS}},
    "samples": {"kPlain": set(), "kStages": {STAGES}, "kCounted": {COUNTED}},
    "colour": {"kPlain": set(), "kTexels": {TEXELS}},
    **{kernel: {"kCounted": {COUNTED}, "kGeometry": {COUNTED, GEOMETRY}} for kernel in ("mark", "compact", "render")},
    "surface": {"kGeometry": {COUNTED, GEOMETRY}},
}
# These change where something lies, not what.
LAYOUTS = [set(), {CHUNKED, POOL_CHUNKED}]
TABLES = {"stream", "references", "frame.pool"}
HOW = ("reads", "writes")


def members(text: str, head: str) -> list[str]:
    """The names of the members of the block of GLSL that begins with `head`, in order."""
    body = re.search(head + r" \{(.*?)\n\}", text, re.S).group(1)
    lines = (re.sub(r"//.*", "", line).strip() for line in body.splitlines())
    return [name.strip() for line in lines if line for name in line.rstrip(";").split(None, 1)[1].split(",")]


def specialised(spirv: bytes, constants: set[int]) -> str:
    """The module with these constants true and the others false, without what is then dead, as text."""
    values = " ".join(f"{number}:{'true' if number in constants else 'false'}" for number in range(7))
    passes = ["--set-spec-const-default-value", values, "--freeze-spec-const", "--fold-spec-const-op-composite", "-O"]
    folded = subprocess.run(["spirv-opt", "--target-env=vulkan1.2", *passes, "-", "-o", "-"], input=spirv, capture_output=True, check=True)
    return subprocess.run(["spirv-dis", "--raw-id", "-"], input=folded.stdout, capture_output=True, check=True).stdout.decode()


class Accesses:
    """Follows addresses through a module, from the push constants to each load, store and atomic operation."""

    def __init__(self, arguments: list[str], frame: list[str]):
        self.members = {"": arguments, "frame": frame}
        self.constants = {}  # numbers by id
        self.addresses = {}  # by the id of a value: the buffer that it is an address of
        self.pointers = {}  # by id: the buffer that is reached through it (none: the push constants), and the buffer whose address lies there
        self.address_types = set()  # of pointers into buffers, and of addresses as two words
        self.found = {}  # by buffer: "reads", "writes"

    def pointer(self, number: str) -> tuple | None:
        if number in self.addresses:
            return (self.addresses[number],) * 2
        return self.pointers.get(number)

    def member(self, pointer: tuple, index: str) -> tuple:
        """The pointer to a member of what `pointer` points to."""
        buffer, holds = pointer
        if holds not in self.members or (buffer == "frame" and holds != "frame"):
            return pointer
        name = self.members[holds][self.constants[index]]
        return (buffer, f"{holds}.{name}" if holds else name)

    def use(self, pointer: tuple | None, how: str) -> None:
        if pointer and pointer[0]:
            self.found.setdefault(pointer[0], set()).add(how)

    def instruction(self, op: str, result: str, words: list[str]) -> None:
        if op == "OpTypePointer" and words[0] == "PhysicalStorageBuffer" or op == "OpTypeVector" and words[1] == "2":
            self.address_types.add(result)
        elif op == "OpConstant":
            self.constants[result] = int(words[1]) if words[1].lstrip("-").isdigit() else None
        elif op == "OpVariable" and words[1] == "PushConstant":
            self.pointers[result] = ("", "")
        elif op in ("OpAccessChain", "OpInBoundsAccessChain") and self.pointer(words[1]):
            self.pointers[result] = self.member(self.pointer(words[1]), words[2])
        elif op == "OpLoad" and self.pointer(words[1]):
            self.use(self.pointer(words[1]), "reads")
            if words[0] in self.address_types:
                self.addresses[result] = self.pointer(words[1])[1]
        elif op in ("OpBitcast", "OpCopyObject") and words[1] in self.addresses:
            self.addresses[result] = self.addresses[words[1]]
        elif op == "OpStore":
            self.use(self.pointer(words[0]), "writes")
        elif op == "OpAtomicLoad":
            self.use(self.pointer(words[1]), "reads")
        elif op.startswith("OpAtomic"):
            for how in ("reads", "writes"):
                self.use(self.pointer(words[1]), how)
        elif op in ("OpPhi", "OpSelect", "OpFunctionCall") and any(word in self.addresses or word in self.pointers for word in words[1:]):
            raise RuntimeError(f"an address passes through {op}, which this program does not follow")


def accesses(assembly: str, arguments: list[str], frame: list[str]) -> dict[str, set[str]]:
    """The buffers that a module of one variant reads or writes."""
    follower = Accesses(arguments, frame)
    for line in assembly.splitlines():
        result, words = "", line.split(";")[0].split()
        if len(words) > 2 and words[1] == "=":
            result, words = words[0], words[2:]
        if words:
            follower.instruction(words[0], result, words[1:])
    return follower.found


def by_spirv(shaders: Path, source: Path) -> dict[tuple, dict]:
    """What each kernel and variant uses."""
    push = members((source / "shaders/arguments.glsl").read_text(), "uniform Arguments")
    frame = members((source / "shaders/frame.glsl").read_text(), "buffer Frame")
    found = {}
    for kernel, variants in VARIANTS.items():
        spirv = spirv_of(shaders / f"{kernel}.inc")
        for kind, constants in variants.items():
            plain, chunked = (accesses(specialised(spirv, constants | layout), push, frame) for layout in LAYOUTS)
            found[kernel, kind] = {how: {buffer.removeprefix("frame.") for buffer in plain if how in plain[buffer]} for how in HOW}
            # Tables of chunks are read, but never written while kernels run.
            for how in HOW:
                different = {buffer for buffer in plain.keys() | chunked.keys() if (how in plain.get(buffer, ())) != (how in chunked.get(buffer, ()))}
                if different - (TABLES if how == "reads" else set()):
                    raise RuntimeError(f"{kernel}: {how} others in chunks: {different}")
    return found


def by_table(text: str) -> dict[tuple, dict]:
    """The same by kernel_accesses.cpp; a kind without a line is that of kPlain."""
    strings = r'\{"(\w+)", Kind::(\w+),\s*"([^"]*)",\s*"([^"]*)"\}'
    lines = {(kernel, kind): {"reads": set(reads.split()), "writes": set(writes.split())} for kernel, kind, reads, writes in re.findall(strings, text)}
    return {(kernel, kind): lines.get((kernel, kind)) or lines.get((kernel, "kPlain")) for kernel, kinds in VARIANTS.items() for kind in kinds}


def differences(spirv: dict, table: dict) -> list[str]:
    found = []
    for kernel, kind in spirv:
        for how in HOW:
            actual, listed = spirv[kernel, kind][how], (table[kernel, kind] or {}).get(how, set())
            found += [f"{kernel}, {kind}: {how} {buffer}, which the table does not say" for buffer in sorted(actual - listed)]
            found += [f"{kernel}, {kind}: the table says that it {how} {buffer}" for buffer in sorted(listed - actual)]
    return found


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("shaders", type=Path)
    parser.add_argument("source", type=Path)
    options = parser.parse_args()
    if not shutil.which("spirv-opt") or not (options.shaders / "walk.inc").exists():
        print("missing: spirv-opt, or the shaders were not built")
        return SKIPPED
    spirv = by_spirv(options.shaders, options.source)
    text = (options.source / "device/kernel_accesses.cpp").read_text()
    found = differences(spirv, by_table(text))
    for difference in found:
        print(difference)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
