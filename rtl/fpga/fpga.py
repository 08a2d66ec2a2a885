#!/usr/bin/env python3
"""Makes the bitstream of the system in rtl/fpga for an ECP5-85F on the board ULX3S.

usage: ./run fpga [--seeds N] [--simulate]

Yosys synthesises; nextpnr-ecp5 places and routes with seeds 1 to N (1), hours each; ecppack writes out/fpga/ulx3s.bit of the fastest. Prints
size and clock rates as tables in Markdown. --simulate: before, the netlist has to give the pixels of hmlfc decode, which takes long.
Exit status 1: a tool is missing or fails, or the clock rate of the board is not reached; 77: that simulate has no Verilator.
       fpga.py simulate HMLFC FOLDER       the system before synthesis alone, in FOLDER; HMLFC: the program
"""

import argparse
import pathlib
import re
import shutil
import statistics
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
RTL = HERE.parent
ROOT = RTL.parent
NEEDED = {"yosys": "yosys", "nextpnr-ecp5": "nextpnr-ecp5", "ecppack": "fpga-trellis", "verilator": "verilator"}
BOARD_MHZ = 25.0
GOAL_MHZ = 12.5  # of nextpnr: a goal that placement reaches leaves room to route
SKIPPED = 77

sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402

# For few LUTs.
AREA = "strash\nifraig\nscorr\ndc2\ndc2\nstrash\ndch -f\nif -a\nmfs2\nlutpack\n"
LUT = r"""module LUT4(input A, B, C, D, output Z);
  parameter [15:0] INIT = 0;
  \$lut #(.WIDTH(4), .LUT(INIT)) _TECHMAP_REPLACE_ (.A({D, C, B, A}), .Y(Z));
endmodule
"""


def run(*command: object, cwd: pathlib.Path | None = None) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, cwd=cwd)
    if done.returncode != 0:
        sys.exit(f"{command[0]} failed:\n{done.stdout[-3000:]}")
    return done.stdout


def cells() -> pathlib.Path:
    """The folder of Yosys' models of cells."""
    return pathlib.Path(shutil.which("yosys") or "/usr/bin/yosys").resolve().parent.parent / "share" / "yosys" / "ecp5"


def say(text: str) -> None:
    print(text, flush=True)


def simulate(hmlfc: pathlib.Path, folder: pathlib.Path, netlist: pathlib.Path | None = None) -> None:
    """A view of a small stream through the serial port, compared with hmlfc decode byte for byte."""
    folder.mkdir(parents=True, exist_ok=True)
    run(hmlfc, "synth", "--scene", "cards", "--grid", "2x2", "--size", "32x24", "--force", "-o", folder / "views")
    run(hmlfc, "encode", folder / "views", "--height", "1", "--force", "-o", folder / "small.hmlfc")
    run(hmlfc, "decode", folder / "small.hmlfc", "--view", "1,1", "--force", "-o", folder / "decoded")
    run("make", "-s", "-f", HERE / "Makefile", f"BUILD={folder}", f"NETLIST={netlist or ''}", f"CELLS={cells()}", folder / "fpga_bench")
    out = folder / "view.ppm"
    out.unlink(missing_ok=True)
    say(run(folder / "fpga_bench", folder / "fpga_host", folder / "small.hmlfc", 1, 1, out, 600).strip())
    from PIL import Image
    one, two = (Image.open(name).convert("RGB").tobytes() for name in (out, folder / "decoded" / "01_01.png"))
    if one != two or len(set(one)) < 10:
        sys.exit("the pixels are not those of hmlfc decode")


