#!/usr/bin/env python3
"""Which mutants of the decode unit's datapath the conformance vectors find.

usage: ./run mutate rtl [--count N] [--seed S] [--module NAME] [--sample N]

Yosys `mutate` makes N mutants (1092) of the modules of the datapath: a bit of a cell's port inverted, stuck, or changed where another bit
is set. Each is switched on in a Verilated unit, on which the vectors for blocks of 4 x 4 run until one finds it: a block or an error of one
that is not the golden model's, an error of the stream that is not the manifest's, or no answer. What the first vectors miss is
compared with its module by Yosys and ABC; what is not equivalent goes through all vectors, and what these miss must be in
survivors.json, each with the reason.

--module NAME   only mutants of hmlfc_NAME        --sample N   only N of them, spread evenly
--record        writes recorded.json: which vector found a mutant; it is tried first from then on
--found         only mutants that were found then
"""

import argparse
import collections
import concurrent.futures
import hashlib
import itertools
import json
import pathlib
import subprocess
import sys

import prove

HERE = pathlib.Path(__file__).resolve().parent
RECORDED = HERE / "recorded.json"
FOUND = ("killed", "hangs")
FIRST_CLOCKS = 300_000


def chosen(mutants: list[dict], module: str | None, sample: int | None) -> list[dict]:
    """Those of a module; of these `sample`, spread evenly."""
    rest = [mutant for mutant in mutants if module in (None, mutant["module"])]
    if sample is None or sample >= len(rest):
        return rest
    return [rest[index * len(rest) // sample] for index in range(sample)]


def recorded_vectors(listed: bytes) -> dict[int, str]:
    """Which vector found a mutant when recorded.json was last written. It serves only the very mutants that it is of."""
    recorded = json.loads(RECORDED.read_text(encoding="utf-8"))
    if recorded["mutants_sha256"] != hashlib.sha256(listed).hexdigest():
        return {}
    return {number: vector for vector, numbers in recorded["found"].items() for number in numbers}


def write_record(listed: bytes, results: dict[int, dict]) -> None:
    """`results`: of all mutants that are listed."""
    found = collections.defaultdict(list)
    for number, result in sorted(results.items()):
        if result["result"] in FOUND:
            found[result["vector"]].append(number)
    rows = ",\n".join(f"  {json.dumps(vector)}: {numbers}" for vector, numbers in sorted(found.items()))
    RECORDED.write_text(f'{{"mutants_sha256": "{hashlib.sha256(listed).hexdigest()}",\n'
                        f' "mutants": {len(results)},\n "found": {{\n{rows}}}}}\n', encoding="utf-8")


def run_groups(program: list[str], groups: list[list[dict]], recorded: dict[int, str]) -> list[dict]:
    """The result of each mutant of groups that rtl_mutants tries. Raises RuntimeError where it fails."""
    names = []
    for group in groups:
        vector = recorded.get(group[0]["number"], "") if len(group) == 1 else ""
        names.append("+".join(f"{mutant['number']}/{mutant['variant']}" for mutant in group) + f":{vector}")
    done = subprocess.run([*program, "--mutants", ",".join(names)], stdout=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise RuntimeError("rtl_mutants has failed")
    return list(map(json.loads, done.stdout.splitlines()))


def in_parallel(step: str, function, items: list, jobs: int) -> list:
    """function(item) of each; a terminal sees how many are done."""
    results = []
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for result in pool.map(function, items):
            results.append(result)
            if sys.stderr.isatty():
                print(f"{step}: {len(results)} of {len(items)}", file=sys.stderr)
    return results


def by_variant(mutants: list[dict]) -> list[list[dict]]:
    return [list(group) for _, group in itertools.groupby(mutants, lambda mutant: mutant["variant"])]


def campaign(program: list[str], mutants: list[dict], options: argparse.Namespace, recorded: dict[int, str]) -> dict[int, dict]:
    """The result of each mutant by number, with a `proof` for those that no vector finds.

    Most are found by the first vectors. What is not found by then is proved equivalent, if it can be, before all vectors are tried on
    the others, several of which are switched on at once."""
    results = {}

    def run_vectors(step: str, command: list[str], shards: list[list[list[dict]]]) -> None:
        found = in_parallel(step, lambda groups: run_groups(command, groups, recorded), shards, options.jobs)
        results.update({result["number"]: result for result in itertools.chain(*found)})

    first = [*program, "--clocks", str(FIRST_CLOCKS)]
    run_vectors("variants, first vectors", first, [[[mutant] for mutant in variant] for variant in by_variant(mutants)])
    missed = [mutant for mutant in mutants if results[mutant["number"]]["result"] not in FOUND]
    folder = pathlib.Path(options.mutants).resolve().parent
    proofs = in_parallel("proofs", lambda mutant: prove.prove(mutant, folder, options.seconds), missed, options.jobs)
    rest = [mutant for mutant, proof in zip(missed, proofs) if proof != prove.EQUIVALENT]
    # One of each variant together: what no vector finds together takes the time of one.
    groups = [[mutant for mutant in group if mutant] for group in itertools.zip_longest(*by_variant(rest))]
    run_vectors("groups, all vectors", program, [[group] for group in groups])
    for mutant, proof in zip(missed, proofs):
        if results[mutant["number"]]["result"] not in FOUND:
            results[mutant["number"]]["proof"] = proof
    return results


def explain(mutants: list[dict], results: dict[int, dict]) -> None:
    """Gives survivors that are not equivalent their `reason` of survivors.json, which names a mutant whatever its number is."""
    def identity(mutant: dict) -> tuple[str, str, str]:
        return mutant["module"], json.dumps(mutant["parameters"]), mutant["command"]

    listed = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    reasons = {identity(entry): entry["reason"] for entry in listed}
    for mutant in mutants:
        result = results[mutant["number"]]
        if result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT and identity(mutant) in reasons:
            result["reason"] = reasons[identity(mutant)]


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
    parser.add_argument("--seconds", type=int, default=60, help="of CPU time for each search of a proof")
    parser.add_argument("--vectors", help="only these vectors, with commas between them")
    parser.add_argument("--found", action="store_true", help="only mutants that a vector found when recorded.json was written")
    parser.add_argument("--record", action="store_true", help="write recorded.json")
    options = parser.parse_args(arguments)
    text = pathlib.Path(options.mutants).read_bytes()
    listed = json.loads(text)
    recorded = recorded_vectors(text)
    known = [mutant for mutant in listed["mutants"] if mutant["number"] in recorded] if options.found else listed["mutants"]
    mutants = chosen(known, options.module, options.sample)
    if not mutants:
        why = "; recorded.json is of other mutants, of another Yosys or RTL: --record makes it anew" if options.found else ""
        print(f"mutate.py: no such mutant{why}", file=sys.stderr)
        return 2
    program = [options.program, options.suite] + (["--vectors", options.vectors] if options.vectors else [])
    results = campaign(program, mutants, options, recorded)
    if options.record:
        write_record(text, results)
    explain(mutants, results)
    print_table(mutants, results)
    unexplained = [result for result in results.values()
                   if result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT and "reason" not in result]
    if unexplained:
        print(f"{len(unexplained)} mutants survive without a reason in survivors.json", file=sys.stderr)
    return 1 if unexplained else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
