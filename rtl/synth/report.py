#!/usr/bin/env python3
"""Prints the size and speed of modules of rtl/ as a table in Markdown.

usage: ./run synthesis size TARGET [MODULE...]    TARGET: ice40, ecp5, xc7, osu035
       ./run synthesis speed [--seeds N] [--cells] [--check] [MODULE...]

MODULE is a name without "hmlfc_", with parameters as in interpolate,BLOCK_LOG2=1, and outputs that are left open as in
reconstruct,-prediction; without one, those of the data path; --all: all modules.
size: LUTs, flip-flops, memories of LUTs, block RAMs and multipliers, or with osu035 cells and area.
speed: clock rates of the module between registers on all its ports, so that a path begins and ends in a register: by nextpnr-ice40 and
icetime on an hx8k in the package ct256, the median of N seeds (1), with blocks of 2 x 2 (*) where it does not fit otherwise; and by
OpenSTA in cells of osu035, without wires. --cells: in cells alone. --check: exit status 1 where a module is below 100 MHz in cells,
or on an hx8k that it fits.
HMLFC_SYNTH_TIMEOUT: seconds that one run may take (600). HMLFC_SYNTH_PATH=1 prints critical paths.
"""

import argparse
import pathlib
import re
import sys
import tempfile

from timing import in_cells, placed
from tools import LIBERTY, RTL, file_list, read, run

TARGET_MHZ = 100.0
UNITS = ("decode_unit", "view_unit")
DATA_PATH = ["bise_unpack", "bise_element", "residual", "vector", "interpolate", "reconstruct", "colour", "compose", "answer"]
CELLS = {
    "ice40": {"LUT": r"SB_LUT4", "FF": r"SB_DFF.*", "LUT RAM": r"(?!)", "BRAM": r"SB_RAM40.*", "DSP": r"SB_MAC16"},
    "ecp5": {"LUT": r"LUT4|CCU2C", "FF": r"TRELLIS_FF", "LUT RAM": r"TRELLIS_DPR16X4", "BRAM": r"DP16KD|PDPW16KD", "DSP": r"MULT18X18D"},
    "xc7": {"LUT": r"LUT[1-6]", "FF": r"FD[RSCP]E.*", "LUT RAM": r"RAM\d.*|SRL.*", "BRAM": r"RAMB.*", "DSP": r"DSP48E1"},
}
SYNTH = {
    "ice40": "synth_ice40 -top {top}",
    "ecp5": "synth_ecp5 -nowidelut -top {top}",
    "xc7": "synth_xilinx -family xc7 -flatten -noiopad -top {top}",
    "osu035": "synth -flatten -top {top}; dfflibmap -liberty {lib}; abc -liberty {lib}; opt_clean",
}


def all_modules() -> list[str]:
    """Those with logic."""
    return sorted(path.stem.removeprefix("hmlfc_") for path in file_list.modules(RTL) if path.stem != "hmlfc_widths")


def size(target: str, spec: str) -> list[str]:
    commands, top = read(spec)
    synth = SYNTH[target].format(top=top, lib=LIBERTY)
    if spec.startswith(UNITS):
        # Each module in them is flattened, and the units are not: as one piece the decode unit did not end within 25 minutes.
        inside = " ".join(f"*hmlfc_{unit}*/t:*hmlfc_*" for unit in UNITS)
        synth = f"setattr -set keep_hierarchy 1 {inside}; {synth}"
    if target == "osu035":
        text = run(["yosys", "-p", f"{commands}{synth}; stat -liberty {LIBERTY}"])
        cells = re.findall(r"Number of cells: +(\d+)", text)
        area = re.findall(r"Chip area for .*: ([\d.]+)", text)
        return [cells[-1], f"{float(area[-1]) / 1e6:.3f}"] if cells and area else ["too long"] * 2
    with tempfile.NamedTemporaryFile(suffix=".txt") as out:
        if not run(["yosys", "-p", f"{commands}{synth}; tee -o {out.name} stat"]):
            return ["too long"] * len(CELLS[target])
        text = pathlib.Path(out.name).read_text(encoding="utf-8")
    # The last section is of the whole hierarchy. (The JSON that Yosys 0.23 writes of several modules is not valid.)
    kinds = {kind: int(n) for kind, n in re.findall(r"^ +(\S+) +(\d+)$", text.split("===")[-1], re.MULTILINE)}
    # A carry cell of ecp5 takes the place of two LUTs.
    return [str(sum(n * (2 if kind == "CCU2C" else 1) for kind, n in kinds.items() if re.fullmatch(pattern, kind)))
            for pattern in CELLS[target].values()]


def speed(spec: str, seeds: int, cells_alone: bool) -> list[str]:
    columns = [] if cells_alone else placed(spec, seeds)
    if columns[1:2] == ["does not fit"] and "BLOCK_LOG2" not in spec and "BLOCK_LOG2" in file_list.module(RTL, spec.split(",")[0]).read_text(encoding="utf-8"):
        smaller = placed(f"{spec},BLOCK_LOG2=1", seeds)
        if smaller[1] != "does not fit":
            columns = [f"{column}*" for column in smaller]
    return columns + in_cells(spec, whole=spec.startswith(UNITS))


def slow(columns: list[str]) -> bool:
    """Whether a clock rate is below the target: the second column, nextpnr's, or the last, that of cells. Text is no rate."""
    rates = re.findall(r"^([\d.]+)\*?$", "\n".join(columns[1:2] + columns[-1:]), re.MULTILINE)
    return any(float(rate) < TARGET_MHZ for rate in rates)


def arguments_of(arguments: list[str]) -> argparse.Namespace:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, usage=argparse.SUPPRESS)
    commands = parser.add_subparsers(dest="command", required=True)
    for name in ("size", "speed"):
        command = commands.add_parser(name)
        if name == "size":
            command.add_argument("target", choices=SYNTH)
        else:
            command.add_argument("--seeds", type=int, default=1)
            command.add_argument("--cells", action="store_true")
            command.add_argument("--check", action="store_true")
        command.add_argument("--all", action="store_true")
        command.add_argument("modules", nargs="*", metavar="MODULE")
    return parser.parse_args(arguments)


def main(arguments: list[str]) -> int:
    options = arguments_of(arguments)
    if options.command == "speed":
        columns = ([] if options.cells else ["logic cells", "nextpnr MHz", "icetime MHz"]) + ["osu035 MHz"]
    else:
        columns = ["cells", "area mm2"] if options.target == "osu035" else list(CELLS[options.target])
    print("| " + " | ".join(["module"] + columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    below = []
    for spec in all_modules() if options.all else options.modules or DATA_PATH:
        row = speed(spec, options.seeds, options.cells) if options.command == "speed" else size(options.target, spec)
        if options.command == "speed" and slow(row):
            below.append(spec)
        print("| " + " | ".join([spec] + row) + " |", flush=True)
    if options.command == "speed" and options.check and below:
        print(f"below {TARGET_MHZ:.0f} MHz: {', '.join(below)}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
