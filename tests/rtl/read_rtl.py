#!/usr/bin/env python3
"""Reads every file of the decode unit with a tool, which must say nothing at all.

read_rtl.py verilator|yosys|icarus|order RTL: the files of the list in the folder RTL, Verilator and Yosys each module as a
top as well.

Icarus 11 cannot elaborate the types of the package: it parses all files and elaborates the FIFO. `order` is no program:
it finds signals used before their declaration, of which Icarus knows only those that are whole ports of an instance.

Exit: 0 silent, 1 not (what was said is printed), 77 the tool is not installed.
"""

import re
import shutil
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "rtl" / "kit"))
import file_list  # noqa: E402

SKIPPED = 77
PROGRAMS = {"verilator": "verilator", "yosys": "yosys", "icarus": "iverilog"}

# In the body of a module, where it is indented by 2.
DECLARATION = re.compile(r"^  (?:logic|wire|\w+::\w+_t|state_t)\b(?: signed)?(?: *\[[^]]*\])* +([^;=]+)", re.M)
FUNCTION = re.compile(r"^  function .*?^  endfunction", re.M | re.S)
NOT_A_USE = re.compile(r"//[^\n]*|`default_nettype [^\n]*|\.\w+ *\(|(?<=[\w\])])\.\w+")  # comments, names of ports, members


def early_uses(path):
    """A line for each signal of a file that is used above its declaration."""
    text = NOT_A_USE.sub("", path.read_text())
    text = FUNCTION.sub(lambda match: "\n" * match.group().count("\n"), text)
    declared = {}
    for match in DECLARATION.finditer(text):
        for name in re.findall(r"(\w+) *(?:\[[^]]*\])* *(?:,|$)", match.group(1).strip()):
            declared.setdefault(name, match.start())
    for name, at in declared.items():
        if use := re.search(rf"\b{name}\b", text[:at]):
            line = text.count("\n", 0, use.start()) + 1
            yield f"{path}:{line}: {name} is used before its declaration\n"


def checked(top):
    """The modules that Yosys checks below a top: all of the unit that has all others in it, else the top alone."""
    return "" if top.stem == "hmlfc_view_unit" else top.stem


def commands(tool, rtl, tops):
    """Icarus reads the file list from the folder that it is in; Yosys knows no such lists."""
    if tool == "icarus":
        return [["iverilog", "-g2012", "-Wall", "-tnull", "-s", "hmlfc_fifo", "-c", file_list.NAME]]
    if tool == "verilator":
        lint = ["verilator", "--lint-only", "-Wall", "waivers.vlt", "-F", file_list.NAME]
        return [[*lint, "--top-module", path.stem] for path in tops]
    files = " ".join(str(path.relative_to(rtl)) for path in file_list.sources(rtl))
    return [
        ["yosys", "-q", "-p", f"read_verilog -sv -defer {files}", "-p", f"hierarchy -check -top {path.stem}",
         "-p", f"proc {checked(path)}", "-p", f"check -assert {checked(path)}"]
        for path in tops
    ]


def said(command, rtl):
    """What the tool said; also where it only failed."""
    run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, cwd=rtl)
    text = "".join(line for line in run.stdout.splitlines(keepends=True) if not line.startswith("- V"))  # its report
    return text or (f"{command[-1]}: exit status {run.returncode}\n" if run.returncode else "")


def complaints(tool, rtl):
    """What is said of the modules."""
    if tool == "order":
        return "".join(line for path in file_list.sources(rtl) for line in early_uses(path))
    with ThreadPoolExecutor() as pool:
        return "".join(pool.map(lambda command: said(command, rtl), commands(tool, rtl, file_list.modules(rtl))))


def main():
    tool, rtl = sys.argv[1], Path(sys.argv[2])
    if tool in PROGRAMS and not shutil.which(PROGRAMS[tool]):
        print(f"{PROGRAMS[tool]} is not installed")
        return SKIPPED
    found = complaints(tool, rtl)
    print(found, end="")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
