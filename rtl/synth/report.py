#!/usr/bin/env python3
"""Prints the size and speed of modules of rtl/ as a table in Markdown.

usage: ./run synthesis size TARGET [MODULE...]    TARGET: ice40, ecp5, xc7, osu035
       ./run synthesis speed [MODULE...]          Fmax by nextpnr-ice40 on an hx8k in the package ct256

MODULE is a name without "hmlfc_", with parameters as in interpolate,BLOCK_LOG2=1, and outputs that are left open as in
reconstruct,-prediction; without one, those of the data path.
size: LUTs, flip-flops, memories of LUTs, block RAMs and multipliers, or with osu035 cells and area. speed: the module between shift
registers on all its ports, as it has more of them than the chip has pins; a path begins and ends in a register.
HMLFC_SYNTH_TIMEOUT: seconds that one run may take (600).
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

RTL = pathlib.Path(__file__).resolve().parent.parent
TIMEOUT = int(os.environ.get("HMLFC_SYNTH_TIMEOUT", "600"))
LIBERTY = os.environ.get("HMLFC_OSU035", "/usr/share/qflow/tech/osu035/osu035_stdcells.lib")
DATA_PATH = ["bise_unpack", "bise_element", "residual", "vector", "interpolate", "reconstruct", "colour", "compose", "answer"]
CELLS = {
    "ice40": {"LUT": r"SB_LUT4", "FF": r"SB_DFF.*", "LUT RAM": r"(?!)", "BRAM": r"SB_RAM40.*", "DSP": r"SB_MAC16"},
    "ecp5": {"LUT": r"LUT4|CCU2C", "FF": r"TRELLIS_FF", "LUT RAM": r"TRELLIS_DPR16X4", "BRAM": r"DP16KD|PDPW16KD", "DSP": r"MULT18X18D"},
    "xc7": {"LUT": r"LUT[1-6]", "FF": r"FD[RSCP]E.*", "LUT RAM": r"RAM\d.*|SRL.*", "BRAM": r"RAMB.*", "DSP": r"DSP48E1"},
}
SYNTH = {
    "ice40": "synth_ice40 -top {top}",
    "ecp5": "synth_ecp5 -top {top}",
    "xc7": "synth_xilinx -family xc7 {flatten} -noiopad -top {top}",
    "osu035": "synth -flatten -top {top}; dfflibmap -liberty {lib}; abc -liberty {lib}; opt_clean",
}


def read(spec: str) -> tuple[str, str]:
    """The commands that read a module with its parameters, and its name."""
    name, *options = spec.split(",")
    module = f"hmlfc_{name}"
    commands = f"read_verilog -sv -I{RTL} {RTL}/hmlfc_pkg.sv {RTL}/{module}.sv; "
    for option in options:
        if not option.startswith("-"):
            commands += f"chparam -set {option.replace('=', ' ')} {module}; "
    commands += f"hierarchy -check -top {module} -libdir {RTL}; rename -top {module}_top; "
    for option in options:
        if option.startswith("-"):
            commands += f"select -assert-any {module}_top/o:{option[1:]}; delete -output {module}_top/o:{option[1:]}; "
    return commands, f"{module}_top"


def run(command: list[str]) -> str:
    """The text of a tool; empty where it takes too long."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)
    try:
        text, _ = process.communicate(timeout=TIMEOUT)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, 9)
        process.wait()
        return ""
    if process.returncode != 0:
        raise RuntimeError(text[-2000:])
    return text


