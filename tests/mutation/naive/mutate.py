#!/usr/bin/env python3
"""Changes the naive decoder in one place at a time: do the vectors notice?

A mutant is a change of one operator, comparison, constant, condition, statement, argument, clamp, or of the order of
two checks. It is tried on the vectors that execute the changed statement. Each vector is asked twice: as `hmlfc
conform` asks a command line (the SHA-256 of all views, or the name of an error of one of them), and, if that tells
nothing of any vector, where single blocks must fail block by block (the names of the errors that the manifest states,
the checksums of the blocks file). An exception other than an error of annex A is a crash; ten times the CPU time of
the decoder as it is, and three seconds, is a timeout.
Those that no stream can tell from the decoder are in equivalents.json with the reason.
Exit status 1: a mutant survives that is not listed there.
"""

import argparse
import json
import os
import resource
import signal
import sys
from functools import cache
from pathlib import Path
from threading import Lock

FOLDER = Path(__file__).resolve().parent
sys.path[:0] = [str(FOLDER), str(FOLDER.parent)]

import decoder  # noqa: E402  (its folder is known only now)
import session  # noqa: E402
from changes import KINDS, Source, mutants_of  # noqa: E402
from decoder import Decoder, Modules, decoder_files  # noqa: E402
from mutants import reasons_of, shuffled  # noqa: E402
from session import Verdict  # noqa: E402
from suite import Suite  # noqa: E402

KEPT_KILLERS, SMALL_BYTES = 40, 1300
MEMORY_BYTES = 4 << 30
TIME_FACTOR, LEAST_SECONDS = 10, 3


@cache
def text_of(file):
    """A source of the decoder."""
    return (decoder.FOLDER / file).read_text()


def all_mutants():
    return [mutant for file in decoder_files() for mutant in mutants_of(file, text_of(file))]


def drawn(mutants, seed):
    """`mutants`, shuffled by the seed, one of each kind in turn; a larger count adds to a smaller one."""
    order = shuffled(mutants, lambda m: f"{seed} {m.file} {m.code} {m.column} {m.kind} {m.change()}")
    queues = [[mutant for mutant in order if mutant.kind == kind] for kind in KINDS]
    while any(queues):
        for queue in queues:
            if queue:
                yield queue.pop(0)


def equivalents(mutants):
    """Mutant to the reason in equivalents.json."""
    return reasons_of(json.loads((FOLDER / "equivalents.json").read_text()), mutants)


class Judge:
    """Tries mutants, each in a process of its own, beginning with small vectors that told the last ones."""

    def __init__(self, suite):
        self.suite, self.killers, self.lock = suite, [], Lock()
        self.codes = {file: compile(text_of(file), file, "exec") for file in decoder_files()}
        self.sources = {file: Source(file, text_of(file)) for file in decoder_files()}

    def of_mutant(self, mutant):
        """The verdict on a mutant; one of a single block says so after the vector's id."""
        try:
            code = compile(mutant.apply(text_of(mutant.file)), mutant.file, "exec")
        except SyntaxError:
            return Verdict("not compiled")
        line, number = self.sources[mutant.file].site(mutant), 0
        with self.lock:
            first = [v for v in self.killers if reached(v, mutant.file, line)]
        verdict = self.tried(mutant, code, first[:3], by_block=False)
        while verdict.result == "survived":
            with self.lock:
                batch = self.suite.batch(number)
            if not batch:
                break
            reaching = [v for v in batch if v not in first[:3] and reached(v, mutant.file, line)]
            verdict = self.tried(mutant, code, reaching, by_block=False)
            number += 1
        if verdict.result == "survived":
            reaching = [v for v in self.suite.tried if v.by_block and reached(v, mutant.file, line)]
            verdict = self.tried(mutant, code, reaching, by_block=True)
        return verdict

    def tried(self, mutant, code, vectors, by_block):
        """The verdict of some vectors."""
        if not vectors:
            return Verdict("survived")
        said = in_child(lambda say: self._ask(mutant, code, vectors, by_block, say))
        result, name = said[-1] if said else ("crash", vectors[0].name)
        if result == "survived":
            return Verdict("survived")
        if result == "begins":  # and nothing more: it ended from outside
            result = "timeout"
        vector = next(vector for vector in vectors if vector.name == name)
        with self.lock:
            if len(vector.data) <= SMALL_BYTES:
                others = [killer for killer in self.killers if killer is not vector]
                self.killers = [vector, *others][:KEPT_KILLERS]
        return Verdict(result, f"{name} by block" if by_block else name)

    def _ask(self, mutant, code, vectors, by_block, say):
        """In the child: what becomes of the mutant on each vector."""
        say("begins", vectors[0].name)
        allow(LEAST_SECONDS)
        vector = vectors[0]
        try:
            modules = Modules({**self.codes, mutant.file: code}).load()
            changed = Decoder(modules, self.suite.known, mutant.file)
            for vector in vectors:
                say("begins", vector.name)
                allow(LEAST_SECONDS + TIME_FACTOR * vector.seconds)
                good = vector.blocks_fit(changed) if by_block else vector.fits(changed.whole_views(vector.data))
                if not good:
                    return say("killed", vector.name)
        except Exception:  # pylint: disable=broad-except # a mutant may end in any way
            return say("crash", vector.name)
        return say("survived", "")


def reached(vector, file, line):
    """Whether a vector executes the statement; None: one outside functions, which all do."""
    return line is None or f"{file}:{line}" in vector.sites


def allow(seconds):
    """This process ends after so much CPU time from now on."""
    signal.setitimer(signal.ITIMER_PROF, seconds)


def in_child(work):
    """What work(say) says in a copy of this process: the pairs of words, in order."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            os.close(reading)
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY_BYTES, MEMORY_BYTES))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
            work(lambda result, name: os.write(writing, f"{result}\t{name}\n".encode()))
        finally:
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        said = [tuple(line.rstrip("\n").split("\t")) for line in pipe]
    os.waitpid(child, 0)
    return said


def report_blocks(results):
    """How many mutants whole views tell, and which only single blocks."""
    told = [(m, v) for m, v in results if v.result in session.KILLED]
    by_block = [(mutant, verdict) for mutant, verdict in told if verdict.detail.endswith(" by block")]
    print(f"told by whole views: {len(told) - len(by_block)}, by single blocks alone: {len(by_block)}")
    for mutant, verdict in by_block:
        print(f"by block: {mutant}    {verdict.detail}")


def main():
    parser = argparse.ArgumentParser(prog="./run mutate naive", description=__doc__.splitlines()[0])
    session.add_arguments(parser, 320)
    parser.add_argument("--file", help="only mutants of this file, relative to tests/naive_decoder/")
    options = parser.parse_args()
    mutants = all_mutants()
    reasons = equivalents(mutants)
    mutants = [mutant for mutant in mutants if options.file in (None, mutant.file)]
    chosen = session.selected(parser, options, mutants, drawn(mutants, options.seed))
    if options.list:
        print(*chosen, sep="\n")
        return 0
    results = session.run(chosen, Judge(Suite()).of_mutant, reasons, options)
    session.report(results, lambda mutant: mutant.kind)
    report_blocks(results)
    return session.exit_status(results)


if __name__ == "__main__":
    sys.exit(main())
