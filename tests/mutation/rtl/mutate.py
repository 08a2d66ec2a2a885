#!/usr/bin/env python3
"""Which mutants of the decode unit's datapath the conformance vectors find.

usage: ./run mutate rtl [--count N] [--seed S] [--module NAME] [--sample N]

Yosys `mutate` makes N mutants (1092) of the modules of the datapath: a bit of a cell's port inverted, stuck, or changed where another bit
is set. Each is switched on in a Verilated unit, on which the vectors for blocks of 4 x 4 run until one finds it: a block or an error of one
that is not the golden model's, an error of the stream that is not the manifest's, or no answer. What the first vectors miss is
compared with its module by Yosys and ABC; what is not equivalent goes through all vectors, and what these miss must be in
survivors.json, each with the reason.

--module NAME   only mutants of hmlfc_NAME        --sample N   only N of them, spread evenly
--log FILE      keeps results as they come; a run with the same file and program goes on
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
import threading

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


class Log:
    """Results by step and number of a mutant, each kept in a file as soon as it is known, so that a long run goes on where it ended."""

    def __init__(self, path: pathlib.Path | None, total: int):
        self.path, self.total, self.lock = path, total, threading.Lock()
        self.known = {}
        if path and path.exists():
            for line in path.read_text(encoding="utf-8").splitlines():
                entry = json.loads(line)
                self.known[entry["step"], entry["number"]] = entry

    def add(self, step: str, result: dict) -> None:
        with self.lock:
            self.known[step, result["number"]] = result
            if self.path:
                with self.path.open("a", encoding="utf-8") as file:
                    file.write(json.dumps({"step": step, **result}) + "\n")
            if sys.stderr.isatty():
                done = sum(known == step for known, _ in self.known)
                print(f"\r\033[K{step}: {done} of {self.total}", end="", file=sys.stderr, flush=True)

    def of(self, step: str, mutant: dict) -> dict | None:
        return self.known.get((step, mutant["number"]))


class Record:
    """recorded.json: what the whole run came to when it was last written. It serves only the very mutants that it is of."""

    def __init__(self, listed: bytes):
        recorded = json.loads(RECORDED.read_text(encoding="utf-8")) if RECORDED.exists() else {}
        serves = recorded.get("mutants_sha256") == hashlib.sha256(listed).hexdigest()
        self.vectors = {number: vector for vector, numbers in recorded["found"].items() for number in numbers} if serves else {}

    @staticmethod
    def write(listed: bytes, results: dict[int, dict]) -> None:
        """`results`: of all mutants that are listed."""
        found = collections.defaultdict(list)
        for number, result in sorted(results.items()):
            if result["result"] in FOUND:
                found[result["vector"]].append(number)
        rows = ",\n".join(f"  {json.dumps(vector)}: {numbers}" for vector, numbers in sorted(found.items()))
        RECORDED.write_text(f'{{"mutants_sha256": "{hashlib.sha256(listed).hexdigest()}",\n'
                            f' "mutants": {len(results)},\n "found": {{\n{rows}}}}}\n', encoding="utf-8")


def run_groups(program: list[str], groups: list[list[dict]], record: Record, note) -> None:
    """Has rtl_mutants try groups of mutants, and gives the result of each mutant to `note`. Raises RuntimeError where it fails."""
    names = []
    for group in groups:
        vector = record.vectors.get(group[0]["number"], "") if len(group) == 1 else ""
        names.append("+".join(f"{mutant['number']}/{mutant['variant']}" for mutant in group) + f":{vector}")
    with subprocess.Popen([*program, "--mutants", ",".join(names)], stdout=subprocess.PIPE, text=True) as process:
        for line in process.stdout:
            note(json.loads(line))
    if process.returncode != 0:
        raise RuntimeError("rtl_mutants has failed")


def run_vectors(program: list[str], step: str, shards: list[list[list[dict]]], record: Record, jobs: int, log: Log) -> None:
    """Logs what rtl_mutants says of each mutant of shards of groups. Raises RuntimeError where it fails."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(lambda groups: run_groups(program, groups, record, lambda result: log.add(step, result)), shards))


def by_variant(mutants: list[dict]) -> list[list[dict]]:
    return [list(group) for _, group in itertools.groupby(mutants, lambda mutant: mutant["variant"])]


