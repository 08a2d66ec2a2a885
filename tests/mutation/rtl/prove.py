#!/usr/bin/env python3
"""Whether a mutant differs from its module at all.

usage: prove.py FOLDER    proves mutants whose end is known; FOLDER is that of plant.py. Exit: 0 all as known, 1 not.
"""

import json
import pathlib
import re
import resource
import signal
import subprocess
import sys
import tempfile

import units

EQUIVALENT = "equivalent"  # proved: for legal inputs the outputs are the same, over all clocks
DIFFERS = "differs"        # legal inputs are found for which the outputs differ
UNPROVED = "unproved"      # neither, within the CPU time

STATUS = {"1": EQUIVALENT, "0": DIFFERS, "-1": UNPROVED}  # as ABC numbers them
CLOCKS = 40  # from reset in which a difference is looked for where there is state


def ports(variant: int, folder: pathlib.Path) -> list[tuple[str, str, str]]:
    """Direction, range and name of each port of a variant."""
    text = (folder / f"mutated_{variant}.v").read_text(encoding="utf-8")
    found = re.findall(r"^  (input|output) (\[\d+:0\] )?(\w+);", text, re.M)
    return [port for port in found if port[2] != "mutsel"]


def variant_of(mutant: dict) -> units.Variant:
    """What is known of it, without the group that it is in: of modules that are not of the datapath, that proofs know nothing."""
    known = [variant for variant in units.DATAPATH if (variant.module, variant.parameters) == (mutant["module"], mutant["parameters"])]
    return known[0] if known else units.Variant(mutant["module"], mutant["parameters"], closed=True)


def flows(mutant: dict) -> bool:
    """Whether outputs of module and mutant depend on the last `latency` inputs alone, and a clock without advance only holds both:
    then clocks with advance alone are a proof. A mutant where the pipeline holds may differ by the hold."""
    return variant_of(mutant).latency is not None and "$procmux$" not in mutant["command"]


def legal_inputs(mutant: dict, folder: pathlib.Path) -> str:
    """A module with the ports of a variant that gives it only what its comment allows: `legal` of units.py."""
    unit = variant_of(mutant)
    legal = unit.legal | ({"advance": "1'b1"} if flows(mutant) else {})
    listed = [port for port in ports(mutant["variant"], folder) if port[2] not in unit.traced]
    values = "".join(f"  wire {width}legal_{name} = {legal.get(name, name)};\n" for direction, width, name in listed
                     if direction == "input")
    connections = ", ".join(f".{name}({'legal_' if direction == 'input' else ''}{name})" for direction, _, name in listed)
    heads = ", ".join(f"{direction} {width}{name}" for direction, width, name in listed)
    return f"module outside ({heads});\n`include \"hmlfc_tables.svh\"\n{values}  top inside ({connections});\nendmodule\n"


def both(mutant: dict, folder: pathlib.Path, scratch: pathlib.Path) -> str:
    """The module as `gold` and the mutant as `gate`, with all that is in them, for legal inputs; outputs of the trace alone are left
    out. `folder` is that of plant.py."""
    variant = variant_of(mutant)
    (scratch / "outside.v").write_text(legal_inputs(mutant, folder), encoding="utf-8")
    inner = "delete =A:blackbox\n" + "".join(f"read_verilog -sv {file}\n" for file in units.all_inner_modules(variant))
    # Closed are modules with their own parameters, not with those that a library has of them: their outputs become inputs, and the other way round.
    closed = "blackbox *hmlfc_*\n" if variant.closed else ""
    opened = "expose -evert t:*hmlfc_*\n" if variant.closed else ""
    text = []
    for copy in ("gold", "gate"):
        planted = mutant["command"] + "\n" if copy == "gate" else ""
        text.append(f"design -reset\nread_rtlil {folder}/{mutant['variant']}.il\n{planted}read_verilog -sv hmlfc_pkg.sv\n{inner}"
                    f"read_verilog -sv {scratch}/outside.v\nhierarchy -check -top outside\n{closed}proc\nflatten\n"
                    f"memory_map\n{opened}opt_clean\nrename outside {copy}\ndesign -stash {copy}\n")
    return "".join(text) + "design -reset\ndesign -copy-from gold gold\ndesign -copy-from gate gate\n"


def write_miter(mutant: dict, folder: pathlib.Path, scratch: pathlib.Path) -> pathlib.Path:
    """Both as an and-inverter graph whose one output is 1 where outputs differ. Bits that the source leaves undefined, and registers
    at the begin, are 0 in both."""
    script, miter = scratch / "prove.ys", scratch / "miter.aig"
    # What both have alike is one in the miter.
    script.write_text(both(mutant, folder, scratch) + "setundef -undriven -init -zero gold gate\nmiter -equiv -flatten gold gate both\n"
                      "hierarchy -top both\nopt_expr\nopt_merge -share_all\nopt_clean\nasync2sync\ndffunmap\ntechmap\nopt_expr\n"
                      f"opt_merge -share_all\nopt_clean\ndffunmap\nsetundef -undriven -zero\naigmap\nwrite_aiger -zinit {miter}\n",
                      encoding="utf-8")
    units.yosys(script)
    return miter


def decided(miter: pathlib.Path, steps: str, seconds: int) -> str:
    """What ABC says of the miter after `steps`; UNPROVED where it says nothing in that CPU time. Raises RuntimeError where it fails."""
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    done = subprocess.run(["yosys-abc", "-c", f"read_aiger {miter}; {steps}; print_status"], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True, preexec_fn=limit, check=False)
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return UNPROVED
    found = re.search(r"^Status = *(-?[01]) ", done.stdout, re.M)
    if not found:
        raise RuntimeError(f"yosys-abc: {done.stdout[-2000:]}")
    return STATUS[found.group(1)]


