#!/usr/bin/env python3
"""replay_test.py RTL_DECODE SUITE [--view] [--gates]: a unit as Yosys understands it, against the pins of the Verilated unit.

Streams of the suite are decoded by the Verilated decode unit or, with --view, view unit, with pauses of the memory, and its
pins are recorded. Yosys writes the unit as a netlist, of words or, with --gates, of gates as after synthesis; pin_replay.sv
or view_pin_replay.sv plays the records to it in Icarus. All registers and memories are unknown at first, and no output may be unknown that has a meaning. A record
with one wrong bit must fail. Exit status 77: a tool is missing.
"""

import argparse
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RTL = ROOT / "rtl"
# Unit: its player, streams, options of rtl_decode, parameters as of the Verilated unit for these streams.
UNITS = {
    "hmlfc_decode_unit": ("pin_replay", ("stress/random-main-06", "stress/random-extended-09"), [],
                          {"BLOCK_LOG2": 1, "MAX_DEPTH": 12, "AXI_DATA_BITS": 64, "OUTSTANDING": 5, "TRACE": 0}),
    "hmlfc_view_unit": ("view_pin_replay", ("stress/random-main-01", "stress/random-extended-10"), ["--views"],
                        {"BLOCK_LOG2": 2, "MAX_DEPTH": 12, "AXI_DATA_BITS": 128, "OUTSTANDING": 32, "TRACE": 0}),
}
GATES = "synth -top {unit} -run begin:fine; opt -fast -full; techmap; opt -fast; abc -fast; opt_clean; "

sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402


def must(*command):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}: exit status {done.returncode}\n{done.stdout[-2000:]}{done.stderr[-2000:]}"
    return done.stdout


def player(folder, unit, gates):
    """The program of Icarus that plays records to the netlist of a unit."""
    files = " ".join(str(RTL / path.name) for path in file_list.sources(RTL))
    module, *_, parameters = UNITS[unit]
    netlist, program = folder / "netlist.v", folder / "player.vvp"
    must("yosys", "-q", "-p", f"read_verilog -sv -DSYNTHESIS -I{RTL} {files}; "
         f"chparam {' '.join(f'-set {name} {value}' for name, value in parameters.items())} {unit}; "
         f"hierarchy -check -top {unit}; proc; {GATES.format(unit=unit) if gates else ''}write_verilog -noattr {netlist}")
    kit = (RTL / "kit" / name for name in ("pin_player.sv", f"{module}.sv"))
    must("iverilog", "-g2012", "-s", module, f"-P{module}.AXI_DATA_BITS={parameters['AXI_DATA_BITS']}", "-o", program, *kit, netlist)
    return program


def replay(program, pins):
    """What the simulation says of a record."""
    return must("vvp", "-n", program, f"+pins={pins}")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("rtl_decode")
    parser.add_argument("suite", type=Path)
    parser.add_argument("--view", action="store_true")
    parser.add_argument("--gates", action="store_true")
    options = parser.parse_args()
    if not all(map(shutil.which, ("yosys", "iverilog"))):
        sys.exit(77)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        unit = "hmlfc_view_unit" if options.view else "hmlfc_decode_unit"
        _, streams, by, _ = UNITS[unit]
        program = player(folder, unit, options.gates)
        for stream in streams:
            pins = folder / "pins"
            must(options.rtl_decode, options.suite / f"{stream}.hmlfc", "-o", folder, "--pins", pins, *by)
            clocks = len(pins.read_text().splitlines())
            said = replay(program, pins)
            print(f"{stream}: {said.splitlines()[0]}", flush=True)
            assert clocks > 1000 and f"pin_replay: {clocks} clocks equal" in said, said
        inputs, outputs, mask = pins.read_text().splitlines()[clocks // 2].split()
        bit = 1 << (int(mask, 16).bit_length() - 1)
        lines = pins.read_text().splitlines()
        lines[clocks // 2] = f"{inputs} {int(outputs, 16) ^ bit:x} {mask}"
        pins.write_text("\n".join(lines) + "\n")
        assert f"difference at clock {clocks // 2}" in replay(program, pins), "a wrong pin is not noticed"


if __name__ == "__main__":
    main()
