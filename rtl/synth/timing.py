"""How fast a module is: placed and routed on an iCE40 HX8K, and mapped to the standard cells of osu035."""

import json
import os
import pathlib
import re
import statistics
import sys
import tempfile

from tools import LIBERTY, RTL, read, run

HX8K = {"ICESTORM_LC": 7680, "ICESTORM_RAM": 32}
CONSTRAINTS = (RTL / "kit" / "hmlfc_decode_unit.sdc").read_text(encoding="utf-8")
PERIOD = float(re.search(r"^set hmlfc_period ([\d.]+)$", CONSTRAINTS, re.MULTILINE)[1])  # ns
HERE = pathlib.Path(__file__).resolve().parent


def ports_of(spec: str, folder: pathlib.Path) -> dict:
    commands, top = read(spec)
    netlist = folder / "ports.json"
    run(["yosys", "-p", f"{commands}proc; flatten; opt_clean; write_json {netlist}"])
    return json.loads(netlist.read_text(encoding="utf-8"))["modules"][top]["ports"]


def wrapper(spec: str, folder: pathlib.Path) -> str:
    """Verilog of the module between shift registers."""
    _, top = read(spec)
    ins = outs = 0
    pins = []
    for name, port in ports_of(spec, folder).items():
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


def placed(spec: str, seeds: int) -> list[str]:
    """Logic cells, and the median over the seeds of the clock rates by nextpnr and by icetime."""
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        (folder / "shifted.v").write_text(wrapper(spec, folder), encoding="utf-8")
        commands, _ = read(spec)
        text = run(["yosys", "-p", f"{commands}read_verilog {folder}/shifted.v; synth_ice40 -top shifted -json {folder}/net.json"])
        if not text:
            return ["too long"] * 3
        cells = sum(int(n) for n in re.findall(r"SB_LUT4 +(\d+)", text[text.rindex("Number of cells:"):]))
        if cells > HX8K["ICESTORM_LC"]:
            return [str(cells), "does not fit", ""]
        rates, estimates = [], []
        for seed in range(1, seeds + 1):
            try:
                text = run(["nextpnr-ice40", "--hx8k", "--package", "ct256", "--freq", "100", "--seed", str(seed), "--json",
                            f"{folder}/net.json", "--asc", f"{folder}/net.asc", "--timing-allow-fail"])
            except RuntimeError as error:
                used = re.findall(r"ICESTORM_LC: *(\d+)", str(error))
                return [used[-1] if used else str(cells), "does not fit", ""]
            if not text:
                return [str(cells), "too long", ""]
            used = re.findall(r"ICESTORM_LC: *(\d+)", text)[-1]
            rates.append(float(re.findall(r"Max frequency for clock .*: ([\d.]+) MHz", text)[-1]))
            icetime = run(["icetime", "-d", "hx8k", "-t", f"{folder}/net.asc"])
            estimates.append(float(re.findall(r"\(([\d.]+) MHz\)", icetime)[-1]))
            if os.environ.get("HMLFC_SYNTH_PATH"):
                print(text[text.rindex("Critical path report for clock"):][:12000], file=sys.stderr)
        return [used, f"{statistics.median(rates):.1f}", f"{statistics.median(estimates):.1f}"]


def constraints(has_clock: bool) -> str:
    """Those of the unit for a module alone: the whole period is for paths inside, and its clock may be none of its ports."""
    text = re.sub(r"^set hmlfc_outside .*", "set hmlfc_outside 0.0", CONSTRAINTS, flags=re.MULTILINE)
    return text if has_clock else text.replace("[get_ports clk]", "")


def in_cells(spec: str, whole: bool) -> list[str]:
    """The clock rate of a module in standard cells without wires, by OpenSTA. The whole unit is mapped module by module."""
    with tempfile.TemporaryDirectory() as work:
        folder = pathlib.Path(work)
        commands, top = read(spec)
        (folder / "constraints").write_text("set_driving_cell BUFX4\nset_load 0.1\n", encoding="utf-8")
        flat = "" if whole else "-flatten"
        text = run(["yosys", "-p", f"{commands}read_liberty -lib {LIBERTY}; synth {flat} -top {top} -run begin:fine; "
                    f"techmap -map {HERE}/memory_ports.v; synth -top {top} -run fine:; dfflibmap -liberty {LIBERTY}; "
                    f"abc -liberty {LIBERTY} -constr {folder}/constraints -D {PERIOD * 1000:.0f}; flatten; opt_clean; setundef -zero; insbuf -buf BUFX2 A Y; "
                    f"splitnets -ports; opt_clean -purge; write_verilog -noattr -noexpr -nohex {folder}/net.v"])
        if not text:
            return ["too long"]
        (folder / "unit.sdc").write_text(constraints("clk" in ports_of(spec, folder)), encoding="utf-8")
        (folder / "time.tcl").write_text(f"""
read_liberty {LIBERTY}
read_verilog {folder}/net.v
link_design {top}
read_sdc {folder}/unit.sdc
report_checks -path_delay max
report_worst_slack
exit
""", encoding="utf-8")
        text = run(["sta", "-no_splash", str(folder / "time.tcl")])
        if os.environ.get("HMLFC_SYNTH_PATH"):
            print(text, file=sys.stderr)
        slack = re.findall(r"worst slack +(-?[\d.]+)", text)
        return [f"{1000 / (PERIOD - float(slack[-1])):.1f}" if slack else "no path"]
