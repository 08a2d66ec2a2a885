#!/usr/bin/env python3
"""Whether a proof of rtl/formal finds a mutant of its module: it has a counterexample, of a run that is legal (prove.py --module).

usage: refute.py FOLDER    refutes mutants whose end is known; FOLDER is that of plant.py for the datapath. Exit: 0 all as known, 1 not.

The proof is made with the parameters that the module has in the mutated unit; where it is for others, it finds nothing. So it does within the
CPU time, and where the module without a mutant is not proved within 30 times that.
"""

import functools
import pathlib
import re
import resource
import subprocess
import sys
import tempfile

import prove
import units

FORMAL = units.RTL / "formal"
HOLDS, COUNTEREXAMPLE, OTHER = 0, 1, 3  # as prove.py exits
PREFIX = "formal."  # of the names of their tests


def test_of(proof: str) -> str:
    """The test that makes a proof."""
    return PREFIX + proof


@functools.cache
def proofs(module: str) -> tuple[str, ...]:
    """Those that have an instance `dut` of a module."""
    instance = re.compile(rf"^ +hmlfc_{module} (#\(.*\) )?dut \(", re.M)
    return tuple(path.stem for path in sorted(FORMAL.glob("*.sv")) if instance.search(path.read_text(encoding="utf-8")))


def netlist(folder: pathlib.Path, variant: int, module: str, command: str, scratch: pathlib.Path) -> pathlib.Path:
    """The module with the mutant of a command of Yosys, none for an empty one."""
    script, out = scratch / "netlist.ys", scratch / f"hmlfc_{module}.il"
    # `mutate` tells inputs of a module inside from its outputs by the closed module.
    script.write_text(f"read_rtlil {folder}/{variant}.il\n{command}\ndelete =A:blackbox\nrename top hmlfc_{module}\nwrite_rtlil {out}\n", encoding="utf-8")
    units.yosys(script)
    return out


def searched(proof: str, file: pathlib.Path, parameters: dict[str, int], seconds: int) -> int:
    """How prove.py ends for the module of `file`."""
    def limit() -> None:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    command = [sys.executable, "-B", FORMAL / "prove.py", proof, "--module", file, *(f"{key}={value}" for key, value in parameters.items())]
    return subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limit, check=False).returncode


def refuted_by(mutant: dict, folder: pathlib.Path, seconds: int) -> str | None:
    """The proof that finds a mutant of mutants.json in `folder`, where each has `seconds` of CPU time for a search."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        file = netlist(folder, mutant["variant"], mutant["module"], mutant["command"], pathlib.Path(name))
        for proof in proofs(mutant["module"]):
            sound = holds(proof, folder, mutant["variant"], mutant["module"], tuple(mutant["parameters"].items()), seconds)
            if sound and searched(proof, file, mutant["parameters"], seconds) == COUNTEREXAMPLE:
                return proof
    return None


@functools.cache
def holds(proof: str, folder: pathlib.Path, variant: int, module: str, parameters: tuple, seconds: int) -> bool:
    """Whether a proof finds nothing in the netlist without a mutant."""
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutant-") as name:
        file = netlist(folder, variant, module, "", pathlib.Path(name))
        status = searched(proof, file, dict(parameters), 30 * seconds)
    if status not in (HOLDS, OTHER):
        print(f"refute.py: {proof} is not proved of {module} {dict(parameters)}, and not tried on its mutants", file=sys.stderr)
    return status == HOLDS


# A value of a sequence is wrong; so is the same in a module whose proof is for other parameters.
KNOWN = [
    (prove.planted("bise_element", "decode_trits", "trits", 0), "bise_element"),
    (prove.planted("bise_unpack", "gen_trits[0].decode", "trits", 0), None),
]


def self_test(folder: pathlib.Path) -> int:
    wrong = 0
    for mutant, known in KNOWN:
        found = refuted_by(mutant, folder, 60)
        wrong += found != known
        print(f"{mutant['command']}: {found}{'' if found == known else f', must be {known}'}", flush=True)
        if known and not holds(known, folder, mutant["variant"], mutant["module"], tuple(mutant["parameters"].items()), 60):
            wrong += 1
            print(f"{known} finds the module without a mutant, too", flush=True)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(self_test(pathlib.Path(sys.argv[1]).resolve()))
