"""Whether a mutant differs from its module at all."""

import pathlib
import re
import subprocess
import tempfile

import units

EQUIVALENT = "equivalent"  # proved for all legal inputs, by induction over all clocks: from a state that both share, outputs stay the same
DIFFERS = "differs"        # legal inputs are found for which the module's outputs differ
UNPROVED = "unproved"      # neither, within the time

MODEL = "SAT proof finished - model found: FAIL!"
NO_MODEL = "SAT proof finished - no model found: SUCCESS!"
DEPTH = 8  # clocks from reset in which a difference is looked for: more than a pipeline of the datapath is long


def ports(variant: int, folder: pathlib.Path) -> list[tuple[str, str, str]]:
    """Direction, range and name of each port of a variant."""
    text = (folder / f"mutated_{variant}.v").read_text(encoding="utf-8")
    found = re.findall(r"^  (input|output) (\[\d+:0\] )?(\w+);", text, re.M)
    return [port for port in found if port[2] != "mutsel"]


def legal_inputs(variant: int, folder: pathlib.Path) -> str:
    """A module with the ports of a variant that gives it only what its comment allows: `legal` of units.py."""
    unit = units.VARIANTS[variant]
    listed = [port for port in ports(variant, folder) if port[2] not in unit.traced]
    values = "".join(f"  wire {width}legal_{name} = {unit.legal.get(name, name)};\n" for direction, width, name in listed
                     if direction == "input")
    connections = ", ".join(f".{name}({'legal_' if direction == 'input' else ''}{name})" for direction, _, name in listed)
    heads = ", ".join(f"{direction} {width}{name}" for direction, width, name in listed)
    return f"module outside ({heads});\n`include \"hmlfc_tables.svh\"\n{values}  top inside ({connections});\nendmodule\n"


def both(mutant: dict, folder: pathlib.Path, scratch: pathlib.Path) -> str:
    """The module as `gold` and the mutant as `gate`, with all that is in them, for legal inputs; outputs of the trace alone are left
    out. `folder` is that of plant.py."""
    variant = mutant["variant"]
    (scratch / "outside.v").write_text(legal_inputs(variant, folder), encoding="utf-8")
    inner = "".join(f"read_verilog -sv -overwrite {file}\n" for file in units.inner_modules(variant))
    text = []
    for copy in ("gold", "gate"):
        planted = mutant["command"] + "\n" if copy == "gate" else ""
        text.append(f"design -reset\nread_rtlil {folder}/{variant}.il\n{planted}read_verilog -sv hmlfc_pkg.sv\n{inner}"
                    f"read_verilog -sv {scratch}/outside.v\nhierarchy -top outside -libdir {units.RTL}\nproc\nflatten\n"
                    f"memory_map\nopt_clean\nrename outside {copy}\ndesign -stash {copy}\n")
    return "".join(text) + "design -reset\ndesign -copy-from gold gold\ndesign -copy-from gate gate\n"


def says(script: str, scratch: pathlib.Path, seconds: float) -> str:
    """What Yosys says to a script; empty where it takes too long."""
    path = scratch / "prove.ys"
    path.write_text(script, encoding="utf-8")
    try:
        return units.yosys(path, seconds, quiet=False)
    except subprocess.TimeoutExpired:
        return ""


def flows(mutant: dict) -> bool:
    """Whether outputs of module and mutant depend on the last `latency` inputs alone, and a clock without advance only holds both:
    then clocks with advance alone are a proof. A mutant where the pipeline holds may differ by the hold."""
    return units.VARIANTS[mutant["variant"]].latency is not None and "$procmux$" not in mutant["command"]


def prove(mutant: dict, folder: pathlib.Path, seconds: float) -> str:
    """One of the three results for a mutant of mutants.json in `folder`."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        scratch = pathlib.Path(name)
        # What both have alike is one in the miter.
        pair = both(mutant, folder, scratch)
        miter = pair + "miter -equiv -flatten gold gate both\nhierarchy -top both\nopt_expr\nopt_merge -share_all\nopt_clean\n"
        if flows(mutant):
            latency = units.VARIANTS[mutant["variant"]].latency
            flow = says(miter + f"sat -set in_advance 1 -prove trigger 0 -seq {latency + 1} -prove-skip {latency} both\n", scratch, seconds)
            if NO_MODEL in flow:
                return EQUIVALENT
            if MODEL in flow:
                return DIFFERS
        equal = says(pair + "equiv_make gold gate both\nhierarchy -top both\nequiv_struct\nequiv_simple -undef\nequiv_induct -undef\n"
                     "equiv_status\n", scratch, seconds)
        if "Equivalence successfully proven!" in equal:
            return EQUIVALENT
        apart = says(miter + f"sat -prove trigger 0 -set-init-zero -seq {DEPTH} both\n", scratch, seconds)
    if MODEL in apart:
        return DIFFERS
    # Without state a search through one clock is the whole proof.
    return EQUIVALENT if "$dff" not in apart and NO_MODEL in apart else UNPROVED
