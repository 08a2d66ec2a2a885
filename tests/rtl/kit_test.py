#!/usr/bin/env python3
"""Checks of the integration kit of the decode unit and the view unit.

kit_test.py generated|read_back|file_list ROOT
  generated   the generated files are what rtl/kit/generate.py writes
  read_back   what kit_readers.py finds in each format is what the descriptions of the registers say; the header compiles as C99
  file_list   rtl/hmlfc_decode_unit.f names every file of its folders, in an order that compiles; the core has its files

Exit: 0 so, 1 not; what is wrong is printed.
"""

import re
import subprocess
import sys
from pathlib import Path

import kit_readers

HEADER, MAP = "driver/hmlfc_registers.h", "hmlfc_register_map.svh"
RDL, VIEW_RDL = "kit/hmlfc_decode_unit.rdl", "kit/hmlfc_view_queue.rdl"
REGISTERS, VIEW_REGISTERS = "registers.json", "view_registers.json"
CORE = "hmlfc_decode_unit.core"


def generated(root):
    command = [sys.executable, "-B", root / "rtl/kit/generate.py", "--check", root]
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    return done.stdout.splitlines() or (["generate.py failed"] if done.returncode else [])


def difference(name, found, expected):
    """A line for each register, and each of its properties that both have, in which the two differ."""
    lines = [f"{name}: {register} is in one alone" for register in sorted(set(found) ^ set(expected))]
    for register in sorted(set(found) & set(expected)):
        lines += [f"{name}: {register} has {key} {found[register][key]}, not {expected[register][key]}"
                  for key in found[register].keys() & expected[register].keys() if found[register][key] != expected[register][key]]
    return lines


def read_back(root):
    text = {name: (root / "rtl" / name).read_text() for name in (HEADER, MAP, RDL, VIEW_RDL, REGISTERS, VIEW_REGISTERS)}
    unit, queue = (kit_readers.description(text[name]) for name in (REGISTERS, VIEW_REGISTERS))
    expected = unit | queue
    lines = []
    for name, registers in {RDL: unit, VIEW_RDL: queue}.items():
        try:
            lines += difference(name, kit_readers.system_rdl(text[name]), registers)
        except AssertionError as error:
            lines.append(f"{name}: {error}")
    if lines:
        return lines
    both = {name: expected[name] | constants for name, constants in kit_readers.masks(expected).items()}
    for name, reader in {HEADER: kit_readers.c_header, MAP: kit_readers.system_verilog}.items():
        try:
            lines += difference(name, reader(text[name]), both)
        except (KeyError, ValueError, AssertionError) as error:
            lines.append(f"{name}: {error!r}")
    compiler = ["cc", "-std=c99", "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", "-x", "c", "-"]
    source = f'#include "{root / "rtl" / HEADER}"\nint status = HMLFC_REG_STATUS;\n'
    done = subprocess.run(compiler, input=source, stderr=subprocess.PIPE, text=True, check=False)
    return lines + done.stderr.splitlines()


def file_list(root):
    rtl = root / "rtl"
    sys.path.insert(0, str(rtl / "kit"))
    import file_list as files

    lines = files.complaints(rtl)
    named = [path.relative_to(rtl).as_posix() for path in [*files.headers(rtl), *files.sources(rtl)]]
    core = re.findall(r"^      - ([\w/]+\.svh?)\b", (rtl / CORE).read_text(), re.M)
    if core != named:
        lines.append(f"{CORE}: its files are not those of the list")
    return lines


CHECKS = {"generated": generated, "read_back": read_back, "file_list": file_list}


def main():
    check, root = sys.argv[1], Path(sys.argv[2]).resolve()
    found = CHECKS[check](root)
    print("\n".join(found) or "clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
