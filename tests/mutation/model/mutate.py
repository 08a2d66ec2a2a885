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
from pathlib import Path
from threading import Lock

FOLDER = Path(__file__).resolve().parent
ROOT = FOLDER.parents[2]
sys.path[:0] = [str(FOLDER.parent), str(ROOT / "tests/decode_path")]

import session  # noqa: E402  (its folder is known only now)
from cpp import mutants_of  # noqa: E402
from mutants import reasons_of, shuffled  # noqa: E402
from scope import decode_path_files, not_decoding  # noqa: E402
from session import Verdict  # noqa: E402
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


def drawn(mutants, seed):
    """A larger count adds to a smaller one; mutants of unchanged lines keep their order when the source
    changes."""
    return shuffled(mutants, lambda mutant: f"{seed} {mutant.file} {mutant.code} {mutant.change()}")


def equivalents():
    """Mutant to the reason in equivalents.json."""
    return reasons_of(json.loads((FOLDER / "equivalents.json").read_text()), all_mutants())


class Judge:
    """Builds and tries mutants, beginning with the vectors that killed the last ones."""

    def __init__(self, build, scratch):
        self.tools, self.scratch = Toolchain(build, MODEL), scratch
        self.killers, self.lock = [], Lock()

    def of_mutant(self, mutant):
        return self.of_text(mutant.file, mutant.apply((MODEL / mutant.file).read_text()))

    def of_text(self, file, text):
        """The verdict on the model with `text` in place of `file`."""
        with tempfile.TemporaryDirectory(dir=self.scratch) as name:
            program = self.tools.make(file, text, Path(name))
            if program is None:
                return Verdict("not compiled")
            if self.tools.same_objects(file, Path(name)):
                return Verdict("same code")
            verdict = self.tools.run(program, ROOT / "vectors", list(self.killers), CPU_SECONDS)
        if verdict.result == "killed":
            with self.lock:
                others = [killer for killer in self.killers if killer != verdict.detail]
                self.killers = [verdict.detail, *others][:KEPT_KILLERS]
        return verdict


def self_test(judge):
    """Changes whose outcomes are known."""
    sample = (MODEL / "arithmetic/reconstruct.hpp").read_text()
    bise = (MODEL / "arithmetic/bise.cpp").read_text()
    header = (MODEL / "arithmetic/bise.hpp").read_text() + "// nothing more\n"
    body = bise.index("{", bise.index("uint32_t bise_value(")) + 1
    endless = bise[:body] + " for (volatile int x = 0;; x = x) {}" + bise[body:]
    overrun = " char* volatile block = new char[16]; block[16] = 1; delete[] block;"
    difference = sample.replace("prediction + residual", "prediction - residual")
    assert difference != sample
    failed = 0
    for name, file, text, result, detail in (
        ("no change", "arithmetic/bise.cpp", bise, "same code", ""),
        ("a comment", "arithmetic/bise.hpp", header, "same code", ""),
        ("a header", "arithmetic/reconstruct.hpp", difference, "killed", "/"),
        ("no C++", "arithmetic/bise.cpp", bise + "}", "not compiled", ""),
        ("no end", "arithmetic/bise.cpp", endless, "timeout", ""),
        ("an overrun", "arithmetic/bise.cpp", bise[:body] + overrun + bise[body:], "crash", "signal 6"),
    ):
        verdict = judge.of_text(file, text)
        right = verdict.result == result and detail in verdict.detail
        failed += not right
        print(f"{name}: {verdict.result} {verdict.detail}{'' if right else '   WRONG'}", flush=True)
    return 1 if failed else 0


def main():
    parser = argparse.ArgumentParser(
        prog="./run mutate model", description=__doc__.splitlines()[0]
    )
    session.add_arguments(parser, 500)
    parser.add_argument("--build", type=Path, required=True, help=argparse.SUPPRESS)
    parser.add_argument("--file", help="only mutants of this file, relative to model/")
    parser.add_argument("--self-test", action="store_true", help="run changes of known outcome instead")
    options = parser.parse_args()
    mutants = [mutant for mutant in all_mutants() if options.file in (None, mutant.file)]
    chosen = session.selected(parser, options, mutants, drawn(mutants, options.seed))
    if options.list:
        print(*chosen, sep="\n")
        return 0
    with tempfile.TemporaryDirectory(prefix="hmlfc-mutants-") as scratch:
        judge = Judge(options.build.resolve(), scratch)
        if options.self_test:
            return self_test(judge)
        results = session.run(chosen, judge.of_mutant, equivalents(), options)
    session.report(results, lambda mutant: mutant.file)
    return session.exit_status(results)


if __name__ == "__main__":
    sys.exit(main())
