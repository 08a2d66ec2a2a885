#!/usr/bin/env python3
"""Checks of the integration kit of the decode unit and the view unit.

kit_test.py generated|read_back|file_list ROOT [--self-test]
  generated   the generated files are what rtl/kit/generate.py writes
  read_back   what kit_readers.py finds in each format is what the descriptions of the registers say; buses have the units'
              ports; the header compiles as C99; elements of IP-XACT are in the order of the standard
  file_list   rtl/hmlfc_decode_unit.f names every file of the folder, in an order that compiles; core and IP-XACT have its files
--self-test: each planted fault must be found, by its file.

Exit: 0 so, 1 not; what is wrong is printed.
"""

import re
import shutil
import subprocess
import sys
import tempfile
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import kit_readers
from kit_readers import IPXACT

HEADER, MAP, XML, RDL = "driver/hmlfc_registers.h", "hmlfc_register_map.svh", "kit/hmlfc_decode_unit.xml", "kit/hmlfc_decode_unit.rdl"
VIEW_XML, VIEW_RDL = "kit/hmlfc_view_unit.xml", "kit/hmlfc_view_queue.rdl"
REGISTERS, VIEW_REGISTERS = "registers.json", "view_registers.json"
UNIT_PAGE, VIEW_PAGE = "docs/decode_unit.md", "docs/view_unit.md"
CORE, LIST = "hmlfc_decode_unit.core", "hmlfc_decode_unit.f"

