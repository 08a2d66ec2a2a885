#!/usr/bin/env python3
"""Writes a copy of the RTL that says which mutants show at a pin of their module, with none switched on.

usage: observe.py FOLDER

FOLDER is that of plant.py, with the numbers of mutants to observe in observed.txt. FOLDER/observed gets a unit like that of plant.py.
Beside each module stands a shadow for each of its mutants: it begins with the same state and gets the same inputs, those from the
modules in it included. Once an output or an input of a module in it differs, the function hmlfc_differs is called with the number.
A mutant that never differs in a check cannot be found by it.
"""

import collections
import hashlib
import itertools
import json
import pathlib
import re
import shutil
import sys

import plant
import units

STATE = ("$dff", "$adff", "$mem_v2")
UNKNOWN_STATE = re.compile(r"\$.*(ff|latch|mem|sr$|fsm|any)")


def is_state(cell: dict) -> bool:
    """Whether what a cell puts out is not a function of what it gets now, or not known, as that of an instance. Raises RuntimeError for
    a cell with state of another kind."""
    kind = cell["type"]
    if kind in STATE or not kind.startswith("$"):
        return True
    if UNKNOWN_STATE.match(kind):
        raise RuntimeError(f"observe.py: STATE lacks {kind}")
    return False


def reached(module: dict, number: int) -> set[str]:
    """Cells with state that a mutant may change, by name: behind the comparison that switches it on, whatever the clock."""
    readers = collections.defaultdict(set)
    for name, cell in module["cells"].items():
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "input":
                for bit in bits:
                    readers[bit].add(name)
    select = module["ports"]["mutsel"]["bits"]
    wanted = [str(number >> at & 1) for at in range(plant.SELECT_BITS)]
    left = [name for name in readers[select[0]] if module["cells"][name]["connections"]["A"] == select
            and module["cells"][name]["connections"]["B"] == wanted]
    if not left:
        raise RuntimeError(f"observe.py: nothing compares mutsel with {number}")
    found = set(left)
    while left:
        cell = module["cells"][left.pop()]
        if not cell["type"].startswith("$"):
            continue  # an instance: what it puts out is the original's
        for port, bits in cell["connections"].items():
            if cell["port_directions"][port] == "output":
                fresh = {name for bit in bits for name in readers[bit]} - found
                found |= fresh
                left += fresh
    return {name for name in found if module["cells"][name]["type"] in STATE}


