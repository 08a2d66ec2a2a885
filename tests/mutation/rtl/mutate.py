#!/usr/bin/env python3
"""Which mutants of the decode unit's datapath the conformance vectors find.

usage: ./run mutate rtl [--count N] [--seed S] [--module NAME] [--sample N] [--json]

Yosys `mutate` makes N mutants (1092) of the modules of the datapath: a bit of a cell's port inverted, stuck, or changed where another bit
is set. Each is switched on in a Verilated unit, on which the vectors for blocks of 4 x 4 run until one finds it: a block's checksum or error
that is not that of its blocks file, an error of the stream that is not the manifest's, or no answer. Mutants that all vectors miss are
compared with their module by Yosys (equiv_induct, sat); those that do differ must be in survivors.json, each with the reason.

--module NAME   only mutants of hmlfc_NAME        --sample N   only N of them, spread evenly
--json          the results as JSON
"""

import argparse
import json
import pathlib
import re
import subprocess
import sys

import prove

HERE = pathlib.Path(__file__).resolve().parent
FOUND = ("killed", "hangs")


def chosen(mutants: list[dict], module: str | None, sample: int | None) -> list[dict]:
    """Those of a module; of these `sample`, spread evenly."""
    rest = [mutant for mutant in mutants if module in (None, mutant["module"])]
    if sample is None or sample >= len(rest):
        return rest
    return [rest[index * len(rest) // sample] for index in range(sample)]


def run_vectors(program: str, suite: str, mutants: list[dict], jobs: int, vectors: str | None) -> dict[int, dict]:
    """What rtl_mutants says of each mutant, by number. Raises RuntimeError where it fails."""
    extra = ["--vectors", vectors] if vectors else []
    shards = [mutants[job::jobs] for job in range(jobs) if mutants[job::jobs]]
    running = [subprocess.Popen([program, suite, *extra, "--mutants", ",".join(str(mutant["number"]) for mutant in shard)],
                                stdout=subprocess.PIPE, text=True) for shard in shards]
    results = {}
    for process in running:
        for line in process.stdout:
            result = json.loads(line)
            results[result["number"]] = result
            if sys.stderr.isatty():
                print(f"\r\033[Kmutants: {len(results)} of {len(mutants)}", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    if any([process.wait() != 0 for process in running]) or len(results) != len(mutants):
        raise RuntimeError("rtl_mutants has failed")
    return results


def identity(mutant: dict) -> tuple[str, str, str]:
    """What a mutant is known by: numbers that Yosys gives to cells by and by are left out."""
    return mutant["module"], json.dumps(mutant["parameters"]), re.sub(r"\$\d+ ", " ", mutant["command"])


def reasons() -> dict[tuple[str, str, str], str]:
    """Why mutants that differ survive."""
    listed = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    return {identity(entry): entry["reason"] for entry in listed}


def settle(mutants: list[dict], results: dict[int, dict], folder: pathlib.Path, seconds: float) -> None:
    """Gives each survivor its `proof`, and its `reason` where one is listed."""
    known = reasons()
    for mutant in mutants:
        result = results[mutant["number"]]
        if result["result"] in FOUND:
            continue
        result["proof"] = prove.prove(mutant, folder, seconds)
        reason = known.get(identity(mutant))
        if reason and result["proof"] != prove.EQUIVALENT:
            result["reason"] = reason


def counts(results: list[dict]) -> list[int]:
    """Mutants, killed, without an answer, equivalent, differing, unproved."""
    def number(key: str, value: str) -> int:
        return sum(result.get(key) == value for result in results)
    return [len(results), number("result", "killed"), number("result", "hangs"), number("proof", prove.EQUIVALENT),
            number("proof", prove.DIFFERS), number("proof", prove.UNPROVED)]


def print_table(mutants: list[dict], results: dict[int, dict]) -> None:
    print("| module | mutants | wrong output | no answer | equivalent | survived: differ | survived: unproved |\n|---|---|---|---|---|---|---|")
    for module in dict.fromkeys(mutant["module"] for mutant in mutants):
        own = [results[mutant["number"]] for mutant in mutants if mutant["module"] == module]
        print("| " + " | ".join([module, *map(str, counts(own))]) + " |")
    print("| " + " | ".join(["all", *map(str, counts(list(results.values())))]) + " |\n")
    for mutant in mutants:
        result = results[mutant["number"]]
        if result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT:
            print(f"mutant {mutant['number']} {result['proof']}: hmlfc_{mutant['module']} {mutant['parameters']}\n  {mutant['command']}\n"
                  f"  {result.get('reason', 'no reason is listed in survivors.json')}")


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="rtl_mutants")
    parser.add_argument("mutants", help="mutants.json that it was made with")
    parser.add_argument("suite", help="the folder of the vectors")
    parser.add_argument("--module")
    parser.add_argument("--sample", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=float, default=120, help="for a proof")
    parser.add_argument("--vectors", help="only these vectors, with commas between them")
    parser.add_argument("--json", action="store_true")
    options = parser.parse_args(arguments)
    listed = json.loads(pathlib.Path(options.mutants).read_text(encoding="utf-8"))
    mutants = chosen(listed["mutants"], options.module, options.sample)
    if not mutants:
        print(f"mutate.py: no mutant of module {options.module}", file=sys.stderr)
        return 2
    results = run_vectors(options.program, options.suite, mutants, options.jobs, options.vectors)
    settle(mutants, results, pathlib.Path(options.mutants).resolve().parent, options.seconds)
    if options.json:
        rows = [{**mutant, **results[mutant["number"]]} for mutant in mutants]
        print(json.dumps({"seed": listed["seed"], "mutants": rows}, indent=1))
    else:
        print_table(mutants, results)
    unexplained = [result for result in results.values()
                   if result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT and "reason" not in result]
    if unexplained:
        print(f"{len(unexplained)} mutants survive without a reason in survivors.json", file=sys.stderr)
    return 1 if unexplained else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