def is_ignored(mutant: dict, folder: pathlib.Path, scratch: pathlib.Path) -> bool:
    """Whether a mutant is of an input bit of an instance of which nothing inside reads that bit, such as a field of the stream's shape."""
    place = re.search(r"-cell (\w\S*) -port (\w+) -portbit (\d+)", mutant["command"])
    if place is None:
        return False
    cell, port, bit = place[1], place[2], int(place[3])
    script, netlist = scratch / "ignored.ys", scratch / "ignored.json"
    script.write_text(f"read_rtlil {folder}/{mutant['variant']}.il\ndelete =A:blackbox\nread_verilog -sv hmlfc_pkg.sv\nhierarchy -check -top top -libdir .\n"
                      f"setattr -mod -set keep_hierarchy 1 *\nsetattr -mod -unset keep_hierarchy top\nproc\nopt_clean\nwrite_json {netlist}\n", encoding="utf-8")
    units.yosys(script)
    inner = json.loads(netlist.read_text(encoding="utf-8"))["modules"]["top"]["cells"][cell]["type"]
    if inner.startswith("$") and not inner.startswith("$paramod"):
        return False  # a memory has a name, too
    script.write_text(script.read_text(encoding="utf-8") + f"setattr -mod -unset keep_hierarchy *\nhierarchy -top {inner}\nflatten\nopt_expr\nopt_clean\nwrite_json {netlist}\n",
                      encoding="utf-8")
    units.yosys(script)
    module = json.loads(netlist.read_text(encoding="utf-8"))["modules"][inner.removeprefix("\\")]
    net = module["ports"][port]["bits"][bit]
    readers = [bits for one in module["cells"].values() for side, bits in one["connections"].items() if one["port_directions"][side] == "input"]
    readers += [one["bits"] for one in module["ports"].values() if one["direction"] == "output"]
    return module["ports"][port]["direction"] == "input" and all(net not in bits for bits in readers)


def prove(mutant: dict, folder: pathlib.Path, seconds: int) -> str:
    """One of the three results for a mutant of mutants.json in `folder`; each search takes `seconds` of CPU time at most."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        if variant_of(mutant).closed and is_ignored(mutant, folder, pathlib.Path(name)):
            return EQUIVALENT
        miter = write_miter(mutant, folder, pathlib.Path(name))
        if flows(mutant):
            latency = variant_of(mutant).latency
            return decided(miter, f"frames -F {latency + 1}; cone -O {latency}; iprove", seconds)
        # Equal registers of both become one; what is left is searched from reset, then proved by invariants.
        found = decided(miter, f"scorr; bmc3 -F {CLOCKS}", seconds)
        return decided(miter, "scorr; pdr", seconds) if found == UNPROVED else found


def planted(module: str, cell: str, port: str, bit: int) -> dict:
    """A mutant with a bit of a port of a cell inverted, in the first variant of a module."""
    variant = next(number for number, unit in enumerate(units.DATAPATH) if unit.module == module)
    return {"module": module, "parameters": units.DATAPATH[variant].parameters, "variant": variant, "command": f"mutate -mode inv -module top -cell {cell} -port {port} -portbit {bit}"}


# What registers hold before they are first written must not count as a difference, nor a bit of the stream's shape that the module
# inside does not use: the last says whether nothing reads it.
KNOWN = [
    (planted("motion_blocks", "place", "stream", 121), EQUIVALENT, True),
    (planted("tile_vectors", "reader_x", "window", 0), DIFFERS, False),
    (planted("bise_unpack", "gen_trits[0].decode", "trits", 0), DIFFERS, False),  # a pipeline
]


def of_queue(folder: pathlib.Path) -> list[tuple[dict, str]]:
    """Mutants of a queue, whose memory is closed, in a folder of its own: of the memory's upper bits, and of the word kept beside where it is not
    put, which differs inside alone."""
    unit = units.Variant("fifo", {"WIDTH": 20, "DEPTH": 4}, closed=True)
    script = folder / "0.ys"
    script.write_text(f"{units.read_commands(unit)}write_rtlil {folder}/0.il\nwrite_verilog -noattr {folder}/mutated_0.v\n", encoding="utf-8")
    units.yosys(script)
    holds = re.search(r"cell \$mux (\S+)\n(?:    parameter .*\n)*    connect \\A \\latest\n", (folder / "0.il").read_text(encoding="utf-8"))
    if holds is None:
        raise RuntimeError("prove.py: the queue's netlist is not as the self-test expects")
    places = [("storage -port read_data -portbit 19", DIFFERS), (f"{holds[1]} -port A -portbit 7", EQUIVALENT), (f"{holds[1]} -port B -portbit 7", DIFFERS)]
    return [({"module": unit.module, "parameters": unit.parameters, "variant": 0, "command": f"mutate -mode inv -module top -cell {place}"}, known)
            for place, known in places]


def self_test(folder: pathlib.Path) -> int:
    wrong = 0
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        scratch = pathlib.Path(name)
        for mutant, known, ignored, where in [*((*one, folder) for one in KNOWN), *((*one, False, scratch) for one in of_queue(scratch))]:
            wrong += is_ignored(mutant, where, scratch) != ignored
            found = prove(mutant, where, 60)
            wrong += found != known
            print(f"{mutant['command']}: {found}{'' if found == known else ', must be ' + known}", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(self_test(pathlib.Path(sys.argv[1]).resolve()))
