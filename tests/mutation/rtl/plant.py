#!/usr/bin/env python3
"""Writes a copy of the RTL with mutants that a number switches on at run time.

usage: plant.py FOLDER GROUP COUNT SEED

GROUP is one of units.py, whose modules get about COUNT mutants each, spread evenly over their variants; SEED says which. FOLDER gets NAME.v, the netlists with the mutants of Yosys `mutate`, and N.il, the modules without; hmlfc_NAME.sv, which have the ports and parameters of the modules and
choose the netlist; hmlfc_mutant_pkg.sv with a bit for each mutant, by number; the top module, which takes them from the plusarg +mutants=;
unit.f, what Verilator needs for the unit; and mutants.json, the list.
"""

import json
import pathlib
import re
import shutil
import sys

import units

SELECT_BITS = 16


def write_commands(folder: pathlib.Path, index: int, name: str) -> str:
    """The commands of Yosys that write a module as hmlfc_mutated_INDEX."""
    # Outputs get wires of their own, and words are split where a bit is mutated: else Verilator would see loops, and be slow.
    (folder / "copied.v").write_text("module copied (input A, output Y);\n  assign Y = A;\nendmodule\n", encoding="utf-8")
    return (f"iopadmap -bits -outpad copied A:Y\ntechmap -map {folder}/copied.v\nsplitnets -driver\n"
            f"rename {name} hmlfc_mutated_{index}\nwrite_verilog -noattr {folder}/mutated_{index}.v\n")


def plant_script(folder: pathlib.Path, index: int, variant: units.Variant, count: int, first: int, seed: int) -> str:
    """The script that lists and plants `count` mutants of a variant, the first with number `first`."""
    # Logic that reaches no other output than those of the trace shows in no picture.
    checks = "".join(f"select -assert-count 1 top/o:{output}\n" for output in variant.traced)
    seen = "top/x:* " + " ".join(f"top/o:{output} %d" for output in variant.traced) + " %ci* top/c:* %i"
    return (units.read_commands(variant) + checks + f"write_rtlil {folder}/{index}.il\n"
            f"mutate -list {count} -seed {seed} -ctrl mutsel {SELECT_BITS} {first} -o {folder}/{index}.list {seen if variant.traced else ''}\n"
            f"script {folder}/{index}.list\n" + write_commands(folder, index, "top"))


def plant(folder: pathlib.Path, variants: list[units.Variant], of_module: int, seed: int) -> list[dict]:
    """Plants all mutants and lists them. Each variant has a Yosys of its own, whose names of cells, and so its mutants, do not depend
    on the others."""
    found = []
    for index, variant in enumerate(variants):
        script = folder / f"{index}.ys"
        script.write_text(plant_script(folder, index, variant, variant.mutants(of_module), len(found) + 1, seed), encoding="utf-8")
        units.yosys(script)
        made = mutants(folder, index, variant, len(found) + 1)
        give_bits(folder / f"mutated_{index}.v", len(found) + 1, len(made))
        found += made
    return found


def give_bits(netlist: pathlib.Path, first: int, count: int) -> None:
    """Each mutant gets a bit of its own that switches it on in the place of a number, so that several can be on in a module."""
    text, changed = re.subn(rf"mutsel == {SELECT_BITS}'h([0-9a-f]+)", lambda found: f"mutsel[{int(found[1], 16) - first}]",
                            netlist.read_text(encoding="utf-8"))
    if changed != count:
        raise RuntimeError(f"{netlist}: {changed} comparisons in place of {count}")
    netlist.write_text(text.replace(f"[{SELECT_BITS - 1}:0] mutsel;", f"[{count - 1}:0] mutsel;"), encoding="utf-8")


def instance(variant: int, planted: list[dict]) -> str:
    numbers = [mutant["number"] for mutant in planted if mutant["variant"] == variant]
    # Verilator 5.006 does not take a variable of a package as what a port is connected to.
    return (f"    wire [{len(numbers) - 1}:0] mutsel = hmlfc_mutant_pkg::mutants[{numbers[0]} +: {len(numbers)}];\n"
            f"    hmlfc_mutated_{variant} mutated (.*);\n")


