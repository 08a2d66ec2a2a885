#!/usr/bin/env python3
"""Checks of the integration kit of the decode unit and the view unit.

kit_test.py generated|read_back|file_list ROOT
  generated   the generated files are what rtl/kit/generate.py writes
  read_back   what kit_readers.py finds in each format is what the descriptions of the registers say; buses have the units'
              ports; the header compiles as C99; elements of IP-XACT are in the order of the standard
  file_list   rtl/hmlfc_decode_unit.f names every file of the folder, in an order that compiles; core and IP-XACT have its files

Exit: 0 so, 1 not; what is wrong is printed.
"""

import re
import subprocess
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import kit_readers
from kit_readers import IPXACT

HEADER, MAP, XML, RDL = "driver/hmlfc_registers.h", "hmlfc_register_map.svh", "kit/hmlfc_decode_unit.xml", "kit/hmlfc_decode_unit.rdl"
VIEW_XML, VIEW_RDL = "kit/hmlfc_view_unit.xml", "kit/hmlfc_view_queue.rdl"
REGISTERS, VIEW_REGISTERS = "registers.json", "view_registers.json"
UNIT_PAGE, VIEW_PAGE = "docs/decode_unit.md", "docs/view_unit.md"
CORE, LIST = "hmlfc_decode_unit.core", "hmlfc_decode_unit.f"



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


def bus_ports(root, name, text):
    """Every port but the interrupt, `active` and those of the trace is in a bus, once, and is a port of the model."""
    component = ElementTree.fromstring(text)
    source = (root / "rtl" / Path(name).with_suffix(".sv").name).read_text()
    real = set(re.findall(r"^    (?:input|output) logic (?:\[.+\] )?(\w+)", source, re.M))
    model = [port.find(f"{IPXACT}name").text for port in component.iter(f"{IPXACT}port")]
    mapped = [port.find(f"{IPXACT}name").text for port in component.iter(f"{IPXACT}physicalPort")]
    mapped = sorted(name for name in mapped if name not in ("clk", "rst_n"))
    expected = sorted(name for name in real if not name.startswith("trace_") and name not in ("clk", "rst_n", "irq", "active"))
    return ([] if sorted(model) == sorted(real) else [f"{name}: its ports are not those of the unit"]) + (
        [] if mapped == expected else [f"{name}: not each port is in one bus: {set(mapped) ^ set(expected) or 'one is in two'}"])


def read_back(root):
    names = (HEADER, MAP, XML, RDL, VIEW_XML, VIEW_RDL, REGISTERS, VIEW_REGISTERS)
    text = {name: (root / "rtl" / name).read_text() for name in names}
    unit, queue = (kit_readers.description(text[name]) for name in (REGISTERS, VIEW_REGISTERS))
    expected = unit | queue
    lines = []
    for name, (reader, registers) in {
            RDL: (kit_readers.system_rdl, unit), XML: (kit_readers.ipxact, unit),
            VIEW_RDL: (kit_readers.system_rdl, queue), VIEW_XML: (kit_readers.ipxact, expected)}.items():
        try:
            lines += difference(name, reader(text[name]), registers)
            if name.endswith(".xml"):
                lines += bus_ports(root, name, text[name])
                lines += [f"{name}: {line}" for line in kit_readers.misplaced(text[name])]
        except (AssertionError, ElementTree.ParseError) as error:
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
    named = [path.name for path in [*files.headers(rtl), *files.sources(rtl)]]
    core = re.findall(r"^      - (\w+\.svh?)\b", (rtl / CORE).read_text(), re.M)
    if core != named:
        lines.append(f"{CORE}: its files are not those of the list")
    for xml in (XML, VIEW_XML):
        files = [file.find(f"{IPXACT}name").text for file in ElementTree.parse(rtl / xml).iter(f"{IPXACT}file")]
        if [name.removeprefix("../") for name in files if name.startswith("../")] != named:
            lines.append(f"{xml}: its files are not those of the list")
    return lines


CHECKS = {"generated": generated, "read_back": read_back, "file_list": file_list}


def main():
    check, root = sys.argv[1], Path(sys.argv[2]).resolve()
    found = CHECKS[check](root)
    print("\n".join(found) or "clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
