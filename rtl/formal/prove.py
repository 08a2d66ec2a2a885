#!/usr/bin/env python3
"""Runs one proof of rtl/formal with Yosys and z3.

usage: prove.py NAME

NAME.sv states what it proves in its first comment, and how in these lines of it:

  Engine: sat N           all runs of N clocks, by the SAT solver of Yosys
  Engine: bmc N           the same by z3
  Engine: induction K N   the same, and by z3 k-induction over K clocks: all runs
  Cover: N                each cover statement is reached within N clocks, by z3
  Parts: N                N runs, with the parameter PART = 0 to N - 1
  Still: MODULE SIGNAL    no register of MODULE changes where its input SIGNAL is 0
  Memories: arrays        the solver takes a memory as a whole, not word by word
  Cut: MODULE ...         outputs of these modules may be anything at any time

Exit status 0: proved. 1: a counterexample, an unreached cover statement, or a register that is not still. 77: a tool is
missing. 2: anything else: a tool's own error, or an induction that lacks an invariant.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
RTL = HERE.parent
sys.path.insert(0, str(RTL / "kit"))
import file_list  # noqa: E402

PROVED, REFUTED, FAILED, SKIPPED = 0, 1, 2, 77


def run(command: list[str]) -> tuple[int, str]:
    result = subprocess.run(command, capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def fail(text: str) -> int:
    print(text, file=sys.stderr)
    return FAILED


class Proof:
    """What the first comment of rtl/formal/NAME.sv says."""

    def __init__(self, name: str):
        self.name = name
        self.file = HERE / f"{name}.sv"
        self.text = self.file.read_text(encoding="utf-8")
        self.engine = self.field(r"(?:sat|bmc) \d+|induction \d+ \d+").split()

    def field(self, pattern: str, name: str = "Engine") -> str:
        found = re.search(rf"^// {name}: +({pattern})$", self.text, re.M)
        return found[1] if found else ""

    def parts(self) -> list[str]:
        """Options of Yosys for each run."""
        return [f"-set PART {k}" for k in range(int(self.field(r"\d+", "Parts") or 0))] or [""]

    def model(self, part: str) -> list[str]:
        """The commands that read the proof with the modules of the RTL, hmlfc_ram as in a simulation."""
        cut = [f"*hmlfc_{module}*" for module in self.field(".+", "Cut").split()]
        arrays = self.field("arrays", "Memories")
        return [
            f"verilog_defaults -add -I{RTL} -I{HERE}",
            f"read_verilog -sv -formal {RTL}/hmlfc_pkg.sv {RTL}/lib/hmlfc_ram.sv {self.file}",
            *([f"chparam {part} prove_{self.name}"] if part else []),
            f"hierarchy -check -top prove_{self.name} {file_list.library(RTL)}",
            "proc", *(["cutpoint " + " ".join(cut), "hierarchy"] if cut else []), "opt_expr", "opt_dff",
            "setattr -set keep 1 t:$*ff*", "opt_clean", "setattr -unset keep t:$*ff*",  # all registers stay
            *(["memory_collect", "memory_nordff"] if arrays else ["memory_dff", "memory_map"]),
            "opt_expr", "flatten", "opt_expr", "opt_clean", "opt_dff", "opt_expr",
            *(["simplemap t:$dff t:$dffe"] if self.engine[0] == "sat" else []),  # registers that are equal become one
            "opt_merge", "opt_clean", "check -assert"]


def solve_sat(script: list[str], clocks: str) -> int:
    version = run(["yosys", "-V"])[1].split()[1].split("+")[0]
    if tuple(map(int, version.split("."))) >= (0, 38):
        script = [*script, "chformal -lower"]  # assertions are cells that `sat` does not know
    status, text = run(["yosys", "-p", "; ".join([*script, f"sat -verify -prove-asserts -set-assumes -seq {clocks}"])])
    print(text[-4000:])
    if status == 0 and "SAT proof finished - no model found: SUCCESS!" in text:
        return PROVED
    return REFUTED if "Called with -verify and proof did fail!" in text else FAILED


def solve_smt(smt2: pathlib.Path, options: list[str]) -> int:
    status, text = run(["yosys-smtbmc", "-s", "z3", "--noprogress", "--unroll", *options, str(smt2)])
    print(text, end="")
    if "Status: PASSED" in text and status == 0:
        return PROVED
    counterexample = "Assert failed in" in text or "Unreached cover statement" in text
    return REFUTED if "Status: FAILED" in text and counterexample else FAILED


def check(proof: Proof, part: str, smt2: pathlib.Path) -> int:
    """Runs the proof's engine, with the parameters of `part`."""
    script = proof.model(part)
    if proof.engine[0] == "sat":
        return solve_sat(script, proof.engine[1])
    smt = ["async2sync", "dffunmap", "opt_clean", f"write_smt2 -wires {smt2}"]
    status, text = run(["yosys", "-q", "-p", "; ".join([*script, *smt])])
    if status != 0:
        return fail(f"yosys: {text}")
    status = solve_smt(smt2, ["-t", proof.engine[-1], "--presat"])
    if status == PROVED and proof.engine[0] == "induction":
        status = solve_smt(smt2, ["-i", "-t", proof.engine[1]])
        if status == REFUTED:
            status = FAILED  # nothing is refuted: the proof lacks an invariant
    cover = proof.field(r"\d+", "Cover")
    if status == PROVED and cover:
        status = solve_smt(smt2, ["-c", "-t", cover])
    return status


