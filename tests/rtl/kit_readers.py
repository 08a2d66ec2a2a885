"""What others read in the kit of the units (rtl/kit): the registers of each format, without the generator's code.

Each reader gives {register: {"offset", "bits", "access", "one_clears", "reset", "fields": {field: (lowest bit, width)}}}, but
what its format does not say.
"""

import json
import re
import xml.etree.ElementTree as ElementTree

IPXACT = "{http://www.accellera.org/XMLSchema/IPXACT/1685-2014}"
IPXACT_ACCESS = {"read-only": "ro", "write-only": "wo", "read-write": "rw"}
RDL_ACCESS = {"r": "ro", "w": "wo", "rw": "rw"}

# The elements that the kit has in others, in the order of the schema of IEEE 1685-2014. An element
# of another name has parts of one kind alone.
ORDER = {
    "component": "vendor library name version busInterfaces addressSpaces memoryMaps model fileSets description parameters",
    "busInterface": "name busType abstractionTypes master slave",
    "abstractionType": "abstractionRef portMaps",
    "portMap": "logicalPort physicalPort",
    "addressSpace": "name range width addressUnitBits",
    "memoryMap": "name addressBlock addressUnitBits",
    "addressBlock": "name baseAddress range width usage register",
    "register": "name description addressOffset size volatile access field",
    "field": "name description bitOffset resets bitWidth volatile access modifiedWriteValue",
    "model": "views instantiations ports",
    "view": "name envIdentifier componentInstantiationRef",
    "componentInstantiation": "name language moduleName moduleParameters fileSetRef",
    "moduleParameter": "name value",
    "port": "name wire",
    "wire": "direction vectors",
    "vector": "left right",
    "fileSet": "name file",
    "file": "name fileType isIncludeFile",
    "parameter": "name description value",
}


def interval(bits):
    """Lowest bit and width of "high:low" or of "bit"."""
    high, low = (int(bit) for bit in (bits.split(":") * 2)[:2])
    return low, high - low + 1


def description(*texts):
    """Of one or more descriptions, whose registers are in one space."""
    return {
        entry["name"]: {
            "offset": int(entry["offset"], 16), "bits": entry["bits"], "access": entry["access"],
            "one_clears": entry.get("one_clears", False),
            "reset": int(entry["reset"], 16), "fields": {field["name"]: interval(field["bits"]) for field in entry["fields"]},
        }
        for text in texts for entry in json.loads(text)["registers"]
    }


def system_rdl(text):
    found = {}
    for body, name, offset in re.findall(r"^  reg \{\n(.*?)^  \} (\w+) @ (0x[0-9a-f]+);", text, re.M | re.S):
        fields = re.findall(r"field \{ desc = \"(?:[^\"\\]|\\.)*\"; sw = (\w+); .*?\} (\w+)\[(\d+):(\d+)\] = (\d+)'h([0-9a-f]+);", body)
        assert len(fields) == body.count("field {"), f"{name}: a field is not understood"
        assert all(int(high) - int(low) + 1 == int(width) for _, _, high, low, width, _ in fields), name
        found[name] = {
            "offset": int(offset, 16), "bits": int(re.search(r"regwidth = (\d+);", body)[1]),
            "access": " ".join({RDL_ACCESS[access] for access, *_ in fields}), "one_clears": body.count(" woclr; }") == len(fields),
            "reset": sum(int(value, 16) << int(low) for *_, low, _, value in fields),
            "fields": {field: interval(f"{high}:{low}") for _, field, high, low, _, _ in fields},
        }
    return found


def number(node, name):
    return int(re.sub("^'h", "0x", node.find(IPXACT + name).text), 0)