def run_proofs(mutants: list[dict], folder: pathlib.Path, seconds: int, jobs: int, log: Log) -> None:
    """Logs for each mutant whether it differs from its module."""
    def settle(mutant: dict) -> None:
        log.add("proofs", {"number": mutant["number"], "proof": prove.prove(mutant, folder, seconds)})

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(settle, [mutant for mutant in mutants if not log.of("proofs", mutant)]))


def campaign(program: list[str], mutants: list[dict], options: argparse.Namespace, record: Record, log: Log) -> dict[int, dict]:
    """The result of each mutant by number, with a `proof` for those that no vector finds.

    Most are found by the first vectors. What is not found by then is proved equivalent, if it can be, before all vectors are tried on
    the others, several of which are switched on at once."""
    left = [mutant for mutant in mutants if not log.of("first vectors", mutant)]
    shards = [[[mutant] for mutant in variant] for variant in by_variant(left)]
    run_vectors([*program, "--clocks", str(FIRST_CLOCKS)], "first vectors", shards, record, options.jobs, log)
    missed = [mutant for mutant in mutants if log.of("first vectors", mutant)["result"] not in FOUND]
    run_proofs(missed, pathlib.Path(options.mutants).resolve().parent, options.seconds, options.jobs, log)
    rest = [mutant for mutant in missed if log.of("proofs", mutant)["proof"] != prove.EQUIVALENT and not log.of("all vectors", mutant)]
    # One of each variant together: what no vector finds together takes the time of one.
    groups = [[mutant for mutant in group if mutant] for group in itertools.zip_longest(*by_variant(rest))]
    run_vectors(program, "all vectors", [[group] for group in groups], record, options.jobs, log)
    results = {}
    for mutant in mutants:
        final = log.of("all vectors", mutant) or log.of("first vectors", mutant)
        proof = {} if final["result"] in FOUND else {"proof": log.of("proofs", mutant)["proof"]}
        results[mutant["number"]] = {**final, **proof}
    return results


def identity(mutant: dict) -> tuple[str, str, str]:
    """What a mutant is known by, whatever its number is."""
    return mutant["module"], json.dumps(mutant["parameters"]), mutant["command"]


def reasons() -> dict[tuple[str, str, str], str]:
    """Why mutants that differ survive."""
    listed = json.loads((HERE / "survivors.json").read_text(encoding="utf-8"))
    return {identity(entry): entry["reason"] for entry in listed}


def explain(mutants: list[dict], results: dict[int, dict]) -> None:
    """Gives survivors that are not equivalent their `reason`, where one is listed."""
    known = reasons()
    for mutant in mutants:
        result = results[mutant["number"]]
        reason = known.get(identity(mutant))
        if reason and result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT:
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
    parser.add_argument("--seconds", type=int, default=60, help="of CPU time for each search of a proof")
    parser.add_argument("--vectors", help="only these vectors, with commas between them")
    parser.add_argument("--log", type=pathlib.Path, help="keeps results as they come; a run with the same file goes on")
    parser.add_argument("--found", action="store_true", help="only mutants that a vector found when recorded.json was written")
    parser.add_argument("--record", action="store_true", help="write recorded.json")
    options = parser.parse_args(arguments)
    text = pathlib.Path(options.mutants).read_bytes()
    listed = json.loads(text)
    record = Record(text)
    known = [mutant for mutant in listed["mutants"] if mutant["number"] in record.vectors] if options.found else listed["mutants"]
    mutants = chosen(known, options.module, options.sample)
    if not mutants:
        why = "; recorded.json is of other mutants, of another Yosys or RTL: --record makes it anew" if options.found else ""
        print(f"mutate.py: no such mutant{why}", file=sys.stderr)
        return 2
    program = [options.program, options.suite] + (["--vectors", options.vectors] if options.vectors else [])
    results = campaign(program, mutants, options, record, Log(options.log, len(mutants)))
    if options.record:
        Record.write(text, results)
    explain(mutants, results)
    if sys.stderr.isatty():
        print("\r\033[K", end="", file=sys.stderr)
    print_table(mutants, results)
    unexplained = [result for result in results.values()
                   if result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT and "reason" not in result]
    if unexplained:
        print(f"{len(unexplained)} mutants survive without a reason in survivors.json", file=sys.stderr)
    return 1 if unexplained else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