def still(module: str, signal: str, netlist: pathlib.Path) -> int:
    """With 0 in place of the input each register of the netlist has its own output as its next value."""
    status, text = run(["yosys", "-q", "-p", f"verilog_defaults -add -I{RTL}; read_verilog -sv {RTL}/hmlfc_pkg.sv {file_list.module(RTL, module)}; "
                        f"hierarchy -check -top hmlfc_{module} {file_list.library(RTL)}; "
                        "proc; flatten; opt_expr; opt_clean; memory_dff; memory_map; dffunmap; setattr -set keep 1 t:$*ff*; "
                        f"select -assert-any hmlfc_{module}/i:{signal}; delete -input hmlfc_{module}/i:{signal}; connect -set {signal} 1'b0; "
                        f"opt_expr; opt_clean; write_json {netlist}"])
    if status != 0:
        return fail(f"yosys: {text}")
    cells = json.loads(netlist.read_text(encoding="utf-8"))["modules"][f"hmlfc_{module}"]["cells"]
    registers = [cell["connections"] for cell in cells.values() if "Q" in cell["connections"]]
    moving = sum(register["D"] != register["Q"] for register in registers)
    print(f"{module}: {moving} of {len(registers)} registers may change without {signal}")
    return REFUTED if moving else PROVED if registers else FAILED


def prove(proof: Proof, work: pathlib.Path) -> int:
    """All that a file states."""
    stills = re.findall(r"^// Still: +hmlfc_(\S+) (\S+)$", proof.text, re.M)
    steps = [lambda pair=pair: still(*pair, work / "still.json") for pair in stills]
    steps += [lambda part=part: check(proof, part, work / "model.smt2") for part in proof.parts()]
    return next((status for step in steps if (status := step()) != PROVED), PROVED)


def main(arguments: list[str]) -> int:
    if len(arguments) != 1:
        return fail(__doc__)
    for tool in ("yosys", "yosys-smtbmc", "z3"):
        if shutil.which(tool) is None:
            print(f"SKIPPED: {tool} is not installed")
            return SKIPPED
    proof = Proof(arguments[0])
    if not proof.engine:
        return fail(f"{arguments[0]}.sv names no engine")
    with tempfile.TemporaryDirectory(prefix="hmlfc_formal_") as folder:
        return prove(proof, pathlib.Path(folder))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
