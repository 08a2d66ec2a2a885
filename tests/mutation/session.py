"""Runs the mutants of a campaign on the conformance vectors, and tells what became of them."""

import argparse
import itertools
import os
import resource
import signal
import subprocess
import sys
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from threading import Lock

from mutants import results_in, survivors_in

SKIPPED = 77
KILLED = ("killed", "crash", "timeout")
RESULTS = (*KILLED, "same code", "equivalent", "survived", "not compiled")


class Unusable(Exception):
    """Nothing can be said here: a tool or a device is missing."""


class Broken(Exception):
    """Nothing can be said of mutants: the program fails as it is."""


@dataclass(frozen=True)
class Verdict:
    """What became of a mutant: one of RESULTS."""

    result: str
    detail: str = ""  # the vector that killed it, or the reason


def tried(command, cpu_seconds, memory_bytes=None, environment=None):
    """The verdict of a program on the vectors: status 0 if none fails, 1 if one fails, which is the
    first word of its first line. Unusable: status 77; Broken: another one."""

    def limit():
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if cpu_seconds:
            resource.setrlimit(resource.RLIMIT_CPU, (cpu_seconds, cpu_seconds + 5))
        if memory_bytes:
            resource.setrlimit(resource.RLIMIT_AS, (memory_bytes, memory_bytes))

    try:
        done = subprocess.run(
            list(map(str, command)), capture_output=True, text=True, errors="replace", check=False,
            preexec_fn=limit, timeout=60 * cpu_seconds if cpu_seconds else None,
            env={**os.environ, **(environment or {})},
        )
    except subprocess.TimeoutExpired:
        return Verdict("timeout")
    if done.returncode == 0:
        return Verdict("survived")
    if done.returncode == 1:
        return Verdict("killed", done.stdout.split(":")[0])
    if done.returncode in (-signal.SIGXCPU, -signal.SIGKILL):
        return Verdict("timeout")
    if done.returncode < 0:
        return Verdict("crash", f"signal {-done.returncode}")
    kind = Unusable if done.returncode == SKIPPED else Broken
    raise kind(f"{command[0]}: status {done.returncode}: {done.stderr.strip()}")


def add_arguments(parser, count):
    """The options of a campaign, which runs `count` mutants if nobody asks for another number."""
    parser.add_argument("--count", type=int, default=count, help=f"of mutants (default {count})")
    parser.add_argument("--seed", type=int, default=1, help="another seed, another choice")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="at a time")
    parser.add_argument(
        "--again", type=Path, metavar="REPORT", help="the survivors of REPORT, the output of an earlier run"
    )
    parser.add_argument(
        "--resume", type=Path, metavar="PROGRESS",
        help="keep the results in PROGRESS, the standard error of a run of the same source and suite",
    )
    parser.add_argument("--list", action="store_true", help="print the mutants, run none")


def selected(parser, options, mutants, drawn):
    """The mutants that the options ask for: those of a report, or the first of `drawn`."""
    if not options.again:
        return list(itertools.islice(drawn, options.count))
    try:
        return survivors_in(options.again.read_text(), mutants)
    except (OSError, ValueError) as error:
        parser.error(f"--again: {error}")


def kept(options, mutants):
    """Mutant to verdict as the progress of an earlier run has them; a reason for a survivor may be new."""
    if not options.resume:
        return {}
    found = results_in(options.resume.read_text(), mutants)
    return {
        mutant: Verdict("survived") if result == "equivalent" else Verdict(result, detail)
        for mutant, (result, detail) in found.items()
    }


def run(mutants, judge, reasons, options):
    """Pairs of mutant and judge(mutant), in the order of `mutants`; survivors that have a reason are
    equivalent. Tells each as soon as it is known."""
    known = kept(options, mutants)
    lock, done = Lock(), itertools.count(1)

    def one(mutant):
        verdict = known.get(mutant) or judge(mutant)
        if verdict.result == "survived" and mutant in reasons:
            verdict = Verdict("equivalent", reasons[mutant])
        with lock:
            line = f"{next(done)}/{len(mutants)} {mutant}: {verdict.result} {verdict.detail}"
            print(line.rstrip(), file=sys.stderr, flush=True)
        return mutant, verdict

    with ThreadPoolExecutor(options.jobs) as pool:
        return list(pool.map(one, mutants))


def report(results, group):
    """Prints a table by group(mutant), and the mutants that no vector has told by wrong output."""
    counts = {}
    for mutant, verdict in results:
        counts.setdefault(group(mutant), Counter())[verdict.result] += 1
    print("| | " + " | ".join(RESULTS) + " |")
    print("|---|" + "---|" * len(RESULTS))
    for name, own in [*sorted(counts.items()), ("all", sum(counts.values(), Counter()))]:
        print(f"| {name} | " + " | ".join(str(own[result]) for result in RESULTS) + " |")
    for result in ("crash", "timeout", "equivalent", "survived"):
        for mutant, verdict in results:
            if verdict.result == result:
                print(f"{result}: {mutant}    {verdict.detail or mutant.code}")


def exit_status(results):
    """A survivor is a failure, and so is a run of which no mutant compiles."""
    ends = {verdict.result for _, verdict in results}
    return 1 if "survived" in ends or ends <= {"not compiled"} else 0
