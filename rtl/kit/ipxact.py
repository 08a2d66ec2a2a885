"""The decode unit and the view unit, each as a component of IP-XACT (IEEE 1685-2014): bus interfaces, memory map, ports, parameters, files."""

import re
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import file_list
from registers import Block, Field, Register

NAMESPACE = "http://www.accellera.org/XMLSchema/IPXACT/1685-2014"
XSI = "http://www.w3.org/2001/XMLSchema-instance"
PORT = re.compile(r"^    (input|output) logic (?:\[(.+):0\] )?(\w+),?$", re.M)
DERIVED = re.compile(r"^    localparam int (\w+) = (.+?),?$", re.M)
DESCRIPTIONS = {
    "hmlfc_decode_unit": "Decodes single blocks of light fields from memory",
    "hmlfc_view_unit": "Decodes rectangles of views of light fields from memory to memory",
}
# Unit, prefix of the ports: definition of the bus by ARM, its version, the unit's part.
BUSES = {
    "hmlfc_decode_unit": {
        "s_request": ("AXI4Stream", "r0p0_1", "slave"),
        "m_response": ("AXI4Stream", "r0p0_1", "master"),
        "m_axi": ("AXI4_RO", "r0p0_0", "master"),
        "s_axil": ("AXI4-Lite", "r0p0_0", "slave"),
    },
    "hmlfc_view_unit": {
        "m_axi": ("AXI4", "r0p0_0", "master"),
        "s_axil": ("AXI4-Lite", "r0p0_0", "slave"),
    },
}
ACCESS = {"ro": "read-only", "wo": "write-only", "rw": "read-write"}


def add(parent: ElementTree.Element, name: str, text: object = None, /, **attributes: str) -> ElementTree.Element:
    node = ElementTree.SubElement(parent, f"{{{NAMESPACE}}}{name}", attributes)
    if text is not None:
        node.text = str(text).lower() if isinstance(text, bool) else str(text)
    return node


def ports(rtl: Path, unit: str) -> list[tuple[str, str, str | None]]:
    """Direction, name and highest bit of each port, an expression of the parameters; None for a single bit."""
    text = (rtl / f"{unit}.sv").read_text(encoding="utf-8")
    package = (rtl / "hmlfc_pkg.sv").read_text(encoding="utf-8")
    derived = dict(DERIVED.findall(text[:text.index(") (")]))
    derived["ADDRESS_BITS"] = re.search(r" ADDRESS_BITS = (\d+);", package)[1]
    found = []
    for direction, high, name in PORT.findall(text[:text.index(");\n")]):
        for value in derived:
            high = re.sub(rf"\b{value}\b", lambda match: f"({derived[match.group()]})", high)
        found.append((direction, name, high.replace(" ", "") or None))
    return found


def add_buses(component: ElementTree.Element, unit: str, names: list[str]) -> None:
    buses = add(component, "busInterfaces")
    for prefix, (kind, version, part) in BUSES[unit].items():
        bus = add(buses, "busInterface")
        add(bus, "name", prefix)
        add(bus, "busType", vendor="amba.com", library="AMBA4", name=kind, version=version)
        abstraction = add(add(bus, "abstractionTypes"), "abstractionType")
        add(abstraction, "abstractionRef", vendor="amba.com", library="AMBA4", name=f"{kind}_rtl", version=version)
        maps = add(abstraction, "portMaps")
        logical = {name: name.removeprefix(f"{prefix}_").upper() for name in names if name.startswith(f"{prefix}_")}
        for physical, port in {"clk": "ACLK", "rst_n": "ARESETn", **logical}.items():
            pair = add(maps, "portMap")
            add(add(pair, "logicalPort"), "name", port)
            add(add(pair, "physicalPort"), "name", physical)
        role = add(bus, part)
        if prefix == "s_axil":
            add(role, "memoryMapRef", memoryMapRef="registers")
        if prefix == "m_axi":
            add(role, "addressSpaceRef", addressSpaceRef="memory")
    space = add(add(component, "addressSpaces"), "addressSpace")
    add(space, "name", "memory")
    add(space, "range", 1 << 40)
    add(space, "width", "AXI_DATA_BITS")
    add(space, "addressUnitBits", 8)


def add_field(parent: ElementTree.Element, register: Register, field: Field, word: int) -> None:
    """The part of a field that is in a word of 32 bits."""
    low, high = max(field.low, 32 * word), min(field.low + field.width, 32 * word + 32)
    if low >= high:
        return
    node = add(parent, "field")
    add(node, "name", field.name)
    add(node, "description", field.description)
    add(node, "bitOffset", low - 32 * word)
    reset = add(add(node, "resets"), "reset")
    add(reset, "value", f"'h{(register.reset >> low) & ((1 << (high - low)) - 1):x}")
    add(node, "bitWidth", high - low)
    add(node, "volatile", register.volatile)
    add(node, "access", ACCESS[register.access])
    if register.one_clears:
        add(node, "modifiedWriteValue", "oneToClear")


