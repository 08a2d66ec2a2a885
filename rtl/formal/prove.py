#!/usr/bin/env python3
"""Runs one proof of rtl/formal with Yosys and z3.

usage: prove.py NAME [--fault | --module FILE [PARAMETER=VALUE ...]]

NAME.sv states what it proves in its first comment, and how in these lines of it:

  Engine: sat N           all runs of N clocks, by the SAT solver of Yosys
  Engine: bmc N           the same by z3
  Engine: induction K N   the same, and by z3 k-induction over K clocks: all runs
  Cover: N                each cover statement is reached within N clocks, by z3
  Parts: N                N runs, with the parameter PART = 0 to N - 1
  Still: MODULE SIGNAL    no register of MODULE changes where its input SIGNAL is 0
  Memories: arrays        the solver takes a memory as a whole, not word by word
  Cut: MODULE ...         outputs of these modules may be anything at any time
  Mutants: N              of these, runs of N clocks (else of engine or cover, whichever has more)
HMLFC_BASE_CASE is defined where no induction follows.
  Fault: FILE / OLD / NEW text OLD of module FILE for which the self-test puts NEW

Exit status 0: proved; with --fault: each fault, planted alone in a copy, has a counterexample, or the induction fails.
1: not so. 77: a tool is missing. 2: anything else, a tool's own error among them.

--module: of the module of FILE, hmlfc_MODULE.il, RTLIL with these values of its parameters, in the place of the RTL's. Those of the
proof's module are set likewise. Exit status 1: a counterexample, of a legal run: from reset, from a state that the proof says is legal, or of a
pipeline that is full; or a register that is not still. 0: none in those clocks, which proves nothing, as no induction is tried. 3: the proof is for other parameters.
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
PROVED, REFUTED, FAILED, OTHER, SKIPPED = 0, 1, 2, 3, 77


def run(command: list[str]) -> tuple[int, str]:
    result = subprocess.run(command, capture_output=True, text=True)
    return result.returncode, result.stdout + result.stderr


@dataclasses.dataclass
class Proof:
    """What the first comment of rtl/formal/NAME.sv says."""
    name: str
    file: pathlib.Path
    arrays: bool
    cut: str           # a command of Yosys, or empty
    mutants: str       # clocks, or empty
    define: str        # an option of Yosys, or empty
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
    mutants = re.search(r"^// Mutants: +(\d+)$", text, re.M)
    cut = re.search(r"^// Cut: +(.+)$", text, re.M)
    cutpoint = "cutpoint " + " ".join(f"*hmlfc_{module}*" for module in cut[1].split()) + "; hierarchy" if cut else ""
    return Proof(name, HERE / f"{name}.sv", "\n// Memories: arrays\n" in text, cutpoint, mutants[1] if mutants else "", "", engine[1].split(), [f"-set PART {k}" for k in range(int(count[1]))] if count else [""],
                 cover[1] if cover else "", re.findall(r"^// Still: +(\S+) (\S+)$", text, re.M),
                 re.findall(r"^// Fault: +(\S+) / (.+) / (.+)$", text, re.M))


def model(proof: Proof, rtl: pathlib.Path, options: str) -> list[str]:
    """The commands that read the proof, its parameters by `options`, with the modules of `rtl`, hmlfc_ram as in a simulation."""
    memory = ["memory_collect", "memory_nordff"] if proof.arrays else ["memory_dff", "memory_map"]
    narrow = ["wreduce t:$add t:$sub t:$mul", "opt_expr"] if proof.define else []  # a netlist's are; multipliers of the same shape are one for the solver
    own_ram = f"{rtl}/hmlfc_ram.sv" if (rtl / "hmlfc_ram.sv").exists() else ""
    script = [
        f"read_verilog -sv -formal {proof.define} -I{rtl} -I{HERE} {rtl}/hmlfc_pkg.sv {own_ram} {proof.file}",
        *([f"chparam {options} prove_{proof.name}"] if options.strip() else []),  # of hierarchy, Yosys 0.23 fails on some netlists
        f"hierarchy -check -top prove_{proof.name} -libdir {rtl}",
        "proc", *([proof.cut] if proof.cut else []), "opt_expr", "opt_dff", "setattr -set keep 1 t:$*ff*", "opt_clean", "setattr -unset keep t:$*ff*",  # all registers stay
        *memory, "opt_expr", "flatten", *narrow, "opt_expr", "opt_clean", "opt_dff", "opt_expr"]
    if proof.engine[0] == "sat":
        script.append("simplemap t:$dff t:$dffe")  # bit by bit: registers that are equal become one
    return [*script, "opt_merge", "opt_clean", "check -assert"]


def base_case(proof: Proof, rtl: pathlib.Path, options: str, steps: list[str], smt2: pathlib.Path) -> int:
    """The runs of N clocks. `steps` are options of the search by z3."""
    script = model(proof, rtl, options)
    if proof.engine[0] == "sat":
        return solve_sat(proof, script)
    status, text = run(["yosys", "-q", "-p", "; ".join([*script, "async2sync", "dffunmap", "opt_clean", f"write_smt2 -wires {smt2}"])])
    return solve_smt(smt2, steps) if status == 0 else fail(f"yosys: {text}")


def check(proof: Proof, rtl: pathlib.Path, part: str, faulty: bool, work: pathlib.Path) -> int:
    """Runs the proof's engine on the modules of `rtl`."""
    smt2 = work / "model.smt2"
    status = base_case(proof, rtl, part, ["-t", proof.engine[-1]] + ([] if faulty else ["--presat"]), smt2)
    if status == PROVED and proof.engine[0] == "induction":
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
    mutated = rtl / f"{module}.il"
    read = f"read_rtlil {mutated}" if mutated.exists() else f"read_verilog -sv -I{rtl} {rtl}/{module}.sv"
    status, text = run(["yosys", "-q", "-p", f"read_verilog -sv -I{rtl} {rtl}/hmlfc_pkg.sv; {read}; hierarchy -check -top {module} -libdir {rtl}; "
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


def without_parameters(text: str, module: str, values: dict[str, str]) -> tuple[str, str] | None:
    """The text of a proof whose instances of `module` set no parameters, and options that set those of the proof's module; None where an instance
    is of other values."""
    own = set(re.findall(r"^  parameter \w+ (\w+) =", text, re.M))
    for _, given in re.findall(rf"(hmlfc_{module}) #\((.*?)\) \w+ \(", text):
        for name, value in re.findall(r"\.(\w+)\((\w+)\)", given):
            if value != values.get(name) and not (name in values and value in own):
                return None
    names = set(re.findall(r"\.(\w+)\(", " ".join(re.findall(rf"hmlfc_{module} #\((.*?)\) \w+ \(", text))))
    if names != set(values):
        return None
    options = " ".join(f"-set {name} {value}" for name, value in values.items() if name in own)
    return re.sub(rf"(hmlfc_{module}) #\(.*?\) (\w+ \()", r"\1 \2", text), options


def refute(proof: Proof, netlist: pathlib.Path, values: dict[str, str], work: pathlib.Path) -> int:
    """REFUTED: the base case has a counterexample with the module of `netlist`."""
    module = netlist.stem.removeprefix("hmlfc_")
    given = without_parameters(proof.file.read_text(encoding="utf-8"), module, values)
    if given is None:
        return OTHER
    text, options = given
    rtl = work / "rtl"
    rtl.mkdir()
    for path in RTL.glob("hmlfc_*.sv*"):
        if path.stem != netlist.stem:
            (rtl / path.name).symlink_to(path)
    shutil.copy(netlist, rtl)
    proof.file = work / f"{proof.name}.sv"
    proof.file.write_text(text, encoding="utf-8")
    proof.define = "-DHMLFC_BASE_CASE"
    for name, signal in proof.stills:
        if name == netlist.stem:
            status = still(name, signal, rtl, work)
            if status != PROVED:
                return status
    clocks = proof.mutants or max(proof.engine[-1], proof.cover, key=lambda number: int(number or 0))
    for part in proof.parts:
        # All clocks in one search: where there is none, each alone takes longer.
        status = base_case(proof, rtl, f"{part} {options}", ["-t", f"0:{clocks}:{clocks}"], work / "model.smt2")
        if status != PROVED:
            return status
    return PROVED


def fail(text: str) -> int:
    print(text, file=sys.stderr)
    return FAILED


def main(arguments: list[str]) -> int:
    module = arguments[1:2] == ["--module"] and len(arguments) > 2
    if not arguments or (arguments[1:] not in ([], ["--fault"]) and not module):
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
        if module:
            return refute(proof, pathlib.Path(arguments[2]), dict(value.split("=") for value in arguments[3:]), work)
        return find_faults(proof, work) if arguments[1:] else prove(proof, RTL, False, work)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
