"""Whether a mutant differs from its module at all."""

import pathlib
import subprocess
import tempfile

import units

EQUIVALENT = "equivalent"  # proved, by induction over all clocks: from a state that both share, outputs stay the same
DIFFERS = "differs"        # an input is found for which the module's outputs differ
UNPROVED = "unproved"      # neither, within the time

DEPTH = 8  # clocks from reset in which a difference is looked for: more than a pipeline of the datapath is long


def both(mutant: dict, folder: pathlib.Path) -> str:
    """The module as `gold` and the mutant as `gate`, with all that is in them; outputs of the trace alone are left out. `folder` is that of
    plant.py."""
    variant = mutant["variant"]
    inner = "".join(f"read_verilog -sv -overwrite {file}\n" for file in units.inner_modules(variant))
    text = []
    for copy in ("gold", "gate"):
        planted = mutant["command"] + "\n" if copy == "gate" else ""
        text.append(f"design -reset\nread_rtlil {folder}/{variant}.il\n{planted}read_verilog -sv hmlfc_pkg.sv\n{inner}"
                    f"hierarchy -top top -libdir {units.RTL}\nproc\nflatten\n"
                    + "".join(f"delete -output top/o:{output}\n" for output in units.VARIANTS[variant][2])
                    + f"memory_map\nopt_clean\nrename top {copy}\ndesign -stash {copy}\n")
    return "".join(text) + "design -reset\ndesign -copy-from gold gold\ndesign -copy-from gate gate\n"


def says(script: str, seconds: float) -> str:
    """What Yosys says to a script; empty where it takes too long."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as folder:
        path = pathlib.Path(folder) / "prove.ys"
        path.write_text(script, encoding="utf-8")
        try:
            return units.yosys(path, seconds, quiet=False)
        except subprocess.TimeoutExpired:
            return ""


def prove(mutant: dict, folder: pathlib.Path, seconds: float) -> str:
    """One of the three results for a mutant of mutants.json in `folder`."""
    pair = both(mutant, folder)
    equal = says(pair + "equiv_make gold gate both\nhierarchy -top both\nequiv_simple -undef\nequiv_induct -undef\nequiv_status\n", seconds)
    if "Equivalence successfully proven!" in equal:
        return EQUIVALENT
    apart = says(pair + "miter -equiv -flatten gold gate both\nhierarchy -top both\n"
                 f"sat -prove trigger 0 -set-init-zero -seq {DEPTH} -show-inputs both\n", seconds)
    if "SAT proof finished - model found: FAIL!" in apart:
        return DIFFERS
    # Without state a search through one clock is the whole proof.
    stateless = "$dff" not in apart and "SAT proof finished - no model found: SUCCESS!" in apart
    return EQUIVALENT if stateless else UNPROVED