def ipxact(text):
    """A register NAME_HIGH is the high word of NAME; its fields go on in it."""
    found = {}
    for node in ElementTree.fromstring(text).iter(f"{IPXACT}register"):
        assert number(node, "size") == 32
        name, _, high = node.find(f"{IPXACT}name").text.partition("_HIGH")
        access = {IPXACT_ACCESS[part.find(f"{IPXACT}access").text] for part in [node, *node.iter(f"{IPXACT}field")]}
        register = {"offset": number(node, "addressOffset"), "bits": 32, "access": " ".join(access), "reset": 0, "fields": {}}
        effects = {part.findtext(f"{IPXACT}modifiedWriteValue") for part in node.iter(f"{IPXACT}field")}
        register["one_clears"] = effects == {"oneToClear"}
        if name in found:
            assert register["offset"] == found[name]["offset"] + 4 and register["access"] == found[name]["access"], name
            found[name]["bits"] = 64
        register = found.setdefault(name, register)
        for field in node.iter(f"{IPXACT}field"):
            low, width = number(field, "bitOffset") + (32 if found[name]["bits"] == 64 else 0), number(field, "bitWidth")
            register["reset"] |= number(field.find(f"{IPXACT}resets/{IPXACT}reset"), "value") << low
            key = field.find(f"{IPXACT}name").text
            start, held = register["fields"].get(key, (low, 0))
            register["fields"][key] = (start, held + width)
    return found


def misplaced(text):
    """A line for each element of a component that is not where IP-XACT has it, and for each reference to what is not there."""
    component = ElementTree.fromstring(text)
    for node in component.iter():
        kind, parts = node.tag.removeprefix(IPXACT), [part.tag.removeprefix(IPXACT) for part in node]
        order = ORDER.get(kind, parts[0] if parts else "").split()
        places = [order.index(part) if part in order else -1 for part in parts]
        if -1 in places or places != sorted(places):
            yield f"{kind} has {' '.join(dict.fromkeys(parts))}"
    for reference, target in {"memoryMapRef": "memoryMap", "addressSpaceRef": "addressSpace"}.items():
        names = {node.findtext(f"{IPXACT}name") for node in component.iter(f"{IPXACT}{target}")}
        for node in component.iter(f"{IPXACT}{reference}"):
            if node.get(reference) not in names:
                yield f"there is no {target} {node.get(reference)}"
    sets = {node.findtext(f"{IPXACT}name") for node in component.iter(f"{IPXACT}fileSet")}
    for node in component.iter(f"{IPXACT}localName"):
        if node.text not in sets:
            yield f"there is no fileSet {node.text}"


def constants(numbers, offset):
    """Registers by the names of constants; offset(name) of a register, in bytes."""
    names = [name.removeprefix("HMLFC_REG_").removesuffix("_RESET") for name in numbers if name.endswith("_RESET")]
    found = {name: {"offset": offset(name), "reset": numbers[f"HMLFC_REG_{name}_RESET"], "mask": numbers[f"HMLFC_REG_{name}_MASK"],
                    "shifts": {}} for name in names}
    for key, value in numbers.items():
        if key.endswith("_SHIFT"):
            # The longest, as ERROR_ADDRESS has no part in ERROR.
            name = max((name for name in names if key.startswith(f"HMLFC_REG_{name}_")), key=len)
            found[name]["shifts"][key.removeprefix(f"HMLFC_REG_{name}_").removesuffix("_SHIFT")] = value
    return found


def c_header(text):
    numbers = {name: int(value.rstrip("ul"), 0) for name, value in re.findall(r"^#define (\w+) (\w+)$", text, re.M)}
    found = constants(numbers, lambda name: numbers[f"HMLFC_REG_{name}"])
    for name, register in found.items():
        if f"HMLFC_REG_{name}_HIGH" in numbers:
            register["bits"] = 64
            assert numbers[f"HMLFC_REG_{name}_HIGH"] == register["offset"] + 4, name
        else:
            register["bits"] = 32
        for field, shift in register["shifts"].items():
            mask = numbers[f"HMLFC_REG_{name}_{field}_MASK"]
            register.setdefault("fields", {})[field] = (shift, (mask >> shift).bit_length())
    return found


def system_verilog(text):
    numbers = {}
    for name, size, value in re.findall(r"^localparam .*?(\w+) = (?:(\d+)'h)?(\w+);$", text, re.M):
        numbers[name] = int(value, 16 if size else 10)
    return constants(numbers, lambda name: 4 * numbers[f"HMLFC_WORD_{name}"])


def masks(registers):
    """The registers of the description as constants say them."""
    return {name: {"offset": register["offset"], "reset": register["reset"],
                   "mask": sum(((1 << width) - 1) << low for low, width in register["fields"].values()),
                   "shifts": {field: low for field, (low, _) in register["fields"].items()}}
            for name, register in registers.items()}
