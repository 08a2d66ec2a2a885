#!/usr/bin/env python3
"""Which mutants of the decode unit and the view unit the conformance vectors and the tests of the bench find.

usage: ./run mutate rtl [--count N] [--seed S] [--group NAME] [--module NAME] [--sample N]

Yosys `mutate` makes N mutants (42) of each module: a bit of a cell's port inverted, stuck, or changed where another bit is set. Groups
of modules (units.py) are Verilated with their mutants in them, each of which is switched on alone. Checks run until one finds it:

- datapath: the vectors for blocks of 4 x 4: a block, an error or the tlast of one that is not the golden model's, an error of the stream
  that is not the manifest's, or no answer;
- loading, tiles, references, memories (the rest of the decode unit): these, then the tests of registers and 16 random streams of the regression;
- dma, view (the modules around it): the tests of the view unit, those of the DMA on 64 random streams.

A failing assertion of rtl/kit finds a mutant too. What the first of these checks miss is tried on the proofs of its module, if it has any
(refute.py), before the others. What nothing finds is equivalent by a proof of Yosys and ABC, or takes other clocks for a vector, or must be in
survivors.json, with the reason.

--group NAME    only mutants of the group         --module NAME   only mutants of hmlfc_NAME
--sample N      only N of them, spread evenly
--first         only the first checks: what they miss gets no result
--record        writes recorded.json: what became of them; what found one is tried first from then on
--found         only mutants that were found then
--new           only mutants of which it has no result, without the first checks, so that a campaign can go on
--proofs        only the proofs, of modules and of equivalence, no other check
"""

import argparse
import concurrent.futures
import itertools
import json
import pathlib
import subprocess
import sys
import threading

import prove
import record
import refute
import units

HERE = pathlib.Path(__file__).resolve().parent
FOUND = ("killed", "hangs")
FIRST_CLOCKS = 60_000
SPEED_CLOCKS = 300_000
LONGER = 3  # times the CPU time of a search for equivalence, for a proof of a module
TOGETHER = 48  # mutants that are switched on at once, if no check finds them


