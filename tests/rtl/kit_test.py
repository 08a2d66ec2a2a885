#!/usr/bin/env python3
"""Checks of the integration kit of the decode unit and the view unit.

kit_test.py generated|read_back|file_list ROOT
  generated   the generated files are what rtl/kit/generate.py writes
  read_back   what SystemRDL says is what the descriptions of the registers say
  file_list   rtl/hmlfc_decode_unit.f names every file of its folders, in an order that compiles; the core has its files

Exit: 0 so, 1 not; what is wrong is printed.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

RDL = {"kit/hmlfc_decode_unit.rdl": "registers.json", "kit/hmlfc_view_queue.rdl": "view_registers.json"}
CORE = "hmlfc_decode_unit.core"
RDL_ACCESS = {"r": "ro", "w": "wo", "rw": "rw"}


def interval(bits):
    """Lowest bit and width of "high:low" or of "bit"."""
    high, low = (int(bit) for bit in (bits.split(":") * 2)[:2])
    return low, high - low + 1


def description(text):
    """The registers of a description, as system_rdl() gives them."""
    return {
        entry["name"]: {
            "offset": int(entry["offset"], 16), "bits": entry["bits"], "access": entry["access"],
            "one_clears": entry.get("one_clears", False),
            "reset": int(entry["reset"], 16), "fields": {field["name"]: interval(field["bits"]) for field in entry["fields"]},
        }
        for entry in json.loads(text)["registers"]
    }


def system_rdl(text):
    """{register: {"offset", "bits", "access", "one_clears", "reset", "fields": {field: (lowest bit, width)}}}."""
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
    lines = []
    for name, registers in RDL.items():
        expected = description((root / "rtl" / registers).read_text())
        try:
            lines += difference(name, system_rdl((root / "rtl" / name).read_text()), expected)
        except AssertionError as error:
            lines.append(f"{name}: {error}")
    return lines


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
