#!/usr/bin/env python3
"""Runs one proof of rtl/formal with Yosys and z3.

usage: prove.py NAME [--fault]

NAME.sv states what it proves in its first comment, and how in these lines of it:

  Engine: sat N           all runs of N clocks, by the SAT solver of Yosys
  Engine: bmc N           the same by z3
  Engine: induction K N   the same, and by z3 k-induction over K clocks: all runs
  Parts: N                N runs, with the parameter PART = 0 to N - 1
  Still: MODULE SIGNAL    no register of MODULE changes where its input SIGNAL is 0
  Fault: FILE / OLD / NEW text OLD of module FILE for which the self-test puts NEW

Exit status 0: proved; with --fault: each fault, planted alone in a copy, has a counterexample.
1: not so. 77: a tool is missing. 2: anything else, a tool's own error among them.
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
PROVED, REFUTED, FAILED, SKIPPED = 0, 1, 2, 77


def run(command: list[str]) -> tuple[int, str]:
    result = subprocess.run(command, capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


def check(name: str, rtl: pathlib.Path, engine: list[str], part: str, faulty: bool, smt2: pathlib.Path) -> int:
    """Reads the proof with the modules of `rtl` and runs its engine; with `faulty` no induction."""
    script = [
        f"read_verilog -sv -formal -I{rtl} -I{HERE} {rtl}/hmlfc_pkg.sv {HERE}/{name}.sv",
        f"hierarchy -check -top prove_{name} {part} -libdir {rtl}",
        "proc", "memory_dff", "memory_map", "opt_expr", "flatten", "opt_expr", "opt_clean", "opt_dff", "opt_expr"]
    if engine[0] == "sat":
        script.append("simplemap t:$dff t:$dffe")  # bit by bit: registers that are equal become one
    script += ["opt_merge", "opt_clean", "check -assert"]
    if engine[0] == "sat":
        script.append(f"sat -verify -prove-asserts -set-assumes -seq {engine[1]}")
        status, text = run(["yosys", "-p", "; ".join(script)])
        if status == 0 and "SAT proof finished - no model found: SUCCESS!" in text:
            print(f"{name}: proved")
            return PROVED
        print(text[-4000:])
        return REFUTED if "Called with -verify and proof did fail!" in text else FAILED

    script += ["async2sync", "dffunmap", "opt_clean", f"write_smt2 -wires {smt2}"]
    status, text = run(["yosys", "-q", "-p", "; ".join(script)])
    if status != 0:
        return fail(f"yosys: {text}")
    status = solve(smt2, ["-t", engine[-1]] + ([] if faulty else ["--presat"]))
    if status == PROVED and engine[0] == "induction" and not faulty:
        status = solve(smt2, ["-i", "-t", engine[1]])
    return status


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


def solve(smt2: pathlib.Path, options: list[str]) -> int:
    status, text = run(["yosys-smtbmc", "-s", "z3", "--noprogress", "--unroll", *options, str(smt2)])
    print(text, end="")
    if "Status: PASSED" in text and status == 0:
        return PROVED
    if "Status: FAILED" in text and "Assert failed in" in text and "-i" not in options:
        return REFUTED
    return FAILED


def prove(name: str, rtl: pathlib.Path, engine: list[str], parts: list[str], stills: list, faulty: bool, smt2: pathlib.Path) -> int:
    """All that a file states."""
    for module, signal in stills:
        status = still(module, signal, rtl, smt2.parent)
        if status != PROVED:
            return status
    for part in parts:
        status = check(name, rtl, engine, part, faulty, smt2)
        if status != PROVED:
            return status
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
    name = arguments[0]
    text = (HERE / f"{name}.sv").read_text(encoding="utf-8")
    engine = re.search(r"^// Engine: +((?:sat|bmc) \d+|induction \d+ \d+)$", text, re.M)
    faults = re.findall(r"^// Fault: +(\S+) / (.+) / (.+)$", text, re.M)
    if engine is None:
        return fail(f"{name}.sv names no engine")
    steps = engine[1].split()
    stills = re.findall(r"^// Still: +(\S+) (\S+)$", text, re.M)
    count = re.search(r"^// Parts: +(\d+)$", text, re.M)
    parts = [f"-chparam PART {k}" for k in range(int(count[1]))] if count else [""]

    with tempfile.TemporaryDirectory(prefix="hmlfc_formal_") as folder:
        work = pathlib.Path(folder)
        smt2 = work / "model.smt2"
        if arguments[1:] == []:
            return prove(name, RTL, steps, parts, stills, False, smt2)
        if not faults:
            return fail(f"{name}.sv has no fault to plant")
        for number, (file, old, new) in enumerate(faults):
            copy = work / f"rtl{number}"
            shutil.copytree(RTL, copy, ignore=shutil.ignore_patterns("formal", "synth"))
            source = (copy / file).read_text(encoding="utf-8")
            if old not in source:
                return fail(f"{file} has no '{old}' to plant a fault in")
            (copy / file).write_text(source.replace(old, new, 1), encoding="utf-8")
            print(f"-- {file}: {old} -> {new}")
            status = prove(name, copy, steps, parts, stills, True, smt2)
            if status == PROVED:
                print("the proof does not notice the fault")
                return REFUTED
            if status == FAILED:
                return FAILED
    return PROVED


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
