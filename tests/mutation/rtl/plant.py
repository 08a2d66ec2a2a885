#!/usr/bin/env python3
"""Writes a copy of the RTL with mutants that a number switches on at run time.

usage: plant.py FOLDER COUNT SEED

FOLDER gets NAME.v, the netlists with the mutants of Yosys `mutate`, and N.il, the modules without; hmlfc_NAME.sv, which have the ports and parameters of the modules and
choose the netlist; hmlfc_mutant_pkg.sv with the number, 0 for none; hmlfc_decode_unit.sv, which takes the number from the plusarg
+mutant=N; unit.f, what Verilator needs for the unit; and mutants.json, the list. COUNT mutants are spread evenly over the variants of units.py.
"""

import json
import pathlib
import re
import sys

import units

SELECT_BITS = 16


def shares(count: int) -> list[int]:
    """How many mutants each variant gets."""
    variants = len(units.VARIANTS)
    return [count // variants + (index < count % variants) for index in range(variants)]


def plant_script(folder: pathlib.Path, variant: int, share: int, first: int, seed: int) -> str:
    """The script that lists and plants the mutants of a variant, the first with number `first`."""
    traced = units.VARIANTS[variant].traced
    # Logic that reaches no other output than those of the trace shows in no picture.
    checks = "".join(f"select -assert-count 1 top/o:{output}\n" for output in traced)
    seen = "top/x:* " + " ".join(f"top/o:{output} %d" for output in traced) + " %ci* top/c:* %i"
    # Outputs get wires of their own, and words are split where a bit is mutated: else Verilator would see loops, and be slow.
    return (units.read_commands(variant) + checks + f"write_rtlil {folder}/{variant}.il\n"
            f"mutate -list {share} -seed {seed} -ctrl mutsel {SELECT_BITS} {first} -o {folder}/{variant}.list {seen}\n"
            f"script {folder}/{variant}.list\niopadmap -bits -outpad copied A:Y\ntechmap -map {folder}/copied.v\n"
            f"splitnets -driver\nrename top hmlfc_mutated_{variant}\nwrite_verilog -noattr {folder}/mutated_{variant}.v\n")


def plant(folder: pathlib.Path, count: int, seed: int) -> None:
    """Plants all mutants. Each variant has a Yosys of its own, whose names of cells, and so its mutants, do not depend on the others."""
    (folder / "copied.v").write_text("module copied (input A, output Y);\n  assign Y = A;\nendmodule\n", encoding="utf-8")
    first = 1
    for variant, share in enumerate(shares(count)):
        script = folder / f"{variant}.ys"
        script.write_text(plant_script(folder, variant, share, first, seed), encoding="utf-8")
        units.yosys(script)
        first += share


def chooser(module: str) -> str:
    """A module with the ports of `module` that holds the netlist made for its parameters."""
    text = (units.RTL / f"hmlfc_{module}.sv").read_text(encoding="utf-8")
    head = re.search(rf"^module hmlfc_{module}\b.*?^\);\n", text, re.M | re.S)
    if head is None:
        raise RuntimeError(f"hmlfc_{module}.sv: no list of ports that ends with ');' on a line of its own")
    body = []
    for variant, unit in enumerate(units.VARIANTS):
        if unit.module == module:
            condition = " && ".join(f"{key} == {value}" for key, value in unit.parameters.items()) or "1"
            # Verilator 5.006 does not take a variable of a package as what a port is connected to.
            body.append(f"if ({condition}) begin : gen_{variant}\n"
                        f"    wire [{SELECT_BITS - 1}:0] mutsel = hmlfc_mutant_pkg::mutants[{SELECT_BITS * variant} +: {SELECT_BITS}];\n"
                        f"    hmlfc_mutated_{variant} mutated (.*);\n  end")
    return head.group() + "  " + " else ".join(body) + f' else $error("units.py lacks these parameters of {module}");\nendmodule\n'


def verilator_arguments(folder: pathlib.Path) -> list[str]:
    """The parameters of the unit; its files, the package of the number first, each mutated where there is such a copy."""
    files = [folder / "hmlfc_mutant_pkg.sv"]
    for path in units.file_list.sources(units.RTL):
        files.append(folder / path.name if (folder / path.name).exists() else path)
    return [*(f"-G{key}={value}" for key, value in units.UNIT.items()), *map(str, files + sorted(folder.glob("mutated_*.v")))]


def mutants(folder: pathlib.Path) -> list[dict]:
    """All mutants in the order of their numbers."""
    found = []
    for variant, unit in enumerate(units.VARIANTS):
        for line in (folder / f"{variant}.list").read_text(encoding="utf-8").splitlines():
            number = int(re.search(r"-ctrl mutsel \d+ (\d+)", line).group(1))
            found.append({"number": number, "module": unit.module, "variant": variant, "parameters": unit.parameters,
                          "mode": re.search(r"-mode (\S+)", line).group(1),
                          "place": re.findall(r"-src (\S+)", line), "command": re.sub(r"-ctrl mutsel \d+ \d+ ", "", line)})
    return found


def main(arguments: list[str]) -> int:
    if len(arguments) != 3:
        print(__doc__, file=sys.stderr)
        return 2
    folder, count, seed = pathlib.Path(arguments[0]).resolve(), int(arguments[1]), int(arguments[2])
    if not len(units.VARIANTS) <= count < 1 << SELECT_BITS:
        print(f"plant.py: the count of mutants is from {len(units.VARIANTS)} to {(1 << SELECT_BITS) - 1}", file=sys.stderr)
        return 2
    folder.mkdir(parents=True, exist_ok=True)
    plant(folder, count, seed)
    for module in {unit.module for unit in units.VARIANTS}:
        (folder / f"hmlfc_{module}.sv").write_text(chooser(module), encoding="utf-8")
    bits = SELECT_BITS * len(units.VARIANTS)
    (folder / "hmlfc_mutant_pkg.sv").write_text(f"package hmlfc_mutant_pkg;\n  logic [{bits - 1}:0] mutants;\nendpackage\n",
                                                encoding="utf-8")
    unit = (units.RTL / "hmlfc_decode_unit.sv").read_text(encoding="utf-8")
    plusarg = "  initial if ($value$plusargs(\"mutants=%h\", hmlfc_mutant_pkg::mutants) == 0) hmlfc_mutant_pkg::mutants = 0;\n"
    (folder / "hmlfc_decode_unit.sv").write_text(unit.replace("\nendmodule", "\n" + plusarg + "endmodule"), encoding="utf-8")
    (folder / "unit.f").write_text("\n".join(verilator_arguments(folder)) + "\n", encoding="utf-8")
    listed = {"seed": seed, "mutants": mutants(folder)}
    (folder / "mutants.json").write_text(json.dumps(listed, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
