#!/usr/bin/env python3
"""Shadows of all mutants of a module without state show at its pins for some input if, and only if, the mutant differs.

usage: observe_test.py FOLDER    FOLDER is that of plant.py for the datapath. Exit: 0 they do, 1 not.
"""

import json
import pathlib
import shutil
import sys
import tempfile

import observe
import prove
import units

MODULE = "trits"
CAN, CANNOT = "SAT solving finished - model found", "SAT solving finished - no model found"


def shows(folder: pathlib.Path, index: int, numbers: list[int]) -> list[bool]:
    """Of each mutant, whether an input is found for which it does."""
    observe.write_netlist(folder, index, units.DATAPATH[index], numbers)
    script = folder / "sat.ys"
    script.write_text(f"read_verilog {folder}/observed/mutated_{index}.v\nprep -top hmlfc_mutated_{index}\n"
                      + "".join(f"sat -set differs[{at}] 1\n" for at in range(len(numbers))), encoding="utf-8")
    return [CAN in line for line in units.yosys(script, quiet=False).splitlines() if CAN in line or CANNOT in line]


def main(planted: pathlib.Path) -> int:
    index = next(number for number, variant in enumerate(units.DATAPATH) if variant.module == MODULE)
    listed = json.loads((planted / "mutants.json").read_text(encoding="utf-8"))["mutants"]
    mutants = [mutant for mutant in listed if mutant["variant"] == index]
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        folder = pathlib.Path(name)
        (folder / "observed").mkdir()
        for kind in ("il", "list"):
            shutil.copy(planted / f"{index}.{kind}", folder)
        found = shows(folder, index, [mutant["number"] for mutant in mutants])
    wrong = 0
    for mutant, shown in zip(mutants, found, strict=True):
        proof = prove.prove(mutant, planted, 60)
        wrong += proof == prove.UNPROVED or shown != (proof == prove.DIFFERS)
    print(f"{len(found)} mutants of {MODULE}, {sum(found)} show, {wrong} wrongly")
    return 0 if found and 0 < sum(found) < len(found) and wrong == 0 else 1


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve()))
