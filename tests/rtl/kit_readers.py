"""What others read in the kit of the units (rtl/kit): the registers of each format, without the generator's code.

Each reader gives {register: {"offset", "bits", "access", "one_clears", "reset", "fields": {field: (lowest bit, width)}}}, but
what its format does not say.
"""

import json
import re

RDL_ACCESS = {"r": "ro", "w": "wo", "rw": "rw"}


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
