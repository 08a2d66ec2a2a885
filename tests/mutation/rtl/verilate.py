#!/usr/bin/env python3
"""Verilates and compiles the mutated unit.

usage: verilate.py MUTANTS FOLDER COMPILER    MUTANTS: the folder that plant.py has written; FOLDER gets MutatedUnit__ALL.a
"""

import pathlib
import subprocess
import sys

import units


def sources(mutants: pathlib.Path) -> list[str]:
    """The package of the number first, and for each module of the RTL its mutated copy if there is one."""
    files = [mutants / "hmlfc_mutant_pkg.sv", units.RTL / "hmlfc_pkg.sv"]
    for path in sorted(units.RTL.glob("hmlfc_*.sv")):
        if path.name != "hmlfc_pkg.sv":
            files.append(mutants / path.name if (mutants / path.name).exists() else path)
    return [str(path) for path in files + sorted(mutants.glob("mutated_*.v"))]


def main(arguments: list[str]) -> int:
    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    mutants, folder, compiler = pathlib.Path(arguments[0]).resolve(), pathlib.Path(arguments[1]).resolve(), arguments[2]
    # Single bits of words that are mutated look like loops to Verilator (UNOPTFLAT).
    command = ["verilator", "--cc", "--top-module", "hmlfc_decode_unit", "--prefix", "MutatedUnit", "--Mdir", str(folder), f"-I{units.RTL}",
               "-Wno-lint", "-Wno-UNOPTFLAT", "--x-assign", "fast", "--x-initial", "fast", "--noassert", "-O3"]
    command += [f"-G{key}={value}" for key, value in units.UNIT.items()]
    subprocess.run(command + sources(mutants), check=True)
    make = ["make", "-C", str(folder), "-f", "MutatedUnit.mk", f"CXX={compiler}", "OPT_FAST=-O2", "OPT_SLOW=-O0", "OPT_GLOBAL=-O1",
            "MutatedUnit__ALL.a"]
    subprocess.run(make, check=True)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