def chosen(mutants: list[dict], module: str | None, sample: int | None) -> list[dict]:
    """Those of a module; of these `sample`, spread evenly."""
    rest = [mutant for mutant in mutants if module in (None, mutant["module"])]
    if sample is None or sample >= len(rest):
        return rest
    return [rest[index * len(rest) // sample] for index in range(sample)]


def lines(program: list[str], groups: list[str]):
    """What rtl_mutants prints for these, as it does. Raises RuntimeError where it fails."""
    with subprocess.Popen([*program, "--mutants", ",".join(groups)], stdout=subprocess.PIPE, text=True) as running:
        # Verilator tells of assertions in between.
        yield from (json.loads(line) for line in running.stdout if line.startswith("{"))
    if running.returncode != 0:
        raise RuntimeError("rtl_mutants has failed")


def run_groups(program: list[str], groups: list[list[dict]], recorded: dict[int, str]):
    """The result of each mutant of groups that rtl_mutants tries."""
    names = []
    for group in groups:
        check = recorded.get(group[0]["number"], "") if len(group) == 1 else ""
        names.append("+".join(str(mutant["number"]) for mutant in group) + f":{check}")
    return lines(program, names)


def in_parallel(step: str, function, items: list, jobs: int):
    """function(item) of each, as they end in turn; a terminal sees how many are done."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        for done, result in enumerate(pool.map(function, items), 1):
            yield result
            if sys.stderr.isatty():
                print(f"{step}: {done} of {len(items)}", file=sys.stderr)


def by_variant(mutants: list[dict]) -> list[list[dict]]:
    return [list(group) for _, group in itertools.groupby(mutants, lambda mutant: mutant["variant"])]


def numbers_of(mutants: list[dict]) -> set[int]:
    return {mutant["number"] for mutant in mutants}


def together(mutants: list[dict]) -> list[list[list[dict]]]:
    """For run_checks: groups of mutants of as many variants as there are. What no check finds together takes the time of one."""
    mixed = [mutant for group in itertools.zip_longest(*by_variant(mutants)) for mutant in group if mutant]
    return [[mixed[begin:begin + TOGETHER]] for begin in range(0, len(mixed), TOGETHER)]


class Campaign:
    """One of a group of modules. `results` has what became of each mutant so far, by number: `result` of rtl_mutants, the `proof` of
    those that no check finds, and the `speed` of those that show in clocks."""

    def __init__(self, program: list[str], folder: pathlib.Path, options: argparse.Namespace, known: dict[int, str], keep):
        self.program, self.folder, self.options, self.known, self.keep = program, folder, options, known, keep
        self.results, self.lock = {}, threading.Lock()

    def run_checks(self, step: str, command: list[str], shards: list[list[list[dict]]]) -> None:
        def run_shard(groups: list[list[dict]]) -> None:
            for result in run_groups(command, groups, self.known):
                with self.lock:
                    self.results[result["number"]] = result
                    self.keep(self.results)

        for _ in in_parallel(step, run_shard, shards, self.options.jobs):
            pass

    def refute(self, mutants: list[dict]) -> None:
        """Those that a proof of their module finds have a result by that."""
        tried = [mutant for mutant in mutants if refute.proofs(mutant["module"])]
        said = in_parallel("proofs of modules", lambda mutant: refute.refuted_by(mutant, self.folder, LONGER * self.options.seconds), tried, self.options.jobs)
        for mutant, proof in zip(tried, said):
            if proof:
                self.results[mutant["number"]] = {"number": mutant["number"], "result": "killed", "vector": refute.test_of(proof)}
                self.keep(self.results)

    def left(self, mutants: list[dict]) -> list[dict]:
        return [mutant for mutant in mutants if self.results[mutant["number"]]["result"] not in FOUND]

    def prove(self, mutants: list[dict]) -> dict[int, str]:
        """What Yosys and ABC say of each; those that are equivalent have a result by that."""
        proofs = {}
        said = in_parallel("proofs", lambda mutant: prove.prove(mutant, self.folder, self.options.seconds), mutants, self.options.jobs)
        for mutant, proof in zip(mutants, said):
            proofs[mutant["number"]] = proof
            if proof == prove.EQUIVALENT:
                self.results[mutant["number"]]["proof"] = proof
                self.keep(self.results)
        return proofs

    def run(self, mutants: list[dict]) -> None:
        """Most are found by the first checks, alone, the others with many switched on at once. What no check finds is proved equivalent, if it
        can be."""
        self.results = {mutant["number"]: {"number": mutant["number"], "result": "missed"} for mutant in mutants}
        if not (self.options.new or self.options.proofs):
            first = [*self.program, "--clocks", str(FIRST_CLOCKS)]
            self.run_checks("first checks", first, [[[mutant] for mutant in variant] for variant in by_variant(mutants)])
        if self.options.first:
            return
        if not self.options.vectors:
            self.refute(self.left(mutants))
        if self.options.proofs:
            self.prove(self.left(mutants))
            return
        self.run_checks("all checks", self.program, together(self.left(mutants)))
        missed = self.left(mutants)
        proofs = self.prove(missed)
        missed = [mutant for mutant in missed if proofs[mutant["number"]] != prove.EQUIVALENT]
        for number in numbers_of(missed):
            self.results[number]["proof"] = proofs[number]
        speed = [*self.program, "--speed", "--clocks", str(SPEED_CLOCKS)]
        alone = [str(number) for number in sorted(numbers_of(missed))]
        for found in in_parallel("clocks", lambda name: list(lines(speed, [name])), alone, self.options.jobs):
            for slower in found:
                self.results[slower["number"]]["speed"] = f"{slower['clocks']} clocks of {slower['vector']} in place of {slower['unmutated']}"


def explain(mutants: list[dict], results: dict[int, dict]) -> None:
    """Gives survivors that are not equivalent their `reason` of survivors.json, which names a mutant whatever its number is."""
    reasons = record.reasons()
    for mutant in mutants:
        result = results[mutant["number"]]
        if survives(result) and record.identity(mutant) in reasons:
            result["reason"] = reasons[record.identity(mutant)]


def survives(result: dict) -> bool:
    """Neither found nor equivalent, and the clocks are the same."""
    return result.get("proof", prove.EQUIVALENT) != prove.EQUIVALENT and "speed" not in result


def counts(results: list[dict]) -> list[int]:
    """Mutants, killed, without an answer, equivalent, of other clocks, differing, unproved."""
    def number(key: str, value: str) -> int:
        return sum(result.get(key) == value for result in results)
    left = [result for result in results if survives(result)]
    return [len(results), number("result", "killed"), number("result", "hangs"), number("proof", prove.EQUIVALENT),
            sum("speed" in result for result in results), sum(result["proof"] == prove.DIFFERS for result in left),
            sum(result["proof"] == prove.UNPROVED for result in left)]


def print_table(mutants: list[dict], results: dict[int, dict]) -> None:
    print("| module | mutants | wrong output | no answer | equivalent | other clocks | survived: differ | survived: unproved |\n"
          "|---|---|---|---|---|---|---|---|")
    for module in dict.fromkeys(mutant["module"] for mutant in mutants):
        own = [results[mutant["number"]] for mutant in mutants if mutant["module"] == module]
        print("| " + " | ".join([module, *map(str, counts(own))]) + " |")
    print("| " + " | ".join(["all", *map(str, counts(list(results.values())))]) + " |\n")
    for mutant in mutants:
        result = results[mutant["number"]]
        if "speed" in result or survives(result):
            print(f"mutant {mutant['number']} {result['proof']}: hmlfc_{mutant['module']} {mutant['parameters']}\n  {mutant['command']}\n  "
                  + next((result[key] for key in ("speed", "reason") if key in result), "no reason is listed in survivors.json"))


def run_group(group: str, options: argparse.Namespace) -> tuple[int, int]:
    """Of a group: how many mutants were run, and how many survive without a reason."""
    folder = pathlib.Path(options.folder).resolve() / group
    mutants = json.loads((folder / "mutants.json").read_text(encoding="utf-8"))["mutants"]
    kept = record.of_group(group, folder, mutants)
    known = record.found_by(kept)
    if options.found:
        mutants = [mutant for mutant in mutants if mutant["number"] in known]
    if options.new:
        mutants = [mutant for mutant in mutants if mutant["number"] not in record.numbers(kept)]
    mutants = chosen(mutants, options.module, options.sample)
    if not mutants:
        return 0, 0
    program = [str(folder.parent / f"rtl_mutants_{group}"), options.suite] + (["--vectors", options.vectors] if options.vectors else [])
    keep = (lambda results: record.write(group, kept, results)) if options.record else (lambda results: None)
    campaign = Campaign(program, folder, options, known, keep)
    campaign.run(mutants)
    explain(mutants, campaign.results)
    keep(campaign.results)
    print_table(mutants, campaign.results)
    if options.first or options.proofs:
        print(f"{len(campaign.left(mutants))} of {group} have no result yet")
    return len(mutants), sum(survives(result) and "reason" not in result for result in campaign.results.values())


def main(arguments: list[str]) -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="with rtl_mutants_GROUP and GROUP/mutants.json that it was made with")
    parser.add_argument("suite", help="the folder of the vectors")
    parser.add_argument("--group", choices=units.GROUPS)
    parser.add_argument("--module")
    parser.add_argument("--sample", type=int)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--seconds", type=int, default=10, help="of CPU time for each search of a proof; few that take longer end")
    parser.add_argument("--vectors", help="only these checks, with commas between them")
    parser.add_argument("--found", action="store_true", help="only mutants that a check found when recorded.json was written")
    parser.add_argument("--new", action="store_true", help="only mutants of which recorded.json has no result")
    parser.add_argument("--first", action="store_true", help="only the first checks: what they miss gets no result")
    parser.add_argument("--proofs", action="store_true", help="only the proofs: what they miss gets no result")
    parser.add_argument("--record", action="store_true", help="write recorded.json")
    options = parser.parse_args(arguments)
    ran = [run_group(group, options) for group in ([options.group] if options.group else units.GROUPS)]
    count, unexplained = map(sum, zip(*ran))
    if count == 0:
        why = "; recorded.json is of other mutants, of another Yosys or RTL: --record makes it anew" if options.found else ""
        print(f"mutate.py: no such mutant{why}", file=sys.stderr)
        return 2
    if unexplained:
        print(f"{unexplained} mutants survive without a reason in survivors.json", file=sys.stderr)
    return 1 if unexplained else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