def synthesise(folder: pathlib.Path) -> None:
    """Writes ulx3s.json. Parts are mapped alone before all is flattened: as one piece the unit takes too long."""
    (folder / "area.abc").write_text(AREA, encoding="utf-8")
    # Wide memories of few words that LUTs would take.
    block_rams = " ".join(f"*/*{name}.words" for name in ("lines_of", "descriptors.storage", "list.storage"))
    parts = " ".join(f"*hmlfc_{name}*/t:*hmlfc_*" for name in ("decode_unit", "view_dma", "references", "tile_stores"))
    run("yosys", "-q", "-l", folder / "yosys.log", "-p",
        f"verilog_defaults -add -I{RTL}; read_verilog -sv {RTL}/hmlfc_pkg.sv {HERE}/*.sv; "
        f"hierarchy -check -top ulx3s {file_list.library(RTL)}; rename -top ulx3s; setattr -set keep_hierarchy 1 {parts}; "
        "synth_ecp5 -noabc9 -nowidelut -top ulx3s -run begin:map_ram; "
        f"setattr -set ram_style \"block\" {block_rams}; synth_ecp5 -noabc9 -nowidelut -top ulx3s -run map_ram:map_luts; "
        "setattr -mod -unset keep_hierarchy *; setattr -unset keep_hierarchy */t:*; flatten; opt_clean; "
        f"techmap -map +/ecp5/latches_map.v; abc -script {folder}/area.abc -lut 4; clean; "
        "techmap -map +/ecp5/cells_map.v; opt_lut_ins -tech lattice; clean; "
        f"blackbox =A:whitebox; write_json {folder}/ulx3s.json")


def write_netlist(folder: pathlib.Path) -> pathlib.Path:
    """The netlist as Verilog. LUTs become expressions: as modules there are thousands of different ones."""
    (folder / "lut.v").write_text(LUT, encoding="utf-8")
    unset = " ".join(f"-unset INITVAL_{i:02X}" for i in range(64))
    for name in ("ASYNC_RESET_RELEASE", "RESETMODE", "GSR", *(f"{name}_{port}" for name in ("CSDECODE", "REGMODE", "WRITEMODE") for port in "AB"),
                 "CLKAMUX", "CLKBMUX"):
        unset += f" -unset {name}"
    run("yosys", "-q", "-p", f"read_json {folder}/ulx3s.json; setparam {unset} t:DP16KD; techmap -map {folder}/lut.v; delete =A:blackbox; "
        f"splitnets; opt_clean -purge; rename -hide w:*; write_verilog -noattr {folder}/netlist.v")
    return folder / "netlist.v"


def place(folder: pathlib.Path, seed: int) -> tuple[float, list[str]]:
    """The clock rate in MHz, and a row for each kind of cell: used and there."""
    # router2 had 14 thousand wires used twice after 12 rounds, and hardly fewer with each.
    run("nextpnr-ecp5", "--router", "router1", "--85k", "--package", "CABGA381", "--speed", 6, "--json", folder / "ulx3s.json", "--lpf", HERE / "ulx3s.lpf",
               "--freq", GOAL_MHZ, "--seed", seed, "--timing-allow-fail", "--textcfg", folder / f"{seed}.config", "-q", "--log", folder / f"{seed}.log")
    text = (folder / f"{seed}.log").read_text(encoding="utf-8")
    cells = re.findall(r"Info:\s+(TRELLIS_COMB|TRELLIS_FF|DP16KD|MULT18X18D): +(\d+)/ *(\d+)", text)
    rate = float(re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", text)[-1])
    return rate, [f"| {kind} | {used} | {there} |" for kind, used, there in dict.fromkeys(cells)]


def main(arguments: list[str]) -> int:
    if arguments[:1] == ["simulate"]:
        if shutil.which("verilator") is None:
            return SKIPPED
        simulate(*(pathlib.Path(name).resolve() for name in arguments[1:]))
        return 0
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, usage=argparse.SUPPRESS)
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--simulate", action="store_true")
    options = parser.parse_args(arguments)
    missing = {package for tool, package in NEEDED.items() if shutil.which(tool) is None}
    if missing:
        sys.exit(f"./run fpga: missing: {', '.join(sorted(missing))}. Debian 13 has packages of these names.")
    folder = ROOT / "out" / "fpga"
    folder.mkdir(parents=True, exist_ok=True)
    synthesise(folder)
    if options.simulate:
        simulate(ROOT / "build" / "release" / "tools" / "hmlfc", folder / "simulation", write_netlist(folder))
    rates = {}
    for seed in range(1, options.seeds + 1):
        rates[seed], cells_used = place(folder, seed)
        if seed == 1:
            say("\n".join(["| cell | used | there |", "|---|---|---|", *cells_used, "", "| seed | MHz |", "|---|---|"]))
        say(f"| {seed} | {rates[seed]:.1f} |")
    say(f"| median | {statistics.median(rates.values()):.1f} |")
    best = max(rates, key=lambda seed: rates[seed])
    run("ecppack", "--compress", folder / f"{best}.config", folder / "ulx3s.bit")
    return 0 if rates[best] >= BOARD_MHZ else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
