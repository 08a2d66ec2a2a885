#!/usr/bin/env python3
"""Changes the decode path of the model in one place at a time: do the vectors notice?

A mutant is one changed operator, comparison or constant. It is killed if vector_check, linked with it,
reports a vector, ends by a signal (build and heap are checked: an index or a shift out of range) or
exceeds the CPU time allowed. Of the others, some compile to the same code; those that no input can
tell from the model are in equivalents.json with the reason.
Exit status 1: a mutant survives that is not listed there.
"""

import argparse
import json
import sys
import tempfile
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[2]
sys.path.insert(0, str(ROOT / "tests/decode_path"))

from mutants import choose, mutants_of, reasons_of, survivors_in  # noqa: E402
from scope import decode_path_files, not_decoding  # noqa: E402
from toolchain import Toolchain  # noqa: E402

MODEL = ROOT / "model"
CPU_SECONDS = 20
KEPT_KILLERS = 12


def all_mutants():
    skipped = not_decoding(MODEL)
    return [
        mutant
        for file in decode_path_files(MODEL)
        for mutant in mutants_of(file, (MODEL / file).read_text(), skipped.get(file, frozenset()))
    ]


def line_of(mutant):
    return (MODEL / mutant.file).read_text().splitlines()[mutant.line - 1].strip()


def equivalents():
    """Mutant to the reason in equivalents.json."""
    entries = json.loads((FOLDER / "equivalents.json").read_text())
    files = {entry["file"] for entry in entries}
    return reasons_of(entries, [m for m in all_mutants() if m.file in files], line_of)


class Session:
    """Runs mutants, beginning with the vectors that killed the last ones."""

    def __init__(self, build, scratch, total):
        self.tools = Toolchain(build, MODEL)
        self.scratch, self.total = scratch, total
        self.killers, self.lock = [], Lock()
        self.results = []
        self.equivalents = equivalents()

    def try_mutant(self, number, mutant):
        text = (MODEL / mutant.file).read_text()
        self.note(mutant, self.outcome(mutant.file, mutant.apply(text), str(number)))

    def outcome(self, file, text, name):
        folder = self.scratch / name
        program = self.tools.make(file, text, folder)
        if program is None:
            return "not compiled"
        if self.tools.same_objects(file, folder):
            return "same code"
        outcome = self.tools.run(program, ROOT / "vectors", list(self.killers), CPU_SECONDS)
        program.unlink()
        return outcome

    def note(self, mutant, outcome):
        with self.lock:
            if "/" in outcome:
                self.killers = [outcome, *(k for k in self.killers if k != outcome)][:KEPT_KILLERS]
            if outcome == "survived" and mutant in self.equivalents:
                outcome = "equivalent"
            self.results.append((mutant, outcome))
            done = f"{len(self.results)}/{self.total}"
            print(f"{done} {mutant}: {outcome}", file=sys.stderr, flush=True)


def report(results):
    """Prints the table by file and the survivors; returns the number of survivors."""
    kinds = ("killed", "timeout", "same code", "equivalent", "survived", "not compiled")
    by_file = {}
    for mutant, outcome in results:
        kind = outcome if outcome in kinds else "killed"
        by_file.setdefault(mutant.file, Counter())[kind] += 1
    print("| file | " + " | ".join(kinds) + " |")
    print("|---|" + "---|" * len(kinds))
    total = sum(by_file.values(), Counter())
    for name, counts in [*sorted(by_file.items()), ("all", total)]:
        print(f"| {name} | " + " | ".join(str(counts[kind]) for kind in kinds) + " |")
    for mutant, outcome in results:
        if outcome == "survived":
            print(f"survived: {mutant}    {line_of(mutant)}")
    return total["survived"]


def self_test(session):
    """Changes whose outcomes are known."""
    sample = (MODEL / "arithmetic/reconstruct.hpp").read_text()
    bise = (MODEL / "arithmetic/bise.cpp").read_text()
    header = (MODEL / "arithmetic/bise.hpp").read_text() + "// nothing more\n"
    body = bise.index("{", bise.index("uint32_t bise_value(")) + 1
    endless = bise[:body] + " for (volatile int x = 0;; x = x) {}" + bise[body:]
    overrun = " char* volatile block = new char[16]; block[16] = 1; delete[] block;"
    difference = sample.replace("prediction + residual", "prediction - residual")
    assert difference != sample
    cases = [
        ("no change", "arithmetic/bise.cpp", bise, lambda outcome: outcome == "same code"),
        ("a comment", "arithmetic/bise.hpp", header, lambda outcome: outcome == "same code"),
        ("a header", "arithmetic/reconstruct.hpp", difference, lambda outcome: "/" in outcome),
        ("no C++", "arithmetic/bise.cpp", bise + "}", lambda outcome: outcome == "not compiled"),
        ("no end", "arithmetic/bise.cpp", endless, lambda outcome: outcome == "timeout"),
        ("an overrun", "arithmetic/bise.cpp", bise[:body] + overrun + bise[body:],
         lambda outcome: outcome == "signal 6"),
    ]
    failed = 0
    for name, file, text, expected in cases:
        outcome = session.outcome(file, text, "self-test")
        failed += not expected(outcome)
        print(f"{name}: {outcome}{'' if expected(outcome) else '   WRONG'}", flush=True)
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(
        prog="./run mutate model", description=__doc__.splitlines()[0]
    )
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--count", type=int, default=500)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--file", help="only mutants of this file, relative to model/")
    parser.add_argument(
        "--again", type=Path, metavar="REPORT", help="the survivors of REPORT, the output of an earlier run"
    )
    parser.add_argument("--list", action="store_true", help="print the mutants, run none")
    parser.add_argument("--self-test", action="store_true", help="run changes of known outcome instead")
    arguments = parser.parse_args()
    mutants = [m for m in all_mutants() if arguments.file in (None, m.file)]
    if arguments.again:
        try:
            chosen = survivors_in(arguments.again.read_text(), mutants)
        except (OSError, ValueError) as error:
            parser.error(f"--again: {error}")
        again = f"--again {arguments.again}"
    else:
        chosen = choose(mutants, arguments.count, arguments.seed)
        again = f"--count {arguments.count} --seed {arguments.seed}"
    if arguments.list:
        print(*chosen, sep="\n")
        return 0
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutants-") as scratch:
        session = Session(arguments.build.resolve(), Path(scratch), len(chosen))
        if arguments.self_test:
            return self_test(session)
        with ThreadPoolExecutor(arguments.jobs) as pool:
            list(pool.map(lambda job: session.try_mutant(*job), enumerate(chosen)))
    results = sorted(session.results, key=lambda r: (r[0].file, r[0].line, r[0].column))
    survived = report(results)
    print(f"{len(results)} of {len(mutants)} mutants; again: ./run mutate model {again}")
    return 1 if survived else 0


if __name__ == "__main__":
    sys.exit(main())