# Check: file below ROOT, text, what stands in its place, and what is said.
FAULTS = {
    "generated": [
        (f"rtl/{MAP}", "HMLFC_REG_STATUS_IDLE_SHIFT = 2", "HMLFC_REG_STATUS_IDLE_SHIFT = 1", MAP),
        (f"rtl/{HEADER}", "HMLFC_REG_BLOCKS 0x040u", "HMLFC_REG_BLOCKS 0x044u", HEADER),
        (f"rtl/{RDL}", "@ 0x38", "@ 0x30", RDL),
        (f"rtl/{XML}", "'h38", "'h30", XML),
        (f"rtl/{CORE}", "      - hmlfc_fifo.sv\n", "", CORE),
        (UNIT_PAGE, "| 20, 24 |", "| 20, 28 |", UNIT_PAGE),
        ("rtl/registers.json", '"bits": "13:8"', '"bits": "12:8"', HEADER),
        ("rtl/view_registers.json", '"offset": "0x82c"', '"offset": "0x830"', VIEW_RDL),
        ("rtl/view_registers.json", '"offset": "0x82c"', '"offset": "0x830"', VIEW_XML),
        (VIEW_PAGE, "| 82C |", "| 830 |", VIEW_PAGE),
        ("rtl/hmlfc_decode_unit.sv", "input logic [11:0] s_axil_awaddr", "input logic [12:0] s_axil_awaddr", XML),
    ],
    "read_back": [
        (f"rtl/{HEADER}", "HMLFC_REG_STATUS_STRAY_MASK 0x00000008u", "HMLFC_REG_STATUS_STRAY_MASK 0x00000018u", HEADER),
        (f"rtl/{HEADER}", "\n#endif", "", HEADER),
        (f"rtl/{MAP}", "HMLFC_WORD_CYCLES = 10'h012", "HMLFC_WORD_CYCLES = 10'h014", MAP),
        (f"rtl/{RDL}", "sw = w;", "sw = rw;", RDL),
        (f"rtl/{XML}", "<ipxact:bitWidth>6<", "<ipxact:bitWidth>5<", XML),
        (f"rtl/{XML}", "<ipxact:access>write-only<", "<ipxact:access>read-write<", XML),
        (f"rtl/{XML}", "<ipxact:name>m_axi_rid<", "<ipxact:name>m_axi_arid<", XML),
        (f"rtl/{XML}", "</ipxact:component>", "", XML),
        (f"rtl/{VIEW_XML}", "<ipxact:name>m_axi_awid<", "<ipxact:name>m_axi_arid<", VIEW_XML),
        (f"rtl/{VIEW_XML}", "'h82c", "'h830", VIEW_XML),
        (f"rtl/{VIEW_RDL}", "@ 0x82c", "@ 0x830", VIEW_RDL),
        (f"rtl/{VIEW_RDL}", " woclr;", "", VIEW_RDL),
        (f"rtl/{VIEW_XML}", ">oneToClear<", ">oneToSet<", VIEW_XML),
        (f"rtl/{XML}", "<ipxact:right>0</ipxact:right></ipxact:vector>", "</ipxact:vector><ipxact:right>0</ipxact:right>", "vectors has"),
        (f"rtl/{XML}", "<ipxact:addressUnitBits>8</ipxact:addressUnitBits>", "<ipxact:bitsInLau>8</ipxact:bitsInLau>", "addressSpace has"),
        (f"rtl/{XML}", '<ipxact:memoryMapRef memoryMapRef="registers"', '<ipxact:memoryMapRef memoryMapRef="register"', "there is no memoryMap"),
        ("rtl/registers.json", '"reset": "0x00000004"', '"reset": "0x00000000"', RDL),
    ],
    "file_list": [
        (f"rtl/{LIST}", "hmlfc_trits.sv\n", "", "hmlfc_trits.sv is not named"),
        (f"rtl/{LIST}", "// included: hmlfc_tables.svh\n", "", "hmlfc_tables.svh is not named"),
        (f"rtl/{LIST}", "hmlfc_fifo.sv\n", "hmlfc_fifo.sv\nhmlfc_fifo.sv\n", "hmlfc_fifo.sv is named twice"),
        (f"rtl/{LIST}", "hmlfc_fifo.sv\n", "hmlfc_fifo.sv\nhmlfc_none.sv\n", "there is no hmlfc_none.sv"),
        (f"rtl/{LIST}", "hmlfc_pkg.sv\n", "hmlfc_divide.sv\nhmlfc_pkg.sv\n", "hmlfc_pkg.sv is not the first"),
        (f"rtl/{LIST}", "hmlfc_decode_unit.sv\n", "", "hmlfc_decode_unit.sv is not named"),
        ("rtl/hmlfc_view_unit.sv", "MAX_DEPTH = 8", "MAX_DEPTH = 9", "its parameters are not those of"),
        (f"rtl/{LIST}", "hmlfc_colour.sv\n", "hmlfc_answer.sv\nhmlfc_colour.sv\n", "stands before hmlfc_colour.sv"),
        (f"rtl/{CORE}", "      - hmlfc_fifo.sv\n", "", CORE),
        (f"rtl/{XML}", "<ipxact:name>../hmlfc_fifo.sv<", "<ipxact:name>../hmlfc_trits.sv<", XML),
    ],
}


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


def missed(check, root):
    """The faults that the check does not name."""
    for file, old, new, said in FAULTS[check]:
        with tempfile.TemporaryDirectory() as folder:
            copy = Path(folder)
            shutil.copytree(root / "rtl", copy / "rtl", ignore=shutil.ignore_patterns("formal", "synth"))
            (copy / "docs").mkdir()
            for page in (UNIT_PAGE, VIEW_PAGE):
                shutil.copy(root / page, copy / page)
            shutil.copy(root / "CMakeLists.txt", copy)
            text = (copy / file).read_text()
            assert old in text, f"{file} has no '{old}' to plant a fault in"
            (copy / file).write_text(text.replace(old, new, 1))
            if not any(said in line for line in CHECKS[check](copy)):
                yield f"not found: {file}: {old.strip()} -> {new.strip()}"


def main():
    check, root = sys.argv[1], Path(sys.argv[2]).resolve()
    found = list(missed(check, root)) if sys.argv[3:] == ["--self-test"] else CHECKS[check](root)
    print("\n".join(found) or "clean")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