def random_bits(name: str, count: int) -> str:
    """The same for a register and its copies."""
    return "".join(f"{byte:08b}" for byte in hashlib.shake_128(name.encode()).digest(-(-count // 8)))[:count]


class Shadows:
    """Builds module `observed`: instances of `step`, the planted module without its state, one for each shadow and one, with no mutant,
    for the unit; the state of each; and the comparisons."""

    def __init__(self, module: dict, numbers: list[int], traced: tuple[str, ...]):
        self.module, self.numbers, self.traced = module, numbers, traced
        self.kept = {name: cell for name, cell in module["cells"].items() if is_state(cell)}
        self.fresh = itertools.count(1 + max(bit for net in module["netnames"].values() for bit in net["bits"] if isinstance(bit, int)))
        self.cells, self.nets = {}, {}

    def wires(self, bits: list) -> list[int]:
        return [next(self.fresh) for _ in bits]

    def step_ports(self) -> dict:
        """Those of the module, and what its state gets and gives."""
        ports = dict(self.module["ports"])
        for at, cell in enumerate(self.kept.values()):
            for port, bits in cell["connections"].items():
                gives = cell["port_directions"][port] == "output"
                ports[f"{port}_{at}"] = {"direction": "input" if gives else "output", "bits": bits}
        return ports

    def step(self) -> dict:
        rest = {name: cell for name, cell in self.module["cells"].items() if name not in self.kept}
        return {"ports": self.step_ports(), "cells": rest, "netnames": self.module["netnames"]}

    def add_copy(self, number: int, original: dict | None) -> dict:
        """A copy with mutant `number`, 0 for none; what is its own has the nets in the answer, by port of step."""
        own = reached(self.module, number) if original else self.kept
        nets = {}
        for port, what in self.step_ports().items():
            if port == "mutsel":
                nets[port] = [str(number >> at & 1) for at in range(plant.SELECT_BITS)]
            elif what["direction"] == "output":
                nets[port] = self.wires(what["bits"])
            elif port in self.module["ports"]:
                nets[port] = what["bits"]
        for at, (name, cell) in enumerate(self.kept.items()):
            gives = [port for port in cell["connections"] if cell["port_directions"][port] == "output"]
            for port in gives:
                nets[f"{port}_{at}"] = self.wires(cell["connections"][port]) if name in own else original[f"{port}_{at}"]
            if name in own:
                self.add_state(f"{name}_{number}", name, {port: nets[f"{port}_{at}"] for port in cell["connections"]})
        directions = {port: what["direction"] for port, what in self.step_ports().items()}
        self.cells[f"step_{number}"] = {"type": "step", "parameters": {}, "attributes": {}, "port_directions": directions, "connections": nets}
        return nets

    def add_state(self, name: str, of: str, connections: dict) -> None:
        cell = self.kept[of] | {"connections": connections}
        if cell["type"] == "$mem_v2":
            bits = int(cell["parameters"]["SIZE"], 2) * int(cell["parameters"]["WIDTH"], 2)
            cell["parameters"] = cell["parameters"] | {"INIT": random_bits(of, bits), "MEMID": f"\\{name}"}
        elif cell["type"] in STATE:
            bits = connections["Q"]
            self.nets[f"{name}_state"] = {"bits": bits, "attributes": {"init": random_bits(of, len(bits))}}
        self.cells[name] = cell

    def add_comparison(self, at: int, original: dict, nets: dict, differs: int) -> None:
        seen = [port for port, what in self.module["ports"].items() if what["direction"] == "output" and port not in self.traced]
        for number, cell in enumerate(self.kept.values()):
            if not cell["type"].startswith("$"):
                seen += [f"{port}_{number}" for port in cell["connections"] if cell["port_directions"][port] == "input"]
        sides = {"A": [bit for port in seen for bit in original[port]], "B": [bit for port in seen for bit in nets[port]]}
        widths = {f"{side}_{key}": f"{value:032b}" for side, bits in sides.items() for key, value in (("WIDTH", len(bits)), ("SIGNED", 0))}
        self.cells[f"differs_{at}"] = {
            "type": "$ne", "parameters": widths | {"Y_WIDTH": f"{1:032b}"}, "attributes": {}, "connections": sides | {"Y": [differs]},
            "port_directions": {"A": "input", "B": "input", "Y": "output"}}

    def observed(self) -> dict:
        original = self.add_copy(0, None)
        differs = self.wires(self.numbers) or ["0"]
        for at, number in enumerate(self.numbers):
            self.add_comparison(at, original, self.add_copy(number, original), differs[at])
        ports = {port: what | {"bits": original[port]} for port, what in self.module["ports"].items() if port != "mutsel"}
        return {"ports": ports | {"differs": {"direction": "output", "bits": differs}}, "cells": self.cells, "netnames": self.nets}


def write_netlist(folder: pathlib.Path, index: int, variant: units.Variant, numbers: list[int]) -> None:
    """Module hmlfc_mutated_INDEX with an output `differs`, a bit for each of `numbers`."""
    out = folder / "observed"
    script, netlist = out / f"{index}.ys", out / f"{index}.json"
    script.write_text(f"read_rtlil {folder}/{index}.il\nscript {folder}/{index}.list\nmemory_collect\nwrite_json {netlist}\n", encoding="utf-8")
    units.yosys(script)
    design = json.loads(netlist.read_text(encoding="utf-8"))
    shadows = Shadows(design["modules"].pop("top"), numbers, variant.traced)
    design["modules"] |= {"observed": shadows.observed(), "step": shadows.step()}
    netlist.write_text(json.dumps(design), encoding="utf-8")
    script.write_text(f"read_json {netlist}\nhierarchy -top observed\nflatten\nopt_clean\n" + "opt_expr\nopt_merge -share_all\nopt_clean\n" * 3
                      + plant.write_commands(out, index, "observed"), encoding="utf-8")
    units.yosys(script)


def instance(variant: int, numbers: list[int]) -> str:
    calls = "".join(f"      if (differs[{at}]) hmlfc_mutant_pkg::hmlfc_differs({number});\n" for at, number in enumerate(numbers))
    return (f"    wire [{max(len(numbers), 1) - 1}:0] differs;\n    hmlfc_mutated_{variant} mutated (.*);\n"
            f"    always @* if (|differs) begin\n{calls}    end\n")


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    folder = pathlib.Path(arguments[0]).resolve()
    listed = json.loads((folder / "mutants.json").read_text(encoding="utf-8"))
    wanted = set(map(int, (folder / "observed.txt").read_text(encoding="utf-8").split()))
    out = folder / "observed"
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir()
    variants = units.variants(listed["group"])
    observed = [mutant for mutant in listed["mutants"] if mutant["number"] in wanted]
    modules = {mutant["module"] for mutant in observed}
    instances = {}
    for index, variant in enumerate(variants):
        if variant.module in modules:
            numbers = [mutant["number"] for mutant in observed if mutant["variant"] == index]
            write_netlist(folder, index, variant, numbers)
            instances[index] = instance(index, numbers)
    plant.write_unit(out, listed["group"], variants, instances, len(listed["mutants"]), "  import \"DPI-C\" function void hmlfc_differs(input int number);\n")
    (out / "mutants.json").write_text(json.dumps(observed) + "\n", encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