def add_registers(component: ElementTree.Element, blocks: list[Block]) -> None:
    """Registers of 64 bits are two of 32: no register may be wider than its block."""
    memory = add(add(component, "memoryMaps"), "memoryMap")
    add(memory, "name", "registers")
    area = add(memory, "addressBlock")
    add(area, "name", "registers")
    add(area, "baseAddress", 0)
    add(area, "range", blocks[0].bytes)
    add(area, "width", 32)
    add(area, "usage", "register")
    for register in [register for block in blocks for register in block.registers]:
        for word in range(register.bits // 32):
            node = add(area, "register")
            add(node, "name", register.name + ("_HIGH" if word else ""))
            add(node, "description", register.description)
            add(node, "addressOffset", f"'h{register.offset + 4 * word:02x}")
            add(node, "size", 32)
            add(node, "volatile", register.volatile)
            add(node, "access", ACCESS[register.access])
            for field in register.fields:
                add_field(node, register, field, word)
    add(memory, "addressUnitBits", 8)


def add_model(component: ElementTree.Element, unit: str, rtl: Path, found: list) -> None:
    model = add(component, "model")
    view = add(add(model, "views"), "view")
    add(view, "name", "rtl")
    add(view, "envIdentifier", "systemVerilogSource::")
    add(view, "componentInstantiationRef", "rtl")
    instance = add(add(model, "instantiations"), "componentInstantiation")
    add(instance, "name", "rtl")
    add(instance, "language", "SystemVerilog")
    add(instance, "moduleName", unit)
    values = add(instance, "moduleParameters")
    for name, _, _ in file_list.parameters(rtl):
        value = add(values, "moduleParameter", dataType="int")
        add(value, "name", name)
        add(value, "value", name)
    for name in ("rtl", "constraints"):
        add(add(instance, "fileSetRef"), "localName", name)
    node = add(model, "ports")
    for direction, name, high in found:
        port = add(node, "port")
        add(port, "name", name)
        wire = add(port, "wire")
        add(wire, "direction", "in" if direction == "input" else "out")
        if high is not None:
            vector = add(add(wire, "vectors"), "vector")
            add(vector, "left", high)
            add(vector, "right", 0)


def add_files(component: ElementTree.Element, rtl: Path) -> None:
    """Their names are relative to rtl/kit."""
    sets = add(component, "fileSets")
    group = add(sets, "fileSet")
    add(group, "name", "rtl")
    headers = file_list.headers(rtl)
    for path in headers + file_list.sources(rtl):
        file = add(group, "file")
        add(file, "name", f"../{path.name}")
        add(file, "fileType", "systemVerilogSource")
        if path in headers:
            add(file, "isIncludeFile", True)
    group = add(sets, "fileSet")
    add(group, "name", "constraints")
    file = add(group, "file")
    add(file, "name", "hmlfc_decode_unit.sdc")
    add(file, "fileType", "SDC")


def add_parameters(component: ElementTree.Element, rtl: Path) -> None:
    node = add(component, "parameters")
    for name, default, values in file_list.parameters(rtl):
        numbers = re.findall(r"\d+", values)
        parameter = add(node, "parameter", parameterId=name, resolve="user", type="int", minimum=numbers[0], maximum=numbers[-1])
        add(parameter, "name", name)
        add(parameter, "description", values)
        add(parameter, "value", default)


def join(root: ElementTree.Element, kind: str) -> None:
    """Puts each element of the kind on one line."""
    for element in root.iter(f"{{{NAMESPACE}}}{kind}"):
        for node in element.iter():
            if len(node):
                node.text = None
            if node is not element:
                node.tail = None


def component(unit: str, blocks: list[Block], rtl: Path, version: str) -> str:
    """blocks: of the unit's registers, all in one space."""
    ElementTree.register_namespace("ipxact", NAMESPACE)
    ElementTree.register_namespace("xsi", XSI)
    root = ElementTree.Element(f"{{{NAMESPACE}}}component", {f"{{{XSI}}}schemaLocation": f"{NAMESPACE} {NAMESPACE}/index.xsd"})
    for name, text in {"vendor": "hmlfc", "library": "hmlfc", "name": unit, "version": version}.items():
        add(root, name, text)
    found = ports(rtl, unit)
    add_buses(root, unit, [name for _, name, _ in found])
    add_registers(root, blocks)
    add_model(root, unit, rtl, found)
    add_files(root, rtl)
    add(root, "description", DESCRIPTIONS[unit])
    add_parameters(root, rtl)
    ElementTree.indent(root)
    for kind in ("portMap", "port", "field", "file", "parameter", "moduleParameter", "fileSetRef", "view"):
        join(root, kind)
    text = ElementTree.tostring(root, encoding="unicode")
    return f'<?xml version="1.0" encoding="UTF-8"?>\n<!-- Generated by rtl/kit/generate.py from the registers, the file list and the ports of the unit: change those. -->\n{text}\n'