def size(target: str, spec: str) -> list[str]:
    commands, top = read(spec)
    # The whole unit is mapped module by module: flattened it did not end within 25 minutes.
    flatten = "" if spec.startswith("decode_unit") else "-flatten"
    synth = SYNTH[target].format(top=top, lib=LIBERTY, flatten=flatten)
    if target == "osu035":
        text = run(["yosys", "-p", f"{commands}{synth}; stat -liberty {LIBERTY}"])
        cells = re.findall(r"Number of cells: +(\d+)", text)
        area = re.findall(r"Chip area for .*: ([\d.]+)", text)
        return [cells[-1], f"{float(area[-1]) / 1e6:.3f}"] if cells and area else ["too long"] * 2
    with tempfile.NamedTemporaryFile(suffix=".json") as out:
        if not run(["yosys", "-p", f"{commands}{synth}; tee -o {out.name} stat -json"]):
            return ["too long"] * len(CELLS[target])
        text = pathlib.Path(out.name).read_text(encoding="utf-8")
    kinds = json.loads(text[text.index("{"):])["design"]["num_cells_by_type"]
    # A carry cell of ecp5 takes the place of two LUTs.
    return [str(sum(n * (2 if kind == "CCU2C" else 1) for kind, n in kinds.items() if re.fullmatch(pattern, kind)))
            for pattern in CELLS[target].values()]


def wrapper(spec: str, folder: pathlib.Path) -> str:
    """Verilog of the module between shift registers."""
    commands, top = read(spec)
    netlist = folder / "ports.json"
    run(["yosys", "-p", f"{commands}proc; flatten; opt_clean; write_json {netlist}"])
    ports = json.loads(netlist.read_text(encoding="utf-8"))["modules"][top]["ports"]
    ins = outs = 0
    pins = []
    for name, port in ports.items():
        width = len(port["bits"])
        if name == "clk":
            pins.append(".clk(clk)")
        elif port["direction"] == "input":
            pins.append(f".{name}(in[{ins}+:{width}])")
            ins += width
        else:
            pins.append(f".{name}(out[{outs}+:{width}])")
            outs += width
    return (f"module shifted(input clk, input si, input load, output so);\n"
            f"reg [{ins - 1}:0] in; reg [{outs - 1}:0] held; wire [{outs - 1}:0] out;\n"
            f"always @(posedge clk) begin in <= {{in, si}}; held <= load ? out : held << 1; end\n"
            f"assign so = held[{outs - 1}];\n{top} unit({', '.join(pins)});\nendmodule\n")


def speed(spec: str) -> list[str]:
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        (folder / "shifted.v").write_text(wrapper(spec, folder), encoding="utf-8")
        commands, _ = read(spec)
        text = run(["yosys", "-p", f"{commands}read_verilog {folder}/shifted.v; synth_ice40 -top shifted -json {folder}/net.json"])
        if not text:
            return ["too long"] * 3
        try:
            text = run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--freq", "100", "--seed", "1", "--json",
                        f"{folder}/net.json", "--asc", f"{folder}/net.asc", "--timing-allow-fail"])
        except RuntimeError as error:
            used = re.findall(r"ICESTORM_LC: *(\d+)", str(error))
            return [used[-1] if used else "?", "does not fit", ""]
        if not text:
            return ["too long"] * 3
        used = re.findall(r"ICESTORM_LC: *(\d+)", text)[-1]
        fmax = re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", text)[-1]
        icetime = run(["icetime", "-d", "hx8k", "-t", f"{folder}/net.asc"])
        estimate = re.findall(r"\(([\d.]+) MHz\)", icetime)[-1]
        if os.environ.get("HMLFC_SYNTH_PATH"):
            print(text[text.rindex("Critical path report for clock"):][:12000], file=sys.stderr)
        return [used, fmax, estimate]


def main(arguments: list[str]) -> int:
    if arguments[:1] in (["--help"], ["-h"]):
        print(__doc__)
        return 0
    if arguments[:1] == ["speed"]:
        columns, measure, specs = ["logic cells", "nextpnr MHz", "icetime MHz"], speed, arguments[1:]
    elif arguments[:1] == ["size"] and len(arguments) > 1 and arguments[1] in SYNTH:
        target = arguments[1]
        columns = ["cells", "area mm2"] if target == "osu035" else list(CELLS[target])
        specs = arguments[2:]

        def measure(spec: str) -> list[str]:
            return size(target, spec)
    else:
        print(__doc__, file=sys.stderr)
        return 2
    print("| " + " | ".join(["module"] + columns) + " |")
    print("|---" * (len(columns) + 1) + "|")
    for spec in specs or DATA_PATH:
        print("| " + " | ".join([spec] + measure(spec)) + " |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