def chooser(module: str, variants: list[units.Variant], instances: dict[int, str]) -> str:
    """A module with the ports of `module` that holds what `instances` has for its parameters."""
    text = (units.RTL / f"hmlfc_{module}.sv").read_text(encoding="utf-8")
    head = re.search(rf"^module hmlfc_{module}\b.*?^\);\n", text, re.M | re.S)
    if head is None:
        raise RuntimeError(f"hmlfc_{module}.sv: no list of ports that ends with ');' on a line of its own")
    body = []
    for variant, unit in enumerate(variants):
        if unit.module == module:
            condition = " && ".join(f"{key} == {value}" for key, value in unit.parameters.items()) or "1"
            body.append(f"if ({condition}) begin : gen_{variant}\n{instances[variant]}  end")
    return head.group() + "  " + " else ".join(body) + f' else $error("units.py lacks these parameters of {module}");\nendmodule\n'


def verilator_arguments(folder: pathlib.Path, parameters: dict[str, int]) -> list[str]:
    """The parameters of the unit; its files, the package of the number first, each mutated where there is such a copy; the rules of the
    channels."""
    files = [folder / "hmlfc_mutant_pkg.sv"]
    for path in units.file_list.sources(units.RTL):
        files.append(folder / path.name if (folder / path.name).exists() else path)
    files += sorted(folder.glob("mutated_*.v")) + sorted(units.RTL.glob("kit/*_assertions.sv"))
    return [*(f"-G{key}={value}" for key, value in parameters.items()), *map(str, files)]


def mutants(folder: pathlib.Path, index: int, variant: units.Variant, first: int) -> list[dict]:
    """Those of a variant, fewer than were wanted where it has no more; the first has number `first`."""
    lines = (folder / f"{index}.list").read_text(encoding="utf-8").splitlines()
    found = []
    for number, line in enumerate(filter(lambda line: line.startswith("mutate "), lines), first):
        if f"-ctrl mutsel {SELECT_BITS} {number} " not in line:
            raise RuntimeError(f"{index}.list: mutant {number} expected: {line}")
        found.append({"number": number, "module": variant.module, "variant": index, "parameters": variant.parameters,
                      "mode": re.search(r"-mode (\S+)", line).group(1),
                      "place": re.findall(r"-src (\S+)", line), "command": re.sub(r"-ctrl mutsel \d+ \d+ ", "", line)})
    return found


def write_unit(folder: pathlib.Path, group: str, variants: list[units.Variant], instances: dict[int, str], count: int, functions: str = "") -> None:
    """The files of a unit of `count` mutants with `instances` in the place of variants, by index; `functions` are for them to call."""
    top, parameters, _ = units.GROUPS[group]
    for module in {variants[index].module for index in instances}:
        (folder / f"hmlfc_{module}.sv").write_text(chooser(module, variants, instances), encoding="utf-8")
    (folder / "hmlfc_mutant_pkg.sv").write_text(f"package hmlfc_mutant_pkg;\n  logic [{count}:0] mutants;\n{functions}endpackage\n",
                                                encoding="utf-8")
    mutated = folder / f"hmlfc_{top}.sv"
    text = (mutated if mutated.exists() else units.RTL / mutated.name).read_text(encoding="utf-8")
    plusarg = "  initial if ($value$plusargs(\"mutants=%h\", hmlfc_mutant_pkg::mutants) == 0) hmlfc_mutant_pkg::mutants = 0;\n"
    mutated.write_text(text.replace("\nendmodule", "\n" + plusarg + "endmodule"), encoding="utf-8")
    (folder / "unit.f").write_text("\n".join(verilator_arguments(folder, parameters)) + "\n", encoding="utf-8")


def main(arguments: list[str]) -> int:
    if len(arguments) != 4 or arguments[1] not in units.GROUPS:
        print(__doc__, file=sys.stderr)
        return 2
    folder, group, count, seed = pathlib.Path(arguments[0]).resolve(), arguments[1], int(arguments[2]), int(arguments[3])
    if not 1 <= count <= 400:
        print("plant.py: the count of mutants of a module is from 1 to 400", file=sys.stderr)
        return 2
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    variants = units.variants(group)
    planted = plant(folder, variants, count, seed)
    write_unit(folder, group, variants, {index: instance(index, planted) for index in range(len(variants))}, len(planted))
    listed = {"group": group, "seed": seed, "mutants": planted}
    (folder / "mutants.json").write_text(json.dumps(listed, indent=1) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
