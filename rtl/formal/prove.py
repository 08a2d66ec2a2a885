#!/usr/bin/env python3
"""Runs one proof of rtl/formal with Yosys and z3.

usage: prove.py NAME [--fault]

NAME.sv states what it proves in its first comment, and how in these lines of it:

  Engine: sat N           all runs of N clocks, by the SAT solver of Yosys
  Engine: bmc N           the same by z3
  Engine: induction K N   the same, and by z3 k-induction over K clocks: all runs
  Cover: N                each cover statement is reached within N clocks, by z3
  Parts: N                N runs, with the parameter PART = 0 to N - 1
  Still: MODULE SIGNAL    no register of MODULE changes where its input SIGNAL is 0
  Fault: FILE / OLD / NEW text OLD of module FILE for which the self-test puts NEW

Exit status 0: proved; with --fault: each fault, planted alone in a copy, has a counterexample, or the induction fails.
1: not so. 77: a tool is missing. 2: anything else, a tool's own error among them.
"""

import dataclasses
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).resolve().parent
RTL = HERE.parent
PROVED, REFUTED, FAILED, SKIPPED = 0, 1, 2, 77


def run(command: list[str]) -> tuple[int, str]:
    result = subprocess.run(command, capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


@dataclasses.dataclass
class Proof:
    """What the first comment of rtl/formal/NAME.sv says."""
    name: str
    engine: list[str]  # its name and bounds
    parts: list[str]   # options of Yosys for each run
    cover: str         # clocks, or empty
    stills: list[tuple[str, str]]
    faults: list[tuple[str, str, str]]


def read_proof(name: str) -> Proof | None:
    text = (HERE / f"{name}.sv").read_text(encoding="utf-8")
    engine = re.search(r"^// Engine: +((?:sat|bmc) \d+|induction \d+ \d+)$", text, re.M)
    if engine is None:
        return None
    count = re.search(r"^// Parts: +(\d+)$", text, re.M)
    cover = re.search(r"^// Cover: +(\d+)$", text, re.M)
    return Proof(name, engine[1].split(), [f"-chparam PART {k}" for k in range(int(count[1]))] if count else [""],
                 cover[1] if cover else "", re.findall(r"^// Still: +(\S+) (\S+)$", text, re.M),
                 re.findall(r"^// Fault: +(\S+) / (.+) / (.+)$", text, re.M))


def check(proof: Proof, rtl: pathlib.Path, part: str, faulty: bool, work: pathlib.Path) -> int:
    """Reads the proof with the modules of `rtl`, hmlfc_ram as in a simulation, and runs its engine."""
    engine = proof.engine[0]
    script = [
        f"read_verilog -sv -formal -I{rtl} -I{HERE} {rtl}/hmlfc_pkg.sv {rtl}/hmlfc_ram.sv {HERE}/{proof.name}.sv",
        f"hierarchy -check -top prove_{proof.name} {part} -libdir {rtl}",
        "proc", "opt_expr", "opt_dff", "setattr -set keep 1 t:$*ff*", "opt_clean", "setattr -unset keep t:$*ff*",  # all registers stay
        "memory_dff", "memory_map", "opt_expr", "flatten", "opt_expr", "opt_clean", "opt_dff", "opt_expr"]
    if engine == "sat":
        script.append("simplemap t:$dff t:$dffe")  # bit by bit: registers that are equal become one
    script += ["opt_merge", "opt_clean", "check -assert"]
    if engine == "sat":
        return solve_sat(proof, script)

    smt2 = work / "model.smt2"
    script += ["async2sync", "dffunmap", "opt_clean", f"write_smt2 -wires {smt2}"]
    status, text = run(["yosys", "-q", "-p", "; ".join(script)])
    if status != 0:
        return fail(f"yosys: {text}")
    status = solve_smt(smt2, ["-t", proof.engine[-1]] + ([] if faulty else ["--presat"]))
    if status == PROVED and engine == "induction":
        status = solve_smt(smt2, ["-i", "-t", proof.engine[1]])
        if status == REFUTED and not faulty:
            status = FAILED  # nothing is refuted: the proof lacks an invariant
    if status == PROVED and proof.cover:
        status = solve_smt(smt2, ["-c", "-t", proof.cover])
    return status


def solve_sat(proof: Proof, script: list[str]) -> int:
    script = script + [f"sat -verify -prove-asserts -set-assumes -seq {proof.engine[1]}"]
    status, text = run(["yosys", "-p", "; ".join(script)])
    if status == 0 and "SAT proof finished - no model found: SUCCESS!" in text:
        print(f"{proof.name}: proved")
        return PROVED
    print(text[-4000:])
    return REFUTED if "Called with -verify and proof did fail!" in text else FAILED


def solve_smt(smt2: pathlib.Path, options: list[str]) -> int:
    status, text = run(["yosys-smtbmc", "-s", "z3", "--noprogress", "--unroll", *options, str(smt2)])
    print(text, end="")
    if "Status: PASSED" in text and status == 0:
        return PROVED
    counterexample = "Assert failed in" in text or "Unreached cover statement" in text
    return REFUTED if "Status: FAILED" in text and counterexample else FAILED


def still(module: str, signal: str, rtl: pathlib.Path, work: pathlib.Path) -> int:
    """With 0 in place of the input each register of the netlist has its own output as its next value."""
    netlist = work / "still.json"
    status, text = run(["yosys", "-q", "-p", f"read_verilog -sv -I{rtl} {rtl}/hmlfc_pkg.sv {rtl}/{module}.sv; hierarchy -check -top {module} -libdir {rtl}; "
                        f"proc; flatten; opt_expr; opt_clean; memory_dff; memory_map; dffunmap; setattr -set keep 1 t:$*ff*; "
                        f"select -assert-any {module}/i:{signal}; delete -input {module}/i:{signal}; connect -set {signal} 1'b0; "
                        f"opt_expr; opt_clean; write_json {netlist}"])
    if status != 0:
        return fail(f"yosys: {text}")
    cells = json.loads(netlist.read_text(encoding="utf-8"))["modules"][module]["cells"]
    registers = [cell["connections"] for cell in cells.values() if "Q" in cell["connections"]]
    moving = sum(register["D"] != register["Q"] for register in registers)
    print(f"{module}: {moving} of {len(registers)} registers may change without {signal}")
    return REFUTED if moving else PROVED if registers else FAILED


def prove(proof: Proof, rtl: pathlib.Path, faulty: bool, work: pathlib.Path) -> int:
    """All that a file states."""
    for module, signal in proof.stills:
        status = still(module, signal, rtl, work)
        if status != PROVED:
            return status
    for part in proof.parts:
        status = check(proof, rtl, part, faulty, work)
        if status != PROVED:
            return status
    return PROVED


def find_faults(proof: Proof, work: pathlib.Path) -> int:
    """PROVED: the proof refutes each fault."""
    if not proof.faults:
        return fail(f"{proof.name}.sv has no fault to plant")
    for number, (file, old, new) in enumerate(proof.faults):
        copy = work / f"rtl{number}"
        shutil.copytree(RTL, copy, ignore=shutil.ignore_patterns("formal", "synth"))
        source = (copy / file).read_text(encoding="utf-8")
        if old not in source:
            return fail(f"{file} has no '{old}' to plant a fault in")
        (copy / file).write_text(source.replace(old, new, 1), encoding="utf-8")
        print(f"-- {file}: {old} -> {new}")
        status = prove(proof, copy, True, work)
        if status == PROVED:
            print("the proof does not notice the fault")
            return REFUTED
        if status == FAILED:
            return FAILED
    return PROVED


def fail(text: str) -> int:
    print(text, file=sys.stderr)
    return FAILED


def main(arguments: list[str]) -> int:
    if len(arguments) not in (1, 2) or arguments[1:] not in ([], ["--fault"]):
        return fail(__doc__)
    for tool in ("yosys", "yosys-smtbmc", "z3"):
        if shutil.which(tool) is None:
            print(f"SKIPPED: {tool} is not installed")
            return SKIPPED
    proof = read_proof(arguments[0])
    if proof is None:
        return fail(f"{arguments[0]}.sv names no engine")
    with tempfile.TemporaryDirectory(prefix="hmlfc_formal_") as folder:
        work = pathlib.Path(folder)
        return find_faults(proof, work) if arguments[1:] else prove(proof, RTL, False, work)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
